"""The page that the comparison draws up, part by part."""

import platform
import re
import sys

from . import families, steps
from .build import PEERS
from .buildings import LAYER

HEAD = """# Benchmarks

`scripts/bench --data FOLDER --write docs/benchmarks.md` builds the programs of `bench/`, runs them by turns on the same polygons and draws up this page; `--quick` is shorter, `--shapes`, `--sizes`, `--rivals` and `--parts` choose, and parts and shapes that are not chosen stay as they are.
Times are medians of the processor time of one thread, in microseconds an edge; reading the input is not counted.
Each process repeats its work for half a second, and three times at least unless that takes more than six seconds; the allocator of all of them is told to keep what they free (`GLIBC_TUNABLES`, in `bench/harness/run.py`).
A busy machine moves them; ratios move less, because all programs take turns.
`> N s` is a run that was stopped, or not begun because by its time an edge at the size before it would take half as much again, `crash` one that ended itself; larger sizes are not tried then, which `-` shows; where there is nothing, a program was not asked for that size.
"""

ROUNDS = """Up to {rounds} rounds of at most {limit} seconds; a program that has spent {budget} seconds on an input skips the rounds left, so large inputs of slow programs were run once or twice.
"""

PROCESSOR = """Processor: {processor}.

"""

SHAPES = """- *medial*: `Domain::from_polygons`, which validates, and `path_tracing`; *medial* is the sum, and *first* that of the first round of a process, which also fetches all its memory from the system. `bytes` is the growth of the peak of resident memory over both, an edge. `÷ at 1e4` is time an edge against that at 1e4 edges.
- *divide_and_conquer*: that engine alone; *boost ÷ divide_and_conquer* counts validation too, as *boost ÷ medial* does.
- *both sides*: `both_sides`, the interior and the exterior within a frame, by either engine, without validation.
- *boost*: Boost.Polygon: `construct_voronoi` of the edges, and the walk that drops what lies outside. It gives both sides of the boundary, medial the inside; in general position it finds as many paths, but for those inside the holes, which count for Boost too.
- *delaunator*: no axis at all, but the Delaunay triangulation of the corners: what a fast geometric algorithm on as many points costs.

Coordinates are whole numbers of 31 bits, but for `ngon` and `ellipse`, which are plain doubles; Boost gets those rounded, and so another polygon.
`star` has corners at equal angles and random distances, `koch` is a fractal coast with jittered thirds and heights, `maze` the outline of a random maze with jittered corners and `rmaze` without jitter, `comb` has equal teeth and `stair` equal steps, both parallel to the axes, `holes` and `holes3` are squares with a lattice of jittered holes of 12 and 3 corners, `lattice` one of equal squares, `ngon` is a regular polygon and `rngon` the same in whole numbers, `slivers` has long thin spikes around a disk, `spiral` is a corridor.

"""

RIVALS = """The same shapes and sizes, medial measured again among these:

- *boostvoronoi*: the Rust port of Boost.Polygon, used in the same way.
- *cgal*: CGAL's segment Delaunay graph, exact predicates, points sorted in space, and the walk that drops what lies outside. It gives both sides.
- *spade*, *spade-cdt*: no axis at all, but the Delaunay triangulation of the corners, the second one constrained to the edges.

"""

STEPS = """What `divide_and_conquer` does, counted by `divide_and_conquer_counted`, an edge of the shape: *pieces* of merge curves that it followed, *arcs* around cells that it looked at to find where a piece ends, and *starts*, edges that it looked at to find where the curve around a ring starts; *steps* are their sum.
Counts are the same on every machine.
Where steps ÷ log₂ edges does not grow, the merges take n log n steps at worst.

![Steps an edge against edges, by shape](merge-steps.svg)

"""

LEE = """The polygons of [the gallery](gallery/README.md) for the figures of [Lee82]: medians of the processor time of one thread in microseconds, here for the whole polygon.
They are of the same kind as those of the paper, not the same.
Beside its figure 9 the paper prints `CP TIME: .569 SEC`; its program was written in Fortran and run under FTN with PLOT-10, on a machine that the paper does not name, and the time may include reading and plotting.

"""

OPERATIONS = """What operations take, on the axis that *engine* made: without reading, validation and writing.
*hierarchy* is the order of burning with the potential of every path, *significance* the same with the excess; both are parts of what follows.
*prune* removes what moves the boundary by less than a thousandth of the diagonal of the box, *smooth* limbs with a prominence below 0.1, *branches* are those of the whole axis with their primitives, areas and boundary, *reconstruct* gives the polygons back, *outline* does so from the graph, and *centerline* is the longest line.
*sum* is that of these six, each by itself; *all together* does all six in one run of a program that burns the axis once (`Hierarchy::pruned`, `smoothed` and `centerlines`).
The axis is *engine*, or *axis*: that and *validation*, as a user runs them.

"""

FILE_OPERATIONS = """The same on whole layers, each feature a domain of its own, on the coordinates of the file.
Many features are small: there each operation mostly waits for memory to be handed out.

"""

FILES = """Whole layers, each feature a domain of its own; columns as for the shapes, *as given* is medial on the coordinates of the file.
All others get whole numbers: each feature enlarged by a power of two, and shifted, to fill 31 bits, and rounded.
Features that bound no domain are left out, and so are those where, after rounding, edges meet elsewhere than at ends, which Boost cannot take.
*divide_and_conquer* counts validation too; the last line has the sums of all files.

"""

BUILDINGS = """The buildings of `LAYER`, GeoJSON to GeoJSON, whole processes with start, reading and writing.
medial writes every path of the exact axis with its radii and governors; the other two write approximate centerlines, which are much less.
`pygeoops.centerline` with its default options drops short branches and simplifies; SFCGAL's approximate medial axis is a part of the straight skeleton.
Both run in Python (PEERS); ratios are to the first line.
""".replace("LAYER", LAYER).replace("PEERS", ", ".join(PEERS))


# The parts of the page in their order: title, and what is said before the table.
PARTS = {
    "shapes": ("Shapes", SHAPES + ROUNDS + PROCESSOR),
    "rivals": ("Slow rivals", RIVALS + ROUNDS + PROCESSOR),
    "steps": (steps.TITLE, STEPS),
    "lee": ("Figures of Lee", LEE + PROCESSOR),
    "operations": ("Operations", OPERATIONS + PROCESSOR),
    "file-operations": ("Operations on real files", FILE_OPERATIONS + PROCESSOR),
    "files": ("Real files", FILES + ROUNDS + PROCESSOR),
    "buildings": ("Buildings, file to file", BUILDINGS + PROCESSOR),
}


class Page:
    """The parts by title; those that are drawn up grow line by line, with the file they go to."""

    def __init__(self, options):
        self.path = options.write
        self.values = vars(options) | {"processor": processor(), "every_shape": families.SHAPES}
        there = self.path and self.path.exists()
        self.parts = sections(self.path.read_text(encoding="utf-8")) if there else {}

    def table(self, part, rows):
        title, head = PARTS[part]
        before = self.parts.get(title, "").splitlines()
        head = head.format(**self.values)
        made = []
        for cells in rows:
            print(" ".join(cells), file=sys.stderr, flush=True)
            made.append(f"| {' | '.join(cells)} |")
            self.parts[title] = head + "".join(f"{line}\n" for line in self.with_kept(made, before))
            if self.path:
                self.path.write_text(self.text(), encoding="utf-8")

    def with_kept(self, made, before):
        """The lines of a table, with those of shapes that are not drawn up anew, if they fit."""
        name = lambda line: line.split("|")[1].strip()
        shapes = self.values["every_shape"]
        if made[0] not in before or name(made[0]) != "shape":
            return made
        asked = self.values["shapes"]
        rows = [line for line in before if line.startswith("| ") and name(line) in shapes]
        rows = [line for line in rows if name(line) not in asked] + made[2:]
        return made[:2] + sorted(rows, key=lambda line: shapes.index(name(line)))

    def text(self):
        """The whole page."""
        titles = [title for title, _ in PARTS.values() if title in self.parts]
        return HEAD + "".join(f"\n## {title}\n\n{self.parts[title]}" for title in titles)


def sections(text):
    """The parts of a page by title."""
    pieces = re.split(r"^## (.*)\n+", text, flags=re.MULTILINE)
    return {title: part.rstrip() + "\n" for title, part in zip(pieces[1::2], pieces[2::2])}


def table(rows):
    """The lines of a table."""
    return "".join("| " + " | ".join(row) + " |\n" for row in rows)


def processor():
    """The processor that this is measured on."""
    model = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            names = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
        model = names[0] if names else model
    except OSError:
        pass
    return model
