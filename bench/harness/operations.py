"""Times operations on axes, beside the engine that made them."""

from .layers import groups, prepare
from .run import Result, by_turns, run, short

SHAPES = ["star", "koch", "maze", "rmaze", "comb", "holes", "lattice", "ngon"]

# What `medial-bench operation` knows.
OPERATIONS = [
    "hierarchy", "significance", "prune", "smooth", "branches", "reconstruct", "outline", "centerline",
]

# All of these but the first two in one run.
TOGETHER = "together"

# What heads the times of one input.
TIMES = ["validation", "engine", *OPERATIONS, "sum", "all together",
         "sum ÷ engine", "all together ÷ engine", "all together ÷ axis"]

# The size to which time an edge is compared.
BASE = 10_000


def rows(commands, options, scratch):
    """Yields the lines of the table of drawn shapes as they are ready."""
    yield ["shape", "edges", *TIMES, "sum ÷ at 1e4"]
    yield ["---"] + ["--:"] * (len(TIMES) + 2)
    for shape in [shape for shape in SHAPES if shape in options.shapes]:
        base = None
        for size in [size for size in options.sizes if size >= BASE]:
            path = scratch / "operations.txt"
            with open(path, "w", encoding="utf-8") as file:
                run([*commands["medial"], "draw", shape, str(size)], options.limit, stdout=file)
            edges, each, cells = times(commands, options, path)
            if edges is None:
                yield [shape, f"{size:,}", *cells]
                continue
            base = each if size == BASE else base
            yield [shape, f"{edges:,}", *cells, f"{each / base:.2f}" if base and size > BASE else ""]


def file_rows(commands, options, scratch):
    """Yields the lines of the table of real files as they are ready."""
    yield ["file", "features", "edges", *TIMES]
    yield ["---"] + ["--:"] * (len(TIMES) + 2)
    for name, files in groups(commands, options.data):
        counts, _, path = prepare(commands, files, scratch)
        edges, _, cells = times(commands, options, path)
        yield [name, f"{counts[0]:,}", f"{edges:,}" if edges else "", *cells]


def times(commands, options, path):
    """The edges of the input in a file, the sum of all operations an edge, and the cells of its line."""
    turns = {name: ([*commands["medial"], "operation", name], path) for name in [*OPERATIONS, TOGETHER]}
    turns["axis"] = ([*commands["medial"], "time"], path)
    results = by_turns(turns, options.rounds, options.limit, options.budget)
    if not all(isinstance(result, Result) for result in results.values()):
        return None, None, [str(r) for r in results.values() if not isinstance(r, Result)]
    axis = results["axis"]
    # The first two are parts of the others.
    each = sum(results[name].second for name in OPERATIONS[2:])
    together = results[TOGETHER].second
    all_times = [axis.first, axis.second, *(results[name].second for name in OPERATIONS), each, together]
    cells = [short(time / axis.edges / 1e3) for time in all_times]
    below = [(each, axis.second), (together, axis.second), (together, axis.time)]
    cells += [short(time / by, 2) for time, by in below]
    return axis.edges, each / axis.edges, cells
