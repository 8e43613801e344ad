// tess_delay keeps its values while it waits.
if (CLOCKS != 0) begin : g_hold
    hold #(.WIDTH(CLOCKS * WIDTH)) values_hold (.clk, .keeps(!advance), .state(g_registers.values));
end
