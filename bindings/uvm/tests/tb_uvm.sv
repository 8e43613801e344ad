// Runs predictor and scoreboard: equal results pass, each planted difference is found. With the stub
// of UVM; `+fault=N` takes a difference: 1 point, 2 index, 3 number of points, 4 a result too few,
// 5 a v too few.
module tb_uvm;
    import uvm_pkg::*;
    import tess_dpi::*;
    import tess_uvm::*;

    localparam int PATCHES = 8;

    tess_predictor  predictor;
    tess_scoreboard scoreboard;
    uvm_component   top;
    uvm_phase       phase;
    int             fault = 0;

    function automatic tess_patch_item patch(int number);
        tess_patch_item p = new("patch");
        p.domain       = domain_e'(number % 3);
        p.partitioning = partitioning_e'(number % 4);
        p.out          = TRIANGLE_CW;
        p.split_order  = RULER;
        for (int i = 0; i < 6; i++) p.factors[i] = 32'h4000_0000 + 32'(number * 32'h0009_0000 + i * 32'h0010_0000);
        return p;
    endfunction

    initial begin
        if ($value$plusargs("fault=%d", fault)) $display("planted fault %0d", fault);
        predictor  = new("predictor", top);
        scoreboard = new("scoreboard", top);
        phase      = new("check");
        predictor.results.connect(scoreboard.expected.analysis_export);
        for (int n = 0; n < PATCHES; n++) begin
            automatic tess_patch_item  p = patch(n);
            automatic tess_result_item observed = tess_predictor::predict(p);
            predictor.write(p);
            if (n == 5) begin
                if (fault == 1) observed.v[3] = observed.v[3] ^ 32'h1;
                if (fault == 2) observed.indices[4] = observed.indices[4] ^ 32'h1;
                if (fault == 3) begin
                    void'(observed.u.pop_back());
                    void'(observed.v.pop_back());
                end
                if (fault == 5) void'(observed.v.pop_back());
            end
            if (!(fault == 4 && n == 7)) scoreboard.observed.write(observed);
        end
        scoreboard.check_phase(phase);
        $display("%0d compared, %0d mismatches, %0d errors",
            scoreboard.compared, scoreboard.mismatches, errors);
        if (errors != 0) $fatal(1, "FAIL");
        $display("PASS");
        $finish;
    end
endmodule
