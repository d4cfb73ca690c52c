#!/usr/bin/env python3
"""Draws the figures of docs/explanation/how-it-works.md as .svg files beside this script.

    docs/figures/make.py

It needs NumPy alone. What a figure shows is computed: triangles are unfolded from their edge lengths, strings are
pulled taut, distances are those of the plane.
"""

from pathlib import Path

import numpy as np

INK, GREY, PALE, RED, BLUE, GREEN, AMBER = "#1c2733", "#8a94a0", "#eef1f4", "#c0392b", "#2468a8", "#2e8b57", "#d98e04"


class Figure:
    """A drawing whose y axis points up; `place` moves and scales what follows."""

    def __init__(self, width, height):
        self.size, self.parts = (width, height), []
        self.place(0, 0, 1)

    def place(self, x, y, scale):
        """Coordinates (0, 0) lie at (x, y) from the lower left, and 1 is `scale` pixels."""
        self.origin, self.scale = np.array([x, y], float), scale

    def at(self, p):
        x, y = self.origin + self.scale * np.asarray(p, float)[:2]
        return x, self.size[1] - y

    def line(self, points, colour=INK, width=1.5, dash=None, arrow=False):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(self.at, points))
        extra = f' stroke-dasharray="{dash}"' if dash else ""
        extra += f' marker-end="url(#tip)"' if arrow else ""
        self.parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{width}" '
                          f'stroke-linejoin="round" stroke-linecap="round"{extra}/>')

    def area(self, points, colour=PALE, edge=INK, width=1.2, opacity=1.0):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(self.at, points))
        self.parts.append(f'<polygon points="{path}" fill="{colour}" fill-opacity="{opacity}" stroke="{edge}" '
                          f'stroke-width="{width}" stroke-linejoin="round"/>')

    def dot(self, p, colour=INK, radius=4, hollow=False):
        x, y = self.at(p)
        fill = "#ffffff" if hollow else colour
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{fill}" stroke="{colour}" '
                          'stroke-width="1.5"/>')

    def arc(self, centre, radius, low, high, colour=GREY, width=1.2, dash=None):
        turn = np.linspace(low, high, 40)
        self.line(np.asarray(centre) + radius * np.stack([np.cos(turn), np.sin(turn)], 1), colour, width, dash)

    def text(self, p, words, colour=INK, size=13, anchor="middle", shift=(0, 0), italic=False):
        x, y = self.at(p)
        style = ' font-style="italic"' if italic else ""
        self.parts.append(f'<text x="{x + shift[0]:.1f}" y="{y - shift[1]:.1f}" fill="{colour}" font-size="{size}" '
                          f'text-anchor="{anchor}"{style}>{words}</text>')

    def save(self, name, title):
        width, height = self.size
        body = "\n".join(self.parts)
        Path(__file__).with_name(name + ".svg").write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
            f'height="{height}" font-family="sans-serif" role="img">\n<title>{title}</title>\n'
            '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" '
            f'orient="auto"><path d="M0,0 L8,4 L0,8 z" fill="{INK}"/></marker></defs>\n'
            f'<rect width="{width}" height="{height}" fill="#ffffff"/>\n{body}\n</svg>\n')


def apex(a, b, from_a, from_b, side=1):
    """The point at these two distances from a and b, on one side of the line a b: a triangle laid into the plane."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    along = b - a
    length = np.linalg.norm(along)
    x = (from_a ** 2 - from_b ** 2 + length ** 2) / (2 * length)
    h = np.sqrt(max(from_a ** 2 - x ** 2, 0))
    return a + x * along / length + side * h * np.array([-along[1], along[0]]) / length


def crossing(p, q, a, b):
    """Where the line p q crosses the line a b, as a share of a b."""
    matrix = np.stack([q - p, a - b], 1)
    return np.linalg.solve(matrix, a - p)[1]


def unfolding():
    figure = Figure(760, 300)
    # A strip of three triangles folded in space, seen in perspective on the left: lengths are what counts.
    space = np.array([[0, 0, 0], [1.2, -.5, .3], [.9, .9, .5], [2.1, .35, .1], [2.2, 1.6, .9]])
    faces = [(0, 1, 2), (1, 3, 2), (2, 3, 4)]
    gap = lambda i, j: np.linalg.norm(space[i] - space[j])
    seen = space[:, :2] + space[:, 2:] * [[.25, .75]]
    flat = {1: np.array([1.1, -.4]), 2: np.array([1.1, -.4]) + gap(1, 2) * np.array([-.15, np.sqrt(1 - .0225)])}
    flat[0] = apex(flat[1], flat[2], gap(1, 0), gap(2, 0), 1)
    flat[3] = apex(flat[1], flat[2], gap(1, 3), gap(2, 3), -1)
    flat[4] = apex(flat[2], flat[3], gap(2, 4), gap(3, 4), 1)
    source, target = flat[0], flat[4]
    shares = [((a, b), crossing(source, target, flat[a], flat[b])) for a, b in ((1, 2), (2, 3))]
    bends = [space[a] + t * (space[b] - space[a]) for (a, b), t in shares]
    path = np.array([space[0], *bends, space[4]])
    figure.place(45, 80, 88)
    for k, face in enumerate(faces):
        figure.area([seen[v] for v in face], ["#e3e9f0", "#d3dde8", "#e9eef3"][k])
    figure.line(path[:, :2] + path[:, 2:] * [[.25, .75]], RED, 2.5)
    figure.dot(seen[0], RED)
    figure.dot(seen[4], BLUE)
    figure.text(seen[0], "S", RED, 15, shift=(-12, -4), italic=True)
    figure.text(seen[4], "target", BLUE, shift=(0, 10))
    figure.text([1.1, -.75], "folded in space")
    figure.place(330, 80, 88)
    for k, face in enumerate(faces):
        figure.area([flat[v] for v in face], ["#e3e9f0", "#d3dde8", "#e9eef3"][k])
    figure.line([source, target], RED, 2.5)
    figure.dot(source, RED)
    figure.dot(target, BLUE)
    figure.text(source, "S", RED, 15, shift=(-12, -4), italic=True)
    figure.text([1.2, -.75], "unfolded: the path is straight")
    # A line that misses an edge bends at the end of that edge: a new virtual source.
    a, b, c = np.array([.9, -.35]), np.array([1.0, .8]), np.array([1.9, .75])
    s, t = np.array([0, -.1]), np.array([1.55, 1.9])
    figure.place(575, 80, 88)
    figure.area([s, a, b], "#e3e9f0")
    figure.area([a, c, b], "#d3dde8")
    figure.area([b, c, t], "#e9eef3")
    figure.line([s, t], GREY, 1.4, "4 4")
    figure.line([s, b, t], RED, 2.5)
    for p, colour in ((s, RED), (t, BLUE), (b, AMBER)):
        figure.dot(p, colour)
    figure.text(s, "S", RED, 15, shift=(-12, -4), italic=True)
    figure.text(b, "new source,", AMBER, 12, anchor="start", shift=(6, -18))
    figure.text(b, "σ = |S b|", AMBER, 12, anchor="start", shift=(6, -33))
    figure.text([.95, -.75], "the line misses: a bend")
    figure.save("unfolding", "A virtual source is unfolded from triangle to triangle")


def label_and_window():
    """A notch in the plane: what one label a triangle says of a triangle in half shadow, and what windows say."""
    figure = Figure(760, 310)
    wall = np.array([1.0, 0.0])
    source = np.array([0.25, -0.95])
    triangle = np.array([[1.15, .3], [2.45, .7], [1.6, 1.65]])
    limit = wall + 2.25 * (wall - source) / np.linalg.norm(wall - source)
    for k, words in enumerate(("one label: the whole triangle gets one source",
                               "windows: each edge keeps an interval for each source")):
        figure.place(60 + 375 * k, 125, 92)
        figure.area([[1.0, 0], [2.6, 0], [2.6, -.95], [1.0, -.95]], "#c9ced4", GREY)
        figure.text([1.8, -.5], "obstacle", GREY)
        figure.area(triangle, "#e3e9f0")
        figure.line([source, limit], GREY, 1.2, "4 4")
        figure.text(limit, "limit of sight", GREY, 12, anchor="start", shift=(6, -8))
        centre = triangle.mean(0)
        cross = []
        for i in range(3):
            a, b = triangle[i], triangle[(i + 1) % 3]
            t = crossing(source, limit, a, b)
            if 0 < t < 1:
                cross.append((i, a + t * (b - a)))
        if k == 0:
            figure.line([source, wall, centre], RED, 2)
            figure.dot(centre, RED, 3.5)
            figure.text(centre, "centre", RED, 12, shift=(22, -12))
            for p in triangle:
                lit = np.cross(limit - source, p - source) > 0
                figure.dot(p, GREEN if lit else RED, 5, hollow=True)
                if lit:
                    figure.line([source, p], GREEN, 1.6)
            figure.text(triangle[2], "S is nearer here", GREEN, 12, anchor="end", shift=(-8, 4))
        else:
            for i in range(3):
                a, b = triangle[i], triangle[(i + 1) % 3]
                cut = next((p for j, p in cross if j == i), None)
                ends = [a, cut, b] if cut is not None else [a, b]
                for p, q in zip(ends, ends[1:]):
                    lit = np.cross(limit - source, (p + q) / 2 - source) > 0
                    figure.line([p, q], GREEN if lit else RED, 5)
            figure.line([source, triangle[2]], GREEN, 1.6)
            figure.line([source, wall, triangle[1]], RED, 1.6)
        figure.dot(source, GREEN)
        figure.dot(wall, RED)
        figure.text(source, "S", GREEN, 15, shift=(-12, -4), italic=True)
        figure.text(wall, "bend", RED, 12, anchor="end", shift=(-8, -4))
        figure.text([1.25, -1.25], words)
    figure.save("label-and-window", "One label a triangle, and windows on edges")


def taut(points, edges, rounds=60):
    """A string from points[0] to points[1] over edges (p, q): Newton's steps for the sum of its lengths."""
    start, end = points
    share = np.full(len(edges), .5)
    for _ in range(rounds):
        places = [start] + [p + t * (q - p) for (p, q), t in zip(edges, share)] + [end]
        for i, (p, q) in enumerate(edges):
            d = q - p
            left, right = places[i + 1] - places[i], places[i + 1] - places[i + 2]
            l, r = np.linalg.norm(left), np.linalg.norm(right)
            slope = d @ left / l + d @ right / r
            curve = (d @ d - (d @ left / l) ** 2) / l + (d @ d - (d @ right / r) ** 2) / r
            share[i] = np.clip(share[i] - slope / curve, 0, 1)
            places[i + 1] = p + share[i] * d
    return np.array(places)


def string():
    figure = Figure(760, 320)
    # A block in a solid: the path from S to w goes over two of its edges, which are lines in space.
    show = lambda p: np.array([p[0] + .42 * p[1], .95 * p[2] + .28 * p[1]])
    low, high = np.array([1.1, 0, 0]), np.array([2.1, 1.6, 1.1])
    corner = lambda i, j, k: np.array([(low, high)[i][0], (low, high)[j][1], (low, high)[k][2]])
    start, end = np.array([0, .3, .15]), np.array([3.0, 1.1, .1])
    edges = [(corner(0, 0, 1), corner(0, 1, 1)), (corner(1, 0, 1), corner(1, 1, 1))]
    path = taut((start, end), edges)
    figure.place(50, 75, 115)
    figure.area([show(corner(0, 0, 0)), show(corner(1, 0, 0)), show(corner(1, 0, 1)), show(corner(0, 0, 1))], "#dfe5ec")
    figure.area([show(corner(1, 0, 0)), show(corner(1, 1, 0)), show(corner(1, 1, 1)), show(corner(1, 0, 1))], "#c8d1db")
    figure.area([show(corner(0, 0, 1)), show(corner(1, 0, 1)), show(corner(1, 1, 1)), show(corner(0, 1, 1))], "#eef1f4")
    for p, q in edges:
        figure.line([show(p), show(q)], AMBER, 3)
    figure.line([show(p) for p in path], RED, 2.5)
    for p in path[1:-1]:
        figure.dot(show(p), AMBER)
    figure.dot(show(start), RED)
    figure.dot(show(end), BLUE)
    figure.text(show(start), "S", RED, 15, shift=(-12, -4), italic=True)
    figure.text(show(end), "w", BLUE, 15, shift=(12, -4), italic=True)
    figure.text(show(edges[0][1]), "edges where paths may bend", AMBER, 12, shift=(30, 12))
    figure.text([1.5, -.5], "a string over two edges; each bend can slide along its edge")
    # The same in the plane of one edge: which of two ways round, and lift-off.
    figure.place(520, 75, 115)
    block = np.array([[.55, 0], [1.35, 0], [1.35, .8], [.55, .8]])
    figure.area(block, "#dfe5ec")
    figure.text([.95, .35], "solid is", GREY, 12)
    figure.text([.95, .22], "missing here", GREY, 12)
    s, w = np.array([.05, .35]), np.array([1.85, .95])
    figure.line([s, w], GREY, 1.3, "4 4")
    figure.line([s, block[3], block[2], w], GREY, 1.6)
    figure.line([s, block[3], w], RED, 2.5)
    for p in (block[3], block[2]):
        figure.dot(p, AMBER)
    figure.dot(s, RED)
    figure.dot(w, BLUE)
    figure.text(s, "S", RED, 15, shift=(0, 10), italic=True)
    figure.text(w, "w", BLUE, 15, shift=(10, 6), italic=True)
    figure.text(block[3], "presses", AMBER, 12, shift=(-6, 12))
    figure.text(block[2], "lifts off", AMBER, 12, shift=(14, -16))
    figure.text([.95, -.5], "edges that do not press are dropped")
    figure.save("string", "A string around the corner of an obstacle is pulled taut")


def hinges():
    figure = Figure(760, 250)
    names = ["K = 0: a vertex", "K = 1: an edge", "K = 2: a triangle"]
    for k, name in enumerate(names):
        figure.place(45 + 250 * k, 85, 95)
        if k == 0:
            left, hinge, right = np.array([0, .2]), np.array([.95, .55]), np.array([1.9, .1])
            figure.line([left, hinge, right], INK, 2)
            figure.dot(hinge, AMBER, 5)
            figure.dot(left, RED)
            figure.dot(right, BLUE)
            figure.text((left + hinge) / 2, "h", RED, 14, shift=(-4, 10), italic=True)
            figure.text((right + hinge) / 2, "h'", BLUE, 14, shift=(8, 8), italic=True)
            figure.text(hinge, "the whole path goes through it", AMBER, 12, shift=(0, 16))
        if k == 1:
            a, b = np.array([.95, -.15]), np.array([1.0, 1.2])
            s, t = np.array([.05, .35]), np.array([1.9, .75])
            figure.area([a, b, s], "#e3e9f0")
            figure.area([a, t, b], "#d3dde8")
            figure.line([a, b], AMBER, 4)
        if k == 2:
            a, b, c = np.array([.75, .05]), np.array([1.25, .3]), np.array([.95, 1.15])
            s, t = np.array([.0, .45]), np.array([1.95, .75])
            for p in (a, b, c):
                figure.line([s, p], INK, 1.2)
                figure.line([t, p], INK, 1.2)
            figure.area([a, b, c], AMBER, AMBER, 2, .35)
        if k:
            up = (b - a) / np.linalg.norm(b - a) if k == 1 else np.array([0, 1.0])
            for p, colour, label in ((s, RED, "h"), (t, BLUE, "h'")):
                foot = a + up * ((p - a) @ up) if k == 1 else np.array([.98, p[1] - .02])
                figure.line([p, foot], colour, 1.2, "3 3")
                figure.dot(foot, colour, 2.5)
                figure.text((p + foot) / 2, label, colour, 14, shift=(0, 6), italic=True)
                figure.dot(p, colour)
            figure.text(foot, "x", BLUE, 14, shift=(-10, 3), italic=True)
        figure.text([.95, -.6], name)
    figure.save("hinge", "The hinge between two simplices, by its dimension")


def pieces():
    """A sheet cut into four pieces; the front of one source, and the horizon up to which each piece works."""
    figure = Figure(760, 330)
    figure.place(60, 45, 250)
    size = np.array([2.5, 1.0])
    source = np.array([.35, .4])
    cuts_x, cut_y = (0, 1.25, 2.5), (0, .5, 1.0)
    tints = ["#e3e9f0", "#eef1f4", "#eef1f4", "#e3e9f0"]
    for i in range(2):
        for j in range(2):
            x, y = cuts_x[i], cut_y[j]
            figure.area([[x, y], [cuts_x[i + 1], y], [cuts_x[i + 1], cut_y[j + 1]], [x, cut_y[j + 1]]],
                        tints[i + 2 * j if i == 0 else 3 - (i + 2 * j) % 4], GREY)
            figure.text([x, y], f"piece {i + 2 * j + 1}", GREY, 12, anchor="start", shift=(8, 8))

    def circle(radius, colour, width, dash=None):
        turn = np.linspace(0, 2 * np.pi, 721)
        ring = source + radius * np.stack([np.cos(turn), np.sin(turn)], 1)
        inside = np.all((ring >= 0) & (ring <= size), axis=1)
        start = 0
        while start < len(ring):
            if not inside[start]:
                start += 1
                continue
            end = start
            while end < len(ring) and inside[end]:
                end += 1
            figure.line(ring[start:end], colour, width, dash)
            start = end

    for radius in (.25, .5, .75):
        circle(radius, GREEN, 1.2)
    circle(.97, GREEN, 3)
    circle(1.3, RED, 2, "6 4")
    for y in (.62, .78):
        x = 1.25
        figure.line([[x - .06, y], [x + .1, y]], INK, 1.6, arrow=True)
    figure.line([[.75, .44], [.75, .6]], INK, 1.6, arrow=True)
    figure.dot(source, GREEN)
    figure.text(source, "S", GREEN, 15, shift=(-12, -4), italic=True)
    figure.text([1.27, .1], "front", GREEN, 13, anchor="end", shift=(-4, 0))
    figure.text([1.66, .28], "horizon: no piece works", RED, 13, anchor="start", shift=(4, 0))
    figure.text([1.66, .28], "beyond it in this superstep", RED, 13, anchor="start", shift=(4, -16))
    figure.text([1.7, .76], "messages: labels", INK, 13, anchor="start")
    figure.text([1.7, .69], "that leave a piece", INK, 13, anchor="start")
    figure.save("pieces", "One solve in pieces: front, horizon, and messages")


if __name__ == "__main__":
    unfolding()
    label_and_window()
    string()
    hinges()
    pieces()
