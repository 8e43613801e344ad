// Tests of the package by itself, for `scripts/verilator`. tess_differences_test compares results of the model with copies of
// them: equal ones must pass, and each planted difference must be found. tess_sequence_test prints what a sequence sends.
package tess_tests;
    import uvm_pkg::*;
    import tess_dpi::*;
    import tess_uvm::*;
    `include "uvm_macros.svh"

    // +tess_difference=N plants one: 1 point, 2 index, 3 number of points, 4 a missing result, 5 a missing v, 6 the result of
    // another patch. All items are cloned, as in environments that keep the items that they receive. +unordered sends the
    // results from the last to the first.
    class tess_differences_test extends uvm_test;
        localparam int PATCHES = 8;
        tess_predictor  predictor;
        tess_scoreboard scoreboard;

        `uvm_component_utils(tess_differences_test)

        function new(string name, uvm_component parent);
            super.new(name, parent);
        endfunction

        virtual function void build_phase(uvm_phase phase);
            super.build_phase(phase);
            predictor  = tess_predictor::type_id::create("predictor", this);
            scoreboard = tess_scoreboard::type_id::create("scoreboard", this);
        endfunction

        virtual function void connect_phase(uvm_phase phase);
            super.connect_phase(phase);
            predictor.results.connect(scoreboard.expected.analysis_export);
        endfunction

        virtual task run_phase(uvm_phase phase);
            tess_result_item kept[$];
            int              difference = 0;
            phase.raise_objection(this);
            void'($value$plusargs("tess_difference=%d", difference));
            for (int n = 0; n < PATCHES; n++) begin
                tess_patch_item  patch = numbered(n);
                tess_patch_item  sent;
                tess_result_item result;
                if (!$cast(sent, patch.clone())) `uvm_fatal("TEST", "a clone of another class")
                if (!$cast(result, tess_predictor::predict(sent).clone())) `uvm_fatal("TEST", "a clone of another class")
                check_clones(patch, result);
                predictor.write(patch);
                if (n == 5) plant(difference, result);
                if (difference != 4 || n != 7) kept.push_back(result);
            end
            scoreboard.unordered = $test$plusargs("unordered") != 0;
            if (scoreboard.unordered) kept.reverse();
            foreach (kept[i]) scoreboard.observed.write(kept[i]);
            phase.drop_objection(this);
        endtask

        protected function tess_patch_item numbered(int number);
            tess_patch_item patch = tess_patch_item::type_id::create("patch");
            patch.domain       = domain_e'(number % 3);
            patch.partitioning = partitioning_e'(number % 4);
            patch.out          = TRIANGLE_CW;
            patch.split_order  = RULER;
            for (int i = 0; i < 6; i++)
                patch.factors[i] = 32'h4000_0000 + 32'(number * 32'h0009_0000 + i * 32'h0010_0000);
            return patch;
        endfunction

        protected function void plant(int difference, tess_result_item result);
            case (difference)
                1: result.v[3] ^= 32'h1;
                2: result.indices[4] ^= 32'h1;
                3: begin
                    void'(result.u.pop_back());
                    void'(result.v.pop_back());
                end
                5: void'(result.v.pop_back());
                6: result.patch.factors[1] = 32'h3F80_0000;
                default: ;
            endcase
        endfunction

        // A clone is equal to the original, and independent of it.
        protected function void check_clones(tess_patch_item patch, tess_result_item result);
            tess_patch_item  other_patch;
            tess_result_item other;
            void'($cast(other_patch, patch.clone()));
            void'($cast(other, result.clone()));
            if (!patch.compare(other_patch) || !result.compare(other)) `uvm_error("TEST", "a clone differs")
            other_patch.factors[0] ^= 32'h1;
            if (patch.compare(other_patch)) `uvm_error("TEST", "patches with other factors are equal")
            other.patch.split_order = CENTER;
            if (result.compare(other) || patch.split_order == CENTER) `uvm_error("TEST", "a clone shares its patch")
            other.patch.split_order = RULER;
            other.indices[0]++;
            if (result.compare(other)) `uvm_error("TEST", "results with other indices are equal")
            if (result.sprint().len() + patch.sprint().len() < 200) `uvm_error("TEST", "little is printed")
        endfunction

        virtual function void report_phase(uvm_phase phase);
            super.report_phase(phase);
            `uvm_info("TESS", $sformatf("%0d patches compared, %0d mismatches", scoreboard.compared, scoreboard.mismatches),
                UVM_LOW)
        endfunction
    endclass

    // Prints each patch that it gets.
    class tess_printing_driver extends uvm_driver #(tess_patch_item);
        `uvm_component_utils(tess_printing_driver)

        function new(string name, uvm_component parent);
            super.new(name, parent);
        endfunction

        virtual task run_phase(uvm_phase phase);
            forever begin
                seq_item_port.get_next_item(req);
                $display("%s", req.convert2string());
                #1 seq_item_port.item_done();
            end
        endtask
    endclass

    // Sends the patches of +tess_cases=FILE to a driver that prints them.
    class tess_sequence_test extends uvm_test;
        uvm_sequencer #(tess_patch_item) sequencer;
        tess_printing_driver             driver;

        `uvm_component_utils(tess_sequence_test)

        function new(string name, uvm_component parent);
            super.new(name, parent);
        endfunction

        virtual function void build_phase(uvm_phase phase);
            super.build_phase(phase);
            sequencer = new("sequencer", this);
            driver    = tess_printing_driver::type_id::create("driver", this);
        endfunction

        virtual function void connect_phase(uvm_phase phase);
            super.connect_phase(phase);
            driver.seq_item_port.connect(sequencer.seq_item_export);
        endfunction

        virtual task run_phase(uvm_phase phase);
            tess_file_sequence patches = tess_file_sequence::type_id::create("patches");
            phase.raise_objection(this);
            patches.start(sequencer);
            $display("%0d sent", patches.sent);
            phase.drop_objection(this);
        endtask
    endclass
endpackage
