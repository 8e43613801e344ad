// The golden tessellator in SystemVerilog: DPI-C imports and typed wrappers.
//
// Link the simulation with the library of tess-capi (libtess_capi.a or .so). All numbers are passed as
// `int unsigned`, so that calls are the same in every simulator: factors as the bits of binary32 or
// 15.16 numbers, coordinates as 16.16 bits. Only the handle of a held patch is a chandle. An import that
// has outputs returns a status: 0 (TESS_OK), or the reason why its outputs were not written, which
// tess_status_message() describes.
//
// The wrappers below take enumerations and return structures. If the model refuses the arguments, they
// end the simulation with $fatal and the reason, so that nothing is compared with undefined values.
package tess_dpi;

    typedef enum int unsigned { ISOLINE = 0, TRIANGLE = 1, QUAD = 2 } domain_e;
    typedef enum int unsigned {
        INTEGER = 0, POW2 = 1, FRACTIONAL_ODD = 2, FRACTIONAL_EVEN = 3
    } partitioning_e;
    typedef enum int unsigned {
        POINT = 0, LINE = 1, TRIANGLE_CW = 2, TRIANGLE_CCW = 3
    } output_e;
    typedef enum int unsigned { RULER = 0, CENTER = 1 } split_order_e;
    typedef enum int unsigned { EVEN = 0, ODD = 1 } parity_e;
    typedef enum int unsigned { CULLED = 0, MINIMUM = 1, REGULAR = 2 } outcome_e;

    // The configuration of a tessellator.
    typedef struct {
        domain_e       domain;
        partitioning_e partitioning;
        output_e       out;
        split_order_e  split_order;
    } config_t;

    // The bits of a patch's binary32 factors, [0] first, in the order of the domain: density, detail;
    // outer U=0, V=0, W=0, inside; or outer U=0, V=0, U=1, V=1, inside U, V. Further elements are ignored.
    typedef bit [5:0][31:0] factors_t;

    // The context of a factor (specification, section 4).
    typedef struct {
        int unsigned inv_floor;   // reciprocals and fraction: 16 fraction bits
        int unsigned inv_ceil;
        int unsigned fraction;
        int unsigned half_points; // 1..32
        int unsigned split;       // 0..33
        int unsigned points;      // 2..65
    } context_t;

    // The placement of one point (specification, section 5), signal by signal.
    typedef struct {
        int unsigned flip;          // 1 on the second half of the edge
        int unsigned position;      // on the half edge; half_points in the exact middle
        int unsigned coarse;        // in the coarser subdivision; 0 in the exact middle
        int unsigned fine;          // in the finer subdivision; 0 in the exact middle
        int unsigned half_location; // blended and rounded; one half in the exact middle
        int unsigned location;      // mirrored back: 16.16, 0..0x10000
    } placement_t;

    // One factor after factor processing (specification, section 3). If culled, all fields except outcome are 0.
    typedef struct {
        outcome_e    outcome; // of the whole patch
        int unsigned clamped; // binary32 bits
        int unsigned rounded; // binary32 bits
        int unsigned fixed;   // 15.16
        parity_e     parity;
    } processed_t;

    typedef struct { int unsigned points, primitives, indices; } counts_t;
    typedef struct { int unsigned u, v; } point_t;
    // size indices, 1 to 3; the others are 0.
    typedef struct { int unsigned size, i0, i1, i2; } primitive_t;

    // The library's version, major << 16 | minor << 8 | patch.
    import "DPI-C" function int unsigned tess_version();

    // Meaning of a status.
    import "DPI-C" function string tess_status_message(input int unsigned status);

    // Converts binary32 bits to a 15.16 number (specification, section 2). Cannot fail.
    import "DPI-C" function int unsigned tess_fixed_factor(input int unsigned binary32_bits);

    import "DPI-C" function int unsigned tess_dpi_context(
        input int unsigned factor, input int unsigned parity, input int unsigned split_order,
        output int unsigned inv_floor, output int unsigned inv_ceil, output int unsigned fraction,
        output int unsigned half_points, output int unsigned split, output int unsigned points);

    import "DPI-C" function int unsigned tess_dpi_place(
        input int unsigned factor, input int unsigned parity, input int unsigned split_order,
        input int unsigned p,
        output int unsigned flip, output int unsigned position, output int unsigned coarse,
        output int unsigned fine, output int unsigned half_location, output int unsigned location);

    import "DPI-C" function int unsigned tess_dpi_process(
        input int unsigned domain, input int unsigned partitioning, input int unsigned split_order,
        input int unsigned f0, input int unsigned f1, input int unsigned f2,
        input int unsigned f3, input int unsigned f4, input int unsigned f5,
        input int unsigned number,
        output int unsigned outcome, output int unsigned clamped, output int unsigned rounded,
        output int unsigned fixed, output int unsigned parity);

    // Gets the number of the i-th coverage bin that a patch hits; TESS_OUT_OF_RANGE past the last one.
    import "DPI-C" function int unsigned tess_dpi_coverage(
        input int unsigned domain, input int unsigned partitioning,
        input int unsigned out, input int unsigned split_order,
        input int unsigned f0, input int unsigned f1, input int unsigned f2,
        input int unsigned f3, input int unsigned f4, input int unsigned f5,
        input int unsigned i, output int unsigned bin);

    // A handle holds one patch; the elements asked for are those of the patch that was set last.
    import "DPI-C" function int unsigned tess_dpi_open(output chandle held);

    import "DPI-C" function void tess_dpi_close(input chandle held);

    import "DPI-C" function int unsigned tess_dpi_patch(
        input chandle held,
        input int unsigned domain, input int unsigned partitioning,
        input int unsigned out, input int unsigned split_order,
        input int unsigned f0, input int unsigned f1, input int unsigned f2,
        input int unsigned f3, input int unsigned f4, input int unsigned f5,
        output int unsigned points, output int unsigned primitives, output int unsigned indices);

    import "DPI-C" function int unsigned tess_dpi_point(
        input chandle held, input int unsigned i, output int unsigned u, output int unsigned v);

    import "DPI-C" function int unsigned tess_dpi_primitive(
        input chandle held, input int unsigned t,
        output int unsigned size,
        output int unsigned i0, output int unsigned i1, output int unsigned i2);

    localparam int unsigned TESS_OUT_OF_RANGE = 6;

    function automatic void require_ok(input int unsigned status, input string call);
        if (status != 0) $fatal(1, "tess_dpi: %s: %s", call, tess_status_message(status));
    endfunction

    // The context of a 15.16 factor. A factor out of range is clamped.
    function automatic context_t model_context(
            input int unsigned factor, input parity_e parity, input split_order_e split_order);
        context_t c;
        require_ok(tess_dpi_context(factor, parity, split_order, c.inv_floor, c.inv_ceil,
            c.fraction, c.half_points, c.split, c.points), "context");
        return c;
    endfunction

    // The placement of point p of an edge, p below the context's points.
    function automatic placement_t model_place(
            input int unsigned factor, input parity_e parity, input split_order_e split_order,
            input int unsigned p);
        placement_t s;
        require_ok(tess_dpi_place(factor, parity, split_order, p, s.flip, s.position, s.coarse,
            s.fine, s.half_location, s.location), "place");
        return s;
    endfunction

    // Factor `number` of a patch after factor processing; cfg.out has no effect.
    function automatic processed_t model_process(
            input config_t cfg, input factors_t x, input int unsigned number);
        processed_t r;
        int unsigned outcome, parity;
        require_ok(tess_dpi_process(cfg.domain, cfg.partitioning, cfg.split_order,
            x[0], x[1], x[2], x[3], x[4], x[5], number,
            outcome, r.clamped, r.rounded, r.fixed, parity), "process");
        r.outcome = outcome_e'(outcome);
        r.parity  = parity_e'(parity);
        return r;
    endfunction

    // A handle that holds one patch at a time. Free it with tess_dpi_close.
    function automatic chandle model_open();
        chandle held;
        require_ok(tess_dpi_open(held), "open");
        return held;
    endfunction

    // Holds a patch in place of the previous one; returns its sizes.
    function automatic counts_t model_patch(input chandle held, input config_t cfg, input factors_t x);
        counts_t c;
        require_ok(tess_dpi_patch(held, cfg.domain, cfg.partitioning, cfg.out, cfg.split_order,
            x[0], x[1], x[2], x[3], x[4], x[5],
            c.points, c.primitives, c.indices), "patch");
        return c;
    endfunction

    // Point i of the held patch, i below its count.
    function automatic point_t model_point(input chandle held, input int unsigned i);
        point_t r;
        require_ok(tess_dpi_point(held, i, r.u, r.v), "point");
        return r;
    endfunction

    // Primitive t of the held patch, t below its count.
    function automatic primitive_t model_primitive(input chandle held, input int unsigned t);
        primitive_t r;
        require_ok(tess_dpi_primitive(held, t, r.size, r.i0, r.i1, r.i2), "primitive");
        return r;
    endfunction

    // Gets the i-th coverage bin that a patch hits, numbered as in tess_covergroups.svh of tess_uvm. Returns
    // 0 if the patch hits no more bins.
    function automatic bit model_coverage(
            input config_t cfg, input factors_t x, input int unsigned i, output int unsigned bin);
        int unsigned status = tess_dpi_coverage(cfg.domain, cfg.partitioning, cfg.out,
            cfg.split_order, x[0], x[1], x[2], x[3], x[4], x[5], i, bin);
        if (status == TESS_OUT_OF_RANGE) return 1'b0;
        require_ok(status, "coverage");
        return 1'b1;
    endfunction
endpackage
