# tess_top or tess_axis in Quartus: the clock. Not run by us. For another top, replace the port's name (tess_axis: aclk).
create_clock -name clk -period 10.000 [get_ports clk]
derive_clock_uncertainty
# For the design on its own, with virtual pins: the time that the neighbours' registers take, on both sides of each port.
set_input_delay  -clock clk 1.000 [remove_from_collection [all_inputs] [get_ports clk]]
set_output_delay -clock clk 1.000 [all_outputs]
