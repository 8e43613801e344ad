// Times tess_dpi_patch for run.py; the measurement is that of main.rs. Also times the call together with
// reading every element of the held patch.
module calls;
    import tess_dpi::*;

    import "DPI-C" function longint unsigned calls_now();

    localparam int unsigned FACTORS[5] = '{1, 2, 4, 8, 64};
    localparam int unsigned BITS[5] = '{32'h3f80_0000, 32'h4000_0000, 32'h4080_0000, 32'h4100_0000, 32'h4280_0000};

    int unsigned sum;

    function automatic longint unsigned run(input chandle held, input config_t cfg, input factors_t x, input bit read);
        longint unsigned start = calls_now();
        for (int call = 0; call < 100; call++) begin
            counts_t c = model_patch(held, cfg, x);
            if (read) begin
                for (int unsigned i = 0; i < c.points; i++) begin
                    point_t p = model_point(held, i);
                    sum += p.u + p.v;
                end
                for (int unsigned i = 0; i < c.primitives; i++) begin
                    primitive_t p = model_primitive(held, i);
                    sum += p.i0 + p.i1 + p.i2;
                end
            end
            sum += c.points;
        end
        return calls_now() - start;
    endfunction

    initial begin
        config_t cfg;
        chandle held;
        cfg.domain = QUAD;
        cfg.partitioning = INTEGER;
        cfg.out = TRIANGLE_CW;
        cfg.split_order = RULER;
        held = model_open();
        for (int k = 0; k < 5; k++) begin
            longint unsigned best[2];
            best = '{2{64'hffff_ffff_ffff_ffff}};
            for (int turn = 0; turn < 12; turn++) begin
                for (int read = 0; read < 2; read++) begin
                    longint unsigned t = run(held, cfg, {6{BITS[k]}}, read == 1);
                    if (t < best[read]) best[read] = t;
                end
            end
            $display("%0d %.1f %.1f", FACTORS[k], real'(best[0]) / 100.0, real'(best[1]) / 100.0);
        end
        tess_dpi_close(held);
        if (sum == 0) $display("nothing was read");
        $finish;
    end
endmodule
