//! Every possible fault of a vector file is an error that names its place and cause.

mod mutated;

use super::*;

const PATCHES: &str = "\
# tess-vectors 1 kind=patches count=2 source=test level=1
domain,partitioning,output,split,factors_f32_hex,points,indices,points_fnv1a64,indices_fnv1a64
isoline,integer,point,ruler,3f800000 3f800000,2,2,ab89bb86730d9e2c,08cd4c29d1e47d34
isoline,integer,point,ruler,40000000 40000000,6,6,784cb2b8c713b205,ac6313d97a44af34
";

const LISTING: &str = "\
# tess-vectors 1 kind=listings count=1 source=test
case tri integer triangle_cw ruler 3f800000 3f800000 3f800000 3f800000
points 3
00000 10000
00000 00000
10000 00000
indices 3
0 1 2
end
";

fn read(text: &str) -> Result<Vec<Record>, VectorError> {
    VectorFile::new("f", text.as_bytes())?.collect()
}

/// The error of `text` after `from`, which must occur in it, is replaced by `to`.
fn error(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "the example has {from:?}");
    match read(&text.replacen(from, to, 1)) {
        Ok(records) => panic!("{from:?} -> {to:?} was read as {records:?}"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn well_formed_files_are_read() {
    let records = read(PATCHES).expect("patches");
    let [_, Record::Row(row)] = &records[..] else { panic!("two patches: {records:?}") };
    let Values::Patch(values) = row.values else { panic!("a patch: {row:?}") };
    assert_eq!((row.line, values.output.points), (4, 6), "line and points");
    assert!(row.text.ends_with("784cb2b8c713b205,ac6313d97a44af34"), "its text: {}", row.text);
    let [Record::Listing(listing)] = &read(LISTING).expect("listing")[..] else { panic!("one") };
    let body = LISTING.split_once('\n').map_or("", |(_, body)| body);
    assert_eq!((listing.line, listing.to_string().as_str()), (2, body), "the same text");
    assert_eq!(read(&LISTING.replace('\n', "\r\n")).map(|r| r.len()), Ok(1), "other line ends");
}

#[test]
fn headers_round_trip() {
    let file = VectorFile::new("f", PATCHES.as_bytes()).expect("valid");
    assert_eq!(Some(file.header().to_string().as_str()), PATCHES.lines().next(), "first line");
}

#[test]
fn wrong_headers() {
    let cases = [
        ("# tess-vectors 1", "# vectors 1", "f:1: header: a vector file starts with"),
        ("vectors 1", "vectors1", "f:1: header: a vector file starts with"),
        ("vectors 1", "vectors 2", "f:1: header: format version `2` is unknown, expected 1"),
        ("kind=patches", "kind=patch", "f:1: kind: unknown kind `patch`, expected one of: list"),
        ("kind=patches ", "", "f:1: kind: missing in the header"),
        (" count=2", "", "f:5: count: the header has no count, so the last line must be `# end`"),
        ("count=2", "count=two", "f:1: count: `two` is not a number"),
        ("count=2", "count=-2", "f:1: count: `-2` is not a number"),
        ("count=2", "count=+2", "f:1: count: `+2` is not a number"),
        ("count=2", "count=0", "f:1: count: is 0"),
        ("source=test", "count=2 source=test", "f:1: header: `count` is given twice"),
        ("source=test", "", "f:1: source: missing in the header"),
        ("source=test", "source", "f:1: header: `source` is not KEY=VALUE"),
        ("domain,part", "part,domain", "f:2: columns: the column names must be `domain,part"),
    ];
    for (from, to, expected) in cases {
        let error = error(PATCHES, from, to);
        assert!(error.starts_with(expected), "{from} -> {to}: {error}");
    }
}

#[test]
fn empty_truncated_and_surplus_files() {
    let read = |text: &str| read(text).expect_err(text).to_string();
    assert!(read("").starts_with("f:1: header: a vector file starts with"), "{}", read(""));
    let lines: Vec<_> = PATCHES.lines().collect();
    assert_eq!(read(lines[0]), "f:2: columns: the file ends here; it is truncated");
    assert_eq!(
        read(&lines[..3].join("\n")),
        "f:4: count: the header announces 2, but the file ends after 1; it is truncated"
    );
    assert_eq!(
        read(&lines[..2].join("\n")),
        "f:3: count: the header announces 2, but the file ends after 0; it is truncated"
    );
    let surplus = read(&format!("{PATCHES}{}", lines[2]));
    assert!(surplus.starts_with("f:5: count: the header announces 2, but"), "{surplus}");
    let blank = read(&format!("{PATCHES}\n"));
    assert!(blank.starts_with("f:5: count: the header announces 2, but"), "{blank}");
}

/// A file without records is accepted only on request.
#[test]
fn files_without_records() {
    let columns = Kind::Patches.columns().expect("a CSV kind");
    for text in [
        "# tess-vectors 1 kind=listings count=0 source=a\n".to_owned(),
        "# tess-vectors 1 kind=listings source=a\n# end\n".to_owned(),
        format!("# tess-vectors 1 kind=patches count=0 source=a\n{columns}\n"),
    ] {
        let error = read(&text).expect_err(&text).to_string();
        assert!(error.ends_with("a file without records shows nothing"), "{error}");
        let mut file = VectorFile::open("f", text.as_bytes(), Emptiness::Accepted).expect(&text);
        assert!(file.next().is_none(), "no record in {text}");
        let more = format!("{text}case");
        let mut file = VectorFile::open("f", more.as_bytes(), Emptiness::Accepted).expect(&more);
        assert!(file.next().is_some_and(|record| record.is_err()), "a record is surplus: {more}");
    }
    let cut = "# tess-vectors 1 kind=listings source=a\n";
    let mut file = VectorFile::open("f", cut.as_bytes(), Emptiness::Accepted).expect("a header");
    assert!(file.next().is_some_and(|record| record.is_err()), "truncated is not empty");
}

/// A listing that is cut after any line, or within its last line, is truncated.
#[test]
fn listings_cut_anywhere() {
    let lines: Vec<_> = LISTING.lines().collect();
    for cut in 1..lines.len() {
        let error = read(&lines[..cut].join("\n")).expect_err("cut").to_string();
        assert!(error.contains("truncated"), "cut after line {cut}: {error}");
    }
    let error = error(LISTING, "\nend\n", "\nen");
    let of = "case tri integer triangle_cw ruler 3f800000 3f800000 3f800000 3f800000";
    let expected =
        format!("f:9: end: a listing ends with `end`, not `en` (record 1, from line 2: {of})");
    assert_eq!(error, expected);
}

#[test]
fn wrong_fields() {
    let cases = [
        ("isoline,", "line,", "f:3: domain: unknown domain `line`"),
        (",integer,", ",Integer,", "f:3: partitioning: unknown partitioning `Integer`"),
        (",point,", ",points,", "f:3: output: unknown output primitive `points`"),
        (",ruler,", ",,", "f:3: split: unknown split order ``"),
        ("3f800000 3f800000", "3f800000", "f:3: factors_f32_hex: expected 2 (density detail), f"),
        ("3f800000 3f", "3f800000 3f800000 3f", "f:3: factors_f32_hex: expected 2 (density deta"),
        ("3f800000 3f8", "3f80000 3f8", "f:3: factors_f32_hex: `3f80000` is not the 8 hex digits"),
        ("3f800000 3f8", "+f800000 3f8", "f:3: factors_f32_hex: `+f800000` is not the 8 hex"),
        (",2,2,", ",2,x,", "f:3: indices: `x` is not a number in range"),
        (",2,2,", ",-2,2,", "f:3: points: `-2` is not a number in range"),
        ("ab89bb86730d9e2c", "ab89bb86730d9e2", "f:3: points_fnv1a64: `ab89bb86730d9e2` is not"),
        ("08cd4c29d1e47d34", "08cd4c29d1e47d3g", "f:3: indices_fnv1a64: `08cd4c29d1e47d3g` is"),
        (",08cd4c29d1e47d34", "", "f:3: indices_fnv1a64: a row has 9 fields"),
        ("08cd4c29d1e47d34", "08cd4c29d1e47d34,", "f:3: indices_fnv1a64: a row has 9 fields"),
    ];
    for (from, to, expected) in cases {
        let error = error(PATCHES, from, to);
        assert!(error.starts_with(expected), "{from} -> {to}: {error}");
    }
}

#[test]
fn wrong_listings() {
    let cases = [
        ("case tri", "cas tri", "f:2: case: a case is: case DOMAIN"),
        ("case tri", "case quad", "f:2: factors: quad patches have 6 factors"),
        ("points 3", "points", "f:3: points: expected `points COUNT`, not `points`"),
        ("points 3", "points three", "f:3: points: expected `points COUNT`"),
        ("points 3", "points 24577", "f:3: points: 24577 is too many: a patch has at most 24576"),
        ("points 3", "points 99999999999", "f:3: points: 99999999999 is too many"),
        (
            "indices 3",
            "indices 24577",
            "f:7: indices: 24577 is too many: a patch has at most 24576",
        ),
        ("points 3", "points 4", "f:7: points: `indices 3` is not a point"),
        ("points 3", "points 2", "f:6: indices: expected `indices COUNT`, not `10000 00000`"),
        ("00000 10000", "00000", "f:4: points: `00000` is not a point"),
        ("00000 10000", "00000 1000g", "f:4: points: `00000 1000g` is not a point"),
        ("00000 10000", "00000 123456789", "f:4: points: `00000 123456789` is not a point"),
        ("indices 3", "indices 4", "f:7: indices: 4 is not a multiple of 3"),
        ("indices 3", "indices 6", "f:9: indices: `end` is not a primitive"),
        ("0 1 2", "0 1", "f:8: indices: `0 1` is not a primitive: 3 decimal indices"),
        ("0 1 2", "0 1 2 3", "f:8: indices: `0 1 2 3` is not a primitive"),
        ("0 1 2", "0 1 +2", "f:8: indices: `0 1 +2` is not a primitive"),
        ("0 1 2", "0 1 -2", "f:8: indices: `0 1 -2` is not a primitive"),
        ("0 1 2", "0 1 :", "f:8: indices: `0 1 :` is not a primitive"),
        ("0 1 2", "0 1 /", "f:8: indices: `0 1 /` is not a primitive"),
    ];
    for (from, to, expected) in cases {
        let error = error(LISTING, from, to);
        assert!(error.starts_with(expected), "{from} -> {to}: {error}");
    }
}

/// Rows of the exhaustive and chained kinds must name existing sequences.
#[test]
fn numbers_out_of_range() {
    let chain = "domain,partitioning,output,row,cases,chain_fnv1a64\nquad,pow2,line,1,64,";
    let cases = [
        ("sweep", "row", chain.replace("line,1,", "line,65,")),
        ("sweep", "row", chain.replace("line,1,", "line,0,")),
        ("sweep", "cases", chain.replace("64,", "63,")),
        ("uniform", "row", chain.replace("1,64,", "66,1,")),
        ("uniform", "cases", chain.replace("1,64,", "65,100,")),
        (
            "locations",
            "factor_bucket",
            "split,parity,factor_bucket,contexts_fnv1a64,locations_fnv1a64,locations\n\
             ruler,odd,64,0000000000000000,0000000000000000,"
                .into(),
        ),
        (
            "factors",
            "exponent",
            "partitioning,exponent,outer_fnv1a64,inside_fnv1a64\npow2,128,0000000000000000,".into(),
        ),
    ];
    for (kind, field, rows) in cases {
        let text = format!("# tess-vectors 1 kind={kind} count=1 source=test\n{rows}");
        let error = read(&format!("{text}{:016}\n", 0)).expect_err(&text).to_string();
        assert!(error.starts_with(&format!("f:3: {field}: ")), "{kind}: {error}");
    }
}

#[test]
fn bytes_that_are_no_text() {
    let bytes = [LISTING.as_bytes(), b"\xFF\xFE"].concat();
    let mut file = VectorFile::new("f", &bytes[..]).expect("header");
    assert!(file.next().is_some_and(|record| record.is_ok()), "the listing");
    let error = file.next().and_then(Result::err).expect("an error").to_string();
    assert!(error.starts_with("f:10: line: not UTF-8 text"), "{error}");
    assert!(file.next().is_none(), "ended");
}

/// Whatever a line holds, errors shorten and escape foreign text.
#[test]
fn lines_that_are_too_long_or_not_text() {
    let long = "x".repeat(50_000_000);
    let error_of = |from: &str, to: &str| error(LISTING, from, to);
    assert_eq!(
        error_of("case tri", &long),
        "f:2: line: longer than the 4096 bytes that a line may have"
    );
    let fits = "x".repeat(4000);
    let shown = error_of("00000 10000", &fits);
    assert_eq!(
        shown.split(" (record 1, ").next().unwrap_or_default(),
        format!(
            "f:4: points: `{}...` (4000 bytes) is not a point: u and v as 5 to 8 hex digits each, where 10000 is 1",
            &fits[..60]
        )
    );
    assert_eq!(
        error_of("case tri", "case \u{1b}[2Jtri"),
        "f:2: line: has the control character U+001B"
    );
    let hidden = error_of("integer", "\u{202e}integer");
    assert!(hidden.contains("`\\u{202e}integer`"), "{hidden}");
}

/// A file without an end causes an error after its first line.
#[test]
fn endless_files() {
    let endless = std::io::BufReader::new(std::io::repeat(0));
    let error = VectorFile::new("zero", endless).expect_err("no header").to_string();
    assert!(error.starts_with("zero:1: line: longer than the 4096 bytes"), "{error}");
}
