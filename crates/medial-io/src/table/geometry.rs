use serde::de::{Error as _, IgnoredAny, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;

/// A point with or without a third coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// First coordinate.
    pub x: f64,
    /// Second coordinate.
    pub y: f64,
    /// Third coordinate.
    pub z: Option<f64>,
}

/// A geometry of a table.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names are those of the standard")]
pub enum Geometry {
    Point(Place),
    LineString(Vec<Place>),
    Polygon(Vec<Vec<Place>>),
    MultiPoint(Vec<Place>),
    MultiLineString(Vec<Vec<Place>>),
    MultiPolygon(Vec<Vec<Vec<Place>>>),
}

/// What a geometry is, and whether it has a third coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct GeometryKind {
    /// Its number in well-known binary, from 1 for a point to 6 for a multipolygon.
    pub number: u32,
    /// Whether it has a third coordinate.
    pub in_space: bool,
}

impl GeometryKind {
    /// Its name in GeoJSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        const NAMES: [&str; 6] =
            ["Point", "LineString", "Polygon", "MultiPoint", "MultiLineString", "MultiPolygon"];
        NAMES[(self.number as usize).clamp(1, 6) - 1]
    }
}

impl Geometry {
    /// What it is.
    #[must_use]
    pub fn kind(&self) -> GeometryKind {
        let number = match self {
            Self::Point(_) => 1,
            Self::LineString(_) => 2,
            Self::Polygon(_) => 3,
            Self::MultiPoint(_) => 4,
            Self::MultiLineString(_) => 5,
            Self::MultiPolygon(_) => 6,
        };
        let mut in_space = false;
        self.each(&mut |place| in_space |= place.z.is_some());
        GeometryKind { number, in_space }
    }

    /// Its box: least x and y, greatest x and y; infinite the wrong way round if it has no points.
    #[must_use]
    pub fn bounds(&self) -> [f64; 4] {
        let mut found = EMPTY;
        self.each(&mut |place| found = joined(found, [place.x, place.y, place.x, place.y]));
        found
    }

    /// Calls `visit` with each point.
    pub fn each(&self, visit: &mut impl FnMut(Place)) {
        match self {
            Self::Point(place) => visit(*place),
            Self::LineString(places) | Self::MultiPoint(places) => {
                places.iter().for_each(|&place| visit(place));
            }
            Self::Polygon(lines) | Self::MultiLineString(lines) => {
                lines.iter().flatten().for_each(|&place| visit(place));
            }
            Self::MultiPolygon(polygons) => {
                polygons.iter().flatten().flatten().for_each(|&place| visit(place));
            }
        }
    }

    /// Appends its well-known binary, little-endian, ISO types with heights. Points without a height
    /// among others that have one get 0.
    pub fn to_wkb(&self, out: &mut Vec<u8>) {
        let GeometryKind { number, in_space } = self.kind();
        let head = |out: &mut Vec<u8>, number: u32| {
            out.push(1);
            out.extend((number + if in_space { 1000 } else { 0 }).to_le_bytes());
        };
        let place = |out: &mut Vec<u8>, place: &Place| {
            out.extend(place.x.to_le_bytes());
            out.extend(place.y.to_le_bytes());
            if in_space {
                out.extend(place.z.unwrap_or(0.0).to_le_bytes());
            }
        };
        let count = |out: &mut Vec<u8>, n: usize| out.extend((n as u32).to_le_bytes());
        let line = |out: &mut Vec<u8>, places: &[Place]| {
            count(out, places.len());
            places.iter().for_each(|each| place(out, each));
        };
        let lines = |out: &mut Vec<u8>, lines: &[Vec<Place>]| {
            count(out, lines.len());
            lines.iter().for_each(|each| line(out, each));
        };
        head(out, number);
        match self {
            Self::Point(at) => place(out, at),
            Self::LineString(places) => line(out, places),
            Self::Polygon(rings) => lines(out, rings),
            Self::MultiPoint(places) => {
                count(out, places.len());
                for at in places {
                    head(out, 1);
                    place(out, at);
                }
            }
            Self::MultiLineString(parts) => {
                count(out, parts.len());
                for part in parts {
                    head(out, 2);
                    line(out, part);
                }
            }
            Self::MultiPolygon(polygons) => {
                count(out, polygons.len());
                for rings in polygons {
                    head(out, 3);
                    lines(out, rings);
                }
            }
        }
    }

    /// The geometry that [`Geometry::to_wkb`] wrote; `None` for anything else.
    #[must_use]
    pub fn of_wkb(bytes: &[u8]) -> Option<Self> {
        let mut reader = Wkb { bytes };
        let geometry = reader.geometry(true)?;
        reader.bytes.is_empty().then_some(geometry)
    }
}

/// The box of nothing.
pub(crate) const EMPTY: [f64; 4] =
    [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];

/// The box around two.
pub(crate) fn joined(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])]
}

/// What is left of well-known binary.
struct Wkb<'a> {
    bytes: &'a [u8],
}

impl Wkb<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (taken, rest) = self.bytes.split_first_chunk()?;
        self.bytes = rest;
        Some(*taken)
    }

    fn count(&mut self) -> Option<usize> {
        let count = u32::from_le_bytes(self.take()?) as usize;
        // Everything that is counted has four bytes at least.
        (count <= self.bytes.len() / 4).then_some(count)
    }

    fn place(&mut self, in_space: bool) -> Option<Place> {
        let mut number = || self.take().map(f64::from_le_bytes);
        let (x, y) = (number()?, number()?);
        Some(Place { x, y, z: if in_space { Some(number()?) } else { None } })
    }

    fn line(&mut self, in_space: bool) -> Option<Vec<Place>> {
        (0..self.count()?).map(|_| self.place(in_space)).collect()
    }

    fn lines(&mut self, in_space: bool) -> Option<Vec<Vec<Place>>> {
        (0..self.count()?).map(|_| self.line(in_space)).collect()
    }

    fn geometry(&mut self, is_whole: bool) -> Option<Geometry> {
        let [1] = self.take::<1>()? else { return None };
        let kind = u32::from_le_bytes(self.take()?);
        let in_space = kind > 1000;
        Some(match kind % 1000 {
            1 => Geometry::Point(self.place(in_space)?),
            2 => Geometry::LineString(self.line(in_space)?),
            3 => Geometry::Polygon(self.lines(in_space)?),
            4 if is_whole => Geometry::MultiPoint(self.parts(|part| match part {
                Geometry::Point(place) => Some(place),
                _ => None,
            })?),
            5 if is_whole => Geometry::MultiLineString(self.parts(|part| match part {
                Geometry::LineString(places) => Some(places),
                _ => None,
            })?),
            6 if is_whole => Geometry::MultiPolygon(self.parts(|part| match part {
                Geometry::Polygon(rings) => Some(rings),
                _ => None,
            })?),
            _ => return None,
        })
    }

    fn parts<T>(&mut self, of: impl Fn(Geometry) -> Option<T>) -> Option<Vec<T>> {
        (0..self.count()?).map(|_| of(self.geometry(false)?)).collect()
    }
}

impl<'de> Deserialize<'de> for Place {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Numbers;
        impl<'de> Visitor<'de> for Numbers {
            type Value = Place;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a position")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut numbers: A) -> Result<Place, A::Error> {
                let short = || A::Error::custom("a position needs two numbers");
                let x = numbers.next_element()?.ok_or_else(short)?;
                let y = numbers.next_element()?.ok_or_else(short)?;
                let z = numbers.next_element()?;
                if z.is_some() {
                    while numbers.next_element::<IgnoredAny>()?.is_some() {}
                }
                Ok(Place { x, y, z })
            }
        }
        deserializer.deserialize_seq(Numbers)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn well_known_binary_reads_back() {
        let at = |x: f64, z| Place { x, y: 0.1 + x, z };
        let line = |z| vec![at(0.0, z), at(1.0 / 3.0, z), at(-5e-324, z)];
        for z in [None, Some(0.5)] {
            let geometries = [
                Geometry::Point(at(7.0, z)),
                Geometry::LineString(line(z)),
                Geometry::Polygon(vec![line(z), line(z)]),
                Geometry::MultiPoint(line(z)),
                Geometry::MultiLineString(vec![line(z), line(z)]),
                Geometry::MultiPolygon(vec![vec![line(z)], vec![line(z), line(z)]]),
            ];
            for geometry in geometries {
                let mut bytes = Vec::new();
                geometry.to_wkb(&mut bytes);
                assert_eq!(Geometry::of_wkb(&bytes).as_ref(), Some(&geometry));
                assert_eq!(Geometry::of_wkb(&bytes[..bytes.len() - 1]), None);
                assert_eq!(geometry.kind().in_space, z.is_some());
            }
        }
    }
}
