//! The reader of vector files, on any bytes.

use crate::fault_is_planted;
use tess_verify::Case;
use tess_verify::vectors::{Coordinates, Listing, Record, VectorFile};

/// Reads a file to its end. The reader never panics. It returns as many records as the header
/// announces, at least one if the header gives no number, or an error that names a line of the
/// file. The contents stay the same when they are written and read again. Errors: a description of
/// the broken promise.
pub fn check(data: &[u8]) -> Result<(), String> {
    let lines = data.split(|&byte| byte == b'\n').count() as u64 + 1;
    let mut file = match VectorFile::new("fuzz", data) {
        Ok(file) => file,
        Err(error) => return names_a_line(&error.to_string(), lines),
    };
    let announced = file.header().count;
    let mut records = 0_u64;
    for record in file.by_ref() {
        match record {
            Err(error) => return names_a_line(&error.to_string(), lines),
            Ok(Record::Listing(listing)) => listing_survives(&listing)?,
            Ok(Record::Coordinates(coordinates)) => coordinates_survive(&coordinates)?,
            Ok(record) => record.case().map_or(Ok(()), |case| case_survives(&case))?,
        }
        records += 1;
    }
    let last = data.trim_ascii_end();
    let marks_its_end = last.ends_with(b"# end");
    let is_whole = announced.map_or(records > 0 && marks_its_end, |count| records == count);
    if is_whole && !fault_is_planted() {
        Ok(())
    } else {
        Err(format!("{records} records without an error, but the header says {announced:?}"))
    }
}

/// An error reads `fuzz:LINE: ...`, with a line of the file or the one after its end. It is short,
/// and contains nothing that a terminal would obey.
fn names_a_line(message: &str, lines: u64) -> Result<(), String> {
    if message.len() > 1000 || message.chars().any(char::is_control) {
        return Err(format!("an error of {} bytes: {message:?}", message.len()));
    }
    let line = message.strip_prefix("fuzz:").and_then(|rest| rest.split(':').next());
    match line.and_then(|line| line.trim().parse::<u64>().ok()) {
        Some(line) if line <= lines => Ok(()),
        _ => Err(format!("an error that names no line of a file of {lines}: {message}")),
    }
}

fn case_survives(case: &Case) -> Result<(), String> {
    match case.to_string().parse::<Case>() {
        Ok(again) if again == *case => Ok(()),
        other => Err(format!("\n{case}\nis read back as {other:?}")),
    }
}

fn coordinates_survive(coordinates: &Coordinates) -> Result<(), String> {
    let text = coordinates.to_string();
    survives(
        &coordinates.case,
        &text,
        |again| matches!(again, Record::Coordinates(same) if same.to_string() == text),
    )
}

fn listing_survives(listing: &Listing) -> Result<(), String> {
    survives(&listing.case, &listing.to_string(), |again| match again {
        Record::Listing(same) => same.case == listing.case && same.output == listing.output,
        _ => false,
    })
}

/// Checks that a record of this text is read back as the same one, and so is its case.
fn survives(case: &Case, text: &str, is_same: impl Fn(&Record) -> bool) -> Result<(), String> {
    case_survives(case)?;
    let file = format!("# tess-vectors 1 kind=listings source=fuzz\n{text}# end\n");
    let mut again = VectorFile::new("again", file.as_bytes()).map_err(|e| e.to_string())?;
    match again.next() {
        Some(Ok(record)) if is_same(&record) => Ok(()),
        other => Err(format!("\n{text}\nis read back as {other:?}")),
    }
}
