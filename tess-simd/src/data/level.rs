//! CPU levels: which instructions the kernels are compiled for.

use core::fmt;

/// A set of CPU instructions that the kernels are compiled for. All levels give the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Level {
    /// What the crate was compiled for; always available.
    Baseline,
    /// AVX2 on x86-64.
    Avx2,
    /// AVX-512 on x86-64, as processors have it from Ice Lake and Zen 4 on.
    Avx512,
}

impl Level {
    /// Every level, from the least to the most capable.
    pub const ALL: [Self; 3] = [Self::Baseline, Self::Avx2, Self::Avx512];

    /// The name that `Display` gives: `baseline`, `avx2` or `avx512`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    /// Whether this machine can run the level. Without the feature `std` the machine cannot be
    /// asked, and only the baseline is available.
    #[must_use]
    pub fn is_available(self) -> bool {
        match self {
            Self::Baseline => true,
            Self::Avx2 => has_avx2(),
            Self::Avx512 => has_avx512(),
        }
    }

    /// Nothing if this machine can run the level.
    ///
    /// # Errors
    /// [`LevelUnavailable`] if it, or this build, cannot.
    pub fn require(self) -> Result<(), LevelUnavailable> {
        if self.is_available() { Ok(()) } else { Err(LevelUnavailable(self)) }
    }

    /// The most capable level that this machine can run.
    #[must_use]
    pub fn detect() -> Self {
        Self::ALL.into_iter().rev().find(|level| level.is_available()).unwrap_or(Self::Baseline)
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// This machine, or this build, cannot run a CPU level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LevelUnavailable(pub Level);

impl fmt::Display for LevelUnavailable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "this machine cannot run the CPU level {}", self.0)
    }
}

impl core::error::Error for LevelUnavailable {}

// The instructions of each level stand below, and for kernels of its own in tess-surface's `dispatch.rs`: as the machine is asked for them, as
// `multiversion` is told them, and as the functions that use intrinsics are.

#[cfg(all(feature = "std", target_arch = "x86_64"))]
fn has_avx2() -> bool {
    std::is_x86_feature_detected!("avx2")
        && std::is_x86_feature_detected!("bmi1")
        && std::is_x86_feature_detected!("bmi2")
        && std::is_x86_feature_detected!("lzcnt")
        && std::is_x86_feature_detected!("popcnt")
}

/// Asks for the target's instructions and for those that `multiversion` asks for beside them: on a
/// processor that lacks one of these it would run what was compiled for the baseline.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
fn has_avx512() -> bool {
    has_avx2()
        && std::is_x86_feature_detected!("avx512f")
        && std::is_x86_feature_detected!("avx512bw")
        && std::is_x86_feature_detected!("avx512cd")
        && std::is_x86_feature_detected!("avx512dq")
        && std::is_x86_feature_detected!("avx512vl")
        && std::is_x86_feature_detected!("avx512bitalg")
        && std::is_x86_feature_detected!("avx512ifma")
        && std::is_x86_feature_detected!("avx512vbmi")
        && std::is_x86_feature_detected!("avx512vbmi2")
        && std::is_x86_feature_detected!("avx512vnni")
        && std::is_x86_feature_detected!("avx512vpopcntdq")
        && std::is_x86_feature_detected!("gfni")
        && std::is_x86_feature_detected!("vaes")
        && std::is_x86_feature_detected!("vpclmulqdq")
}

#[cfg(not(all(feature = "std", target_arch = "x86_64")))]
const fn has_avx2() -> bool {
    false
}

#[cfg(not(all(feature = "std", target_arch = "x86_64")))]
const fn has_avx512() -> bool {
    false
}

/// Defines functions that may call the intrinsics of AVX-512. Only functions of that level may call them.
#[cfg(target_arch = "x86_64")]
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
#[cfg(target_arch = "x86_64")]
pub(crate) use with_avx512;

/// Defines a function that runs `$kernel` at a level: one instance for each, which the level's
/// availability was checked for ([`Level::is_available`] asks for the same instructions). With
/// `avx512 = $special`, that level runs `$special` instead, a function of `with_avx512`.
///
/// For this project's crates alone; one that uses it depends on `multiversion`.
#[doc(hidden)]
#[macro_export]
macro_rules! at_each_level {
    (@avx512 $args:tt $kernel:path) => {
        $kernel $args
    };
    (@avx512 $args:tt $kernel:path, $special:path) => {
        $special $args
    };
    (
        $(#[$doc:meta])*
        fn $name:ident $(<$($type:ident: $bound:ident),*>)? ($($arg:ident: $arg_type:ty),* $(,)?)
            $(-> $result:ty)? = $kernel:path $(, avx512 = $special:path)?;
    ) => {
        $(#[$doc])*
        pub(crate) fn $name $(<$($type: $bound),*>)? (level: $crate::Level, $($arg: $arg_type),*)
            $(-> $result)?
        {
            #[cfg(target_arch = "x86_64")]
            #[multiversion::multiversion(targets("x86_64+avx2+bmi1+bmi2+lzcnt+popcnt"))]
            fn avx2 $(<$($type: $bound),*>)? ($($arg: $arg_type),*) $(-> $result)? {
                multiversion::target::match_target! {
                    "x86_64+avx2+bmi1+bmi2+lzcnt+popcnt" => $kernel($($arg),*),
                    // For processors without the level's instructions. It never runs, so it need not be
                    // an instance of the kernel.
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
                        => $crate::at_each_level!(@avx512 ($($arg),*) $kernel $(, $special)?),
                    _ => self::$name($crate::Level::Baseline, $($arg),*),
                }
            }

            match level {
                #[cfg(target_arch = "x86_64")]
                $crate::Level::Avx2 => avx2($($arg),*),
                #[cfg(target_arch = "x86_64")]
                $crate::Level::Avx512 => avx512($($arg),*),
                // Elsewhere it is the only level that is available.
                _ => $kernel($($arg),*),
            }
        }
    };
}
