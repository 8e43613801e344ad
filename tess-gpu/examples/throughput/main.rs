//! Throughput of variants, stage by stage, against a fill of the same bytes.
#![allow(clippy::all, clippy::pedantic, missing_docs, reason = "experiment")]
use tess_check::workloads;
use tess_core::{Config, Domain, PatchFactors};
use tess_gpu::layout::factor_words;
use tess_gpu::runner::{Gpu, Outputs, Stopwatch, Tessellator, Wanted};
use tess_gpu::{Numbering, PointFormat, Setup, Stage};
use wgpu::BufferUsages as U;

fn edit_none(_: Stage, s: String) -> String {
    s
}
fn edit_wg256(_: Stage, s: String) -> String {
    s.replace("const WORKGROUP = 128u", "const WORKGROUP = 256u")
}
fn edit_wg64(_: Stage, s: String) -> String {
    s.replace("const WORKGROUP = 128u", "const WORKGROUP = 64u")
}
fn unroll(s: String) -> String {
    let mut s = s;
    for f in ["write_point", "write_primitive"] {
        let from = format!(
            "    for (var element = thread; element < TILE; element += WORKGROUP) {{\n        let at = tile.base + element;\n        if at >= tile.begin && at < tile.end {{\n            {f}(tile, element);\n        }}\n    }}\n"
        );
        if s.contains(&from) {
            let one = |k: u32| {
                format!(
                    "    if tile.base + thread + {k}u * WORKGROUP >= tile.begin && tile.base + thread + {k}u * WORKGROUP < tile.end {{ {f}(tile, thread + {k}u * WORKGROUP); }}\n"
                )
            };
            let all: String = (0..4).map(one).collect();
            s = s.replace(&from, &all);
        }
    }
    s
}
fn edit_unroll(_: Stage, s: String) -> String {
    unroll(s)
}
fn edit_nostore(_: Stage, s: String) -> String {
    s.replace("        indices_out[at] = triangle.x;\n        indices_out[at + 1u] = triangle.y;\n        indices_out[at + 2u] = triangle.z;",
      "        if (triangle.x ^ triangle.y ^ triangle.z) == 0xfffffff1u { indices_out[at] = triangle.x; }")
}
fn edit_storeonly(_: Stage, s: String) -> String {
    s.replace(
        "        let triangle = stitch_triangle(stitch, found.step);",
        "        let triangle = vec3<u32>(first, found.step, found.position);",
    )
}

fn fill(gpu: &Gpu, watch: &Stopwatch, buffers: &[&wgpu::Buffer], reps: usize) -> u64 {
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source: wgpu::ShaderSource::Wgsl(
        "@group(0) @binding(0) var<storage, read_write> out: array<vec4<u32>>;
         @compute @workgroup_size(256) fn fill(@builtin(workgroup_id) w: vec3<u32>, @builtin(num_workgroups) n: vec3<u32>, @builtin(local_invocation_index) t: u32) {
           let i = (w.x + w.y * n.x) * 256u + t; if i < arrayLength(&out) { out[i] = vec4<u32>(i, 1u, 2u, 3u); } }".into()) });
    let p = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: Some("fill"),
        compilation_options: Default::default(),
        cache: None,
    });
    let groups: Vec<_> = buffers
        .iter()
        .map(|b| {
            (
                b.size(),
                gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                    label: None,
                    layout: &p.get_bind_group_layout(0),
                    entries: &[wgpu::BindGroupEntry {
                        binding: 0,
                        resource: b.as_entire_binding(),
                    }],
                }),
            )
        })
        .collect();
    let mut ts: Vec<u64> = (0..reps)
        .map(|_| {
            watch
                .time(gpu, |e| {
                    let mut pass = e.begin_compute_pass(&Default::default());
                    pass.set_pipeline(&p);
                    for (size, g) in &groups {
                        let n = (size / 16).div_ceil(256) as u32;
                        pass.set_bind_group(0, g, &[]);
                        pass.dispatch_workgroups(n.min(65535), n.div_ceil(65535), 1);
                    }
                })
                .unwrap()
        })
        .collect();
    ts.sort();
    ts[ts.len() / 2]
}

fn main() {
    let arg = |k: usize, d: u64| std::env::args().nth(k).and_then(|s| s.parse().ok()).unwrap_or(d);
    let target = arg(1, 1 << 30);
    let reps = arg(2, 7) as usize;
    let gpu = pollster::block_on(Gpu::open_with(Wanted::Everything, Stopwatch::FEATURES)).unwrap();
    println!("{} binding {}", gpu.name(), gpu.device.limits().max_storage_buffer_binding_size);
    let watch = Stopwatch::new(&gpu).unwrap();
    fn nolink(s: String) -> String {
        s.replace(
            "for (var word = 0u; word < thread; word++) {",
            "for (var word = max(thread, 2u) - 2u; word < thread; word++) {",
        )
    }
    fn small(s: String) -> String {
        s.replace("array<u32, TILE>", "array<u32, 256>")
    }
    fn only(s: String) -> String {
        s.replace(
            "patch_index <= tile.last_patch; patch_index += 1u << share",
            "patch_index < tile.first_patch; patch_index += 1u << share",
        )
        .replace(
            "var element = thread; element < TILE;",
            "var element = thread + 60u*min(first, 1u) + TILE; element < TILE;",
        )
    }
    fn size(s: String, t: u32, w: u32) -> String {
        s.replace("const TILE = 1024u", &format!("const TILE = {t}u"))
            .replace("const WORKGROUP = 128u", &format!("const WORKGROUP = {w}u"))
    }
    let variants: Vec<(&str, fn(Stage, String) -> String)> = vec![
        ("1024/128", |_, s| size(s, 1024, 128)),
        ("1024/256", |_, s| size(s, 1024, 256)),
        ("512/64", |_, s| size(s, 512, 64)),
        ("512/128", |_, s| size(s, 512, 128)),
        ("512/256", |_, s| size(s, 512, 256)),
        ("256/32", |_, s| size(s, 256, 32)),
        ("256/64", |_, s| size(s, 256, 64)),
        ("256/128", |_, s| size(s, 256, 128)),
        ("256/64u", |_, s| unroll(size(s, 256, 64))),
    ];
    let names: Vec<String> = std::env::args().skip(3).collect();
    for name in &names {
        let w = &workloads::named(name).into_iter().find(|w| &w.name == name).unwrap();
        let totals = w.totals();
        let each = totals.points * 8 + totals.indices * 4;
        let times = (target / each).max(1);
        let patches: Vec<PatchFactors> = w.patches.clone();
        let mut words = factor_words(&patches);
        let one = words.clone();
        for _ in 1..times {
            words.extend_from_slice(&one);
        }
        let n = patches.len() as u64 * times;
        let domain = patches[0].domain();
        let setup = Setup::new(domain, w.config);
        let factors = gpu.upload("f", bytemuck::cast_slice(&words), U::STORAGE);
        let points = gpu.buffer("p", (totals.points * times * 32).next_multiple_of(16), U::STORAGE);
        let indices =
            gpu.buffer("i", (totals.indices * times * 16).next_multiple_of(48), U::STORAGE);
        let bytes = each * times;
        let f = fill(&gpu, &watch, &[&points, &indices], reps) / 4;
        println!(
            "{name}: {n} patches, {} triangles, {:.3} GB, fill {:.3} ms = {:.2} TB/s",
            totals.primitives * times,
            bytes as f64 / 1e9,
            f as f64 / 1e6,
            bytes as f64 / f as f64 / 1e3
        );
        for (vname, edit) in &variants {
            let mut t = Tessellator::with_edit(&gpu.device, *edit);
            let batch = t
                .batch(
                    setup,
                    n as u32,
                    &factors,
                    Outputs::Buffers { points: &points, indices: &indices },
                )
                .unwrap();
            let mut ts: Vec<u64> =
                (0..reps).map(|_| watch.time(&gpu, |e| batch.encode(e)).unwrap()).collect();
            ts.sort();
            let m = ts[ts.len() / 2];
            let stages = watch.time_stages(&gpu, &batch).unwrap();
            let mut agg: Vec<(String, u64)> = vec![];
            for (s, t) in stages {
                let k = format!("{s:?}");
                if let Some(e) = agg.iter_mut().find(|e| e.0 == k) {
                    e.1 += t
                } else {
                    agg.push((k, t))
                }
            }
            let st: String =
                agg.iter().map(|(k, t)| format!("{k} {:.0} ", *t as f64 / 1e3)).collect();
            println!(
                "  {vname:10} {:8.3} ms  {:7.1} Gtri/s {:6.2} Gpatch/s fill ratio {:.3} | us: {st}",
                m as f64 / 1e6,
                (totals.primitives * times) as f64 / m as f64,
                n as f64 / m as f64,
                f as f64 / m as f64
            );
        }
    }
}
