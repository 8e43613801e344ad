// The macros that tess_uvm and its example use, for the stub of uvm_pkg. A `type_id` is the class itself, because Verilator
// 5.006 loses the type parameter of a parameterised `type_id`.
`define uvm_object_utils(T) \
    typedef T type_id; \
    static function T create(string name = ""); \
        T made = new(name); \
        return made; \
    endfunction \
    virtual function uvm_object m_create(string name = ""); \
        T made = new(name); \
        uvm_object any = made; \
        return any; \
    endfunction
`define uvm_component_utils(T) \
    typedef T type_id; \
    static function T create(string name, uvm_component parent); \
        T made = new(name, parent); \
        return made; \
    endfunction
`define uvm_info(ID, MESSAGE, VERBOSITY) $display("UVM_INFO [%s] %s", ID, MESSAGE);
`define uvm_error(ID, MESSAGE) uvm_pkg::report_error(ID, MESSAGE);
`define uvm_fatal(ID, MESSAGE) $fatal(1, MESSAGE);
