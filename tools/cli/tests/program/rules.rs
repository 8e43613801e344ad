//! `--rules` of `tess gen`, `check` and `verify`.

use crate::support::{tess, tess_with_input};

/// The rules of Vulkan that the model breaks on three lines, and those that it does not.
#[test]
fn a_capture_is_judged() {
    let lines = "case tri integer triangle_cw ruler 40800000 40a00000 40400000 40a00000\n\
                 case isoline fractional_odd line ruler 3f800000 40400001\n";
    let listings = tess_with_input("patch --cases -", lines).stdout;
    let run = tess_with_input("check - --rules vulkan", &listings);
    assert_eq!(run.code, Some(1), "{}{}", run.stdout, run.stderr);
    let example = "  line 0 has 3 segments, its level 3.0000002 asks for 5\n  \
                   case isoline fractional_odd line ruler 3f800000 40400001\n";
    assert!(run.stdout.contains(example), "{}", run.stdout);
    assert!(run.stdout.contains("22.3 Tessellator Spacing"), "{}", run.stdout);
    assert!(run.stdout.contains("2 patches, vulkan: "), "{}", run.stdout);
    let run = tess_with_input("check - --rules d3d11", &listings);
    assert_eq!(run.code, Some(0), "{}{}", run.stdout, run.stderr);
    assert!(run.stdout.contains(" 0 broken, "), "{}", run.stdout);
    let equal = "patches beside the model: 2 equal, 0 in another order, 0 different\n";
    assert!(run.stdout.ends_with(equal), "{}", run.stdout);
    let faulty = listings.replacen("\n00000 04000\n", "\n00000 04001\n", 1);
    assert_ne!(faulty, listings, "a fault is planted");
    let run = tess_with_input("check - --rules d3d11", &faulty);
    assert_eq!(run.code, Some(1), "{}{}", run.stdout, run.stderr);
    assert!(run.stdout.contains("symmetric    broken"), "{}", run.stdout);
    let different = "patches beside the model: 1 equal, 0 in another order, 1 different\n";
    assert!(run.stdout.ends_with(different), "{}", run.stdout);
}

/// One command says that a device conforms to Vulkan and has another order than Direct3D's.
#[test]
fn another_order_is_told_from_other_output() {
    let line = "case tri integer triangle_cw ruler 40000000 40000000 40000000 40000000\n";
    let listing = tess_with_input("patch --cases -", line).stdout;
    let reordered = listing.replacen("\n0 1 6\n", "\n1 6 0\n", 1);
    assert_ne!(reordered, listing, "a triangle begins elsewhere");
    let run = tess_with_input("check - --rules vulkan", &reordered);
    assert_eq!(run.code, Some(0), "{}{}", run.stdout, run.stderr);
    let expected = "patches beside the model: 0 equal, 1 in another order, 0 different\n";
    assert!(run.stdout.ends_with(expected), "{}", run.stdout);
}

#[test]
fn rules_are_for_listings() {
    let rows = tess("gen --rules --domain isoline --count 3 --split ruler");
    assert_eq!(rows.code, Some(0), "{}", rows.stderr);
    let header = rows.stdout.lines().next().unwrap_or_default();
    assert!(header.contains(" level=rules level-version=2 seed=1 random=3 "), "{header}");
    let run = tess_with_input("check - --rules opengl", &rows.stdout);
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{}", run.stderr);
    assert!(run.stderr.contains("--rules judges listings"), "{}", run.stderr);
    for words in
        ["check - --rules vulkan --order any", "gen --rules --level 2", "check - --rules gl"]
    {
        assert_eq!(tess_with_input(words, &rows.stdout).code, Some(2), "{words}");
    }
}

/// Rules ask no backend, so how one runs is refused with them.
#[test]
fn rules_have_no_backend() {
    let listing = tess("patch tri --outer 2,2,2 --inner 2").stdout;
    for words in ["--cpu-level baseline", "--index-type u16", "--index-type u32"] {
        let run = tess_with_input(&format!("check - --rules vulkan {words}"), &listing);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{words}: {}", run.stderr);
        for name in ["--rules", words.split(' ').next().unwrap_or(words)] {
            assert!(run.stderr.contains(name), "{words}: {name} is not in {}", run.stderr);
        }
    }
}

#[test]
fn backends_are_judged() {
    let run = tess("verify --backend simd --rules d3d11");
    assert_eq!(run.code, Some(0), "{}{}", run.stdout, run.stderr);
    assert!(
        run.stdout.ends_with("d3d11: 11 rules held, 0 broken, 0 not exercised\n"),
        "{}",
        run.stdout
    );
}
