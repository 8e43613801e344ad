//! Any sequence of frames gives what the model says, on several stages of one device.
//!
//! The model of a stage is its factors, the place of its patches, its groups and the room that it says it has. From
//! these follow the factors that a frame is scaled to, its points and indices word for word, and its pixels.

use crate::calls::Call::{self, Frame, Give, Group, MakeRoom, Move, Use};
use crate::calls::{self, Count, Draw, Form, Source, Then, Wrong};
use crate::common::expected::Expected;
use crate::hold;
use crate::model::compare;
use crate::room::scaled;
use crate::scene::{self, FORMAT, PATCHES, Pixel, Scene};
use std::collections::{BTreeMap, VecDeque};
use tess_core::{Config, OutputPrimitive, Patch, PatchFactors};
use tess_gpu::layout::{Status, factor_words};
use tess_gpu::{Capacity, Setup};
use tess_wgpu::stage::{Factors, Feedback, Overflow, PatchCount, Points, Room, StageError};
use tess_wgpu::{Error, Gpu, TessellationStage};
use wgpu::BufferUsages as Usage;

/// A stage, what it reads, and the model's state of it.
struct Own {
    form: Form,
    scene: Scene,
    stage: TessellationStage,
    given: wgpu::Buffer,
    camera: wgpu::Buffer,
    cameras: wgpu::BindGroupLayout,
    patches: Vec<PatchFactors>,
    moved: u32,
    groups: Vec<u32>,
    next_groups: Vec<u32>,
    frame: u64,
    /// The latest frame that ran: its number and what it needed.
    heard: Option<(u64, Capacity)>,
    kept: VecDeque<(wgpu::CommandEncoder, u64, u32, Capacity)>,
}

struct World<'a> {
    gpu: &'a Gpu,
    forms: &'a [Form],
    stages: BTreeMap<usize, Own>,
    used: usize,
    words: u64,
}

/// The scene's WGSL with a grid that a uniform turns.
fn source(form: Form) -> String {
    let place = "return vec2<f32>(f32(number % 4u), f32(number / 4u));";
    let text = scene::source(form.domain);
    assert!(text.contains(place), "{text}");
    let moved = "let cell = (number + camera.x) % 8u;\n    return vec2<f32>(f32(cell % 4u), f32(cell / 4u));";
    text.replace(place, moved) + "\n@group(1) @binding(0) var<uniform> camera: vec4<u32>;\n"
}

impl Own {
    fn new(gpu: &Gpu, form: Form) -> Self {
        let config = Config::new(form.partitioning, OutputPrimitive::TriangleCw);
        let culled = vec![PatchFactors::uniform(form.domain, 0.0); PATCHES as usize];
        let scene = Scene::on(gpu.clone(), form.domain, config, culled.clone());
        let usage = Usage::STORAGE | Usage::COPY_DST;
        let words = factor_words(&culled);
        let given = gpu.upload("given", bytemuck::cast_slice(&words), usage).expect("room");
        let usage = Usage::UNIFORM | Usage::COPY_DST;
        let camera = gpu.upload("camera", &[0; 16], usage).expect("room");
        let ty = wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let cameras = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX,
                ty,
                count: None,
            }],
        });
        let source = source(form);
        let builder = TessellationStage::builder(&source, form.domain, config, PATCHES)
            .bind_group(&scene.layout, &scene.group)
            .bind_group(&cameras, &bind(gpu, &cameras, &camera))
            .target(FORMAT)
            .points(form.points)
            .room(form.room)
            .overflow(form.overflow)
            .order(form.order)
            .factors(match form.source {
                Source::Hull => Factors::Hull,
                Source::Host => Factors::Host,
                Source::Buffer => Factors::Buffer(&given),
            });
        let stage = scene.build(builder);
        Self {
            form,
            scene,
            stage,
            given,
            camera,
            cameras,
            patches: culled,
            moved: 0,
            groups: Vec::new(),
            next_groups: Vec::new(),
            frame: 0,
            heard: None,
            kept: VecDeque::new(),
        }
    }

    fn setup(&self) -> Setup {
        Setup { order: self.form.order, ..Setup::new(self.form.domain, self.scene.config) }
    }

    /// The factors of a frame of `count` patches; the others are culled.
    fn frame_patches(&self, count: u32) -> Vec<PatchFactors> {
        let mut patches = self.patches.clone();
        patches[count.min(PATCHES) as usize..].fill(PatchFactors::uniform(self.form.domain, 0.0));
        patches
    }

    fn needed(&self, patches: &[PatchFactors]) -> Capacity {
        let counts = patches.iter().map(|&patch| Patch::new(self.scene.config, patch).counts());
        counts.fold(Capacity::default(), |sum, own| Capacity {
            points: sum.points + own.points,
            primitives: sum.primitives + own.primitives,
        })
    }

    /// Bytes of a room.
    fn bytes(&self, room: Capacity) -> u64 {
        let point = if self.form.points == Points::Stored { 8 } else { 0 };
        let primitive = if self.form.points == Points::PullWithoutIndices { 0 } else { 12 };
        point * u64::from(room.points) + primitive * u64::from(room.primitives)
    }

    /// The room that a frame has, when the room was `before` and the stage has heard of all that ran.
    fn check_room(&self, before: Capacity) -> Result<(), String> {
        let now = self.stage.capacity();
        let (Room::Automatic { most_bytes }, Some((_, needed))) = (self.form.room, self.heard)
        else {
            return equal("room", now, before);
        };
        if fits(needed, before) {
            return equal("room", now, before);
        }
        let is_larger = now.points >= before.points && now.primitives >= before.primitives;
        if !is_larger || self.bytes(now) > most_bytes.max(self.bytes(before)) {
            return Err(format!("room {now:?} after {before:?}, {needed:?} were needed"));
        }
        let worst = Capacity::worst_case(self.setup(), PATCHES);
        let more = |needed: u32, worst: u32, before: u32| (needed * 5 / 4).min(worst).max(before);
        let wanted = Capacity {
            points: more(needed.points, worst.points, before.points),
            primitives: more(needed.primitives, worst.primitives, before.primitives),
        };
        let is_used = self.bytes(before) + 20 > most_bytes;
        if self.bytes(wanted) <= most_bytes && !is_used {
            return equal("room that grew", now, wanted);
        }
        Ok(())
    }

    /// Gives the patches other factors.
    fn give(&mut self, gpu: &Gpu, seed: u64, is_dropped: bool) {
        let patches = calls::factors(self.form.domain, seed);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        match self.form.source {
            Source::Hull => {
                let group = self.scene.bind(&patches);
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

    fn shift(&mut self, gpu: &Gpu, by: u32, is_bound: bool) {
        self.moved = by;
        let words = [by, 0, 0, 0];
        let bytes = bytemuck::bytes_of(&words);
        if is_bound {
            let usage = Usage::UNIFORM | Usage::COPY_DST;
            self.camera = gpu.upload("camera", bytes, usage).expect("room");
            let group = bind(gpu, &self.cameras, &self.camera);
            self.stage.set_bind_group(1, &group).expect("it goes with the layout");
        } else {
            gpu.queue.write_buffer(&self.camera, 0, bytes);
        }
    }

    fn regroup(&mut self, groups: u32) {
        let mut random = tess_verify::random::SplitMix64::new(groups.into());
        let mut begins: Vec<u32> = (0..groups).map(|_| random.below(PATCHES + 1)).collect();
        begins.sort_unstable();
        self.stage.set_groups(&begins).expect("they ascend");
        self.next_groups = begins;
    }

    /// Records a frame's compute passes, and follows the room.
    fn prepare(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        count: u32,
        from: Count,
    ) -> Result<(), String> {
        let before = self.stage.capacity();
        let prepared = match from {
            Count::Host => self.stage.prepare(encoder, count.min(PATCHES)),
            Count::Device => {
                // More than the stage was made for counts as that.
                let asked = if count < PATCHES { count } else { 1000 };
                let words = [7, asked];
                let bytes = bytemuck::bytes_of(&words);
                let buffer = self.scene.gpu.upload("count", bytes, Usage::COPY_SRC).expect("room");
                self.stage.prepare(encoder, PatchCount::Device(&buffer, 4))
            }
        };
        prepared.map_err(|error| error.to_string())?;
        self.groups.clone_from(&self.next_groups);
        self.frame += 1;
        self.check_room(before)
    }

    /// Compares what a frame left that ran last, but for its pixels. Returns the patches that are drawn.
    fn compare(&mut self, count: u32, words: &mut u64) -> Result<Vec<PatchFactors>, String> {
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
            let observed = self.words(buffer);
            *words += expected.len() as u64;
            if let Some(at) = (0..expected.len()).find(|&at| observed[at] != expected[at]) {
                let (observed, expected) = (observed[at], expected[at]);
                return Err(format!("{what}, word {at}: {observed:#x}, not {expected:#x}"));
            }
        }
        Ok(patches)
    }

    /// A scale fits, and one that is larger by a step of the ladder, 1.6 percent, does not.
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
    fn pixels(&self, patches: &[PatchFactors]) -> Vec<Option<Pixel>> {
        let mut placed = patches.to_vec();
        placed.rotate_right(self.moved as usize);
        let number = |[u, v, cell, is_drawn]: Pixel| match is_drawn {
            1 => [u, v, (cell + PATCHES - self.moved) % PATCHES, 1],
            _ => [0; 4],
        };
        self.scene.pixels(&placed).into_iter().map(|pixel| pixel.map(number)).collect()
    }
}

impl World<'_> {
    fn call(&mut self, call: Call) -> Result<(), String> {
        if let Use { stage } = call {
            self.used = stage % self.forms.len();
            return Ok(());
        }
        let (gpu, form) = (self.gpu, self.forms[self.used]);
        let own = self.stages.entry(self.used).or_insert_with(|| Own::new(gpu, form));
        match call {
            Use { .. } => {}
            Give { seed, is_dropped } => own.give(gpu, seed, is_dropped),
            Move { by, is_bound } => own.shift(gpu, by, is_bound),
            Group { groups } => own.regroup(groups),
            Frame { count, from, draw, then } => {
                return self.frame(count, from, draw, then);
            }
            Call::Late => {
                if let Some((encoder, frame, count, needed)) = own.kept.pop_front() {
                    gpu.run(encoder).map_err(|error| error.to_string())?;
                    if own.heard.is_none_or(|(heard, _)| heard <= frame) {
                        own.heard = Some((frame, needed));
                    }
                    let heard = own.stage.feedback().map(|feedback| feedback.frame);
                    return equal("frame of the feedback", heard, own.heard.map(|heard| heard.0))
                        .map_err(|wrong| format!("a late frame of {count} patches: {wrong}"));
                }
            }
            MakeRoom { count } => {
                let before = own.stage.capacity();
                let count = count.min(PATCHES);
                let found = own.stage.make_room(&gpu.queue, count);
                let found = found.map_err(|error| error.to_string())?;
                own.groups.clone_from(&own.next_groups);
                own.frame += 1;
                let needed = own.needed(&own.frame_patches(count));
                equal(
                    "needed",
                    [found.points, found.primitives],
                    [needed.points, needed.primitives].map(u64::from),
                )?;
                let known = own.heard;
                own.heard = Some((own.frame - 1, needed));
                // An earlier frame's room may have been made first.
                let is_first = known.is_none_or(|(_, known)| fits(known, before));
                return if is_first { own.check_room(before) } else { Ok(()) };
            }
            Call::Refused { wrong } => return own.refused(gpu, wrong),
        }
        Ok(())
    }

    fn frame(&mut self, count: u32, from: Count, draw: Draw, then: Then) -> Result<(), String> {
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let used = self.used;
        let with_others = matches!(draw, Draw::AmongOthers) && matches!(then, Then::Submit);
        for (&number, own) in &mut self.stages {
            if number == used || with_others {
                own.prepare(&mut encoder, count, from)
                    .map_err(|wrong| format!("stage {number}: {wrong}"))?;
            }
        }
        let own = self.stages.get_mut(&used).expect("it is built");
        match then {
            Then::Drop => return Ok(()),
            // More than a few would stop the feedback.
            Then::Keep if own.kept.len() < 2 => {
                let needed = own.needed(&own.frame_patches(count));
                own.kept.push_back((encoder, own.frame - 1, count, needed));
                return Ok(());
            }
            Then::Keep | Then::Submit => {}
        }
        let group = match draw {
            Draw::One(group) if !own.groups.is_empty() => Some(group as usize % own.groups.len()),
            _ => None,
        };
        let stage = &own.stage;
        let number = |group| u32::try_from(group).expect("a few");
        let observed = own.scene.draw_only(encoder, |pass| match group {
            None => stage.draw(pass),
            Some(group) => stage.draw_group(pass, number(group)).expect("it is there"),
        });
        let observed = observed.map_err(|error| error.to_string())?;
        let mut drawn = Vec::new();
        for (&number, own) in &mut self.stages {
            if number == used || with_others {
                let patches = own.compare(count, &mut self.words);
                let patches = patches.map_err(|wrong| format!("stage {number}: {wrong}"))?;
                drawn = if number == used { patches } else { drawn };
            }
        }
        let own = &self.stages[&used];
        if let Some(group) = group {
            let begin = own.groups[group] as usize;
            let end = own.groups.get(group + 1).map_or(drawn.len(), |&end| end as usize);
            let culled = PatchFactors::uniform(own.form.domain, 0.0);
            drawn[..begin].fill(culled);
            drawn[end..].fill(culled);
        }
        // More would take the model too long.
        if own.needed(&drawn).primitives < 2500 {
            self.words += observed.len() as u64;
            return compare(&observed, &own.pixels(&drawn));
        }
        Ok(())
    }
}

impl Own {
    fn refused(&mut self, gpu: &Gpu, wrong: Wrong) -> Result<(), String> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let stage = |error| Err(Error::Stage(error));
        let buffer = gpu.upload("short", &[0; 8], Usage::COPY_SRC).expect("room");
        let (observed, expected) = match wrong {
            Wrong::Count => (
                self.stage.prepare(&mut encoder, PATCHES + 1),
                stage(StageError::TooManyPatches { got: PATCHES + 1, most: PATCHES }),
            ),
            Wrong::Offset => (
                self.stage.prepare(&mut encoder, PatchCount::Device(&buffer, 8)),
                stage(StageError::BadPatchCount { offset: 8, size: 8, usage: Usage::COPY_SRC }),
            ),
            Wrong::Groups => (
                self.stage.set_groups(&[3, 2]),
                Err(Error::MisplacedGroup { group: 1, begin: 2, range: [3, PATCHES] }),
            ),
            Wrong::BindGroup => (
                self.stage.set_bind_group(2, &self.scene.group),
                stage(StageError::NoSuchBindGroup { number: 2, groups: 2 }),
            ),
            Wrong::Factors if self.form.source == Source::Host => {
                let got = PATCHES + 1;
                let patches = vec![PatchFactors::uniform(self.form.domain, 3.0); got as usize];
                (
                    self.stage.set_factors(&mut encoder, &patches),
                    stage(StageError::TooManyPatches { got, most: PATCHES }),
                )
            }
            Wrong::Factors => (
                self.stage.set_factors(&mut encoder, &self.patches),
                stage(StageError::NotHostFactors),
            ),
        };
        equal("refusal", observed, expected)
    }
}

fn bind(gpu: &Gpu, layout: &wgpu::BindGroupLayout, buffer: &wgpu::Buffer) -> wgpu::BindGroup {
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout,
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() }],
    })
}

const fn fits(needed: Capacity, room: Capacity) -> bool {
    needed.points <= room.points && needed.primitives <= room.primitives
}

fn equal<T: PartialEq + std::fmt::Debug>(
    what: &str,
    observed: T,
    expected: T,
) -> Result<(), String> {
    if observed == expected {
        return Ok(());
    }
    Err(format!("{what}: observed {observed:?}, expected {expected:?}"))
}

/// Does the calls on new stages; returns how many words and pixels were compared.
fn replayed(gpu: &Gpu, forms: &[Form], calls: &[Call]) -> Result<u64, String> {
    let mut world = World { gpu, forms, stages: BTreeMap::new(), used: 0, words: 0 };
    for (number, &call) in calls.iter().enumerate() {
        world.call(call).map_err(|wrong| {
            format!("call {number}, {call:?}, stage {:?}: {wrong}", forms[world.used])
        })?;
    }
    Ok(world.words)
}

/// The stages of this run.
fn forms() -> Vec<Form> {
    calls::forms(hold::long().is_some())
}

/// Does a sequence that was found. One of the long run needs its variable.
fn replay(calls: &[Call]) {
    let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
    replayed(&gpu, &forms(), calls).unwrap_or_else(|wrong| panic!("{wrong}"));
}

#[test]
fn any_sequence_of_frames_gives_the_models_pictures() {
    let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
    let forms = forms();
    let names = "calls::{Call::*, Count::*, Draw::*, Then::*, Wrong::*}";
    hold::hold(names, (25, 30), calls::call(forms.len()), |calls| replayed(&gpu, &forms, calls));
}

/// Groups wait for the frame in which the room grows.
#[test]
fn groups_and_room_change_in_one_frame() {
    let frame = Frame { count: 8, from: Count::Host, draw: Draw::One(1), then: Then::Submit };
    replay(&[
        Give { seed: 2, is_dropped: false },
        frame,
        Group { groups: 3 },
        Move { by: 3, is_bound: true },
        frame,
        Use { stage: 3 },
        Give { seed: 3, is_dropped: false },
        frame,
        MakeRoom { count: 5 },
        Frame { count: 3, from: Count::Device, draw: Draw::AmongOthers, then: Then::Submit },
    ]);
}
