// Sends the patches of +tess_cases=FILE through the design. FILE may be that of `tess gen --level 1 -o level-1.csv`.
class tess_file_test extends uvm_test;
    tess_env     env;
    int unsigned patience = 200_000; // clocks within which a result must arrive; the largest patch has 8192 primitives

    `uvm_component_utils(tess_file_test)

    function new(string name, uvm_component parent);
        super.new(name, parent);
    endfunction

    virtual function void build_phase(uvm_phase phase);
        super.build_phase(phase);
        env = tess_env::type_id::create("env", this);
    endfunction

    virtual task run_phase(uvm_phase phase);
        tess_file_sequence patches = tess_file_sequence::type_id::create("patches");
        phase.raise_objection(this);
        patches.start(env.agent.sequencer);
        drain();
        phase.drop_objection(this);
    endtask

    // Waits for the last result.
    protected task drain();
        tess_monitor monitor = env.agent.monitor;
        int unsigned last = monitor.given;
        int unsigned clocks = 0;
        while (monitor.given < monitor.taken) begin
            @(posedge monitor.ports.clk);
            clocks = monitor.given == last ? clocks + 1 : 0;
            last = monitor.given;
            if (clocks > patience) begin
                `uvm_error("TESS", $sformatf("no result in %0d clocks", patience))
                return;
            end
        end
    endtask

    virtual function void report_phase(uvm_phase phase);
        super.report_phase(phase);
        `uvm_info("TESS", $sformatf("%0d patches compared, %0d mismatches",
            env.scoreboard.compared, env.scoreboard.mismatches), UVM_LOW)
    endfunction
endclass
