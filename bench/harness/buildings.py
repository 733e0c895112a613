"""Compares the command with packages of pip, file to file, on buildings."""

import json
import statistics

from . import BENCH
from .run import Unfinished, run, short

LAYER = "tiles/mvt-fixtures-sanfrancisco.geojson"

# Runs of a peer take long, and it is they that have the limit; seconds.
LIMIT = 600


def rows(medial, python, options, scratch):
    """Yields the lines of the table as they are ready."""
    yield ["program", "buildings", "clock, s", "processor, s", "clock ÷ medial",
           "processor ÷ medial"]
    yield ["---"] + ["--:"] * 5
    source = scratch / "buildings.geojson"
    total = extract(options.data / LAYER, source)
    out = lambda name: scratch / name
    axis = [medial, "axis", "-q", source, "-o"]
    programs = {
        "medial axis -o axes.geojson": [*axis, out("axes.geojson")],
        "medial axis -o axes.wkb": [*axis, out("axes.wkb")],
        "medial axis --threads 1 -o axes.geojson": [*axis, out("one.geojson"), "--threads", "1"],
        "pygeoops.centerline": [python, BENCH / "pygeoops_centerline.py", source, out("p.geojson")],
        "SFCGAL approximate_medial_axis":
            [python, BENCH / "sfcgal_axis.py", source, out("s.geojson")],
    }
    taken = {name: [] for name in programs}
    failed = {}
    for _ in range(options.rounds):
        for name, words in programs.items():
            if name in failed or sum(t[2] for t in taken[name]) > 3 * options.budget:
                continue
            try:
                taken[name].append(run(words, LIMIT))
            except Unfinished as reason:
                failed[name] = reason
    medians = {
        name: [statistics.median(t[k] for t in times) for k in (1, 2)]
        for name, times in taken.items() if name not in failed
    }
    ours = medians.get(next(iter(programs)))
    for name in programs:
        if name in failed:
            yield [name, "", str(failed[name]), "", "", ""]
            continue
        done = (taken[name][0][0].split() or [total])[-1]
        ratios = [short(a / b) if ours else "" for a, b in zip(medians[name], ours or (1, 1))]
        yield [name, f"{int(done):,}", *(short(t) for t in medians[name]), *ratios]


def extract(path, to):
    """Writes the buildings of the layer; gives their number."""
    features = json.loads(path.read_text(encoding="utf-8"))["features"]
    features = [f for f in features if f["properties"]["layer"] == "building"]
    collection = {"type": "FeatureCollection", "features": features}
    to.write_text(json.dumps(collection), encoding="utf-8")
    return len(features)
