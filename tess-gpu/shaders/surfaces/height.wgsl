// Height images. The formulas of height.rs.

// The height between four texels: upper left, upper right, lower left, lower right. `part` is the fraction of the way
// to the right and down.
fn tess_bilinear(texels: vec4<f32>, part: vec2<f32>) -> f32 {
    let above = texels.x + (texels.y - texels.x) * part.x;
    let below = texels.z + (texels.w - texels.z) * part.x;
    return above + (below - above) * part.y;
}

// The first channel of a texture of float components, filterable or not, at a place: 0 to 1 from left to right and
// from the top down. It is bilinear between texel centres, and the outermost texels go on beyond them (Address::Clamp
// in height.rs). Places are rounded to 1/256 of a texel, the precision of samplers. No sampler is used, so hull and
// domain functions get the same height.
fn tess_sample(map: texture_2d<f32>, at: vec2<f32>) -> f32 {
    let size = vec2<i32>(textureDimensions(map));
    let place = vec2<i32>(round((at * vec2<f32>(size) - 0.5) * 256.0));
    let low = place >> vec2<u32>(8u);
    let part = vec2<f32>(place - (low << vec2<u32>(8u))) / 256.0;
    let last = size - 1;
    let a = clamp(low, vec2<i32>(0), last);
    let b = clamp(low + 1, vec2<i32>(0), last);
    return tess_bilinear(vec4<f32>(
        textureLoad(map, a, 0).x, textureLoad(map, vec2<i32>(b.x, a.y), 0).x,
        textureLoad(map, vec2<i32>(a.x, b.y), 0).x, textureLoad(map, b, 0).x), part);
}
