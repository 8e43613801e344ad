//! A shader that pulls its points: it computes every point and primitive of a batch that stores
//! neither.

use crate::bare::Left;
use crate::common::device::Machine;
use crate::common::expected::Expected;
use crate::common::objects::{compute, dispatch, group, part, whole};
use std::collections::HashMap;
use tess_gpu::layout::Job;
use tess_gpu::{Pull, Setup, tables};
use wgpu::BufferUsages as Usage;

/// A user's shader: the points and primitives of a batch by their numbers, in four words each.
const USER: &str = "
@group(1) @binding(0) var<storage, read_write> answers: array<vec4<u32>>;
@group(1) @binding(1) var<uniform> asked: vec4<u32>;

@compute @workgroup_size(64)
fn ask(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < asked.x {
        let at = tess_point_at(id.x);
        answers[id.x] = vec4<u32>(at.x, bitcast<vec2<u32>>(tess_location(at.x, at.y)), 0u);
    }
    if id.x < asked.y {
        let at = tess_primitive_at(id.x);
        answers[asked.x + id.x] = vec4<u32>(at.x, tess_primitive(at.x, at.y));
    }
}
";

/// The most elements of a kind that are asked for, beginning with the first.
const MOST: u32 = 20_000;

/// The pipelines of the setups so far.
#[derive(Default)]
pub(crate) struct Pulling(HashMap<Setup, wgpu::ComputePipeline>);

impl Pulling {
    /// Compares the results of a shader that runs after a batch; returns the number of compared
    /// words.
    pub(crate) fn compare(
        &mut self,
        machine: &Machine,
        setup: Setup,
        left: &Left<'_>,
        expected: &Expected<'_>,
    ) -> Result<u64, String> {
        let begins = expected.begins();
        let asked = begins.last().expect("the end").map(|elements| elements.min(MOST));
        if asked == [0, 0] {
            return Ok(0);
        }
        let answers = self.ask(machine, setup, left, asked);
        let each = setup.indices_per_primitive() as usize;
        let [points, primitives] = expected.elements();
        let own = |(patch, words): &(u32, Vec<u32>)| [&[*patch], &words[..]].concat();
        let points = points.iter().take(asked[0] as usize).map(own);
        let primitives = primitives.iter().take(asked[1] as usize).map(own);
        let named =
            points.map(|own| ("point", own)).chain(primitives.map(|own| ("primitive", own)));
        for (number, ((what, expected), answer)) in named.zip(&answers).enumerate() {
            let observed = &answer[..if what == "point" { 3 } else { 1 + each }];
            if *observed != expected[..] {
                let number = if what == "point" { number } else { number - asked[0] as usize };
                return Err(format!(
                    "pulled {what} {number}, patch and words: observed {observed:x?}, expected {expected:x?}"
                ));
            }
        }
        Ok(4 * answers.len() as u64)
    }

    fn ask(
        &mut self,
        machine: &Machine,
        setup: Setup,
        left: &Left<'_>,
        asked: [u32; 2],
    ) -> Vec<[u32; 4]> {
        let device = &machine.gpu.device;
        let pipeline = self.0.entry(setup).or_insert_with(|| {
            let source = Pull { group: 0, first_binding: 0 }.source_for_drawing(setup) + USER;
            compute(device, source, "ask", &[])
        });
        let tables = machine.upload(&tables(setup.config.split), Usage::STORAGE);
        let [points, primitives] = asked;
        let answers = machine
            .upload(&vec![0; 4 * (points + primitives) as usize], Usage::STORAGE | Usage::COPY_SRC);
        let asked = machine.upload(&[points, primitives, 0, 0], Usage::UNIFORM);
        let entire = wgpu::Buffer::as_entire_binding;
        let job = part(left.jobs, 0, size_of::<Job>() as u64);
        let mut own = vec![(0, entire(left.topologies)), (1, entire(&tables)), (3, job)];
        own.extend([(4, entire(left.offsets)), (5, entire(left.tiles))]);
        if !setup.has_integer_factors() {
            own.push((2, entire(left.contexts)));
        }
        let layout = |number| pipeline.get_bind_group_layout(number);
        let groups = [
            &group(device, &layout(0), own),
            &group(device, &layout(1), whole([&answers, &asked])),
        ];
        let workgroups = points.max(primitives).div_ceil(64);
        dispatch(&machine.gpu, pipeline, &groups, workgroups).expect("the device finishes");
        machine.words(&answers).as_chunks().0.to_vec()
    }
}
