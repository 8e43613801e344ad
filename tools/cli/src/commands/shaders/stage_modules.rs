//! The modules of a stage: their passes with bindings and workgroups, as files or as shaders for
//! SDL.

use super::programs::{self, Program, Programs};
use super::stage_manifest::{Attribute, Bound, Pass, Vertex, Workgroups};
use super::translation::Translation;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{AddressSpace, GlobalVariable, Module, StorageAccess};
use tess_wgpu::stage::{FixedShaders, UserShaders, VertexLayout};

const HULL: &str = "stage_hull.wgsl";
const COPY_FACTORS: &str = "stage_copy_factors.wgsl";
const FIT: &str = "stage_fit.wgsl";
const EVALUATE: &str = "stage_evaluate.wgsl";
const VERTEX: &str = "stage_vertex.wgsl";

/// Entry points, and what their workgroups depend on.
type Entry = (&'static str, Workgroups);

const HULL_PASS: Entry = ("tess_hull", Workgroups::Patches);
const COPY_PASS: Entry = ("copy_factors", Workgroups::Patches);
const EVALUATE_PASS: Entry = ("tess_evaluate", Workgroups::Points);
const FIT_PASSES: [Entry; 5] = [
    ("count_whole", Workgroups::Patches),
    ("decide", Workgroups::One),
    ("count_coarse", Workgroups::FitArguments),
    ("count_fine", Workgroups::FitArguments),
    ("scale_factors", Workgroups::FitArguments),
];

/// The buffers of the stage's variables.
const BUFFERS: [(&str, &str); 13] = [
    ("tess_written_factors", "factors"),
    ("tess_drawn_factors", "factors"),
    ("factors", "factors"),
    ("tess_frame", "patch_count"),
    ("patches", "patch_count"),
    ("given", "given_factors"),
    ("fit", "fit"),
    ("terms", "terms"),
    ("arguments", "fit_arguments"),
    ("tess_packed_points", "points"),
    ("tess_vertices", "vertices"),
    ("tess_status", "status"),
    ("tess_window", "window"),
];

/// The buffer of a variable of the stage.
fn own_buffer(variable: &str) -> Option<&'static str> {
    BUFFERS.iter().find(|(own, _)| *own == variable).map(|(_, buffer)| *buffer)
}

/// A module in WGSL with entry points of passes.
pub(super) struct Source {
    file: &'static str,
    text: String,
    /// The stage's own bind group; the user's are before it.
    group: u32,
    part: &'static str,
    entries: &'static [Entry],
}

impl Source {
    const fn new(
        file: &'static str,
        text: String,
        group: u32,
        part: &'static str,
        entries: &'static [Entry],
    ) -> Self {
        Self { file, text, group, part, entries }
    }
}

/// The modules of a stage.
pub(super) struct Sources {
    pub(super) before: Vec<Source>,
    pub(super) after: Vec<Source>,
    /// The module of draws, which has the user's fragment shaders too.
    pub(super) drawn: Option<String>,
    group: u32,
}

impl Sources {
    pub(super) fn new(user: UserShaders, fixed: &FixedShaders, is_parts: bool) -> Self {
        let group = user.group;
        let hull = user.hull.map(|text| Source::new(HULL, text, group, "hull", &[HULL_PASS]));
        // The parts have both, so that the host can choose.
        let copy = (is_parts || hull.is_none()).then(|| {
            let text = fixed.copy_factors.clone();
            Source::new(COPY_FACTORS, text, 0, "copy_factors", &[COPY_PASS])
        });
        let fit = Source::new(FIT, fixed.fit.clone(), 0, "fit", &FIT_PASSES);
        let evaluate = user
            .evaluate
            .map(|text| Source::new(EVALUATE, text, group, "evaluate", &[EVALUATE_PASS]));
        Self {
            before: hull.into_iter().chain(copy).chain([fit]).collect(),
            after: evaluate.into_iter().collect(),
            drawn: user.vertex.filter(|_| !is_parts),
            group,
        }
    }

    /// The modules as files.
    pub(super) fn files(self) -> Vec<(String, Vec<u8>)> {
        let passes = self.before.into_iter().chain(self.after);
        let passes = passes.map(|one| (one.file.to_owned(), one.text.into_bytes()));
        let drawn = self.drawn.map(|text| (VERTEX.to_owned(), text.into_bytes()));
        passes.chain(drawn).collect()
    }

    /// Gives each pass and the draws their shaders for SDL; returns them with the fragment shaders.
    ///
    /// # Errors
    /// The language or SDL cannot express one.
    pub(super) fn translated(
        &self,
        translation: Translation,
        [before, after]: [&mut Vec<Pass>; 2],
        vertex: Option<&mut Vertex>,
    ) -> Result<(Programs, Vec<Program>), String> {
        let mut made = Programs::new(translation);
        translate(&mut made, &self.before, before)?;
        translate(&mut made, &self.after, after)?;
        let mut fragments = Vec::new();
        if let (Some(text), Some(vertex)) = (&self.drawn, vertex) {
            let own = (text.as_str(), self.group);
            vertex.file = None;
            vertex.program = Some(made.add("stage_vertex", own, "tess_vertex", own_buffer)?);
            for name in programs::fragments(text)? {
                let file = format!("stage_fragment_{name}");
                fragments.push(made.add(&file, own, &name, own_buffer)?);
            }
        }
        Ok((made, fragments))
    }
}

/// The passes of modules.
///
/// # Errors
/// One is not valid.
pub(super) fn passes(sources: &[Source]) -> Result<Vec<Pass>, String> {
    let mut all = Vec::new();
    for source in sources {
        let read = Read::new(&source.text)?;
        let pass = |&(entry_point, workgroups): &Entry| Pass {
            entry_point: entry_point.to_owned(),
            file: Some(source.file),
            part: source.part,
            workgroups,
            bindings: read.bindings(entry_point, source.group),
            program: None,
        };
        all.extend(source.entries.iter().map(pass));
    }
    Ok(all)
}

/// Gives each pass its shader for SDL.
///
/// # Errors
/// The language or SDL cannot express one.
fn translate(made: &mut Programs, sources: &[Source], all: &mut [Pass]) -> Result<(), String> {
    let entries = sources.iter().flat_map(|one| one.entries.iter().map(move |_| one));
    for (source, pass) in entries.zip(all) {
        let entry = pass.entry_point.as_str();
        let name = format!("stage_{}", entry.trim_start_matches("tess_"));
        let text = (source.text.as_str(), source.group);
        let program = made.add(&name, text, entry, own_buffer)?;
        (pass.file, pass.program) = (None, Some(program));
    }
    Ok(())
}

impl Vertex {
    pub(super) fn new(text: &str, group: u32, layout: &VertexLayout) -> Result<Self, String> {
        let attribute = |one: &wgpu::VertexAttribute| Attribute {
            location: one.shader_location,
            offset: one.offset,
            format: format!("{:?}", one.format).to_lowercase(),
        };
        Ok(Self {
            file: Some(VERTEX),
            entry_point: "tess_vertex",
            stride: layout.array_stride,
            attributes: layout.attributes.iter().map(attribute).collect(),
            bindings: Read::new(text)?.bindings("tess_vertex", group),
            program: None,
        })
    }
}

/// A valid module.
pub(super) struct Read {
    pub(super) module: Module,
    info: naga::valid::ModuleInfo,
}

impl Read {
    pub(super) fn new(text: &str) -> Result<Self, String> {
        let module =
            naga::front::wgsl::parse_str(text).map_err(|error| error.emit_to_string(text))?;
        // What the user's WGSL asks of a device is known only there.
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
        let info = validator.validate(&module).map_err(|error| error.emit_to_string(text))?;
        Ok(Self { module, info })
    }

    /// The stage's own bindings that an entry point uses, in order. The user's are in the bind
    /// groups before `from_group`.
    fn bindings(&self, entry_point: &str, from_group: u32) -> Vec<Bound> {
        let Self { module, info } = self;
        let is_it = |one: &naga::EntryPoint| one.name == entry_point;
        let Some(number) = module.entry_points.iter().position(is_it) else { return Vec::new() };
        let used = info.get_entry_point(number);
        let bound = |(handle, variable): (naga::Handle<GlobalVariable>, &GlobalVariable)| {
            let binding = variable.binding.filter(|binding| binding.group >= from_group)?;
            let name = variable.name.as_deref()?;
            let buffer = own_buffer(name)?;
            let is_used = !used[handle].is_empty();
            let AddressSpace::Storage { access } = variable.space else { return None };
            let is_written = access.contains(StorageAccess::STORE);
            let (group, binding) = (binding.group, binding.binding);
            is_used.then_some(Bound { group, binding, is_written, buffer })
        };
        let mut all: Vec<_> = module.global_variables.iter().filter_map(bound).collect();
        all.sort_by_key(|one| (one.group, one.binding));
        all
    }
}
