// The positions of a half edge that have a point: bit k - 1 is set if position k has one (specification, section 14.3).
// Combinational.
module tess_mask (
    input  logic [5:0]  half,   // half steps, 0..32: half_points, less one if odd
    input  logic        center, // split order: 0 ruler, 1 center
    output logic [31:0] mask
);
    logic [31:0] ruler;
    always_comb begin
        case (half)
            6'd2: ruler = 32'h00010000;
            6'd3: ruler = 32'h00010100;
            6'd4: ruler = 32'h01010100;
            6'd5: ruler = 32'h01010110;
            6'd6: ruler = 32'h01011110;
            6'd7: ruler = 32'h01111110;
            6'd8: ruler = 32'h11111110;
            6'd9: ruler = 32'h11111114;
            6'd10: ruler = 32'h11111154;
            6'd11: ruler = 32'h11111554;
            6'd12: ruler = 32'h11115554;
            6'd13: ruler = 32'h11155554;
            6'd14: ruler = 32'h11555554;
            6'd15: ruler = 32'h15555554;
            6'd16: ruler = 32'h55555554;
            6'd17: ruler = 32'h55555556;
            6'd18: ruler = 32'h5555555E;
            6'd19: ruler = 32'h5555557E;
            6'd20: ruler = 32'h555555FE;
            6'd21: ruler = 32'h555557FE;
            6'd22: ruler = 32'h55555FFE;
            6'd23: ruler = 32'h55557FFE;
            6'd24: ruler = 32'h5555FFFE;
            6'd25: ruler = 32'h5557FFFE;
            6'd26: ruler = 32'h555FFFFE;
            6'd27: ruler = 32'h557FFFFE;
            6'd28: ruler = 32'h55FFFFFE;
            6'd29: ruler = 32'h57FFFFFE;
            6'd30: ruler = 32'h5FFFFFFE;
            6'd31: ruler = 32'h7FFFFFFE;
            6'd32: ruler = 32'hFFFFFFFE;
            default: ruler = 32'd0;
        endcase
        // Center order: the lowest half - 1 bits.
        mask = center ? ((half == 6'd0) ? 32'd0 : ~(32'hFFFF_FFFF << (half - 6'd1))) : ruler;
    end
endmodule
