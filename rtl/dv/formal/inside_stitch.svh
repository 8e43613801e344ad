// Stands at the end of tess_stitch in the copy that is proved.
prove_stitch proof (
    .clk(clk), .rst(rst), .advance(advance), .takes(takes), .further(ahead.further), .last(ahead.last), .walks(walks),
    .to_come(to_come), .ends(ends), .here_last(here.last), .made_valid(made_valid), .made_last(made.last), .step_valid(step_valid),
    .step_last(step.last)
);
