// tess_combine keeps everything while it waits: its registers here, and those of the delay by itself.
hold #(.WIDTH(33 + 13 * 17)) registers_hold (
    .clk, .keeps(!advance),
    .state({scaled, scaled_a, scaled_b, perp, perp_a, perp_b, q, q_perp, beyond, a, a_mirrored, b, u, v}));
