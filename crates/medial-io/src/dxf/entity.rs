//! Entities as outlines.

use super::groups::Group;
use crate::curves::{Affine, Arc, Bezier, Contour, Fit, Nurbs, Segment};
use crate::{Error, dxf::hatch};
use medial::geom::Point;
use std::f64::consts::TAU;

/// An entity with the entities that belong to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entity<'a> {
    /// Its groups, the first of which names it.
    pub groups: &'a [Group<'a>],
    /// Vertices and the like, up to the end of their sequence.
    pub parts: &'a [Group<'a>],
}

/// What an entity draws.
#[derive(Debug)]
pub(super) enum Drawn {
    /// A closed outline.
    Closed(Contour),
    /// A line, which may be closed by others.
    Open(Contour),
    /// What is filled, by the paths that bound it.
    Filled(Vec<Contour>, hatch::Style),
    /// Nothing that could bound a polygon.
    Other,
}

/// What stands in the groups of an entity.
pub(super) struct Fields<'a>(pub &'a [Group<'a>]);

impl Fields<'_> {
    pub fn find(&self, code: i32) -> Option<&Group<'_>> {
        self.0.iter().find(|group| group.code == code)
    }

    pub fn real(&self, code: i32) -> Result<Option<f64>, Error> {
        self.find(code).map(Group::real).transpose()
    }

    pub fn real_or(&self, code: i32, default: f64) -> Result<f64, Error> {
        Ok(self.real(code)?.unwrap_or(default))
    }

    pub fn whole_or(&self, code: i32, default: i64) -> Result<i64, Error> {
        Ok(self.find(code).map(Group::whole).transpose()?.unwrap_or(default))
    }

    fn needed(&self, code: i32) -> Result<f64, Error> {
        self.real(code)?.ok_or_else(|| Error::Value {
            place: format!("line {}", self.0.first().map_or(0, |group| group.line)),
            why: format!("the entity has no group {code}"),
        })
    }

    /// The point whose abscissa has this code; its ordinate has the code 10 higher.
    pub fn point(&self, code: i32) -> Result<Point, Error> {
        Ok(Point::new(self.needed(code)?, self.needed(code + 10)?))
    }

    /// All numbers with this code.
    pub fn reals(&self, code: i32) -> Result<Vec<f64>, Error> {
        self.0.iter().filter(|group| group.code == code).map(Group::real).collect()
    }

    /// All points whose abscissas have this code.
    pub fn points(&self, code: i32) -> Result<Vec<Point>, Error> {
        let (x, y) = (self.reals(code)?, self.reals(code + 10)?);
        Ok(x.into_iter().zip(y).map(|(x, y)| Point::new(x, y)).collect())
    }

    /// From the coordinates of the entity to the plane: its own are on a plane with a normal.
    pub fn plane(&self, elevation: i32) -> Result<Affine, Error> {
        let n = [self.real_or(210, 0.0)?, self.real_or(220, 0.0)?, self.real_or(230, 1.0)?];
        if n == [0.0, 0.0, 1.0] {
            return Ok(Affine::IDENTITY);
        }
        let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return Ok(Affine::IDENTITY);
        }
        let n = n.map(|c| c / length);
        let cross = |a: [f64; 3], b: [f64; 3]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let unit = |a: [f64; 3]| {
            let length = a.iter().map(|c| c * c).sum::<f64>().sqrt();
            a.map(|c| c / length)
        };
        // The arbitrary axis algorithm of the format.
        let near_z = n[0].abs() < 1.0 / 64.0 && n[1].abs() < 1.0 / 64.0;
        let x = unit(cross(if near_z { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] }, n));
        let y = unit(cross(n, x));
        let z = self.real_or(elevation, 0.0)?;
        Ok(Affine { a: x[0], b: x[1], c: y[0], d: y[1], e: z * n[0], f: z * n[1] })
    }
}

impl<'a> Entity<'a> {
    pub fn name(&self) -> String {
        self.groups.first().map(|group| group.text().into_owned()).unwrap_or_default()
    }

    pub fn fields(&self) -> Fields<'a> {
        Fields(self.groups)
    }

    /// What it draws, in the plane.
    pub fn drawn(&self) -> Result<Drawn, Error> {
        let fields = self.fields();
        match self.name().as_str() {
            "LINE" => {
                let mut line = Contour::new(fields.point(10)?);
                line.line_to(fields.point(11)?);
                Ok(Drawn::Open(line))
            }
            "LWPOLYLINE" => lightweight(&fields),
            "POLYLINE" => self.polyline(),
            "CIRCLE" => {
                let (centre, radius) = (fields.point(10)?, fields.needed(40)?.abs());
                let (u, v) = (Point::new(radius, 0.0), Point::new(0.0, radius));
                let circle = contour(Arc::around(centre, u, v, 0.0, TAU));
                Ok(Drawn::Closed(fields.plane(30)?.contour(&circle)))
            }
            "ARC" => {
                let arc = arc(
                    fields.point(10)?,
                    fields.needed(40)?,
                    [fields.needed(50)?, fields.needed(51)?],
                );
                Ok(Drawn::Open(fields.plane(30)?.contour(&arc)))
            }
            "ELLIPSE" => ellipse(&fields),
            "SPLINE" => spline(&fields),
            "SOLID" | "TRACE" => {
                let corners = [fields.point(10)?, fields.point(11)?, fields.point(12)?];
                let last = fields.point(13).unwrap_or(corners[2]);
                let mut solid = Contour::new(corners[0]);
                [corners[1], last, corners[2]].iter().for_each(|p| solid.line_to(*p));
                Ok(Drawn::Closed(fields.plane(30)?.contour(&solid)))
            }
            "HATCH" | "MPOLYGON" => {
                let plane = fields.plane(30)?;
                let paths = hatch::paths(&fields)?;
                let paths = paths.iter().map(|path| plane.contour(path)).collect();
                Ok(Drawn::Filled(paths, hatch::Style::of(&fields)?))
            }
            _ => Ok(Drawn::Other),
        }
    }

    fn polyline(&self) -> Result<Drawn, Error> {
        let fields = self.fields();
        let flags = fields.whole_or(70, 0)?;
        if flags & (16 | 64) != 0 {
            // A mesh.
            return Ok(Drawn::Other);
        }
        let mut vertices = Vec::new();
        for part in self.parts.chunk_by(|_, next| next.code != 0) {
            let vertex = Fields(part);
            // Not the frame of a spline.
            if part.first().is_some_and(|g| g.is(0, "VERTEX")) && vertex.whole_or(70, 0)? & 16 == 0
            {
                let bulge = vertex.find(42).map(Group::bulge).transpose()?;
                vertices.push((vertex.point(10)?, bulge.unwrap_or(0.0)));
            }
        }
        // Vertices in space have no plane of their own.
        let plane = if flags & 8 == 0 { fields.plane(30)? } else { Affine::IDENTITY };
        Ok(bulged(&vertices, flags & 1 != 0, &plane))
    }
}

fn lightweight(fields: &Fields) -> Result<Drawn, Error> {
    let mut vertices: Vec<(Point, f64)> = Vec::new();
    let mut x = None;
    for group in fields.0 {
        match group.code {
            10 => x = Some(group.real()?),
            20 => {
                let x = x.take().ok_or_else(|| group.wrong("there is no group 10 before it"))?;
                vertices.push((Point::new(x, group.real()?), 0.0));
            }
            42 => {
                if let Some((_, bulge)) = vertices.last_mut() {
                    *bulge = group.bulge()?;
                }
            }
            _ => {}
        }
    }
    Ok(bulged(&vertices, fields.whole_or(70, 0)? & 1 != 0, &fields.plane(38)?))
}

/// A polyline of vertices, each with the bulge of what follows.
fn bulged(vertices: &[(Point, f64)], closed: bool, plane: &Affine) -> Drawn {
    match bulges(vertices, closed) {
        Some(contour) if closed => Drawn::Closed(plane.contour(&contour)),
        Some(contour) => Drawn::Open(plane.contour(&contour)),
        None => Drawn::Other,
    }
}

pub(super) fn bulges(vertices: &[(Point, f64)], closed: bool) -> Option<Contour> {
    let (first, _) = vertices.first()?;
    let mut contour = Contour::new(*first);
    for pair in vertices.windows(2) {
        contour.bulge_to(pair[1].0, pair[0].1);
    }
    if let (true, Some((_, bulge))) = (closed, vertices.last()) {
        contour.bulge_to(*first, *bulge);
    }
    Some(contour)
}

pub(super) fn contour(arcs: Vec<Arc>) -> Contour {
    let start = arcs.first().map_or(Point::default(), |arc| arc.start);
    Contour { start, segments: arcs.into_iter().map(Segment::Arc).collect() }
}

/// An arc of a circle, counterclockwise between two angles in degrees.
pub(super) fn arc(centre: Point, radius: f64, [from, to]: [f64; 2]) -> Contour {
    let mut sweep = (to - from) % 360.0;
    if sweep <= 0.0 {
        sweep += 360.0;
    }
    let (u, v) = (Point::new(radius, 0.0), Point::new(0.0, radius));
    let mut arcs = Arc::around(centre, u, v, from.to_radians(), sweep.to_radians());
    // Quarters are exact.
    let place = |degrees: f64| centre + unit(degrees) * radius;
    if let Some(first) = arcs.first_mut() {
        first.start = place(from);
    }
    if let Some(last) = arcs.last_mut() {
        last.end = place(to);
    }
    contour(arcs)
}

fn unit(degrees: f64) -> Point {
    match degrees.rem_euclid(360.0) {
        0.0 => Point::new(1.0, 0.0),
        90.0 => Point::new(0.0, 1.0),
        180.0 => Point::new(-1.0, 0.0),
        270.0 => Point::new(0.0, -1.0),
        _ => {
            let (sin, cos) = degrees.to_radians().sin_cos();
            Point::new(cos, sin)
        }
    }
}

fn ellipse(fields: &Fields) -> Result<Drawn, Error> {
    let (centre, u) = (fields.point(10)?, fields.point(11)?);
    let (ux, uy, uz) = (u.x, u.y, fields.real_or(31, 0.0)?);
    let n = [fields.real_or(210, 0.0)?, fields.real_or(220, 0.0)?, fields.real_or(230, 1.0)?];
    let ratio = fields.needed(40)?;
    let v = Point::new(n[1] * uz - n[2] * uy, n[2] * ux - n[0] * uz) * ratio;
    let (from, to) = (fields.real_or(41, 0.0)?, fields.real_or(42, TAU)?);
    let sweep = to - from;
    // Full ellipses are often a few digits off.
    if sweep == 0.0 || (sweep.abs() - TAU).abs() < 1e-9 {
        return Ok(Drawn::Closed(contour(Arc::around(centre, u, v, from, TAU))));
    }
    let sweep = if sweep < 0.0 { sweep.rem_euclid(TAU) } else { sweep };
    Ok(Drawn::Open(contour(Arc::around(centre, u, v, from, sweep))))
}

fn spline(fields: &Fields) -> Result<Drawn, Error> {
    let points = fields.points(10)?;
    if points.is_empty() && fields.find(11).is_some() {
        return fitted(fields);
    }
    let degree = usize::try_from(fields.whole_or(71, 3)?).unwrap_or(0);
    let spline = Nurbs { degree, knots: fields.reals(40)?, points, weights: fields.reals(41)? };
    Ok(Drawn::Open(of_spline(&spline)?))
}

/// A spline that is given by the points it goes through: cubic, whatever its degree says.
fn fitted(fields: &Fields) -> Result<Drawn, Error> {
    /// The bits of a closed and of a periodic spline.
    const ROUND: i64 = 1 | 2;
    let tangent = |code: i32| match (fields.real(code)?, fields.real(code + 10)?) {
        (Some(x), Some(y)) => Ok::<_, Error>(Some(Point::new(x, y))),
        _ => Ok(None),
    };
    let closed = fields.whole_or(70, 0)? & ROUND != 0;
    let tangents = [tangent(12)?, tangent(13)?];
    let fit = Fit { points: fields.points(11)?, tangents, closed };
    let contour = of_curves(fit.beziers()?);
    Ok(if closed { Drawn::Closed(contour) } else { Drawn::Open(contour) })
}

fn of_curves(curves: Vec<Bezier>) -> Contour {
    let start = curves.first().map_or(Point::default(), Bezier::start);
    Contour { start, segments: curves.into_iter().map(Segment::Bezier).collect() }
}

pub(super) fn of_spline(spline: &Nurbs) -> Result<Contour, Error> {
    Ok(of_curves(spline.beziers()?))
}
