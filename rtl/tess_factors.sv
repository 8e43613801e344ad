// The front end: raw factors in, the contexts and counts of a patch out (specification, sections 3, 4, 12.6).
//
// One factor goes through each clock, in three steps:
//   issue    tess_factor clamps, rounds and converts factor k
//   context  tess_factor_context makes its context, which goes to place k of `contexts`
//   counts   when all have theirs: the numbers of points and primitives
// A quad takes 9 clocks, and the next patch is 7 clocks behind it. While a finished patch waits, everything waits.
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
    output tess_patch_t                    out_patch,
    output logic [tess_pkg::CONTEXTS_BITS-1:0]  out_contexts
);
    logic advance;
    assign advance = !out_valid || out_ready;

    // ---- the patch whose factors are issued ----------------------------------------------------

    logic         busy;
    logic [1:0]   domain, partitioning, out;
    logic         center;
    logic [191:0] factors;
    logic [2:0]   k;

    logic [2:0] factor_count, outer_count;
    always_comb begin
        factor_count = (domain == tess_pkg::ISOLINE) ? 3'd2 : (domain == tess_pkg::TRIANGLE) ? 3'd4 : 3'd6;
        outer_count  = (domain == tess_pkg::ISOLINE) ? 3'd2 : (domain == tess_pkg::TRIANGLE) ? 3'd3 : 3'd4;
    end

    // Steps 1 and 4 look at all factors of the patch. Greater than zero: not negative, not zero, not NaN.
    logic [5:0] is_positive, is_large, is_there, is_outer;
    for (genvar i = 0; i < tess_pkg::FACTORS; i++) begin : g_factor
        logic [31:0] x;
        assign x = factors[32*i +: 32];
        assign is_positive[i] = !x[31] && x[30:0] != 31'd0 && x[30:0] <= 31'h7F80_0000;
        assign is_large[i]    = is_positive[i] && x[30:0] > 31'h3F80_0040;
        assign is_there[i]    = 3'(i) < factor_count;
        assign is_outer[i]    = 3'(i) < outer_count;
    end
    logic is_culled, has_frame;
    assign is_culled = (is_outer & ~is_positive) != 6'd0;
    assign has_frame = (is_there & is_large) != 6'd0;

    logic issues, issues_last, context_valid;
    // The first factor of a patch waits until the contexts of the patch before have been counted.
    assign issues      = busy && !(k == 3'd0 && context_valid);
    assign issues_last = issues && (is_culled || k == factor_count - 3'd1);
    assign in_ready    = advance && (!busy || issues_last);

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
                k            <= 3'd0;
            end else if (issues) begin
                busy <= !issues_last;
                k    <= k + 3'd1;
            end
        end
    end

    logic [31:0] bits; // of factor k
    always_comb begin
        case (k)
            3'd0:    bits = factors[0*32 +: 32];
            3'd1:    bits = factors[1*32 +: 32];
            3'd2:    bits = factors[2*32 +: 32];
            3'd3:    bits = factors[3*32 +: 32];
            3'd4:    bits = factors[4*32 +: 32];
            default: bits = factors[5*32 +: 32];
        endcase
    end
    logic [22:0] fixed_next;
    logic        odd_next;
    tess_factor factor (
        .bits        (bits),
        .partitioning(domain == tess_pkg::ISOLINE && k == 3'd0 ? tess_pkg::INTEGER : partitioning),
        .is_inside   (k >= outer_count),
        .has_frame   (has_frame),
        .fixed       (fixed_next),
        .odd         (odd_next)
    );

    // ---- the factor whose context is made ------------------------------------------------------

    tess_patch_t context_patch; // without counts
    logic             context_last, context_culled, context_is_outer;
    logic [2:0]       context_k;
    logic [22:0]      fixed;
    logic             odd;

    always_ff @(posedge clk) begin
        if (rst) begin
            context_valid <= 1'b0;
        end else if (advance) begin
            context_valid           <= issues;
            context_last            <= issues_last;
            context_culled          <= is_culled;
            context_is_outer        <= k < outer_count;
            context_k               <= k;
            fixed                   <= fixed_next;
            odd                     <= odd_next;
            context_patch.domain    <= domain;
            context_patch.out       <= out;
            context_patch.center    <= center;
            context_patch.minimum   <= domain != tess_pkg::ISOLINE;
            context_patch.points    <= 13'd0;
            context_patch.primitives <= 14'd0;
        end
    end

    tess_context_t made;
    assign made.odd = odd;
    tess_factor_context factor_context (
        .factor     (fixed),
        .odd        (odd),
        .center     (context_patch.center),
        .inv_floor  (made.inv_floor),
        .inv_ceil   (made.inv_ceil),
        .fraction   (made.fraction),
        .half_points(made.half_points),
        .split      (made.split),
        .points     (made.points)
    );

    // ---- the patch whose elements are counted --------------------------------------------------

    tess_patch_t counted;
    logic             counted_valid, counted_culled;
    logic             all_one;     // every factor so far equals ONE
    logic [8:0]       outer_edges; // the sum of n - 1 over the outer edges so far: B of section 12.6
    logic             starts;
    assign starts = context_k == 3'd0;

    always_ff @(posedge clk) begin
        if (rst) begin
            counted_valid <= 1'b0;
        end else if (advance) begin
            counted_valid <= context_valid && context_last;
            if (context_valid) begin
                for (int i = 0; i < tess_pkg::FACTORS; i++) begin
                    if (context_k == 3'(i)) out_contexts[tess_pkg::CONTEXT_BITS*i +: tess_pkg::CONTEXT_BITS] <= made;
                end
                counted         <= context_patch;
                counted_culled  <= context_culled;
                all_one         <= (starts || all_one) && fixed == 23'h01_0000;
                if (starts)                outer_edges <= {2'd0, made.points} - 9'd1;
                else if (context_is_outer) outer_edges <= outer_edges + {2'd0, made.points} - 9'd1;
            end
        end
    end

    // The point counts that the numbers of elements are made of.
    logic [12:0] n0, n1, n3, n4, n5, half, inner_points, points, edges;
    logic [13:0] primitives;
    logic        is_minimum;
    always_comb begin
        n0 = {6'd0, out_contexts[0*tess_pkg::CONTEXT_BITS +: 7]};
        n1 = {6'd0, out_contexts[1*tess_pkg::CONTEXT_BITS +: 7]};
        n3 = {6'd0, out_contexts[3*tess_pkg::CONTEXT_BITS +: 7]};
        n4 = {6'd0, out_contexts[4*tess_pkg::CONTEXT_BITS +: 7]};
        n5 = {6'd0, out_contexts[5*tess_pkg::CONTEXT_BITS +: 7]};
        is_minimum = counted.minimum && all_one;
        edges = 13'(outer_edges);
        half = n3 >> 1;
        inner_points = 13'd0;
        if (counted.domain == tess_pkg::QUAD) inner_points = (n4 - 13'd2) * (n5 - 13'd2);
        else if (n3[0])                       inner_points = 13'd3 * half * (half - 13'd1) + 13'd1;
        else                                  inner_points = 13'd3 * (half - 13'd1) * (half - 13'd1);

        if (counted.domain == tess_pkg::ISOLINE) points = (n0 - 13'd1) * n1;
        else if (is_minimum)                     points = (counted.domain == tess_pkg::QUAD) ? 13'd4 : 13'd3;
        else                                     points = edges + inner_points;

        if (counted.out == tess_pkg::POINT)           primitives = {1'b0, points};
        else if (counted.domain == tess_pkg::ISOLINE) primitives = {1'b0, (n0 - 13'd1) * (n1 - 13'd1)};
        else if (counted.out == tess_pkg::LINE)       primitives = {1'b0, points} - 14'd1;
        else if (is_minimum)                          primitives = {1'b0, points} - 14'd2;
        else                                          primitives = {points, 1'b0} - 14'd2 - {1'b0, edges};
    end

    always_ff @(posedge clk) begin
        if (rst) begin
            out_valid <= 1'b0;
        end else if (advance) begin
            out_valid <= counted_valid;
            if (counted_valid) begin
                out_patch            <= counted;
                out_patch.minimum    <= is_minimum;
                out_patch.points     <= counted_culled ? 13'd0 : points;
                out_patch.primitives <= counted_culled ? 14'd0 : primitives;
            end
        end
    end
endmodule
