// Checks single stages against the golden model over DPI-C, for every input of a range.
//
//   +first=N +factors=M   M 15.16 factors from N: the context, and the place of every point, for each parity that the
//                         factor has and both split orders. With +contexts only contexts; with +placer every signal of
//                         the stages of tess_placer; with +stride=N every Nth factor
//   +bits=HEX +words=M    M binary32 patterns from HEX: factor processing in every partitioning, of outer and inside
//                         factors, with and without the picture frame
// Exit: PASS with the numbers of comparisons, or $fatal.
module tb_stages;
    import tess_dpi::*;

    localparam int unsigned MAX_SHOWN = 20;
    // Points that are placed per clock: a clock of the simulator costs more than a placement.
    localparam int unsigned LANES = 16;
    localparam int unsigned CLOCKS = 6; // of a placement
    int unsigned     mismatches = 0;
    longint unsigned contexts_checked = 0, places_checked = 0, factors_checked = 0;

    function automatic void differs(
            input string stage, input string signal, input int unsigned given, input int unsigned element,
            input int unsigned observed, input int unsigned expected);
        mismatches++;
        if (mismatches <= MAX_SHOWN)
            $display("MISMATCH stage=%s signal=%s input=0x%08x element=%0d observed=0x%05x expected=0x%05x",
                stage, signal, given, element, observed, expected);
        if (mismatches == MAX_SHOWN) $fatal(1, "FAIL");
    endfunction

    // The signals of the three stages of a place, in the order of the data flow.
    localparam int unsigned SIGNALS = 12;
    string STAGES[3] = '{"factor_context", "place_position", "place_blend"};
    string NAMES[SIGNALS] = '{"fraction", "half_points", "points", "split", "inv_floor", "inv_ceil",
        "flip", "position", "coarse", "fine", "half_location", "location"};
    typedef bit [SIGNALS-1:0][31:0] signals_t;

    function automatic bit [5:0][31:0] of_context(input context_t c);
        return {c.inv_ceil, c.inv_floor, c.split, c.points, c.half_points, c.fraction};
    endfunction

    function automatic bit [5:0][31:0] of_place(input placement_t s);
        return {s.location, s.half_location, s.fine, s.coarse, s.position, s.flip};
    endfunction

    // Only the first wrong signal is reported, because later ones follow from it.
    function automatic void check_signals(
            input signals_t observed, input signals_t expected, input int unsigned given, input int unsigned element);
        if (observed == expected) return;
        for (int unsigned i = 0; i < SIGNALS; i++) begin
            if (observed[i] == expected[i]) continue;
            differs(STAGES[(i < 6) ? 0 : (i < 10) ? 1 : 2], NAMES[i], given, element, observed[i], expected[i]);
            return;
        end
    endfunction

    // ---- context and place ---------------------------------------------------------------------

    logic          clk = 1'b0;
    logic [22:0]   factor;
    logic          center;
    tess_context_t made;
    logic          odd;
    logic [6:0]    p [LANES];        // of the points that enter in this clock
    logic [16:0]   location [LANES]; // of the points that entered CLOCKS clocks ago
    assign made.odd = odd;
    tess_factor_context #(.REGISTERED(1'b1)) factor_context (
        .clk, .advance(1'b1), .factor, .odd, .center,
        .inv_floor  (made.inv_floor),
        .inv_ceil   (made.inv_ceil),
        .fraction   (made.fraction),
        .half_points(made.half_points),
        .split      (made.split),
        .points     (made.points)
    );
    for (genvar lane = 0; lane < LANES; lane++) begin : lanes
        tess_place place (.clk, .advance(1'b1), .in_context(made), .in_p(p[lane]), .location(location[lane]));
    end

    task automatic tick();
        #1 clk = 1'b1;
        #1 clk = 1'b0;
    endtask

    task automatic check_context(input int unsigned fixed, input bit is_odd, input bit is_center);
        context_t c;
        factor = 23'(fixed);
        odd    = is_odd;
        center = is_center;
        c = model_context(fixed, parity_e'(is_odd), split_order_e'(is_center));
        if ($test$plusargs("placer")) begin
            check_placer(fixed, c);
            return;
        end
        repeat (2) tick();
        #1;
        check_signals({192'd0, 32'(made.inv_ceil), 32'(made.inv_floor), 32'(made.split), 32'(made.points),
            32'(made.half_points), 32'(made.fraction)}, {192'd0, of_context(c)}, fixed, 0);
        contexts_checked++;
        if (!$test$plusargs("contexts")) check_places(fixed, c.points);
    endtask

    // The locations of the points are output CLOCKS edges later.
    task automatic check_places(input int unsigned fixed, input int unsigned points);
        for (int unsigned next = 0; next < points + CLOCKS * LANES; next += LANES) begin
            for (int unsigned lane = 0; lane < LANES; lane++) p[lane] = (next + lane < points) ? 7'(next + lane) : 7'd0;
            tick();
            if (next + LANES >= CLOCKS * LANES) begin
                for (int unsigned lane = 0; lane < LANES; lane++)
                    check_place(fixed, points, next + LANES - CLOCKS * LANES + lane, location[lane]);
            end
        end
    endtask

    function automatic void check_place(
            input int unsigned fixed, input int unsigned points, input int unsigned k, input logic [16:0] observed);
        placement_t s;
        if (k >= points) return;
        s = model_place(fixed, parity_e'(odd), split_order_e'(center), k);
        if (32'(observed) != s.location) differs("place", "location", fixed, k, 32'(observed), s.location);
        places_checked++;
    endfunction

    // ---- tess_placer ---------------------------------------------------------------------------

    logic     rst = 1'b1;
    logic     placer_in = 1'b0, placer_out;
    signals_t placed = '0;
    tess_placer placer (
        .clk, .rst,
        .in_valid         (placer_in),
        .in_factor        (factor),
        .in_odd           (odd),
        .in_center        (center),
        .in_p             (p[0]),
        .out_valid        (placer_out),
        .out_fraction     (placed[0][15:0]),
        .out_half_points  (placed[1][5:0]),
        .out_points       (placed[2][6:0]),
        .out_split        (placed[3][5:0]),
        .out_inv_floor    (placed[4][16:0]),
        .out_inv_ceil     (placed[5][16:0]),
        .out_flip         (placed[6][0]),
        .out_position     (placed[7][5:0]),
        .out_coarse       (placed[8][16:0]),
        .out_fine         (placed[9][16:0]),
        .out_half_location(placed[10][16:0]),
        .out_location     (placed[11][16:0])
    );

    // Sends a point per clock, which is output three edges later; nothing may be output before or after.
    task automatic check_placer(input int unsigned fixed, input context_t c);
        for (int unsigned k = 0; k < c.points + 3; k++) begin
            placement_t s;
            placer_in = k < c.points;
            p[0] = placer_in ? 7'(k) : 7'd0;
            tick();
            if (placer_out != (k >= 2 && k < c.points + 2))
                differs("placer", "valid", fixed, k, 32'(placer_out), 32'(!placer_out));
            if (k < 2 || k >= c.points + 2) continue;
            s = model_place(fixed, parity_e'(odd), split_order_e'(center), k - 2);
            check_signals(placed, {of_place(s), of_context(c)}, fixed, k - 2);
            places_checked++;
        end
        contexts_checked++;
    endtask

    // ---- factor processing ---------------------------------------------------------------------

    logic [31:0] bits;
    logic [1:0]  partitioning;
    logic        is_inside, has_frame;
    logic [22:0] fixed;
    logic        fixed_odd;
    tess_factor processing (
        .clk, .advance(1'b1), .bits, .partitioning, .is_inside, .has_frame, .fixed, .odd(fixed_odd));

    // Whether the model applies the picture frame: it then increases an inside factor 1. If the patch is
    // culled, only the factor of `framed` can exceed 1.
    function automatic bit model_frame(input int unsigned word, input bit framed);
        config_t    cfg;
        factors_t   x = '{default: 32'h3F80_0000};
        processed_t r;
        cfg.domain       = TRIANGLE;
        cfg.partitioning = FRACTIONAL_ODD;
        cfg.out          = TRIANGLE_CW;
        cfg.split_order  = RULER;
        if (framed) x[1] = 32'h4000_0000;
        x[2] = word;
        r = model_process(cfg, x, 3);
        return (r.outcome == CULLED) ? framed : r.fixed != 32'h1_0000;
    endfunction

    // Processes a triangle patch. The factor is outer 0 or inside; the frame is due to outer 1 or to the factor itself.
    task automatic check_word(input int unsigned word, input int unsigned place_of, input bit framed);
        config_t    cfg;
        factors_t   x;
        processed_t r;
        x    = '{default: 32'h3F80_0000};
        x[1] = framed ? 32'h4000_0000 : 32'h3F80_0000;
        x[place_of] = word;
        is_inside  = place_of == 3;
        bits       = word;
        has_frame  = model_frame(word, framed);
        cfg.domain = TRIANGLE;
        cfg.out    = TRIANGLE_CW;
        cfg.split_order = RULER;
        for (int unsigned number = 0; number < 4; number++) begin
            partitioning     = 2'(number);
            cfg.partitioning = partitioning_e'(number);
            r = model_process(cfg, x, place_of);
            #1;
            if (r.outcome != CULLED) begin
                if (32'(fixed) != r.fixed) differs("factors", "fixed", word, number, 32'(fixed), r.fixed);
                if (32'(fixed_odd) != int'(r.parity)) differs("factors", "odd", word, number, 32'(fixed_odd), int'(r.parity));
                factors_checked++;
            end
        end
    endtask

    // ---- ranges --------------------------------------------------------------------------------

    int unsigned first = 0, factors = 0, stride = 1, from = 0, words = 0;

    initial begin
        void'($value$plusargs("first=%d", first));
        void'($value$plusargs("factors=%d", factors));
        void'($value$plusargs("stride=%d", stride));
        void'($value$plusargs("bits=%h", from));
        void'($value$plusargs("words=%d", words));
        if (factors != 0 && (first < 32'h1_0000 || first + (factors - 1) * stride > 32'h40_0000))
            $fatal(1, "factors are 0x10000 to 0x400000, not 0x%05x to 0x%05x", first, first + (factors - 1) * stride);
        // Points that enter during a reset are not output.
        placer_in = 1'b1;
        repeat (3) tick();
        rst = 1'b0;
        // Even factors are 1 or 2 to 64, odd ones 1 to 63 (section 3).
        for (int unsigned f = first; f < first + factors * stride; f += stride) begin
            for (int unsigned order = 0; order < 2; order++) begin
                if (f == 32'h1_0000 || f >= 32'h2_0000) check_context(f, 1'b0, order == 1);
                if (f <= 32'h3F_0000) check_context(f, 1'b1, order == 1);
            end
        end
        for (int unsigned i = 0; i < words; i++) begin
            check_word(from + i, 0, 1'b0);
            check_word(from + i, 3, 1'b0);
            check_word(from + i, 0, 1'b1);
            check_word(from + i, 3, 1'b1);
        end
        $display("%0d contexts, %0d places, %0d processed factors, %0d mismatches",
            contexts_checked, places_checked, factors_checked, mismatches);
        if (mismatches != 0) $fatal(1, "FAIL");
        if (contexts_checked + factors_checked == 0) $fatal(1, "FAIL: nothing was checked");
        $display("PASS");
        $finish;
    end
endmodule
