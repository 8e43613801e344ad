// References: compare each module of the two streams with the formula of its section, computed here in plain integers. A failure
// names the module, whereas the comparison of the streams would name only the last module that the value passes. Like
// tess_checks.sv they are bound to the modules; compile this file after it.
//
//   module                     checked when                                  against
//   tess_reciprocal            in every clock                                section 2
//   tess_fork                  in every clock                                each element once to each consumer
//   tess_skid                  an element leaves                             the elements that entered, in order
//   tess_tags                  an element leaves                             the tags that entered, one for each `last`
//   tess_base                  in every clock                                64-bit sums
//   tess_place_position        two clocks after a position enters            section 5, first half
//   tess_place_blend           six clocks after                              section 5, second half
//   tess_combine               ten clocks after                              section 6
//   tess_lane                  ten clocks after a step of the walk           sections 5 and 6, from the step's first position
//   tess_mask                  a transition is described                     ruler[] of section 7.2, for 14.3
//   tess_stitch                a step leaves                                 the steps of sections 7.2 to 7.4
//   tess_rows                  a primitive leaves                            sections 7.1 and 8

// ---- the front end, the fork, the buffers --------------------------------------------------------

module tess_reference_reciprocal (
    input logic        clk, rst,
    input logic [6:0]  n,
    input logic [16:0] value
);
    logic [16:0] expected;
    always_comb begin
        expected = '0;
        if (n != 7'd0 && n <= 7'd64) expected = 17'((32'h1_0000 + 32'(n) / 2) / 32'(n));
    end
    `TESS_CHECK(reciprocal, "factor_context", "reciprocal", "tess_reciprocal", 1'b1, value == expected)
endmodule
bind tess_factors tess_reference_reciprocal floor_reference (
    .clk, .rst, .n(factor_context.floor_reciprocal.n), .value(factor_context.floor_reciprocal.value));
bind tess_factors tess_reference_reciprocal ceil_reference (
    .clk, .rst, .n(factor_context.ceil_reciprocal.n), .value(factor_context.ceil_reciprocal.value));

// Each consumer has taken as many elements as have left the fork, or one more.
module tess_reference_fork #(
    parameter int N = 1
) (
    input logic         clk, rst, in_valid, in_ready,
    input logic [N-1:0] out_valid, out_ready
);
    logic [N-1:0] has_taken; // the consumers that have taken the offered element
    always @(posedge clk) begin
        for (int i = 0; i < N; i++) begin
            if (!rst && in_valid && out_valid[i] == has_taken[i]) tess_check_pkg::failed("fork", "valid", "tess_fork");
            if (!rst && in_valid && in_ready && !has_taken[i] && !(out_valid[i] && out_ready[i]))
                tess_check_pkg::failed("fork", "ready", "tess_fork");
            has_taken[i] <= !rst && !(in_valid && in_ready) && (has_taken[i] || (out_valid[i] && out_ready[i]));
        end
    end
endmodule
bind tess_fork tess_reference_fork #(.N(N)) reference (.clk, .rst, .in_valid, .in_ready, .out_valid, .out_ready);

module tess_reference_skid #(
    parameter int WIDTH = 1
) (
    input logic             clk, rst, in_valid, in_ready, out_valid, out_ready,
    input logic [WIDTH-1:0] in_data, out_data
);
    logic [WIDTH-1:0] held[$];
    always @(posedge clk) begin
        if (rst) begin
            held.delete();
        end else begin
            if (in_valid && in_ready) held.push_back(in_data);
            if (out_valid && out_ready) begin
                if (held.size() == 0) begin
                    tess_check_pkg::failed("port", "valid", "tess_skid");
                end else begin
                    if (held[0] != out_data) tess_check_pkg::failed("port", "data", "tess_skid");
                    void'(held.pop_front());
                end
            end
        end
    end
endmodule
bind tess_skid tess_reference_skid #(.WIDTH(WIDTH)) reference (
    .clk, .rst, .in_valid, .in_ready, .out_valid, .out_ready, .in_data, .out_data);

module tess_reference_tags #(
    parameter bit USED  = 1'b0,
    parameter int WIDTH = 1
) (
    input logic             clk, rst, in_valid, in_ready, from_valid, out_valid, out_ready, last,
    input logic [13:0]      in_count,
    input logic [WIDTH-1:0] in_tag, out_tag
);
    logic [WIDTH-1:0] held[$]; // the tags of patches whose last element has not left, the oldest first
    always @(posedge clk) begin
        if (rst) begin
            held.delete();
        end else if (USED) begin
            if (from_valid != out_valid) tess_check_pkg::failed("tags", "valid", "tess_tags"); // an element waits for its tag
            if (out_valid && held.size() == 0) tess_check_pkg::failed("tags", "valid", "tess_tags");
            if (out_valid && held.size() != 0 && out_tag != held[0]) tess_check_pkg::failed("tags", "tag", "tess_tags");
            if (out_valid && out_ready && last && held.size() != 0) void'(held.pop_front());
            if (in_valid && in_ready && in_count != 14'd0) held.push_back(in_tag);
        end
    end
endmodule
bind tess_tags tess_reference_tags #(.USED(USED), .WIDTH(WIDTH)) reference (
    .clk, .rst, .in_valid, .in_ready, .in_count, .from_valid, .out_valid, .out_ready, .last(from_last), .in_tag, .out_tag);

module tess_reference_base #(
    parameter int INDICES = 13
) (
    input logic               clk, rst, valid,
    input logic [63:0]        first,
    input logic [1:0]         size,
    input logic [2:0][12:0]   from,
    input logic [INDICES-1:0] i0, i1, i2
);
    function automatic bit [INDICES-1:0] sum(input int unsigned k);
        return (k < 32'(size)) ? INDICES'(64'(from[k]) + first) : '0;
    endfunction
    `TESS_CHECK(i0, "base", "i0", "tess_base", valid, i0 == sum(0))
    `TESS_CHECK(i1, "base", "i1", "tess_base", valid, i1 == sum(1))
    `TESS_CHECK(i2, "base", "i2", "tess_base", valid, i2 == sum(2))
endmodule
bind tess_top tess_reference_base #(.INDICES(INDICES)) base_reference (
    .clk, .rst, .valid(joined_valid), .first((BASE == 0) ? 64'd0 : 64'(joined_label[FIRSTS-1:0])), .size(joined_size),
    .from({joined_i2, joined_i1, joined_i0}), .i0, .i1, .i2);

// ---- points --------------------------------------------------------------------------------------

// The place of a point in one dimension (section 5).
typedef struct packed {
    bit        is_used, flip, middle;
    bit [31:0] coarse, fine, location;
} tess_place_t;

function automatic tess_place_t tess_placed(input tess_context_t c, input int unsigned from);
    int unsigned position, half;
    tess_place_t r;
    r.is_used  = 1'b1;
    r.flip     = from >= 32'(c.half_points);
    position       = r.flip ? 2 * 32'(c.half_points) - from - 32'(c.odd) : from;
    r.middle   = position == 32'(c.half_points);
    r.coarse   = (position > 32'(c.split) ? position - 1 : position) * 32'(c.inv_floor);
    r.fine     = position * 32'(c.inv_ceil);
    half           = (r.coarse * (32'h1_0000 - 32'(c.fraction)) + r.fine * 32'(c.fraction) + 32'h8000) >> 16;
    if (r.middle) half = 32'h8000;
    r.location = r.flip ? 32'h1_0000 - half : half;
    return r;
endfunction

// The point of two locations (section 6).
typedef struct packed {
    bit        is_used;
    bit [31:0] u, v;
} tess_point_t;

function automatic tess_point_t tess_combined(
        input bit is_quad, input bit [2:0] at, input bit [1:0] side, input bit [16:0] a, input bit [16:0] b);
    localparam int unsigned ONE = 32'h1_0000;
    int unsigned along, perp, q;
    tess_point_t r;
    along = 32'(a);
    perp  = (along * 32'hAAAA + 32'h8000) >> 16;
    q     = 32'(b) - (perp + 1) / 2;
    r = {1'b1, along, 32'(b)};
    if (at == tess_pkg::AT_CORNER && is_quad) begin
        r.u = (side == 2'd1 || side == 2'd2) ? ONE : 0;
        r.v = (side >= 2'd2) ? ONE : 0;
    end else if (at == tess_pkg::AT_CORNER) begin
        r.u = (side == 2'd2) ? ONE : 0;
        r.v = (side == 2'd0) ? ONE : 0;
    end else if (at == tess_pkg::AT_OUTER) begin
        r.u = (side == 2'd0) ? 0 : (side == 2'd2 && is_quad) ? ONE : along;
        r.v = (side == 2'd1) ? 0 : (side == 2'd3) ? ONE : (side == 2'd2 && !is_quad) ? ONE - along : along;
    end else if (at == tess_pkg::AT_RING && !is_quad) begin
        r.u = (side == 2'd0) ? perp : q;
        r.v = (side == 2'd0) ? q : (side == 2'd1) ? perp : ONE - q - perp;
    end else if (at == tess_pkg::AT_CENTRE && !is_quad) begin
        r.u = 32'h5555;
        r.v = 32'h5555;
    end
    return r;
endfunction

module tess_reference_place (
    input logic          clk, rst, advance,
    input logic          is_used,      // `given` and `p` are those of a point
    input tess_context_t given,
    input logic [6:0]    p,
    input logic          flip, middle, // two clocks later
    input logic [16:0]   coarse, fine,
    input logic [16:0]   location      // six clocks later
);
    tess_place_t expected[6]; // for the points of the previous clock, of the one before that, ..
    always_ff @(posedge clk) begin
        if (rst) begin
            for (int i = 0; i < 6; i++) expected[i] <= '0;
        end else if (advance) begin
            expected[0] <= is_used ? tess_placed(given, 32'(p)) : '0;
            for (int i = 1; i < 6; i++) expected[i] <= expected[i-1];
        end
    end
    tess_place_t position, placed;
    logic   is_chosen; // the position is not the middle, which needs no multiplication
    assign position  = expected[1];
    assign placed    = expected[5];
    assign is_chosen = position.is_used && !position.middle;
    `TESS_CHECK(flip, "points", "flip", "tess_place_position", position.is_used, flip == position.flip)
    `TESS_CHECK(middle, "points", "middle", "tess_place_position", position.is_used, middle == position.middle)
    `TESS_CHECK(coarse, "points", "coarse", "tess_place_position", is_chosen, 32'(coarse) == position.coarse)
    `TESS_CHECK(fine, "points", "fine", "tess_place_position", is_chosen, 32'(fine) == position.fine)
    `TESS_CHECK(location, "points", "location", "tess_place_blend", placed.is_used, 32'(location) == placed.location)
endmodule
bind tess_points tess_reference_place reference_a (
    .clk, .rst, .advance, .is_used(walks && here.at != AT_CORNER), .given(a_context), .p(a_p),
    .flip(place_a.flip_next), .middle(place_a.middle_next), .coarse(place_a.coarse_next), .fine(place_a.fine_next), .location(a));
bind tess_points tess_reference_place reference_b (
    .clk, .rst, .advance, .is_used(walks && here.at != AT_CORNER), .given(b_context), .p(b_p),
    .flip(place_b.flip_next), .middle(place_b.middle_next), .coarse(place_b.coarse_next), .fine(place_b.fine_next), .location(b));

module tess_reference_combine (
    input logic        clk, rst, advance,
    input logic        is_used,
    input logic        is_quad,
    input logic [2:0]  at,
    input logic [1:0]  side,
    input logic [16:0] a, b,
    input logic [16:0] u, v // four clocks later
);
    tess_point_t expected[4];
    always_ff @(posedge clk) begin
        if (rst) begin
            for (int i = 0; i < 4; i++) expected[i] <= '0;
        end else if (advance) begin
            expected[0] <= is_used ? tess_combined(is_quad, at, side, a, b) : '0;
            for (int i = 1; i < 4; i++) expected[i] <= expected[i-1];
        end
    end
    tess_point_t combined;
    assign combined = expected[3];
    `TESS_CHECK(u, "points", "u", "tess_combine", combined.is_used, 32'(u) == combined.u)
    `TESS_CHECK(v, "points", "v", "tess_combine", combined.is_used, 32'(v) == combined.v)
endmodule
bind tess_points tess_reference_combine combine_reference (
    .clk, .rst, .advance, .is_used(valids[PLACING-1]), .is_quad(quad_there), .at(at_there), .side(side_there), .a, .b,
    .u(out_u[16:0]), .v(out_v[16:0]));

// The lanes of tess_points after the first: the k-th point after the position of the step.
module tess_reference_lanes #(
    parameter int POINTS = 1
) (
    input logic                 clk, rst, advance, walks,
    input logic                 backward, a_runs, is_quad,
    input logic [2:0]           at,
    input logic [1:0]           side,
    input logic [6:0]           along, across, to_come,
    input tess_context_t        a_context, b_context,
    input logic [POINTS-1:0]    keep, // ten clocks later
    input logic [17*POINTS-1:0] u, v
);
    for (genvar k = 1; k < POINTS; k++) begin : g_lane
        function automatic tess_point_t point();
            bit [6:0]    p = backward ? along - 7'(k) : along + 7'(k);
            tess_place_t a = tess_placed(a_context, 32'(a_runs ? p : across));
            tess_place_t b = tess_placed(b_context, 32'(a_runs ? across : p));
            return tess_combined(is_quad, at, side, 17'(a.location), 17'(b.location));
        endfunction

        bit [9:0]    comes; // the steps of the last ten clocks, the newest in the lowest bit
        tess_point_t expected[10];
        always_ff @(posedge clk) begin
            if (rst) begin
                comes <= '0;
            end else if (advance) begin
                comes       <= {comes[8:0], walks};
                expected[0] <= (walks && to_come >= 7'(k)) ? point() : '0;
                for (int i = 1; i < 10; i++) expected[i] <= expected[i-1];
            end
        end
        tess_point_t due;
        assign due = expected[9];
        `TESS_CHECK(keep, "points", "keep", "tess_points", comes[9], keep[k] == due.is_used)
        `TESS_CHECK(u, "points", "u", "tess_lane", comes[9] && due.is_used, 32'(u[17*k +: 17]) == due.u)
        `TESS_CHECK(v, "points", "v", "tess_lane", comes[9] && due.is_used, 32'(v[17*k +: 17]) == due.v)
    end
endmodule
bind tess_points tess_reference_lanes #(.POINTS(POINTS)) lanes_reference (
    .clk, .rst, .advance, .walks, .backward(here.backward), .a_runs(here.a_runs), .is_quad(here.is_quad), .at(here.at),
    .side(here.side), .along, .across(here.across), .to_come, .a_context, .b_context, .keep(out_keep), .u(out_u), .v(out_v));

// ---- primitives ----------------------------------------------------------------------------------

module tess_reference_mask (
    input logic        clk, rst, is_used, center,
    input logic [5:0]  half,
    input logic [31:0] mask
);
    // ruler[position] of section 7.2: 1 for the middle, 2 and 3 for the quarters, .., 32 for position 1.
    function automatic int unsigned ruler(input int unsigned position);
        int unsigned odd = position - 1, first = 16;
        if (odd == 0) return 32;
        while (odd % 2 == 0) begin
            odd /= 2;
            first /= 2;
        end
        return first + odd / 2;
    endfunction

    logic [31:0] expected;
    always_comb for (int unsigned k = 1; k <= 32; k++) expected[k-1] = (center ? k : ruler(k)) < 32'(half);
    `TESS_CHECK(mask, "connect", "mask", "tess_mask", is_used, mask == expected)
endmodule
bind tess_connect tess_reference_mask outer_reference (
    .clk, .rst, .is_used(passes && edge_kind == tess_pkg::TRANSITION), .center(edge_center), .half(outer_half), .mask(outer_mask));
bind tess_connect tess_reference_mask inner_reference (
    .clk, .rst, .is_used(passes && edge_kind == tess_pkg::TRANSITION), .center(edge_center), .half(inner_half), .mask(inner_mask));

module tess_reference_stitch (
    input logic         clk, rst, advance, takes, step_valid, step_begins,
    input tess_stitch_t ahead,
    input tess_step_t   step
);
    typedef struct packed { bit begins, last, advances_outer, begins_outer; } step_t;
    step_t due[$]; // the steps that are due for the stitches that were taken, the next one first

    function automatic void walk(input bit advances_outer, input bit begins_outer, inout int unsigned number);
        due.push_back({number == 0, ahead.last && number == 32'(ahead.further), advances_outer, begins_outer});
        number++;
    endfunction

    // The steps of section 7.2; the bits of the mask are positions.
    function automatic void walk_transition(inout int unsigned number);
        if (ahead.has_ends) walk(1'b1, 1'b1, number);
        for (int i = 0; i < 64; i++) if (ahead.mask[i]) walk(i[0], i[0], number);
        if (ahead.has_inner) walk(1'b0, 1'b0, number);
        if (ahead.has_outer) walk(1'b1, 1'b0, number);
        for (int i = 63; i >= 0; i--) if (ahead.mask[i]) walk(i[0], i[0], number);
        if (ahead.has_ends) walk(1'b1, 1'b1, number);
    endfunction

    function automatic void walk_stitch();
        int unsigned number = 0, pair;
        bit          is_second;
        if (ahead.kind == tess_pkg::TRANSITION) walk_transition(number);
        else while (number <= 32'(ahead.further)) begin
            case (ahead.kind)
                tess_pkg::RING: begin
                    pair      = (number - 1) / 2;
                    is_second = number % 2 == 0;
                    if (number == 0 || number == 32'(ahead.further)) walk(1'b1, 1'b1, number);
                    else if (pair <= 32'(ahead.middle))              walk(is_second, 1'b1, number);
                    else                                             walk(!is_second, 1'b0, number);
                end
                tess_pkg::STRIP: walk(number % 2 == 0, 1'b0, number);
                tess_pkg::STRIP_EXCEPT_MIDDLE: begin
                    is_second = number % 2 == 1;
                    if (number / 2 == 32'(ahead.middle)) walk(is_second, 1'b1, number);
                    else                                 walk(!is_second, !is_second, number);
                end
                default: walk(1'b1, 1'b1, number);
            endcase
        end
        if (number != 32'(ahead.further) + 1) tess_check_pkg::failed("connect", "further", "tess_connect");
    endfunction

    always @(posedge clk) begin
        if (rst) begin
            due.delete();
        end else begin
            if (takes) walk_stitch();
            if (advance && step_valid) begin
                if (due.size() == 0) begin
                    tess_check_pkg::failed("connect", "step_valid", "tess_stitch");
                end else begin
                    if (due[0] != {step_begins, step}) tess_check_pkg::failed("connect", "step", "tess_stitch");
                    void'(due.pop_front());
                end
            end
        end
    end
endmodule
bind tess_stitch tess_reference_stitch reference (.clk, .rst, .advance, .takes, .step_valid, .step_begins, .ahead, .step);

module tess_reference_rows (
    input logic         clk, rst, advance, step_valid, step_begins,
    input tess_step_t   step,
    input tess_stitch_t step_stitch,
    input logic [1:0]   out_size,
    input logic [12:0]  out_i0, out_i1, out_i2
);
    typedef struct packed { bit is_used; bit [1:0] size; bit [12:0] i0, i1, i2; } primitive_t;
    tess_stitch_t rows;
    int unsigned  outer = 0, inner = 0; // entries of its rows
    primitive_t   expected[2];

    function automatic bit [12:0] outer_entry(input int unsigned k);
        return (rows.outer_closes && k == 32'(rows.outer_last)) ? rows.outer_close : rows.outer_base + 13'(k);
    endfunction

    function automatic bit [12:0] inner_entry(input int unsigned k);
        if (rows.inner_opens && k == 0)                      return rows.inner_close;
        if (rows.inner_closes && k == 32'(rows.inner_last))  return rows.inner_close;
        return rows.inner_descends ? rows.inner_base - 13'(k) : rows.inner_base + 13'(k);
    endfunction

    function automatic primitive_t make();
        bit [12:0]  here, there, next;
        primitive_t r;
        here  = step.begins_outer ? outer_entry(outer) : inner_entry(inner);
        there = step.begins_outer ? inner_entry(inner) : outer_entry(outer);
        next  = step.advances_outer ? outer_entry(outer + 1) : inner_entry(inner + 1);
        if (step.begins_outer) r = {1'b1, rows.size, here, next, there};
        else                   r = {1'b1, rows.size, here, there, next};
        if (rows.swaps) r = {1'b1, rows.size, r.i0, r.i2, r.i1};
        if (rows.size < 2'd2) r.i1 = 13'd0;
        if (rows.size < 2'd3) r.i2 = 13'd0;
        return r;
    endfunction

    always @(posedge clk) begin
        if (rst) begin
            expected[0] <= '0;
            expected[1] <= '0;
        end else if (advance) begin
            if (step_valid && step_begins) begin
                rows  = step_stitch;
                outer = 0;
                inner = 0;
            end
            expected[0] <= step_valid ? make() : '0;
            expected[1] <= expected[0];
            if (step_valid && step.advances_outer)  outer++;
            if (step_valid && !step.advances_outer) inner++;
        end
    end
    primitive_t made;
    assign made = expected[1];
    `TESS_CHECK(size, "connect", "size", "tess_rows", made.is_used, out_size == made.size)
    `TESS_CHECK(i0, "connect", "i0", "tess_rows", made.is_used, out_i0 == made.i0)
    `TESS_CHECK(i1, "connect", "i1", "tess_rows", made.is_used, out_i1 == made.i1)
    `TESS_CHECK(i2, "connect", "i2", "tess_rows", made.is_used, out_i2 == made.i2)
endmodule
bind tess_rows tess_reference_rows reference (
    .clk, .rst, .advance, .step_valid, .step_begins, .step, .step_stitch, .out_size, .out_i0, .out_i1, .out_i2);
