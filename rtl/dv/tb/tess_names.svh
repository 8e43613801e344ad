// Written by `cargo xtask rtl --names` from rtl/stages.tsv. Do not edit.
// The bench includes it: the number of each signal, then names by number. OPTIONS chooses in `tess explain` what
// the signal describes.
localparam int unsigned FACTORS_CULLED = 0;
localparam int unsigned FACTORS_FIXED = 1;
localparam int unsigned FACTORS_ODD = 2;
localparam int unsigned FACTOR_CONTEXT_FRACTION = 3;
localparam int unsigned FACTOR_CONTEXT_HALF_POINTS = 4;
localparam int unsigned FACTOR_CONTEXT_POINTS = 5;
localparam int unsigned FACTOR_CONTEXT_SPLIT = 6;
localparam int unsigned FACTOR_CONTEXT_INV_FLOOR = 7;
localparam int unsigned FACTOR_CONTEXT_INV_CEIL = 8;
localparam int unsigned COUNTS_POINTS = 9;
localparam int unsigned COUNTS_PRIMITIVES = 10;
localparam int unsigned POINTS_VALID = 11;
localparam int unsigned POINTS_U = 12;
localparam int unsigned POINTS_V = 13;
localparam int unsigned POINTS_LAST = 14;
localparam int unsigned CONNECT_VALID = 15;
localparam int unsigned CONNECT_SIZE = 16;
localparam int unsigned CONNECT_I0 = 17;
localparam int unsigned CONNECT_I1 = 18;
localparam int unsigned CONNECT_I2 = 19;
localparam int unsigned CONNECT_LAST = 20;
string STAGES[21] = '{
    "factors",
    "factors",
    "factors",
    "factor_context",
    "factor_context",
    "factor_context",
    "factor_context",
    "factor_context",
    "factor_context",
    "counts",
    "counts",
    "points",
    "points",
    "points",
    "points",
    "connect",
    "connect",
    "connect",
    "connect",
    "connect",
    "connect"
};
string SIGNALS[21] = '{
    "culled",
    "fixed",
    "odd",
    "fraction",
    "half_points",
    "points",
    "split",
    "inv_floor",
    "inv_ceil",
    "points",
    "primitives",
    "valid",
    "u",
    "v",
    "last",
    "valid",
    "size",
    "i0",
    "i1",
    "i2",
    "last"
};
string MODULES[21] = '{
    "tess_factors",
    "tess_factor",
    "tess_factor",
    "tess_factor_context",
    "tess_factor_context",
    "tess_factor_context",
    "tess_factor_context",
    "tess_factor_context",
    "tess_factor_context",
    "tess_factors",
    "tess_factors",
    "tess_points",
    "tess_points",
    "tess_points",
    "tess_points",
    "tess_connect",
    "tess_connect",
    "tess_connect",
    "tess_connect",
    "tess_connect",
    "tess_connect"
};
string OPTIONS[21] = '{
    "factor",
    "factor",
    "factor",
    "factor",
    "factor",
    "factor",
    "factor",
    "factor",
    "factor",
    "",
    "",
    "point",
    "point",
    "point",
    "point",
    "primitive",
    "primitive",
    "primitive",
    "primitive",
    "primitive",
    "primitive"
};
