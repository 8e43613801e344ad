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

// Compares results exactly. A difference is reported with its first wrong element, the stage of the
// specification that it points to, and the patch as a line that `tess patch --cases` accepts.
class tess_scoreboard extends uvm_component;
    tess_result_input expected; // connect the predictor's port to expected.analysis_export
    tess_result_input observed; // and the monitor's to observed.analysis_export

    // Whether results may arrive in an order other than that of the patches. They are then paired by equal patches.
    bit unordered;

    int unsigned compared;
    int unsigned mismatches;

    protected tess_result_item expected_queue[$];
    protected tess_result_item observed_queue[$];

    `uvm_component_utils(tess_scoreboard)

    function new(string name, uvm_component parent);
        super.new(name, parent);
        expected = new("expected", this);
        expected.scoreboard = this;
        expected.is_expected = 1'b1;
        observed = new("observed", this);
        observed.scoreboard = this;
    endfunction

    // Takes a result, and compares it if its partner has arrived.
    virtual function void take(bit is_expected, tess_result_item t);
        int at;
        if (t.patch == null) begin
            `uvm_error("TESS", "a result has no patch")
            return;
        end
        at = is_expected ? partner(observed_queue, t) : partner(expected_queue, t);
        if (at < 0) begin
            if (is_expected) expected_queue.push_back(t);
            else             observed_queue.push_back(t);
        end else if (is_expected) begin
            compare_two(t, observed_queue[at]);
            observed_queue.delete(at);
        end else begin
            compare_two(expected_queue[at], t);
            expected_queue.delete(at);
        end
    endfunction

    // The position of the first result that this one is paired with; -1 if there is none.
    protected function int partner(const ref tess_result_item waiting[$], input tess_result_item t);
        string wanted = t.patch.convert2string();
        if (!unordered) return waiting.size() == 0 ? -1 : 0;
        foreach (waiting[i]) if (waiting[i].patch.convert2string() == wanted) return i;
        return -1;
    endfunction

    protected function void compare_two(tess_result_item right, tess_result_item found);
        string asked = right.patch.convert2string();
        string what = found.patch.convert2string() == asked ? first_difference(right, found)
            : {"the result is of ", found.patch.convert2string(), " (stage: answer)"};
        compared++;
        if (what != "") begin
            mismatches++;
            `uvm_error("TESS", {what, "\n", asked})
        end
    endfunction

    // The first difference, with counts first; empty if the results are equal.
    static function string first_difference(tess_result_item right, tess_result_item found);
        if (found.u.size() != found.v.size())
            return $sformatf("number of coordinates: observed %0d u and %0d v, expected %0d of each (stage: counts)",
                found.u.size(), found.v.size(), right.u.size());
        if (found.u.size() != right.u.size())
            return $sformatf("number of points: observed %0d, expected %0d (stage: counts)",
                found.u.size(), right.u.size());
        if (found.indices.size() != right.indices.size())
            return $sformatf("number of indices: observed %0d, expected %0d (stage: counts)",
                found.indices.size(), right.indices.size());
        for (int i = 0; i < right.u.size(); i++) begin
            if (found.u[i] != right.u[i] || found.v[i] != right.v[i])
                return $sformatf("point %0d: observed (%05x, %05x), expected (%05x, %05x) (stage: location)",
                    i, found.u[i], found.v[i], right.u[i], right.v[i]);
        end
        for (int i = 0; i < right.indices.size(); i++) begin
            if (found.indices[i] != right.indices[i])
                return $sformatf("index %0d: observed %0d, expected %0d (stage: stitch)",
                    i, found.indices[i], right.indices[i]);
        end
        return "";
    endfunction

    // A run fails if it compared nothing, or if results were not compared.
    virtual function void check_phase(uvm_phase phase);
        super.check_phase(phase);
        if (compared == 0) `uvm_error("TESS", "nothing was compared")
        if (expected_queue.size() != 0 || observed_queue.size() != 0)
            `uvm_error("TESS", $sformatf("%0d expected and %0d observed results have no partner",
                expected_queue.size(), observed_queue.size()))
    endfunction
endclass
