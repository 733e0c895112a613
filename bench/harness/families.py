"""Compares the programs on drawn shapes."""

import sys

from .run import Result, Unfinished, by_turns, microseconds, ratio, run, short

SHAPES = [
    "star", "koch", "maze", "rmaze", "comb", "stair", "holes", "holes3", "lattice", "ngon",
    "rngon", "ellipse", "slivers", "spiral",
]

# The size to which time an edge is compared.
BASE = 10_000

# The engine that is timed beside the default one.
OTHER = "divide_and_conquer"

# What each engine takes for both sides.
BOTH = ["both", "both_other"]

# Rivals with a table of their own: most of them take minutes where medial takes a second.
SLOW = ["cgal", "boostvoronoi", "spade", "spade-cdt"]

# How many times the limit a program must be expected to take, by its time an edge at the size before,
# not to be run.
HOPELESS = 1.5


def rows(commands, rivals, options, scratch):
    """Yields the lines of the table as they are ready."""
    heads = ["shape", "edges", "validation", "engine", "medial", "first", "bytes", "paths"]
    heads += ["boost", "its paths"] if "boost" in rivals else []
    heads += ["delaunator"] if "delaunator" in rivals else []
    heads += ["boost ÷ medial"] if "boost" in rivals else []
    heads += ["medial ÷ delaunator"] if "delaunator" in rivals else []
    heads += ["÷ at 1e4", OTHER]
    heads += [f"boost ÷ {OTHER}"] if "boost" in rivals else []
    heads += [f"both sides, {OTHER} ÷ path_tracing"]
    yield heads
    yield ["---"] + ["--:"] * (len(heads) - 1)
    bases = {}
    for shape, size, results in compared(commands, [OTHER, *BOTH, *rivals], options, scratch):
        ours, other = results["medial"], results[OTHER]
        cells = [shape, f"{size:,}", "", "", str(ours), "", "", ""]
        far = ""
        if isinstance(ours, Result):
            each = ours.time / ours.edges
            if size == BASE:
                bases[shape] = each
            base = bases.get(shape)
            far = f"{each / base:.2f}" if base and size > BASE else ""
            stages = [short(time / ours.edges / 1e3) for time in (ours.first, ours.second)]
            # Small shapes fit into what the process has already.
            growth = f"{ours.growth / ours.edges:.0f}" if size >= BASE else ""
            cold = short(ours.cold / ours.edges / 1e3)
            cells = [shape, f"{ours.edges:,}", *stages, microseconds(ours), cold, growth]
            cells.append(f"{ours.found:,}")
        if "boost" in rivals:
            boost = results["boost"]
            found = f"{boost.found:,}" if isinstance(boost, Result) else ""
            cells += [microseconds(boost), found]
        cells += [microseconds(results["delaunator"])] if "delaunator" in rivals else []
        cells += [ratio(results["boost"], ours)] if "boost" in rivals else []
        cells += [ratio(ours, results["delaunator"])] if "delaunator" in rivals else []
        engine = isinstance(other, Result) and short(other.second / other.edges / 1e3)
        cells += [far, engine or str(other)]
        cells += [ratio(results["boost"], other)] if "boost" in rivals else []
        first, second = (results[name] for name in BOTH)
        both = isinstance(first, Result) and isinstance(second, Result)
        yield cells + [f"{second.second / first.second:.2f}" if both else ""]


def slow_rows(commands, rivals, options, scratch):
    """Yields the lines of the table of the slow rivals, medial measured among them."""
    heads = ["shape", "edges", "medial", *rivals]
    yield heads
    yield ["---"] + ["--:"] * (len(heads) - 1)
    for shape, size, results in compared(commands, rivals, options, scratch):
        edges = [result.edges for result in results.values() if isinstance(result, Result)]
        cells = [shape, f"{edges[0] if edges else size:,}"]
        yield cells + [microseconds(results[name]) for name in ["medial", *rivals]]


def compared(commands, rivals, options, scratch):
    """Yields each shape and size with its results by program."""
    for shape in options.shapes:
        slow = {}
        for size in sorted(options.sizes):
            yield shape, size, compare(commands, rivals, options, scratch, shape, size, slow)


def compare(commands, rivals, options, scratch, shape, size, slow):
    """The results on one shape by program.

    `slow` holds those that failed at a smaller size, or will take far longer than the limit at the
    next one; it is added to.
    """
    path = scratch / "shape.txt"
    with open(path, "w", encoding="utf-8") as file:
        run([*commands["medial"], "draw", shape, str(size)], 600, stdout=file)
    turns = {"medial": ([*commands["medial"], "time"], path)}
    turns |= {name: (commands[name], path) for name in rivals}
    if options.slow_up_to and size > options.slow_up_to:
        for name in SLOW:
            slow.setdefault(name, Unfinished(""))
    turns = {name: turn for name, turn in turns.items() if name not in slow}
    results = by_turns(turns, options.rounds, options.limit, options.budget)
    for name, result in results.items():
        larger = min((s for s in options.sizes if s > size), default=0)
        if not isinstance(result, Result):
            slow[name] = Unfinished("-")
        elif result.time / result.edges * larger > HOPELESS * options.limit * 1e9:
            slow[name] = Unfinished(f"> {options.limit} s")
    edges = {result.edges for result in results.values() if isinstance(result, Result)}
    if len(edges) > 1:
        sys.exit(f"error: {shape} {size}: the programs read different polygons")
    return {name: results.get(name) or slow[name] for name in ["medial", *rivals]}
