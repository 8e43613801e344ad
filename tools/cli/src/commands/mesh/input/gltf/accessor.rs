//! Accessors: the rules about their bytes, and reading them.
//!
//! The source is the glTF 2.0 Specification, section 3.6.2 and the properties `accessor` and
//! `bufferView` in section 5. [`check`] must have passed before anything is read.

use super::document::{Accessor, BufferView, ComponentType, Document, Sparse, broken};
use std::borrow::Cow;

/// Checks every buffer view and every accessor of a document. Errors: the first broken rule, with
/// the JSON path.
pub(super) fn check(document: &Document) -> Result<(), String> {
    for (number, view) in document.buffer_views.iter().enumerate() {
        check_view(document, view)
            .map_err(|(name, what)| broken(format!("bufferViews[{number}].{name}"), what))?;
    }
    for (number, accessor) in document.accessors.iter().enumerate() {
        check_accessor(document, accessor)
            .map_err(|(name, what)| broken(format!("accessors[{number}].{name}"), what))?;
    }
    Ok(())
}

/// The property at fault, and its fault.
type BrokenRule = (&'static str, String);

fn check_view(document: &Document, view: &BufferView) -> Result<(), BrokenRule> {
    let count = document.buffers.len();
    let buffer = document.buffers.get(view.buffer).ok_or_else(|| {
        ("buffer", format!("{} is out of range: there are {count} buffers", view.buffer))
    })?;
    let end = view.byte_offset.checked_add(view.byte_length);
    if view.byte_length == 0 || end.is_none_or(|end| end > buffer.byte_length) {
        let (start, length, most) = (view.byte_offset, view.byte_length, buffer.byte_length);
        let what = format!("{length} bytes from {start} on are not within the buffer's {most}");
        return Err(("byteLength", what));
    }
    match view.byte_stride {
        Some(stride) if !(4..=252).contains(&stride) || !stride.is_multiple_of(4) => {
            Err(("byteStride", format!("{stride} is not a multiple of 4 from 4 to 252")))
        }
        _ => Ok(()),
    }
}

fn check_accessor(document: &Document, accessor: &Accessor) -> Result<(), BrokenRule> {
    if accessor.count == 0 {
        return Err(("count", "it is 0; at least 1 is needed".to_owned()));
    }
    let size = accessor.kind.size(accessor.component_type);
    let whole =
        matches!(accessor.component_type, ComponentType::Float | ComponentType::UnsignedInt);
    if accessor.normalized && whole {
        return Err(("normalized", "only bytes and shorts can be normalized".to_owned()));
    }
    // Without a buffer view all elements are zeros.
    if accessor.buffer_view.is_none() && accessor.byte_offset.is_some() {
        return Err(("byteOffset", "it has no meaning without bufferView".to_owned()));
    }
    if let Some(number) = accessor.buffer_view {
        let view = view(document, number).map_err(|what| ("bufferView", what))?;
        let stride = view.byte_stride.unwrap_or(size);
        let offset = accessor.byte_offset.unwrap_or(0);
        let bytes = ElementBytes { offset, stride, size, count: accessor.count };
        bytes.check(view, accessor.component_type)?;
    }
    accessor.sparse.as_ref().map_or(Ok(()), |sparse| check_sparse(document, accessor, sparse))
}

fn check_sparse(
    document: &Document,
    accessor: &Accessor,
    sparse: &Sparse,
) -> Result<(), BrokenRule> {
    let Sparse { count, indices, values } = sparse;
    if *count == 0 || *count > accessor.count {
        let what = format!("{count} is not from 1 to the accessor's count, {}", accessor.count);
        return Err(("sparse.count", what));
    }
    let kind = indices.component_type;
    if !is_index(kind) {
        let what = format!("{kind:?} is not an unsigned integer");
        return Err(("sparse.indices.componentType", what));
    }
    let size = accessor.kind.size(accessor.component_type);
    for (path, number, offset, size, component) in [
        ("sparse.indices", indices.buffer_view, indices.byte_offset, kind.size(), kind),
        ("sparse.values", values.buffer_view, values.byte_offset, size, accessor.component_type),
    ] {
        let view = view(document, number).map_err(|what| (path, what))?;
        if view.byte_stride.is_some() || view.target.is_some() {
            let what = format!("bufferViews[{number}] must have no byteStride and no target");
            return Err((path, what));
        }
        let bytes = ElementBytes { offset, stride: size, size, count: *count };
        bytes.check(view, component).map_err(|(name, what)| (path, format!("{name}: {what}")))?;
    }
    Ok(())
}

/// Whether integers of a type can be indices of vertices.
pub(super) const fn is_index(kind: ComponentType) -> bool {
    use ComponentType::{UnsignedByte, UnsignedInt, UnsignedShort};
    matches!(kind, UnsignedByte | UnsignedShort | UnsignedInt)
}

fn view(document: &Document, number: usize) -> Result<&BufferView, String> {
    let count = document.buffer_views.len();
    let view = document.buffer_views.get(number);
    view.ok_or_else(|| format!("{number} is out of range: there are {count} buffer views"))
}

/// Elements in a buffer view; all sizes are in bytes.
#[derive(Clone, Copy)]
struct ElementBytes {
    offset: u64,
    stride: u64,
    size: u64,
    count: u64,
}

impl ElementBytes {
    fn check(&self, view: &BufferView, component: ComponentType) -> Result<(), BrokenRule> {
        let &Self { offset, stride, size, count } = self;
        if stride < size {
            return Err(("bufferView", format!("its byteStride {stride} is less than {size}")));
        }
        let end = (count - 1).checked_mul(stride).and_then(|last| last.checked_add(offset));
        if end.and_then(|last| last.checked_add(size)).is_none_or(|end| end > view.byte_length) {
            let length = view.byte_length;
            let what = format!(
                "{count} elements of {size} bytes, {stride} apart from {offset} on, \
                 are not within the {length} bytes of the buffer view"
            );
            return Err(("count", what));
        }
        let unit = component.size();
        if !(view.byte_offset + offset).is_multiple_of(unit) || !stride.is_multiple_of(unit) {
            let what = format!("components do not begin at multiples of their size, {unit} bytes");
            return Err(("byteOffset", what));
        }
        Ok(())
    }
}

/// A checked document and the contents of its buffers.
#[derive(Debug)]
pub(super) struct Data<'a> {
    pub(super) document: &'a Document,
    pub(super) buffers: Vec<Cow<'a, [u8]>>,
}

impl Data<'_> {
    /// The elements of an accessor with `N` components, each converted from its bytes by
    /// `component`. Errors: sparse indices that are out of range or do not increase, with the JSON
    /// path.
    pub(super) fn read<T: Copy + Default, const N: usize>(
        &self,
        number: usize,
        component: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<[T; N]>, String> {
        let accessor = &self.document.accessors[number];
        let unit = index(accessor.component_type.size());
        let size = N * unit;
        let element =
            |bytes: &[u8]| std::array::from_fn(|k| component(&bytes[k * unit..(k + 1) * unit]));
        let mut elements = match accessor.buffer_view {
            None => vec![[T::default(); N]; index(accessor.count)],
            Some(view) => {
                let stride = self.document.buffer_views[view].byte_stride.map_or(size, index);
                let bytes = self.view(view, accessor.byte_offset.unwrap_or(0));
                bytes.chunks(stride).take(index(accessor.count)).map(element).collect()
            }
        };
        if let Some(sparse) = &accessor.sparse {
            let values = self.view(sparse.values.buffer_view, sparse.values.byte_offset);
            let indices = self.sparse_indices(sparse, elements.len());
            let indices = indices
                .map_err(|what| broken(format!("accessors[{number}].sparse.indices"), what))?;
            for (place, bytes) in indices.into_iter().zip(values.chunks(size)) {
                elements[place] = element(bytes);
            }
        }
        Ok(elements)
    }

    /// The elements of an accessor of any component type; normalized integers are converted as in
    /// section 3.6.2.2.
    pub(super) fn numbers<const N: usize>(&self, number: usize) -> Result<Vec<[f32; N]>, String> {
        let accessor = &self.document.accessors[number];
        let most = match (accessor.normalized, accessor.component_type) {
            (true, ComponentType::Byte) => 127.0,
            (true, ComponentType::UnsignedByte) => 255.0,
            (true, ComponentType::Short) => 32767.0,
            (true, ComponentType::UnsignedShort) => 65535.0,
            _ => 1.0,
        };
        match accessor.component_type {
            ComponentType::Float => self.read(number, float),
            ComponentType::Byte | ComponentType::Short if accessor.normalized => {
                self.read(number, |bytes| (signed(bytes) / most).max(-1.0))
            }
            ComponentType::Byte | ComponentType::Short => self.read(number, signed),
            _ => self.read(number, |bytes| unsigned(bytes) as f32 / most),
        }
    }

    /// The elements of an accessor of unsigned integers.
    pub(super) fn integers<const N: usize>(&self, number: usize) -> Result<Vec<[u32; N]>, String> {
        self.read(number, unsigned)
    }

    fn sparse_indices(&self, sparse: &Sparse, most: usize) -> Result<Vec<usize>, String> {
        let bytes = self.view(sparse.indices.buffer_view, sparse.indices.byte_offset);
        let unit = index(sparse.indices.component_type.size());
        let indices = bytes.chunks(unit).take(index(sparse.count)).map(unsigned);
        let indices: Vec<usize> = indices.map(|number| index(u64::from(number))).collect();
        if !indices.is_sorted_by(|a, b| a < b) {
            return Err("they do not increase".to_owned());
        }
        match indices.last() {
            Some(&last) if last >= most => {
                Err(format!("{last} is out of range: there are {most} elements"))
            }
            _ => Ok(indices),
        }
    }

    /// The bytes of a buffer view, starting at `offset`.
    fn view(&self, number: usize, offset: u64) -> &[u8] {
        let view = &self.document.buffer_views[number];
        let (start, end) = (view.byte_offset + offset, view.byte_offset + view.byte_length);
        &self.buffers[view.buffer][index(start)..index(end)]
    }
}

/// A checked length or offset as an index. It fits, because buffers are in memory.
fn index(number: u64) -> usize {
    usize::try_from(number).unwrap_or(usize::MAX)
}

/// An unsigned integer of up to four bytes.
pub(super) fn unsigned(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |number, &byte| number << 8 | u32::from(byte))
}

/// A signed integer of one or two bytes.
fn signed(bytes: &[u8]) -> f32 {
    match *bytes {
        [byte] => f32::from(byte.cast_signed()),
        _ => f32::from(u16::try_from(unsigned(bytes)).unwrap_or(0).cast_signed()),
    }
}

/// A float of four bytes.
pub(super) fn float(bytes: &[u8]) -> f32 {
    f32::from_bits(unsigned(bytes))
}
