"""Buffers the polygons of standard input, in the text that `medial-bench draw` prints, with Shapely: THIS D,D.

Distances are inward if positive. Prints, as JSON, the areas for each feature and distance, and the seconds that took
without reading.
"""

import json
import sys
import time

import shapely

# Pieces of a quarter of a circle.
QUARTER = 50


def main():
    distances = [float(word) for word in sys.argv[1].split(",")]
    features = [shapely.MultiPolygon(polygons) for polygons in read(sys.stdin)]
    start = time.process_time()
    areas = [
        [feature.buffer(-distance, quad_segs=QUARTER).area for distance in distances]
        for feature in features
    ]
    seconds = time.process_time() - start
    json.dump({"areas": areas, "quarter": QUARTER, "seconds": seconds}, sys.stdout)


def read(lines):
    features = []
    for line in lines:
        if line == "feature\n":
            features.append([])
        elif line == "polygon\n":
            features[-1].append([])
        elif line == "ring\n":
            features[-1][-1].append([])
        else:
            features[-1][-1][-1].append(tuple(map(float, line.split())))
    return [[(rings[0], rings[1:]) for rings in polygons] for polygons in features]


if __name__ == "__main__":
    main()
