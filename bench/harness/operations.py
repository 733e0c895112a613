"""Times operations on axes, beside the engine that made them."""

from .run import Result, by_turns, run, short

SHAPES = ["star", "koch", "maze", "comb", "holes"]

# What `medial-bench operation` knows.
OPERATIONS = [
    "hierarchy", "significance", "prune", "smooth", "branches", "reconstruct", "outline", "centerline",
]

# The size to which time an edge is compared.
BASE = 10_000


def rows(commands, options, scratch):
    """Yields the lines of the table as they are ready."""
    yield ["shape", "edges", "engine", *OPERATIONS, "all but the first two ÷ engine", "÷ at 1e4"]
    yield ["---"] + ["--:"] * (len(OPERATIONS) + 4)
    for shape in [shape for shape in SHAPES if shape in options.shapes]:
        base = None
        for size in [size for size in options.sizes if size >= BASE]:
            path = scratch / "operations.txt"
            with open(path, "w", encoding="utf-8") as file:
                run([*commands["medial"], "draw", shape, str(size)], options.limit, stdout=file)
            turns = {name: ([*commands["medial"], "operation", name], path) for name in OPERATIONS}
            results = by_turns(turns, options.rounds, options.limit, options.budget)
            good = [result for result in results.values() if isinstance(result, Result)]
            if not good:
                yield [shape, f"{size:,}"] + [str(result) for result in results.values()]
                continue
            edges = good[0].edges
            engine = sorted(result.first for result in good)[len(good) // 2] / edges
            cells = [shape, f"{edges:,}", short(engine / 1e3)]
            for result in results.values():
                told = isinstance(result, Result)
                cells.append(short(result.second / edges / 1e3) if told else str(result))
            # The first two are parts of the others.
            whole = [results[name] for name in OPERATIONS[2:]]
            if all(isinstance(result, Result) for result in whole):
                each = sum(result.second for result in whole) / edges
                base = each if size == BASE else base
                cells.append(short(each / engine, 2))
                cells.append(f"{each / base:.2f}" if base and size > BASE else "")
            yield cells
