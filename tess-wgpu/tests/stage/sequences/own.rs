//! A stage in a sequence of frames, and its model.

use super::calls::{self, Count, Draw, Source, StageForm, WrongFrame};
use crate::both::{Both, Builder};
use crate::common::expected::Expected;
use crate::common::objects::{self, group, whole};
use crate::hold::equal;
use crate::model::compare;
use crate::room::scaled;
use crate::scene::{self, FORMAT, PATCHES, Pixel, Scene};
use std::collections::VecDeque;
use tess_core::{Config, OutputPrimitive, Patch, PatchFactors};
use tess_gpu::layout::{Status, factor_words};
use tess_gpu::{Capacity, Setup};
use tess_wgpu::stage::{
    Factors, Feedback, Frame, Material, Overflow, PatchCount, Points, StageError,
};
use tess_wgpu::{Error, Gpu, TessellationStage, Tessellator};
use wgpu::BufferUsages as Usage;

/// The groups that a stage is made with.
const GROUPS: [u32; 4] = [0, 3, 3, 6];

/// A stage, the buffers that it reads, and the model's state.
pub(super) struct Own {
    pub(super) form: StageForm,
    variant: u32,
    /// The room at first.
    pub(super) first: Capacity,
    /// The frame since which little was needed, and the greatest needs since then.
    pub(super) lull: (u64, Capacity),
    pub(super) scene: Scene,
    pub(super) stage: Both,
    source: String,
    /// Draws the stage's frames with a mark of its own.
    other: Material,
    /// Whether it also shows the patches' first factors.
    shows_factors: bool,
    /// The number of instances of the prepared frame, and of the next.
    pub(super) instances: [u32; 2],
    /// The frame before the last.
    pub(super) old: Option<Frame>,
    pub(super) given: wgpu::Buffer,
    pub(super) camera: wgpu::Buffer,
    pub(super) cameras: wgpu::BindGroupLayout,
    pub(super) patches: Vec<PatchFactors>,
    pub(super) moved: u32,
    pub(super) groups: Vec<u32>,
    pub(super) next_groups: Vec<u32>,
    pub(super) frame: u64,
    /// The patches of the last prepared frame, if it ran.
    pub(super) drawn: Option<Vec<PatchFactors>>,
    /// The latest frame that ran: its number and its needs.
    pub(super) heard: Option<(u64, Capacity)>,
    pub(super) kept: VecDeque<(wgpu::CommandEncoder, u64, u32, Capacity)>,
}

/// The mark of a pixel that another material has drawn.
const OTHER: u32 = 7;

/// The frames of little output after which a stage gives room back.
pub(super) const PATIENCE: u64 = 2;

/// The scene's WGSL with a grid that a uniform shifts, and with instances of which each is drawn
/// one row lower. A variant exchanges patches in `hull`, or writes another number in the fragment
/// shader, or both.
fn source(form: StageForm, variant: u32) -> String {
    let place = "return vec2<f32>(f32(number % 4u), f32(number / 4u));";
    let text = scene::source(form.domain);
    assert!(text.contains(place), "{text}");
    let moved = "let cell = (number + camera.x) % 8u;\n    return vec2<f32>(f32(cell % 4u), f32(cell / 4u));";
    let (turn, mark) = (variant & 1, 1 + variant / 2);
    let text = text.replace("u * number;", "u * turned(number);");
    let text = text.replace("vertex.number, 1u);", &format!("vertex.number, {mark}u);"));
    let turned = format!("\nfn turned(number: u32) -> u32 {{\n    return number ^ {turn}u;\n}}\n");
    let lower = "fn lower(vertex: Vertex) -> Vertex {\n    var other = vertex;\n    \
                 other.position.y -= f32(tess_instance());\n    return other;\n}\n";
    let camera = "@group(1) @binding(0) var<uniform> camera: vec4<u32>;\n";
    text.replace(place, moved) + &turned + lower + camera
}

impl Own {
    /// A stage that replaces `old` has the same layouts, so that it can share all pipelines.
    pub(super) fn new(
        (gpu, shared): (&Gpu, &Tessellator),
        form: StageForm,
        variant: u32,
        old: Option<&Self>,
    ) -> Self {
        let config = Config::new(form.partitioning, OutputPrimitive::TriangleCw);
        let culled = vec![PatchFactors::uniform(form.domain, 0.0); PATCHES as usize];
        let mut scene = Scene::on(gpu.clone(), form.domain, config, culled.clone());
        if let Some(old) = old {
            scene.layout = old.scene.layout.clone();
            scene.group = scene.bind(&culled);
        }
        let usage = Usage::STORAGE | Usage::COPY_DST;
        let words = factor_words(&culled);
        let given = gpu.upload("given", bytemuck::cast_slice(&words), usage).expect("room");
        let usage = Usage::UNIFORM | Usage::COPY_DST;
        let camera = gpu.upload("camera", &[0; 16], usage).expect("room");
        let cameras = old.map_or_else(|| layout_of_cameras(gpu), |old| old.cameras.clone());
        let source = source(form, variant);
        let builder = Builder::new(&source, form.domain, config, PATCHES)
            .bind_group(&scene.layout, &scene.group)
            .bind_group(&cameras, &group(&gpu.device, &cameras, whole([&camera])))
            .target(FORMAT)
            .project("lower")
            .groups(&GROUPS)
            .tessellator(shared)
            .points(form.points)
            .room(form.room)
            .overflow(form.overflow)
            .order(form.order)
            .factors(match form.source {
                Source::Hull => Factors::Hull,
                Source::Host => Factors::Host,
                Source::Buffer => Factors::Buffer(&given),
            });
        let mut stage = scene.build(builder);
        stage.shrink_after(PATIENCE);
        let groups = [&scene.group, &group(&gpu.device, &cameras, whole([&camera]))];
        let layouts = [&scene.layout, &cameras];
        let other = material(&stage, (&source, variant, false), layouts, groups);
        Self {
            form,
            variant,
            first: stage.capacity(),
            lull: Default::default(),
            scene,
            stage,
            source,
            other,
            shows_factors: false,
            instances: [1; 2],
            old: None,
            given,
            camera,
            cameras,
            patches: culled,
            moved: 0,
            groups: GROUPS.to_vec(),
            next_groups: GROUPS.to_vec(),
            frame: 0,
            drawn: None,
            heard: None,
            kept: VecDeque::new(),
        }
    }

    pub(super) fn setup(&self) -> Setup {
        Setup { order: self.form.order, ..Setup::new(self.form.domain, self.scene.config) }
    }

    /// The factors of a frame of `count` patches; the others are culled.
    pub(super) fn frame_patches(&self, count: u32) -> Vec<PatchFactors> {
        let mut patches = self.patches.clone();
        patches[count.min(PATCHES) as usize..].fill(PatchFactors::uniform(self.form.domain, 0.0));
        patches
    }

    pub(super) fn needed(&self, patches: &[PatchFactors]) -> Capacity {
        let counts = patches.iter().map(|&patch| Patch::new(self.scene.config, patch).counts());
        counts.fold(Capacity::default(), |sum, own| Capacity {
            points: sum.points + own.points,
            primitives: sum.primitives + own.primitives,
        })
    }

    /// The bytes of a room.
    pub(super) fn bytes(&self, room: Capacity) -> u64 {
        let point = match self.form.points {
            Points::Stored => 8,
            // The scene's `Vertex` has 32 bytes.
            Points::Evaluated => 8 + 32,
            Points::Pull | Points::PullWithoutIndices => 0,
        };
        let primitive = if self.form.points == Points::PullWithoutIndices { 0 } else { 12 };
        point * u64::from(room.points) + primitive * u64::from(room.primitives)
    }

    /// Gives the patches other factors.
    pub(super) fn give(&mut self, gpu: &Gpu, seed: u64, is_dropped: bool) {
        let patches = calls::factors(self.form.domain, seed);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        match self.form.source {
            Source::Hull => {
                let turn = self.variant as usize & 1;
                let turned: Vec<_> = (0..patches.len()).map(|at| patches[at ^ turn]).collect();
                let group = self.scene.bind(&turned);
                self.stage.set_bind_group(0, &group).expect("it goes with the layout");
            }
            Source::Host => {
                self.stage.set_factors(&mut encoder, &patches).expect("they are the stage's");
                if is_dropped {
                    return;
                }
                gpu.run(encoder).expect("the device finishes");
            }
            Source::Buffer => {
                let words = factor_words(&patches);
                gpu.queue.write_buffer(&self.given, 0, bytemuck::cast_slice(&words));
            }
        }
        self.patches = patches;
    }

    pub(super) fn shift(&mut self, gpu: &Gpu, by: u32, is_bound: bool) {
        self.moved = by;
        let words = [by, 0, 0, 0];
        let bytes = bytemuck::bytes_of(&words);
        if is_bound {
            let usage = Usage::UNIFORM | Usage::COPY_DST;
            self.camera = gpu.upload("camera", bytes, usage).expect("room");
            let group = group(&gpu.device, &self.cameras, whole([&self.camera]));
            self.stage.set_bind_group(1, &group).expect("it goes with the layout");
            self.other.set_bind_group(1, &group).expect("it goes with the layout");
        } else {
            gpu.queue.write_buffer(&self.camera, 0, bytes);
        }
    }

    /// Makes the other material again, with factors in its pixels or without.
    pub(super) fn paint(&mut self, gpu: &Gpu, shows_factors: bool) {
        self.shows_factors = shows_factors;
        let camera = group(&gpu.device, &self.cameras, whole([&self.camera]));
        let of = (&self.source[..], self.variant, shows_factors);
        let layouts = [&self.scene.layout, &self.cameras];
        self.other = material(&self.stage, of, layouts, [&self.scene.group, &camera]);
    }

    pub(super) fn repeat(&mut self, instances: u32) {
        self.stage.set_instances(instances).expect("there is room");
        self.instances[1] = instances;
    }

    pub(super) fn regroup(&mut self, groups: u32) {
        let mut random = tess_verify::generate::SplitMix64::new(groups.into());
        let mut begins: Vec<u32> = (0..groups).map(|_| random.below(PATCHES + 1)).collect();
        begins.sort_unstable();
        self.stage.set_groups(&begins).expect("they ascend");
        self.next_groups = begins;
    }

    /// Records a frame's compute passes, and follows the room.
    pub(super) fn prepare(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        count: u32,
        from: Count,
    ) -> Result<(), String> {
        let before = self.stage.capacity();
        self.drawn = None;
        let old = self.stage.frame.clone();
        let prepared = match from {
            Count::Host => self.stage.prepare(encoder, count.min(PATCHES)),
            Count::Device => {
                // A number above the stage's most patches counts as that.
                let asked = if count < PATCHES { count } else { 1000 };
                let words = [7, asked];
                let bytes = bytemuck::bytes_of(&words);
                let buffer = self.scene.gpu.upload("count", bytes, Usage::COPY_SRC).expect("room");
                self.stage.prepare(encoder, PatchCount::Device(&buffer, 4))
            }
        };
        prepared.map_err(|error| error.to_string())?;
        self.old = old;
        self.instances[0] = self.instances[1];
        self.groups.clone_from(&self.next_groups);
        self.frame += 1;
        self.check_room(before)
    }

    /// Compares the results of the last frame that ran, except its pixels. Returns the drawn
    /// patches.
    pub(super) fn compare(
        &mut self,
        count: u32,
        words: &mut u64,
    ) -> Result<Vec<PatchFactors>, String> {
        let (room, asked) = (self.stage.capacity(), self.frame_patches(count));
        let needed = self.needed(&asked);
        self.heard = Some((self.frame - 1, needed));
        let feedback = self.stage.feedback();
        let Feedback { frame, points, primitives, drawn, scale } =
            feedback.ok_or_else(|| "nothing was heard of a frame that ran".to_owned())?;
        equal("frame of the feedback", frame, self.frame - 1)?;
        let expected = [needed.points, needed.primitives].map(u64::from);
        equal("needed", [points, primitives], expected)?;
        let is_scaled = self.form.overflow == Overflow::Coarser && !fits(needed, room);
        equal("whether it is coarser", scale < 1.0, is_scaled)?;
        let patches = if is_scaled { scaled(&asked, self.form.domain, scale) } else { asked };
        self.check_scale(scale, count, room)?;
        let factors: Vec<u32> = self.words(self.stage.factors());
        equal("factors", &factors[..], &factor_words(&patches)[..])?;
        let all = self.needed(&patches);
        equal("drawn", drawn, if fits(all, room) { all.primitives.into() } else { 0 })?;
        *words += factors.len() as u64;
        if !fits(all, room) {
            return Ok(vec![PatchFactors::uniform(self.form.domain, 0.0); PATCHES as usize]);
        }
        let expected = Expected::new(self.setup(), &patches);
        let (batch, stored) = self.stage.inside();
        let status = self.scene.gpu.read(batch.status(), 32).expect("the device answers");
        let status: Status = bytemuck::pod_read_unaligned(&status);
        equal("points of the batch", status.points(), all.points.into())?;
        for (what, (buffer, expected)) in
            ["points", "indices"].into_iter().zip(stored.into_iter().zip(expected.output()))
        {
            let Some(buffer) = buffer else { continue };
            let observed = self.words(&buffer);
            *words += expected.len() as u64;
            if let Some(at) = (0..expected.len()).find(|&at| observed[at] != expected[at]) {
                let (observed, expected) = (observed[at], expected[at]);
                return Err(format!("{what}, word {at}: {observed:#x}, not {expected:#x}"));
            }
        }
        Ok(patches)
    }

    /// Checks that a scale fits, and that one that is larger by a step of the ladder, 1.6 percent,
    /// does not.
    fn check_scale(&self, scale: f32, count: u32, room: Capacity) -> Result<(), String> {
        let asked = self.frame_patches(count);
        let at = |scale| self.needed(&scaled(&asked, self.form.domain, scale));
        let is_right = scale >= 1.0
            || fits(at(scale), room) && !fits(at(scale * 1.017), room)
            || !fits(at(1.0 / 64.0), room) && scale <= 1.0 / 64.0;
        if is_right { Ok(()) } else { Err(format!("scale {scale} in {room:?}")) }
    }

    fn words(&self, buffer: &wgpu::Buffer) -> Vec<u32> {
        let bytes = self.scene.gpu.read(buffer, buffer.size()).expect("the device answers");
        bytemuck::pod_collect_to_vec(&bytes)
    }

    /// The pixels of these patches in their places.
    fn pixels(&self, patches: &[PatchFactors], mark: u32) -> Vec<Option<Pixel>> {
        let mut placed = patches.to_vec();
        placed.rotate_right(self.moved as usize);
        let shown = |number: u32| match patches[number as usize].iter().next() {
            Some(first) if mark == OTHER && self.shows_factors => number ^ first.to_bits(),
            _ => number,
        };
        let number = |[u, v, cell, is_drawn]: Pixel| match is_drawn {
            1 => [u, v, shown((cell + PATCHES - self.moved) % PATCHES), mark],
            _ => [0; 4],
        };
        let pixels = self.scene.pixels(&placed).into_iter().map(|pixel| pixel.map(number));
        let mut all: Vec<_> = pixels.collect();
        let row = all.len() / 2;
        match self.instances[0] {
            0 => all.fill(Some([0; 4])),
            1 => {}
            // The second instance covers the lower row, wherever the upper one is covered.
            _ => {
                for at in 0..row {
                    if all[at] != Some([0; 4]) {
                        all[row + at] = all[at];
                    }
                }
            }
        }
        all
    }
}

impl Own {
    /// Draws the prepared frame: the pixels, and the drawn group if it was one.
    pub(super) fn draw(
        &self,
        encoder: wgpu::CommandEncoder,
        draw: Draw,
    ) -> Result<(Vec<Pixel>, Option<usize>), String> {
        let group = match draw {
            Draw::One(group) | Draw::OneByAnother(group) if !self.groups.is_empty() => {
                Some(group as usize % self.groups.len())
            }
            _ => None,
        };
        let number = |group| u32::try_from(group).expect("a few");
        let material = if draw.is_by_another() { &self.other } else { &self.stage.material };
        let frame = self.stage.frame();
        let observed = self.scene.draw_only(encoder, |pass| {
            let drawn = match group {
                None => material.draw(pass, frame),
                Some(group) => material.draw_group(pass, frame, number(group)),
            };
            drawn.expect("it is the last frame");
        });
        Ok((observed.map_err(|error| error.to_string())?, group))
    }

    /// Compares the pixels of the last drawn patches, or of a group of them.
    pub(super) fn check(
        &self,
        observed: &[Pixel],
        draw: Draw,
        group: Option<usize>,
    ) -> Result<(), String> {
        let Some(mut drawn) = self.drawn.clone() else { return Ok(()) };
        if let Some(group) = group {
            let begin = self.groups[group] as usize;
            let end = self.groups.get(group + 1).map_or(drawn.len(), |&end| end as usize);
            let culled = PatchFactors::uniform(self.form.domain, 0.0);
            drawn[..begin].fill(culled);
            drawn[end..].fill(culled);
        }
        // The model would take too long for more.
        let is_little = self.needed(&drawn).primitives < 2500;
        let mark = if draw.is_by_another() { OTHER } else { 1 + self.variant / 2 };
        if is_little { compare(observed, &self.pixels(&drawn, mark)) } else { Ok(()) }
    }

    pub(super) fn refused(&mut self, gpu: &Gpu, wrong: WrongFrame) -> Result<(), String> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let stage = |error| Err(Error::Stage(error));
        let buffer = gpu.upload("short", &[0; 8], Usage::COPY_SRC).expect("room");
        let (observed, expected) = match wrong {
            WrongFrame::Count => (
                self.stage.prepare(&mut encoder, PATCHES + 1),
                stage(StageError::TooManyPatches { got: PATCHES + 1, most: PATCHES }),
            ),
            WrongFrame::Offset => (
                self.stage.prepare(&mut encoder, PatchCount::Device(&buffer, 8)),
                stage(StageError::BadPatchCount { offset: 8, size: 8, usage: Usage::COPY_SRC }),
            ),
            WrongFrame::Groups => (
                self.stage.set_groups(&[3, 2]),
                Err(Error::MisplacedGroup { group: 1, begin: 2, range: [3, PATCHES] }),
            ),
            WrongFrame::BindGroup => (
                self.stage.set_bind_group(2, &self.scene.group),
                stage(StageError::NoSuchBindGroup { number: 2, groups: 2 }),
            ),
            WrongFrame::Old => {
                let Some(old) = &self.old else { return Ok(()) };
                let mut refused = Ok(());
                let drawn = self.scene.draw_only(encoder, |pass| {
                    refused = self.other.draw(pass, old);
                });
                drawn.map_err(|error| error.to_string())?;
                let (frame, last) = (old.number(), self.frame - 1);
                return equal("refusal", refused, stage(StageError::OldFrame { frame, last }));
            }
            WrongFrame::Factors if self.form.source == Source::Host => {
                let got = PATCHES + 1;
                let patches = vec![PatchFactors::uniform(self.form.domain, 3.0); got as usize];
                (
                    self.stage.set_factors(&mut encoder, &patches),
                    stage(StageError::TooManyPatches { got, most: PATCHES }),
                )
            }
            WrongFrame::Factors => (
                self.stage.set_factors(&mut encoder, &self.patches),
                stage(StageError::NotHostFactors),
            ),
        };
        equal("refusal", observed, expected)
    }
}

/// A material of this WGSL and variant, with another mark. It may show the patches' factors.
fn material(
    stage: &TessellationStage,
    (source, variant, shows_factors): (&str, u32, bool),
    layouts: [&wgpu::BindGroupLayout; 2],
    groups: [&wgpu::BindGroup; 2],
) -> Material {
    let number = match shows_factors {
        true => "vertex.number ^ bitcast<u32>(tess_factors(vertex.number).edges.x)",
        false => "vertex.number",
    };
    let (from, to) =
        (format!("vertex.number, {}u);", 1 + variant / 2), format!("{number}, {OTHER}u);"));
    assert!(source.contains(&from), "{source}");
    let marked = source.replace(&from, &to);
    let builder = stage.material(&marked).project("lower").target(FORMAT);
    let builder = builder.bind_group(layouts[0], groups[0]).bind_group(layouts[1], groups[1]);
    builder.build().unwrap_or_else(|error| panic!("{error}"))
}

fn layout_of_cameras(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let uniform = objects::buffer(wgpu::BufferBindingType::Uniform);
    let visibility = wgpu::ShaderStages::VERTEX | wgpu::ShaderStages::COMPUTE;
    objects::layout(&gpu.device, visibility, [uniform])
}

pub(super) const fn fits(needed: Capacity, room: Capacity) -> bool {
    needed.points <= room.points && needed.primitives <= room.primitives
}
