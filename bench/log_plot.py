"""Plots with two logarithmic axes as SVG, by hand: no library is needed to draw a dozen lines."""
import math

COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56789a", "#a6761d"]
MARKS = ["circle", "square", "diamond", "triangle"]


def decades(values):
    return math.floor(math.log10(min(values)) + 1e-9), math.ceil(math.log10(max(values)) - 1e-9)


def text(x, y, words, anchor="middle", size=12, extra=""):
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}"{extra}>'
            f"{words}</text>")


def mark(kind, x, y, colour, hollow=False):
    r = 4
    paint = f'fill="white" stroke="{colour}" stroke-width="1.6"' if hollow else f'fill="{colour}"'
    if kind == "circle":
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r}" {paint}/>'
    corners = {
        "square": [(-r, -r), (r, -r), (r, r), (-r, r)],
        "diamond": [(0, -r - 1), (r + 1, 0), (0, r + 1), (-r - 1, 0)],
        "triangle": [(0, -r - 1), (r + 1, r), (-r - 1, r)],
    }[kind]
    points = " ".join(f"{x + a:.1f},{y + b:.1f}" for a, b in corners)
    return f'<polygon points="{points}" {paint}/>'


def power(exponent):
    return f'10<tspan dy="-5" font-size="9">{exponent}</tspan>'


def picture(width, height, parts):
    return "\n".join(
        [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
         f'width="{width}" height="{height}" font-family="sans-serif" fill="#222">',
         f'<rect width="{width}" height="{height}" fill="white"/>', *parts, "</svg>"]) + "\n"


class LogPanel:
    """Axes in decades: `x` and `y` are pairs of decimal logarithms, those of `y` whole. Values at or below `least`
    are drawn there, and its tick says so."""

    def __init__(self, left, top, width, height, x, y, least):
        self.left, self.top, self.width, self.height = left, top, width, height
        self.x, self.y, self.least = x, y if y[1] > y[0] else (y[0], y[0] + 1), least

    def at(self, x, y):
        fx = (math.log10(x) - self.x[0]) / (self.x[1] - self.x[0])
        fy = (math.log10(max(y, self.least)) - self.y[0]) / (self.y[1] - self.y[0])
        return self.left + fx * self.width, self.top + (1 - fy) * self.height

    def frame(self, title, x_title, digits, out):
        """Border, grid, ticks; those of x at `digits` times the powers of ten."""
        out.append(text(self.left + self.width / 2, self.top - 16, title, size=14))
        out.append(f'<rect x="{self.left}" y="{self.top}" width="{self.width}" height="{self.height}" '
                   'fill="none" stroke="#333"/>')
        for exponent in range(self.y[0], self.y[1] + 1):
            _, y = self.at(1, 10.0**exponent)
            out.append(f'<line x1="{self.left}" y1="{y:.1f}" x2="{self.left + self.width}" '
                       f'y2="{y:.1f}" stroke="#ddd"/>')
            words = ("&#8804; " if 10.0**exponent <= self.least else "") + power(exponent)
            out.append(text(self.left - 8, y + 4, words, "end"))
        for exponent in range(math.floor(self.x[0]), math.ceil(self.x[1]) + 1):
            for digit in digits:
                value = digit * 10.0**exponent
                if not self.x[0] <= math.log10(value) <= self.x[1]:
                    continue
                x, _ = self.at(value, 10.0 ** self.y[0])
                out.append(f'<line x1="{x:.1f}" y1="{self.top}" x2="{x:.1f}" '
                           f'y2="{self.top + self.height}" stroke="#eee"/>')
                out.append(text(x, self.top + self.height + 18, f"{value:g}"))
        out.append(text(self.left + self.width / 2, self.top + self.height + 40, x_title))
