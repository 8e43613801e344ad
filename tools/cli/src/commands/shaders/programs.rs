//! The shaders of a stage for SDL's GPU interface: each entry point in a file of its own, with its
//! resources in the order in which the host binds them.

use super::languages::Entry;
use super::slots::{Extra, Kind, Slots, Which};
use super::translation::Translation;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Handle, Module, ShaderStage};
use serde::Serialize;

/// A buffer of the stage or of its batch, or a resource of the user's WGSL.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Named {
    Buffer(&'static str),
    User(String),
}

/// A shader, and how the host makes and binds it.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Program {
    pub(super) file: String,
    pub(super) entry_point: String,
    pub(super) threads: [u32; 3],
    pub(super) textures: u32,
    pub(super) read_only: u32,
    pub(super) read_write: u32,
    /// With the extra one.
    pub(super) uniforms: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) extra: Option<Extra>,
    /// What the host binds: textures, then buffers that are read, buffers that are written, and
    /// uniform buffers, each kind from slot 0.
    pub(super) bound: Vec<Named>,
    /// Whose bytes the extra uniform buffer of Metal has.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) sized: Vec<Named>,
}

/// A resource of the user's WGSL.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(super) struct User {
    pub(super) name: String,
    pub(super) kind: Kind,
    /// Of a uniform buffer's type; 0 for others.
    pub(super) bytes: u32,
}

/// The shaders of a stage, as they are written.
#[derive(Debug)]
pub(super) struct Programs {
    translation: Translation,
    pub(super) users: Vec<User>,
    pub(super) files: Vec<(String, Vec<u8>)>,
}

/// A module in WGSL: its text, and the number of the stage's own bind group, which follows the
/// user's.
pub(super) type Source<'a> = (&'a str, u32);

impl Programs {
    pub(super) const fn new(translation: Translation) -> Self {
        Self { translation, users: Vec::new(), files: Vec::new() }
    }

    /// Writes an entry point into a file with this name and the language's ending. `own` finds the
    /// buffer of one of the stage's variables.
    ///
    /// # Errors
    /// The module is not valid, or the language or SDL cannot express it.
    pub(super) fn add(
        &mut self,
        name: &str,
        (text, group): Source<'_>,
        entry_point: &str,
        own: impl Fn(&str) -> Option<&'static str>,
    ) -> Result<Program, String> {
        let (module, info) = valid(text)?;
        let is_it = |one: &naga::EntryPoint| one.name == entry_point;
        let number = module.entry_points.iter().position(is_it);
        let number = number.ok_or_else(|| format!("there is no entry point `{entry_point}`"))?;
        let entry = &module.entry_points[number];
        let slots = Slots::new((&module, &info), number, self.translation.target, Which::Used)
            .map_err(|why| format!("`{entry_point}`: {why}"))?;
        let (text, written) = self.translation.entry(&Entry {
            module: &module,
            info: &info,
            stage: entry.stage,
            name: entry_point,
            places: slots.places(),
            is_zeroed: true,
        })?;
        let mut named = |handle: Handle<naga::GlobalVariable>| {
            let name = slots.name(handle);
            let binding = slots.variable(handle).binding;
            let is_own = binding.is_some_and(|binding| binding.group >= group);
            is_own.then(|| own(name)).flatten().map_or_else(
                || {
                    self.user(&slots, handle);
                    Named::User(name.to_owned())
                },
                Named::Buffer,
            )
        };
        let bound = slots.all.iter().map(|one| named(one.handle)).collect();
        let sized = slots.sized().map(&mut named).collect();
        let file = format!("{name}.{}", self.translation.target.extension());
        self.files.push((file.clone(), text));
        Ok(Program {
            file,
            entry_point: written,
            threads: entry.workgroup_size,
            textures: slots.count(Kind::Texture),
            read_only: slots.count(Kind::ReadOnly),
            read_write: slots.count(Kind::ReadWrite),
            uniforms: slots.count(Kind::Uniform),
            extra: slots.extra,
            bound,
            sized,
        })
    }

    /// Remembers a resource of the user's.
    fn user(&mut self, slots: &Slots<'_>, handle: Handle<naga::GlobalVariable>) {
        let (name, Some(kind)) = (slots.name(handle), slots.kind(handle)) else { return };
        if self.users.iter().all(|user| user.name != name) {
            let bytes = if kind == Kind::Uniform { slots.bytes(handle) } else { 0 };
            self.users.push(User { name: name.to_owned(), kind, bytes });
        }
    }
}

fn valid(text: &str) -> Result<(Module, ModuleInfo), String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|error| error.emit_to_string(text))?;
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
    let info = validator.validate(&module).map_err(|error| error.emit_to_string(text))?;
    Ok((module, info))
}

/// The fragment shaders of a module.
///
/// # Errors
/// The module is not valid.
pub(super) fn fragments(text: &str) -> Result<Vec<String>, String> {
    let (module, _) = valid(text)?;
    let is_fragment = |one: &&naga::EntryPoint| one.stage == ShaderStage::Fragment;
    Ok(module.entry_points.iter().filter(is_fragment).map(|one| one.name.clone()).collect())
}
