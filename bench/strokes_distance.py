"""Measures how far lines are from published medians: python3 THIS OUTLINES MEDIANS AXES NAME=LINES…

All are GeoJSON files, with ids, but for AXES, which has the axis of each line of the first program as WKT,
under the name `axis`. Prints JSON: by name, means over the strokes that all have a line for, in widths of
the stroke; the width is twice the mean distance of the median from the outline.

- `inner`: the distance of a published point from the line, without the two at the ends.
- `points`: the same with them.
- `there`: the distance of the median from the line, along all of it.
- `back`: the distance of the line from the median, along all of it.
"""

import json
import sys

import numpy
import shapely

# How far apart the points are that stand for a line, in units of the outlines; a stroke is some 40 wide.
STEP = 2.0


def main():
    outlines, medians, axes, *rest = sys.argv[1:]
    outlines, medians = read(outlines), read(medians)
    results = {name: read(path) for name, path in (word.rsplit("=", 1) for word in rest)}
    with open(axes, encoding="utf-8") as file:
        first = next(iter(results.values()))
        results["axis"] = dict(zip(first, shapely.from_wkt(file.read().splitlines())))
    common = [name for name in medians if all(name in lines for lines in results.values())]
    told = {}
    for program, lines in results.items():
        rows = [figures(outlines[name], medians[name], lines[name]) for name in common]
        means = {key: float(numpy.mean([row[key] for row in rows if key in row])) for key in rows[0]}
        told[program] = means | {"found": len(lines), "measured": len(common)}
    print(json.dumps(told))


def read(path):
    """The geometries that have a length, by id."""
    with open(path, encoding="utf-8") as file:
        features = json.load(file)["features"]
    found = {}
    for feature in features:
        name = feature.get("id") or feature["properties"]["source_id"]
        geometry = shapely.geometry.shape(feature["geometry"])
        if geometry.length > 0:
            found[name] = geometry
    return found


def figures(outline, median, line):
    along, weights = samples(median)
    width = 2 * numpy.average(shapely.distance(outline.exterior, along), weights=weights)
    away = shapely.distance(shapely.points(median.coords), line) / width
    there = numpy.average(shapely.distance(along, line), weights=weights) / width
    along, weights = samples(line)
    back = numpy.average(shapely.distance(along, median), weights=weights) / width
    row = {"points": away.mean(), "there": there, "back": back}
    return row | ({"inner": away[1:-1].mean()} if len(away) > 2 else {})


def samples(lines):
    """Points along some lines, with the length that each stands for."""
    points, weights = [], []
    for line in shapely.get_parts(lines):
        n = max(2, round(line.length / STEP))
        points.append(shapely.line_interpolate_point(line, (numpy.arange(n) + 0.5) * line.length / n))
        weights += [line.length / n] * n
    return numpy.concatenate(points), weights


main()
