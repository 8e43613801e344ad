// Sends the model's result for each patch.
class tess_predictor extends uvm_subscriber #(tess_patch_item);
    uvm_analysis_port #(tess_result_item) results;

    `uvm_component_utils(tess_predictor)

    function new(string name, uvm_component parent);
        super.new(name, parent);
        results = new("results", this);
    endfunction

    virtual function void write(tess_patch_item t);
        results.write(predict(t));
    endfunction

    static function tess_result_item predict(tess_patch_item patch);
        chandle          held = model_open();
        factors_t        x;
        counts_t         counts;
        tess_result_item r = new("expected");
        patch.get_factors(x);
        counts = model_patch(held, patch.cfg(), x);
        r.patch = patch;
        for (int unsigned i = 0; i < counts.points; i++) begin
            point_t p = model_point(held, i);
            r.u.push_back(p.u);
            r.v.push_back(p.v);
        end
        for (int unsigned i = 0; i < counts.primitives; i++) begin
            primitive_t p = model_primitive(held, i);
            r.indices.push_back(p.i0);
            if (p.size > 1) r.indices.push_back(p.i1);
            if (p.size > 2) r.indices.push_back(p.i2);
        end
        tess_dpi_close(held);
        return r;
    endfunction
endclass
