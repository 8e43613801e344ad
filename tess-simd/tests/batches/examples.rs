//! Runs the examples, which assert what they show.

#[path = "../../examples/own_buffers.rs"]
mod own_buffers;

#[cfg(feature = "rayon")]
#[path = "../../examples/threads.rs"]
mod threads;

#[test]
fn own_buffers_fill_up() {
    assert_eq!(own_buffers::main(), Ok(()), "own_buffers");
}

#[cfg(feature = "rayon")]
#[test]
fn threads_give_the_same_output() {
    assert_eq!(threads::main(), Ok(()), "threads");
}
