// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;

struct _mslBufferSizes {
    uint size1;
    uint size2;
    uint size4;
    uint size5;
    uint size8;
    uint size9;
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
typedef metal::atomic_uint type_5[1];
struct _atomic_compare_exchange_result_Uint_4_ {
    uint old_value;
    bool exchanged;
    char _pad2[3];
};
typedef uint type_6[1];
struct type_7 {
    metal::uint2 inner[341];
};
struct Sums {
    metal::uint2 before;
    metal::uint2 all;
};
struct Processed {
    metal::uint4 outer;
    metal::uint4 outer_odd;
    metal::uint2 inside;
    metal::uint2 inside_odd;
    metal::uint2 topology;
    char _pad5[8];
};
typedef metal::uint2 type_9[1];
struct BlockSums {
    metal::uint2 own;
    metal::uint2 before;
    metal::uint2 all;
};

template <typename A>
_atomic_compare_exchange_result_Uint_4_ naga_atomic_compare_exchange_weak_explicit(
    device A *atomic_ptr,
    uint cmp,
    uint v
) {
    bool swapped = metal::atomic_compare_exchange_weak_explicit(
        atomic_ptr, &cmp, v,
        metal::memory_order_relaxed, metal::memory_order_relaxed
    );
    return _atomic_compare_exchange_result_Uint_4_{cmp, swapped};
}
template <typename A>
_atomic_compare_exchange_result_Uint_4_ naga_atomic_compare_exchange_weak_explicit(
    threadgroup A *atomic_ptr,
    uint cmp,
    uint v
) {
    bool swapped = metal::atomic_compare_exchange_weak_explicit(
        atomic_ptr, &cmp, v,
        metal::memory_order_relaxed, metal::memory_order_relaxed
    );
    return _atomic_compare_exchange_result_Uint_4_{cmp, swapped};
}
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
constant uint CULLED = 0u;
constant uint MINIMUM = 1u;
constant uint REGULAR = 2u;
constant uint ONE = 65536u;
constant uint HALF = 32768u;
constant uint ONE_THIRD = 21845u;
constant uint TWO_THIRDS = 43690u;
constant uint FOURS = 256u;
constant uint SIXTEENS = 320u;
constant uint SIXTY_FOURS = 336u;
constant uint WHOLE = 340u;
constant uint INFINITY_ = 2139095040u;
constant uint BITS_1_ = 1065353216u;
constant uint BITS_2_ = 1073741824u;
constant uint BITS_63_ = 1115422720u;
constant uint BITS_64_ = 1115684864u;
constant uint BITS_1_PLUS_2_POW_MINUS_17_ = 1065353280u;
constant uint BITS_1_PLUS_2_POW_MINUS_16_ = 1065353344u;
constant uint LOW = 1065353216u;
constant uint HIGH = 1115422720u;

uint state_of(
    metal::uint2 topology
) {
    return topology.x >> 28u;
}

uint outer_points(
    metal::uint2 topology_1,
    uint edge
) {
    return (topology_1.x >> (7u * edge)) & 127u;
}

uint inside_u(
    metal::uint2 topology_2
) {
    return topology_2.y & 127u;
}

uint inside_v(
    metal::uint2 topology_3
) {
    return (topology_3.y >> 7u) & 127u;
}

uint listed_slot(
    metal::uint2 topology_4
) {
    return topology_4.y >> 14u;
}

uint along_points(
    metal::uint2 topology_5,
    uint edge_1
) {
    return (topology_5.y >> (7u * (1u - (edge_1 & 1u)))) & 127u;
}

uint outer_before(
    metal::uint2 topology_6,
    uint edge_2
) {
    uint _e4 = outer_points(topology_6, 0u);
    uint _e10 = outer_points(topology_6, 1u);
    uint _e17 = outer_points(topology_6, 2u);
    return (((edge_2 > 0u) ? _e4 : 0u) + ((edge_2 > 1u) ? _e10 : 0u)) + ((edge_2 > 2u) ? _e17 : 0u);
}

uint along_before(
    metal::uint2 topology_7,
    uint edge_3
) {
    uint _e6 = inside_v(topology_7);
    uint _e10 = inside_u(topology_7);
    return (((edge_3 + 1u) >> 1u) * _e6) + ((edge_3 >> 1u) * _e10);
}

uint boundary(
    metal::uint2 topology_8
) {
    uint _e2 = outer_before(topology_8, 3u);
    uint _e4 = outer_points(topology_8, 3u);
    return (_e2 + _e4) - EDGES;
}

uint interior_points(
    metal::uint2 topology_9
) {
    uint _e1 = inside_u(topology_9);
    if (true) {
        uint _e5 = inside_v(topology_9);
        return (_e1 - 2u) * (_e5 - 2u);
    }
    uint half_ = _e1 >> 1u;
    return ((_e1 & 1u) == 1u) ? (((3u * half_) * (half_ - 1u)) + 1u) : ((3u * (half_ - 1u)) * (half_ - 1u));
}

uint triangles_of(
    uint points,
    metal::uint2 topology_10
) {
    uint _e6 = boundary(topology_10);
    return ((2u * points) - 2u) - _e6;
}

metal::uint2 counts(
    metal::uint2 topology_11
) {
    uint points_1 = EDGES;
    uint triangles = 2u;
    uint _e1 = state_of(topology_11);
    if (_e1 == CULLED) {
        return metal::uint2(0u, 0u);
    }
    if (false) {
        uint _e9 = outer_points(topology_11, 0u);
        uint lines = _e9 - 1u;
        uint _e13 = outer_points(topology_11, 1u);
        return lines * metal::uint2(_e13, _e13 - 1u);
    }
    uint _e22 = state_of(topology_11);
    if (_e22 == REGULAR) {
        uint _e25 = boundary(topology_11);
        uint _e26 = interior_points(topology_11);
        points_1 = _e25 + _e26;
        uint _e28 = points_1;
        uint _e29 = triangles_of(_e28, topology_11);
        triangles = _e29;
    }
    if (false) {
        uint _e31 = points_1;
        uint _e32 = points_1;
        return metal::uint2(_e31, _e32);
    }
    uint _e34 = points_1;
    uint _e35 = triangles;
    uint _e36 = points_1;
    return metal::uint2(_e34, false ? (_e36 - 1u) : _e35);
}

uint key_of(
    metal::uint2 topology_12
) {
    uint key = {};
    uint edge_4 = 0u;
    uint _e1 = inside_u(topology_12);
    uint _e6 = inside_v(topology_12);
    key = ((_e1 - 2u) << 20u) | ((_e6 - 2u) << 25u);
    uint2 loop_bound = uint2(4294967295u);
    bool loop_init = true;
    while(true) {
        if (metal::all(loop_bound == uint2(0u))) { break; }
        loop_bound -= uint2(loop_bound.y == 0u, 1u);
        if (!loop_init) {
            uint _e29 = edge_4;
            edge_4 = _e29 + 1u;
        }
        loop_init = false;
        uint _e15 = edge_4;
        if (_e15 < EDGES) {
        } else {
            break;
        }
        {
            uint _e18 = key;
            uint _e19 = edge_4;
            uint _e20 = outer_points(topology_12, _e19);
            uint _e24 = edge_4;
            key = _e18 | ((_e20 - 2u) << (5u * _e24));
        }
    }
    uint _e31 = key;
    uint _e32 = state_of(topology_12);
    return _e31 | (_e32 << 30u);
}

bool has_key(
    metal::uint2 topology_13
) {
    uint most = {};
    uint edge_5 = 0u;
    bool local_2 = {};
    uint _e1 = inside_u(topology_13);
    uint _e2 = inside_v(topology_13);
    most = metal::max(_e1, _e2);
    uint2 loop_bound_1 = uint2(4294967295u);
    bool loop_init_1 = true;
    while(true) {
        if (metal::all(loop_bound_1 == uint2(0u))) { break; }
        loop_bound_1 -= uint2(loop_bound_1.y == 0u, 1u);
        if (!loop_init_1) {
            uint _e15 = edge_5;
            edge_5 = _e15 + 1u;
        }
        loop_init_1 = false;
        uint _e7 = edge_5;
        if (_e7 < EDGES) {
        } else {
            break;
        }
        {
            uint _e10 = most;
            uint _e11 = edge_5;
            uint _e12 = outer_points(topology_13, _e11);
            most = metal::max(_e10, _e12);
        }
    }
    uint _e17 = state_of(topology_13);
    if (_e17 != CULLED) {
        uint _e22 = most;
        local_2 = _e22 <= 33u;
    } else {
        local_2 = false;
    }
    bool _e26 = local_2;
    return _e26;
}

metal::uint2 topology_of(
    uint key_1
) {
    uint outer = 0u;
    uint edge_6 = 0u;
    uint2 loop_bound_2 = uint2(4294967295u);
    bool loop_init_2 = true;
    while(true) {
        if (metal::all(loop_bound_2 == uint2(0u))) { break; }
        loop_bound_2 -= uint2(loop_bound_2.y == 0u, 1u);
        if (!loop_init_2) {
            uint _e23 = edge_6;
            edge_6 = _e23 + 1u;
        }
        loop_init_2 = false;
        uint _e5 = edge_6;
        if (_e5 < EDGES) {
        } else {
            break;
        }
        {
            uint _e8 = outer;
            uint _e10 = edge_6;
            uint _e18 = edge_6;
            outer = _e8 | ((((key_1 >> (5u * _e10)) & 31u) + 2u) << (7u * _e18));
        }
    }
    uint u = ((key_1 >> 20u) & 31u) + 2u;
    uint v = ((key_1 >> 25u) & 31u) + 2u;
    uint _e37 = outer;
    return metal::uint2(_e37 | ((key_1 >> 30u) << 28u), u | (v << 7u));
}

uint naga_mod(uint lhs, uint rhs) {
    return lhs % metal::select(rhs, 1u, rhs == 0u);
}

uint slot_of(
    metal::uint2 topology_14,
    metal::uint2 size,
    constant Job& job,
    device type_5& catalogue,
    constant _mslBufferSizes& _buffer_sizes
) {
    bool local_3 = {};
    bool local_4 = {};
    bool local_5 = {};
    uint at = {};
    uint probe = 0u;
    bool local_6 = {};
    uint _e4 = job.has_catalogue;
    if (!((_e4 == 0u))) {
        bool _e10 = has_key(topology_14);
        local_3 = !(_e10);
    } else {
        local_3 = true;
    }
    bool _e13 = local_3;
    if (!(_e13)) {
        local_4 = size.x > LISTED_POINTS;
    } else {
        local_4 = true;
    }
    bool _e21 = local_4;
    if (!(_e21)) {
        local_5 = size.y > LISTED_PRIMITIVES;
    } else {
        local_5 = true;
    }
    bool _e29 = local_5;
    if (_e29) {
        return 0u;
    }
    uint _e31 = key_of(topology_14);
    at = (_e31 * 2654435769u) >> 19u;
    uint2 loop_bound_3 = uint2(4294967295u);
    bool loop_init_3 = true;
    while(true) {
        if (metal::all(loop_bound_3 == uint2(0u))) { break; }
        loop_bound_3 -= uint2(loop_bound_3.y == 0u, 1u);
        if (!loop_init_3) {
            uint _e74 = probe;
            probe = _e74 + 1u;
        }
        loop_init_3 = false;
        uint _e39 = probe;
        if (_e39 < 16u) {
        } else {
            break;
        }
        {
            uint _e43 = at;
            uint found = metal::atomic_load_explicit(&catalogue[metal::min(unsigned(_e43), (_buffer_sizes.size1 - 0 - 4) / 4)], metal::memory_order_relaxed);
            if (found == _e31) {
                uint _e47 = at;
                return _e47 + 1u;
            }
            if (found == 0u) {
                uint _e53 = at;
                _atomic_compare_exchange_result_Uint_4_ _e56 = naga_atomic_compare_exchange_weak_explicit(&catalogue[metal::min(unsigned(_e53), (_buffer_sizes.size1 - 0 - 4) / 4)], 0u, _e31);
                if (!(_e56.exchanged)) {
                    local_6 = _e56.old_value == _e31;
                } else {
                    local_6 = true;
                }
                bool _e64 = local_6;
                if (_e64) {
                    uint _e65 = at;
                    return _e65 + 1u;
                }
            }
            uint _e68 = at;
            at = naga_mod(_e68 + 1u, SLOTS);
        }
    }
    return 0u;
}

void empty_catalogue(
    device type_5& catalogue,
    constant _mslBufferSizes& _buffer_sizes
) {
    metal::atomic_store_explicit(&catalogue[metal::min(unsigned(8192), (_buffer_sizes.size1 - 0 - 4) / 4)], 0u, metal::memory_order_relaxed);
    metal::atomic_store_explicit(&catalogue[metal::min(unsigned(8193), (_buffer_sizes.size1 - 0 - 4) / 4)], 0u, metal::memory_order_relaxed);
    return;
}

uint fixed_from_bits(
    uint bits
) {
    bool local_7 = {};
    bool local_8 = {};
    uint shift = 134u - (bits >> 23u);
    uint mantissa = (bits & 8388607u) | 8388608u;
    uint quotient = mantissa >> shift;
    uint remainder = mantissa & ((1u << shift) - 1u);
    uint half_1 = 1u << (shift - 1u);
    if (!((remainder > half_1))) {
        if (remainder == half_1) {
            local_8 = (quotient & 1u) == 1u;
        } else {
            local_8 = false;
        }
        bool _e31 = local_8;
        local_7 = _e31;
    } else {
        local_7 = true;
    }
    bool up = local_7;
    return quotient + (up ? 1u : 0u);
}

uint float_bits_from_coordinate(
    uint coordinate
) {
    if (coordinate == 0u) {
        return 0u;
    }
    uint top = metal::select(31 - metal::clz(coordinate), uint(-1), coordinate == 0);
    uint mantissa_1 = (coordinate << (23u - top)) & 8388607u;
    return ((top + 111u) << 23u) | mantissa_1;
}

uint reciprocal(
    uint n,
    device type_6 const& tables,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint _e7 = tables[metal::min(unsigned((RECIPROCALS_AT + n) - 1u), (_buffer_sizes.size2 - 0 - 4) / 4)];
    return _e7;
}

uint half_factor(
    uint factor,
    uint odd
) {
    bool local_9 = {};
    uint rounded = (factor + 1u) >> 1u;
    if (!((odd == 1u))) {
        local_9 = rounded == HALF;
    } else {
        local_9 = true;
    }
    bool _e16 = local_9;
    return rounded + (_e16 ? HALF : 0u);
}

uint edge_points(
    uint factor_1,
    uint odd_1
) {
    bool local_10 = {};
    if (IS_INTEGER) {
        if (factor_1 == ONE) {
            local_10 = odd_1 == 0u;
        } else {
            local_10 = false;
        }
        bool _e15 = local_10;
        return _e15 ? 3u : ((factor_1 >> 16u) + 1u);
    }
    uint _e17 = half_factor(factor_1, odd_1);
    uint half_points = (_e17 + 65535u) >> 16u;
    return ((2u * half_points) + 1u) - odd_1;
}

uint drop_most_significant_bit(
    uint x
) {
    return x ^ (1u << metal::select(31 - metal::clz(x), uint(-1), x == 0));
}

uint split_position(
    uint floor_points,
    uint ceil_points,
    uint odd_2
) {
    bool local_11 = {};
    if (floor_points == ceil_points) {
        return ceil_points + 1u;
    }
    if (false) {
        return (ceil_points - 1u) - odd_2;
    }
    if (odd_2 == 1u) {
        local_11 = floor_points == 1u;
    } else {
        local_11 = false;
    }
    bool _e17 = local_11;
    if (_e17) {
        return 0u;
    }
    uint _e21 = drop_most_significant_bit(floor_points - odd_2);
    return (2u * _e21) + 1u;
}

metal::uint2 make_context(
    uint factor_2,
    uint odd_3,
    device type_6 const& tables,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint _e2 = half_factor(factor_2, odd_3);
    uint floor_points_1 = _e2 >> 16u;
    uint ceil_points_1 = (_e2 + 65535u) >> 16u;
    uint _e12 = reciprocal((2u * ceil_points_1) - odd_3, tables, _buffer_sizes);
    uint _e16 = reciprocal((2u * floor_points_1) - odd_3, tables, _buffer_sizes);
    uint _e20 = split_position(floor_points_1, ceil_points_1, odd_3);
    return metal::uint2((((_e16 | (ceil_points_1 << 17u)) | (_e20 << 23u)) | (odd_3 << 29u)) | ((_e12 >> 16u) << 30u), (_e12 & 65535u) | ((_e2 & 65535u) << 16u));
}

void add_four(
    uint from_at,
    uint to_at,
    threadgroup type_7& sums
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
    metal::uint2 own,
    threadgroup type_7& sums
) {
    sums.inner[metal::min(unsigned(thread_1), 340u)] = own;
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

bool is_greater_than_zero(
    uint bits_1
) {
    return (bits_1 - 1u) < INFINITY_;
}

bool is_greater(
    uint bits_2,
    uint low
) {
    bool local_12 = {};
    if (bits_2 > low) {
        local_12 = bits_2 <= INFINITY_;
    } else {
        local_12 = false;
    }
    bool _e8 = local_12;
    return _e8;
}

uint clamp_factor(
    uint bits_3,
    uint low_1,
    uint high
) {
    return (bits_3 > INFINITY_) ? low_1 : metal::clamp(bits_3, low_1, high);
}

uint ceil_factor(
    uint bits_4
) {
    uint shift_1 = 150u - (bits_4 >> 23u);
    uint mantissa_2 = (bits_4 & 8388607u) | 8388608u;
    return ((mantissa_2 + (1u << shift_1)) - 1u) >> shift_1;
}

uint fixed_factor(
    uint bits_5,
    uint low_2,
    uint high_1,
    bool rounds
) {
    uint _e4 = clamp_factor(bits_5, low_2, high_1);
    if (rounds) {
        uint _e5 = ceil_factor(_e4);
        return _e5 << 16u;
    }
    uint _e8 = fixed_from_bits(_e4);
    return _e8;
}

uint edge_parity(
    uint factor_3,
    bool rounds_1
) {
    return rounds_1 ? ((factor_3 >> 16u) & 1u) : 1u;
}

uint inside_parity(
    uint factor_4
) {
    bool local_13 = {};
    uint _e2 = edge_parity(factor_4, IS_INTEGER);
    if (IS_INTEGER) {
        local_13 = factor_4 == ONE;
    } else {
        local_13 = false;
    }
    bool _e10 = local_13;
    return _e10 ? 0u : _e2;
}

metal::uint2 process_edge(
    uint bits_6
) {
    uint _e4 = fixed_factor(bits_6, LOW, HIGH, IS_INTEGER);
    uint _e6 = edge_parity(_e4, IS_INTEGER);
    return metal::uint2(_e4, _e6);
}

metal::uint2 process_inside(
    uint bits_7,
    uint low_3
) {
    uint _e4 = fixed_factor(bits_7, low_3, HIGH, IS_INTEGER);
    uint _e5 = inside_parity(_e4);
    return metal::uint2(_e4, _e5);
}

uint inside_low(
    bool any_above
) {
    bool local_14 = {};
    if (true) {
        local_14 = any_above;
    } else {
        local_14 = false;
    }
    bool _e7 = local_14;
    return _e7 ? BITS_1_PLUS_2_POW_MINUS_16_ : LOW;
}

bool is_above(
    uint bits_8
) {
    bool _e2 = is_greater(bits_8, BITS_1_PLUS_2_POW_MINUS_17_);
    return _e2;
}

Processed process_isoline(
    metal::uint2 raw
) {
    Processed out = {};
    bool local_15 = {};
    uint _e6 = fixed_factor(raw.x, BITS_1_, BITS_64_, true);
    uint _e8 = edge_parity(_e6, true);
    metal::uint2 _e10 = process_edge(raw.y);
    out.outer = metal::uint4(_e6, _e10.x, 0u, 0u);
    out.outer_odd = metal::uint4(_e8, _e10.y, 0u, 0u);
    bool _e22 = is_greater_than_zero(raw.x);
    if (_e22) {
        bool _e26 = is_greater_than_zero(raw.y);
        local_15 = _e26;
    } else {
        local_15 = false;
    }
    bool _e28 = local_15;
    bool is_culled_1 = !(_e28);
    uint _e30 = edge_points(_e6, _e8);
    uint _e33 = edge_points(_e10.x, _e10.y);
    uint points_2 = _e30 | (_e33 << 7u);
    out.topology = metal::uint2(points_2 | ((is_culled_1 ? CULLED : REGULAR) << 28u), 0u);
    Processed _e46 = out;
    return _e46;
}

metal::uint2 make_topology(
    Processed processed,
    bool is_culled,
    bool is_minimum
) {
    uint outer_1 = {};
    metal::uint4 f = processed.outer;
    metal::uint4 odd_4 = processed.outer_odd;
    uint _e7 = edge_points(processed.outer.x, processed.outer_odd.x);
    uint _e10 = edge_points(processed.outer.y, processed.outer_odd.y);
    uint _e16 = edge_points(processed.outer.z, processed.outer_odd.z);
    outer_1 = (_e7 | (_e10 << 7u)) | (_e16 << 14u);
    if (true) {
        uint _e22 = outer_1;
        uint _e25 = edge_points(processed.outer.w, processed.outer_odd.w);
        outer_1 = _e22 | (_e25 << 21u);
    }
    uint _e33 = edge_points(processed.inside.x, processed.inside_odd.x);
    uint _e38 = edge_points(processed.inside.y, processed.inside_odd.y);
    uint state = is_culled ? CULLED : (is_minimum ? MINIMUM : REGULAR);
    uint _e44 = outer_1;
    return metal::uint2(_e44 | (state << 28u), _e33 | (_e38 << 7u));
}

Processed process_triangle(
    metal::uint4 raw_1
) {
    Processed out_1 = {};
    bool local_16 = {};
    bool local_17 = {};
    bool local_18 = {};
    bool local_19 = {};
    bool local_20 = {};
    bool local_21 = {};
    bool local_22 = {};
    bool local_23 = {};
    metal::uint2 _e3 = process_edge(raw_1.x);
    metal::uint2 _e5 = process_edge(raw_1.y);
    metal::uint2 _e7 = process_edge(raw_1.z);
    bool _e9 = is_above(raw_1.x);
    if (!(_e9)) {
        bool _e14 = is_above(raw_1.y);
        local_16 = _e14;
    } else {
        local_16 = true;
    }
    bool _e16 = local_16;
    if (!(_e16)) {
        bool _e21 = is_above(raw_1.z);
        local_17 = _e21;
    } else {
        local_17 = true;
    }
    bool _e23 = local_17;
    if (!(_e23)) {
        bool _e28 = is_above(raw_1.w);
        local_18 = _e28;
    } else {
        local_18 = true;
    }
    bool any_above_1 = local_18;
    uint _e32 = inside_low(any_above_1);
    metal::uint2 _e33 = process_inside(raw_1.w, _e32);
    out_1.outer = metal::uint4(_e3.x, _e5.x, _e7.x, 0u);
    out_1.outer_odd = metal::uint4(_e3.y, _e5.y, _e7.y, 0u);
    out_1.inside = metal::uint2(_e33.x, _e33.x);
    out_1.inside_odd = metal::uint2(_e33.y, _e33.y);
    bool _e55 = is_greater_than_zero(raw_1.x);
    if (_e55) {
        bool _e59 = is_greater_than_zero(raw_1.y);
        local_19 = _e59;
    } else {
        local_19 = false;
    }
    bool _e61 = local_19;
    if (_e61) {
        bool _e65 = is_greater_than_zero(raw_1.z);
        local_20 = _e65;
    } else {
        local_20 = false;
    }
    bool _e67 = local_20;
    bool is_culled_2 = !(_e67);
    if (_e3.x == ONE) {
        local_21 = _e5.x == ONE;
    } else {
        local_21 = false;
    }
    bool _e78 = local_21;
    if (_e78) {
        local_22 = _e7.x == ONE;
    } else {
        local_22 = false;
    }
    bool _e85 = local_22;
    if (_e85) {
        local_23 = _e33.x == ONE;
    } else {
        local_23 = false;
    }
    bool is_minimum_1 = local_23;
    Processed _e94 = out_1;
    metal::uint2 _e95 = make_topology(_e94, is_culled_2, is_minimum_1);
    out_1.topology = _e95;
    Processed _e96 = out_1;
    return _e96;
}

Processed process_quad(
    metal::uint4 raw_2,
    metal::uint2 raw_inside
) {
    Processed out_2 = {};
    bool local_24 = {};
    bool local_25 = {};
    bool local_26 = {};
    bool local_27 = {};
    bool local_28 = {};
    bool local_29 = {};
    bool local_30 = {};
    bool local_31 = {};
    bool local_32 = {};
    bool local_33 = {};
    bool local_34 = {};
    bool local_35 = {};
    bool local_36 = {};
    metal::uint2 _e4 = process_edge(raw_2.x);
    metal::uint2 _e6 = process_edge(raw_2.y);
    metal::uint2 _e8 = process_edge(raw_2.z);
    metal::uint2 _e10 = process_edge(raw_2.w);
    bool _e12 = is_above(raw_2.x);
    if (!(_e12)) {
        bool _e17 = is_above(raw_2.y);
        local_24 = _e17;
    } else {
        local_24 = true;
    }
    bool _e19 = local_24;
    if (!(_e19)) {
        bool _e24 = is_above(raw_2.z);
        local_25 = _e24;
    } else {
        local_25 = true;
    }
    bool _e26 = local_25;
    if (!(_e26)) {
        bool _e31 = is_above(raw_2.w);
        local_26 = _e31;
    } else {
        local_26 = true;
    }
    bool _e33 = local_26;
    if (!(_e33)) {
        bool _e38 = is_above(raw_inside.x);
        local_27 = _e38;
    } else {
        local_27 = true;
    }
    bool _e40 = local_27;
    if (!(_e40)) {
        bool _e45 = is_above(raw_inside.y);
        local_28 = _e45;
    } else {
        local_28 = true;
    }
    bool any_above_2 = local_28;
    uint _e48 = inside_low(any_above_2);
    metal::uint2 _e50 = process_inside(raw_inside.x, _e48);
    metal::uint2 _e52 = process_inside(raw_inside.y, _e48);
    out_2.outer = metal::uint4(_e4.x, _e6.x, _e8.x, _e10.x);
    out_2.outer_odd = metal::uint4(_e4.y, _e6.y, _e8.y, _e10.y);
    out_2.inside = metal::uint2(_e50.x, _e52.x);
    out_2.inside_odd = metal::uint2(_e50.y, _e52.y);
    bool _e74 = is_greater_than_zero(raw_2.x);
    if (_e74) {
        bool _e78 = is_greater_than_zero(raw_2.y);
        local_29 = _e78;
    } else {
        local_29 = false;
    }
    bool _e80 = local_29;
    if (_e80) {
        bool _e84 = is_greater_than_zero(raw_2.z);
        local_30 = _e84;
    } else {
        local_30 = false;
    }
    bool _e86 = local_30;
    if (_e86) {
        bool _e90 = is_greater_than_zero(raw_2.w);
        local_31 = _e90;
    } else {
        local_31 = false;
    }
    bool _e92 = local_31;
    bool is_culled_3 = !(_e92);
    if (_e4.x == ONE) {
        local_32 = _e6.x == ONE;
    } else {
        local_32 = false;
    }
    bool _e103 = local_32;
    if (_e103) {
        local_33 = _e8.x == ONE;
    } else {
        local_33 = false;
    }
    bool _e110 = local_33;
    if (_e110) {
        local_34 = _e10.x == ONE;
    } else {
        local_34 = false;
    }
    bool _e117 = local_34;
    if (_e117) {
        local_35 = _e50.x == ONE;
    } else {
        local_35 = false;
    }
    bool _e124 = local_35;
    if (_e124) {
        local_36 = _e52.x == ONE;
    } else {
        local_36 = false;
    }
    bool is_minimum_2 = local_36;
    Processed _e133 = out_2;
    metal::uint2 _e134 = make_topology(_e133, is_culled_3, is_minimum_2);
    out_2.topology = _e134;
    Processed _e135 = out_2;
    return _e135;
}

Processed process(
    uint patch_index,
    device type_9 const& raw_factors,
    constant _mslBufferSizes& _buffer_sizes
) {
    if (false) {
        metal::uint2 _e4 = raw_factors[metal::min(unsigned(patch_index), (_buffer_sizes.size4 - 0 - 8) / 8)];
        Processed _e5 = process_isoline(_e4);
        return _e5;
    }
    if (false) {
        uint at_1 = 2u * patch_index;
        metal::uint2 _e11 = raw_factors[metal::min(unsigned(at_1), (_buffer_sizes.size4 - 0 - 8) / 8)];
        metal::uint2 _e16 = raw_factors[metal::min(unsigned(at_1 + 1u), (_buffer_sizes.size4 - 0 - 8) / 8)];
        Processed _e18 = process_triangle(metal::uint4(_e11, _e16));
        return _e18;
    }
    uint at_2 = 3u * patch_index;
    metal::uint2 _e23 = raw_factors[metal::min(unsigned(at_2), (_buffer_sizes.size4 - 0 - 8) / 8)];
    metal::uint2 _e28 = raw_factors[metal::min(unsigned(at_2 + 1u), (_buffer_sizes.size4 - 0 - 8) / 8)];
    metal::uint4 outer_2 = metal::uint4(_e23, _e28);
    metal::uint2 _e34 = raw_factors[metal::min(unsigned(at_2 + 2u), (_buffer_sizes.size4 - 0 - 8) / 8)];
    Processed _e35 = process_quad(outer_2, _e34);
    return _e35;
}

void write_contexts(
    uint patch_index_1,
    Processed processed_1,
    constant Job& job,
    device type_6 const& tables,
    device type_9& contexts,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint step = job.stride;
    metal::uint2 _e11 = make_context(processed_1.outer.x, processed_1.outer_odd.x, tables, _buffer_sizes);
    contexts[metal::min(unsigned(patch_index_1), (_buffer_sizes.size5 - 0 - 8) / 8)] = _e11;
    metal::uint2 _e19 = make_context(processed_1.outer.y, processed_1.outer_odd.y, tables, _buffer_sizes);
    contexts[metal::min(unsigned(patch_index_1 + step), (_buffer_sizes.size5 - 0 - 8) / 8)] = _e19;
    if (false) {
        return;
    }
    metal::uint2 _e30 = make_context(processed_1.outer.z, processed_1.outer_odd.z, tables, _buffer_sizes);
    contexts[metal::min(unsigned(patch_index_1 + (2u * step)), (_buffer_sizes.size5 - 0 - 8) / 8)] = _e30;
    if (false) {
        metal::uint2 _e41 = make_context(processed_1.inside.x, processed_1.inside_odd.x, tables, _buffer_sizes);
        contexts[metal::min(unsigned(patch_index_1 + (3u * step)), (_buffer_sizes.size5 - 0 - 8) / 8)] = _e41;
        return;
    }
    metal::uint2 _e51 = make_context(processed_1.outer.w, processed_1.outer_odd.w, tables, _buffer_sizes);
    contexts[metal::min(unsigned(patch_index_1 + (3u * step)), (_buffer_sizes.size5 - 0 - 8) / 8)] = _e51;
    metal::uint2 _e61 = make_context(processed_1.inside.x, processed_1.inside_odd.x, tables, _buffer_sizes);
    contexts[metal::min(unsigned(patch_index_1 + (4u * step)), (_buffer_sizes.size5 - 0 - 8) / 8)] = _e61;
    metal::uint2 _e71 = make_context(processed_1.inside.y, processed_1.inside_odd.y, tables, _buffer_sizes);
    contexts[metal::min(unsigned(patch_index_1 + (5u * step)), (_buffer_sizes.size5 - 0 - 8) / 8)] = _e71;
    return;
}

BlockSums process_block(
    uint block,
    uint thread_2,
    constant Job& job,
    device type_5& catalogue,
    device type_6 const& tables,
    threadgroup type_7& sums,
    device type_9 const& raw_factors,
    device type_9& contexts,
    threadgroup metal::uint2& first_topology,
    threadgroup metal::atomic_uint& differs,
    device type_9& topologies,
    device type_9& offsets,
    constant _mslBufferSizes& _buffer_sizes
) {
    metal::uint2 own_1 = metal::uint2(0u, 0u);
    metal::uint2 topology_15 = metal::uint2(0u, 0u);
    bool local_37 = {};
    metal::uint2 slot = metal::uint2(0u, 0u);
    bool local_38 = {};
    bool local_39 = {};
    bool local_40 = {};
    bool local_41 = {};
    uint patch_index_2 = (block * BLOCK) + thread_2;
    uint _e15 = job.patches;
    if (patch_index_2 < _e15) {
        Processed _e17 = process(patch_index_2, raw_factors, _buffer_sizes);
        topology_15 = _e17.topology;
        metal::uint2 _e21 = topology_15;
        topologies[metal::min(unsigned(patch_index_2), (_buffer_sizes.size8 - 0 - 8) / 8)] = _e21;
        metal::uint2 _e22 = topology_15;
        metal::uint2 _e23 = counts(_e22);
        own_1 = _e23;
        if (true) {
            uint _e28 = state_of(_e17.topology);
            local_37 = _e28 == REGULAR;
        } else {
            local_37 = false;
        }
        bool _e32 = local_37;
        if (_e32) {
            write_contexts(patch_index_2, _e17, job, tables, contexts, _buffer_sizes);
        }
    }
    if (thread_2 == 0u) {
        metal::uint2 _e36 = topology_15;
        first_topology = _e36;
        metal::atomic_store_explicit(&differs, 0u, metal::memory_order_relaxed);
    }
    metal::uint2 _e39 = own_1;
    Sums _e40 = prefix_sums(thread_2, _e39, sums);
    uint _e43 = job.patches;
    if (patch_index_2 < _e43) {
        offsets[metal::min(unsigned(patch_index_2), (_buffer_sizes.size9 - 0 - 8) / 8)] = _e40.before;
        metal::uint2 _e48 = topology_15;
        metal::uint2 _e50 = first_topology;
        if (metal::any(_e48 != _e50)) {
            metal::atomic_store_explicit(&differs, 1u, metal::memory_order_relaxed);
        }
    }
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    uint _e56 = metal::atomic_load_explicit(&differs, metal::memory_order_relaxed);
    bool is_alike = _e56 == 0u;
    if (!(!(is_alike))) {
        if (thread_2 == 0u) {
            local_39 = true;
        } else {
            local_39 = false;
        }
        bool _e73 = local_39;
        local_38 = _e73;
    } else {
        local_38 = true;
    }
    bool _e75 = local_38;
    if (_e75) {
        metal::uint2 _e77 = topology_15;
        metal::uint2 _e78 = own_1;
        uint _e79 = slot_of(_e77, _e78, job, catalogue, _buffer_sizes);
        slot.y = _e79 << 14u;
    }
    uint _e83 = slot.y;
    if (_e83 != 0u) {
        local_40 = !(is_alike);
    } else {
        local_40 = false;
    }
    bool _e90 = local_40;
    if (_e90) {
        metal::uint2 _e93 = topology_15;
        metal::uint2 _e94 = slot;
        topologies[metal::min(unsigned(patch_index_2), (_buffer_sizes.size8 - 0 - 8) / 8)] = _e93 | _e94;
    }
    if (thread_2 == 0u) {
        uint _e104 = job.patches;
        local_41 = (block * BLOCK) < _e104;
    } else {
        local_41 = false;
    }
    bool _e107 = local_41;
    if (_e107) {
        uint _e111 = job.alike_at;
        metal::uint2 _e117 = topology_15;
        metal::uint2 _e118 = slot;
        offsets[metal::min(unsigned(_e111 + block), (_buffer_sizes.size9 - 0 - 8) / 8)] = is_alike ? (_e117 | _e118) : metal::uint2(0u, 0u);
    }
    metal::uint2 _e121 = own_1;
    return BlockSums {_e121, _e40.before, _e40.all};
}

struct factorsInput {
};
kernel void factors(
  metal::uint3 workgroup [[threadgroup_position_in_grid]]
, uint thread_ [[thread_index_in_threadgroup]]
, constant Job& job [[buffer(0)]]
, device type_5& catalogue [[buffer(6)]]
, device type_6 const& tables [[buffer(2)]]
, threadgroup type_7& sums
, device type_9 const& raw_factors [[buffer(1)]]
, device type_9& contexts [[buffer(4)]]
, threadgroup metal::uint2& first_topology
, threadgroup metal::atomic_uint& differs
, device type_9& topologies [[buffer(3)]]
, device type_9& offsets [[buffer(5)]]
, constant _mslBufferSizes& _buffer_sizes [[buffer(7)]]
) {
    bool local = {};
    bool local_1 = {};
    uint _e6 = job.max_workgroups;
    uint block_1 = workgroup.x + (workgroup.y * _e6);
    BlockSums _e9 = process_block(block_1, thread_, job, catalogue, tables, sums, raw_factors, contexts, first_topology, differs, topologies, offsets, _buffer_sizes);
    metal::uint2 all_1 = _e9.all;
    if (thread_ == 0u) {
        uint _e17 = job.first_patch;
        local = (block_1 + _e17) == 0u;
    } else {
        local = false;
    }
    bool _e22 = local;
    if (_e22) {
        empty_catalogue(catalogue, _buffer_sizes);
    }
    if (thread_ == 0u) {
        uint _e31 = job.patches;
        local_1 = (block_1 * BLOCK) < _e31;
    } else {
        local_1 = false;
    }
    bool _e34 = local_1;
    if (_e34) {
        uint _e38 = job.blocks_at;
        offsets[metal::min(unsigned(_e38 + block_1), (_buffer_sizes.size9 - 0 - 8) / 8)] = all_1;
        return;
    } else {
        return;
    }
}
