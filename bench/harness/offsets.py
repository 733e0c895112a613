"""Compares offsets with the buffers of other libraries: areas on real polygons, times on a coast."""

import json
import math
import statistics

from . import BENCH
from .run import run, short

FILE = "tiles/mvt-fixtures-sanfrancisco.geojson"

# Pinned, so that the page can be drawn up again.
PEERS = ["shapely==2.1.2"]

POLYGONS = 1000

# As shares of the shorter side of the box of a polygon; inward if positive.
DISTANCES = [0.05, 0.15, 0.3, -0.2, -1.0]

LIMIT = 1200

# How far GEOS may move a line before it buffers it, as a share of the distance.
SIMPLIFIED = 0.01

# The coast, and how many offsets of it each takes.
SHAPE, EDGES, OURS, THEIRS, ROUNDS = "koch", 100_000, 100, 10, 3


def areas(commands, python, options, scratch):
    """Yields the lines of the table of areas."""
    yield ["distance", "peer", "median", "99 of 100", "largest", "explained, largest", "beyond that"]
    yield ["--:", "---"] + ["--:"] * 5
    polygons = list(read(options.data / FILE))
    polygons = polygons[:: len(polygons) // POLYGONS][:POLYGONS]
    path = scratch / "polygons.txt"
    for share in DISTANCES:
        ours, theirs = [], {"i_overlay": [], "Shapely": []}
        # Polygons of one size are done in one go, at the distance of that size.
        for size in sorted({bucket(polygon) for polygon in polygons}):
            chosen = [polygon for polygon in polygons if bucket(polygon) == size]
            path.write_text("".join(map(text, chosen)), encoding="utf-8")
            distance = repr(share * size)
            ask = lambda words: json.loads(piped([*words, distance], path))
            found = ask([*commands["medial"], "offsets"])
            ours += [tuple(k[0] for k in row) for row in zip(found["areas"], found["sectors"], found["lengths"])]
            found = ask([*commands["i_overlay"], "i_overlay"])
            theirs["i_overlay"] += [(a[0], found["angle"], 0.0) for a in found["areas"]]
            found = ask([python, BENCH / "offsets_peer.py"])
            angle = 0.5 * math.pi / found["quarter"]
            theirs["Shapely"] += [(a[0], angle, SIMPLIFIED * abs(share * size)) for a in found["areas"]]
        for peer, rows in theirs.items():
            off, explained, beyond = [], [], 0
            for (area, sectors, length), (other, angle, moved) in zip(ours, rows):
                scale = max(area, other)
                if scale == 0.0:
                    continue
                # Chords of arcs leave out so much of their sectors; a short arc may be one chord.
                known = sectors * (1.0 - math.sin(2.0 * angle) / (2.0 * angle)) / scale
                known += moved * length / scale
                off.append(abs(area - other) / scale)
                explained.append(known)
                beyond += off[-1] > known + 1e-9
            order = sorted(off)
            told = [statistics.median(order), order[int(0.99 * len(order))], order[-1], max(explained)]
            yield [short(share), peer, *(f"{value:.1e}" for value in told), f"{beyond} of {len(off)}"]


def times(commands, python, options, scratch):
    """Yields the lines of the table of times."""
    yield ["program", "offsets", "seconds", "an offset, s"]
    yield ["---"] + ["--:"] * 3
    path = scratch / "coast.txt"
    with open(path, "w", encoding="utf-8") as file:
        run([*commands["medial"], "draw", SHAPE, str(EDGES)], LIMIT, stdout=file)
    most = largest(path)
    distances = lambda n: ",".join(repr(most * (k + 0.5) / n) for k in range(n))
    ours, theirs = [], []
    for _ in range(ROUNDS):
        ask = lambda words, n: json.loads(piped([*words, distances(n)], path))["seconds"]
        ours.append(ask([*commands["medial"], "offsets"], OURS))
        theirs.append(ask([python, BENCH / "offsets_peer.py"], THEIRS))
    ours, theirs = statistics.median(ours), statistics.median(theirs)
    yield ["medial: domain, axis and offsets", str(OURS), short(ours), short(ours / OURS)]
    yield ["Shapely (GEOS)", str(THEIRS), short(theirs), short(theirs / THEIRS)]
    yield [f"{THEIRS} of Shapely ÷ {OURS} of medial", "", short(theirs / ours), ""]


def piped(words, path):
    with open(path, encoding="utf-8") as file:
        return run(words, LIMIT, stdin=file)[0]


def largest(path):
    """About the radius of the largest disk in the coast: a fifth of its box."""
    rows = [line.split() for line in path.read_text(encoding="utf-8").splitlines() if " " in line]
    xs = [float(x) for x, _ in rows]
    return 0.2 * (max(xs) - min(xs))


def bucket(polygon):
    """The shorter side of the box, to a power of √2."""
    xs, ys = zip(*polygon[0][0])
    side = min(max(xs) - min(xs), max(ys) - min(ys))
    return 2.0 ** (round(2.0 * math.log2(side)) / 2.0)


def read(path):
    """The polygons of a file, each a list of polygons without closing points."""
    for feature in json.loads(path.read_text(encoding="utf-8"))["features"]:
        geometry = feature["geometry"] or {"type": None}
        kinds = {"Polygon": lambda c: [c], "MultiPolygon": lambda c: c}
        if geometry["type"] in kinds:
            polygons = kinds[geometry["type"]](geometry["coordinates"])
            if all(len(ring) > 3 for rings in polygons for ring in rings):
                yield [[[tuple(p[:2]) for p in ring[:-1]] for ring in rings] for rings in polygons]


def text(polygons):
    lines = ["feature"]
    for rings in polygons:
        lines.append("polygon")
        for ring in rings:
            lines.append("ring")
            lines += [f"{x!r} {y!r}" for x, y in ring]
    return "\n".join(lines) + "\n"
