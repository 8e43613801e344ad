"""Does what a README says: `try_readme.py README`, in a folder that has the archives and nothing else.

Each block of code after "as `FILE`:" is written to FILE. Each block of a console is run, one after another in one shell:
what follows a line `$ COMMAND` must be what the command prints on its standard output, where the block shows any. A block
after the comment `<!-- not tried: REASON -->` is left out, and the reason printed. Exit status 1: a command fails, prints
something else, or the README has none.
"""

import re
import subprocess
import sys
from pathlib import Path

BLOCK = re.compile(r"([^\n]*)\n*^```([\w,]*)\n(.*?)^```$", re.M | re.S)


def blocks(text):
    """The line before each block of code, its language and its text."""
    return [(before.strip(), language, body) for before, language, body in BLOCK.findall("\n" + text)]


def commands(console):
    """The commands of a console's block, and the lines that each of them prints; none are shown as None."""
    for part in re.split(r"^\$ ", console, flags=re.M)[1:]:
        lines = part.splitlines()
        command = [lines.pop(0)]
        while command[-1].endswith("\\"):
            command.append(lines.pop(0))
        yield "\n".join(command), lines or None


def script(text):
    """A shell's script that does what the README says, and how many commands it runs."""
    lines, count = ["set -eu"], 0
    for before, language, body in blocks(text):
        if reason := re.fullmatch(r"<!-- not tried: (.*) -->", before):
            print(f"not tried: {reason[1]}", flush=True)
        elif name := re.search(r"as `([\w./-]+)`:$", before):
            Path(name[1]).write_text(body)
        elif language == "console":
            for command, expected in commands(body):
                count += 1
                lines += ["cat <<'END'", f"$ {command}", "END"]
                if expected is None:
                    lines.append(command)
                    continue
                # Absolute: the commands may go to another folder.
                wanted, printed = Path(f"expected-{count}").absolute(), Path(f"printed-{count}").absolute()
                wanted.write_text("\n".join(expected) + "\n")
                lines += ["{", command, f"}} > '{printed}'", f"diff -u '{wanted}' '{printed}'"]
    return "\n".join(lines) + "\n", count


def main(readme):
    text, count = script(Path(readme).read_text())
    if count == 0:
        sys.exit(f"{readme} shows no command")
    Path("readme.sh").write_text(text)
    if code := subprocess.call(["sh", "readme.sh"]):
        sys.exit(f"{readme}: its commands ended with {code}")
    print(f"{readme}: {count} commands did what it says")


if __name__ == "__main__":
    main(*sys.argv[1:])
