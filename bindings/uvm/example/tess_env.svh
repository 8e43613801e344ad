// The agent and the model. The scoreboard compares the design's results with the predictor's.
class tess_env extends uvm_env;
    tess_agent      agent;
    tess_predictor  predictor;
    tess_scoreboard scoreboard;
`ifndef TESS_NO_COVERGROUPS
    tess_coverage   coverage;
`endif

    `uvm_component_utils(tess_env)

    function new(string name, uvm_component parent);
        super.new(name, parent);
    endfunction

    virtual function void build_phase(uvm_phase phase);
        super.build_phase(phase);
        agent      = tess_agent::type_id::create("agent", this);
        predictor  = tess_predictor::type_id::create("predictor", this);
        scoreboard = tess_scoreboard::type_id::create("scoreboard", this);
`ifndef TESS_NO_COVERGROUPS
        coverage   = tess_coverage::type_id::create("coverage", this);
`endif
    endfunction

    virtual function void connect_phase(uvm_phase phase);
        super.connect_phase(phase);
        agent.monitor.patches.connect(predictor.analysis_export);
        predictor.results.connect(scoreboard.expected.analysis_export);
        agent.monitor.results.connect(scoreboard.observed.analysis_export);
`ifndef TESS_NO_COVERGROUPS
        agent.monitor.patches.connect(coverage.analysis_export);
`endif
    endfunction
endclass
