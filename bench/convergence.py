#!/usr/bin/env python3
"""Draws bench convergence's JSON as an SVG: error against mean edge, both axes logarithmic.

  convergence.py TABLE.json PLOT.svg
"""
import json
import math
import sys

from log_plot import COLOURS, LogPanel, MARKS, decades, mark, picture, text

WIDTH, HEIGHT, LEFT, TOP, GAP, PANEL_W, PANEL_H = 960, 440, 70, 46, 90, 380, 320
LEAST = 1e-9  # smaller errors are drawn as this: what is exact is rounding


class Panel(LogPanel):
    def __init__(self, left, title, rows, first_colour):
        self.title, self.first = title, first_colour
        self.series = {}
        for row in rows:
            self.series.setdefault(row["series"], []).append((row["edge"], max(row["mean"], LEAST)))
        points = [p for s in self.series.values() for p in s]
        edges = [math.log10(x) for x, _ in points]
        super().__init__(left, TOP, PANEL_W, PANEL_H, (min(edges) - 0.12, max(edges) + 0.12),
                         decades([e for _, e in points]), LEAST)

    def guide(self, order, out):
        """A dashed line of this slope through the panel's upper right part."""
        x1, y1 = self.x[1] - 0.05, self.y[1] - 0.15
        x0 = max(self.x[0] + 0.05, x1 - (y1 - self.y[0] - 0.1) / order)
        y0 = y1 - order * (x1 - x0)
        (a, b), (c, d) = self.at(10**x0, 10**y0), self.at(10**x1, 10**y1)
        out.append(f'<line x1="{a:.1f}" y1="{b:.1f}" x2="{c:.1f}" y2="{d:.1f}" stroke="#999" '
                   'stroke-dasharray="5 4"/>')
        out.append(text(a + 6, b - 6, f"order {order}", "start", 11, ' fill="#666"'))

    def draw(self, out):
        self.frame(self.title, "mean edge", (1, 2, 5), out)
        for order in (1, 2):
            self.guide(order, out)
        for i, (name, points) in enumerate(self.series.items()):
            colour = COLOURS[(self.first + i) % len(COLOURS)]
            at = [self.at(*p) for p in points]
            line = " ".join(f"{x:.1f},{y:.1f}" for x, y in at)
            out.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2"/>')
            kind = MARKS[i % len(MARKS)]
            out.extend(mark(kind, x, y, colour) for x, y in at)
            key_x, key_y = self.left + PANEL_W - 92, TOP + PANEL_H - 14 - 18 * (len(self.series) - 1 - i)
            out.append(f'<line x1="{key_x}" y1="{key_y}" x2="{key_x + 24}" y2="{key_y}" '
                       f'stroke="{colour}" stroke-width="2"/>')
            out.append(mark(kind, key_x + 12, key_y, colour))
            out.append(text(key_x + 30, key_y + 4, name, "start"))


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        rows = json.load(file)
    surfaces = [row for row in rows if row["kind"] != "solid"]
    solids = [row for row in rows if row["kind"] == "solid"]
    out = []
    left, colour = LEFT, 0
    for title, part in (("surfaces", surfaces), ("solids around obstacles", solids)):
        if part:
            panel = Panel(left, title, part, colour)
            panel.draw(out)
            colour += len(panel.series)
        left += PANEL_W + GAP
    out.append(text(16, TOP + PANEL_H / 2, "mean relative error", "middle", 12,
                    f' transform="rotate(-90 16 {TOP + PANEL_H / 2:.0f})"'))
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(picture(WIDTH, HEIGHT, out))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__.strip())
    main()
