"""Measures how good medial cells are, with nothing of ours but the cells; prints JSON.

usage: raster_quality.py MEDIAL-BENCH MEDIAL FOLDER IMAGE...
       raster_quality.py masks FOLDER IMAGE...

For each image: how many components and holes the cells have more or less than the shape, blocks of two by two
cells from which one can be taken, the share of the shape in the union of disks of exact radius and the other way
round, at the default and without pruning, the distance of the cells from the exact axis of the outline, and how
far they move when the image is turned by 30 degrees. The second form writes the shapes as bitmaps.
"""

import json
import pathlib
import subprocess
import sys

import imageio.v3 as imageio
import numpy as np
import shapely
from scipy import ndimage
from skimage import measure, transform


def mask_of(path):
    """The shape of an image: the brighter half, or the darker one where that is less."""
    image = imageio.imread(path)
    if image.ndim == 3:
        image = image[..., :3].mean(axis=2) * (image[..., 3] > 127 if image.shape[2] == 4 else 1)
    low, high = float(image.min()), float(image.max())
    mask = image > 0.5 * (low + high) if high > low else image > 0
    return ~mask if mask.mean() > 0.5 else mask


def write(path, mask):
    rows, columns = mask.shape
    path.write_bytes(b"P4\n%d %d\n" % (columns, rows) + np.packbits(mask, axis=1).tobytes())


def read(path):
    content = path.read_bytes()
    _, columns, rows = content.split(None, 3)[:3]
    columns, rows = int(columns), int(rows)
    data = content[len(content) - rows * ((columns + 7) // 8):]
    return np.unpackbits(np.frombuffer(data, np.uint8).reshape(rows, -1), axis=1)[:, :columns].astype(bool)


def topology(mask):
    padded = np.pad(mask, 1)
    return (measure.label(padded, connectivity=2).max(),
            measure.label(~padded, connectivity=1).max() - 1)


def removable_blocks(mask):
    """Full blocks of two by two cells from which one can be taken without changing the topology."""
    padded = np.pad(mask, 2)
    full = padded[:-1, :-1] & padded[1:, :-1] & padded[:-1, 1:] & padded[1:, 1:]
    found = 0
    for y, x in zip(*np.nonzero(full)):
        for v, u in [(y, x), (y + 1, x), (y, x + 1), (y + 1, x + 1)]:
            window = padded[v - 1:v + 2, u - 1:u + 2].copy()
            window[1, 1] = False
            inside = measure.label(window, connectivity=2).max()
            window[1, 1] = True
            outside = measure.label(~window, connectivity=1)
            sides = {outside[0, 1], outside[1, 0], outside[1, 2], outside[2, 1]} - {0}
            if inside == 1 and len(sides) == 1:
                found += 1
                break
    return found


def union(mask, cells):
    """The open disks of the exact radii at the cells."""
    squared = np.rint(ndimage.distance_transform_edt(np.pad(mask, 1)) ** 2).astype(int)[1:-1, 1:-1]
    covered = np.zeros_like(mask)
    rows, columns = mask.shape
    for y, x in zip(*np.nonzero(cells)):
        r2 = squared[y, x]
        r = int(np.ceil(np.sqrt(r2)))
        top, bottom = max(0, y - r), min(rows, y + r + 1)
        left, right = max(0, x - r), min(columns, x + r + 1)
        v, u = np.ogrid[top - y:bottom - y, left - x:right - x]
        covered[top:bottom, left:right] |= v * v + u * u < r2
    return covered


def iou(a, b):
    both, either = (a & b).sum(), (a | b).sum()
    return float(both / either) if either else 1.0


def main():
    if sys.argv[1] == "masks":
        return masks(pathlib.Path(sys.argv[2]), sys.argv[3:])
    bench, medial, folder, *images = sys.argv[1:]
    folder = pathlib.Path(folder)
    source, target = folder / "shape.pbm", folder / "cells.pbm"

    def cells_of(mask, *more):
        write(source, mask)
        subprocess.run([bench, "skeleton", source, target, *more], check=True)
        return read(target)

    for path in images:
        mask = mask_of(path)
        cells, whole = cells_of(mask), cells_of(mask, "none")
        (c, h), (d, i) = topology(mask), topology(cells)
        (e, j) = topology(whole)
        found = {"image": pathlib.Path(path).stem, "pixels": int(mask.size),
                 "cells": float(cells.sum() / max(1, mask.sum())),
                 "components": abs(int(c) - int(d)) + abs(int(c) - int(e)),
                 "holes": abs(int(h) - int(i)) + abs(int(h) - int(j)),
                 "blocks": removable_blocks(cells),
                 "iou": iou(union(mask, cells), mask), "iou_none": iou(union(mask, whole), mask)}
        if mask.size < 1_000_000 and mask.any():
            found["centred"] = centred(medial, folder, mask, cells)
            found["drift"] = drift(mask, cells, cells_of)
        print(json.dumps(found), flush=True)


def masks(folder, images):
    """Writes the shapes of images as bitmaps, and prints where."""
    for image in images:
        target = folder / f"{pathlib.Path(image).stem}.pbm"
        write(target, mask_of(image))
        print(target)


def centred(medial, folder, mask, cells):
    """The mean distance of cells from the exact axis of the outline, as it is pruned too."""
    picture, lines = folder / "shape.png", folder / "axis.wkt"
    imageio.imwrite(picture, (mask * 255).astype(np.uint8))
    subprocess.run([medial, "axis", "-q", picture, "--threshold", "0", "--engine", "path_tracing", "--prune",
                    "chord=2", "--tolerance", "0.02", "-o", lines], check=True)
    axis = [g for g in map(shapely.from_wkt, lines.read_text().splitlines()) if not g.is_empty]
    if not axis:
        return None
    tree = shapely.STRtree([part for g in axis for part in getattr(g, "geoms", [g])])
    y, x = np.nonzero(cells)
    points = shapely.points(x + 0.5, -(y + 0.5))
    _, distances = tree.query_nearest(points, return_distance=True, all_matches=False)
    return float(np.mean(distances))


def drift(mask, cells, cells_of):
    """The mean distance between the cells of the turned image and the turned cells."""
    turned = transform.rotate(np.pad(mask, 2).astype(float), 30, resize=True, order=1) > 0.5
    there = cells_of(turned)
    y, x = np.nonzero(np.pad(cells, 2))
    rows, columns = mask.shape[0] + 4, mask.shape[1] + 4
    centre, new = np.array([columns, rows]) / 2 - 0.5, np.array(turned.shape[::-1]) / 2 - 0.5
    angle = np.deg2rad(30)
    way = np.stack([x, y], 1) - centre
    # Counterclockwise in a picture whose rows go down.
    back = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    points = way @ back.T + new
    from scipy.spatial import cKDTree
    v, u = np.nonzero(there)
    if not len(u) or not len(x):
        return None
    there = np.stack([u, v], 1)
    a, _ = cKDTree(points).query(there)
    b, _ = cKDTree(there).query(points)
    return float(0.5 * (a.mean() + b.mean()))


main()
