#version 450
#extension GL_GOOGLE_include_directive : require
// Runs after the fixed-function tessellator. The modes are replaced when a pipeline is created.
layout(triangles, equal_spacing, cw) in;
#include "surface.glsl"

void main()
{
    gl_Position = surface(gl_TessCoord.xy, uint(gl_PrimitiveID));
}
