//! Compares the cases that the shards of a campaign saw with those that were asked.

use super::campaign::Campaign;
use crate::campaign::cases::CaseSum;
use crate::campaign::report::Report;
use crate::failure::Failure;
use crate::input;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The outcome of the comparison.
#[derive(Debug)]
pub(super) enum Compared {
    /// The shards saw every asked case, each as often as it was asked.
    Equal(CaseSum),
    /// They saw others: a line for each fault.
    Other(Vec<String>),
    /// It is not known which cases were asked, or seen, and why.
    Unknown(String),
}

/// The sum of the cases in the files of `--cases`; `None` without the option.
///
/// # Errors
/// A file that cannot be read, or has no cases.
pub(super) fn given(files: &[PathBuf]) -> Result<Option<CaseSum>, Failure> {
    let mut sum = CaseSum::default();
    for file in files {
        for case in input::cases(file)? {
            sum.add(&case.map_err(Failure::bad_input)?);
        }
    }
    Ok((!files.is_empty()).then_some(sum))
}

/// Compares the cases of all shards that ended with the `given` ones, or with those that this
/// program makes as the first report says.
pub(super) fn compare(campaign: &Campaign, given: Option<CaseSum>) -> Compared {
    let mut seen = BTreeMap::new();
    for (number, shard) in &campaign.shards {
        let Ok(found) = shard.proof() else { continue };
        let Some(asked) = found.report.asked else {
            return Compared::Unknown(format!("{} does not say which it saw", found.place));
        };
        seen.insert(*number, (asked, &*found.place));
    }
    match given {
        Some(given) => compare_whole(campaign, &seen, given),
        None => compare_shards(campaign, &seen),
    }
}

/// The cases of each shard that ended, and the place of its report.
type Seen<'a> = BTreeMap<u64, (CaseSum, &'a str)>;

/// Compares the sum of all shards, once they are all there. How the given cases were cut into
/// shards is not known.
fn compare_whole(campaign: &Campaign, seen: &Seen<'_>, given: CaseSum) -> Compared {
    let mut sum = CaseSum::default();
    seen.values().for_each(|(own, _)| sum.join(*own));
    if sum == given || seen.len() < campaign.shards.len() {
        return Compared::Equal(given);
    }
    Compared::Other(vec![format!("the shards saw {sum}; asked are {given}")])
}

/// Compares shard by shard, which also compares the sum.
fn compare_shards(campaign: &Campaign, seen: &Seen<'_>) -> Compared {
    let Report { shards, set, .. } = &campaign.sample;
    let set = set.as_ref().ok_or_else(|| "the reports do not say how they were made".to_owned());
    let asked = match set.and_then(|set| set.sums(*shards)) {
        Ok(asked) => asked,
        Err(why) => return Compared::Unknown(why),
    };
    let mut whole = CaseSum::default();
    let mut other = Vec::new();
    for (number, asked) in (1..).zip(asked) {
        whole.join(asked);
        if let Some((own, place)) = seen.get(&number).filter(|(own, _)| *own != asked) {
            other.push(format!("shard {number}/{shards} saw {own}; asked are {asked} ({place})"));
        }
    }
    if other.is_empty() { Compared::Equal(whole) } else { Compared::Other(other) }
}
