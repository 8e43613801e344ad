// The front end's own signals for tb_tess: each converted factor and its context, compared with the model.

// Factors after conversion, two clocks before their contexts.
logic [22:0] fixed[2];
always @(posedge clk) begin
    if (axis.top.stage_factors.advance) begin
        fixed[0] <= axis.top.stage_factors.fixed;
        fixed[1] <= fixed[0];
    end
end

// The front end: each factor and its context. Culled patches have none.
function automatic void check_factor();
    stimulus_t   s;
    int unsigned k = 32'(axis.top.stage_factors.context_k);
    processed_t  p;
    bit          is_culled = axis.top.stage_factors.context_tag.culled;
    if (of_factors.size() == 0) begin // a factor of a patch that a reset has withdrawn, or of no patch
        tess_check_pkg::failed("factors", "valid", "tess_factors");
        return;
    end
    s = of_factors[0];
    p.outcome = CULLED; // of domain 3, which the model refuses
    if (s.domain != 2'd3) p = model_process(config_of(s), s.x, k);
    compare(s, FACTORS_CULLED, k, 32'(is_culled), 32'(p.outcome == CULLED));
    if (!is_culled && p.outcome != CULLED) begin
        context_t c = model_context(p.fixed, p.parity, split_order_e'(s.split));
        compare(s, FACTORS_FIXED, k, 32'(fixed[1]), p.fixed);
        compare(s, FACTORS_ODD, k, 32'(axis.top.stage_factors.made.odd), int'(p.parity));
        compare(s, FACTOR_CONTEXT_FRACTION, k, 32'(axis.top.stage_factors.made.fraction), c.fraction);
        compare(s, FACTOR_CONTEXT_HALF_POINTS, k, 32'(axis.top.stage_factors.made.half_points), c.half_points);
        compare(s, FACTOR_CONTEXT_POINTS, k, 32'(axis.top.stage_factors.made.points), c.points);
        compare(s, FACTOR_CONTEXT_SPLIT, k, 32'(axis.top.stage_factors.made.split), c.split);
        compare(s, FACTOR_CONTEXT_INV_FLOOR, k, 32'(axis.top.stage_factors.made.inv_floor), c.inv_floor);
        compare(s, FACTOR_CONTEXT_INV_CEIL, k, 32'(axis.top.stage_factors.made.inv_ceil), c.inv_ceil);
    end
    if (axis.top.stage_factors.context_last) void'(of_factors.pop_front());
endfunction
