//! Rows of options have every pair that is allowed and none that is excluded.

use tess_testkit::pairs::{Choice, Options};

/// All pairs of choices, and whether each is excluded.
fn pairs(values: &[usize], excluded: impl Fn(Choice, Choice) -> bool) -> Vec<([Choice; 2], bool)> {
    let choices = |option: usize| (0..values[option]).map(move |value| (option, value));
    let all = (0..values.len()).flat_map(choices).collect::<Vec<_>>();
    let two = all.iter().flat_map(|&a| all.iter().map(move |&b| (a, b)));
    two.filter(|(a, b)| a.0 < b.0).map(|(a, b)| ([a, b], excluded(a, b))).collect()
}

fn has(row: &[usize], pair: [Choice; 2]) -> bool {
    pair.iter().all(|&(option, value)| row[option] == value)
}

/// The rows, after a check that they are right.
fn checked(values: &[usize], excluded: impl Fn(Choice, Choice) -> bool + Copy) -> Vec<Vec<usize>> {
    let options = Options::new(values, excluded);
    let (rows, refused) = (options.rows(), options.refused());
    for (row, option) in rows.iter().flat_map(|row| (0..values.len()).map(move |i| (row, i))) {
        assert_eq!(row.len(), values.len(), "{row:?}");
        assert!(row[option] < values[option], "{row:?}: option {option}");
    }
    let all = pairs(values, excluded);
    for &(pair, is_excluded) in &all {
        let in_rows = rows.iter().any(|row| has(row, pair));
        assert_eq!(in_rows, !is_excluded, "{pair:?} in the rows of {values:?}");
        let faults = |row: &[usize]| all.iter().filter(|(p, ex)| *ex && has(row, *p)).count();
        let own: Vec<_> = refused.iter().filter(|(other, _)| *other == pair).collect();
        assert_eq!(own.len(), usize::from(is_excluded), "{pair:?} in the refused of {values:?}");
        assert!(own.iter().all(|(_, row)| has(row, pair) && faults(row) == 1), "{own:?}");
    }
    rows
}

#[test]
fn every_pair_is_in_a_row() {
    for values in [&[2, 2][..], &[3, 1, 2], &[4, 4, 2, 2, 3, 2, 5], &[2; 12], &[3; 10]] {
        checked(values, |_, _| false);
    }
}

/// An option alone or together with values that exclude each other, one of them far from the other.
#[test]
fn excluded_pairs_are_in_no_row_but_their_own() {
    let values = [3, 4, 2, 2, 5];
    checked(&values, |a, b| (a, b) == ((0, 1), (4, 3)));
    checked(&values, |a, b| a == (0, 1) && b.0 == 4 && b.1 != 2);
    checked(&values, |a, b| (a.1 + b.1) % 3 == 2 && b.0 == 4);
}

/// The best known arrays of these sizes have 4, 9 and 14 rows. Ten options with 3 values have 59049
/// rows in all.
#[test]
fn rows_are_few() {
    for (values, most) in [(&[2, 2, 2][..], 5), (&[3, 3, 3, 3], 12), (&[3; 10], 22)] {
        let rows = checked(values, |_, _| false).len();
        assert!(rows <= most, "{rows} rows for {values:?}");
    }
}

/// Three rows have every pair of one choice, and choices of two options occur together in one of
/// them.
#[test]
fn seldom_choices_are_in_few_rows() {
    let options = Options::new(&[3, 3, 3, 2], |_, _| false).seldom(&[(0, 1), (3, 1)]);
    let rows = options.rows();
    let all = pairs(&[3, 3, 3, 2], |_, _| false);
    assert!(all.iter().all(|(pair, _)| rows.iter().any(|row| has(row, *pair))), "{rows:?}");
    for (option, most) in [(0, 4), (3, 6)] {
        let seldom = rows.iter().filter(|row| row[option] == 1).count();
        assert!(seldom <= most, "option {option}: {seldom} of {rows:?}");
    }
}

/// Both values of option 1 exclude one of the others.
#[test]
#[should_panic(expected = "no row can have [(0, 0), (2, 0)]: exclude it")]
fn pairs_that_no_row_can_have_are_named() {
    let excluded = |a, b| matches!((a, b), ((0, 0), (1, 0)) | ((1, 1), (2, 0)));
    Options::new(&[2, 2, 2], excluded).rows();
}
