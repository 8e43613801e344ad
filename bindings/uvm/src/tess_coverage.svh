// Samples the covergroups with the bins that each patch hits according to the model.
class tess_coverage extends uvm_subscriber #(tess_patch_item);
    tess_covergroups groups;

    `uvm_component_utils(tess_coverage)

    function new(string name, uvm_component parent);
        super.new(name, parent);
        groups = new();
    endfunction

    virtual function void write(tess_patch_item t);
        config_t     cfg = t.cfg();
        factors_t    x;
        int unsigned bin;
        t.get_factors(x);
        for (int unsigned i = 0; model_coverage(cfg, x, i, bin); i++) groups.sample(bin);
    endfunction
endclass
