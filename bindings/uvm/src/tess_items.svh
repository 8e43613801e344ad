// A patch. The factors are bits of binary32 numbers, in the order of tess_dpi::factors_t.
class tess_patch_item extends uvm_sequence_item;
    rand domain_e       domain;
    rand partitioning_e partitioning;
    rand output_e       out;
    rand split_order_e  split_order;
    rand bit [31:0]     factors[6];

    `uvm_object_utils(tess_patch_item)

    // Mostly small factors, as simulations are slow: 1 to 16 with all fractions. A test that wants every
    // bit pattern turns this off.
    constraint c_small {
        foreach (factors[i]) factors[i] inside {[32'h3F80_0000 : 32'h4180_0000]};
    }

    function new(string name = "tess_patch_item");
        super.new(name);
    endfunction

    function config_t cfg();
        config_t c;
        c.domain = domain;
        c.partitioning = partitioning;
        c.out = out;
        c.split_order = split_order;
        return c;
    endfunction

    // The factors as tess_dpi takes them.
    function void get_factors(output factors_t x);
        for (int i = 0; i < 6; i++) x[i] = factors[i];
    endfunction

    // Everything that the result depends on.
    virtual function string convert2string();
        return $sformatf("domain=%0d partitioning=%0d output=%0d split=%0d %08x %08x %08x %08x %08x %08x",
            domain, partitioning, out, split_order,
            factors[0], factors[1], factors[2], factors[3], factors[4], factors[5]);
    endfunction
endclass

// What comes out for a patch: 16.16 points, and indices, one after another.
class tess_result_item extends uvm_sequence_item;
    tess_patch_item patch;
    int unsigned    u[$];
    int unsigned    v[$];
    int unsigned    indices[$];

    `uvm_object_utils(tess_result_item)

    function new(string name = "tess_result_item");
        super.new(name);
    endfunction
endclass
