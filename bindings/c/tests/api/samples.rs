//! Patches to compare with: every configuration, factors of every kind.

use std::ffi::{CStr, c_char, c_void};
use tess_capi::patch::tess_patch;
use tess_capi::status::TESS_OK;
use tess_capi::types::{
    TESS_MAX_INDICES, TESS_MAX_POINTS, TessConfig, TessContext, TessCounts, TessPoint,
};
use tess_core::{
    Config, Counts, Domain, DomainPoint, FactorContext, OutputPrimitive, Parity, Partitioning,
    Patch, PatchFactors, SplitOrder,
};

/// One patch as C describes it and as the model does.
pub(super) struct Sample {
    pub(super) config: TessConfig,
    pub(super) factors: Vec<f32>,
    pub(super) patch: Patch,
}

/// The model's own answer, as a device gives it.
///
/// # Safety
/// As for a `TessDevice`.
pub(super) unsafe fn answer(
    config: *const TessConfig,
    factors: *const f32,
    factor_count: usize,
    points: *mut TessPoint,
    indices: *mut u32,
    counts: *mut TessCounts,
) {
    let (most_points, most_indices) = (TESS_MAX_POINTS as usize, TESS_MAX_INDICES as usize);
    // SAFETY: what a device is given is what `tess_patch` asks for.
    let status = unsafe {
        tess_patch(
            config,
            factors,
            factor_count,
            points,
            most_points,
            indices,
            most_indices,
            counts,
        )
    };
    assert_eq!(status, TESS_OK, "a patch");
}

/// Change to the model's answer, and what the device answers.
pub(super) type DeviceFault = fn(&TessConfig, &mut TessCounts, *mut u32) -> i32;

/// The model's own answer, then the fault that `user` points to.
pub(super) unsafe extern "C" fn device(
    user: *mut c_void,
    config: *const TessConfig,
    factors: *const f32,
    factor_count: usize,
    points: *mut TessPoint,
    indices: *mut u32,
    counts: *mut TessCounts,
) -> i32 {
    // SAFETY: the device is called as its type says; `user` is the fault that the test gave.
    unsafe {
        answer(config, factors, factor_count, points, indices, counts);
        (*user.cast::<DeviceFault>())(&*config, &mut *counts, indices)
    }
}

/// The text that a function wrote to room full of ones; empty if it wrote none.
pub(super) fn text(room: &[c_char]) -> String {
    if room[0] == 1 {
        assert!(room.iter().all(|&byte| byte == 1), "nothing is written");
        return String::new();
    }
    // SAFETY: a text ends with a zero byte.
    unsafe { CStr::from_ptr(room.as_ptr()) }.to_str().expect("text").to_owned()
}

/// Factors that go different ways through the stages: ends, exact and nearly exact integers,
/// halves, culled ones.
const KINDS: [f32; 13] = [
    1.0,
    1.0,
    3.0,
    4.5,
    f32::from_bits(0x4000_0001), // just above 2
    f32::from_bits(0x40E0_0040), // 7 + 2^-15
    63.7,
    0.3,
    f32::from_bits(1), // the smallest denormal
    f32::INFINITY,
    17.25,
    f32::NAN,
    -1.0,
];

/// Miri takes a thousand times as long, so it gets fewer patches, none of them large.
const STRIDE: usize = if cfg!(miri) { 17 } else { 1 };

fn small_for_miri(factor: f32) -> f32 {
    if cfg!(miri) && factor > 5.0 { 5.0 } else { factor }
}

/// 96 patches for each of the 3 domains: each configuration three times, factors in strides.
pub(super) fn samples() -> Vec<Sample> {
    let mut samples = Vec::new();
    for (d, &domain) in Domain::ALL.iter().enumerate() {
        for n in (0..96).step_by(STRIDE) {
            let numbers = [d, n % 4, n / 4 % 4, n / 16 % 2];
            let [domain_number, partitioning, output, split] =
                numbers.map(|number| u32::try_from(number).expect("a small number"));
            let config = TessConfig { domain: domain_number, partitioning, output, split };
            let kind = |i: usize| KINDS[(n * 7 + i * (1 + n / 13)) % KINDS.len()];
            let factors: Vec<f32> = (0..domain.factors()).map(kind).map(small_for_miri).collect();
            let patch = Patch::new(model(&config), patch_factors(domain, &factors));
            samples.push(Sample { config, factors, patch });
        }
    }
    if cfg!(miri) {
        return samples;
    }
    let count = |f: fn(&Patch) -> bool| samples.iter().filter(|s| f(&s.patch)).count();
    assert!(count(|p| p.counts().points == 0) > 30, "too few culled patches");
    assert!(count(|p| p.counts().indices > 300) > 30, "too few large patches");
    samples
}

/// The model's configuration.
pub(super) fn model(config: &TessConfig) -> Config {
    let TessConfig { partitioning, output, split, .. } = *config;
    Config {
        partitioning: Partitioning::ALL[partitioning as usize],
        output: OutputPrimitive::ALL[output as usize],
        split: SplitOrder::ALL[split as usize],
    }
}

pub(super) fn patch_factors(domain: Domain, factors: &[f32]) -> PatchFactors {
    PatchFactors::from_slice(domain, factors).expect("as many factors as the domain has")
}

/// The model's values in C's structures, field by field and not by the conversions under test.
pub(super) fn point(point: DomainPoint) -> TessPoint {
    TessPoint { u: point.u.to_bits(), v: point.v.to_bits() }
}

pub(super) fn counts(counts: Counts) -> TessCounts {
    TessCounts { points: counts.points, primitives: counts.primitives, indices: counts.indices }
}

pub(super) fn context(context: FactorContext) -> TessContext {
    TessContext {
        parity: u32::from(context.parity == Parity::Odd),
        inv_floor: context.inv_floor,
        inv_ceil: context.inv_ceil,
        fraction: context.fraction,
        half_points: context.half_points,
        split: context.split_position,
        points: context.points,
    }
}
