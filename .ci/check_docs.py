#!/usr/bin/env python3
"""Checks what users read: links between pages and to their headings; commands of the tool in snippets, whose options
must exist; pages that no other page leads to; and lists words that only this house knows, by file.

    .ci/check_docs.py [TOOL]

TOOL is the tool whose options count; where it is not there, commands are not checked, and that is said.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent
HOUSE = re.compile(r"\b(told|remarks?|lengths alone|crews?|mended|mends|lots|rim detours?|what may surprise|is asked for|"
                   r"was asked|were asked|no path leads|goes? together)\b", re.I)
faults = []


def pages():
    names = ["README.md", "CONTRIBUTING.md", "SECURITY.md", "data/README.md", "complexes/README.md"]
    return [root / n for n in names if (root / n).exists()] + sorted((root / "docs").rglob("*.md"))


def without_code(text):
    """Fenced and indented code blanked, lines kept."""
    out, fenced = [], False
    for line in text.splitlines():
        if line.lstrip().startswith("```"):
            fenced = not fenced
            out.append("")
        else:
            out.append("" if fenced or line.startswith("    ") else line)
    return "\n".join(out)


def headings(text):
    """The anchors of a page, as GitHub and mkdocs both make them for plain words."""
    found = set()
    for line in without_code(text).splitlines():
        match = re.match(r"#+ (.*)", line)
        if match:
            plain = re.sub(r"[`*_]|\[([^]]*)\]\([^)]*\)", r"\1", match[1]).lower()
            found.add(re.sub(r"[\s]+", "-", re.sub(r"[^\w\s-]", "", plain).strip()))
    return found


def check_links(page, text):
    leads = set()
    plain = re.sub(r"`[^`]*`", "", without_code(text))
    targets = re.findall(r"\]\(([^)\s]+)\)", plain) + re.findall(r'(?:src|href)="([^"]+)"', plain)
    for target in targets:
        if re.match(r"[a-z]+:|//", target):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        name = page.relative_to(root)
        if not file.exists():
            faults.append(f"{name}: no {target}")
        elif page.is_relative_to(root / "docs") and not file.is_relative_to(root / "docs"):
            faults.append(f"{name}: {target} is outside of the site: name the file instead")
        else:
            leads.add(file)
            if anchor and file.suffix == ".md" and anchor not in headings(file.read_text()):
                faults.append(f"{name}: {target} has no such heading")
    return leads


def options_of(tool):
    """Options by command, as the tool's own completions have them."""
    script = subprocess.run([tool, "--help-page", "bash"], capture_output=True, text=True, check=True).stdout
    return {m[1]: set(m[2].split()) for m in re.finditer(r"^ +(\S+)\) words=\"(.*)\" ;;", script, re.M)}


def check_files(page, text):
    """Files of the sources that are named in text, as `src/...`: they move, and pages stay behind."""
    for name in re.findall(r"`((?:src|include|complexes|tests|bench|cmake|shaders)/[\w./-]*)`", text):
        if not (root / name).exists():
            faults.append(f"{page.relative_to(root)}: there is no {name}")


def check_commands(page, text, options):
    code = "\n".join(re.findall(r"```sh\n(.*?)```", text, re.S)) + "\n"
    code += "\n".join(line[4:] for line in text.splitlines() if line.startswith("    "))
    code = code.replace("\\\n", " ")
    for line in code.splitlines():
        for part in re.split(r"\||;|&&", re.sub(r"\s#.*", "", line)):
            words = part.split()
            while words and (words[0] in ("$", "time", "do") or words[0].startswith("mpirun") or
                             (words[0].startswith("-") and not words[0].startswith("--")) or words[0].isdigit()):
                words.pop(0)
            if len(words) < 2 or words[0].split("/")[-1] not in ("plexway", "plexway-mpi") or words[1].startswith("-"):
                continue
            command = words[1]
            if not re.fullmatch(r"[a-z]+", command):
                continue
            if command not in options:
                faults.append(f"{page.relative_to(root)}: plexway has no command {command}: {line.strip()}")
                continue
            for word in words[2:]:
                option = re.match(r"\[?(--[a-z-]+|-[a-z])\b", word)
                if option and option[1] not in options[command]:
                    faults.append(f"{page.relative_to(root)}: plexway {command} has no {option[1]}: {line.strip()}")


def check_width(page, text):
    for number, line in enumerate(without_code(text).splitlines(), 1):
        if len(line) > 100 and not re.match(r"\s*(\||#|<|!|>>>)", line):
            faults.append(f"{page.relative_to(root)}:{number}: more than 100 columns")


def check_figures():
    """Rows of the comparison in README.md and docs/ have the figures of the page that measured them."""
    log = (root / "docs/log/peers.md").read_text()
    table = log[log.index("## All surfaces"):]
    names = {"Boost Dijkstra": "Boost Dijkstra", "SciPy Dijkstra": "scipy Dijkstra", "Connectome Workbench": "Workbench",
             "CGAL, heat method": "CGAL heat", "CGAL, exact paths": "CGAL exact", "plexway `fast`": "plexway, fast",
             "plexway, `fast`": "plexway, fast", "plexway, the default": "plexway", "plexway `exact`": "plexway, exact",
             "plexway, `exact`": "plexway, exact"}
    for page in ("README.md", "docs/explanation/comparison.md"):
        rows = 0
        for line in (root / page).read_text().splitlines():
            cells = [c.strip().replace("**", "") for c in line.strip("|").split("|")]
            name = next((n for n in names if cells[0].startswith(n)), None) if line.startswith("| ") else None
            if name is None or len(cells) < 6:
                continue
            rows += 1
            measured = re.search(rf"^\| {re.escape(names[name])} \| (.*)\|$", table, re.M)[1]
            there = [c.strip() for c in measured.split("|")]
            for cell in cells[1:]:
                if re.sub(r" \(.*", "", cell) not in there:
                    faults.append(f"{page}: {name}: {cell} is not in docs/log/peers.md")
        if rows < 6:
            faults.append(f"{page}: the comparison has {rows} rows")


def house_words():
    files = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True).stdout.split()
    total = 0
    for name in files:
        prose = re.match(r"(README\.md|docs/(?!log/).*\.md)$", name)
        if not prose and not re.match(r"web/page/.*\.(html|js)$|python/plexway/.*\.pyi?$|"
                                      r"(src|include|complexes)/.*\.(cpp|hpp)$", name):
            continue
        count = 0
        for line in (root / name).read_text(errors="replace").splitlines():
            if line.startswith("#include"):
                continue
            if prose:
                line = re.sub(r"`[^`]*`", "", line)
            elif not name.endswith((".py", ".pyi", ".html")):
                line = " ".join(re.findall(r'"((?:[^"\\]|\\.)*)"', line))
            count += len(HOUSE.findall(line))
        if count:
            print(f"{count:4} {name}")
        total += count
    print(f"docs: {total} house words in what users read")


def main():
    tool = sys.argv[1] if len(sys.argv) > 1 else ""
    options = options_of(tool) if os.access(tool, os.X_OK) else None
    if options is None:
        print("docs: commands in snippets are not checked: the tool is not built")
    led = {root / "README.md", root / "docs" / "index.md"}
    for page in pages():
        text = page.read_text()
        led |= check_links(page, text)
        if page.name != "support.md":  # made by a program
            check_width(page, text)
        if "docs/log" not in str(page):
            check_files(page, text)
            if options:
                check_commands(page, text, options)
    check_figures()
    nav = (root / ".ci" / "mkdocs.yml").read_text()
    for page in (root / "docs").rglob("*.md"):
        if str(page.relative_to(root / "docs")) not in nav:
            faults.append(f"{page.relative_to(root)}: not in .ci/mkdocs.yml")
        if page not in led:
            print(f"docs: no page leads to {page.relative_to(root)}")
    house_words()
    for fault in faults:
        print(f"docs: {fault}", file=sys.stderr)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
