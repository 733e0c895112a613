"""Checks the tables of features that `medial` reads and writes against readers and writers of others.

    python tests/foreign/check_formats.py MEDIAL [DATA]

GDAL (by pyogrio and by its program ogrinfo), pyarrow and pyshp write layers, and the command has to find in them what it finds in
GeoJSON; they read what the command writes, and have to find the same doubles. DATA is the folder of real
data, if it is there; the shipped fixtures are used in any case. What is needed is in requirements.txt.
"""

import json
import pathlib
import re
import sqlite3
import subprocess
import sys
import tempfile
import warnings

import geopandas
import numpy as np
import pyarrow.parquet
import pyogrio
import pyproj
import shapefile
import shapely

warnings.filterwarnings("ignore", category=UserWarning)
FIXTURES = pathlib.Path(__file__).parents[2] / "fixtures"
DRIVERS = {"gpkg": "GPKG", "shp": "ESRI Shapefile", "fgb": "FlatGeobuf", "parquet": None}
passed = 0


def check(is_so, what):
    """Counts a check, or ends with what is wrong."""
    global passed
    if not is_so:
        sys.exit(f"FAILED: {what}")
    passed += 1


def medial(*words, status=(0, 3)):
    """Runs the command; gives what it says on standard error."""
    done = subprocess.run([MEDIAL, *map(str, words)], capture_output=True, text=True)
    check(done.returncode in status, f"{words}: status {done.returncode}: {done.stderr}")
    return done.stderr


def lines(path):
    """Lengths, sources and shapes of axes in GeoJSON lines, in an order that no format changes."""
    features = [json.loads(line.lstrip("\x1e")) for line in path.read_text().splitlines()]
    rows = [(f["geometry"]["coordinates"], f["properties"]["length"]) for f in features]
    return sorted(rows)


def table(path):
    """What GDAL or pyarrow finds in a file."""
    if path.suffix == ".parquet":
        return geopandas.read_parquet(path)
    return geopandas.read_file(path)


def write(frame, path):
    """Lets GDAL or pyarrow write a layer."""
    if path.suffix == ".parquet":
        frame.to_parquet(path)
    else:
        frame.to_file(path, driver=DRIVERS[path.suffix[1:]], engine="pyogrio")


def input_layers(source, folder):
    """A layer in every format gives the axes that its GeoJSON gives."""
    medial("axis", source, "-q", "-o", folder / "axes.geojsonl")
    expected = lines(folder / "axes.geojsonl")
    frame = geopandas.read_file(source)
    for extension in DRIVERS:
        path = folder / f"{source.stem}.{extension}"
        write(frame, path)
        medial("axis", path, "-q", "-o", folder / "found.geojsonl")
        found = lines(folder / "found.geojsonl")
        check(len(found) == len(expected), f"{path.name}: {len(found)} paths for {len(expected)}")
        # Rings are written from another corner, or the other way round: sums are taken elsewhere.
        lengths = [np.sort([length for _, length in rows]) for rows in (found, expected)]
        check(np.allclose(*lengths, rtol=1e-9, atol=1e-12), f"{path.name}: lengths")
    print(f"{source.name}: {len(expected)} paths from every format")


def output_layers(source, folder):
    """Axes in every format are those of GeoJSON lines, double for double."""
    medial("axis", source, "-q", "-o", folder / "axes.geojsonl", "--measures", "excess")
    features = [json.loads(line) for line in (folder / "axes.geojsonl").read_text().splitlines()]
    key = lambda shape: shapely.to_wkb(shape, byte_order=1)
    expected = sorted(
        (key(shapely.LineString(f["geometry"]["coordinates"])), f["properties"]["length"],
         f["properties"]["feature"]) for f in features)
    for extension in DRIVERS:
        path = folder / f"axes.{extension}"
        medial("axis", source, "-q", "-o", path, "--measures", "excess")
        frame = table(path)
        found = sorted(
            (key(shape), length, feature)
            for shape, length, feature in zip(frame.geometry, frame["length"], frame["feature"]))
        check(found == expected, f"{path.name}: not the doubles of GeoJSON")
        box = shapely.total_bounds([shapely.from_wkb(row[0]) for row in expected])
        check((frame.total_bounds == box).all(), f"{path.name}: box")
        if extension != "parquet":
            info = pyogrio.read_info(path)
            check(info["geometry_type"] == "LineString", f"{path.name}: {info['geometry_type']}")
            check((np.array(info["total_bounds"]) == box).all(), f"{path.name}: extent")
    print(f"{source.name}: {len(expected)} paths in every format")


def spatial_filters(folder):
    """The indexes that are written find what they should."""
    for extension in ("gpkg", "fgb"):
        path = folder / f"axes.{extension}"
        every = geopandas.read_file(path)
        x, y, x_max, y_max = every.total_bounds
        box = (x, y, (x + x_max) / 2, (y + y_max) / 2)
        found = geopandas.read_file(path, bbox=box)
        bounds = every.bounds
        apart = (bounds.minx > box[2]) | (bounds.miny > box[3])
        check(0 < len(found) <= (~apart).sum(), f"{path.name}: {len(found)} in the box")
        inside = (bounds.maxx < box[2]) & (bounds.maxy < box[3])
        check(len(found) >= inside.sum(), f"{path.name}: {len(found)} in the box")


def heights_and_points(folder):
    """Third coordinates, points among lines, polygons with holes."""
    plus = FIXTURES / "shapes" / "plus_of_unit_squares.wkt"
    for extension in ("gpkg", "fgb", "parquet"):
        path = folder / f"plus.{extension}"
        medial("axis", plus, "-o", path, "--keypoints")
        frame = table(path)
        check(set(frame.geom_type) == {"Point", "LineString"}, f"{path.name}: kinds")
        medial("axis", plus, "-o", path, "--z", "radius")
        frame = table(path)
        check(frame.geometry.has_z.all(), f"{path.name}: heights")
        check(frame.crs is None or "ndefined" in frame.crs.name, f"{path.name}: {frame.crs}")
    refused = medial("axis", plus, "-o", folder / "plus.shp", "--keypoints", status=(2,))
    check("one kind of geometry" in refused and "--keypoints" in refused, refused)
    check(not list(folder.glob("plus.s*")) and not list(folder.glob(".medial*")), "files left")
    medial("axis", plus, "-o", folder / "plus.shp", "--z", "radius")
    check(table(folder / "plus.shp").geometry.has_z.all(), "plus.shp: heights")
    with shapefile.Reader(str(folder / "plus.shp")) as reader:
        check(reader.shapeType == shapefile.POLYLINEZ, "plus.shp: type for pyshp")
        check(len(reader) == len(table(folder / "plus.shp")), "plus.shp: rows for pyshp")
        check(reader.encoding.lower().replace("-", "").replace("_", "") == "utf8", "plus.shp: encoding")
    lake = FIXTURES / "lake.rings"
    medial("smooth", lake, "--to", "geojson", "-o", folder / "smooth.geojson")
    expected = geopandas.read_file(folder / "smooth.geojson")
    for extension in DRIVERS:
        path = folder / f"smooth.{extension}"
        medial("smooth", lake, "-q", "-o", path)
        frame = table(path)
        check((frame.is_valid == expected.is_valid).all(), f"{path.name}: validity")
        same = frame.geometry.normalize() == expected.geometry.normalize()
        check(same.all(), f"{path.name}: polygons")


def reference_systems(folder):
    """Reference systems come through, also from format to format."""
    square = shapely.Polygon([(0, 0), (4, 0), (4, 2), (0, 2)])
    for code in (2193, 28992, 32633, 3857):
        frame = geopandas.GeoDataFrame({"name": ["é"]}, geometry=[square], crs=code)
        for extension in DRIVERS:
            path = folder / f"in{code}.{extension}"
            write(frame, path)
            for other in ("gpkg", "shp", "fgb"):
                out = folder / f"out.{other}"
                said = medial("axis", path, "-o", out)
                check("degrees" not in said, said)
                crs = table(out).crs
                same = crs is not None and (crs == pyproj.CRS(code) or crs.to_epsg() == code)
                check(same, f"{path.name} to {other}: {crs}")
                check(set(table(out)["name"]) == {"é"}, f"{path.name} to {other}: text")
            medial("axis", path, "-q", "-o", folder / "out.geojson")
            check(table(folder / "out.geojson").crs.to_epsg() == code, f"{path.name}: to GeoJSON")
            medial("axis", path, "-o", folder / "out.parquet")
            # ESRI has eastings first, whatever the order of EPSG is.
            crs = table(folder / "out.parquet").crs
            check(crs.to_json_dict()["id"]["code"] == code, f"{path.name}: to Parquet")
            check(crs.to_dict() == pyproj.CRS(code).to_dict(), f"{path.name}: to Parquet")
    frame = geopandas.GeoDataFrame({"name": ["a"]}, geometry=[square], crs=4326)
    for extension in DRIVERS:
        path = folder / f"degrees.{extension}"
        write(frame, path)
        said = medial("axis", path, "-o", folder / f"out.{extension}")
        check(said.count("degrees (") == 1, f"{path.name}: {said}")
        check(table(folder / f"out.{extension}").crs.to_epsg() == 4326, f"{path.name}: CRS")


def dialects(folder):
    """Reference systems in every dialect of well-known text become the PROJJSON of the same system, and
    PROJJSON the text of it."""
    square = shapely.Polygon([(0, 0), (4, 0), (4, 2), (0, 2)])
    source = folder / "dialect.gpkg"
    # Degrees, zones of UTM, national grids, feet, poles, areas, grads from Paris, the Web, heights.
    codes = (4269, 32633, 32705, 3857, 27700, 2154, 25832, 5070, 3035, 2225, 3031, 3413, 5041, 2193, 28992,
             2056, 5514, 27572, 31370, 3395, 7405, "ESRI:54009", "ESRI:102003")
    for code in codes:
        known = pyproj.CRS.from_user_input(code)
        geopandas.GeoDataFrame({"a": [1]}, geometry=[square], crs=known).to_file(source, driver="GPKG")
        for version in ("WKT1_GDAL", "WKT1_ESRI", "WKT2_2019", "WKT2_2015"):
            try:
                text = known.to_wkt(version)
            except pyproj.exceptions.CRSError:
                # The dialect has no words for it.
                continue
            with sqlite3.connect(source) as base:
                # Nobody knows its number.
                base.execute("UPDATE gpkg_spatial_ref_sys SET organization = 'NONE', definition = ? WHERE "
                             "srs_id = (SELECT srs_id FROM gpkg_geometry_columns)", [text])
            written = pyproj.CRS.from_wkt(text)
            out = folder / "dialect.parquet"
            said = medial("axis", source, "-o", out)
            check("left out" not in said, f"{code}: {said}")
            metadata = json.loads(pyarrow.parquet.read_schema(out).metadata[b"geo"])
            crs = pyproj.CRS.from_json_dict(metadata["columns"]["geometry"]["crs"])
            same = any(crs.equals(other, ignore_axis_order=True) for other in (written, known))
            check(same, f"{code}, {version}: {crs.to_json()}")
        # Back, without a number.
        nameless = known.to_json_dict()
        nameless.pop("id", None)
        nameless = pyproj.CRS.from_json_dict(nameless)
        frame = geopandas.GeoDataFrame({"a": [1]}, geometry=[square], crs=nameless)
        frame.to_parquet(folder / "nameless.parquet")
        for extension in ("gpkg", "fgb", "shp"):
            out = folder / f"nameless.{extension}"
            medial("axis", folder / "nameless.parquet", "-o", out)
            crs = table(out).crs
            same = crs is not None and (crs.equals(nameless, ignore_axis_order=True)
                                        or crs.equals(known, ignore_axis_order=True))
            # GDAL takes WKT of version 1 in a .prj for ESRI's, with other names of datums.
            same = same or extension == "shp" and crs is not None and crs.name != "" and (
                crs.to_dict() == known.to_dict())
            check(same, f"{code} without a number to {extension}: {crs}")


def values(folder):
    """Values of all types come through from every format."""
    import pandas

    square = shapely.Polygon([(0, 0), (4, 0), (4, 2), (0, 2)])
    frame = geopandas.GeoDataFrame(
        {"whole": [2**53 + 1], "real": [0.1], "text": ["ä \"b\""], "flag": [True],
         "when": [pandas.Timestamp("2026-11-29T13:30:00.25")], "none": [None]},
        geometry=[square], crs=2193)
    for extension in ("gpkg", "fgb", "parquet"):
        path = folder / f"values.{extension}"
        write(frame, path)
        medial("axis", path, "-o", folder / "values.geojsonl")
        found = json.loads((folder / "values.geojsonl").read_text().splitlines()[0])["properties"]
        check(found["whole"] == 2**53 + 1 and found["real"] == 0.1, f"{path.name}: numbers")
        check(found["text"] == "ä \"b\"" and found["flag"] is True, f"{path.name}: text, flag")
        check(found["when"].startswith("2026-11-29T13:30:00.25"), f"{path.name}: {found['when']}")
        check(found["none"] is None, f"{path.name}: nothing")


def shapefiles(folder):
    """Shapefiles as others write them: rings in any order, encodings, deleted rows."""
    hole = [(1, 1), (2, 1), (2, 2), (1, 2), (1, 1)]
    outer = [(0, 0), (0, 9), (9, 9), (9, 0), (0, 0)]
    far = [(20, 0), (20, 4), (24, 4), (24, 0), (20, 0)]
    path = folder / "rings.shp"
    with shapefile.Writer(str(path), encoding="cp1252") as writer:
        writer.field("name", "C", 20)
        writer.field("day", "D")
        writer.poly([hole, far, outer])
        writer.record("Žižkov", "20261129")
        writer.null()
        writer.record("nothing", None)
    (folder / "rings.cpg").write_text("1252")
    said = medial("axis", path, "-q", "-o", folder / "rings.geojsonl", status=(3,))
    found = [json.loads(line) for line in (folder / "rings.geojsonl").read_text().splitlines()]
    check({f["properties"]["name"] for f in found} == {"Žižkov"}, "encoding")
    check({f["properties"]["day"] for f in found} == {"2026-11-29"}, "date")
    expected = folder / "rings.wkt"
    shape = shapely.MultiPolygon([(far, []), (outer, [hole])])
    expected.write_text(shape.wkt)
    medial("axis", expected, "-o", folder / "expected.geojsonl")
    check(len(found) == len(lines(folder / "expected.geojsonl")), f"rings: {said}")


def geopackage_rules(folder):
    """What the standard asks of a GeoPackage."""
    with sqlite3.connect(folder / "axes.gpkg") as base:
        one = lambda query: base.execute(query).fetchone()
        check(one("PRAGMA application_id") == (0x47504B47,), "application_id")
        check(one("PRAGMA user_version") == (10300,), "user_version")
        check(one("PRAGMA integrity_check") == ("ok",), "integrity")
        check(one("PRAGMA foreign_key_check") is None, "foreign keys")
        ids = {row[0] for row in base.execute("SELECT srs_id FROM gpkg_spatial_ref_sys")}
        check({-1, 0, 4326} <= ids, f"reference systems {ids}")
        count = one("SELECT count(*) FROM axes")
        check(one("SELECT count(*) FROM rtree_axes_geom") == count, "index")
        check(one("SELECT rtreecheck('rtree_axes_geom')") == ("ok",), "index")
    # GDAL edits it, by the triggers of the index.
    frame = table(folder / "axes.gpkg").iloc[:1]
    frame.to_file(folder / "axes.gpkg", driver="GPKG", engine="pyogrio", mode="a", layer="axes")
    with sqlite3.connect(folder / "axes.gpkg") as base:
        more = base.execute("SELECT count(*) FROM rtree_axes_geom").fetchone()
        check(more == (count[0] + 1,), "a row that GDAL adds is in the index")


def parquet_rules(folder):
    """What GeoParquet asks of a file, and other encodings of it."""
    metadata = pyarrow.parquet.read_schema(folder / "axes.parquet").metadata[b"geo"]
    geo = json.loads(metadata)
    column = geo["columns"][geo["primary_column"]]
    check(geo["version"] == "1.1.0" and column["encoding"] == "WKB", "geo")
    check(column["geometry_types"] == ["LineString"] and len(column["bbox"]) == 4, "geo")
    square = shapely.Polygon([(0, 0), (4, 0), (4, 2), (0, 2)])
    frame = geopandas.GeoDataFrame({"a": [1]}, geometry=[square], crs=2193)
    native = folder / "native.parquet"
    frame.to_parquet(native, geometry_encoding="geoarrow", write_covering_bbox=True)
    for compression in ("zstd", "gzip", "lz4", "snappy", "brotli", None):
        path = folder / f"{compression}.parquet"
        frame.to_parquet(path, compression=compression)
        medial("axis", path, "-o", folder / "a.geojsonl")
        check(len(lines(folder / "a.geojsonl")) == 5, f"{compression}")
    medial("axis", native, "-o", folder / "native.geojsonl")
    found = json.loads((folder / "native.geojsonl").read_text().splitlines()[0])["properties"]
    check("bbox" not in found and found["a"] == 1, f"native: {found}")


def sequences(folder):
    """Text sequences have their record separators, and read back."""
    plus = FIXTURES / "shapes" / "plus_of_unit_squares.wkt"
    path = folder / "plus.geojsons"
    medial("voronoi", plus, "-o", path)
    data = path.read_bytes()
    check(data.count(b"\x1e") == data.count(b"\n") and data[0] == 0x1E, "separators")
    check(len(geopandas.read_file(path)) == data.count(b"\n"), "GDAL reads the sequence")
    medial("voronoi", plus, "-o", folder / "plus.geojsonl")
    check(b"\x1e" not in (folder / "plus.geojsonl").read_bytes(), "lines have none")
    square = '{"type":"Polygon","coordinates":[[[0,0],[4,0],[4,2],[0,0]]]}\n'
    (folder / "in.geojsons").write_text(f"\x1e{square}\x1e{square}")
    medial("axis", folder / "in.geojsons", "-o", folder / "in.geojsonl")
    check(len(lines(folder / "in.geojsonl")) == 6, "sequence in")


def by_ogrinfo(source, folder):
    """The program `ogrinfo` of GDAL finds as many lines in every format, of the same kind, in the same box."""
    medial("axis", source, "-q", "-o", folder / "axes.geojsonl")
    features = [json.loads(line) for line in (folder / "axes.geojsonl").read_text().splitlines()]
    box = shapely.total_bounds([shapely.LineString(f["geometry"]["coordinates"]) for f in features])
    for extension in ("gpkg", "shp", "fgb", "geojson", "geojsons", "csv", "dxf"):
        path = folder / f"told.{extension}"
        medial("axis", source, "-q", "-o", path)
        # CSV has its shapes as text.
        options = ["-oo", "GEOM_POSSIBLE_NAMES=WKT"] if extension == "csv" else []
        words = ["ogrinfo", "-ro", "-al", "-so", *options, path]
        told = subprocess.run(list(map(str, words)), capture_output=True, text=True, check=True).stdout
        count = int(re.search(r"Feature Count: (\d+)", told)[1])
        check(count == len(features), f"ogrinfo {path.name}: {count} features for {len(features)}")
        if extension == "dxf":
            # Parabolas are splines, which GDAL draws with points of its own.
            continue
        if extension != "csv":
            check(re.search(r"Geometry: (3D )?Line String", told), f"ogrinfo {path.name}: {told}")
        extent = re.search(r"Extent: \(([^,]+), ([^)]+)\) - \(([^,]+), ([^)]+)\)", told)
        found = np.array([float(number) for number in extent.groups()])
        check(np.allclose(found, box, rtol=0, atol=1e-6), f"ogrinfo {path.name}: {found} for {box}")
    print(f"{source.name}: {len(features)} paths told by ogrinfo")


def main(data):
    sources = [FIXTURES / "river.geojson"]
    if data:
        gis = data / "gis"
        sources += [gis / "bubenec/buildings.geojson", gis / "natural-earth/countries-50m.geojson",
                    gis / "us-census/counties-10m.geojson"]
    for source in sources:
        with tempfile.TemporaryDirectory() as folder:
            input_layers(source, pathlib.Path(folder))
            output_layers(source, pathlib.Path(folder))
            by_ogrinfo(source, pathlib.Path(folder))
            spatial_filters(pathlib.Path(folder))
            geopackage_rules(pathlib.Path(folder))
            parquet_rules(pathlib.Path(folder))
    for checks in (heights_and_points, reference_systems, dialects, values, shapefiles, sequences):
        with tempfile.TemporaryDirectory() as folder:
            checks(pathlib.Path(folder))
    print(f"{passed} passed, 0 failed")


MEDIAL = sys.argv[1]
main(pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None)
