//! The committed header is what the sources generate.

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

/// With `TESS_BLESS` set, writes the header instead of comparing it.
#[test]
fn header_is_generated_from_the_sources() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(root.join("cbindgen.toml")).expect("a configuration");
    let mut generated = Vec::new();
    let mut sources = cbindgen::Builder::new().with_config(config);
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
