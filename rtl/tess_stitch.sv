// Walks a stitch, one step per clock. A step states which row advances, and on which row the primitive begins
// (specification, sections 7.2 to 7.4; 14.3 for the masks).
//
// A transition walks two half edges in split order. Its mask has a bit for every position of each row that has a point, so
// the next step is the lowest bit; the way back walks the mask with its bits reversed. The row of that bit is determined a
// clock later, from the bits of the outer row.
//
//   mask of outer positions 2, 3 and inner position 2:  ..0011'1000     bit 2k inner, 2k + 1 outer, positions from 0 here
//   way out   lowest bits:   inner 1, outer 1, outer 2 ..
`include "tess_types.svh"
module tess_stitch (
    input  logic         clk,
    input  logic         rst,
    input  logic         advance,     // all registers may change
    input  logic         ahead_valid,
    output logic         takes,       // `ahead` is taken
    input  tess_stitch_t ahead,

    output logic         step_valid,
    output logic         step_begins, // it is the first one of `step_stitch`
    output tess_step_t   step,
    output tess_stitch_t step_stitch
);
    // ---- the walk ------------------------------------------------------------------------------

    logic         walks;
    tess_stitch_t here;
    logic [6:0]   to_come;    // steps of this stitch after this one
    logic         ends;       // no step of this stitch follows; 1 if there is no step
    logic         is_first, is_odd; // the number of the step: 0; odd
    logic [6:0]   pairs;      // pairs before the middle; negative after it
    logic [2:0]   phase;      // of a transition
    logic [5:0]   masked;     // steps of this way after this one
    logic [63:0]  left;       // the rest of the mask

    assign takes = advance && ahead_valid && ends;

    logic [63:0] reversed;
    for (genvar i = 0; i < 64; i++) begin : g_reversed
        assign reversed[i] = here.mask[63-i];
    end

    // The kind of step that follows each kind; kinds that this transition does not have are skipped.
    logic       has_masked, ends_way;
    logic [2:0] behind_inner, behind_out, behind_first, behind_outer, phase_next;
    assign has_masked   = here.masked != 6'd0;
    assign ends_way     = masked == 6'd1;
    assign behind_outer = has_masked ? tess_pkg::BACK : tess_pkg::LAST;
    assign behind_inner = here.has_outer ? tess_pkg::MIDDLE_OUTER : behind_outer;
    assign behind_out   = here.has_inner ? tess_pkg::MIDDLE_INNER : behind_inner;
    assign behind_first = has_masked ? tess_pkg::OUT : behind_out;
    always_comb begin
        unique case (phase)
            tess_pkg::FIRST:        phase_next = behind_first;
            tess_pkg::OUT:          phase_next = ends_way ? behind_out : tess_pkg::OUT;
            tess_pkg::MIDDLE_INNER: phase_next = behind_inner;
            tess_pkg::MIDDLE_OUTER: phase_next = behind_outer;
            tess_pkg::BACK:         phase_next = ends_way ? tess_pkg::LAST : tess_pkg::BACK;
            default:                phase_next = tess_pkg::LAST;
        endcase
    end

    logic is_masked, holds;
    assign is_masked = phase == tess_pkg::OUT || phase == tess_pkg::BACK;
    assign holds     = phase == tess_pkg::FIRST;
    always_ff @(posedge clk) begin
        if (rst) begin
            walks <= 1'b0;
            ends  <= 1'b1;
        end else if (takes) begin
            walks <= 1'b1;
            ends  <= ahead.further == 7'd0;
        end else if (advance && ends) begin
            walks <= 1'b0;
        end else if (advance) begin
            ends  <= to_come == 7'd1;
        end

        if (takes) begin
            here     <= ahead;
            to_come  <= ahead.further;
            is_first <= 1'b1;
            is_odd   <= 1'b0;
            pairs    <= ahead.middle;
            phase    <= ahead.begins;
            masked   <= ahead.masked;
            left     <= ahead.mask;
        end else if (advance) begin
            to_come  <= to_come - 7'd1;
            is_first <= 1'b0;
            is_odd   <= !is_odd;
            // A pair ends with its second step; the first step of a ring precedes its pairs.
            if (here.kind == tess_pkg::RING ? !is_odd && !is_first : is_odd) begin
                pairs <= pairs - 7'd1;
            end
            phase    <= phase_next;
            masked   <= (is_masked && !ends_way) ? masked - 6'd1 : here.masked;
            if (is_masked && !ends_way) begin
                left <= left & (left - 64'd1);
            end else if (!holds) begin
                left <= reversed;
            end
        end
    end

    // ---- the step, without the row of a mask's bit ---------------------------------------------

    tess_step_t next;
    logic       is_before_middle, is_middle;
    assign is_before_middle = !pairs[6];
    assign is_middle        = pairs == 7'd0;
    always_comb begin
        next.last           = here.last && ends;
        next.advances_outer = 1'b1;
        next.begins_outer   = 1'b1;
        unique case (here.kind)
            tess_pkg::TRANSITION: begin
                next.advances_outer = phase != tess_pkg::MIDDLE_INNER;
                next.begins_outer   = phase != tess_pkg::MIDDLE_INNER && phase != tess_pkg::MIDDLE_OUTER;
            end
            tess_pkg::RING: begin
                // Diagonals are mirrored about the middle.
                if (!is_first && !ends) begin
                    next.advances_outer = !is_odd == is_before_middle;
                    next.begins_outer   = is_before_middle;
                end
            end
            tess_pkg::STRIP: begin
                next.advances_outer = !is_odd;
                next.begins_outer   = 1'b0;
            end
            tess_pkg::STRIP_EXCEPT_MIDDLE: begin
                // All diagonals forward except one.
                next.advances_outer = is_odd == is_middle;
                next.begins_outer   = is_middle || !is_odd;
            end
            default: begin
            end
        endcase
    end

    logic         made_valid, made_begins, made_masked, made_back;
    tess_step_t   made;
    tess_stitch_t made_stitch;
    logic [31:0]  lowest; // the lowest bit, if the outer row has it
    logic [63:0]  borrow;
    assign borrow = left - 64'd1;
    always_ff @(posedge clk) begin
        if (rst) begin
            made_valid <= 1'b0;
        end else if (advance) begin
            made_valid <= walks;
        end
        if (advance) begin
            made        <= next;
            made_begins <= is_first;
            made_stitch <= here;
            made_masked <= here.kind == tess_pkg::TRANSITION && is_masked;
            made_back   <= phase == tess_pkg::BACK;
            for (int i = 0; i < 32; i++) begin
                lowest[i] <= left[2*i+1] && !borrow[2*i+1];
            end
        end
    end

    // ---- the row -------------------------------------------------------------------------------

    logic is_outer;
    assign is_outer = (lowest != 32'd0) != made_back;
    always_ff @(posedge clk) begin
        if (rst) begin
            step_valid <= 1'b0;
        end else if (advance) begin
            step_valid <= made_valid;
        end
        if (advance) begin
            step        <= made;
            step_begins <= made_begins;
            step_stitch <= made_stitch;
            if (made_masked) begin
                step.advances_outer <= is_outer;
                step.begins_outer   <= is_outer;
            end
        end
    end
endmodule
