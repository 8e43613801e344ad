//! An explanation as plain text.

use super::PatchReport;
use super::factors::FactorReport;
use std::fmt;

impl fmt::Display for PatchReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}\n", self.command)?;
        self.write_factors(f)?;
        writeln!(f, "Decisions (spec section 3)")?;
        self.decisions.iter().try_for_each(|sentence| writeln!(f, "  {sentence}"))?;
        writeln!(f, "\nCounts (spec section 12.6)")?;
        let points = counted(self.points, ["point", "points"]);
        let primitives = counted(self.primitives, ["primitive", "primitives"]);
        let indices = counted(self.indices, ["index", "indices"]);
        writeln!(f, "  {points}, {primitives}, {indices}")?;
        self.write_points(f)?;
        self.write_stitches(f)
    }
}

impl PatchReport {
    fn write_factors(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "Factors (spec sections 2 and 3; hex bits and value)")?;
        writeln!(
            f,
            "  {:<9} {:>19} {:>19} {:>19} {:>18}  parity",
            "", "raw", "clamped", "rounded", "fixed 15.16"
        )?;
        self.factors.iter().try_for_each(|factor| write_factor(f, factor))?;
        if self.kind != "culled" {
            writeln!(f, "\nContexts (spec section 4; fractions and reciprocals in hex 0.16)")?;
            writeln!(
                f,
                "  {:<9} {:>6} {:>11} {:>6} {:>9} {:>10} {:>9} {:>11}",
                "",
                "points",
                "half_points",
                "split",
                "fraction",
                "inv_floor",
                "inv_ceil",
                "half_steps"
            )?;
            self.factors.iter().try_for_each(|factor| write_context(f, factor))?;
        }
        writeln!(f)
    }

    fn write_points(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "\nPoints, edge by edge (spec section 6)")?;
        for run in &self.point_runs {
            writeln!(f, "  {:<22} {:>5} from {}", run.place, run.count, run.first)?;
        }
        Ok(())
    }

    fn write_stitches(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "\nPrimitives, stitch by stitch (spec sections 7 and 8; \
             O advances on the outer row, I on the inner)"
        )?;
        for stitch in &self.stitches {
            writeln!(f, "  {:<22} {:>5} from {}", stitch.place, stitch.count, stitch.first)?;
            if !stitch.steps.is_empty() {
                writeln!(f, "    outer row {}", row(&stitch.outer_row))?;
                writeln!(f, "    inner row {}", row(&stitch.inner_row))?;
                writeln!(f, "    steps     {}", stitch.steps)?;
            }
        }
        Ok(())
    }
}

/// A number followed by the right form of its noun.
fn counted(number: u32, [one, many]: [&str; 2]) -> String {
    format!("{number} {}", if number == 1 { one } else { many })
}

fn write_factor(f: &mut fmt::Formatter<'_>, factor: &FactorReport) -> fmt::Result {
    let float = |x: super::factors::Float| format!("{:08x} {:>10}", x.bits, shorten(x.value));
    write!(f, "  {:<9} {}", factor.name, float(factor.raw))?;
    if let Some(processed) = factor.processed {
        let [clamped, rounded] = [processed.clamped, processed.rounded].map(float);
        let fixed = processed.fixed;
        write!(f, " {clamped} {rounded} {:06x} {:>11}", fixed.bits, fixed.value)?;
        write!(f, "  {}", processed.parity)?;
    }
    writeln!(f)
}

fn write_context(f: &mut fmt::Formatter<'_>, factor: &FactorReport) -> fmt::Result {
    let Some(processed) = factor.processed else {
        return Ok(());
    };
    let c = processed.context;
    writeln!(
        f,
        "  {:<9} {:>6} {:>11} {:>6} {:>9} {:>10} {:>9} {:>11}",
        factor.name,
        c.points,
        c.half_points,
        c.split,
        format!("{:04x}", c.fraction),
        format!("{:05x}", c.inv_floor),
        format!("{:05x}", c.inv_ceil),
        c.half_steps
    )
}

/// A float that fits the column; very long ones are in scientific notation.
fn shorten(value: f32) -> String {
    let plain = value.to_string();
    if plain.len() > 10 { format!("{value:.3e}") } else { plain }
}

/// A row with its runs abbreviated: `20..24 16`.
fn row(indices: &[u32]) -> String {
    let mut words: Vec<String> = Vec::new();
    let mut rest = indices;
    while let Some((&first, _)) = rest.split_first() {
        let run = run_length(rest);
        let last = rest[run - 1];
        words.push(if run < 3 { first.to_string() } else { format!("{first}..{last}") });
        rest = &rest[if run < 3 { 1 } else { run }..];
    }
    words.join(" ")
}

/// The length of the longest beginning in which the indices go up by one each, or down by one each.
fn run_length(indices: &[u32]) -> usize {
    let length = |step: i64| {
        let follows = |pair: &&[u32]| i64::from(pair[1]) - i64::from(pair[0]) == step;
        1 + indices.windows(2).take_while(follows).count()
    };
    length(1).max(length(-1))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The column has room for ten characters.
    #[test]
    fn long_floats_are_shortened() {
        let all = [0.123_456_78, 0.012_345_678, 1.5, 16_777_216.0, 1.0e-40].map(shorten);
        assert_eq!(all, ["0.12345678", "1.235e-2", "1.5", "16777216", "1.000e-40"]);
    }
}
