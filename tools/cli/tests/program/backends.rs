//! Tests of the program's backends: the simd and gpu backends reproduce the recorded results
//! exactly, and a missing backend is reported.

#[cfg(all(feature = "gpu", target_os = "linux"))]
use crate::support::tess_with_environment;
use crate::support::{tess, tess_with_input};
use tess_simd::Level;

const GOLDEN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../golden");

fn equals(file: &str, backend: &str) {
    let run = tess(&format!("check {GOLDEN}/{file} --backend {backend}"));
    run.exits(0);
    assert!(run.stdout.ends_with(" cases, 0 mismatches\n"), "{file}: {}", run.stdout);
}

#[test]
#[ignore = "slow: every recorded result"]
fn simd_equals_every_recorded_result() {
    let files = ["cases.txt", "patches.csv", "corners.csv", "hlsl.csv", "sweep.csv", "uniform.csv"];
    for file in files.into_iter().chain(["place.csv", "factor.csv"]) {
        equals(file, "simd");
    }
}

/// A CPU level that this machine lacks ends with exit code 3; no other level is used in its place.
#[test]
#[ignore = "slow: every recorded result"]
fn simd_at_every_cpu_level() {
    for level in Level::ALL {
        let backend = format!("simd --cpu-level {level}");
        for file in ["cases.txt", "patches.csv", "corners.csv", "sweep.csv"] {
            if level.is_available() {
                equals(file, &backend);
            } else {
                tess(&format!("check {GOLDEN}/{file} --backend {backend}")).exits(3);
            }
        }
    }
    let no_such_level = format!("check {GOLDEN}/cases.txt --backend simd --cpu-level avx1024");
    tess(&no_such_level).exits(2);
}

#[cfg(feature = "gpu")]
#[test]
#[ignore = "slow: every recorded result on a software driver"]
fn gpu_equals_recorded_patches() {
    let files = ["cases.txt", "patches.csv", "corners.csv", "hlsl.csv", "sweep.csv", "uniform.csv"];
    for file in files {
        equals(file, "gpu");
    }
}

/// Compares 16-bit indices patch by patch; each patch numbers its points from 0.
#[test]
#[ignore = "slow: every recorded result"]
fn narrow_indices_equal_recorded_patches() {
    for backend in narrow() {
        for file in ["cases.txt", "patches.csv"] {
            equals(file, &format!("{backend} --index-type u16"));
        }
    }
}

/// The backends that have 16-bit indices.
fn narrow() -> &'static [&'static str] {
    if cfg!(feature = "gpu") { &["simd", "gpu"] } else { &["simd"] }
}

/// A recorded index that is too high by one is reported.
#[test]
#[ignore = "slow: every recorded case on a software driver"]
fn narrow_indices_that_differ() {
    let recorded = std::fs::read_to_string(format!("{GOLDEN}/cases.txt")).expect("recorded");
    let changed = recorded.replacen("\n3 4 12\n", "\n3 4 13\n", 1);
    assert_ne!(recorded, changed, "a fault is planted in the file");
    for backend in narrow() {
        let run =
            tess_with_input(&format!("check - --backend {backend} --index-type u16"), &changed);
        run.exits(1);
        assert!(run.stdout.ends_with(" cases, 1 mismatches\n"), "{backend}: {}", run.stdout);
        let again = format!("--backend {backend} --index-type u16\n");
        run.prints(&again);
    }
}

/// The model, with which a device's listings are compared, cannot choose the size of its indices.
#[test]
fn narrow_indices_where_there_are_none() {
    let patch = tess("patch quad --outer 3,4,5,6 --inner 4,7").stdout;
    for (words, input, why) in [
        ("check - --index-type u16", &patch, "--backend simd or gpu"),
        ("check - --backend simd --index-type u8", &patch, "[possible values: u16, u32]"),
    ] {
        tess_with_input(words, input).exits(2).prints_nothing().says(why);
    }
}

/// A shard without units succeeds and says so.
#[test]
fn a_shard_without_units() {
    let subjects = "--subject transitions --subject interiors";
    let run = tess(&format!("verify --backend simd {subjects} --shard 10/40"));
    run.exits(0);
    let line = "tess: nothing to compare in shard 10/40: interiors has fewer than 10 units\n";
    assert_eq!(run.stderr, line, "{}", run.stdout);
    tess(&format!("verify --backend simd {subjects} --shard 3/40")).exits(0).says_nothing();
}

/// 561 million locations and 336 million factors: one or two minutes on a software driver.
#[cfg(feature = "gpu")]
#[test]
#[ignore = "slow: every recorded result on a software driver"]
fn gpu_equals_recorded_stages() {
    for file in ["place.csv", "factor.csv"] {
        equals(file, "gpu");
    }
}

/// Without a driver there is no adapter: exit code 3 and advice on what to do next, never a pass.
#[cfg(all(feature = "gpu", target_os = "linux"))]
#[test]
fn no_adapter_is_reported() {
    let none = [("VK_DRIVER_FILES", "/nonexistent"), ("VK_ICD_FILENAMES", "/nonexistent")];
    let run = tess_with_environment(&format!("check {GOLDEN}/cases.txt --backend gpu"), &none);
    run.exits(3);
    assert!(run.stdout.is_empty() && !run.stderr.is_empty(), "a message: {}", run.stderr);
}

#[cfg(all(feature = "gles", target_os = "linux"))]
#[test]
fn opengl_equals_recorded_cases() {
    let gl = [("WGPU_BACKEND", "gl")];
    let run = tess_with_environment(&format!("check {GOLDEN}/cases.txt --backend gpu"), &gl);
    run.exits(0);
    assert!(run.stdout.ends_with(" cases, 0 mismatches\n"), "{}", run.stdout);
    let bench = "bench --backend gpu --workload uniform-1 --samples 1 --working-set cache";
    tess_with_environment(bench, &gl).prints(" (gl, "); // the device
}

/// Compares generated vectors in a backend, without a file.
#[test]
fn verify_compares_what_it_says() {
    let run = tess("verify --backend simd --subject transitions --subject interiors");
    run.exits(0);
    let words = |name: &str| {
        let line = run.stdout.lines().find(|line| line.starts_with(name));
        line.map(|line| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>())
    };
    let row = |name: &str, n: &str| Some([name, "simd", n, "0"].map(str::to_owned).to_vec());
    assert_eq!(words("transitions"), row("transitions", "24576"), "{}", run.stdout);
    assert_eq!(words("interiors"), row("interiors", "8256"), "{}", run.stdout);
    factors_are_equal("simd");
}

/// Random patches of each of 96 configurations.
fn random_patches_are_equal(backend: &str, patches: usize) {
    let run = tess(&format!("verify --backend {backend} --random {patches}"));
    run.exits(0);
    let row: Vec<_> =
        run.stdout.lines().nth(1).into_iter().flat_map(str::split_whitespace).collect();
    let all = (96 * patches).to_string();
    assert_eq!(row, ["random", backend, &all, "0"], "{}", run.stdout);
}

#[test]
#[ignore = "slow: random patches of all 96 configurations"]
fn simd_random_patches_are_equal() {
    random_patches_are_equal("simd", 20_000);
}

/// Seven seconds of processor time on a software driver.
#[cfg(feature = "gpu")]
#[test]
#[ignore = "slow: random patches of all 96 configurations"]
fn gpu_random_patches_are_equal() {
    random_patches_are_equal("gpu", 5000);
}

/// Options that exclude each other: exit code 2 and the reason.
#[test]
fn verify_refuses_what_does_not_go_together() {
    for (words, why) in [
        ("--random 0", "0 is not in 1.."),
        ("--random 10 --exhaustive", "cannot be used with"),
        ("--random 10 --subject level-1", "cannot be used with"),
        ("--subject random", "invalid value 'random'"),
        ("--seed 7", "--random <N>"),
    ] {
        tess(&format!("verify --backend simd {words}")).exits(2).says(why);
    }
}

/// One part in 16384 of all binary32 numbers in all partitionings, including zero, NaNs and
/// negative numbers.
fn factors_are_equal(backend: &str) {
    for part in [1, 3000, 8191, 8193, 16384] {
        let words = format!("verify --backend {backend} --subject factors --shard {part}/16384");
        tess(&words).exits(0).prints(" 1048576 "); // one unit was compared
    }
}

#[cfg(feature = "gpu")]
#[test]
fn gpu_factors_are_equal() {
    factors_are_equal("gpu");
}
