#version 450
// Tessellation needs no vertices: a patch is its number.
void main() {}
