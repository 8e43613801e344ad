//! The manifest as a C99 header: constants, structures, and the plans as tables.

use super::formula::{Formula, Variable, snake};
use super::manifest::{Host, Kind, Manifest, Stage, TABLES_FILE};
use super::plan::{Bound, Count, Dispatch, Variant, resources};
use super::structures::Structure;
use std::fmt::{Debug, Display, Write};
use tess_gpu::Resource;

/// The text before the tables, which does not depend on the setup.
const DECLARATIONS: &str = include_str!("declarations.h");

/// The header.
pub(super) fn text(manifest: &Manifest) -> String {
    let mut out = String::new();
    let mut line = |text: String| {
        out += &text;
        out.push('\n');
    };
    line(
        "/* Written by `tess shaders`. manifest.json says the same. C99; needs nothing. */".into(),
    );
    line("#ifndef TESS_SHADERS_H\n#define TESS_SHADERS_H\n\n#include <stdint.h>\n".into());
    constants(manifest).into_iter().for_each(&mut line);
    line(enumeration(
        "tess_resource",
        resources().map(resource_name).chain(["TESS_RESOURCES".to_owned()]),
    ));
    line(enumeration("tess_host", HOSTS.iter().map(|host| constant("HOST_", host))));
    line(enumeration("tess_variable", Variable::ALL.iter().map(|of| constant("OF_", of))));
    line(DECLARATIONS.trim_end().to_owned());
    manifest.structures.iter().map(structure).for_each(&mut line);
    let hosts = manifest.resources.iter().map(|role| constant("HOST_", role.host));
    line(table("enum tess_host", "tess_hosts", "TESS_RESOURCES", hosts));
    line(table(
        "struct tess_stage",
        "tess_stages",
        "TESS_STAGES",
        manifest.stages.iter().map(stage),
    ));
    let plans = manifest.plans.iter().map(|plan| variant(plan, &manifest.stages));
    line(table("struct tess_plan", "tess_plans", "TESS_PLANS", plans));
    line("#endif".into());
    out
}

const HOSTS: [Host; 7] = [
    Host::WritesJobs,
    Host::WritesFactors,
    Host::WritesTables,
    Host::Clears,
    Host::UsesIndirectly,
    Host::Reads,
    Host::Keeps,
];

fn constants(manifest: &Manifest) -> Vec<String> {
    let setup = &manifest.setup;
    let longest = |length: fn(&Variant) -> usize| manifest.plans.iter().map(length).max();
    let number = |name: &str, value: &dyn Display| format!("#define TESS_{name} {value}");
    let text = |name: &str, value: &str| format!("#define TESS_{name} \"{value}\"");
    vec![
        text("VERSION", manifest.version),
        text("DOMAIN", setup.domain),
        text("PARTITIONING", setup.partitioning),
        text("OUTPUT", setup.output),
        text("SPLIT", setup.split),
        text("POINTS_FORM", setup.points),
        text("NUMBERING", setup.numbering),
        text("ORDER", setup.order),
        text("TABLES_FILE", TABLES_FILE),
        number("FACTORS_PER_PATCH", &setup.factors_per_patch),
        number("INDICES_PER_PRIMITIVE", &setup.indices_per_primitive),
        number("BYTES_PER_INDEX", &setup.bytes_per_index),
        number("BYTES_PER_POINT", &setup.bytes_per_point),
        number("JOB_STRIDE", &manifest.job_stride),
        number("STAGES", &manifest.stages.len()),
        number("PLANS", &manifest.plans.len()),
        number(
            "MAX_BINDINGS",
            &manifest.stages.iter().map(|s| s.bindings.len()).max().unwrap_or(0),
        ),
        number("MAX_JOBS", &longest(|plan| plan.jobs.len()).unwrap_or(0)),
        number(
            "JOB_WORDS",
            &longest(|p| p.jobs.iter().map(Vec::len).max().unwrap_or(0)).unwrap_or(0),
        ),
        number("MAX_DISPATCHES", &longest(|plan| plan.dispatches.len()).unwrap_or(0)),
    ]
}

pub(super) fn enumeration(name: &str, values: impl Iterator<Item = String>) -> String {
    format!("\nenum {name} {{\n    {}\n}};", values.collect::<Vec<_>>().join(",\n    "))
}

fn table(ty: &str, name: &str, size: &str, rows: impl Iterator<Item = String>) -> String {
    let rows = rows.collect::<Vec<_>>().join(",\n    ");
    format!("\nstatic const {ty} {name}[{size}] = {{\n    {rows}\n}};")
}

/// For example `TESS_HOST_WRITES_JOBS`.
pub(super) fn constant(prefix: &str, value: impl Debug) -> String {
    format!("TESS_{prefix}{}", snake(&format!("{value:?}")).to_uppercase())
}

fn resource_name(resource: Resource) -> String {
    constant("", resource)
}

/// A structure as a C declaration. An array up to the buffer's end becomes a comment.
fn structure(structure: &Structure) -> String {
    let mut text =
        format!("\nstruct tess_{} {{ /* {} bytes */\n", snake(&structure.name), structure.bytes);
    for member in &structure.members {
        // Writing to a String cannot fail.
        _ = match member.ty.as_str() {
            "u32" => writeln!(text, "    uint32_t {};", member.name),
            other if other.starts_with('[') => {
                let of = snake(other.trim_matches(['[', ']']));
                writeln!(text, "    /* then struct tess_{of} {}[]; */", member.name)
            }
            other => writeln!(text, "    struct tess_{} {};", snake(other), member.name),
        };
    }
    text + "};"
}

fn stage(stage: &Stage) -> String {
    let [x, y, z] = stage.workgroup_size;
    let bindings = stage.bindings.iter().map(|binding| {
        let is_uniform = u32::from(binding.kind == Kind::Uniform);
        let is_written = u32::from(binding.is_written);
        format!("{{{}, {is_uniform}, {is_written}}}", resource_name(binding.resource))
    });
    let bindings = bindings.collect::<Vec<_>>().join(",\n      ");
    format!(
        "{{\"{}\", \"{}\", \"{}\", {{{x}, {y}, {z}}}, {},\n     {{{bindings}}}}}",
        stage.name,
        stage.file,
        stage.entry_point,
        stage.bindings.len()
    )
}

fn formula(formula: &Formula) -> String {
    formula_of(formula, "OF_")
}

/// A formula as a C initializer; `prefix` begins the names of the variables.
pub(super) fn formula_of(formula: &Formula, prefix: &str) -> String {
    let terms = formula
        .terms
        .iter()
        .map(|term| format!("{{{}u, {}, {}}}", term.times, constant(prefix, term.of), term.per));
    let terms = terms.collect::<Vec<_>>().join(", ");
    let terms = if terms.is_empty() { "{0, 0, 1}".to_owned() } else { terms };
    format!("{{{}u, {}, {}, {{{terms}}}}}", formula.constant, formula.multiple, formula.terms.len())
}

fn variant(plan: &Variant, stages: &[Stage]) -> String {
    let buffers = plan.buffers.iter().map(|buffer| formula(&buffer.bytes));
    let jobs = plan.jobs.iter().map(|words| {
        format!("{{{}}}", words.iter().map(formula).collect::<Vec<_>>().join(",\n       "))
    });
    let dispatches = plan.dispatches.iter().map(|one| dispatch(one, stages));
    format!(
        "{{{}u, {}u, {}u, {}u, {}, {},\n     {{{}}},\n     {{{}}},\n     {{{}}}}}",
        plan.min_patches,
        plan.max_patches,
        plan.max_points,
        plan.max_primitives,
        plan.jobs.len(),
        plan.dispatches.len(),
        buffers.collect::<Vec<_>>().join(",\n      "),
        jobs.collect::<Vec<_>>().join(",\n      "),
        dispatches.collect::<Vec<_>>().join(",\n      ")
    )
}

fn dispatch(dispatch: &Dispatch, stages: &[Stage]) -> String {
    let name = dispatch.stage.entry_point();
    let number = stages.iter().position(|stage| stage.name == name).unwrap_or(stages.len());
    let (is_indirect, workgroups) = match &dispatch.workgroups {
        Count::Direct(count) => (0, count),
        Count::IndirectAt(at) => (1, at),
    };
    let span = |bound: &Bound| format!("{{{}, {}}}", formula(&bound.offset), formula(&bound.bytes));
    let spans = dispatch.bindings.iter().map(span).collect::<Vec<_>>().join(",\n        ");
    format!("{{{number}, {is_indirect}, {},\n       {{{spans}}}}}", formula(workgroups))
}
