"""Compares `medial segment` with segmentations of other libraries on pictures."""

import json

from . import BENCH
from .page import table
from .run import Unfinished, run, short

# Seconds of processor time for one run.
LIMIT = 300

# Pinned, so that the page can be drawn up again.
PEERS = ["scikit-image==0.26.0", "opencv-contrib-python-headless==5.0.0.93", "imageio==2.38.1",
         "tifffile==2026.3.3", "imagecodecs==2026.3.6", "scipy==1.17.1"]

# Pictures of FOLDER/images.
IMAGES = ["maps/nypl_insurance_atlas.png", "satellite/rmnp-rgb.tif", "satellite/Miriam.A2012270.2050.2km.jpg",
          "colour/coffee.png", "colour/opencv_fruits.jpg"]

# What our command is told, by name.
OURS = {
    "feature_space": ["--method", "feature_space"],
    "feature_space over": ["--method", "feature_space", "--resolution", "over"],
    "mean_shift": ["--method", "mean_shift"],
}

RIVALS = {"felzenszwalb": "felzenszwalb", "quickshift": "quickshift", "slic": "SLIC", "opencv": "OpenCV mean shift"}

# Those whose boundaries all are compared with.
OTHERS = ["feature_space", "mean_shift", "felzenszwalb", "quickshift", "opencv"]

HEAD = """# Segmentation, measured

`scripts/segmentation --write docs/segmentation.md FOLDER` draws up this page from FOLDER/images, which is no part of this repository.
Processor: {processor}.

`feature_space` is the analysis of the colours of the whole image [CM97] with its class *undersegmentation*, *over* with *oversegmentation*; `mean_shift` that of place and colour together [CM02] with its defaults, 7 pixels, 6.5 units, regions of 20 pixels.
*felzenszwalb* (scale 100, sigma 0.5, regions of 50 pixels), *quickshift* (kernel 3, distance 6) and *SLIC* (400 regions) are those of scikit-image; *OpenCV mean shift* is `pyrMeanShiftFiltering` (7, 6.5, one level), which gives no regions: each connected set of pixels of one colour is counted as one.

- *ns a pixel*: one thread, without reading and writing, the least of {rounds} rounds by turns.
- *explained*: the share of the variance of the colours that the mean colours of the regions have.
- *boundary*: the share of pixels that differ from the one to the right or below.
- The last columns tell how well boundaries agree: the harmonic mean of the shares of either boundary that is at most 2 pixels from the other one.

"""


def page(program, python, folder, data, processor, rounds):
    """The page."""
    text = HEAD.format(processor=processor, rounds=rounds)
    for image in IMAGES:
        text += f"## {image.rsplit('/', 1)[-1]}\n\n"
        text += table(rows(program, python, folder, data / "images" / image, rounds)) + "\n"
    return text.rstrip() + "\n"


def rows(program, python, folder, image, rounds):
    """The lines of the table of one picture."""
    times, files, failed, pixels = {}, {}, {}, 1
    for _ in range(rounds):
        for name, words in OURS.items():
            told, labels = folder / "timings.json", folder / f"{name}.tiff"
            run(list(map(str, [program, "segment", image, *words, "--threads", 1, "--timings", told,
                               "--labels", labels, "--to", "csv", "-q"])), LIMIT)
            seconds = json.loads(told.read_text(encoding="utf-8"))["engine"]
            times[name], files[name] = min(seconds, times.get(name, seconds)), labels
        for name in RIVALS:
            if name in failed:
                continue
            labels = folder / f"{name}.npy"
            words = [python, BENCH / "segmentation_peers.py", name, image, labels]
            try:
                told = json.loads(run(list(map(str, words)), LIMIT)[0])
            except Unfinished as reason:
                failed[name] = str(reason)
                continue
            seconds, pixels = told["seconds"], told["pixels"]
            times[name], files[name] = min(seconds, times.get(name, seconds)), labels
    pairs = [f"{name}={path}" for name, path in files.items()]
    words = [python, BENCH / "segmentation_peers.py", "compare", image, *pairs]
    found = json.loads(run(list(map(str, words)), LIMIT)[0])
    heads = [RIVALS.get(name, name) for name in OTHERS]
    yield ["method", "regions", "ns a pixel", "explained", "boundary", *heads]
    yield ["---"] + ["--:"] * (4 + len(heads))
    for name in [*OURS, *RIVALS]:
        title = RIVALS.get(name, f"medial `{name}`")
        if name in failed:
            yield [title, failed[name], *[""] * (3 + len(heads))]
            continue
        one = found[name]
        cells = [f"{one['agreement'][other]:.2f}" if other in one["agreement"] else "" for other in OTHERS]
        yield [title, f"{one['regions']:,}", short(1e9 * times[name] / pixels), f"{one['explained']:.3f}",
               f"{one['boundary']:.3f}", *cells]
