//! Levels: which the machine has, and the instance that runs at each.

use tess_level::{Level, LevelUnavailableError, at_each_level};

#[test]
fn names_and_order() {
    assert_eq!(Level::ALL.map(Level::name), ["baseline", "avx2", "avx512"], "ascending");
    assert!(Level::ALL.is_sorted(), "the derived order is that of the list");
    assert_eq!(Level::Avx2.to_string(), "avx2", "as by `name`");
}

#[test]
fn the_most_capable_level_is_detected() {
    assert!(Level::Baseline.is_available(), "on every machine");
    for level in Level::ALL {
        assert_eq!(level.is_available(), level <= Level::detect(), "{level}");
        let expected =
            if level <= Level::detect() { Ok(()) } else { Err(LevelUnavailableError(level)) };
        assert_eq!(level.require(), expected, "{level}");
    }
    let error = LevelUnavailableError(Level::Avx512).to_string();
    assert_eq!(error, "this machine cannot run the CPU level avx512", "with the level's name");
}

/// The CPU features that the levels need, in one list.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[test]
fn the_machine_is_asked_for_every_instruction() {
    use std::is_x86_feature_detected as has;
    let avx2 = [has!("avx2"), has!("bmi1"), has!("bmi2"), has!("lzcnt"), has!("popcnt")];
    let avx512 = [
        [has!("avx512f"), has!("avx512bw"), has!("avx512cd"), has!("avx512dq"), has!("avx512vl")],
        [has!("avx512bitalg"), has!("avx512ifma"), has!("avx512vbmi"), has!("gfni"), has!("vaes")],
    ];
    let others =
        [has!("avx512vbmi2"), has!("avx512vnni"), has!("avx512vpopcntdq"), has!("vpclmulqdq")];
    let has_avx2 = avx2 == [true; 5];
    let has_avx512 = has_avx2 && avx512 == [[true; 5]; 2] && others == [true; 4];
    let available = [Level::Avx2, Level::Avx512].map(Level::is_available);
    assert_eq!(available, [has_avx2, has_avx512], "{avx2:?} {avx512:?} {others:?}");
}

/// Adds to each number, and returns how.
#[inline(always)]
fn add(numbers: &mut [u32], more: u32) -> &'static str {
    for number in numbers {
        *number += more;
    }
    "by vectors that the compiler chose"
}

#[cfg(target_arch = "x86_64")]
tess_level::with_avx512! {
    fn add_with_intrinsics(numbers: &mut [u32], more: u32) -> &'static str {
        add(numbers, more);
        "by intrinsics"
    }
}

at_each_level! {
    /// [`add`] at a level.
    fn add_at(numbers: &mut [u32], more: u32) -> &'static str = add, avx512 = add_with_intrinsics;
}

at_each_level! {
    /// [`sum`] at a level, for any iterator.
    fn sum_at<I: Numbers>(numbers: I) -> u32 = sum;
}

trait Numbers: Iterator<Item = u32> {}
impl<I: Iterator<Item = u32>> Numbers for I {}

#[inline(always)]
fn sum<I: Numbers>(numbers: I) -> u32 {
    numbers.sum()
}

#[test]
fn every_level_runs_the_function_or_its_own() {
    for level in Level::ALL.into_iter().filter(|level| level.is_available()) {
        let mut numbers = [1, 2, 3];
        let by = add_at(level, &mut numbers, 10);
        assert_eq!(numbers, [11, 12, 13], "{level}");
        assert_eq!(by == "by intrinsics", level == Level::Avx512, "{level}");
        assert_eq!(sum_at(level, numbers.into_iter()), 36, "{level}");
    }
}
