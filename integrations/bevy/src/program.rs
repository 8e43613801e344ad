//! Programs: the shaders of all entities that are tessellated in one call.

use crate::component::Tessellated;
use bevy::asset::{AssetServer, Assets, Handle};
use bevy::ecs::prelude::*;
use bevy::platform::collections::{HashMap, HashSet};
use bevy::shader::{Shader, ShaderImport};
use std::borrow::Cow;
use std::sync::Arc;
use tess_core::{Config, Domain};
use tess_wgpu::TessellationStage;

const TYPES: &str = include_str!("../shaders/types.wgsl");
const SURFACE: &str = include_str!("../shaders/surface.wgsl");
const PROJECT: &str = include_str!("../shaders/project.wgsl");
const PREPASS: &str = include_str!("../shaders/prepass.wesl");
/// [`PROJECT`] for the compute pass, which is not a pass of Bevy's.
const PROJECT_OF_HULL: &str = "fn tess_project(world: vec3<f32>) -> vec4<f32> {
    return tess_camera.clip_from_world * vec4<f32>(world, 1.0);
}";
const FRAGMENT: &str = include_str!("../shaders/fragment.wesl");
/// Bevy's items that fragment.wesl uses, in one line before the shape's first line.
const IMPORTS: &str = "import bevy_pbr::render::pbr_types as tess_pbr_types; \
                       import bevy_pbr::render::pbr_functions as tess_pbr_functions; \
                       import bevy_pbr::render::pbr_fragment as tess_pbr_fragment; \
                       @if(PREPASS_PIPELINE) \
                       import bevy_pbr::prepass::io::VertexOutput as TessOutput; \
                       @else import bevy_pbr::render::forward_io::VertexOutput as TessOutput; ";

/// The plugin's bind group in the stage's compute pass.
const HULL_GROUP: &str = "0";
/// The plugin's bind group in the render pass, in place of Bevy's group for meshes.
pub(crate) const DRAW_GROUP: usize = 2;

/// The properties that all entities of one call share.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Key {
    pub(crate) domain: Domain,
    pub(crate) config: Config,
    surface: Cow<'static, str>,
    fragment: Cow<'static, str>,
}

impl Key {
    fn new(tessellated: &Tessellated) -> Self {
        let shape = &tessellated.shape;
        Self {
            domain: shape.domain(),
            config: tessellated.config(),
            surface: shape.surface(),
            fragment: shape.fragment(),
        }
    }

    /// The shape's WGSL, then the plugin's, for a bind group of this number.
    fn joined(&self, project: &str, group: &str) -> String {
        let own = [TYPES, SURFACE, project].join("\n").replace("TESS_GROUP", group);
        format!("{}\n{own}", self.surface)
    }

    /// The source of the stage's hull pass.
    pub(crate) fn hull_source(&self) -> String {
        self.joined(PROJECT_OF_HULL, HULL_GROUP)
    }

    fn vertex_shader(&self, number: usize) -> Shader {
        let source = self.joined(PROJECT, &DRAW_GROUP.to_string());
        let builder = TessellationStage::builder(&source, self.domain, self.config, 1);
        let shader =
            builder.vertex_shader(None).expect("packed points need no struct of the user's");
        Shader::from_wgsl(shader, format!("bevy_tess/surface_{number}.wgsl"))
    }
}

/// The fragment shader of a text: the imports, the text, and then the plugin's WESL.
fn fragment_shader(text: &str, name: &str) -> Shader {
    let own = [TYPES, FRAGMENT].join("\n").replace("TESS_GROUP", &DRAW_GROUP.to_string());
    Shader::from_wesl(format!("{IMPORTS}{text}\n{own}"), format!("bevy_tess/{name}.wesl"))
}

/// The modules that an import may name: `a::b::c` is the module `c`, or the item `c` of the module
/// `b`.
fn modules_of(import: &ShaderImport) -> impl Iterator<Item = &str> {
    let path = match import {
        ShaderImport::Custom(path) => Some(path.as_str()),
        ShaderImport::AssetPath(_) => None,
    };
    path.into_iter()
        .flat_map(|path| [Some(path), path.rsplit_once("::").map(|(outer, _)| outer)])
        .flatten()
}

/// The shaders of all entities with one key.
#[derive(Debug)]
pub(crate) struct Program {
    /// Its number among all programs.
    pub(crate) number: usize,
    pub(crate) key: Key,
    pub(crate) vertex: Handle<Shader>,
    pub(crate) fragment: Handle<Shader>,
    /// The fragment shader of prepasses.
    pub(crate) prepass: Handle<Shader>,
}

/// Every program so far, and the program of each entity.
#[derive(Debug, Resource)]
pub(crate) struct Programs {
    /// The fragment shader of prepasses.
    prepass: Handle<Shader>,
    all: HashMap<Key, Arc<Program>>,
    of_entities: HashMap<Entity, Arc<Program>>,
}

impl FromWorld for Programs {
    fn from_world(world: &mut World) -> Self {
        let prepass = world.resource::<AssetServer>().add(fragment_shader(PREPASS, "prepass"));
        Self { prepass, all: HashMap::default(), of_entities: HashMap::default() }
    }
}

impl Programs {
    /// Whether all of Bevy's modules are loaded that the shaders import, directly or through other
    /// modules. Bevy loads some modules later than others, and warns of a shader that is compiled
    /// too early.
    pub(crate) fn are_ready(&self, server: &AssetServer, shaders: &Assets<Shader>) -> bool {
        let own = self.all.values().map(|program| &program.fragment).chain([&self.prepass]);
        let mut imports: Vec<&ShaderImport> = Vec::new();
        for handle in own {
            let Some(shader) = shaders.get(handle) else { return false };
            imports.extend(&shader.imports);
        }
        let mut seen = HashSet::new();
        while let Some(import) = imports.pop() {
            for module in modules_of(import).filter(|module| seen.insert(*module)) {
                let file = format!("embedded://{}.wesl", module.replace("::", "/"));
                // Bevy does not load a module of a feature that is off, and an item is not a
                // module.
                let Some(handle) = server.get_handle::<Shader>(file) else { continue };
                let Some(shader) = shaders.get(&handle) else { return false };
                imports.extend(&shader.imports);
            }
        }
        true
    }

    pub(crate) fn of(&self, entity: Entity) -> Option<&Arc<Program>> {
        self.of_entities.get(&entity)
    }
}

/// Finds the program of each new or changed entity, and makes the shaders of a program that is new.
pub(crate) fn register(
    mut programs: ResMut<Programs>,
    mut shaders: ResMut<Assets<Shader>>,
    changed: Query<(Entity, &Tessellated), Changed<Tessellated>>,
    mut removed: RemovedComponents<Tessellated>,
) {
    for entity in removed.read() {
        programs.of_entities.remove(&entity);
    }
    for (entity, tessellated) in &changed {
        let key = Key::new(tessellated);
        let (number, prepass) = (programs.all.len(), programs.prepass.clone());
        let program = programs.all.entry(key).or_insert_with_key(|key| {
            let vertex = shaders.add(key.vertex_shader(number));
            let name = format!("fragment_{number}");
            let fragment = shaders.add(fragment_shader(&key.fragment, &name));
            Arc::new(Program { number, key: key.clone(), vertex, fragment, prepass })
        });
        let program = Arc::clone(program);
        programs.of_entities.insert(entity, program);
    }
}
