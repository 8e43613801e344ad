#version 450
#extension GL_GOOGLE_include_directive : require
// Runs after the compute shaders, on a packed point (`tess_gpu::layout::PackedPoint`).
layout(location = 0) in uvec2 point;
#include "surface.glsl"

void main()
{
    uint v = point.x >> 17 | (point.y & 3u) << 15;
    gl_Position = surface(vec2(point.x & 0x1ffffu, v) / 65536.0, point.y >> 2);
}
