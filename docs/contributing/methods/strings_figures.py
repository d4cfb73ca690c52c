#!/usr/bin/env python3
"""Draws the two figures of strings.md beside it: strings_bend.svg and strings_blocked.svg."""
from pathlib import Path

SIZE = (460, 240)
STYLE = """
  .solid { fill: #eef2f7 } .out { fill: #8a94a3 } .string { fill: none; stroke: #1f5fbf; stroke-width: 2.5 }
  .old { fill: none; stroke: #1f5fbf; stroke-width: 1.5; stroke-dasharray: 5 4 }
  .bad { fill: none; stroke: #c03030; stroke-width: 1.5; stroke-dasharray: 5 4 }
  .mesh { fill: none; stroke: #a9b4c4; stroke-width: 1 } .place { fill: #c03030 } .vertex { fill: #202020 }
  text { font: italic 16px serif; fill: #202020 } .note { font: 12px sans-serif }
"""


def line(kind, *points):
    return f'<polyline class="{kind}" points="{" ".join(f"{x},{y}" for x, y in points)}"/>'


def block(x, y, w, h):
    return f'<rect class="out" x="{x}" y="{y}" width="{w}" height="{h}"/>'


def dot(kind, x, y, name="", dx=8, dy=-6):
    return (f'<circle class="{kind}" cx="{x}" cy="{y}" r="4"/>'
            f'<text x="{x + dx}" y="{y + dy}">{name}</text>')


def note(x, y, text):
    return f'<text class="note" x="{x}" y="{y}">{text}</text>'


def page(*parts):
    width, height = SIZE
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
            f'width="{width}" height="{height}"><style>{STYLE}</style>'
            f'<rect class="solid" width="{width}" height="{height}"/>{"".join(parts)}</svg>\n')


# A solid seen along the edges of an obstacle: each corner is a place, seen end-on.
BEND = page(
    block(150, 90, 120, 110),
    line("mesh", (330, 150), (390, 120), (400, 190), (330, 150)),
    line("string", (60, 190), (150, 90), (270, 90), (330, 150)),
    line("old", (60, 190), (150, 90), (270, 90), (390, 120)),
    dot("vertex", 60, 190, "S", -18, 16), dot("place", 150, 90, "p"), dot("place", 270, 90, "q"),
    dot("vertex", 330, 150, "u", -14, 20), dot("vertex", 390, 120, "w"),
    dot("vertex", 400, 190),
    note(20, 26, "u has the chain S, p, q; it offers it to w along their edge."),
    note(20, 44, "Pulled taut to w, it bends at the same places."),
)
BLOCKED = page(
    block(120, 110, 90, 130), block(270, 0, 70, 130),
    line("mesh", (300, 200), (400, 60)),
    line("string", (50, 200), (120, 110), (210, 110), (300, 200)),
    line("bad", (210, 110), (400, 60)),
    line("old", (210, 110), (270, 130), (340, 130), (400, 60)),
    dot("vertex", 50, 200, "S", -18, 16), dot("place", 120, 110, "p"), dot("place", 210, 110, "q"),
    dot("vertex", 300, 200, "u", -4, 22), dot("vertex", 400, 60, "w"),
    dot("place", 270, 130, "r", -4, 22), dot("place", 340, 130, "t", 4, 20),
    note(14, 22, "To w the last leg runs through another"),
    note(14, 40, "obstacle. Turned from u to w about q it"),
    note(14, 58, "touches r first: r is put in, and then t."),
)

if __name__ == "__main__":
    here = Path(__file__).parent
    (here / "strings_bend.svg").write_text(BEND)
    (here / "strings_blocked.svg").write_text(BLOCKED)
