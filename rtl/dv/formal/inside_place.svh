// tess_place keeps everything while it waits: its registers here, and those of the delays by themselves.
hold #(.WIDTH(2 + 3 * 17)) registers_hold (.clk, .keeps(!advance), .state({flip, middle, coarse, fine, location}));
