//! The rates that rows of `tess bench` have, and how numbers are shown.

use super::Row;
use serde_json::Value;

/// A column of the rows of `tess bench`.
pub(super) struct Column {
    pub(super) title: &'static str,
    pub(super) key: &'static str,
    /// The divisor of a value.
    pub(super) unit: f64,
}

pub(super) const RATES: &[Column] = &[
    Column { title: "M patches/s", key: "patches_per_s", unit: 1e6 },
    Column { title: "G triangles/s", key: "triangles_per_s", unit: 1e9 },
    Column { title: "GB/s", key: "bytes_per_s", unit: 1e9 },
    Column { title: "of fill", key: "fill_ratio", unit: 1.0 },
    Column { title: "of core", key: "core_ratio", unit: 1.0 },
];

pub(super) fn number(row: &Row, key: &str) -> Option<f64> {
    row.get(key).and_then(Value::as_f64)
}

/// Three significant digits, never fewer than those before the point, without zeros at the end.
pub(super) fn digits(value: f64) -> String {
    let decimals = [(100.0, 0), (10.0, 1), (1.0, 2), (0.1, 3), (0.01, 4)]
        .into_iter()
        .find_map(|(from, decimals)| (value >= from).then_some(decimals));
    let text = format!("{value:.*}", decimals.unwrap_or(5));
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits_count() {
        let shown = [27430.4, 173.1, 14.85, 4.0749, 9.8, 0.5661, 0.0571, 0.00123].map(digits);
        let expected = ["27430", "173", "14.8", "4.07", "9.8", "0.566", "0.0571", "0.00123"];
        assert_eq!(shown, expected, "digits");
    }
}
