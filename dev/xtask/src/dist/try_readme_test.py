"""What `try_readme.py` must see."""

import os
import tempfile
from pathlib import Path

from try_readme import main, script

README = """# A

Save this as `a.txt`:

```c
one
two
```

```console
$ wc -l < a.txt    # its lines
2
$ export WORD=so
$ mkdir -p inner && cd inner
$ echo in; pwd | grep -c inner
in
1
$ cd ..
$ echo \\
    $WORD > said
```

Not for machines:

<!-- not tried: it needs a window -->
```console
$ false
```
"""


def verdict(text):
    """Why a README fails; None if it does not."""
    Path("README.md").write_text(text)
    try:
        main("README.md")
    except SystemExit as error:
        return str(error)


def test_readmes():
    assert verdict(README) is None and Path("said").read_text() == "so\n", "a shell goes through it"
    assert script(README)[1] == 6, "a comment leaves out one"
    assert "ended with 1" in verdict(README.replace("\n2\n", "\n3\n")), "other output"
    assert "ended with 1" in verdict(README.replace("$ export", "$ false\n$ export")), "a command fails"
    assert "ended with 1" in verdict(README.replace("<!-- not tried: it needs a window -->\n", "")), "it is tried"
    assert "shows no command" in verdict("# A\n\n```c\none\n```\n"), "nothing to try"


if __name__ == "__main__":
    os.chdir(tempfile.mkdtemp())
    test_readmes()
    print("test_readmes: passed")
