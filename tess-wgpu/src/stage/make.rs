//! Making a stage: checks, modules, pipelines.

use super::builder::{Points, Render};
use super::output::Output;
use super::room::{Form, Overflow};
use super::{
    Factors, Fit, Origin, StageBuilder, StageError, TessellationStage, gl, origin, source,
};
use crate::error::{Error, checked};
use crate::{Tessellator, gpu};
use std::future::Future;
use std::pin::pin;
use std::task::{Context, Poll, Waker};
use tess_gpu::{Order, Setup};
use wgpu::BufferUsages as Usage;

/// What `work` gives where nothing has to be waited for.
pub(super) fn now<T>(work: impl Future<Output = Result<T, Error>>) -> Result<T, Error> {
    match pin!(work).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(done) => done,
        Poll::Pending => Err(Error::Refused {
            reason: "the shader compiler answers later here; use build_async".to_owned(),
        }),
    }
}

pub(super) async fn stage(
    mut builder: StageBuilder<'_>,
    device: &wgpu::Device,
) -> Result<TessellationStage, Error> {
    check(&builder, device)?;
    if builder.points == Points::PullWithoutIndices {
        builder.setup.order = Order::Specification;
    }
    let StageBuilder { setup, patches, points, room, overflow, .. } = builder;
    let mut tessellator = Tessellator::new(device);
    let usage = Usage::STORAGE | Usage::COPY_DST;
    let size = factor_bytes(setup, patches);
    let factors = gpu::empty(device, "factors of the stage", size, usage)?;
    let count = gpu::empty(device, "number of patches", 4, usage)?;
    let origin = Origin::new(&builder, device, [&factors, &count]).await?;
    let pulled = pulled_layout(device, setup, points)?;
    let pipeline = match builder.makes_pipeline {
        true => Some(render_pipeline(&builder, device, pulled.as_ref()).await?),
        false => None,
    };
    let buffer_limit = device.limits().max_buffer_size;
    let form = Form { setup, points, patches, buffer_limit };
    let capacity = form.initial(room);
    let fit = (overflow == Overflow::Coarser)
        .then(|| Fit::new(device, setup, patches, &factors, capacity))
        .transpose()?;
    let output = Output::new(
        &mut tessellator,
        form,
        capacity,
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
        feedback: Default::default(),
        frame: 0,
    })
}

/// Refuses what the device cannot do.
fn check(builder: &StageBuilder<'_>, device: &wgpu::Device) -> Result<(), Error> {
    if !builder.makes_pipeline && builder.points != Points::Stored {
        return Err(StageError::NothingStored.into());
    }
    let limits = device.limits();
    let groups = builder.own_group().saturating_add(1);
    for (limit, needed, got) in [
        ("max_compute_workgroups_per_dimension", 1, limits.max_compute_workgroups_per_dimension),
        ("max_storage_buffers_per_shader_stage", 8, limits.max_storage_buffers_per_shader_stage),
        ("max_bind_groups", groups, limits.max_bind_groups),
    ] {
        if got < needed {
            return Err(StageError::LimitTooLow { limit, needed, got }.into());
        }
    }
    let (needed, limit) =
        (factor_bytes(builder.setup, builder.patches), limits.max_storage_buffer_binding_size);
    if needed > limit {
        return Err(StageError::TooManyFactors { needed, limit }.into());
    }
    match builder.factors {
        Factors::Buffer(given) => origin::check(given, needed),
        _ => Ok(()),
    }
}

pub(super) fn factor_bytes(setup: Setup, patches: u32) -> u64 {
    4 * u64::from(setup.factors()) * u64::from(patches)
}

/// A module that begins with the user's text; what is wrong with it is said with their line.
pub(super) async fn user_module(
    device: &wgpu::Device,
    label: &str,
    user: &str,
    joined: String,
) -> Result<wgpu::ShaderModule, Error> {
    let mut made = None;
    let outcome = checked(device, || {
        made = Some(device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(joined.into()),
        }));
    });
    let Some(module) = made else {
        return Err(Error::Refused { reason: "no shader module was made".to_owned() });
    };
    let info = module.get_compilation_info().await;
    let is_error = |message: &&wgpu::CompilationMessage| {
        message.message_type == wgpu::CompilationMessageType::Error
    };
    if let Some(error) = info.messages.iter().find(is_error) {
        let line = error.location.map(|location| location.line_number);
        let line = line.filter(|&line| (1..=source::lines(user)).contains(&line));
        return Err(StageError::Wgsl { line, message: headline(&error.message) }.into());
    }
    outcome?;
    Ok(module)
}

/// What is wrong, without the excerpt of the source: the first line of a compiler's report, and naga's
/// reasons, which begin with `= `.
fn headline(report: &str) -> String {
    let from = report.find("error: ").map_or(report, |at| &report[at + "error: ".len()..]);
    let mut lines = from.trim().lines().map(str::trim);
    let first = lines.next().unwrap_or_default();
    let reasons = lines.filter_map(|line| line.strip_prefix("= "));
    [first].into_iter().chain(reasons).collect::<Vec<_>>().join(": ")
}

/// What a vertex shader binds that computes its points, as `Pull::source_for_drawing` numbers it.
fn pulled_layout(
    device: &wgpu::Device,
    setup: Setup,
    points: Points,
) -> Result<Option<wgpu::BindGroupLayout>, Error> {
    if points == Points::Stored {
        return Ok(None);
    }
    let entry = |binding| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX,
        ty: wgpu::BindingType::Buffer {
            ty: match binding {
                3 => wgpu::BufferBindingType::Uniform,
                _ => wgpu::BufferBindingType::Storage { read_only: true },
            },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let has = |&binding: &u32| binding != 2 || !setup.has_integer_factors();
    let entries: Vec<_> = (0..6).filter(has).map(entry).collect();
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
    let StageBuilder { source: user, setup, layouts, render, .. } = builder;
    let shader = builder.vertex_shader();
    let module = user_module(device, "draw", user, shader.clone()).await?;
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
        primitive: wgpu::PrimitiveState { topology: topology(*setup), ..*primitive },
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
