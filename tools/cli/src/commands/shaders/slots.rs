//! Where SDL's GPU interface expects the resources of a shader.
//!
//! SDL numbers resources by kind, without gaps, in one set for each kind; `SDL_CreateGPUShader` and
//! `SDL_CreateGPUComputePipeline` say which. Here every kind is counted in the order of the WGSL's
//! groups and bindings, and only resources count that the entry point uses. A sampler has the
//! number of the one texture that it samples.

use super::places::{Metal, Place, Places};
use super::structures::ends_open;
use super::translation::Target;
use naga::valid::ModuleInfo;
use naga::{AddressSpace, BuiltIn, GlobalVariable, Handle, Module, ShaderStage, StorageAccess};
use naga::{ImageClass, ResourceBinding, TypeInner};
use serde::Serialize;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Kind {
    Texture,
    ReadOnly,
    ReadWrite,
    Uniform,
}

/// A resource of an entry point: its kind, and its number among those of its kind.
#[derive(Clone, Debug)]
pub(super) struct Slot {
    pub(super) kind: Kind,
    pub(super) slot: u32,
    pub(super) handle: Handle<GlobalVariable>,
}

/// One more uniform buffer, after the others, that the host fills.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Extra {
    /// Metal: the number of bytes of each buffer in `sized`, a word each.
    Sizes,
    /// HLSL: the number of workgroups along x, y and z.
    Workgroups,
}

/// The resources of an entry point.
#[derive(Debug)]
pub(super) struct Slots<'a> {
    module: &'a Module,
    stage: ShaderStage,
    /// Sorted by kind, then by slot.
    pub(super) all: Vec<Slot>,
    samplers: Vec<(Handle<GlobalVariable>, u32)>,
    pub(super) extra: Option<Extra>,
}

/// The bytes that SDL binds of a uniform buffer.
const MOST_UNIFORM_BYTES: u32 = 4096;

/// Which resources of a module count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Which {
    Declared,
    #[cfg(feature = "gpu")]
    Used,
}

impl<'a> Slots<'a> {
    /// The slots of an entry point.
    ///
    /// # Errors
    /// SDL cannot bind its resources.
    pub(super) fn new(
        (module, info): (&'a Module, &ModuleInfo),
        number: usize,
        target: Target,
        which: Which,
    ) -> Result<Self, String> {
        let (entry, uses) = (&module.entry_points[number], info.get_entry_point(number));
        let mut bound: Vec<_> = module
            .global_variables
            .iter()
            .filter(|(handle, one)| {
                one.binding.is_some() && (which == Which::Declared || !uses[*handle].is_empty())
            })
            .collect();
        bound.sort_by_key(|(_, one)| one.binding.map(|it| (it.group, it.binding)));
        let mut all: Vec<Slot> = Vec::new();
        let mut samplers = Vec::new();
        for (handle, one) in bound {
            match kind_of(module, one)? {
                Some(kind) => {
                    let before = all.iter().filter(|other| other.kind == kind).count();
                    let slot = u32::try_from(before).unwrap_or(u32::MAX);
                    all.push(Slot { kind, slot, handle });
                }
                None => samplers.push(handle),
            }
        }
        all.sort_by_key(|one| (one.kind as u32, one.slot));
        let pair = |handle: Handle<GlobalVariable>| {
            let mut of = uses.sampling_set.iter().filter(|key| key.sampler == handle);
            let (first, more) = (of.next(), of.next());
            let texture = first.filter(|_| more.is_none()).map(|key| key.image);
            let slot = all.iter().find(|one| Some(one.handle) == texture).map(|one| one.slot);
            let name = name_of(module, handle);
            slot.map(|slot| (handle, slot)).ok_or_else(|| {
                format!(
                    "SDL binds a sampler with its texture: `{name}` samples more than one, or none"
                )
            })
        };
        let samplers = samplers.into_iter().map(pair).collect::<Result<Vec<_>, _>>()?;
        if target == Target::Hlsl && !samplers.is_empty() {
            return Err("samplers have no words in HLSL for SDL: use textureLoad".to_owned());
        }
        let sized = all.iter().any(|one| is_sized(module, one.handle));
        let extra = match target {
            Target::Msl if sized => Some(Extra::Sizes),
            Target::Hlsl if counts_workgroups(entry) => Some(Extra::Workgroups),
            _ => None,
        };
        let slots = Self { module, stage: entry.stage, all, samplers, extra };
        slots.check().map(|()| slots)
    }

    /// # Errors
    /// There are more of a kind than SDL allows.
    fn check(&self) -> Result<(), String> {
        let most = [(Kind::Texture, 16), (Kind::ReadOnly, 8), (Kind::ReadWrite, 8)];
        for (kind, most) in most.into_iter().chain([(Kind::Uniform, 4)]) {
            if self.count(kind) > most {
                return Err(format!("SDL binds at most {most} resources of the kind {kind:?}"));
            }
        }
        let is_large =
            |one: &&Slot| one.kind == Kind::Uniform && self.bytes(one.handle) > MOST_UNIFORM_BYTES;
        if let Some(one) = self.all.iter().find(is_large) {
            let name = name_of(self.module, one.handle);
            return Err(format!(
                "SDL passes uniform buffers of at most {MOST_UNIFORM_BYTES} bytes: `{name}` has {}",
                self.bytes(one.handle)
            ));
        }
        if self.stage != ShaderStage::Compute && self.count(Kind::ReadWrite) > 0 {
            return Err("SDL lets only compute shaders write buffers".to_owned());
        }
        Ok(())
    }

    /// How many of a kind the host binds; the extra one is a uniform buffer.
    pub(super) fn count(&self, kind: Kind) -> u32 {
        let own = self.all.iter().filter(|one| one.kind == kind).count();
        let own = u32::try_from(own).unwrap_or(u32::MAX);
        own + u32::from(kind == Kind::Uniform && self.extra.is_some())
    }

    /// The set, or space, of a kind.
    fn set(&self, kind: Kind) -> u32 {
        let uniforms = match self.stage {
            ShaderStage::Compute => 2,
            ShaderStage::Vertex => 1,
            _ => 3,
        };
        match kind {
            Kind::Uniform => uniforms,
            Kind::ReadWrite => 1,
            Kind::Texture | Kind::ReadOnly if self.stage == ShaderStage::Fragment => 2,
            Kind::Texture | Kind::ReadOnly => 0,
        }
    }

    fn place(&self, kind: Kind, slot: u32) -> Place {
        let (uniforms, textures) = (self.count(Kind::Uniform), self.count(Kind::Texture));
        let binding = if kind == Kind::ReadOnly { textures + slot } else { slot };
        let metal = match kind {
            Kind::Texture => Metal::Texture(slot),
            Kind::Uniform => Metal::Buffer(slot),
            Kind::ReadOnly => Metal::Buffer(uniforms + slot),
            Kind::ReadWrite => Metal::Buffer(uniforms + self.count(Kind::ReadOnly) + slot),
        };
        Place { set: self.set(kind), binding, metal }
    }

    /// The place of every resource, for naga's writers.
    pub(super) fn places(&self) -> Places {
        let binding = |handle: Handle<GlobalVariable>| self.module.global_variables[handle].binding;
        let own = self.all.iter().map(|one| (one.handle, self.place(one.kind, one.slot)));
        let samplers = self.samplers.iter().map(|&(handle, slot)| {
            let metal = Metal::Sampler(slot);
            (handle, Place { metal, ..self.place(Kind::Texture, slot) })
        });
        let of = own.chain(samplers);
        let of: Vec<(ResourceBinding, Place)> =
            of.filter_map(|(handle, place)| Some((binding(handle)?, place))).collect();
        let extra = self.count(Kind::Uniform).saturating_sub(1);
        let place = self.place(Kind::Uniform, extra);
        Places {
            of,
            sizes: (self.extra == Some(Extra::Sizes)).then_some(extra),
            workgroups: (self.extra == Some(Extra::Workgroups)).then_some(place),
        }
    }

    /// The bytes of a variable's type; of an array without an end, those before it.
    pub(super) fn bytes(&self, handle: Handle<GlobalVariable>) -> u32 {
        let ty = self.module.global_variables[handle].ty;
        self.module.types[ty].inner.size(self.module.to_ctx())
    }
}

#[cfg(feature = "gpu")]
impl<'a> Slots<'a> {
    /// The variables whose bytes the extra uniform buffer has, in its order; for Metal.
    pub(super) fn sized(&self) -> impl Iterator<Item = Handle<GlobalVariable>> {
        let all = self.module.global_variables.iter().map(|(handle, _)| handle);
        all.filter(|&handle| self.extra == Some(Extra::Sizes) && is_sized(self.module, handle))
    }

    pub(super) fn name(&self, handle: Handle<GlobalVariable>) -> &'a str {
        name_of(self.module, handle)
    }

    /// The kind of a resource; `None` for a sampler, and for what SDL does not bind.
    pub(super) fn kind(&self, handle: Handle<GlobalVariable>) -> Option<Kind> {
        kind_of(self.module, self.variable(handle)).ok().flatten()
    }

    pub(super) fn variable(&self, handle: Handle<GlobalVariable>) -> &'a GlobalVariable {
        &self.module.global_variables[handle]
    }
}

fn name_of(module: &Module, handle: Handle<GlobalVariable>) -> &str {
    module.global_variables[handle].name.as_deref().unwrap_or_default()
}

/// The kind of a resource; `None` for a sampler.
///
/// # Errors
/// SDL cannot bind it, or no host of ours does.
fn kind_of(module: &Module, one: &GlobalVariable) -> Result<Option<Kind>, String> {
    let name = one.name.as_deref().unwrap_or_default();
    Ok(match (one.space, &module.types[one.ty].inner) {
        (AddressSpace::Uniform, _) => Some(Kind::Uniform),
        (AddressSpace::Storage { access }, _) if access.contains(StorageAccess::STORE) => {
            Some(Kind::ReadWrite)
        }
        (AddressSpace::Storage { .. }, _) => Some(Kind::ReadOnly),
        (_, TypeInner::Sampler { .. }) => None,
        (_, TypeInner::Image { class: ImageClass::Storage { .. }, .. }) => {
            return Err(format!("`{name}` is a storage texture, which is not bound for SDL"));
        }
        (_, TypeInner::Image { .. }) => Some(Kind::Texture),
        _ => return Err(format!("`{name}` is of a kind that SDL does not bind")),
    })
}

fn is_sized(module: &Module, handle: Handle<GlobalVariable>) -> bool {
    let one = &module.global_variables[handle];
    one.binding.is_some() && ends_open(module, one.ty)
}

/// Whether an entry point asks for the number of workgroups, which HLSL does not have.
fn counts_workgroups(entry: &naga::EntryPoint) -> bool {
    let number = Some(naga::Binding::BuiltIn(BuiltIn::NumWorkGroups));
    entry.function.arguments.iter().any(|one| one.binding == number)
}
