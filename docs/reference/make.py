#!/usr/bin/env python3
"""Makes the reference pages from the program itself: options.md and the table of exit-codes.md from the manual page
that the tool writes, the table of python.md from the package's docstrings.

    docs/reference/make.py TOOL           writes them
    docs/reference/make.py TOOL --check   fails where a page differs, and says where
"""

import ast
import re
import subprocess
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
package = here.parent.parent / "python" / "plexway"


def manual(tool):
    """The manual page as sections of (name, text) entries, roff's marks taken off."""
    def plain(text):
        text = re.sub(r"\\f[A-Z]", "", text)
        return text.replace("\\-", "-").replace("\\&", "").replace("\\e", "\\")

    text = subprocess.run([tool, "--help-page", "man"], capture_output=True, text=True, check=True).stdout
    sections, lines = {}, text.splitlines()
    section = None
    for i, line in enumerate(lines):
        if line.startswith(".SH "):
            section = sections.setdefault(line[4:].strip('"').lower(), [])
        elif line == ".TP":
            section.append((plain(lines[i + 1]), plain(lines[i + 2])))
    return sections


def row(*cells):
    return "| " + " | ".join(c.replace("|", "\\|") for c in cells) + " |"


def and_of(names):
    return names[0] if len(names) == 1 else ", ".join(names[:-1]) + " and " + names[-1]


def options_page(sections):
    commands = [name for name, _ in sections["commands"]]
    of, order = {}, []
    for command in commands:
        for option in sections[command]:
            if option[0].startswith("--help"):
                continue
            if option not in of:
                of[option] = []
                order.append(option)
            of[option].append(command)
    out = ["# Options", "",
           "All options of the tool, made from its own parser by `docs/reference/make.py`; a test compares them.",
           "[The tool](cli.md) explains them, `plexway COMMAND --help` lists those of a command with examples.", ""]

    def table(found):
        out.extend(["| option | meaning |", "|---|---|"])
        for name, text in found:
            # What the parser checks besides is no name of a value.
            out.append(row(f"`{re.sub(r':(INT in .*|NONNEGATIVE)$', '', name)}`", text))
        out.append("")

    for command, text in sections["commands"]:
        own = [o for o in order if of[o] == [command]]
        out.extend([f"## {command}", "", text + ".", ""])
        if own:
            table(own)
    shared = {}
    for option in order:
        if len(of[option]) > 1:
            shared.setdefault(tuple(of[option]), []).append(option)
    out.extend(["## Options of several commands", ""])
    for names, found in shared.items():
        out.extend([f"### {and_of(list(names))}", ""])
        table(found)
    out.extend(["## Without a command", ""])
    table([o for o in sections["options"] if not o[0].startswith("--help,")])
    out.extend(["## Environment", ""])
    table(sections["environment"])
    return "\n".join(out).rstrip() + "\n"


def exit_codes(sections):
    return "\n".join(["| code | meaning |", "|---|---|"] + [row(*entry) for entry in sections["exit status"]])


def first_sentence(doc):
    text = " ".join(doc.split("\n\n")[0].split())
    return re.split(r"(?<=\.)\s", text.replace("``", "`"))[0].rstrip(".") + "."


def signature(function):
    a = function.args
    names = [arg.arg for arg in a.args if arg.arg != "self"] + (["*" + a.vararg.arg] if a.vararg else [])
    keywords = [arg.arg + "=" for arg in a.kwonlyargs]
    return ", ".join(names + keywords)


def python_table():
    public = re.findall(r'^    "(\w+)",$', (package / "__init__.py").read_text(), re.M)
    found = {}
    for file in sorted(package.glob("_*.py*")):
        for node in ast.parse(file.read_text()).body:
            if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and node.name in public and ast.get_docstring(node):
                found.setdefault(node.name, node)
    out = ["| name | what it is |", "|---|---|"]
    for name in public:
        if name.startswith("_"):
            continue
        if name not in found:
            sys.exit(f"python: {name} has no docstring")
        node = found[name]
        if isinstance(node, ast.FunctionDef):
            out.append(row(f"`{name}({signature(node)})`", first_sentence(ast.get_docstring(node))))
            continue
        start = next((m for m in node.body if isinstance(m, ast.FunctionDef) and m.name == "__init__"), None)
        fields = [m.target.id for m in node.body
                  if isinstance(m, ast.AnnAssign) and isinstance(m.target, ast.Name) and not m.target.id.startswith("_")]
        # Of a data class the fields are the arguments, where users make one.
        takes = signature(start) if start and name not in ("Domain", "Field", "Points") else ", ".join(fields)
        out.append(row(f"`{name}({takes})`" if takes else f"`{name}`", first_sentence(ast.get_docstring(node))))
        for member in node.body:
            if isinstance(member, ast.FunctionDef) and not member.name.startswith("_") and ast.get_docstring(member):
                asked = any(getattr(d, "id", "") == "property" for d in member.decorator_list)
                call = "" if asked else f"({signature(member)})"
                out.append(row(f"`{name}.{member.name}{call}`", first_sentence(ast.get_docstring(member))))
    return "\n".join(out)


def between_marks(page, name, text):
    begin, end = f"<!-- {name} -->\n", f"\n<!-- /{name} -->"
    before, rest = page.split(begin)
    return before + begin + text + end + rest.split(end)[1]


def main():
    tool, check = sys.argv[1], "--check" in sys.argv
    sections = manual(tool)
    pages = {"options.md": options_page(sections)}
    for name, mark, text in (("exit-codes.md", "exit codes", exit_codes(sections)),
                             ("python.md", "names", python_table())):
        pages[name] = between_marks((here / name).read_text(), mark, text)
    wrong = 0
    for name, text in pages.items():
        file = here / name
        there = file.read_text() if file.exists() else ""
        if there == text:
            continue
        if not check:
            file.write_text(text)
            print(f"docs/reference/{name}")
            continue
        wrong += 1
        lines = zip(there.splitlines() + [""], text.splitlines() + [""])
        first = next(((n, a, b) for n, (a, b) in enumerate(lines, 1) if a != b), (1, "", ""))
        print(f"docs/reference/{name}:{first[0]}: {first[1]!r:.160}\n  the program says {first[2]!r:.160}\n"
              f"  docs/reference/make.py TOOL makes it anew", file=sys.stderr)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
