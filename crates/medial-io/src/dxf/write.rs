//! Axes, parallel curves and records as DXF of version R2000 (AC1015).
//!
//! # Contract
//! Nothing is flattened: lines are LINE, parabolas SPLINE of degree 2, arcs bulges of LWPOLYLINE. With radii
//! as heights paths are exact too, as rational splines.

use crate::Drawing;
use crate::number::push_shortest;
use crate::path::{records, shown_keypoints};
use crate::record::{Record, Shape};
use medial::axis::{Curve, CurveKind, KeypointKind, MedialAxis};
use medial::geom::Point;
use medial::ops::{Outline, Stroke};
use std::fmt::Write as _;

/// The layers of what is written, with their colours by number.
const LAYERS: [(&str, u8); 12] = [
    ("axis_line", 5),
    ("axis_polyline", 5),
    ("axis_parabola", 4),
    ("keypoint_end", 8),
    ("keypoint_transition", 3),
    ("keypoint_junction", 1),
    ("keypoint_tip", 6),
    ("keypoint_clipped", 9),
    ("offset", 2),
    ("polygon", 7),
    ("line", 5),
    ("point", 1),
];

/// Stands for the handle of an entity until [`number`] gives it one.
const HANDLE: u8 = 1;

/// Handle of the model space, which all entities name as their owner.
const MODEL_SPACE: u32 = 0x1F;

/// First handle of an entity.
const FIRST: u64 = 0x100;

/// What follows the entities.
pub const FOOTER: &str = "0\nENDSEC\n0\nSECTION\n2\nOBJECTS\n0\nDICTIONARY\n5\nC\n330\n0\n100\nAcDbDictionary\n\
    281\n1\n3\nACAD_GROUP\n350\nD\n0\nDICTIONARY\n5\nD\n330\nC\n100\nAcDbDictionary\n281\n1\n0\nENDSEC\n0\nEOF\n";

/// What comes before the entities; `units` as [`Layer::units`](crate::Layer) has them.
#[must_use]
pub fn header(units: Option<&str>) -> String {
    let number = super::read::UNITS.iter().find(|(_, name)| Some(*name) == units);
    let number = number.map_or(0, |(number, _)| *number);
    // Inches, feet, miles, mils and yards are imperial, those of surveys too.
    let metric = i32::from(!matches!(number, 1..=3 | 8..=10 | 21..=24));
    let mut out = format!(
        "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$DWGCODEPAGE\n3\nANSI_1252\n9\n$HANDSEED\n5\nFFFFFFF\n\
         9\n$INSUNITS\n70\n{number}\n9\n$MEASUREMENT\n70\n{metric}\n0\nENDSEC\n0\nSECTION\n2\nTABLES\n"
    );
    table(&mut out, "VPORT", 0x8, &[]);
    let ltype =
        |name: &str, text: &str| format!("2\n{name}\n70\n0\n3\n{text}\n72\n65\n73\n0\n40\n0.0\n");
    let ltypes = [
        (0x14, "LTYPE", "AcDbLinetypeTableRecord", ltype("ByBlock", "")),
        (0x15, "LTYPE", "AcDbLinetypeTableRecord", ltype("ByLayer", "")),
        (0x16, "LTYPE", "AcDbLinetypeTableRecord", ltype("Continuous", "Solid line")),
    ];
    table(&mut out, "LTYPE", 0x5, &ltypes);
    let layer = |name: &str, color: u8| format!("2\n{name}\n70\n0\n62\n{color}\n6\nContinuous\n");
    let layers: Vec<_> = std::iter::once(("0", 7))
        .chain(LAYERS)
        .zip(0x30..)
        .map(|((name, color), handle)| {
            (handle, "LAYER", "AcDbLayerTableRecord", layer(name, color))
        })
        .collect();
    table(&mut out, "LAYER", 0x2, &layers);
    let style =
        "2\nStandard\n70\n0\n40\n0.0\n41\n1.0\n50\n0.0\n71\n0\n42\n2.5\n3\ntxt\n4\n\n".to_owned();
    table(&mut out, "STYLE", 0x3, &[(0x11, "STYLE", "AcDbTextStyleTableRecord", style)]);
    table(&mut out, "VIEW", 0x6, &[]);
    table(&mut out, "UCS", 0x7, &[]);
    let acad = "2\nACAD\n70\n0\n".to_owned();
    table(&mut out, "APPID", 0x9, &[(0x12, "APPID", "AcDbRegAppTableRecord", acad)]);
    let dimstyle = "2\nStandard\n70\n0\n".to_owned();
    table(&mut out, "DIMSTYLE", 0xA, &[(0x27, "DIMSTYLE", "AcDbDimStyleTableRecord", dimstyle)]);
    let blocks = [("*Model_Space", MODEL_SPACE), ("*Paper_Space", 0x1B)];
    let records = blocks.map(|(name, handle)| {
        let record = "AcDbBlockTableRecord";
        (handle, "BLOCK_RECORD", record, format!("2\n{name}\n340\n0\n"))
    });
    table(&mut out, "BLOCK_RECORD", 0x1, &records);
    out.push_str("0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n");
    for ((name, record), handle) in blocks.into_iter().zip([0x20, 0x1C]) {
        let paper = if record == MODEL_SPACE { "" } else { "67\n1\n" };
        let _ = write!(
            out,
            "0\nBLOCK\n5\n{handle:X}\n330\n{record:X}\n100\nAcDbEntity\n{paper}8\n0\n100\nAcDbBlockBegin\n\
             2\n{name}\n70\n0\n10\n0.0\n20\n0.0\n30\n0.0\n3\n{name}\n1\n\n0\nENDBLK\n5\n{:X}\n330\n{record:X}\n\
             100\nAcDbEntity\n{paper}8\n0\n100\nAcDbBlockEnd\n",
            handle + 1
        );
    }
    out.push_str("0\nENDSEC\n0\nSECTION\n2\nENTITIES\n");
    out
}

/// A table of records: handle, name, class and content.
fn table(out: &mut String, name: &str, handle: u32, records: &[(u32, &str, &str, String)]) {
    let _ = write!(
        out,
        "0\nTABLE\n2\n{name}\n5\n{handle:X}\n330\n0\n100\nAcDbSymbolTable\n70\n{}\n",
        records.len()
    );
    if name == "DIMSTYLE" {
        let _ = write!(out, "100\nAcDbDimStyleTable\n71\n{}\n", records.len());
    }
    for (record, kind, class, content) in records {
        // Dimension styles have their handle elsewhere.
        let code = if name == "DIMSTYLE" { 105 } else { 5 };
        let _ = write!(
            out,
            "0\n{kind}\n{code}\n{record:X}\n330\n{handle:X}\n100\nAcDbSymbolTableRecord\n100\n{class}\n{content}"
        );
    }
    out.push_str("0\nENDTAB\n");
}

/// Gives each entity in the bytes a handle, in order, behind so many that have one.
#[must_use]
pub fn number(bytes: &[u8], n_before: &mut u64) -> Vec<u8> {
    let mut out = Vec::with_capacity(bytes.len() + bytes.len() / 8);
    for (k, part) in bytes.split(|b| *b == HANDLE).enumerate() {
        if k > 0 {
            out.extend_from_slice(format!("{:X}", FIRST + *n_before).as_bytes());
            *n_before += 1;
        }
        out.extend_from_slice(part);
    }
    out
}

/// Entities of results, to be [numbered](number) and put between [`header`] and [`FOOTER`].
#[derive(Debug, Default)]
pub struct Entities {
    text: String,
}

impl Entities {
    /// Their text.
    #[must_use]
    pub fn into_text(self) -> String {
        self.text
    }

    /// Adds the paths of an axis, and its keypoints if they are asked for; with radii as heights or flat.
    pub fn axis(&mut self, axis: &MedialAxis, keypoints: bool, radius_as_z: bool) {
        let drawing = Drawing { keypoints, radius_as_z, ..Drawing::default() };
        for line in records(axis, drawing) {
            match (&line.curves[..], radius_as_z) {
                ([_, _, ..], false) => {
                    let points = line.points(drawing, 0.0).into_iter().map(|(p, _)| (p, 0.0));
                    self.polyline("axis_polyline", &points.collect::<Vec<_>>(), false);
                }
                (curves, _) => curves.iter().for_each(|curve| self.curve(curve, radius_as_z)),
            }
        }
        let shown = if keypoints { shown_keypoints(axis, drawing) } else { Vec::new() };
        for k in shown {
            let keypoint = axis.keypoints().at(k);
            let layer = match keypoint.kind {
                KeypointKind::End => "keypoint_end",
                KeypointKind::Transition => "keypoint_transition",
                KeypointKind::Junction => "keypoint_junction",
                KeypointKind::Clipped => "keypoint_clipped",
                _ => "keypoint_tip",
            };
            let z = if radius_as_z { keypoint.radius } else { 0.0 };
            self.point(layer, keypoint.position, z);
        }
    }

    fn curve(&mut self, curve: &Curve, radius_as_z: bool) {
        let layer = match curve.kind() {
            CurveKind::Parabola => "axis_parabola",
            _ => "axis_line",
        };
        let (a, b) = (curve.from(), curve.to());
        let (za, zb) = match radius_as_z {
            true => (curve.radius_from(), curve.radius_to()),
            false => (0.0, 0.0),
        };
        let middle = match radius_as_z {
            true => curve.control_in_space(),
            false => curve.control().map(|control| (control, 0.0, 1.0)),
        };
        match middle {
            Some((p, z, weight)) => self.spline(layer, [(a, za), (p, z), (b, zb)], weight),
            None => self.line(layer, [(a, za), (b, zb)]),
        }
    }

    /// Adds a parallel curve, an entity for each contour.
    pub fn outline(&mut self, outline: &Outline) {
        for contour in outline.polygons.iter().flat_map(|polygon| &polygon.0) {
            let vertex = |stroke: Stroke| match stroke {
                Stroke::Line { from, .. } => vec![(from, 0.0)],
                Stroke::Arc { from, to, centre, sense, angle, radius } => {
                    let sign = match sense {
                        medial::ops::Sense::Counterclockwise => 1.0,
                        medial::ops::Sense::Clockwise => -1.0,
                    };
                    if from != to {
                        return vec![(from, sign * (0.25 * angle).tan())];
                    }
                    // A full circle has no bulge; two halves have.
                    let start = from - centre;
                    let opposite = centre - start * (radius / start.norm());
                    vec![(from, sign), (opposite, sign)]
                }
            };
            let vertices: Vec<_> = contour.strokes().into_iter().flat_map(vertex).collect();
            self.polyline("offset", &vertices, true);
        }
    }

    /// Adds the shapes of records.
    pub fn records(&mut self, records: &[Record]) {
        for record in records {
            match &record.shape {
                Shape::Point(p) => self.point("point", *p, 0.0),
                Shape::PointInSpace(p, z) => self.point("point", *p, *z),
                Shape::Line(points) => match points[..] {
                    [a, b] => self.line("line", [(a, 0.0), (b, 0.0)]),
                    _ => self.straight("line", points, false),
                },
                Shape::LineInSpace(points) => self.line_in_space("line", points),
                Shape::Lines(lines) => {
                    lines.iter().for_each(|points| self.straight("line", points, false));
                }
                Shape::Polygons(polygons) => {
                    polygons.iter().flatten().for_each(|ring| self.straight("polygon", ring, true));
                }
            }
        }
    }

    /// Adds lines of points with heights, or without.
    pub fn lines(&mut self, lines: &[Vec<(Point, f64)>], z: bool) {
        for line in lines {
            if z {
                self.line_in_space("line", line);
            } else {
                let points: Vec<Point> = line.iter().map(|(p, _)| *p).collect();
                self.straight("line", &points, false);
            }
        }
    }

    fn straight(&mut self, layer: &str, points: &[Point], closed: bool) {
        let vertices: Vec<_> = points.iter().map(|p| (*p, 0.0)).collect();
        self.polyline(layer, &vertices, closed);
    }

    fn begin(&mut self, kind: &str, layer: &str, class: &str) {
        let handle = char::from(HANDLE);
        let _ = write!(
            self.text,
            "0\n{kind}\n5\n{handle}\n330\n{MODEL_SPACE:X}\n100\nAcDbEntity\n8\n{layer}\n100\n{class}\n"
        );
    }

    fn real(&mut self, code: u32, value: f64) {
        let _ = writeln!(self.text, "{code}");
        push_shortest(&mut self.text, value);
        self.text.push('\n');
    }

    fn place(&mut self, code: u32, p: Point, z: f64) {
        self.real(code, p.x);
        self.real(code + 10, p.y);
        self.real(code + 20, z);
    }

    fn point(&mut self, layer: &str, p: Point, z: f64) {
        self.begin("POINT", layer, "AcDbPoint");
        self.place(10, p, z);
    }

    fn line(&mut self, layer: &str, [(a, za), (b, zb)]: [(Point, f64); 2]) {
        self.begin("LINE", layer, "AcDbLine");
        self.place(10, a, za);
        self.place(11, b, zb);
    }

    fn polyline(&mut self, layer: &str, vertices: &[(Point, f64)], closed: bool) {
        self.begin("LWPOLYLINE", layer, "AcDbPolyline");
        let _ = write!(self.text, "90\n{}\n70\n{}\n", vertices.len(), u8::from(closed));
        for (p, bulge) in vertices {
            self.real(10, p.x);
            self.real(20, p.y);
            if *bulge != 0.0 {
                self.real(42, *bulge);
            }
        }
    }

    fn line_in_space(&mut self, layer: &str, points: &[(Point, f64)]) {
        self.begin("POLYLINE", layer, "AcDb3dPolyline");
        self.text.push_str("66\n1\n10\n0.0\n20\n0.0\n30\n0.0\n70\n8\n");
        for (p, z) in points {
            self.begin("VERTEX", layer, "AcDbVertex\n100\nAcDb3dPolylineVertex");
            self.place(10, *p, *z);
            self.text.push_str("70\n32\n");
        }
        let handle = char::from(HANDLE);
        let _ = write!(
            self.text,
            "0\nSEQEND\n5\n{handle}\n330\n{MODEL_SPACE:X}\n100\nAcDbEntity\n8\n{layer}\n"
        );
    }

    /// A spline of degree 2 whose middle control point has a weight.
    fn spline(&mut self, layer: &str, points: [(Point, f64); 3], weight: f64) {
        self.begin("SPLINE", layer, "AcDbSpline");
        let is_rational = weight != 1.0;
        let flags =
            if is_rational { 4 } else { 0 } + if points.iter().all(|p| p.1 == 0.0) { 8 } else { 0 };
        let _ =
            write!(self.text, "70\n{flags}\n71\n2\n72\n6\n73\n3\n74\n0\n42\n1e-10\n43\n1e-10\n");
        for knot in [0, 0, 0, 1, 1, 1] {
            let _ = write!(self.text, "40\n{knot}.0\n");
        }
        if is_rational {
            for weight in [1.0, weight, 1.0] {
                self.real(41, weight);
            }
        }
        for (p, z) in points {
            self.place(10, p, z);
        }
    }
}
