// Checks tess_top, in tess_axis, against the golden model over DPI-C: every element, in order, and the front end's values.
//
//   +stimuli=FILE   patches, one per line: domain partitioning output split factors (names and hex digits of `tess gen`,
//                   with blanks instead of commas; further words on the line are ignored)
//   +random=N       N random patches after them, most of them small (default 0)
//   +seed=N         seed of everything random (default 1)
//   +gaps           random gaps between patches, back-pressure of several kinds on each stream
//   +resets=N       N resets before anything is checked, each with up to eight patches under way
//   +covered        fails unless every bin of tess_sequences.svh is hit, and every rule of tess_checks.sv has applied
//   +alone          sends each patch after the output of the previous one is complete, to measure latencies
//   +fault=N        the design has fault N (`cargo xtask rtl --plant`); ends soon after a difference
// Exit: PASS, or $fatal. For each difference the patch is printed as a line that `tess explain` and +stimuli accept.
module tb_tess #(
    parameter bit PADDED   = 1'b0, // of tess_axis
    parameter bit BUFFERED = 1'b0,
    parameter int TAG      = 0,    // at most 64
    parameter int BASE     = 0,    // at most 32
    parameter int POINTS   = 1     // 1, 2 or 4
);
    import tess_dpi::*;

    localparam int unsigned MAX_SHOWN = 20;

    // Packed, because Verilator 5.006 does not accept a structure of structures.
    typedef struct packed {
        bit [1:0]       domain;
        bit [1:0]       partitioning;
        bit [1:0]       out;
        bit             split;
        bit [5:0][31:0] x;          // factors
        bit [31:0]      points;     // the model's counts
        bit [31:0]      primitives;
        bit [63:0]      tag;        // its lowest TAG bits
        bit [31:0]      first;      // number of its first point: the lowest BASE bits
    } stimulus_t;

    function automatic config_t config_of(input stimulus_t s);
        config_t cfg;
        cfg.domain       = domain_e'(s.domain);
        cfg.partitioning = partitioning_e'(s.partitioning);
        cfg.out          = output_e'(s.out);
        cfg.split_order  = split_order_e'(s.split);
        return cfg;
    endfunction

    logic         clk = 1'b0;
    logic         rst = 1'b1;
    logic         patch_valid = 1'b0;
    logic         patch_ready;
    logic [1:0]   patch_domain, patch_partitioning, patch_out;
    logic         patch_center;
    logic [191:0] patch_factors;
    logic         counts_valid, point_valid, primitive_valid;
    logic         counts_ready = 1'b1, point_ready = 1'b1, primitive_ready = 1'b1;
    logic [12:0]  counts_points;
    logic [13:0]  counts_primitives;
    logic         point_last, primitive_last;
    logic [1:0]   primitive_size;
    logic [31:0]  primitive_i0, primitive_i1, primitive_i2;
    logic [63:0]  patch_tag, counts_tag, primitive_tag;
    logic [31:0]  patch_first;

    // The design in its AXI4-Stream wrapper, so that every comparison covers both.
    // A field of TAG or BASE begins at a byte, as do those after it.
    localparam int INDEX         = (BASE == 0) ? 13 : BASE; // bits
    localparam int INDEX_SLOT    = (BASE == 0) ? 16 : (BASE + 7) / 8 * 8;
    localparam int PATCH_TAG     = 200 + (BASE + 7) / 8 * 8;
    localparam int PRIMITIVE_TAG = 3 * INDEX_SLOT + 8;
    typedef bit [511:0] word_t; // any word, in its lowest bits

    function automatic int word(input int tag_at);
        int packed_bits = tag_at + (TAG + 7) / 8 * 8;
        return PADDED ? 2**$clog2(packed_bits) : packed_bits;
    endfunction

    function automatic bit [191:0] field(input word_t from, input int at, input int bits);
        return 192'(from >> at) & ~((~192'd0) << bits);
    endfunction

    // The word with this field, where it was 0.
    function automatic word_t with_field(input word_t rest, input int at, input int bits, input bit [191:0] value);
        return rest | (word_t'(value & ~((~192'd0) << bits)) << at);
    endfunction

    logic [word(PATCH_TAG)-1:0]     patch_data;
    logic [word(32)-1:0]            counts_data;
    localparam int LANE = word(48); // bits of a lane
    logic [POINTS*LANE-1:0]         point_data;
    logic [POINTS*LANE/8-1:0]       point_keep;
    bit   [LANE-1:0]                point_word; // of the lane that is compared
    logic [word(PRIMITIVE_TAG)-1:0] primitive_data;
    word_t ignored; // the bits of a patch without a field
    always_comb begin
        ignored    = with_field('0, 7, 1, '1) | ~((word_t'(1) << 200) - 1);
        ignored    = ignored & ~with_field(with_field('0, 200, BASE, '1), PATCH_TAG, TAG, '1);
        patch_data = $bits(patch_data)'(with_field(with_field((^patch_factors) ? ignored : '0, 200, BASE, 192'(patch_first)),
            PATCH_TAG, TAG, 192'(patch_tag))
            | word_t'({patch_factors, 1'b0, patch_center, patch_out, patch_partitioning, patch_domain}));
    end
`ifdef TESS_GATES
    tess_axis axis (
`else
    tess_axis #(.PADDED(PADDED), .BUFFERED(BUFFERED), .TAG(TAG), .BASE(BASE), .POINTS(POINTS)) axis (
`endif
        .aclk                   (clk),
        .aresetn                (!rst),
        .s_axis_patch_tvalid    (patch_valid),
        .s_axis_patch_tready    (patch_ready),
        .s_axis_patch_tdata     (patch_data),
        .m_axis_counts_tvalid   (counts_valid),
        .m_axis_counts_tready   (counts_ready),
        .m_axis_counts_tdata    (counts_data),
        .m_axis_point_tvalid    (point_valid),
        .m_axis_point_tready    (point_ready),
        .m_axis_point_tdata     (point_data),
        .m_axis_point_tkeep     (point_keep),
        .m_axis_point_tlast     (point_last),
        .m_axis_primitive_tvalid(primitive_valid),
        .m_axis_primitive_tready(primitive_ready),
        .m_axis_primitive_tdata (primitive_data),
        .m_axis_primitive_tlast (primitive_last)
    );
    assign counts_points     = counts_data[12:0];
    assign counts_primitives = counts_data[29:16];
    assign counts_tag        = 64'(field(word_t'(counts_data), 32, TAG));
    assign primitive_i0      = 32'(field(word_t'(primitive_data), 0, INDEX));
    assign primitive_i1      = 32'(field(word_t'(primitive_data), INDEX_SLOT, INDEX));
    assign primitive_i2      = 32'(field(word_t'(primitive_data), 2 * INDEX_SLOT, INDEX));
    assign primitive_size    = 2'(field(word_t'(primitive_data), 3 * INDEX_SLOT, 2));
    assign primitive_tag     = 64'(field(word_t'(primitive_data), PRIMITIVE_TAG, TAG));

    // The bits of the words that have fields, besides the tag.
    localparam word_t COUNTS_FIELDS    = 512'h3FFF_1FFF;
    localparam word_t POINT_FIELDS     = 512'h1_FFFF_01_FFFF;
    localparam word_t INDEX_FIELD      = (512'd1 << INDEX) - 512'd1;
    localparam word_t PRIMITIVE_FIELDS = INDEX_FIELD | (INDEX_FIELD << INDEX_SLOT) | (INDEX_FIELD << (2 * INDEX_SLOT))
        | (512'd3 << (3 * INDEX_SLOT));

    // The tag of a word is the patch's, and the bits that have no field are 0.
    localparam word_t TAG_FIELD = (512'd1 << TAG) - 512'd1;
    function automatic void check_word(
            input string stage, input word_t observed, input word_t fields, input int tag_at,
            input bit [63:0] tag, input bit [63:0] expected);
        if (((tag ^ expected) & TAG_FIELD[63:0]) != 64'd0) tess_check_pkg::failed(stage, "tag", "tess_tags");
        if ((observed & ~(fields | (TAG_FIELD << tag_at))) != '0) tess_check_pkg::failed(stage, "padding", "tess_axis");
    endfunction

    // The index of a point in its patch: less the number of the patch's first point, if the primitive has the index.
    function automatic int unsigned in_patch(input stimulus_t s, input int unsigned k, input bit [31:0] index);
        if (BASE == 0 || k >= 32'(primitive_size)) return index;
        return (index - s.first) & INDEX_FIELD[31:0];
    endfunction

    always #5 clk = ~clk;

    // ---- what is expected ----------------------------------------------------------------------

    // Patches that the design has accepted, for each stream that is checked.
    stimulus_t of_factors[$], of_counts[$], of_points[$], of_primitives[$];
    // The model's patch that is offered, and those whose elements are compared.
    chandle held_offered = model_open(), held_of_points = model_open(), held_of_primitives = model_open();

    int unsigned next_point = 0, next_primitive = 0;
    longint unsigned points_checked = 0, primitives_checked = 0, patches_checked = 0, cycles = 0;
    int unsigned mismatches = 0;

    string DOMAINS[4] = '{"isoline", "tri", "quad", "3"}; // 3 is not a domain; its patches are culled
    string PARTITIONINGS[4] = '{"integer", "pow2", "fractional_odd", "fractional_even"};
    string OUTPUTS[4] = '{"point", "line", "triangle_cw", "triangle_ccw"};
    string SPLITS[2] = '{"ruler", "center"};

    function automatic int unsigned factor_count(input stimulus_t s);
        return (s.domain == 2'(ISOLINE)) ? 2 : (s.domain == 2'(TRIANGLE)) ? 4 : 6;
    endfunction

    function automatic string line_of(input stimulus_t s);
        string text = $sformatf("%s %s %s %s", DOMAINS[s.domain],
            PARTITIONINGS[s.partitioning], OUTPUTS[s.out], SPLITS[s.split]);
        for (int unsigned i = 0; i < factor_count(s); i++) text = {text, $sformatf(" %08x", s.x[i])};
        return text;
    endfunction

    // The numbers and names of signals, which rtl/dv/run makes from rtl/stages.tsv.
    `include "tess_names.svh"
    typedef enum { OPTION, STAGE, SIGNAL, MODULE } column_e;
    function automatic string name_of(input int unsigned signal, input column_e column);
        return SIGNALS[4 * signal + column];
    endfunction

    // The differences of this clock. They are printed in one place, because Verilator copies a function to each call.
    typedef struct packed {
        bit [31:0] signal; // of tess_names.svh
        bit [31:0] element;
        bit [31:0] observed;
        bit [31:0] expected;
        stimulus_t s;
    } difference_t;
    difference_t differences[$];

    function automatic void compare(
            input stimulus_t s, input int unsigned signal, input int unsigned element,
            input int unsigned observed, input int unsigned expected);
        if (observed != expected) differences.push_back({signal, element, observed, expected, s});
    endfunction

    // Prints the differences and the command that explains them.
    function automatic string explain(input difference_t d);
        int unsigned outer = (d.s.domain == 2'(TRIANGLE)) ? 3 : (d.s.domain == 2'(QUAD)) ? 4 : 2;
        string text = {"tess explain ", DOMAINS[d.s.domain]};
        for (int unsigned i = 0; i < factor_count(d.s); i++)
            text = {text, (i == 0) ? " --outer " : (i == outer) ? " --inner " : ",", $sformatf("0x%08x", d.s.x[i])};
        text = {text, " --partitioning ", PARTITIONINGS[d.s.partitioning], " --output ", OUTPUTS[d.s.out],
            " --split ", SPLITS[d.s.split]};
        if (name_of(d.signal, OPTION) != "patch") text = {text, " --", name_of(d.signal, OPTION), $sformatf(" %0d", d.element)};
        return {text, " --observed ", name_of(d.signal, SIGNAL), $sformatf("=0x%0x", d.observed)};
    endfunction

    function automatic void show();
        while (differences.size() != 0) begin
            difference_t d = differences.pop_front();
            mismatches++;
            if (mismatches <= MAX_SHOWN) begin
                $display("MISMATCH stage=%s signal=%s element=%0d observed=0x%05x expected=0x%05x",
                    name_of(d.signal, STAGE), name_of(d.signal, SIGNAL), d.element, d.observed, d.expected);
                $display("    case %s", line_of(d.s));
                $display("    module %s; %s", name_of(d.signal, MODULE), explain(d));
            end
        end
    endfunction

    // ---- checking ------------------------------------------------------------------------------

`ifndef TESS_GATES
    `include "tess_front_end.svh"
`endif

    function automatic void check_counts();
        stimulus_t s;
        if (of_counts.size() == 0) begin
            tess_check_pkg::failed("counts", "valid", "tess_top");
            $fatal(1, "FAIL: counts came that no patch has");
        end
        s = of_counts.pop_front();
        check_word("counts", word_t'(counts_data), COUNTS_FIELDS, 32, counts_tag, s.tag);
        compare(s, COUNTS_POINTS, 0, 32'(counts_points), s.points);
        compare(s, COUNTS_PRIMITIVES, 0, 32'(counts_primitives), s.primitives);
        patches_checked++;
        idle = 0;
    endfunction

    // Whether a lane has a point: all its bytes are kept, or none; the first lane has one, and no lane after one without.
    function automatic bit is_kept(input int unsigned lane);
        bit [LANE/8-1:0] keep = point_keep[LANE/8*lane +: LANE/8];
        bit is_wrong = (keep == '0) ? lane == 0 : keep != '1 || (lane != 0 && !point_keep[LANE/8*(lane-1)]);
        if (is_wrong) tess_check_pkg::failed("points", "keep", "tess_axis");
        return keep != '0;
    endfunction

    // The points of all lanes, the first lane first.
    function automatic void check_points();
        point_transfers++;
        for (int unsigned lane = 0; lane < POINTS; lane++) if (is_kept(lane)) begin
            point_word = point_data[LANE*lane +: LANE];
            check_point(lane + 1 == POINTS || !point_keep[LANE/8*(lane+1)]);
        end
    endfunction

    // The point in `point_word`; patches without elements are not due.
    function automatic void check_point(input bit is_highest);
        stimulus_t s;
        point_t p;
        while (of_points.size() != 0 && of_points[0].points == 0) void'(of_points.pop_front());
        if (of_points.size() == 0) begin
            compare(offered, POINTS_VALID, 0, 1, 0);
            show();
            $fatal(1, "FAIL: a point came that no patch has");
        end
        s = of_points[0];
        if (next_point == 0) void'(model_patch(held_of_points, config_of(s), s.x));
        p = model_point(held_of_points, next_point);
        check_word("points", word_t'(point_word), POINT_FIELDS, 48, 64'(field(word_t'(point_word), 48, TAG)), s.tag);
        compare(s, POINTS_U, next_point, 32'(point_word[16:0]), p.u);
        compare(s, POINTS_V, next_point, 32'(point_word[40:24]), p.v);
        next_point++;
        compare(s, POINTS_LAST, next_point - 1, 32'(point_last && is_highest), 32'(next_point == s.points));
        points_checked++;
        idle = 0;
        if (next_point == s.points) begin
            next_point = 0;
            void'(of_points.pop_front());
        end
    endfunction

    function automatic void check_primitive();
        stimulus_t s;
        primitive_t p;
        while (of_primitives.size() != 0 && of_primitives[0].primitives == 0) void'(of_primitives.pop_front());
        if (of_primitives.size() == 0) begin
            compare(offered, CONNECT_VALID, 0, 1, 0);
            show();
            $fatal(1, "FAIL: a primitive came that no patch has");
        end
        s = of_primitives[0];
        if (next_primitive == 0) void'(model_patch(held_of_primitives, config_of(s), s.x));
        p = model_primitive(held_of_primitives, next_primitive);
        check_word("connect", word_t'(primitive_data), PRIMITIVE_FIELDS, PRIMITIVE_TAG, primitive_tag, s.tag);
        compare(s, CONNECT_SIZE, next_primitive, 32'(primitive_size), p.size);
        compare(s, CONNECT_I0, next_primitive, in_patch(s, 0, primitive_i0), p.i0);
        compare(s, CONNECT_I1, next_primitive, in_patch(s, 1, primitive_i1), p.i1);
        compare(s, CONNECT_I2, next_primitive, in_patch(s, 2, primitive_i2), p.i2);
        next_primitive++;
        compare(s, CONNECT_LAST, next_primitive - 1, 32'(primitive_last),
            32'(next_primitive == s.primitives));
        primitives_checked++;
        idle = 0;
        if (next_primitive == s.primitives) begin
            next_primitive = 0;
            void'(of_primitives.pop_front());
        end
    endfunction

    // ---- clocks --------------------------------------------------------------------------------

    bit              alone;
    bit              has_elements = 1'b0; // the patch of the last output has elements: it is not culled
    int unsigned     silent = 0, most_silent = 0; // clocks between two patches in which neither stream has an element
    int unsigned     lost_points = 0, lost_primitives = 0; // clocks without an element, within a patch
    int unsigned     point_latency = 0, primitive_latency = 0;
    longint unsigned accepted_at = 0, point_transfers = 0;
    bit              has_point = 1'b0, has_primitive = 1'b0; // an element of the last accepted patch was output

    function automatic void count_clocks();
        if (next_point != 0 && !point_valid) lost_points++;
        if (next_primitive != 0 && !primitive_valid) lost_primitives++;
        if (point_valid || primitive_valid) begin
            if (has_elements && silent > most_silent) most_silent = silent;
            silent = 0;
            has_elements = 1'b1;
        end else begin
            silent++;
        end
        // Culled patches have no elements, so they are no gap between elements.
        if (counts_valid && counts_points == 13'd0) has_elements = 1'b0;
        if (alone && point_valid && !has_point) begin
            has_point = 1'b1;
            if (point_latency < 32'(cycles - accepted_at)) point_latency = 32'(cycles - accepted_at);
        end
        if (alone && primitive_valid && !has_primitive) begin
            has_primitive = 1'b1;
            if (primitive_latency < 32'(cycles - accepted_at)) primitive_latency = 32'(cycles - accepted_at);
        end
    endfunction

    // ---- random --------------------------------------------------------------------------------

    int unsigned seed = 1;
    int unsigned state;
    bit          gaps;

    // xorshift, 32 bits: the same sequence in every simulator.
    function automatic int unsigned random();
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        return state;
    endfunction

    // The thresholds of section 3: 1, 1 + 2^-17 and 1 + 2^-16, 2, 63, 64.
    int unsigned THRESHOLDS[6] = '{32'h3F80_0000, 32'h3F80_0040, 32'h3F80_0080, 32'h4000_0000, 32'h427C_0000, 32'h4280_0000};

    // A factor: mostly small and near an integer, sometimes any bits.
    function automatic int unsigned random_factor();
        int unsigned kind = random() % 16;
        int unsigned fixed, exponent, bits;
        if (kind == 0) return random();
        if (kind == 1) return THRESHOLDS[random() % 6] + random() % 3 - 1;
        if (kind == 2) begin
            case (random() % 8)
                0:       return 32'h7FC0_0000 ^ (random() & 32'h803F_FFFF); // NaN
                1:       return 32'h7F80_0000;                              // infinity
                2:       return 1 + random() % 32'h007F_FFFF;               // denormal
                default: return 32'h3F80_0040 + (random() & 32'h0000_FF80); // half of 2^-16 after the point: a tie
            endcase
        end
        fixed = 32'h1_0000 + random() % (32'h1_0000 << (random() % 7));
        if (kind < 8) fixed = (fixed & 32'hFFFF_0000) + (random() % 8 == 0 ? random() % 64 : 0);
        if (fixed > 32'h40_0000) fixed = 32'h40_0000;
        // To binary32: a 23-bit number is exact.
        exponent = 0;
        for (int unsigned i = 0; i < 24; i++) if (fixed[i]) exponent = i;
        bits = ((exponent + 32'd111) << 23) | ((fixed << (23 - exponent)) & 32'h007F_FFFF);
        // Its neighbours too, one unit in the last place away.
        return (kind < 3) ? bits + random() % 3 - 1 : bits;
    endfunction

    function automatic stimulus_t random_stimulus();
        stimulus_t s;
        s.domain       = (random() % 64 == 0) ? 2'd3 : 2'(random() % 3);
        s.partitioning = 2'(random() % 4);
        s.out          = 2'(random() % 8 < 6 ? 2 + random() % 2 : random() % 2);
        s.split        = random() % 4 == 0;
        for (int unsigned i = 0; i < 6; i++) s.x[i] = random_factor();
        if (random() % 4 == 0) for (int unsigned i = 1; i < 6; i++) s.x[i] = s.x[0];
        // One factor is near a threshold; the others are ONE, so they do not hide it.
        if (random() % 8 == 0) begin
            if (random() % 2 == 0) s.partitioning = 2'(FRACTIONAL_ODD);
            for (int unsigned i = 0; i < 6; i++) s.x[i] = 32'h3F80_0000;
            s.x[random() % 6] = THRESHOLDS[random() % 3] + random() % 3 - 1;
        end
        // The largest number of rings.
        if (random() % 256 == 0) begin
            s.domain = 2'(QUAD);
            for (int unsigned i = 4; i < 6; i++) s.x[i] = (random() % 2 == 0) ? 32'h4280_0000 : 32'h4278_0000; // 64, 62
        end
        return s;
    endfunction

    // ---- back-pressure -------------------------------------------------------------------------

    // Clocks of long stalls, and of the longest. Stalls last 100 clocks longer, in which an element comes to be stalled.
    localparam int unsigned LONG_STALL = 1024, LONGEST_STALL = 5000;

    // The present kind of stall of each consumer: never, every fourth clock, every other clock, always.
    int unsigned manner[3] = '{0, 0, 0}, remains = 0;
    // The stream that finishes each patch before the others begin it; 3 for none.
    int unsigned first = 3;

    function automatic bit is_ready(input int unsigned stream, input int unsigned due);
        int unsigned due_first = (first == 0) ? of_counts.size() : (first == 1) ? of_points.size() : of_primitives.size();
        if (first != 3) return stream == first || due > due_first;
        case (manner[stream])
            0:       return 1'b1;
            1:       return random() % 4 != 0;
            2:       return cycles[0] == 1'(stream);
            default: return 1'b0;
        endcase
    endfunction

    function automatic void press_back();
        if (remains == 0) begin
            int unsigned kind = random() % 16;
            remains = 64 + random() % 128;
            first   = (kind == 0) ? random() % 3 : 3;
            foreach (manner[i]) manner[i] = random() % ((kind < 4) ? 3 : 2);
            if (kind >= 14) begin // only one stream, or all of them; sometimes for thousands of clocks
                remains = (random() % 64 != 0) ? 40 : 100 + ((random() % 2 == 0) ? LONGEST_STALL : LONG_STALL);
                foreach (manner[i]) manner[i] = (kind == 14) ? 0 : 3;
                manner[random() % 3] = 3;
            end
        end
        // The other streams wait for the stream that must finish first.
        if (first == 3 || idle < 2) remains--;
        void'(is_empty());
        counts_ready    = is_ready(0, of_counts.size());
        point_ready     = is_ready(1, of_points.size());
        primitive_ready = is_ready(2, of_primitives.size());
    endfunction

    `include "tess_sequences.svh"

    // ---- driving -------------------------------------------------------------------------------

    // The patch that is offered to the design; the process below checks whether the design has accepted it.
    stimulus_t   offered;
    bit          is_offered = 1'b0, is_accepted = 1'b0;
    int unsigned idle = 0; // clocks without a transfer

    // One clock. Inputs change at falling edges; the transfers of the rising edge are known a moment later.
    always @(negedge clk) begin
        // Differences of the previous clock: its assertions, which name the module, have been printed by now.
        if (differences.size() != 0) show();
        patch_valid        = is_offered;
        patch_domain       = offered.domain;
        patch_partitioning = offered.partitioning;
        patch_out          = offered.out;
        patch_center       = offered.split;
        patch_factors      = offered.x;
        patch_tag          = offered.tag;
        patch_first        = offered.first;
        if (gaps) press_back();
        #1;
        cover_sequences();
        cycles++;
        idle++;
        if (!rst) begin
            if (patch_valid && patch_ready) begin
                idle = 0;
                accepted_at = cycles;
                has_point = 1'b0;
                has_primitive = 1'b0;
                is_offered  = 1'b0;
                is_accepted = 1'b1;
                cover_patch();
                of_factors.push_back(offered);
                of_counts.push_back(offered);
                of_points.push_back(offered);
                of_primitives.push_back(offered);
            end
`ifndef TESS_GATES
            if (axis.top.stage_factors.context_valid && axis.top.stage_factors.advance) check_factor();
`endif
            if (counts_valid && counts_ready) check_counts();
            if (point_valid && point_ready) check_points();
            if (primitive_valid && primitive_ready) begin
                cover_primitive();
                check_primitive();
            end
            count_clocks();
            // One of the longest stalls can follow another.
            if (idle > 3 * LONGEST_STALL && (is_offered || !is_empty())) begin
                if (of_points.size() != 0) compare(of_points[0], POINTS_VALID, next_point, 0, 1);
                if (of_primitives.size() != 0) compare(of_primitives[0], CONNECT_VALID, next_primitive, 0, 1);
                show();
                $fatal(1, "FAIL: nothing passes any more");
            end
        end
    end

    // Each patch has another tag and another first number; half of the numbers are among the last, so that sums begin at 0 again.
    int unsigned labels = 0;
    function automatic stimulus_t labelled(input stimulus_t s);
        labels++;
        labelled       = s;
        labelled.tag   = {labels * 32'h85EB_CA6B, labels * 32'h9E37_79B1};
        labelled.first = labels * 32'hC2B2_AE35;
        if (labelled.first[16]) labelled.first |= 32'hFFFF_F000;
    endfunction

    int unsigned fault = 0, patches_behind = 0; // patches sent since a planted fault was found

    task automatic send(input stimulus_t s);
        counts_t c;
        c.points     = 0;
        c.primitives = 0;
        if (gaps && random() % 8 == 0) repeat (random() % 24) @(posedge clk);
        if (s.domain != 2'd3) c = model_patch(held_offered, config_of(s), s.x);
        offered            = labelled(s);
        offered.points     = c.points;
        offered.primitives = c.primitives;
        is_accepted        = 1'b0;
        is_offered         = 1'b1;
        while (!is_accepted) @(posedge clk);
        // With a planted fault, the run ends 100 patches after the first difference.
        if (fault != 0 && mismatches + tess_check_pkg::failures != 0) patches_behind++;
        if (mismatches > MAX_SHOWN || patches_behind > 100) give_verdict();
        if (alone) drain();
    endtask

    // Whether the output of every accepted patch is complete.
    function automatic bit is_empty();
        while (of_points.size() != 0 && of_points[0].points == 0) void'(of_points.pop_front());
        while (of_primitives.size() != 0 && of_primitives[0].primitives == 0) void'(of_primitives.pop_front());
        return of_counts.size() == 0 && of_points.size() == 0 && of_primitives.size() == 0;
    endfunction

    task automatic drain();
        while (!is_empty()) @(posedge clk);
        repeat (32) @(posedge clk);
    endtask

    task automatic send_file(input string path);
        int          fd;
        int unsigned count;
        string       domain, partitioning, out, split, rest;
        bit [31:0]   word;
        fd = $fopen(path, "r");
        count = 0;
        if (fd == 0) $fatal(1, "%s: cannot be read", path);
        while ($fscanf(fd, "%s %s %s %s", domain, partitioning, out, split) == 4) begin
            stimulus_t s;
            s = '0;
            s.domain       = 2'(number_of(domain, DOMAINS[0], DOMAINS[1], DOMAINS[2], ""));
            s.partitioning = 2'(number_of(partitioning, PARTITIONINGS[0], PARTITIONINGS[1],
                PARTITIONINGS[2], PARTITIONINGS[3]));
            s.out          = 2'(number_of(out, OUTPUTS[0], OUTPUTS[1], OUTPUTS[2], OUTPUTS[3]));
            s.split        = 1'(number_of(split, SPLITS[0], SPLITS[1], "", ""));
            for (int unsigned i = 0; i < factor_count(s); i++) begin
                if ($fscanf(fd, "%h", word) != 1) $fatal(1, "%s: patch %0d lacks factors", path, count);
                s.x[i] = word;
            end
            void'($fgets(rest, fd));
            send(s);
            count++;
        end
        $fclose(fd);
        if (count == 0) $fatal(1, "%s: no patches", path);
        $display("%s: %0d patches", path, count);
    endtask

    function automatic int unsigned number_of(
            input string word, input string n0, input string n1, input string n2, input string n3);
        if (word == n0) return 0;
        if (word == n1) return 1;
        if (word == n2 && n2 != "") return 2;
        if (word == n3 && n3 != "") return 3;
        $fatal(1, "`%s` is no name of the specification", word);
        return 0;
    endfunction

    // Resets with patches under way, one of which may wait in the fork; nothing of them may remain.
    task automatic reset_in_the_middle(input int unsigned count);
        repeat (count) begin
            repeat (1 + random() % 8) send(random_stimulus());
            repeat (random() % 40) @(posedge clk);
            // Half of the resets are at the last element of a stream.
            @(negedge clk);
            case (random() % 4)
                0: for (int unsigned i = 0; i < 4096 && !is_empty() && !(point_valid && point_last); i++) @(negedge clk);
                1: for (int unsigned i = 0; i < 4096 && !is_empty() && !(primitive_valid && primitive_last); i++) @(negedge clk);
                default: ;
            endcase
            #2;
            cover_reset();
            rst = 1'b1;
            repeat (1 + random() % 2) @(negedge clk);
            #2;
            of_factors.delete();
            of_counts.delete();
            of_points.delete();
            of_primitives.delete();
            next_point = 0;
            next_primitive = 0;
            rst = 1'b0;
        end
    endtask

    task automatic give_verdict();
        show();
        $display("%0d patches, %0d points, %0d primitives, %0d clocks, %0d mismatches",
            patches_checked, points_checked, primitives_checked, cycles, mismatches);
        if (alone) $display("latency: first point %0d clocks, first primitive %0d clocks", point_latency, primitive_latency);
        else if (!gaps) begin
            $display("transfers of points: %0d", point_transfers);
            $display("between patches: at most %0d clocks", most_silent);
            $display("within patches: %0d clocks without a point, %0d without a primitive", lost_points, lost_primitives);
        end
        if ($test$plusargs("covered") != 0) begin
            int unsigned unhit = sequences_missed(), idle_rules = tess_check_pkg::missed();
            if (unhit != 0 || idle_rules != 0) $fatal(1, "FAIL: not everything is covered");
        end
        if (tess_check_pkg::failures != 0) $fatal(1, "FAIL: %0d assertions", tess_check_pkg::failures);
        if (mismatches != 0) $fatal(1, "FAIL");
        if (points_checked == 0 || primitives_checked == 0) $fatal(1, "FAIL: nothing was checked");
        $display("PASS");
        $finish;
    endtask

    int unsigned random_patches = 0, resets = 0;
    string       path;

    initial begin
        gaps = $test$plusargs("gaps") != 0;
        alone = $test$plusargs("alone") != 0;
        void'($value$plusargs("seed=%d", seed));
        void'($value$plusargs("random=%d", random_patches));
        void'($value$plusargs("resets=%d", resets));
        void'($value$plusargs("fault=%d", fault));
        state = (seed == 0) ? 32'h9E37_79B9 : seed;
        repeat (3) @(posedge clk);
        @(negedge clk);
        rst = 1'b0;
        reset_in_the_middle(resets);
        if ($value$plusargs("stimuli=%s", path)) send_file(path);
        repeat (random_patches) send(random_stimulus());
        drain();
        give_verdict();
    end
endmodule
