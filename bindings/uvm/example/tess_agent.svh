class tess_sequencer extends uvm_sequencer #(tess_patch_item);
    `uvm_component_utils(tess_sequencer)

    function new(string name, uvm_component parent);
        super.new(name, parent);
    endfunction
endclass

// The components that access the ports of one tessellator.
class tess_agent extends uvm_agent;
    tess_sequencer sequencer;
    tess_driver    driver;
    tess_sink      sink;
    tess_monitor   monitor;

    `uvm_component_utils(tess_agent)

    function new(string name, uvm_component parent);
        super.new(name, parent);
    endfunction

    virtual function void build_phase(uvm_phase phase);
        super.build_phase(phase);
        monitor = tess_monitor::type_id::create("monitor", this);
        if (get_is_active() == UVM_ACTIVE) begin
            sequencer = tess_sequencer::type_id::create("sequencer", this);
            driver    = tess_driver::type_id::create("driver", this);
            sink      = tess_sink::type_id::create("sink", this);
        end
    endfunction

    virtual function void connect_phase(uvm_phase phase);
        super.connect_phase(phase);
        if (get_is_active() == UVM_ACTIVE) driver.seq_item_port.connect(sequencer.seq_item_export);
    endfunction
endclass
