"""Drawings and fonts, against other programs: python check_drawings.py PATH_TO_MEDIAL

What svgelements, ezdxf and fontTools make of a file must be what `medial` reads, and ezdxf must read
what it writes. Needs the packages of requirements-drawings.txt.
"""

import json
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

import ezdxf
import ezdxf.path
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.areaPen import AreaPen
from fontTools.pens.t2CharStringPen import T2CharStringPen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from shapely.affinity import scale, translate
from shapely.geometry import Point, Polygon, shape
from shapely.ops import unary_union
from shapely.validation import explain_validity
from svgelements import SVG, Move, Path as SvgPath, Shape

MEDIAL = sys.argv[1]
N_CHECKS = 0


def check(holds, what):
    global N_CHECKS
    N_CHECKS += 1
    if not holds:
        sys.exit(f"failed: {what}")


def medial(*words, status=0):
    run = subprocess.run([MEDIAL, *map(str, words)], capture_output=True, check=False)
    errors = run.stderr.decode()
    check(run.returncode == status, f"{words}: exit status {run.returncode}: {errors}")
    return run.stdout.decode()


def polygons(file, *words, status=0):
    """The features as shapely geometries, with their properties."""
    words = ["reconstruct", file, "--to", "geojsonl", "--regroup", "-q", *words]
    features = [json.loads(line) for line in medial(*words, status=status).splitlines()]
    return [(shape(f["geometry"]), f["properties"]) for f in features]


def same(found, expected, size, what, share=1e-3):
    # Of what ezdxf flattens, joints may be off by rounding.
    expected = expected if expected.is_valid else expected.buffer(0)
    check(found.is_valid, f"{what}: {explain_validity(found)}")
    off = found.symmetric_difference(expected).area
    check(off <= share * size, f"{what}: areas {found.area} and {expected.area} differ by {off}")


def check_svg(folder):
    draw = random.Random(7)
    shapes = []
    for _ in range(40):
        x, y, a, b = (draw.uniform(1, 20) for _ in range(4))
        f = draw.uniform(0.2, 0.8)
        turn = [
            "",
            f"rotate({draw.uniform(0, 360)} {x} {y})",
            f"translate({x},{y}) scale({a / 5} {b / 7})",
            f"matrix({a / 9} {f} {-f} {b / 9} {x} {y})",
            f"skewX({10 * f}) translate(3)",
        ][draw.randrange(5)]
        body = [
            f'<rect x="{x}" y="{y}" width="{a}" height="{b}"',
            f'<rect x="{x}" y="{y}" width="{a}" height="{b}" rx="{f * a / 2}" ry="{f * b / 2}"',
            f'<circle cx="{x}" cy="{y}" r="{a}"',
            f'<ellipse cx="{x}" cy="{y}" rx="{a}" ry="{b}"',
            f'<polygon points="{x} {y} {x + a} {y} {x} {y + b}"',
            f'<path d="M{x} {y}h{a}a{b} {b * f} {40 * f} 0 1 {a} {b}q{-a} {b} {-2 * a} {f}z"',
            f'<path d="M{x} {y}c{a} {-b} {2 * a} {-b} {3 * a} 0s{a * f} {b} {-a} {2 * b}q{-a / 2} 0 {-a} {-b * f}t{-a / 3} {-b * f / 2}z"',
            f'<path d="M{x},{y}A{a},{b} {90 * f} 1 0 {x + a},{y + b * f}Z"',
        ][draw.randrange(8)]
        shapes.append(f'{body} transform="{turn}"/>')
    file = folder / "shapes.svg"
    file.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 300 300" width="300" height="300">'
        + "".join(shapes)
        + "</svg>"
    )
    expected = []
    for element in SVG.parse(file, reify=False).elements():
        if isinstance(element, Shape):
            # Its arcs are wrong once they are skewed, so points are moved and not segments.
            path = SvgPath(element)
            segments = [part for part in path if not isinstance(part, Move)]
            points = [part.point(k / 1000) for part in segments for k in range(1000)]
            points = [path.transform.point_in_matrix_space(p) for p in points]
            ring = Polygon([(p.x, -p.y) for p in points])
            expected.append(ring)
    check(len(expected) == len(shapes), "svgelements reads all shapes")
    words = ["reconstruct", file, "--to", "geojsonl", "-q", "--tolerance", "1e-5"]
    run = subprocess.run([MEDIAL, *map(str, words)], capture_output=True, check=False)
    for line in run.stdout.splitlines():
        feature = json.loads(line)
        k = feature["properties"]["feature"]
        if expected[k].is_valid:
            same(shape(feature["geometry"]), expected[k], expected[k].area, shapes[k])
    n_valid = sum(ring.is_valid for ring in expected)
    check(len(run.stdout.splitlines()) >= n_valid - 2, "all valid shapes are read")


def flat(entity, extra=None):
    """A closed entity of ezdxf as a polygon."""
    line = ezdxf.path.make_path(entity)
    if extra is not None:
        line = line.transform(extra)
    return Polygon([(p.x, p.y) for p in line.flattening(1e-4)])


def periodic(control):
    """Points of a periodic cubic spline, of which ezdxf flattens more than there is."""
    points = []
    for k in range(len(control)):
        own = [control[(k + j) % len(control)] for j in range(4)]
        for t in (j / 200 for j in range(200)):
            basis = [(1 - t) ** 3, 3 * t**3 - 6 * t**2 + 4, -3 * t**3 + 3 * t**2 + 3 * t + 1, t**3]
            points.append([sum(b * p[axis] for b, p in zip(basis, own)) / 6 for axis in (0, 1)])
    return points


def drawing(version):
    document = ezdxf.new(version, units=ezdxf.units.MM)
    model = document.modelspace()
    expected = []

    def layer():
        return {"layer": f"L{len(expected)}"}

    def closed(entity):
        expected.append(flat(entity))

    slot = [(0, 0, 0.0), (10, 0, 1.0), (10, 4, 0.0), (0, 4, -0.4)]
    closed(model.add_polyline2d(slot, format="xyb", close=True, dxfattribs=layer()))
    closed(model.add_circle((3.5, -7.25), 2.5, dxfattribs=layer()))
    mirrored = layer() | {"extrusion": (0, 0, -1)}
    closed(model.add_circle((20, 1), 2, dxfattribs=mirrored))
    # A slot of lines and arcs, with a hole.
    attributes = layer()
    model.add_line((0, 20), (10, 20), dxfattribs=attributes)
    model.add_arc((10, 23), 3, 270, 90, dxfattribs=attributes)
    model.add_line((0, 26), (10, 26), dxfattribs=attributes)
    model.add_arc((0, 23), 3, 90, 270, dxfattribs=attributes)
    model.add_circle((5, 23), 2, dxfattribs=attributes)
    disk = Polygon([(math.cos(t * math.pi / 2000), math.sin(t * math.pi / 2000)) for t in range(4000)])
    def round_at(x, y, r):
        return translate(scale(disk, r, r, origin=(0, 0)), x, y)

    box = Polygon([(0, 20), (10, 20), (10, 26), (0, 26)])
    expected.append(
        unary_union([box, round_at(0, 23, 3), round_at(10, 23, 3)]).difference(round_at(5, 23, 2))
    )
    # A block, scaled, mirrored and turned.
    block = document.blocks.new(f"PART{version}", base_point=(1, 1))
    inner = block.add_polyline2d(slot, format="xyb", close=True, dxfattribs={"layer": "0"})
    insert = model.add_blockref(
        block.name, (40, 10), dxfattribs=layer() | {"xscale": 2, "yscale": -1.5, "rotation": 30}
    )
    expected.append(flat(inner, insert.matrix44()))
    model.add_line((0, 80), (1, 80), dxfattribs={"layer": "OPEN"})
    model.add_text("text", dxfattribs={"layer": "TEXT"})
    for name, state in (("OFF", "off"), ("FROZEN", "freeze")):
        getattr(document.layers.add(name), state)()
        model.add_circle((200, 200), 1, dxfattribs={"layer": name})
    if version == "R12":
        return document, expected
    closed(model.add_lwpolyline(slot, format="xyb", close=True, dxfattribs=layer()))
    closed(model.add_ellipse((30, 30), (6, 2), 0.4, dxfattribs=layer()))
    arcs = layer()
    half = model.add_ellipse((30, 50), (6, 2), 0.4, 0.5, 0.5 + math.pi, dxfattribs=arcs)
    model.add_line(half.start_point, half.end_point, dxfattribs=arcs)
    closed(half)
    control = [(50, 0, 0), (60, -3, 0), (64, 6, 0), (55, 12, 0), (48, 6, 0)]
    spline = model.add_spline(dxfattribs=layer())
    spline.set_closed(control)
    expected.append(Polygon(periodic(control)))
    rational = model.add_spline(dxfattribs=layer())
    rational.set_open_rational([*control, control[0]], [1, 2, 1, 0.5, 3, 1])
    closed(rational)
    # Splines through points, closed by a line, with and without tangents.
    for y, tangents in ((0, None), (30, ((0, 4), (-1, -2)))):
        attributes = layer()
        through = [(120, y), (124, y + 7), (131, y + 5), (133, y + 11), (140, y + 2)]
        fit = model.add_spline(fit_points=through, dxfattribs=attributes)
        if tangents:
            fit.dxf.start_tangent, fit.dxf.end_tangent = tangents
        model.add_line(through[-1], through[0], dxfattribs=attributes)
        closed(fit)
    closed(model.add_solid([(70, 0), (75, 0), (70, 4), (76, 5)], dxfattribs=layer()))
    expected[-1] = Polygon([(70, 0), (75, 0), (76, 5), (70, 4)])
    # Hatches with every kind of edge.
    hatch = model.add_hatch(dxfattribs=layer())
    hatch.paths.add_polyline_path([(0, 40, 0.0), (12, 40, 0.3), (12, 52, 0.0), (0, 52, 0.0)], is_closed=True)
    for ccw in [True, False]:
        x = 3 if ccw else 9
        path = hatch.paths.add_edge_path()
        path.add_arc((x, 43), 1, 20, 200, ccw=ccw)
        a = [math.radians(t) for t in ((200, 20) if ccw else (20, 200))]
        # From where the arc ends to where it begins.
        path.add_line(*[(x + math.cos(t), 43 + math.sin(t)) for t in a])
        path = hatch.paths.add_edge_path()
        path.add_ellipse((x, 48), (2, 0.5), 0.5, 0, 360, ccw=ccw)
    holes = [ezdxf.path.from_hatch_boundary_path(p) for p in hatch.paths]
    rings = [Polygon([(p.x, p.y) for p in h.flattening(1e-4)]) for h in holes]
    outer = max(rings, key=lambda ring: ring.area)
    for ring in rings:
        if ring is not outer:
            outer = outer.difference(ring)
    expected.append(outer)
    hatch = model.add_hatch(dxfattribs=layer())
    path = hatch.paths.add_edge_path()
    arc = path.add_ellipse((80, 40), (6, 3), 0.35, 25, 200)
    path.add_line(arc.end_point, arc.start_point)
    ring = ezdxf.path.from_hatch_boundary_path(hatch.paths[0])
    expected.append(Polygon([(p.x, p.y) for p in ring.flattening(1e-4)]))
    hatch = model.add_hatch(dxfattribs=layer())
    path = hatch.paths.add_edge_path()
    knots = [0, 0, 0, 0, 1, 2, 2, 2, 2]
    path.add_spline(control_points=[(90, 0), (95, 9), (99, -3), (104, 8), (108, 0)], knot_values=knots, degree=3)
    path.add_line((108, 0), (100, -20))
    path.add_line((100, -20), (90, 0))
    ring = ezdxf.path.from_hatch_boundary_path(hatch.paths[0])
    expected.append(Polygon([(p.x, p.y) for p in ring.flattening(1e-4)]))
    # An array of a block.
    insert = model.add_blockref(
        block.name,
        (120, 10),
        dxfattribs={"layer": "ARRAY", "rotation": 90, "column_count": 3, "row_count": 2,
                    "column_spacing": 20, "row_spacing": 30},
    )
    return document, expected


def check_dxf_in(folder):
    for version in ["R12", "R2000", "R2010", "R2018"]:
        document, expected = drawing(version)
        for form in ["asc", "bin"]:
            file = folder / f"{version}_{form}.dxf"
            document.saveas(file, fmt=form)
            report = folder / "report.json"
            found = polygons(file, "--report", report, "--tolerance", "1e-3", status=3)
            of_layers = {}
            for polygon, properties in found:
                if version != "R12":
                    check(properties["units"] == "mm", f"{file.name}: units")
                of_layers.setdefault(properties["layer"], []).append(polygon)
            check(not {"OFF", "FROZEN"} & set(of_layers), f"{file.name}: layers that are not seen")
            for k, polygon in enumerate(expected):
                own = of_layers.get(f"L{k}", [])
                check(len(own) == 1, f"{file.name}: layer L{k} has {len(own)} polygons")
                same(own[0], polygon, polygon.area, f"{file.name}: layer L{k}")
            if version != "R12":
                boxes = sorted(tuple(round(v, 6) for v in p.bounds) for p in of_layers["ARRAY"])
                check(len(boxes) == 6, f"{file.name}: an array of six")
                x = sorted({box[0] for box in boxes})
                y = sorted({box[1] for box in boxes})
                check([round(b - a, 4) for a, b in zip(x, x[1:])] == [30], "rows turned to the left")
                check([round(b - a, 4) for a, b in zip(y, y[1:])] == [20, 20], "columns up")
            entries = json.loads(report.read_text())["features"]
            codes = sorted(e["code"] for f in entries for e in f["entries"] if e["action"] == "refused")
            check(codes == ["not_polygon", "open_chain"], f"{file.name}: {codes}")


def audited(file):
    document = ezdxf.readfile(file)
    auditor = document.audit()
    what = [str(entry.message) for entry in [*auditor.errors, *auditor.fixes]]
    check(not what, f"{file}: {what[:3]}")
    check(document.dxfversion >= "AC1015", "R2000 or later")
    return document


def check_dxf_out(folder):
    source = folder / "l.wkt"
    source.write_text("POLYGON ((0 0, 20 0, 20 10, 10 10, 10 20, 0 20, 0 0), (2 2, 4 2, 4 4, 2 4, 2 2))")
    file = folder / "offset.dxf"
    words = ["offset", source, "--distance=-1.5,0.5,1", "--regroup"]
    medial(*words, "-o", file)
    documents = [json.loads(line) for line in medial(*words, "--to", "json").splitlines()]
    lines = audited(file).modelspace().query("LWPOLYLINE")
    check(any(v[4] != 0 for line in lines for v in line), "arcs are bulges")
    areas = []
    for line in lines:
        vertices = line.get_points("xyb")
        area = 0
        for (x0, y0, bulge), (x1, y1, _) in zip(vertices, vertices[1:] + vertices[:1]):
            area += (x0 * y1 - y0 * x1) / 2
            if bulge:
                angle = 4 * math.atan(bulge)
                radius = math.dist((x0, y0), (x1, y1)) / 2 / math.sin(abs(angle) / 2)
                area += radius**2 / 2 * (angle - math.sin(angle))
        areas.append(abs(area))
    # Outer rings less holes.
    signed = sum(
        area * (1 if k == 0 else -1)
        for document in documents
        for polygon in document["polygons"]
        for k, area in zip(range(len(polygon)), [areas.pop(0) for _ in polygon])
    )
    total = sum(document["area"] for document in documents)
    check(abs(signed - total) < 1e-9 * total, f"offsets: {signed} and {total}")

    file = folder / "axis.dxf"
    medial("axis", source, "--keypoints", "-o", file)
    model = audited(file).modelspace()
    axis = json.loads(medial("axis", source, "--tolerance", "1e-6"))["features"]
    curves = [f["properties"]["curve"] for f in axis if f["geometry"]["type"] == "LineString"]
    check(len(model.query("SPLINE")) == curves.count("parabola"), "a spline for each parabola")
    check(len(model.query("LINE")) == curves.count("line"), "a line for each line")
    exact = [f for f in axis if f["properties"].get("curve") == "parabola"]
    for spline, feature in zip(model.query("SPLINE"), exact):
        line = shape(feature["geometry"])
        for p in spline.construction_tool().approximate(50):
            check(line.distance(Point(p.x, p.y)) < 1e-5, "splines are the parabolas")
    file = folder / "axis3d.dxf"
    medial("axis", source, "--z", "radius", "-o", file)
    for spline in audited(file).modelspace().query("SPLINE"):
        for p in spline.construction_tool().approximate(10):
            polygon = Polygon(*[[(0, 0), (20, 0), (20, 10), (10, 10), (10, 20), (0, 20)]],
                              [[(2, 2), (4, 2), (4, 4), (2, 4)]])
            check(abs(polygon.boundary.distance(Point(p.x, p.y)) - p.z) < 1e-9, "heights are radii")
    for command in [["smooth", source], ["centerline", source], ["walls", source, "--max", "3"],
                    ["branches", source], ["carve", source, "--angle", "60"], ["centerline", source, "--z", "radius"]]:
        medial(*command, "-o", file)
        check(len(audited(file).modelspace()) > 0, f"{command} writes entities")
    # Units pass through.
    given = folder / "given.dxf"
    document = ezdxf.new("R2010", units=ezdxf.units.IN)
    document.modelspace().add_circle((0, 0), 3)
    document.saveas(given)
    medial("axis", given, "-o", file)
    check(audited(file).header["$INSUNITS"] == ezdxf.units.IN, "units pass through")


def drawn(pen, kind):
    """A glyph of quadratic or cubic curves."""
    pen.moveTo((100, 0))
    if kind == "ttf":
        pen.qCurveTo((150, 300), (400, 350), (500, 0))
    else:
        pen.curveTo((150, 200), (300, 350), (500, 0))
    pen.lineTo((300, -100))
    pen.closePath()


def check_fonts(folder):
    for kind in ["ttf", "otf"]:
        builder = FontBuilder(1000, isTTF=kind == "ttf")
        builder.setupGlyphOrder([".notdef", "A", "B", "space"])
        builder.setupCharacterMap({65: "A", 66: "B", 32: "space"})
        glyphs = {}
        areas = {}
        for name in [".notdef", "A", "B", "space"]:
            pen = TTGlyphPen(None) if kind == "ttf" else T2CharStringPen(600, None)
            if name in "AB":
                drawn(pen, kind)
                area = AreaPen()
                drawn(area, kind)
                areas[name] = abs(area.value)
            glyphs[name] = pen.glyph() if kind == "ttf" else pen.getCharString()
        if kind == "ttf":
            builder.setupGlyf(glyphs)
        else:
            builder.setupCFF("Test", {}, glyphs, {})
        builder.setupHorizontalMetrics({n: (600, 100 if n in "AB" else 0) for n in glyphs})
        builder.setupHorizontalHeader(ascent=800, descent=-200)
        builder.setupNameTable({"familyName": "Test", "styleName": "Regular"})
        builder.setupOS2()
        builder.setupPost()
        builder.addOpenTypeFeatures("feature kern { pos A B -75; } kern;")
        file = folder / f"test.{kind}"
        builder.save(file)
        found = polygons(file, "--text", "AB A", "--tolerance", "0.01")
        told = [(p["char"], p["glyph"], p["x"]) for _, p in found]
        check(told == [("A", "A", 0), ("B", "B", 525), ("A", "A", 1725)], f"{kind}: {told}")
        for polygon, properties in found:
            area = areas[properties["glyph"]]
            check(abs(polygon.area - area) < 1e-3 * area, f"{kind}: {polygon.area} and {area}")
            check(abs(polygon.bounds[0] - properties["x"] - 100) < 1e-9, f"{kind}: moved by its place: {polygon.bounds}, {properties}")
        check(len(polygons(file)) == 2, "all glyphs with an outline")
        medial("axis", file, "--text", "Z", status=1)


def main():
    with tempfile.TemporaryDirectory() as folder:
        for each in [check_svg, check_dxf_in, check_dxf_out, check_fonts]:
            each(Path(folder))
    print(f"{N_CHECKS} checks of drawings hold")


main()
