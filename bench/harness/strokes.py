"""Compares centerlines with the published medians of the strokes of Chinese characters."""

import json
import re

from . import BENCH
from .run import run, short

FILE = "strokes/hanzi_dev_150.json"

# Pinned, so that the page can be drawn up again.
PEERS = ["pygeoops==0.6.0", "scikit-image==0.26.0"]

# Runs of a peer take long; seconds.
LIMIT = 1200

# Pieces with which each curve of an outline is drawn.
PIECES = 16

# Our options: the ends that a chord of 16 across a corner makes out.
OPTIONS = ["--prune", "half_chord=8"]

OURS = ["medial centerline " + " ".join(OPTIONS), "medial centerline"]

# What is told of each program; see `bench/strokes_distance.py`.
FIGURES = ["inner", "points", "there", "back"]


def rows(medial, python, options, scratch):
    """Yields the lines of the table, the last one with what of the goal is reached."""
    yield ["program", "lines", "points between the ends", "all points", "median to line",
           "line to median", "both ways", "processor, s"]
    yield ["---"] + ["--:"] * 7
    outlines, medians = scratch / "outlines.geojson", scratch / "medians.geojson"
    strokes = read(options.data / FILE)
    collect(outlines, strokes, lambda ring, _: ("Polygon", [[*ring, ring[0]]]))
    collect(medians, strokes, lambda _, median: ("LineString", median))
    peer = lambda name: [python, BENCH / "strokes_peers.py", name, outlines]
    ours = [medial, "centerline", "-q", outlines]
    programs = {
        OURS[0]: [*ours, *OPTIONS, "-o"],
        OURS[1]: [*ours, "-o"],
        "skimage.morphology.skeletonize": peer("skimage"),
        "pygeoops.centerline": peer("pygeoops"),
        "pygeoops.centerline, extend=True": peer("pygeoops_extended"),
    }
    times, files = {}, []
    # Status 3 says that some outlines cross themselves.
    start = lambda words: run(words, LIMIT, allowed=(0, 3))[2]
    for k, (name, words) in enumerate(programs.items()):
        target = scratch / f"{k}.geojson"
        times[name] = start([*words, target])
        files.append(f"{name}={target}")
    axes = scratch / "axes.wkt"
    start([medial, "axis", "-q", outlines, "-o", axes])
    words = [python, BENCH / "strokes_distance.py", outlines, medians, axes, *files]
    figures = json.loads(run(words, LIMIT)[0])
    for found in figures.values():
        found["both"] = 0.5 * (found["there"] + found["back"])
    columns = [*FIGURES, "both"]
    for name in programs:
        found = figures[name]
        cells = [short(found[key]) for key in columns]
        yield [name, f"{found['found']:,}", *cells, short(times[name])]
    axis = [short(figures["axis"][key]) for key in FIGURES[:3]]
    yield ["the whole exact axis, with all branches", "", *axis, "", "", ""]
    rivals = [figures[name] for name in programs if name not in OURS]
    ratios = [figures[OURS[0]][key] / min(found[key] for found in rivals) for key in columns]
    yield ["the first line ÷ the best of the other programs", "",
           *(short(ratio, 2) for ratio in ratios), ""]


def read(path):
    """The ring of each stroke, flattened, and its published median, by name."""
    found = {}
    for character, entry in json.loads(path.read_text(encoding="utf-8")).items():
        for k, (outline, median) in enumerate(zip(entry["strokes"], entry["medians"])):
            found[f"{character} {k}"] = (flattened(outline), median)
    return found


def collect(path, strokes, geometry):
    """Writes something of each stroke as GeoJSON."""
    features = []
    for name, stroke in strokes.items():
        kind, coordinates = geometry(*stroke)
        shape = {"type": kind, "coordinates": coordinates}
        features.append({"type": "Feature", "id": name, "properties": {}, "geometry": shape})
    collection = {"type": "FeatureCollection", "features": features}
    path.write_text(json.dumps(collection), encoding="utf-8")


def flattened(path):
    """The ring of a path of SVG in one part, of the verbs M, L, Q, C and Z."""
    words = re.findall(r"[A-Za-z]|-?[\d.]+", path)
    ring = []
    while words:
        verb = words.pop(0)
        n = {"M": 1, "L": 1, "Q": 2, "C": 3, "Z": 0}[verb]
        points = [(float(words.pop(0)), float(words.pop(0))) for _ in range(n)]
        if n == 1:
            ring += points
        elif n > 1:
            control = [ring[-1], *points]
            ring += [bezier(control, k / PIECES) for k in range(1, PIECES + 1)]
    # A point that is there twice says nothing.
    return [p for k, p in enumerate(ring) if p != ring[k - 1]]


def bezier(points, u):
    while len(points) > 1:
        points = [
            (a[0] + (b[0] - a[0]) * u, a[1] + (b[1] - a[1]) * u)
            for a, b in zip(points, points[1:])
        ]
    return points[0]
