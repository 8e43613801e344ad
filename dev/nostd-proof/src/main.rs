//! A program of `tess-core` alone: no standard library, no allocator, no libc.
//!
//! That it links is the proof. It also runs: it tessellates the largest patch into buffers on its
//! stack, compares every element with random access, and exits with 0 if they are all equal, with
//! 1 if one is not, with 2 on a panic. x86-64 Linux.
#![no_std]
#![no_main]

use core::arch::{asm, global_asm};
use core::hint::black_box;
use core::panic::PanicInfo;
use tess_core::{
    Config, DomainPoint, MAX_INDICES, MAX_POINTS, OutputPrimitive, Partitioning, Patch,
    PatchFactors, QuadFactors,
};

// The kernel enters with an aligned stack; a function is entered with a return address on it.
global_asm!(".globl _start", "_start:", "and rsp, -16", "call {run}", "ud2", run = sym run);

// What compiled code expects of any environment: two block operations, and a symbol of unwinding
// that the precompiled `core` names and nothing calls under `panic = "abort"`.
global_asm!(
    ".globl memcpy",
    "memcpy:",
    "mov rax, rdi",
    "mov rcx, rdx",
    "rep movsb",
    "ret",
    ".globl memset",
    "memset:",
    "mov r8, rdi",
    "mov eax, esi",
    "mov rcx, rdx",
    "rep stosb",
    "mov rax, r8",
    "ret",
    ".globl rust_eh_personality",
    "rust_eh_personality:",
    "ud2",
);

extern "C" fn run() -> ! {
    exit(if formulations_agree() { 0 } else { 1 })
}

/// Both formulations of the largest patch; false if they differ or an index is missing.
fn formulations_agree() -> bool {
    let [u0, v0, u1, v1, inside_u, inside_v] = black_box([64.0; 6]);
    let factors = QuadFactors { u0, v0, u1, v1, inside_u, inside_v };
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCcw);
    let patch = Patch::new(config, PatchFactors::Quad(factors));
    let mut points = [DomainPoint::default(); MAX_POINTS];
    let mut indices = [u32::MAX; MAX_INDICES];
    let Ok(counts) = patch.write(&mut points, &mut indices) else { return false };
    let filled = (counts.points as usize, counts.indices as usize) == (MAX_POINTS, MAX_INDICES);
    let triangles = indices.chunks_exact(3);
    filled
        && patch.points().eq(points)
        && patch.primitives().zip(triangles).all(|(one, other)| one.indices() == other)
}

fn exit(status: i32) -> ! {
    // SAFETY: the system call `exit` (60) takes a status, touches no memory and does not return.
    unsafe { asm!("syscall", in("rax") 60, in("rdi") status, options(noreturn, nostack)) }
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    exit(2)
}
