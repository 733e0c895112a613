"""Segments a picture with other libraries, one thread, or compares segmentations; prints JSON.

usage: segmentation_peers.py NAME IMAGE LABELS.npy
       segmentation_peers.py compare IMAGE NAME=LABELS...

The first writes the labels and tells seconds; the second tells of each how many regions it has, how much of the
colours they explain, and how well its boundaries agree with those of each other one.
"""

import json
import os
import sys
import time

for name in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"]:
    os.environ[name] = "1"

import imageio.v3 as imageio  # noqa: E402
import numpy as np  # noqa: E402

# Boundaries agree up to this distance, in pixels.
NEAR = 2


def picture(path):
    """Red, green and blue in bytes."""
    image = np.asarray(imageio.imread(path))
    if image.ndim == 2:
        image = np.stack([image] * 3, axis=-1)
    return np.ascontiguousarray(image[..., :3])


def opencv(image):
    """Mean shift as OpenCV has it, and a region for each connected set of pixels of one colour."""
    import cv2
    from skimage import measure
    cv2.setNumThreads(1)
    filtered = cv2.pyrMeanShiftFiltering(image, 7, 6.5, maxLevel=0).astype(np.int64)
    return measure.label(filtered @ np.array([65536, 256, 1]) + 1, connectivity=1)


def work(name, image):
    from skimage import segmentation
    return {
        "felzenszwalb": lambda: segmentation.felzenszwalb(image, scale=100, sigma=0.5, min_size=50),
        "quickshift": lambda: segmentation.quickshift(image, kernel_size=3, max_dist=6, rng=1),
        "slic": lambda: segmentation.slic(image, n_segments=400, start_label=1),
        "opencv": lambda: opencv(image),
    }[name]


def boundary(labels):
    """Pixels that differ from the one to the right or below."""
    found = np.zeros(labels.shape, bool)
    found[:, :-1] |= labels[:, :-1] != labels[:, 1:]
    found[:-1] |= labels[:-1] != labels[1:]
    return found


def explained(image, labels):
    """The share of the variance of the colours that the mean colours of the regions have."""
    number = np.unique(labels, return_inverse=True)[1].reshape(-1)
    counts = np.bincount(number)
    colours = image.reshape(-1, 3).astype(float)
    total, within = 0.0, 0.0
    for band in colours.T:
        means = np.bincount(number, band) / counts
        total += ((band - band.mean()) ** 2).sum()
        within += ((band - means[number]) ** 2).sum()
    return 1.0 - within / total if total else 1.0


def compare(path, files):
    from scipy import ndimage
    image = picture(path)
    found = {}
    for name, file in files:
        labels = np.load(file) if file.endswith(".npy") else np.asarray(imageio.imread(file))
        found[name] = labels.astype(np.int64)
    edges = {name: boundary(labels) for name, labels in found.items()}
    away = {name: ndimage.distance_transform_edt(~edge) for name, edge in edges.items()}

    def agreement(a, b):
        # The harmonic mean of the shares of either boundary that is near the other one.
        there = (away[b][edges[a]] <= NEAR).mean() if edges[a].any() else 0.0
        back = (away[a][edges[b]] <= NEAR).mean() if edges[b].any() else 0.0
        return 2 * there * back / (there + back) if there + back else 0.0

    return {name: {"regions": len(np.unique(labels)), "explained": explained(image, labels),
                   "boundary": float(edges[name].mean()),
                   "agreement": {other: float(agreement(name, other)) for other in found if other != name}}
            for name, labels in found.items()}


def main():
    name, path, *rest = sys.argv[1:]
    if name == "compare":
        print(json.dumps(compare(path, [word.split("=", 1) for word in rest])))
        return
    image = picture(path)
    run = work(name, image)
    start = time.process_time()
    labels = run()
    seconds = time.process_time() - start
    np.save(rest[0], labels.astype(np.int32))
    print(json.dumps({"seconds": seconds, "pixels": labels.size}))


main()
