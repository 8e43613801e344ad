// Assertions that are bound to the design's modules: the contracts of ports and the ranges of section 14.1. A bench compiles
// this file and tess_references.sv with the design. Each failure prints the stage, the signal and the module, and increments
// tess_check_pkg::failures, which the bench's verdict includes.
package tess_check_pkg;
    int unsigned failures = 0;
    int unsigned applied[string]; // the instances of each rule to which it has applied

    function automatic void failed(input string stage, input string signal, input string module_name);
        failures++;
        if (failures <= 20)
            $display("ASSERTION stage=%s signal=%s module=%s at %0t", stage, signal, module_name, $time);
    endfunction

    // Adds to the tally of a rule.
    function automatic void note(input string stage, input string signal, input string module_name, input int unsigned instances);
        string rule = {"stage=", stage, " signal=", signal, " module=", module_name};
        if (!applied.exists(rule)) applied[rule] = 0;
        applied[rule] += instances;
    endfunction

    // Returns the number of rules that have never applied, and prints their names.
    function automatic int unsigned missed();
        missed = 0;
        foreach (applied[rule]) if (applied[rule] == 0) begin
            $display("never applied: %s", rule);
            missed++;
        end
        $display("assertions: %0d rules have applied, %0d have not", 32'(applied.num()) - missed, missed);
    endfunction
endpackage

`ifndef TESS_GATES // a netlist has no modules to bind to

// Notes that a rule has applied, for the verdict: Verilator counts cover properties only in files of its own.
module tess_check_applies #(
    parameter string STAGE  = "",
    parameter string SIGNAL = "",
    parameter string MODULE = ""
) (
    input logic clk, rst, applies
);
    bit has_applied = 1'b0;
    initial tess_check_pkg::note(STAGE, SIGNAL, MODULE, 0);
    always @(posedge clk) begin
        if (!rst && applies && !has_applied) begin
            has_applied = 1'b1;
            tess_check_pkg::note(STAGE, SIGNAL, MODULE, 1);
        end
    end
endmodule

// A rule: in each clock in which WHEN is 1, CONDITION is.
`define TESS_CHECK(NAME, AT, OF, IN, WHEN, CONDITION) \
    assert property (@(posedge clk) disable iff (rst) !(WHEN) || (CONDITION)) \
    else tess_check_pkg::failed(AT, OF, IN); \
    cover property (@(posedge clk) disable iff (rst) WHEN); \
    tess_check_applies #(.STAGE(AT), .SIGNAL(OF), .MODULE(IN)) applies_``NAME (.clk, .rst, .applies(WHEN));

// A stream: an element is offered unchanged until it is taken; a reset withdraws it.
module tess_check_stream #(
    parameter string STAGE  = "",
    parameter string MODULE = "",
    parameter int    WIDTH  = 1,
    parameter bit    COMES  = 1'b0 // an input stream of the design: a reset does not withdraw its element
) (
    input logic             clk, rst,
    input logic             valid, ready,
    input logic [WIDTH-1:0] data
);
    logic             is_stalled, was_reset;
    logic [WIDTH-1:0] stalled;
    always_ff @(posedge clk) begin
        is_stalled <= valid && !ready && !rst;
        stalled    <= data;
        was_reset  <= rst;
    end
    `TESS_CHECK(valid, STAGE, "valid", MODULE, is_stalled, valid)
    `TESS_CHECK(data, STAGE, "data", MODULE, is_stalled, data == stalled)
    if (!COMES) begin : g_reset
        `TESS_CHECK(reset, STAGE, "reset", MODULE, was_reset, !valid)
    end
endmodule

// A stream against the counts with which its stage was started: it has that many elements, and `last` only with the last.
module tess_check_counts #(
    parameter string STAGE  = "",
    parameter string MODULE = ""
) (
    input logic        clk, rst,
    input logic        start,     // a patch begins
    input logic [13:0] elements,  // its number of elements, which may be 0
    input logic        passes,    // elements leave
    input logic [13:0] passing,   // their number
    input logic        last       // the last element is among them
);
    logic [13:0] due[$]; // elements that are due of each patch, the oldest patch first
    always @(posedge clk) begin
        if (rst) begin
            due.delete();
        end else begin
            if (passes && due.size() == 0) tess_check_pkg::failed(STAGE, "valid", MODULE);
            if (passes && due.size() != 0) begin
                if (last != (due[0] <= passing)) tess_check_pkg::failed(STAGE, "last", MODULE);
                if (due[0] < passing) tess_check_pkg::failed(STAGE, "keep", MODULE);
                if (due[0] <= passing) void'(due.pop_front());
                else due[0] = due[0] - passing;
            end
            if (start && elements != 14'd0) due.push_back(elements);
        end
    end
endmodule

// The ports of tess_top: each stream, including that of patches, keeps an element that waits, and a patch that is offered
// during a reset is not taken.
module tess_check_top #(
    parameter int PATCH = 1, COUNTS = 1, POINT = 1, PRIMITIVE = 1 // bits
) (
    input logic                 clk, rst, patch_valid, patch_ready, counts_valid, counts_ready,
    input logic                 point_valid, point_ready, primitive_valid, primitive_ready,
    input logic [PATCH-1:0]     patch,
    input logic [COUNTS-1:0]    counts,
    input logic [POINT-1:0]     point,
    input logic [PRIMITIVE-1:0] element
);
    always @(posedge clk) if (rst && patch_ready) tess_check_pkg::failed("patch", "ready", "tess_factors");
    tess_check_stream #(.STAGE("patch"), .MODULE("tess_top"), .WIDTH(PATCH), .COMES(1'b1)) patches (
        .clk, .rst, .valid(patch_valid && !rst), .ready(patch_ready), .data(patch));
    tess_check_stream #(.STAGE("counts"), .MODULE("tess_top"), .WIDTH(COUNTS)) counted (
        .clk, .rst, .valid(counts_valid), .ready(counts_ready), .data(counts));
    tess_check_stream #(.STAGE("points"), .MODULE("tess_top"), .WIDTH(POINT)) points (
        .clk, .rst, .valid(point_valid), .ready(point_ready), .data(point));
    tess_check_stream #(.STAGE("connect"), .MODULE("tess_top"), .WIDTH(PRIMITIVE)) primitives (
        .clk, .rst, .valid(primitive_valid), .ready(primitive_ready), .data(element));
endmodule
bind tess_top tess_check_top #(
    .PATCH(199 + TAGS + FIRSTS), .COUNTS(27 + TAGS), .POINT(35 * POINTS + 1 + TAGS), .PRIMITIVE(3 + 3 * INDICES + TAGS)
) checks (
    .clk, .rst, .patch_valid, .patch_ready, .counts_valid, .counts_ready, .point_valid, .point_ready,
    .primitive_valid, .primitive_ready,
    .patch({patch_domain, patch_partitioning, patch_out, patch_center, patch_factors, patch_tag, patch_first}),
    .counts({counts_points, counts_primitives, counts_tag}),
    .point({point_keep, point_u, point_v, point_last, point_tag}),
    .element({primitive_size, primitive_i0, primitive_i1, primitive_i2, primitive_last, primitive_tag})
);

// Structures have the widths that tess_pkg states as sums.
module tess_check_widths;
    if ($bits(tess_context_t) != tess_pkg::CONTEXT_BITS) $error("CONTEXT_BITS is not the width of tess_context_t");
    if ($bits(tess_patch_t) != tess_pkg::PATCH_BITS) $error("PATCH_BITS is not the width of tess_patch_t");
endmodule
bind tess_factors tess_check_widths widths ();

// Section 14.1: ranges of the front end's values.
module tess_check_factors (
    input logic        clk, rst, advance, context_valid, context_culled, out_valid, out_ready,
    input logic        fixed_valid, fixed_culled,
    input logic [22:0] fixed,
    input logic [6:0]  points,
    input logic [5:0]  half_points, split,
    input logic [16:0] inv_floor, inv_ceil,
    input logic [12:0] out_points,
    input logic [13:0] out_primitives
);
    logic is_made;
    assign is_made = context_valid && !context_culled;
    `TESS_CHECK(fixed, "factors", "fixed", "tess_factor", fixed_valid && !fixed_culled,
        fixed >= 23'h01_0000 && fixed <= 23'h40_0000)
    `TESS_CHECK(points, "factor_context", "points", "tess_factor_context", is_made, points >= 7'd2 && points <= 7'd65)
    `TESS_CHECK(half_points, "factor_context", "half_points", "tess_factor_context", is_made,
        half_points >= 6'd1 && half_points <= 6'd32)
    `TESS_CHECK(split, "factor_context", "split", "tess_factor_context", is_made, split <= 6'd33)
    `TESS_CHECK(inv_floor, "factor_context", "inv_floor", "tess_factor_context", is_made,
        inv_floor >= 17'd1024 && inv_floor <= 17'h1_0000)
    `TESS_CHECK(inv_ceil, "factor_context", "inv_ceil", "tess_factor_context", is_made,
        inv_ceil >= 17'd1024 && inv_ceil <= 17'h1_0000)
    `TESS_CHECK(count_of_points, "counts", "points", "tess_factors", out_valid, out_points <= 13'd4225)
    `TESS_CHECK(count_of_primitives, "counts", "primitives", "tess_factors", out_valid, out_primitives <= 14'd8192)
    tess_check_stream #(.STAGE("factors"), .MODULE("tess_factors"), .WIDTH(27)) stream (
        .clk, .rst, .valid(out_valid), .ready(out_ready), .data({out_points, out_primitives}));
endmodule
bind tess_factors tess_check_factors checks (
    .clk, .rst, .advance, .context_valid, .context_culled(context_tag.culled), .out_valid, .out_ready,
    .fixed_valid(valids[3]), .fixed_culled(fixed_tag.culled), .fixed, .points(made.points), .half_points(made.half_points), .split(made.split),
    .inv_floor(made.inv_floor), .inv_ceil(made.inv_ceil),
    .out_points(out_patch.points), .out_primitives(out_patch.primitives)
);

// Positions are on their edges, ring numbers increase by one, locations are at most ONE.
module tess_check_points #(
    parameter int POINTS = 1
) (
    input logic        clk, rst, active, start_valid, start_ready, walks, out_valid, out_ready, out_last,
    input logic [5:0]  ring,
    input logic [12:0] start_points,
    input logic [6:0]  a_p, a_points, b_p, b_points,
    input logic        is_placed, // the placers' results are used
    input logic [POINTS-1:0]    out_keep,
    input logic [17*POINTS-1:0] out_u, out_v
);
    logic [13:0] passing; // points of the element that is offered
    always_comb begin
        passing = '0;
        for (int k = 0; k < POINTS; k++) passing = passing + 14'(out_keep[k]);
    end
    logic [5:0] ring_before;
    logic       was_active, was_start;
    always_ff @(posedge clk) begin
        ring_before <= ring;
        was_active  <= active && !rst;
        was_start   <= start_valid && start_ready;
    end
    `TESS_CHECK(ring, "points", "ring", "tess_points", active && was_active && !was_start,
        ring == ring_before || ring == ring_before + 6'd1)
    `TESS_CHECK(a_p, "points", "a_p", "tess_points", walks && is_placed, a_p < a_points)
    `TESS_CHECK(b_p, "points", "b_p", "tess_points", walks && is_placed, b_p < b_points)
    for (genvar k = 0; k < POINTS; k++) begin : g_lane
        `TESS_CHECK(u, "points", "u", "tess_points", out_valid && out_keep[k], out_u[17*k +: 17] <= 17'h1_0000)
        `TESS_CHECK(v, "points", "v", "tess_points", out_valid && out_keep[k], out_v[17*k +: 17] <= 17'h1_0000)
    end
    tess_check_stream #(.STAGE("points"), .MODULE("tess_points"), .WIDTH(35 * POINTS + 1)) stream (
        .clk, .rst, .valid(out_valid), .ready(out_ready), .data({out_keep, out_u, out_v, out_last}));
    tess_check_counts #(.STAGE("points"), .MODULE("tess_points")) counts (
        .clk, .rst, .start(start_valid && start_ready), .elements({1'b0, start_points}),
        .passes(out_valid && out_ready), .passing, .last(out_last));
endmodule
bind tess_points tess_check_points #(.POINTS(POINTS)) checks (
    .clk, .rst, .active, .start_valid, .start_ready, .walks, .out_valid, .out_ready, .out_last, .ring,
    .start_points(start_patch.points), .a_p, .a_points(a_context.points), .b_p,
    .b_points(b_context.points), .is_placed(here.at != AT_CORNER), .out_keep, .out_u, .out_v
);

// Indices are below the patch's number of points, and a stitch stays on its rows.
module tess_check_connect (
    input logic        clk, rst, start_valid, start_ready, out_valid, out_ready, out_last,
    input logic [12:0] start_points,
    input logic [13:0] start_primitives,
    input logic [1:0]  out_size,
    input logic [12:0] out_i0, out_i1, out_i2
);
    logic [12:0] counts[$]; // points of the patches whose primitives are due, the oldest patch first
    logic [12:0] points;
    assign points = (counts.size() == 0) ? 13'd0 : counts[0];
    always @(posedge clk) begin
        if (rst) begin
            counts.delete();
        end else begin
            if (out_valid && out_ready && out_last && counts.size() != 0) void'(counts.pop_front());
            if (start_valid && start_ready && start_primitives != 14'd0) counts.push_back(start_points);
        end
    end
    `TESS_CHECK(i0, "connect", "i0", "tess_connect", out_valid, out_i0 < points)
    `TESS_CHECK(i1, "connect", "i1", "tess_connect", out_valid, out_i1 < points)
    `TESS_CHECK(i2, "connect", "i2", "tess_connect", out_valid, out_i2 < points)
    `TESS_CHECK(size, "connect", "size", "tess_connect", out_valid, out_size != 2'd0)
    tess_check_stream #(.STAGE("connect"), .MODULE("tess_connect"), .WIDTH(42)) stream (
        .clk, .rst, .valid(out_valid), .ready(out_ready), .data({out_size, out_i0, out_i1, out_i2, out_last}));
    tess_check_counts #(.STAGE("connect"), .MODULE("tess_connect")) counts_check (
        .clk, .rst, .start(start_valid && start_ready), .elements(start_primitives),
        .passes(out_valid && out_ready), .passing(14'd1), .last(out_last));
endmodule
bind tess_connect tess_check_connect checks (
    .clk, .rst, .start_valid, .start_ready, .out_valid, .out_ready, .out_last,
    .start_points(start_patch.points), .start_primitives(start_patch.primitives), .out_size, .out_i0, .out_i1, .out_i2
);

// Neither row of a stitch advances past its last entry.
module tess_check_rows (
    input logic       clk, rst, advance, valid, is_stitch, advances_outer,
    input logic [6:0] outer_left, inner_left
);
    `TESS_CHECK(outer_left, "connect", "outer_left", "tess_stitch", valid && is_stitch && advances_outer, outer_left != 7'd0)
    `TESS_CHECK(inner_left, "connect", "inner_left", "tess_stitch", valid && is_stitch && !advances_outer, inner_left != 7'd0)
endmodule
bind tess_rows tess_check_rows checks (
    .clk, .rst, .advance, .valid, .is_stitch(size == 2'd3), .advances_outer(here.advances_outer), .outer_left, .inner_left
);
`endif
