"""Writes a GeoPackage of many buildings: those of a GeoJSON file again and again, side by side.

    python tests/foreign/many_buildings.py BUILDINGS.geojson COUNT OUT.gpkg

What it takes to do them all:

    /usr/bin/time -v medial axis OUT.gpkg -o axes.gpkg
"""

import sys

import numpy as np
import pyogrio
import shapely


def main(source, count, target):
    meta, _, wkb, _ = pyogrio.raw.read(source)
    shapes = shapely.force_2d(shapely.from_wkb(wkb))
    shapes = shapes[np.isin(shapely.get_type_id(shapes), (3, 6))]
    x, y, x_max, y_max = shapely.total_bounds(shapes)
    # Moved to the origin, so that the steps below lose no corner.
    shapes = shapely.transform(shapes, lambda p: p - (x, y))
    step = 1.1 * max(x_max - x, y_max - y)
    side = int(np.ceil(np.sqrt(count / len(shapes))))
    for k in range(0, side * side):
        part = shapes[: count - k * len(shapes)]
        if len(part) == 0:
            break
        moved = shapely.transform(part, lambda p: p + (step * (k % side), step * (k // side)))
        numbers = np.arange(len(part)) + k * len(shapes)
        names = np.array([f"building {number}" for number in numbers], dtype=object)
        pyogrio.raw.write(
            target,
            geometry=shapely.to_wkb(shapely.multipolygons(
                [shapely.get_parts(shape) for shape in moved])),
            field_data=[numbers, names, numbers / 3],
            fields=["number", "name", "third"],
            geometry_type="MultiPolygon",
            crs="EPSG:3857",
            driver="GPKG",
            layer="buildings",
            append=k > 0,
        )


main(sys.argv[1], int(sys.argv[2]), sys.argv[3])
