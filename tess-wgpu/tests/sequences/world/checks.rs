//! Comparisons with the model, and refusals.

use super::{Last, Made, Store, World, position};
use crate::calls::{Patches, WrongCall};
use crate::common::expected::Expected;
use crate::sequences::equal;
use tess_core::{Domain, PatchFactors};
use tess_gpu::layout::DrawIndexed;
use tess_gpu::{IndexType, Numbering, Setup};
use tess_wgpu::{Error, Outputs};
use wgpu::BufferUsages as Usage;

impl World<'_> {
    /// Compares the results besides points and indices: counts, draws, the beginnings of patches,
    /// and pulled elements.
    pub(super) fn compare_own(
        &mut self,
        made: &Made,
        expected: &Expected<'_>,
    ) -> Result<(), String> {
        let (begins, overflow) = (expected.begins(), made.overflow(expected));
        let left = made.runner.left();
        let (status, draw) = self.machine.left([left.status, left.arguments]);
        let [points, primitives] = *begins.last().expect("the end");
        let observed = (status.points(), status.primitives());
        let bits = u32::from(status.points_overflow()) | u32::from(status.indices_overflow()) << 1;
        equal("totals", observed, (points.into(), primitives.into()))?;
        equal("overflow", bits, overflow)?;
        let each = made.setup.indices_per_primitive();
        let drawn = |begin: u32, end: u32| DrawIndexed {
            index_count: if overflow == 0 { each * (end - begin) } else { 0 },
            instance_count: 1,
            first_index: each * begin,
            ..DrawIndexed::default()
        };
        equal("draw", draw, drawn(0, primitives))?;
        if !made.groups.is_empty() {
            let words = self.machine.words(left.draws);
            let draws: Vec<DrawIndexed> =
                bytemuck::pod_collect_to_vec(&words[..5 * made.groups.len()]);
            let count = u32::try_from(made.count).unwrap_or(u32::MAX);
            let ends = made.groups.iter().skip(1).copied().chain([count]);
            for (number, ((&begin, end), draw)) in
                made.groups.iter().zip(ends).zip(draws).enumerate()
            {
                let [begin, end] = [begin, end].map(|patch| begins[patch as usize][1]);
                equal(&format!("draw of group {number}"), draw, drawn(begin, end))?;
            }
        }
        let offsets = self.machine.words(left.offsets);
        for (patch, &begin) in (0..).zip(&begins[..made.count]) {
            let at = |entry: u64| 2 * usize::try_from(entry).expect("in memory");
            let entries = left.plan.offset_entries(patch).map(at);
            let sum = [0, 1].map(|kind| entries.iter().map(|at| offsets[at + kind]).sum::<u32>());
            equal(&format!("beginning of patch {patch}"), sum, begin)?;
        }
        self.words += 18 + offsets.len() as u64;
        if made.is_pulled && overflow == 0 {
            let pulling = &mut self.kept.pulling;
            self.words += pulling.compare(self.machine, made.setup, &left, expected)?;
        }
        Ok(())
    }

    /// Compares every buffer with its shadow.
    pub(super) fn compare_stores(&mut self) -> Result<(), String> {
        for Store { what, buffer, shadow, last } in &self.stores {
            let observed = self.machine.words(buffer);
            self.words += observed.len() as u64;
            if observed != *shadow {
                let differs = |(a, b): (&u32, &u32)| a != b;
                let at = observed.iter().zip(shadow).position(differs).unwrap_or(0);
                let (observed, expected) = (observed[at], shadow[at]);
                let place = last.place(what, at, observed ^ expected);
                return Err(format!(
                    "{what}, word {at}{place}: observed {observed:#010x}, expected {expected:#010x}"
                ));
            }
        }
        Ok(())
    }

    pub(super) fn whole(&mut self, setup: Setup, with: Patches) -> Result<(), String> {
        let patches = with.of(setup.domain);
        let expected = Expected::new(setup, &patches);
        let mut begins = expected.begins();
        let [points, primitives] = begins.pop().expect("the end");
        let is_narrow =
            (setup.index_type, setup.numbering) == (IndexType::U16, Numbering::PerBatch);
        let output = self.machine.tessellator.tessellate(&self.machine.gpu, setup, &patches);
        if is_narrow && points > 65_536 {
            let (points, primitives) = (points.into(), primitives.into());
            return equal(
                "tessellate",
                output.err(),
                Some(Error::OutputTooLarge { points, primitives }),
            );
        }
        let output = output.map_err(|error| error.to_string())?;
        let observed = [output.status.points(), output.status.primitives()];
        equal("totals", observed, [points, primitives].map(u64::from))?;
        equal("draw", output.draw.index_count, primitives * setup.indices_per_primitive())?;
        equal("beginnings", output.begins, begins)?;
        let [points, indices] = expected.output();
        equal("points", bytemuck::cast_slice(&output.points), points)?;
        equal("indices", &output.indices[..], indices)
    }

    /// Makes a call that is refused, and checks its error.
    pub(super) fn refused(&mut self, setup: Setup, wrong: WrongCall) -> Result<(), String> {
        let (factors, patches) = &self.factors[position(setup.domain)];
        let [points, indices] = [0, 1].map(|store| &self.stores[store].buffer);
        let plain = self.machine.gpu.buffer("plain", 64, Usage::COPY_DST).expect("there is room");
        let (groups, count, points, indices): (&[u32], _, _, _) = match wrong {
            WrongCall::GroupsDescend => (&[2, 1], 3, points, indices),
            WrongCall::GroupBehind => (&[0, 4], 3, points, indices),
            WrongCall::FewFactors => {
                (&[], u32::try_from(patches.len()).unwrap_or(u32::MAX) + 1, points, indices)
            }
            WrongCall::OneBuffer => (&[], 3, points, points),
            WrongCall::NotStorage => (&[], 3, points, &plain),
            WrongCall::OtherDomain => {
                let other =
                    if setup.domain == Domain::Quad { Domain::Triangle } else { Domain::Quad };
                let patches = [PatchFactors::uniform(other, 1.0)];
                let refused =
                    self.machine.tessellator.tessellate(&self.machine.gpu, setup, &patches);
                let is_right = matches!(refused, Err(Error::WrongDomain { patch: 0, .. }));
                return if is_right { Ok(()) } else { Err(format!("{refused:?}")) };
            }
        };
        let outputs = Outputs::Buffers { points, indices };
        let refused =
            self.machine.tessellator.batch_in_groups(setup, count, groups, factors, outputs);
        let refused = refused.map(drop);
        let is_right = match wrong {
            WrongCall::GroupsDescend => {
                matches!(refused, Err(Error::MisplacedGroup { group: 1, begin: 1, .. }))
            }
            WrongCall::GroupBehind => {
                matches!(refused, Err(Error::MisplacedGroup { group: 1, begin: 4, .. }))
            }
            WrongCall::FewFactors => matches!(refused, Err(Error::FactorsTooShort { .. })),
            WrongCall::OneBuffer => matches!(refused, Err(Error::SharedBuffer { .. })),
            _ => matches!(refused, Err(Error::NotStorage { .. })),
        };
        if is_right { Ok(()) } else { Err(format!("{wrong:?}: {refused:?}")) }
    }
}

impl Last {
    /// The element and the patch of word `at`, in which the bits `wrong` are wrong.
    fn place(&self, what: &str, at: usize, wrong: u32) -> String {
        let Some((setup, patches, begins)) = &self.0 else { return String::new() };
        let is_narrow = what.contains("indices") && setup.index_type == IndexType::U16;
        let at = if is_narrow { 2 * at + usize::from(wrong & 0xFFFF == 0) } else { at };
        let patch = begins.partition_point(|&begin| begin <= at).saturating_sub(1);
        match patches.get(patch) {
            None => format!(", behind the {} patches of {setup:?}", patches.len()),
            Some(factors) => {
                let element = at - begins[patch];
                format!(", element {element} of patch {patch} {factors:?} of {setup:?}")
            }
        }
    }
}
