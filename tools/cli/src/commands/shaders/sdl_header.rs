//! The stage and its batch as data in C, for the host in bindings/sdl, whose header
//! `tess_sdl.h` declares the structures.

use super::formula::Formula;
use super::header::{constant, enumeration, formula_of};
use super::manifest::{self, Kind, TABLES_FILE};
use super::plan::{Count, Dispatch, Variant};
use super::programs::{Named, Program, User};
use super::slots::{self, Extra};
use super::stage_manifest::{Attribute, Manifest, Pass, Workgroups};
use super::translation::Target;
use tess_gpu::Resource;

/// The header.
pub(super) fn text(stage: &Manifest, batch: &manifest::Manifest) -> String {
    let users = stage.users.as_deref().unwrap_or_default();
    let fragments = stage.fragments.as_deref().unwrap_or_default();
    let mut out = String::from(
        "/* Written by `tess shaders --layout sdl`; stage.json and manifest.json say the same. tess_sdl.h declares\n   \
         the structures. A program with several stages includes each stage's header in another file. */\n\
         #ifndef TESS_STAGE_H\n#define TESS_STAGE_H\n\n#include \"tess_sdl.h\"\n",
    );
    let mut line = |text: String| {
        out += &text;
        out.push('\n');
    };
    let names = |prefix: &'static str, all: Vec<String>, last: &str| {
        let all = all.into_iter().map(move |name| format!("{prefix}{name}"));
        all.chain([last.to_owned()]).collect::<Vec<_>>()
    };
    let named = users.iter().map(|user| user.name.clone()).collect();
    let named = names("TESS_USER_", named, "TESS_USERS");
    line(enumeration("tess_user", named.into_iter()));
    let entry = |one: &Program| one.file.trim_start_matches("stage_fragment_").to_owned();
    let stem = |file: String| file.split('.').next().unwrap_or_default().to_owned();
    let named = fragments.iter().map(|one| stem(entry(one))).collect();
    let named = names("TESS_FRAGMENT_", named, "TESS_FRAGMENTS");
    line(enumeration("tess_fragment", named.into_iter()));
    tables(stage, batch).into_iter().filter(|text| !text.is_empty()).for_each(&mut line);
    line(whole(stage, batch));
    line("#endif".to_owned());
    out
}

/// An array of these rows; nothing without any, because C has no empty arrays.
fn table(ty: &str, name: &str, rows: &[String]) -> String {
    let (count, rows) = (rows.len(), rows.join(",\n    "));
    match count {
        0 => String::new(),
        _ => format!("\nstatic const {ty} tess_stage_{name}[{count}] = {{\n    {rows}\n}};"),
    }
}

/// The name of an array and the number of its elements.
fn array(name: &str, count: usize) -> String {
    match count {
        0 => "NULL, 0".to_owned(),
        _ => format!("tess_stage_{name}, {count}"),
    }
}

fn tables(stage: &Manifest, batch: &manifest::Manifest) -> Vec<String> {
    let target = batch.translation.target;
    let rows =
        |all: Vec<&Program>| all.into_iter().map(|one| program(one, "ONE", target)).collect();
    let passes = |all: &[Pass]| -> Vec<String> {
        let row = |pass: &Pass| Some(program(pass.program.as_ref()?, kind(pass), target));
        all.iter().filter_map(row).collect()
    };
    let vertex = stage.vertex.as_ref();
    let drawn: Vec<String> =
        rows(vertex.and_then(|one| one.program.as_ref()).into_iter().collect());
    let fragments: Vec<String> = rows(stage.fragments.iter().flatten().collect());
    let batch_rows: Vec<String> = batch.stages.iter().map(|one| of_batch(one, target)).collect();
    let attributes = vertex.map_or(&[][..], |one| &one.attributes);
    let attributes: Vec<String> = attributes.iter().map(attribute).collect();
    let own: Vec<String> =
        stage.buffers.iter().map(|one| size(&buffer(one.name), &one.bytes)).collect();
    let users: Vec<String> = stage.users.iter().flatten().map(user).collect();
    let uniform: Vec<String> = stage
        .uniform
        .iter()
        .map(|one| format!("{{{}.0f, {}u, {}u}}", one.factor, one.points, one.primitives))
        .collect();
    let ladder: Vec<String> =
        stage.ladder.iter().map(|step| format!("{:#010x}u", step.to_bits())).collect();
    let ladder: Vec<String> = ladder.chunks(8).map(|row| row.join(", ")).collect();
    let mut all = vec![
        table("struct tess_sdl_program", "batch", &batch_rows),
        table("struct tess_sdl_program", "before", &passes(&stage.before_batch)),
        table("struct tess_sdl_program", "after", &passes(&stage.after_batch)),
        table("struct tess_sdl_program", "vertex", &drawn),
        table("struct tess_sdl_program", "fragments", &fragments),
        table("SDL_GPUVertexAttribute", "attributes", &attributes),
        table("struct tess_sdl_size", "sizes", &own),
        table("struct tess_sdl_user", "users", &users),
        table("struct tess_sdl_uniform", "uniform", &uniform),
        // The rows are of eight each.
        table("uint32_t", "ladder", &ladder)
            .replace("ladder[33]", &format!("ladder[{}]", stage.ladder.len())),
    ];
    let plans: Vec<String> =
        batch.plans.iter().enumerate().map(|(number, one)| plan(number, one)).collect();
    for (number, one) in batch.plans.iter().enumerate() {
        let sizes: Vec<String> =
            one.buffers.iter().map(|of| size(&resource(of.resource), &of.bytes)).collect();
        let jobs: Vec<String> = one.jobs.iter().flatten().map(formula).collect();
        let dispatches: Vec<String> =
            one.dispatches.iter().map(|one| dispatch(one, batch)).collect();
        all.push(table("struct tess_sdl_size", &format!("sizes_{number}"), &sizes));
        all.push(table("struct tess_sdl_formula", &format!("jobs_{number}"), &jobs));
        all.push(table("struct tess_sdl_dispatch", &format!("dispatches_{number}"), &dispatches));
    }
    all.push(table("struct tess_sdl_plan", "plans", &plans));
    all
}

/// The structure that the host is given.
fn whole(stage: &Manifest, batch: &manifest::Manifest) -> String {
    let setup = &batch.setup;
    let format = match batch.translation.target {
        Target::Msl => "SDL_GPU_SHADERFORMAT_MSL",
        Target::Hlsl => "SDL_GPU_SHADERFORMAT_DXIL",
        _ => "SDL_GPU_SHADERFORMAT_SPIRV",
    };
    let primitives = if setup.indices_per_primitive == 2 { "LINELIST" } else { "TRIANGLELIST" };
    let primitives = if setup.indices_per_primitive == 1 { "POINTLIST" } else { primitives };
    let has = |part: &str| stage.before_batch.iter().any(|pass| pass.part == part);
    let names = [setup.domain, setup.partitioning, setup.output, setup.split];
    let vertex = stage.vertex.as_ref();
    let rows = [
        names.map(|name| format!("\"{name}\"")).join(", "),
        format!("\"{TABLES_FILE}\""),
        format.to_owned(),
        format!("SDL_GPU_PRIMITIVETYPE_{primitives}"),
        format!("{}, {}", setup.factors_per_patch, setup.indices_per_primitive),
        format!("{}, {}", stage.workgroup_size, stage.most_workgroups),
        format!("{}, {}", u8::from(has("hull")), u8::from(!stage.after_batch.is_empty())),
        array("batch", batch.stages.len()),
        array("before", stage.before_batch.len()),
        array("after", stage.after_batch.len()),
        array("vertex", usize::from(vertex.is_some())),
        array("fragments", stage.fragments.iter().flatten().count()),
        array("attributes", vertex.map_or(0, |one| one.attributes.len())),
        vertex.map_or(0, |one| one.stride).to_string(),
        array("sizes", stage.buffers.len()),
        array("users", stage.users.iter().flatten().count()),
        array("uniform", stage.uniform.len()),
        array("ladder", stage.ladder.len()),
        array("plans", batch.plans.len()),
    ];
    format!(
        "\nstatic const struct tess_sdl_shaders tess_stage = {{\n    {}\n}};\n",
        rows.join(",\n    ")
    )
}

fn kind(pass: &Pass) -> &'static str {
    match (pass.part, pass.workgroups) {
        (_, Workgroups::One) => "ONE",
        (_, Workgroups::Patches) => "PATCHES",
        (_, Workgroups::FitArguments) => "FIT_ARGUMENTS",
        (_, Workgroups::Points) => "POINTS",
        // Only parts have such a pass.
        (_, Workgroups::Groups) => "ONE",
    }
}

/// `TESS_SDL_FIT_ARGUMENTS` for `fit_arguments`.
fn buffer(name: &str) -> String {
    format!("TESS_SDL_{}", name.to_uppercase())
}

fn resource(of: Resource) -> String {
    constant("SDL_", of)
}

fn formula(of: &Formula) -> String {
    formula_of(of, "SDL_OF_")
}

fn size(name: &str, bytes: &Formula) -> String {
    format!("{{{name}, {}}}", formula(bytes))
}

fn user(user: &User) -> String {
    let kind = match user.kind {
        slots::Kind::Texture => "TEXTURE",
        slots::Kind::Uniform => "UNIFORM",
        slots::Kind::ReadOnly | slots::Kind::ReadWrite => "BUFFER",
    };
    format!("{{\"{}\", TESS_SDL_USER_{kind}, {}}}", user.name, user.bytes)
}

fn attribute(one: &Attribute) -> String {
    let (scalar, count) = one.format.split_once('x').unwrap_or((&one.format, ""));
    let scalar = match scalar {
        "float32" => "FLOAT",
        "sint32" => "INT",
        _ => "UINT",
    };
    let format = format!("SDL_GPU_VERTEXELEMENTFORMAT_{scalar}{count}");
    format!("{{{}, 0, {format}, {}}}", one.location, one.offset)
}

fn list(all: Vec<String>) -> String {
    if all.is_empty() { "{0}".to_owned() } else { format!("{{{}}}", all.join(", ")) }
}

fn named(one: &Named) -> String {
    match one {
        Named::Buffer(name) => buffer(name),
        Named::User(name) => format!("TESS_SDL_OF_USER(TESS_USER_{name})"),
    }
}

/// The name of the file that SDL loads: DXIL is compiled from HLSL.
fn loaded(file: &str, target: Target) -> String {
    match target {
        Target::Hlsl => file.replace(".hlsl", ".dxil"),
        _ => file.to_owned(),
    }
}

fn program(one: &Program, workgroups: &str, target: Target) -> String {
    let extra = match one.extra {
        None => "NOTHING",
        Some(Extra::Sizes) => "SIZES",
        Some(Extra::Workgroups) => "WORKGROUPS",
    };
    let [x, y, z] = one.threads;
    format!(
        "{{\"{}\", \"{}\", TESS_SDL_GROUPS_{workgroups}, {{{x}, {y}, {z}}}, {}, {}, {}, {}, TESS_SDL_EXTRA_{extra},\n     \
         {}, {}, {}}}",
        loaded(&one.file, target),
        one.entry_point,
        one.textures,
        one.read_only,
        one.read_write,
        one.uniforms,
        list(one.bound.iter().map(named).collect()),
        one.sized.len(),
        list(one.sized.iter().map(named).collect()),
    )
}

/// A shader of the batch. Its bindings are counted in their order, as SDL's layout does.
fn of_batch(stage: &manifest::Stage, target: Target) -> String {
    let is = |one: &manifest::Binding| match (one.kind, one.is_written) {
        (Kind::Uniform, _) => 2,
        (Kind::Storage, true) => 1,
        (Kind::Storage, false) => 0,
    };
    let mut bound: Vec<_> = stage.bindings.iter().collect();
    bound.sort_by_key(|one| is(one));
    let count = |kind| bound.iter().filter(|one| is(one) == kind).count();
    let sized = stage.msl_sizes.as_ref().map_or(&[][..], |sizes| &sizes.of_bindings);
    let at = |number: &u32| stage.bindings.get(usize::try_from(*number).ok()?);
    let sized: Vec<String> =
        sized.iter().filter_map(at).map(|one| resource(one.resource)).collect();
    let extra = if sized.is_empty() { "NOTHING" } else { "SIZES" };
    let [x, y, z] = stage.workgroup_size;
    format!(
        "{{\"{}\", \"{}\", TESS_SDL_GROUPS_ONE, {{{x}, {y}, {z}}}, 0, {}, {}, {}, TESS_SDL_EXTRA_{extra},\n     \
         {}, {}, {}}}",
        loaded(&stage.file, target),
        stage.entry_point,
        count(0),
        count(1),
        count(2) + usize::from(!sized.is_empty()),
        list(bound.iter().map(|one| resource(one.resource)).collect()),
        sized.len(),
        list(sized),
    )
}

fn plan(number: usize, of: &Variant) -> String {
    let words = of.jobs.iter().map(Vec::len).max().unwrap_or(0);
    format!(
        "{{{}u, {}u, {}u, {}u, tess_stage_sizes_{number}, {}, tess_stage_jobs_{number}, {words},\n     \
         tess_stage_dispatches_{number}, {}}}",
        of.min_patches,
        of.max_patches,
        of.max_points,
        of.max_primitives,
        of.buffers.len(),
        of.dispatches.len()
    )
}

fn dispatch(one: &Dispatch, batch: &manifest::Manifest) -> String {
    let name = one.stage.entry_point();
    let number = batch.stages.iter().position(|stage| stage.name == name).unwrap_or(usize::MAX);
    let (is_indirect, workgroups) = match &one.workgroups {
        Count::Direct(count) => (0, count),
        Count::IndirectAt(at) => (1, at),
    };
    format!("{{{number}, {}, {is_indirect}, {}}}", one.job, formula(workgroups))
}
