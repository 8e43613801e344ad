//! Making a stage: checks, modules, pipelines.

use super::builder::{Render, StageBuilder};
use super::choices::{Factors, Overflow, Points};
use super::output::{StageOutput, Stored};
use super::room::Lull;
use super::wgsl::Declaration;
use super::{FactorPass, Fit, StageError, TessellationStage};
use super::{factor_pass, gl, modules, passes, source, wgsl};
use crate::Tessellator;
use crate::device::pipelines::PipelineKey;
use crate::device::{gpu, limits, pipeline};
use crate::error::{Error, checked};
use std::future::Future;
use std::pin::pin;
use std::sync::Arc;
use std::task::{Context, Poll, Waker};
use tess_gpu::{Access, Binding, Pull, Setup};
use wgpu::BufferUsages as Usage;

impl StageBuilder<'_> {
    /// Compiles everything and makes every buffer.
    ///
    /// # Errors
    /// - For the user's WGSL: [`StageError::Wgsl`], [`StageError::UnclearFragment`], and on OpenGL
    ///   [`StageError::FlatOfFirstVertex`].
    /// - For bind groups: [`StageError::TooManyBindGroups`].
    /// - For pipeline constants: [`StageError::NoSuchConstant`].
    /// - For a tessellator of another device: [`StageError::OtherDevice`].
    /// - If the device does not allow this many patches: [`Error::TooManyPatches`], [`StageError::TooManyFactors`],
    ///   [`Error::TooManyToPull`], [`Error::BufferTooLarge`], [`Error::OutOfMemory`].
    /// - If the device allows no stage at all: [`Error::LimitTooLow`].
    /// - For a buffer of factors: [`Error::FactorsTooShort`], [`Error::NotStorage`].
    /// - For groups of patches: [`Error::MisplacedGroup`].
    /// - Without a pipeline, unless points are stored: [`StageError::NothingStored`].
    /// - For what wgpu has against layouts or the render state: [`Error::Refused`].
    pub fn build(self, device: &wgpu::Device) -> Result<TessellationStage, Error> {
        now(stage(self, device))
    }

    /// The same where waiting is not possible: in a browser, the compiler answers later.
    ///
    /// # Errors
    /// As [`StageBuilder::build`].
    pub async fn build_async(self, device: &wgpu::Device) -> Result<TessellationStage, Error> {
        stage(self, device).await
    }
}

/// The result of `work` where nothing has to be waited for.
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
    check(&builder, device)?;
    let StageBuilder { patches, points, room, first_room, overflow, .. } = builder;
    let form = builder.form(device);
    let setup = form.setup;
    let mut tessellator = match builder.tessellator {
        Some(shared) if shared.device() == device => shared.clone(),
        Some(_) => return Err(StageError::OtherDevice.into()),
        None => Tessellator::new(device),
    };
    let usage = Usage::STORAGE | Usage::COPY_DST;
    let size = form.factor_bytes();
    let factors = gpu::empty(device, "factors of the stage", size, usage | Usage::COPY_SRC)?;
    let count = gpu::empty(device, "number of patches", 4, usage)?;
    let factor_pass = FactorPass::new(&builder, (form, &tessellator), [&factors, &count]).await?;
    let pulled = pulled_layout(&tessellator, setup, points)?;
    let pipeline = match builder.makes_pipeline {
        true => Some(render_pipeline(&builder, &tessellator, pulled.as_ref()).await?),
        false => None,
    };
    let capacity = form.first(room, first_room);
    let fit = (overflow == Overflow::Coarser)
        .then(|| Fit::new(&tessellator, setup, patches, &factors, capacity))
        .transpose()?;
    let output = StageOutput::new(
        &mut tessellator,
        form,
        (capacity, Stored::new(device, form, capacity)?),
        (&factors, &builder.groups),
        pulled.as_ref(),
    )?;
    Ok(TessellationStage {
        device: device.clone(),
        tessellator,
        form,
        room,
        lull: Lull::NEW,
        groups: builder.groups,
        begins: None,
        bind_groups: builder.bind_groups.into_iter().map(|group| (group, Vec::new())).collect(),
        factors,
        count,
        factor_pass,
        fit,
        pulled,
        pipeline,
        output,
        next: None,
        feedback: Default::default(),
        frame: 0,
    })
}

/// Refuses what the device or the stage cannot do.
fn check(builder: &StageBuilder<'_>, device: &wgpu::Device) -> Result<(), Error> {
    if !builder.makes_pipeline && builder.points != Points::Stored {
        return Err(StageError::NothingStored.into());
    }
    limits::check(device)?;
    let limits = device.limits();
    let has_own = matches!(builder.factors, Factors::Hull) || builder.points != Points::Stored;
    let (got, most) =
        (builder.own_group(), limits.max_bind_groups.saturating_sub(u32::from(has_own)));
    if got > most {
        return Err(StageError::TooManyBindGroups { got, most }.into());
    }
    let (needed, limit) =
        (builder.form(device).factor_bytes(), limits.max_storage_buffer_binding_size);
    if needed > limit {
        return Err(StageError::TooManyFactors { needed, limit }.into());
    }
    if let Factors::Buffer(given) = builder.factors {
        factor_pass::check(given, needed)?;
    }
    source::check_names(builder.source, builder.setup(), builder.points)?;
    let declared = wgsl::declarations(builder.source);
    let mut entries = if matches!(builder.factors, Factors::Hull) { vec!["hull"] } else { vec![] };
    if builder.makes_pipeline {
        entries.push("domain");
        entries.extend(check_fragment(builder, &declared)?);
    }
    check_groups(&wgsl::reached(&declared, &entries), builder.own_group())?;
    check_constants(&declared, builder.constants)
}

/// Refuses a binding in a group that the builder did not get.
fn check_groups(reached: &[Declaration<'_>], groups: u32) -> Result<(), Error> {
    // Ways to write it that are no number are left to wgpu.
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

/// Refuses a pipeline constant that is not there, and one without a value.
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

/// The fragment shader, if there are targets. Refuses one that is not there, or several of which none is named.
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

/// The bindings of a vertex shader that computes its points.
fn pulled_layout(
    tessellator: &Tessellator,
    setup: Setup,
    points: Points,
) -> Result<Option<wgpu::BindGroupLayout>, Error> {
    if points == Points::Stored {
        return Ok(None);
    }
    let entries = Pull { group: 0, first_binding: 0 }
        .bindings(setup)
        .map(|(number, resource)| {
            let binding = Binding(resource, Access::Read);
            pipeline::entry(number, binding, wgpu::ShaderStages::VERTEX)
        })
        .collect();
    tessellator.pipelines().layout("pulled", entries).map(Some)
}

/// The render pipeline, which stages of the same text and state share.
async fn render_pipeline(
    builder: &StageBuilder<'_>,
    tessellator: &Tessellator,
    pulled: Option<&wgpu::BindGroupLayout>,
) -> Result<Arc<wgpu::RenderPipeline>, Error> {
    let (user, device) = (builder.source, tessellator.device());
    let shader = builder.vertex_shader();
    let mut key = PipelineKey {
        text: format!("{shader}\n{:?}", (&builder.render, builder.setup(), builder.points)),
        entry_point: "tess_vertex",
        layouts: builder.layouts.clone(),
        constants: builder.constants_of(&wgsl::declarations(user)),
    };
    key.layouts.extend(pulled.cloned());
    if let Some(pipeline) = tessellator.pipelines().draws.find(&key) {
        return Ok(pipeline);
    }
    let module = modules::user_module(device, "domain", user, shader.clone()).await?;
    gl::check_flat_members(device, &shader)?;
    let layout = pipeline::layout(device, "tessellation stage", &key.layouts)?;
    let mut pipelines = tessellator.pipelines();
    let cache = pipelines.cache.as_ref();
    let made = new_render_pipeline(builder, device, (&module, &layout), (&key, cache))?;
    Ok(pipelines.draws.keep(key, made))
}

fn new_render_pipeline(
    builder: &StageBuilder<'_>,
    device: &wgpu::Device,
    (module, layout): (&wgpu::ShaderModule, &wgpu::PipelineLayout),
    (key, cache): (&PipelineKey, Option<&wgpu::PipelineCache>),
) -> Result<wgpu::RenderPipeline, Error> {
    let has_points = builder.points == Points::Stored;
    let attributes = gl::attributes(device);
    let buffer = wgpu::VertexBufferLayout {
        array_stride: if has_points { 8 } else { 0 },
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &attributes,
    };
    let buffers = [Some(buffer)];
    let buffers = if has_points || gl::is_gl(device) { &buffers[..] } else { &[] };
    let Render { fragment, targets, depth, multisample, primitive } = &builder.render;
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
        multiview_mask: None,
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
