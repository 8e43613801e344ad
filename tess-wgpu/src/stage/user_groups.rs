//! The user's bind groups, which can be replaced between frames.

use super::StageError;

/// The user's bind groups of one pipeline, numbered from 0, each with its dynamic offsets.
#[derive(Clone, Debug)]
pub(super) struct UserGroups(Vec<(wgpu::BindGroup, Vec<wgpu::DynamicOffset>)>);

impl UserGroups {
    /// These groups, without dynamic offsets.
    pub(super) fn new(groups: Vec<wgpu::BindGroup>) -> Self {
        Self(groups.into_iter().map(|group| (group, Vec::new())).collect())
    }

    pub(super) fn set(&mut self, number: u32, group: &wgpu::BindGroup) -> Result<(), StageError> {
        self.at(number)?.0.clone_from(group);
        Ok(())
    }

    pub(super) fn set_offsets(&mut self, number: u32, offsets: &[u32]) -> Result<(), StageError> {
        self.at(number)?.1 = offsets.to_vec();
        Ok(())
    }

    fn at(
        &mut self,
        number: u32,
    ) -> Result<&mut (wgpu::BindGroup, Vec<wgpu::DynamicOffset>), StageError> {
        let groups = self.0.len();
        self.0.get_mut(number as usize).ok_or(StageError::NoSuchBindGroup { number, groups })
    }

    /// The numbers, groups and dynamic offsets, as a pass sets them.
    pub(super) fn iter(&self) -> impl Iterator<Item = (u32, &wgpu::BindGroup, &[u32])> {
        (0..).zip(&self.0).map(|(number, (group, offsets))| (number, group, &offsets[..]))
    }
}
