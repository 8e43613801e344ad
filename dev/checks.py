"""Checks of texts: `checks.py traceability`, `checks.py public`, `checks.py width`.

traceability: each row of docs/traceability.md is a demand of the specification, with the tests, recorded results, rules or
proofs that see a violation. Every numbered section has a row, and everything that a row names exists.

public: an item of a published library that nobody outside uses is a promise that nobody tests. Words are compared, not
paths: an item counts as used where its name stands in the code of a test, an example, a bench, a tool, a binding or
another crate. A type may also come with its caller: it stands in a signature or a field. The lint `unreachable_pub` sees
to it that what is `pub` can be reached.

width: a line of Rust has at most 100 columns, as `rustfmt.toml` says. rustfmt reports no line that it cannot break, such as
those of a macro's rules. Text in quotes may be longer, because programs wrap it, and so may listings and tables in comments.
"""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def read(path):
    return (ROOT / path).read_text()


def evidence(quoted, read):
    """What is wrong with the name of a test, a recorded result, a rule or a proof; None if it exists."""
    if not re.fullmatch("`.+`", quoted):
        return f"`{quoted}` is no name in backticks"
    path, _, item = quoted.strip("`").partition("::")
    try:
        text = read(path)
    except OSError as error:
        return f"{path}: {error}"
    if path == "docs/rules.md":
        is_there = f"\n| `{item}` | " in text
    elif not item:
        is_there = path.startswith(("golden/", "rtl/dv/formal/prove_"))
    else:
        before, found, _ = text.partition(f"fn {item}(")
        attributes = re.split("[};]", before)[-1]
        # `ci` runs a test that is marked as slow.
        ignored = re.search(r'#\[ignore(?! = "slow: )', attributes)
        is_there = found and "#[test]" in attributes and not ignored
    return None if is_there else f"there is no {quoted.strip('`')}"


def traceability(page, table, read):
    """The number of demands, and the errors: sections without a row, and rows of unknown sections or evidence."""
    sections = re.findall(r"^#+ (\d[\d.]*?)\.? ", page, re.MULTILINE)
    # A section that consists of others has its demands there.
    demanding = [section for section in sections if not any(other.startswith(section + ".") for other in sections)]
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines() if line.startswith("| ")]
    rows = [row for row in rows if row[0] != "section" and not row[0].startswith("---")]
    errors = []
    for section, demand, *cells in rows:
        where = f"section {section}, {demand}"
        if section not in sections:
            errors.append(f"{where}: the specification has no such section")
        names = cells[0].split(", ") if cells else [""]
        errors += [f"{where}: {fault}" for name in names if (fault := evidence(name, read))]
    used = {row[0] for row in rows}
    errors += [f"docs/traceability.md has no row for section {section}" for section in demanding if section not in used]
    return len(rows), errors


LIBRARIES = ["tess-core", "tess-level", "tess-simd", "tess-gpu", "tess-wgpu", "tess-surface", "tess-mesh", "tess-verify", "tess-show", "tess-workloads"]
TYPES = ("struct", "enum", "union", "trait", "type")
ITEM = re.compile(r'\s*pub (?:(?:const|unsafe|async|extern|"C") )*(fn|const|static|' + "|".join(TYPES) + r") (\w+)")


def words(text):
    """The words of code, comments left out."""
    return re.findall(r"\w+", re.sub("//.*", "", text))


def signatures(text):
    """Types in signatures and fields: the text behind `->` or the `:` of a public line, or an error type."""
    for line in text.splitlines():
        found = line.lstrip().startswith("pub ") and re.search(r"[(:](.*)", line)
        if found := found or re.search("(?:-> |type Err)(.*)", line):
            yield found[1]


def public(libraries, files):
    """How many public items the libraries have, and those whose names stand nowhere else."""
    count, unused = 0, []
    for library in libraries:
        own = {path: text for path, text in files.items() if path.startswith(f"{library}/src/")}
        used = {word for path, text in files.items() if path not in own for word in words(text)}
        named = {word for text in own.values() for part in signatures(text) for word in words(part)}
        for path, text in own.items():
            if path.endswith("tests.rs"):
                continue
            code = text.split("\n#[cfg(test)]\nmod ")[0]
            for number, line in enumerate(code.splitlines(), 1):
                if not (item := ITEM.match(line)) or item[2] == "_":
                    continue
                count += 1
                if item[2] not in used and not (item[1] in TYPES and item[2] in named):
                    unused.append(f"{path}:{number}: {item[2]}")
    return count, unused


WIDTH = int(re.search(r"max_width = (\d+)", read("rustfmt.toml"))[1])


# Comments, and the literals of Rust that may contain a quote: strings, raw strings and characters.
LITERAL = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)|(?P<string>\b[bc]?r(?P<hashes>\#*)".*?"(?P=hashes)|"(?:\\.|[^"\\])*")"""
    r"""|'(?:\\(?:u\{[^}]*\}|.)|[^'\\\n])'""",
    re.DOTALL,
)


# Columns after a text for what closes its call: `")],`.
CLOSING = 4


def width(path, text):
    """The lines that are too long, except for text in quotes, and listings and tables in comments."""
    quoted = [found.span() for found in LITERAL.finditer(text) if found["string"]]
    is_listing, start, found = False, 0, []
    for number, line in enumerate(text.split("\n"), 1):
        at = start + WIDTH
        start += len(line) + 1
        comment = re.match(r"\s*//[/!]? ?(.*)", line)
        if not comment:
            is_listing = False
            is_free = any(first <= at < end + CLOSING for first, end in quoted)
        else:
            is_fence = comment[1].lstrip().startswith(("```", "~~~"))
            is_listing ^= is_fence
            is_table = comment[1].startswith(("|", "    ", ">>>", "["))
            is_free = is_listing or is_fence or is_table or " " not in comment[1].strip().lstrip("-*# ")
        if len(line) > WIDTH and not is_free:
            found.append(f"{path}:{number}: {len(line)} columns")
    return found


def rust_files():
    """The paths of all files of Rust that git knows."""
    known = subprocess.run(["git", "ls-files", "--", "*.rs"], cwd=ROOT, check=True, capture_output=True, text=True)
    return known.stdout.splitlines()


def main(words):
    if words == ["traceability"]:
        count, faults = traceability(read("docs/specification.md"), read("docs/traceability.md"), read)
        print(f"{count} demands of the specification, each with what sees a violation")
    elif words == ["public"]:
        count, faults = public(LIBRARIES, {path: read(path) for path in rust_files()})
        print(f"{count} public items of the published libraries, each with a user outside their own crate's src")
    elif words == ["width"]:
        files = [path for path in rust_files() if not (ROOT / path).is_symlink()]
        count, faults = len(files), [fault for path in files for fault in width(path, read(path))]
        print(f"{count} files of Rust, whose lines have at most {WIDTH} columns")
    else:
        sys.exit(__doc__)
    if faults:
        sys.exit("but not these:\n" + "\n".join(faults))


if __name__ == "__main__":
    main(sys.argv[1:])
