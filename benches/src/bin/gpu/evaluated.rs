//! Times frames that draw one tessellation in one, two or four passes: with `domain` in each vertex
//! shader, or evaluated once. Evaluated vertices are loaded as the stage does it, from a storage
//! buffer if they are large, and for comparison as attributes.

mod scene;

use crate::Result;
use crate::timing::device_time;
use scene::{Scene, Targets, Way};
use std::time::Duration;
use tess_core::Order;
use tess_wgpu::{DeviceLimits, Gpu, Stopwatch};

/// The time for which each frame is repeated.
const LONG_ENOUGH: Duration = Duration::from_millis(120);

/// Factors, and the patches along each side that give two million triangles with them.
const SIZES: [[u32; 2]; 3] = [[4, 256], [16, 64], [64, 16]];

/// Octaves of noise in `domain`, each of about 40 instructions.
const OCTAVES: [u32; 4] = [1, 2, 4, 32];

const PASSES: [usize; 3] = [1, 2, 4];

/// The members of `Vertex` beside its position, which has 16 bytes.
struct Form {
    /// Bytes from one vertex to the next.
    bytes: u32,
    members: &'static str,
    /// Their values.
    values: &'static str,
    /// The member or expression that the fragment shader lights.
    normal: &'static str,
}

const FORMS: [Form; 4] = [
    Form { bytes: 16, members: "", values: "", normal: "vec3f(0.0, 0.0, 1.0)" },
    Form {
        bytes: 32,
        members: "@location(0) normal: vec3f,",
        values: ", normal",
        normal: "vertex.normal",
    },
    Form {
        bytes: 48,
        members: "@location(0) normal: vec3f, @location(1) uv: vec2f,",
        values: ", normal, at",
        normal: "vertex.normal + vec3f(vertex.uv, 0.0)",
    },
    Form {
        bytes: 64,
        members: "@location(0) normal: vec3f, @location(1) uv: vec2f, @location(2) tangent: vec4f,",
        values: ", normal, at, vec4f(normal.zxy, 1.0)",
        normal: "vertex.normal + vec3f(vertex.uv, 0.0) * vertex.tangent.w",
    },
];

impl Form {
    /// The WGSL of hills with these vertices.
    fn text(&self, [factor, side]: [u32; 2], octaves: u32) -> String {
        include_str!("evaluated/hills.wgsl")
            .replace("MEMBERS", self.members)
            .replace("VALUES", self.values)
            .replace("NORMAL", self.normal)
            .replace("FACTOR", &format!("{factor}.0"))
            .replace("SIDE", &format!("{side}u"))
            .replace("OCTAVES", &octaves.to_string())
    }
}

/// The device, and what frames are timed with.
struct Bench {
    gpu: Gpu,
    stopwatch: Stopwatch,
    targets: Targets,
}

/// Prints the device's times in microseconds, of `prepare` alone and of whole frames, and the
/// quotients of frames and the frame of stored points.
pub(crate) fn run() -> Result<()> {
    let gpu = pollster::block_on(Gpu::open_with(DeviceLimits::Highest, Stopwatch::FEATURES))?;
    let stopwatch = Stopwatch::new(&gpu)?;
    println!("{}", gpu.name());
    let bench = Bench { targets: Targets::new(&gpu), gpu, stopwatch };
    bench.compare_forms()?;
    bench.compare_orders()
}

impl Bench {
    /// Vertices of each size, with all factors, octaves and numbers of passes.
    fn compare_forms(&self) -> Result<()> {
        println!(
            "                                    stored us         evaluated us       attributes"
        );
        println!(
            "bytes factor octaves passes  prepare    frame  prepare    frame  ratio      ratio"
        );
        for form in &FORMS {
            for size in SIZES {
                for octaves in OCTAVES {
                    let text = form.text(size, octaves);
                    self.compare_passes(form, size, (&text, octaves))?;
                }
            }
        }
        Ok(())
    }

    #[expect(clippy::float_arithmetic, reason = "quotients of times")]
    fn compare_passes(
        &self,
        form: &Form,
        [factor, side]: [u32; 2],
        (text, octaves): (&str, u32),
    ) -> Result<()> {
        let of = |way| Scene::new(&self.gpu, (text, side * side), way, Order::VertexCache);
        let [stored, evaluated, attributes] =
            [of(Way::Stored)?, of(Way::Evaluated)?, of(Way::Attributes)?];
        for passes in PASSES {
            let [[a, b], [c, d]] = [self.times(&stored, passes)?, self.times(&evaluated, passes)?];
            let [_, e] = self.times(&attributes, passes)?;
            println!(
                "{:5} {factor:6} {octaves:7} {passes:6} {a:8.1} {b:8.1} {c:8.1} {d:8.1} {:6.3} {:10.3}",
                form.bytes,
                d / b,
                e / b
            );
        }
        Ok(())
    }

    /// The orders of a patch's triangles, with vertices of 48 bytes and two octaves.
    #[expect(clippy::float_arithmetic, reason = "a quotient of times")]
    fn compare_orders(&self) -> Result<()> {
        println!("\nframes with 48 bytes and 2 octaves, us: order, then stored and evaluated");
        println!("factor passes          order   stored evaluated  ratio");
        for size @ [factor, side] in SIZES {
            let text = FORMS[2].text(size, 2);
            for order in [Order::VertexCache, Order::Specification] {
                let of = |way| Scene::new(&self.gpu, (&text, side * side), way, order);
                let [stored, evaluated] = [of(Way::Stored)?, of(Way::Evaluated)?];
                for passes in [1, 4] {
                    let [_, b] = self.times(&stored, passes)?;
                    let [_, d] = self.times(&evaluated, passes)?;
                    let order = format!("{order:?}");
                    println!("{factor:6} {passes:6} {order:>14} {b:8.1} {d:9.1} {:6.3}", d / b);
                }
            }
        }
        Ok(())
    }

    /// The times of `prepare` alone and of a frame: one `prepare`, and this number of passes.
    fn times(&self, scene: &Scene, passes: usize) -> Result<[f64; 2]> {
        let time = |passes| {
            let record = |encoder: &mut wgpu::CommandEncoder| {
                scene.record(encoder, &self.targets, passes);
            };
            device_time(&self.gpu, &self.stopwatch, LONG_ENOUGH, record)
        };
        Ok([time(0)?, time(passes)?])
    }
}
