// The screen position of a domain point of a patch. The patches form a square grid, slightly curved.
layout(push_constant) uniform Draw { layout(offset = 4) uint patches_in_a_row; };

vec4 surface(vec2 uv, uint patch_number)
{
    vec2 cell = vec2(patch_number % patches_in_a_row, patch_number / patches_in_a_row);
    vec2 bent = uv + 0.05 * sin(6.2831853 * uv.yx);
    return vec4((cell + bent) * (2.0 / float(patches_in_a_row)) - 1.0, 0.5, 1.0);
}
