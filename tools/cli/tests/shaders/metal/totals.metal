// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;

struct _mslBufferSizes {
    uint size1;
    uint size2;
    uint size4;
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
typedef uint type_3[1];
struct type_5 {
    metal::uint2 inner[341];
};
struct Sums {
    metal::uint2 before;
    metal::uint2 all;
};
typedef metal::uint2 type_6[1];
struct type_8 {
    metal::atomic_uint inner[2];
};
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
constant uint FOURS = 256u;
constant uint SIXTEENS = 320u;
constant uint SIXTY_FOURS = 336u;
constant uint WHOLE = 340u;

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

uint naga_div(uint lhs, uint rhs) {
    return lhs / metal::select(rhs, 1u, rhs == 0u);
}

void write_dispatch(
    uint number,
    uint workgroups,
    constant Job& job,
    device type_3& arguments,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint _e4 = job.max_workgroups;
    uint _e10 = job.max_workgroups;
    uint rows = naga_div((workgroups + _e4) - 1u, _e10);
    uint at = DISPATCHES_AT + (3u * number);
    uint _e20 = job.max_workgroups;
    arguments[metal::min(unsigned(at), (_buffer_sizes.size1 - 0 - 4) / 4)] = (rows <= 1u) ? workgroups : _e20;
    arguments[metal::min(unsigned(at + 1u), (_buffer_sizes.size1 - 0 - 4) / 4)] = metal::max(rows, 1u);
    arguments[metal::min(unsigned(at + 2u), (_buffer_sizes.size1 - 0 - 4) / 4)] = 1u;
    return;
}

uint tiles_between(
    uint begin_1,
    uint end_1,
    constant Job& job
) {
    uint _e3 = tile_end(end_1, job);
    uint _e4 = tile_at(begin_1, job);
    return (end_1 > begin_1) ? (_e3 - _e4) : 0u;
}

uint tiles_in_window(
    uint begin_2,
    uint end_2,
    uint window,
    uint window_tiles,
    constant Job& job
) {
    bool local = {};
    uint _e4 = tile_at(begin_2, job);
    uint first = metal::max(_e4, window * window_tiles);
    uint _e7 = tile_end(end_2, job);
    uint last = metal::min(_e7, (window + 1u) * window_tiles);
    if (last > first) {
        local = end_2 > begin_2;
    } else {
        local = false;
    }
    bool _e19 = local;
    return _e19 ? (last - first) : 0u;
}

uint slots(
    constant Job& job
) {
    uint _e3 = job.point_windows;
    uint _e7 = job.primitive_windows;
    return (1u + _e3) + _e7;
}

uint workgroups_of(
    uint slot,
    Range range,
    uint is_overflow,
    constant Job& job
) {
    if (is_overflow != 0u) {
        return 0u;
    }
    if (slot == 0u) {
        uint _e10 = tiles_between(range.points_begin, range.points_end, job);
        uint _e13 = tiles_between(range.primitives_begin, range.primitives_end, job);
        uint count = _e10 + _e13;
        return naga_div(((count + 2u) + WORKGROUP) - 1u, WORKGROUP);
    }
    uint _e25 = job.point_windows;
    if (slot <= _e25) {
        uint _e33 = job.point_window_tiles;
        uint _e34 = tiles_in_window(range.points_begin, range.points_end, slot - 1u, _e33, job);
        return _e34;
    }
    uint _e41 = job.point_windows;
    uint _e45 = job.primitive_window_tiles;
    uint _e46 = tiles_in_window(range.primitives_begin, range.primitives_end, (slot - 1u) - _e41, _e45, job);
    return _e46;
}

uint overflow(
    metal::uint2 low,
    metal::uint2 high_1,
    constant Job& job
) {
    bool local_1 = {};
    bool local_2 = {};
    if (!((high_1.x != 0u))) {
        uint _e11 = job.point_capacity;
        local_1 = low.x > _e11;
    } else {
        local_1 = true;
    }
    bool points = local_1;
    if (!((high_1.y != 0u))) {
        uint _e24 = job.primitive_capacity;
        local_2 = low.y > _e24;
    } else {
        local_2 = true;
    }
    bool primitives_1 = local_2;
    return (points ? 1u : 0u) | (primitives_1 ? 2u : 0u);
}

void write_draw(
    uint primitives,
    uint is_overflow_1,
    device type_3& arguments,
    device Status& status,
    constant _mslBufferSizes& _buffer_sizes
) {
    status.overflow = is_overflow_1;
    arguments[metal::min(unsigned(0), (_buffer_sizes.size1 - 0 - 4) / 4)] = (is_overflow_1 != 0u) ? 0u : (primitives * INDICES);
    arguments[metal::min(unsigned(1), (_buffer_sizes.size1 - 0 - 4) / 4)] = 1u;
    arguments[metal::min(unsigned(2), (_buffer_sizes.size1 - 0 - 4) / 4)] = 0u;
    arguments[metal::min(unsigned(3), (_buffer_sizes.size1 - 0 - 4) / 4)] = 0u;
    arguments[metal::min(unsigned(4), (_buffer_sizes.size1 - 0 - 4) / 4)] = 0u;
    return;
}

uint naga_mod(uint lhs, uint rhs) {
    return lhs % metal::select(rhs, 1u, rhs == 0u);
}

void finish(
    uint thread_1,
    constant Job& job,
    device type_3& arguments,
    device Status& status,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint slot_1 = {};
    uint _e3 = status.points;
    uint _e6 = status.primitives;
    uint _e10 = status.points_high;
    uint _e13 = status.primitives_high;
    uint _e15 = overflow(metal::uint2(_e3, _e6), metal::uint2(_e10, _e13), job);
    slot_1 = thread_1;
    uint2 loop_bound = uint2(4294967295u);
    bool loop_init = true;
    while(true) {
        if (metal::all(loop_bound == uint2(0u))) { break; }
        loop_bound -= uint2(loop_bound.y == 0u, 1u);
        if (!loop_init) {
            uint _e36 = slot_1;
            slot_1 = _e36 + SUMMED;
        }
        loop_init = false;
        uint _e17 = slot_1;
        uint _e20 = job.portions;
        uint _e21 = slots(job);
        if (_e17 < (_e20 * _e21)) {
        } else {
            break;
        }
        {
            uint _e26 = slot_1;
            uint _e27 = slots(job);
            Range range_1 = status.ranges[metal::min(unsigned(naga_div(_e26, _e27)), (_buffer_sizes.size2 - 32 - 16) / 16)];
            uint _e31 = slot_1;
            uint _e32 = slot_1;
            uint _e33 = slots(job);
            uint _e35 = workgroups_of(naga_mod(_e32, _e33), range_1, _e15, job);
            write_dispatch(_e31, _e35, job, arguments, _buffer_sizes);
        }
    }
    if (thread_1 == 0u) {
        uint _e43 = status.primitives;
        write_draw(_e43, _e15, arguments, status, _buffer_sizes);
        return;
    } else {
        return;
    }
}

void add_four(
    uint from_at,
    uint to_at,
    threadgroup type_5& sums
) {
    metal::uint2 first_1 = sums.inner[metal::min(unsigned(from_at), 340u)];
    metal::uint2 _e9 = sums.inner[metal::min(unsigned(from_at + 1u), 340u)];
    metal::uint2 second = first_1 + _e9;
    metal::uint2 _e15 = sums.inner[metal::min(unsigned(from_at + 2u), 340u)];
    metal::uint2 third = second + _e15;
    metal::uint2 _e23 = sums.inner[metal::min(unsigned(from_at + 3u), 340u)];
    sums.inner[metal::min(unsigned(to_at), 340u)] = third + _e23;
    sums.inner[metal::min(unsigned(from_at), 340u)] = metal::uint2(0u);
    sums.inner[metal::min(unsigned(from_at + 1u), 340u)] = first_1;
    sums.inner[metal::min(unsigned(from_at + 2u), 340u)] = second;
    sums.inner[metal::min(unsigned(from_at + 3u), 340u)] = third;
    return;
}

Sums prefix_sums(
    uint thread_2,
    metal::uint2 own_1,
    threadgroup type_5& sums
) {
    sums.inner[metal::min(unsigned(thread_2), 340u)] = own_1;
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    if (thread_2 < 64u) {
        add_four(4u * thread_2, FOURS + thread_2, sums);
    }
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    if (thread_2 < 16u) {
        add_four(FOURS + (4u * thread_2), SIXTEENS + thread_2, sums);
    }
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    if (thread_2 < 4u) {
        add_four(SIXTEENS + (4u * thread_2), SIXTY_FOURS + thread_2, sums);
    }
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    if (thread_2 == 0u) {
        add_four(SIXTY_FOURS, WHOLE, sums);
    }
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    metal::uint2 _e32 = sums.inner[metal::min(unsigned(thread_2), 340u)];
    metal::uint2 _e39 = sums.inner[metal::min(unsigned(FOURS + (thread_2 >> 2u)), 340u)];
    metal::uint2 _e47 = sums.inner[metal::min(unsigned(SIXTEENS + (thread_2 >> 4u)), 340u)];
    metal::uint2 _e55 = sums.inner[metal::min(unsigned(SIXTY_FOURS + (thread_2 >> 6u)), 340u)];
    metal::uint2 before = ((_e32 + _e39) + _e47) + _e55;
    metal::uint2 all = sums.inner[340];
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    return Sums {before, all};
}

struct totalsInput {
};
kernel void totals(
  uint thread_ [[thread_index_in_threadgroup]]
, constant Job& job [[buffer(0)]]
, device type_3& arguments [[buffer(3)]]
, device Status& status [[buffer(2)]]
, threadgroup type_5& sums
, device type_6& offsets [[buffer(1)]]
, threadgroup type_8& carries
, constant _mslBufferSizes& _buffer_sizes [[buffer(4)]]
) {
    metal::uint2 own = metal::uint2(0u, 0u);
    metal::uint2 begin = metal::uint2(0u, 0u);
    metal::uint2 high = metal::uint2(0u, 0u);
    uint _e3 = job.patches;
    uint sections = naga_div((_e3 + SECTION) - 1u, SECTION);
    if (thread_ < sections) {
        uint _e18 = job.sections_at;
        metal::uint2 _e21 = offsets[metal::min(unsigned(_e18 + thread_), (_buffer_sizes.size4 - 0 - 8) / 8)];
        own = _e21;
    }
    if (thread_ < 2u) {
        metal::atomic_store_explicit(&carries.inner[metal::min(unsigned(thread_), 1u)], 0u, metal::memory_order_relaxed);
    }
    metal::uint2 _e27 = own;
    Sums _e28 = prefix_sums(thread_, _e27, sums);
    uint _e39 = job.portion;
    if (_e39 > 0u) {
        uint _e44 = status.points;
        uint _e47 = status.primitives;
        begin = metal::uint2(_e44, _e47);
        uint _e51 = status.points_high;
        uint _e54 = status.primitives_high;
        high = metal::uint2(_e51, _e54);
    }
    metal::uint2 _e56 = begin;
    metal::uint2 own_begin = _e56 + _e28.before;
    metal::uint2 _e59 = own;
    metal::uint2 carry = static_cast<metal::uint2>((own_begin + _e59) < own_begin);
    uint _e66 = metal::atomic_fetch_add_explicit(&carries.inner[0], carry.x, metal::memory_order_relaxed);
    uint _e70 = metal::atomic_fetch_add_explicit(&carries.inner[1], carry.y, metal::memory_order_relaxed);
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    metal::threadgroup_barrier(metal::mem_flags::mem_device);
    if (thread_ < sections) {
        uint _e75 = job.sections_at;
        offsets[metal::min(unsigned(_e75 + thread_), (_buffer_sizes.size4 - 0 - 8) / 8)] = own_begin;
    }
    if (thread_ == 0u) {
        metal::uint2 _e80 = begin;
        metal::uint2 end_3 = _e80 + _e28.all;
        uint _e87 = job.portion;
        uint _e90 = begin.x;
        uint _e93 = begin.y;
        status.ranges[metal::min(unsigned(_e87), (_buffer_sizes.size2 - 32 - 16) / 16)] = Range {_e90, end_3.x, _e93, end_3.y};
        status.points = end_3.x;
        uint _e102 = high.x;
        uint _e105 = metal::atomic_load_explicit(&carries.inner[0], metal::memory_order_relaxed);
        status.points_high = _e102 + _e105;
        status.primitives = end_3.y;
        uint _e113 = high.y;
        uint _e116 = metal::atomic_load_explicit(&carries.inner[1], metal::memory_order_relaxed);
        status.primitives_high = _e113 + _e116;
    }
    metal::threadgroup_barrier(metal::mem_flags::mem_device);
    uint _e120 = job.portion;
    uint _e125 = job.portions;
    if ((_e120 + 1u) >= _e125) {
        finish(thread_, job, arguments, status, _buffer_sizes);
        return;
    } else {
        return;
    }
}
