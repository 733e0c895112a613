"""How well and how fast `delaunay_dual` works: tables, and a plot of the distance from the exact axis."""

import json
import math

from . import BENCH
from .page import table
from .run import run, short

# Seconds of processor time for one run.
LIMIT = 300

# Images, by folder of FOLDER/images.
FOLDERS = ["mpeg7", "masks"]

# Shapes of `medial-bench draw` and about how many edges they have.
SHAPES = [("star", 100), ("koch", 300), ("maze", 300), ("holes", 300)]

HEAD = """# The dual of the Delaunay graph, measured

`scripts/delaunay-dual --write docs/delaunay-dual.md FOLDER` draws up this page from FOLDER/images, which is no part of this repository; `scripts/figures` draws the plot from it.
Processor: {processor}.

"""

CRUST = """## Crust

The outlines of images at the default spacing, half a pixel: the middles of the sides of pixels and the points between these.
The engine knows which samples are neighbours; the one-step crust finds that out from the samples alone.

- *missing*: pairs of neighbours that are not in the crust; *false*: edges of the crust between others, as a share of the pairs.
- *not Delaunay*: pairs that are not joined in the Delaunay graph by themselves.
- *broken*: by how many the components of the axis, pruned by a chord residual of 2 pixels, differ from those of the mask.
- *ends*: of that axis, on average.
- *two-step*: the same of the crust of Amenta, Bern and Eppstein, for which the Voronoi vertices are triangulated as well: the circle of an edge may hold none of them, not only none of those beside it, so there are fewer edges.
- *ns*: nanoseconds of processor time a sample, for either crust from the samples alone.

Nearly all false edges join both sides of a place where two pixels touch at a corner only: the outline leaves half a diagonal between them there, so samples are twice as dense at such places.

"""

TIMES = """## Times

Nanoseconds of processor time a sample, one thread.

- *graph*: from the mask to the dual graph: outline, Delaunay triangulation, boundary, groups on one circle, centres.
- *axis*: chord residuals, pruning by 2 pixels, and the axis with its governors.
- *incremental*: the triangulation alone, by turns in one process with the incremental insertion of `spade` in the order of the outline, and along a Hilbert curve, with its bulk load, and with `delaunator`.

"""

SPACING = """## Distance from the exact axis

The axis of samples, unpruned, against that of `path_tracing`, as the spacing is halved.
All lengths are shares of the longer side of the box.

- *distance*: the largest one of a point of the axis from the exact axis.
- *missed*: the largest one of a point of the exact axis from the axis.
- *crust*: the share of pairs of neighbours that is in the crust; samples at corners never are dense enough.

The distance goes down with the square of the spacing, but where a shape has a corner that is nearly flat, as the star one of 179.95 degrees: a branch leads into it from one of the two circles through the sample there and a neighbour, so it meets the others up to half a spacing beside its place.

![Distances against the spacing](delaunay-dual.svg)

"""


def page(programs, python, folder, data, processor):
    """The page."""
    text = HEAD.format(processor=processor)
    masks = bitmaps(python, folder, data)
    text += CRUST + table(crust(programs, masks)) + "\n"
    text += TIMES + table(times(programs, masks)) + "\n"
    text += SPACING
    for name, words in [*((f"{shape}, {edges} edges", [shape, str(edges)]) for shape, edges in SHAPES),
                        *((path.stem, [str(path)]) for path in masks["masks"] if path.stem == "horse")]:
        text += f"### {name}\n\n" + table(spacings(programs, words)) + "\n"
    return text.rstrip() + "\n"


def bitmaps(python, folder, data):
    """The images of each folder as bitmaps."""
    found = {}
    for kind in FOLDERS:
        place = folder / kind
        place.mkdir()
        images = [str(path) for path in sorted((data / "images" / kind).glob("*.png"))]
        run([str(python), str(BENCH / "raster_quality.py"), "masks", str(place), *images], 3600)
        found[kind] = sorted(place.glob("*.pbm"))
    return found


def told(words):
    return json.loads(run([str(word) for word in words], LIMIT)[0])


def crust(programs, masks):
    yield ["images", "number", "samples", "missing", "false", "ns", "two-step missing", "two-step false", "two-step ns",
           "not Delaunay", "broken", "ends"]
    yield ["---"] + ["--:"] * 11
    for kind, files in masks.items():
        found = [told([programs["bench"], "dual", path]) for path in files]
        total = lambda key: sum(one[key] for one in found)
        samples = total("samples")
        mean = lambda key: short(sum(one[key] * one["samples"] for one in found) / samples)
        yield [kind, str(len(found)), str(samples), str(total("outside_crust")),
               f"{total('false_crust') / samples:.4%}", mean("one_step_ns"), str(total("two_step_missing")),
               f"{total('two_step_false') / samples:.4%}", mean("two_step_ns"), str(total("missing")), str(total("broken")),
               short(total("ends") / len(found))]


def times(programs, masks):
    yield ["image", "samples", "graph", "axis", "together", "incremental", "spade", "spade, Hilbert",
           "spade, bulk", "delaunator", "medial ÷ spade"]
    yield ["---"] + ["--:"] * 10
    largest = sorted(masks["masks"] + masks["mpeg7"], key=lambda path: -path.stat().st_size)[:4]
    for path in largest:
        whole = told([programs["bench"], "dual", path])
        alone = told([programs["rivals"], "delaunay", path])
        rivals = [alone[name] for name in ["medial", "spade", "spade_hilbert", "spade_bulk", "delaunator"]]
        least = min(alone["spade"], alone["spade_hilbert"])
        yield [path.stem, str(whole["samples"]), short(whole["graph_ns"]), short(whole["axis_ns"]),
               short(whole["graph_ns"] + whole["axis_ns"]), *map(short, rivals),
               f"{alone['medial'] / least:.2f}"]


def spacings(programs, words):
    yield ["spacing", "samples", "crust", "distance", "missed"]
    yield ["--:"] * 5
    lines = run([str(programs["bench"]), "spacing", *words], LIMIT)[0].splitlines()
    for line in map(json.loads, lines):
        share = 1 - line["outside_crust"] / line["samples"]
        yield [f"{line['spacing']:.6f}", str(line["samples"]), f"{share:.1%}",
               f"{line['distance']:.2e}", f"{line['missed']:.2e}"]


def read(text):
    """The tables of distances of a page: for each shape its rows."""
    found, name = {}, None
    for line in text.splitlines():
        if line.startswith("### "):
            name = line[4:]
            found[name] = []
        elif name and line.startswith("| ") and line[2].isdigit():
            cells = line.strip("| ").split(" | ")
            found[name].append([float(cells[k]) for k in (0, 3, 4)])
    return found


# Size of one plot, and of the room around it.
WIDTH, HEIGHT, GAP, LEFT, TOP = 260, 200, 60, 70, 90

INK, MUTED, GRID = "#263238", "#607d8b", "#eceff1"

COLOURS = {"distance": "#1976d2", "missed": "#d84315"}


def figure(text):
    """The plots of a page as a picture: both distances against the spacing, logarithms all."""
    tables = read(text)
    wide, high = LEFT + len(tables) * (WIDTH + GAP), TOP + HEIGHT + GAP
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {high}" font-family="sans-serif" '
           f'font-size="11" fill="{INK}">', f'<rect width="{wide}" height="{high}" fill="#fff"/>',
           f'<text x="{LEFT}" y="26" font-size="16">Distance from the exact axis against the spacing</text>']
    for k, name in enumerate(COLOURS):
        out.append(f'<text x="{LEFT + 80 * k}" y="46" fill="{COLOURS[name]}">{name}</text>')
    out.append(f'<text x="{LEFT + 160}" y="46" fill="{MUTED}">the spacing itself, dotted</text>')
    for k, (name, rows) in enumerate(tables.items()):
        out += plot(name, rows, LEFT + k * (WIDTH + GAP), TOP)
    return "\n".join([*out, "</svg>\n"])


def plot(name, rows, left, top):
    """One plot."""
    low, high = math.log10(rows[-1][0]), math.log10(rows[0][0])
    bottom = math.floor(math.log10(min(min(row[1:]) for row in rows)))
    x = lambda value: left + WIDTH * (math.log10(value) - low) / (high - low)
    y = lambda value: top + HEIGHT * (-1 - math.log10(value)) / (-1 - bottom)
    out = [f'<text x="{left}" y="{top - 10}" font-weight="bold">{name}</text>']
    for power in range(bottom, 0):
        at = y(10.0 ** power)
        out += [f'<line x1="{left}" y1="{at:.1f}" x2="{left + WIDTH}" y2="{at:.1f}" stroke="{GRID}"/>',
                f'<text x="{left - 6}" y="{at + 4:.1f}" text-anchor="end" fill="{MUTED}">1e{power}</text>']
    for value in (rows[-1][0], rows[0][0]):
        out.append(f'<text x="{x(value):.1f}" y="{top + HEIGHT + 16}" text-anchor="middle" '
                   f'fill="{MUTED}">{value:g}</text>')
    ends = " ".join(f"{x(row[0]):.1f},{y(row[0]):.1f}" for row in rows)
    out.append(f'<polyline points="{ends}" fill="none" stroke="{MUTED}" stroke-dasharray="2 3"/>')
    for place, colour in enumerate(COLOURS.values(), 1):
        points = " ".join(f"{x(row[0]):.1f},{y(row[place]):.1f}" for row in rows)
        out.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.5"/>')
    return out
