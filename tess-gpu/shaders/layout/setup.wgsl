// needs: nothing
// Values that every entry point agrees on. `Setup::prelude` in src/setup.rs writes constants before this file, so that
// no number is written in both languages: the setup (DOMAIN, PARTITIONING, OUTPUT, SPLIT, POINT_FORMAT, NUMBERING, FACTORS,
// COPIES, ORDER) and the values that these can have (ISOLINE, TRIANGLE, QUAD and so on); the sizes of src/sizes.rs; the
// places in the tables of src/tables.rs; and SCRATCH and THREADS for the entry points that expand.

// The two numbers of an entry of the offsets, and the kinds of elements.
const POINTS = 0u;
const PRIMITIVES = 1u;

const NEVER = 0xffffffffu;

// Whether blocks of like patches are copied, points too.
const HAS_COPIED_POINTS = COPIES == 1u && IS_INTEGER;

// Words of a point in the catalogue: the point, or its description.
const POINT_WORDS = select(1u, 2u, IS_INTEGER);

const IS_INTEGER = PARTITIONING == INTEGER || PARTITIONING == POW2;

// Edges of a triangle or quad.
const EDGES = select(3u, 4u, DOMAIN == QUAD);

const IS_TRIANGLES = DOMAIN != ISOLINE && OUTPUT >= OUTPUT_TRIANGLE_CW;
const INDICES = select(select(2u, 3u, IS_TRIANGLES), 1u, OUTPUT == OUTPUT_POINT);

// One portion of a batch and one window of its output: the host's `layout::Job`, which explains each
// member.
struct Job {
    patches: u32,
    first_patch: u32,
    portion: u32,
    stride: u32,
    blocks_at: u32,
    alike_at: u32,
    sections_at: u32,
    primitive_tiles_at: u32,
    window_first: u32,
    window_tiles: u32,
    portions: u32,
    point_capacity: u32,
    primitive_capacity: u32,
    point_windows: u32,
    primitive_windows: u32,
    point_window_tiles: u32,
    primitive_window_tiles: u32,
    max_workgroups: u32,
    tile_bits: u32,
    has_catalogue: u32,
}

// Where a portion's output is within the batch's.
struct Range {
    points_begin: u32,
    points_end: u32,
    primitives_begin: u32,
    primitives_end: u32,
}

// The host's `layout::Status`, with the range of each portion after it.
struct Status {
    // The batch's needs, low and high words.
    points: u32,
    points_high: u32,
    primitives: u32,
    primitives_high: u32,
    // Bit 0: the points don't fit, bit 1: the indices don't.
    overflow: u32,
    reserved_0: u32,
    reserved_1: u32,
    reserved_2: u32,
    ranges: array<Range>,
}
