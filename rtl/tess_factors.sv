// The front end: computes the contexts and counts of a patch from its raw factors (specification, sections 3, 4, 12.6).
//
// One factor is processed per clock. A patch of six factors:
//
//   clock     1   2   3   4   5   6   7   8   9  10  11  12  13  14  15
//   select    0   1   2   3   4   5   .   .                              factor k of the patch that is accepted in clock 0
//   clamp         0   1   2   3   4   5                                  tess_factor
//   align             0   1   2   3   4   5
//   round                 0   1   2   3   4   5
//   half                      0   1   2   3   4   5                      tess_factor_context
//   points                        0   1   2   3   4   5
//   the rest                          0   1   2   3   4   5              to its places in `contexts`
//   counts                                                  +   x   +    offered after clock 15
//
// The next patch is selected from clock 7: its contexts are computed while the previous patch is counted and waits in
// `out_contexts`. The front end stalls only if the previous patch still waits when the next one is complete.
//
// Places of contexts: 0 to 3 for the outer edges, 4 along u and 5 along v. On triangles 4 and 5 are equal; on isolines they
// are the detail and the density.
`include "tess_types.svh"
module tess_factors (
    input  logic         clk,
    input  logic         rst,

    input  logic         in_valid,
    output logic         in_ready,
    input  logic [1:0]   in_domain,
    input  logic [1:0]   in_partitioning,
    input  logic [1:0]   in_out,
    input  logic         in_center,
    input  logic [191:0] in_factors, // binary32; factor 0 in the lowest bits

    output logic                                out_valid,
    input  logic                                out_ready,
    output tess_patch_t                         out_patch,
    output logic [tess_pkg::CONTEXTS_BITS-1:0]  out_contexts
);
    localparam int BITS = tess_pkg::CONTEXT_BITS;

    logic is_complete; // `contexts` holds the contexts of a whole patch
    logic is_occupied; // `out_contexts` holds those of the previous patch
    logic advance;
    assign advance = !(is_complete && is_occupied);

    // ---- select --------------------------------------------------------------------------------

    logic         busy;
    logic [1:0]   domain, partitioning, out;
    logic         center;
    logic [191:0] factors;
    logic         is_culled, has_frame;
    logic [2:0]   k;
    logic         issues_last; // k is the last factor that is selected: the first one if the patch is culled

    logic [2:0] factor_count, outer_count;
    always_comb begin
        factor_count = (domain == tess_pkg::ISOLINE) ? 3'd2 : (domain == tess_pkg::TRIANGLE) ? 3'd4 : 3'd6;
        outer_count  = (domain == tess_pkg::ISOLINE) ? 3'd2 : (domain == tess_pkg::TRIANGLE) ? 3'd3 : 3'd4;
    end

    // Steps 1 and 4 examine all factors of the arriving patch. Positive: not negative, not zero, not NaN. Large: above
    // 1 + 2^-17.
    logic [5:0] is_positive, is_large, is_there, is_outer;
    assign is_there = (in_domain == tess_pkg::ISOLINE) ? 6'b000011 : (in_domain == tess_pkg::TRIANGLE) ? 6'b001111 : 6'b111111;
    assign is_outer = (in_domain == tess_pkg::ISOLINE) ? 6'b000011 : (in_domain == tess_pkg::TRIANGLE) ? 6'b000111 : 6'b001111;
    for (genvar i = 0; i < tess_pkg::FACTORS; i++) begin : g_factor
        logic [31:0] x;
        assign x = in_factors[32*i +: 32];
        assign is_positive[i] = !x[31] && x[30:0] != 31'd0 && x[30:0] <= 31'h7F80_0000;
        assign is_large[i]    = !x[31] && x[30:0] > 31'h3F80_0040 && x[30:0] <= 31'h7F80_0000;
    end
    logic comes_culled;
    assign comes_culled = in_domain > tess_pkg::QUAD || (is_outer & ~is_positive) != 6'd0;
    assign in_ready     = !rst && advance && (!busy || issues_last);

    always_ff @(posedge clk) begin
        if (rst) begin
            busy <= 1'b0;
        end else if (advance) begin
            if (in_valid && in_ready) begin
                busy         <= 1'b1;
                domain       <= in_domain;
                partitioning <= in_partitioning;
                out          <= in_out;
                center       <= in_center;
                factors      <= in_factors;
                is_culled    <= comes_culled;
                has_frame    <= (is_there & is_large) != 6'd0;
                k            <= 3'd0;
                issues_last  <= comes_culled;
            end else if (busy) begin
                busy        <= !issues_last;
                k           <= k + 3'd1;
                issues_last <= k == factor_count - 3'd2;
            end
        end
    end

    // Factor k, and its partitioning and role. To select bits from 32 k would need a shifter.
    logic [31:0] bits_next, bits;
    logic [1:0]  mode;
    logic        is_inside, framed;
    always_comb begin
        unique case (k)
            3'd0:    bits_next = factors[0*32 +: 32];
            3'd1:    bits_next = factors[1*32 +: 32];
            3'd2:    bits_next = factors[2*32 +: 32];
            3'd3:    bits_next = factors[3*32 +: 32];
            3'd4:    bits_next = factors[4*32 +: 32];
            default: bits_next = factors[5*32 +: 32];
        endcase
    end
    always_ff @(posedge clk) begin
        if (advance) begin
            bits      <= bits_next;
            mode      <= (domain == tess_pkg::ISOLINE && k == 3'd0) ? tess_pkg::INTEGER : partitioning;
            is_inside <= k >= outer_count;
            framed    <= has_frame;
        end
    end

    // ---- clamp, align, round -------------------------------------------------------------------

    logic [22:0] fixed_next, fixed;
    logic        odd_next, odd;
    tess_factor #(.REGISTERED(1'b1)) factor (
        .clk, .advance,
        .bits, .partitioning(mode), .is_inside, .has_frame(framed),
        .fixed(fixed_next), .odd(odd_next)
    );
    always_ff @(posedge clk) begin
        if (advance) begin
            fixed <= fixed_next;
            odd   <= odd_next;
        end
    end

    // ---- half, points, the rest of a context ---------------------------------------------------

    // The data that accompanies a factor, until its conversion and until its context.
    typedef struct packed {
        logic [1:0] domain;
        logic [1:0] out;
        logic       center;
        logic       culled;
        logic       is_outer;
        logic [2:0] k;
    } tag_t;
    localparam int TAG_BITS = 2 + 2 + 1 + 1 + 1 + 3;
    tag_t       selected, fixed_tag, context_tag;
    logic [5:0] valids, lasts; // of the six clocks from select to points
    logic       is_one; // the factor equals ONE
    assign selected.domain   = domain;
    assign selected.out      = out;
    assign selected.center   = center;
    assign selected.culled   = is_culled;
    assign selected.is_outer = k < outer_count;
    assign selected.k        = k;
    tess_delay #(.WIDTH(TAG_BITS), .CLOCKS(4)) to_fixed (.clk, .advance, .in(selected), .out(fixed_tag));
    tess_delay #(.WIDTH(TAG_BITS), .CLOCKS(2)) to_context (.clk, .advance, .in(fixed_tag), .out(context_tag));

    always_ff @(posedge clk) begin
        if (rst) begin
            valids <= 6'd0;
        end else if (advance) begin
            valids <= {valids[4:0], busy};
        end
        if (advance) begin
            lasts <= {lasts[4:0], issues_last};
        end
    end

    logic          context_valid, context_last;
    logic [2:0]    context_k;
    tess_context_t made;
    assign context_valid = valids[5];
    assign context_last  = lasts[5];
    assign context_k     = context_tag.k;
    tess_delay #(.WIDTH(2), .CLOCKS(2)) beside (
        .clk, .advance, .in({odd, fixed == 23'h01_0000}), .out({made.odd, is_one}));
    tess_factor_context #(.REGISTERED(1'b1)) factor_context (
        .clk, .advance,
        .factor     (fixed),
        .odd        (odd),
        .center     (fixed_tag.center),
        .inv_floor  (made.inv_floor),
        .inv_ceil   (made.inv_ceil),
        .fraction   (made.fraction),
        .half_points(made.half_points),
        .split      (made.split),
        .points     (made.points)
    );

    // ---- the patch whose contexts are being computed -------------------------------------------

    logic [BITS*tess_pkg::FACTORS-1:0] contexts;
    /* verilator lint_off UNUSEDSIGNAL */ // the number of the factor is not used
    tag_t       whole;       // of its last factor
    /* verilator lint_on UNUSEDSIGNAL */
    logic       all_one;     // every factor equals ONE
    logic [8:0] ring_points; // the sum of n - 1 over the outer edges
    logic [6:0] wide, tall;  // their product is the number of points inside, or on the lines
    logic       is_quad, is_isoline, starts, sets_wide, sets_tall;
    logic [6:0] made_points, half;
    assign is_quad    = context_tag.domain == tess_pkg::QUAD;
    assign is_isoline = context_tag.domain == tess_pkg::ISOLINE;
    assign starts     = context_k == 3'd0;
    assign sets_wide  = context_k == (is_quad ? 3'd4 : is_isoline ? 3'd1 : 3'd3);
    assign sets_tall  = context_k == (is_quad ? 3'd5 : is_isoline ? 3'd0 : 3'd3);
    // By a name of its own: Icarus 11 never leaves an always_comb that reads a member of a structure with several drivers.
    assign made_points = made.points;
    assign half       = made_points >> 1;

    // Quad: (n4 - 2)(n5 - 2). Isoline: n1 (n0 - 1). Triangle, with h = n3 / 2: (h - 1)(3h - 3), or (h - 1) 3h + 1 if n3 is odd.
    // Each is one sum, whose terms are selected before the addition.
    logic [6:0] wide_next, tall_next;
    logic [1:0] tall_less;
    always_comb begin
        wide_next = (is_quad || is_isoline ? made_points : half) - {5'd0, is_quad, !is_quad && !is_isoline};
        tall_less = 2'd0;
        if (is_quad) begin
            tall_less = 2'd2;
        end else if (is_isoline) begin
            tall_less = 2'd1;
        end else if (!made_points[0]) begin
            tall_less = 2'd3;
        end
        tall_next = (is_quad || is_isoline ? made_points : half) + (is_quad || is_isoline ? 7'd0 : half << 1) - {5'd0, tall_less};
    end

    always_ff @(posedge clk) begin
        if (rst) begin
            is_complete <= 1'b0;
        end else if (advance) begin
            is_complete <= context_valid && context_last;
        end
        if (advance && context_valid) begin
            whole   <= context_tag;
            all_one <= (starts || all_one) && is_one;
            if (starts) begin
                ring_points <= {2'd0, made.points} - 9'd1;
            end else if (context_tag.is_outer) begin
                ring_points <= ring_points + {2'd0, made.points} - 9'd1;
            end
            for (int i = 0; i < 4; i++) begin
                if (context_k == 3'(i)) begin
                    contexts[BITS*i +: BITS] <= made;
                end
            end
            if (sets_wide) begin
                contexts[BITS*4 +: BITS] <= made;
                wide <= wide_next;
            end
            if (sets_tall) begin
                contexts[BITS*5 +: BITS] <= made;
                tall <= tall_next;
            end
        end
    end

    // ---- the patch that is counted, then offered -----------------------------------------------

    logic        moves, product_valid, sum_valid;
    assign moves       = is_complete && !is_occupied;
    assign is_occupied = product_valid || sum_valid || out_valid;

    logic [1:0]  counted_domain, counted_out;
    logic        is_minimum;
    logic [12:0] product, inner, ring13; // inner: points inside
    logic [6:0]  lines;      // of an isoline patch
    logic [13:0] subtrahend; // primitives = points - subtrahend, or 2 points - subtrahend
    assign ring13 = {4'd0, out_patch.ring_points};

    // The triangles of a patch that is not minimum: two per point, less those of the border.
    logic is_doubled;
    assign is_doubled = counted_out[1] && counted_domain != tess_pkg::ISOLINE && !is_minimum;
    always_comb begin
        inner = product;
        if (counted_domain == tess_pkg::TRIANGLE) begin
            inner = product + {12'd0, out_contexts[BITS*4]};
        end
    end

    always_ff @(posedge clk) begin
        if (rst) begin
            product_valid <= 1'b0;
            sum_valid     <= 1'b0;
            out_valid     <= 1'b0;
        end else begin
            // A culled patch is not counted.
            product_valid <= moves && !whole.culled;
            sum_valid     <= product_valid;
            out_valid     <= (moves && whole.culled) || sum_valid || (out_valid && !out_ready);
        end
        if (moves) begin
            out_contexts          <= contexts;
            out_patch.domain      <= whole.domain;
            out_patch.out         <= whole.out;
            out_patch.center      <= whole.center;
            out_patch.ring_points <= ring_points;
            out_patch.minimum     <= 1'b0;
            out_patch.points      <= 13'd0;
            out_patch.primitives  <= 14'd0;
            counted_domain        <= whole.domain;
            counted_out           <= whole.out;
            is_minimum            <= all_one && whole.domain != tess_pkg::ISOLINE;
            product               <= 13'(wide) * 13'(tall);
            lines                 <= tall;
        end
        if (product_valid) begin
            out_patch.minimum <= is_minimum;
            if (is_minimum) begin
                out_patch.points <= (counted_domain == tess_pkg::QUAD) ? 13'd4 : 13'd3;
            end else if (counted_domain == tess_pkg::ISOLINE) begin
                out_patch.points <= product;
            end else begin
                out_patch.points <= inner + ring13;
            end

            if (counted_out == tess_pkg::POINT) begin
                subtrahend <= 14'd0;
            end else if (counted_domain == tess_pkg::ISOLINE) begin
                subtrahend <= {7'd0, lines};
            end else if (counted_out == tess_pkg::LINE) begin
                subtrahend <= 14'd1;
            end else if (is_minimum) begin
                subtrahend <= 14'd2;
            end else begin
                subtrahend <= {1'b0, ring13} + 14'd2;
            end
        end
        if (sum_valid) begin
            out_patch.primitives <= (is_doubled ? {out_patch.points, 1'b0} : {1'b0, out_patch.points}) - subtrahend;
        end
    end
endmodule
