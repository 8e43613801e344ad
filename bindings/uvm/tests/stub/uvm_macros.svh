// The macros that tess_uvm uses, for the stub of uvm_pkg.
`define uvm_object_utils(T) \
    virtual function uvm_object create(string name = ""); \
        T made = new(name); \
        uvm_object any = made; \
        return any; \
    endfunction
`define uvm_component_utils(T)
`define uvm_error(ID, MESSAGE) uvm_pkg::report_error(ID, MESSAGE);
`define uvm_fatal(ID, MESSAGE) $fatal(1, MESSAGE);
