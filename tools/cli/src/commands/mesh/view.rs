//! The camera of pictures, and of factor rules that depend on a viewpoint.

use crate::args::{Choices, choice};
use clap::builder::ValueParser;
use glam::{Mat4, Vec3};
use tess_mesh::Up;

/// The viewpoint.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct ViewArgs {
    /// Position of the eye, in the model's units [default: so that the model fills the picture]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    #[arg(value_parser = ValueParser::new(point))]
    eye: Option<Vec3>,
    /// Point that the eye looks at [default: the middle of the model]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    #[arg(value_parser = ValueParser::new(point))]
    target: Option<Vec3>,
    /// Field of view from top to bottom, in degrees [default: 30]
    #[arg(long, value_name = "DEGREES", value_parser = ValueParser::new(angle))]
    fov: Option<f32>,
    /// Size of the picture in pixels, at most 16777216 of them [default: 800x600]
    #[arg(long, value_name = "WxH", value_parser = ValueParser::new(size))]
    size: Option<(u32, u32)>,
    /// Which way is up [default: y for OBJ and glTF, z for Bezier patches]
    #[arg(long, value_name = "AXIS", value_parser = choice(AXES))]
    pub(crate) up: Option<Up>,
}

/// The directions that can be up.
const AXES: Choices<Up> = &[
    ("y", Up::Y, "+y, as in glTF and most OBJ files"),
    ("z", Up::Z, "+z, as in Bezier patch files"),
];

/// A fixed camera.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CameraView {
    /// The position of the eye.
    pub(crate) eye: Vec3,
    /// The matrix from the model's coordinates to clip space: x and y are in -w..w inside the
    /// picture, and w is the depth.
    pub(crate) clip: Mat4,
    /// The width and height of the picture in pixels.
    pub(crate) size: (u32, u32),
    /// The number of pixels that a length of 1 covers at distance 1.
    pub(crate) pixels_per_unit: f32,
}

/// The largest width and height of a picture.
const MAX_SIDE: u32 = 8192;

/// The largest number of pixels in a picture. Each takes 63 bytes while it is drawn, which is a
/// gigabyte in all.
const MAX_PIXELS: u32 = 4096 * 4096;

/// The part of the picture's half width and half height that the default camera fills.
const FILLED: f32 = 0.94;

impl ViewArgs {
    /// Whether any option of the camera is given.
    pub(crate) const fn is_chosen(&self) -> bool {
        self.eye.is_some() || self.target.is_some() || self.fov.is_some() || self.size.is_some()
    }

    /// The camera for a surface with these points.
    pub(crate) fn view(&self, points: &[Vec3], up: Up) -> CameraView {
        let first = points.first().copied().unwrap_or_default();
        let grow = |(low, high): (Vec3, Vec3), &point: &Vec3| (low.min(point), high.max(point));
        let (low, high) = points.iter().fold((first, first), grow);
        let size = self.size.unwrap_or((800, 600));
        let (width, height) = (size.0 as f32, size.1 as f32);
        let radius = (0.5 * high.distance(low)).max(f32::MIN_POSITIVE);
        let target = self.target.unwrap_or((low + high) * 0.5);
        let half_height = libm::tanf((0.5 * self.fov.unwrap_or(30.0)).to_radians());
        let (axis, from) = match up {
            Up::Y => (Vec3::Y, Vec3::new(0.35, 0.45, 1.0)),
            Up::Z => (Vec3::Z, Vec3::new(0.35, -1.0, 0.45)),
        };
        let eye = self.eye.unwrap_or_else(|| {
            let half = [half_height * width / height, half_height];
            let away = from.normalize();
            target + away * distance_to_fit(points, target, away, axis, half).max(radius * 0.1)
        });
        let forward = (target - eye).normalize_or(Vec3::X);
        // When the view is straight up or down, any direction may be at the top of the picture.
        let right = forward.cross(axis).normalize_or(forward.any_orthonormal_vector());
        let top = right.cross(forward);
        // Clip x, y, z, w of a point: z is 0 on the near plane, and w is the distance from the eye.
        let row = |v: Vec3, offset: f32| v.extend(offset - v.dot(eye));
        let near = radius * 1e-3;
        let rows = Mat4::from_cols(
            row(right * (height / (width * half_height)), 0.0),
            row(top / half_height, 0.0),
            row(forward, -near),
            row(forward, 0.0),
        );
        CameraView {
            eye,
            clip: rows.transpose(),
            size,
            pixels_per_unit: height / (2.0 * half_height),
        }
    }
}

/// The distance from `target`, in direction `away`, at which the points fill the picture: all are
/// within [`FILLED`] of its half width and half height, which are `half` at distance 1.
fn distance_to_fit(points: &[Vec3], target: Vec3, away: Vec3, axis: Vec3, half: [f32; 2]) -> f32 {
    let right = axis.cross(away).normalize();
    let top = away.cross(right);
    let mut distance = 0.0f32;
    for &point in points {
        let point = point - target;
        // At `distance`, the depth of the point is `distance - point.dot(away)`.
        for (across, half) in [(right, half[0]), (top, half[1])] {
            distance = distance.max(point.dot(across).abs() / (half * FILLED) + point.dot(away));
        }
    }
    distance
}

fn point(text: &str) -> Result<Vec3, String> {
    let numbers: Option<Vec<f32>> = text.split(',').map(|word| word.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, z]) if Vec3::new(x, y, z).is_finite() => Ok(Vec3::new(x, y, z)),
        _ => Err("a point is three finite numbers, such as 4,-6,2.5".to_owned()),
    }
}

fn angle(text: &str) -> Result<f32, String> {
    let angle = text.parse().ok().filter(|angle: &f32| (1.0..=170.0).contains(angle));
    angle.ok_or_else(|| "a field of view is 1 to 170 degrees".to_owned())
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let side = |text: &str| text.parse().ok().filter(|side: &u32| (1..=MAX_SIDE).contains(side));
    let sides = text.split_once('x').and_then(|(w, h)| Some((side(w)?, side(h)?)));
    sides.filter(|(width, height)| width * height <= MAX_PIXELS).ok_or_else(|| {
        format!(
            "a size is such as 800x600, each side 1 to {MAX_SIDE}, at most {MAX_PIXELS} pixels in \
             all (4096x4096)"
        )
    })
}
