//! A rectangle of patches, raised by heights.

use crate::bezier::quad_factors;
use crate::eye::Eye;
use crate::shape::{CpuShape, Shape, ShapeVertex};
use bevy::asset::Handle;
use bevy::camera::primitives::Aabb;
use bevy::color::{Color, ColorToComponents};
use bevy::ecs::error::BevyError;
use bevy::image::Image;
use bevy::math::{UVec2, Vec2, Vec3};
use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;
use tess_core::{Domain, OutputPrimitive, PatchFactors, QuadFactors};
use tess_surface::{Address, HeightError, HeightMap, glam};

/// A rectangle over x and z, centred on the origin and raised along y by a height map.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightField {
    texels: UVec2,
    heights: HeightMap,
    /// The lowest and the highest height.
    range: [f32; 2],
    patches: UVec2,
    size: Vec3,
    colors: GroundColors,
    /// The image, and whether the heights are already those of it.
    image: Option<(Handle<Image>, bool)>,
}

/// Linear colours of the ground, which multiply the material's base colour. All are white by
/// default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundColors {
    /// The colour of low ground.
    pub low: Vec3,
    /// The colour of high ground.
    pub high: Vec3,
    /// The colour of steep ground.
    pub steep: Vec3,
}

impl Default for GroundColors {
    fn default() -> Self {
        Self { low: Vec3::ONE, high: Vec3::ONE, steep: Vec3::ONE }
    }
}

/// The reason why a height field cannot be made.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum HeightFieldError {
    /// The heights are not an image.
    Image(HeightError),
    /// A pixel of the image cannot be read.
    Unreadable {
        /// Bevy's reason.
        reason: String,
    },
    /// A pixel of the image is not grey.
    NotGrey {
        /// The pixel's place.
        at: UVec2,
    },
    /// There are no patches along a side, or more than [`HeightField::MOST_PATCHES`].
    WrongPatches {
        /// Patches along x and z.
        got: UVec2,
    },
}

impl fmt::Display for HeightFieldError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Image(error) => write!(f, "the heights are not an image: {error}"),
            Self::Unreadable { reason } => write!(
                f,
                "the image cannot be read: {reason}; load grey pixels of 8 or 16 bits or floats, in 2D, and keep them in \
                 RenderAssetUsages::MAIN_WORLD"
            ),
            Self::NotGrey { at } => {
                write!(f, "the image is not grey: the channels of its pixel at {at} differ")
            }
            Self::WrongPatches { got } => write!(
                f,
                "{} x {} patches: each side must have 1 to {}; use several entities for more",
                got.x,
                got.y,
                HeightField::MOST_PATCHES
            ),
        }
    }
}

impl std::error::Error for HeightFieldError {}

/// The number of words before the heights. It replaces HEADER in `height_field.wgsl`.
const HEADER: usize = 20;

impl HeightField {
    /// The most patches along a side. Up to this number, places in patches are exact.
    pub const MOST_PATCHES: u32 = 256;

    /// Makes a field of `texels` heights, row by row along x, with the first row at the least z. It
    /// is 1 unit wide along x and z, and 1 unit high where a height is 1. It has 16 x 16 patches.
    ///
    /// # Errors
    /// [`HeightFieldError::Image`].
    pub fn new(texels: UVec2, heights: Vec<f32>) -> Result<Self, HeightFieldError> {
        let [width, height] = texels.to_array().map(|size| size as usize);
        let heights = HeightMap::new(width, height, heights).map_err(HeightFieldError::Image)?;
        let heights = heights.with_address(Address::Clamp);
        let (patches, colors) = (UVec2::splat(16), GroundColors::default());
        let range = heights
            .texels()
            .iter()
            .fold([f32::MAX, f32::MIN], |[low, high], &h| [low.min(h), high.max(h)]);
        Ok(Self { texels, heights, range, patches, size: Vec3::ONE, colors, image: None })
    }

    /// The same field, which takes the heights of a grey image once that is loaded, and again at
    /// each [`AssetEvent`](bevy::asset::AssetEvent) that reports a change. Black is 0 and white 1,
    /// in any colour space; floats are used as heights. Until then the field keeps its heights.
    #[must_use]
    pub fn with_image(mut self, image: Handle<Image>) -> Self {
        self.image = Some((image, false));
        self
    }

    /// The same field with this extent along x and z; heights are multiplied by the extent along y.
    #[must_use]
    pub const fn with_size(mut self, size: Vec3) -> Self {
        self.size = size;
        self
    }

    /// The same field with these colours.
    #[must_use]
    pub const fn with_colors(mut self, colors: GroundColors) -> Self {
        self.colors = colors;
        self
    }

    /// The same field with this number of patches along x and z.
    ///
    /// # Errors
    /// [`HeightFieldError::WrongPatches`].
    pub fn with_patches(mut self, patches: UVec2) -> Result<Self, HeightFieldError> {
        if patches.min_element() == 0 || patches.max_element() > Self::MOST_PATCHES {
            return Err(HeightFieldError::WrongPatches { got: patches });
        }
        self.patches = patches;
        Ok(self)
    }

    /// The surface above a place, 0 to 1 along x and z, in local space.
    #[must_use]
    pub fn surface_at(&self, place: Vec2) -> Vec3 {
        self.raised(place, self.height(place))
    }

    // The other functions are those of height_field.wgsl in Rust, one by one.

    fn height(&self, place: Vec2) -> f32 {
        self.heights.height_at(glam::Vec2::from_array(place.to_array()))
    }

    fn place_of(&self, patch: u32, uv: Vec2) -> Vec2 {
        let cell = UVec2::new(patch % self.patches.x, patch / self.patches.x).as_vec2();
        (cell + uv) / self.patches.as_vec2()
    }

    fn raised(&self, place: Vec2, height: f32) -> Vec3 {
        Vec3::new(
            (place.x - 0.5) * self.size.x,
            height * self.size.y,
            (place.y - 0.5) * self.size.z,
        )
    }

    fn is_unseen(&self, patch: u32, eye: &Eye) -> bool {
        let [lowest, highest] = self.range;
        let [near, far] = [Vec2::ZERO, Vec2::ONE].map(|uv| self.place_of(patch, uv));
        let middle = self.raised(0.5 * (near + far), 0.5 * (lowest + highest));
        let center = eye.to_world(middle);
        let radius = (0..8).map(|i| {
            let x = if i & 1 == 0 { near.x } else { far.x };
            let z = if i & 2 == 0 { near.y } else { far.y };
            let high = if i & 4 == 0 { lowest } else { highest };
            center.distance(eye.to_world(self.raised(Vec2::new(x, z), high)))
        });
        eye.is_unseen(center, radius.fold(0.0, f32::max))
    }

    fn slope(&self, place: Vec2) -> Vec3 {
        let step = self.texels.as_vec2().recip();
        let (x, z) = (Vec2::new(step.x, 0.0), Vec2::new(0.0, step.y));
        let along_x = self.height(place + x) - self.height(place - x);
        let along_z = self.height(place + z) - self.height(place - z);
        let extent = Vec2::new(self.size.x, self.size.z);
        let rise = Vec2::new(along_x, along_z) * self.size.y / (2.0 * step * extent);
        Vec3::new(-rise.x, 1.0, -rise.y).normalize()
    }

    fn tint(&self, high: f32, upward: f32) -> [f32; 4] {
        let [lowest, highest] = self.range;
        let part = (high - lowest) / (highest - lowest).max(1e-20);
        let GroundColors { low, high: peak, steep } = self.colors;
        let flat = low.lerp(peak, smoothstep(0.55, 0.85, part));
        steep.lerp(flat, smoothstep(0.75, 0.9, upward)).extend(1.0).to_array()
    }
}

/// WGSL's function of this name.
fn smoothstep(low: f32, high: f32, at: f32) -> f32 {
    let t = ((at - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

impl Shape for HeightField {
    fn domain(&self) -> Domain {
        Domain::Quad
    }

    /// The cross product of x and z points down.
    fn winding(&self) -> OutputPrimitive {
        OutputPrimitive::TriangleCcw
    }

    fn patches(&self) -> u32 {
        self.patches.x * self.patches.y
    }

    fn bounds(&self) -> Aabb {
        let [lowest, highest] = self.range;
        let (a, b) = (self.raised(Vec2::ZERO, lowest), self.raised(Vec2::ONE, highest));
        Aabb::from_min_max(a.min(b), a.max(b))
    }

    fn surface(&self) -> Cow<'static, str> {
        let text = include_str!("../shaders/height_field.wgsl");
        Cow::Owned(text.replace("HEADER", &format!("{HEADER}u")))
    }

    fn words(&self) -> Vec<u32> {
        let [lowest, highest] = self.range;
        let GroundColors { low, high, steep } = self.colors;
        let mut words = vec![self.texels.x, self.texels.y, self.patches.x, self.patches.y];
        let numbers = [self.size.to_array(), [lowest, highest, low.x]].concat();
        words.extend(numbers.into_iter().map(f32::to_bits));
        let colors = [low.y, low.z, high.x, high.y, high.z, steep.x, steep.y, steep.z];
        words.extend(colors.map(f32::to_bits));
        words.resize(HEADER, 0);
        words.extend(self.heights.texels().iter().map(|height| height.to_bits()));
        words
    }

    fn image(&self) -> Option<(&Handle<Image>, bool)> {
        self.image.as_ref().map(|(image, is_read)| (image, *is_read))
    }

    fn of_image(&self, image: &Image) -> Result<Arc<dyn Shape>, BevyError> {
        let read = Self::new(image.size(), heights(image)?)?;
        let (size, colors, patches) = (self.size, self.colors, self.patches);
        let image = self.image.clone().map(|(image, _)| (image, true));
        Ok(Arc::new(Self { size, colors, patches, image, ..read }))
    }

    fn on_cpu(&self) -> Option<&dyn CpuShape> {
        Some(self)
    }
}

/// The heights of a grey image, row by row.
fn heights(image: &Image) -> Result<Vec<f32>, HeightFieldError> {
    let size = image.size();
    let height = |at: UVec2| {
        let color = image.get_color_at(at.x, at.y);
        let color =
            color.map_err(|error| HeightFieldError::Unreadable { reason: error.to_string() })?;
        let [red, green, blue, _] = match color {
            Color::Srgba(color) => color.to_f32_array(),
            color => color.to_linear().to_f32_array(),
        };
        // The bits are compared, because NaN is unequal to itself; `HeightMap::new` reports NaN.
        let is_grey = [green, blue].map(f32::to_bits) == [red.to_bits(); 2];
        if is_grey { Ok(red) } else { Err(HeightFieldError::NotGrey { at }) }
    };
    (0..size.y).flat_map(|y| (0..size.x).map(move |x| UVec2::new(x, y))).map(height).collect()
}

impl CpuShape for HeightField {
    fn factors(&self, patch: u32, eye: &Eye) -> PatchFactors {
        if self.is_unseen(patch, eye) {
            return PatchFactors::Quad(QuadFactors::uniform(0.0));
        }
        let corners = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        let [a, b, c, d] =
            corners.map(|uv| eye.to_world(self.surface_at(self.place_of(patch, uv))));
        let edges = [eye.edge(a, d), eye.edge(a, b), eye.edge(b, c), eye.edge(d, c)];
        PatchFactors::Quad(quad_factors(edges))
    }

    fn vertices(&self, patch: u32, _: &Eye, points: &[[f32; 2]], vertices: &mut Vec<ShapeVertex>) {
        vertices.extend(points.iter().map(|&uv| {
            let place = self.place_of(patch, uv.into());
            let high = self.height(place);
            let normal = self.slope(place);
            ShapeVertex {
                position: self.raised(place, high).to_array(),
                normal: normal.to_array(),
                uv: place.to_array(),
                color: self.tint(high, normal.y),
            }
        }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LevelOfDetail;
    use crate::eye::{Casting, tests::eye};

    fn map() -> HeightField {
        let heights = (0..35_u16).map(|i| f32::from(i * 37 % 35) / 35.0).collect();
        let map = HeightField::new(UVec2::new(7, 5), heights).expect("35 texels");
        let map = map.with_size(Vec3::new(10.0, 2.0, 6.0));
        map.with_patches(UVec2::new(3, 2)).expect("six patches")
    }

    /// The vertices of a patch along a line of its domain.
    fn edge(map: &HeightField, patch: u32, of: impl Fn(f32) -> [f32; 2]) -> Vec<ShapeVertex> {
        let points: Vec<_> = (0..=64_u8).map(|i| of(f32::from(i) / 64.0)).collect();
        let mut vertices = Vec::new();
        let eye = eye(LevelOfDetail::default(), &Casting::default());
        map.vertices(patch, &eye, &points, &mut vertices);
        vertices
    }

    #[test]
    fn patches_agree_on_the_bits_of_their_edges() {
        let map = map();
        let (right, left) = (edge(&map, 1, |t| [1.0, t]), edge(&map, 2, |t| [0.0, t]));
        assert_eq!(right, left, "along z");
        let (far, near) = (edge(&map, 1, |t| [t, 1.0]), edge(&map, 4, |t| [t, 0.0]));
        assert_eq!(far, near, "along x");
        assert_ne!(right, edge(&map, 2, |t| [1.0 / 65536.0, t]), "the next point would be seen");
    }

    #[test]
    fn the_surface_is_in_its_box() {
        let map = map();
        let Aabb { center, half_extents } = map.bounds();
        let all = (0..map.patches()).flat_map(|patch| edge(&map, patch, |t| [t, t]));
        for ShapeVertex { position, .. } in all {
            let off = (Vec3::from(position) - Vec3::from(center)).abs();
            assert!(off.cmple(Vec3::from(half_extents) + 1e-5).all(), "{position:?}");
        }
    }

    #[test]
    fn what_is_missing_is_named() {
        let of = |x, y, heights: &[f32]| HeightField::new(UVec2::new(x, y), heights.to_vec());
        let missing = HeightError::WrongLength { texels: 3, width: 2, height: 2 };
        let wrong = Err(HeightFieldError::Image(missing));
        assert_eq!(of(2, 2, &[0.0; 3]), wrong, "a height is missing");
        assert!(of(0, 2, &[]).is_err(), "there is nothing");
        let nan = Err(HeightFieldError::Image(HeightError::NotFinite { index: 1 }));
        assert_eq!(of(2, 1, &[0.0, f32::NAN]), nan, "the second one");
        for (x, z) in [(0, 1), (1, 257)] {
            let got = UVec2::new(x, z);
            let refused = map().with_patches(got);
            assert_eq!(refused, Err(HeightFieldError::WrongPatches { got }), "{x} x {z}");
        }
        let text = HeightFieldError::WrongPatches { got: UVec2::new(1, 257) }.to_string();
        assert!(text.contains("1 to 256"), "{text}");
    }
}
