// Structures that the modules share. They are outside tess_pkg because Icarus Verilog 11 cannot use structures of packages.
// States in them are not enums, because neither Icarus Verilog 11 nor Yosys 0.23 can cast to an enum.
`ifndef TESS_TYPES
`define TESS_TYPES

// The context of a factor (sections 4 and 14.1).
typedef struct packed {
    logic        odd;
    logic [16:0] inv_floor;
    logic [16:0] inv_ceil;
    logic [15:0] fraction;
    logic [5:0]  half_points;
    logic [5:0]  split;
    logic [6:0]  points;
} tess_context_t;

// A patch as passed to the stages after the factors. A culled patch has no points and no primitives.
typedef struct packed {
    logic [1:0]  domain;
    logic [1:0]  out;
    logic        center;      // split order: 0 ruler, 1 center
    logic        minimum;     // the minimum patch of section 3.8
    logic [8:0]  ring_points; // on the outer ring: B of section 12.6
    logic [12:0] points;      // 0..4225
    logic [13:0] primitives;  // 0..8192
} tess_patch_t;

// A stitch between two rows, or a part of a sequence. The walk makes one primitive of it per clock (section 7).
typedef struct packed {
    logic        last;     // of the patch
    logic [6:0]  further;  // primitives after the first one
    logic [2:0]  kind;     // STRAIGHT .. of tess_pkg
    // For a transition: its first step, and the kinds of steps that it has.
    logic [2:0]  begins;   // FIRST .. of tess_pkg
    logic        has_ends; // the first and the last step
    logic        has_inner;
    logic        has_outer;
    logic [5:0]  masked;   // steps of each way, 0..62
    logic [63:0] mask;     // positions of the steps: bit 2k for position k of the inner row, 2k + 1 for the outer row
    logic [6:0]  middle;   // ring, strip: pairs before the middle; one less for a ring
    // The rows: entry k is base + k or base - k. If the row closes, its last entry is `close`.
    logic [6:0]  outer_last;
    logic [12:0] outer_base;
    logic        outer_closes;
    logic [12:0] outer_close;
    logic [6:0]  inner_last;
    logic [12:0] inner_base;
    logic        inner_descends;
    logic        inner_closes;
    logic        inner_opens; // entry 0 is inner_close instead
    logic [12:0] inner_close;
    logic [1:0]  size;        // indices of a primitive
    logic        swaps;       // whether the last two indices of a triangle are exchanged, for its winding
} tess_stitch_t;

// One primitive of a stitch.
typedef struct packed {
    logic last;           // of the patch
    logic advances_outer; // the outer row advances; otherwise the inner row
    logic begins_outer;   // the first index belongs to the outer row
} tess_step_t;

`endif
