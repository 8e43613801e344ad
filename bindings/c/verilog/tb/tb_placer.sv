// Checks tess_placer against the golden model, signal by signal in the order of its stages.
//
// Stimuli: level 1, which is every integer and half factor with its neighbours at one unit (2^-16), both
// parities, both split orders, every point of each edge; then random factors; then a file, if given.
//   +random=N      that many random factors (default 2000), each with every point
//   +seed=N        seed of the random factors (default 1)
//   +stimuli=FILE  a $readmemh file of 32-bit words, one factor each: digit 7 is 1 for center split
//                  order, digit 6 is 1 for odd, the last six digits are the 15.16 factor
// Each difference prints the word that repeats it as a stimulus.
module tb_placer;
    import tess_dpi::*;

    localparam int unsigned HALF      = 32'h8000;
    localparam int unsigned ONE       = 32'h1_0000;
    localparam int unsigned MAX_SHOWN = 20;
    localparam int unsigned MAX_FILE  = 65536;
    localparam logic [31:0] NO_WORD   = 32'hFFFF_FFFF; // no stimulus has these bits

    typedef struct {
        int unsigned  factor;
        parity_e      parity;
        split_order_e split_order;
        int unsigned  p;
    } stimulus_t;

    logic        clk = 1'b0;
    logic        rst = 1'b1;
    logic        in_valid = 1'b0;
    logic [22:0] in_factor;
    logic        in_odd, in_center;
    logic [6:0]  in_p;

    typedef struct packed {
        logic        valid;
        logic [16:0] inv_floor, inv_ceil;
        logic [15:0] fraction;
        logic [5:0]  half_points, split;
        logic [6:0]  points;
        logic        flip;
        logic [5:0]  position;
        logic [16:0] coarse, fine, half_location, location;
    } outputs_t;

    outputs_t out;
    tess_placer dut (
        .clk, .rst, .in_valid, .in_factor, .in_odd, .in_center, .in_p,
        .out_valid        (out.valid),
        .out_inv_floor    (out.inv_floor),
        .out_inv_ceil     (out.inv_ceil),
        .out_fraction     (out.fraction),
        .out_half_points  (out.half_points),
        .out_split        (out.split),
        .out_points       (out.points),
        .out_flip         (out.flip),
        .out_position     (out.position),
        .out_coarse       (out.coarse),
        .out_fine         (out.fine),
        .out_half_location(out.half_location),
        .out_location     (out.location)
    );

    always #5 clk = ~clk;

    stimulus_t   in_flight[$];
    int unsigned factors_sent = 0;
    int unsigned vectors_checked = 0;
    int unsigned mismatches = 0;

    // ---- driving -------------------------------------------------------------------------------

    // Range of the design's factors: 1..63 if odd; 1 and 2..64 if even.
    function automatic bit in_range(input int unsigned factor, input parity_e parity);
        if (parity == ODD) return factor >= ONE && factor <= 63 * ONE;
        return factor == ONE || (factor >= 2 * ONE && factor <= 64 * ONE);
    endfunction

    // Inputs change at falling edges, where outputs are read too.
    task automatic send(input stimulus_t s);
        in_valid  = 1'b1;
        in_factor = s.factor[22:0];
        in_odd    = s.parity == ODD;
        in_center = s.split_order == CENTER;
        in_p      = s.p[6:0];
        in_flight.push_back(s);
        @(negedge clk);
    endtask

    // Every point of one edge.
    task automatic send_factor(
            input int unsigned factor, input parity_e parity, input split_order_e split_order);
        context_t model = model_context(factor, parity, split_order);
        stimulus_t s;
        s.factor = factor;
        s.parity = parity;
        s.split_order = split_order;
        for (int unsigned p = 0; p < model.points; p++) begin
            s.p = p;
            send(s);
        end
        factors_sent++;
    endtask

    task automatic send_level_1(input parity_e parity, input split_order_e split_order);
        for (int unsigned halves = 2; halves <= 128; halves++) begin
            for (int unsigned offset = 0; offset < 3; offset++) begin
                int unsigned factor = halves * HALF + offset - 1;
                if (in_range(factor, parity)) send_factor(factor, parity, split_order);
            end
        end
    endtask

    // xorshift, 32 bits: the same sequence in every simulator.
    function automatic int unsigned next_random(input int unsigned state);
        int unsigned x = state;
        x ^= x << 13;
        x ^= x >> 17;
        x ^= x << 5;
        return x;
    endfunction

    task automatic send_random(input int unsigned seed, input int unsigned count);
        int unsigned state = (seed == 0) ? 32'h9E37_79B9 : seed;
        int unsigned sent = 0;
        while (sent < count) begin
            int unsigned  factor;
            parity_e      parity;
            split_order_e split_order;
            state = next_random(state);
            factor = state & 32'h007F_FFFF;
            parity = state[31] ? ODD : EVEN;
            split_order = state[30] ? CENTER : RULER;
            if (in_range(factor, parity)) begin
                send_factor(factor, parity, split_order);
                sent++;
            end
        end
    endtask

    logic [31:0] words[MAX_FILE];

    task automatic send_file(input string path);
        int unsigned count = 0;
        foreach (words[i]) words[i] = NO_WORD;
        $readmemh(path, words);
        while (count < MAX_FILE && words[count] != NO_WORD) begin
            logic [31:0]  w = words[count];
            parity_e      parity = w[24] ? ODD : EVEN;
            split_order_e split_order = w[28] ? CENTER : RULER;
            if ((w & 32'hEE00_0000) != 0 || !in_range({8'd0, w[23:0]}, parity)) begin
                $fatal(1, "%s: word %0d, %08x, is no stimulus", path, count, w);
            end
            send_factor({8'd0, w[23:0]}, parity, split_order);
            count++;
        end
        if (count == 0) $fatal(1, "%s: no stimuli", path);
        $display("%s: %0d factors", path, count);
    endtask

    // ---- checking ------------------------------------------------------------------------------

    stimulus_t current;       // the vector being checked
    bit        current_wrong; // and whether a signal of it differed

    // Compares a signal; the first difference of a vector counts and is shown.
    task automatic compare(
            input string stage, input string name,
            input int unsigned observed, input int unsigned expected);
        string parity_name = "even";
        string split_name = "ruler";
        if (current_wrong || observed == expected) return;
        current_wrong = 1'b1;
        mismatches++;
        if (mismatches > MAX_SHOWN) return;
        if (current.parity == ODD) parity_name = "odd";
        if (current.split_order == CENTER) split_name = "center";
        $display("MISMATCH stage=%s signal=%s observed=0x%05x expected=0x%05x",
            stage, name, observed, expected);
        $display("    factor=0x%06x (%0f) parity=%s split_order=%s p=%0d stimulus=%1x%1x%06x",
            current.factor, real'(current.factor) / 65536.0, parity_name, split_name, current.p,
            current.split_order == CENTER, current.parity == ODD, current.factor);
    endtask

    // Stage by stage, in the order in which each feeds the next.
    task automatic check();
        context_t c = model_context(current.factor, current.parity, current.split_order);
        placement_t m = model_place(current.factor, current.parity, current.split_order, current.p);
        compare("factor_context", "fraction", 32'(out.fraction), c.fraction);
        compare("factor_context", "half_points", 32'(out.half_points), c.half_points);
        compare("factor_context", "points", 32'(out.points), c.points);
        compare("factor_context", "split", 32'(out.split), c.split);
        compare("factor_context", "inv_floor", 32'(out.inv_floor), c.inv_floor);
        compare("factor_context", "inv_ceil", 32'(out.inv_ceil), c.inv_ceil);
        compare("place_position", "flip", 32'(out.flip), m.flip);
        compare("place_position", "position", 32'(out.position), m.position);
        compare("place_position", "coarse", 32'(out.coarse), m.coarse);
        compare("place_position", "fine", 32'(out.fine), m.fine);
        compare("place_blend", "half_location", 32'(out.half_location), m.half_location);
        compare("place_blend", "location", 32'(out.location), m.location);
    endtask

    always @(negedge clk) begin
        if (out.valid) begin
            if (in_flight.size() == 0) $fatal(1, "a location came that nobody asked for");
            current = in_flight.pop_front();
            current_wrong = 1'b0;
            check();
            vectors_checked++;
        end
    end

    // ---- the run -------------------------------------------------------------------------------

    int unsigned seed = 1;
    int unsigned random_factors = 2000;
    string       path;

    initial begin
        if ($value$plusargs("seed=%d", seed)) $display("seed %0d", seed);
        if ($value$plusargs("random=%d", random_factors)) $display("%0d random", random_factors);
        repeat (3) @(negedge clk);
        rst = 1'b0;
        send_level_1(EVEN, RULER);
        send_level_1(EVEN, CENTER);
        send_level_1(ODD, RULER);
        send_level_1(ODD, CENTER);
        send_random(seed, random_factors);
        if ($value$plusargs("stimuli=%s", path)) send_file(path);
        in_valid = 1'b0;
        repeat (8) @(negedge clk);
        if (in_flight.size() != 0) $fatal(1, "%0d locations never came", in_flight.size());
        $display("%0d factors, %0d vectors, %0d mismatches", factors_sent, vectors_checked, mismatches);
        if (vectors_checked == 0) $fatal(1, "FAIL: nothing was checked");
        if (mismatches != 0) $fatal(1, "FAIL");
        $display("PASS");
        $finish;
    end
endmodule
