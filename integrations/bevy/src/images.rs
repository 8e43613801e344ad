//! Updates shapes that are made of images, when the image is loaded or changes.

use crate::component::Tessellated;
use crate::shape::Shape;
use bevy::asset::{AssetEvent, AssetId, Assets};
use bevy::ecs::prelude::*;
use bevy::image::Image;
use bevy::log::error;
use bevy::platform::collections::{HashMap, HashSet};
use std::sync::Arc;

/// Gives entities the new shape of their image. Entities that shared a shape share the new one.
pub(crate) fn follow(
    images: Res<Assets<Image>>,
    mut events: MessageReader<AssetEvent<Image>>,
    mut surfaces: Query<&mut Tessellated>,
) {
    let changed = |event: &AssetEvent<Image>| match event {
        AssetEvent::Added { id } | AssetEvent::Modified { id } => Some(*id),
        _ => None,
    };
    let changed: HashSet<AssetId<Image>> = events.read().filter_map(changed).collect();
    let mut made: HashMap<usize, Option<Arc<dyn Shape>>> = HashMap::default();
    for mut surface in &mut surfaces {
        let Some((image, is_read)) = surface.shape.image() else { continue };
        let is_new = !is_read && surface.is_changed();
        let Some(image) = images.get(image).filter(|_| is_new || changed.contains(&image.id()))
        else {
            continue;
        };
        let next = made.entry(Arc::as_ptr(&surface.shape).addr()).or_insert_with(|| {
            let next = surface.shape.of_image(image);
            next.inspect_err(|problem| error!("a surface keeps its heights: {problem}")).ok()
        });
        if let Some(next) = next.clone() {
            surface.shape = next;
        }
    }
}
