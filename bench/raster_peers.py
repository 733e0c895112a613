"""Times thinning and medial axes of other libraries on a bitmap, one thread; prints JSON.

usage: raster_peers.py NAME FILE.pbm
"""

import json
import os
import sys
import time

for name in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"]:
    os.environ[name] = "1"

import numpy as np  # noqa: E402

# Seconds to repeat for.
ENOUGH = 0.5


def bitmap(path):
    """The pixels of a bitmap of the kind P4."""
    content = open(path, "rb").read()
    _, columns, rows = content.split(None, 3)[:3]
    start = content.index(rows, content.index(columns) + len(columns)) + len(rows) + 1
    columns, rows, data = int(columns), int(rows), content[start:]
    bits = np.unpackbits(np.frombuffer(data, np.uint8).reshape(rows, -1), axis=1)
    return bits[:, :columns].astype(bool)


def work(name, image):
    """What a program does with an image."""
    if name.startswith("skimage"):
        from skimage import morphology
        return {
            "skimage medial_axis": lambda: morphology.medial_axis(image, return_distance=True),
            "skimage skeletonize": lambda: morphology.skeletonize(image),
            "skimage skeletonize lee": lambda: morphology.skeletonize(image, method="lee"),
            "skimage thin": lambda: morphology.thin(image),
        }[name]
    import cv2
    cv2.setNumThreads(1)
    bytes_ = image.astype(np.uint8) * 255
    kind = {"opencv zhang_suen": cv2.ximgproc.THINNING_ZHANGSUEN,
            "opencv guo_hall": cv2.ximgproc.THINNING_GUOHALL}[name]
    return lambda: cv2.ximgproc.thinning(bytes_, thinningType=kind)


def main():
    name, path = sys.argv[1:]
    image = bitmap(path)
    run = work(name, image)
    times, begun = [], time.perf_counter()
    while not times or time.perf_counter() - begun < ENOUGH:
        start = time.process_time()
        run()
        times.append(time.process_time() - start)
    print(json.dumps({"ns": 1e9 * sorted(times)[len(times) // 2] / image.size}))


main()
