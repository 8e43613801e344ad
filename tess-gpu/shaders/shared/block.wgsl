// needs: stages/counts, {listing}, stages/factor_context, shared/prefix_sum, stages/factors, layout/setup, layout/topology; bindings: contexts, job, offsets, raw_factors, topologies
// Factor processing (spec section 3) of a block of patches: one thread per patch, from the bits of
// its raw factors to its topology, contexts and counts.

fn process(patch_index: u32) -> Processed {
    if DOMAIN == ISOLINE {
        return process_isoline(raw_factors[patch_index]);
    }
    if DOMAIN == TRIANGLE {
        let at = 2u * patch_index;
        return process_triangle(vec4<u32>(raw_factors[at], raw_factors[at + 1u]));
    }
    let at = 3u * patch_index;
    let outer = vec4<u32>(raw_factors[at], raw_factors[at + 1u]);
    return process_quad(outer, raw_factors[at + 2u]);
}

// Writes the contexts of a regular patch, one for each factor of the domain. Integer factors need
// none (variants/place_evenly.wgsl).
fn write_contexts(patch_index: u32, processed: Processed) {
    let at = patch_index;
    let step = job.stride;
    contexts[at] = make_context(processed.outer.x, processed.outer_odd.x);
    contexts[at + step] = make_context(processed.outer.y, processed.outer_odd.y);
    if DOMAIN == ISOLINE {
        return;
    }
    contexts[at + 2u * step] = make_context(processed.outer.z, processed.outer_odd.z);
    if DOMAIN == TRIANGLE {
        contexts[at + 3u * step] = make_context(processed.inside.x, processed.inside_odd.x);
        return;
    }
    contexts[at + 3u * step] = make_context(processed.outer.w, processed.outer_odd.w);
    contexts[at + 4u * step] = make_context(processed.inside.x, processed.inside_odd.x);
    contexts[at + 5u * step] = make_context(processed.inside.y, processed.inside_odd.y);
}

// The topology of a block's first patch, and whether any other patch has another.
var<workgroup> first_topology: vec2<u32>;
var<workgroup> differs: atomic<u32>;

struct BlockSums {
    // Points and primitives of the thread's patch, of the patches before it and of the whole block.
    own: vec2<u32>,
    before: vec2<u32>,
    all: vec2<u32>,
}

// Processes a block; tests/twins/block.rs is the same in Rust. Called in uniform control flow by all threads of a workgroup of
// BLOCK.
fn process_block(block: u32, thread: u32) -> BlockSums {
    let patch_index = block * BLOCK + thread;
    var own = vec2<u32>(0u, 0u);
    var topology = vec2<u32>(0u, 0u);
    if patch_index < job.patches {
        let processed = process(patch_index);
        topology = processed.topology;
        topologies[patch_index] = topology;
        own = counts(topology);
        if !IS_INTEGER && state_of(processed.topology) == REGULAR {
            write_contexts(patch_index, processed);
        }
    }
    // The barriers of the sums come between this and the comparison.
    if thread == 0u {
        first_topology = topology;
        atomicStore(&differs, 0u);
    }
    let sums = prefix_sums(thread, own);
    if patch_index < job.patches {
        offsets[patch_index] = sums.before;
        if any(topology != first_topology) {
            atomicStore(&differs, 1u);
        }
    }
    workgroupBarrier();
    // Patches of a block that are alike are copied from one of them, so only the first may need a slot: its points
    // differ from patch to patch unless they can be copied too.
    let is_alike = atomicLoad(&differs) == 0u;
    var slot = vec2<u32>(0u, 0u);
    if !is_alike || (thread == 0u && !HAS_COPIED_POINTS) {
        slot.y = slot_of(topology, own) << 14u;
    }
    if slot.y != 0u && !is_alike {
        topologies[patch_index] = topology | slot;
    }
    if thread == 0u && block * BLOCK < job.patches {
        offsets[job.alike_at + block] = select(vec2<u32>(0u, 0u), topology | slot, is_alike);
    }
    return BlockSums(own, sums.before, sums.all);
}
