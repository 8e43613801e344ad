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
struct Round {
    uint first;
    uint count;
    uint begin;
    uint end;
    bool is_listed;
    char _pad5[3];
};
struct type_8 {
    int inner[128];
};
struct type_9 {
    metal::uint2 inner[128];
};
struct Source {
    uint number;
    uint begin;
    uint base;
    bool is_regular;
    char _pad4[3];
    Rings rings;
};
struct Corner {
    uint number;
    uint i;
    uint corner;
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
constant uint SCRATCH = 128u;
constant uint THREADS = 64u;
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
    uint first_4 = metal::max(_e4, _e7);
    uint _e9 = tile_end(end_1, job);
    uint _e12 = job.window_first;
    uint _e15 = job.window_tiles;
    uint last_1 = metal::min(_e9, _e12 + _e15);
    uint number_8 = first_4 + workgroup_1;
    if (!((end_1 <= begin))) {
        local = number_8 >= last_1;
    } else {
        local = true;
    }
    bool _e25 = local;
    if (_e25) {
        return Tile {0u, 0u, 0u, 0u, 0u};
    }
    uint _e34 = job.tile_bits;
    uint base_7 = number_8 << _e34;
    uint at_9 = (table_at + number_8) - _e4;
    uint _e42 = job.tile_bits;
    uint _e48 = tiles[metal::min(unsigned(at_9), (_buffer_sizes.size2 - 0 - 4) / 4)];
    uint _e53 = tiles[metal::min(unsigned(at_9 + 1u), (_buffer_sizes.size2 - 0 - 4) / 4)];
    return Tile {base_7, metal::max(base_7, begin), metal::min(base_7 + (1u << _e42), end_1), _e48, _e53};
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
    uint first_5 = _e3 + (tile.first_patch >> BLOCK_BITS);
    uint _e10 = job.alike_at;
    uint last_2 = _e10 + (tile.last_patch >> BLOCK_BITS);
    metal::uint2 topology_13 = offsets[metal::min(unsigned(first_5), (_buffer_sizes.size0 - 0 - 8) / 8)];
    block = first_5 + 1u;
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
            if (metal::any(_e26 != topology_13)) {
                return metal::uint2(0u, 0u);
            }
        }
    }
    return topology_13;
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
    metal::uint2 size_2 = _e29 - _e25;
    if (size_2[metal::min(unsigned(kind), 1u)] > most) {
        Repeat _e33 = none;
        return _e33;
    }
    return Repeat {_e6, size_2[metal::min(unsigned(kind), 1u)], tile_1.base - _e25[metal::min(unsigned(kind), 1u)], naga_div(2097151u + size_2[metal::min(unsigned(kind), 1u)], size_2[metal::min(unsigned(kind), 1u)]), _e25.x, size_2.x};
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
    uint size_3 = is_high ? (false ? NEVER : size_2_) : begin_1_;
    bool is_odd = low >= size_3;
    return RingLocation {ring_2, (is_high ? 2u : 0u) + (is_odd ? 1u : 0u), low - (is_odd ? size_3 : 0u)};
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

Sector sector_of(
    Rings rings_8,
    uint edge_8
) {
    uint _e2 = along_of(rings_8, edge_8);
    uint regular = (2u * _e2) - 4u;
    uint _e7 = outer_of(rings_8, edge_8);
    uint _e11 = stitch_ring_end(rings_8);
    return Sector {edge_8, (_e7 + _e2) - 4u, _e2, _e11, naga_div(2097151u + regular, regular)};
}

uint sectors_before(
    Rings rings_9,
    uint edge_9
) {
    uint _e2 = stitch_ring_end(rings_9);
    uint _e3 = outer_sum(rings_9, edge_9);
    uint outer_2 = (edge_9 == EDGES) ? (rings_9.boundary + EDGES) : _e3;
    uint _e10 = along_sum(rings_9, edge_9);
    uint along = (edge_9 == EDGES) ? rings_9.along : _e10;
    return ((outer_2 + along) - (4u * edge_9)) + (((_e2 - 2u) * 2u) * (along - (edge_9 * (_e2 + 1u))));
}

uint transition_border(
    Sector sector,
    uint column
) {
    uint first_6 = metal::min(metal::max((8u * column) + 1u, 2u) - 2u, (2u * sector.along) - 4u);
    return ((first_6 * sector.transition) * sector.inverse) >> 21u;
}

uint borders(
    Sector sector_1,
    uint end_4,
    uint column_1
) {
    uint first_7 = (8u * column_1) + 1u;
    uint half_ = (metal::max((2u * sector_1.along) + 1u, first_7) - first_7) >> 1u;
    uint top = metal::max(end_4, 2u);
    uint cut = metal::max(metal::min(metal::min(end_4, (COLUMN * column_1) + 1u), half_), 2u);
    uint complete = metal::clamp(half_, 2u, top);
    return ((cut - 2u) * ((metal::max(first_7, cut + 1u) - cut) - 1u)) + (((top - complete) * 2u) * (((sector_1.along + 1u) - complete) - top));
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
    uint t
) {
    uint _e6 = columns_before(sector_3, column_3 + reach_1);
    return column_3 + ((_e6 <= t) ? reach_1 : 0u);
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
    uint t_1
) {
    bool local_3 = {};
    uint next_2 = ring_5 + reach_2;
    if (next_2 < sector_5.end) {
        uint _e10 = rings_before(sector_5, column_5, next_2);
        local_3 = _e10 <= t_1;
    } else {
        local_3 = false;
    }
    bool is_there = local_3;
    return is_there ? next_2 : ring_5;
}

uint ring_border(
    Sector sector_6,
    uint ring_6,
    uint column_6
) {
    uint first_8 = (8u * column_6) + 1u;
    return metal::min(metal::max(first_8, 2u * ring_6) - (2u * ring_6), 2u * (sector_6.along - (2u * ring_6)));
}

RingLocation location_in_column(
    Sector sector_7,
    uint column_7,
    uint t_2
) {
    uint ring_7 = 2u;
    if (sector_7.end > 10u) {
        uint _e8 = ring_7;
        uint _e10 = nearer_in_column(sector_7, column_7, _e8, 16u, t_2);
        ring_7 = _e10;
        uint _e11 = ring_7;
        uint _e13 = nearer_in_column(sector_7, column_7, _e11, 8u, t_2);
        ring_7 = _e13;
    }
    uint _e14 = ring_7;
    uint _e16 = nearer_in_column(sector_7, column_7, _e14, 4u, t_2);
    ring_7 = _e16;
    uint _e17 = ring_7;
    uint _e19 = nearer_in_column(sector_7, column_7, _e17, 2u, t_2);
    ring_7 = _e19;
    uint _e20 = ring_7;
    uint _e22 = nearer_in_column(sector_7, column_7, _e20, 1u, t_2);
    ring_7 = _e22;
    uint _e23 = ring_7;
    uint _e24 = ring_border(sector_7, _e23, column_7);
    uint _e26 = ring_7;
    uint _e27 = rings_before(sector_7, column_7, _e26);
    uint step = (_e24 + t_2) - _e27;
    uint _e29 = ring_7;
    return RingLocation {_e29, sector_7.edge, step};
}

RingLocation location_in_sector(
    Sector sector_8,
    uint t_3
) {
    uint column_8 = {};
    uint _e4 = nearer_column(sector_8, 0u, 8u, t_3);
    column_8 = _e4;
    uint _e6 = column_8;
    uint _e8 = nearer_column(sector_8, _e6, 4u, t_3);
    column_8 = _e8;
    uint _e9 = column_8;
    uint _e11 = nearer_column(sector_8, _e9, 2u, t_3);
    column_8 = _e11;
    uint _e12 = column_8;
    uint _e14 = nearer_column(sector_8, _e12, 1u, t_3);
    column_8 = _e14;
    uint _e15 = column_8;
    uint _e16 = columns_before(sector_8, _e15);
    uint rest_2 = t_3 - _e16;
    uint _e18 = column_8;
    uint _e19 = transition_border(sector_8, _e18);
    uint _e20 = column_8;
    uint _e23 = transition_border(sector_8, _e20 + 1u);
    uint transition = _e23 - _e19;
    if (rest_2 < transition) {
        return RingLocation {1u, sector_8.edge, _e19 + rest_2};
    }
    uint _e30 = column_8;
    RingLocation _e32 = location_in_column(sector_8, _e30, rest_2 - transition);
    return _e32;
}

RingLocation drawn_location(
    Rings rings_10,
    uint t_4
) {
    uint edge_10 = {};
    uint _e3 = sectors_before(rings_10, EDGES);
    if (t_4 >= _e3) {
        uint _e5 = stitch_ring_end(rings_10);
        return RingLocation {_e5, 0u, t_4 - _e3};
    }
    uint _e12 = sectors_before(rings_10, 1u);
    edge_10 = (t_4 >= _e12) ? 1u : 0u;
    uint _e16 = edge_10;
    uint _e19 = sectors_before(rings_10, 2u);
    edge_10 = (t_4 >= _e19) ? 2u : _e16;
    if (true) {
        uint _e23 = edge_10;
        uint _e26 = sectors_before(rings_10, 3u);
        edge_10 = (t_4 >= _e26) ? 3u : _e23;
    }
    uint _e29 = edge_10;
    Sector _e30 = sector_of(rings_10, _e29);
    uint _e31 = edge_10;
    uint _e32 = sectors_before(rings_10, _e31);
    RingLocation _e34 = location_in_sector(_e30, t_4 - _e32);
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
    bool local_4 = {};
    uint _e3 = stitch_ring_end(rings_11);
    if (location_1.ring == _e3) {
        return RingLocation {4294967295u, 0u, 0u};
    }
    Sector _e10 = sector_of(rings_11, location_1.edge);
    uint step_1 = location_1.step + 1u;
    column_10 = naga_div((location_1.step + (2u * location_1.ring)) - 1u, 8u);
    if (location_1.ring == 1u) {
        column_10 = naga_div(naga_div((step_1 * ((2u * _e10.along) - 4u)) - 1u, _e10.transition) + 1u, 8u);
    }
    uint _e42 = column_10;
    uint _e45 = border(_e10, location_1.ring, _e42 + 1u);
    if (step_1 < _e45) {
        return RingLocation {location_1.ring, location_1.edge, step_1};
    }
    uint ring_10 = location_1.ring + 1u;
    uint _e53 = column_10;
    uint _e54 = ring_border(_e10, ring_10, _e53);
    if (ring_10 < _e10.end) {
        uint _e59 = column_10;
        uint _e62 = ring_border(_e10, ring_10, _e59 + 1u);
        local_4 = _e54 < _e62;
    } else {
        local_4 = false;
    }
    bool is_there_1 = local_4;
    return RingLocation {is_there_1 ? ring_10 : NEVER, location_1.edge, _e54};
}

uint outer_vertex(
    Stitch stitch,
    uint at_1
) {
    return (at_1 >= stitch.outer_turn) ? (stitch.outer_mirror - at_1) : at_1;
}

uint inner_vertex(
    Stitch stitch_1,
    uint at_2
) {
    return (at_2 >= stitch_1.inner_turn) ? (stitch_1.inner_mirror - at_2) : at_2;
}

metal::uint3 oriented(
    uint a,
    uint b,
    uint c,
    bool begins_inner
) {
    uint first_9 = begins_inner ? b : a;
    uint second_2 = begins_inner ? a : c;
    uint third = begins_inner ? c : b;
    if (false) {
        return metal::uint3(first_9, third, second_2);
    }
    return metal::uint3(first_9, second_2, third);
}

Pair stitch_triangles(
    Stitch stitch_2,
    uint number,
    device type_3 const& tables,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint a_1 = {};
    uint b_1 = {};
    uint c_1 = {};
    uint d = {};
    uint steps = tables[metal::min(unsigned(stitch_2.steps_at + number), (_buffer_sizes.size4 - 0 - 4) / 4)];
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
    uint t_5
) {
    uint transitions = (rings_12.boundary + rings_12.along) - 12u;
    if (t_5 < transitions) {
        uint _e20 = outer_of(rings_12, 2u);
        RingLocation _e25 = location_on_edges(1u, t_5, (rings_12.before_1_ + rings_12.v) - 4u, (rings_12.before_2_ + rings_12.sides) - 8u, (_e20 + rings_12.v) - 4u);
        return _e25;
    }
    uint _e26 = stitch_ring_end(rings_12);
    uint end_6 = _e26 - 2u;
    uint form_2 = (2u * rings_12.along) - 24u;
    uint _e36 = last_before(t_5 - transitions, end_6, form_2, 8u);
    uint rest_3 = (t_5 - transitions) - (_e36 * (form_2 - (8u * _e36)));
    if (_e36 == end_6) {
        return RingLocation {_e36 + 2u, 0u, rest_3};
    }
    RingLocation _e66 = location_on_ring(_e36 + 2u, rest_3, (2u * rings_12.v) - (4u * (_e36 + 2u)), (2u * rings_12.u) - (4u * (_e36 + 2u)));
    return _e66;
}

RingLocation triangle_location(
    Rings rings_13,
    uint t_6
) {
    if (false) {
        RingLocation _e3 = drawn_location(rings_13, t_6);
        return _e3;
    }
    RingLocation _e4 = specified_location(rings_13, t_6);
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
    uint outer,
    uint inner
) {
    uint _e4 = steps_of(number_2);
    return Stitch {size, _e4, outer, inner, false, {}, 0u, 0u, 0u, 0u};
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
    uint edge_11,
    uint size_1,
    uint number_3,
    uint outer_ring,
    uint outer_1,
    uint inner_ring,
    uint inner_1
) {
    bool local_5 = {};
    uint _e9 = ring_points(rings_14, ring_9);
    bool walks_back = rings_14.short_ == ((2u * ring_9) + 1u);
    uint _e16 = steps_of(number_3);
    if (!((edge_11 == 3u))) {
        local_5 = walks_back;
    } else {
        local_5 = true;
    }
    bool _e23 = local_5;
    return Stitch {size_1, _e16, outer_1, inner_1, _e23, {}, inner_ring, inner_ring + outer_ring, inner_ring + (walks_back ? (_e9 >> 1u) : _e9), (2u * inner_ring) + _e9};
}

Stitch transition_stitch(
    Rings rings_15,
    uint edge_12,
    uint base_1
) {
    uint _e3 = outer_of(rings_15, edge_12);
    uint _e4 = along_of(rings_15, edge_12);
    uint inner_points = _e4 - 2u;
    uint ring_11 = base_1 + rings_15.boundary;
    uint _e18 = outer_sum(rings_15, edge_12);
    uint _e21 = along_sum(rings_15, edge_12);
    Stitch _e26 = rows(rings_15, 1u, edge_12, (_e3 + inner_points) - 2u, ((TRANSITION_STRIDE * _e3) + inner_points) - 128u, base_1, (base_1 + _e18) - edge_12, ring_11, (ring_11 + _e21) - (3u * edge_12));
    return _e26;
}

Stitch centre_stitch(
    Rings rings_16,
    uint base_2
) {
    bool local_6 = {};
    uint _e2 = stitch_ring_end(rings_16);
    uint _e5 = first_of_ring(rings_16, _e2 - 1u);
    uint first_10 = base_2 + _e5;
    if (false) {
        Stitch _e12 = straight(1u, FAN_STITCH, first_10, first_10 + 2u);
        return _e12;
    }
    uint quads = (metal::max(rings_16.u, rings_16.v) - rings_16.short_) + 1u;
    uint along_u = (rings_16.u > rings_16.v) ? 1u : 0u;
    if (rings_16.u <= rings_16.v) {
        local_6 = (rings_16.v & 1u) == 0u;
    } else {
        local_6 = false;
    }
    bool is_mirrored = local_6;
    uint _e44 = steps_of(is_mirrored ? (MIRRORED_STRIP + quads) : PLAIN_STRIP);
    return Stitch {2u * quads, _e44, first_10 + along_u, first_10, true, {}, NEVER, 0u, first_10 + along_u, (((2u * first_10) + (2u * quads)) + 1u) + along_u};
}

Stitch ring_stitch(
    Rings rings_17,
    RingLocation location_2,
    uint base_3
) {
    uint ring_12 = location_2.ring;
    uint _e5 = along_of(rings_17, location_2.edge);
    uint inner_points_1 = _e5 - (2u * ring_12);
    uint _e9 = first_of_ring(rings_17, ring_12);
    uint inner_ring_1 = base_3 + _e9;
    uint _e13 = ring_points(rings_17, ring_12 - 1u);
    uint outer_ring_1 = inner_ring_1 - _e13;
    uint _e16 = along_sum(rings_17, location_2.edge);
    uint skip = _e16 - ((2u * ring_12) * location_2.edge);
    Stitch _e33 = rows(rings_17, ring_12, location_2.edge, 2u * inner_points_1, RING_STITCH + inner_points_1, outer_ring_1, (outer_ring_1 + skip) + location_2.edge, inner_ring_1, (inner_ring_1 + skip) - location_2.edge);
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
    metal::uint2 topology_10,
    uint t_7,
    device type_3 const& tables,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint _e2 = state_of(topology_10);
    if (_e2 == MINIMUM) {
        Stitch _e6 = minimum_stitch(0u);
        Pair _e7 = stitch_triangles(_e6, t_7, tables, _buffer_sizes);
        return _e7.first;
    }
    Rings _e9 = rings_of(topology_10);
    RingLocation _e10 = triangle_location(_e9, t_7);
    Stitch _e12 = stitch_at(_e9, _e10, 0u);
    Pair _e14 = stitch_triangles(_e12, _e10.step, tables, _buffer_sizes);
    return _e14.first;
}

uint sequence_first(
    metal::uint2 topology_11,
    uint t_8,
    uint base_5
) {
    bool local_7 = {};
    if (false) {
        local_7 = true;
    } else {
        local_7 = false;
    }
    bool _e8 = local_7;
    if (_e8) {
        uint _e11 = outer_points(topology_11, 1u);
        return (base_5 + t_8) + naga_div(t_8, _e11 - 1u);
    }
    return base_5 + t_8;
}

uint tile_size(
) {
    return TILE;
}

uint place_of(
    uint patch_index_1,
    metal::uint2 topology_12,
    uint kind_1,
    device type_2 const& offsets,
    constant Job& job,
    device type_3 const& catalogue,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint slot = {};
    uint _e3 = listed_slot(topology_12);
    slot = _e3;
    uint _e5 = slot;
    if (_e5 == 0u) {
        uint _e11 = job.alike_at;
        metal::uint2 _e16 = offsets[metal::min(unsigned(_e11 + (patch_index_1 >> BLOCK_BITS)), (_buffer_sizes.size0 - 0 - 8) / 8)];
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
    uint i,
    uint patch_index_2,
    Tile tile_2,
    uint kind_2,
    device type_2 const& offsets,
    constant Job& job,
    device type_3 const& catalogue,
    threadgroup type_8& begins,
    threadgroup type_9& scratch,
    threadgroup type_9& listed,
    threadgroup metal::atomic_uint& is_missing,
    device type_2 const& topologies,
    constant _mslBufferSizes& _buffer_sizes
) {
    bool local_8 = {};
    metal::uint2 topology_14 = topologies[metal::min(unsigned(patch_index_2), (_buffer_sizes.size9 - 0 - 8) / 8)];
    metal::uint2 _e7 = patch_offset(patch_index_2, offsets, job, _buffer_sizes);
    uint begin_1 = _e7[metal::min(unsigned(kind_2), 1u)] - tile_2.base;
    begins.inner[metal::min(unsigned(i), 127u)] = static_cast<int>(begin_1);
    scratch.inner[metal::min(unsigned(i), 127u)] = topology_14;
    uint _e16 = place_of(patch_index_2, topology_14, kind_2, offsets, job, catalogue, _buffer_sizes);
    uint words = (kind_2 == POINTS) ? POINT_WORDS : 1u;
    listed.inner[metal::min(unsigned(i), 127u)] = metal::uint2(_e16 - (words * begin_1), true ? _e7.x : 0u);
    if (_e16 == 0u) {
        uint _e35 = state_of(topology_14);
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
    threadgroup type_8& begins,
    threadgroup type_9& scratch,
    threadgroup type_9& listed,
    threadgroup metal::atomic_uint& is_missing,
    device type_2 const& topologies,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint i_1 = {};
    uint end_5 = {};
    uint count = metal::min(ROUND, (tile_3.last_patch - first) + 1u);
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    if (thread_1 == 0u) {
        metal::atomic_store_explicit(&is_missing, 0u, metal::memory_order_relaxed);
    }
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    i_1 = thread_1;
    uint2 loop_bound_1 = uint2(4294967295u);
    bool loop_init_1 = true;
    while(true) {
        if (metal::all(loop_bound_1 == uint2(0u))) { break; }
        loop_bound_1 -= uint2(loop_bound_1.y == 0u, 1u);
        if (!loop_init_1) {
            uint _e20 = i_1;
            i_1 = _e20 + THREADS;
        }
        loop_init_1 = false;
        uint _e15 = i_1;
        if (_e15 < count) {
        } else {
            break;
        }
        {
            uint _e17 = i_1;
            uint _e18 = i_1;
            load_patch(_e17, first + _e18, tile_3, kind_3, offsets, job, catalogue, begins, scratch, listed, is_missing, topologies, _buffer_sizes);
        }
    }
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    int _e25 = begins.inner[0];
    uint begin_2 = static_cast<uint>(metal::max(_e25, static_cast<int>(tile_3.begin - tile_3.base)));
    end_5 = tile_3.end - tile_3.base;
    if ((first + count) <= tile_3.last_patch) {
        metal::uint2 _e40 = patch_offset(first + count, offsets, job, _buffer_sizes);
        end_5 = _e40[metal::min(unsigned(kind_3), 1u)] - tile_3.base;
    }
    uint _e44 = end_5;
    uint _e46 = metal::atomic_load_explicit(&is_missing, metal::memory_order_relaxed);
    return Round {first, count, begin_2, _e44, _e46 == 0u};
}

uint nearer_patch(
    uint found,
    uint reach_3,
    uint last,
    uint element_1,
    threadgroup type_8& begins
) {
    uint next_3 = metal::min(found + reach_3, last);
    int _e8 = begins.inner[metal::min(unsigned(next_3), 127u)];
    return (_e8 <= static_cast<int>(element_1)) ? next_3 : found;
}

uint find_patch(
    Round round,
    uint element_2,
    threadgroup type_8& begins
) {
    uint found_1 = 0u;
    if (round.count == 1u) {
        uint _e7 = found_1;
        return _e7;
    }
    uint last_3 = round.count - 1u;
    if (round.count > 32u) {
        uint _e14 = found_1;
        uint _e16 = nearer_patch(_e14, 64u, last_3, element_2, begins);
        found_1 = _e16;
        uint _e17 = found_1;
        uint _e19 = nearer_patch(_e17, 32u, last_3, element_2, begins);
        found_1 = _e19;
    }
    if (round.count > 8u) {
        uint _e23 = found_1;
        uint _e25 = nearer_patch(_e23, 16u, last_3, element_2, begins);
        found_1 = _e25;
        uint _e26 = found_1;
        uint _e28 = nearer_patch(_e26, 8u, last_3, element_2, begins);
        found_1 = _e28;
    }
    if (round.count > 4u) {
        uint _e32 = found_1;
        uint _e34 = nearer_patch(_e32, 4u, last_3, element_2, begins);
        found_1 = _e34;
    }
    uint _e35 = found_1;
    uint _e37 = nearer_patch(_e35, 2u, last_3, element_2, begins);
    found_1 = _e37;
    uint _e38 = found_1;
    uint _e40 = nearer_patch(_e38, 1u, last_3, element_2, begins);
    return _e40;
}

uint next_patch(
    Round round_1,
    uint number_4,
    uint element_3,
    threadgroup type_8& begins
) {
    uint found_2 = {};
    bool local_9 = {};
    found_2 = number_4;
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

void write_triangle_pair(
    uint at_3,
    metal::uint3 first_1,
    metal::uint3 second,
    device type_2& indices_out,
    constant _mslBufferSizes& _buffer_sizes
) {
    indices_out[metal::min(unsigned(3u * at_3), (_buffer_sizes.size10 - 0 - 8) / 8)] = first_1.xy;
    indices_out[metal::min(unsigned((3u * at_3) + 1u), (_buffer_sizes.size10 - 0 - 8) / 8)] = metal::uint2(first_1.z, second.x);
    indices_out[metal::min(unsigned((3u * at_3) + 2u), (_buffer_sizes.size10 - 0 - 8) / 8)] = second.yz;
    return;
}

void write_triangle(
    uint at_4,
    bool is_second,
    metal::uint3 triangle,
    device type_2& indices_out,
    constant _mslBufferSizes& _buffer_sizes
) {
    if (is_second) {
        indices_out[metal::min(unsigned((3u * at_4) + 1u), (_buffer_sizes.size10 - 0 - 8) / 8)].y = triangle.x;
        indices_out[metal::min(unsigned((3u * at_4) + 2u), (_buffer_sizes.size10 - 0 - 8) / 8)] = triangle.yz;
        return;
    } else {
        indices_out[metal::min(unsigned(3u * at_4), (_buffer_sizes.size10 - 0 - 8) / 8)] = triangle.xy;
        indices_out[metal::min(unsigned((3u * at_4) + 1u), (_buffer_sizes.size10 - 0 - 8) / 8)].x = triangle.z;
        return;
    }
}

void write_two(
    uint at_5,
    uint first_2,
    uint second_1,
    device type_2& indices_out,
    constant _mslBufferSizes& _buffer_sizes
) {
    indices_out[metal::min(unsigned(at_5), (_buffer_sizes.size10 - 0 - 8) / 8)] = metal::uint2(first_2, second_1);
    return;
}

void write_single(
    uint at_6,
    uint index,
    device type_2& indices_out,
    constant _mslBufferSizes& _buffer_sizes
) {
    if ((at_6 & 1u) == 0u) {
        indices_out[metal::min(unsigned(at_6 >> 1u), (_buffer_sizes.size10 - 0 - 8) / 8)].x = index;
        return;
    } else {
        indices_out[metal::min(unsigned(at_6 >> 1u), (_buffer_sizes.size10 - 0 - 8) / 8)].y = index;
        return;
    }
}

uint packed_triangle(
    metal::uint3 triangle_1
) {
    return (triangle_1.x | (triangle_1.y << 10u)) | (triangle_1.z << 20u);
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

Source load_source(
    Round round_2,
    uint number_5,
    device type_2 const& offsets,
    constant Job& job,
    threadgroup type_8& begins,
    threadgroup type_9& scratch,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint patch_index_3 = round_2.first + number_5;
    metal::uint2 topology_15 = scratch.inner[metal::min(unsigned(number_5), 127u)];
    metal::uint2 _e8 = patch_offset(patch_index_3, offsets, job, _buffer_sizes);
    uint base_8 = true ? _e8.x : 0u;
    int _e14 = begins.inner[metal::min(unsigned(number_5), 127u)];
    uint _e16 = state_of(topology_15);
    Rings _e19 = rings_of(topology_15);
    return Source {number_5, static_cast<uint>(_e14), base_8, _e16 == REGULAR, {}, _e19};
}

RingLocation location_of(
    Source source,
    uint t_9
) {
    if (source.is_regular) {
        RingLocation _e4 = triangle_location(source.rings, t_9);
        return _e4;
    }
    return RingLocation {1u, 0u, t_9};
}

Stitch stitch_from(
    Source source_1,
    RingLocation location_4
) {
    if (!(source_1.is_regular)) {
        Stitch _e5 = minimum_stitch(source_1.base);
        return _e5;
    }
    Stitch _e8 = stitch_at(source_1.rings, location_4, source_1.base);
    return _e8;
}

RingLocation drawn_next(
    Source source_2,
    RingLocation location_5,
    uint element_4
) {
    if (source_2.is_regular) {
        RingLocation _e5 = drawn_behind(source_2.rings, location_5);
        if (_e5.ring != NEVER) {
            return _e5;
        }
    }
    RingLocation _e11 = location_of(source_2, element_4 - source_2.begin);
    return _e11;
}

metal::uint3 first_triangle(
    Round round_3,
    Source before,
    RingLocation location_6,
    uint element_5,
    device type_2 const& offsets,
    constant Job& job,
    device type_3 const& tables,
    threadgroup type_8& begins,
    threadgroup type_9& scratch,
    constant _mslBufferSizes& _buffer_sizes
) {
    Source source_3 = {};
    RingLocation next = RingLocation {1u, 0u, 0u};
    source_3 = before;
    uint _e11 = next_patch(round_3, before.number, element_5, begins);
    if (_e11 != before.number) {
        Source _e14 = load_source(round_3, _e11, offsets, job, begins, scratch, _buffer_sizes);
        source_3 = _e14;
    } else {
        if (true) {
            RingLocation _e16 = next_edge(location_6);
            next = _e16;
        } else {
            Source _e17 = source_3;
            RingLocation _e18 = drawn_next(_e17, location_6, element_5);
            next = _e18;
        }
    }
    Source _e19 = source_3;
    RingLocation _e20 = next;
    Stitch _e21 = stitch_from(_e19, _e20);
    uint _e23 = next.step;
    Pair _e24 = stitch_triangles(_e21, _e23, tables, _buffer_sizes);
    return _e24.first;
}

void write_triangles(
    Round round_4,
    uint thread_2,
    uint out,
    device type_2 const& offsets,
    constant Job& job,
    device type_3 const& tables,
    threadgroup type_8& begins,
    threadgroup type_9& scratch,
    device type_2& indices_out,
    constant _mslBufferSizes& _buffer_sizes
) {
    Source source_4 = {};
    uint element_6 = {};
    bool local_10 = {};
    bool local_11 = {};
    bool local_12 = {};
    bool local_13 = {};
    source_4.number = NEVER;
    element_6 = 2u * thread_2;
    uint2 loop_bound_3 = uint2(4294967295u);
    bool loop_init_2 = true;
    while(true) {
        if (metal::all(loop_bound_3 == uint2(0u))) { break; }
        loop_bound_3 -= uint2(loop_bound_3.y == 0u, 1u);
        if (!loop_init_2) {
            uint _e82 = element_6;
            element_6 = _e82 + 128u;
        }
        loop_init_2 = false;
        uint _e9 = element_6;
        uint _e10 = tile_size();
        if (_e9 < _e10) {
        } else {
            break;
        }
        {
            uint _e12 = element_6;
            if (!(((_e12 + 1u) < round_4.begin))) {
                uint _e20 = element_6;
                local_10 = _e20 >= round_4.end;
            } else {
                local_10 = true;
            }
            bool _e24 = local_10;
            if (_e24) {
                continue;
            }
            uint _e25 = element_6;
            uint first_11 = metal::max(_e25, round_4.begin);
            uint _e28 = find_patch(round_4, first_11, begins);
            uint _e30 = source_4.number;
            if (_e28 != _e30) {
                Source _e32 = load_source(round_4, _e28, offsets, job, begins, scratch, _buffer_sizes);
                source_4 = _e32;
            }
            Source _e33 = source_4;
            uint _e35 = source_4.begin;
            RingLocation _e37 = location_of(_e33, first_11 - _e35);
            Source _e38 = source_4;
            Stitch _e39 = stitch_from(_e38, _e37);
            Pair _e41 = stitch_triangles(_e39, _e37.step, tables, _buffer_sizes);
            uint _e42 = element_6;
            uint at_10 = (out + _e42) >> 1u;
            uint _e46 = element_6;
            if (first_11 == _e46) {
                uint _e50 = element_6;
                local_11 = (_e50 + 1u) < round_4.end;
            } else {
                local_11 = false;
            }
            bool is_whole = local_11;
            if (is_whole) {
                local_12 = true;
            } else {
                local_12 = false;
            }
            bool _e61 = local_12;
            if (_e61) {
                local_13 = (_e37.step + 1u) < _e39.size;
            } else {
                local_13 = false;
            }
            bool _e70 = local_13;
            if (_e70) {
                write_triangle_pair(at_10, _e41.first, _e41.second, indices_out, _buffer_sizes);
            } else {
                uint _e73 = element_6;
                write_triangle(at_10, first_11 != _e73, _e41.first, indices_out, _buffer_sizes);
                if (is_whole) {
                    Source _e77 = source_4;
                    uint _e78 = element_6;
                    metal::uint3 _e81 = first_triangle(round_4, _e77, _e37, _e78 + 1u, offsets, job, tables, begins, scratch, _buffer_sizes);
                    write_triangle(at_10, true, _e81, indices_out, _buffer_sizes);
                }
            }
        }
    }
    return;
}

metal::uint3 listed_triangle(
    uint number_6,
    uint element_7,
    device type_3 const& catalogue,
    threadgroup type_9& listed,
    constant _mslBufferSizes& _buffer_sizes
) {
    metal::uint2 own = listed.inner[metal::min(unsigned(number_6), 127u)];
    uint _e7 = catalogue_word(own.x + element_7, catalogue, _buffer_sizes);
    metal::uint3 _e9 = unpacked_triangle(_e7, own.y);
    return _e9;
}

void write_listed_triangles(
    Round round_5,
    uint thread_3,
    uint out_1,
    device type_3 const& catalogue,
    threadgroup type_8& begins,
    threadgroup type_9& listed,
    device type_2& indices_out,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint element_8 = {};
    bool local_14 = {};
    bool local_15 = {};
    element_8 = 2u * thread_3;
    uint2 loop_bound_4 = uint2(4294967295u);
    bool loop_init_3 = true;
    while(true) {
        if (metal::all(loop_bound_4 == uint2(0u))) { break; }
        loop_bound_4 -= uint2(loop_bound_4.y == 0u, 1u);
        if (!loop_init_3) {
            uint _e52 = element_8;
            element_8 = _e52 + 128u;
        }
        loop_init_3 = false;
        uint _e6 = element_8;
        uint _e7 = tile_size();
        if (_e6 < _e7) {
        } else {
            break;
        }
        {
            uint _e9 = element_8;
            if (!(((_e9 + 1u) < round_5.begin))) {
                uint _e17 = element_8;
                local_14 = _e17 >= round_5.end;
            } else {
                local_14 = true;
            }
            bool _e21 = local_14;
            if (_e21) {
                continue;
            }
            uint _e22 = element_8;
            uint first_12 = metal::max(_e22, round_5.begin);
            uint _e25 = find_patch(round_5, first_12, begins);
            metal::uint3 _e26 = listed_triangle(_e25, first_12, catalogue, listed, _buffer_sizes);
            uint _e27 = element_8;
            uint at_11 = (out_1 + _e27) >> 1u;
            uint _e31 = element_8;
            if (first_12 == _e31) {
                uint _e35 = element_8;
                local_15 = (_e35 + 1u) < round_5.end;
            } else {
                local_15 = false;
            }
            bool _e41 = local_15;
            if (_e41) {
                uint _e42 = element_8;
                uint _e45 = next_patch(round_5, _e25, _e42 + 1u, begins);
                uint _e46 = element_8;
                metal::uint3 _e49 = listed_triangle(_e45, _e46 + 1u, catalogue, listed, _buffer_sizes);
                write_triangle_pair(at_11, _e26, _e49, indices_out, _buffer_sizes);
            } else {
                uint _e50 = element_8;
                write_triangle(at_11, first_12 != _e50, _e26, indices_out, _buffer_sizes);
            }
        }
    }
    return;
}

void write_sequences(
    Round round_6,
    uint thread_4,
    uint out_2,
    device type_2 const& offsets,
    constant Job& job,
    threadgroup type_8& begins,
    threadgroup type_9& scratch,
    device type_2& indices_out,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint pair = {};
    uint element_9 = {};
    bool local_16 = {};
    pair = 2u * thread_4;
    uint2 loop_bound_5 = uint2(4294967295u);
    bool loop_init_4 = true;
    while(true) {
        if (metal::all(loop_bound_5 == uint2(0u))) { break; }
        loop_bound_5 -= uint2(loop_bound_5.y == 0u, 1u);
        if (!loop_init_4) {
            uint _e56 = pair;
            pair = _e56 + 128u;
        }
        loop_init_4 = false;
        uint _e6 = pair;
        uint _e7 = tile_size();
        if (_e6 < _e7) {
        } else {
            break;
        }
        {
            uint _e9 = pair;
            element_9 = _e9;
            uint2 loop_bound_6 = uint2(4294967295u);
            bool loop_init_5 = true;
            while(true) {
                if (metal::all(loop_bound_6 == uint2(0u))) { break; }
                loop_bound_6 -= uint2(loop_bound_6.y == 0u, 1u);
                if (!loop_init_5) {
                    uint _e54 = element_9;
                    element_9 = _e54 + 1u;
                }
                loop_init_5 = false;
                uint _e11 = element_9;
                uint _e12 = pair;
                if (_e11 < (_e12 + 2u)) {
                } else {
                    break;
                }
                {
                    uint _e16 = element_9;
                    if (!((_e16 < round_6.begin))) {
                        uint _e22 = element_9;
                        local_16 = _e22 >= round_6.end;
                    } else {
                        local_16 = true;
                    }
                    bool _e26 = local_16;
                    if (_e26) {
                        continue;
                    }
                    uint _e27 = element_9;
                    uint _e28 = find_patch(round_6, _e27, begins);
                    metal::uint2 _e32 = patch_offset(round_6.first + _e28, offsets, job, _buffer_sizes);
                    uint base_9 = true ? _e32.x : 0u;
                    uint _e36 = element_9;
                    int _e39 = begins.inner[metal::min(unsigned(_e28), 127u)];
                    uint t_10 = _e36 - static_cast<uint>(_e39);
                    metal::uint2 _e44 = scratch.inner[metal::min(unsigned(_e28), 127u)];
                    uint _e45 = sequence_first(_e44, t_10, base_9);
                    if (false) {
                        uint _e47 = element_9;
                        write_two(out_2 + _e47, _e45, _e45 + 1u, indices_out, _buffer_sizes);
                    } else {
                        uint _e51 = element_9;
                        write_single(out_2 + _e51, _e45, indices_out, _buffer_sizes);
                    }
                }
            }
        }
    }
    return;
}

void keep_triangles(
    Repeat repeat_1,
    uint thread_5,
    device type_3 const& tables,
    threadgroup type_9& scratch,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint i_2 = {};
    uint _e3 = state_of(repeat_1.topology);
    bool is_regular = _e3 == REGULAR;
    Rings _e10 = rings_of(repeat_1.topology);
    Source source_5 = Source {0u, 0u, 0u, is_regular, {}, _e10};
    i_2 = thread_5;
    uint2 loop_bound_7 = uint2(4294967295u);
    bool loop_init_6 = true;
    while(true) {
        if (metal::all(loop_bound_7 == uint2(0u))) { break; }
        loop_bound_7 -= uint2(loop_bound_7.y == 0u, 1u);
        if (!loop_init_6) {
            uint _e36 = i_2;
            i_2 = _e36 + THREADS;
        }
        loop_init_6 = false;
        uint _e13 = i_2;
        if (_e13 < repeat_1.size) {
        } else {
            break;
        }
        {
            uint _e16 = i_2;
            RingLocation _e17 = location_of(source_5, _e16);
            Stitch _e18 = stitch_from(source_5, _e17);
            Pair _e20 = stitch_triangles(_e18, _e17.step, tables, _buffer_sizes);
            metal::uint3 triangle_2 = _e20.first;
            uint _e22 = packed_triangle(triangle_2);
            uint _e23 = i_2;
            if (_e23 < SCRATCH) {
                uint _e27 = i_2;
                scratch.inner[metal::min(unsigned(_e27), 127u)].x = _e22;
            } else {
                uint _e31 = i_2;
                scratch.inner[metal::min(unsigned(_e31 - SCRATCH), 127u)].y = _e22;
            }
        }
    }
    return;
}

Corner corner_at(
    Repeat repeat_2,
    uint at_7
) {
    uint element_10 = (at_7 * 43691u) >> 17u;
    uint position_1 = element_10 + repeat_2.before;
    uint _e8 = patch_at(repeat_2, position_1);
    return Corner {_e8, position_1 - (_e8 * repeat_2.size), at_7 - (3u * element_10)};
}

Corner next_corner(
    Repeat repeat_3,
    Corner it
) {
    bool local_17 = {};
    bool is_last_corner = it.corner == 2u;
    if (is_last_corner) {
        local_17 = (it.i + 1u) == repeat_3.size;
    } else {
        local_17 = false;
    }
    bool is_last_1 = local_17;
    return Corner {it.number + (is_last_1 ? 1u : 0u), is_last_1 ? 0u : (it.i + (is_last_corner ? 1u : 0u)), is_last_corner ? 0u : (it.corner + 1u)};
}

uint kept_index(
    Repeat repeat_4,
    Corner it_1,
    threadgroup type_9& scratch
) {
    bool is_low = it_1.i < SCRATCH;
    metal::uint2 two = scratch.inner[metal::min(unsigned(is_low ? it_1.i : (it_1.i - SCRATCH)), 127u)];
    uint _e17 = packed_vertex(is_low ? two.x : two.y, it_1.corner);
    return _e17 + (true ? (repeat_4.base + (it_1.number * repeat_4.points)) : 0u);
}

void copy_triangles(
    Tile tile_4,
    Repeat repeat_5,
    uint thread_6,
    uint out_3,
    device type_3 const& tables,
    threadgroup type_9& scratch,
    device type_2& indices_out,
    constant _mslBufferSizes& _buffer_sizes
) {
    uint at_8 = {};
    bool local_18 = {};
    keep_triangles(repeat_5, thread_6, tables, scratch, _buffer_sizes);
    metal::threadgroup_barrier(metal::mem_flags::mem_threadgroup);
    uint begin_3 = 3u * (tile_4.begin - tile_4.base);
    uint end_7 = 3u * (tile_4.end - tile_4.base);
    at_8 = 2u * thread_6;
    uint2 loop_bound_8 = uint2(4294967295u);
    bool loop_init_7 = true;
    while(true) {
        if (metal::all(loop_bound_8 == uint2(0u))) { break; }
        loop_bound_8 -= uint2(loop_bound_8.y == 0u, 1u);
        if (!loop_init_7) {
            uint _e48 = at_8;
            at_8 = _e48 + 128u;
        }
        loop_init_7 = false;
        uint _e17 = at_8;
        if (_e17 < end_7) {
        } else {
            break;
        }
        {
            uint _e19 = at_8;
            if ((_e19 + 1u) < begin_3) {
                continue;
            }
            uint _e23 = at_8;
            uint first_13 = metal::max(_e23, begin_3);
            Corner _e25 = corner_at(repeat_5, first_13);
            uint _e26 = kept_index(repeat_5, _e25, scratch);
            uint _e27 = at_8;
            if (first_13 == _e27) {
                uint _e31 = at_8;
                local_18 = (_e31 + 1u) < end_7;
            } else {
                local_18 = false;
            }
            bool _e36 = local_18;
            if (_e36) {
                Corner _e37 = next_corner(repeat_5, _e25);
                uint _e38 = kept_index(repeat_5, _e37, scratch);
                uint _e41 = at_8;
                write_two(((3u * out_3) + _e41) >> 1u, _e26, _e38, indices_out, _buffer_sizes);
            } else {
                write_single((3u * out_3) + first_13, _e26, indices_out, _buffer_sizes);
            }
        }
    }
    return;
}

void write_primitive_tile(
    uint number_7,
    uint thread_7,
    device type_2 const& offsets,
    constant Job& job,
    device type_3 const& tiles,
    device type_3 const& catalogue,
    device type_3 const& tables,
    threadgroup type_8& begins,
    threadgroup type_9& scratch,
    threadgroup type_9& listed,
    threadgroup metal::atomic_uint& is_missing,
    device type_2 const& topologies,
    device type_2& indices_out,
    device Status const& status,
    constant _mslBufferSizes& _buffer_sizes
) {
    bool local_19 = {};
    uint first_3 = {};
    bool local_20 = {};
    uint _e6 = job.portion;
    Range range = status.ranges[metal::min(unsigned(_e6), (_buffer_sizes.size11 - 32 - 16) / 16)];
    uint _e13 = job.primitive_tiles_at;
    Tile _e14 = tile_of(number_7, range.primitives_begin, range.primitives_end, _e13, job, tiles, _buffer_sizes);
    if (!((_e14.end == 0u))) {
        uint _e23 = status.overflow;
        local_19 = _e23 != 0u;
    } else {
        local_19 = true;
    }
    bool _e27 = local_19;
    if (_e27) {
        return;
    }
    uint _e31 = job.window_first;
    uint _e34 = job.tile_bits;
    uint out_4 = _e14.base - (_e31 << _e34);
    if (IS_TRIANGLES) {
        Repeat _e40 = repeat_of(_e14, PRIMITIVES, 256u, offsets, job, _buffer_sizes);
        if (_e40.size > 0u) {
            copy_triangles(_e14, _e40, thread_7, out_4, tables, scratch, indices_out, _buffer_sizes);
            return;
        }
    }
    first_3 = _e14.first_patch;
    uint2 loop_bound_9 = uint2(4294967295u);
    bool loop_init_8 = true;
    while(true) {
        if (metal::all(loop_bound_9 == uint2(0u))) { break; }
        loop_bound_9 -= uint2(loop_bound_9.y == 0u, 1u);
        if (!loop_init_8) {
            uint _e59 = first_3;
            first_3 = _e59 + ROUND;
        }
        loop_init_8 = false;
        uint _e46 = first_3;
        if (_e46 <= _e14.last_patch) {
        } else {
            break;
        }
        {
            uint _e49 = first_3;
            Round _e51 = load_round(_e14, _e49, PRIMITIVES, thread_7, offsets, job, catalogue, begins, scratch, listed, is_missing, topologies, _buffer_sizes);
            if (IS_TRIANGLES) {
                local_20 = _e51.is_listed;
            } else {
                local_20 = false;
            }
            bool _e57 = local_20;
            if (_e57) {
                write_listed_triangles(_e51, thread_7, out_4, catalogue, begins, listed, indices_out, _buffer_sizes);
            } else {
                if (IS_TRIANGLES) {
                    write_triangles(_e51, thread_7, out_4, offsets, job, tables, begins, scratch, indices_out, _buffer_sizes);
                } else {
                    write_sequences(_e51, thread_7, out_4, offsets, job, begins, scratch, indices_out, _buffer_sizes);
                }
            }
        }
    }
    return;
}

struct expand_primitivesInput {
};
kernel void expand_primitives(
  metal::uint3 workgroup [[threadgroup_position_in_grid]]
, uint thread_ [[thread_index_in_threadgroup]]
, device type_2 const& offsets [[buffer(3)]]
, constant Job& job [[buffer(0)]]
, device type_3 const& tiles [[buffer(5)]]
, device type_3 const& catalogue [[buffer(7)]]
, device type_3 const& tables [[buffer(2)]]
, threadgroup type_8& begins
, threadgroup type_9& scratch
, threadgroup type_9& listed
, threadgroup metal::atomic_uint& is_missing
, device type_2 const& topologies [[buffer(1)]]
, device type_2& indices_out [[buffer(6)]]
, device Status const& status [[buffer(4)]]
, constant _mslBufferSizes& _buffer_sizes [[buffer(8)]]
) {
    uint _e6 = job.max_workgroups;
    uint number_9 = workgroup.x + (workgroup.y * _e6);
    write_primitive_tile(number_9, thread_, offsets, job, tiles, catalogue, tables, begins, scratch, listed, is_missing, topologies, indices_out, status, _buffer_sizes);
    return;
}
