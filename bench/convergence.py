#!/usr/bin/env python3
"""Draws bench_convergence's JSON as an SVG: error against mean edge, both axes logarithmic.

  convergence.py TABLE.json PLOT.svg
"""
import json
import math
import sys

WIDTH, HEIGHT, LEFT, TOP, GAP, PANEL_W, PANEL_H = 960, 440, 70, 46, 90, 380, 320
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56789a", "#a6761d"]
LEAST = 1e-9  # smaller errors are drawn as this: what is exact is rounding
MARKS = ["circle", "square", "diamond", "triangle"]


def decades(values):
    return math.floor(math.log10(min(values)) + 1e-9), math.ceil(math.log10(max(values)) - 1e-9)


def text(x, y, words, anchor="middle", size=12, extra=""):
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}"{extra}>'
            f"{words}</text>")


def mark(kind, x, y, colour):
    r = 4
    if kind == "circle":
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r}" fill="{colour}"/>'
    corners = {
        "square": [(-r, -r), (r, -r), (r, r), (-r, r)],
        "diamond": [(0, -r - 1), (r + 1, 0), (0, r + 1), (-r - 1, 0)],
        "triangle": [(0, -r - 1), (r + 1, r), (-r - 1, r)],
    }[kind]
    points = " ".join(f"{x + a:.1f},{y + b:.1f}" for a, b in corners)
    return f'<polygon points="{points}" fill="{colour}"/>'


def power(exponent):
    return f'10<tspan dy="-5" font-size="9">{exponent}</tspan>'


class Panel:
    def __init__(self, left, title, rows, first_colour):
        self.left, self.title, self.first = left, title, first_colour
        self.series = {}
        for row in rows:
            self.series.setdefault(row["series"], []).append((row["edge"], max(row["mean"], LEAST)))
        points = [p for s in self.series.values() for p in s]
        edges = [math.log10(x) for x, _ in points]
        self.x = min(edges) - 0.12, max(edges) + 0.12
        self.y = decades([e for _, e in points])
        if self.y[0] == self.y[1]:
            self.y = self.y[0], self.y[1] + 1

    def at(self, edge, error):
        fx = (math.log10(edge) - self.x[0]) / (self.x[1] - self.x[0])
        fy = (math.log10(error) - self.y[0]) / (self.y[1] - self.y[0])
        return self.left + fx * PANEL_W, TOP + (1 - fy) * PANEL_H

    @staticmethod
    def label(exponent):
        return ("&#8804; " if 10.0**exponent <= LEAST else "") + power(exponent)

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
        out.append(text(self.left + PANEL_W / 2, TOP - 16, self.title, size=14))
        out.append(f'<rect x="{self.left}" y="{TOP}" width="{PANEL_W}" height="{PANEL_H}" '
                   'fill="none" stroke="#333"/>')
        for exponent in range(self.y[0], self.y[1] + 1):
            _, y = self.at(1, 10**exponent)
            out.append(f'<line x1="{self.left}" y1="{y:.1f}" x2="{self.left + PANEL_W}" '
                       f'y2="{y:.1f}" stroke="#ddd"/>')
            out.append(text(self.left - 8, y + 4, self.label(exponent), "end"))
        for exponent in range(math.floor(self.x[0]), math.ceil(self.x[1]) + 1):
            for digit in (1, 2, 5):
                edge = digit * 10.0**exponent
                if not self.x[0] <= math.log10(edge) <= self.x[1]:
                    continue
                x, _ = self.at(edge, 10.0 ** self.y[0])
                out.append(f'<line x1="{x:.1f}" y1="{TOP}" x2="{x:.1f}" y2="{TOP + PANEL_H}" '
                           'stroke="#eee"/>')
                out.append(text(x, TOP + PANEL_H + 18, f"{edge:g}"))
        out.append(text(self.left + PANEL_W / 2, TOP + PANEL_H + 40, "mean edge"))
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
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
           f'width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" fill="#222">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>']
    left, colour = LEFT, 0
    for title, part in (("surfaces", surfaces), ("solids around obstacles", solids)):
        if part:
            panel = Panel(left, title, part, colour)
            panel.draw(out)
            colour += len(panel.series)
        left += PANEL_W + GAP
    out.append(text(16, TOP + PANEL_H / 2, "mean relative error", "middle", 12,
                    f' transform="rotate(-90 16 {TOP + PANEL_H / 2:.0f})"'))
    out.append("</svg>")
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write("\n".join(out) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__.strip())
    main()
