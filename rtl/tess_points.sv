// The domain points of a patch, one a clock, in the specification's order (section 6).
//
// A walker names the next point: line or ring, edge, position. Each coordinate is a constant or a location, so two
// placers, A and B, serve every point. Four stages: walk, position, blend, combine.
//
//   line         u = A: place(detail, k)        v = B: place(density, line)
//   outer edge   A: place(edge, k or its mirror image); the other coordinate is constant or ONE - A
//   quad ring    u = A, v = B: one runs along the edge, the other is the ring's
//   triangle     A: place(inside, ring), the ring's distance; B: place(inside, ...), which runs along the edge
//   centre       as a ring of a quad; one third on triangles
`include "tess_types.svh"
module tess_points (
    input  logic                               clk,
    input  logic                               rst,

    input  logic                               start_valid,
    output logic                               start_ready,
    input  tess_patch_t                   start_patch,
    input  logic [tess_pkg::CONTEXTS_BITS-1:0] start_contexts,

    output logic                               out_valid,
    input  logic                               out_ready,
    output logic [16:0]                        out_u,
    output logic [16:0]                        out_v,
    output logic                               out_last
);
    localparam logic [2:0] AT_LINE   = 3'd0;
    localparam logic [2:0] AT_CORNER = 3'd1;
    localparam logic [2:0] AT_OUTER  = 3'd2;
    localparam logic [2:0] AT_RING   = 3'd3;
    localparam logic [2:0] AT_CENTRE = 3'd4;

    logic advance;
    assign advance = !out_valid || out_ready;

    // ---- walk ----------------------------------------------------------------------------------

    logic                               active;
    /* verilator lint_off UNUSEDSIGNAL */ // no stage needs every field
    tess_patch_t                   patch;
    /* verilator lint_on UNUSEDSIGNAL */
    logic [tess_pkg::CONTEXTS_BITS-1:0] contexts;
    logic [2:0]                         at;
    logic [5:0]                         ring;  // from 1; the number of a line
    logic [1:0]                         side;  // number of the edge
    logic [6:0]                         k;     // position on the line or edge, in the direction of the walk
    logic [12:0]                        index; // number of the point

    function automatic tess_context_t context_of(
            input logic [tess_pkg::CONTEXTS_BITS-1:0] all, input logic [2:0] i);
        // Constant places: an index times 70 would be a multiplier and a shifter.
        case (i)
            3'd0:    context_of = all[0*tess_pkg::CONTEXT_BITS +: tess_pkg::CONTEXT_BITS];
            3'd1:    context_of = all[1*tess_pkg::CONTEXT_BITS +: tess_pkg::CONTEXT_BITS];
            3'd2:    context_of = all[2*tess_pkg::CONTEXT_BITS +: tess_pkg::CONTEXT_BITS];
            3'd3:    context_of = all[3*tess_pkg::CONTEXT_BITS +: tess_pkg::CONTEXT_BITS];
            3'd4:    context_of = all[4*tess_pkg::CONTEXT_BITS +: tess_pkg::CONTEXT_BITS];
            default: context_of = all[5*tess_pkg::CONTEXT_BITS +: tess_pkg::CONTEXT_BITS];
        endcase
    endfunction

    logic               is_quad;
    tess_context_t detail, density;        // those of an isoline
    tess_context_t along_u, along_v, outer; // inside contexts along u and v, and that of an outer edge
    logic [6:0]         n_u, n_v, n_outer, n_line;
    logic [5:0]         rings_end;               // rings are 1..rings_end-1
    logic               row_along_u;             // the row of points at the centre lies along u
    assign is_quad = patch.domain == tess_pkg::QUAD;
    assign along_u = context_of(contexts, is_quad ? 3'd4 : 3'd3);
    assign along_v = context_of(contexts, is_quad ? 3'd5 : 3'd3);
    assign detail  = context_of(contexts, 3'd1);
    assign density = context_of(contexts, 3'd0);
    assign outer   = context_of(contexts, {1'b0, side});
    assign n_u     = along_u.points;
    assign n_v     = along_v.points;
    assign n_outer = outer.points;
    assign n_line  = detail.points;
    assign row_along_u = n_u > n_v;
    assign rings_end   = row_along_u ? n_v[6:1] : n_u[6:1];

    logic [6:0] end_u, end_v, ring7; // the last positions of this ring
    assign ring7 = {1'b0, ring};
    assign end_u = n_u - 7'd1 - ring7;
    assign end_v = n_v - 7'd1 - ring7;

    logic       is_last, ends_edge, is_last_side, runs_along_v;
    logic [6:0] edge_points; // those of this line or edge; the next edge has its last one
    assign is_last      = index == patch.points - 13'd1;
    assign is_last_side = side == (is_quad ? 2'd3 : 2'd2);
    assign runs_along_v = !side[0];
    always_comb begin
        case (at)
            AT_LINE:  edge_points = n_line;
            AT_OUTER: edge_points = n_outer - 7'd1;
            AT_RING:  edge_points = (runs_along_v ? end_v : end_u) - ring7;
            default:  edge_points = 7'd127; // ends with the patch
        endcase
        ends_edge = k == edge_points - 7'd1;
    end

    assign start_ready = advance && (!active || is_last);

    always_ff @(posedge clk) begin
        if (rst) begin
            active <= 1'b0;
        end else if (advance) begin
            if (start_valid && start_ready) begin
                active   <= start_patch.points != 13'd0;
                patch    <= start_patch;
                contexts <= start_contexts;
                ring     <= 6'd0;
                side     <= 2'd0;
                k        <= 7'd0;
                index    <= 13'd0;
                if (start_patch.domain == tess_pkg::ISOLINE) at <= AT_LINE;
                else                                         at <= start_patch.minimum ? AT_CORNER : AT_OUTER;
            end else if (active) begin
                active <= !is_last;
                index  <= index + 13'd1;
                k      <= ends_edge ? 7'd0 : k + 7'd1;
                if (ends_edge) begin
                    side <= (at == AT_LINE || is_last_side) ? 2'd0 : side + 2'd1;
                    if (at == AT_LINE || is_last_side) begin
                        ring <= ring + 6'd1;
                        if (at != AT_LINE) at <= (ring + 6'd1 < rings_end) ? AT_RING : AT_CENTRE;
                    end
                end
            end
        end
    end

    // ---- what the placers place ----------------------------------------------------------------

    tess_context_t a_context, b_context;
    logic [6:0]         a_p, b_p;
    logic               backward; // the walk of this edge begins at the far end
    assign backward = (side == 2'd0) || (side == (is_quad ? 2'd3 : 2'd2));
    always_comb begin
        a_context = along_u;
        b_context = along_v;
        a_p = 7'd0;
        b_p = 7'd0;
        case (at)
            AT_LINE: begin
                a_context = detail;
                b_context = density;
                a_p = k;
                b_p = ring7;
            end
            AT_OUTER: begin
                a_context = outer;
                a_p = backward ? n_outer - 7'd1 - k : k;
            end
            AT_RING: begin
                if (!is_quad) begin
                    a_p = ring7;
                    b_p = backward ? end_v - k : ring7 + k;
                end else if (runs_along_v) begin
                    a_p = (side == 2'd0) ? ring7 : end_u;
                    b_p = backward ? end_v - k : ring7 + k;
                end else begin
                    a_p = backward ? end_u - k : ring7 + k;
                    b_p = (side == 2'd1) ? ring7 : end_v;
                end
            end
            AT_CENTRE: begin
                // `ring` is now the number of the row; across it lies the middle of the shorter axis.
                a_p = row_along_u ? ring7 + k : ring7;
                b_p = row_along_u ? ring7 : end_v - k;
            end
            default: begin
            end
        endcase
    end

    logic [16:0] a, b;
    tess_place place_a (.clk, .advance, .in_context(a_context), .in_p(a_p), .location(a));
    tess_place place_b (.clk, .advance, .in_context(b_context), .in_p(b_p), .location(b));

    // ---- combine -------------------------------------------------------------------------------

    // What goes beside the placers.
    typedef struct packed {
        logic       valid;
        logic       last;
        logic       is_quad;
        logic [2:0] at;
        logic [1:0] side;
    } walked_t;
    walked_t walked, position, blend;
    always_comb begin
        walked.valid   = active;
        walked.last    = is_last;
        walked.is_quad = is_quad;
        walked.at      = at;
        walked.side    = (at == AT_CORNER) ? k[1:0] : side;
    end

    always_ff @(posedge clk) begin
        if (rst) begin
            position.valid <= 1'b0;
            blend.valid    <= 1'b0;
        end else if (advance) begin
            position <= walked;
            blend    <= position;
        end
    end

    /* verilator lint_off UNUSEDSIGNAL */ // the bits that are rounded away
    logic [32:0] scaled;
    /* verilator lint_on UNUSEDSIGNAL */
    logic [16:0] perp, shift, q, across, u, v;
    always_comb begin
        scaled = 33'(a) * 33'(tess_pkg::TWO_THIRDS) + 33'(tess_pkg::HALF);
        perp   = scaled[32:16];
        shift  = (perp + 17'd1) >> 1;
        q      = b - shift;
        across = tess_pkg::ONE - q - perp;
        u = a;
        v = b;
        case (blend.at)
            AT_CORNER: begin
                // Triangle: (0, ONE), (0, 0), (ONE, 0). Quad: (0, 0), (ONE, 0), (ONE, ONE), (0, ONE).
                u = (blend.side == 2'd2 || (blend.side == 2'd1 && blend.is_quad)) ? tess_pkg::ONE : 17'd0;
                v = (blend.is_quad ? blend.side[1] : blend.side == 2'd0) ? tess_pkg::ONE : 17'd0;
            end
            AT_OUTER: begin
                case (blend.side)
                    2'd0:    begin u = 17'd0; v = a; end
                    2'd1:    begin u = a; v = 17'd0; end
                    2'd2:    begin
                        u = blend.is_quad ? tess_pkg::ONE : a;
                        v = blend.is_quad ? a : tess_pkg::ONE - a;
                    end
                    default: begin u = a; v = tess_pkg::ONE; end
                endcase
            end
            AT_RING: begin
                if (!blend.is_quad) begin
                    case (blend.side)
                        2'd0:    begin u = perp; v = q; end
                        2'd1:    begin u = q; v = perp; end
                        default: begin u = q; v = across; end
                    endcase
                end
            end
            AT_CENTRE: begin
                if (!blend.is_quad) begin
                    u = tess_pkg::ONE_THIRD;
                    v = tess_pkg::ONE_THIRD;
                end
            end
            default: begin
            end
        endcase
    end

    always_ff @(posedge clk) begin
        if (rst) begin
            out_valid <= 1'b0;
        end else if (advance) begin
            out_valid <= blend.valid;
            out_u     <= u;
            out_v     <= v;
            out_last  <= blend.last;
        end
    end
endmodule
