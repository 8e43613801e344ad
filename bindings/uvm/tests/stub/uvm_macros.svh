// The macros that tess_uvm uses, for the stub of uvm_pkg.
`define uvm_object_utils(T)
`define uvm_component_utils(T)
`define uvm_error(ID, MESSAGE) uvm_pkg::report_error(ID, MESSAGE);
