//! Builds a stage: checks what the builder got, then makes modules, pipelines and buffers.

use super::builder::StageBuilder;
use super::choices::{Factors, Overflow, Points, Room};
use super::evaluation::Evaluation;
use super::output::{StageOutput, Stored};
use super::room::{Form, Lull};
use super::user_groups::UserGroups;
use super::vertex::VertexLayout;
use super::wgsl::{self, Declaration};
use super::{FactorPass, Fit, Passes, StageError, TessellationStage};
use super::{factor_pass, mistakes, source};
use crate::Tessellator;
use crate::device::{gpu, limits};
use crate::error::Error;
use std::future::Future;
use std::pin::pin;
use std::task::{Context, Poll, Waker};
use tess_core::Domain;
use tess_gpu::Capacity;
use wgpu::BufferUsages as Usage;

impl StageBuilder<'_> {
    /// Compiles everything and makes every buffer.
    ///
    /// # Errors
    /// - For the user's WGSL: [`StageError::Wgsl`].
    /// - For bind groups and constants: [`StageError::TooManyBindGroups`],
    ///   [`StageError::NoSuchConstant`].
    /// - For a tessellator of another device: [`StageError::OtherDevice`].
    /// - If the device does not allow this many patches: [`Error::TooManyPatches`],
    ///   [`StageError::TooManyFactors`], [`Error::TooManyToPull`], [`Error::BufferTooLarge`],
    ///   [`Error::OutOfMemory`].
    /// - If the device cannot run any stage: [`Error::LimitTooLow`].
    /// - For a buffer of factors: [`Error::FactorsTooShort`], [`Error::NotStorage`].
    /// - For groups of patches: [`Error::MisplacedGroup`].
    /// - If wgpu refuses a layout: [`Error::Refused`].
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
pub(super) fn now<T>(work: impl Future<Output = Result<T, Error>>) -> Result<T, Error> {
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
    let vertices = builder.vertex_layout()?;
    check(&builder, device, &vertices)?;
    let StageBuilder { room, first_room, .. } = builder;
    let form = builder.form(device, &vertices);
    let mut tessellator = tessellator_of(&builder, device)?;
    let capacity = form.first(room, first_room);
    let passes = passes(&builder, (form, &tessellator), (capacity, &vertices)).await?;
    let output = StageOutput::new(
        &mut tessellator,
        form,
        (capacity, Stored::new(device, form, capacity)?),
        (&passes.factors, &builder.groups),
        passes.evaluation.as_ref(),
    )?;
    if matches!(room, Room::Automatic { .. }) {
        // The room changes between frames, which must not wait for a compiler.
        tessellator.compile(form.setup, &form.stages())?;
    }
    let stage = TessellationStage {
        tessellator,
        form,
        vertices,
        bind_groups: UserGroups::new(builder.program.bind_groups),
        passes,
        room,
        lull: Lull::NEW,
        groups: builder.groups,
        begins: None,
        instances: None,
        output,
        feedback: Default::default(),
        frames: Default::default(),
        kinds: Default::default(),
    };
    stage.warm_up()?;
    Ok(stage)
}

/// The compute passes before and after the batch, and the buffers that they share with it.
async fn passes(
    builder: &StageBuilder<'_>,
    (form, tessellator): (Form, &Tessellator),
    (room, vertices): (Capacity, &VertexLayout),
) -> Result<Passes, Error> {
    let device = tessellator.device();
    let usage = Usage::STORAGE | Usage::COPY_DST;
    let size = form.factor_bytes();
    let factors = gpu::empty(device, "factors of the stage", size, usage | Usage::COPY_SRC)?;
    let count = gpu::empty(device, "number of patches", 4, usage)?;
    let write = FactorPass::new(builder, (form, tessellator), [&factors, &count]).await?;
    let evaluation = Evaluation::new(builder, tessellator, vertices).await?;
    let fit = (builder.overflow == Overflow::Coarser)
        .then(|| Fit::new(tessellator, form.setup, builder.patches, &factors, room))
        .transpose()?;
    Ok(Passes { factors, count, write, fit, evaluation })
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

/// Refuses what the device or the stage cannot do.
fn check(
    builder: &StageBuilder<'_>,
    device: &wgpu::Device,
    vertices: &VertexLayout,
) -> Result<(), Error> {
    let StageBuilder { program, factors, points, .. } = builder;
    limits::check(device)?;
    let limits = device.limits();
    let mut entries = Vec::new();
    entries.extend(matches!(factors, Factors::Hull).then_some("hull"));
    entries.extend((*points == Points::Evaluated).then_some("domain"));
    program.check_bind_groups(&limits, !entries.is_empty())?;
    let (needed, limit) =
        (builder.form(device, vertices).factor_bytes(), limits.max_storage_buffer_binding_size);
    if needed > limit {
        return Err(StageError::TooManyFactors { needed, limit }.into());
    }
    if let Factors::Buffer(given) = factors {
        factor_pass::check(given, needed)?;
    }
    check_vertices(vertices, &limits)?;
    let declared = wgsl::declarations(program.source);
    let of = (program.source, builder.setup().domain, *points);
    check_text(&declared, of, entries.contains(&"hull"))?;
    program.check(&declared, &entries)
}

/// Refuses a text that the stage cannot run, as far as that is seen without a compiler and without
/// bind groups. `has_hull` is whether the stage runs `hull`.
pub(super) fn check_text(
    declared: &[Declaration<'_>],
    (text, domain, points): (&str, Domain, Points),
    has_hull: bool,
) -> Result<(), StageError> {
    source::check_names(text, &source::own_of_passes(domain))?;
    if has_hull {
        mistakes::check_hull(declared, domain)?;
    }
    // The passes need no `domain` unless points are evaluated, but a wrong one in their text would
    // be reported in the compiler's words.
    mistakes::check_domain(declared)?;
    mistakes::check_derivatives(declared, &["hull", "domain"])?;
    check_draws(declared, points)
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
fn check_draws(declared: &[Declaration<'_>], points: Points) -> Result<(), StageError> {
    let in_draws = ["tess_instance", "tess_view"];
    let in_hull: &[&str] = &["tess_factors", "tess_instance", "tess_view"];
    let is_evaluated = points == Points::Evaluated;
    let in_domain: &[&str] = if is_evaluated { &in_draws } else { &[] };
    for (function, refused) in [("hull", in_hull), ("domain", in_domain)] {
        for one in wgsl::reached(declared, &[function]) {
            if let Some(asked) = refused.iter().find(|name| source::uses(one.text, name)) {
                let message = format!(
                    "`{asked}` has no value in `{function}`, which runs before the draws; call it \
                     in {}",
                    if is_evaluated { "the function of `project`" } else { "`domain`" }
                );
                return Err(StageError::Wgsl { line: Some(one.line), message });
            }
        }
    }
    Ok(())
}
