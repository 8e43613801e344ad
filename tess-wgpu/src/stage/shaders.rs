//! The WGSL of a stage's passes as data, for hosts that run the passes themselves.
//!
//! `tess shaders --stage` writes it to files, with a manifest that names the buffers. A host that
//! gets the user's WGSL only when it runs joins the parts ([`ShaderParts`]) as this crate does.

use super::builder::StageBuilder;
use super::choices::Points;
use super::source::{self, VertexShader};
use super::vertex::{Load, VertexLayout};
use super::{StageError, build, fit, wgsl};
use crate::error::Error;
use tess_gpu::Setup;

/// The complete shaders of a stage that depend on the user's WGSL: each begins with it, so that
/// lines of compilers' messages are the user's.
#[derive(Clone, Debug)]
pub struct UserShaders {
    /// The number of the stage's own bind group, which follows the user's.
    pub group: u32,
    /// The pass that runs `hull`, with the entry point `tess_hull`; `None` if the WGSL has no such
    /// function, so that the host gives the factors.
    pub hull: Option<String>,
    /// The pass that runs `domain` once for each point, with the entry point `tess_evaluate`;
    /// `None` unless points are evaluated.
    pub evaluate: Option<String>,
    /// The vertex shader, with the entry point `tess_vertex`, as
    /// [`StageBuilder::vertex_shader`](super::StageBuilder::vertex_shader) describes; `None` if
    /// the WGSL has no function `domain`.
    pub vertex: Option<String>,
    /// The layout of the vertex buffer.
    pub vertices: VertexLayout,
}

/// The shaders of a stage that do not depend on the user's WGSL.
#[derive(Clone, Debug)]
pub struct FixedShaders {
    /// The pass that copies factors of the host, with the entry point `copy_factors`.
    pub copy_factors: String,
    /// The passes that scale factors until the output fits. In order of their dispatches, the entry
    /// points are `count_whole`, `decide`, `count_coarse`, `count_fine` and `scale_factors`.
    pub fit: String,
    /// The scale of the factors at each step. The host writes it to the buffer `terms` after four
    /// words: the room for points and primitives, and the workgroups along x and y.
    pub ladder: Vec<f32>,
}

/// The stage's own text in parts. A module is the user's WGSL, a line feed, `shared`, a line feed,
/// the module's part, and then `factors` and the parts of `draws` whose function the user's WGSL
/// calls. `GROUP` stands for the number of the stage's own bind group.
#[derive(Clone, Debug)]
pub struct ShaderParts {
    /// Types, and helpers for factors, culling and heights.
    pub shared: String,
    /// The part of the hull's module.
    pub hull: String,
    /// The part of the module that evaluates points.
    pub evaluate: String,
    /// The part of the vertex shader where points are stored. ` BUILTINS` stands for further
    /// parameters: `, @builtin(BUILTIN) FUNCTION_now: u32` for each of `draws` that is called.
    /// `BEGIN` stands for `FUNCTION_value = FUNCTION_now;` for each of them, and `PROJECT` for the
    /// name of the user's function that every draw calls, or nothing.
    pub vertex_stored: String,
    /// The same where points are evaluated. `LOADED` stands for the parameters that load the
    /// members of `Vertex`, `@location(N) tess_I: TYPE` with commas between them, and `VERTEX` for
    /// `Vertex(tess_0, tess_1, ...)`. The first must be replaced first.
    pub vertex_evaluated: String,
    /// The same where points are pulled: with an index buffer, and without one. The bindings are
    /// those of [`tess_gpu::Pull`], from 0 on.
    pub vertex_pulled: [String; 2],
    /// The function `tess_factors` with its binding.
    pub factors: String,
    /// Functions that return a value of the draw: the function, the builtin, and the part.
    pub draws: Vec<[String; 3]>,
}

impl StageBuilder<'_> {
    /// The stage's shaders for a host that runs its passes itself. No device is needed.
    ///
    /// # Errors
    /// - [`StageError::Wgsl`] for the user's WGSL, as far as this crate checks it without a
    ///   compiler.
    /// - [`StageError::NothingStored`] if points are pulled.
    /// - [`StageError::NoSuchFunction`] for `project`.
    pub fn user_shaders(&self, project: Option<&str>) -> Result<UserShaders, Error> {
        let (user, setup, points) = (self.program.source, self.setup(), self.points);
        if !points.are_written() {
            return Err(StageError::NothingStored.into());
        }
        let declared = wgsl::declarations(user);
        let group = user_groups(&declared);
        let has = |name| declared.iter().any(|one| one.keyword == "fn" && one.name == name);
        build::check_text(&declared, (user, setup.domain, points), has("hull"))?;
        project.map_or(Ok(()), |name| super::mistakes::check_project(&declared, name))?;
        let is_evaluated = points == Points::Evaluated;
        if is_evaluated && !has("domain") {
            let message = "there is no function `domain`".to_owned();
            return Err(StageError::Wgsl { line: None, message }.into());
        }
        let vertices = self.vertex_layout()?;
        let load = Load::Attributes;
        let shader = VertexShader { setup, points, load, group, project, vertices: &vertices };
        Ok(UserShaders {
            group,
            hull: has("hull").then(|| source::of_hull(user, setup.domain, group)),
            evaluate: is_evaluated.then(|| source::of_evaluation(user, setup.domain, group)),
            vertex: has("domain").then(|| shader.with(user)),
            vertices,
        })
    }
}

/// The number of bind groups that a text numbers.
fn user_groups(declared: &[wgsl::Declaration<'_>]) -> u32 {
    let number = |one: &wgsl::Declaration<'_>| -> Option<u32> {
        one.attribute("group")?.trim_end_matches(['i', 'u']).parse().ok()
    };
    declared.iter().filter_map(number).max().map_or(0, |last| last.saturating_add(1))
}

impl FixedShaders {
    /// The shaders of a setup.
    #[must_use]
    pub fn new(setup: Setup) -> Self {
        let copy_factors = source::of_copying(setup);
        Self { copy_factors, fit: fit::source(setup), ladder: fit::ladder() }
    }
}

impl ShaderParts {
    /// The parts of a setup.
    #[must_use]
    pub fn new(setup: Setup) -> Self {
        let domain = setup.domain;
        let [vertex_stored, vertex_evaluated] = source::vertex_parts();
        let draws = source::OF_DRAWS.map(|(function, builtin)| {
            [function, builtin, &source::draw_part(function)].map(str::to_owned)
        });
        Self {
            shared: source::shared(),
            hull: source::hull_part(domain),
            evaluate: source::evaluation_part(),
            vertex_stored,
            vertex_evaluated,
            vertex_pulled: source::pulled_parts(setup),
            factors: source::factors_part(domain),
            draws: draws.into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TessellationStage;
    use tess_core::{Config, Domain, OutputPrimitive, Partitioning};

    const WGSL: &str = "@group(1) @binding(0) var<uniform> eye: vec4f;\n\
        struct Vertex { @builtin(position) position: vec4f, @location(0) uv: vec2f }\n\
        fn hull(number: u32) -> QuadFactors { return tess_quad_factors(eye); }\n\
        fn domain(number: u32, uv: vec2f) -> Vertex { return Vertex(eye, uv); }\n\
        fn seen(vertex: Vertex) -> Vertex {\n\
            return Vertex(vertex.position * tess_factors(tess_instance()).inside.x, vertex.uv);\n\
        }\n";

    fn builder(text: &str) -> StageBuilder<'_> {
        let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
        TessellationStage::builder(text, Domain::Quad, config, 1)
    }

    /// What the documentation of [`ShaderParts`] says, done by hand, gives the crate's shaders.
    #[test]
    fn parts_join_to_the_shaders() {
        let parts = ShaderParts::new(builder(WGSL).setup());
        let [instance, builtin, of_instance] = &parts.draws[0];
        let end = parts.factors.clone() + of_instance;
        let joined = |part: &str| {
            let own = format!("{part}{end}").replace("GROUP", "2");
            format!("{WGSL}\n{}\n{own}", parts.shared)
        };
        let vertex = |part: &str| {
            let part = part
                .replace("LOADED", "@location(1) tess_0: vec4<f32>, @location(0) tess_1: vec2<f32>")
                .replace("VERTEX", "Vertex(tess_0, tess_1)")
                .replace(" BUILTINS", &format!(", @builtin({builtin}) {instance}_now: u32"))
                .replace("BEGIN", &format!("{instance}_value = {instance}_now;"))
                .replace("PROJECT", "seen");
            joined(&part)
        };
        for points in [Points::Stored, Points::Evaluated] {
            let made =
                builder(WGSL).points(points).user_shaders(Some("seen")).expect("it is sound");
            assert_eq!(made.group, 2, "after the user's");
            assert_eq!(made.hull, Some(joined(&parts.hull)), "the hull's module");
            let part = match points {
                Points::Stored => &parts.vertex_stored,
                _ => &parts.vertex_evaluated,
            };
            assert_eq!(made.vertex, Some(vertex(part)), "the vertex shader, {points:?}");
            let evaluate = (points == Points::Evaluated).then(|| joined(&parts.evaluate));
            assert_eq!(made.evaluate, evaluate, "{points:?}");
        }
    }

    #[test]
    fn wrong_text_is_refused_with_its_line() {
        let told = |text: &str, points| {
            let made = builder(text).points(points).user_shaders(None);
            made.expect_err("it is wrong").to_string()
        };
        let wrong = WGSL.replace("-> QuadFactors", "-> TriFactors");
        assert!(told(&wrong, Points::Stored).contains("line 3 of your WGSL"), "the hull");
        let none = WGSL.replace("fn domain", "fn dominion");
        assert!(told(&none, Points::Evaluated).contains("no function `domain`"), "evaluated");
        assert!(builder(&none).user_shaders(None).is_ok_and(|made| made.vertex.is_none()), "fine");
        assert!(builder(WGSL).user_shaders(Some("see")).is_err(), "no such function");
        assert!(builder(WGSL).points(Points::Pull).user_shaders(None).is_err(), "pulled");
    }
}
