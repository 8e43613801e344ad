"""Tests of the tables and charts of records, and of faults that must be detected."""

import study
from fresh import code_in, code_of_file
from measure import MEASUREMENTS, fastest, of_ablation, of_crossover, of_evaluated, of_first, of_groups, of_one_thread, of_probe, of_stage, of_surface, of_threads, record_of
from records import bench_table, digits, svg, table, with_tables


def test_three_digits_count():
    some = [digits(value) for value in (27430.4, 173.1, 14.85, 4.0749, 9.8, 0.5661, 0.0571, 0.00123)]
    assert some == ["27430", "173", "14.8", "4.07", "9.8", "0.566", "0.0571", "0.00123"], some


def test_a_table_names_what_varies_and_whether_targets_are_reached():
    row = {"workload": "worst", "backend": "simd", "patches_per_s": 4.07e6}
    rows = [{**row, "working_set": "cache", "fill_ratio": 0.5}, {**row, "working_set": "stream", "fill_ratio": 1.25}]
    target = {"backend": "simd", "workload": "worst", "key": "fill_ratio"}
    targets = [{**target, "working_set": "cache", "at_least": 0.45}, {**target, "working_set": "stream", "at_least": 1.3}]
    few = {"command": "tess bench", "machine": "a machine", "date": "2026-01-02", "commit": "abc", "rows": rows}
    assert table(few, targets) == (
        "    tess bench\n\na machine; 2026-01-02, commit abc.\n\n"
        "| workload | ns a patch | of fill | target |\n| --- | --- | --- | --- |\n"
        "| worst, cache | 246 | 0.5 | 0.45 of fill: reached |\n"
        "| worst, stream | 246 | 1.25 | 1.3 of fill: missed |\n"
    )


def test_single_patches_are_not_compared_with_a_fill():
    row = {"workload": "single/worst", "backend": "simd", "patches_per_s": 1e7, "fill_ratio": 0.5}
    assert bench_table([row], []) == (["workload", "ns a patch"], [["single/worst", "100"]]), bench_table([row], [])
    on_device = {**row, "workload": "worst", "backend": "gpu"}
    assert bench_table([on_device], []) == (["workload", "M patches/s", "of fill"], [["worst", "10", "0.5"]])


def test_tables_stand_between_their_markers():
    marked = "a\n<!-- table: one -->\nold\n<!-- end -->\nb\n<!-- table: two -->\n<!-- end -->\n"
    remade = "a\n<!-- table: one -->\nnew one\n<!-- end -->\nb\n<!-- table: two -->\nnew two\n<!-- end -->\n"
    assert with_tables(marked, "new {}\n".format) == (remade, ["one", "two"])
    assert fails(with_tables, "<!-- table: one -->\n", str) and fails(with_tables, marked.replace("<!-- end -->\nb", "b"), str)


def test_bars_are_as_long_as_their_values():
    linear, logarithmic = svg("", False, ["a", "b"], {"one": [2.0, 4.0]}), svg("", True, ["a", "b"], {"one": [10.0, 100.0]})
    for picture in (linear, logarithmic):
        assert 'width="250.0"' in picture and 'width="500.0"' in picture, picture
    assert "logarithmic" in logarithmic and fails(svg, "", False, ["a", "b"], {"one": [2.0, None]})


def test_comments_and_tests_are_no_code():
    text = "//! head\nuse a; // why\n\n    /// doc\nfn f() {}\n#[cfg(test)]\nmod tests {\n    fn g() {}\n}\n"
    assert code_in(text) == ["use a;", "fn f() {}"], code_in(text)
    assert code_in(text.replace("f()", "h()")) != code_in(text)


def test_rows_of_each_program():
    threads = of_threads(['[{"workload":"worst","bytes_per_s":2e9,"fill_ratio":0.5}]'] * 5)
    assert threads == [{"workload": "worst", **{n: "2.0 / 0.50" for n in ("1", "2", "4", "8", "16")}}], threads
    times = {"fixed": 1, "compute": 2, "ordered": 4, "fixed_drawn": 1, "compute_drawn": 1, "ordered_drawn": 0.5}
    (probed,) = of_probe([f'[{{"workload":"w","triangles":1000000,{str(times)[1:-1]}}}]'.replace("'", '"')])
    assert (probed["stage_alone"], probed["compute_alone"], probed["in_vertex_cache_order_drawn"]) == (1.0, 0.5, 2.0), probed
    variant = "{:<26}  152.3 G/s    445 factors 12 expand_points 94 expand_primitives 327{}\n"
    ablation = "NVIDIA\nuniform-16, 8 triangles\n" + variant.format("as they are", "") + variant.format("one thread a patch", " (wrong results)")
    assert of_ablation([ablation]) == [{"shaders": "as they are", "uniform-16": "445 / 94 / 327"}]
    assert of_one_thread([ablation])[0]["times_as_fast"] == 1.0
    groups = of_groups(["NVIDIA\ncharacter: 9 patches in 256 meshes, microseconds\none batch         49.1\nbatches         2861.7\n"])
    assert groups == [{"meshes": "one batch without groups", "microseconds": 49.1}, {"meshes": "256 batches", "microseconds": 2861.7}]
    lines = "".join(f"{1 << k:>6} {0.3:>9.1f} {13.4:>9.1f} {102.2:>9.1f}\n" for k in range(13))
    crossover = of_crossover(["NVIDIA; CPU level avx512\nuniform-1: patches, microseconds: CPU, device, both\n" + lines])
    assert crossover[0] == {"patches": 1, "uniform-1": "0.3 / 13 / 102"} and len(crossover) == 6, crossover
    row = "   48 {:6}       2 {:6}    100.0    200.0    110.0    {:5}  {:5.3f}    1.300\n"
    evaluated = of_evaluated(["NVIDIA\nbytes factor\n" + row.format(4, 1, 220.0, 1.104) + row.format(16, 1, 300.0, 1.5) + "\n     4      1    VertexCache    200.0     220.0  1.100\n"])
    assert evaluated == [{"bytes": 48, "octaves": 2, "one pass": "1.10 / 1.50", "one pass, attributes": "1.30 / 1.30"}], evaluated
    stage = of_stage(["head\npoints  triangles  prepare us  draw us  G\nstored     994756         118      802    1.081\n"])
    assert stage == [{"points": "stored", "triangles": 994756, "prepare_us": 118, "draw_us": 802, "G_triangles/s": 1.081}], stage
    criterion = "first/a tessellator/avx2  time:   [1.0 ns 70.4 ns 80 ns]\n                        change: [-1%]\nfirst/a tessellator/avx512\n                        time:   [1 µs 1.5 µs 2 µs]\n"
    assert of_first([criterion]) == [{"nanoseconds of": "a tessellator", "avx2": "70", "avx512": "1500"}], of_first([criterion])
    criterion = "surface/fill            time:   [1 ns 2 ns 3 ns]\n                        thrpt:  [1.0 Gelem/s 2.0000 Gelem/s 3.0 Gelem/s]\n"
    criterion += "surface/PN triangle/avx2\n                        time:   [1 us 2 us 3 us]\n                        thrpt:  [1.0 Melem/s 50.0 Melem/s 60.0 Melem/s]\n"
    assert of_surface([criterion]) == [{"surface": "PN triangle", "level": "avx2", "ns a vertex": "20.0", "fills": "40"}], of_surface([criterion])


def test_a_record_has_its_command():
    measured = {"machine": "m", "date": "2026-01-02", "rows": [{}]}
    record = record_of("simd-threads", measured, "abc")
    assert record["command"].startswith("cargo run --release -- bench --json --backend simd --threads N --frame 64"), record
    assert list(record) == ["command", "machine", "date", "commit", "columns", "rows"]
    assert all(record_of(name, measured, "abc")["command"] for name in MEASUREMENTS)


def test_all_code_that_is_measured_counts():
    paths = {name: measurement.code.paths() for name, measurement in MEASUREMENTS.items()}
    for name, path in (
        ("gpu", "tess-wgpu/shaders"),
        ("gpu", "tess-gpu/shaders"),
        ("gpu", "tess-core/src"),
        ("stage", "tess-wgpu/examples"),
        ("drawn", "tools/probe/shaders"),
        ("gpu-crossover", "tess-simd/src"),
        ("surface", "tess-level/src"),
        ("simd", "tess-workloads/src"),
    ):
        assert path in paths[name], f"{name}: {paths[name]} lacks {path}"
    others = [path for of in paths.values() for path in of if path.endswith(("/tests", "/benches")) or path == "tess-verify/src"]
    assert not others, others
    assert "tess-wgpu/examples" not in paths["gpu"] and "tess-gpu/src" not in paths["simd"], paths


def test_shaders_that_are_compiled_count_whole():
    assert code_of_file("a.rs", b"one  // remark\n\n") == code_of_file("a.rs", b"one\n")
    assert code_of_file("a.spv", b"\xff// 1") != code_of_file("a.spv", b"\xff// 2")


def test_each_row_is_the_fastest():
    def run(*speeds):
        return [{"workload": name, "patches_per_s": speed} for name, speed in zip("ab", speeds, strict=True)]

    assert fastest([run(3, 5), run(4, 1)]) == run(4, 5)
    vertices = [[{"ns a vertex": "20.0"}], [{"ns a vertex": "9.5"}]]
    assert fastest(vertices) == vertices[1], "the least time"
    tables = [[{"1": "9 / 0.8"}], [{"1": "11 / 0.9"}]]
    assert fastest(tables) == tables[0], "no single speed: the first run"


CIRCUIT = "| `uniform-64` | 24 | 101400 | 196608 | 196667 | 0.515 | 0.999 | 0 |\n| clock with seeds 1, 2, 3 | 104.2, 110.8, 99.0 MHz | 101.0, 95.0, 103.0 MHz |\n"


def study_records(card="NVIDIA H200"):
    """Records of the study: one call takes a tenth of the study's time, one patch on the GPU a hundredth."""
    machine = {"machine": f"{card}, driver 1; processor", "command": "c", "date": "d", "commit": "abc"}
    names = {**study.INPUTS, study.ISOLINES: ("", 1.0, 1.0)}
    ours = lambda name, cpu, gpu: {"workload": name, "triangles": 8000, "call_ns": cpu * 1e5, "model_ns": cpu * 1e6, "device_us": gpu * 10}
    rows = [{**ours(name, cpu, gpu), "batch_ns": 4000.0, "host_us": 1.0, "frame_us": 1.0, "ghz": 2.5, "mhz": 2000} for name, (_, cpu, gpu) in names.items()]
    stage = {"workload": "w", "stage_alone": 1.0, "in_vertex_cache_order_alone": 50.0, "stage_drawn": 1.0, "in_vertex_cache_order_drawn": 1.5}
    swept = [{"backend": "gpu", "rows": 792, "mismatches": 3}]
    made = {"study-cpu": rows, "study-gpu": rows, "study-sweep": swept, "study-sweep-gpu": swept, "drawn": [stage]}
    made["gpu"] = [{"workload": "w", "triangles_per_s": 5e10}]
    return {name: {**machine, "rows": rows} for name, rows in made.items()}


def test_the_study_is_compared():
    tables = study.tables(study_records().__getitem__, CIRCUIT)
    assert "| 16^6 | 8000 | 7.18 | 0.718 | 4.00 | 7.18 | 10 |" in tables["study-cpu"], tables["study-cpu"]
    assert "| 64^6 | 8000 | 2369.81 | 23.7 | 1.00 | 1.00 | 4.00 | 100 |" in tables["study-gpu"], tables["study-gpu"]
    assert "| 6 of 1584 [" in tables["study-answers"], "the rows that differ are added up"
    assert "making triangles, 50 to 50 times as fast; with drawing, 1.50 to 1.50 times" in tables["study-answers"]
    assert "| 3.0 to 3.0 % of a frame" in tables["study-answers"]
    assert "`w` | 50000 | 2.00 GHz, read from its driver | 25.0 |" in tables["study-clocks"], tables["study-clocks"]
    assert "`uniform-64` | 101 | 101 MHz on an ECP5 | 0.999 |" in tables["study-clocks"], tables["study-clocks"]


def test_a_clock_of_another_gpu_is_named():
    records = study_records() | {name: record for name, record in study_records("NVIDIA H100").items() if name in ("gpu", "drawn")}
    clocks = study.tables(records.__getitem__, CIRCUIT)["study-clocks"]
    assert clocks.count("as the NVIDIA H200") == 2 and "on an NVIDIA H100, `w`" in clocks, clocks


def test_a_sweep_counts_rows_that_differ():
    swept = MEASUREMENTS["study-sweep"].rows(["792 cases, 0 mismatches\n", "head\n792 cases, 5 mismatches\n"])
    assert swept == [{"backend": "core", "rows": 792, "mismatches": 0}, {"backend": "simd", "rows": 792, "mismatches": 5}], swept


def fails(function, *arguments):
    try:
        function(*arguments)
    except AssertionError:
        return True
    return False


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
            print(f"{name}: passed")
