// Sends the patches of a file. Its lines are case lines, as in messages of the scoreboard and `tess check`, or the rows of
// `tess gen`. For level 1, every boundary once, use the file of `tess gen --level 1 -o level-1.csv`.
//
// The file is `file`, or that of +tess_cases=FILE. Lines that begin with #, headings, and words after the factors are
// ignored. The simulation ends if a line is not a case, if the file has no cases, or if it cannot be read.
class tess_file_sequence extends uvm_sequence #(tess_patch_item);
    string       file;
    int unsigned most = 0; // the largest number of patches to send; 0 for all
    int unsigned sent = 0;

    `uvm_object_utils(tess_file_sequence)

    function new(string name = "tess_file_sequence");
        super.new(name);
    endfunction

    virtual task body();
        string line;
        int    handle;
        int    number = 0;
        if (file == "") void'($value$plusargs("tess_cases=%s", file));
        handle = $fopen(file, "r");
        if (handle == 0) `uvm_fatal("TESS", $sformatf("cannot read the cases of '%s'; +tess_cases=FILE names them", file))
        while ((most == 0 || sent < most) && $fgets(line, handle) != 0) begin
            number++;
            send(line, number);
        end
        $fclose(handle);
        if (sent == 0) `uvm_fatal("TESS", {"there is no case in ", file})
    endtask

    // Sends the patch of a line, if it has one.
    protected task send(string line, int number);
        tess_patch_item item;
        if (!tess_patch_item::is_case(line)) return;
        item = tess_patch_item::type_id::create("patch");
        start_item(item);
        if (!item.from_case(line))
            `uvm_fatal("TESS", $sformatf("%s:%0d: no case: %s", file, number, line))
        finish_item(item);
        sent++;
    endtask
endclass
