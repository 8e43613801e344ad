//! Mistakes of callers and refusals of devices: errors, no panics.

use crate::common::device::{Machine, limited};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_gpu::{Resource, Setup};
use tess_wgpu::{Error, Gpu, Outputs, Tessellator};
use wgpu::BufferUsages as Usage;

fn setup(domain: Domain) -> Setup {
    Setup::new(domain, Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw))
}

fn quads(factor: f32, count: usize) -> Vec<PatchFactors> {
    vec![PatchFactors::uniform(Domain::Quad, factor); count]
}

/// A device that allows buffers up to this size, in bytes.
fn small_device(max_buffer_size: u64) -> Gpu {
    limited(wgpu::Limits { max_buffer_size, ..Default::default() })
}

#[test]
fn one_buffer_for_two_purposes_is_refused() {
    let mut machine = Machine::open();
    let factors = machine.factors(&quads(2.0, 10));
    let [one, other] = [(); 2].map(|()| machine.upload(&[0; 4_000], Usage::STORAGE));
    for (points, indices, expected) in [
        (&one, &other, None),
        (&one, &one, Some([Resource::Points, Resource::Indices])),
        (&factors, &one, Some([Resource::Factors, Resource::Points])),
        (&one, &factors, Some([Resource::Factors, Resource::Indices])),
    ] {
        let outputs = Outputs::Buffers { points, indices };
        let batch = machine.tessellator.batch(setup(Domain::Quad), 10, &factors, outputs);
        let expected = expected.map(|buffers| Error::SharedBuffer { buffers });
        assert_eq!(batch.err(), expected, "batch of these buffers");
    }
}

#[test]
fn buffers_that_do_not_do_are_refused() {
    let mut machine = Machine::open();
    let factors = machine.factors(&quads(2.0, 10));
    let outputs = Outputs::CountOnly;
    let batch = machine.tessellator.batch(setup(Domain::Quad), 11, &factors, outputs);
    let expected = Error::FactorsTooShort { needed: 11 * 24, got: 10 * 24 };
    assert_eq!(batch.err(), Some(expected), "too few factors");
    let plain = machine.upload(&[0; 4_000], Usage::COPY_SRC);
    let points = machine.upload(&[0; 4_000], Usage::STORAGE);
    let outputs = Outputs::Buffers { points: &points, indices: &plain };
    let batch = machine.tessellator.batch(setup(Domain::Quad), 10, &factors, outputs);
    let expected = Error::NotStorage { buffer: Resource::Indices };
    assert_eq!(batch.err(), Some(expected), "indices that no shader can write");
    let patches = (1 << 30) + 1;
    let batch = machine.tessellator.batch(setup(Domain::Quad), patches, &factors, outputs);
    let expected = Error::TooManyPatches { got: patches as usize };
    assert_eq!(batch.err(), Some(expected), "more patches than points can name");
}

/// The text for a person, in addition to the variant that a program can match.
#[test]
fn errors_name_what_is_wrong() {
    for (buffer, name) in [
        (Resource::Factors, "of factors lacks"),
        (Resource::Points, "of points lacks"),
        (Resource::Indices, "of indices lacks"),
        (Resource::Status, "of the batch lacks"),
    ] {
        let text = Error::NotStorage { buffer }.to_string();
        assert!(text.contains(name), "{text}");
    }
    let text = Error::NoDevice { reason: "none here".into() }.to_string();
    assert!(text.contains("(none here); install a"), "the next step: {text}");
}

#[test]
fn patches_of_another_domain_are_refused() {
    let mut machine = Machine::open();
    let mut patches = vec![PatchFactors::uniform(Domain::Isoline, 3.0); 4];
    patches.extend(quads(3.0, 1));
    let output = machine.tessellator.tessellate(&machine.gpu, setup(Domain::Isoline), &patches);
    let (expected, got) = (Domain::Isoline, Domain::Quad);
    let expected = Error::WrongDomain { patch: 4, expected, got };
    assert_eq!(output.err(), Some(expected), "a quad among isolines");
}

/// Too much output, too many factors, and cases between them.
#[test]
fn what_exceeds_the_device_is_refused() {
    // The tables of constants are already larger, so fewer patches would not help.
    let (needed, got) = (4 * 540_864, 1 << 20);
    let gpu = small_device(got);
    let output =
        Tessellator::new(&gpu.device).tessellate(&gpu, setup(Domain::Quad), &quads(1.0, 1));
    let expected = Error::LimitTooLow { limit: "max_buffer_size", needed, got };
    assert_eq!(output.err(), Some(expected), "tables");

    let limit = 1 << 22;
    let gpu = small_device(limit);
    let patches = quads(1.0, 200_000);
    let output = Tessellator::new(&gpu.device).tessellate(&gpu, setup(Domain::Quad), &patches);
    let (buffer, needed) = ("factors".to_owned(), 24 * 200_000);
    assert_eq!(output.err(), Some(Error::BufferTooLarge { buffer, needed, limit }), "factors");

    let mut machine = Machine::open();
    let patches = quads(64.0, 8_000);
    let output = machine.tessellator.tessellate(&machine.gpu, setup(Domain::Quad), &patches);
    let limit = machine.gpu.device.limits().max_buffer_size;
    let needed = 8 * 4_225 * 8_000;
    assert!(needed > limit, "{limit}");
    let buffer = "points".to_owned();
    assert_eq!(output.err(), Some(Error::BufferTooLarge { buffer, needed, limit }), "points");
    machine.assert_equal(setup(Domain::Quad), &quads(3.0, 10));
}

/// Every call on a lost device is an error.
#[test]
fn a_lost_device_is_an_error() {
    let mut machine = Machine::on(limited(wgpu::Limits::default()));
    let quad = setup(Domain::Quad);
    let usage = Usage::STORAGE | Usage::COPY_SRC;
    let buffer = machine.upload(&[1, 2, 3], usage);
    let factors = machine.factors(&quads(2.0, 10));
    let batch = machine.tessellator.batch(quad, 10, &factors, Outputs::CountOnly).expect("valid");
    machine.gpu.device.destroy();

    let is_lost = |error: Option<Error>| matches!(error, Some(Error::DeviceLost { .. }));
    let Machine { gpu, tessellator } = &mut machine;
    assert!(is_lost(gpu.read(&buffer, 12).err()), "read");
    assert!(is_lost(gpu.upload("words", &[1; 8], usage).err()), "upload");
    assert!(is_lost(tessellator.tessellate(gpu, quad, &quads(2.0, 10)).err()), "tessellate");
    let again = tessellator.batch(quad, 10, &factors, Outputs::CountOnly);
    assert!(is_lost(again.err()), "a batch");
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    batch.encode(&mut encoder);
    assert!(is_lost(gpu.run(encoder).err()), "run");
}
