# tess_top or tess_axis in Vivado: the clock. Not run by us. For another top, replace the port's name (tess_axis: aclk).
create_clock -name clk -period 10.000 [get_ports clk]
# For the design on its own, as in `synth_design -mode out_of_context`: the time that the neighbours' registers take, on both
# sides of each port.
set_input_delay  -clock clk 1.000 [get_ports -filter {DIRECTION == IN && NAME != clk}]
set_output_delay -clock clk 1.000 [get_ports -filter {DIRECTION == OUT}]
