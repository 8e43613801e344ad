// needs: nothing; bindings: catalogue
// The catalogue in the expansions of a long batch.

fn catalogue_word(at: u32) -> u32 {
    return catalogue[at];
}
