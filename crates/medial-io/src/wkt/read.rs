use super::scanner::{Scanner, Token};
use crate::{Error, Feature, FeatureError, Layer, Note};
use medial::geom::Point;

/// Deepest nesting of collections; protects the stack against made-up input.
const MAX_NESTING: u32 = 32;

/// Reads one geometry after the other, on a line each or spread over several.
///
/// A geometry that is malformed is an item of the layer; reading goes on at the next line that
/// begins with a letter.
#[must_use]
pub fn read(text: &str) -> Layer<'_> {
    let mut scanner = Scanner::new(text);
    let mut index = 0;
    Layer::new(std::iter::from_fn(move || {
        if !scanner.at_geometry() {
            return None;
        }
        let mut feature = Feature::numbered(index);
        index += 1;
        let start = scanner.place();
        let result = geometry(&mut scanner, &mut feature, 0);
        Some(result.map(|()| feature).map_err(|error| {
            scanner.skip_to_next_geometry(start);
            FeatureError { feature: index - 1, id: None, error }
        }))
    }))
}

fn geometry(scanner: &mut Scanner, feature: &mut Feature, depth: u32) -> Result<(), Error> {
    scanner.skip_srid();
    let what = "a geometry such as POLYGON";
    let Token::Word(word) = scanner.peek() else { return Err(scanner.expected(what)) };
    let tag = Tag::of(word).ok_or_else(|| scanner.expected(what))?;
    scanner.take();
    // `POLYGON Z (…)`; some writers join the letters, which the tag has taken off.
    if let Token::Word(word) = scanner.peek()
        && ["z", "m", "zm"].contains(&word.to_ascii_lowercase().as_str())
    {
        scanner.take();
    }
    if depth == 0 {
        feature.geometry = format!("a {}", tag.name());
    }
    if let Token::Word(word) = scanner.peek()
        && word.eq_ignore_ascii_case("empty")
    {
        scanner.take();
        feature.polygonal |= matches!(tag, Tag::Polygon | Tag::MultiPolygon);
        if depth == 0 && matches!(tag, Tag::Points(_)) {
            feature.points = Some(Vec::new());
        }
        return Ok(());
    }
    match tag {
        Tag::Polygon => feature.add_polygon(polygon(scanner)?),
        Tag::MultiPolygon => {
            feature.polygonal = true;
            list(scanner, |scanner| {
                feature.add_polygon(polygon(scanner)?);
                Ok(())
            })?;
        }
        Tag::Collection if depth == MAX_NESTING => {
            return Err(scanner.expected(&format!("at most {MAX_NESTING} nested collections")));
        }
        Tag::Collection => list(scanner, |scanner| geometry(scanner, feature, depth + 1))?,
        Tag::LineString => {
            let points = ring(scanner)?;
            line(points, feature, depth);
        }
        Tag::Points(_) if depth == 0 => feature.points = Some(points(scanner)?),
        Tag::Points(name) | Tag::Other(name) => {
            skip(scanner)?;
            if depth > 0 {
                feature.leave_out(name);
            }
        }
    }
    Ok(())
}

/// A closed line is taken for the ring of a polygon, as simple tools write rings.
fn line(points: Vec<Point>, feature: &mut Feature, depth: u32) {
    if points.len() >= 4 && points.first() == points.last() {
        feature.notes.push(Note {
            code: "line_as_ring",
            text: "the closed LINESTRING is taken for the ring of a polygon".to_owned(),
        });
        feature.add_polygon(vec![points]);
    } else if depth > 0 {
        feature.leave_out("LINESTRING");
    }
}

fn polygon(scanner: &mut Scanner) -> Result<Vec<Vec<Point>>, Error> {
    let mut rings = Vec::new();
    list(scanner, |scanner| {
        rings.push(ring(scanner)?);
        Ok(())
    })?;
    Ok(rings)
}

fn ring(scanner: &mut Scanner) -> Result<Vec<Point>, Error> {
    let mut points = Vec::new();
    list(scanner, |scanner| {
        points.push(Point::new(scanner.number()?, scanner.number()?));
        while let Token::Word(_) = scanner.peek() {
            scanner.number()?;
        }
        Ok(())
    })?;
    Ok(points)
}

/// The point of a POINT, or those of a MULTIPOINT, each within brackets or not.
fn points(scanner: &mut Scanner) -> Result<Vec<Point>, Error> {
    let mut points = Vec::new();
    list(scanner, |scanner| match scanner.peek() {
        Token::Word(word) if word.eq_ignore_ascii_case("empty") => {
            scanner.take();
            Ok(())
        }
        Token::Open => {
            scanner.take();
            points.push(point(scanner)?);
            scanner.expect(Token::Close, "`)`")
        }
        _ => {
            points.push(point(scanner)?);
            Ok(())
        }
    })?;
    Ok(points)
}

fn point(scanner: &mut Scanner) -> Result<Point, Error> {
    let point = Point::new(scanner.finite()?, scanner.finite()?);
    while let Token::Word(_) = scanner.peek() {
        scanner.number()?;
    }
    Ok(point)
}

/// `( item, item, … )` or `EMPTY`.
fn list(
    scanner: &mut Scanner,
    mut item: impl FnMut(&mut Scanner) -> Result<(), Error>,
) -> Result<(), Error> {
    if let Token::Word(word) = scanner.peek()
        && word.eq_ignore_ascii_case("empty")
    {
        scanner.take();
        return Ok(());
    }
    scanner.expect(Token::Open, "`(`")?;
    loop {
        item(scanner)?;
        match scanner.peek() {
            Token::Comma => scanner.take(),
            Token::Close => {
                scanner.take();
                return Ok(());
            }
            _ => return Err(scanner.expected("`,` or `)`")),
        };
    }
}

/// A bracketed group of anything.
fn skip(scanner: &mut Scanner) -> Result<(), Error> {
    scanner.expect(Token::Open, "`(`")?;
    let mut open = 1_usize;
    while open > 0 {
        match scanner.peek() {
            Token::Open => open += 1,
            Token::Close => open -= 1,
            Token::End => return Err(scanner.expected("`)`")),
            Token::Comma | Token::Word(_) => {}
        }
        scanner.take();
    }
    Ok(())
}

#[derive(Clone, Copy)]
enum Tag {
    Polygon,
    MultiPolygon,
    Collection,
    LineString,
    Points(&'static str),
    Other(&'static str),
}

impl Tag {
    /// The kind of geometry a word names, with or without Z and M at its end.
    fn of(word: &str) -> Option<Self> {
        const POINTS: [&str; 2] = ["POINT", "MULTIPOINT"];
        const OTHERS: [&str; 8] = [
            "MULTILINESTRING",
            "CIRCULARSTRING",
            "COMPOUNDCURVE",
            "CURVEPOLYGON",
            "MULTICURVE",
            "MULTISURFACE",
            "TIN",
            "POLYHEDRALSURFACE",
        ];
        let upper = word.to_ascii_uppercase();
        let bare = upper.strip_suffix("ZM").or(upper.strip_suffix('Z')).or(upper.strip_suffix('M'));
        [Some(upper.as_str()), bare].into_iter().flatten().find_map(|name| match name {
            "POLYGON" | "TRIANGLE" => Some(Self::Polygon),
            "MULTIPOLYGON" => Some(Self::MultiPolygon),
            "GEOMETRYCOLLECTION" => Some(Self::Collection),
            "LINESTRING" | "LINEARRING" => Some(Self::LineString),
            name => {
                let known = |names: &[&'static str]| names.iter().copied().find(|&n| n == name);
                known(&POINTS).map(Self::Points).or_else(|| known(&OTHERS).map(Self::Other))
            }
        })
    }

    fn name(self) -> &'static str {
        match self {
            Self::Polygon => "POLYGON",
            Self::MultiPolygon => "MULTIPOLYGON",
            Self::Collection => "GEOMETRYCOLLECTION",
            Self::LineString => "LINESTRING",
            Self::Points(name) | Self::Other(name) => name,
        }
    }
}
