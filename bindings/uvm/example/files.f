// The example's files, with paths from this folder: an argument `-F` of Questa, VCS, Xcelium and slang.
+incdir+.
-F ../../../rtl/tess.f
tess_if.sv
tess_example.sv
tb_example.sv
