//! PNG files as heights, and a decoder that takes its bytes one by one.

use super::bits;
use miniz_oxide::inflate::decompress_to_vec_with_limit;
use tess_program::fuzzing::{self, Heights};

/// Most pixels.
const MOST: u64 = 1 << 16;

/// Compares one file. Errors: the first difference, or an empty message.
pub fn check(data: &[u8]) -> Result<(), String> {
    let words = |(width, height, texels): &Heights| {
        let size = [*width as u32, *height as u32];
        size.into_iter().chain(texels.iter().map(|&texel| bits(texel))).collect()
    };
    // A file of numbers has no places that a user could look at; the message says what is wrong.
    let says_what = |message: &str| !message.is_empty();
    super::check(fuzzing::height_png(data, MOST), words, says_what, || naive(data))
}

/// First column and row of each pass of an interlaced image, and the steps between them.
pub(super) const PASSES: [[usize; 4]; 7] = [
    [0, 0, 8, 8],
    [4, 0, 8, 8],
    [0, 4, 4, 8],
    [2, 0, 4, 4],
    [0, 2, 2, 4],
    [1, 0, 2, 2],
    [0, 1, 1, 2],
];

/// Channels of a pixel by colour type.
pub(super) fn channels(colour: u8) -> usize {
    match colour {
        2 => 3,
        4 => 2,
        6 => 4,
        _ => 1,
    }
}

fn word(bytes: &[u8]) -> Option<usize> {
    Some(u32::from_be_bytes(*bytes.first_chunk()?) as usize)
}

/// The chunks of a file up to its end: type and content.
fn chunks(mut data: &[u8]) -> Vec<(&[u8], &[u8])> {
    let mut chunks = Vec::new();
    while let Some(length) = word(data) {
        let (Some(kind), Some(content)) = (data.get(4..8), data.get(8..8 + length)) else { break };
        chunks.push((kind, content));
        data = data.get(12 + length..).unwrap_or_default();
    }
    chunks
}

fn naive(data: &[u8]) -> Option<Heights> {
    let chunks = chunks(data.get(8..)?);
    let content = |name: &[u8]| chunks.iter().find(|(kind, _)| *kind == name).map(|(_, c)| *c);
    let header = content(b"IHDR")?;
    let (width, height) = (word(header)?, word(&header[4..])?);
    let (depth, colour, interlaced) = (usize::from(header[8]), header[9], header[12] == 1);
    let palette = content(b"PLTE").unwrap_or_default();
    let first = chunks.iter().position(|(kind, _)| *kind == b"IDAT")?;
    let data = chunks[first..].iter().take_while(|(kind, _)| *kind == b"IDAT");
    let data: Vec<u8> = data.flat_map(|(_, content)| content.iter().copied()).collect();
    // Two bytes of zlib's header; its checksum at the end is left alone.
    let mut raw = match decompress_to_vec_with_limit(data.get(2..)?, 1 << 24) {
        Ok(raw) => raw,
        Err(error) => error.output,
    }
    .into_iter();
    let bits = channels(colour) * depth;
    let mut texels = vec![0.0; width * height];
    let passes = if interlaced { &PASSES[..] } else { &[[0, 0, 1, 1]] };
    for &[x0, y0, dx, dy] in passes {
        let columns: Vec<usize> = (x0..width).step_by(dx).collect();
        let mut above = vec![0; (columns.len() * bits).div_ceil(8)];
        if columns.is_empty() {
            continue;
        }
        for y in (y0..height).step_by(dy) {
            let filter = raw.next()?;
            let mut row: Vec<u8> = raw.by_ref().take(above.len()).collect();
            if row.len() < above.len() {
                return None;
            }
            unfilter(filter, &mut row, &above, bits.div_ceil(8));
            for (k, &x) in columns.iter().enumerate() {
                let channel = |c: usize| sample(&row, (k * channels(colour) + c) * depth, depth);
                texels[y * width + x] = grey(colour, depth, palette, channel);
            }
            above = row;
        }
    }
    Some((width, height, texels))
}

/// The number of `depth` bits from bit `at` on.
fn sample(row: &[u8], at: usize, depth: usize) -> usize {
    (at..at + depth).fold(0, |n, bit| n << 1 | usize::from(row[bit / 8] >> (7 - bit % 8) & 1))
}

fn grey(colour: u8, depth: usize, palette: &[u8], channel: impl Fn(usize) -> usize) -> f32 {
    let luma = |[r, g, b]: [f32; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
    let value = |c: usize| match depth {
        16 => channel(c) as f32 / 65535.0,
        // Fewer than 8 bits are spread over 0..=255.
        _ => (channel(c) * (255 / ((1 << depth) - 1))) as f32 / 255.0,
    };
    match colour {
        0 | 4 => value(0),
        3 => luma(
            [0, 1, 2]
                .map(|c| f32::from(palette.get(3 * channel(0) + c).copied().unwrap_or(0)) / 255.0),
        ),
        _ => luma([value(0), value(1), value(2)]),
    }
}

/// PNG specification, section 9.
fn unfilter(filter: u8, row: &mut [u8], above: &[u8], pixel: usize) {
    for k in 0..row.len() {
        let before = |row: &[u8]| if k < pixel { 0 } else { row[k - pixel] };
        let (a, b, c) = (before(row), above[k], before(above));
        let predicted = match filter {
            1 => a,
            2 => b,
            3 => ((u16::from(a) + u16::from(b)) / 2) as u8,
            4 => paeth(a, b, c),
            _ => 0,
        };
        row[k] = row[k].wrapping_add(predicted);
    }
}

fn paeth(a: u8, b: u8, c: u8) -> u8 {
    let p = i16::from(a) + i16::from(b) - i16::from(c);
    let distance = |x: u8| (p - i16::from(x)).abs();
    if distance(a) <= distance(b) && distance(a) <= distance(c) {
        a
    } else if distance(b) <= distance(c) {
        b
    } else {
        c
    }
}
