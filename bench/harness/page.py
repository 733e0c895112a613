"""The page that the comparison draws up."""

import platform
import sys

from .build import PEERS
from .buildings import LAYER

HEAD = """# Benchmarks

`scripts/bench --data FOLDER --write docs/benchmarks.md` builds the programs of `bench/`, runs them by turns on the same polygons and draws up this page; `--quick` is shorter, `--shapes`, `--sizes`, `--rivals` and `--parts` choose.
Times are medians of the processor time of one thread, in microseconds an edge; reading the input is not counted.
Each process repeats its work for half a second, and three times at least unless that takes more than six seconds; the allocator of all of them is told to keep what they free (`GLIBC_TUNABLES`, in `bench/harness/run.py`).
A busy machine moves them; ratios move less, because all programs take turns.
"""

ROUNDS = """This page: up to {rounds} rounds; a program that has spent {budget} seconds on an input skips the rounds left, so large inputs of slow programs were run once or twice.
`> {limit} s` is a run that was stopped, or not begun because by its time an edge at the size before it would take half as much again, `crash` one that ended itself; larger sizes are not tried then, which `-` shows; where there is nothing, a program was not asked for that size.
"""

SHAPES = """
## Shapes

- *medial*: `Domain::from_polygons`, which validates, and `path_tracing`; *medial* is the sum, and *first* that of the first round of a process, which also fetches all its memory from the system. `bytes` is the growth of the peak of resident memory over both, an edge. `÷ at 1e4` is time an edge against that at 1e4 edges.
- *boost*, *boostvoronoi*: Boost.Polygon and its Rust port: `construct_voronoi` of the edges, and the walk that drops what lies outside. They give both sides of the boundary, medial the inside; in general position they find as many paths, but for those inside the holes, which count for Boost too.
- *cgal*: the same with CGAL's segment Delaunay graph, exact predicates, points sorted in space. It gives both sides.
- *delaunator*, *spade*, *spade-cdt*: no axis at all, but the Delaunay triangulation of the corners, the last one constrained to the edges: what a fast geometric algorithm on as many points costs.

Coordinates are whole numbers of 31 bits, but for `ngon` and `ellipse`, which are plain doubles; Boost and its port get those rounded, and so another polygon.
`star` has corners at equal angles and random distances, `koch` is a fractal coast with jittered thirds and heights, `maze` the outline of a random maze with jittered corners and `rmaze` without jitter, `comb` has equal teeth and `stair` equal steps, both parallel to the axes, `holes` and `holes3` are squares with a lattice of jittered holes of 12 and 3 corners, `lattice` one of equal squares, `ngon` is a regular polygon and `rngon` the same in whole numbers, `slivers` has long thin spikes around a disk, `spiral` is a corridor.

"""

FILES = """
## Real files

Whole layers, each feature a domain of its own; columns as above, *as given* is medial on the coordinates of the file.
All others get whole numbers: each feature enlarged by a power of two, and shifted, to fill 31 bits, and rounded.
Features that bound no domain are left out, and so are those where, after rounding, edges meet elsewhere than at ends, which Boost cannot take.

"""

BUILDINGS = """
## Buildings, file to file

The buildings of `{layer}`, GeoJSON to GeoJSON, whole processes with start, reading and writing.
medial writes every path of the exact axis with its radii and governors; the other two write approximate centerlines, which are much less.
`pygeoops.centerline` with its default options drops short branches and simplifies; SFCGAL's approximate medial axis is a part of the straight skeleton.
Both run in Python ({peers}); ratios are to the first line.

""".format(layer=LAYER, peers=", ".join(PEERS))


class Page:
    """Text that grows line by line, and the file it goes to."""

    def __init__(self, options):
        self.path = options.write
        self.text = HEAD + ROUNDS.format(**vars(options)) + machine()

    def table(self, head, rows):
        self.text += head
        for cells in rows:
            print(" ".join(cells), file=sys.stderr, flush=True)
            self.text += f"| {' | '.join(cells)} |\n"
            if self.path:
                self.path.write_text(self.text, encoding="utf-8")


def machine():
    """One sentence on where this was measured."""
    model = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            names = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
        model = names[0] if names else model
    except OSError:
        pass
    return f"Processor: {model}.\n"
