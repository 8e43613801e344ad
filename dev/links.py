"""Checks of links in Markdown: `links.py`.

Readers meet a README on the repository's page, on a registry's page and in an archive; rustdoc alone resolves [`Item`].
So, outside of code:
- a link in brackets without an address has a line `[text]: address` in its file;
- a relative link leads to a file of the tree, and its `#part` to a heading;
- a README that a registry shows has no relative links, as there is no tree around it;
- a link to an item on docs.rs names an item that the crate has.
"""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# What a registry shows beside the published crates.
SHOWN = ["bindings/python/README.md", "bindings/webgpu/README.md"]


def prose(text):
    """The text without blocks of code and comments; code in a line becomes a word, unless brackets are around it."""
    text = re.sub(r"^( *)```.*?^\1```$|<!--.*?-->", "", text, flags=re.M | re.S)
    keep = lambda found: found[0] if found[1] and found[2] else f"{found[1]}code{found[2]}"
    return re.sub(r"(\[?)`[^`\n]*`(\]?)", keep, text)


def headings(text):
    """The names that pages give to headings."""
    lines = re.findall(r"^#+ +(.*?)$", re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S), re.M)
    plain = (re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", line) for line in lines)
    return {re.sub(r"[^\w\- ]", "", line.lower()).replace(" ", "-") for line in plain}


def without_address(text):
    """Texts in brackets that are no links because their addresses are missing."""
    addresses = set(re.findall(r"^\[([^\]]+)\]: \S", text, re.M))
    body = re.sub(r"^\[[^\]]+\]: .*$", "", text, flags=re.M)
    body = re.sub(r"\[[^\[\]]*\]\([^)]*\)", "", body)
    used = re.findall(r"\[(`[^`\n]+`)\](?!\()", body)
    return [text for text in used if text not in addresses]


def addresses(text):
    """The addresses of links."""
    return re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r"^\[[^\]]+\]: (\S+)", text, re.M)


ITEM = re.compile(r"https://docs\.rs/([\w-]+)/latest/\w+/(?:\w+/)*?(?:(\w+)/index|(\w+)\.(\w+))\.html(?:#\w+\.(\w+))?")


def item_fault(address, source):
    """Why an address on docs.rs leads to no item of a crate; `source` is the crate's, or None."""
    found = ITEM.fullmatch(address)
    text = found and source(found[1])
    if not text:
        return None
    _, module, kind, item, member = found.groups()
    kind, item = ("mod", module) if module else (kind.replace("constant", "const"), item)
    if not re.search(rf"\bpub (?:const )?{kind} {item}\b", text):
        return f"{found[1]} has no {kind} {item}"
    if member and not re.search(rf"\b{member}\b", text):
        return f"{item} has no {member}"
    return None


def faults(path, text, is_shown, read, source):
    """What is wrong with a page's links."""
    page = prose(text)
    found = [f"[{words}] has no address" for words in without_address(page)]
    for address in addresses(page):
        file, _, part = address.partition("#")
        if "://" in address:
            found += [fault] if (fault := item_fault(address, source)) else []
            continue
        if is_shown and file:
            found.append(f"{address} is relative, and a registry has no tree around it")
        try:
            target = read(str(Path(path).parent / file)) if file else text
        except OSError:
            found.append(f"{address} leads to no file")
            continue
        if part and target is not None and part not in headings(target):
            found.append(f"{address} leads to no heading")
    return [f"{path}: {fault}" for fault in found]


def tracked(pattern):
    """The files of the tree."""
    names = subprocess.run(["git", "ls-files", pattern], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    return names.splitlines()


def main():
    def read(path):
        """The text of a page; None for other files and folders."""
        path = (ROOT / path).resolve(strict=True)
        return path.read_text() if path.suffix == ".md" else None

    def source(crate):
        folder = {"tess-probe": "tools/probe", "bevy_tess": "integrations/bevy"}.get(crate, crate)
        return "\n".join(Path(ROOT / name).read_text() for name in tracked(f"{folder}/src/*.rs"))

    manifests = {Path(name).parent / "README.md": (ROOT / name).read_text() for name in tracked("*Cargo.toml")}
    shown = {str(readme) for readme, text in manifests.items() if "\nreadme = " in text}.union(SHOWN)
    # Links of the readmes of archives lead to files of the archives; packing looks for them.
    pages = [page for page in tracked("*.md") if "/dist/readmes/" not in page]
    found = [fault for page in pages for fault in faults(page, (ROOT / page).read_text(), page in shown, read, source)]
    print("\n".join(found) or f"{len(pages)} pages: every link leads somewhere")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
