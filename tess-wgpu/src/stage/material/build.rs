//! Builds a material: checks what the builder got, then makes the render pipeline.

use super::builder::{MaterialBuilder, Project, Render};
use super::{Material, Way};
use crate::device::pipeline;
use crate::device::pipelines::PipelineKey;
use crate::error::{Error, checked};
use crate::stage::build::now;
use crate::stage::own_group::{self, OwnLayout, Reads};
use crate::stage::source::VertexShader;
use crate::stage::user_groups::UserGroups;
use crate::stage::vertex::{Load, VertexLayout};
use crate::stage::wgsl::{self, Declaration};
use crate::stage::{Points, StageError, gl, loads, mistakes, modules, passes, source};
use std::sync::Arc;
use tess_gpu::Setup;

impl MaterialBuilder<'_> {
    /// Compiles the shaders.
    ///
    /// # Errors
    /// - For the user's WGSL: [`StageError::Wgsl`], [`StageError::UnclearFragment`], and on OpenGL
    ///   [`StageError::FlatOfFirstVertex`].
    /// - For bind groups and constants: [`StageError::TooManyBindGroups`],
    ///   [`StageError::NoSuchConstant`].
    /// - For [`Self::project`]: [`StageError::NoSuchFunction`], [`StageError::ProjectForgotten`].
    /// - For a `struct Vertex` other than the stage's, if points are evaluated:
    ///   [`StageError::OtherVertex`].
    /// - If wgpu refuses a layout or the render state: [`Error::Refused`].
    pub fn build(self) -> Result<Material, Error> {
        now(material(self))
    }

    /// Does the same as [`MaterialBuilder::build`] without blocking. A browser needs it, because
    /// its shader compiler answers later.
    ///
    /// # Errors
    /// As [`MaterialBuilder::build`].
    pub async fn build_async(self) -> Result<Material, Error> {
        material(self).await
    }
}

async fn material(builder: MaterialBuilder<'_>) -> Result<Material, Error> {
    let stage = builder.stage;
    let form = stage.form;
    let project = match builder.project {
        Project::Function(name) => Some(name),
        Project::Unset | Project::Nothing => None,
    };
    let (setup, points) = (form.setup, form.points);
    let (group, vertices) = (builder.program.own_group(), &stage.vertices);
    let load = Load::Attributes;
    let shader = VertexShader { setup, points, load, group, project, vertices };
    check(&builder, shader)?;
    let kind = kind(&builder)?;
    let ways = ways(&builder, shader).await?;
    Ok(Material {
        device: stage.tessellator.device().clone(),
        ways,
        bind_groups: UserGroups::new(builder.program.bind_groups),
        stage: stage.frames.downgrade(),
        _kind: kind,
    })
}

/// The ways to draw that the stage's frames need.
async fn ways(builder: &MaterialBuilder<'_>, shader: VertexShader<'_>) -> Result<Vec<Way>, Error> {
    let mut ways = Vec::new();
    for &load in loads::of(builder.stage, &builder.program) {
        match way(builder, VertexShader { load, ..shader }).await {
            Ok(way) => ways.push(way),
            // The user's bind groups may leave no storage buffer. What else is wrong, attributes
            // tell as well.
            Err(_) if load == Load::Storage => {}
            Err(error) => return Err(error),
        }
    }
    if ways.is_empty() {
        ways.push(way(builder, shader).await?);
    }
    Ok(ways)
}

/// Draws whose vertex shader loads as `shader` does.
async fn way(builder: &MaterialBuilder<'_>, shader: VertexShader<'_>) -> Result<Way, Error> {
    let (tessellator, load) = (&builder.stage.tessellator, shader.load);
    let reads = Reads { load, has_factors: builder.program.has_factors() };
    let own = OwnLayout::new(tessellator, builder.stage.form, reads)?;
    let pipeline = render_pipeline(builder, shader, own.as_ref()).await?;
    let most_bytes = match load {
        Load::Attributes => u64::MAX,
        Load::Storage => tessellator.device().limits().max_storage_buffer_binding_size,
    };
    Ok(Way { load, most_bytes, pipeline, own })
}

/// Refuses what the device or the stage cannot do.
fn check(builder: &MaterialBuilder<'_>, shader: VertexShader<'_>) -> Result<(), Error> {
    let MaterialBuilder { stage, program, render, .. } = builder;
    let points = stage.form.points;
    let has_own = own_group::is_needed(points, program.has_factors());
    program.check_bind_groups(&stage.tessellator.device().limits(), has_own)?;
    let declared = wgsl::declarations(program.source);
    let is_evaluated = points == Points::Evaluated;
    if is_evaluated && !VertexLayout::of(&declared)?.is_like(&stage.vertices) {
        return Err(StageError::OtherVertex.into());
    }
    source::check_names(program.source, &shader.own())?;
    let mut entries = Vec::new();
    entries.extend((!is_evaluated).then_some("domain"));
    entries.extend(shader.project);
    shader.project.map_or(Ok(()), |name| mistakes::check_project(&declared, name))?;
    if !is_evaluated {
        mistakes::check_domain(&declared)?;
    }
    mistakes::check_derivatives(&declared, &entries)?;
    entries.extend(check_fragment(render, &declared)?);
    program.check(&declared, &entries)
}

/// Counts the material among those of its stage that call a function of `project`, or among those
/// that do not. Refuses it if there are others of the other kind, which hold a reference each.
fn kind(builder: &MaterialBuilder<'_>) -> Result<Option<Arc<()>>, StageError> {
    let [plain, projected] = &builder.stage.kinds;
    let (own, other, function) = match builder.project {
        Project::Nothing => return Ok(None),
        Project::Unset => (plain, projected, None),
        Project::Function(name) => (projected, plain, Some(name.to_owned())),
    };
    if Arc::strong_count(other) > 1 {
        return Err(StageError::ProjectForgotten { function });
    }
    Ok(Some(Arc::clone(own)))
}

/// The fragment shader's name, or `None` if there are no targets. Refuses a name that the WGSL
/// lacks, and several fragment shaders if none is named.
fn check_fragment<'a>(
    render: &Render<'_>,
    declared: &[Declaration<'a>],
) -> Result<Option<&'a str>, Error> {
    let Render { fragment, targets, .. } = render;
    if targets.is_empty() {
        return Ok(None);
    }
    let found: Vec<_> = declared.iter().filter(|one| one.is_fragment).map(|one| one.name).collect();
    let chosen = match (fragment, &found[..]) {
        (Some(name), _) => found.iter().find(|one| *one == name),
        (None, [one]) => Some(one),
        _ => None,
    };
    if let Some(&chosen) = chosen {
        return Ok(Some(chosen));
    }
    let found = found.into_iter().map(str::to_owned).collect();
    Err(StageError::UnclearFragment { asked: fragment.map(str::to_owned), found }.into())
}

/// The render pipeline. Materials of one tessellator with the same text and state share it.
async fn render_pipeline(
    builder: &MaterialBuilder<'_>,
    shader: VertexShader<'_>,
    own: Option<&OwnLayout>,
) -> Result<Arc<wgpu::RenderPipeline>, Error> {
    let MaterialBuilder { stage, program, render, .. } = builder;
    let (tessellator, device) = (&stage.tessellator, stage.tessellator.device());
    let text = shader.with(program.source);
    let of_state = (render, stage.form.setup, stage.form.points);
    let key =
        program.key(format!("{text}\n{of_state:?}"), "tess_vertex", own.map(OwnLayout::layout));
    if let Some(pipeline) = tessellator.pipelines().draws.find(&key) {
        return Ok(pipeline);
    }
    let user = program.source;
    let module = modules::user_module(device, "domain", user, text.clone()).await?;
    gl::check_flat_members(device, &text)?;
    let own = own.map_or(0, OwnLayout::storage_buffers);
    let layout = pipeline::layout(device, "material", &key.layouts)
        .map_err(|error| mistakes::counted(error, "domain", own))?;
    let mut pipelines = tessellator.pipelines();
    let of = (&module, &layout);
    let cache = pipelines.cache.as_ref();
    let made = new_render_pipeline(builder, of, (&key, cache), shader.load);
    let made = made.map_err(|error| mistakes::explained(error, user, "VERTEX_FRAGMENT"))?;
    Ok(pipelines.draws.keep(key, made))
}

fn new_render_pipeline(
    MaterialBuilder { stage, render, .. }: &MaterialBuilder<'_>,
    (module, layout): (&wgpu::ShaderModule, &wgpu::PipelineLayout),
    (key, cache): (&PipelineKey, Option<&wgpu::PipelineCache>),
    load: Load,
) -> Result<wgpu::RenderPipeline, Error> {
    let (device, vertices) = (stage.tessellator.device(), &stage.vertices);
    let has_points = stage.form.points.are_written() && load == Load::Attributes;
    let own = if has_points { &vertices.attributes[..] } else { &[] };
    let attributes = gl::attributes(device, own);
    let buffer = wgpu::VertexBufferLayout {
        array_stride: if has_points { vertices.array_stride } else { 0 },
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &attributes,
    };
    let buffers = [Some(buffer)];
    let buffers = if has_points || gl::is_gl(device) { &buffers[..] } else { &[] };
    let Render { fragment, targets, depth, multisample, primitive, .. } = render;
    let constants = passes::constants(key);
    let options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    let descriptor = wgpu::RenderPipelineDescriptor {
        label: Some("material"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(key.entry_point),
            compilation_options: options.clone(),
            buffers,
        },
        primitive: wgpu::PrimitiveState { topology: topology(stage.form.setup), ..*primitive },
        depth_stencil: depth.clone(),
        multisample: *multisample,
        fragment: (!targets.is_empty()).then_some(wgpu::FragmentState {
            module,
            entry_point: *fragment,
            compilation_options: options,
            targets,
        }),
        multiview_mask: render.views,
        cache,
    };
    checked(device, || device.create_render_pipeline(&descriptor))
}

const fn topology(setup: Setup) -> wgpu::PrimitiveTopology {
    match setup.indices_per_primitive() {
        1 => wgpu::PrimitiveTopology::PointList,
        2 => wgpu::PrimitiveTopology::LineList,
        _ => wgpu::PrimitiveTopology::TriangleList,
    }
}
