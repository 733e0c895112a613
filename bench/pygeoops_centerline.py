"""Computes `pygeoops.centerline` of the polygons of a GeoJSON file: python3 THIS IN OUT.

Default options. One GeoJSON feature for each polygon, as `medial axis` writes them.
"""

import json
import sys

import pygeoops
import shapely


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        features = json.load(file)["features"]
    polygons = [shapely.geometry.shape(feature["geometry"]) for feature in features]
    lines = pygeoops.centerline(polygons)
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write('{"type":"FeatureCollection","features":[\n')
        file.write(",\n".join(
            f'{{"type":"Feature","properties":{{}},"geometry":{shapely.to_geojson(line)}}}'
            for line in lines if line is not None and not line.is_empty
        ))
        file.write("\n]}\n")
    print(sum(line is not None and not line.is_empty for line in lines))


main()
