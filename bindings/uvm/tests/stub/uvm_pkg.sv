// A stub of the parts of UVM that tess_uvm uses, so that a simulator without UVM compiles and runs it
// in this project's tests. It is no UVM: no factory, no phases but by hand, reports are lines.
package uvm_pkg;
    class uvm_comparer;
        int unsigned m_compares;
    endclass

    // Keeps what is printed.
    class uvm_printer;
        string m_text;
        function void print_string(string name, string value);
            m_text = {m_text, name, ": ", value, "\n"};
        endfunction
    endclass

    class uvm_object;
        string m_name;
        function new(string name = "");
            m_name = name;
        endfunction
        virtual function string get_name();
            return m_name;
        endfunction
        virtual function string convert2string();
            return "";
        endfunction
        virtual function uvm_object create(string name = "");
            return null;
        endfunction
        virtual function void do_copy(uvm_object rhs);
        endfunction
        virtual function bit do_compare(uvm_object rhs, uvm_comparer comparer);
            return comparer.m_compares > 0;
        endfunction
        virtual function void do_print(uvm_printer printer);
        endfunction
        function void copy(uvm_object rhs);
            do_copy(rhs);
        endfunction
        function bit compare(uvm_object rhs);
            uvm_comparer comparer = new();
            comparer.m_compares++;
            return do_compare(rhs, comparer);
        endfunction
        virtual function uvm_object clone();
            uvm_object made = create(m_name);
            made.copy(this);
            return made;
        endfunction
    endclass

    class uvm_phase extends uvm_object;
        function new(string name = "");
            super.new(name);
        endfunction
    endclass

    class uvm_component extends uvm_object;
        uvm_component m_parent;
        function new(string name, uvm_component parent);
            super.new(name);
            m_parent = parent;
        endfunction
        virtual function void check_phase(uvm_phase phase);
        endfunction
    endclass

    class uvm_sequence_item extends uvm_object;
        function new(string name = "");
            super.new(name);
        endfunction
    endclass

    // What an analysis port writes to.
    virtual class uvm_port_base #(type T = int) extends uvm_component;
        function new(string name, uvm_component parent);
            super.new(name, parent);
        endfunction
        pure virtual function void write(T t);
    endclass

    class uvm_analysis_port #(type T = int) extends uvm_port_base #(T);
        uvm_port_base #(T) m_to[$];
        function new(string name, uvm_component parent);
            super.new(name, parent);
        endfunction
        virtual function void connect(uvm_port_base #(T) to);
            m_to.push_back(to);
        endfunction
        virtual function void write(T t);
            foreach (m_to[i]) m_to[i].write(t);
        endfunction
    endclass

    virtual class uvm_subscriber #(type T = int) extends uvm_port_base #(T);
        uvm_port_base #(T) analysis_export;
        function new(string name, uvm_component parent);
            super.new(name, parent);
            analysis_export = this;
        endfunction
    endclass

    int unsigned errors;
    function automatic void report_error(string id, string message);
        errors++;
        $display("UVM_ERROR [%s] %s", id, message);
    endfunction
endpackage
