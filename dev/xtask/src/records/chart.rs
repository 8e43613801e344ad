//! Bar charts of records, as SVG: `docs/images/NAME.svg`.
#![expect(clippy::float_arithmetic, reason = "lengths of bars")]

use super::rates::{digits, number};
use super::{Row, read};
use serde_json::Value;
use std::fmt::Write;

/// A chart: for each label a bar for each series.
struct Chart {
    title: &'static str,
    /// Whether a bar's length is the logarithm of its value.
    is_logarithmic: bool,
    series: Vec<&'static str>,
    bars: Vec<Bars>,
}

/// The bars of one label; a series may have no value for it.
struct Bars {
    label: String,
    values: Vec<Option<f64>>,
}

/// Colours of the series, which people with any eyes tell apart, in any order and in grey.
const COLOURS: [&str; 3] = ["#4477aa", "#ee8866", "#44aa77"];

/// Left of the bars are labels, right of the longest is its value.
const LEFT: f64 = 180.0;
const LONGEST: f64 = 500.0;
const WIDTH: f64 = 760.0;
const BAR: f64 = 13.0;
const GAP: f64 = 9.0;
const HEAD: f64 = 62.0;

/// The name and the text of every chart's file.
///
/// # Errors
/// A record that does not exist or has other keys.
pub(super) fn all() -> Result<Vec<(&'static str, String)>, String> {
    let charts = [("fill", fill()?), ("core", core()?), ("drawn", drawn()?), ("pixels", pixels()?)];
    charts.into_iter().map(|(name, chart)| Ok((name, chart.svg(name)?))).collect()
}

/// How close the CPU and the GPU come to writing with no work at all.
fn fill() -> Result<Chart, String> {
    let title = "Speed of writing the output, as a part of a fill of as many bytes";
    beside(title, "fill_ratio", false)
}

/// How much faster than the model they are.
fn core() -> Result<Chart, String> {
    beside("Patches a second, as a multiple of the model's on one thread", "core_ratio", true)
}

/// The CPU backend beside the GPU backend, workload by workload.
fn beside(title: &'static str, key: &str, is_logarithmic: bool) -> Result<Chart, String> {
    let cpu = read("simd-xeon")?.rows;
    let gpu = read("gpu-h200")?.rows;
    let of = |rows: &[Row], workload: &str| {
        rows.iter().find(|row| text(row, "workload") == workload).and_then(|row| number(row, key))
    };
    let bars = cpu.iter().map(|row| {
        let label = text(row, "workload").to_owned();
        Bars { values: vec![number(row, key), of(&gpu, &label)], label }
    });
    let series = vec!["CPU: tess-simd, one thread, AVX-512, cache", "GPU: tess-gpu, H200, stream"];
    Ok(Chart { title, is_logarithmic, series, bars: bars.collect() })
}

/// Factors to pixels through the fixed-function stage and through compute shaders.
fn drawn() -> Result<Chart, String> {
    let keys = ["stage_drawn", "compute_drawn", "in_vertex_cache_order_drawn"];
    let rows = read("probe-h200")?.rows;
    let bars = rows.iter().map(|row| {
        let label = text(row, "workload").to_owned();
        Bars { values: keys.iter().map(|key| figure(row, key)).collect(), label }
    });
    Ok(Chart {
        title: "Factors to pixels on an H200, thousands of millions of triangles a second",
        is_logarithmic: false,
        series: vec!["fixed-function stage", "compute", "compute, vertex-cache order"],
        bars: bars.collect(),
    })
}

/// The stage of tess-wgpu, by where its points are computed.
fn pixels() -> Result<Chart, String> {
    let rows = read("stage-h200")?.rows;
    let mut bars: Vec<Bars> = Vec::new();
    for row in &rows {
        let millions = figure(row, "triangles").unwrap_or_default() / 1e6;
        let label = format!("{} M triangles", digits(millions));
        if bars.iter().all(|bars| bars.label != label) {
            bars.push(Bars { label: label.clone(), values: Vec::new() });
        }
        let value = figure(row, "G_triangles/s");
        bars.iter_mut().filter(|bars| bars.label == label).for_each(|bars| bars.values.push(value));
    }
    Ok(Chart {
        title: "Terrain by the stage of tess-wgpu on an H200, thousands of millions of triangles a second",
        is_logarithmic: false,
        series: vec!["points stored", "points pulled", "pulled without indices"],
        bars,
    })
}

fn text<'a>(row: &'a Row, key: &str) -> &'a str {
    row.get(key).and_then(Value::as_str).unwrap_or_default()
}

/// A number, which other programs print as text.
fn figure(row: &Row, key: &str) -> Option<f64> {
    number(row, key).or_else(|| text(row, key).parse().ok())
}

impl Chart {
    /// The picture.
    ///
    /// # Errors
    /// No value at all, or a series without one: the records have other keys.
    fn svg(&self, name: &str) -> Result<String, String> {
        let values = || self.bars.iter().flat_map(|bars| &bars.values).copied().flatten();
        for (number, series) in self.series.iter().enumerate() {
            if self.bars.iter().all(|bars| bars.values.get(number).copied().flatten().is_none()) {
                return Err(format!("chart {name}: no record has a value of `{series}`"));
            }
        }
        let most = values().fold(0.0, f64::max);
        let row = self.series.len() as f64 * BAR + GAP;
        let height = HEAD + self.bars.len() as f64 * row + GAP;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
             <!-- Written by `cargo xtask performance` from benches/records. Do not edit. -->\n\
             <rect width=\"{WIDTH}\" height=\"{height}\" fill=\"#ffffff\"/>\n\
             <text x=\"12\" y=\"22\" font-size=\"14\" font-weight=\"bold\">{}</text>\n",
            self.title
        );
        self.legend(&mut svg);
        for (number, bars) in self.bars.iter().enumerate() {
            let top = HEAD + number as f64 * row;
            let middle = top + self.series.len() as f64 * BAR / 2.0 + 4.0;
            let Bars { label, values } = bars;
            line(&mut svg, LEFT - 8.0, middle, "end", label);
            for (series, value) in values.iter().enumerate() {
                let Some(value) = *value else { continue };
                let (y, length) = (top + series as f64 * BAR, self.length(value, most));
                let (height, colour) = (BAR - 1.0, COLOURS[series]);
                _ = writeln!(
                    svg,
                    "<rect x=\"{LEFT}\" y=\"{y}\" width=\"{length:.1}\" height=\"{height}\" fill=\"{colour}\"/>"
                );
                line(&mut svg, LEFT + length + 5.0, y + 10.5, "start", &digits(value));
            }
        }
        Ok(svg + "</svg>\n")
    }

    /// Which colour is which series.
    fn legend(&self, svg: &mut String) {
        let mut x = 12.0;
        for (series, colour) in self.series.iter().zip(COLOURS) {
            _ = writeln!(
                svg,
                "<rect x=\"{x}\" y=\"36\" width=\"11\" height=\"11\" fill=\"{colour}\"/>"
            );
            line(svg, x + 16.0, 46.0, "start", series);
            x += 36.0 + 6.6 * series.len() as f64;
        }
        if self.is_logarithmic {
            line(svg, WIDTH - 12.0, 46.0, "end", "logarithmic");
        }
    }

    /// The length of a bar; a logarithmic one begins at 1.
    fn length(&self, value: f64, most: f64) -> f64 {
        match self.is_logarithmic {
            true => LONGEST * libm::log(value.max(1.0)) / libm::log(most),
            false => LONGEST * value / most,
        }
    }
}

/// A line of text.
fn line(svg: &mut String, x: f64, y: f64, anchor: &str, text: &str) {
    // Writing to a String does not fail.
    _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{text}</text>");
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(is_logarithmic: bool, values: Vec<Option<f64>>) -> Chart {
        let bars = vec![Bars { label: "one".into(), values }];
        Chart { title: "a chart", is_logarithmic, series: vec!["a", "b"], bars }
    }

    #[test]
    fn bars_are_as_long_as_their_values() {
        let svg = chart(false, vec![Some(2.0), Some(4.0)]).svg("x").expect("a picture");
        assert!(svg.contains("width=\"250.0\"") && svg.contains("width=\"500.0\""), "{svg}");
        let svg = chart(true, vec![Some(10.0), Some(100.0)]).svg("x").expect("a picture");
        assert!(svg.contains("width=\"250.0\"") && svg.contains("logarithmic"), "{svg}");
    }

    #[test]
    fn a_series_without_values_is_an_error() {
        let error = chart(false, vec![Some(2.0), None]).svg("x");
        assert!(error.is_err_and(|error| error.contains("`b`")), "the second");
    }
}
