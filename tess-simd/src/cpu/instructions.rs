//! The instructions of each level, in three forms: as the machine is asked for them, as the
//! functions that use intrinsics are given them, and as `multiversion` is told them.

use super::level::Level;

/// Whether this machine has all of these.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
macro_rules! all_of {
    ($($instructions:tt)*) => {
        true $(&& std::is_x86_feature_detected!($instructions))*
    };
}

/// Whether this machine can run a level: it has the target's instructions and those that
/// `multiversion` asks for beside them. On a processor that lacks one of these it would run what
/// was compiled for the baseline.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
pub(super) fn has(level: Level) -> bool {
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

/// Whether this machine can run a level: it cannot be asked.
#[cfg(not(all(feature = "std", target_arch = "x86_64")))]
pub(super) const fn has(level: Level) -> bool {
    matches!(level, Level::Baseline)
}

/// Defines functions that may call the intrinsics of AVX-512. Only functions of that level may call
/// them.
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
/// Only for this project's crates; one that uses it depends on `multiversion`.
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
        #[inline]
        pub(crate) fn $name $(<$($type: $bound),*>)? (level: $crate::Level, $($arg: $arg_type),*)
            $(-> $result)?
        {
            #[cfg(target_arch = "x86_64")]
            #[multiversion::multiversion(targets("x86_64+avx2+bmi1+bmi2+lzcnt+popcnt"))]
            fn avx2 $(<$($type: $bound),*>)? ($($arg: $arg_type),*) $(-> $result)? {
                multiversion::target::match_target! {
                    "x86_64+avx2+bmi1+bmi2+lzcnt+popcnt" => $kernel($($arg),*),
                    // For processors without the level's instructions. It never runs, so it need
                    // not be an instance of the kernel.
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

            // Apart, so that choosing a level needs no registers and no stack.
            #[inline(never)]
            fn baseline $(<$($type: $bound),*>)? ($($arg: $arg_type),*) $(-> $result)? {
                $kernel($($arg),*)
            }

            match level {
                #[cfg(target_arch = "x86_64")]
                $crate::Level::Avx2 => avx2($($arg),*),
                #[cfg(target_arch = "x86_64")]
                $crate::Level::Avx512 => avx512($($arg),*),
                // Elsewhere it is the only level that is available.
                _ => baseline($($arg),*),
            }
        }
    };
}
