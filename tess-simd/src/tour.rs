//! The patch of `docs/tour-cpu.md`, for unit tests.

use crate::data::lanes::{Column, LANES, MAX_FACTORS};
use crate::stages::packet::Packet;
use crate::stages::points::{Code, codes};
use alloc::vec::Vec;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors, QuadFactors};

/// The tour's configuration.
pub(crate) const CONFIG: Config =
    Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);

/// The tour's patch.
pub(crate) const QUAD: QuadFactors =
    QuadFactors { u0: 3.0, v0: 4.5, u1: 5.0, v1: 6.0, inside_u: 4.0, inside_v: 7.0 };

/// The packet that has the patch in lane 0; the other lanes are culled.
pub(crate) fn packet() -> Packet {
    let mut raw: Column<f32> = [[0.0; LANES]; MAX_FACTORS];
    for (number, factor) in PatchFactors::Quad(QUAD).iter().enumerate() {
        raw[number][0] = factor;
    }
    let mut packet = Packet::EMPTY;
    packet.process::<i32>(CONFIG, Domain::Quad, &raw);
    packet
}

/// The codes of the patch's points.
pub(crate) fn all_codes() -> Vec<Code> {
    let packet = packet();
    let mut all = alloc::vec![Code::default(); packet.patch(0).points() as usize];
    codes(Domain::Quad, &packet.patch(0).edges(), &mut all);
    all
}
