// Carries a tag past a stage: beside each element that the stage makes of a patch is the patch's tag. The stage takes patches
// and makes elements in the same order, the last of each patch with `last`.
//
//   in ----+---- to, from: the stage ----+---- out
//          +------ tags, in order -------+
//
// A patch enters when both the stage and a place for its tag are free, and an element leaves when it and its tag are there. The
// tag leaves with the last element. A tag is stored one clock after its patch has come, so that the handshake ends at a register;
// no stage makes an element as soon. Without USED there are only wires, and the tag is 0.
module tess_tags #(
    parameter bit USED  = 1'b1,
    parameter int WIDTH = 1,
    parameter int LOG   = 3 // 2^LOG tags fit
) (
    /* verilator lint_off UNUSEDSIGNAL */ // wires use neither the clock nor tags
    input  logic             clk,
    input  logic             rst,
    input  logic [13:0]      in_count,  // elements that the stage makes of the patch
    input  logic [WIDTH-1:0] in_tag,
    input  logic             from_last,
    /* verilator lint_on UNUSEDSIGNAL */
    input  logic             in_valid,
    output logic             in_ready,
    output logic             to_valid,
    input  logic             to_ready,
    input  logic             from_valid,
    output logic             from_ready,
    output logic             out_valid,
    input  logic             out_ready,
    output logic [WIDTH-1:0] out_tag
);
    if (!USED) begin : g_wires
        assign to_valid   = in_valid;
        assign in_ready   = to_ready;
        assign out_valid  = from_valid;
        assign from_ready = out_ready;
        assign out_tag    = '0;
    end else begin : g_tags
        logic [WIDTH-1:0] tags [2**LOG];
        logic [LOG-1:0]   first;    // place of the tag that leaves next
        logic             is_there; // there is one
        logic [LOG-1:0]   further;  // number of tags after it
        logic             has_come; // a tag that is stored in this clock: `latest`
        logic [WIDTH-1:0] latest;
        logic             is_full, leaves;
        assign is_full    = &further[LOG-1:1]; // but for `latest` and another
        assign to_valid   = in_valid && !is_full;
        assign in_ready   = to_ready && !is_full;
        assign out_valid  = from_valid && is_there;
        assign from_ready = out_ready && is_there;
        assign out_tag    = tags[first];
        assign leaves     = out_valid && out_ready && from_last;
        always_ff @(posedge clk) begin
            if (rst) begin
                has_come <= 1'b0;
                is_there <= 1'b0;
                first    <= '0;
                further  <= '0;
            end else begin
                has_come <= in_valid && in_ready && in_count != 14'd0;
                is_there <= has_come || (is_there && !(leaves && further == '0));
                first    <= first + LOG'(leaves);
                further  <= further + LOG'(has_come && !leaves && is_there) - LOG'(leaves && !has_come && further != '0);
            end
            latest <= in_tag;
            if (has_come) begin
                tags[first + further + LOG'(is_there)] <= latest;
            end
        end
    end
endmodule
