// needs: nothing; bindings: contexts
// The contexts that the stage `factors` stored, all of them bound.

fn context_of(patch_index: u32, factor: u32, points: u32) -> vec2<u32> {
    return contexts[factor * (arrayLength(&contexts) / FACTORS) + patch_index];
}
