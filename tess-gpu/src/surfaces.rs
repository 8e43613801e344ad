#![doc = include_str!("../shaders/surfaces/README.md")]

/// The text of a module.
macro_rules! module {
    ($name:literal) => {
        include_str!(concat!("../shaders/surfaces/", $name, ".wgsl"))
    };
}

/// The modules that the stage of `tess-wgpu` joins to the user's functions: [`FLAT`], [`PN_EDGE`],
/// [`FACTORS`], [`CULLING`], [`HEIGHT`].
pub const HELPERS: &str = concat!(
    module!("flat"),
    "\n",
    module!("pn_edge"),
    "\n",
    module!("factors"),
    "\n",
    module!("culling"),
    "\n",
    module!("height"),
);

/// Lines, bilinear quads and flat triangles, closed along edges.
pub const FLAT: &str = module!("flat");

/// The inner control points of a point-normal edge.
pub const PN_EDGE: &str = module!("pn_edge");

/// Factor rules for edges and insides. Needs [`PN_EDGE`].
pub const FACTORS: &str = module!("factors");

/// Tests that cull patches.
pub const CULLING: &str = module!("culling");

/// Height images.
pub const HEIGHT: &str = module!("height");

/// Curves, edges in canonical direction, bicubic patches and their normals.
pub const BEZIER: &str = module!("bezier");

/// Factor rules for cubic edges. Needs [`BEZIER`], [`FACTORS`] and [`PN_EDGE`].
pub const BEZIER_FACTORS: &str = module!("bezier_factors");

/// Point-normal triangles and quads. Needs [`PN_EDGE`].
pub const POINT_NORMAL: &str = module!("pn");

/// A point-normal triangle at a domain point, closed along its edges. Needs [`BEZIER`],
/// [`POINT_NORMAL`] and [`PN_EDGE`].
pub const PN_TRIANGLE: &str = module!("pn_triangle");

/// Positions and normals of displaced surfaces.
pub const DISPLACEMENT: &str = module!("displacement");

/// A module, for programs that write or serve all of them.
#[derive(Clone, Copy, Debug)]
pub struct Module {
    /// The name in the tables above; `NAME.wgsl` is its file.
    pub name: &'static str,
    /// The text.
    pub source: &'static str,
    /// The names of all modules that it needs.
    pub needs: &'static [&'static str],
}

/// All modules.
pub const MODULES: &[Module] = &[
    Module { name: "flat", source: FLAT, needs: &[] },
    Module { name: "pn_edge", source: PN_EDGE, needs: &[] },
    Module { name: "factors", source: FACTORS, needs: &["pn_edge"] },
    Module { name: "culling", source: CULLING, needs: &[] },
    Module { name: "height", source: HEIGHT, needs: &[] },
    Module { name: "bezier", source: BEZIER, needs: &[] },
    Module {
        name: "bezier_factors",
        source: BEZIER_FACTORS,
        needs: &["bezier", "factors", "pn_edge"],
    },
    Module { name: "pn", source: POINT_NORMAL, needs: &["pn_edge"] },
    Module { name: "pn_triangle", source: PN_TRIANGLE, needs: &["bezier", "pn", "pn_edge"] },
    Module { name: "displacement", source: DISPLACEMENT, needs: &[] },
];

/// The documentation of this module in Markdown, with the tables of all modules and functions.
pub const README: &str = include_str!("../shaders/surfaces/README.md");

#[cfg(test)]
mod tests {
    use super::*;
    use naga::valid::{Capabilities, ValidationFlags, Validator};

    /// The names of a module's functions; an error if the module is not valid.
    fn functions(text: &str) -> Result<Vec<String>, String> {
        let module = naga::front::wgsl::parse_str(text).map_err(|e| e.emit_to_string(text))?;
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        validator.validate(&module).map_err(|e| e.emit_to_string(text))?;
        Ok(module.functions.iter().filter_map(|(_, function)| function.name.clone()).collect())
    }

    fn module(name: &str) -> &'static Module {
        MODULES.iter().find(|module| module.name == name).expect("a module that is needed is there")
    }

    /// Every module is valid with the modules that it needs, and invalid without any one of them.
    #[test]
    fn modules_are_valid_with_what_they_need() {
        for Module { name, source, needs } in MODULES {
            let with = |left_out: Option<&str>| {
                let needed = needs.iter().filter(|need| Some(**need) != left_out);
                let needed = needed.map(|need| module(need).source);
                functions(&needed.chain([*source]).collect::<Vec<_>>().join("\n"))
            };
            with(None).unwrap_or_else(|error| panic!("{name}: {error}"));
            for need in *needs {
                assert!(with(Some(need)).is_err(), "{name} does not need {need}");
            }
        }
    }

    /// The first two cells of the rows of the table in [`README`] whose head begins with this word.
    fn rows(head: &str) -> Vec<[&'static str; 2]> {
        let (_, table) = README.split_once(&format!("| {head} |")).expect("the table");
        let lines = table.lines().skip(2).take_while(|line| line.starts_with('|'));
        let cells = lines.map(|line| line.split('|').map(str::trim).collect::<Vec<_>>());
        cells.map(|cells| [cells[1], cells[2]]).collect()
    }

    /// The names between backticks, without parameters.
    fn names(cell: &str) -> Vec<&str> {
        let quoted = cell.split('`').skip(1).step_by(2);
        quoted.map(|name| name.split('(').next().unwrap_or(name)).collect()
    }

    #[test]
    fn the_tables_have_every_module_and_function() {
        let listed: Vec<_> =
            rows("module").iter().map(|[name, needs]| (names(name)[0], names(needs))).collect();
        let own: Vec<_> = MODULES.iter().map(|it| (it.name, it.needs.to_vec())).collect();
        assert_eq!(listed, own, "modules");
        let mut listed: Vec<_> =
            rows("function").iter().flat_map(|[cell, _]| names(cell)).collect();
        let all: Vec<_> = MODULES.iter().map(|module| module.source).collect();
        let mut own = functions(&all.join("\n")).unwrap_or_else(|error| panic!("{error}"));
        listed.sort_unstable();
        own.sort_unstable();
        assert_eq!(listed, own, "functions");
    }

    #[test]
    fn the_stage_joins_the_first_five() {
        let first: Vec<_> = MODULES[..5].iter().map(|module| module.source).collect();
        assert_eq!(first.join("\n"), HELPERS, "in the order of the table");
    }

    /// The table has the parameters that the functions have.
    #[test]
    fn the_table_has_the_parameters() {
        for [cell, _] in rows("function") {
            for call in cell.split('`').skip(1).step_by(2).filter(|call| call.contains('(')) {
                let (name, parameters) = call.trim_end_matches(')').split_once('(').expect("both");
                let module = MODULES.iter().find(|it| it.source.contains(&format!("fn {name}(")));
                let (_, rest) = module
                    .expect("a function")
                    .source
                    .split_once(&format!("fn {name}("))
                    .expect("it");
                let declared = rest.split_once(") ->").expect("a result").0;
                // Types have commas of their own.
                let names = declared
                    .split(':')
                    .map(|part| part.rsplit([',', ' ', '\n']).next().unwrap_or(part));
                let names: Vec<_> = names.take(declared.matches(':').count()).collect();
                assert_eq!(parameters.split(", ").collect::<Vec<_>>(), names, "{name}");
            }
        }
    }

    /// The stage's helpers have the prefix `tess_`, so that users may declare any other name. Other
    /// modules do not have it.
    #[test]
    fn helpers_have_the_prefix() {
        let names = functions(HELPERS).unwrap_or_else(|error| panic!("{error}"));
        assert!(names.iter().all(|name| name.starts_with("tess_")), "{names:?}");
        let others = [BEZIER, BEZIER_FACTORS, POINT_NORMAL, PN_TRIANGLE, DISPLACEMENT, HELPERS];
        let all = functions(&others.join("\n")).unwrap_or_else(|error| panic!("{error}"));
        let prefixed = all.iter().filter(|name| name.starts_with("tess_")).count();
        assert_eq!(prefixed, names.len(), "no others have it: {all:?}");
    }

    #[test]
    fn a_broken_module_is_told() {
        let broken = BEZIER.replacen("return", "retrun", 1);
        assert!(functions(&broken).is_err(), "a misspelt keyword");
        let broken = FLAT.replacen("-> vec4<f32>", "-> f32", 1);
        assert!(functions(&broken).is_err(), "a wrong type");
    }
}
