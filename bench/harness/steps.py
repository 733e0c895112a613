"""Counts the steps of the merges of `divide_and_conquer`, and plots them."""

import math

from . import families
from .run import Unfinished, run, short

# Seconds a count may take; it is no measurement, and the same on every machine.
LIMIT = 600

TITLE = "Merge steps"

# Size of the picture, and of the field that the lines are in.
WIDTH, HEIGHT = 760, 470
LEFT, RIGHT, TOP, BOTTOM = 64, 610, 64, 410

# Least distance between the names of two lines.
APART = 15

INK, MUTED, GRID = "#263238", "#607d8b", "#eceff1"
BLUE, ORANGE = "#1976d2", "#d84315"
DASHED = ' stroke-dasharray="4 4"'


def rows(command, options):
    """Yields the lines of the table as they are ready."""
    yield ["shape", "rings", "edges", "pieces", "arcs", "starts", "steps", "steps ÷ log₂ edges"]
    yield ["---"] + ["--:"] * 7
    for shape in options.shapes:
        for size in sorted(options.sizes):
            try:
                told, _, _ = run([*command, "work", shape, str(size)], LIMIT)
            except Unfinished as reason:
                yield [shape, "", f"{size:,}", "", "", "", str(reason), ""]
                continue
            edges, rings, *work = map(int, told.split())
            each = [count / edges for count in work]
            steps = sum(each)
            cells = [shape, f"{rings:,}", f"{edges:,}", *map(short, each), short(steps)]
            yield cells + [short(steps / math.log2(edges))]


def figure(section):
    """The picture of the table in a part of the page: steps an edge against the edges."""
    lines = read(section)
    everything = [point for points in lines.values() for point in points]
    sizes = [n for n, _, _ in everything]
    least_n, most_n = min(sizes), max(sizes)
    counts = [steps for _, _, steps in everything]
    ticks = [step * 10**power for power in range(4) for step in (1, 2, 5)]
    low = max(tick for tick in ticks if tick <= max(min(counts), 1))
    high = min(tick for tick in ticks if tick >= max(counts))
    wide = math.log(most_n / least_n) or 1.0
    x = lambda n: LEFT + (RIGHT - LEFT) * math.log(n / least_n) / wide
    y = lambda steps: BOTTOM - (BOTTOM - TOP) * math.log(steps / low) / math.log(high / low)
    drawn = Drawing()
    drawn.words(LEFT, 26, "Steps of the merges of divide_and_conquer, an edge", size=16)
    drawn.words(LEFT, 46, "without holes", fill=BLUE)
    drawn.words(LEFT + 92, 46, "with holes", fill=ORANGE)
    drawn.words(LEFT + 166, 46, "dashed: growth of all steps like n log n", fill=MUTED)
    for value in (tick for tick in ticks if low <= tick <= high):
        drawn.line([(LEFT, y(value)), (RIGHT, y(value))], GRID)
        drawn.words(LEFT - 8, y(value) + 4, f"{value}", anchor="end", fill=MUTED)
    for power in range(math.ceil(math.log10(least_n) - 0.02), int(math.log10(most_n) + 0.02) + 1):
        place = min(max(x(10**power), LEFT), RIGHT)
        drawn.words(place, BOTTOM + 20, f"1e{power}", anchor="middle", fill=MUTED)
    drawn.words((LEFT + RIGHT) / 2, BOTTOM + 42, "edges", anchor="middle", fill=MUTED)
    for start in (min(counts), 10 ** (math.log10(min(counts) * max(counts)) / 2)):
        scale = [least_n * (most_n / least_n) ** (k / 20) for k in range(21)]
        ray = [(x(n), y(start * math.log(n) / math.log(least_n))) for n in scale]
        drawn.line([place for place in ray if place[1] >= TOP], MUTED, more=DASHED)
    for points in lines.values():
        color = ORANGE if points[0][1] > 1 else BLUE
        places = [(x(m), y(count)) for m, _, count in points]
        drawn.line(places, color, width=1.8)
        for place in places:
            drawn.dot(place, color)
    ends = sorted((y(points[-1][2]), shape) for shape, points in lines.items())
    for height, shape in spread(ends):
        color = ORANGE if lines[shape][0][1] > 1 else BLUE
        end = (x(lines[shape][-1][0]), y(lines[shape][-1][2]))
        drawn.line([end, (RIGHT + 22, height)], color, width=0.8, more=' stroke-opacity="0.5"')
        drawn.words(RIGHT + 26, height + 4, shape, fill=color)
    return drawn.text()


def read(section):
    """The edges, rings and steps an edge of each shape, from the table."""
    lines = {}
    for row in section.splitlines():
        cells = [cell.strip() for cell in row.strip("|").split("|")]
        if row.startswith("|") and cells[0] in families.SHAPES and cells[1]:
            rings, edges = (int(cell.replace(",", "")) for cell in cells[1:3])
            steps = float(cells[6].replace(",", ""))
            lines.setdefault(cells[0], []).append((edges, rings, steps))
    return lines


def spread(ends):
    """The heights of names, moved apart where they would overlap."""
    heights = [height for height, _ in ends]
    for _ in range(200):
        for k in range(1, len(heights)):
            over = APART - (heights[k] - heights[k - 1])
            if over > 0:
                heights[k - 1] -= over / 2
                heights[k] += over / 2
    return [(height, shape) for height, (_, shape) in zip(heights, ends)]


class Drawing:
    """A picture that grows."""

    def __init__(self):
        self.parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
            f'viewBox="0 0 {WIDTH} {HEIGHT}">',
            f"<title>{TITLE}</title>",
            f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>',
        ]

    def words(self, x, y, text, size=12, anchor="start", fill=INK):
        self.parts.append(
            f'<text x="{x:.1f}" y="{y:.1f}" font-family="Helvetica, Arial, sans-serif" '
            f'font-size="{size}" text-anchor="{anchor}" fill="{fill}">{text}</text>'
        )

    def line(self, points, stroke, width=1, more=""):
        way = "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
        self.parts.append(
            f'<path d="M{way}" fill="none" stroke="{stroke}" stroke-width="{width}"{more}/>'
        )

    def dot(self, place, fill):
        x, y = place
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.6" fill="{fill}"/>')

    def text(self):
        return "\n".join([*self.parts, "</svg>\n"])
