// UVM components with the golden tessellator as reference: a sequence, a predictor, a scoreboard and covergroups.
//
//   tess_patch_item    a patch: configuration and the bits of its factors; can be randomised
//   tess_result_item   its points and indices
//   tess_file_sequence the patches of a file, such as level 1 of `tess gen`
//   tess_predictor     takes patch items and sends the model's results
//   tess_scoreboard    compares a device's results with the predictor's, in order
//   tess_coverage      samples the covergroups of the specification's cases
//
// It needs tess_dpi.sv and the library of tess-capi. Results arrive in the order of the patches. If the scoreboard's
// `unordered` is set, they may arrive in any order and are paired by patch.
package tess_uvm;
    import uvm_pkg::*;
    import tess_dpi::*;
    `include "uvm_macros.svh"

    `include "tess_items.svh"
    `include "tess_sequence.svh"
    `include "tess_predictor.svh"
    `include "tess_scoreboard.svh"
`ifndef TESS_NO_COVERGROUPS
    `include "tess_covergroups.svh"
    `include "tess_coverage.svh"
`endif
endpackage
