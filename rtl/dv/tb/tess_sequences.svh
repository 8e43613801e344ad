// Functional coverage of sequences, for tb_tess: the kinds of successive patches, and the positions in a patch at which the
// circuit is stalled or reset. The position of a stream is that of the element that it offers.
string POSITIONS[4] = '{"only", "first", "middle", "last"};
string STREAMS[3] = '{"counts", "points", "primitives"};
string KINDS[5] = '{"isoline", "triangle", "quad", "minimum", "culled"};

int unsigned sequences[string]; // hits by bin

function automatic void hit(input string bin);
    if (sequences.exists(bin)) sequences[bin]++;
    else sequences[bin] = 1;
endfunction

// ---- a patch after a patch ---------------------------------------------------------------------

int unsigned kind_before = 5;
function automatic void cover_patch();
    int unsigned kind = 32'(offered.domain);
    if (offered.points == 0) kind = 4;
    else if (offered.domain != 2'(ISOLINE) && offered.points == ((offered.domain == 2'(QUAD)) ? 4 : 3)) kind = 3;
    if (kind_before != 5) hit({KINDS[kind], " after ", KINDS[kind_before]});
    kind_before = kind;
endfunction

// ---- a primitive before its points -------------------------------------------------------------

// Both streams are in the same patch if the same number of patches is due in each.
function automatic void cover_primitive();
    if (of_points.size() == of_primitives.size() && in_patch(of_primitives[0], 0, primitive_i0) >= next_point) hit("a primitive before its points");
endfunction

// ---- stalls and resets by position -------------------------------------------------------------

int unsigned stalled_for[3] = '{0, 0, 0}; // clocks

function automatic string position_of(input int unsigned stream);
    int unsigned next = (stream == 1) ? next_point : next_primitive;
    bit          is_last = (stream == 1) ? point_last : primitive_last;
    if (stream == 0) return "only";
    return POSITIONS[(next == 0) ? (is_last ? 0 : 1) : (is_last ? 3 : 2)];
endfunction

// Called in every clock, before the transfers.
function automatic void cover_sequences();
    bit [2:0] waits;
    waits = {primitive_valid && !primitive_ready, point_valid && !point_ready, counts_valid && !counts_ready};
    for (int unsigned stream = 0; stream < 3; stream++) begin
        stalled_for[stream] = (waits[stream] && !rst) ? stalled_for[stream] + 1 : 0;
        if (stalled_for[stream] == 1) hit({"stall of ", STREAMS[stream], ", ", position_of(stream)});
        if (stalled_for[stream] == 32) hit({"long stall of ", STREAMS[stream], ", ", position_of(stream)});
        if (stalled_for[stream] == LONG_STALL) hit({"stall of 1024 clocks of ", STREAMS[stream]});
        if (stalled_for[stream] == LONGEST_STALL) hit({"stall of 5000 clocks of ", STREAMS[stream]});
        if (stalled_for[stream] == 8 && !(|(waits & ~(3'd1 << stream)))) hit({STREAMS[stream], " alone wait"});
    end
endfunction

function automatic void cover_reset();
`ifndef TESS_GATES
    if (axis.top.stage_fork.in_valid)
        hit($sformatf("reset with a patch in the fork, taken by %03b", axis.top.stage_fork.took));
`endif
    if (point_valid) hit({"reset of points, ", position_of(1)});
    if (primitive_valid) hit({"reset of primitives, ", position_of(2)});
    if (counts_valid) hit("reset of counts, only");
    if (!point_valid && !primitive_valid) hit("reset before the first element");
    if (patch_valid) hit("reset with a patch offered");
endfunction

// ---- the verdict -------------------------------------------------------------------------------

function automatic int unsigned missed(input string bin);
    if (sequences.exists(bin)) return 0;
    $display("not covered: %s", bin);
    return 1;
endfunction

// Returns the number of bins without a hit, and prints their names.
function automatic int unsigned sequences_missed();
    sequences_missed = missed("reset before the first element") + missed("reset of counts, only") + missed("a primitive before its points");
    foreach (KINDS[i]) foreach (KINDS[j]) sequences_missed += missed({KINDS[i], " after ", KINDS[j]});
    for (int unsigned stream = 0; stream < 3; stream++) begin
        sequences_missed += missed({STREAMS[stream], " alone wait"}) + missed({"stall of 1024 clocks of ", STREAMS[stream]});
        sequences_missed += missed({"stall of 5000 clocks of ", STREAMS[stream]});
        foreach (POSITIONS[i]) if ((stream == 0 && i == 0) || (stream == 1 && i != 0) || stream == 2) begin // a patch has at least two points
            string place = {STREAMS[stream], ", ", POSITIONS[i]};
            sequences_missed += missed({"stall of ", place}) + missed({"long stall of ", place});
            if (stream != 0) sequences_missed += missed({"reset of ", place});
        end
    end
    // Bits of `took`: points, primitives, counts. All three are never set, because the patch would have left.
    for (int unsigned took = 0; took < 7; took++)
        sequences_missed += missed($sformatf("reset with a patch in the fork, taken by %03b", 3'(took)));
    $display("sequences: %0d bins are hit, %0d are not", sequences.num(), sequences_missed);
endfunction
