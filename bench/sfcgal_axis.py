"""Computes SFCGAL's approximate medial axis of the polygons of a GeoJSON file: python3 THIS IN OUT.

One GeoJSON feature for each polygon, as `medial axis` writes them.
"""

import json
import sys

from pysfcgal.geometry import Polygon


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        features = json.load(file)["features"]
    lines = []
    for feature in features:
        outer, *holes = feature["geometry"]["coordinates"]
        try:
            line = Polygon(outer, holes).approximate_medial_axis()
        except Exception as error:  # which class differs between versions
            print(error, file=sys.stderr)
            continue
        # None stands for an error that it has told itself.
        if line is not None:
            lines.append(line)
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write('{"type":"FeatureCollection","features":[\n')
        file.write(",\n".join(
            f'{{"type":"Feature","properties":{{}},"geometry":{line.to_geojson()}}}'
            for line in lines
        ))
        file.write("\n]}\n")
    # SFCGAL's own messages may lack the end of the line.
    print(f"\n{len(lines)}")


main()
