// Planted faults. `TESS_FAULT(n) is 0 in synthesis and wherever TESS_PLANTED_FAULTS is not defined. A bench
// defines it, and sets tess_fault_pkg::number to plant fault n.
`ifndef TESS_FAULT
`ifdef TESS_PLANTED_FAULTS
`define TESS_FAULT(n) (tess_fault_pkg::number == n)
package tess_fault_pkg;
    int number = 0;
endpackage
`else
`define TESS_FAULT(n) 1'b0
`endif
`endif
