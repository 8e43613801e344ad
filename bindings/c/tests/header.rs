//! The committed header is what the sources generate.

use cbindgen::{Config, ConstantConfig, DocumentationStyle, Language, ParseConfig};
use std::path::Path;

/// The sources with an interface for C, in the order in which the header is best read.
const SOURCES: &[&str] = &[
    "version",
    "status",
    "shortage",
    "types",
    "patch",
    "process",
    "probe",
    "prepare",
    "batch",
    "batch/output",
    "batch/single",
    "surface",
    "device",
    "fuzz",
    "rules",
];

/// The first lines of the header.
const HEAD: &str = "/*
 * Bit-exact Direct3D 11 class tessellation.
 *
 * The caller owns all memory. Only the functions on batches, tess_fuzz() and tess_check_rules()
 * allocate. A function that can fail returns TESS_OK, or the reason for which it refused the call;
 * tess_status_message() describes it.
 * Null and misaligned pointers, unknown numbers, and buffers that are too small or overlap are refused
 * with a status and are never undefined behaviour. The library cannot check that the memory behind a
 * pointer is as large as the call states: the caller must ensure it.
 * All functions may be called from any number of threads at the same time, except that only one call
 * may use a batch at a time.
 *
 * Factors are any binary32 numbers, NaN included, in the order of their domain:
 *   isoline   density, detail
 *   triangle  outer U=0, V=0, W=0; inside
 *   quad      outer U=0, V=0, U=1, V=1; inside U, V
 */
";

const WARNING: &str = "/* Generated from the Rust sources of tess-capi by \
    `TESS_BLESS=1 cargo test -p tess-capi --test header`. Do not edit. */";

/// What cbindgen is asked for. Its reader of configuration files is generic, and would be compiled
/// into this program: ten times the rest of it.
fn config() -> Config {
    Config {
        language: Language::C,
        cpp_compat: true,
        include_guard: Some("TESS_H".to_owned()),
        no_includes: true,
        sys_includes: ["stddef.h", "stdint.h"].map(str::to_owned).to_vec(),
        autogen_warning: Some(WARNING.to_owned()),
        documentation_style: DocumentationStyle::Doxy,
        line_length: 100,
        usize_is_size_t: true,
        header: Some(HEAD.to_owned()),
        constant: ConstantConfig { allow_static_const: false, ..ConstantConfig::default() },
        parse: ParseConfig { parse_deps: false, ..ParseConfig::default() },
        ..Config::default()
    }
}

/// With `TESS_BLESS` set, writes the header instead of comparing it.
#[test]
fn header_is_generated_from_the_sources() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut generated = Vec::new();
    let mut sources = cbindgen::Builder::new().with_config(config());
    for file in SOURCES {
        sources = sources.with_src(root.join(format!("src/{file}.rs")));
    }
    sources.generate().expect("bindings").write(&mut generated);
    let generated = String::from_utf8(generated).expect("text");
    let generated = generated.replace("# Safety", "The caller must ensure:");

    let header = root.join("include/tess.h");
    if std::env::var_os("TESS_BLESS").is_some() {
        std::fs::write(&header, &generated).expect("the header can be written");
    }
    let committed = std::fs::read_to_string(&header).expect("include/tess.h");
    for (number, (ours, theirs)) in generated.lines().zip(committed.lines()).enumerate() {
        assert_eq!(
            ours,
            theirs,
            "line {}: include/tess.h is stale; see its first lines",
            number + 1
        );
    }
    assert_eq!(generated, committed, "include/tess.h is stale; see its first lines");
}
