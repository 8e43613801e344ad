//! The user's WGSL joined with the stage's own.
//!
//! The user's text comes first, so that its line numbers stay the same in the joined text.

use super::choices::Points;
use super::vertex::{Load, VertexLayout};
use super::{StageError, wgsl};
use tess_core::Domain;
use tess_gpu::{Pull, Setup};

const TYPES: &str = include_str!("../../shaders/types.wgsl");
const HELPERS: &str = tess_gpu::surfaces::HELPERS;
const COPY_FACTORS: &str = include_str!("../../shaders/copy_factors.wgsl");
const HULL: &str = include_str!("../../shaders/hull.wgsl");
const UNPACK: &str = include_str!("../../shaders/unpack.wgsl");
const EVALUATE: &str = include_str!("../../shaders/evaluate.wgsl");
const STORED: &str = include_str!("../../shaders/vertex_stored.wgsl");
const PULLED: &str = include_str!("../../shaders/vertex_pulled.wgsl");
const UNINDEXED: &str = include_str!("../../shaders/vertex_unindexed.wgsl");
const EVALUATED: &str = include_str!("../../shaders/vertex_evaluated.wgsl");
const LOADED: &str = include_str!("../../shaders/vertex_loaded.wgsl");

/// The binding of the factors that `tess_factors` reads, in the stage's own group. It is above all
/// others there.
pub(crate) const FACTORS_BINDING: u32 = 8;

/// The module whose entry point `tess_hull` runs the user's hull function. Its own bindings are 0
/// and 1 of bind group `group`.
pub(crate) fn of_hull(user: &str, domain: Domain, group: u32) -> String {
    joined(user, &(own_of_hull(domain, group) + &of_draws(user, domain, group)))
}

/// The text after the types and helpers in the hull's module.
fn own_of_hull(domain: Domain, group: u32) -> String {
    in_group(&hull_part(domain), group)
}

/// The same with `GROUP` for the number of the bind group.
pub(crate) fn hull_part(domain: Domain) -> String {
    let write = match domain {
        Domain::Isoline => include_str!("../../shaders/hull_isoline.wgsl"),
        Domain::Triangle => include_str!("../../shaders/hull_triangle.wgsl"),
        Domain::Quad => include_str!("../../shaders/hull_quad.wgsl"),
    };
    HULL.to_owned() + "\n" + write
}

/// A part of the stage's text with this number of the stage's own bind group.
fn in_group(part: &str, group: u32) -> String {
    part.replace("GROUP", &group.to_string())
}

/// The module whose entry point `tess_evaluate` runs the user's domain function over all points.
/// Its own bindings are 0 to 3 of bind group `group`.
pub(crate) fn of_evaluation(user: &str, domain: Domain, group: u32) -> String {
    joined(user, &(own_of_evaluation(group) + &of_draws(user, domain, group)))
}

fn own_of_evaluation(group: u32) -> String {
    in_group(&evaluation_part(), group)
}

/// The text after the types and helpers in the evaluation's module, with `GROUP` for the number of
/// the bind group.
pub(crate) fn evaluation_part() -> String {
    UNPACK.to_owned() + "\n" + EVALUATE
}

/// The text after the types and helpers in the vertex shader, where points are stored and where
/// they are evaluated, with words for the user's choices.
pub(crate) fn vertex_parts() -> [String; 2] {
    [UNPACK.to_owned() + "\n" + STORED, EVALUATED.to_owned()]
}

/// The same where points are pulled: with an index buffer, and without one.
pub(crate) fn pulled_parts(setup: Setup) -> [String; 2] {
    [PULLED, UNINDEXED].map(|vertex| pulled_part(setup, vertex))
}

fn pulled_part(setup: Setup, vertex: &str) -> String {
    let pull = Pull { group: 0, first_binding: 0 }.source_for_drawing(setup);
    with_own_names(&(pull + vertex)).replace("@group(0)", "@group(GROUP)")
}

/// The parameters of the vertex shader's text, apart from the user's text.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VertexShader<'a> {
    pub(crate) setup: Setup,
    pub(crate) points: Points,
    /// How the shader gets its vertices, where points are evaluated.
    pub(crate) load: Load,
    /// The number of the stage's own bind group.
    pub(crate) group: u32,
    /// The user's function that every draw runs.
    pub(crate) project: Option<&'a str>,
    /// The vertices that are loaded, where points are evaluated.
    pub(crate) vertices: &'a VertexLayout,
}

impl VertexShader<'_> {
    /// The module whose entry point is `tess_vertex`. Where points are pulled, its own bindings are
    /// 0 to 5 of the stage's bind group; where vertices are loaded from a storage buffer, it is 0.
    pub(crate) fn with(self, user: &str) -> String {
        let of_draws = of_draws(user, self.setup.domain, self.group);
        let (mut builtins, mut begin) = (String::new(), String::new());
        for (function, builtin) in OF_DRAWS {
            if uses(user, function) {
                builtins += &format!(", @builtin({builtin}) {function}_now: u32");
                begin += &format!("{function}_value = {function}_now;");
            }
        }
        let own = self
            .own()
            .replace(" BUILTINS", &builtins)
            .replace("BEGIN", &begin)
            .replace("PROJECT", self.project.unwrap_or_default());
        joined(user, &(own + &of_draws))
    }

    /// The text after the types and helpers, with the parts that the user's choices fill in.
    pub(crate) fn own(self) -> String {
        let Self { setup, group, .. } = self;
        let [loaded, vertex] = self.vertices.loads();
        let [stored, evaluated] = vertex_parts();
        match self.points {
            Points::Stored => stored,
            Points::Evaluated if self.load == Load::Storage => in_group(LOADED, group),
            Points::Evaluated => evaluated.replace("LOADED", &loaded).replace("VERTEX", &vertex),
            Points::Pull => in_group(&pulled_part(setup, PULLED), group),
            Points::PullWithoutIndices => in_group(&pulled_part(setup, UNINDEXED), group),
        }
    }
}

/// Functions that return a value of the draw, and the builtin that holds it.
pub(crate) const OF_DRAWS: [(&str, &str); 2] =
    [("tess_instance", "instance_index"), ("tess_view", "view_index")];

/// Whether a text has this word.
pub(crate) fn uses(text: &str, word: &str) -> bool {
    wgsl::tokens(text).any(|(_, token)| token == word)
}

/// The functions for the frame's factors and the draw's instance and view, as far as the user's
/// text calls them.
fn of_draws(user: &str, domain: Domain, group: u32) -> String {
    let mut text = String::new();
    if uses(user, "tess_factors") {
        text += &in_group(&factors_part(domain), group);
    }
    for (function, _) in OF_DRAWS {
        if uses(user, function) {
            text += &draw_part(function);
        }
    }
    text
}

/// `tess_factors` and its binding, with `GROUP` for the number of the bind group.
pub(crate) fn factors_part(domain: Domain) -> String {
    let read = match domain {
        Domain::Isoline => include_str!("../../shaders/factors_isoline.wgsl"),
        Domain::Triangle => include_str!("../../shaders/factors_triangle.wgsl"),
        Domain::Quad => include_str!("../../shaders/factors_quad.wgsl"),
    };
    let kind = "var<storage, read> tess_drawn_factors: array<f32>";
    format!("@group(GROUP) @binding({FACTORS_BINDING}) {kind};\n{read}")
}

/// One of the functions of [`OF_DRAWS`].
pub(crate) fn draw_part(function: &str) -> String {
    let value = format!("{function}_value");
    format!("var<private> {value}: u32;\nfn {function}() -> u32 {{ return {value}; }}\n")
}

/// The user's text, then the types and helpers that it may use, then `own`.
pub(crate) fn joined(user: &str, own: &str) -> String {
    [user, &shared(), own].join("\n")
}

/// The types and helpers of every module.
pub(crate) fn shared() -> String {
    [TYPES, HELPERS].join("\n")
}

/// The module whose entry point `copy_factors` copies factors of the host or of a buffer.
pub(crate) fn of_copying(setup: Setup) -> String {
    COPY_FACTORS.replace("FACTORS", &format!("{}u", setup.factors()))
}

/// The text of the compute passes of a stage, apart from the user's text.
pub(crate) fn own_of_passes(domain: Domain) -> String {
    own_of_hull(domain, 0) + &own_of_evaluation(0)
}

/// Refuses a user's text that declares a built-in name of WGSL that the stage's text uses: the
/// helpers, or `own`.
pub(crate) fn check_names(user: &str, own: &str) -> Result<(), StageError> {
    match wgsl::shadowed(user, &joined("", own)) {
        None => Ok(()),
        Some(wgsl::Declaration { name, line, .. }) => Err(StageError::Wgsl {
            line: Some(line),
            message: format!(
                "`{name}` is a built-in name of WGSL that the stage's functions use; choose another name"
            ),
        }),
    }
}

/// The number of lines of the user's text.
pub(crate) fn lines(user: &str) -> u32 {
    u32::try_from(user.lines().count()).unwrap_or(u32::MAX)
}

/// The same WGSL with a prefix before every name that it declares at module scope, so that the
/// user's text can have these names too. Every occurrence of such a name is renamed, members and
/// locals included, which changes nothing within the text.
fn with_own_names(source: &str) -> String {
    let declared = wgsl::declarations(source).into_iter().map(|one| one.name);
    let declared: Vec<_> = declared.filter(|name| !name.starts_with("tess_")).collect();
    let mut renamed = String::with_capacity(source.len() * 5 / 4);
    let mut rest = source;
    while let Some(begin) = rest.find(wgsl::is_in_word) {
        let (between, from_word) = rest.split_at(begin);
        let end = from_word.find(|c| !wgsl::is_in_word(c)).unwrap_or(from_word.len());
        let (word, behind) = from_word.split_at(end);
        renamed.push_str(between);
        if declared.contains(&word) {
            renamed.push_str("tess_");
        }
        renamed.push_str(word);
        rest = behind;
    }
    renamed + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn declared_names_get_the_prefix_everywhere() {
        let source = "const ONE = 1u;\n@group(0) @binding(1) var<storage, read> job: Job;\n\
                      struct Job { x: u32 }\nfn tess_f(a: u32) -> u32 { return place(a) + job.x + ONE; }\n\
                      fn place(at: u32) -> u32 { return at; }";
        let expected = source
            .replace("ONE", "tess_ONE")
            .replace("job", "tess_job")
            .replace("Job", "tess_Job")
            .replace("place", "tess_place");
        assert_eq!(with_own_names(source), expected, "and nothing else");
    }

    /// Functions that only other helpers call; the README does not list them.
    const OF_HELPERS: [&str; 7] = [
        "tess_bilinear",
        "tess_clamp_factor",
        "tess_is_before",
        "tess_is_behind",
        "tess_pn_edge_point",
        "tess_power_of_two",
        "tess_root_quotient",
    ];

    #[test]
    fn the_readme_has_every_helper() {
        let readme = include_str!("../../README.md");
        let declared = joined("", "");
        let names = declared.lines().filter_map(|line| line.strip_prefix("fn ")?.split('(').next());
        let (mut silent, mut own) = (Vec::new(), Vec::new());
        for name in names {
            match OF_HELPERS.contains(&name) {
                true => own.push(name),
                false
                    if readme.contains(&format!("| `{name}("))
                        || readme.contains(&format!(", `{name}(")) => {}
                false => silent.push(name),
            }
        }
        assert!(silent.is_empty(), "the README's table lacks {silent:?}");
        own.sort_unstable();
        assert_eq!(own, OF_HELPERS, "all of them are there");
    }

    /// The smallest text that a user can write for a domain.
    fn user(domain: Domain) -> String {
        let kind = match domain {
            Domain::Isoline => "IsolineFactors",
            Domain::Triangle => "TriFactors",
            Domain::Quad => "QuadFactors",
        };
        format!(
            "struct Vertex {{ @builtin(position) position: vec4f }}\n\
             fn hull(number: u32) -> {kind} {{ return {kind}(); }}\n\
             fn domain(number: u32, uv: vec2f) -> Vertex {{ return Vertex(vec4f(uv, 0.0, 1.0)); }}\n"
        )
    }

    /// The same, with everything that a user may call.
    fn busy(domain: Domain) -> String {
        user(domain).replace("vec4f(uv, 0.0", "vec4f(uv, f32(tess_instance())")
            + "fn turned(vertex: Vertex) -> Vertex {\n    let a = tess_factors(tess_view());\n    \
               return vertex;\n}\n"
    }

    fn vertex_shader(setup: Setup, points: Points, project: Option<&str>) -> VertexShader<'_> {
        static LAYOUT: std::sync::LazyLock<VertexLayout> = std::sync::LazyLock::new(|| {
            VertexLayout::of(&wgsl::declarations(&user(Domain::Quad))).expect("a sound struct")
        });
        VertexShader { setup, points, load: Load::Attributes, group: 1, project, vertices: &LAYOUT }
    }

    /// Every module of the stage, with names of the stage's own shaders in the user's text.
    fn modules() -> Vec<String> {
        let mut all = Vec::new();
        for domain in Domain::ALL {
            let user = user(domain)
                + "const ONE = 1.0; fn place() {} fn corner() {} struct Job { a: u32 }";
            let busy = busy(domain);
            all.extend([of_hull(&user, domain, 2), of_hull(&busy, domain, 2)]);
            all.extend([of_evaluation(&user, domain, 2), of_evaluation(&busy, domain, 2)]);
            for partitioning in tess_core::Partitioning::ALL {
                for output in tess_core::OutputPrimitive::ALL {
                    let setup = Setup::new(domain, tess_core::Config::new(partitioning, output));
                    all.push(super::super::fit::source(setup));
                    for points in Points::ALL {
                        all.push(vertex_shader(setup, points, None).with(&user));
                        all.push(vertex_shader(setup, points, Some("turned")).with(&busy));
                    }
                    let loaded = vertex_shader(setup, Points::Evaluated, None);
                    all.push(VertexShader { load: Load::Storage, ..loaded }.with(&busy));
                }
            }
        }
        all
    }

    #[test]
    fn every_module_is_valid() {
        use wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};
        for source in modules() {
            let module = wgpu::naga::front::wgsl::parse_str(&source)
                .unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)));
            let mut validator = Validator::new(ValidationFlags::all(), Capabilities::MULTIVIEW);
            if let Err(error) = validator.validate(&module) {
                panic!("{}", error.emit_to_string(&source));
            }
        }
    }

    /// Chromium compiles WGSL with tint.
    #[test]
    #[ignore = "needs tint, a part of Dawn: cargo test -p tess-wgpu --lib -- --ignored"]
    fn tint_takes_every_module_on_request() {
        use std::io::Write;
        use std::process::{Command, Stdio};
        for source in modules() {
            let mut child = Command::new("tint")
                .args(["--input-format", "wgsl", "--format", "wgsl", "-"])
                .stdin(Stdio::piped())
                .stdout(Stdio::null())
                .stderr(Stdio::piped())
                .spawn()
                .unwrap_or_else(|error| panic!("tint, a part of Dawn, has to be there: {error}"));
            let mut input = child.stdin.take().expect("it is piped");
            input.write_all(source.as_bytes()).expect("tint reads");
            drop(input);
            let output = child.wait_with_output().expect("tint ends");
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            assert!(output.status.success(), "{said}\n{source}");
        }
    }
}
