// Offers each patch of the sequencer to the design until the design accepts it.
class tess_driver extends uvm_driver #(tess_patch_item);
    virtual tess_if ports;

    `uvm_component_utils(tess_driver)

    function new(string name, uvm_component parent);
        super.new(name, parent);
    endfunction

    virtual function void build_phase(uvm_phase phase);
        super.build_phase(phase);
        if (!uvm_config_db#(virtual tess_if)::get(this, "", "ports", ports))
            `uvm_fatal("TESS", "the driver has no ports: set the tess_if of `ports`")
    endfunction

    virtual task run_phase(uvm_phase phase);
        tess_patch_item item;
        do @(negedge ports.clk); while (ports.rst);
        forever begin
            seq_item_port.get_next_item(item);
            drive(item);
            seq_item_port.item_done();
        end
    endtask

    protected task drive(tess_patch_item item);
        ports.patch_valid        = 1'b1;
        ports.patch_domain       = 2'(item.domain);
        ports.patch_partitioning = 2'(item.partitioning);
        ports.patch_out          = 2'(item.out);
        ports.patch_center       = item.split_order == CENTER;
        for (int i = 0; i < 6; i++) ports.patch_factors[32 * i +: 32] = item.factors[i];
        do @(posedge ports.clk); while (!ports.patch_ready);
        @(negedge ports.clk);
        ports.patch_valid = 1'b0;
    endtask
endclass

// Accepts the design's output. Each stream is stalled at random in the given percentage of clocks.
class tess_sink extends uvm_component;
    virtual tess_if ports;
    int unsigned    stalls = 25;

    `uvm_component_utils(tess_sink)

    function new(string name, uvm_component parent);
        super.new(name, parent);
    endfunction

    virtual function void build_phase(uvm_phase phase);
        super.build_phase(phase);
        if (!uvm_config_db#(virtual tess_if)::get(this, "", "ports", ports))
            `uvm_fatal("TESS", "the sink has no ports: set the tess_if of `ports`")
    endfunction

    virtual task run_phase(uvm_phase phase);
        forever begin
            @(negedge ports.clk);
            ports.counts_ready    = $urandom_range(99) >= stalls;
            ports.point_ready     = $urandom_range(99) >= stalls;
            ports.primitive_ready = $urandom_range(99) >= stalls;
        end
    endtask
endclass
