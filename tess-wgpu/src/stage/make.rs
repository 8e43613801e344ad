//! Making a stage: checks, modules, pipelines.

use super::builder::{Render, StageBuilder};
use super::choices::{Factors, Overflow, Points};
use super::output::{Output, Stored};
use super::{Fit, Origin, StageError, TessellationStage, gl, modules, origin, source, wgsl};
use crate::error::{Error, checked};
use crate::{Tessellator, gpu, limits, pipeline};
use std::future::Future;
use std::pin::pin;
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

/// What `work` gives where nothing has to be waited for.
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
    let StageBuilder { patches, points, room, overflow, .. } = builder;
    let form = builder.form(device);
    let setup = form.setup;
    let mut tessellator = Tessellator::new(device);
    let usage = Usage::STORAGE | Usage::COPY_DST;
    let size = form.factor_bytes();
    let factors = gpu::empty(device, "factors of the stage", size, usage | Usage::COPY_SRC)?;
    let count = gpu::empty(device, "number of patches", 4, usage)?;
    let origin = Origin::new(&builder, form, device, [&factors, &count]).await?;
    let pulled = pulled_layout(device, setup, points)?;
    let pipeline = match builder.makes_pipeline {
        true => Some(render_pipeline(&builder, device, pulled.as_ref()).await?),
        false => None,
    };
    let capacity = form.initial(room);
    let fit = (overflow == Overflow::Coarser)
        .then(|| Fit::new(device, setup, patches, &factors, capacity))
        .transpose()?;
    let output = Output::new(
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
        groups: builder.groups,
        bind_groups: builder.bind_groups,
        factors,
        count,
        origin,
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
        origin::check(given, needed)?;
    }
    source::check_names(builder.source, builder.setup(), builder.points)?;
    if builder.makes_pipeline { check_fragment(builder) } else { Ok(()) }
}

/// Refuses a fragment shader that is not there, or one of several that is not named.
fn check_fragment(builder: &StageBuilder<'_>) -> Result<(), Error> {
    let Render { fragment, targets, .. } = &builder.render;
    if targets.is_empty() {
        return Ok(());
    }
    let declared = wgsl::declarations(builder.source).into_iter();
    let found: Vec<_> = declared.filter(|one| one.is_fragment).map(|one| one.name).collect();
    let is_clear = match fragment {
        Some(name) => found.contains(name),
        None => found.len() == 1,
    };
    if is_clear {
        return Ok(());
    }
    let found = found.into_iter().map(str::to_owned).collect();
    Err(StageError::UnclearFragment { asked: fragment.map(str::to_owned), found }.into())
}

/// What a vertex shader binds that computes its points.
fn pulled_layout(
    device: &wgpu::Device,
    setup: Setup,
    points: Points,
) -> Result<Option<wgpu::BindGroupLayout>, Error> {
    if points == Points::Stored {
        return Ok(None);
    }
    let entries: Vec<_> = Pull { group: 0, first_binding: 0 }
        .bindings(setup)
        .map(|(number, resource)| {
            let binding = Binding(resource, Access::Read);
            pipeline::entry(number, binding, wgpu::ShaderStages::VERTEX)
        })
        .collect();
    let label = Some("pulled");
    checked(device, || {
        let entries = &entries;
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label, entries })
    })
    .map(Some)
}

async fn render_pipeline(
    builder: &StageBuilder<'_>,
    device: &wgpu::Device,
    pulled: Option<&wgpu::BindGroupLayout>,
) -> Result<wgpu::RenderPipeline, Error> {
    let StageBuilder { source: user, layouts, render, .. } = builder;
    let shader = builder.vertex_shader();
    let module = modules::user_module(device, "domain", user, shader.clone()).await?;
    gl::check_flat_members(device, &shader)?;
    let layouts: Vec<_> = layouts.iter().chain(pulled).map(Some).collect();
    let has_points = pulled.is_none();
    let attributes = gl::attributes(device);
    let buffer = wgpu::VertexBufferLayout {
        array_stride: if has_points { 8 } else { 0 },
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &attributes,
    };
    let buffers = [Some(buffer)];
    let buffers = if has_points || gl::is_gl(device) { &buffers[..] } else { &[] };
    let Render { fragment, targets, depth, multisample, primitive } = render;
    let layout = checked(device, || {
        device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("tessellation stage"),
            bind_group_layouts: &layouts,
            immediate_size: 0,
        })
    })?;
    let descriptor = wgpu::RenderPipelineDescriptor {
        label: Some("tessellation stage"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("tess_vertex"),
            compilation_options: Default::default(),
            buffers,
        },
        primitive: wgpu::PrimitiveState { topology: topology(builder.setup()), ..*primitive },
        depth_stencil: depth.clone(),
        multisample: *multisample,
        fragment: (!targets.is_empty()).then_some(wgpu::FragmentState {
            module: &module,
            entry_point: *fragment,
            compilation_options: Default::default(),
            targets,
        }),
        multiview_mask: None,
        cache: None,
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
