// Computes u and v from two locations (specification, section 6), in four registered clocks: product, perpendicular, q,
// output.
`include "tess_types.svh"
module tess_combine (
    input  logic        clk,
    input  logic        advance,
    input  logic        is_quad,
    input  logic [2:0]  at,      // AT_ of tess_pkg
    input  logic [1:0]  side,    // number of the edge or the corner
    input  logic [16:0] in_a,
    input  logic [16:0] in_b,
    output logic [16:0] u,       // four clocks later
    output logic [16:0] v
);
    // ---- product: two thirds of the ring's distance --------------------------------------------

    /* verilator lint_off UNUSEDSIGNAL */ // the bits that are rounded away
    logic [32:0] scaled;
    /* verilator lint_on UNUSEDSIGNAL */
    logic [16:0] scaled_a, scaled_b;
    always_ff @(posedge clk) begin
        if (advance) begin
            scaled   <= 33'(in_a) * 33'(tess_pkg::TWO_THIRDS);
            scaled_a <= in_a;
            scaled_b <= in_b;
        end
    end

    // ---- perpendicular -------------------------------------------------------------------------

    logic [16:0] perp, perp_a, perp_b;
    always_ff @(posedge clk) begin
        if (advance) begin
            perp   <= scaled[32:16] + 17'(scaled[15]);
            perp_a <= scaled_a;
            perp_b <= scaled_b;
        end
    end

    // ---- q: along the ring ---------------------------------------------------------------------

    logic [16:0] shift, q, q_perp, beyond, a, a_mirrored, b;
    assign shift = 17'(perp[16:1]) + 17'(perp[0]);
    always_ff @(posedge clk) begin
        if (advance) begin
            q          <= perp_b - shift;
            q_perp     <= perp;
            beyond     <= tess_pkg::ONE - perp;
            a          <= perp_a;
            a_mirrored <= tess_pkg::ONE - perp_a;
            b          <= perp_b;
        end
    end

    // ---- output --------------------------------------------------------------------------------

    logic        quad;
    logic [2:0]  kind;
    logic [1:0]  number;
    tess_delay #(.WIDTH(1 + 3 + 2), .CLOCKS(3)) beside (
        .clk, .advance, .in({is_quad, at, side}), .out({quad, kind, number}));

    logic [16:0] u_next, v_next;
    always_comb begin
        u_next = a;
        v_next = b;
        unique case (kind)
            tess_pkg::AT_CORNER: begin
                // Triangle: (0, ONE), (0, 0), (ONE, 0). Quad: (0, 0), (ONE, 0), (ONE, ONE), (0, ONE).
                u_next = (number == 2'd2 || (number == 2'd1 && quad)) ? tess_pkg::ONE : 17'd0;
                v_next = (quad ? number[1] : number == 2'd0) ? tess_pkg::ONE : 17'd0;
            end
            tess_pkg::AT_OUTER: begin
                unique case (number)
                    2'd0:    begin u_next = 17'd0; v_next = a; end
                    2'd1:    begin u_next = a; v_next = 17'd0; end
                    2'd2:    begin
                        u_next = quad ? tess_pkg::ONE : a;
                        v_next = quad ? a : a_mirrored;
                    end
                    default: begin u_next = a; v_next = tess_pkg::ONE; end
                endcase
            end
            tess_pkg::AT_RING: begin
                if (!quad) begin
                    unique case (number)
                        2'd0:    begin u_next = q_perp; v_next = q; end
                        2'd1:    begin u_next = q; v_next = q_perp; end
                        default: begin u_next = q; v_next = beyond - q; end
                    endcase
                end
            end
            tess_pkg::AT_CENTRE: begin
                if (!quad) begin
                    u_next = tess_pkg::ONE_THIRD;
                    v_next = tess_pkg::ONE_THIRD;
                end
            end
            default: begin
            end
        endcase
    end
    always_ff @(posedge clk) begin
        if (advance) begin
            u <= u_next;
            v <= v_next;
        end
    end
endmodule
