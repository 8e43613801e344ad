//! Tests of `--rules` of `tess gen`, `check` and `verify`.

use crate::campaigns::{json, tess_in};
use crate::support::{directory, tess, tess_with_input};
use std::fs::write;

/// The rules of Vulkan that the model breaks on three lines, and the rules that it does not.
#[test]
fn a_capture_is_judged() {
    let listings = tess_with_input("patch --cases -", &LINES.concat()).stdout;
    let run = tess_with_input("check - --rules vulkan", &listings);
    run.exits(1);
    let example = "  line 0 has 3 segments, its level 3.0000002 asks for 5\n  \
                   case isoline fractional_odd line ruler 3f800000 40400001\n";
    run.prints(example).prints("22.3 Tessellator Spacing").prints("2 patches, vulkan: ");
    let run = tess_with_input("check - --rules d3d11", &listings);
    run.exits(0)
        .prints(" 0 broken, ")
        .prints(" held as far as asked ")
        .prints("\n  not asked: quad; ");
    let equal = "patches beside the model: 2 equal, 0 in another order, 0 different\n";
    assert!(run.stdout.ends_with(equal), "{}", run.stdout);
    let faulty = listings.replacen("\n00000 04000\n", "\n00000 04001\n", 1);
    assert_ne!(faulty, listings, "a fault is planted");
    let run = tess_with_input("check - --rules d3d11", &faulty);
    run.exits(1).prints("symmetric     broken");
    let different = "patches beside the model: 1 equal, 0 in another order, 1 different\n";
    assert!(run.stdout.ends_with(different), "{}", run.stdout);
}

const LINES: [&str; 2] = [
    "case tri integer triangle_cw ruler 40800000 40a00000 40400000 40a00000\n",
    "case isoline fractional_odd line ruler 3f800000 40400001\n",
];

/// Answers that use other levels than were asked for: the rule names the level.
#[test]
fn levels_that_are_ignored_or_exchanged_are_named() {
    let quad = |inner: &str| {
        format!("case quad integer triangle_cw ruler{} {inner}\n", " 40800000".repeat(4))
    };
    let lines = |levels: &str| format!("case isoline integer line ruler {levels}\n");
    let rows = "inner level 2 is 7 and asks for 7 rows; there are 2";
    let columns = "inner level 1 is 2 and asks for 2 columns; there are 7";
    let isolines = "the patch has 8 isolines, its level 3 asks for 3";
    for (asked, answered, says) in [
        (quad("40000000 40e00000"), quad("3f800000 3f800000"), rows),
        (quad("40000000 40e00000"), quad("40e00000 40000000"), columns),
        (lines("40400000 41000000"), lines("41000000 40400000"), isolines),
    ] {
        let listing = tess_with_input("patch --cases -", &answered).stdout;
        let device = listing.replacen(&answered, &asked, 1);
        assert_ne!(device, listing, "another case is answered");
        for standard in ["vulkan", "opengl", "d3d11"] {
            let run = tess_with_input(&format!("check - --rules {standard}"), &device);
            run.exits(1).prints(format!("\n  {says}\n  {asked}"));
        }
    }
}

/// A baseline states how often a rule is broken and which answers are missing; nothing else passes.
#[test]
fn deviations_have_terms() {
    let folder = directory("deviations_have_terms");
    let file = |name: &str, text: &str| write(folder.join(name), text).expect("written");
    file("asked.txt", &LINES.concat());
    file("whole.txt", &tess_with_input("patch --cases -", &LINES.concat()).stdout);
    file("part.txt", &tess_with_input("patch --cases -", LINES[1]).stdout);
    let run = |device: &str, known: &str| {
        file("known.txt", known);
        let words = format!("check {device} --rules vulkan --cases asked.txt --known known.txt");
        tess_in(&folder, &(words + " --report r.jsonl"))
    };
    let broken = run("whole.txt", "# none\n");
    broken.exits(1);
    let rules =
        broken.stdout.lines().filter(|line| line.contains(" broken ") && !line.contains(','));
    let rules = rules.map(|line| line.split_whitespace().collect::<Vec<_>>());
    let baseline: String = rules
        .map(|row| format!("rule {} | {} | ada | 9999-12-31 | as the model\n", row[0], row[2]))
        .collect();
    let missing = format!("{} | missing | ada | 9999-12-31 | too large\n", LINES[0].trim());
    let both = format!("{baseline}{missing}");
    let line = "rule cover | 1 | ada | 9999-12-31 | unused";
    for (device, known, code, says) in [
        ("whole.txt", &baseline, 0, ""),
        ("part.txt", &both, 0, ""),
        ("part.txt", &baseline, 1, ""),
        ("whole.txt", &both, 1, "2: is unused"),
        (
            "whole.txt",
            &(baseline.clone() + line),
            1,
            ": is unused: nothing differs this way: rule cover",
        ),
        ("whole.txt", &baseline.replacen("| 1 |", "| 2 |", 1), 1, "1: expects `2`, not `1`: rule"),
        ("whole.txt", &baseline.replace("9999", "2020"), 1, "known.txt:1: expired on 2020-12-31"),
        ("whole.txt", &line.replace("cover", "covre"), 2, "known.txt:1: rule: "),
        ("whole.txt", &line.replace("12-31", "13-31"), 2, "known.txt:1: until: "),
        ("whole.txt", &line.replace("| 1 |", "| so |"), 2, "known.txt:1: expected: "),
        ("whole.txt", &line.replace("ada", ""), 2, "known.txt:1: terms: "),
        ("whole.txt", &"rule cover".to_owned(), 2, "known.txt:1: terms: "),
        ("whole.txt", &format!("{line}\n\n{line}"), 2, "known.txt:3: subject: is also on line 1"),
    ] {
        let run = run(device, known);
        run.exits(code);
        assert!(
            run.stderr.contains(says) && run.stderr.is_empty() == says.is_empty(),
            "{}",
            run.stderr
        );
        if code < 2 {
            let report = json(&folder.join("r.jsonl"));
            assert_eq!(report["mismatches"] == 0, code == 0, "{report}");
        }
    }
    let run = run("part.txt", &baseline);
    let missing = format!("record 1 is missing: {}", LINES[0]);
    run.prints(&missing).prints("\n2 cases, 1 mismatches of answers\n");
}

/// One command tells that a device conforms to Vulkan and that its order differs from Direct3D's.
#[test]
fn another_order_is_told_from_other_output() {
    let line = "case tri integer triangle_cw ruler 40000000 40000000 40000000 40000000\n";
    let listing = tess_with_input("patch --cases -", line).stdout;
    let reordered = listing.replacen("\n0 1 6\n", "\n1 6 0\n", 1);
    assert_ne!(reordered, listing, "a triangle begins elsewhere");
    let run = tess_with_input("check - --rules vulkan", &reordered);
    run.exits(0);
    let expected = "patches beside the model: 0 equal, 1 in another order, 0 different\n";
    assert!(run.stdout.ends_with(expected), "{}", run.stdout);
}

#[test]
fn rules_are_for_listings() {
    let rows = tess("gen --rules --domain isoline --count 3 --split ruler");
    rows.exits(0);
    let header = rows.stdout.lines().next().unwrap_or_default();
    assert!(header.contains(" level=rules level-version=5 seed=1 random=3 "), "{header}");
    let run = tess_with_input("check - --rules opengl", &rows.stdout);
    run.exits(2).prints_nothing().says("--rules judges listings");
    for words in
        ["check - --rules vulkan --order any", "gen --rules --level 2", "check - --rules gl"]
    {
        tess_with_input(words, &rows.stdout).exits(2);
    }
}

/// Rules do not use a backend, so options about how one runs are refused with them.
#[test]
fn rules_have_no_backend() {
    let listing = tess("patch tri --outer 2,2,2 --inner 2").stdout;
    for words in ["--cpu-level baseline", "--index-type u16", "--index-type u32"] {
        let run = tess_with_input(&format!("check - --rules vulkan {words}"), &listing);
        run.exits(2).prints_nothing();
        for name in ["--rules", words.split(' ').next().unwrap_or(words)] {
            run.says(name);
        }
    }
}

#[test]
#[ignore = "slow: every case of level 1 by each backend"]
fn backends_are_judged() {
    let run = tess("verify --backend simd --rules d3d11");
    run.exits(0);
    assert!(
        run.stdout
            .ends_with("d3d11: 15 rules held, 0 held as far as asked, 0 broken, 0 not exercised\n"),
        "{}",
        run.stdout
    );
}
