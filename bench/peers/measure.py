"""Runs one program on one domain, within limits, and judges its answer."""
import json
import os
import signal
import subprocess
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
ENVIRONMENT = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "PYTHONDONTWRITEBYTECODE": "1"}


class Failure(Exception):
    """No answer, and why, in a line."""


class Runner:
    def __init__(self, folder, seconds, memory):
        self.folder, self.seconds, self.memory = folder, seconds, memory

    def path(self, name):
        return os.path.join(self.folder, name)

    def call(self, words):
        """What limited.py reports; throws Failure unless the program ended well."""
        report, errors = self.path("report.json"), self.path("errors.txt")
        subprocess.run([sys.executable, "-S", "-E", os.path.join(HERE, "limited.py"), str(self.seconds), str(self.memory),
                        report, errors, *words], check=True, cwd=self.folder, env={**os.environ, **ENVIRONMENT})
        with open(report, encoding="utf-8") as file:
            used = json.load(file)
        if used["late"] == "clock":
            raise Failure(f"no end after {10 * self.seconds:g} s")
        if used["late"]:
            raise Failure(f"stopped after {self.seconds:g} s of the processor")
        if used["status"]:
            with open(errors, encoding="utf-8", errors="replace") as file:
                said = [line.strip() for line in file if line.strip()]
            how = f"ended with {used['status']}"
            if used["status"] > 128:
                how = "crashed: " + signal.strsignal(used["status"] - 128)
            raise Failure(how + (f": {said[-1][:120]}" if said else ""))
        return used

    def answer(self, peer, domain, sources):
        """A row of distances for each source, and what it took."""
        listed, out = self.path("sources.txt"), self.path("answer.npy")
        with open(listed, "w", encoding="ascii") as file:
            file.writelines(f"{source}\n" for source in sources)
        for name in os.listdir(self.folder):
            if name.startswith("answer.npy"):
                os.remove(self.path(name))
        used = self.call(peer.words(domain.file(peer.reads[domain.kind], self.folder), listed, out))
        if not os.path.exists(out):
            raise Failure("wrote no answer")
        with open(out, "rb") as file:
            is_array = file.read(6) == b"\x93NUMPY"
        rows = np.load(out) if is_array else np.fromfile(out, "<f8")
        if rows.size != len(sources) * len(domain.points):
            raise Failure(f"wrote {rows.size} numbers, not {len(sources)} x {len(domain.points)}")
        return rows.reshape(len(sources), -1).astype(float), used


def errors(rows, sources, truths):
    """Relative errors, all sources pooled. `wrong` counts what has no error in per cent: NaN, a distance where no path
    leads, none where one does, a source that is not at 0."""
    signed, wrong, compared = [], 0, 0
    for row, source in zip(rows, sources):
        wrong += int(np.isnan(row).sum()) + int(not np.isnan(row[source]) and row[source] != 0)
        if source not in truths:
            continue
        compared += 1
        exact = truths[source]
        known = ~np.isnan(exact) & ~np.isnan(row)
        finite = np.isfinite(exact) & np.isfinite(row)
        wrong += int((known & (np.isfinite(exact) != np.isfinite(row))).sum())
        some = known & finite & (exact > 0)
        signed.append(row[some] / exact[some] - 1)
    found = {"wrong": wrong, "compared": compared}
    off = np.concatenate(signed) if signed else np.array([])
    if len(off):
        found.update(mean=float(np.abs(off).mean()), worst=float(np.abs(off).max()), below=float(min(0, off.min())))
    return found


def measure(runner, peers, domain, count, turns, say):
    """A row for each peer. They take turns, so that a busy machine is busy for all, and the least of each counts."""
    rows, first, more, known = {}, {}, {}, {}
    for turn in range(turns):
        for peer in peers:
            row = rows.setdefault(peer.name, {"mesh": domain.name, "kind": domain.kind, "vertices": len(domain.points),
                                              "peer": peer.name})
            if "failure" in row or (turn > 0 and first[peer.name]["processor"] > runner.seconds / 12):
                continue
            say(f"{domain.name}: {peer.name}" + (f", turn {turn + 1}" if turn else ""))
            try:
                sources = domain.sources(count)
                one, used = runner.answer(peer, domain, sources[:1])
                known.setdefault(peer.name, (one, sources[:1]))
                least(first, peer.name, used)
                fits = int(runner.seconds / max(used["processor"], 1e-9) * 0.8)
                sources = sources[:min(count, fits)]
                if len(sources) > 1:
                    found, used = runner.answer(peer, domain, sources)
                    known[peer.name] = found, sources
                    least(more, peer.name, used)
            except Failure as failure:
                row["failure" if peer.name not in known else "note"] = str(failure)
    for name, row in rows.items():
        if name not in known:
            continue
        found, sources = known[name]
        row["first"], row["first_wall"] = first[name]["processor"], first[name]["wall"]
        row["peak"] = max(first[name]["peak"], more.get(name, first[name])["peak"])
        if name in more and len(sources) > 1:
            further = (more[name]["processor"] - first[name]["processor"]) / (len(sources) - 1)
            if further > 0:
                row["further"] = further
        row.update(errors(found, sources, domain.truths))
    return list(rows.values())


def least(kept, name, used):
    """The least of each figure over the turns; peaks are the largest."""
    before = kept.get(name, used)
    kept[name] = {**used, "wall": min(used["wall"], before["wall"]),
                  "processor": min(used["processor"], before["processor"]), "peak": max(used["peak"], before["peak"])}
