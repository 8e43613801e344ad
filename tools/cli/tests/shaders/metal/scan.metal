// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;

struct _mslBufferSizes {
    uint size2;
};

struct type_2 {
    metal::uint2 inner[341];
};
struct Sums {
    metal::uint2 before;
    metal::uint2 all;
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
typedef Range type_4[1];
struct Status {
    uint points;
    uint points_high;
    uint primitives;
    uint primitives_high;
    uint overflow;
    uint reserved_0_;
    uint reserved_1_;
    uint reserved_2_;
    type_4 ranges;
};
typedef metal::uint2 type_5[1];
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
constant uint FOURS = 256u;
constant uint SIXTEENS = 320u;
constant uint SIXTY_FOURS = 336u;
constant uint WHOLE = 340u;
constant uint POINTS = 0u;
constant uint PRIMITIVES = 1u;
constant uint NEVER = 4294967295u;
constant bool IS_INTEGER = false;
constant bool HAS_COPIED_POINTS = false;
constant uint POINT_WORDS = 1u;
constant uint EDGES = 4u;
constant bool IS_TRIANGLES = true;
constant uint INDICES = 3u;

void add_four(
    uint from_at,
    uint to_at,
    threadgroup type_2& sums
) {
    metal::uint2 first = sums.inner[metal::min(unsigned(from_at), 340u)];
    metal::uint2 _e9 = sums.inner[metal::min(unsigned(from_at + 1u), 340u)];
    metal::uint2 second = first + _e9;
    metal::uint2 _e15 = sums.inner[metal::min(unsigned(from_at + 2u), 340u)];
    metal::uint2 third = second + _e15;
    metal::uint2 _e23 = sums.inner[metal::min(unsigned(from_at + 3u), 340u)];
    sums.inner[metal::min(unsigned(to_at), 340u)] = third + _e23;
    sums.inner[metal::min(unsigned(from_at), 340u)] = metal::uint2(0u);
    sums.inner[metal::min(unsigned(from_at + 1u), 340u)] = first;
    sums.inner[metal::min(unsigned(from_at + 2u), 340u)] = second;
    sums.inner[metal::min(unsigned(from_at + 3u), 340u)] = third;
    return;
}

Sums prefix_sums(
    uint thread_1,
    metal::uint2 own_1,
    threadgroup type_2& sums
) {
    sums.inner[metal::min(unsigned(thread_1), 340u)] = own_1;
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    if (thread_1 < 64u) {
        add_four(4u * thread_1, FOURS + thread_1, sums);
    }
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    if (thread_1 < 16u) {
        add_four(FOURS + (4u * thread_1), SIXTEENS + thread_1, sums);
    }
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    if (thread_1 < 4u) {
        add_four(SIXTEENS + (4u * thread_1), SIXTY_FOURS + thread_1, sums);
    }
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    if (thread_1 == 0u) {
        add_four(SIXTY_FOURS, WHOLE, sums);
    }
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    metal::uint2 _e32 = sums.inner[metal::min(unsigned(thread_1), 340u)];
    metal::uint2 _e39 = sums.inner[metal::min(unsigned(FOURS + (thread_1 >> 2u)), 340u)];
    metal::uint2 _e47 = sums.inner[metal::min(unsigned(SIXTEENS + (thread_1 >> 4u)), 340u)];
    metal::uint2 _e55 = sums.inner[metal::min(unsigned(SIXTY_FOURS + (thread_1 >> 6u)), 340u)];
    metal::uint2 before = ((_e32 + _e39) + _e47) + _e55;
    metal::uint2 all = sums.inner[340];
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    return Sums {before, all};
}

uint naga_div(uint lhs, uint rhs) {
    return lhs / metal::select(rhs, 1u, rhs == 0u);
}

uint block_count(
    constant Job& job
) {
    uint _e2 = job.patches;
    return naga_div((_e2 + BLOCK) - 1u, BLOCK);
}

struct scanInput {
};
kernel void scan(
  metal::uint3 workgroup [[threadgroup_position_in_grid]]
, uint thread_ [[thread_index_in_threadgroup]]
, threadgroup type_2& sums
, constant Job& job [[buffer(0)]]
, device type_5& offsets [[buffer(1)]]
, constant _mslBufferSizes& _buffer_sizes [[buffer(2)]]
) {
    metal::uint2 own = metal::uint2(0u, 0u);
    bool local = {};
    uint _e6 = job.max_workgroups;
    uint section = workgroup.x + (workgroup.y * _e6);
    uint block = (section * SECTION_BLOCKS) + thread_;
    uint _e16 = block_count(job);
    if (block < _e16) {
        uint _e21 = job.blocks_at;
        metal::uint2 _e24 = offsets[metal::min(unsigned(_e21 + block), (_buffer_sizes.size2 - 0 - 8) / 8)];
        own = _e24;
    }
    metal::uint2 _e25 = own;
    Sums _e26 = prefix_sums(thread_, _e25, sums);
    uint _e27 = block_count(job);
    if (block < _e27) {
        uint _e32 = job.blocks_at;
        offsets[metal::min(unsigned(_e32 + block), (_buffer_sizes.size2 - 0 - 8) / 8)] = _e26.before;
    }
    if (thread_ == 0u) {
        uint _e40 = block_count(job);
        local = block < _e40;
    } else {
        local = false;
    }
    bool _e43 = local;
    if (_e43) {
        uint _e47 = job.sections_at;
        offsets[metal::min(unsigned(_e47 + section), (_buffer_sizes.size2 - 0 - 8) / 8)] = _e26.all;
        return;
    } else {
        return;
    }
}
