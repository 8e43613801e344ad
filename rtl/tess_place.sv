// Places a point in one dimension (specification, section 5), in six registered clocks: mirror, choose and multiply in
// tess_place_position; multiply, add and mirror in tess_place_blend.
`include "tess_types.svh"
module tess_place (
    input  logic          clk,
    input  logic          advance, // all registers may change
    /* verilator lint_off UNUSEDSIGNAL */ // `points` bounds in_p
    input  tess_context_t in_context,
    /* verilator lint_on UNUSEDSIGNAL */
    input  logic [6:0]    in_p,    // below the context's points
    output logic [16:0]   location // six clocks later: 0..ONE
);
    logic        flip_next, middle_next;
    logic [16:0] coarse_next, fine_next;
    tess_place_position #(.REGISTERED(1'b1)) place_position (
        .clk, .advance,
        .inv_floor  (in_context.inv_floor),
        .inv_ceil   (in_context.inv_ceil),
        .half_points(in_context.half_points),
        .split      (in_context.split),
        .odd        (in_context.odd),
        .p          (in_p),
        .flip       (flip_next),
        .middle     (middle_next),
        /* verilator lint_off PINCONNECTEMPTY */ // only tess_placer outputs it
        .position   (),
        /* verilator lint_on PINCONNECTEMPTY */
        .coarse     (coarse_next),
        .fine       (fine_next)
    );

    logic [15:0] fraction;
    tess_delay #(.WIDTH(16), .CLOCKS(3)) fractions (.clk, .advance, .in(in_context.fraction), .out(fraction));
    logic        flip, middle;
    logic [16:0] coarse, fine;
    always_ff @(posedge clk) begin
        if (advance) begin
            flip   <= flip_next;
            middle <= middle_next;
            coarse <= coarse_next;
            fine   <= fine_next;
        end
    end

    logic [16:0] location_next;
    tess_place_blend #(.REGISTERED(1'b1)) place_blend (
        .clk, .advance,
        .fraction     (fraction),
        .flip         (flip),
        .middle       (middle),
        .coarse       (coarse),
        .fine         (fine),
        /* verilator lint_off PINCONNECTEMPTY */ // only tess_placer outputs it
        .half_location(),
        /* verilator lint_on PINCONNECTEMPTY */
        .location     (location_next)
    );
    logic [16:0] placed;
    always_ff @(posedge clk) begin
        if (advance) begin
            placed <= location_next;
        end
    end
    assign location = placed;
endmodule
