//! Small files that ask for much: refused before anything is made, with the place and the limit.

use crate::support::Gltf;
use serde_json::json;
use std::fmt::Write as _;
use tess_mesh::{Format, LoadErrorKind, LoadOptions, read};

/// Refuses a file for its size in little memory and time, and returns the message.
fn refused(gltf: &Gltf) -> String {
    let error = gltf.load().expect_err("it is refused");
    assert_eq!(error.kind(), LoadErrorKind::Limit, "{error}");
    error.to_string()
}

/// An accessor without bytes has any number of elements.
fn zeros(gltf: &mut Gltf, kind: &str, count: u64) -> usize {
    let accessors = gltf.document["accessors"].as_array_mut().expect("a list");
    accessors.push(json!({"componentType": 5126, "type": kind, "count": count}));
    accessors.len() - 1
}

#[test]
fn accessors_without_bytes() {
    for count in [1 << 28, 1 << 40, u64::MAX >> 1] {
        let mut gltf = Gltf::triangle();
        let matrices = zeros(&mut gltf, "MAT4", count);
        gltf.document["skins"] = json!([{"joints": [0], "inverseBindMatrices": matrices}]);
        gltf.document["nodes"][0]["skin"] = json!(0);
        let message = refused(&gltf);
        let start = format!("accessors[1].count: {count} elements of 64 bytes each");
        assert!(message.starts_with(&start), "{message}");
        assert!(message.ends_with("the limit of 4294967296 bytes"), "{message}");
    }
    // A morph target's count is compared before anything is read.
    let mut gltf = Gltf::triangle();
    let moves = zeros(&mut gltf, "VEC3", 1 << 40);
    gltf.primitive()["targets"] = json!([{"POSITION": moves}]);
    gltf.document["meshes"][0]["weights"] = json!([1]);
    let message = gltf.refused();
    assert!(message.contains("targets[0].POSITION: its count is not that of"), "{message}");
    let mut gltf = Gltf::triangle();
    let positions = zeros(&mut gltf, "VEC3", 1 << 30);
    gltf.attribute("POSITION", positions);
    assert!(refused(&gltf).starts_with("meshes[0].primitives[0]: 1073741824 vertices"), "vertices");
}

#[test]
fn many_sets_of_joints() {
    let mut gltf = Gltf::triangle();
    let count = 200_000;
    let positions = zeros(&mut gltf, "VEC3", count);
    gltf.attribute("POSITION", positions);
    let weights = zeros(&mut gltf, "VEC4", count);
    let joints = zeros(&mut gltf, "VEC4", count);
    gltf.document["accessors"][joints]["componentType"] = json!(5121);
    for set in 0..1000 {
        gltf.attribute(&format!("JOINTS_{set}"), joints);
        gltf.attribute(&format!("WEIGHTS_{set}"), weights);
    }
    gltf.document["skins"] = json!([{"joints": [0]}]);
    gltf.document["nodes"][0]["skin"] = json!(0);
    let options = LoadOptions { max_memory: 1 << 27, ..LoadOptions::default() };
    let error = read(&gltf.text(), Format::Gltf, None, &options).expect_err("it is refused");
    assert_eq!(error.kind(), LoadErrorKind::Limit, "{error}");
}

#[test]
fn nodes_times_primitives() {
    let mut gltf = Gltf::triangle();
    let point = json!({"attributes": {"POSITION": 0}, "mode": 0});
    gltf.document["meshes"] = json!([{"primitives": vec![point; 10_000]}]);
    gltf.document["nodes"] = json!(vec![json!({"mesh": 0}); 20_000]);
    gltf.document["scenes"] = json!([{"nodes": (0..20_000).collect::<Vec<_>>()}]);
    let options = LoadOptions { max_memory: 1 << 26, ..LoadOptions::default() };
    let error = read(&gltf.text(), Format::Gltf, None, &options).expect_err("it is refused");
    assert_eq!(error.kind(), LoadErrorKind::Limit, "{error}");
    let message = error.to_string();
    assert!(message.contains("].mesh: 10000 primitives of 64 bytes each"), "{message}");
}

/// Joints on nodes, each of which has the same skin: the matrices are made once.
#[test]
fn joints_times_nodes() {
    let mut gltf = Gltf::triangle();
    let count = 20_000;
    let node = |k: usize| json!({"mesh": 0, "skin": 0, "translation": [k, 0, 0]});
    gltf.document["nodes"] = (0..count).map(node).collect();
    let all: Vec<usize> = (0..count).collect();
    gltf.document["skins"] = json!([{"joints": all}]);
    gltf.document["scenes"] = json!([{"nodes": all}]);
    let loaded = gltf.loaded();
    assert_eq!(loaded.model.len(), count, "one triangle for each node");
}

#[test]
fn text_that_grows() {
    let limit = |max_memory| LoadOptions { max_memory, ..LoadOptions::default() };
    let mut text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n".to_owned();
    (0..1000).for_each(|_| text.push_str("f 1 2 3\n"));
    let obj = |text: &str, max_memory| read(text.as_bytes(), Format::Obj, None, &limit(max_memory));
    let error = obj(&text, 1 << 17).expect_err("it is refused");
    assert_eq!(error.kind(), LoadErrorKind::Limit, "{error}");
    assert!(error.to_string().contains("faces of 192 bytes each"), "{error}");
    assert_eq!(obj(&text, 1 << 20).expect("it is read").model.len(), 1000, "a higher limit");
    let mut bpt = "9999\n".to_owned();
    for _ in 0..9999 {
        bpt.push_str("3 3\n");
        (0..16).for_each(|k| _ = writeln!(bpt, "{} {} 0", k % 4, k / 4));
    }
    let error = read(bpt.as_bytes(), Format::Bpt, None, &limit(1 << 20));
    assert_eq!(error.expect_err("it is refused").kind(), LoadErrorKind::Limit, "patches");
    let json = format!(r#"{{"asset": {{"version": "2.0"}}, "x": [{}0]}}"#, "0,".repeat(100_000));
    let error = read(json.as_bytes(), Format::Gltf, None, &limit(1 << 20));
    assert_eq!(error.expect_err("it is refused").kind(), LoadErrorKind::Limit, "values");
}
