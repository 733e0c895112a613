"""Compares ways to compress masks, and draws the plot of docs/raster.md from its table."""

import re

from . import BENCH
from .run import run

# Images whose masks are compressed: what the table calls them, and where they are.
GROUPS = [
    ("silhouettes", "mpeg7", "*.png"),
    ("a horse, a noisy contour", "masks", "[dh]*.png"),
    ("roads", "masks", "solaris*.png"),
    ("scanned pages", "scans", "*.png"),
]

# The plot shows these, by the ways that match.
SERIES = {
    r"chain, chord=[\d.]+": ("chain by threshold", "#8e24aa"),
    r"chain, chord=2(, .*radii.*)?": ("chain by steps of radii", "#ad1457"),
    r"chain, error .*": ("chain by error", "#1976d2"),
    r"cover, .*": ("disks", "#00897b"),
    r"squares, .*": ("squares", "#ef6c00"),
}

EXACT = ["PNG", "CCITT G4", "crack"]

TITLE = "Compression"

HEAD = """## Compression

What masks take as `medial compress` writes them ([formats.md](formats.md#the-compressed-axis)), whole files, and in other ways: [VS87, II.A.3](../REFERENCES.md) hopes for the medial axis to save memory, and names squares in the place of disks.
Every file is read again before it is counted.

- *raw*: one bit a pixel; *PNG*: the smallest of three filters, one bit a pixel, deflated as hard as it goes; *CCITT G4*: as fax machines code it, without the head of a file; *crack code, 2 bits*: two bits for each crack between a pixel of the shape and one outside, and a start for each outline.
- *crack*: the same turns, each expected by those before it; *chain*: the medial cells with their distances; *cover* and *squares*: disks or squares, each time the one that gains most.
- *÷ PNG* and *÷ crack*: bits as a share of those of PNG and of the coded cracks, mean over the images; below 1 it is smaller.
- *lost*: cells that do not come back, as a share of the shape (XOR by area; no cell is ever added); *distance*: the Hausdorff distance in pixels, of the shapes or of what lies outside of them, whichever is more.

![Plots of what is lost against bits](mask-compression.svg)

"""

END = """
Without loss nothing here is smaller than the coded outline.
The chain of all medial cells takes four times the bits of PNG on silhouettes, because each step of a digital outline has a branch of its own; disks that cover everything take half of PNG, which is more than CCITT G4 and twice the coded outline.

With loss the chain at its default takes half of PNG on silhouettes, lacks less than a percent of the area and is off by two pixels or so; that is still twice the coded outline, which lacks nothing.
Most of its bits are distances: in whole pixels they cost a quarter less, and in exact squares two fifths more.
The chain gives the axis, whose topology is that of the shape, for these bits; the outline gives none.

Thin shapes are where the axis loses.
On scanned pages, whose strokes are a few pixels wide, the chain takes what the coded outline takes and lacks a quarter of the area, as disks of one or two pixels hardly fit into such strokes; disks that cover everything take more than PNG.
Roads are thin as well, but long and straight: a cell of the chain costs half a bit there, so all ways are below PNG, but of straight strokes an outline costs next to nothing.

Covers leave out whole parts of little area first, which is why distances are large at small losses; with `--max-error` they do not.
Disks beat squares where outlines run in all directions; of roads that are a few pixels wide everywhere, squares are fewer.
Only where several percent may be lost, or several pixels, a cover of disks or a chain takes fewer bits than the coded outline.
"""


def rows(program, python, folder, data):
    """Yields the lines of the table."""
    yield ["images", "number", "way", "÷ PNG", "÷ crack", "lost, mean", "distance, mean px", "distance, most px",
           "disks, mean"]
    yield ["---", "--:", "---"] + ["--:"] * 6
    for group, kind, pattern in GROUPS:
        files = sorted((data / "images" / kind).glob(pattern))
        words = [python, BENCH / "raster_quality.py", "masks", folder, *files]
        masks = run(list(map(str, words)), 600)[0].splitlines()
        found = {}
        for line in run([str(program), *masks], 7200)[0].splitlines():
            name, way, *numbers = line.split("\t")
            found.setdefault(way, {})[name] = [float(number) for number in numbers]
        bits = lambda way: {name: numbers[0] for name, numbers in found[way].items()}
        png, crack = bits("PNG"), bits("crack")
        for way, of in found.items():
            mean = lambda values: sum(values) / len(of)
            share = lambda other: mean([numbers[0] / other[name] for name, numbers in of.items()])
            lost, distance, disks = ([numbers[k] for numbers in of.values()] for k in (1, 2, 3))
            yield [group, str(len(of)), way, f"{share(png):.3f}", f"{share(crack):.3f}",
                   f"{mean(lost):.3%}" if any(lost) else "0", f"{mean(distance):.2f}" if any(lost) else "0",
                   f"{max(distance):.2f}" if any(lost) else "0", f"{mean(disks):,.0f}" if any(disks) else ""]


def read(text):
    """The table of the page: for each group of images its ways, each with bits by PNG and what is lost."""
    found = {}
    part = text.split(f"## {TITLE}\n", 1)[1].split("\n## ", 1)[0]
    for line in part.splitlines():
        cells = line.strip("| ").split(" | ")
        if line.startswith("| ") and len(cells) >= 8 and cells[1].isdigit():
            found.setdefault(cells[0], []).append(
                (cells[2], float(cells[3]), float(cells[5].rstrip("%")), float(cells[6])))
    return found


# Size of one plot, and of the room around it.
WIDTH, HEIGHT, GAP, LEFT, TOP = 330, 220, 70, 60, 76

INK, GRID = "#263238", "#eceff1"


def figure(text):
    """The plots of a page as a picture: a row for each group of images, lost cells and the distance."""
    tables = read(text)
    wide, high = LEFT + 2 * (WIDTH + GAP), TOP + len(tables) * (HEIGHT + GAP)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {high}" font-family="sans-serif" '
           f'font-size="11" fill="{INK}">', f'<rect width="{wide}" height="{high}" fill="#fff"/>',
           f'<text x="{LEFT}" y="26" font-size="16">Masks: what is lost against bits, those of PNG being 1</text>']
    at = LEFT
    for name, colour in SERIES.values():
        out.append(f'<circle cx="{at + 4}" cy="46" r="3.5" fill="{colour}"/><text x="{at + 12}" y="50">{name}</text>')
        at += 40 + 6 * len(name)
    out.append(f'<text x="{at}" y="50" fill="#c62828">dashed: without loss</text>')
    for row, (group, lines) in enumerate(tables.items()):
        top = TOP + row * (HEIGHT + GAP)
        for column, (what, place) in enumerate([("% of the cells lost", 2), ("distance, px", 3)]):
            out += plot(lines, place, f"{group}: {what}", LEFT + column * (WIDTH + GAP), top + 20)
    return "\n".join([*out, "</svg>\n"])


def plot(lines, place, title, left, top):
    """One plot."""
    series = {key: sorted((line[1], line[place]) for line in lines if re.fullmatch(key, line[0])) for key in SERIES}
    exact = {line[0]: line[1] for line in lines if line[0] in EXACT}
    most_x = min(4.0, 1.05 * max([x for points in series.values() for x, _ in points] + list(exact.values())))
    most_y = 1.05 * max([y for points in series.values() for x, y in points if x <= most_x] + [1e-9])
    x_of = lambda x: left + WIDTH * x / most_x
    y_of = lambda y: top + HEIGHT * (1 - y / most_y)
    out = [f'<text x="{left}" y="{top - 6}" font-weight="bold">{title}</text>',
           f'<path d="M{left} {top}v{HEIGHT}h{WIDTH}" fill="none" stroke="{INK}"/>']
    for k in range(1, 5):
        x, y = most_x * k / 4, most_y * k / 4
        out.append(f'<path d="M{x_of(x):.1f} {top}v{HEIGHT}M{left} {y_of(y):.1f}h{WIDTH}" stroke="{GRID}"/>')
        out.append(f'<text x="{x_of(x):.1f}" y="{top + HEIGHT + 14}" text-anchor="middle">{x:.2f}</text>')
        out.append(f'<text x="{left - 5}" y="{y_of(y) + 4:.1f}" text-anchor="end">{y:.3g}</text>')
    for k, (name, x) in enumerate(exact.items()):
        if x <= most_x:
            out.append(f'<path d="M{x_of(x):.1f} {top}v{HEIGHT}" stroke="#c62828" stroke-dasharray="4 3"/>')
            out.append(f'<text x="{x_of(x) + 3:.1f}" y="{top + 12 + 13 * k}" fill="#c62828">{name}</text>')
    for key, (_, colour) in SERIES.items():
        points = [(x, y) for x, y in series[key] if x <= most_x]
        if points:
            way = "L".join(f"{x_of(x):.1f} {y_of(y):.1f}" for x, y in points)
            out.append(f'<path d="M{way}" fill="none" stroke="{colour}" stroke-width="1.5"/>')
        out += [f'<circle cx="{x_of(x):.1f}" cy="{y_of(y):.1f}" r="3" fill="{colour}"/>' for x, y in points]
    return out
