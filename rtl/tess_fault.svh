// Planted faults. `TESS_FAULT(n) is 0 in synthesis and wherever neither of these is defined:
//   TESS_PLANTED_FAULTS   a bench sets tess_fault_pkg::number to plant fault n
//   TESS_PROOF_FAULT      the number of the fault itself, for proofs
// rtl/dv/tb/faults.txt lists the faults.
`ifndef TESS_FAULT
`ifdef TESS_PLANTED_FAULTS
`define TESS_FAULT(n) (tess_fault_pkg::number == n)
package tess_fault_pkg;
    int number = 0;
endpackage
`elsif TESS_PROOF_FAULT
`define TESS_FAULT(n) 1'(n == `TESS_PROOF_FAULT)
`else
`define TESS_FAULT(n) 1'b0
`endif
`endif
