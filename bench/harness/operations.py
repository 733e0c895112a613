"""Times operations on axes, beside the engine that made them."""

from .run import Result, by_turns, run, short

SHAPES = ["star", "koch", "maze", "rmaze", "comb", "holes", "lattice", "ngon"]

# What `medial-bench operation` knows.
OPERATIONS = [
    "hierarchy", "significance", "prune", "smooth", "branches", "reconstruct", "outline", "centerline",
]

# All of these but the first two in one run.
TOGETHER = "together"

# The size to which time an edge is compared.
BASE = 10_000


def rows(commands, options, scratch):
    """Yields the lines of the table as they are ready."""
    ratios = ["sum ÷ engine", "all together ÷ engine", "all together ÷ axis", "sum ÷ at 1e4"]
    head = ["validation", "engine", *OPERATIONS, "sum", "all together", *ratios]
    yield ["shape", "edges", *head]
    yield ["---"] + ["--:"] * (len(head) + 1)
    for shape in [shape for shape in SHAPES if shape in options.shapes]:
        base = None
        for size in [size for size in options.sizes if size >= BASE]:
            path = scratch / "operations.txt"
            with open(path, "w", encoding="utf-8") as file:
                run([*commands["medial"], "draw", shape, str(size)], options.limit, stdout=file)
            names = [*OPERATIONS, TOGETHER]
            turns = {name: ([*commands["medial"], "operation", name], path) for name in names}
            turns["axis"] = ([*commands["medial"], "time"], path)
            results = by_turns(turns, options.rounds, options.limit, options.budget)
            if not all(isinstance(result, Result) for result in results.values()):
                yield [shape, f"{size:,}"] + [str(result) for result in results.values()
                                              if not isinstance(result, Result)]
                continue
            axis = results["axis"]
            # The first two are parts of the others.
            each = sum(results[name].second for name in OPERATIONS[2:])
            together = results[TOGETHER].second
            base = each / axis.edges if size == BASE else base
            times = [axis.first, axis.second, *(results[name].second for name in OPERATIONS)]
            cells = [short(time / axis.edges / 1e3) for time in [*times, each, together]]
            below = [(each, axis.second), (together, axis.second), (together, axis.time)]
            cells += [short(time / by, 2) for time, by in below]
            grows = base and size > BASE
            yield [shape, f"{axis.edges:,}", *cells,
                   f"{each / axis.edges / base:.2f}" if grows else ""]
