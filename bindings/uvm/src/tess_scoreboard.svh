typedef class tess_scoreboard;

// One of the scoreboard's two inputs.
class tess_result_input extends uvm_subscriber #(tess_result_item);
    tess_scoreboard scoreboard;
    bit             is_expected;

    `uvm_component_utils(tess_result_input)

    function new(string name, uvm_component parent);
        super.new(name, parent);
    endfunction

    virtual function void write(tess_result_item t);
        scoreboard.take(is_expected, t);
    endfunction
endclass

// Compares results in order, exactly. Each difference is reported with its first wrong element.
class tess_scoreboard extends uvm_component;
    tess_result_input expected; // connect the predictor's port to expected.analysis_export
    tess_result_input observed; // and the monitor's to observed.analysis_export

    int unsigned compared;
    int unsigned mismatches;

    protected tess_result_item expected_queue[$];
    protected tess_result_item observed_queue[$];

    `uvm_component_utils(tess_scoreboard)

    function new(string name, uvm_component parent);
        uvm_component self; // of the argument's very type, which Verilator 5.006 asks for
        super.new(name, parent);
        self = this;
        expected = new("expected", self);
        expected.scoreboard = this;
        expected.is_expected = 1'b1;
        observed = new("observed", self);
        observed.scoreboard = this;
    endfunction

    // Takes a result, and compares as long as there is one of each.
    virtual function void take(bit is_expected, tess_result_item t);
        if (is_expected) expected_queue.push_back(t);
        else             observed_queue.push_back(t);
        while (expected_queue.size() > 0 && observed_queue.size() > 0) begin
            tess_result_item right = expected_queue.pop_front();
            tess_result_item found = observed_queue.pop_front();
            string what = first_difference(right, found);
            compared++;
            if (what != "") begin
                mismatches++;
                `uvm_error("TESS", {what, "; ", right.patch.convert2string()})
            end
        end
    endfunction

    // The first element that differs, counts first; empty if none does.
    static function string first_difference(tess_result_item right, tess_result_item found);
        if (found.u.size() != found.v.size())
            return $sformatf("number of coordinates: observed %0d u and %0d v, expected %0d of each",
                found.u.size(), found.v.size(), right.u.size());
        if (found.u.size() != right.u.size())
            return $sformatf("number of points: observed %0d, expected %0d",
                found.u.size(), right.u.size());
        if (found.indices.size() != right.indices.size())
            return $sformatf("number of indices: observed %0d, expected %0d",
                found.indices.size(), right.indices.size());
        for (int i = 0; i < right.u.size(); i++) begin
            if (found.u[i] != right.u[i] || found.v[i] != right.v[i])
                return $sformatf("point %0d: observed (%05x, %05x), expected (%05x, %05x)",
                    i, found.u[i], found.v[i], right.u[i], right.v[i]);
        end
        for (int i = 0; i < right.indices.size(); i++) begin
            if (found.indices[i] != right.indices[i])
                return $sformatf("index %0d: observed %0d, expected %0d",
                    i, found.indices[i], right.indices[i]);
        end
        return "";
    endfunction

    // A run that compared nothing, or left something over, has not passed.
    virtual function void check_phase(uvm_phase phase);
        super.check_phase(phase);
        if (compared == 0) `uvm_error("TESS", "nothing was compared")
        if (expected_queue.size() != 0 || observed_queue.size() != 0)
            `uvm_error("TESS", $sformatf("%0d expected and %0d observed results have no partner",
                expected_queue.size(), observed_queue.size()))
    endfunction
endclass
