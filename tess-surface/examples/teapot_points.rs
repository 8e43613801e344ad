//! Tessellates the teapot by distance from an eye and prints it as an OBJ file.
#![expect(clippy::print_stdout, reason = "an example prints")]

use tess_core::{Config, OutputPrimitive, Partitioning, Patch};
use tess_surface::glam::Vec3;
use tess_surface::{FactorRule, MeshError, Model, Sample, teapot};

pub(crate) fn main() -> Result<(), MeshError> {
    let model = Model::bezier(teapot::patches())?;
    let rule = FactorRule::Distance { eye: Vec3::new(6.0, 0.0, 2.0), scale: 30.0 };
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);

    let mut first = 1; // OBJ counts from 1
    for number in 0..model.len() {
        let factors = rule.factors(&model, number, config.partitioning);
        let domain = Patch::new(config, factors);
        let (patch, whole) = (model.patch(number), domain.tessellate());
        for point in &whole.points {
            let Sample { position, normal, .. } = patch.sample(point.to_f32());
            println!("v {} {} {}", position.x, position.y, position.z);
            println!("vn {} {} {}", normal.x, normal.y, normal.z);
        }
        for triangle in whole.indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|corner| first + triangle[corner]);
            println!("f {a}//{a} {b}//{b} {c}//{c}");
        }
        first += domain.counts().points;
    }
    Ok(())
}
