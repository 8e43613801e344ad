#version 450
// Like capture.tese, for devices without transform feedback: points in any order, some maybe several times.
layout(triangles, equal_spacing, cw) in;
layout(push_constant) uniform Draw { uint first_patch; };
layout(set = 0, binding = 1, std430) buffer Points {
    uint count;
    uint unused[3];
    uvec4 points[];
};

void main()
{
    uint at = atomicAdd(count, 1u);
    if (at < uint(points.length()))
        points[at] = uvec4(floatBitsToUint(gl_TessCoord), first_patch + uint(gl_PrimitiveID));
}
