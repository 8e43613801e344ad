"""Work in other processes: forked children, and simulators."""

import os
import select
import signal
import subprocess
import sys
import traceback
from pathlib import Path
from typing import Callable, Union


def in_a_child(work: "Callable[[], bytes]", patience: float = 60) -> bytes:
    """Result of the work in a forked child.

    Fails if the child raises, or has not ended in so many seconds.
    """
    reader, writer = os.pipe()
    sys.stdout.flush()
    child = os.fork()
    if child == 0:
        status = 1
        try:
            os.close(reader)
            os.write(writer, work())
            status = 0
        except BaseException:
            traceback.print_exc()
        finally:
            os._exit(status)
    os.close(writer)
    try:
        is_ready, _, _ = select.select([reader], [], [], patience)
        said = os.read(reader, 65536) if is_ready else None
    finally:
        os.close(reader)
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
    assert said is not None, f"the child hangs: it has not ended in {patience} s"
    assert said, "the child raised an exception"
    return said


def simulated(*words: Union[str, Path]) -> "subprocess.CompletedProcess[str]":
    """Runs Python with these words, which run a bench of cocotb."""
    # A simulator of another interpreter's cocotb would not find this one's packages.
    environment = {**os.environ, "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
    # By it cocotb's runner knows pytest, and would end the script before its last line.
    environment.pop("PYTEST_CURRENT_TEST", None)
    return subprocess.run([sys.executable, *words], capture_output=True, text=True, env=environment)
