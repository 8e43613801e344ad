// tess_stitch, tess_rows and tess_mask as the proof of tess_connect sees them: stitches are taken at any time, the rest is 0.
`include "tess_types.svh"
module tess_stitch (
    input  logic         clk, rst, advance, ahead_valid,
    output logic         takes,
    input  tess_stitch_t ahead,
    output logic         step_valid, step_begins,
    output tess_step_t   step,
    output tess_stitch_t step_stitch
);
    (* anyseq *) logic is_taken;
    assign takes = ahead_valid && is_taken;
    assign {step_valid, step_begins, step, step_stitch} = '0;
endmodule
module tess_rows (
    input  logic         clk, rst, advance, step_valid, step_begins,
    input  tess_step_t   step,
    input  tess_stitch_t step_stitch,
    output logic         out_valid,
    output logic [1:0]   out_size,
    output logic [12:0]  out_i0, out_i1, out_i2,
    output logic         out_last
);
    assign {out_valid, out_size, out_i0, out_i1, out_i2, out_last} = '0;
endmodule
module tess_mask (
    input  logic [5:0]  half,
    input  logic        center,
    output logic [31:0] mask
);
    assign mask = '0;
endmodule
