"""Tests of the tables and charts of records, and of the faults that must be seen."""

from records import digits, svg, table, with_tables


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
        "| workload | M patches/s | of fill | target |\n| --- | --- | --- | --- |\n"
        "| worst, cache | 4.07 | 0.5 | 0.45 of fill: reached |\n"
        "| worst, stream | 4.07 | 1.25 | 1.3 of fill: missed |\n"
    )


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
