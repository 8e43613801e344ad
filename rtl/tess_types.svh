// Structures that the modules share. They stand outside tess_pkg because Icarus Verilog 11 takes none from packages. States
// that pass through them are no enums, as neither it nor Yosys 0.23 casts to one.
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

// A patch as the stages behind the factors know it. A culled patch has no points and no primitives.
typedef struct packed {
    logic [1:0]  domain;
    logic [1:0]  out;
    logic        center;      // split order: 0 ruler, 1 center
    logic        minimum;     // the minimum patch of section 3.8
    logic [8:0]  ring_points; // on the outer ring: B of section 12.6
    logic [12:0] points;      // 0..4225
    logic [13:0] primitives;  // 0..8192
} tess_patch_t;

// A stitch between two rows, or a part of a sequence, of which the walk makes one primitive a clock (section 7).
typedef struct packed {
    logic        last;     // of the patch
    logic [6:0]  further;  // primitives behind the first one
    logic [2:0]  kind;     // STRAIGHT .. of tess_pkg
    // Transition: its first step, and those that it has.
    logic [2:0]  begins;   // FIRST .. of tess_pkg
    logic        has_ends; // the first and the last step
    logic        has_inner;
    logic        has_outer;
    logic [5:0]  masked;   // steps of each way, 0..62
    logic [63:0] mask;     // where: bit 2k for position k of the inner row, 2k + 1 for the outer row
    logic [6:0]  middle;   // ring, strip: pairs before the middle; less one for a ring
    // The rows: entry k is base + k or base - k, and close where k is the last one, if it closes.
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
    logic        swaps;       // the last two of a triangle, for its winding
} tess_stitch_t;

// One primitive of it.
typedef struct packed {
    logic last;           // of the patch
    logic advances_outer; // the outer row; otherwise the inner one
    logic begins_outer;   // the first index is the outer row's
} tess_step_t;

`endif
