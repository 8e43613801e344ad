//! Tests that a campaign proves which cases its shards saw: a shard that saw others is refused,
//! whatever its file says of itself.

use crate::campaigns::{campaign, json, tess_in};
use crate::support::{Folder, directory, shell, tess_with_input};
use std::fs;
use tess_verify::generate::LEVEL_VERSION;

const SET: &str = "--level 3 --count 20 --domain isoline --partitioning pow2 --format listing";

/// A file without its header: a text for each record.
fn records(text: &str) -> Vec<String> {
    let (_, records) = text.split_once('\n').expect("a header");
    records.split_inclusive("\nend\n").map(str::to_owned).collect()
}

/// A file of these records under the header of another file, whose count is corrected.
fn file(header_of: &str, records: &[String]) -> String {
    let header = header_of.lines().next().expect("a header");
    let count = header.split(' ').find(|word| word.starts_with("count=")).expect("a count");
    header.replacen(count, &format!("count={}", records.len()), 1) + "\n" + &records.concat()
}

/// The header without the notes of how the cases were made.
fn without_notes(text: &str) -> String {
    let (header, records) = text.split_once('\n').expect("a header");
    let (header, _) = header.split_once(" level=").expect("notes");
    format!("{header}\n{records}")
}

/// The two shards of a set, as a right device answers them.
fn two_shards(folder: &Folder) -> [String; 2] {
    [1, 2].map(|shard| {
        let name = format!("asked{shard}.txt");
        tess_in(folder, &format!("gen {SET} --shard {shard}/2 -o {name}")).exits(0);
        fs::read_to_string(folder.join(name)).expect("asked cases")
    })
}

/// Checks both shards with these texts as a device's answers, and merges. Returns the exit codes.
fn checked(folder: &Folder, answers: [&str; 2], options: [&str; 2], merge: &str) -> [i32; 3] {
    let mut codes = [0; 3];
    for (at, (text, options)) in answers.into_iter().zip(options).enumerate() {
        let shard = at + 1;
        fs::write(folder.join(format!("d{shard}.txt")), text).expect("written");
        let words = format!("check d{shard}.txt {options} --report r{shard}.jsonl");
        codes[at] = tess_in(folder, &words).code.expect("it ends");
    }
    codes[2] = tess_in(folder, &format!("merge r1.jsonl r2.jsonl {merge}")).code.expect("it ends");
    codes
}

#[test]
fn right_answers_are_proved() {
    let folder = directory("right_answers_are_proved");
    let [one, two] = two_shards(&folder);
    assert_eq!(checked(&folder, [&one, &two], ["", ""], ""), [0, 0, 0], "by their notes");
    let asked = ["--cases asked1.txt", "--cases asked2.txt"];
    assert_eq!(checked(&folder, [&one, &two], asked, ""), [0, 0, 0], "and by --cases");
    // The order within a shard does not change which cases it has.
    let mut turned = records(&one);
    turned.reverse();
    fs::write(folder.join("asked1.txt"), file(&one, &turned)).expect("written");
    let turned = file(&one, &turned);
    assert_eq!(checked(&folder, [&turned, &two], asked, ""), [0, 0, 0], "in another order");
    assert_eq!(checked(&folder, [&turned, &two], ["", ""], ""), [1, 0, 1], "which was not asked");
}

/// One file that says nothing of itself, checked as both shards.
#[test]
fn one_file_is_not_two_shards() {
    let folder = directory("one_file_is_not_two_shards");
    let [one, two] = two_shards(&folder);
    let [plain, other] = [&one, &two].map(|text| without_notes(text));
    let shards = ["--shard 1/2", "--shard 2/2"];
    assert_eq!(checked(&folder, [&plain, &plain], shards, ""), [0, 0, 1], "nothing is known");
    tess_in(&folder, "merge r1.jsonl r2.jsonl --junit m.xml").exits(1).prints(
        "\nthe cases were not compared: the reports do not say how they were made; give the asked \
         ones with --cases\n2 of 2 shards ran once: 20 cases, 0 mismatches, ",
    );
    let xml = fs::read_to_string(folder.join("m.xml")).expect("JUnit");
    assert!(xml.contains("<failure message=\"the cases were not compared\""), "{xml}");
    let asked = "--cases asked1.txt asked2.txt";
    let run = tess_in(&folder, &format!("merge r1.jsonl r2.jsonl {asked}"));
    run.exits(2)
        .prints("\nthe shards saw 20 cases with the digest ")
        .prints("; asked are 20 cases");
    assert_eq!(checked(&folder, [&plain, &other], shards, asked), [0, 0, 0], "two files");
    assert_eq!(checked(&folder, [&plain, &other], shards, "--cases asked1.txt"), [0, 0, 2], "half");
    // With the notes, both are asked of the shard that they claim to be.
    let whole = file(&one.replacen(" shard=1/2", "", 1), &records(&one));
    assert_eq!(checked(&folder, [&whole, &whole], shards, ""), [0, 1, 1], "the notes tell");
}

/// The header of shard 2 over the records of shard 1, and a header with one of ten records: with
/// asked cases that are forged in the same way, only `tess merge` can tell.
#[test]
fn headers_do_not_prove_records() {
    let folder = directory("headers_do_not_prove_records");
    let [one, two] = two_shards(&folder);
    let swapped = file(&two, &records(&one));
    let first = file(&two, &records(&two)[..1]);
    for forged in [&swapped, &first] {
        assert_eq!(checked(&folder, [&one, forged], ["", ""], ""), [0, 1, 1], "{forged:.100}");
        fs::write(folder.join("forged.txt"), forged).expect("written");
        let options = ["", "--cases forged.txt"];
        assert_eq!(checked(&folder, [&one, forged], options, ""), [0, 0, 2], "{forged:.100}");
        let run = tess_in(&folder, "merge r1.jsonl r2.jsonl --junit m.xml");
        run.exits(2).prints("\nshard 2/2 saw ").prints("; asked are 10 cases with the digest ");
        let xml = fs::read_to_string(folder.join("m.xml")).expect("JUnit");
        assert!(
            xml.contains("<error message=\"other cases\" type=\"error\">shard 2/2 saw"),
            "{xml}"
        );
    }
    let run = tess_in(&folder, "check d2.txt --shard 2/2");
    run.exits(1).prints("record 9 is missing: case ");
    run.says("the notes in the file's first line say which cases were asked; give --cases if");
}

/// The whole kind: asked cases that lack one, have one twice, one of another shard, one with
/// another last bit, or that exchange one with the other shard.
#[test]
#[ignore = "slow: many runs of the program"]
fn every_other_set_is_refused() {
    let folder = directory("every_other_set_is_refused");
    let [one, two] = two_shards(&folder);
    let (own, others) = (records(&one), records(&two));
    let factor = own[3].lines().next().and_then(|line| line.split(' ').next_back());
    let factor = factor.expect("a factor").to_owned();
    let bits = u32::from_str_radix(&factor, 16).expect("hex") ^ 1;
    let right = |records: &[String]| {
        let asked: String = records
            .iter()
            .filter_map(|text| text.lines().next())
            .fold(String::new(), |all, case| {
                all + case.replace(&factor, &format!("{bits:08x}")).as_str() + "\n"
            });
        records_of(&folder, &asked)
    };
    let mut forged: Vec<(&str, Vec<String>, Vec<String>)> = Vec::new();
    let mut all = own.clone();
    all.remove(4);
    forged.push(("one is missing", all.clone(), others.clone()));
    all.push(own[5].clone());
    forged.push(("one is there twice, and another one not", all, others.clone()));
    let twice = [&own[..], &own[5..6]].concat();
    forged.push(("one is there twice", twice, others.clone()));
    let foreign = [&own[..9], &others[..1]].concat();
    forged.push(("one is of the other shard", foreign.clone(), others.clone()));
    let exchanged = [&own[9..], &others[1..]].concat();
    forged.push(("two are exchanged", foreign, exchanged));
    forged.push(("another bit", right(&own), others.clone()));
    for (what, first, second) in &forged {
        let texts = [file(&one, first), file(&two, second)];
        for (at, text) in texts.iter().enumerate() {
            fs::write(folder.join(format!("a{}.txt", at + 1)), text).expect("written");
        }
        let options = ["--cases a1.txt", "--cases a2.txt"];
        let codes = checked(&folder, [&texts[0], &texts[1]], options, "");
        assert_eq!(codes, [0, 0, 2], "{what}");
    }
}

/// The answers to some case lines as records.
fn records_of(folder: &Folder, asked: &str) -> Vec<String> {
    fs::write(folder.join("lines.txt"), asked).expect("written");
    let run = tess_in(folder, "patch --cases lines.txt");
    let text = run.exits(0).stdout.clone();
    records(text.trim_end_matches("# end\n"))
}

/// A digest is what its description says: the sum of the first halves of SHA-256.
#[test]
fn digests_are_sums_of_sha256() {
    let folder = directory("digests_are_sums_of_sha256");
    let made = "gen --level 3 --count 5 --format listing -o a.txt --report r.jsonl";
    tess_in(&folder, made).exits(0);
    let script = "grep ^case a.txt | while read -r line; do printf %s \"$line\" | sha256sum; done";
    let sums = shell(script, &folder).exits(0).stdout.clone();
    let halves = sums.lines().map(|line| u128::from_str_radix(&line[..32], 16).expect("hex"));
    let digest = halves.fold(0u128, u128::wrapping_add);
    let asked = &json(&folder.join("r.jsonl"))["asked"];
    let expected = serde_json::json!({ "cases": 5, "digest": format!("{digest:032x}") });
    assert_eq!(*asked, expected, "of {sums}");
}

/// Every command that writes reports counts its cases, and `tess merge` makes the same ones.
#[test]
#[ignore = "slow: many runs of the program"]
fn every_command_is_proved() {
    let folder = directory("every_command_is_proved");
    are_proved(
        &folder,
        &[
            "gen --level 3 --count 50 --seed 9 --output line --split center",
            "gen --level 3 --count 50 --coverage",
            "gen --level 3 --count 50 --stage factors",
            "verify --backend simd --backend core --random 20",
        ],
    );
}

#[test]
#[ignore = "slow: whole levels, and whole sets of rules"]
fn whole_sets_are_proved() {
    let folder = directory("whole_sets_are_proved");
    tess_in(&folder, "gen --rules --split ruler --format listing -o rules.txt").exits(0);
    are_proved(
        &folder,
        &[
            "gen --rules --count 20 --domain tri",
            "verify --backend simd --subject level-1 --subject transitions",
        ],
    );
    for command in ["verify --backend simd --rules d3d11", "check rules.txt --rules d3d11"] {
        tess_in(&folder, &format!("{command} --report r.jsonl")).exits(0);
        tess_in(&folder, "merge r.jsonl").exits(0).prints("\nasked: ");
    }
}

/// Runs each command in three shards, and merges their reports.
fn are_proved(folder: &Folder, commands: &[&str]) {
    for command in commands {
        for shard in 1..=3 {
            let words = format!("{command} --shard {shard}/3 --report r{shard}.jsonl");
            tess_in(folder, &words).exits(0);
        }
        let run = tess_in(folder, "merge r1.jsonl r2.jsonl r3.jsonl");
        run.exits(0).prints("\nasked: ").prints("\n3 of 3 shards ran once: ");
    }
}

/// The entries of a report that say what it saw are believed only if they agree.
#[test]
fn reports_of_other_cases() {
    let folder = directory("reports_of_other_cases");
    campaign(&folder);
    let read = |name: &str| fs::read_to_string(folder.join(name)).expect("a report");
    let reports = [read("r1.jsonl"), read("r2.jsonl"), read("r3.jsonl")];
    let digest =
        json(&folder.join("r2.jsonl"))["asked"]["digest"].as_str().expect("hex").to_owned();
    let last = if digest.ends_with('0') { "1" } else { "0" };
    let other = digest[..31].to_owned() + last;
    let [all, own] = [true, false];
    let level = format!("level=3 level-version={LEVEL_VERSION}");
    let versions = format!("have version 0; this program makes version {LEVEL_VERSION}; give");
    for (old, new, whole, code, says) in [
        (digest.as_str(), other.as_str(), own, 2, "shard 2/3 saw 17 cases with the digest "),
        (
            "\"cases\":17,\"digest\"",
            "\"cases\":16,\"digest\"",
            own,
            2,
            "saw 16 cases with the digest",
        ),
        ("seed=1", "seed=2", all, 2, "shard 1/3 saw 17 cases"),
        ("random=50", "random=51", all, 2, "shard 3/3 saw 16 cases with the digest "),
        (&level, "level=1 level-version=0", all, 1, &versions),
        ("level=3 ", "level=4 ", all, 1, "compared: `level=4` is unknown to this program; give"),
        ("random=50", "random=50 colour=red", all, 1, "`colour=red` is unknown to this program"),
    ] {
        let changed: Vec<String> = reports
            .iter()
            .enumerate()
            .map(|(at, text)| if whole || at == 1 { text.replace(old, new) } else { text.clone() })
            .collect();
        assert_ne!(changed[1], reports[1], "{old}");
        tess_with_input("merge -", &changed.concat()).exits(code).prints(says);
    }
}

/// The cases of levels of another version are not made by this program: the answers are compared
/// one by one, and `tess merge` says what it does not know.
#[test]
#[ignore = "slow: many runs of the program"]
fn levels_of_other_versions() {
    let folder = directory("levels_of_other_versions");
    let few = "--domain isoline --partitioning pow2 --format listing";
    tess_in(&folder, &format!("gen --level 1 {few} -o a.txt")).exits(0);
    let text = fs::read_to_string(folder.join("a.txt")).expect("listings");
    let version = format!("level-version={LEVEL_VERSION}");
    let makes = format!("this program makes version {LEVEL_VERSION}");
    for (old, new, says) in [
        (&*version, "level-version=0", &*format!("the levels have version 0; {makes}")),
        (&format!("{version} "), "", &format!("the levels have version 1; {makes}")),
        ("level=1", "level=7", "`level=7` is unknown to this program"),
        ("domain=isoline", "domain=circle", "`domain=circle` is unknown to this program"),
    ] {
        fs::write(folder.join("b.txt"), text.replacen(old, new, 1)).expect("written");
        let run = tess_in(&folder, "check b.txt --report r.jsonl");
        run.exits(0).says(format!("{says}, so the answers are not compared with what was asked"));
        let run = tess_in(&folder, "merge r.jsonl");
        run.exits(1).prints(format!("the cases were not compared: {says}; give the asked ones"));
        tess_in(&folder, "merge r.jsonl --cases a.txt").exits(0);
    }
}

/// What `--failures` writes is no longer the set that was asked.
#[test]
fn failing_records_are_checked_by_themselves() {
    let folder = directory("failing_records_are_checked_by_themselves");
    let made = "$TESS gen --level 3 --count 30 --domain isoline --format csv -o a.csv; \
                sed '7s/0$/x/; 7s/[1-9a-f]$/0/; 7s/x$/1/' a.csv > wrong.csv; \
                $TESS check wrong.csv --failures f.csv";
    shell(made, &folder).exits(1).prints("30 cases, 1 mismatches");
    tess_in(&folder, "check f.csv").exits(1).prints("1 cases, 1 mismatches").says_nothing();
}
