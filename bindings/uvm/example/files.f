// The example's files, relative to this folder, for the option `-F` of Questa, VCS, Xcelium and slang.
+incdir+.
-F ../../../rtl/tess.f
tess_if.sv
tess_example.sv
tb_example.sv
