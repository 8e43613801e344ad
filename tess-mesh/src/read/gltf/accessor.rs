//! Accessors: the rules about their bytes, and reading them.
//!
//! The source is the glTF 2.0 Specification, section 3.6.2 and the properties `accessor` and
//! `bufferView` in section 5. An accessor is checked when it is read for the first time. Rules
//! about alignment are for programs that pass the bytes to a GPU; here a place that breaks one is
//! counted.

use super::buffers::Buffers;
use super::document::{Accessor, BufferView, ComponentType, Document, Sparse, broken};
use crate::budget::Budget;
use std::cell::OnceCell;

/// The property at fault, and its fault.
type BrokenRule = (&'static str, String);

/// A document and the contents of its buffers.
#[derive(Debug)]
pub(crate) struct Data<'a> {
    pub(crate) document: &'a Document,
    pub(crate) buffers: Buffers<'a>,
    pub(crate) budget: &'a Budget,
    /// The result of checking each accessor.
    checked: Vec<OnceCell<Result<(), String>>>,
}

impl<'a> Data<'a> {
    pub(crate) fn new(document: &'a Document, buffers: Buffers<'a>, budget: &'a Budget) -> Self {
        let checked = (0..document.accessors.len()).map(|_| OnceCell::new()).collect();
        Self { document, buffers, budget, checked }
    }

    /// The accessor of this number, to which the value at `path` refers. Errors: there is none; a
    /// rule that it breaks.
    pub(crate) fn accessor(
        &self,
        number: usize,
        path: impl std::fmt::Display,
    ) -> Result<&'a Accessor, String> {
        let accessor = self.document.accessors.get(number, path)?;
        let check = || {
            let checked = self.check_accessor(number, accessor);
            checked.map_err(|(name, what)| match name {
                "" => what,
                _ => broken(format!("accessors[{number}].{name}"), what),
            })
        };
        self.checked[number].get_or_init(check).clone()?;
        Ok(accessor)
    }

    fn check_accessor(&self, number: usize, accessor: &Accessor) -> Result<(), BrokenRule> {
        let component = accessor.component_type;
        if accessor.normalized && component == ComponentType::UnsignedInt {
            return Err(("normalized", "only bytes and shorts can be normalized".to_owned()));
        }
        let irregular = |name: &str| {
            self.document.irregular(|| format!("accessors[{number}].{name}"));
        };
        if accessor.normalized && component == ComponentType::Float {
            irregular("normalized");
        }
        // Without a buffer view all elements are zeros.
        if let Some(view) = accessor.buffer_view {
            let bytes = self.element_bytes(number, accessor, view)?;
            if !bytes.is_aligned(component) {
                irregular("byteOffset");
            }
        }
        match &accessor.sparse {
            Some(sparse) => self.check_sparse(number, accessor, sparse),
            None => Ok(()),
        }
    }

    /// The bytes of an accessor's elements in its buffer view.
    fn element_bytes(
        &self,
        number: usize,
        accessor: &Accessor,
        view: usize,
    ) -> Result<ElementBytes, BrokenRule> {
        let size = accessor.kind.size(accessor.component_type);
        let path = format!("accessors[{number}].bufferView");
        let view = self.view(view, path).map_err(|what| ("", what))?;
        let stride = match view.byte_stride {
            // Files that were glTF 1 once have 0 where the elements are packed.
            None | Some(0) => size,
            Some(stride) => stride,
        };
        let offset = accessor.byte_offset.unwrap_or(0);
        let start = view.byte_offset.saturating_add(offset);
        let bytes = ElementBytes { start, offset, stride, size, count: accessor.count };
        bytes.check(view)?;
        Ok(bytes)
    }

    fn check_sparse(
        &self,
        number: usize,
        accessor: &Accessor,
        sparse: &Sparse,
    ) -> Result<(), BrokenRule> {
        let Sparse { count, indices, values } = sparse;
        if *count > accessor.count {
            let what = format!("{count} is more than the accessor's count, {}", accessor.count);
            return Err(("sparse.count", what));
        }
        let kind = indices.component_type;
        if !is_index(kind) {
            let what = format!("{kind:?} is not an unsigned integer");
            return Err(("sparse.indices.componentType", what));
        }
        let size = accessor.kind.size(accessor.component_type);
        for (name, view, offset, size, component) in [
            ("sparse.indices", indices.buffer_view, indices.byte_offset, kind.size(), kind),
            (
                "sparse.values",
                values.buffer_view,
                values.byte_offset,
                size,
                accessor.component_type,
            ),
        ] {
            let path = format!("accessors[{number}].{name}");
            let view = self.view(view, &path).map_err(|what| ("", what))?;
            let start = view.byte_offset.saturating_add(offset);
            let bytes = ElementBytes { start, offset, stride: size, size, count: *count };
            bytes.check(view).map_err(|(rule, what)| (name, format!("{rule}: {what}")))?;
            if !bytes.is_aligned(component) {
                self.document.irregular(|| path);
            }
        }
        Ok(())
    }

    /// A buffer view that is within its buffer. Errors: with the JSON path.
    pub(crate) fn view(
        &self,
        number: usize,
        path: impl std::fmt::Display,
    ) -> Result<&'a BufferView, String> {
        let view = self.document.buffer_views.get(number, path)?;
        let path = format!("bufferViews[{number}]");
        let buffer = self.document.buffers.get(view.buffer, format!("{path}.buffer"))?;
        let end = view.byte_offset.checked_add(view.byte_length);
        if end.is_none_or(|end| end > buffer.byte_length) {
            let (start, length, most) = (view.byte_offset, view.byte_length, buffer.byte_length);
            let what = format!("{length} bytes from {start} on are not within the buffer's {most}");
            return Err(broken(format!("{path}.byteLength"), what));
        }
        Ok(view)
    }
}

/// Whether integers of a type can be indices of vertices.
pub(crate) const fn is_index(kind: ComponentType) -> bool {
    use ComponentType::{UnsignedByte, UnsignedInt, UnsignedShort};
    matches!(kind, UnsignedByte | UnsignedShort | UnsignedInt)
}

/// Elements in a buffer view; all sizes are in bytes.
#[derive(Clone, Copy)]
struct ElementBytes {
    /// The offset in the buffer.
    start: u64,
    /// The offset in the buffer view.
    offset: u64,
    stride: u64,
    size: u64,
    count: u64,
}

impl ElementBytes {
    fn check(&self, view: &BufferView) -> Result<(), BrokenRule> {
        let &Self { offset, stride, size, count, .. } = self;
        if stride < size {
            return Err(("bufferView", format!("its byteStride {stride} is less than {size}")));
        }
        let Some(last) = count.checked_sub(1) else { return Ok(()) };
        let end = last.checked_mul(stride).and_then(|last| last.checked_add(offset));
        if end.and_then(|last| last.checked_add(size)).is_none_or(|end| end > view.byte_length) {
            let length = view.byte_length;
            let what = format!(
                "{count} elements of {size} bytes, {stride} apart from {offset} on, \
                 are not within the {length} bytes of the buffer view"
            );
            return Err(("count", what));
        }
        Ok(())
    }

    const fn is_aligned(&self, component: ComponentType) -> bool {
        let unit = component.size();
        self.start.is_multiple_of(unit) && self.stride.is_multiple_of(unit)
    }
}

impl Data<'_> {
    /// The elements of an accessor with `N` components, each converted from its bytes by
    /// `component`. All of them are charged before any is made. Errors: a rule that the accessor
    /// breaks; sparse indices that are out of range or do not increase, with the JSON path.
    pub(crate) fn read<T: Copy + Default, const N: usize>(
        &self,
        number: usize,
        component: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<[T; N]>, String> {
        let accessor = self.accessor(number, format!("accessors[{number}]"))?;
        let path = |what| broken(format!("accessors[{number}].count"), what);
        let size_in_memory = (N * size_of::<T>()) as u64;
        self.budget.charge(accessor.count, size_in_memory, "elements").map_err(path)?;
        let unit = index(accessor.component_type.size());
        let size = N * unit;
        let element =
            |bytes: &[u8]| std::array::from_fn(|k| component(&bytes[k * unit..(k + 1) * unit]));
        let mut elements = match accessor.buffer_view.filter(|_| accessor.count > 0) {
            None => vec![[T::default(); N]; index(accessor.count)],
            Some(view) => {
                let stride = self.view(view, "")?.byte_stride.filter(|&stride| stride > 0);
                let bytes = self.bytes(view, accessor.byte_offset.unwrap_or(0))?;
                let stride = stride.map_or(size, index);
                bytes.chunks(stride).take(index(accessor.count)).map(element).collect()
            }
        };
        if let Some(sparse) = accessor.sparse.as_ref().filter(|sparse| sparse.count > 0) {
            let values = self.bytes(sparse.values.buffer_view, sparse.values.byte_offset)?;
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
    pub(crate) fn numbers<const N: usize>(&self, number: usize) -> Result<Vec<[f32; N]>, String> {
        let accessor = self.accessor(number, format!("accessors[{number}]"))?;
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
    pub(crate) fn integers<const N: usize>(&self, number: usize) -> Result<Vec<[u32; N]>, String> {
        self.read(number, unsigned)
    }

    fn sparse_indices(&self, sparse: &Sparse, most: usize) -> Result<Vec<usize>, String> {
        let bytes = self.bytes(sparse.indices.buffer_view, sparse.indices.byte_offset)?;
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

    /// The bytes of a checked buffer view, starting at `offset`.
    pub(crate) fn bytes(&self, number: usize, offset: u64) -> Result<&[u8], String> {
        let view = self.view(number, format!("bufferViews[{number}]"))?;
        let (start, end) = (view.byte_offset + offset, view.byte_offset + view.byte_length);
        Ok(&self.buffers.get(self.document, view.buffer)?[index(start)..index(end)])
    }
}

/// A checked length or offset as an index. It fits, because buffers are in memory.
fn index(number: u64) -> usize {
    usize::try_from(number).unwrap_or(usize::MAX)
}

/// An unsigned integer of up to four bytes.
pub(crate) fn unsigned(bytes: &[u8]) -> u32 {
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
pub(crate) fn float(bytes: &[u8]) -> f32 {
    f32::from_bits(unsigned(bytes))
}
