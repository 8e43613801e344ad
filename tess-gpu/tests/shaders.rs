//! Every shader in every setup is valid, has no floats, and has the host's layouts.

mod common;

use common::evaluate::{self, Argument};
use common::{COUNTING, DRAWING, PULLING, all_setups, parse};
use naga::{AddressSpace, Module, ScalarKind, TypeInner};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;
use tess_core::{Config, Domain, DomainPoint, OutputPrimitive, Partitioning, Patch, PatchFactors};
use tess_gpu::{Access, Binding, Counting, Pull, Resource, Setup, Stage, Tap, layout};
use tess_testkit::wgsl_faults;

#[test]
#[ignore = "slow: 480 setups"]
fn every_shader_of_every_setup_is_sound() {
    let setups = all_setups();
    assert_eq!(
        setups.len(),
        96 * (2 * 2 + 1),
        "domains x partitionings x outputs x splits, formats x numberings and 16-bit indices"
    );
    let all = modules(&setups);
    all.iter().for_each(|(_, source, module)| common::validate(source, module));
    has_no_floats(&all);
    has_the_bindings(&all);
    keeps_to_the_default_limits(&all);
    let pull = Pull { group: 0, first_binding: 0 };
    let others = setups.into_iter().flat_map(|setup| {
        let library = [
            pull.source(setup) + PULLING,
            pull.source_for_drawing(setup) + DRAWING,
            Counting { group: 0, binding: 0 }.source(setup) + COUNTING,
        ];
        Tap::ALL.map(|tap| tap.source(setup)).into_iter().chain(library)
    });
    for source in others.collect::<BTreeSet<_>>() {
        common::validate(&source, &parse(&source));
    }
}

/// The distinct sources of all stages in these setups, and their modules.
fn modules(setups: &[Setup]) -> Vec<(Stage, String, Module)> {
    let of_stage = |stage: Stage| setups.iter().map(move |&setup| (stage.source(setup), stage));
    let distinct: BTreeMap<String, Stage> = Stage::ALL.into_iter().flat_map(of_stage).collect();
    let with_module = |(source, stage): (String, Stage)| {
        let module = parse(&source);
        (stage, source, module)
    };
    distinct.into_iter().map(with_module).collect()
}

/// The modules of every seventh setup, in which every two values of two options occur together.
fn stages() -> &'static [(Stage, String, Module)] {
    static STAGES: LazyLock<Vec<(Stage, String, Module)>> = LazyLock::new(|| {
        let some: Vec<Setup> = all_setups().into_iter().step_by(7).collect();
        modules(&some)
    });
    &STAGES
}

#[test]
fn every_pair_of_options_is_in_a_seventh_of_the_setups() {
    let options = |setup: Setup| {
        let Config { partitioning, output, split } = setup.config;
        let formats = (setup.point_format, setup.index_type);
        [
            format!("{:?}", setup.domain),
            format!("{partitioning:?}"),
            format!("{output:?}"),
            format!("{split:?}"),
            format!("{formats:?}"),
            format!("{:?}", setup.numbering),
        ]
    };
    let mut missing = BTreeSet::new();
    for setup in all_setups() {
        missing.extend(pairs(&options(setup)));
    }
    for setup in all_setups().into_iter().step_by(7) {
        for pair in pairs(&options(setup)) {
            missing.remove(&pair);
        }
    }
    assert!(missing.is_empty(), "{missing:?}");
}

/// Every two of the texts, in their order.
fn pairs(texts: &[String]) -> Vec<[String; 2]> {
    let later = |at: usize| texts[at + 1..].iter().map(move |other| [&texts[at], other]);
    (0..texts.len()).flat_map(later).map(|pair| pair.map(String::clone)).collect()
}

/// A planted fault changes a shader, but the shader stays valid: the comparison has to notice the
/// fault, not the compiler.
#[test]
fn every_fault_can_be_planted() {
    let setups = all_setups();
    let faults = wgsl_faults::of_batches();
    let names: BTreeSet<&str> = faults.iter().map(|fault| fault.name.as_str()).collect();
    assert_eq!((names.len(), faults.len()), (90, 90), "each name stands once");
    for fault in faults {
        let with_fault = setups.iter().step_by(7).find_map(|&setup| {
            Stage::ALL.iter().find_map(|stage| fault.planted(&stage.source(setup)))
        });
        let with_fault = with_fault.unwrap_or_else(|| panic!("{fault:?} is in no shader"));
        common::validate(&with_fault, &parse(&with_fault));
    }
}

/// The rule of the project: no float arithmetic, and not even a float type.
#[test]
fn no_stage_knows_floats() {
    has_no_floats(stages());
}

fn has_no_floats(stages: &[(Stage, String, Module)]) {
    for (stage, _, module) in stages {
        let found = float_types(module);
        assert!(found.is_empty(), "{}: {found:?}", stage.entry_point());
    }
}

#[test]
fn the_house_rule_sees_floats() {
    for planted in
        ["fn f(a: f32) -> f32 { return a + a; }", "fn g(a: u32) -> u32 { return u32(f32(a)); }"]
    {
        assert!(!float_types(&parse(planted)).is_empty(), "{planted}");
    }
}

/// The types of a module that contain floats, and its float literals.
fn float_types(module: &Module) -> Vec<String> {
    let scalar_of = |inner: &TypeInner| match *inner {
        TypeInner::Scalar(scalar)
        | TypeInner::Vector { scalar, .. }
        | TypeInner::Matrix { scalar, .. }
        | TypeInner::Atomic(scalar) => Some(scalar.kind),
        _ => None,
    };
    let is_float = |kind| matches!(kind, ScalarKind::Float | ScalarKind::AbstractFloat);
    let types = module
        .types
        .iter()
        .filter(|(_, ty)| scalar_of(&ty.inner).is_some_and(is_float))
        .map(|(_, ty)| format!("{ty:?}"));
    let arenas = module.functions.iter().map(|(_, function)| &function.expressions);
    let entries = module.entry_points.iter().map(|entry| &entry.function.expressions);
    let literals = arenas
        .chain(entries)
        .chain([&module.global_expressions])
        .flat_map(|arena| arena.iter())
        .filter_map(|(_, expression)| match expression {
            naga::Expression::Literal(literal) if is_float(literal.scalar().kind) => {
                Some(format!("{literal:?}"))
            }
            naga::Expression::As { kind, .. } if is_float(*kind) => Some(format!("{expression:?}")),
            _ => None,
        });
    types.chain(literals).collect()
}

#[test]
fn bindings_are_those_of_the_shaders() {
    has_the_bindings(stages());
}

fn has_the_bindings(stages: &[(Stage, String, Module)]) {
    for (stage, _, module) in stages {
        let mut found: Vec<(u32, Access, bool)> = module
            .global_variables
            .iter()
            .filter_map(|(_, variable)| {
                let binding = variable.binding?;
                assert_eq!(binding.group, 0, "{variable:?}");
                let (access, is_uniform) = match variable.space {
                    AddressSpace::Uniform => (Access::Read, true),
                    AddressSpace::Storage { access }
                        if access.contains(naga::StorageAccess::STORE) =>
                    {
                        (Access::ReadWrite, false)
                    }
                    _ => (Access::Read, false),
                };
                Some((binding.binding, access, is_uniform))
            })
            .collect();
        found.sort_by_key(|&(number, ..)| number);
        let expected: Vec<_> = (0..)
            .zip(stage.bindings())
            .map(|(number, &Binding(resource, access))| (number, access, resource == Resource::Job))
            .collect();
        assert_eq!(found, expected, "{}", stage.entry_point());
        let storage = expected.iter().filter(|(.., is_uniform)| !is_uniform).count();
        assert!(storage <= 8, "{}: {storage} storage buffers", stage.entry_point());
    }
}

#[test]
fn layouts_are_those_of_the_shaders() {
    let source = Stage::Totals.source(all_setups()[0]);
    let module = parse(&source);
    assert_eq!(struct_size(&module, "Job"), size_of::<layout::Job>(), "Job");
    assert_eq!(struct_size(&module, "Range"), size_of::<layout::Range>(), "Range");
    let expected = [
        "patches",
        "first_patch",
        "portion",
        "stride",
        "blocks_at",
        "alike_at",
        "sections_at",
        "primitive_tiles_at",
        "window_first",
        "window_tiles",
        "portions",
        "point_capacity",
        "primitive_capacity",
        "point_windows",
        "primitive_windows",
        "point_window_tiles",
        "primitive_window_tiles",
        "max_workgroups",
        "tile_bits",
        "has_catalogue",
    ];
    let fields = layout::Job {
        patches: 0,
        first_patch: 1,
        portion: 2,
        stride: 3,
        blocks_at: 4,
        alike_at: 5,
        sections_at: 6,
        primitive_tiles_at: 7,
        window_first: 8,
        window_tiles: 9,
        portions: 10,
        point_capacity: 11,
        primitive_capacity: 12,
        point_windows: 13,
        primitive_windows: 14,
        point_window_tiles: 15,
        primitive_window_tiles: 16,
        max_workgroups: 17,
        tile_bits: 18,
        has_catalogue: 19,
    };
    let words: &[u32] = bytemuck::cast_slice(bytemuck::bytes_of(&fields));
    assert_eq!(words, (0..20).collect::<Vec<_>>(), "the host's members are in this order");
    assert_eq!(members(&module, "Job"), (0..).map(|n| 4 * n).zip(expected).collect::<Vec<_>>());
    let ranges = members(&module, "Status").into_iter().find(|&(_, name)| name == "ranges");
    assert_eq!(ranges, Some((size_of::<layout::Status>(), "ranges")));
    let status = ["points", "points_high", "primitives", "primitives_high", "overflow"];
    assert_eq!(
        members(&module, "Status")[..5],
        (0..).map(|n| 4 * n).zip(status).collect::<Vec<_>>()
    );
}

/// Each bit of two words in turn, and no bit.
fn words_of_one_bit() -> impl Iterator<Item = [u32; 2]> {
    (0..=64).map(|bit| 1u64.checked_shl(bit).unwrap_or(0)).map(|bits| {
        let [low, high] = [bits, bits >> 32].map(|half| half & u64::from(u32::MAX));
        [low, high].map(|half| u32::try_from(half).expect("32 bits"))
    })
}

/// Topologies and contexts have the same bits in both languages: each accessor reads them from the
/// same place.
#[test]
fn packed_words_are_read_alike() {
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let module = parse(&Stage::ExpandPoints.source(Setup::new(Domain::Quad, config)));
    for words in words_of_one_bit() {
        let shaders = |name| evaluate::call(&module, name, &[Argument::Two(words)]);
        let topology = layout::Topology(words);
        assert_eq!(shaders("state_of"), topology.state(), "{words:x?}");
        let inside = ["inside_u", "inside_v"].map(shaders);
        assert_eq!(inside, topology.inside_points(), "{words:x?}");
        for edge in 0..4 {
            let arguments = [Argument::Two(words), Argument::One(edge)];
            let points = evaluate::call(&module, "outer_points", &arguments);
            assert_eq!(points, topology.outer_points(edge), "{words:x?}, edge {edge}");
        }
        let context = layout::unpack_context(words);
        // The shaders omit the top bit of `inv_ceil`, because it is set only where `inv_ceil`
        // multiplies 0.
        let rest = context.inv_ceil & 0xffff;
        for (name, expected) in [
            ("inv_floor_of", context.inv_floor),
            ("inv_ceil_of", rest),
            ("fraction_of", context.fraction),
            ("half_points_of", context.half_points),
            ("split_of", context.split_position),
            ("odd_of", context.parity.odd()),
        ] {
            assert_eq!(shaders(name), expected, "{name} of {words:x?}");
        }
    }
}

/// Two numbers of 64 bits, low word first, then a bit for each output that does not fit.
#[test]
fn a_status_is_read_from_its_words() {
    let status: layout::Status = bytemuck::cast([1, 2, 3, 4, 0, 0, 0, 0_u32]);
    assert_eq!([status.points(), status.primitives()], [0x2_0000_0001, 0x4_0000_0003]);
    for (overflow, points, indices) in
        [(0, false, false), (1, true, false), (2, false, true), (3, true, true)]
    {
        let status: layout::Status = bytemuck::cast([0, 0, 0, 0, overflow, 0, 0, 0_u32]);
        assert_eq!([status.points_overflow(), status.indices_overflow()], [points, indices]);
        assert_eq!(status.fits(), overflow == 0, "overflow {overflow}");
    }
}

/// u in bits 0 to 16, v in bits 17 to 33, the patch in the rest.
#[test]
fn points_are_packed_into_64_bits() {
    for (u, v, patch) in
        [(0x10000, 0, 0), (0, 0x10000, 0), (0, 0x8000, 5), (0x5555, 0xaaaa, (1 << 30) - 1)]
    {
        let packed = layout::PackedPoint::new(DomainPoint::from_bits(u, v), patch);
        let [low, high] = packed.0.map(u64::from);
        let expected = u64::from(u) | u64::from(v) << 17 | u64::from(patch) << 34;
        assert_eq!(low | high << 32, expected, "{u:x} {v:x} {patch}");
        let point = packed.point();
        assert_eq!([point.u.to_bits(), point.v.to_bits(), packed.patch()], [u, v, patch]);
    }
}

#[test]
fn contexts_keep_their_bits_when_packed() {
    for partitioning in [Partitioning::FractionalOdd, Partitioning::FractionalEven] {
        let config = Config::new(partitioning, OutputPrimitive::Point);
        for eighths in 8..=512_u16 {
            let raw = PatchFactors::uniform(Domain::Quad, f32::from(eighths) / 8.0);
            let patch = Patch::new(config, raw);
            let Some(PatchFactors::Quad(factors)) = patch.processed().factors() else { continue };
            let context = factors.inside_u.context;
            let packed = layout::pack_context(&context);
            assert_eq!(layout::unpack_context(packed), context, "{partitioning:?} {eighths}/8");
        }
    }
}

fn members<'a>(module: &'a Module, name: &str) -> Vec<(usize, &'a str)> {
    let TypeInner::Struct { members, .. } = structure(module, name) else { unreachable!() };
    let named = |member: &'a naga::StructMember| {
        (member.offset as usize, member.name.as_deref().unwrap_or_default())
    };
    members.iter().map(named).collect()
}

fn struct_size(module: &Module, name: &str) -> usize {
    let TypeInner::Struct { span, .. } = structure(module, name) else { unreachable!() };
    *span as usize
}

fn structure<'a>(module: &'a Module, name: &str) -> &'a TypeInner {
    let found = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name));
    let (_, ty) = found.unwrap_or_else(|| panic!("no structure {name}"));
    assert!(matches!(ty.inner, TypeInner::Struct { .. }), "{name} is a structure");
    &ty.inner
}

/// WebGPU guarantees 16 KiB of workgroup memory and 256 invocations.
#[test]
fn workgroups_keep_to_the_default_limits() {
    keeps_to_the_default_limits(stages());
}

fn keeps_to_the_default_limits(stages: &[(Stage, String, Module)]) {
    for (stage, _, module) in stages {
        let mut layouter = naga::proc::Layouter::default();
        layouter.update(module.to_ctx()).expect("types have layouts");
        let shared: u32 = module
            .global_variables
            .iter()
            .filter(|(_, variable)| variable.space == AddressSpace::WorkGroup)
            .map(|(_, variable)| layouter[variable.ty].size)
            .sum();
        assert!(shared <= 16384, "{}: {shared} bytes", stage.entry_point());
        for entry in &module.entry_points {
            let threads: u32 = entry.workgroup_size.iter().product();
            assert!(threads <= 256, "{}: {threads} threads", entry.name);
        }
    }
}

/// Hosts without `tess-wgpu` join modules of surfaces themselves, the whole stage's or single ones.
#[test]
fn surfaces_are_joined_by_hand() {
    use tess_gpu::surfaces::{CULLING, DISPLACEMENT, FLAT, HELPERS};
    for module in [FLAT, CULLING] {
        assert!(HELPERS.contains(module), "the stage's modules are whole: {module}");
    }
    for text in [FLAT.to_owned(), CULLING.to_owned(), [HELPERS, DISPLACEMENT].join("\n")] {
        let module = naga::front::wgsl::parse_str(&text)
            .unwrap_or_else(|error| panic!("{}", error.emit_to_string(&text)));
        assert!(module.functions.len() > 1, "functions alone");
        assert!(module.entry_points.is_empty() && module.global_variables.is_empty(), "no more");
    }
}
