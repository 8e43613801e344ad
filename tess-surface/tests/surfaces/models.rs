//! The models that the tests run over.

use glam::{Vec2, Vec3, Vec4};
use tess_surface::{BezierPatch, Displacement, Face, FactorRule, HeightMap, Model, PolygonMesh};
use tess_surface::{Sides, Style, teapot};

pub(crate) fn face(corners: &[u32]) -> Face {
    let positions = match *corners {
        [a, b, c] => Sides::Triangle([a, b, c]),
        [a, b, c, d] => Sides::Quad([a, b, c, d]),
        _ => panic!("3 or 4 corners"),
    };
    Face { positions, normals: None, texcoords: None }
}

pub(crate) fn mesh(positions: &[[f32; 3]], faces: &[&[u32]]) -> PolygonMesh {
    PolygonMesh {
        positions: positions.iter().map(|&p| Vec3::from_array(p)).collect(),
        faces: faces.iter().map(|corners| face(corners)).collect(),
        ..PolygonMesh::default()
    }
}

pub(crate) fn octahedron() -> PolygonMesh {
    let p = [[1., 0., 0.], [-1., 0., 0.], [0., 1., 0.], [0., -1., 0.], [0., 0., 1.], [0., 0., -1.]];
    mesh(
        &p,
        &[
            &[0, 2, 4],
            &[2, 1, 4],
            &[1, 3, 4],
            &[3, 0, 4],
            &[2, 0, 5],
            &[1, 2, 5],
            &[3, 1, 5],
            &[0, 3, 5],
        ],
    )
}

const CUBE: [[f32; 3]; 8] = [
    [-1., -1., -1.],
    [1., -1., -1.],
    [1., 1., -1.],
    [-1., 1., -1.],
    [-1., -1., 1.],
    [1., -1., 1.],
    [1., 1., 1.],
    [-1., 1., 1.],
];

pub(crate) fn cube() -> PolygonMesh {
    mesh(
        &CUBE,
        &[&[0, 3, 2, 1], &[4, 5, 6, 7], &[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]],
    )
}

/// A cube whose faces have their own normals, positions and texture coordinates: all edges are
/// creases and seams.
pub(crate) fn creased_cube() -> PolygonMesh {
    let shared = cube();
    let mut mesh = PolygonMesh::default();
    for face in &shared.faces {
        let corners = shared.corners(face);
        let [a, b, c, d] = corners.as_slice() else { panic!("quads") };
        let first = u32::try_from(mesh.positions.len()).unwrap();
        let numbers = Sides::Quad([first, first + 1, first + 2, first + 3]);
        mesh.positions.extend([*a, *b, *c, *d]);
        // Tilted, so that the two sides want different curves.
        let across = (*b - *a).cross(*c - *a);
        mesh.normals.extend([*a, *b, *c, *d].map(|corner| across + corner));
        mesh.texcoords.extend([Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y].map(|t| t * 0.7));
        mesh.faces.push(Face {
            positions: numbers,
            normals: Some(numbers),
            texcoords: Some(numbers),
        });
    }
    mesh
}

/// A torus of quads, every third one cut into two triangles, with a bumpy tube.
pub(crate) fn torus() -> PolygonMesh {
    let (rings, tubes) = (7u32, 5u32);
    let mut out = PolygonMesh::default();
    for i in 0..rings {
        for j in 0..tubes {
            let (a, b) = (i as f32 * 6.2831855 / rings as f32, j as f32 * 6.2831855 / tubes as f32);
            let r = 0.4 + 0.1 * ((i * 3 + j) % 4) as f32;
            let x = 2.0 + r * libm::cosf(b);
            out.positions.push(Vec3::new(x * libm::cosf(a), x * libm::sinf(a), r * libm::sinf(b)));
        }
    }
    for i in 0..rings {
        for j in 0..tubes {
            let at = |i: u32, j: u32| (i % rings) * tubes + j % tubes;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if (i + j) % 3 == 0 {
                out.faces.extend([face(&[a, b, c]), face(&[a, c, d])]);
            } else {
                out.faces.push(face(&[a, b, c, d]));
            }
        }
    }
    out
}

/// An open hilly grid.
pub(crate) fn hills() -> PolygonMesh {
    let n = 5u32;
    let mut out = PolygonMesh::default();
    for j in 0..=n {
        for i in 0..=n {
            let z = 0.3 * ((i * 7 + j * 5) % 6) as f32;
            out.positions.push(Vec3::new(i as f32, j as f32, z));
        }
    }
    let row = n + 1;
    for j in 0..n {
        for i in 0..n {
            let a = j * row + i;
            out.faces.push(face(&[a, a + 1, a + row + 1, a + row]));
        }
    }
    out
}

/// The hills with every face twice, once for each side.
pub(crate) fn leaf() -> PolygonMesh {
    let mut mesh = hills();
    let backs: Vec<Face> = mesh.faces.iter().map(back).collect();
    mesh.faces.extend(backs);
    mesh
}

/// A face with its corners in reverse order.
fn back(face: &Face) -> Face {
    let positions = match face.positions {
        Sides::Triangle([a, b, c]) => Sides::Triangle([a, c, b]),
        Sides::Quad([a, b, c, d]) => Sides::Quad([a, d, c, b]),
    };
    Face { positions, ..*face }
}

/// The hills with a fin of two quads on the edges between the second row and the third.
pub(crate) fn fin() -> PolygonMesh {
    let mut mesh = hills();
    let row = 2 * 6;
    let first = u32::try_from(mesh.positions.len()).unwrap();
    // Twisted: on a plane, the row next to an edge with one segment is so close to it that the two
    // are equal in 16.16.
    let lean = |i: usize| Vec3::new(0.0, 0.8 * (i % 2) as f32, 1.0);
    let tops: Vec<Vec3> = (0..3).map(|i| mesh.positions[row + 1 + i] + lean(i)).collect();
    mesh.positions.extend(tops);
    let below = u32::try_from(row + 1).unwrap();
    for i in 0..2 {
        mesh.faces.push(face(&[below + i, below + i + 1, first + i + 1, first + i]));
    }
    mesh
}

pub(crate) fn models() -> Vec<(&'static str, Model)> {
    let polygons = [
        ("octahedron", octahedron()),
        ("cube", cube()),
        ("creased cube", creased_cube()),
        ("torus", torus()),
        ("hills", hills()),
        ("leaf", leaf()),
        ("fin", fin()),
    ];
    let mut all = vec![
        ("teapot", Model::bezier(teapot::patches()).unwrap()),
        ("rational ball", Model::bezier(rational_ball()).unwrap()),
    ];
    for (name, mesh) in polygons {
        for style in [Style::Flat, Style::PointNormal] {
            all.push((name, Model::polygons(mesh.clone(), style).unwrap()));
        }
    }
    all
}

/// The unit ball as eight rational patches, each an eighth with one edge collapsed to a pole. Its
/// quarter circles are cubics, made from the rational quadratic by raising the degree.
pub(crate) fn rational_ball() -> Vec<BezierPatch> {
    let h = std::f32::consts::FRAC_1_SQRT_2;
    // (x, y, w) of a quarter circle of degree 2, raised to degree 3.
    let quadratic = [[1.0, 0.0, 1.0], [h, h, h], [0.0, 1.0, 1.0]];
    let raise = |a: [f32; 3], b: [f32; 3], s: f32, t: f32| [0, 1, 2].map(|k| a[k] * s + b[k] * t);
    let quarter = [
        quadratic[0],
        raise(quadratic[0], quadratic[1], 1.0 / 3.0, 2.0 / 3.0),
        raise(quadratic[2], quadratic[1], 1.0 / 3.0, 2.0 / 3.0),
        quadratic[2],
    ];
    let mut patches = Vec::new();
    for up in [1.0f32, -1.0] {
        for turn in 0..4 {
            let rotate = |x: f32, y: f32| match turn {
                0 => (x, y),
                1 => (-y, x),
                2 => (-x, -y),
                _ => (y, -x),
            };
            let point = |i: usize, j: usize| {
                // The parallel through the meridian's point, in homogeneous coordinates.
                let ([px, py, pw], [mr, mz, mw]) = (quarter[i], quarter[j]);
                let (x, y) = rotate(px * mr, py * mr);
                Vec4::new(x, y, pw * mz * up, pw * mw)
            };
            let column = |i: usize| if up > 0.0 { i } else { 3 - i };
            let points = std::array::from_fn(|j| std::array::from_fn(|i| point(column(i), j)));
            patches.push(BezierPatch { points });
        }
    }
    patches
}

pub(crate) fn rules() -> Vec<(&'static str, FactorRule)> {
    let eye = Vec3::new(3.0, -4.0, 2.5);
    vec![
        ("uniform 1", FactorRule::Uniform(1.0)),
        ("uniform 5.3", FactorRule::Uniform(5.3)),
        ("uniform 8", FactorRule::Uniform(8.0)),
        ("distance", FactorRule::Distance { eye, scale: 35.0 }),
        ("screen", FactorRule::ScreenSize { eye, pixels_per_unit: 700.0, segment: 25.0 }),
        ("flatness", FactorRule::Flatness { tolerance: 0.02 }),
    ]
}

pub(crate) fn bumps() -> Displacement {
    let texels = (0..64 * 64).map(|i| ((i * 37 + (i / 64) * 11) % 101) as f32 / 100.0).collect();
    Displacement::new(HeightMap::new(64, 64, texels).unwrap(), 0.1).unwrap()
}
