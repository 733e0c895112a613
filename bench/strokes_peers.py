"""Computes the centerline of each polygon of a GeoJSON file with a package of pip: python3 THIS NAME IN OUT.

NAME is `pygeoops` or `skimage`. One GeoJSON feature for each polygon that has a line, with the id of
the polygon.

- `pygeoops`: `pygeoops.centerline` with default options, which drops short branches and simplifies;
  `pygeoops_extended` has `extend=True` besides.
- `skimage`: a raster of one pixel a unit, `skimage.morphology.skeletonize`, and of the skeleton the longest of
  the shortest ways between two pixels, by steps of 1 and √2.
"""

import json
import sys

import numpy
import shapely


def main():
    name, source, target = sys.argv[1:]
    with open(source, encoding="utf-8") as file:
        features = json.load(file)["features"]
    polygons = [shapely.geometry.shape(feature["geometry"]) for feature in features]
    lines = PEERS[name](polygons)
    with open(target, "w", encoding="utf-8") as file:
        file.write('{"type":"FeatureCollection","features":[\n')
        file.write(",\n".join(
            f'{{"type":"Feature","id":{json.dumps(feature["id"])},"properties":{{}},'
            f'"geometry":{shapely.to_geojson(line)}}}'
            for feature, line in zip(features, lines) if line is not None and not line.is_empty
        ))
        file.write("\n]}\n")


def pygeoops(polygons, **options):
    from pygeoops import centerline

    return centerline(polygons, **options)


def skimage(polygons):
    from skimage.morphology import skeletonize

    return [longest(skeletonize(raster(polygon)), polygon.bounds) for polygon in polygons]


def raster(polygon):
    """The pixels whose centres lie inside, with a rim of one pixel around all."""
    from skimage.draw import polygon2mask

    left, bottom, right, top = numpy.round(polygon.bounds)
    ring = numpy.asarray(polygon.exterior.coords) - (left - 1.5, bottom - 1.5)
    return polygon2mask((int(right - left) + 3, int(top - bottom) + 3), ring)


def longest(skeleton, bounds):
    """The longest way through a skeleton, in the coordinates of the polygon."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import dijkstra

    pixels = numpy.argwhere(skeleton)
    number = numpy.full(skeleton.shape, -1)
    number[tuple(pixels.T)] = range(len(pixels))
    rows, columns, lengths = [], [], []
    for step in [(0, 1), (1, 0), (1, 1), (1, -1)]:
        # The rim is empty, so no step leaves the raster.
        others = number[tuple((pixels + step).T)]
        here = numpy.flatnonzero(others >= 0)
        rows += here.tolist()
        columns += others[here].tolist()
        lengths += [numpy.hypot(*step)] * len(here)
    graph = coo_array((lengths, (rows, columns)), shape=(len(pixels),) * 2).tocsr()
    # Twice to the farthest pixel; on a skeleton with cycles that may not be the longest way.
    far = farthest(dijkstra(graph, directed=False, indices=0))
    distances, before = dijkstra(graph, directed=False, indices=far, return_predecessors=True)
    way = [farthest(distances)]
    while way[-1] != far:
        way.append(before[way[-1]])
    if len(way) < 2:
        return None
    return shapely.LineString(pixels[way] + (numpy.round(bounds[:2]) - 1.0))


def farthest(distances):
    return int(numpy.argmax(numpy.where(numpy.isfinite(distances), distances, -1)))


PEERS = {
    "pygeoops": pygeoops,
    "pygeoops_extended": lambda polygons: pygeoops(polygons, extend=True),
    "skimage": skimage,
}

main()
