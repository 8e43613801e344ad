//! The structures that host and shaders share, as declared in the shaders.

use naga::{Module, Scalar, ScalarKind, TypeInner};
use serde::Serialize;
use tess_gpu::{Setup, Stage};

/// A structure: its size in bytes, and its members in order.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(super) struct Structure {
    pub(super) name: String,
    pub(super) bytes: u32,
    pub(super) members: Vec<Member>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(super) struct Member {
    pub(super) name: String,
    pub(super) offset: u32,
    /// `u32`, or the name of a structure; a name in brackets is an array up to the buffer's end.
    #[serde(rename = "type")]
    pub(super) ty: String,
}

/// Every structure that a stage binds, and the draw arguments.
pub(super) fn all(setup: Setup) -> Vec<Structure> {
    let mut found: Vec<Structure> = Vec::new();
    for stage in Stage::ALL {
        let Ok(module) = naga::front::wgsl::parse_str(&stage.source(setup)) else { continue };
        let bound = module.global_variables.iter().filter(|(_, v)| v.binding.is_some());
        for (_, variable) in bound {
            add(&module, variable.ty, &mut found);
        }
    }
    found.push(draw_indexed());
    found
}

fn add(module: &Module, ty: naga::Handle<naga::Type>, found: &mut Vec<Structure>) {
    let own = &module.types[ty];
    let (Some(name), TypeInner::Struct { members, span }) = (&own.name, &own.inner) else { return };
    if found.iter().any(|structure| structure.name == *name) {
        return;
    }
    for member in members {
        match module.types[member.ty].inner {
            TypeInner::Array { base, .. } => add(module, base, found),
            _ => add(module, member.ty, found),
        }
    }
    let member = |member: &naga::StructMember| Member {
        name: member.name.clone().unwrap_or_default(),
        offset: member.offset,
        ty: type_name(module, member.ty),
    };
    let bytes = match members.last() {
        Some(last) if ends_open(module, last.ty) => last.offset,
        _ => *span,
    };
    let members = members.iter().map(member).collect();
    found.push(Structure { name: name.clone(), bytes, members });
}

/// Whether only the host knows the length of this type: it is an array, or a structure that ends
/// with one.
pub(super) fn ends_open(module: &Module, ty: naga::Handle<naga::Type>) -> bool {
    match &module.types[ty].inner {
        TypeInner::Array { size: naga::ArraySize::Dynamic, .. } => true,
        TypeInner::Struct { members, .. } => {
            members.last().is_some_and(|last| ends_open(module, last.ty))
        }
        _ => false,
    }
}

fn type_name(module: &Module, ty: naga::Handle<naga::Type>) -> String {
    let own = &module.types[ty];
    match own.inner {
        TypeInner::Scalar(Scalar { kind: ScalarKind::Uint, width: 4 }) => "u32".to_owned(),
        TypeInner::Array { base, size: naga::ArraySize::Dynamic, .. } => {
            format!("[{}]", type_name(module, base))
        }
        _ => own.name.clone().unwrap_or_else(|| format!("{:?}", own.inner)),
    }
}

/// [`tess_gpu::layout::DrawIndexed`], which is not declared in any shader.
fn draw_indexed() -> Structure {
    let names = ["index_count", "instance_count", "first_index", "base_vertex", "first_instance"];
    let members = (0..).zip(names).map(|(word, name)| Member {
        name: name.to_owned(),
        offset: 4 * word,
        ty: "u32".to_owned(),
    });
    Structure { name: "DrawIndexed".to_owned(), bytes: 20, members: members.collect() }
}
