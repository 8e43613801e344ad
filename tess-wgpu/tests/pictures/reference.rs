//! The examples' scenes, drawn with tess-core, tess-surface and the rasteriser of the program
//! `tess`.

use crate::camera::Camera;
use crate::raster::{Fragment, Raster};
use crate::{app, passes, teapot};
use glam::{Mat4, Vec2, Vec3};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, Patch, PatchFactors, QuadFactors};
use tess_surface::{Model, Sample};

fn byte(channel: f32) -> u8 {
    (channel.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

fn colour(rgb: Vec3) -> [u8; 3] {
    rgb.to_array().map(byte)
}

fn blank(size: [u32; 2], clip: Mat4) -> Raster {
    let wgpu::Color { r, g, b, .. } = app::BACKGROUND;
    let background = [r, g, b].map(|channel| byte(channel as f32));
    Raster::new((size[0] as usize, size[1] as usize), clip, background)
}

/// Draws a tessellated patch, its points placed by `sample`.
fn draw(
    raster: &mut Raster,
    (config, factors): (Config, PatchFactors),
    sample: impl Fn([f32; 2]) -> Sample,
    shade: impl Fn(&Fragment) -> [u8; 3],
) {
    let whole = Patch::new(config, factors).tessellate();
    let samples: Vec<Sample> = whole.points.iter().map(|point| sample(point.to_f32())).collect();
    for corners in whole.indices.chunks_exact(3) {
        raster.triangle([0, 1, 2].map(|k| &samples[corners[k] as usize]), &shade);
    }
}

/// The power of a number from 0 to 1 with an integer exponent.
fn power(base: f32, exponent: u8) -> f32 {
    (0..exponent).fold(1.0, |product, _| product * base)
}

/// The example `teapot`, moved to the right.
pub(crate) fn teapot(size: [u32; 2], right: f32) -> Vec<[u8; 3]> {
    // The same as in draw.wgsl.
    let (eye, target) = (Vec3::new(3.2, -7.6, 5.0), Vec3::new(0.3, 0.0, 1.45));
    let camera = Camera { eye, target, up: Vec3::Z, zoom: 3.1 };
    let model = Model::bezier(tess_surface::teapot::patches()).expect("a sound model");
    let factors = teapot::factors().expect("a sound model");
    let mut raster = blank(size, camera.clip_from_world(4.0 / 3.0));
    let shade = |fragment: &Fragment| {
        let to_eye = (eye - fragment.position).normalize();
        let toward = fragment.normal.dot(to_eye);
        let normal = if toward < 0.0 { -fragment.normal } else { fragment.normal };
        let to_light = Vec3::new(0.6, -0.7, 1.1).normalize();
        let diffuse = 0.3 + 0.7 * normal.dot(to_light).max(0.0);
        let shine = power(normal.dot((to_light + to_eye).normalize()).max(0.0), 60);
        colour(diffuse * Vec3::new(0.36, 0.52, 0.70) + Vec3::splat(0.45 * shine))
    };
    for (number, &factors) in factors.iter().enumerate() {
        let patch = model.patch(number);
        let sample = |uv| {
            let sample = patch.sample(uv);
            Sample { position: sample.position + Vec3::X * right, ..sample }
        };
        draw(&mut raster, (teapot::setup().config, factors), sample, shade);
    }
    raster.pixels().to_vec()
}

/// The function `wave` of sea.wgsl at time 0, with waves of this height.
fn wave(at: Vec2, height: f32) -> Vec3 {
    let Vec2 { x, y } = at;
    let z = 0.16 * libm::sinf(1.7 * x + 0.6 * y)
        + 0.09 * libm::sinf(2.9 * y - 1.3 * x)
        + 0.03 * libm::sinf(7.0 * x + 5.0 * y);
    at.extend(height * z)
}

/// The example `quickstart`.
pub(crate) fn sea(size: [u32; 2], height: f32) -> Vec<[u8; 3]> {
    let (eye, target) = (Vec3::new(8.0, -3.0, 2.5), Vec3::new(8.0, 4.0, 0.0));
    let camera = Camera { eye, target, up: Vec3::Z, zoom: 1.6 };
    let clip = camera.clip_from_world(size[0] as f32 / size[1] as f32);
    let pixels_per_unit = 0.5 * size[1] as f32 * camera.zoom;
    let edge = |a: Vec2, b: Vec2| {
        let away = eye.distance((a + b).extend(0.0) * 0.5);
        (a.distance(b) * pixels_per_unit / (away * 10.0)).clamp(1.0, 64.0)
    };
    let shade = |fragment: &Fragment| {
        let at = fragment.position.truncate();
        let here = wave(at, height).z;
        let slope = Vec2::new(
            wave(at + Vec2::new(0.01, 0.0), height).z - here,
            wave(at + Vec2::new(0.0, 0.01), height).z - here,
        ) / 0.01;
        let normal = (-slope).extend(1.0).normalize();
        let to_eye = (eye - fragment.position).normalize();
        let shine = power(normal.dot((to_eye + Vec3::new(0.3, 0.8, 0.5)).normalize()).max(0.0), 90);
        let glance = power(1.0 - normal.dot(to_eye).max(0.0), 3);
        let sea = Vec3::new(0.02, 0.22, 0.30);
        colour(sea.lerp(Vec3::new(0.55, 0.70, 0.80), glance) + Vec3::splat(0.6 * shine))
    };
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
    let mut raster = blank(size, clip);
    for number in 0..256_u16 {
        let corner =
            |u: f32, v: f32| Vec2::new(f32::from(number % 16) + u, f32::from(number / 16) + v);
        let [a, b, c, d] =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[u, v]| corner(u, v));
        let (u0, v0, u1, v1) = (edge(a, d), edge(a, b), edge(b, c), edge(d, c));
        let (inside_u, inside_v) = (0.5 * (v0 + v1), 0.5 * (u0 + u1));
        let factors = QuadFactors { u0, v0, u1, v1, inside_u, inside_v };
        let sample = |[u, v]: [f32; 2]| Sample {
            position: wave(corner(u, v), height),
            normal: Vec3::Z,
            ..Sample::default()
        };
        draw(&mut raster, (config, PatchFactors::Quad(factors)), sample, shade);
    }
    raster.pixels().to_vec()
}

/// The function `height` of hills.wgsl.
fn height(at: Vec2) -> f32 {
    let top = at - Vec2::new(4.0, 3.5);
    0.25 * libm::sinf(1.7 * at.x) * libm::sinf(1.9 * at.y) + 1.8 * libm::expf(-1.5 * top.dot(top))
}

/// The place where a ray meets the hills, if it does.
pub(crate) fn hit(from: Vec3, direction: Vec3) -> Option<Vec3> {
    let mut ray = (1..4000_u16).map(|step| from + direction * (0.005 * f32::from(step)));
    ray.find(|at| {
        let is_over = at.x >= 0.0 && at.y >= 0.0 && at.x <= 8.0 && at.y <= 8.0;
        is_over && at.z < height(at.truncate())
    })
}

/// The example `passes`: two pictures side by side, with shadows or without.
pub(crate) fn hills([width, rows]: [u32; 2], has_shadows: bool) -> Vec<[u8; 3]> {
    let sun = passes::toward_sun();
    let is_lit = |from: Vec3| {
        let mut ray = (1..400_u16).map(|step| from + sun * (0.02 * f32::from(step)));
        !ray.any(|at| at.max_element() < 8.0 && at.z < height(at.truncate()) - 0.02)
    };
    let shade = |fragment: &Fragment| {
        let at = fragment.position.truncate();
        let slope = [Vec2::X, Vec2::Y].map(|axis| (height(at + 0.01 * axis) - height(at)) / 0.01);
        let normal = Vec3::new(-slope[0], -slope[1], 1.0).normalize();
        let lit = !has_shadows || is_lit(fragment.position);
        let light = if lit { 0.3 + 0.7 * normal.dot(sun).max(0.0) } else { 0.3 };
        colour(light * Vec3::new(0.55, 0.62, 0.40))
    };
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
    let half = passes::cameras(0.5 * width as f32 / rows as f32).map(|clip| {
        let mut raster = blank([width / 2, rows], clip);
        for number in 0..64_u16 {
            let corner = Vec2::new(f32::from(number % 8), f32::from(number / 8));
            let sample = |uv: [f32; 2]| {
                let at = corner + Vec2::from(uv);
                Sample { position: at.extend(height(at)), normal: Vec3::Z, ..Sample::default() }
            };
            draw(&mut raster, (config, PatchFactors::uniform(Domain::Quad, 16.0)), sample, shade);
        }
        raster
    });
    let rows = half.each_ref().map(|raster| raster.pixels().chunks(width as usize / 2));
    let [left, right] = rows;
    left.zip(right).flat_map(|(left, right)| [left, right].concat()).collect()
}
