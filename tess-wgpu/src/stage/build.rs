//! Builds a stage: checks what the builder got, then makes modules, pipelines and buffers.

use super::builder::{Render, StageBuilder};
use super::choices::{Factors, Overflow, Points, Room};
use super::evaluation::Evaluation;
use super::output::{StageOutput, Stored};
use super::own_group::{self, OwnGroups};
use super::room::{Form, Lull};
use super::vertex::VertexLayout;
use super::wgsl::Declaration;
use super::{FactorPass, Fit, StageError, TessellationStage, UserGroup, locked};
use super::{factor_pass, gl, mistakes, modules, passes, source, wgsl};
use crate::Tessellator;
use crate::device::pipelines::PipelineKey;
use crate::device::{gpu, limits, pipeline};
use crate::error::{Error, checked};
use std::future::Future;
use std::pin::pin;
use std::sync::{Arc, Mutex};
use std::task::{Context, Poll, Waker};
use tess_gpu::Setup;
use wgpu::BufferUsages as Usage;

impl StageBuilder<'_> {
    /// Compiles everything and makes every buffer.
    ///
    /// # Errors
    /// - For the user's WGSL: [`StageError::Wgsl`], [`StageError::UnclearFragment`], and on OpenGL
    ///   [`StageError::FlatOfFirstVertex`].
    /// - For bind groups: [`StageError::TooManyBindGroups`].
    /// - For names: [`StageError::NoSuchConstant`], [`StageError::NoSuchFunction`].
    /// - For another stage's output: [`StageError::OtherOutput`].
    /// - For a tessellator of another device: [`StageError::OtherDevice`].
    /// - If the device does not allow this many patches: [`Error::TooManyPatches`],
    ///   [`StageError::TooManyFactors`], [`Error::TooManyToPull`], [`Error::BufferTooLarge`],
    ///   [`Error::OutOfMemory`].
    /// - If the device cannot run any stage: [`Error::LimitTooLow`].
    /// - For a buffer of factors: [`Error::FactorsTooShort`], [`Error::NotStorage`].
    /// - For groups of patches: [`Error::MisplacedGroup`].
    /// - Without a pipeline, unless points are stored: [`StageError::NothingStored`].
    /// - If wgpu refuses a layout or the render state: [`Error::Refused`].
    pub fn build(self, device: &wgpu::Device) -> Result<TessellationStage, Error> {
        now(stage(self, device))
    }

    /// Does the same as [`StageBuilder::build`] without blocking. A browser needs it, because its
    /// shader compiler answers later.
    ///
    /// # Errors
    /// As [`StageBuilder::build`].
    pub async fn build_async(self, device: &wgpu::Device) -> Result<TessellationStage, Error> {
        stage(self, device).await
    }
}

/// The result of `work`, which must be ready at once; otherwise [`Error::Refused`].
fn now<T>(work: impl Future<Output = Result<T, Error>>) -> Result<T, Error> {
    match pin!(work).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(done) => done,
        Poll::Pending => Err(Error::Refused {
            reason: "the shader compiler answers later here; use build_async".to_owned(),
        }),
    }
}

async fn stage(
    builder: StageBuilder<'_>,
    device: &wgpu::Device,
) -> Result<TessellationStage, Error> {
    if let Some(other) = builder.output_of {
        return drawing_stage(builder, other, device).await;
    }
    let vertices = builder.vertex_layout()?;
    check(&builder, device, &vertices)?;
    let StageBuilder { patches, room, first_room, overflow, .. } = builder;
    let form = builder.form(device, &vertices);
    let setup = form.setup;
    let mut tessellator = tessellator_of(&builder, device)?;
    let usage = Usage::STORAGE | Usage::COPY_DST;
    let size = form.factor_bytes();
    let factors = gpu::empty(device, "factors of the stage", size, usage | Usage::COPY_SRC)?;
    let count = gpu::empty(device, "number of patches", 4, usage)?;
    let factor_pass = FactorPass::new(&builder, (form, &tessellator), [&factors, &count]).await?;
    let evaluation = Evaluation::new(&builder, &tessellator, &vertices).await?;
    let mut own = OwnGroups::default();
    let pipeline = pipeline_of(&builder, (&tessellator, form, &vertices), &mut own).await?;
    let capacity = form.first(room, first_room);
    let fit = (overflow == Overflow::Coarser)
        .then(|| Fit::new(&tessellator, setup, patches, &factors, capacity))
        .transpose()?;
    let output = StageOutput::new(
        &mut tessellator,
        form,
        (capacity, Stored::new(device, form, capacity)?),
        (&factors, &builder.groups),
        (evaluation.as_ref(), &own),
    )?;
    if matches!(room, Room::Automatic { .. }) {
        // The room changes between frames, which must not wait for a compiler.
        tessellator.compile(setup, &form.stages())?;
    }
    let has_factors = builder.has_factors();
    Ok(TessellationStage {
        device: device.clone(),
        tessellator,
        form,
        vertices,
        room,
        lull: Lull::NEW,
        groups: builder.groups,
        begins: None,
        instances: None,
        bind_groups: without_offsets(builder.bind_groups),
        factors,
        count,
        factor_pass: Some(factor_pass),
        fit,
        evaluation,
        has_factors,
        pipeline,
        output: Arc::new(Mutex::new(output)),
        next: None,
        feedback: Default::default(),
        frame: 0,
    })
}

/// The tessellator that the stage shares, or one of its own.
///
/// # Errors
/// [`StageError::OtherDevice`] if the shared one belongs to another device.
fn tessellator_of(
    builder: &StageBuilder<'_>,
    device: &wgpu::Device,
) -> Result<Tessellator, StageError> {
    match builder.tessellator {
        Some(shared) if shared.device() == device => Ok(shared.clone()),
        Some(_) => Err(StageError::OtherDevice),
        None => Ok(Tessellator::new(device)),
    }
}

/// Builds a stage that draws the output of another.
async fn drawing_stage(
    mut builder: StageBuilder<'_>,
    other: &TessellationStage,
    device: &wgpu::Device,
) -> Result<TessellationStage, Error> {
    if other.device != *device {
        return Err(StageError::OtherDevice.into());
    }
    let (form, tessellator) = (other.form, other.tessellator.clone());
    builder.points = form.points;
    builder.factors = Factors::Buffer(&other.factors);
    builder = builder.order(form.setup.order);
    let vertices = builder.vertex_layout()?;
    if builder.setup() != form.setup || !vertices.is_like(&other.vertices) {
        return Err(StageError::OtherOutput.into());
    }
    check(&builder, device, &vertices)?;
    let mut own = other.output().own;
    let pipeline = pipeline_of(&builder, (&tessellator, form, &vertices), &mut own).await?;
    let has_factors = builder.has_factors();
    {
        let mut output = locked(&other.output);
        output.own = own.with(&tessellator, form, (&output.batch, &other.factors))?;
    }
    Ok(TessellationStage {
        device: device.clone(),
        tessellator,
        form,
        vertices,
        room: other.room,
        lull: Lull::NEW,
        groups: Vec::new(),
        begins: None,
        instances: None,
        bind_groups: without_offsets(builder.bind_groups),
        factors: other.factors.clone(),
        count: other.count.clone(),
        factor_pass: None,
        fit: None,
        evaluation: None,
        has_factors,
        pipeline,
        output: Arc::clone(&other.output),
        next: None,
        feedback: Arc::clone(&other.feedback),
        frame: 0,
    })
}

fn without_offsets(groups: Vec<wgpu::BindGroup>) -> Vec<UserGroup> {
    groups.into_iter().map(|group| (group, Vec::new())).collect()
}

/// The render pipeline, or `None` if the caller makes it. Adds to `own` the layout of the bind
/// group that its draws need.
async fn pipeline_of(
    builder: &StageBuilder<'_>,
    (tessellator, form, vertices): (&Tessellator, Form, &VertexLayout),
    own: &mut OwnGroups,
) -> Result<Option<Arc<wgpu::RenderPipeline>>, Error> {
    if !builder.makes_pipeline {
        return Ok(None);
    }
    let own = own.ask(tessellator, form, builder.has_factors())?;
    render_pipeline(builder, tessellator, (vertices, own.as_ref())).await.map(Some)
}

/// Refuses what the device or the stage cannot do.
fn check(
    builder: &StageBuilder<'_>,
    device: &wgpu::Device,
    vertices: &VertexLayout,
) -> Result<(), Error> {
    let points = builder.points;
    if !builder.makes_pipeline && !points.are_written() {
        return Err(StageError::NothingStored.into());
    }
    limits::check(device)?;
    let limits = device.limits();
    let has_own = matches!(builder.factors, Factors::Hull)
        || points == Points::Evaluated
        || own_group::is_needed(points, builder.has_factors());
    let (got, most) =
        (builder.own_group(), limits.max_bind_groups.saturating_sub(u32::from(has_own)));
    if got > most {
        return Err(StageError::TooManyBindGroups { got, most }.into());
    }
    let (needed, limit) =
        (builder.form(device, vertices).factor_bytes(), limits.max_storage_buffer_binding_size);
    if needed > limit {
        return Err(StageError::TooManyFactors { needed, limit }.into());
    }
    if let (Factors::Buffer(given), None) = (builder.factors, builder.output_of) {
        factor_pass::check(given, needed)?;
    }
    check_vertices(vertices, &limits)?;
    source::check_names(builder.source, builder.shader(vertices))?;
    let declared = wgsl::declarations(builder.source);
    let entries = entries(builder, &declared)?;
    if entries.contains(&"hull") {
        mistakes::check_hull(&declared, builder.setup().domain)?;
    }
    check_groups(&wgsl::reached(&declared, &entries), builder.own_group())?;
    check_draws(builder, &declared)?;
    check_constants(&declared, builder.constants)
}

/// The names of the user's functions that the stage's shaders call.
fn entries<'a>(
    builder: &StageBuilder<'a>,
    declared: &[Declaration<'a>],
) -> Result<Vec<&'a str>, Error> {
    let mut entries = Vec::new();
    if matches!(builder.factors, Factors::Hull) {
        entries.push("hull");
    }
    let is_evaluated = builder.points == Points::Evaluated;
    let evaluates = is_evaluated && builder.output_of.is_none();
    if evaluates || builder.makes_pipeline && !is_evaluated {
        entries.push("domain");
    }
    if let Some(name) = builder.render.project {
        let is_it = |one: &&Declaration<'_>| one.keyword == "fn" && one.name == name;
        if !declared.iter().any(|one| is_it(&one)) {
            return Err(StageError::NoSuchFunction { name: name.to_owned() }.into());
        }
        entries.push(name);
    }
    if builder.makes_pipeline {
        entries.extend(check_fragment(builder, declared)?);
    }
    Ok(entries)
}

/// Refuses vertices that the device cannot load.
fn check_vertices(vertices: &VertexLayout, limits: &wgpu::Limits) -> Result<(), Error> {
    let locations = vertices.attributes.iter().map(|one| u64::from(one.shader_location) + 1);
    let needed = locations.max().unwrap_or(0);
    limits::at_least("max_vertex_attributes", needed, limits.max_vertex_attributes.into())?;
    let got = limits.max_vertex_buffer_array_stride.into();
    limits::at_least("max_vertex_buffer_array_stride", vertices.array_stride, got)
}

/// Refuses a `hull` that asks for a value of the draw, such as `tess_instance()`, because it runs
/// before the draws; and a `domain` likewise if points are evaluated.
fn check_draws(builder: &StageBuilder<'_>, declared: &[Declaration<'_>]) -> Result<(), Error> {
    let in_draws = ["tess_instance", "tess_view"];
    let in_hull: &[&str] = &["tess_factors", "tess_instance", "tess_view"];
    let is_evaluated = builder.points == Points::Evaluated && builder.output_of.is_none();
    let in_domain: &[&str] = if is_evaluated { &in_draws } else { &[] };
    for (function, refused) in [("hull", in_hull), ("domain", in_domain)] {
        for one in wgsl::reached(declared, &[function]) {
            if let Some(asked) = refused.iter().find(|name| source::uses(one.text, name)) {
                let message = format!(
                    "`{asked}` has no value in `{function}`, which runs before the draws; call it \
                     in {}",
                    if is_evaluated { "the function of `project`" } else { "`domain`" }
                );
                return Err(StageError::Wgsl { line: Some(one.line), message }.into());
            }
        }
    }
    Ok(())
}

/// Refuses a binding in a group that the builder did not get.
fn check_groups(reached: &[Declaration<'_>], groups: u32) -> Result<(), Error> {
    // wgpu checks a group that is not written as a plain number.
    let is_there = |one: &Declaration<'_>| {
        let group = one
            .attribute("group")
            .and_then(|group| group.trim_end_matches(['i', 'u']).parse::<u32>().ok());
        group.is_none_or(|group| group < groups)
    };
    match reached.iter().find(|one| !is_there(one)) {
        None => Ok(()),
        Some(one) => Err(StageError::Wgsl {
            line: Some(one.line),
            message: format!(
                "`{}` is in a bind group that the builder did not get: it got {groups}, numbered from 0; call \
                 `bind_group` for each, in order",
                one.name
            ),
        }
        .into()),
    }
}

/// Refuses a value for an `override` that the WGSL does not declare, and an `override` without a
/// value.
fn check_constants(declared: &[Declaration<'_>], given: &[(&str, f64)]) -> Result<(), Error> {
    let overrides: Vec<_> = declared.iter().filter(|one| one.keyword == "override").collect();
    let is_given = |name: &str| given.iter().any(|one| one.0 == name);
    for &(name, _) in given {
        if !overrides.iter().any(|one| one.name == name) {
            let found = overrides.iter().map(|one| one.name.to_owned()).collect();
            return Err(StageError::NoSuchConstant { name: name.to_owned(), found }.into());
        }
    }
    match overrides.iter().find(|one| one.has_no_value() && !is_given(one.name)) {
        None => Ok(()),
        Some(Declaration { name, line, .. }) => Err(StageError::Wgsl {
            line: Some(*line),
            message: format!("`{name}` has no value; give one with `constants`"),
        }
        .into()),
    }
}

/// The fragment shader's name, or `None` if there are no targets. Refuses a name that the WGSL
/// lacks, and several fragment shaders if none is named.
fn check_fragment<'a>(
    builder: &StageBuilder<'_>,
    declared: &[Declaration<'a>],
) -> Result<Option<&'a str>, Error> {
    let Render { fragment, targets, .. } = &builder.render;
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

/// The render pipeline. Stages of one tessellator with the same text and state share it.
async fn render_pipeline(
    builder: &StageBuilder<'_>,
    tessellator: &Tessellator,
    (vertices, own): (&VertexLayout, Option<&wgpu::BindGroupLayout>),
) -> Result<Arc<wgpu::RenderPipeline>, Error> {
    let (user, device) = (builder.source, tessellator.device());
    let shader = builder.shader(vertices).with(user);
    let mut key = PipelineKey {
        text: format!("{shader}\n{:?}", (&builder.render, builder.setup(), builder.points)),
        entry_point: "tess_vertex",
        layouts: builder.layouts.clone(),
        constants: builder.constants_of(&wgsl::declarations(user)),
    };
    key.layouts.extend(own.cloned());
    if let Some(pipeline) = tessellator.pipelines().draws.find(&key) {
        return Ok(pipeline);
    }
    let module = modules::user_module(device, "domain", user, shader.clone()).await?;
    gl::check_flat_members(device, &shader)?;
    let layout = pipeline::layout(device, "tessellation stage", &key.layouts)?;
    let mut pipelines = tessellator.pipelines();
    let of = (&module, &layout, vertices);
    let cache = pipelines.cache.as_ref();
    let made = new_render_pipeline(builder, device, of, (&key, cache));
    let made = made.map_err(|error| mistakes::explained(error, user, "VERTEX_FRAGMENT"))?;
    Ok(pipelines.draws.keep(key, made))
}

fn new_render_pipeline(
    builder: &StageBuilder<'_>,
    device: &wgpu::Device,
    (module, layout, vertices): (&wgpu::ShaderModule, &wgpu::PipelineLayout, &VertexLayout),
    (key, cache): (&PipelineKey, Option<&wgpu::PipelineCache>),
) -> Result<wgpu::RenderPipeline, Error> {
    let has_points = builder.points.are_written();
    let own = if has_points { &vertices.attributes[..] } else { &[] };
    let attributes = gl::attributes(device, own);
    let buffer = wgpu::VertexBufferLayout {
        array_stride: if has_points { vertices.array_stride } else { 0 },
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &attributes,
    };
    let buffers = [Some(buffer)];
    let buffers = if has_points || gl::is_gl(device) { &buffers[..] } else { &[] };
    let Render { fragment, targets, depth, multisample, primitive, .. } = &builder.render;
    let constants = passes::constants(key);
    let options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    let descriptor = wgpu::RenderPipelineDescriptor {
        label: Some("tessellation stage"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(key.entry_point),
            compilation_options: options.clone(),
            buffers,
        },
        primitive: wgpu::PrimitiveState { topology: topology(builder.setup()), ..*primitive },
        depth_stencil: depth.clone(),
        multisample: *multisample,
        fragment: (!targets.is_empty()).then_some(wgpu::FragmentState {
            module,
            entry_point: *fragment,
            compilation_options: options,
            targets,
        }),
        multiview_mask: builder.render.views,
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
