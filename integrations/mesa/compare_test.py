"""The faults of drivers that the comparison must refuse."""

from compare import COLUMNS, QUESTIONS, judge


def test_faults_of_drivers_are_refused():
    def driver(*answers, piglit=("pass", "fail")):
        answers = {question: {**dict.fromkeys(COLUMNS, 0), **one} for question, one in zip(QUESTIONS, answers)}
        return {"answers": answers, "piglit": dict(zip("ab", piglit))}

    exact = {"patches": 10, "sequence": 10}
    flushing, wrapping = {**exact, "sequence": 8, "culling": 2}, {**exact, "sequence": 5, "connectivity": 5}
    other, few = {**exact, "sequence": 8, "order": 2}, {"patches": 9, "sequence": 9}
    unpatched, whole = driver(flushing, flushing, wrapping), driver(exact, exact, exact)

    def verdict(one_patch, whole=whole, unpatched=unpatched):
        return judge({"unpatched": unpatched, "0001": one_patch, "0001+0002": whole})

    one_patch = driver(exact, flushing, wrapping)
    assert verdict(one_patch) is None, "better"
    for fault, refused in {
        "another column": verdict(driver(exact, other, wrapping)),
        "patches are missing": verdict(driver(few, exact, exact)),
        "long draws wrap": verdict(whole, driver(exact, exact, wrapping)),
        "nothing was wrong before": verdict(whole, unpatched=driver(flushing, flushing, flushing)),
        "a test passes": verdict(driver(exact, flushing, wrapping, piglit=("pass", "pass"))),
        "a test is missing": verdict(driver(exact, flushing, wrapping, piglit=("pass",))),
        "a test fails": verdict(driver(exact, flushing, wrapping, piglit=("fail", "fail"))),
    }.items():
        assert refused, fault


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
            print(f"{name}: passed")
