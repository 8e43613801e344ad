//! The instructions of each level, in three forms: for detection at run time (`has`), for functions
//! that use intrinsics (`with_avx512`), and for `multiversion` (`at_each_level`).

use crate::level::{Level, LevelUnavailableError};

impl Level {
    /// Whether this machine can run the level. Without the feature `std` the machine cannot be
    /// asked, and only the baseline is available.
    #[must_use]
    pub fn is_available(self) -> bool {
        has(self)
    }

    /// Checks that this machine can run the level.
    ///
    /// # Errors
    /// [`LevelUnavailableError`] if this machine, or this build, cannot run it.
    pub fn require(self) -> Result<(), LevelUnavailableError> {
        if self.is_available() { Ok(()) } else { Err(LevelUnavailableError(self)) }
    }

    /// The most capable level that this machine can run.
    #[must_use]
    pub fn detect() -> Self {
        Self::ALL.into_iter().rev().find(|level| level.is_available()).unwrap_or(Self::Baseline)
    }
}

/// Whether this machine has all of these instruction sets.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
macro_rules! all_of {
    ($($instructions:tt)*) => {
        true $(&& std::is_x86_feature_detected!($instructions))*
    };
}

/// Whether this machine can run a level: it has the instructions of the target, and the others that
/// `multiversion` checks for. Without one of them, `multiversion` would choose the baseline's code.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
fn has(level: Level) -> bool {
    match level {
        Level::Baseline => true,
        Level::Avx2 => all_of!("avx2" "bmi1" "bmi2" "lzcnt" "popcnt"),
        Level::Avx512 => {
            has(Level::Avx2)
                && all_of!("avx512f" "avx512bw" "avx512cd" "avx512dq" "avx512vl")
                && all_of!("gfni" "vaes" "vpclmulqdq" "avx512bitalg" "avx512ifma")
                && all_of!("avx512vbmi" "avx512vbmi2" "avx512vnni" "avx512vpopcntdq")
        }
    }
}

/// Whether this machine can run a level. The machine cannot be asked, so only the baseline.
#[cfg(not(all(feature = "std", target_arch = "x86_64")))]
const fn has(level: Level) -> bool {
    matches!(level, Level::Baseline)
}

/// Defines functions that may call the intrinsics of AVX-512. Only functions of that level may call
/// these functions.
///
/// Only for this project's crates, and only on x86-64.
#[macro_export]
macro_rules! with_avx512 {
    ($($function:item)*) => {
        $(
            #[inline]
            #[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
            #[target_feature(enable = "avx512f,avx512bw,avx512cd,avx512dq,avx512vl")]
            $function
        )*
    };
}

/// Defines a function that runs `$kernel` at a level, with one compiled instance per level. The
/// caller has checked that the level is available ([`Level::is_available`] asks for the same
/// instructions). With `avx512 = $special`, the level AVX-512 runs `$special` instead, a function
/// of [`with_avx512!`](crate::with_avx512). With `baseline = $compiled`, the baseline runs
/// `$compiled` instead.
///
/// The kernel and what it calls must be inlined into the instance, for example by
/// `#[inline(always)]`: otherwise they have the instructions of the baseline.
///
/// Only for this project's crates. A crate that uses it depends on `multiversion`.
#[macro_export]
macro_rules! at_each_level {
    (@last $args:tt $kernel:path) => {
        $kernel $args
    };
    (@last $args:tt $kernel:path, $special:path) => {
        $special $args
    };
    (
        $(#[$doc:meta])*
        fn $name:ident $(<$($type:ident: $bound:ident),*>)? ($($arg:ident: $arg_type:ty),* $(,)?)
            $(-> $result:ty)? = $kernel:path
            $(, avx512 = $special:path)? $(, baseline = $compiled:path)?;
    ) => {
        $(#[$doc])*
        #[inline]
        pub(crate) fn $name $(<$($type: $bound),*>)? (level: $crate::Level, $($arg: $arg_type),*)
            $(-> $result)?
        {
            #[cfg(target_arch = "x86_64")]
            #[multiversion::multiversion(targets("x86_64+avx2+bmi1+bmi2+lzcnt+popcnt"))]
            fn avx2 $(<$($type: $bound),*>)? ($($arg: $arg_type),*) $(-> $result)? {
                multiversion::target::match_target! {
                    "x86_64+avx2+bmi1+bmi2+lzcnt+popcnt" => $kernel($($arg),*),
                    // For processors without the level's instructions. This arm never runs, so it
                    // does not need an instance of the kernel of its own.
                    _ => self::$name($crate::Level::Baseline, $($arg),*),
                }
            }

            #[cfg(target_arch = "x86_64")]
            #[multiversion::multiversion(targets(
                "x86_64+avx2+bmi1+bmi2+lzcnt+popcnt+avx512f+avx512bw+avx512cd+avx512dq+avx512vl"
            ))]
            fn avx512 $(<$($type: $bound),*>)? ($($arg: $arg_type),*) $(-> $result)? {
                multiversion::target::match_target! {
                    "x86_64+avx2+bmi1+bmi2+lzcnt+popcnt+avx512f+avx512bw+avx512cd+avx512dq+avx512vl"
                        => $crate::at_each_level!(@last ($($arg),*) $kernel $(, $special)?),
                    _ => self::$name($crate::Level::Baseline, $($arg),*),
                }
            }

            // Not inlined, so that choosing a level needs no registers and no stack.
            #[inline(never)]
            fn baseline $(<$($type: $bound),*>)? ($($arg: $arg_type),*) $(-> $result)? {
                $crate::at_each_level!(@last ($($arg),*) $kernel $(, $compiled)?)
            }

            match level {
                #[cfg(target_arch = "x86_64")]
                $crate::Level::Avx2 => avx2($($arg),*),
                #[cfg(target_arch = "x86_64")]
                $crate::Level::Avx512 => avx512($($arg),*),
                // On other architectures the baseline is the only level that is available.
                _ => baseline($($arg),*),
            }
        }
    };
}
