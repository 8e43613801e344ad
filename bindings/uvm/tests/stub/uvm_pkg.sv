// A stub of the parts of UVM that tess_uvm uses, so that a simulator without UVM compiles and runs it
// in this project's tests. It does not implement UVM: there is no factory, phases are called by hand, a sequencer has one
// sequence, and reports are lines. The other names that the example uses do nothing; they are declared so that it can be
// elaborated.
package uvm_pkg;
    typedef enum bit { UVM_PASSIVE = 0, UVM_ACTIVE = 1 } uvm_active_passive_enum;

    class uvm_comparer;
        int unsigned m_compares;
    endclass

    // Keeps the text that is printed.
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
        virtual function uvm_object m_create(string name = "");
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
            uvm_object made = m_create(m_name);
            made.copy(this);
            return made;
        endfunction
    endclass

    class uvm_phase extends uvm_object;
        function new(string name = "");
            super.new(name);
        endfunction
        function void raise_objection(uvm_object obj);
        endfunction
        function void drop_objection(uvm_object obj);
        endfunction
    endclass

    class uvm_component extends uvm_object;
        uvm_component m_parent;
        function new(string name, uvm_component parent);
            super.new(name);
            m_parent = parent;
        endfunction
        virtual function void build_phase(uvm_phase phase);
        endfunction
        virtual function void connect_phase(uvm_phase phase);
        endfunction
        virtual task run_phase(uvm_phase phase);
        endtask
        virtual function void check_phase(uvm_phase phase);
        endfunction
        virtual function void report_phase(uvm_phase phase);
        endfunction
    endclass

    class uvm_env extends uvm_component;
        function new(string name, uvm_component parent);
            super.new(name, parent);
        endfunction
    endclass

    class uvm_test extends uvm_component;
        function new(string name, uvm_component parent);
            super.new(name, parent);
        endfunction
    endclass

    class uvm_agent extends uvm_component;
        function new(string name, uvm_component parent);
            super.new(name, parent);
        endfunction
        virtual function uvm_active_passive_enum get_is_active();
            return UVM_ACTIVE;
        endfunction
    endclass

    class uvm_config_db #(type T = int);
        static function void set(uvm_component scope, string instance_name, string name, T value);
        endfunction
        static function bit get(uvm_component scope, string instance_name, string name, inout T value);
            return 0;
        endfunction
    endclass

    class uvm_sequence_item extends uvm_object;
        function new(string name = "");
            super.new(name);
        endfunction
    endclass

    // The target of an analysis port.
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

    // Passes items from a sequence to a driver. It is not parameterised by the type of the items, which Verilator 5.006
    // would lose.
    class m_item_channel;
        mailbox #(uvm_sequence_item) m_items;
        mailbox #(bit)               m_done;
        function new();
            m_items = new(1);
            m_done = new(1);
        endfunction
    endclass

    class uvm_sequencer_base extends uvm_component;
        m_item_channel seq_item_export;
        function new(string name, uvm_component parent);
            super.new(name, parent);
            seq_item_export = new();
        endfunction
    endclass

    class uvm_sequencer #(type REQ = uvm_sequence_item) extends uvm_sequencer_base;
        function new(string name, uvm_component parent);
            super.new(name, parent);
        endfunction
    endclass

    class uvm_seq_item_pull_port;
        m_item_channel m_from;
        function void connect(m_item_channel exporter);
            m_from = exporter;
        endfunction
        task get_next_item(output uvm_sequence_item item);
            m_from.m_items.get(item);
        endtask
        function void item_done();
            void'(m_from.m_done.try_put(1'b1));
        endfunction
    endclass

    class uvm_driver #(type REQ = uvm_sequence_item) extends uvm_component;
        uvm_seq_item_pull_port seq_item_port;
        function new(string name, uvm_component parent);
            super.new(name, parent);
            seq_item_port = new();
        endfunction
    endclass

    class uvm_sequence_base extends uvm_object;
        m_item_channel m_to;
        function new(string name = "");
            super.new(name);
        endfunction
        virtual task body();
            if (m_to == null) #1; // makes this a task that takes time, like its overrides
        endtask
        task start(uvm_sequencer_base sequencer);
            m_to = sequencer.seq_item_export;
            body();
        endtask
        task start_item(uvm_sequence_item item);
        endtask
        task finish_item(uvm_sequence_item item);
            bit done;
            m_to.m_items.put(item);
            m_to.m_done.get(done);
        endtask
    endclass

    class uvm_sequence #(type REQ = uvm_sequence_item) extends uvm_sequence_base;
        function new(string name = "");
            super.new(name);
        endfunction
    endclass

    task automatic run_test(string name);
    endtask

    int unsigned errors;
    function automatic void report_error(string id, string message);
        errors++;
        $display("UVM_ERROR [%s] %s", id, message);
    endfunction
endpackage
