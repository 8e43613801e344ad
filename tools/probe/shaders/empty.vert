#version 450
// Tessellation needs no vertices here: a patch is given by its number.
void main() {}
