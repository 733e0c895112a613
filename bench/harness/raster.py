"""Compares the raster transform with thinning and medial axes of other libraries on images."""

import json

from . import BENCH
from .run import Unfinished, run, short

# Pinned, so that the page can be drawn up again.
PEERS = ["scikit-image==0.26.0", "opencv-contrib-python-headless==5.0.0.93", "shapely==2.2.0",
         "imageio==2.38.1"]

# Seconds of processor time for one run.
LIMIT = 120

# Sides of the squares that are timed, in pixels.
SIDES = [512, 1024, 2048, 4096]

SHAPES = ["horse", "blobs", "page"]

# Images too large to be held as numbers, and their side.
LARGE = ["horse", "page"]
LARGE_SIDE = 20_000

OURS = "medial raster_transform"

RIVALS = ["skimage medial_axis", "skimage skeletonize", "skimage skeletonize lee", "skimage thin",
          "opencv zhang_suen", "opencv guo_hall", "skeletonize (Rust)"]

# Images whose cells are judged, by folder.
FOLDERS = ["mpeg7", "masks", "scans"]


def timings(programs, python, folder, data, options):
    """Yields the lines of the table of times, in nanoseconds a pixel."""
    names = [OURS, *options.rivals]
    yield ["shape", "megapixels", "filled", *names, "bytes a pixel", "skimage medial_axis ÷ medial"]
    yield ["---"] + ["--:"] * (len(names) + 4)
    for shape in options.shapes:
        for side in options.sides:
            image = folder / f"{shape}_{side}.pbm"
            words = [python, BENCH / "raster_images.py", shape, side, data / "images", image]
            filled = float(run(list(map(str, words)), LIMIT)[0])
            found = {name: [] for name in names}
            failed, memory = {}, ""
            for _ in range(options.rounds):
                for name in names:
                    if name in failed:
                        continue
                    try:
                        told = json.loads(run(command(name, programs, python, image), LIMIT)[0])
                    except Unfinished as reason:
                        failed[name] = str(reason)
                        continue
                    if name == OURS:
                        memory = short(told["bytes"], 2)
                        told["ns"] = told["cells_ns"] + told["axis_ns"]
                    found[name].append(told["ns"])
            least = {name: min(times) for name, times in found.items() if times}
            cells = [failed.get(name) or short(least[name]) for name in names]
            ratio = ""
            if OURS in least and RIVALS[0] in least:
                ratio = short(least[RIVALS[0]] / least[OURS], 2)
            yield [shape, short(side * side / 1e6, 2), f"{filled:.0%}", *cells, memory, ratio]


def command(name, programs, python, image):
    """The words that time a program on an image."""
    if name == OURS:
        return [str(programs["bench"]), "raster", str(image)]
    if name == RIVALS[-1]:
        return [str(programs["rivals"]), "raster", str(image)]
    return [str(python), str(BENCH / "raster_peers.py"), name, str(image)]


def bands(programs, python, folder, data):
    """Yields the lines of the table of large images, one run each."""
    yield ["image", "megapixels", "filled", "rows of a band", "read, s", "engine, s", "write, s",
           "peak of memory, MB", "bytes a pixel"]
    yield ["---"] + ["--:"] * 8
    for shape in LARGE:
        image = folder / f"{shape}.png"
        words = [python, BENCH / "raster_images.py", shape, LARGE_SIDE, data / "images", image]
        filled = float(run(list(map(str, words)), 600)[0])
        # All rows at once for comparison.
        for rows in [None, LARGE_SIDE]:
            told = folder / "timings.json"
            words = [programs["medial"], "axis", image, "--by", "branch", "-o", folder / "axis.csv",
                     "--threads", 1, "--progress", "never", "-q", "--timings", told]
            words += ["--band-rows", rows] if rows else []
            run(list(map(str, words)), 900)
            told = json.loads(told.read_text())
            pixels = LARGE_SIDE * LARGE_SIDE
            yield [shape, short(pixels / 1e6, 3), f"{filled:.0%}", f"{rows:,}" if rows else "usual",
                   *(short(told[stage], 2) for stage in ["read", "engine", "write"]),
                   f"{told['peak_bytes'] / 1e6:,.0f}", short(told["peak_bytes"] / pixels, 2)]


def quality(programs, python, folder, data):
    """Yields the lines of the table of quality."""
    yield ["images", "number", "components off", "holes off", "removable blocks", "cells of the shape",
           "IoU mean", "IoU least", "IoU without pruning, least", "distance from the exact axis, px",
           "drift when turned by 30°, px"]
    yield ["---"] + ["--:"] * 10
    everything = []
    for kind in FOLDERS:
        files = sorted((data / "images" / kind).glob("*.png"))
        words = [python, BENCH / "raster_quality.py", programs["bench"], programs["medial"], folder, *files]
        lines = run(list(map(str, words)), 3600)[0].splitlines()
        found = [json.loads(line) for line in lines]
        everything += found
        yield row(kind, found)
    yield row("**all**", everything)


def inverses(programs, python, folder, data):
    """Yields the lines of the table of inversion."""
    yield ["engine", "silhouettes", "IoU mean", "IoU least", "distance, mean px", "distance, most px",
           "points a cell of the shape", "medial cells found again"]
    yield ["---"] + ["--:"] * 7
    files = sorted((data / "images" / "mpeg7").glob("*.png"))
    words = [python, BENCH / "raster_quality.py", "masks", folder, *files]
    masks = run(list(map(str, words)), LIMIT)[0].splitlines()
    found = {}
    for line in run([str(programs["bench"]), "inverse", *masks], 3600)[0].splitlines():
        name, share, distance, points, again = line.split("\t")
        found.setdefault(name, []).append((float(share), float(distance), float(points), again and float(again)))
    for name, of in found.items():
        shares, distances, points, again = zip(*of)
        mean = lambda values: sum(values) / len(of)
        yield [name, str(len(of)), f"{mean(shares):.4f}", f"{min(shares):.4f}", f"{mean(distances):.2f}",
               f"{max(distances):.2f}", f"{mean(points):.1%}", "" if "" in again else f"{mean(again):.1%}"]


def row(kind, found):
    """What was found for some images."""
    mean = lambda key: [f[key] for f in found if f.get(key) is not None]
    average = lambda key: sum(mean(key)) / max(1, len(mean(key)))
    total = lambda key: str(sum(mean(key)))
    return [kind, str(len(found)), total("components"), total("holes"), total("blocks"),
            f"{average('cells'):.1%}", f"{average('iou'):.4f}", f"{min(mean('iou')):.4f}",
            f"{min(mean('iou_none')):.4f}", f"{average('centred'):.3f}", f"{average('drift'):.3f}"]

