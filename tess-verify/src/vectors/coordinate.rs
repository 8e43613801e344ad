//! Conversion of a device's coordinates to 16.16 numbers.

use tess_core::fixed_point::ONE;

/// The 16.16 number that equals the binary32 with these bits; `None` if that is not one in 0..=1.
#[must_use]
pub const fn fixed(bits: u32) -> Option<u32> {
    let exponent = bits >> 23;
    let mantissa = bits & 0x7F_FFFF | 1 << 23;
    match exponent {
        0 if bits == 0 => Some(0),
        // 2^-16 has exponent 111, 1 has 127.
        111..=127 => {
            let below = 134 - exponent;
            let number = mantissa >> below;
            if number << below == mantissa && number <= ONE { Some(number) } else { None }
        }
        _ => None,
    }
}

/// The 16.16 number in 0..=1 that a decimal text stands for; `None` if there is none.
///
/// The text must be the number itself, or the number rounded to the text's last digit. Its nearest
/// binary32 must be the number's. So `0.333328247` is 21845/65536, but `0.999999999` and `1e-50`
/// are not numbers: with as many digits, 1 and 0 are written differently.
#[must_use]
pub(crate) fn from_decimal(text: &str) -> Option<u32> {
    let number = fixed(text.parse::<f32>().ok()?.to_bits())?;
    let Decimal { digits, decimals } = Decimal::parse(text)?;
    // |digits / 10^decimals - number / 2^16| is at most half of 10^-decimals. Both products are < 2^80.
    let unit = 10_u128.checked_pow(decimals)?;
    let is_rounded = (digits << 16).abs_diff(u128::from(number) * unit) <= 1 << 15;
    is_rounded.then_some(number)
}

/// A decimal number of at most 17 digits: `digits` / 10^`decimals`.
struct Decimal {
    digits: u128,
    decimals: u32,
}

impl Decimal {
    /// The most decimals. A multiple of 2^-16 has at most 16, so a text with more nonzero ones is
    /// not one.
    const MOST: u32 = 16;

    /// Parses what Rust reads as a finite number, without a minus sign.
    fn parse(text: &str) -> Option<Self> {
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
            None => (text, 0),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let all = format!("{}{fraction}", whole.strip_prefix('+').unwrap_or(whole));
        let mut digits = all.trim_start_matches('0');
        let mut decimals = i64::try_from(fraction.len()).ok()? - i64::from(exponent);
        while decimals > i64::from(Self::MOST)
            && let Some(shorter) = digits.strip_suffix('0')
        {
            (digits, decimals) = (shorter, decimals - 1);
        }
        if digits.is_empty() {
            return Some(Self { digits: 0, decimals: 0 });
        }
        let zeros = usize::try_from(-decimals.min(0)).ok()?;
        let few = digits.len() + zeros <= 17 && decimals <= i64::from(Self::MOST);
        let digits = few.then(|| format!("{digits}{}", "0".repeat(zeros)))?.parse().ok()?;
        Some(Self { digits, decimals: u32::try_from(decimals.max(0)).ok()? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::DomainPoint;
    use tess_core::fixed_point::{HALF, coordinate_to_f32};

    #[test]
    fn every_coordinate_is_its_own_number() {
        for number in 0..=ONE {
            let float = coordinate_to_f32(DomainPoint::from_bits(number, 0).u);
            assert_eq!(fixed(float.to_bits()), Some(number));
        }
    }

    /// With 9 significant digits, as `%.9g` writes them; with 12 and more decimals; and in the
    /// shortest form that reads back as the binary32.
    #[test]
    fn every_coordinate_in_decimal() {
        for number in (0..=ONE).step_by(7).chain([1, ONE - 1, ONE]) {
            let float = coordinate_to_f32(DomainPoint::from_bits(number, 0).u);
            let texts = [
                format!("{float:.8e}"),
                format!("{float:.12}"),
                format!("{float:.16}"),
                format!("{float:.30}"),
                format!("{float}"),
                format!("+{float:.13}"),
            ];
            for text in texts {
                assert_eq!(from_decimal(&text), Some(number), "{text}");
            }
        }
    }

    /// Texts that become a coordinate only by rounding to binary32, and texts that are not
    /// coordinates in any form.
    #[test]
    fn decimals_that_are_no_coordinates() {
        for text in [
            "1e-50",
            "0.999999999",
            "1.00000001",
            "0.00000001",
            "0.3333282471999",
            "1e-6",
            "-0",
            "-1",
            "nan",
            "inf",
            "1.5",
            "0.1",
            "",
            ".",
            "+",
            "1e",
            "1e400",
            "1e99999999999",
            "0x1",
            "0.5e-",
        ] {
            assert_eq!(from_decimal(text), None, "{text}");
        }
        let long = format!("0.{}1", "0".repeat(4000));
        assert_eq!(from_decimal(&long), None, "not 0");
        for (text, number) in [("1", ONE), ("1.", ONE), (".5", HALF), ("5e-1", HALF), ("0e-50", 0)]
        {
            assert_eq!(from_decimal(text), Some(number), "{text}");
        }
        assert_eq!(from_decimal("00000000000000000000000.1e1"), Some(ONE), "an exponent");
    }

    #[test]
    fn other_numbers_are_none() {
        let denormal = f32::from_bits(1);
        for float in
            [-0.0, -1.0, 1.000_001, 0.5 + 1e-7, 1e-6, f32::NAN, f32::INFINITY, 2.0, denormal]
        {
            assert_eq!(fixed(float.to_bits()), None, "{float}");
        }
    }
}
