"""Checks that the modules of each Rust crate import each other in one direction.

A module and its own parts may import each other. Of two modules with the same parent, together with all of their parts, only
one may import the other, directly or by way of a third: whoever reads a module then knows what it stands on.
"""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# What is no code: comments and strings.
IGNORED = re.compile(r'//[^\n]*|"(?:\\.|[^"\\])*"')
# The beginning and end of a module inside a file, a `use`, and another path of this crate.
PART = re.compile(
    r"^(?:pub(?:\([^)]*\))? )?mod (?P<begin>\w+) \{|^(?P<end>\})|\buse (?P<use>[^;]+);"
    r"|(?<![\w:$])(?P<path>(?:crate|super|self)(?:::\w+)+)",
    re.MULTILINE,
)


def module_of(path):
    """The folder of a file's crate, and the module that the file is; None for tests and what has no `src`."""
    folder, found, rest = path.partition("src/")
    names = rest.removesuffix(".rs").split("/")
    if not found or "tests" in names:
        return None
    if names[-1] in ("mod", "lib", "main"):
        names.pop()
    return folder, tuple(names)


def paths_of(tree):
    """The paths of a `use`, as `a::{b, c::d}` has `a::b` and `a::c::d`."""
    head, found, rest = tree.partition("{")
    if not found:
        return [tree.split(" as ")[0].strip()]
    depth, parts = 0, [""]
    for character in rest.rstrip()[:-1]:
        depth += (character == "{") - (character == "}")
        if character == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return [head.strip() + path for part in parts if part.strip() for path in paths_of(part.strip())]


def imports(module, text):
    """Paths that a module's code names, as lists of names from the crate's root."""
    text = IGNORED.sub("", text.split("\n#[cfg(test)]\nmod ")[0])
    inside = ()
    for part in PART.finditer(text):
        if part["begin"]:
            inside = (part["begin"],)
        elif part["end"]:
            inside = ()
        for path in paths_of(part["use"]) if part["use"] else [part["path"]] if part["path"] else []:
            names, here = path.split("::"), [*module, *inside]
            if names[0] == "crate":
                here = []
            while names and names[0] in ("crate", "self", "super"):
                here = here[:-1] if names.pop(0) == "super" else here
            yield here + names


def arrows(modules):
    """The imports between modules that have the same parent: `{parent: {(from, to): file}}`. `modules` has their texts."""
    found = {}
    for (module, file), text in modules.items():
        for names in imports(module, text):
            known = {other for other, _ in modules}
            to = next((tuple(names[:end]) for end in range(len(names), -1, -1) if tuple(names[:end]) in known), ())
            same = next((at for at, (one, other) in enumerate(zip(module, to)) if one != other), None)
            if same is not None:
                found.setdefault(module[:same], {}).setdefault((module[same], to[same]), file)
    return found


def circle(arrows):
    """The names of one circle of arrows, each importing the next; None if there is none."""
    state = {}

    def follow(name, way):
        state[name] = "open"
        for one, other in arrows:
            if one != name:
                continue
            if state.get(other) == "open":
                return [*way, name][[*way, name].index(other) :]
            found = other not in state and follow(other, [*way, name])
            if found:
                return found
        state[name] = "done"
        return None

    return next((found for name, _ in arrows if name not in state and (found := follow(name, []))), None)


def check(files):
    """The number of crates, and a line for each circle; `files` has the texts by path."""
    crates = {}
    for path, text in files.items():
        if found := module_of(path):
            folder, module = found
            crates.setdefault(folder, {})[module, path] = text
    faults = []
    for modules in crates.values():
        for all_of_parent in arrows(modules).values():
            while found := circle(all_of_parent):
                pairs = list(zip(found, [*found[1:], found[0]]))
                faults.append("; ".join(f"{all_of_parent[pair]} imports {pair[1]}" for pair in pairs))
                del all_of_parent[pairs[0]]
    return len(crates), faults


def main():
    known = subprocess.run(["git", "ls-files", "--", "*.rs"], cwd=ROOT, check=True, capture_output=True, text=True)
    paths = [path for path in known.stdout.splitlines() if not (ROOT / path).is_symlink()]
    count, faults = check({path: (ROOT / path).read_text() for path in paths})
    print(f"{count} crates of Rust, whose modules import each other in one direction")
    if faults:
        sys.exit("but not these:\n" + "\n".join(faults))


if __name__ == "__main__":
    main()
