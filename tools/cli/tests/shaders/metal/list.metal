// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;

struct _mslBufferSizes {
    uint size0;
    uint size2;
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
struct Sector {
    uint edge;
    uint transition;
    uint along;
    uint end;
    uint inverse;
};
struct Stitch {
    uint size;
    uint steps_at;
    uint outer;
    uint inner;
    bool turns;
    char _pad5[3];
    uint outer_turn;
    uint outer_mirror;
    uint inner_turn;
    uint inner_mirror;
};
struct Pair {
    metal::uint3 first;
    metal::uint3 second;
};
typedef uint type_5[1];
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
typedef metal::atomic_uint type_7[1];
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
constant uint FORM_FIXED_Q = 0u;
constant uint FORM_Q_FIXED = 1u;
constant uint FORM_Q_REST = 2u;
constant uint FORM_CORNER = 3u;
constant uint DOWN = 4294967295u;

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

uint key_of(
    metal::uint2 topology_9
) {
    uint key = {};
    uint edge_4 = 0u;
    uint _e1 = inside_u(topology_9);
    uint _e6 = inside_v(topology_9);
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
            uint _e20 = outer_points(topology_9, _e19);
            uint _e24 = edge_4;
            key = _e18 | ((_e20 - 2u) << (5u * _e24));
        }
    }
    uint _e31 = key;
    uint _e32 = state_of(topology_9);
    return _e31 | (_e32 << 30u);
}

bool has_key(
    metal::uint2 topology_10
) {
    uint most = {};
    uint edge_5 = 0u;
    bool local = {};
    uint _e1 = inside_u(topology_10);
    uint _e2 = inside_v(topology_10);
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
            uint _e12 = outer_points(topology_10, _e11);
            most = metal::max(_e10, _e12);
        }
    }
    uint _e17 = state_of(topology_10);
    if (_e17 != CULLED) {
        uint _e22 = most;
        local = _e22 <= 33u;
    } else {
        local = false;
    }
    bool _e26 = local;
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

Rings rings_of(
    metal::uint2 topology_11
) {
    uint _e2 = outer_points(topology_11, 0u);
    uint _e4 = outer_points(topology_11, 1u);
    uint before_2_ = _e2 + _e4;
    uint _e7 = outer_points(topology_11, 2u);
    uint before_3_ = before_2_ + _e7;
    uint _e9 = inside_u(topology_11);
    uint _e10 = inside_v(topology_11);
    uint sides = _e9 + _e10;
    uint _e15 = outer_points(topology_11, 3u);
    return Rings {topology_11.x, _e2, before_2_, before_3_, _e9, _e10, metal::min(_e9, _e10), sides, before_3_ + (false ? 4294967293u : (_e15 - 4u)), false ? (sides + _e9) : (2u * sides)};
}

uint outer_of(
    Rings rings,
    uint edge_7
) {
    return (rings.outer >> (7u * edge_7)) & 127u;
}

uint outer_sum(
    Rings rings_1,
    uint edge_8
) {
    uint high = (edge_8 == 3u) ? rings_1.before_3_ : rings_1.before_2_;
    return (edge_8 >= 2u) ? high : ((edge_8 == 1u) ? rings_1.before_1_ : 0u);
}

uint along_of(
    Rings rings_2,
    uint edge_9
) {
    return ((edge_9 & 1u) == 1u) ? rings_2.u : rings_2.v;
}

uint along_sum(
    Rings rings_3,
    uint edge_10
) {
    return (((edge_10 & 1u) == 1u) ? rings_3.v : 0u) + ((edge_10 >= 2u) ? rings_3.sides : 0u);
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
    uint end,
    uint form,
    uint scale
) {
    uint next = metal::min(k + reach, end);
    return ((next * (form - (scale * next))) <= goal) ? next : k;
}

uint last_before(
    uint goal_1,
    uint end_1,
    uint form_1,
    uint scale_1
) {
    uint k_1 = 0u;
    if (end_1 > 3u) {
        uint _e8 = k_1;
        uint _e10 = nearer_ring(_e8, 16u, goal_1, end_1, form_1, scale_1);
        k_1 = _e10;
        uint _e11 = k_1;
        uint _e13 = nearer_ring(_e11, 8u, goal_1, end_1, form_1, scale_1);
        k_1 = _e13;
        uint _e14 = k_1;
        uint _e16 = nearer_ring(_e14, 4u, goal_1, end_1, form_1, scale_1);
        k_1 = _e16;
    }
    uint _e17 = k_1;
    uint _e19 = nearer_ring(_e17, 2u, goal_1, end_1, form_1, scale_1);
    k_1 = _e19;
    uint _e20 = k_1;
    uint _e22 = nearer_ring(_e20, 1u, goal_1, end_1, form_1, scale_1);
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
    uint size_2 = is_high ? (false ? NEVER : size_2_) : begin_1_;
    bool is_odd = low >= size_2;
    return RingLocation {ring_2, (is_high ? 2u : 0u) + (is_odd ? 1u : 0u), low - (is_odd ? size_2 : 0u)};
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

uint naga_div(uint lhs, uint rhs) {
    return lhs / metal::select(rhs, 1u, rhs == 0u);
}

Sector sector_of(
    Rings rings_8,
    uint edge_11
) {
    uint _e2 = along_of(rings_8, edge_11);
    uint regular = (2u * _e2) - 4u;
    uint _e7 = outer_of(rings_8, edge_11);
    uint _e11 = stitch_ring_end(rings_8);
    return Sector {edge_11, (_e7 + _e2) - 4u, _e2, _e11, naga_div(2097151u + regular, regular)};
}

uint sectors_before(
    Rings rings_9,
    uint edge_12
) {
    uint _e2 = stitch_ring_end(rings_9);
    uint _e3 = outer_sum(rings_9, edge_12);
    uint outer_3 = (edge_12 == EDGES) ? (rings_9.boundary + EDGES) : _e3;
    uint _e10 = along_sum(rings_9, edge_12);
    uint along = (edge_12 == EDGES) ? rings_9.along : _e10;
    return ((outer_3 + along) - (4u * edge_12)) + (((_e2 - 2u) * 2u) * (along - (edge_12 * (_e2 + 1u))));
}

uint transition_border(
    Sector sector,
    uint column
) {
    uint first = metal::min(metal::max((8u * column) + 1u, 2u) - 2u, (2u * sector.along) - 4u);
    return ((first * sector.transition) * sector.inverse) >> 21u;
}

uint borders(
    Sector sector_1,
    uint end_2,
    uint column_1
) {
    uint first_1 = (8u * column_1) + 1u;
    uint half_ = (metal::max((2u * sector_1.along) + 1u, first_1) - first_1) >> 1u;
    uint top = metal::max(end_2, 2u);
    uint cut = metal::max(metal::min(metal::min(end_2, (COLUMN * column_1) + 1u), half_), 2u);
    uint complete = metal::clamp(half_, 2u, top);
    return ((cut - 2u) * ((metal::max(first_1, cut + 1u) - cut) - 1u)) + (((top - complete) * 2u) * (((sector_1.along + 1u) - complete) - top));
}

uint columns_before(
    Sector sector_2,
    uint column_2
) {
    uint _e2 = transition_border(sector_2, column_2);
    uint _e4 = borders(sector_2, sector_2.end, column_2);
    return _e2 + _e4;
}

uint nearer_column(
    Sector sector_3,
    uint column_3,
    uint reach_1,
    uint t_1
) {
    uint _e6 = columns_before(sector_3, column_3 + reach_1);
    return column_3 + ((_e6 <= t_1) ? reach_1 : 0u);
}

uint rings_before(
    Sector sector_4,
    uint column_4,
    uint ring_4
) {
    uint _e5 = borders(sector_4, ring_4, column_4 + 1u);
    uint _e6 = borders(sector_4, ring_4, column_4);
    return _e5 - _e6;
}

uint nearer_in_column(
    Sector sector_5,
    uint column_5,
    uint ring_5,
    uint reach_2,
    uint t_2
) {
    bool local_1 = {};
    uint next_1 = ring_5 + reach_2;
    if (next_1 < sector_5.end) {
        uint _e10 = rings_before(sector_5, column_5, next_1);
        local_1 = _e10 <= t_2;
    } else {
        local_1 = false;
    }
    bool is_there = local_1;
    return is_there ? next_1 : ring_5;
}

uint ring_border(
    Sector sector_6,
    uint ring_6,
    uint column_6
) {
    uint first_2 = (8u * column_6) + 1u;
    return metal::min(metal::max(first_2, 2u * ring_6) - (2u * ring_6), 2u * (sector_6.along - (2u * ring_6)));
}

RingLocation location_in_column(
    Sector sector_7,
    uint column_7,
    uint t_3
) {
    uint ring_7 = 2u;
    if (sector_7.end > 10u) {
        uint _e8 = ring_7;
        uint _e10 = nearer_in_column(sector_7, column_7, _e8, 16u, t_3);
        ring_7 = _e10;
        uint _e11 = ring_7;
        uint _e13 = nearer_in_column(sector_7, column_7, _e11, 8u, t_3);
        ring_7 = _e13;
    }
    uint _e14 = ring_7;
    uint _e16 = nearer_in_column(sector_7, column_7, _e14, 4u, t_3);
    ring_7 = _e16;
    uint _e17 = ring_7;
    uint _e19 = nearer_in_column(sector_7, column_7, _e17, 2u, t_3);
    ring_7 = _e19;
    uint _e20 = ring_7;
    uint _e22 = nearer_in_column(sector_7, column_7, _e20, 1u, t_3);
    ring_7 = _e22;
    uint _e23 = ring_7;
    uint _e24 = ring_border(sector_7, _e23, column_7);
    uint _e26 = ring_7;
    uint _e27 = rings_before(sector_7, column_7, _e26);
    uint step_1 = (_e24 + t_3) - _e27;
    uint _e29 = ring_7;
    return RingLocation {_e29, sector_7.edge, step_1};
}

RingLocation location_in_sector(
    Sector sector_8,
    uint t_4
) {
    uint column_8 = {};
    uint _e4 = nearer_column(sector_8, 0u, 8u, t_4);
    column_8 = _e4;
    uint _e6 = column_8;
    uint _e8 = nearer_column(sector_8, _e6, 4u, t_4);
    column_8 = _e8;
    uint _e9 = column_8;
    uint _e11 = nearer_column(sector_8, _e9, 2u, t_4);
    column_8 = _e11;
    uint _e12 = column_8;
    uint _e14 = nearer_column(sector_8, _e12, 1u, t_4);
    column_8 = _e14;
    uint _e15 = column_8;
    uint _e16 = columns_before(sector_8, _e15);
    uint rest_3 = t_4 - _e16;
    uint _e18 = column_8;
    uint _e19 = transition_border(sector_8, _e18);
    uint _e20 = column_8;
    uint _e23 = transition_border(sector_8, _e20 + 1u);
    uint transition = _e23 - _e19;
    if (rest_3 < transition) {
        return RingLocation {1u, sector_8.edge, _e19 + rest_3};
    }
    uint _e30 = column_8;
    RingLocation _e32 = location_in_column(sector_8, _e30, rest_3 - transition);
    return _e32;
}

RingLocation drawn_location(
    Rings rings_10,
    uint t_5
) {
    uint edge_13 = {};
    uint _e3 = sectors_before(rings_10, EDGES);
    if (t_5 >= _e3) {
        uint _e5 = stitch_ring_end(rings_10);
        return RingLocation {_e5, 0u, t_5 - _e3};
    }
    uint _e12 = sectors_before(rings_10, 1u);
    edge_13 = (t_5 >= _e12) ? 1u : 0u;
    uint _e16 = edge_13;
    uint _e19 = sectors_before(rings_10, 2u);
    edge_13 = (t_5 >= _e19) ? 2u : _e16;
    if (true) {
        uint _e23 = edge_13;
        uint _e26 = sectors_before(rings_10, 3u);
        edge_13 = (t_5 >= _e26) ? 3u : _e23;
    }
    uint _e29 = edge_13;
    Sector _e30 = sector_of(rings_10, _e29);
    uint _e31 = edge_13;
    uint _e32 = sectors_before(rings_10, _e31);
    RingLocation _e34 = location_in_sector(_e30, t_5 - _e32);
    return _e34;
}

uint border(
    Sector sector_9,
    uint ring_8,
    uint column_9
) {
    if (ring_8 == 1u) {
        uint _e5 = transition_border(sector_9, column_9);
        return _e5;
    }
    uint _e6 = ring_border(sector_9, ring_8, column_9);
    return _e6;
}

RingLocation drawn_behind(
    Rings rings_11,
    RingLocation location_1
) {
    uint column_10 = {};
    bool local_2 = {};
    uint _e3 = stitch_ring_end(rings_11);
    if (location_1.ring == _e3) {
        return RingLocation {4294967295u, 0u, 0u};
    }
    Sector _e10 = sector_of(rings_11, location_1.edge);
    uint step_2 = location_1.step + 1u;
    column_10 = naga_div((location_1.step + (2u * location_1.ring)) - 1u, 8u);
    if (location_1.ring == 1u) {
        column_10 = naga_div(naga_div((step_2 * ((2u * _e10.along) - 4u)) - 1u, _e10.transition) + 1u, 8u);
    }
    uint _e42 = column_10;
    uint _e45 = border(_e10, location_1.ring, _e42 + 1u);
    if (step_2 < _e45) {
        return RingLocation {location_1.ring, location_1.edge, step_2};
    }
    uint ring_11 = location_1.ring + 1u;
    uint _e53 = column_10;
    uint _e54 = ring_border(_e10, ring_11, _e53);
    if (ring_11 < _e10.end) {
        uint _e59 = column_10;
        uint _e62 = ring_border(_e10, ring_11, _e59 + 1u);
        local_2 = _e54 < _e62;
    } else {
        local_2 = false;
    }
    bool is_there_1 = local_2;
    return RingLocation {is_there_1 ? ring_11 : NEVER, location_1.edge, _e54};
}

uint outer_vertex(
    Stitch stitch,
    uint at
) {
    return (at >= stitch.outer_turn) ? (stitch.outer_mirror - at) : at;
}

uint inner_vertex(
    Stitch stitch_1,
    uint at_1
) {
    return (at_1 >= stitch_1.inner_turn) ? (stitch_1.inner_mirror - at_1) : at_1;
}

metal::uint3 oriented(
    uint a,
    uint b,
    uint c,
    bool begins_inner
) {
    uint first_3 = begins_inner ? b : a;
    uint second = begins_inner ? a : c;
    uint third = begins_inner ? c : b;
    if (false) {
        return metal::uint3(first_3, third, second);
    }
    return metal::uint3(first_3, second, third);
}

Pair stitch_triangles(
    Stitch stitch_2,
    uint number,
    device type_5 const& tables,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint a_1 = {};
    uint b_1 = {};
    uint c_1 = {};
    uint d = {};
    uint steps = tables[metal::min(unsigned(stitch_2.steps_at + number), (_buffer_sizes.size0 - 0 - 4) / 4)];
    bool first_inner = (steps & 128u) != 0u;
    bool second_inner = (steps & 8388608u) != 0u;
    a_1 = stitch_2.outer + (steps & 127u);
    b_1 = (stitch_2.inner + number) - (steps & 127u);
    uint _e26 = a_1;
    uint _e27 = b_1;
    c_1 = (first_inner ? _e27 : _e26) + 1u;
    uint _e32 = c_1;
    uint _e33 = a_1;
    uint _e35 = b_1;
    uint _e36 = c_1;
    d = (second_inner ? (first_inner ? _e36 : _e35) : (first_inner ? _e33 : _e32)) + 1u;
    if (stitch_2.turns) {
        uint _e43 = c_1;
        uint _e44 = outer_vertex(stitch_2, _e43);
        uint _e45 = c_1;
        uint _e46 = inner_vertex(stitch_2, _e45);
        c_1 = first_inner ? _e46 : _e44;
        uint _e48 = d;
        uint _e49 = outer_vertex(stitch_2, _e48);
        uint _e50 = d;
        uint _e51 = inner_vertex(stitch_2, _e50);
        d = second_inner ? _e51 : _e49;
        uint _e53 = a_1;
        uint _e54 = outer_vertex(stitch_2, _e53);
        a_1 = _e54;
        uint _e55 = b_1;
        uint _e56 = inner_vertex(stitch_2, _e55);
        b_1 = _e56;
    }
    uint _e57 = a_1;
    uint _e58 = b_1;
    uint _e59 = c_1;
    metal::uint3 _e64 = oriented(_e57, _e58, _e59, (steps & 256u) != 0u);
    uint _e65 = c_1;
    uint _e66 = a_1;
    uint _e68 = b_1;
    uint _e69 = c_1;
    uint _e71 = d;
    metal::uint3 _e76 = oriented(first_inner ? _e66 : _e65, first_inner ? _e69 : _e68, _e71, (steps & 16777216u) != 0u);
    return Pair {_e64, _e76};
}

RingLocation specified_location(
    Rings rings_12,
    uint t_6
) {
    uint transitions = (rings_12.boundary + rings_12.along) - 12u;
    if (t_6 < transitions) {
        uint _e20 = outer_of(rings_12, 2u);
        RingLocation _e25 = location_on_edges(1u, t_6, (rings_12.before_1_ + rings_12.v) - 4u, (rings_12.before_2_ + rings_12.sides) - 8u, (_e20 + rings_12.v) - 4u);
        return _e25;
    }
    uint _e26 = stitch_ring_end(rings_12);
    uint end_3 = _e26 - 2u;
    uint form_3 = (2u * rings_12.along) - 24u;
    uint _e36 = last_before(t_6 - transitions, end_3, form_3, 8u);
    uint rest_4 = (t_6 - transitions) - (_e36 * (form_3 - (8u * _e36)));
    if (_e36 == end_3) {
        return RingLocation {_e36 + 2u, 0u, rest_4};
    }
    RingLocation _e66 = location_on_ring(_e36 + 2u, rest_4, (2u * rings_12.v) - (4u * (_e36 + 2u)), (2u * rings_12.u) - (4u * (_e36 + 2u)));
    return _e66;
}

RingLocation triangle_location(
    Rings rings_13,
    uint t_7
) {
    if (false) {
        RingLocation _e3 = drawn_location(rings_13, t_7);
        return _e3;
    }
    RingLocation _e4 = specified_location(rings_13, t_7);
    return _e4;
}

uint steps_of(
    uint number_1
) {
    return STITCHES_AT + (STITCH_WORDS * number_1);
}

Stitch straight(
    uint size,
    uint number_2,
    uint outer_1,
    uint inner
) {
    uint _e4 = steps_of(number_2);
    return Stitch {size, _e4, outer_1, inner, false, {}, 0u, 0u, 0u, 0u};
}

Stitch minimum_stitch(
    uint base
) {
    Stitch _e7 = straight(2u, FAN_STITCH, base, (base + EDGES) - 1u);
    return _e7;
}

Stitch rows(
    Rings rings_14,
    uint ring_9,
    uint edge_14,
    uint size_1,
    uint number_3,
    uint outer_ring,
    uint outer_2,
    uint inner_ring,
    uint inner_1
) {
    bool local_3 = {};
    uint _e9 = ring_points(rings_14, ring_9);
    bool walks_back = rings_14.short_ == ((2u * ring_9) + 1u);
    uint _e16 = steps_of(number_3);
    if (!((edge_14 == 3u))) {
        local_3 = walks_back;
    } else {
        local_3 = true;
    }
    bool _e23 = local_3;
    return Stitch {size_1, _e16, outer_2, inner_1, _e23, {}, inner_ring, inner_ring + outer_ring, inner_ring + (walks_back ? (_e9 >> 1u) : _e9), (2u * inner_ring) + _e9};
}

Stitch transition_stitch(
    Rings rings_15,
    uint edge_15,
    uint base_1
) {
    uint _e3 = outer_of(rings_15, edge_15);
    uint _e4 = along_of(rings_15, edge_15);
    uint inner_points = _e4 - 2u;
    uint ring_12 = base_1 + rings_15.boundary;
    uint _e18 = outer_sum(rings_15, edge_15);
    uint _e21 = along_sum(rings_15, edge_15);
    Stitch _e26 = rows(rings_15, 1u, edge_15, (_e3 + inner_points) - 2u, ((TRANSITION_STRIDE * _e3) + inner_points) - 128u, base_1, (base_1 + _e18) - edge_15, ring_12, (ring_12 + _e21) - (3u * edge_15));
    return _e26;
}

Stitch centre_stitch(
    Rings rings_16,
    uint base_2
) {
    bool local_4 = {};
    uint _e2 = stitch_ring_end(rings_16);
    uint _e5 = first_of_ring(rings_16, _e2 - 1u);
    uint first_4 = base_2 + _e5;
    if (false) {
        Stitch _e12 = straight(1u, FAN_STITCH, first_4, first_4 + 2u);
        return _e12;
    }
    uint quads = (metal::max(rings_16.u, rings_16.v) - rings_16.short_) + 1u;
    uint along_u = (rings_16.u > rings_16.v) ? 1u : 0u;
    if (rings_16.u <= rings_16.v) {
        local_4 = (rings_16.v & 1u) == 0u;
    } else {
        local_4 = false;
    }
    bool is_mirrored = local_4;
    uint _e44 = steps_of(is_mirrored ? (MIRRORED_STRIP + quads) : PLAIN_STRIP);
    return Stitch {2u * quads, _e44, first_4 + along_u, first_4, true, {}, NEVER, 0u, first_4 + along_u, (((2u * first_4) + (2u * quads)) + 1u) + along_u};
}

Stitch ring_stitch(
    Rings rings_17,
    RingLocation location_2,
    uint base_3
) {
    uint ring_13 = location_2.ring;
    uint _e5 = along_of(rings_17, location_2.edge);
    uint inner_points_1 = _e5 - (2u * ring_13);
    uint _e9 = first_of_ring(rings_17, ring_13);
    uint inner_ring_1 = base_3 + _e9;
    uint _e13 = ring_points(rings_17, ring_13 - 1u);
    uint outer_ring_1 = inner_ring_1 - _e13;
    uint _e16 = along_sum(rings_17, location_2.edge);
    uint skip = _e16 - ((2u * ring_13) * location_2.edge);
    Stitch _e33 = rows(rings_17, ring_13, location_2.edge, 2u * inner_points_1, RING_STITCH + inner_points_1, outer_ring_1, (outer_ring_1 + skip) + location_2.edge, inner_ring_1, (inner_ring_1 + skip) - location_2.edge);
    return _e33;
}

Stitch stitch_at(
    Rings rings_18,
    RingLocation location_3,
    uint base_4
) {
    if (location_3.ring == 1u) {
        Stitch _e7 = transition_stitch(rings_18, location_3.edge, base_4);
        return _e7;
    }
    uint _e9 = stitch_ring_end(rings_18);
    if (location_3.ring == _e9) {
        Stitch _e11 = centre_stitch(rings_18, base_4);
        return _e11;
    }
    Stitch _e12 = ring_stitch(rings_18, location_3, base_4);
    return _e12;
}

metal::uint3 triangle_of(
    metal::uint2 topology_12,
    uint t_8,
    device type_5 const& tables,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint _e2 = state_of(topology_12);
    if (_e2 == MINIMUM) {
        Stitch _e6 = minimum_stitch(0u);
        Pair _e7 = stitch_triangles(_e6, t_8, tables, _buffer_sizes);
        return _e7.first;
    }
    Rings _e9 = rings_of(topology_12);
    RingLocation _e10 = triangle_location(_e9, t_8);
    Stitch _e12 = stitch_at(_e9, _e10, 0u);
    Pair _e14 = stitch_triangles(_e12, _e10.step, tables, _buffer_sizes);
    return _e14.first;
}

uint sequence_first(
    metal::uint2 topology_13,
    uint t_9,
    uint base_5
) {
    bool local_5 = {};
    if (false) {
        local_5 = true;
    } else {
        local_5 = false;
    }
    bool _e8 = local_5;
    if (_e8) {
        uint _e11 = outer_points(topology_13, 1u);
        return (base_5 + t_9) + naga_div(t_9, _e11 - 1u);
    }
    return base_5 + t_9;
}

uint interior_points(
    metal::uint2 topology_14
) {
    uint _e1 = inside_u(topology_14);
    if (true) {
        uint _e5 = inside_v(topology_14);
        return (_e1 - 2u) * (_e5 - 2u);
    }
    uint half_1 = _e1 >> 1u;
    return ((_e1 & 1u) == 1u) ? (((3u * half_1) * (half_1 - 1u)) + 1u) : ((3u * (half_1 - 1u)) * (half_1 - 1u));
}

uint triangles_of(
    uint points,
    metal::uint2 topology_15
) {
    uint _e6 = boundary(topology_15);
    return ((2u * points) - 2u) - _e6;
}

metal::uint2 counts(
    metal::uint2 topology_16
) {
    uint points_1 = EDGES;
    uint triangles = 2u;
    uint _e1 = state_of(topology_16);
    if (_e1 == CULLED) {
        return metal::uint2(0u, 0u);
    }
    if (false) {
        uint _e9 = outer_points(topology_16, 0u);
        uint lines = _e9 - 1u;
        uint _e13 = outer_points(topology_16, 1u);
        return lines * metal::uint2(_e13, _e13 - 1u);
    }
    uint _e22 = state_of(topology_16);
    if (_e22 == REGULAR) {
        uint _e25 = boundary(topology_16);
        uint _e26 = interior_points(topology_16);
        points_1 = _e25 + _e26;
        uint _e28 = points_1;
        uint _e29 = triangles_of(_e28, topology_16);
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

metal::uint2 context_of(
    uint patch_index,
    uint factor,
    uint points_2
) {
    return metal::uint2(0u, 0u);
}

uint fixed_from_bits(
    uint bits
) {
    bool local_6 = {};
    bool local_7 = {};
    uint shift = 134u - (bits >> 23u);
    uint mantissa = (bits & 8388607u) | 8388608u;
    uint quotient = mantissa >> shift;
    uint remainder = mantissa & ((1u << shift) - 1u);
    uint half_2 = 1u << (shift - 1u);
    if (!((remainder > half_2))) {
        if (remainder == half_2) {
            local_7 = (quotient & 1u) == 1u;
        } else {
            local_7 = false;
        }
        bool _e31 = local_7;
        local_6 = _e31;
    } else {
        local_6 = true;
    }
    bool up = local_6;
    return quotient + (up ? 1u : 0u);
}

uint float_bits_from_coordinate(
    uint coordinate
) {
    if (coordinate == 0u) {
        return 0u;
    }
    uint top_1 = metal::select(31 - metal::clz(coordinate), uint(-1), coordinate == 0);
    uint mantissa_1 = (coordinate << (23u - top_1)) & 8388607u;
    return ((top_1 + 111u) << 23u) | mantissa_1;
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
    uint position
) {
    uint _e4 = split_of(context_6);
    uint coarse_position = position - ((position > _e4) ? 1u : 0u);
    uint _e8 = inv_floor_of(context_6);
    uint coarse = coarse_position * _e8;
    uint _e10 = inv_ceil_of(context_6);
    uint fine = position * _e10;
    uint _e15 = fraction_of(context_6);
    return (((coarse << 16u) + ((fine - coarse) * _e15)) + HALF) >> 16u;
}

uint place(
    metal::uint2 context_7,
    uint position_1
) {
    uint _e2 = half_points_of(context_7);
    bool flip = position_1 >= _e2;
    uint _e7 = odd_of(context_7);
    uint p = flip ? (((2u * _e2) - position_1) - _e7) : position_1;
    uint _e10 = place_before_middle(context_7, p);
    uint location_6 = flip ? (ONE - _e10) : _e10;
    return (p == _e2) ? HALF : location_6;
}

PatchAxes axes_of(
    uint patch_index_1,
    metal::uint2 topology_17
) {
    Rings _e2 = rings_of(topology_17);
    metal::uint2 _e5 = context_of(patch_index_1, EDGES, _e2.u);
    if (false) {
        return PatchAxes {patch_index_1, _e2, {}, _e5, _e5};
    }
    metal::uint2 _e10 = context_of(patch_index_1, 5u, _e2.v);
    return PatchAxes {patch_index_1, _e2, {}, _e5, _e10};
}

uint inside_factor(
    uint edge_16
) {
    bool local_8 = {};
    if (true) {
        local_8 = (edge_16 & 1u) == 1u;
    } else {
        local_8 = true;
    }
    bool _e11 = local_8;
    return _e11 ? EDGES : 5u;
}

metal::uint2 inside_context(
    PatchAxes axes,
    uint factor_1
) {
    return (factor_1 == EDGES) ? axes.along_u : axes.along_v;
}

RingLocation point_location(
    Rings rings_19,
    uint i_1
) {
    uint ring_10 = 0u;
    uint rest_2 = {};
    uint begin_1_1 = {};
    uint begin_2_1 = {};
    uint size_2_1 = {};
    bool is_outer = i_1 < rings_19.boundary;
    uint _e4 = point_ring_end(rings_19);
    uint end_4 = _e4 - 1u;
    rest_2 = i_1;
    begin_1_1 = rings_19.before_1_ - 1u;
    begin_2_1 = rings_19.before_2_ - 2u;
    uint _e19 = outer_of(rings_19, 2u);
    size_2_1 = _e19 - 1u;
    if (!(is_outer)) {
        uint form_4 = rings_19.along - 8u;
        uint _e30 = last_before(i_1 - rings_19.boundary, end_4, form_4, EDGES);
        ring_10 = _e30 + 1u;
        rest_2 = (i_1 - rings_19.boundary) - (_e30 * (form_4 - (EDGES * _e30)));
        uint _e44 = ring_10;
        size_2_1 = (rings_19.v - 1u) - (2u * _e44);
        uint _e47 = size_2_1;
        begin_1_1 = (_e30 == end_4) ? NEVER : _e47;
        uint _e55 = ring_10;
        begin_2_1 = (_e30 == end_4) ? NEVER : ((rings_19.sides - 2u) - (4u * _e55));
    }
    uint _e61 = ring_10;
    uint _e62 = rest_2;
    uint _e63 = begin_1_1;
    uint _e64 = begin_2_1;
    uint _e65 = size_2_1;
    RingLocation _e66 = location_on_edges(_e61, _e62, _e63, _e64, _e65);
    return _e66;
}

RunShape shape_of(
    Rings rings_20,
    RingLocation location_4
) {
    uint form_2 = {};
    bool local_9 = {};
    bool descends = {};
    uint ring_14 = location_4.ring;
    bool is_outer_1 = ring_14 == 0u;
    uint _e5 = point_ring_end(rings_20);
    bool is_centre = ring_14 == _e5;
    uint edge_17 = is_centre ? ((rings_20.u > rings_20.v) ? 1u : 0u) : location_4.edge;
    uint _e15 = along_of(rings_20, edge_17);
    uint _e16 = outer_of(rings_20, edge_17);
    uint points_3 = is_outer_1 ? _e16 : _e15;
    uint last = (points_3 - 1u) - ring_14;
    form_2 = edge_17 & 1u;
    if (!((edge_17 == 0u))) {
        local_9 = edge_17 == 3u;
    } else {
        local_9 = true;
    }
    bool _e32 = local_9;
    descends = _e32;
    if (false) {
        form_2 = is_centre ? FORM_CORNER : edge_17;
        descends = edge_17 != 1u;
    }
    uint _e44 = form_2;
    uint _e45 = inside_factor(edge_17);
    bool _e47 = descends;
    bool _e51 = descends;
    uint _e55 = inside_factor(edge_17 + 1u);
    return RunShape {(last - ring_14) + (is_centre ? 1u : 0u), _e44, is_outer_1 ? edge_17 : _e45, points_3, _e47 ? last : ring_14, _e51 ? DOWN : 1u, Constant {_e55, ring_14, edge_17 >= 2u, is_centre}};
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
    RingLocation location_5
) {
    metal::uint2 context_9 = {};
    RunShape _e3 = shape_of(axes_1.rings, location_5);
    metal::uint2 _e5 = inside_context(axes_1, _e3.factor);
    context_9 = _e5;
    if (location_5.ring == 0u) {
        metal::uint2 _e13 = context_of(axes_1.patch_index, _e3.factor, _e3.points);
        context_9 = _e13;
    }
    Constant constant_1 = _e3.constant_;
    metal::uint2 _e18 = inside_context(axes_1, _e3.constant_.factor);
    uint _e19 = constant_value(constant_1, _e18);
    metal::uint2 _e21 = context_9;
    return PointRun {_e3.size, location_5.step, _e19, _e3.form, _e21, _e3.first, _e3.sign};
}

PointRun line_run(
    uint patch_index_2,
    metal::uint2 topology_18,
    uint i_2
) {
    uint _e4 = outer_points(topology_18, 1u);
    uint line = naga_div(i_2, _e4);
    uint _e8 = outer_points(topology_18, 0u);
    metal::uint2 _e9 = context_of(patch_index_2, 0u, _e8);
    uint _e10 = place(_e9, line);
    metal::uint2 _e15 = context_of(patch_index_2, 1u, _e4);
    return PointRun {_e4, i_2 - (line * _e4), _e10, FORM_Q_FIXED, _e15, 0u, 1u};
}

PointRun minimum_run(
    uint i_3
) {
    return PointRun {EDGES, i_3, 0u, FORM_CORNER, metal::uint2(0u), 0u, 1u};
}

PointRun run_at_point(
    uint patch_index_3,
    metal::uint2 topology_19,
    uint i_4
) {
    if (false) {
        PointRun _e4 = line_run(patch_index_3, topology_19, i_4);
        return _e4;
    }
    uint _e5 = state_of(topology_19);
    if (_e5 == MINIMUM) {
        PointRun _e8 = minimum_run(i_4);
        return _e8;
    }
    PatchAxes _e9 = axes_of(patch_index_3, topology_19);
    RingLocation _e11 = point_location(_e9.rings, i_4);
    PointRun _e12 = run_of(_e9, _e11);
    return _e12;
}

metal::uint2 corner(
    uint fixed,
    uint number_4
) {
    bool local_10 = {};
    if (fixed != 0u) {
        return metal::uint2(fixed, fixed);
    }
    if (false) {
        return metal::uint2((number_4 == 2u) ? ONE : 0u, (number_4 == 0u) ? ONE : 0u);
    }
    if (!((number_4 == 1u))) {
        local_10 = number_4 == 2u;
    } else {
        local_10 = true;
    }
    bool _e27 = local_10;
    return metal::uint2(_e27 ? ONE : 0u, (number_4 >= 2u) ? ONE : 0u);
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
    metal::uint2 topology_20,
    uint i_5
) {
    uint _e2 = state_of(topology_20);
    if (_e2 == MINIMUM) {
        return (i_5 << 6u) | 786432u;
    }
    Rings _e9 = rings_of(topology_20);
    RingLocation _e10 = point_location(_e9, i_5);
    RunShape _e11 = shape_of(_e9, _e10);
    Constant constant_2 = _e11.constant_;
    uint position_2 = _e11.first + (_e11.sign * _e10.step);
    return (((((_e11.factor | (_e11.constant_.factor << 3u)) | (position_2 << 6u)) | (_e11.constant_.ring << 13u)) | (_e11.form << 18u)) | (_e11.constant_.is_far ? 1048576u : 0u)) | (_e11.constant_.is_centre ? 2097152u : 0u);
}

metal::uint2 placed_point(
    uint described,
    uint patch_index_4
) {
    uint ring_15 = (described >> 13u) & 31u;
    Constant constant_3 = Constant {0u, ring_15, (described & 1048576u) != 0u, (described & 2097152u) != 0u};
    metal::uint2 _e21 = context_of(patch_index_4, (described >> 3u) & 7u, 0u);
    uint _e22 = constant_value(constant_3, _e21);
    metal::uint2 _e26 = context_of(patch_index_4, described & 7u, 0u);
    PointRun run_1 = PointRun {0u, 0u, _e22, (described >> 18u) & 3u, _e26, 0u, 1u};
    metal::uint2 _e40 = point_of_run(run_1, (described >> 6u) & 127u);
    return _e40;
}

uint packed_triangle(
    metal::uint3 triangle
) {
    return (triangle.x | (triangle.y << 10u)) | (triangle.z << 20u);
}

uint packed_vertex(
    uint packed,
    uint which
) {
    return (packed >> (10u * which)) & 1023u;
}

metal::uint3 unpacked_triangle(
    uint packed_1,
    uint base_6
) {
    return metal::uint3(base_6) + metal::uint3(packed_1 & 1023u, (packed_1 >> 10u) & 1023u, packed_1 >> 20u);
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

metal::uint2 take_room(
    metal::uint2 counts_1,
    device type_7& catalogue,
    constant _mslBufferSizes& _buffer_sizes
) {
    bool local_11 = {};
    uint _e4 = metal::atomic_fetch_add_explicit(&catalogue[metal::min(unsigned(8192), (_buffer_sizes.size2 - 0 - 4) / 4)], counts_1.x, metal::memory_order_relaxed);
    uint _e8 = metal::atomic_fetch_add_explicit(&catalogue[metal::min(unsigned(8193), (_buffer_sizes.size2 - 0 - 4) / 4)], counts_1.y, metal::memory_order_relaxed);
    if (!(((_e4 + counts_1.x) > CATALOGUE_POINTS))) {
        local_11 = (_e8 + counts_1.y) > CATALOGUE_TRIANGLES;
    } else {
        local_11 = true;
    }
    bool _e21 = local_11;
    if (_e21) {
        return metal::uint2(0u, 0u);
    }
    return metal::uint2(POINTS_AT + (POINT_WORDS * _e4), TRIANGLES_AT + _e8);
}

void keep_point(
    metal::uint2 topology_21,
    uint i_6,
    uint at_2,
    device type_7& catalogue,
    constant _mslBufferSizes& _buffer_sizes
) {
    if (IS_INTEGER) {
        PointRun _e5 = run_at_point(0u, topology_21, i_6);
        metal::uint2 _e7 = point_of_run(_e5, _e5.step);
        metal::uint2 _e9 = format_point(_e7, 0u);
        metal::atomic_store_explicit(&catalogue[metal::min(unsigned(at_2), (_buffer_sizes.size2 - 0 - 4) / 4)], _e9.x, metal::memory_order_relaxed);
        metal::atomic_store_explicit(&catalogue[metal::min(unsigned(at_2 + 1u), (_buffer_sizes.size2 - 0 - 4) / 4)], _e9.y, metal::memory_order_relaxed);
        return;
    } else {
        uint _e20 = described_point(topology_21, i_6);
        metal::atomic_store_explicit(&catalogue[metal::min(unsigned(at_2), (_buffer_sizes.size2 - 0 - 4) / 4)], _e20, metal::memory_order_relaxed);
        return;
    }
}

struct listInput {
};
kernel void list(
  metal::uint3 workgroup [[threadgroup_position_in_grid]]
, uint thread_ [[thread_index_in_threadgroup]]
, device type_5 const& tables [[buffer(1)]]
, constant Job& job [[buffer(0)]]
, device type_7& catalogue [[buffer(2)]]
, threadgroup metal::uint2& places
, constant _mslBufferSizes& _buffer_sizes [[buffer(3)]]
) {
    uint i = {};
    uint t = {};
    uint _e6 = job.max_workgroups;
    uint slot = workgroup.x + (workgroup.y * _e6);
    if (slot >= SLOTS) {
        return;
    }
    uint key_2 = metal::atomic_load_explicit(&catalogue[metal::min(unsigned(slot), (_buffer_sizes.size2 - 0 - 4) / 4)], metal::memory_order_relaxed);
    metal::uint2 _e14 = topology_of(key_2);
    metal::uint2 _e15 = counts(_e14);
    if (thread_ == 0u) {
        places = metal::uint2(0u, 0u);
        if (key_2 != 0u) {
            metal::uint2 _e25 = take_room(_e15, catalogue, _buffer_sizes);
            places = _e25;
        }
        uint _e34 = places.x;
        metal::atomic_store_explicit(&catalogue[metal::min(unsigned(PLACES_AT + (2u * slot)), (_buffer_sizes.size2 - 0 - 4) / 4)], _e34, metal::memory_order_relaxed);
        uint _e45 = places.y;
        metal::atomic_store_explicit(&catalogue[metal::min(unsigned((PLACES_AT + (2u * slot)) + 1u), (_buffer_sizes.size2 - 0 - 4) / 4)], _e45, metal::memory_order_relaxed);
    }
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    if (thread_ == 0u) {
        metal::atomic_store_explicit(&catalogue[metal::min(unsigned(slot), (_buffer_sizes.size2 - 0 - 4) / 4)], 0u, metal::memory_order_relaxed);
    }
    uint _e53 = places.x;
    if (_e53 == 0u) {
        return;
    }
    i = thread_;
    uint2 loop_bound_3 = uint2(4294967295u);
    bool loop_init_3 = true;
    while(true) {
        if (metal::all(loop_bound_3 == uint2(0u))) { break; }
        loop_bound_3 -= uint2(loop_bound_3.y == 0u, 1u);
        if (!loop_init_3) {
            uint _e68 = i;
            i = _e68 + WORKGROUP;
        }
        loop_init_3 = false;
        uint _e57 = i;
        if (_e57 < _e15.x) {
        } else {
            break;
        }
        {
            uint _e60 = i;
            uint _e63 = places.x;
            uint _e65 = i;
            keep_point(_e14, _e60, _e63 + (POINT_WORDS * _e65), catalogue, _buffer_sizes);
        }
    }
    t = thread_;
    uint2 loop_bound_4 = uint2(4294967295u);
    bool loop_init_4 = true;
    while(true) {
        if (metal::all(loop_bound_4 == uint2(0u))) { break; }
        loop_bound_4 -= uint2(loop_bound_4.y == 0u, 1u);
        if (!loop_init_4) {
            uint _e85 = t;
            t = _e85 + WORKGROUP;
        }
        loop_init_4 = false;
        uint _e72 = t;
        if (_e72 < _e15.y) {
        } else {
            break;
        }
        {
            uint _e78 = places.y;
            uint _e79 = t;
            uint _e82 = t;
            metal::uint3 _e83 = triangle_of(_e14, _e82, tables, _buffer_sizes);
            uint _e84 = packed_triangle(_e83);
            metal::atomic_store_explicit(&catalogue[metal::min(unsigned(_e78 + _e79), (_buffer_sizes.size2 - 0 - 4) / 4)], _e84, metal::memory_order_relaxed);
        }
    }
    return;
}
