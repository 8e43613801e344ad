//! Reads the recorded results of `golden/` (described in its README).

use tess_core::{
    Config, IsolineFactors, OutputPrimitive, Partitioning, PatchFactors, QuadFactors, SplitOrder,
    TriangleFactors,
};

/// The text of a file in `golden/`.
pub(crate) fn text(file: &str) -> String {
    let path = format!("{}/../golden/{file}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Partitioning, output and split order by name.
pub(crate) fn config(names: &[&str]) -> Config {
    let partitioning = match names[0] {
        "integer" => Partitioning::Integer,
        "pow2" => Partitioning::Pow2,
        "fractional_odd" => Partitioning::FractionalOdd,
        "fractional_even" => Partitioning::FractionalEven,
        name => panic!("no partitioning: {name}"),
    };
    let output = match names[1] {
        "point" => OutputPrimitive::Point,
        "line" => OutputPrimitive::Line,
        "triangle_cw" => OutputPrimitive::TriangleCw,
        "triangle_ccw" => OutputPrimitive::TriangleCcw,
        name => panic!("no output primitive: {name}"),
    };
    let split = match names[2] {
        "ruler" => SplitOrder::Ruler,
        "center" => SplitOrder::Centre,
        name => panic!("no split order: {name}"),
    };
    Config { partitioning, output, split }
}

/// Factors from the hex bits of binary32 numbers.
pub(crate) fn factors(domain: &str, bits: &[&str]) -> PatchFactors {
    let numbers: Vec<f32> = bits
        .iter()
        .map(|bits| f32::from_bits(u32::from_str_radix(bits, 16).expect("hex digits")))
        .collect();
    match (domain, &numbers[..]) {
        ("isoline", &[density, detail]) => {
            PatchFactors::Isoline(IsolineFactors { density, detail })
        }
        ("tri", &[u0, v0, w0, inside]) => {
            PatchFactors::Triangle(TriangleFactors { u0, v0, w0, inside })
        }
        ("quad", &[u0, v0, u1, v1, inside_u, inside_v]) => {
            PatchFactors::Quad(QuadFactors { u0, v0, u1, v1, inside_u, inside_v })
        }
        _ => panic!("{domain} does not have the factors {bits:?}"),
    }
}

/// Factors as the files write them.
pub(crate) fn hex_words(factors: &PatchFactors) -> String {
    let numbers = match factors {
        PatchFactors::Isoline(f) => vec![f.density, f.detail],
        PatchFactors::Triangle(f) => [&f.outer()[..], &[f.inside]].concat(),
        PatchFactors::Quad(f) => [&f.outer()[..], &f.inside()].concat(),
    };
    let words: Vec<String> = numbers.iter().map(|f| format!("{:08x}", f.to_bits())).collect();
    words.join(" ")
}

/// FNV-1a 64 over little-endian 32-bit words.
pub(crate) fn digest(words: impl IntoIterator<Item = u32>) -> String {
    let bytes = words.into_iter().flat_map(u32::to_le_bytes);
    let hash = bytes.fold(0xCBF2_9CE4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3)
    });
    format!("{hash:016x}")
}

/// The lines of a file of listings.
pub(crate) struct RecordedLines<'a>(std::str::Lines<'a>);

impl<'a> RecordedLines<'a> {
    pub(crate) fn new(text: &'a str) -> Self {
        Self(text.lines())
    }

    /// The rest of the next line that begins with `start`.
    pub(crate) fn next_starting(&mut self, start: &str) -> Option<&'a str> {
        self.0.find_map(|line| line.strip_prefix(start))
    }

    /// The numbers of a list whose items have `each` numbers; the list's length follows `start`.
    pub(crate) fn next_list(&mut self, start: &str, each: usize, radix: u32) -> Vec<u32> {
        let length = self.next_starting(start).expect("a list");
        let length = length.parse::<usize>().expect("its length") * each;
        let mut numbers = Vec::with_capacity(length);
        while numbers.len() < length {
            let line = self.0.next().expect("as many as announced").split(' ');
            numbers.extend(line.map(|n| u32::from_str_radix(n, radix).expect("a number")));
        }
        numbers
    }
}
