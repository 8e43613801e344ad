// needs: nothing; bindings: contexts, job
// The contexts that the stage `factors` stored.

fn context_of(patch_index: u32, factor: u32, points: u32) -> vec2<u32> {
    return contexts[factor * job.stride + patch_index];
}
