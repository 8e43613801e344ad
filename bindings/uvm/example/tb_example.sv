// rtl/tess_top in the environment of tess_example. Run with +UVM_TESTNAME=tess_file_test +tess_cases=FILE
module tb_example;
    import uvm_pkg::*;
    import tess_example::*;

    logic clk = 1'b0;
    always #5 clk = ~clk;

    tess_if ports (.clk);

    tess_top dut (
        .clk,
        .rst               (ports.rst),
        .patch_valid       (ports.patch_valid),
        .patch_ready       (ports.patch_ready),
        .patch_domain      (ports.patch_domain),
        .patch_partitioning(ports.patch_partitioning),
        .patch_out         (ports.patch_out),
        .patch_center      (ports.patch_center),
        .patch_factors     (ports.patch_factors),
        .patch_tag         (1'b0),
        .patch_first       (1'b0),
        .counts_valid      (ports.counts_valid),
        .counts_ready      (ports.counts_ready),
        .counts_points     (ports.counts_points),
        .counts_primitives (ports.counts_primitives),
        .counts_tag        (),
        .point_valid       (ports.point_valid),
        .point_ready       (ports.point_ready),
        .point_keep        (),
        .point_u           (ports.point_u),
        .point_v           (ports.point_v),
        .point_last        (ports.point_last),
        .point_tag         (),
        .primitive_valid   (ports.primitive_valid),
        .primitive_ready   (ports.primitive_ready),
        .primitive_size    (ports.primitive_size),
        .primitive_i0      (ports.primitive_i0),
        .primitive_i1      (ports.primitive_i1),
        .primitive_i2      (ports.primitive_i2),
        .primitive_last    (ports.primitive_last),
        .primitive_tag     ()
    );

    initial begin
        repeat (3) @(negedge clk);
        ports.rst = 1'b0;
    end

    initial begin
        uvm_config_db#(virtual tess_if)::set(null, "*", "ports", ports);
        run_test("tess_file_test");
    end
endmodule
