// A ledger of the elements that enter, leave and are in a stage, and of patches, by their last elements. The stage must hold
// what has entered since the last reset and has not left. `also` is a further invariant. Proved by induction.
module ledger (
    input logic        clk, rst,
    input logic [15:0] came, left,           // elements that enter and leave in this clock
    input logic        came_last, left_last, // the last element of a patch is among them
    input logic [15:0] held,                 // elements before this clock
    input logic [7:0]  held_last,
    input logic        also
);
    logic        has_begun = 1'b0;
    logic [15:0] due;
    logic [7:0]  due_last;
    always_ff @(posedge clk) begin
        has_begun <= 1'b1;
        due       <= rst ? 16'd0 : due + came - left;
        due_last  <= rst ? 8'd0 : due_last + 8'(came_last) - 8'(left_last);
    end
    always_comb begin
        if (!has_begun) assume (rst);
        if (has_begun && !rst) assert (also && held == due && held_last == due_last);
        cover (has_begun && !rst && left != 16'd0);
    end
endmodule
