// Runs predictor and scoreboard with the stub of UVM. Equal results must pass, and each planted difference must be found.
// `+fault=N` plants a difference: 1 point, 2 index, 3 number of points, 4 a missing result, 5 a missing v, 6 the result of
// another patch. All items are cloned, as in environments that keep the items that they receive. `+unordered` sends the
// results from the last to the first. `+tess_cases=FILE` only sends the patches of a file through a sequencer and prints
// them.
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
    tess_result_item kept[$];

    // A clone is equal to the original, and independent of it.
    task automatic check_clones(tess_patch_item p, tess_result_item r);
        tess_patch_item  q;
        tess_result_item s;
        uvm_printer      printer = new();
        uvm_comparer     comparer = new();
        uvm_object       qo, so; // exactly the arguments' types, as Verilator 5.006 requires
        qo = p.clone();
        so = r.clone();
        if (!$cast(q, qo) || !$cast(s, so)) $fatal(1, "FAIL: a clone of another class");
        comparer.m_compares = 1;
        if (!p.do_compare(qo, comparer)) $fatal(1, "FAIL: a clone differs");
        if (!p.compare(qo) || !r.compare(so)) $fatal(1, "FAIL: a clone differs");
        q.factors[0] = q.factors[0] ^ 32'h1;
        if (p.compare(qo)) $fatal(1, "FAIL: patches with other factors are equal");
        s.patch.split_order = CENTER;
        if (r.compare(so) || p.split_order == CENTER) $fatal(1, "FAIL: a clone shares its patch");
        s.patch.split_order = RULER;
        s.indices[0] = s.indices[0] + 1;
        if (r.compare(so)) $fatal(1, "FAIL: results with other indices are equal");
        r.do_print(printer);
        p.do_print(printer);
        if (printer.m_text.len() < 200) $fatal(1, "FAIL: little is printed: %s", printer.m_text);
    endtask

    function automatic tess_patch_item patch(int number);
        tess_patch_item p = new("patch");
        p.domain       = domain_e'(number % 3);
        p.partitioning = partitioning_e'(number % 4);
        p.out          = TRIANGLE_CW;
        p.split_order  = RULER;
        for (int i = 0; i < 6; i++) p.factors[i] = 32'h4000_0000 + 32'(number * 32'h0009_0000 + i * 32'h0010_0000);
        return p;
    endfunction

    tess_file_sequence     sequence_of_file;
    uvm_sequencer_base     sequencer;
    uvm_seq_item_pull_port port;
    bit                    is_sent = 1'b0;

    // Takes the items of the sequence, as a driver does.
    task automatic print_sequence();
        uvm_sequence_item next;
        sequence_of_file = new("cases");
        sequencer = new("sequencer", top);
        port = new();
        port.connect(sequencer.seq_item_export);
        fork
            begin
                sequence_of_file.start(sequencer);
                is_sent = 1'b1;
                $display("%0d sent", sequence_of_file.sent);
                $finish;
            end
        join_none
        while (!is_sent) begin
            port.get_next_item(next);
            $display("%s", next.convert2string());
            #1 port.item_done();
        end
    endtask

    initial if ($test$plusargs("tess_cases=") != 0) print_sequence();

    initial if ($test$plusargs("tess_cases=") == 0) begin
        if ($value$plusargs("fault=%d", fault)) $display("planted fault %0d", fault);
        predictor  = new("predictor", top);
        scoreboard = new("scoreboard", top);
        phase      = new("check");
        predictor.results.connect(scoreboard.expected.analysis_export);
        for (int n = 0; n < PATCHES; n++) begin
            automatic tess_patch_item  p = patch(n);
            automatic tess_result_item observed;
            automatic tess_patch_item  q;
            automatic tess_result_item predicted;
            if (!$cast(q, p.clone())) $fatal(1, "FAIL: a clone of another class");
            predicted = tess_predictor::predict(q);
            if (!$cast(observed, predicted.clone())) $fatal(1, "FAIL: a clone of another class");
            check_clones(p, observed);
            predictor.write(p);
            if (n == 5) begin
                if (fault == 1) observed.v[3] = observed.v[3] ^ 32'h1;
                if (fault == 2) observed.indices[4] = observed.indices[4] ^ 32'h1;
                if (fault == 3) begin
                    void'(observed.u.pop_back());
                    void'(observed.v.pop_back());
                end
                if (fault == 5) void'(observed.v.pop_back());
                if (fault == 6) observed.patch.factors[1] = 32'h3F80_0000;
            end
            if (!(fault == 4 && n == 7)) kept.push_back(observed);
        end
        scoreboard.unordered = $test$plusargs("unordered") != 0;
        if (scoreboard.unordered) kept.reverse();
        foreach (kept[i]) scoreboard.observed.write(kept[i]);
        scoreboard.check_phase(phase);
        $display("%0d compared, %0d mismatches, %0d errors",
            scoreboard.compared, scoreboard.mismatches, errors);
        if (errors != 0) $fatal(1, "FAIL");
        $display("PASS");
        $finish;
    end
endmodule
