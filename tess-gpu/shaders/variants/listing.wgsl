// needs: shared/catalogue; bindings: catalogue, job
// Entering topologies into the catalogue.

// The number of a topology's slot from 1 on, or 0 if the topology is large or there is no slot for it.
// `size` is its points and primitives.
fn slot_of(topology: vec2<u32>, size: vec2<u32>) -> u32 {
    if job.has_catalogue == 0u || !has_key(topology) || size.x > LISTED_POINTS || size.y > LISTED_PRIMITIVES {
        return 0u;
    }
    let key = key_of(topology);
    var at = (key * 0x9e3779b9u) >> (32u - SLOT_BITS);
    for (var probe = 0u; probe < 16u; probe++) {
        let found = atomicLoad(&catalogue[at]);
        if found == key {
            return at + 1u;
        }
        if found == 0u {
            let old = atomicCompareExchangeWeak(&catalogue[at], 0u, key);
            if old.exchanged || old.old_value == key {
                return at + 1u;
            }
        }
        at = (at + 1u) % SLOTS;
    }
    return 0u;
}

// Before the first key: nothing of the catalogue is in use.
fn empty_catalogue() {
    if job.has_catalogue == 0u {
        return;
    }
    atomicStore(&catalogue[USED_AT], 0u);
    atomicStore(&catalogue[USED_AT + 1u], 0u);
}
