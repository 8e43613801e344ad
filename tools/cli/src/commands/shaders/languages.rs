//! Writes a stage in each language, through naga's writers.

use super::manifest::{Binding, Kind, MetalSizes, Stage as Described};
use super::old_vulkan;
use super::places::{Metal, Place, Places};
use super::slots::{Slots, Which};
use super::structures::ends_open;
use super::translation::{Checks, Layout, Target, Translation};
use naga::back::{glsl, hlsl, msl, spv};
use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Module, ResourceBinding, ShaderStage};
use tess_gpu::{Access, Resource, Setup, Stage};

/// A stage, written in a language.
pub(super) struct Written {
    pub(super) file: String,
    pub(super) text: Vec<u8>,
    pub(super) stage: Described,
}

/// An entry point, and where its resources are.
pub(super) struct Entry<'a> {
    pub(super) module: &'a Module,
    pub(super) info: &'a ModuleInfo,
    pub(super) stage: ShaderStage,
    pub(super) name: &'a str,
    pub(super) places: Places,
    /// Whether the variables of a workgroup begin with zeros, as WGSL says. The batch's shaders do
    /// not rely on it.
    pub(super) is_zeroed: bool,
}

/// A stage that naga has parsed and that can be written in any language.
pub(super) struct Read {
    source: String,
    module: Module,
    info: ModuleInfo,
    stage: Stage,
}

impl Read {
    /// Parses a stage.
    ///
    /// # Errors
    /// The stage is not valid.
    pub(super) fn new(stage: Stage, setup: Setup) -> Result<Self, String> {
        let source = stage.source(setup);
        let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", stage.entry_point());
        let module = naga::front::wgsl::parse_str(&source)
            .map_err(|error| failed(&error.emit_to_string(&source)))?;
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        let info =
            validator.validate(&module).map_err(|error| failed(&error.emit_to_string(&source)))?;
        Ok(Self { source, module, info, stage })
    }
}

impl Translation {
    /// Writes a stage.
    ///
    /// # Errors
    /// The language cannot express the stage.
    pub(super) fn write(self, stage: Stage, setup: Setup) -> Result<Written, String> {
        self.write_read(&Read::new(stage, setup)?)
    }

    /// Writes a stage that has been parsed.
    ///
    /// # Errors
    /// The language cannot express the stage.
    pub(super) fn write_read(self, read: &Read) -> Result<Written, String> {
        let name = read.stage.entry_point();
        let slots = read.slots(self)?;
        let places = slots.as_ref().map_or_else(|| read.plain_places(), Slots::places);
        let sizes_at = places.sizes;
        let (text, entry_point) = match self.target {
            Target::Wgsl => (read.source.clone().into_bytes(), name.to_owned()),
            _ => self.entry(&Entry {
                module: &read.module,
                info: &read.info,
                stage: ShaderStage::Compute,
                name,
                places,
                is_zeroed: false,
            })?,
        };
        let file = format!("{name}.{}", self.target.extension());
        let described = self.describe(read, (file.clone(), entry_point), sizes_at, slots.as_ref());
        Ok(Written { file, text, stage: described })
    }

    /// The text of an entry point, and its name there.
    ///
    /// # Errors
    /// The language cannot express it.
    pub(super) fn entry(self, entry: &Entry<'_>) -> Result<(Vec<u8>, String), String> {
        match self.target {
            Target::Wgsl => Err("WGSL is not translated".to_owned()),
            Target::Spirv => self.spirv(entry),
            Target::Glsl => self.glsl(entry),
            Target::Hlsl => self.hlsl(entry),
            Target::Msl => self.msl(entry),
        }
    }

    fn describe(
        self,
        read: &Read,
        (file, entry_point): (String, String),
        sizes_at: Option<u32>,
        slots: Option<&Slots<'_>>,
    ) -> Described {
        let sizes = sizes_at
            .filter(|_| self.target == Target::Msl && (self.is_checked() || slots.is_some()))
            .map(|buffer| MetalSizes { buffer, of_bindings: read.unsized_bindings() })
            .filter(|sizes| !sizes.of_bindings.is_empty());
        Described {
            name: read.stage.entry_point(),
            file,
            entry_point,
            workgroup_size: read.module.entry_points[0].workgroup_size,
            bindings: read.bindings(slots),
            msl_sizes: sizes,
        }
    }

    fn policies(self) -> BoundsCheckPolicies {
        let policy = match self.checks {
            Checks::Full => BoundsCheckPolicy::Restrict,
            Checks::None => BoundsCheckPolicy::Unchecked,
        };
        BoundsCheckPolicies {
            index: policy,
            buffer: policy,
            image_load: policy,
            binding_array: policy,
        }
    }

    fn is_checked(self) -> bool {
        self.checks == Checks::Full
    }

    fn spirv(self, entry: &Entry<'_>) -> Result<(Vec<u8>, String), String> {
        let target = |place: Place| spv::BindingInfo {
            descriptor_set: place.set,
            binding: place.binding,
            binding_array_size: None,
        };
        let zeros = match entry.is_zeroed {
            true => spv::ZeroInitializeWorkgroupMemoryMode::Polyfill,
            false => spv::ZeroInitializeWorkgroupMemoryMode::None,
        };
        let options = spv::Options {
            // SDL opens Vulkan 1.0.
            lang_version: if self.layout == Layout::Sdl { (1, 0) } else { (1, 3) },
            flags: spv::WriterFlags::empty(),
            fake_missing_bindings: false,
            binding_map: entry.map(target).collect(),
            bounds_check_policies: self.policies(),
            zero_initialize_workgroup_memory: zeros,
            force_loop_bounding: self.is_checked(),
            emit_int_div_checks: self.is_checked(),
            ..spv::Options::default()
        };
        let one =
            spv::PipelineOptions { shader_stage: entry.stage, entry_point: entry.name.to_owned() };
        let one = (self.layout == Layout::Sdl).then_some(&one);
        let words = spv::write_vec(entry.module, entry.info, &options, one)
            .map_err(|error| entry.failed("SPIR-V", &error))?;
        let words = match self.layout {
            Layout::Plain => words,
            Layout::Sdl => old_vulkan::rewritten(words),
        };
        let bytes = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        Ok((bytes, entry.name.to_owned()))
    }

    fn glsl(self, entry: &Entry<'_>) -> Result<(Vec<u8>, String), String> {
        let options = glsl::Options {
            version: glsl::Version::Desktop(430),
            writer_flags: glsl::WriterFlags::empty(),
            binding_map: entry
                .map(|place| u8::try_from(place.binding).unwrap_or(u8::MAX))
                .collect(),
            zero_initialize_workgroup_memory: entry.is_zeroed,
        };
        let pipeline = glsl::PipelineOptions {
            shader_stage: entry.stage,
            entry_point: entry.name.to_owned(),
            multiview: None,
        };
        let (mut text, policies) = (String::new(), self.policies());
        let Entry { module, info, .. } = entry;
        glsl::Writer::new(&mut text, module, info, &options, &pipeline, policies)
            .and_then(|mut writer| writer.write())
            .map_err(|error| entry.failed("GLSL", &error))?;
        Ok((text.into_bytes(), "main".to_owned()))
    }

    fn hlsl(self, entry: &Entry<'_>) -> Result<(Vec<u8>, String), String> {
        let target = |place: Place| hlsl::BindTarget {
            space: u8::try_from(place.set).unwrap_or(u8::MAX),
            register: place.binding,
            ..Default::default()
        };
        let options = hlsl::Options {
            shader_model: hlsl::ShaderModel::V5_1,
            binding_map: entry.map(target).collect(),
            fake_missing_bindings: false,
            special_constants_binding: entry.places.workgroups.map(target),
            zero_initialize_workgroup_memory: entry.is_zeroed,
            restrict_indexing: self.is_checked(),
            force_loop_bounding: self.is_checked(),
            ..hlsl::Options::default()
        };
        let mut text = String::new();
        let pipeline = hlsl::PipelineOptions { entry_point: entry.pipeline() };
        let info = hlsl::Writer::new(&mut text, &options, &pipeline)
            .write(entry.module, entry.info, None)
            .map_err(|error| entry.failed("HLSL", &error))?;
        let name = entry.named("HLSL", &info.entry_point_names)?;
        let mut text = with_unsigned_zeros(&text);
        if self.layout == Layout::Sdl {
            // The name that SDL gives to the inputs of vertex shaders.
            text = text.replace(" : LOC", " : TEXCOORD");
        }
        Ok((text.into_bytes(), name))
    }

    fn msl(self, entry: &Entry<'_>) -> Result<(Vec<u8>, String), String> {
        let target = |place: Place| {
            let slot = |slot: u32| u8::try_from(slot).ok();
            let none = msl::BindTarget { mutable: true, ..Default::default() };
            match place.metal {
                Metal::Buffer(at) => msl::BindTarget { buffer: slot(at), ..none },
                Metal::Texture(at) => msl::BindTarget { texture: slot(at), ..none },
                Metal::Sampler(at) => {
                    let sampler = slot(at).map(msl::BindSamplerTarget::Resource);
                    msl::BindTarget { sampler, ..none }
                }
            }
        };
        let resources = msl::EntryPointResources {
            resources: entry.map(target).collect(),
            sizes_buffer: entry.places.sizes.and_then(|at| u8::try_from(at).ok()),
            ..Default::default()
        };
        let options = msl::Options {
            lang_version: (2, 0),
            per_entry_point_map: [(entry.name.to_owned(), resources)].into(),
            fake_missing_bindings: false,
            bounds_check_policies: self.policies(),
            zero_initialize_workgroup_memory: entry.is_zeroed,
            force_loop_bounding: self.is_checked(),
            emit_int_div_checks: self.is_checked(),
            ..msl::Options::default()
        };
        let pipeline = msl::PipelineOptions { entry_point: entry.pipeline(), ..Default::default() };
        let (text, info) = msl::write_string(entry.module, entry.info, &options, &pipeline)
            .map_err(|error| entry.failed("MSL", &error))?;
        let name = entry.named("MSL", &info.entry_point_names)?;
        Ok((text.into_bytes(), name))
    }
}

impl Entry<'_> {
    /// Each binding with its counterpart in a language.
    fn map<T>(&self, target: impl Fn(Place) -> T) -> impl Iterator<Item = (ResourceBinding, T)> {
        self.places.of.iter().map(move |&(binding, place)| (binding, target(place)))
    }

    fn pipeline(&self) -> Option<(ShaderStage, String)> {
        Some((self.stage, self.name.to_owned()))
    }

    fn failed(&self, language: &str, error: &dyn std::fmt::Display) -> String {
        format!("{} has no words for {}: {error}", language, self.name)
    }

    /// The name of the entry point in a language.
    fn named<E: std::fmt::Display>(
        &self,
        language: &str,
        names: &[Result<String, E>],
    ) -> Result<String, String> {
        match names.first() {
            Some(Ok(name)) => Ok(name.clone()),
            Some(Err(error)) => Err(self.failed(language, error)),
            None => Err(self.failed(language, &"no entry point")),
        }
    }
}

impl Target {
    pub(super) const fn extension(self) -> &'static str {
        match self {
            Self::Wgsl => "wgsl",
            Self::Spirv => "spv",
            Self::Glsl => "comp",
            Self::Hlsl => "hlsl",
            Self::Msl => "metal",
        }
    }
}

impl Read {
    /// The places for SDL, if the layout is its.
    ///
    /// # Errors
    /// SDL cannot bind the resources.
    fn slots(&self, translation: Translation) -> Result<Option<Slots<'_>>, String> {
        match translation.layout {
            Layout::Plain => Ok(None),
            Layout::Sdl => {
                let read = (&self.module, &self.info);
                Slots::new(read, 0, translation.target, Which::Declared).map(Some)
            }
        }
    }

    /// All bindings in set 0, numbered together; in Metal, the lengths of the buffers follow.
    fn plain_places(&self) -> Places {
        let count = u32::try_from(self.stage.bindings().len()).unwrap_or(u32::MAX);
        let place = |binding| {
            let place = Place { set: 0, binding, metal: Metal::Buffer(binding) };
            (ResourceBinding { group: 0, binding }, place)
        };
        Places { of: (0..count).map(place).collect(), sizes: Some(count), workgroups: None }
    }

    fn bindings(&self, slots: Option<&Slots<'_>>) -> Vec<Binding> {
        let places = slots.map_or_else(|| self.plain_places(), Slots::places).of;
        let at = |binding| {
            let from = ResourceBinding { group: 0, binding };
            places.iter().find(|(other, _)| *other == from).map(|(_, place)| *place)
        };
        let described = |(number, of): (u32, &tess_gpu::Binding)| {
            let Place { set, binding, .. } = at(number)?;
            let is_written = of.1 == Access::ReadWrite;
            let kind = if of.0 == Resource::Job { Kind::Uniform } else { Kind::Storage };
            let register = match kind {
                Kind::Uniform => 'b',
                Kind::Storage if is_written => 'u',
                Kind::Storage => 't',
            };
            let hlsl_register = format!("{register}{binding}");
            Some(Binding { set, binding, kind, is_written, resource: of.0, hlsl_register })
        };
        (0..).zip(self.stage.bindings()).filter_map(described).collect()
    }

    /// The bindings whose length only the host knows, in the order in which naga's MSL expects the
    /// lengths.
    fn unsized_bindings(&self) -> Vec<u32> {
        let globals = self.module.global_variables.iter();
        globals
            .filter(|(_, variable)| ends_open(&self.module, variable.ty))
            .filter_map(|(_, variable)| variable.binding.map(|binding| binding.binding))
            .collect()
    }
}

/// HLSL in which atomic loads from buffers use an unsigned zero. naga writes such a load as
/// `x.InterlockedOr(at, 0, result)`; glslang turns the signed zero into an invalid instruction.
fn with_unsigned_zeros(hlsl: &str) -> String {
    let line = |line: &str| {
        if line.contains(".InterlockedOr(") {
            line.replace(", 0, ", ", 0u, ")
        } else {
            line.to_owned()
        }
    };
    hlsl.split_inclusive('\n').map(line).collect()
}
