// Structures that the modules share. They stand outside tess_pkg because Icarus Verilog 11 takes none from packages.
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

// What the stages behind the factors know of a patch. A culled patch has no points and no primitives.
typedef struct packed {
    logic [1:0]  domain;
    logic [1:0]  out;
    logic        center;     // split order: 0 ruler, 1 center
    logic        minimum;    // the minimum patch of section 3.8
    logic [12:0] points;     // 0..4225
    logic [13:0] primitives; // 0..8192
} tess_patch_t;

`endif
