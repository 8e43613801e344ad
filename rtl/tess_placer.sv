// Places points along an edge: takes a factor and a point number per clock, and outputs the 16.16 location.
// It has three registered stages, named after the specification: factor context, place (position), place
// (blend). The signals of each stage are output with the location, for comparison with the model.
module tess_placer (
    input  logic        clk,
    input  logic        rst,

    input  logic        in_valid,
    input  logic [22:0] in_factor,   // 15.16: 1..63 if odd, 1 or 2..64 if even
    input  logic        in_odd,
    input  logic        in_center,   // split order: 0 ruler, 1 center
    input  logic [6:0]  in_p,        // below the edge's point count

    output logic        out_valid,
    output logic [16:0] out_inv_floor,
    output logic [16:0] out_inv_ceil,
    output logic [15:0] out_fraction,
    output logic [5:0]  out_half_points,
    output logic [5:0]  out_split,
    output logic [6:0]  out_points,
    output logic        out_flip,
    output logic [5:0]  out_position,
    output logic [16:0] out_coarse,
    output logic [16:0] out_fine,
    output logic [16:0] out_half_location,
    output logic [16:0] out_location
);
    typedef struct packed {
        logic [16:0] inv_floor;
        logic [16:0] inv_ceil;
        logic [15:0] fraction;
        logic [5:0]  half_points;
        logic [5:0]  split;
        logic [6:0]  points;
    } context_t;

    typedef struct packed {
        logic        flip;
        logic        middle;
        logic [5:0]  position;
        logic [16:0] coarse;
        logic [16:0] fine;
    } position_t;

    // Stage 1: factor context.
    context_t   context_next, context_1;
    logic       valid_1, odd_1;
    logic [6:0] p_1;

    tess_factor_context factor_context (
        .clk, .advance(1'b1),
        .factor     (in_factor),
        .odd        (in_odd),
        .center     (in_center),
        .inv_floor  (context_next.inv_floor),
        .inv_ceil   (context_next.inv_ceil),
        .fraction   (context_next.fraction),
        .half_points(context_next.half_points),
        .split      (context_next.split),
        .points     (context_next.points)
    );

    always_ff @(posedge clk) begin
        valid_1   <= in_valid && !rst;
        context_1 <= context_next;
        odd_1     <= in_odd;
        p_1       <= in_p;
    end

    // Stage 2: position.
    context_t  context_2;
    position_t position_next, position_2;
    logic      valid_2;

    tess_place_position place_position (
        .clk, .advance(1'b1),
        .inv_floor  (context_1.inv_floor),
        .inv_ceil   (context_1.inv_ceil),
        .half_points(context_1.half_points),
        .split      (context_1.split),
        .odd        (odd_1),
        .p          (p_1),
        .flip       (position_next.flip),
        .middle     (position_next.middle),
        .position   (position_next.position),
        .coarse     (position_next.coarse),
        .fine       (position_next.fine)
    );

    always_ff @(posedge clk) begin
        valid_2    <= valid_1 && !rst;
        context_2  <= context_1;
        position_2 <= position_next;
    end

    // Stage 3: blend.
    logic [16:0] half_location_next, location_next;

    tess_place_blend place_blend (
        .clk, .advance(1'b1),
        .fraction     (context_2.fraction),
        .flip         (position_2.flip),
        .middle       (position_2.middle),
        .coarse       (position_2.coarse),
        .fine         (position_2.fine),
        .half_location(half_location_next),
        .location     (location_next)
    );

    always_ff @(posedge clk) begin
        out_valid         <= valid_2 && !rst;
        out_inv_floor     <= context_2.inv_floor;
        out_inv_ceil      <= context_2.inv_ceil;
        out_fraction      <= context_2.fraction;
        out_half_points   <= context_2.half_points;
        out_split         <= context_2.split;
        out_points        <= context_2.points;
        out_flip          <= position_2.flip;
        out_position      <= position_2.position;
        out_coarse        <= position_2.coarse;
        out_fine          <= position_2.fine;
        out_half_location <= half_location_next;
        out_location      <= location_next;
    end
endmodule
