// Names of the domains, partitionings, outputs and split orders, each in the order of its numbers.
localparam string TESS_NAMES[13] = '{"isoline", "tri", "quad",
    "integer", "pow2", "fractional_odd", "fractional_even",
    "point", "line", "triangle_cw", "triangle_ccw",
    "ruler", "center"};

// A patch. The factors are bits of binary32 numbers, in the order of tess_dpi::factors_t.
class tess_patch_item extends uvm_sequence_item;
    rand domain_e       domain;
    rand partitioning_e partitioning;
    rand output_e       out;
    rand split_order_e  split_order;
    rand bit [31:0]     factors[6];

    `uvm_object_utils(tess_patch_item)

    // Small factors, because simulations are slow: 1 to 16 with all fractions. Turn this constraint off to get
    // every bit pattern.
    constraint c_small {
        foreach (factors[i]) factors[i] inside {[32'h3F80_0000 : 32'h4180_0000]};
    }

    function new(string name = "tess_patch_item");
        super.new(name);
    endfunction

    function config_t cfg();
        config_t c;
        c.domain = domain;
        c.partitioning = partitioning;
        c.out = out;
        c.split_order = split_order;
        return c;
    endfunction

    // The factors as tess_dpi takes them.
    function void get_factors(output factors_t x);
        for (int i = 0; i < 6; i++) x[i] = factors[i];
    endfunction

    // The domain's number of factors.
    function int unsigned factor_count();
        return 2 + 2 * int'(domain);
    endfunction

    // Everything that the result depends on, as a line that `tess patch --cases` takes.
    virtual function string convert2string();
        string words = $sformatf("case %s %s %s %s", TESS_NAMES[int'(domain)], TESS_NAMES[3 + int'(partitioning)],
            TESS_NAMES[7 + int'(out)], TESS_NAMES[11 + int'(split_order)]);
        for (int unsigned i = 0; i < factor_count(); i++) words = {words, $sformatf(" %08x", factors[i])};
        return words;
    endfunction

    // Whether a line of a file is neither empty nor a remark nor a heading.
    static function bit is_case(string line);
        string word;
        if ($sscanf(line, "%s", word) < 1) return 0;
        if (word.substr(0, 0) == "#") return 0;
        return word.len() < 7 || word.substr(0, 6) != "domain,";
    endfunction

    // Reads a line of `convert2string` or a row of `tess gen`. Returns 0 and changes nothing if the line is neither.
    virtual function bit from_case(string line);
        string          words[10];
        int             given = 0;
        int             d, p, o, s;
        bit [31:0]      x[6];
        string          blanks = line;
        for (int i = 0; i < blanks.len(); i++) if (blanks.getc(i) == ",") blanks.putc(i, " ");
        if (blanks.len() > 5 && blanks.substr(0, 4) == "case ") blanks = blanks.substr(5, blanks.len() - 1);
        // The words are counted, because Verilator 5.048 returns -1 for fewer than ten.
        void'($sscanf(blanks, "%s %s %s %s %s %s %s %s %s %s", words[0], words[1], words[2], words[3], words[4],
            words[5], words[6], words[7], words[8], words[9]));
        foreach (words[i]) if (words[i] != "") given++;
        if (given < 4) return 0;
        d = number_of(words[0], 0, 3);
        p = number_of(words[1], 3, 4);
        o = number_of(words[2], 7, 4);
        s = number_of(words[3], 11, 2);
        if (d < 0 || p < 0 || o < 0 || s < 0 || given < 6 + 2 * d) return 0;
        for (int i = 0; i < 2 + 2 * d; i++) begin
            if (!is_hex(words[4 + i]) || $sscanf(words[4 + i], "%h", x[i]) != 1) return 0;
        end
        domain       = domain_e'(d);
        partitioning = partitioning_e'(p);
        out          = output_e'(o);
        split_order  = split_order_e'(s);
        factors      = x;
        return 1;
    endfunction

    // Whether a word is eight hex digits, the bits of a factor.
    protected static function bit is_hex(string word);
        if (word.len() != 8) return 0;
        for (int i = 0; i < 8; i++) begin
            byte digit = word.getc(i);
            if (!((digit >= "0" && digit <= "9") || (digit >= "a" && digit <= "f"))) return 0;
        end
        return 1;
    endfunction

    // The number of a word among `count` names, beginning with name `first`; -1 if it is not among them.
    protected static function int number_of(string word, int first, int count);
        for (int i = 0; i < count; i++) if (word == TESS_NAMES[first + i]) return i;
        return -1;
    endfunction

    virtual function void do_copy(uvm_object rhs);
        tess_patch_item other;
        super.do_copy(rhs);
        if (!$cast(other, rhs)) `uvm_fatal("TESS", "a patch is copied from an object that is none")
        domain       = other.domain;
        partitioning = other.partitioning;
        out          = other.out;
        split_order  = other.split_order;
        factors      = other.factors;
    endfunction

    // Compares only what the result depends on: the factors that the domain does not have are ignored.
    virtual function bit do_compare(uvm_object rhs, uvm_comparer comparer);
        tess_patch_item other;
        if (!$cast(other, rhs)) return 0;
        return super.do_compare(rhs, comparer) && convert2string() == other.convert2string();
    endfunction

    virtual function void do_print(uvm_printer printer);
        super.do_print(printer);
        printer.print_string("case", convert2string());
    endfunction
endclass

// The output of a patch: its 16.16 points and its indices, in order.
class tess_result_item extends uvm_sequence_item;
    tess_patch_item patch;
    int unsigned    u[$];
    int unsigned    v[$];
    int unsigned    indices[$];

    `uvm_object_utils(tess_result_item)

    function new(string name = "tess_result_item");
        super.new(name);
    endfunction

    virtual function string convert2string();
        return $sformatf("%0d points, %0d indices of %s", u.size(), indices.size(),
            patch == null ? "no patch" : patch.convert2string());
    endfunction

    // Copies the patch too, because a driver may reuse its own for the next patch.
    virtual function void do_copy(uvm_object rhs);
        tess_result_item other;
        super.do_copy(rhs);
        if (!$cast(other, rhs)) `uvm_fatal("TESS", "a result is copied from an object that is none")
        patch = null;
        if (other.patch != null) begin
            patch = new(other.patch.get_name());
            patch.copy(other.patch);
        end
        u       = other.u;
        v       = other.v;
        indices = other.indices;
    endfunction

    virtual function bit do_compare(uvm_object rhs, uvm_comparer comparer);
        tess_result_item other;
        bit              same_patch;
        if (!$cast(other, rhs)) return 0;
        if (patch == null || other.patch == null) same_patch = patch == other.patch;
        else same_patch = patch.do_compare(other.patch, comparer);
        return super.do_compare(rhs, comparer) && same_patch
            && u == other.u && v == other.v && indices == other.indices;
    endfunction

    virtual function void do_print(uvm_printer printer);
        super.do_print(printer);
        printer.print_string("result", convert2string());
        foreach (u[i])
            printer.print_string($sformatf("point %0d", i), $sformatf("%05x %05x", u[i], i < v.size() ? v[i] : 0));
        foreach (indices[i])
            printer.print_string($sformatf("index %0d", i), $sformatf("%0d", indices[i]));
    endfunction
endclass
