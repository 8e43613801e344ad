//! How a surface looks.

use bevy::color::{Color, LinearRgba};
use bevy::pbr::StandardMaterial;

/// How a surface looks, with the meaning and the defaults of Bevy's [`StandardMaterial`]. Surfaces are opaque.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// The base colour; its alpha does not count.
    pub base_color: Color,
    /// Light that it emits.
    pub emissive: LinearRgba,
    /// 0.089 to 1.
    pub perceptual_roughness: f32,
    /// 0 to 1.
    pub metallic: f32,
    /// Specular intensity, 0 to 1.
    pub reflectance: f32,
    /// Whether it has its base colour whatever the light.
    pub unlit: bool,
}

impl Default for Look {
    fn default() -> Self {
        let StandardMaterial {
            base_color,
            emissive,
            perceptual_roughness,
            metallic,
            reflectance,
            unlit,
            ..
        } = StandardMaterial::default();
        Self { base_color, emissive, perceptual_roughness, metallic, reflectance, unlit }
    }
}

impl From<Look> for StandardMaterial {
    fn from(look: Look) -> Self {
        let Look { base_color, emissive, perceptual_roughness, metallic, reflectance, unlit } =
            look;
        Self {
            base_color,
            emissive,
            perceptual_roughness,
            metallic,
            reflectance,
            unlit,
            ..Self::default()
        }
    }
}
