//! The module for a user's own shaders, which computes any element from its number.

use crate::common::device::Machine;
use crate::common::objects::{compute, dispatch, group, whole};
use crate::common::patches::{all, covering};
use tess_core::{Patch, SplitOrder};
use tess_gpu::tables;
use tess_gpu::{Pull, Setup};
use tess_verify::generate::SplitMix64;
use tess_wgpu::Batch;
use wgpu::BufferUsages as Usage;

/// A user's shader, which asks for one point and one primitive of a patch.
const USER: &str = "
@group(0) @binding(0) var<storage, read> asked: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read_write> answers: array<u32>;

@compute @workgroup_size(64)
fn ask(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < arrayLength(&asked) {
        let question = asked[id.x];
        let point = tess_point(question.x, question.y);
        let location = bitcast<vec2<u32>>(tess_location(question.x, question.y));
        let primitive = tess_primitive(question.x, question.z);
        answers[7u * id.x] = point.x;
        answers[7u * id.x + 1u] = point.y;
        answers[7u * id.x + 2u] = location.x;
        answers[7u * id.x + 3u] = location.y;
        answers[7u * id.x + 4u] = primitive.x;
        answers[7u * id.x + 5u] = primitive.y;
        answers[7u * id.x + 6u] = primitive.z;
    }
}
";

#[test]
fn any_element_in_every_pair_of_options() {
    assert_any_element_in(covering());
}

#[test]
#[ignore = "slow: all 96 configurations"]
fn any_element_in_every_configuration() {
    assert_any_element_in(all());
}

fn assert_any_element_in(setups: Vec<Setup>) {
    let mut machine = Machine::open();
    let mut random = SplitMix64::new(7);
    for setup in setups {
        let Setup { domain, config, .. } = setup;
        let patches = crate::common::patches::random(domain, 100, &mut random);
        let batch = machine.counted(setup, &patches);
        let mut asked = Vec::new();
        let mut expected = Vec::new();
        for (number, &raw) in (0..).zip(&patches) {
            let patch = Patch::new(config, raw);
            let counts = patch.counts();
            for _ in 0..20 {
                let (i, t) = (random.below(counts.points), random.below(counts.primitives));
                let (Some(point), Some(primitive)) = (patch.point(i), patch.primitive(t)) else {
                    continue;
                };
                asked.extend([number, i, t, 0]);
                let [u, v] = point.to_f32().map(f32::to_bits);
                let mut indices = [0; 3];
                let own = primitive.indices();
                indices[..own.len()].copy_from_slice(own);
                expected.push(([point.u.to_bits(), point.v.to_bits(), u, v], indices, own.len()));
            }
        }
        let answers = ask(&machine, setup, &batch, &asked, config.split == SplitOrder::Centre);
        assert_eq!(answers.len(), 7 * expected.len(), "one answer each");
        for (answer, (point, indices, size)) in answers.chunks(7).zip(&expected) {
            assert_eq!(answer[..4], point[..], "{setup:?}");
            assert_eq!(answer[4..4 + size], indices[..*size], "{setup:?}");
        }
    }
}

/// The shader's answer to `asked`; with `is_apart` the buffers of the batch are copied into larger
/// ones first.
fn ask(machine: &Machine, setup: Setup, batch: &Batch, asked: &[u32], is_apart: bool) -> Vec<u32> {
    let source = Pull { group: 0, first_binding: 2 }.source(setup) + USER;
    let device = &machine.gpu.device;
    let pipeline = compute(device, source, "ask", &[]);
    let count = asked.len() as u64 / 4;
    let answers = machine.gpu.buffer("answers", 28 * count, Usage::STORAGE | Usage::COPY_SRC);
    let answers = answers.expect("the device has room");
    let tables = tables(setup.config.split);
    let upload = |words: &[u32]| machine.upload(words, Usage::STORAGE);
    let (asked, tables) = (upload(asked), upload(&tables));
    let own = [batch.topologies(), batch.contexts()];
    let larger = own.map(|buffer| upload(&[machine.words(buffer), vec![7; 12_345]].concat()));
    let [topologies, contexts] = if is_apart { [&larger[0], &larger[1]] } else { own };
    let mut buffers = vec![&asked, &answers, topologies, &tables];
    if !setup.has_integer_factors() {
        buffers.extend([contexts, batch.jobs()]);
    }
    let group = group(device, &pipeline.get_bind_group_layout(0), whole(buffers));
    let workgroups = u32::try_from(count.div_ceil(64)).expect("few");
    dispatch(&machine.gpu, &pipeline, &[&group], workgroups).expect("the device finishes");
    machine.words(&answers)
}
