//! Seeds of the readers of mesh files: small valid files of every form.

use super::naive::seeds;

/// OBJ files.
pub fn obj() -> Vec<Vec<u8>> {
    seeds::obj()
}

/// glTF and GLB files.
pub fn gltf() -> Vec<Vec<u8>> {
    seeds::gltf()
}

/// Bezier patch files.
pub fn bpt() -> Vec<Vec<u8>> {
    seeds::bpt()
}

/// PNG files: every colour type and depth, plain and interlaced, on random bytes.
pub fn height_png() -> Vec<Vec<u8>> {
    let kinds = [
        (0, &[1, 2, 4, 8, 16][..]),
        (2, &[8, 16]),
        (3, &[1, 2, 4, 8]),
        (4, &[8, 16]),
        (6, &[8, 16]),
    ];
    let kinds = kinds.iter().flat_map(|&(colour, depths)| depths.iter().map(move |&d| (colour, d)));
    let sizes = [(1u8, 1u8), (5, 3), (9, 10)];
    let mut seeds = Vec::new();
    for (number, (colour, depth)) in kinds.enumerate() {
        for interlaced in [false, true] {
            let (width, height) = sizes[(number + usize::from(interlaced)) % 3];
            seeds.push(png(width, height, depth, colour, interlaced));
        }
    }
    seeds
}

/// First column and row of each pass of an interlaced image, and the steps between them.
const PASSES: [[usize; 4]; 7] = [
    [0, 0, 8, 8],
    [4, 0, 8, 8],
    [0, 4, 4, 8],
    [2, 0, 4, 4],
    [0, 2, 2, 4],
    [1, 0, 2, 2],
    [0, 1, 1, 2],
];

fn png(width: u8, height: u8, depth: u8, colour: u8, interlaced: bool) -> Vec<u8> {
    let header = [0, 0, 0, width, 0, 0, 0, height, depth, colour, 0, 0, u8::from(interlaced)];
    let mut state = u32::from_be_bytes([width, height, depth, colour]) | 1;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        state.to_le_bytes()[1]
    };
    let mut rows = Vec::new();
    let channels = match colour {
        2 => 3,
        4 => 2,
        6 => 4,
        _ => 1,
    };
    let passes = if interlaced { &PASSES[..] } else { &[[0, 0, 1, 1]] };
    for &[x0, y0, dx, dy] in passes {
        let columns = (x0..usize::from(width)).step_by(dx).count();
        let bytes = (columns * channels * usize::from(depth)).div_ceil(8);
        for _ in (y0..usize::from(height)).step_by(dy).filter(|_| columns > 0) {
            rows.push(random() % 5);
            rows.extend((0..bytes).map(|_| random()));
        }
    }
    let mut file = b"\x89PNG\r\n\x1A\n".to_vec();
    let palette: Vec<u8> = (0..3usize << depth.min(8)).map(|_| random()).collect();
    chunk(&mut file, b"IHDR", &header);
    if colour == 3 {
        chunk(&mut file, b"PLTE", &palette);
    }
    if colour == 3 && !interlaced {
        chunk(&mut file, b"tRNS", &[7]);
    }
    chunk(&mut file, b"IDAT", &miniz_oxide::deflate::compress_to_vec_zlib(&rows, 1));
    chunk(&mut file, b"IEND", b"");
    file
}

/// Appends a chunk of a PNG file, with its checksum.
pub fn chunk(file: &mut Vec<u8>, kind: &[u8], content: &[u8]) {
    file.extend(u32::try_from(content.len()).unwrap_or(0).to_be_bytes());
    let start = file.len();
    file.extend(kind);
    file.extend(content);
    file.extend(crc32fast::hash(&file[start..]).to_be_bytes());
}
