#!/usr/bin/env python3
"""Runs a tutorial as its reader would: its files are written, its commands run, what they print is compared.

    run.py PAGE --tool PLEXWAY [--python INTERPRETER --package FOLDER] [--prefix INSTALLED] [--pictures FOLDER]

In a page a block of `sh` is run; any other whose first line is a comment with the name of a file is that file; a block
of `text` behind a block of `sh` is what it prints. A block behind `<!-- not run -->` is left alone. A line or the rest
of one that is `...` stands for anything; numbers may differ by 1 %. Commands find the project's `data` beside them.
With --pictures, pictures that the page shows are copied there.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w])")


def blocks(text):
    """(language, body, line) of each fenced block that counts."""
    found, language, body, skip = [], None, [], False
    for number, line in enumerate(text.splitlines(), 1):
        if language is None and line.startswith("```"):
            language, body, start = line[3:].strip(), [], number
        elif language is not None and line.startswith("```"):
            if not skip:
                found.append((language, "\n".join(body) + "\n", start))
            language, skip = None, False
        elif language is not None:
            body.append(line)
        elif line.strip() == "<!-- not run -->":
            skip = True
    return found


def same(wanted, line):
    """Is a line as wanted, numbers to 1 %?"""
    if wanted.endswith("..."):
        wanted = wanted[:-3].rstrip()
        parts = len(NUMBER.findall(wanted))
        ends = [m.end() for m in NUMBER.finditer(line)]
        if NUMBER.sub("#", line).find(NUMBER.sub("#", wanted)) != 0:
            return False
        line = line[:ends[parts - 1]] if parts else line[:len(wanted)]
        wanted = wanted[:[m.end() for m in NUMBER.finditer(wanted)][-1]] if parts else wanted
    if NUMBER.sub("#", wanted) != NUMBER.sub("#", line):
        return False
    pairs = zip(NUMBER.findall(wanted), NUMBER.findall(line))
    return all(abs(float(a) - float(b)) <= 0.01 * max(abs(float(a)), abs(float(b))) for a, b in pairs)


def fits(wanted, printed):
    """Do the lines match, where `...` stands for any number of them?"""
    if not wanted:
        return not printed
    if wanted[0].strip() == "...":
        return any(fits(wanted[1:], printed[k:]) for k in range(len(printed) + 1))
    return bool(printed) and same(wanted[0], printed[0]) and fits(wanted[1:], printed[1:])


def environment(given, folder):
    """PATH has the tool and the interpreter by the names that readers type."""
    names = folder / "names"
    names.mkdir()
    (names / "plexway").symlink_to(given.tool)
    env = dict(os.environ, PATH=f"{names}:{os.environ['PATH']}")
    if given.python:
        (names / "python3").write_text(f'#!/bin/sh\nexec "{given.python}" "$@"\n')
        (names / "python3").chmod(0o755)
        env["PYTHONPATH"] = str(given.package)
    if given.prefix:
        env["PLEXWAY"] = str(given.prefix)
    return env


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", type=Path)
    parser.add_argument("--tool", type=Path, required=True)
    parser.add_argument("--python")
    parser.add_argument("--package")
    parser.add_argument("--prefix")
    parser.add_argument("--pictures", type=Path)
    given = parser.parse_args()
    data = Path(__file__).resolve().parents[2] / "data"
    text = given.page.read_text()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        env = environment(given, folder)
        work = folder / "work"
        work.mkdir()
        (work / "data").symlink_to(data)
        printed, commands = None, 0
        for language, body, line in blocks(text):
            where = f"{given.page.name}:{line}"
            file = re.match(r"(?:#|//) ([\w-]+\.\w+)\n", body)
            if language == "sh":
                ran = subprocess.run(["sh", "-e", "-c", body], cwd=work, env=env, capture_output=True, text=True,
                                     timeout=500, stdin=subprocess.DEVNULL)
                if ran.returncode:
                    sys.exit(f"{where}: exit code {ran.returncode}\n{body}{ran.stdout}{ran.stderr}")
                printed, commands = ran.stdout, commands + 1
            elif language == "text":
                if printed is None:
                    sys.exit(f"{where}: nothing was run that prints this")
                if not fits(body.splitlines(), printed.splitlines()):
                    sys.exit(f"{where}: the page has\n{body}but this was printed\n{printed}")
                printed = None
            elif file:
                (work / file[1]).write_text(body)
            else:
                sys.exit(f"{where}: a block that is neither a command, nor a file, nor what is printed")
        if not commands:
            sys.exit(f"{given.page}: no commands")
        for picture in re.findall(r"!\[[^]]*\]\(([\w-]+\.png)\)", text):
            if not (work / picture).stat().st_size:
                sys.exit(f"{given.page}: {picture} is empty")
            if given.pictures:
                shutil.copy(work / picture, given.pictures / picture)
    print(f"{given.page.name}: {commands} commands")


if __name__ == "__main__":
    main()
