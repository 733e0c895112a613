use crate::text::lines;
use crate::{Error, Feature, FeatureError, Layer};
use medial::geom::Point;

/// Deepest nesting of collections; protects the stack against made-up input.
const MAX_NESTING: u32 = 32;

/// Reads one geometry after the other.
///
/// Binary geometries after a malformed one cannot be found, so it is the last item of the layer;
/// in hexadecimal text every line stands for itself.
///
/// # Errors
/// If there is nothing to read.
pub fn read(bytes: &[u8]) -> Result<Layer<'_>, Error> {
    match bytes.iter().find(|byte| !byte.is_ascii_whitespace()) {
        None => Err(Error::Empty),
        Some(b'0') => Ok(hexadecimal(crate::text(bytes)?)),
        Some(_) => Ok(binary(bytes)),
    }
}

fn binary(bytes: &[u8]) -> Layer<'_> {
    let mut reader = Reader { bytes, at: 0, little: true };
    let mut index = 0;
    Layer::new(std::iter::from_fn(move || {
        if reader.at >= reader.bytes.len() {
            return None;
        }
        let result = feature(&mut reader, index);
        if result.is_err() {
            reader.at = reader.bytes.len();
        }
        index += 1;
        Some(result)
    }))
}

fn hexadecimal(text: &str) -> Layer<'_> {
    Layer::of_slices(text, lines(text), hexadecimal_line)
}

fn hexadecimal_line(text: &str, line: &str, index: usize) -> Result<Feature, FeatureError> {
    let digit = |byte: u8| char::from(byte).to_digit(16);
    let pairs = line.as_bytes().chunks(2);
    let bytes: Option<Vec<u8>> = pairs
        .map(|pair| match *pair {
            [high, low] => Some((16 * digit(high)? + digit(low)?) as u8),
            _ => None,
        })
        .collect();
    let bytes = bytes.ok_or_else(|| {
        let why = "a line of pairs of hexadecimal digits is expected";
        let error = crate::text::syntax_at(text, crate::text::offset(text, line), why);
        FeatureError { feature: index, id: None, error }
    })?;
    feature(&mut Reader { bytes: &bytes, at: 0, little: true }, index)
}

/// Reads the only geometry in some bytes into a feature.
///
/// # Errors
/// If it is malformed, or something follows it.
pub(crate) fn read_alone(bytes: &[u8], feature: &mut Feature) -> Result<(), Error> {
    let mut reader = Reader { bytes, at: 0, little: true };
    geometry(&mut reader, feature, 0)?;
    let left = bytes.len() - reader.at;
    if left > 0 {
        return Err(reader.wrong(format!("{left} bytes follow the geometry")));
    }
    Ok(())
}

fn feature(reader: &mut Reader, index: usize) -> Result<Feature, FeatureError> {
    let mut feature = Feature::numbered(index);
    match geometry(reader, &mut feature, 0) {
        Ok(()) => Ok(feature),
        Err(error) => Err(FeatureError { feature: index, id: None, error }),
    }
}

struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    little: bool,
}

impl Reader<'_> {
    fn wrong(&self, why: impl Into<String>) -> Error {
        Error::Value { place: format!("byte {}", self.at), why: why.into() }
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], Error> {
        let taken = self.bytes.get(self.at..).and_then(<[u8]>::first_chunk::<N>).copied();
        let mut taken = taken.ok_or_else(|| self.wrong("the geometry ends too early"))?;
        self.at += N;
        if !self.little {
            taken.reverse();
        }
        Ok(taken)
    }

    /// A count of things of at least `size` bytes: no more than there are bytes left.
    fn count(&mut self, size: usize) -> Result<usize, Error> {
        let count = u32::from_le_bytes(self.take()?) as usize;
        if count > (self.bytes.len() - self.at) / size {
            self.at -= 4;
            return Err(self.wrong(format!("a count of {count} is more than there is")));
        }
        Ok(count)
    }

    fn points(&mut self, dimensions: usize) -> Result<Vec<Point>, Error> {
        let count = self.count(8 * dimensions)?;
        (0..count).map(|_| self.point(dimensions)).collect()
    }

    fn point(&mut self, dimensions: usize) -> Result<Point, Error> {
        let [x, y] = [self.take()?, self.take()?].map(f64::from_le_bytes);
        for _ in 2..dimensions {
            self.take::<8>()?;
        }
        Ok(Point::new(x, y))
    }
}

fn geometry(reader: &mut Reader, feature: &mut Feature, depth: u32) -> Result<(), Error> {
    reader.little = match reader.take::<1>()? {
        [0] => false,
        [1] => true,
        [other] => return Err(reader.wrong(format!("{other} is no byte order"))),
    };
    let word = u32::from_le_bytes(reader.take()?);
    if word & 0x2000_0000 != 0 {
        reader.take::<4>()?; // number of the reference system
    }
    let (kind, more) = (word & 0x0fff_ffff, word >> 30);
    let dimensions = 2 + match kind / 1000 {
        0 => more.count_ones() as usize,
        3 => 2,
        _ => 1,
    };
    const NAMES: [&str; 17] = [
        "Point",
        "LineString",
        "Polygon",
        "MultiPoint",
        "MultiLineString",
        "MultiPolygon",
        "GeometryCollection",
        "CircularString",
        "CompoundCurve",
        "CurvePolygon",
        "MultiCurve",
        "MultiSurface",
        "",
        "",
        "PolyhedralSurface",
        "TIN",
        "Triangle",
    ];
    let name = (kind % 1000).checked_sub(1).and_then(|k| NAMES.get(k as usize));
    let Some(&name) = name.filter(|name| kind < 4000 && !name.is_empty()) else {
        return Err(reader.wrong(format!("geometries of type {kind} are not known")));
    };
    if depth == 0 {
        feature.geometry = format!("a {name}");
    }
    match name {
        "Point" => drop(reader.point(dimensions)?),
        "LineString" | "CircularString" => drop(reader.points(dimensions)?),
        "Polygon" => {
            let rings = reader.count(4)?;
            let rings: Result<Vec<_>, _> = (0..rings).map(|_| reader.points(dimensions)).collect();
            feature.add_polygon(rings?);
        }
        "Triangle" => {
            for _ in 0..reader.count(4)? {
                reader.points(dimensions)?;
            }
        }
        _ if depth == MAX_NESTING => {
            return Err(reader.wrong(format!("collections are nested deeper than {MAX_NESTING}")));
        }
        "CompoundCurve" | "CurvePolygon" | "MultiCurve" | "MultiSurface" | "PolyhedralSurface"
        | "TIN" => {
            // Arcs are no edges, and a part of a shape is none.
            let mut parts = Feature { geometry: format!("a {name}"), ..Feature::default() };
            let n_parts = reader.count(5)?;
            for _ in 0..n_parts {
                geometry(reader, &mut parts, depth + 1)?;
            }
            if name == "MultiSurface" && parts.polygons.len() == n_parts {
                feature.polygonal = true;
                feature.polygons.append(&mut parts.polygons);
            }
        }
        _ => {
            feature.polygonal |= name == "MultiPolygon";
            for _ in 0..reader.count(5)? {
                geometry(reader, feature, depth + 1)?;
            }
        }
    }
    // Points of a multipoint are not told one by one.
    if depth > 0
        && !name.starts_with("Multi")
        && !matches!(name, "Polygon" | "GeometryCollection")
        && feature.geometry.ends_with("Collection")
    {
        feature.leave_out(name);
    }
    Ok(())
}
