"""Where the recorded results and the program are."""

import os
from pathlib import Path
from typing import Any

import pytest

REPOSITORY = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def golden() -> Path:
    return REPOSITORY / "golden"


@pytest.fixture(scope="session")
def program() -> Path:
    """The program ``tess``, which ``cargo xtask python`` builds and names."""
    name = os.environ.get("TESS_PROGRAM")
    assert name, "TESS_PROGRAM names the program `tess` to compare with: run `cargo xtask python`"
    return Path(name)


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """The line that `cargo xtask` counts tests by."""
    counts = {what: len(terminalreporter.stats.get(what, [])) for what in ("passed", "failed", "error", "skipped")}
    failed = counts["failed"] + counts["error"]
    terminalreporter.write_line(
        f"test result: {'FAILED' if failed else 'ok'}. {counts['passed']} passed; {failed} failed; "
        f"{counts['skipped']} ignored"
    )
