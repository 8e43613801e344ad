#version 450
// Outputs the bits of the domain point and the number of the patch, captured for each vertex of each primitive.
// The modes are replaced when a pipeline is created.
layout(triangles, equal_spacing, cw) in;
layout(push_constant) uniform Draw { uint first_patch; };
layout(location = 0, xfb_buffer = 0, xfb_offset = 0, xfb_stride = 16) out uvec4 vertex;

void main()
{
    vertex = uvec4(floatBitsToUint(gl_TessCoord), first_patch + uint(gl_PrimitiveID));
}
