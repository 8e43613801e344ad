//! Bit-exact batch tessellation on CPUs.
