"""Times both engines on the polygons that the gallery draws for the figures of [Lee82], whole ones."""

from . import ROOT
from .run import Result, by_turns, run, short

FIGURES = [3, 7, 9, 10, 11]

# What the paper prints, in microseconds of processor time.
PAPER = {9: 569_000}


def rows(commands, options, scratch):
    """Yields the lines of the table as they are ready."""
    engines = ["path_tracing", "divide_and_conquer"]
    yield ["figure", "edges", "validation", *engines, "[Lee82]"]
    yield ["---"] + ["--:"] * 5
    for figure in FIGURES:
        source = ROOT / "fixtures" / "lee" / f"figure_{figure}.wkt"
        # One ring, which repeats its first corner: a comma to an edge.
        edges = source.read_text(encoding="utf-8").count(",")
        path = scratch / f"figure_{figure}.txt"
        with open(path, "w", encoding="utf-8") as file:
            run([*commands["layers"], "given", source], options.limit, stdout=file)
        turns = {name: ([*commands["medial"], "time", name], path) for name in engines}
        results = by_turns(turns, options.rounds, options.limit, options.budget)
        first = results[engines[0]]
        cells = [str(figure), f"{edges:,}"]
        cells.append(short(first.first / 1e3) if isinstance(first, Result) else "")
        for result in results.values():
            cells.append(short(result.second / 1e3) if isinstance(result, Result) else str(result))
        yield cells + [f"{PAPER[figure]:,}" if figure in PAPER else ""]
