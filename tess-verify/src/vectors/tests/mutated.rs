//! Vector files with random damage cause an error that names its place, or read back equal. They
//! never cause a panic, nor use more memory than a record needs.

use crate::vectors::{Listing, Record, Values, VectorError, VectorFile};
use proptest::prelude::*;
use std::fs::read_to_string;

/// The most memory that a file of a few kilobytes may use. A record of the largest patch needs 130
/// KB.
const MOST_BYTES: u64 = 2 << 20;

/// The first lines of a golden file, with a header that announces this number of records.
fn excerpt(name: &str, records: usize) -> String {
    let path = format!("{}/../golden/{name}", env!("CARGO_MANIFEST_DIR"));
    let text = read_to_string(path).expect("readable");
    let (header, rest) = text.split_once('\n').expect("a header");
    let kind = header.split(' ').nth(3).expect("a kind");
    let body: String = if name == "cases.txt" {
        rest.split_inclusive("\nend\n").take(records).collect()
    } else {
        rest.split_inclusive('\n').take(records + 1).collect()
    };
    format!("# tess-vectors 1 {kind} count={records} source=golden level=1\n{body}")
}

fn files() -> impl Strategy<Value = String> {
    let names = [
        "cases.txt",
        "patches.csv",
        "corners.csv",
        "sweep.csv",
        "uniform.csv",
        "place.csv",
        "factor.csv",
        "hlsl.csv",
    ];
    prop::sample::select(names.map(|name| excerpt(name, 4)).to_vec())
}

/// Damage to a file at a place, in 1/65536 of the file's length.
#[derive(Clone, Debug)]
enum Damage {
    Byte(u16, u8),
    Insert(u16, String),
    Remove(u16, u16),
    Cut(u16),
    RepeatLine(u16),
    SwapLines(u16, u16),
    Number(u16, String),
}

fn damage() -> impl Strategy<Value = Damage> {
    let inserted = prop_oneof![
        Just("\u{1b}[2J".to_owned()),
        Just("\u{202e}".to_owned()),
        Just("\0".to_owned()),
        Just("\r\n".to_owned()),
        Just("é".to_owned()),
        Just("x".repeat(10_000)),
        "[ ,=0-9a-f\n]{1,5}",
    ];
    let number = prop_oneof![
        Just("99999999999".to_owned()),
        Just("18446744073709551615".to_owned()),
        Just("-1".to_owned()),
        Just("+1".to_owned()),
        Just("4225".to_owned()),
        "[0-9]{1,3}",
    ];
    prop_oneof![
        (any::<u16>(), any::<u8>()).prop_map(|(at, byte)| Damage::Byte(at, byte)),
        (any::<u16>(), inserted).prop_map(|(at, text)| Damage::Insert(at, text)),
        (any::<u16>(), 1..200u16).prop_map(|(at, bytes)| Damage::Remove(at, bytes)),
        any::<u16>().prop_map(Damage::Cut),
        any::<u16>().prop_map(Damage::RepeatLine),
        (any::<u16>(), any::<u16>()).prop_map(|(a, b)| Damage::SwapLines(a, b)),
        (any::<u16>(), number).prop_map(|(at, number)| Damage::Number(at, number)),
    ]
}

/// An index below `length`.
fn scaled(at: u16, length: usize) -> usize {
    usize::from(at) * length / 65536
}

fn apply(bytes: &mut Vec<u8>, damage: &Damage) {
    let at = |place: u16| scaled(place, bytes.len());
    match damage {
        Damage::Byte(place, byte) => {
            let at = at(*place);
            bytes.splice(at..(at + 1).min(bytes.len()), [*byte]);
        }
        Damage::Insert(place, text) => {
            let at = at(*place);
            bytes.splice(at..at, text.bytes());
        }
        Damage::Remove(place, count) => {
            let at = at(*place);
            bytes.drain(at..(at + usize::from(*count)).min(bytes.len()));
        }
        Damage::Cut(place) => bytes.truncate(at(*place)),
        Damage::RepeatLine(place) => in_lines(bytes, |lines| {
            let at = scaled(*place, lines.len());
            lines.insert(at, lines[at].clone());
        }),
        Damage::SwapLines(a, b) => in_lines(bytes, |lines| {
            let [a, b] = [*a, *b].map(|place| scaled(place, lines.len()));
            lines.swap(a, b);
        }),
        Damage::Number(place, number) => {
            let from = at(*place);
            let digits = |byte: &u8| byte.is_ascii_digit();
            let Some(start) = bytes[from..].iter().position(digits).map(|n| n + from) else {
                return;
            };
            let length = bytes[start..].iter().take_while(|byte| digits(byte)).count();
            bytes.splice(start..start + length, number.bytes());
        }
    }
}

fn in_lines(bytes: &mut Vec<u8>, change: impl FnOnce(&mut Vec<Vec<u8>>)) {
    let mut lines: Vec<Vec<u8>> = bytes.split(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect();
    change(&mut lines);
    *bytes = lines.join(&b'\n');
}

/// A file's records as text, preceded by its header and column names.
fn read(bytes: &[u8]) -> Result<String, VectorError> {
    let mut file = VectorFile::new("damaged", bytes)?;
    let mut text = file.header().head();
    for record in file.by_ref() {
        match record? {
            Record::Listing(listing) => text += &Listing { line: 0, ..listing }.to_string(),
            Record::Row(row) => match row.values {
                Values::Patch(values) => text += &format!("{values}\n"),
                _ => text += &format!("{}\n", row.text),
            },
            Record::Coordinates(_) => panic!("the files have none"),
        }
    }
    Ok(text)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn damaged_files(file in files(), damages in prop::collection::vec(damage(), 1..4)) {
        let mut bytes = file.into_bytes();
        damages.iter().for_each(|damage| apply(&mut bytes, damage));
        let lines = bytes.split(|byte| *byte == b'\n').count() as u64 + 1;
        let mut result = None;
        let memory = allocation_counter::measure(|| result = Some(read(&bytes)));
        let most = MOST_BYTES + 4 * bytes.len() as u64;
        prop_assert!(memory.bytes_max <= most, "{} bytes at once", memory.bytes_max);
        match result.expect("it was read") {
            Ok(text) => {
                let again = read(text.as_bytes());
                prop_assert_eq!(again.as_ref(), Ok(&text), "what was read, written and read again");
            }
            Err(error) => {
                prop_assert!((1..=lines).contains(&error.line), "{error} of {lines} lines");
                let message = error.to_string();
                prop_assert!(message.len() < 800, "{} bytes: {message}", message.len());
                let unprintable = message.chars().find(|c| c.is_control() || *c == '\u{202e}');
                prop_assert_eq!(unprintable, None, "{:?}", message);
            }
        }
    }
}
