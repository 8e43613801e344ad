//! Writes a stage in each language, through naga's writers.

use super::manifest::{Binding, Kind, MetalSizes, Stage as Described};
use super::structures::ends_open;
use super::translation::{Checks, Target, Translation};
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
        let stage = read.stage;
        let (text, entry_point) = match self.target {
            Target::Wgsl => (read.source.clone().into_bytes(), stage.entry_point().to_owned()),
            Target::Spirv => self.spirv(read)?,
            Target::Glsl => self.glsl(read)?,
            Target::Hlsl => self.hlsl(read)?,
            Target::Msl => self.msl(read)?,
        };
        let file = format!("{}.{}", stage.entry_point(), self.target.extension());
        let described = self.describe(read, file.clone(), entry_point);
        Ok(Written { file, text, stage: described })
    }

    fn describe(self, read: &Read, file: String, entry_point: String) -> Described {
        let sizes = (self.target == Target::Msl && self.checks == Checks::Full)
            .then(|| MetalSizes { buffer: read.sizes_slot(), of_bindings: read.unsized_bindings() })
            .filter(|sizes| !sizes.of_bindings.is_empty());
        Described {
            name: read.stage.entry_point(),
            file,
            entry_point,
            workgroup_size: read.module.entry_points[0].workgroup_size,
            bindings: read.bindings().collect(),
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

    fn spirv(self, read: &Read) -> Result<(Vec<u8>, String), String> {
        let options = spv::Options {
            lang_version: (1, 3),
            flags: spv::WriterFlags::empty(),
            bounds_check_policies: self.policies(),
            zero_initialize_workgroup_memory: spv::ZeroInitializeWorkgroupMemoryMode::None,
            force_loop_bounding: self.is_checked(),
            emit_int_div_checks: self.is_checked(),
            ..spv::Options::default()
        };
        let words = spv::write_vec(&read.module, &read.info, &options, None)
            .map_err(|error| read.failed("SPIR-V", &error))?;
        let bytes = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        Ok((bytes, read.stage.entry_point().to_owned()))
    }

    fn glsl(self, read: &Read) -> Result<(Vec<u8>, String), String> {
        let options = glsl::Options {
            version: glsl::Version::Desktop(430),
            writer_flags: glsl::WriterFlags::empty(),
            binding_map: read.map(|binding| u8::try_from(binding).unwrap_or(u8::MAX)).collect(),
            zero_initialize_workgroup_memory: false,
        };
        let pipeline = glsl::PipelineOptions {
            shader_stage: ShaderStage::Compute,
            entry_point: read.stage.entry_point().to_owned(),
            multiview: None,
        };
        let mut text = String::new();
        glsl::Writer::new(
            &mut text,
            &read.module,
            &read.info,
            &options,
            &pipeline,
            self.policies(),
        )
        .and_then(|mut writer| writer.write())
        .map_err(|error| read.failed("GLSL", &error))?;
        Ok((text.into_bytes(), "main".to_owned()))
    }

    fn hlsl(self, read: &Read) -> Result<(Vec<u8>, String), String> {
        let target = |register| hlsl::BindTarget { register, ..Default::default() };
        let options = hlsl::Options {
            shader_model: hlsl::ShaderModel::V5_1,
            binding_map: read.map(target).collect(),
            fake_missing_bindings: false,
            zero_initialize_workgroup_memory: false,
            restrict_indexing: self.is_checked(),
            force_loop_bounding: self.is_checked(),
            ..hlsl::Options::default()
        };
        let mut text = String::new();
        let pipeline = hlsl::PipelineOptions::default();
        let info = hlsl::Writer::new(&mut text, &options, &pipeline)
            .write(&read.module, &read.info, None)
            .map_err(|error| read.failed("HLSL", &error))?;
        let name = read.named("HLSL", &info.entry_point_names)?;
        Ok((with_unsigned_zeros(&text).into_bytes(), name))
    }

    fn msl(self, read: &Read) -> Result<(Vec<u8>, String), String> {
        let target = |slot: u32| msl::BindTarget {
            buffer: u8::try_from(slot).ok(),
            mutable: true,
            ..Default::default()
        };
        let resources = msl::EntryPointResources {
            resources: read.map(target).collect(),
            sizes_buffer: u8::try_from(read.sizes_slot()).ok(),
            ..Default::default()
        };
        let options = msl::Options {
            lang_version: (2, 0),
            per_entry_point_map: [(read.stage.entry_point().to_owned(), resources)].into(),
            fake_missing_bindings: false,
            bounds_check_policies: self.policies(),
            zero_initialize_workgroup_memory: false,
            force_loop_bounding: self.is_checked(),
            emit_int_div_checks: self.is_checked(),
            ..msl::Options::default()
        };
        let pipeline = msl::PipelineOptions::default();
        let (text, info) = msl::write_string(&read.module, &read.info, &options, &pipeline)
            .map_err(|error| read.failed("MSL", &error))?;
        let name = read.named("MSL", &info.entry_point_names)?;
        Ok((text.into_bytes(), name))
    }
}

impl Target {
    const fn extension(self) -> &'static str {
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
    /// Each binding with its counterpart in a language that numbers bindings of all kinds together.
    fn map<T>(&self, target: impl Fn(u32) -> T) -> impl Iterator<Item = (ResourceBinding, T)> {
        let count = u32::try_from(self.stage.bindings().len()).unwrap_or(u32::MAX);
        (0..count).map(move |binding| (ResourceBinding { group: 0, binding }, target(binding)))
    }

    fn bindings(&self) -> impl Iterator<Item = Binding> {
        (0..).zip(self.stage.bindings()).map(|(binding, of)| {
            let is_written = of.1 == Access::ReadWrite;
            let kind = if of.0 == Resource::Job { Kind::Uniform } else { Kind::Storage };
            let register = match kind {
                Kind::Uniform => 'b',
                Kind::Storage if is_written => 'u',
                Kind::Storage => 't',
            };
            let hlsl_register = format!("{register}{binding}");
            Binding { set: 0, binding, kind, is_written, resource: of.0, hlsl_register }
        })
    }

    /// Metal's first buffer slot after the bindings.
    fn sizes_slot(&self) -> u32 {
        u32::try_from(self.stage.bindings().len()).unwrap_or(u32::MAX)
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

    fn failed(&self, language: &str, error: &dyn std::fmt::Display) -> String {
        format!("{} has no words for {}: {error}", language, self.stage.entry_point())
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
