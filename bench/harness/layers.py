"""Compares the programs on files of polygons."""

import pathlib

from .families import OTHER
from .run import Result, by_turns, microseconds, ratio, run, short

# Files with fewer edges are taken together.
SMALL = 2_000

SUFFIXES = (".geojson", ".geojsonl", ".wkt", ".json")


def rows(commands, rivals, options, scratch):
    """Yields the lines of the table as they are ready."""
    heads = ["file", "features", "no domain", "not for Boost", "edges", "medial", "as given"]
    heads += rivals
    heads += ["boost ÷ medial"] if "boost" in rivals else []
    heads += ["medial ÷ delaunator"] if "delaunator" in rivals else []
    heads += [OTHER]
    heads += [f"boost ÷ {OTHER}"] if "boost" in rivals else []
    yield heads
    yield ["---"] + ["--:"] * (len(heads) - 1)
    total = Total(rivals)
    for name, files in groups(commands, options.data):
        counts, rounded, given = prepare(commands, files, scratch)
        time = [*commands["medial"], "time"]
        turns = {"medial": (time, rounded), "as given": (time, given)}
        turns |= {rival: (commands[rival], rounded) for rival in [*rivals, OTHER]}
        results = by_turns(turns, options.rounds, options.limit, options.budget)
        ours, other = results["medial"], results.pop(OTHER)
        edges = ours.edges if isinstance(ours, Result) else None
        cells = [name, *(f"{n:,}" for n in counts), f"{edges:,}" if edges else ""]
        cells += [microseconds(result, edges) for result in results.values()]
        cells += [ratio(results["boost"], ours)] if "boost" in rivals else []
        cells += [ratio(ours, results["delaunator"])] if "delaunator" in rivals else []
        cells += [microseconds(other, edges)]
        cells += [ratio(results["boost"], other)] if "boost" in rivals else []
        total.add(counts, edges, {**results, OTHER: other})
        yield cells
    yield total.cells()


class Total:
    """All files together: the sums of what is told of each."""

    def __init__(self, rivals):
        self.counts, self.edges, self.times = [0, 0, 0], 0, {}
        self.rivals = rivals

    def add(self, counts, edges, results):
        self.counts = [a + b for a, b in zip(self.counts, counts)]
        self.edges += edges or 0
        for name, result in results.items():
            known = self.times.get(name, 0.0)
            ended = known is not None and isinstance(result, Result)
            self.times[name] = known + result.time if ended else None

    def cells(self):
        def ratio_of(above, below):
            above, below = self.times.get(above), self.times.get(below)
            return short(above / below, 2) if above and below else ""

        def each(name):
            time = self.times.get(name)
            return short(time / self.edges / 1e3) if time else ""

        cells = ["**all**", *(f"{n:,}" for n in self.counts), f"{self.edges:,}"]
        cells += [each(name) for name in ["medial", "as given", *self.rivals]]
        cells += [ratio_of("boost", "medial")] if "boost" in self.rivals else []
        cells += [ratio_of("medial", "delaunator")] if "delaunator" in self.rivals else []
        cells += [each(OTHER)]
        return cells + ([ratio_of("boost", OTHER)] if "boost" in self.rivals else [])


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
