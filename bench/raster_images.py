"""Draws the bitmaps, and large images, on which thinning is timed; prints the share of the picture that is filled.

usage: raster_images.py SHAPE SIDE FOLDER FILE.pbm|FILE.png

SHAPE: horse (one thick silhouette, enlarged), blobs (a labyrinth of constant width), page (a scanned page, beside
itself as often as it takes).
"""

import pathlib
import sys

import imageio.v3 as imageio
import numpy as np
from scipy import ndimage


def grey(path):
    image = imageio.imread(path)
    return image[..., :3].mean(axis=2) if image.ndim == 3 else image.astype(float)


def horse(side, folder):
    mask = grey(folder / "masks" / "horse.png") < 128
    rows, columns = mask.shape
    v, u = (np.arange(side) * rows // side), (np.arange(side) * columns // side)
    return mask[np.ix_(v, u)]


def blobs(side, _):
    noise = np.random.default_rng(7).standard_normal((side, side))
    return ndimage.gaussian_filter(noise, 6) - ndimage.gaussian_filter(noise, 9) > 0


def page(side, folder):
    image = grey(folder / "scans" / "page.png")
    mask = image < ndimage.gaussian_filter(image, 20) - 12
    rows, columns = mask.shape
    return mask[np.ix_(np.arange(side) % rows, np.arange(side) % columns)]


def main():
    shape, side, folder, target = sys.argv[1:]
    mask = {"horse": horse, "blobs": blobs, "page": page}[shape](int(side), pathlib.Path(folder))
    rows, columns = mask.shape
    if target.endswith(".png"):
        imageio.imwrite(target, np.where(mask, np.uint8(255), np.uint8(0)))
    else:
        data = np.packbits(mask, axis=1).tobytes()
        pathlib.Path(target).write_bytes(b"P4\n%d %d\n" % (columns, rows) + data)
    print(mask.mean())


main()
