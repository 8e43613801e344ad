//! The stage on OpenGL.

use crate::model::{self, compare};
use crate::scene::{PATCHES, Scene, source};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_wgpu::stage::{Points, StageError};
use tess_wgpu::{Error, Gpu, TessellationStage};

const CONFIG: Config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);

/// A scene whose patches have different factors on each edge.
fn scene(gpu: Gpu, domain: Domain) -> Scene {
    let of = |patch: u16| {
        let mut factor = f32::from(patch) * 0.75;
        PatchFactors::from_fn(domain, |_| {
            factor += 1.25;
            factor
        })
    };
    Scene::on(gpu, domain, CONFIG, (0..8).map(of).collect())
}

pub(crate) fn every_way_to_draw(gpu: Gpu) {
    let quads = [Points::Stored, Points::Pull, Points::PullWithoutIndices];
    for (domain, ways) in [(Domain::Triangle, &quads[..1]), (Domain::Quad, &quads)] {
        let scene = scene(gpu.clone(), domain);
        let expected = scene.pixels(&scene.patches);
        for &points in ways {
            let mut stage = scene.build(scene.builder().points(points));
            let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
            assert_eq!(compare(&observed, &expected), Ok(()), "{points:?}, {domain:?}");
            for corner in [0, 1] {
                let turned = model::pixels(CONFIG, &scene.patches, corner);
                assert!(compare(&observed, &turned).is_err(), "triangles begin elsewhere");
            }
            let observed = scene.frame(&mut stage, 7.into()).expect("it draws");
            assert!(compare(&observed, &expected).is_err(), "a patch less");
        }
    }
}

pub(crate) fn flat_members_are_refused(gpu: Gpu) {
    let scene = scene(gpu, Domain::Quad);
    let build = |source: &str| {
        TessellationStage::builder(source, scene.domain, scene.config, PATCHES)
            .bind_group(&scene.layout, &scene.group)
            .target(crate::scene::FORMAT)
            .build(&scene.gpu.device)
            .map(drop)
    };
    let first = source(scene.domain);
    let refused = |member: &str| {
        Err(Error::Stage(StageError::FlatOfFirstVertex { member: member.to_owned() }))
    };
    assert_eq!(build(&first), refused("uv"), "a place differs from vertex to vertex");
    let of_patch = first.replacen("@interpolate(flat)", "", 1);
    assert_eq!(build(&of_patch), refused("number"), "nobody said that it does not");
    let either = of_patch.replace("@interpolate(flat)", "@interpolate(flat, either)");
    assert_eq!(build(&either), Ok(()), "now it is said");
}
