// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;

struct _mslBufferSizes {
    uint size0;
    uint size2;
    uint size3;
    uint size4;
    uint size9;
    uint size10;
    uint size11;
    uint size12;
};

typedef metal::uint2 type_2[1];
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
struct Tile {
    uint base;
    uint begin;
    uint end;
    uint first_patch;
    uint last_patch;
};
typedef uint type_3[1];
struct Range {
    uint points_begin;
    uint points_end;
    uint primitives_begin;
    uint primitives_end;
};
typedef Range type_5[1];
struct Status {
    uint points;
    uint points_high;
    uint primitives;
    uint primitives_high;
    uint overflow;
    uint reserved_0_;
    uint reserved_1_;
    uint reserved_2_;
    type_5 ranges;
};
struct Repeat {
    metal::uint2 topology;
    uint size;
    uint before;
    uint inverse;
    uint base;
    uint points;
    char _pad6[4];
};
struct Rings {
    uint outer;
    uint before_1_;
    uint before_2_;
    uint before_3_;
    uint u;
    uint v;
    uint short_;
    uint sides;
    uint boundary;
    uint along;
};
struct RingLocation {
    uint ring;
    uint edge;
    uint step;
};
struct PointRun {
    uint size;
    uint step;
    uint fixed;
    uint form;
    metal::uint2 context;
    uint first;
    uint sign;
};
struct PatchAxes {
    uint patch_index;
    Rings rings;
    char _pad2[4];
    metal::uint2 along_u;
    metal::uint2 along_v;
};
struct Constant {
    uint factor;
    uint ring;
    bool is_far;
    bool is_centre;
    char _pad4[2];
};
struct RunShape {
    uint size;
    uint form;
    uint factor;
    uint points;
    uint first;
    uint sign;
    Constant constant_;
};
struct Round {
    uint first;
    uint count;
    uint begin;
    uint end;
    bool is_listed;
    char _pad5[3];
};
struct type_7 {
    int inner[128];
};
struct type_8 {
    metal::uint2 inner[320];
};
struct type_9 {
    metal::uint2 inner[128];
};
struct PointSource {
    uint number;
    uint begin;
    metal::uint2 topology;
    PatchAxes axes;
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
constant uint SCRATCH = 320u;
constant uint THREADS = 128u;
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
constant uint FORM_FIXED_Q = 0u;
constant uint FORM_Q_FIXED = 1u;
constant uint FORM_Q_REST = 2u;
constant uint FORM_CORNER = 3u;
constant uint DOWN = 4294967295u;

metal::uint2 patch_offset(
    uint patch_index,
    device type_2 const& offsets,
    constant Job& job,
    constant _mslBufferSizes& _buffer_sizes
) {
    metal::uint2 _e3 = offsets[metal::min(unsigned(patch_index), (_buffer_sizes.size0 - 0 - 8) / 8)];
    uint _e7 = job.blocks_at;
    metal::uint2 _e12 = offsets[metal::min(unsigned(_e7 + (patch_index >> BLOCK_BITS)), (_buffer_sizes.size0 - 0 - 8) / 8)];
    uint _e17 = job.sections_at;
    metal::uint2 _e22 = offsets[metal::min(unsigned(_e17 + (patch_index >> SECTION_BITS)), (_buffer_sizes.size0 - 0 - 8) / 8)];
    return (_e3 + _e12) + _e22;
}

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

Tile tile_of(
    uint workgroup_1,
    uint begin,
    uint end_1,
    uint table_at,
    constant Job& job,
    device type_3 const& tiles,
    constant _mslBufferSizes& _buffer_sizes
) {
    bool local = {};
    uint _e4 = tile_at(begin, job);
    uint _e7 = job.window_first;
    uint first_2 = metal::max(_e4, _e7);
    uint _e9 = tile_end(end_1, job);
    uint _e12 = job.window_first;
    uint _e15 = job.window_tiles;
    uint last_1 = metal::min(_e9, _e12 + _e15);
    uint number_5 = first_2 + workgroup_1;
    if (!((end_1 <= begin))) {
        local = number_5 >= last_1;
    } else {
        local = true;
    }
    bool _e25 = local;
    if (_e25) {
        return Tile {0u, 0u, 0u, 0u, 0u};
    }
    uint _e34 = job.tile_bits;
    uint base = number_5 << _e34;
    uint at_1 = (table_at + number_5) - _e4;
    uint _e42 = job.tile_bits;
    uint _e48 = tiles[metal::min(unsigned(at_1), (_buffer_sizes.size2 - 0 - 4) / 4)];
    uint _e53 = tiles[metal::min(unsigned(at_1 + 1u), (_buffer_sizes.size2 - 0 - 4) / 4)];
    return Tile {base, metal::max(base, begin), metal::min(base + (1u << _e42), end_1), _e48, _e53};
}

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

metal::uint2 common_topology(
    Tile tile,
    device type_2 const& offsets,
    constant Job& job,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint block = {};
    uint _e3 = job.alike_at;
    uint first_3 = _e3 + (tile.first_patch >> BLOCK_BITS);
    uint _e10 = job.alike_at;
    uint last_2 = _e10 + (tile.last_patch >> BLOCK_BITS);
    metal::uint2 topology_17 = offsets[metal::min(unsigned(first_3), (_buffer_sizes.size0 - 0 - 8) / 8)];
    block = first_3 + 1u;
    uint2 loop_bound = uint2(4294967295u);
    bool loop_init = true;
    while(true) {
        if (metal::all(loop_bound == uint2(0u))) { break; }
        loop_bound -= uint2(loop_bound.y == 0u, 1u);
        if (!loop_init) {
            uint _e33 = block;
            block = _e33 + 1u;
        }
        loop_init = false;
        uint _e21 = block;
        if (_e21 <= last_2) {
        } else {
            break;
        }
        {
            uint _e24 = block;
            metal::uint2 _e26 = offsets[metal::min(unsigned(_e24), (_buffer_sizes.size0 - 0 - 8) / 8)];
            if (metal::any(_e26 != topology_17)) {
                return metal::uint2(0u, 0u);
            }
        }
    }
    return topology_17;
}

uint naga_div(uint lhs, uint rhs) {
    return lhs / metal::select(rhs, 1u, rhs == 0u);
}

Repeat repeat_of(
    Tile tile_1,
    uint kind,
    uint most,
    device type_2 const& offsets,
    constant Job& job,
    constant _mslBufferSizes& _buffer_sizes
) {
    Repeat none = {};
    bool local_1 = {};
    bool local_2 = {};
    none.size = 0u;
    metal::uint2 _e6 = common_topology(tile_1, offsets, job, _buffer_sizes);
    if (true) {
        local_1 = tile_1.first_patch == tile_1.last_patch;
    } else {
        local_1 = true;
    }
    bool _e14 = local_1;
    if (!(_e14)) {
        uint _e18 = state_of(_e6);
        local_2 = _e18 == CULLED;
    } else {
        local_2 = true;
    }
    bool _e22 = local_2;
    if (_e22) {
        Repeat _e23 = none;
        return _e23;
    }
    metal::uint2 _e25 = patch_offset(tile_1.first_patch, offsets, job, _buffer_sizes);
    metal::uint2 _e29 = patch_offset(tile_1.first_patch + 1u, offsets, job, _buffer_sizes);
    metal::uint2 size = _e29 - _e25;
    if (size[metal::min(unsigned(kind), 1u)] > most) {
        Repeat _e33 = none;
        return _e33;
    }
    return Repeat {_e6, size[metal::min(unsigned(kind), 1u)], tile_1.base - _e25[metal::min(unsigned(kind), 1u)], naga_div(2097151u + size[metal::min(unsigned(kind), 1u)], size[metal::min(unsigned(kind), 1u)]), _e25.x, size.x};
}

uint patch_at(
    Repeat repeat,
    uint position
) {
    return (position * repeat.inverse) >> 21u;
}

uint catalogue_word(
    uint at,
    device type_3 const& catalogue,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint _e3 = catalogue[metal::min(unsigned(at), (_buffer_sizes.size3 - 0 - 4) / 4)];
    return _e3;
}

metal::uint2 context_of(
    uint patch_index_1,
    uint factor,
    uint points,
    constant Job& job,
    device type_2 const& contexts,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint _e6 = job.stride;
    metal::uint2 _e10 = contexts[metal::min(unsigned((factor * _e6) + patch_index_1), (_buffer_sizes.size4 - 0 - 8) / 8)];
    return _e10;
}

uint fixed_from_bits(
    uint bits
) {
    bool local_3 = {};
    bool local_4 = {};
    uint shift = 134u - (bits >> 23u);
    uint mantissa = (bits & 8388607u) | 8388608u;
    uint quotient = mantissa >> shift;
    uint remainder = mantissa & ((1u << shift) - 1u);
    uint half_ = 1u << (shift - 1u);
    if (!((remainder > half_))) {
        if (remainder == half_) {
            local_4 = (quotient & 1u) == 1u;
        } else {
            local_4 = false;
        }
        bool _e31 = local_4;
        local_3 = _e31;
    } else {
        local_3 = true;
    }
    bool up = local_3;
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

uint inv_floor_of(
    metal::uint2 context
) {
    return context.x & 131071u;
}

uint inv_ceil_of(
    metal::uint2 context_1
) {
    return context_1.y & 65535u;
}

uint fraction_of(
    metal::uint2 context_2
) {
    return context_2.y >> 16u;
}

uint half_points_of(
    metal::uint2 context_3
) {
    return (context_3.x >> 17u) & 63u;
}

uint split_of(
    metal::uint2 context_4
) {
    return (context_4.x >> 23u) & 63u;
}

uint odd_of(
    metal::uint2 context_5
) {
    return (context_5.x >> 29u) & 1u;
}

uint place_before_middle(
    metal::uint2 context_6,
    uint position_1
) {
    uint _e4 = split_of(context_6);
    uint coarse_position = position_1 - ((position_1 > _e4) ? 1u : 0u);
    uint _e8 = inv_floor_of(context_6);
    uint coarse = coarse_position * _e8;
    uint _e10 = inv_ceil_of(context_6);
    uint fine = position_1 * _e10;
    uint _e15 = fraction_of(context_6);
    return (((coarse << 16u) + ((fine - coarse) * _e15)) + HALF) >> 16u;
}

uint place(
    metal::uint2 context_7,
    uint position_2
) {
    uint _e2 = half_points_of(context_7);
    bool flip = position_2 >= _e2;
    uint _e7 = odd_of(context_7);
    uint p = flip ? (((2u * _e2) - position_2) - _e7) : position_2;
    uint _e10 = place_before_middle(context_7, p);
    uint location_5 = flip ? (ONE - _e10) : _e10;
    return (p == _e2) ? HALF : location_5;
}

Rings rings_of(
    metal::uint2 topology_9
) {
    uint _e2 = outer_points(topology_9, 0u);
    uint _e4 = outer_points(topology_9, 1u);
    uint before_2_ = _e2 + _e4;
    uint _e7 = outer_points(topology_9, 2u);
    uint before_3_ = before_2_ + _e7;
    uint _e9 = inside_u(topology_9);
    uint _e10 = inside_v(topology_9);
    uint sides = _e9 + _e10;
    uint _e15 = outer_points(topology_9, 3u);
    return Rings {topology_9.x, _e2, before_2_, before_3_, _e9, _e10, metal::min(_e9, _e10), sides, before_3_ + (false ? 4294967293u : (_e15 - 4u)), false ? (sides + _e9) : (2u * sides)};
}

uint outer_of(
    Rings rings,
    uint edge_4
) {
    return (rings.outer >> (7u * edge_4)) & 127u;
}

uint outer_sum(
    Rings rings_1,
    uint edge_5
) {
    uint high = (edge_5 == 3u) ? rings_1.before_3_ : rings_1.before_2_;
    return (edge_5 >= 2u) ? high : ((edge_5 == 1u) ? rings_1.before_1_ : 0u);
}

uint along_of(
    Rings rings_2,
    uint edge_6
) {
    return ((edge_6 & 1u) == 1u) ? rings_2.u : rings_2.v;
}

uint along_sum(
    Rings rings_3,
    uint edge_7
) {
    return (((edge_7 & 1u) == 1u) ? rings_3.v : 0u) + ((edge_7 >= 2u) ? rings_3.sides : 0u);
}

uint ring_points(
    Rings rings_4,
    uint ring
) {
    return (rings_4.along - EDGES) - (8u * ring);
}

uint first_of_ring(
    Rings rings_5,
    uint ring_1
) {
    return rings_5.boundary + ((ring_1 - 1u) * ((rings_5.along - EDGES) - (EDGES * ring_1)));
}

uint point_ring_end(
    Rings rings_6
) {
    return rings_6.short_ >> 1u;
}

uint stitch_ring_end(
    Rings rings_7
) {
    return (rings_7.short_ + 1u) >> 1u;
}

uint nearer_ring(
    uint k,
    uint reach,
    uint goal,
    uint end_2,
    uint form,
    uint scale
) {
    uint next_1 = metal::min(k + reach, end_2);
    return ((next_1 * (form - (scale * next_1))) <= goal) ? next_1 : k;
}

uint last_before(
    uint goal_1,
    uint end_3,
    uint form_1,
    uint scale_1
) {
    uint k_1 = 0u;
    if (end_3 > 3u) {
        uint _e8 = k_1;
        uint _e10 = nearer_ring(_e8, 16u, goal_1, end_3, form_1, scale_1);
        k_1 = _e10;
        uint _e11 = k_1;
        uint _e13 = nearer_ring(_e11, 8u, goal_1, end_3, form_1, scale_1);
        k_1 = _e13;
        uint _e14 = k_1;
        uint _e16 = nearer_ring(_e14, 4u, goal_1, end_3, form_1, scale_1);
        k_1 = _e16;
    }
    uint _e17 = k_1;
    uint _e19 = nearer_ring(_e17, 2u, goal_1, end_3, form_1, scale_1);
    k_1 = _e19;
    uint _e20 = k_1;
    uint _e22 = nearer_ring(_e20, 1u, goal_1, end_3, form_1, scale_1);
    return _e22;
}

RingLocation location_on_edges(
    uint ring_2,
    uint rest,
    uint begin_1_,
    uint begin_2_,
    uint size_2_
) {
    bool is_high = rest >= begin_2_;
    uint low = rest - (is_high ? begin_2_ : 0u);
    uint size_1 = is_high ? (false ? NEVER : size_2_) : begin_1_;
    bool is_odd = low >= size_1;
    return RingLocation {ring_2, (is_high ? 2u : 0u) + (is_odd ? 1u : 0u), low - (is_odd ? size_1 : 0u)};
}

RingLocation location_on_ring(
    uint ring_3,
    uint rest_1,
    uint size_0_,
    uint size_1_
) {
    RingLocation _e5 = location_on_edges(ring_3, rest_1, size_0_, size_0_ + size_1_, size_0_);
    return _e5;
}

RingLocation next_edge(
    RingLocation location
) {
    bool is_last = (location.edge + 1u) == EDGES;
    return RingLocation {is_last ? (location.ring + 1u) : location.ring, is_last ? 0u : (location.edge + 1u), 0u};
}

PatchAxes axes_of(
    uint patch_index_2,
    metal::uint2 topology_10,
    constant Job& job,
    device type_2 const& contexts,
    constant _mslBufferSizes& _buffer_sizes
) {
    Rings _e2 = rings_of(topology_10);
    metal::uint2 _e5 = context_of(patch_index_2, EDGES, _e2.u, job, contexts, _buffer_sizes);
    if (false) {
        return PatchAxes {patch_index_2, _e2, {}, _e5, _e5};
    }
    metal::uint2 _e10 = context_of(patch_index_2, 5u, _e2.v, job, contexts, _buffer_sizes);
    return PatchAxes {patch_index_2, _e2, {}, _e5, _e10};
}

uint inside_factor(
    uint edge_8
) {
    bool local_5 = {};
    if (true) {
        local_5 = (edge_8 & 1u) == 1u;
    } else {
        local_5 = true;
    }
    bool _e11 = local_5;
    return _e11 ? EDGES : 5u;
}

metal::uint2 inside_context(
    PatchAxes axes,
    uint factor_1
) {
    return (factor_1 == EDGES) ? axes.along_u : axes.along_v;
}

RingLocation point_location(
    Rings rings_8,
    uint i
) {
    uint ring_4 = 0u;
    uint rest_2 = {};
    uint begin_1_1 = {};
    uint begin_2_1 = {};
    uint size_2_1 = {};
    bool is_outer = i < rings_8.boundary;
    uint _e4 = point_ring_end(rings_8);
    uint end_5 = _e4 - 1u;
    rest_2 = i;
    begin_1_1 = rings_8.before_1_ - 1u;
    begin_2_1 = rings_8.before_2_ - 2u;
    uint _e19 = outer_of(rings_8, 2u);
    size_2_1 = _e19 - 1u;
    if (!(is_outer)) {
        uint form_3 = rings_8.along - 8u;
        uint _e30 = last_before(i - rings_8.boundary, end_5, form_3, EDGES);
        ring_4 = _e30 + 1u;
        rest_2 = (i - rings_8.boundary) - (_e30 * (form_3 - (EDGES * _e30)));
        uint _e44 = ring_4;
        size_2_1 = (rings_8.v - 1u) - (2u * _e44);
        uint _e47 = size_2_1;
        begin_1_1 = (_e30 == end_5) ? NEVER : _e47;
        uint _e55 = ring_4;
        begin_2_1 = (_e30 == end_5) ? NEVER : ((rings_8.sides - 2u) - (4u * _e55));
    }
    uint _e61 = ring_4;
    uint _e62 = rest_2;
    uint _e63 = begin_1_1;
    uint _e64 = begin_2_1;
    uint _e65 = size_2_1;
    RingLocation _e66 = location_on_edges(_e61, _e62, _e63, _e64, _e65);
    return _e66;
}

RunShape shape_of(
    Rings rings_9,
    RingLocation location_1
) {
    uint form_2 = {};
    bool local_6 = {};
    bool descends = {};
    uint ring_5 = location_1.ring;
    bool is_outer_1 = ring_5 == 0u;
    uint _e5 = point_ring_end(rings_9);
    bool is_centre = ring_5 == _e5;
    uint edge_9 = is_centre ? ((rings_9.u > rings_9.v) ? 1u : 0u) : location_1.edge;
    uint _e15 = along_of(rings_9, edge_9);
    uint _e16 = outer_of(rings_9, edge_9);
    uint points_1 = is_outer_1 ? _e16 : _e15;
    uint last_3 = (points_1 - 1u) - ring_5;
    form_2 = edge_9 & 1u;
    if (!((edge_9 == 0u))) {
        local_6 = edge_9 == 3u;
    } else {
        local_6 = true;
    }
    bool _e32 = local_6;
    descends = _e32;
    if (false) {
        form_2 = is_centre ? FORM_CORNER : edge_9;
        descends = edge_9 != 1u;
    }
    uint _e44 = form_2;
    uint _e45 = inside_factor(edge_9);
    bool _e47 = descends;
    bool _e51 = descends;
    uint _e55 = inside_factor(edge_9 + 1u);
    return RunShape {(last_3 - ring_5) + (is_centre ? 1u : 0u), _e44, is_outer_1 ? edge_9 : _e45, points_1, _e47 ? last_3 : ring_5, _e51 ? DOWN : 1u, Constant {_e55, ring_5, edge_9 >= 2u, is_centre}};
}

uint constant_value(
    Constant constant_,
    metal::uint2 context_8
) {
    uint _e3 = place_before_middle(context_8, constant_.ring);
    if (false) {
        return constant_.is_centre ? ONE_THIRD : (((_e3 * TWO_THIRDS) + HALF) >> 16u);
    }
    return constant_.is_centre ? HALF : (constant_.is_far ? (ONE - _e3) : _e3);
}

PointRun run_of(
    PatchAxes axes_1,
    RingLocation location_2,
    constant Job& job,
    device type_2 const& contexts,
    constant _mslBufferSizes& _buffer_sizes
) {
    metal::uint2 context_9 = {};
    RunShape _e3 = shape_of(axes_1.rings, location_2);
    metal::uint2 _e5 = inside_context(axes_1, _e3.factor);
    context_9 = _e5;
    if (location_2.ring == 0u) {
        metal::uint2 _e13 = context_of(axes_1.patch_index, _e3.factor, _e3.points, job, contexts, _buffer_sizes);
        context_9 = _e13;
    }
    Constant constant_1 = _e3.constant_;
    metal::uint2 _e18 = inside_context(axes_1, _e3.constant_.factor);
    uint _e19 = constant_value(constant_1, _e18);
    metal::uint2 _e21 = context_9;
    return PointRun {_e3.size, location_2.step, _e19, _e3.form, _e21, _e3.first, _e3.sign};
}

PointRun line_run(
    uint patch_index_3,
    metal::uint2 topology_11,
    uint i_1,
    constant Job& job,
    device type_2 const& contexts,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint _e4 = outer_points(topology_11, 1u);
    uint line = naga_div(i_1, _e4);
    uint _e8 = outer_points(topology_11, 0u);
    metal::uint2 _e9 = context_of(patch_index_3, 0u, _e8, job, contexts, _buffer_sizes);
    uint _e10 = place(_e9, line);
    metal::uint2 _e15 = context_of(patch_index_3, 1u, _e4, job, contexts, _buffer_sizes);
    return PointRun {_e4, i_1 - (line * _e4), _e10, FORM_Q_FIXED, _e15, 0u, 1u};
}

PointRun minimum_run(
    uint i_2
) {
    return PointRun {EDGES, i_2, 0u, FORM_CORNER, metal::uint2(0u), 0u, 1u};
}

PointRun run_at_point(
    uint patch_index_4,
    metal::uint2 topology_12,
    uint i_3,
    constant Job& job,
    device type_2 const& contexts,
    constant _mslBufferSizes& _buffer_sizes
) {
    if (false) {
        PointRun _e4 = line_run(patch_index_4, topology_12, i_3, job, contexts, _buffer_sizes);
        return _e4;
    }
    uint _e5 = state_of(topology_12);
    if (_e5 == MINIMUM) {
        PointRun _e8 = minimum_run(i_3);
        return _e8;
    }
    PatchAxes _e9 = axes_of(patch_index_4, topology_12, job, contexts, _buffer_sizes);
    RingLocation _e11 = point_location(_e9.rings, i_3);
    PointRun _e12 = run_of(_e9, _e11, job, contexts, _buffer_sizes);
    return _e12;
}

metal::uint2 corner(
    uint fixed,
    uint number
) {
    bool local_7 = {};
    if (fixed != 0u) {
        return metal::uint2(fixed, fixed);
    }
    if (false) {
        return metal::uint2((number == 2u) ? ONE : 0u, (number == 0u) ? ONE : 0u);
    }
    if (!((number == 1u))) {
        local_7 = number == 2u;
    } else {
        local_7 = true;
    }
    bool _e27 = local_7;
    return metal::uint2(_e27 ? ONE : 0u, (number >= 2u) ? ONE : 0u);
}

metal::uint2 point_of_run(
    PointRun run,
    uint step
) {
    uint q = {};
    uint fixed_1 = run.fixed;
    if (run.form == FORM_CORNER) {
        metal::uint2 _e6 = corner(fixed_1, step);
        return _e6;
    }
    uint _e12 = place(run.context, run.first + (run.sign * step));
    q = _e12;
    if (false) {
        uint _e15 = q;
        q = _e15 - ((fixed_1 + 1u) >> 1u);
        if (run.form == FORM_Q_REST) {
            uint _e24 = q;
            uint _e26 = q;
            return metal::uint2(_e24, (ONE - _e26) - fixed_1);
        }
    }
    uint _e30 = q;
    uint _e32 = q;
    return (run.form == FORM_Q_FIXED) ? metal::uint2(_e32, fixed_1) : metal::uint2(fixed_1, _e30);
}

uint described_point(
    metal::uint2 topology_13,
    uint i_4
) {
    uint _e2 = state_of(topology_13);
    if (_e2 == MINIMUM) {
        return (i_4 << 6u) | 786432u;
    }
    Rings _e9 = rings_of(topology_13);
    RingLocation _e10 = point_location(_e9, i_4);
    RunShape _e11 = shape_of(_e9, _e10);
    Constant constant_2 = _e11.constant_;
    uint position_3 = _e11.first + (_e11.sign * _e10.step);
    return (((((_e11.factor | (_e11.constant_.factor << 3u)) | (position_3 << 6u)) | (_e11.constant_.ring << 13u)) | (_e11.form << 18u)) | (_e11.constant_.is_far ? 1048576u : 0u)) | (_e11.constant_.is_centre ? 2097152u : 0u);
}

metal::uint2 placed_point(
    uint described,
    uint patch_index_5,
    constant Job& job,
    device type_2 const& contexts,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint ring_6 = (described >> 13u) & 31u;
    Constant constant_3 = Constant {0u, ring_6, (described & 1048576u) != 0u, (described & 2097152u) != 0u};
    metal::uint2 _e21 = context_of(patch_index_5, (described >> 3u) & 7u, 0u, job, contexts, _buffer_sizes);
    uint _e22 = constant_value(constant_3, _e21);
    metal::uint2 _e26 = context_of(patch_index_5, described & 7u, 0u, job, contexts, _buffer_sizes);
    PointRun run_2 = PointRun {0u, 0u, _e22, (described >> 18u) & 3u, _e26, 0u, 1u};
    metal::uint2 _e40 = point_of_run(run_2, (described >> 6u) & 127u);
    return _e40;
}

uint tile_size(
) {
    return TILE;
}

uint place_of(
    uint patch_index_6,
    metal::uint2 topology_14,
    uint kind_1,
    device type_2 const& offsets,
    constant Job& job,
    device type_3 const& catalogue,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint slot = {};
    uint _e3 = listed_slot(topology_14);
    slot = _e3;
    uint _e5 = slot;
    if (_e5 == 0u) {
        uint _e11 = job.alike_at;
        metal::uint2 _e16 = offsets[metal::min(unsigned(_e11 + (patch_index_6 >> BLOCK_BITS)), (_buffer_sizes.size0 - 0 - 8) / 8)];
        uint _e17 = listed_slot(_e16);
        slot = _e17;
    }
    uint _e18 = slot;
    if (_e18 == 0u) {
        return 0u;
    }
    uint _e24 = slot;
    uint _e30 = catalogue_word((PLACES_AT + (2u * (_e24 - 1u))) + kind_1, catalogue, _buffer_sizes);
    return _e30;
}

void load_patch(
    uint i_5,
    uint patch_index_7,
    Tile tile_2,
    uint kind_2,
    device type_2 const& offsets,
    constant Job& job,
    device type_3 const& catalogue,
    threadgroup type_7& begins,
    threadgroup type_8& scratch,
    threadgroup type_9& listed,
    threadgroup metal::atomic_uint& is_missing,
    device type_2 const& topologies,
    constant _mslBufferSizes& _buffer_sizes
) {
    bool local_8 = {};
    metal::uint2 topology_18 = topologies[metal::min(unsigned(patch_index_7), (_buffer_sizes.size9 - 0 - 8) / 8)];
    metal::uint2 _e7 = patch_offset(patch_index_7, offsets, job, _buffer_sizes);
    uint begin_1 = _e7[metal::min(unsigned(kind_2), 1u)] - tile_2.base;
    begins.inner[metal::min(unsigned(i_5), 127u)] = static_cast<int>(begin_1);
    scratch.inner[metal::min(unsigned(i_5), 319u)] = topology_18;
    uint _e16 = place_of(patch_index_7, topology_18, kind_2, offsets, job, catalogue, _buffer_sizes);
    uint words = (kind_2 == POINTS) ? POINT_WORDS : 1u;
    listed.inner[metal::min(unsigned(i_5), 127u)] = metal::uint2(_e16 - (words * begin_1), true ? _e7.x : 0u);
    if (_e16 == 0u) {
        uint _e35 = state_of(topology_18);
        local_8 = _e35 != CULLED;
    } else {
        local_8 = false;
    }
    bool _e39 = local_8;
    if (_e39) {
        metal::atomic_store_explicit(&is_missing, 1u, metal::memory_order_relaxed);
        return;
    } else {
        return;
    }
}

Round load_round(
    Tile tile_3,
    uint first,
    uint kind_3,
    uint thread_1,
    device type_2 const& offsets,
    constant Job& job,
    device type_3 const& catalogue,
    threadgroup type_7& begins,
    threadgroup type_8& scratch,
    threadgroup type_9& listed,
    threadgroup metal::atomic_uint& is_missing,
    device type_2 const& topologies,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint i_6 = {};
    uint end_4 = {};
    uint count = metal::min(ROUND, (tile_3.last_patch - first) + 1u);
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    if (thread_1 == 0u) {
        metal::atomic_store_explicit(&is_missing, 0u, metal::memory_order_relaxed);
    }
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    i_6 = thread_1;
    uint2 loop_bound_1 = uint2(4294967295u);
    bool loop_init_1 = true;
    while(true) {
        if (metal::all(loop_bound_1 == uint2(0u))) { break; }
        loop_bound_1 -= uint2(loop_bound_1.y == 0u, 1u);
        if (!loop_init_1) {
            uint _e20 = i_6;
            i_6 = _e20 + THREADS;
        }
        loop_init_1 = false;
        uint _e15 = i_6;
        if (_e15 < count) {
        } else {
            break;
        }
        {
            uint _e17 = i_6;
            uint _e18 = i_6;
            load_patch(_e17, first + _e18, tile_3, kind_3, offsets, job, catalogue, begins, scratch, listed, is_missing, topologies, _buffer_sizes);
        }
    }
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    int _e25 = begins.inner[0];
    uint begin_2 = static_cast<uint>(metal::max(_e25, static_cast<int>(tile_3.begin - tile_3.base)));
    end_4 = tile_3.end - tile_3.base;
    if ((first + count) <= tile_3.last_patch) {
        metal::uint2 _e40 = patch_offset(first + count, offsets, job, _buffer_sizes);
        end_4 = _e40[metal::min(unsigned(kind_3), 1u)] - tile_3.base;
    }
    uint _e44 = end_4;
    uint _e46 = metal::atomic_load_explicit(&is_missing, metal::memory_order_relaxed);
    return Round {first, count, begin_2, _e44, _e46 == 0u};
}

uint nearer_patch(
    uint found,
    uint reach_1,
    uint last,
    uint element_1,
    threadgroup type_7& begins
) {
    uint next_2 = metal::min(found + reach_1, last);
    int _e8 = begins.inner[metal::min(unsigned(next_2), 127u)];
    return (_e8 <= static_cast<int>(element_1)) ? next_2 : found;
}

uint find_patch(
    Round round,
    uint element_2,
    threadgroup type_7& begins
) {
    uint found_1 = 0u;
    if (round.count == 1u) {
        uint _e7 = found_1;
        return _e7;
    }
    uint last_4 = round.count - 1u;
    if (round.count > 32u) {
        uint _e14 = found_1;
        uint _e16 = nearer_patch(_e14, 64u, last_4, element_2, begins);
        found_1 = _e16;
        uint _e17 = found_1;
        uint _e19 = nearer_patch(_e17, 32u, last_4, element_2, begins);
        found_1 = _e19;
    }
    if (round.count > 8u) {
        uint _e23 = found_1;
        uint _e25 = nearer_patch(_e23, 16u, last_4, element_2, begins);
        found_1 = _e25;
        uint _e26 = found_1;
        uint _e28 = nearer_patch(_e26, 8u, last_4, element_2, begins);
        found_1 = _e28;
    }
    if (round.count > 4u) {
        uint _e32 = found_1;
        uint _e34 = nearer_patch(_e32, 4u, last_4, element_2, begins);
        found_1 = _e34;
    }
    uint _e35 = found_1;
    uint _e37 = nearer_patch(_e35, 2u, last_4, element_2, begins);
    found_1 = _e37;
    uint _e38 = found_1;
    uint _e40 = nearer_patch(_e38, 1u, last_4, element_2, begins);
    return _e40;
}

uint next_patch(
    Round round_1,
    uint number_1,
    uint element_3,
    threadgroup type_7& begins
) {
    uint found_2 = {};
    bool local_9 = {};
    found_2 = number_1;
    uint2 loop_bound_2 = uint2(4294967295u);
    while(true) {
        if (metal::all(loop_bound_2 == uint2(0u))) { break; }
        loop_bound_2 -= uint2(loop_bound_2.y == 0u, 1u);
        uint _e4 = found_2;
        if ((_e4 + 1u) < round_1.count) {
            uint _e12 = found_2;
            int _e16 = begins.inner[metal::min(unsigned(_e12 + 1u), 127u)];
            local_9 = _e16 <= static_cast<int>(element_3);
        } else {
            local_9 = false;
        }
        bool _e20 = local_9;
        if (_e20) {
        } else {
            break;
        }
        {
            uint _e22 = found_2;
            found_2 = _e22 + 1u;
        }
    }
    uint _e24 = found_2;
    return _e24;
}

metal::uint2 numbered(
    metal::uint2 stored,
    uint patch_number
) {
    if (true) {
        return metal::uint2(stored.x, stored.y | (patch_number << 2u));
    }
    return stored;
}

metal::uint2 format_point(
    metal::uint2 point,
    uint patch_number_1
) {
    if (true) {
        metal::uint2 _e12 = numbered(metal::uint2(point.x | (point.y << 17u), point.y >> 15u), patch_number_1);
        return _e12;
    }
    uint _e14 = float_bits_from_coordinate(point.x);
    uint _e16 = float_bits_from_coordinate(point.y);
    return metal::uint2(_e14, _e16);
}

PointSource point_source_of(
    uint patch_index_8,
    metal::uint2 topology_15,
    constant Job& job,
    device type_2 const& contexts,
    constant _mslBufferSizes& _buffer_sizes
) {
    PointSource source = {};
    bool local_10 = {};
    source.topology = topology_15;
    if (true) {
        uint _e7 = state_of(topology_15);
        local_10 = _e7 == REGULAR;
    } else {
        local_10 = false;
    }
    bool _e11 = local_10;
    if (_e11) {
        PatchAxes _e13 = axes_of(patch_index_8, topology_15, job, contexts, _buffer_sizes);
        source.axes = _e13;
    }
    PointSource _e14 = source;
    return _e14;
}

PointSource load_point_source(
    Round round_2,
    uint number_2,
    constant Job& job,
    device type_2 const& contexts,
    threadgroup type_7& begins,
    threadgroup type_8& scratch,
    constant _mslBufferSizes& _buffer_sizes
) {
    PointSource source_1 = {};
    metal::uint2 _e6 = scratch.inner[metal::min(unsigned(number_2), 319u)];
    PointSource _e7 = point_source_of(round_2.first + number_2, _e6, job, contexts, _buffer_sizes);
    source_1 = _e7;
    source_1.number = number_2;
    int _e13 = begins.inner[metal::min(unsigned(number_2), 127u)];
    source_1.begin = static_cast<uint>(_e13);
    PointSource _e15 = source_1;
    return _e15;
}

RingLocation location_of_point(
    PointSource source_2,
    uint i_7
) {
    bool local_11 = {};
    if (true) {
        uint _e6 = state_of(source_2.topology);
        local_11 = _e6 == REGULAR;
    } else {
        local_11 = false;
    }
    bool _e10 = local_11;
    if (_e10) {
        RingLocation _e13 = point_location(source_2.axes.rings, i_7);
        return _e13;
    }
    return RingLocation {0u, 0u, i_7};
}

PointRun run_at(
    Round round_3,
    PointSource source_3,
    RingLocation location_3,
    constant Job& job,
    device type_2 const& contexts,
    constant _mslBufferSizes& _buffer_sizes
) {
    if (false) {
        PointRun _e9 = line_run(round_3.first + source_3.number, source_3.topology, location_3.step, job, contexts, _buffer_sizes);
        return _e9;
    }
    uint _e11 = state_of(source_3.topology);
    if (_e11 == MINIMUM) {
        PointRun _e15 = minimum_run(location_3.step);
        return _e15;
    }
    PointRun _e17 = run_of(source_3.axes, location_3, job, contexts, _buffer_sizes);
    return _e17;
}

PointRun first_run(
    Round round_4,
    PointSource source_4,
    RingLocation location_4,
    bool is_next_patch,
    uint element_4,
    constant Job& job,
    device type_2 const& contexts,
    constant _mslBufferSizes& _buffer_sizes
) {
    RingLocation next = {};
    if (false) {
        PointRun _e11 = run_at(round_4, source_4, RingLocation {0u, 0u, element_4 - source_4.begin}, job, contexts, _buffer_sizes);
        return _e11;
    }
    RingLocation _e12 = next_edge(location_4);
    next = _e12;
    if (is_next_patch) {
        next = RingLocation {0u, 0u, 0u};
    }
    RingLocation _e18 = next;
    PointRun _e19 = run_at(round_4, source_4, _e18, job, contexts, _buffer_sizes);
    return _e19;
}

void write_points(
    Round round_5,
    uint thread_2,
    uint out,
    constant Job& job,
    device type_2 const& contexts,
    threadgroup type_7& begins,
    threadgroup type_8& scratch,
    device type_2& points_out,
    constant _mslBufferSizes& _buffer_sizes
) {
    PointSource source_5 = {};
    uint element_5 = {};
    bool local_12 = {};
    PointRun run_1 = {};
    bool local_13 = {};
    source_5.number = NEVER;
    uint _e8 = job.first_patch;
    uint patch_number_2 = _e8 + round_5.first;
    element_5 = 2u * thread_2;
    uint2 loop_bound_3 = uint2(4294967295u);
    bool loop_init_2 = true;
    while(true) {
        if (metal::all(loop_bound_3 == uint2(0u))) { break; }
        loop_bound_3 -= uint2(loop_bound_3.y == 0u, 1u);
        if (!loop_init_2) {
            uint _e101 = element_5;
            element_5 = _e101 + 256u;
        }
        loop_init_2 = false;
        uint _e14 = element_5;
        uint _e15 = tile_size();
        if (_e14 < _e15) {
        } else {
            break;
        }
        {
            uint _e17 = element_5;
            if (!(((_e17 + 1u) < round_5.begin))) {
                uint _e25 = element_5;
                local_12 = _e25 >= round_5.end;
            } else {
                local_12 = true;
            }
            bool _e29 = local_12;
            if (_e29) {
                continue;
            }
            uint _e30 = element_5;
            uint first_4 = metal::max(_e30, round_5.begin);
            uint _e33 = find_patch(round_5, first_4, begins);
            uint _e35 = source_5.number;
            if (_e33 != _e35) {
                PointSource _e37 = load_point_source(round_5, _e33, job, contexts, begins, scratch, _buffer_sizes);
                source_5 = _e37;
            }
            PointSource _e38 = source_5;
            uint _e40 = source_5.begin;
            RingLocation _e42 = location_of_point(_e38, first_4 - _e40);
            PointSource _e43 = source_5;
            PointRun _e44 = run_at(round_5, _e43, _e42, job, contexts, _buffer_sizes);
            run_1 = _e44;
            PointRun _e49 = run_1;
            uint _e51 = run_1.step;
            metal::uint2 _e52 = point_of_run(_e49, _e51);
            metal::uint2 _e54 = format_point(_e52, patch_number_2 + _e33);
            points_out[metal::min(unsigned(out + first_4), (_buffer_sizes.size10 - 0 - 8) / 8)] = _e54;
            uint _e55 = element_5;
            if (first_4 == _e55) {
                uint _e59 = element_5;
                local_13 = (_e59 + 1u) < round_5.end;
            } else {
                local_13 = false;
            }
            bool _e65 = local_13;
            if (_e65) {
                uint _e68 = run_1.step;
                run_1.step = _e68 + 1u;
                uint _e71 = run_1.step;
                uint _e73 = run_1.size;
                if (_e71 == _e73) {
                    uint _e75 = element_5;
                    uint _e78 = next_patch(round_5, _e33, _e75 + 1u, begins);
                    if (_e78 != _e33) {
                        PointSource _e80 = load_point_source(round_5, _e78, job, contexts, begins, scratch, _buffer_sizes);
                        source_5 = _e80;
                    }
                    PointSource _e81 = source_5;
                    uint _e83 = element_5;
                    PointRun _e86 = first_run(round_5, _e81, _e42, _e78 != _e33, _e83 + 1u, job, contexts, _buffer_sizes);
                    run_1 = _e86;
                }
                uint _e88 = element_5;
                PointRun _e93 = run_1;
                uint _e95 = run_1.step;
                metal::uint2 _e96 = point_of_run(_e93, _e95);
                uint _e98 = source_5.number;
                metal::uint2 _e100 = format_point(_e96, patch_number_2 + _e98);
                points_out[metal::min(unsigned((out + _e88) + 1u), (_buffer_sizes.size10 - 0 - 8) / 8)] = _e100;
            }
        }
    }
    return;
}

metal::uint2 listed_point(
    Round round_6,
    uint number_3,
    uint element_6,
    constant Job& job,
    device type_3 const& catalogue,
    device type_2 const& contexts,
    threadgroup type_9& listed,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint _e6 = listed.inner[metal::min(unsigned(number_3), 127u)].x;
    uint at_2 = _e6 + (POINT_WORDS * element_6);
    uint patch_index_9 = round_6.first + number_3;
    uint _e14 = job.first_patch;
    uint patch_number_3 = _e14 + patch_index_9;
    if (IS_INTEGER) {
        uint _e17 = catalogue_word(at_2, catalogue, _buffer_sizes);
        uint _e20 = catalogue_word(at_2 + 1u, catalogue, _buffer_sizes);
        metal::uint2 _e22 = numbered(metal::uint2(_e17, _e20), patch_number_3);
        return _e22;
    }
    uint _e23 = catalogue_word(at_2, catalogue, _buffer_sizes);
    metal::uint2 _e24 = placed_point(_e23, patch_index_9, job, contexts, _buffer_sizes);
    metal::uint2 _e25 = format_point(_e24, patch_number_3);
    return _e25;
}

void write_listed_points(
    Round round_7,
    uint thread_3,
    uint out_1,
    constant Job& job,
    device type_3 const& catalogue,
    device type_2 const& contexts,
    threadgroup type_7& begins,
    threadgroup type_9& listed,
    device type_2& points_out,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint element_7 = {};
    bool local_14 = {};
    bool local_15 = {};
    element_7 = 2u * thread_3;
    uint2 loop_bound_4 = uint2(4294967295u);
    bool loop_init_3 = true;
    while(true) {
        if (metal::all(loop_bound_4 == uint2(0u))) { break; }
        loop_bound_4 -= uint2(loop_bound_4.y == 0u, 1u);
        if (!loop_init_3) {
            uint _e55 = element_7;
            element_7 = _e55 + 256u;
        }
        loop_init_3 = false;
        uint _e6 = element_7;
        uint _e7 = tile_size();
        if (_e6 < _e7) {
        } else {
            break;
        }
        {
            uint _e9 = element_7;
            if (!(((_e9 + 1u) < round_7.begin))) {
                uint _e17 = element_7;
                local_14 = _e17 >= round_7.end;
            } else {
                local_14 = true;
            }
            bool _e21 = local_14;
            if (_e21) {
                continue;
            }
            uint _e22 = element_7;
            uint first_5 = metal::max(_e22, round_7.begin);
            uint _e25 = find_patch(round_7, first_5, begins);
            metal::uint2 _e29 = listed_point(round_7, _e25, first_5, job, catalogue, contexts, listed, _buffer_sizes);
            points_out[metal::min(unsigned(out_1 + first_5), (_buffer_sizes.size10 - 0 - 8) / 8)] = _e29;
            uint _e30 = element_7;
            if (first_5 == _e30) {
                uint _e34 = element_7;
                local_15 = (_e34 + 1u) < round_7.end;
            } else {
                local_15 = false;
            }
            bool _e40 = local_15;
            if (_e40) {
                uint _e41 = element_7;
                uint _e44 = next_patch(round_7, _e25, _e41 + 1u, begins);
                uint _e46 = element_7;
                uint _e51 = element_7;
                metal::uint2 _e54 = listed_point(round_7, _e44, _e51 + 1u, job, catalogue, contexts, listed, _buffer_sizes);
                points_out[metal::min(unsigned((out_1 + _e46) + 1u), (_buffer_sizes.size10 - 0 - 8) / 8)] = _e54;
            }
        }
    }
    return;
}

bool has_same_points(
    metal::uint2 topology_16
) {
    bool local_16 = {};
    if (true) {
        uint _e4 = state_of(topology_16);
        local_16 = _e4 == MINIMUM;
    } else {
        local_16 = true;
    }
    bool _e8 = local_16;
    return _e8;
}

void copy_points(
    Tile tile_4,
    Repeat repeat_1,
    uint thread_4,
    uint out_2,
    constant Job& job,
    device type_2 const& contexts,
    threadgroup type_8& scratch,
    device type_2& points_out,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint i_8 = {};
    uint element_8 = {};
    PointSource _e6 = point_source_of(tile_4.first_patch, repeat_1.topology, job, contexts, _buffer_sizes);
    Round round_8 = Round {tile_4.first_patch, 1u, 0u, 0u, false};
    i_8 = thread_4;
    uint2 loop_bound_5 = uint2(4294967295u);
    bool loop_init_4 = true;
    while(true) {
        if (metal::all(loop_bound_5 == uint2(0u))) { break; }
        loop_bound_5 -= uint2(loop_bound_5.y == 0u, 1u);
        if (!loop_init_4) {
            uint _e27 = i_8;
            i_8 = _e27 + THREADS;
        }
        loop_init_4 = false;
        uint _e14 = i_8;
        if (_e14 < repeat_1.size) {
        } else {
            break;
        }
        {
            uint _e17 = i_8;
            RingLocation _e18 = location_of_point(_e6, _e17);
            PointRun _e19 = run_at(round_8, _e6, _e18, job, contexts, _buffer_sizes);
            uint _e21 = i_8;
            metal::uint2 _e24 = point_of_run(_e19, _e19.step);
            metal::uint2 _e26 = format_point(_e24, 0u);
            scratch.inner[metal::min(unsigned(_e21), 319u)] = _e26;
        }
    }
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    uint end_6 = tile_4.end - tile_4.base;
    element_8 = (tile_4.begin - tile_4.base) + thread_4;
    uint2 loop_bound_6 = uint2(4294967295u);
    bool loop_init_5 = true;
    while(true) {
        if (metal::all(loop_bound_6 == uint2(0u))) { break; }
        loop_bound_6 -= uint2(loop_bound_6.y == 0u, 1u);
        if (!loop_init_5) {
            uint _e61 = element_8;
            element_8 = _e61 + THREADS;
        }
        loop_init_5 = false;
        uint _e38 = element_8;
        if (_e38 < end_6) {
        } else {
            break;
        }
        {
            uint _e40 = element_8;
            uint position_4 = _e40 + repeat_1.before;
            uint _e43 = patch_at(repeat_1, position_4);
            uint _e45 = element_8;
            metal::uint2 _e53 = scratch.inner[metal::min(unsigned(position_4 - (_e43 * repeat_1.size)), 319u)];
            uint _e56 = job.first_patch;
            metal::uint2 _e60 = numbered(_e53, (_e56 + tile_4.first_patch) + _e43);
            points_out[metal::min(unsigned(out_2 + _e45), (_buffer_sizes.size10 - 0 - 8) / 8)] = _e60;
        }
    }
    return;
}

void write_point_tile(
    uint number_4,
    uint thread_5,
    device type_2 const& offsets,
    constant Job& job,
    device type_3 const& tiles,
    device type_3 const& catalogue,
    device type_2 const& contexts,
    threadgroup type_7& begins,
    threadgroup type_8& scratch,
    threadgroup type_9& listed,
    threadgroup metal::atomic_uint& is_missing,
    device type_2 const& topologies,
    device type_2& points_out,
    device Status const& status,
    constant _mslBufferSizes& _buffer_sizes
) {
    bool local_17 = {};
    bool local_18 = {};
    uint first_1 = {};
    uint _e6 = job.portion;
    Range range = status.ranges[metal::min(unsigned(_e6), (_buffer_sizes.size11 - 32 - 16) / 16)];
    Tile _e12 = tile_of(number_4, range.points_begin, range.points_end, 0u, job, tiles, _buffer_sizes);
    if (!((_e12.end == 0u))) {
        uint _e21 = status.overflow;
        local_17 = _e21 != 0u;
    } else {
        local_17 = true;
    }
    bool _e25 = local_17;
    if (_e25) {
        return;
    }
    uint _e29 = job.window_first;
    uint _e32 = job.tile_bits;
    uint out_3 = _e12.base - (_e29 << _e32);
    Repeat _e37 = repeat_of(_e12, POINTS, SCRATCH, offsets, job, _buffer_sizes);
    if (_e37.size > 0u) {
        bool _e44 = has_same_points(_e37.topology);
        local_18 = _e44;
    } else {
        local_18 = false;
    }
    bool _e46 = local_18;
    if (_e46) {
        copy_points(_e12, _e37, thread_5, out_3, job, contexts, scratch, points_out, _buffer_sizes);
        return;
    }
    first_1 = _e12.first_patch;
    uint2 loop_bound_7 = uint2(4294967295u);
    bool loop_init_6 = true;
    while(true) {
        if (metal::all(loop_bound_7 == uint2(0u))) { break; }
        loop_bound_7 -= uint2(loop_bound_7.y == 0u, 1u);
        if (!loop_init_6) {
            uint _e56 = first_1;
            first_1 = _e56 + ROUND;
        }
        loop_init_6 = false;
        uint _e49 = first_1;
        if (_e49 <= _e12.last_patch) {
        } else {
            break;
        }
        {
            uint _e52 = first_1;
            Round _e54 = load_round(_e12, _e52, POINTS, thread_5, offsets, job, catalogue, begins, scratch, listed, is_missing, topologies, _buffer_sizes);
            if (_e54.is_listed) {
                write_listed_points(_e54, thread_5, out_3, job, catalogue, contexts, begins, listed, points_out, _buffer_sizes);
            } else {
                write_points(_e54, thread_5, out_3, job, contexts, begins, scratch, points_out, _buffer_sizes);
            }
        }
    }
    return;
}

struct expand_pointsInput {
};
kernel void expand_points(
  metal::uint3 workgroup [[threadgroup_position_in_grid]]
, uint thread_ [[thread_index_in_threadgroup]]
, device type_2 const& offsets [[buffer(4)]]
, constant Job& job [[buffer(0)]]
, device type_3 const& tiles [[buffer(6)]]
, device type_3 const& catalogue [[buffer(8)]]
, device type_2 const& contexts [[buffer(2)]]
, threadgroup type_7& begins
, threadgroup type_8& scratch
, threadgroup type_9& listed
, threadgroup metal::atomic_uint& is_missing
, device type_2 const& topologies [[buffer(1)]]
, device type_2& points_out [[buffer(7)]]
, device Status const& status [[buffer(5)]]
, constant _mslBufferSizes& _buffer_sizes [[buffer(9)]]
) {
    uint _e6 = job.max_workgroups;
    uint number_6 = workgroup.x + (workgroup.y * _e6);
    write_point_tile(number_6, thread_, offsets, job, tiles, catalogue, contexts, begins, scratch, listed, is_missing, topologies, points_out, status, _buffer_sizes);
    return;
}
