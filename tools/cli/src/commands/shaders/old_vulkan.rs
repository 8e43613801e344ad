//! SPIR-V for Vulkan 1.0, which SDL opens: it has no storage class for storage buffers.
//!
//! There, a storage buffer is a uniform buffer whose type has the decoration `BufferBlock` in the
//! place of `Block`. naga writes the class of Vulkan 1.1, as an extension, which SDL does not
//! enable.

const OP_EXTENSION: u32 = 10;
const OP_TYPE_POINTER: u32 = 32;
const OP_VARIABLE: u32 = 59;
const OP_DECORATE: u32 = 71;
const UNIFORM: u32 = 2;
const STORAGE_BUFFER: u32 = 12;
const BLOCK: u32 = 2;
const BUFFER_BLOCK: u32 = 3;
/// The words before the first instruction.
const HEADER: usize = 5;
const NAME: &str = "SPV_KHR_storage_buffer_storage_class";

/// The same module with the storage buffers of Vulkan 1.0.
///
/// A module in which a storage buffer and a uniform buffer have the same type stays as it is.
pub(super) fn rewritten(words: Vec<u32>) -> Vec<u32> {
    let pointees = |class: u32| -> Vec<u32> {
        let pointers = instructions(&words).filter(|one| one[0] & 0xffff == OP_TYPE_POINTER);
        pointers.filter(|one| one[2] == class).map(|one| one[3]).collect()
    };
    let stored = pointees(STORAGE_BUFFER);
    let blocks: Vec<u32> = instructions(&words)
        .filter(|one| one[0] & 0xffff == OP_DECORATE && one[2] == BLOCK)
        .map(|one| one[1])
        .filter(|ty| stored.contains(ty))
        .collect();
    if pointees(UNIFORM).iter().any(|ty| blocks.contains(ty)) {
        return words;
    }
    let mut all = words[..HEADER].to_vec();
    for one in instructions(&words) {
        let at = all.len();
        all.extend_from_slice(one);
        match one[0] & 0xffff {
            OP_EXTENSION if text(&one[1..]) == NAME.as_bytes() => all.truncate(at),
            OP_TYPE_POINTER if one[2] == STORAGE_BUFFER => all[at + 2] = UNIFORM,
            OP_VARIABLE if one[3] == STORAGE_BUFFER => all[at + 3] = UNIFORM,
            OP_DECORATE if one[2] == BLOCK && blocks.contains(&one[1]) => {
                all[at + 2] = BUFFER_BLOCK
            }
            _ => {}
        }
    }
    all
}

/// The instructions of a module: the length and code, then the operands.
fn instructions(words: &[u32]) -> impl Iterator<Item = &[u32]> {
    let mut at = HEADER;
    std::iter::from_fn(move || {
        let length = usize::try_from(words.get(at)? >> 16).ok().filter(|&length| length > 0)?;
        let one = words.get(at..at + length)?;
        at += length;
        Some(one)
    })
}

/// The text of words that end with a zero byte.
fn text(words: &[u32]) -> Vec<u8> {
    let bytes = words.iter().flat_map(|word| word.to_le_bytes());
    bytes.take_while(|&byte| byte != 0).collect()
}
