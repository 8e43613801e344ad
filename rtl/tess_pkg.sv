// Numbers and widths that the modules share; structures are in tess_types.svh. Section numbers refer to docs/specification.md;
// section 14 derives the widths, and a test of the model asserts them.
/* verilator lint_off UNUSEDPARAM */ // a complete list of names
package tess_pkg;
    // Domains, partitionings and output primitives have the numbers of tess.h.
    localparam logic [1:0] ISOLINE  = 2'd0;
    localparam logic [1:0] TRIANGLE = 2'd1;
    localparam logic [1:0] QUAD     = 2'd2;

    localparam logic [1:0] INTEGER         = 2'd0;
    localparam logic [1:0] POW2            = 2'd1;
    localparam logic [1:0] FRACTIONAL_ODD  = 2'd2;
    localparam logic [1:0] FRACTIONAL_EVEN = 2'd3;

    localparam logic [1:0] POINT        = 2'd0;
    localparam logic [1:0] LINE         = 2'd1;
    localparam logic [1:0] TRIANGLE_CW  = 2'd2;
    localparam logic [1:0] TRIANGLE_CCW = 2'd3;

    // 16.16 locations.
    localparam logic [16:0] ONE       = 17'h1_0000;
    localparam logic [16:0] HALF      = 17'h0_8000;
    localparam logic [16:0] ONE_THIRD = 17'h0_5555;
    localparam logic [15:0] TWO_THIRDS = 16'hAAAA;

    // The place of the walk of points (section 6).
    localparam logic [2:0] AT_LINE   = 3'd0;
    localparam logic [2:0] AT_CORNER = 3'd1;
    localparam logic [2:0] AT_OUTER  = 3'd2;
    localparam logic [2:0] AT_RING   = 3'd3;
    localparam logic [2:0] AT_CENTRE = 3'd4;

    // Kinds of stitches (sections 7.2, 7.3 and 7.4).
    localparam logic [2:0] STRAIGHT            = 3'd0; // no stitch: only the outer row advances
    localparam logic [2:0] TRANSITION          = 3'd1;
    localparam logic [2:0] RING                = 3'd2;
    localparam logic [2:0] STRIP               = 3'd3; // all diagonals forward
    localparam logic [2:0] STRIP_EXCEPT_MIDDLE = 3'd4;

    // Steps of a transition (section 7.2), in this order.
    localparam logic [2:0] FIRST        = 3'd0;
    localparam logic [2:0] OUT          = 3'd1;
    localparam logic [2:0] MIDDLE_INNER = 3'd2;
    localparam logic [2:0] MIDDLE_OUTER = 3'd3;
    localparam logic [2:0] BACK         = 3'd4;
    localparam logic [2:0] LAST         = 3'd5;

    // The width of tess_context_t, field by field, because not every tool takes its `$bits` as a constant (docs/rtl.md, Style).
    localparam int CONTEXT_BITS = 1 + 17 + 17 + 16 + 6 + 6 + 7;
    // A patch has at most six factors: outer first, then inside. Vectors hold one context for each.
    localparam int FACTORS = 6;
    localparam int CONTEXTS_BITS = FACTORS * CONTEXT_BITS;
    localparam int COUNTS_BITS = FACTORS * 7;
    // The width of tess_patch_t.
    localparam int PATCH_BITS = 2 + 2 + 1 + 1 + 9 + 13 + 14;

endpackage
/* verilator lint_on UNUSEDPARAM */
