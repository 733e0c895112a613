//! The boundary paths of hatches.

use super::chain::chains;
use super::entity::{Fields, arc, bulges, contour, of_spline};
use super::groups::Group;
use super::nest::Nest;
use crate::Error;
use crate::curves::{Arc, Contour, Nurbs};
use medial::geom::Point;
use std::f64::consts::TAU;

/// Which of the paths that lie in one another are filled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Style {
    /// Every other one.
    Nested,
    /// What lies between the outermost ones and those directly in them.
    Outermost,
    /// All that lies within the outermost ones.
    Ignore,
}

impl Style {
    pub fn of(fields: &Fields) -> Result<Self, Error> {
        Ok(match fields.whole_or(75, 0)? {
            1 => Self::Outermost,
            2 => Self::Ignore,
            _ => Self::Nested,
        })
    }

    /// The polygons that are filled of outlines with their holes.
    pub fn filled(self, mut nests: Vec<Nest>) -> Vec<Nest> {
        nests.retain(|nest| self == Self::Nested || nest.depth == 0);
        if self == Self::Ignore {
            nests.iter_mut().for_each(|nest| nest.rings.truncate(1));
        }
        nests
    }
}

/// The closed paths that bound a hatch.
pub(super) fn paths(fields: &Fields) -> Result<Vec<Contour>, Error> {
    let Some(start) = fields.0.iter().position(|group| group.code == 91) else {
        return Ok(Vec::new());
    };
    let mut reader = Reader { groups: &fields.0[start..] };
    let n = reader.whole(91)?;
    let mut paths = Vec::new();
    for _ in 0..n {
        let flags = reader.whole(92)?;
        if flags & 2 != 0 {
            paths.extend(reader.polyline()?);
            continue;
        }
        let n_edges = reader.whole(93)?;
        let mut edges = Vec::new();
        for _ in 0..n_edges {
            edges.push(reader.edge()?);
        }
        // Edges are in order in most files, not in all; what is open is closed by a straight line.
        paths.extend(chains(&edges).into_iter().map(|chain| chain.contour));
    }
    Ok(paths)
}

/// Groups in the order in which they must come.
struct Reader<'a> {
    groups: &'a [Group<'a>],
}

impl<'a> Reader<'a> {
    /// The next group with a code; others before it are passed over, but not the end of a path.
    fn next(&mut self, code: i32) -> Result<&'a Group<'a>, Error> {
        let found = self.groups.iter().position(|group| group.code == code);
        let Some(k) = found else {
            let place = self.groups.first().map_or(0, |group| group.line);
            let why = format!("the hatch has no group {code} where one is needed");
            return Err(Error::Value { place: format!("line {place}"), why });
        };
        let group = &self.groups[k];
        self.groups = &self.groups[k + 1..];
        Ok(group)
    }

    /// The next group if it has this code.
    fn maybe(&mut self, code: i32) -> Option<&'a Group<'a>> {
        let (group, rest) = self.groups.split_first()?;
        (group.code == code).then(|| {
            self.groups = rest;
            group
        })
    }

    fn real(&mut self, code: i32) -> Result<f64, Error> {
        self.next(code)?.real()
    }

    fn whole(&mut self, code: i32) -> Result<i64, Error> {
        self.next(code)?.whole()
    }

    fn point(&mut self, code: i32) -> Result<Point, Error> {
        Ok(Point::new(self.real(code)?, self.real(code + 10)?))
    }

    fn polyline(&mut self) -> Result<Option<Contour>, Error> {
        let n = self.whole(93)?;
        let mut vertices = Vec::new();
        for _ in 0..n {
            let p = self.point(10)?;
            let bulge = self.maybe(42).map_or(Ok(0.0), Group::bulge)?;
            vertices.push((p, bulge));
        }
        Ok(bulges(&vertices, true))
    }

    fn edge(&mut self) -> Result<Contour, Error> {
        let kind = self.next(72)?;
        match kind.whole()? {
            1 => {
                let mut line = Contour::new(self.point(10)?);
                line.line_to(self.point(11)?);
                Ok(line)
            }
            2 => {
                let (centre, radius) = (self.point(10)?, self.real(40)?);
                let angles = [self.real(50)?, self.real(51)?];
                Ok(match self.whole(73)? != 0 {
                    true => arc(centre, radius, angles),
                    // Angles of clockwise arcs count clockwise.
                    false => arc(centre, radius, [-angles[1], -angles[0]]).reversed(),
                })
            }
            3 => {
                let (centre, u) = (self.point(10)?, self.point(11)?);
                let ratio = self.real(40)?;
                let v = u.perp() * ratio;
                let angles = [self.real(50)?, self.real(51)?];
                let counterclockwise = self.whole(73)? != 0;
                let [from, to] = if counterclockwise { angles } else { [-angles[1], -angles[0]] };
                // The angle of a point as it is seen, as parameter of the ellipse.
                let parameter = |degrees: f64| {
                    let angle = degrees.to_radians();
                    let turns = (angle / TAU).round() * TAU;
                    (angle.sin() / ratio).atan2(angle.cos()) + turns
                };
                let is_full = ((to - from).abs() - 360.0).abs() < 1e-9;
                let mut sweep = parameter(to) - parameter(from);
                if is_full {
                    sweep = TAU;
                } else if sweep <= 0.0 {
                    sweep += TAU;
                }
                let ellipse = contour(Arc::around(centre, u, v, parameter(from), sweep));
                Ok(if counterclockwise { ellipse } else { ellipse.reversed() })
            }
            4 => {
                let degree = usize::try_from(self.whole(94)?).unwrap_or(0);
                let (n_knots, n_points) = (self.whole(95)?, self.whole(96)?);
                let mut knots = Vec::new();
                for _ in 0..n_knots {
                    knots.push(self.real(40)?);
                }
                let (mut points, mut weights) = (Vec::new(), Vec::new());
                for _ in 0..n_points {
                    points.push(self.point(10)?);
                    if let Some(weight) = self.maybe(42) {
                        weights.push(weight.real()?);
                    }
                }
                of_spline(&Nurbs { degree, knots, points, weights })
            }
            other => Err(kind.wrong(format!("there is no edge of type {other}"))),
        }
    }
}
