// An environment for rtl/tess_top. For your own tessellator, change tess_if, the driver and the monitor.
package tess_example;
    import uvm_pkg::*;
    import tess_dpi::*;
    import tess_uvm::*;
    `include "uvm_macros.svh"

    `include "tess_driver.svh"
    `include "tess_monitor.svh"
    `include "tess_agent.svh"
    `include "tess_env.svh"
    `include "tess_test.svh"
endpackage
