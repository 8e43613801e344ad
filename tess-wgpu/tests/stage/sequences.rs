//! Any sequence of frames on several stages of one device equals the model.
//!
//! The model of a stage is its factors, the places of its patches, its groups and the room that it
//! reports. They determine the scaled factors of a frame, its points and indices word for word, and
//! its pixels.

mod calls;
mod own;
mod rooms;

use crate::hold::{self, equal};
use calls::StageCall::{self, Again, Frame, Give, Group, MakeRoom, Move, Rebuild, Use};
use calls::{Count, Draw, Source, StageForm, Then};
use own::Own;
use std::collections::BTreeMap;
use tess_core::{Domain, Order, Partitioning};
use tess_wgpu::stage::{Overflow, Points, Room};
use tess_wgpu::{Gpu, Tessellator};

struct World<'a> {
    gpu: &'a Gpu,
    shared: &'a Tessellator,
    forms: &'a [StageForm],
    stages: BTreeMap<usize, Own>,
    used: usize,
    words: u64,
}

impl World<'_> {
    fn call(&mut self, call: StageCall) -> Result<(), String> {
        if let Use { stage } = call {
            self.used = stage % self.forms.len();
            return Ok(());
        }
        let (gpu, form) = (self.gpu, self.forms[self.used]);
        let new = || Own::new((gpu, self.shared), form, 0, None);
        let own = self.stages.entry(self.used).or_insert_with(new);
        match call {
            Use { .. } => {}
            Rebuild { variant, is_alone: false } => {
                *own = Own::new((gpu, self.shared), form, variant, Some(own));
            }
            Rebuild { variant, is_alone: true } => {
                *own = Own::new((gpu, &Tessellator::new(&gpu.device)), form, variant, Some(own));
            }
            Give { seed, is_dropped } => own.give(gpu, seed, is_dropped),
            Move { by, is_bound } => own.shift(gpu, by, is_bound),
            Group { groups } => own.regroup(groups),
            StageCall::Repeat { instances } => own.repeat(instances),
            StageCall::Paint { shows_factors } => own.paint(gpu, shows_factors),
            Frame { count, from, draw, then } => {
                return self.frame(count, from, draw, then);
            }
            StageCall::Late => {
                if let Some((encoder, frame, count, recorded)) = own.kept.pop_front() {
                    own.drawn = None;
                    // A bind group is recorded, but factors in a buffer are read when the frame
                    // runs.
                    let needed = match own.form.source {
                        Source::Hull => recorded,
                        Source::Host | Source::Buffer => own.needed(&own.frame_patches(count)),
                    };
                    gpu.run(encoder).map_err(|error| error.to_string())?;
                    if own.heard.is_none_or(|(heard, _)| heard <= frame) {
                        own.heard = Some((frame, needed));
                    }
                    let heard = own.stage.feedback().map(|feedback| feedback.frame);
                    return equal("frame of the feedback", heard, own.heard.map(|heard| heard.0))
                        .map_err(|wrong| format!("a late frame of {count} patches: {wrong}"));
                }
            }
            MakeRoom { count } => return own.make_room(gpu, count),
            Again { draw } if own.drawn.is_some() => {
                let encoder = gpu.device.create_command_encoder(&Default::default());
                let (observed, group) = own.draw(encoder, draw)?;
                self.words += observed.len() as u64;
                return own.check(&observed, draw, group);
            }
            Again { .. } => {}
            StageCall::Refused { wrong } => return own.refused(gpu, wrong),
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
            // More kept encoders than a few would stop the feedback.
            Then::Keep if own.kept.len() < 2 => {
                let needed = own.needed(&own.frame_patches(count));
                own.kept.push_back((encoder, own.frame - 1, count, needed));
                return Ok(());
            }
            Then::Keep | Then::Submit => {}
        }
        let (observed, group) = own.draw(encoder, draw)?;
        for (&number, own) in &mut self.stages {
            if number == used || with_others {
                let patches = own.compare(count, &mut self.words);
                own.drawn = Some(patches.map_err(|wrong| format!("stage {number}: {wrong}"))?);
            }
        }
        self.words += observed.len() as u64;
        self.stages[&used].check(&observed, draw, group)
    }
}

/// Makes the calls on new stages; returns the number of compared words and pixels.
fn replayed(
    (gpu, shared): (&Gpu, &Tessellator),
    forms: &[StageForm],
    calls: &[StageCall],
) -> Result<u64, String> {
    let mut world = World { gpu, shared, forms, stages: BTreeMap::new(), used: 0, words: 0 };
    for (number, &call) in calls.iter().enumerate() {
        world.call(call).map_err(|wrong| {
            format!("call {number}, {call:?}, stage {:?}: {wrong}", forms[world.used])
        })?;
    }
    Ok(world.words)
}

/// The stages of this run.
fn forms() -> Vec<StageForm> {
    calls::forms(hold::long().is_some())
}

/// Runs a sequence that was found. A sequence of the long run needs its variable.
fn replay(calls: &[StageCall]) {
    replay_on(&forms(), calls);
}

/// Runs a sequence on stages of these forms.
fn replay_on(forms: &[StageForm], calls: &[StageCall]) {
    let (gpu, shared) = device();
    replayed((&gpu, &shared), forms, calls).unwrap_or_else(|wrong| panic!("{wrong}"));
}

/// A device, and the tessellator that its stages share.
fn device() -> (Gpu, Tessellator) {
    let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
    let shared = Tessellator::new(&gpu.device);
    (gpu, shared)
}

#[test]
#[ignore = "slow: sequences of frames"]
fn any_sequence_of_frames_gives_the_models_pictures() {
    let (gpu, shared) = device();
    let forms = forms();
    let names = "calls::{StageCall::*, Count::*, Draw::*, Then::*, WrongFrame::*}";
    hold::hold(names, (25, 30), calls::call(forms.len()), |calls| {
        replayed((&gpu, &shared), &forms, calls)
    });
}

/// A frame that runs late needs room for the factors that its buffer holds at that time.
#[test]
#[ignore = "slow: sequences of frames"]
fn a_late_frame_reads_later_factors() {
    let form = StageForm {
        domain: Domain::Quad,
        partitioning: Partitioning::Integer,
        points: Points::PullWithoutIndices,
        source: Source::Host,
        room: Room::Automatic { most_bytes: 40000 },
        overflow: Overflow::Coarser,
        order: Order::Specification,
    };
    let frame = |then| Frame { count: 8, from: Count::Host, draw: Draw::Everything, then };
    let calls = [
        frame(Then::Keep),
        Give { seed: 16031510608930659577, is_dropped: false },
        StageCall::Late,
        frame(Then::Submit),
    ];
    replay_on(&[form], &calls);
}

/// Groups wait for the frame in which the room grows.
#[test]
#[ignore = "slow: sequences of frames"]
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

/// A material that reads what no other does is made while other groups wait for their frame.
#[test]
#[ignore = "slow: many pipelines"]
fn a_material_is_made_between_groups_and_their_frame() {
    let frame = |draw| Frame { count: 8, from: Count::Host, draw, then: Then::Submit };
    let calls = |stage| {
        [
            Use { stage },
            Give { seed: 4, is_dropped: false },
            MakeRoom { count: 8 },
            // Patches 0, 1, 2, 3 to 5, and the rest: the second instance of each but the last is in
            // the lower row.
            Group { groups: 5 },
            StageCall::Paint { shows_factors: true },
            StageCall::Repeat { instances: 2 },
            frame(Draw::OneByAnother(2)),
            Again { draw: Draw::One(1) },
            Again { draw: Draw::Everything },
            // Factors that need more room, and other groups: both replace a drawn output.
            Give { seed: 7, is_dropped: false },
            frame(Draw::ByAnother),
            frame(Draw::ByAnother),
            Give { seed: 5, is_dropped: false },
            Group { groups: 3 },
            frame(Draw::ByAnother),
            Rebuild { variant: 2, is_alone: false },
            Give { seed: 8, is_dropped: false },
            frame(Draw::ByAnother),
        ]
    };
    replay(&(0..5).flat_map(calls).collect::<Vec<_>>());
}

/// Room that was given back grows again, also for a stage that replaces the first.
#[test]
#[ignore = "slow: sequences of frames"]
fn room_shrinks_and_grows_again() {
    let frame =
        |count| Frame { count, from: Count::Host, draw: Draw::Everything, then: Then::Submit };
    let use_and_fill =
        |seed| [Use { stage: 0 }, Give { seed, is_dropped: false }, MakeRoom { count: 8 }];
    let calls = [
        &use_and_fill(1)[..],
        &[frame(8), frame(0), frame(0), frame(0), frame(0), frame(8), frame(8)],
        &[Rebuild { variant: 3, is_alone: false }],
        &use_and_fill(2),
        &[frame(8), frame(0), frame(1), frame(0), frame(0), frame(8), frame(8)],
    ];
    replay(&calls.concat());
}
