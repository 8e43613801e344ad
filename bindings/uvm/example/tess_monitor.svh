// Observes only the ports. Sends each patch to `patches` when the design accepts it, and its result to `results` when
// the design has output the last element.
//
// The three streams are independent of each other. The counts state how many elements the other streams have for a patch;
// a culled patch has none. It is an error if a `last` does not agree with the counts.
class tess_monitor extends uvm_component;
    uvm_analysis_port #(tess_patch_item)  patches;
    uvm_analysis_port #(tess_result_item) results;
    virtual tess_if                       ports;

    int unsigned taken = 0; // patches that the design has accepted
    int unsigned given = 0; // results that were sent

    protected tess_patch_item waiting[$];              // accepted patches without a result
    protected int unsigned    points_of[$];            // counts that have arrived
    protected int unsigned    primitives_of[$];
    protected int unsigned    u[$], v[$], indices[$];  // elements of patches without a result
    protected int unsigned    ends_of_points[$];       // sizes of the runs that `last` ended
    protected int unsigned    ends_of_primitives[$];   // in primitives
    protected int unsigned    ends_of_indices[$];      // the same runs in indices
    protected int unsigned    points = 0, primitives = 0, some_indices = 0;

    `uvm_component_utils(tess_monitor)

    function new(string name, uvm_component parent);
        super.new(name, parent);
        patches = new("patches", this);
        results = new("results", this);
    endfunction

    virtual function void build_phase(uvm_phase phase);
        super.build_phase(phase);
        if (!uvm_config_db#(virtual tess_if)::get(this, "", "ports", ports))
            `uvm_fatal("TESS", "the monitor has no ports: set the tess_if of `ports`")
    endfunction

    virtual task run_phase(uvm_phase phase);
        forever begin
            @(posedge ports.clk);
            if (!ports.rst) begin
                if (ports.patch_valid && ports.patch_ready) take_patch();
                if (ports.counts_valid && ports.counts_ready) begin
                    points_of.push_back(32'(ports.counts_points));
                    primitives_of.push_back(32'(ports.counts_primitives));
                end
                if (ports.point_valid && ports.point_ready) take_point();
                if (ports.primitive_valid && ports.primitive_ready) take_primitive();
                while (is_complete()) give();
            end
        end
    endtask

    protected function void take_patch();
        tess_patch_item item = new("observed");
        item.domain       = domain_e'(32'(ports.patch_domain));
        item.partitioning = partitioning_e'(32'(ports.patch_partitioning));
        item.out          = output_e'(32'(ports.patch_out));
        item.split_order  = ports.patch_center ? CENTER : RULER;
        for (int i = 0; i < 6; i++) item.factors[i] = ports.patch_factors[32 * i +: 32];
        taken++;
        waiting.push_back(item);
        patches.write(item);
    endfunction

    protected function void take_point();
        u.push_back(32'(ports.point_u));
        v.push_back(32'(ports.point_v));
        points++;
        if (ports.point_last) begin
            ends_of_points.push_back(points);
            points = 0;
        end
    endfunction

    protected function void take_primitive();
        indices.push_back(32'(ports.primitive_i0));
        if (ports.primitive_size > 2'd1) indices.push_back(32'(ports.primitive_i1));
        if (ports.primitive_size > 2'd2) indices.push_back(32'(ports.primitive_i2));
        primitives++;
        some_indices += 32'(ports.primitive_size);
        if (ports.primitive_last) begin
            ends_of_primitives.push_back(primitives);
            ends_of_indices.push_back(some_indices);
            primitives   = 0;
            some_indices = 0;
        end
    endfunction

    // Whether the result of the oldest patch is complete.
    protected function bit is_complete();
        if (waiting.size() == 0 || points_of.size() == 0) return 0;
        if (points_of[0] != 0 && ends_of_points.size() == 0) return 0;
        return primitives_of[0] == 0 || ends_of_primitives.size() != 0;
    endfunction

    // Sends the result of the oldest patch.
    protected function void give();
        tess_result_item r = new("observed");
        int unsigned     said_points     = points_of.pop_front();
        int unsigned     said_primitives = primitives_of.pop_front();
        int unsigned     got_points      = said_points == 0 ? 0 : ends_of_points.pop_front();
        int unsigned     got_primitives  = said_primitives == 0 ? 0 : ends_of_primitives.pop_front();
        int unsigned     got_indices     = said_primitives == 0 ? 0 : ends_of_indices.pop_front();
        r.patch = waiting.pop_front();
        if (got_points != said_points || got_primitives != said_primitives)
            `uvm_error("TESS", $sformatf("the counts say %0d points and %0d primitives, the last ones are %0d and %0d\n%s",
                said_points, said_primitives, got_points, got_primitives, r.patch.convert2string()))
        for (int unsigned i = 0; i < got_points; i++) begin
            r.u.push_back(u.pop_front());
            r.v.push_back(v.pop_front());
        end
        for (int unsigned i = 0; i < got_indices; i++) r.indices.push_back(indices.pop_front());
        given++;
        results.write(r);
    endfunction

    // Elements that belong to no patch.
    virtual function void check_phase(uvm_phase phase);
        super.check_phase(phase);
        if (waiting.size() != 0 || points_of.size() != 0 || u.size() != 0 || indices.size() != 0)
            `uvm_error("TESS", $sformatf("at the end %0d patches, %0d points and %0d indices are left over",
                waiting.size(), u.size(), indices.size()))
    endfunction
endclass
