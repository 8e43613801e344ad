// One more point of an edge in the same clock: the lanes of tess_points after the first. One coordinate runs along an edge, so a
// lane has one placer for it; the location across the edge is that of the first lane.
`include "tess_types.svh"
module tess_lane (
    input  logic          clk,
    input  logic          advance,    // all registers may change
    input  tess_context_t in_context, // of the coordinate that runs
    input  logic [6:0]    in_p,       // its position; if the lane has a point, below the context's points

    // Six clocks later: the first lane's locations, and the point's place.
    input  logic          a_runs,     // placer A's coordinate is the one that runs
    input  logic [16:0]   in_a,
    input  logic [16:0]   in_b,
    input  logic          is_quad,
    input  logic [2:0]    at,         // AT_ of tess_pkg
    input  logic [1:0]    side,       // number of the edge or the corner

    output logic [16:0]   u,          // ten clocks later
    output logic [16:0]   v
);
    logic [16:0] location;
    tess_place place (.clk, .advance, .in_context, .in_p, .location);
    tess_combine combine (
        .clk, .advance, .is_quad, .at, .side,
        .in_a(a_runs ? location : in_a), .in_b(a_runs ? in_b : location), .u, .v);
endmodule
