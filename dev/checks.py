"""Checks of texts: `checks.py traceability`, `checks.py public`.

traceability: docs/traceability.md says of each sentence of the specification what sees a violation. A mark,
`<!-- r:SECTION/NUMBER -->`, stands behind its sentence. `<!-- r:- -->` stands behind text that demands nothing.

public: an item of a published library that nobody outside uses is a promise that nobody tests. Words are compared, not
paths: an item counts as used where its name stands in the code of a test, an example, a bench, a tool, a binding or
another crate. A type may also come with its caller: it stands in a signature or a field. The lint `unreachable_pub` sees
to it that what is `pub` can be reached.
"""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def read(path):
    return (ROOT / path).read_text()


def blocks(page):
    """Paragraphs, items of lists, tables and listings: section, whether it consists of sentences, and text.

    A line that begins with a mark belongs to the table or the listing above it.
    """
    found, section, is_listing, goes_on = [], "0", False, False
    for words in map(str.strip, page.splitlines()):
        is_fence = words.startswith("```")
        if not is_listing and words.startswith("#"):
            section = re.match(r"#+ ?(\d[\d.]*)?", words)[1] or "0"
            section = section.rstrip(".")
        if not is_listing and (not words or words.startswith("#")):
            goes_on = False
            continue
        is_prose = not is_listing and not is_fence and not words.startswith(("|", "<"))
        # Behind the sign of a list no sentence ends.
        item = re.match(r"(?:\d+\.|-) (.*)", words) if is_prose else None
        if not goes_on or item or (found[-1][1] and not is_prose and not words.startswith("<")):
            found.append([section, is_prose, ""])
        goes_on, is_listing = True, is_listing ^ is_fence
        if found[-1][1] and words.startswith("<!--"):
            found[-1][2] += "\nThis mark begins a line, which then is no text:"
        found[-1][2] += "\n" + (item[1] if item else words)
    return found


def sentences(text):
    """Full stops that something follows which begins a sentence, and the last."""
    return len(re.findall(r"(?<!\.)\.(?=\s+[A-Z`*(])", text.strip().replace(".)", "."))) + 1


def marks_of(page, errors):
    """The marks, but for those of text that demands nothing."""
    marks = []
    for section, is_prose, text in blocks(page):
        *parts, rest = re.split(r"<!-- r:(.*?) -->", text)
        for before, mark in zip(parts[::2], parts[1::2]):
            if mark == "-":
                continue
            if is_prose and sentences(before) > 1:
                errors.append(f"r:{mark} stands behind more than one sentence:{before}")
            if not re.fullmatch(re.escape(section) + r"/\d+", mark):
                errors.append(f"r:{mark} stands in section {section}")
            if mark in marks:
                errors.append(f"r:{mark} stands in the specification twice")
            marks.append(mark)
        if rest.strip():
            errors.append(f"section {section}, no mark stands behind:{rest}")
    return marks


def evidence(quoted, read):
    """Why a row's name is none of a test, a recorded result, a rule or a proof."""
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
        is_there = found and "#[test]" in attributes and "#[ignore" not in attributes
    return None if is_there else f"there is no {quoted.strip('`')}"


def traceability(page, table, read):
    """The marks, and what is wrong: marks and names that are missing, doubled or unknown."""
    errors = []
    marks = marks_of(page, errors)
    rows = [[cell.strip() for cell in line.split("|")] for line in table.splitlines() if line.startswith("| ")]
    rows = [row for row in rows[1:] if not row[1].startswith("---")]
    for _, mark, *cells in rows:
        if mark not in marks:
            errors.append(f"the specification has no mark r:{mark}")
        names = cells[1].split(", ") if len(cells) > 1 else [""]
        errors += [f"r:{mark}: {fault}" for name in names if (fault := evidence(name, read))]
    counts = {mark: sum(row[1] == mark for row in rows) for mark in marks}
    errors += [f"docs/traceability.md has {count} rows for r:{mark}" for mark, count in counts.items() if count != 1]
    return len(counts), errors


LIBRARIES = ["tess-core", "tess-simd", "tess-gpu", "tess-wgpu", "tess-surface", "tess-verify"]
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


def main(words):
    if words == ["traceability"]:
        count, faults = traceability(read("docs/specification.md"), read("docs/traceability.md"), read)
        print(f"{count} sentences of the specification, each with what sees a violation")
    elif words == ["public"]:
        known = subprocess.run(["git", "ls-files", "--", "*.rs"], cwd=ROOT, check=True, capture_output=True, text=True)
        count, faults = public(LIBRARIES, {path: read(path) for path in known.stdout.splitlines()})
        print(f"{count} public items of the published libraries, each with a user outside their own crate's src")
    else:
        sys.exit(__doc__)
    if faults:
        sys.exit("but not these:\n" + "\n".join(faults))


if __name__ == "__main__":
    main(sys.argv[1:])
