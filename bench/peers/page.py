"""What is said of the rows: tables."""

LEAST = 1e-9  # smaller errors count as equal
SLACK = 1.1  # less is noise


def number(value, form):
    return "" if value is None else format(value, form)


def seconds(value):
    return number(value, ".2f" if value is not None and value >= 1 else ".3f")


def per_vertex(row):
    return None if row.get("further") is None else 1e9 * row["further"] / row["vertices"]


def cells(row):
    notes = [row[key] for key in ("failure", "note") if row.get(key)]
    if row.get("wrong"):
        notes.append(f"**{row['wrong']} wrong**")
    if "failure" not in row and row.get("compared") == 0:
        notes.append("no exact answer")
    peak = None if row.get("peak") is None else row["peak"] / 1e6
    return [row["peer"], seconds(row.get("first")), number(per_vertex(row), ".0f"), number(peak, ".0f"),
            number(row.get("mean"), ".1e"), number(row.get("worst"), ".1e"), number(row.get("below"), ".1e"),
            "; ".join(notes)]


def table(rows, domains):
    out = []
    for domain in domains:
        some = [row for row in rows if row["mesh"] == domain["name"]]
        if not some:
            continue
        note = f"; {domain['note']}" if domain["note"] else ""
        out += [f"### {domain['name']}", "", f"{domain['kind']}, {domain['vertices']} vertices, {domain['cells']} "
                f"{'triangles' if domain['kind'] == 'surface' else 'tetrahedra'}{note}", "",
                "| program | first answer s | each further ns/V | peak MB | mean error | worst | most below | |",
                "| --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |"]
        out += ["| " + " | ".join(cells(row)) + " |" for row in some]
        out.append("")
    return "\n".join(out)


def median(values):
    values = sorted(values)
    middle = len(values) // 2
    return values[middle] if len(values) % 2 else (values[middle - 1] + values[middle]) / 2


def summary(rows):
    """A line a program: medians over the meshes, the worst vertex of all, failures."""
    out = ["| program | answered | wrong | first answer s | each further ns/V | peak bytes/V | mean error | worst of all |",
           "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"]
    for name in dict.fromkeys(row["peer"] for row in rows):
        some = [row for row in rows if row["peer"] == name]
        done = [row for row in some if "failure" not in row]

        def middle(value, form):
            found = [v for v in map(value, done) if v is not None]
            return format(median(found), form) if found else ""
        worst = [row["worst"] for row in done if "worst" in row]
        out.append(f"| {name} | {len(done)} of {len(some)} | {sum(row['wrong'] > 0 for row in done)} | "
                   + " | ".join([middle(lambda r: r["first"], ".3f"), middle(per_vertex, ".0f"),
                                 middle(lambda r: r["peak"] / r["vertices"], ".0f"),
                                 middle(lambda r: r.get("mean"), ".1e"), f"{max(worst):.1e}" if worst else ""]) + " |")
    return "\n".join(out) + "\n"


ASPECTS = {"first": "the first answer", "further": "a further source", "peak": "peak memory", "mean": "mean error",
           "worst": "worst error"}


def better(rows, ours):
    """Where a peer is better than one of our rows: by how much at most, and on how many of the meshes that both
    answered without a wrong value."""
    out = []
    names = [n for n in dict.fromkeys(row["peer"] for row in rows) if not n.startswith("plexway")]
    by = {(row["peer"], row["mesh"]): row for row in rows if "failure" not in row and not row.get("wrong")}
    for name in names:
        both = [(by[name, mesh], by[ours, mesh]) for peer, mesh in by if peer == name and (ours, mesh) in by]
        said = []
        for key, what in ASPECTS.items():
            some = [(theirs, mine) for theirs, mine in both if key in theirs and key in mine]
            ratios = [(max(mine[key], LEAST if key in ("mean", "worst") else 0)
                       / max(theirs[key], LEAST if key in ("mean", "worst") else 1e-12), mine["mesh"])
                      for theirs, mine in some]
            won = [found for found in ratios if found[0] > SLACK]
            if won:
                most, mesh = max(won)
                said.append(f"{what} on {len(won)} of {len(some)} (at most {most:.2g} x, {mesh})")
        if said:
            out.append(f"* **{name}**: " + "; ".join(said))
    return "\n".join(out) + "\n" if out else "None is.\n"


def replace_between(page, begin, end, what):
    """The text of a page with what stands between two lines replaced."""
    before, found, rest = page.partition(begin)
    _, closed, after = rest.partition(end)
    if not found or not closed:
        raise ValueError(f"the page lacks '{begin}' or '{end}'")
    return f"{before}{begin}\n\n{what.strip()}\n\n{end}{after}"
