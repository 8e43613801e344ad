#version 450
// Passes on the raw factors of a patch, bit for bit: four outer and two inside, even if the domain has fewer.
layout(vertices = 1) out;
layout(set = 0, binding = 0, std430) readonly buffer Factors { uint factors[]; };
layout(push_constant) uniform Draw { uint first_patch; };

void main()
{
    uint at = 6u * (first_patch + uint(gl_PrimitiveID));
    gl_TessLevelOuter[0] = uintBitsToFloat(factors[at]);
    gl_TessLevelOuter[1] = uintBitsToFloat(factors[at + 1u]);
    gl_TessLevelOuter[2] = uintBitsToFloat(factors[at + 2u]);
    gl_TessLevelOuter[3] = uintBitsToFloat(factors[at + 3u]);
    gl_TessLevelInner[0] = uintBitsToFloat(factors[at + 4u]);
    gl_TessLevelInner[1] = uintBitsToFloat(factors[at + 5u]);
}
