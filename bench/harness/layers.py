"""Compares the programs on files of polygons."""

import pathlib

from .run import Result, by_turns, microseconds, ratio, run

# Files with fewer edges are taken together.
SMALL = 2_000

SUFFIXES = (".geojson", ".geojsonl", ".wkt", ".json")


def rows(commands, rivals, options, scratch):
    """Yields the lines of the table as they are ready."""
    heads = ["file", "features", "no domain", "not for Boost", "edges", "medial", "as given"]
    heads += rivals
    heads += ["boost ÷ medial"] if "boost" in rivals else []
    heads += ["medial ÷ delaunator"] if "delaunator" in rivals else []
    yield heads
    yield ["---"] + ["--:"] * (len(heads) - 1)
    for name, files in groups(commands, options.data):
        counts, rounded, given = prepare(commands, files, scratch)
        time = [*commands["medial"], "time"]
        turns = {"medial": (time, rounded), "as given": (time, given)}
        turns |= {rival: (commands[rival], rounded) for rival in rivals}
        results = by_turns(turns, options.rounds, options.limit, options.budget)
        ours = results["medial"]
        edges = ours.edges if isinstance(ours, Result) else None
        cells = [name, *(f"{n:,}" for n in counts), f"{edges:,}" if edges else ""]
        cells += [microseconds(result, edges) for result in results.values()]
        cells += [ratio(results["boost"], ours)] if "boost" in rivals else []
        cells += [ratio(ours, results["delaunator"])] if "delaunator" in rivals else []
        yield cells


def groups(commands, folder):
    """Each large file, and at the end all small ones."""
    found = [p for part in ("gis", "tiles", "vlsi") for p in (folder / part).rglob("*")]
    found = sorted(p for p in [*found, *folder.glob("*.wkt")] if p.suffix in SUFFIXES)
    small = []
    for path in found:
        told, _, _ = run([*commands["layers"], "rounded", path], 600)
        edges = told.count("\n")
        if edges >= SMALL:
            yield path.relative_to(folder).as_posix(), [path]
        elif edges:
            small.append(path)
    if small:
        yield f"{len(small)} smaller files", small


def prepare(commands, files, scratch):
    """Writes the features rounded and as given; tells how many there are and were left out."""
    paths = []
    for way in ("rounded", "given"):
        path = pathlib.Path(scratch, f"{way}.txt")
        report = pathlib.Path(scratch, f"{way}.counts")
        words = ["sh", "-c", 'r=$1; shift; exec "$@" 2>"$r"', "sh", report]
        with open(path, "w", encoding="utf-8") as file:
            run([*words, *commands["layers"], way, *files], 600, stdout=file)
        paths.append(path)
    return [int(word) for word in report.read_text(encoding="utf-8").split()], *paths
