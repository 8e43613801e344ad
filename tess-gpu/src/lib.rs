//! Bit-exact tessellation in WGSL compute shaders.
