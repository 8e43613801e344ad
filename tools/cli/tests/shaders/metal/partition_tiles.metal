// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;

struct _mslBufferSizes {
    uint size1;
    uint size2;
    uint size3;
};

struct Job {
    uint patches;
    uint first_patch;
    uint portion;
    uint stride;
    uint blocks_at;
    uint alike_at;
    uint sections_at;
    uint primitive_tiles_at;
    uint window_first;
    uint window_tiles;
    uint portions;
    uint point_capacity;
    uint primitive_capacity;
    uint point_windows;
    uint primitive_windows;
    uint point_window_tiles;
    uint primitive_window_tiles;
    uint max_workgroups;
    uint tile_bits;
    uint has_catalogue;
};
struct Range {
    uint points_begin;
    uint points_end;
    uint primitives_begin;
    uint primitives_end;
};
typedef Range type_2[1];
struct Status {
    uint points;
    uint points_high;
    uint primitives;
    uint primitives_high;
    uint overflow;
    uint reserved_0_;
    uint reserved_1_;
    uint reserved_2_;
    type_2 ranges;
};
typedef metal::uint2 type_4[1];
typedef uint type_5[1];
constant uint DOMAIN = 2u;
constant uint PARTITIONING = 2u;
constant uint OUTPUT = 2u;
constant uint SPLIT = 0u;
constant uint POINT_FORMAT = 0u;
constant uint NUMBERING = 0u;
constant uint FACTORS = 6u;
constant uint COPIES = 1u;
constant uint ORDER = 0u;
constant uint COLUMN = 4u;
constant uint WORKGROUP = 64u;
constant uint ROUND = 128u;
constant uint SUMMED = 256u;
constant uint BLOCK = 256u;
constant uint BLOCK_BITS = 8u;
constant uint SECTION_BLOCKS = 256u;
constant uint SECTION_BLOCK_BITS = 8u;
constant uint SECTION = 65536u;
constant uint SECTION_BITS = 16u;
constant uint DISPATCHES_AT = 8u;
constant uint SLOT_BITS = 13u;
constant uint SLOTS = 8192u;
constant uint CATALOGUE_POINTS = 131072u;
constant uint CATALOGUE_TRIANGLES = 262144u;
constant uint LISTED_POINTS = 512u;
constant uint LISTED_PRIMITIVES = 512u;
constant uint USED_AT = 8192u;
constant uint TILE = 2048u;
constant uint PLACES_AT = 8194u;
constant uint POINTS_AT = 24578u;
constant uint TRIANGLES_AT = 286722u;
constant uint RECIPROCALS_AT = 0u;
constant uint STITCHES_AT = 64u;
constant uint STITCH_WORDS = 128u;
constant uint TRANSITION_STRIDE = 64u;
constant uint FAN_STITCH = 65u;
constant uint RING_STITCH = 4096u;
constant uint MIRRORED_STRIP = 4160u;
constant uint PLAIN_STRIP = 4224u;
constant uint ISOLINE = 0u;
constant uint TRIANGLE = 1u;
constant uint QUAD = 2u;
constant uint INTEGER = 0u;
constant uint POW2_ = 1u;
constant uint FRACTIONAL_ODD = 2u;
constant uint FRACTIONAL_EVEN = 3u;
constant uint OUTPUT_POINT = 0u;
constant uint OUTPUT_LINE = 1u;
constant uint OUTPUT_TRIANGLE_CW = 2u;
constant uint OUTPUT_TRIANGLE_CCW = 3u;
constant uint RULER = 0u;
constant uint CENTER = 1u;
constant uint PACKED = 0u;
constant uint F32_ = 1u;
constant uint SPECIFICATION = 0u;
constant uint VERTEX_CACHE = 1u;
constant uint PER_BATCH = 0u;
constant uint PER_PATCH = 1u;
constant uint POINTS = 0u;
constant uint PRIMITIVES = 1u;
constant uint NEVER = 4294967295u;
constant bool IS_INTEGER = false;
constant bool HAS_COPIED_POINTS = false;
constant uint POINT_WORDS = 1u;
constant uint EDGES = 4u;
constant bool IS_TRIANGLES = true;
constant uint INDICES = 3u;

uint tile_at(
    uint element,
    constant Job& job
) {
    uint _e3 = job.tile_bits;
    return element >> _e3;
}

uint tile_end(
    uint end,
    constant Job& job
) {
    uint _e4 = job.tile_bits;
    uint _e11 = job.tile_bits;
    return ((end + (1u << _e4)) - 1u) >> _e11;
}

uint offset_at(
    uint index,
    uint kind,
    device type_4 const& offsets,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint _e5 = offsets[metal::min(unsigned(index), (_buffer_sizes.size1 - 0 - 8) / 8)][metal::min(unsigned(kind), 1u)];
    return _e5;
}

uint nearer_entry(
    uint found,
    uint reach,
    uint first,
    uint count,
    uint kind_1,
    uint goal,
    device type_4 const& offsets,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint next = metal::min(found + reach, count - 1u);
    uint _e11 = offset_at(first + next, kind_1, offsets, _buffer_sizes);
    return (_e11 <= goal) ? next : found;
}

uint last_at_or_before(
    uint first_1,
    uint count_1,
    uint kind_2,
    uint goal_1,
    device type_4 const& offsets,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint found_1 = 0u;
    if (count_1 > 16u) {
        uint _e8 = found_1;
        uint _e10 = nearer_entry(_e8, 128u, first_1, count_1, kind_2, goal_1, offsets, _buffer_sizes);
        found_1 = _e10;
        uint _e11 = found_1;
        uint _e13 = nearer_entry(_e11, 64u, first_1, count_1, kind_2, goal_1, offsets, _buffer_sizes);
        found_1 = _e13;
        uint _e14 = found_1;
        uint _e16 = nearer_entry(_e14, 32u, first_1, count_1, kind_2, goal_1, offsets, _buffer_sizes);
        found_1 = _e16;
        uint _e17 = found_1;
        uint _e19 = nearer_entry(_e17, 16u, first_1, count_1, kind_2, goal_1, offsets, _buffer_sizes);
        found_1 = _e19;
    }
    if (count_1 > 1u) {
        uint _e22 = found_1;
        uint _e24 = nearer_entry(_e22, 8u, first_1, count_1, kind_2, goal_1, offsets, _buffer_sizes);
        found_1 = _e24;
        uint _e25 = found_1;
        uint _e27 = nearer_entry(_e25, 4u, first_1, count_1, kind_2, goal_1, offsets, _buffer_sizes);
        found_1 = _e27;
        uint _e28 = found_1;
        uint _e30 = nearer_entry(_e28, 2u, first_1, count_1, kind_2, goal_1, offsets, _buffer_sizes);
        found_1 = _e30;
        uint _e31 = found_1;
        uint _e33 = nearer_entry(_e31, 1u, first_1, count_1, kind_2, goal_1, offsets, _buffer_sizes);
        found_1 = _e33;
    }
    uint _e34 = found_1;
    return _e34;
}

uint patch_of(
    uint goal_2,
    uint kind_3,
    constant Job& job,
    device type_4 const& offsets,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint _e4 = job.patches;
    uint blocks = ((_e4 + BLOCK) - 1u) >> BLOCK_BITS;
    uint sections = ((blocks + SECTION_BLOCKS) - 1u) >> SECTION_BLOCK_BITS;
    uint _e19 = job.sections_at;
    uint _e20 = last_at_or_before(_e19, sections, kind_3, goal_2, offsets, _buffer_sizes);
    uint _e23 = job.sections_at;
    uint _e25 = offset_at(_e23 + _e20, kind_3, offsets, _buffer_sizes);
    uint in_section = goal_2 - _e25;
    uint _e29 = job.blocks_at;
    uint first_block = _e29 + (_e20 << SECTION_BLOCK_BITS);
    uint count_2 = metal::min(SECTION_BLOCKS, blocks - (_e20 << SECTION_BLOCK_BITS));
    uint _e40 = last_at_or_before(first_block, count_2, kind_3, in_section, offsets, _buffer_sizes);
    uint block = (_e20 << SECTION_BLOCK_BITS) + _e40;
    uint _e44 = job.blocks_at;
    uint _e46 = offset_at(_e44 + block, kind_3, offsets, _buffer_sizes);
    uint in_block = in_section - _e46;
    uint _e51 = job.patches;
    uint patches = metal::min(BLOCK, _e51 - (block << BLOCK_BITS));
    uint _e60 = last_at_or_before(block << BLOCK_BITS, patches, kind_3, in_block, offsets, _buffer_sizes);
    return (block << BLOCK_BITS) + _e60;
}

uint entries(
    uint begin,
    uint end_1,
    constant Job& job
) {
    uint _e3 = tile_end(end_1, job);
    uint _e4 = tile_at(begin, job);
    return (end_1 > begin) ? ((_e3 - _e4) + 1u) : 0u;
}

uint entry_of(
    uint number,
    uint begin_1,
    uint end_2,
    uint kind_4,
    constant Job& job,
    device type_4 const& offsets,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint _e4 = tile_at(begin_1, job);
    uint _e8 = job.tile_bits;
    uint element_1 = (_e4 + number) << _e8;
    uint _e13 = patch_of(metal::clamp(element_1, begin_1, end_2 - 1u), kind_4, job, offsets, _buffer_sizes);
    return _e13;
}

void write_entry(
    uint number_1,
    Range range,
    constant Job& job,
    device type_4 const& offsets,
    device type_5& tiles,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint _e4 = entries(range.points_begin, range.points_end, job);
    uint _e7 = entries(range.primitives_begin, range.primitives_end, job);
    if (number_1 < _e4) {
        uint _e14 = entry_of(number_1, range.points_begin, range.points_end, POINTS, job, offsets, _buffer_sizes);
        tiles[metal::min(unsigned(number_1), (_buffer_sizes.size2 - 0 - 4) / 4)] = _e14;
        return;
    } else {
        if ((number_1 - _e4) < _e7) {
            uint own = number_1 - _e4;
            uint _e21 = job.primitive_tiles_at;
            uint _e27 = entry_of(own, range.primitives_begin, range.primitives_end, PRIMITIVES, job, offsets, _buffer_sizes);
            tiles[metal::min(unsigned(_e21 + own), (_buffer_sizes.size2 - 0 - 4) / 4)] = _e27;
            return;
        } else {
            return;
        }
    }
}

struct partition_tilesInput {
};
kernel void partition_tiles(
  metal::uint3 workgroup [[threadgroup_position_in_grid]]
, uint thread_ [[thread_index_in_threadgroup]]
, constant Job& job [[buffer(0)]]
, device type_4 const& offsets [[buffer(1)]]
, device type_5& tiles [[buffer(3)]]
, device Status const& status [[buffer(2)]]
, constant _mslBufferSizes& _buffer_sizes [[buffer(4)]]
) {
    uint _e6 = job.max_workgroups;
    uint number_2 = ((workgroup.x + (workgroup.y * _e6)) * WORKGROUP) + thread_;
    uint _e16 = job.portion;
    Range _e18 = status.ranges[metal::min(unsigned(_e16), (_buffer_sizes.size3 - 32 - 16) / 16)];
    write_entry(number_2, _e18, job, offsets, tiles, _buffer_sizes);
    return;
}
