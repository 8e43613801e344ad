// What a stage has been given and what has left it, since the last reset: elements, and patches that have any. The proofs
// of the stages say where the difference is.
module ledger #(
    parameter int WIDTH = 14 // of a patch's number of elements
) (
    input  logic             clk, rst,
    input  logic             starts,      // a patch is accepted
    input  logic [WIDTH-1:0] elements,    // of it
    input  logic             leaves,      // an element passes
    input  logic             leaves_last, // and it is the last one of its patch
    output logic [15:0]      held,        // elements that have not left
    output logic [7:0]       held_patches // patches whose last one has not
);
    logic [15:0] accepted, left;
    logic [7:0]  accepted_patches, left_patches;
    always_ff @(posedge clk) begin
        accepted         <= rst ? 16'd0 : accepted + (starts ? 16'(elements) : 16'd0);
        left             <= rst ? 16'd0 : left + 16'(leaves);
        accepted_patches <= rst ? 8'd0 : accepted_patches + 8'(starts && elements != '0);
        left_patches     <= rst ? 8'd0 : left_patches + 8'(leaves && leaves_last);
    end
    assign held         = accepted - left;
    assign held_patches = accepted_patches - left_patches;
endmodule
