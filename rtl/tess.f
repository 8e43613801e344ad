// The only list of the design's files, in order of dependency. Paths are relative to this folder:
// `verilator -F rtl/tess.f --top-module tess_top`. `cargo xtask rtl --names` writes Bender.yml and tess.core from it.
+incdir+.
tess_pkg.sv
tess_delay.sv
tess_reciprocal.sv
tess_factor.sv
tess_factor_context.sv
tess_factors.sv
tess_fork.sv
tess_skid.sv
tess_tags.sv
tess_place_position.sv
tess_place_blend.sv
tess_place.sv
tess_combine.sv
tess_lane.sv
tess_points.sv
tess_mask.sv
tess_rows.sv
tess_stitch.sv
tess_connect.sv
tess_base.sv
tess_top.sv
tess_axis.sv
