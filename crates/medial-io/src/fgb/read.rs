use crate::table::told_apart;
use crate::{Crs, Error, Feature, FeatureError, Json, Layer, Part, attribute};
use flatgeobuf::{
    ColumnType, Geometry, GeometryType, Header, size_prefixed_root_as_feature,
    size_prefixed_root_as_header,
};
use medial::geom::Point;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::Arc;

/// Most bytes of a header, as other readers have it.
const HEADER_BYTES: u64 = 10 << 20;

/// Bytes of a node of the index: its box, and where its children are.
const NODE_BYTES: u64 = 40;

/// Deepest nesting of collections; protects the stack against made-up input.
const MAX_NESTING: u32 = 32;

/// What the header says.
struct Described {
    columns: Vec<(String, ColumnType)>,
    /// `Unknown` if every feature has its own.
    kind: GeometryType,
}

/// Opens a FlatGeobuf. Features come in the order of the file, the index is passed over.
///
/// # Errors
/// If the file cannot be read or is no FlatGeobuf.
pub fn open(path: &Path) -> Result<Layer<'static>, Error> {
    let failed = |source| Error::Interrupted { source };
    let wrong = |why: &str| Error::File { why: format!("it is no FlatGeobuf: {why}") };
    let mut source = BufReader::new(File::open(path).map_err(failed)?);
    let mut magic = [0; 8];
    source.read_exact(&mut magic).map_err(|_| wrong("it ends too early"))?;
    let [b'f', b'g', b'b', version, b'f', b'g', b'b', _] = magic else {
        return Err(wrong("it does not begin like one"));
    };
    if version > flatgeobuf::VERSION {
        return Err(wrong(&format!("version {version} is not known")));
    }
    let buffer = message(&mut source, HEADER_BYTES).map_err(failed)?;
    let buffer = buffer.ok_or_else(|| wrong("it has no header"))?;
    let header = size_prefixed_root_as_header(&buffer)
        .map_err(|error| wrong(&format!("its header is malformed: {}", plain(&error))))?;
    let columns: Vec<(String, ColumnType)> = header.columns().map_or_else(Vec::new, |columns| {
        columns.iter().map(|column| (column.name().to_owned(), column.type_())).collect()
    });
    let mut warnings = Vec::new();
    let (names, kinds): (Vec<String>, Vec<ColumnType>) = columns.into_iter().unzip();
    let columns = told_apart(names, &mut warnings).into_iter().zip(kinds).collect();
    let described = Arc::new(Described { columns, kind: header.geometry_type() });
    let count = header.features_count();
    let index = index_bytes(count, header.index_node_size());
    let index = index.and_then(|size| i64::try_from(size).ok());
    let index = index.ok_or_else(|| wrong("its index makes no sense"))?;
    let crs = reference(&header);
    source.seek(SeekFrom::Current(index)).map_err(failed)?;
    let len = usize::try_from(count).ok().filter(|&count| count > 0);
    let features = Features { source, described, index: 0, expected: count, is_over: false };
    Ok(Layer { crs, len, warnings, ..Layer::of_parts(features) })
}

/// A flatbuffer behind its size, with it; `None` at the end.
fn message(source: &mut impl Read, most: u64) -> io::Result<Option<Vec<u8>>> {
    let early = || io::Error::new(io::ErrorKind::UnexpectedEof, "the file ends in a feature");
    let mut buffer = Vec::new();
    source.take(4).read_to_end(&mut buffer)?;
    let size = match buffer.first_chunk() {
        Some(size) => u64::from(u32::from_le_bytes(*size)),
        None if buffer.is_empty() => return Ok(None),
        None => return Err(early()),
    };
    if size > most {
        return Err(io::Error::other(format!("a size of {size} bytes makes no sense")));
    }
    // No more memory than there are bytes.
    source.take(size).read_to_end(&mut buffer)?;
    if (buffer.len() as u64) < size + 4 {
        return Err(early());
    }
    Ok(Some(buffer))
}

/// How many bytes the index takes.
fn index_bytes(count: u64, node_size: u16) -> Option<u64> {
    if node_size == 0 || count == 0 {
        return Some(0);
    }
    let size = u64::from(node_size.max(2));
    let (mut level, mut nodes) = (count, count);
    // A single feature has a root of its own.
    loop {
        level = level.div_ceil(size);
        nodes = nodes.checked_add(level)?;
        if level == 1 {
            return nodes.checked_mul(NODE_BYTES);
        }
    }
}

fn reference(header: &Header) -> Option<Crs> {
    let crs = header.crs()?;
    let known = match (crs.code(), crs.code_string()) {
        (code, _) if code > 0 => Some(code.to_string()),
        (_, Some(code)) if !code.is_empty() => Some(code.to_owned()),
        _ => None,
    };
    let known = known.map(|code| Crs::of_authority(crs.org().unwrap_or("EPSG"), &code));
    match (known, crs.wkt().filter(|wkt| !wkt.is_empty())) {
        (Some(known), Some(wkt)) => Some(known.with_wkt(wkt)),
        (None, Some(wkt)) => Some(Crs::of_wkt(wkt)),
        (known, None) => known,
    }
}

fn plain(error: &impl ToString) -> String {
    error.to_string().lines().next().unwrap_or_default().trim_end_matches('.').to_owned()
}

/// The features of a file.
struct Features {
    source: BufReader<File>,
    described: Arc<Described>,
    index: usize,
    /// How many there are by the header, 0 if it does not say.
    expected: u64,
    is_over: bool,
}

impl Iterator for Features {
    type Item = Part<'static>;

    fn next(&mut self) -> Option<Part<'static>> {
        if self.is_over {
            return None;
        }
        let index = self.index;
        let buffer = match message(&mut self.source, u64::MAX) {
            Ok(Some(buffer)) => buffer,
            Ok(None) => {
                self.is_over = true;
                let n = self.expected;
                let why = format!("the file ends after {index} of {n} features");
                let source = io::Error::new(io::ErrorKind::UnexpectedEof, why);
                let is_short = (index as u64) < n;
                return is_short.then(|| Part::broken(index, Error::Interrupted { source }));
            }
            Err(source) => {
                self.is_over = true;
                return Some(Part::broken(index, Error::Interrupted { source }));
            }
        };
        self.index += 1;
        let described = Arc::clone(&self.described);
        Some(Part::of_row(buffer.len(), move || {
            read(&buffer, index, &described).map_err(|why| {
                let error = Error::Value { place: "flatbuffer".to_owned(), why };
                FeatureError { feature: index, id: None, error }
            })
        }))
    }
}

fn read(buffer: &[u8], index: usize, described: &Described) -> Result<Feature, String> {
    let found = size_prefixed_root_as_feature(buffer)
        .map_err(|error| format!("it is malformed: {}", plain(&error)))?;
    let mut feature = Feature::numbered(index);
    // A feature may have columns of its own.
    let own: Option<Vec<(String, ColumnType)>> = found.columns().map(|columns| {
        columns.iter().map(|column| (column.name().to_owned(), column.type_())).collect()
    });
    let columns = own.as_ref().unwrap_or(&described.columns);
    let bytes = found.properties().map(|bytes| bytes.bytes()).unwrap_or_default();
    feature.properties = properties(bytes, columns)?;
    match found.geometry() {
        Some(geometry) => {
            let kind = match described.kind {
                GeometryType::Unknown => geometry.type_(),
                kind => kind,
            };
            shape(&geometry, kind, &mut feature, 0)?;
        }
        None => feature.geometry = "without a geometry".to_owned(),
    }
    Ok(feature)
}

/// The values of all columns, nothing for those that a feature does not have.
fn properties(
    mut bytes: &[u8],
    columns: &[(String, ColumnType)],
) -> Result<Vec<(String, Json)>, String> {
    let mut values = vec![None; columns.len()];
    while let Some((number, rest)) = bytes.split_first_chunk() {
        let number = usize::from(u16::from_le_bytes(*number));
        let (name, kind) =
            columns.get(number).ok_or_else(|| format!("there is no column {number}"))?;
        let value = value(rest, *kind).ok_or_else(|| format!("the value of `{name}` is malformed"));
        let (value, rest) = value?;
        values[number] = Some(value);
        bytes = rest;
    }
    let named = columns.iter().zip(values);
    Ok(named
        .map(|((name, _), value)| (name.clone(), value.unwrap_or_else(attribute::null)))
        .collect())
}

/// A value, and what follows it.
fn value(bytes: &[u8], kind: ColumnType) -> Option<(Json, &[u8])> {
    macro_rules! number {
        ($type:ty, $to:expr) => {{
            let (value, rest) = bytes.split_first_chunk()?;
            Some(($to(<$type>::from_le_bytes(*value)), rest))
        }};
    }
    match kind {
        ColumnType::Byte => number!(i8, attribute::integer),
        ColumnType::UByte => number!(u8, attribute::integer),
        ColumnType::Bool => number!(u8, |value| attribute::boolean(value != 0)),
        ColumnType::Short => number!(i16, attribute::integer),
        ColumnType::UShort => number!(u16, attribute::integer),
        ColumnType::Int => number!(i32, attribute::integer),
        ColumnType::UInt => number!(u32, attribute::integer),
        ColumnType::Long => number!(i64, attribute::integer),
        ColumnType::ULong => number!(u64, attribute::integer),
        ColumnType::Float => number!(f32, attribute::single),
        ColumnType::Double => number!(f64, attribute::real),
        _ => {
            let (size, rest) = bytes.split_first_chunk()?;
            let size = u32::from_le_bytes(*size) as usize;
            let (value, rest) = rest.split_at_checked(size)?;
            let value = match kind {
                ColumnType::Binary => attribute::bytes(value),
                ColumnType::Json => attribute::json(&String::from_utf8_lossy(value)),
                _ => attribute::text(&String::from_utf8_lossy(value)),
            };
            Some((value, rest))
        }
    }
}

/// Adds a geometry to a feature.
fn shape(
    geometry: &Geometry<'_>,
    kind: GeometryType,
    feature: &mut Feature,
    depth: u32,
) -> Result<(), String> {
    let name = kind.variant_name().unwrap_or("geometry of an unknown type");
    if depth == 0 {
        feature.geometry = format!("a {name}");
    }
    match kind {
        GeometryType::Polygon => feature.add_polygon(rings(geometry)?),
        GeometryType::MultiPolygon => {
            feature.polygonal = true;
            match geometry.parts() {
                Some(parts) => {
                    for part in parts {
                        feature.add_polygon(rings(&part)?);
                    }
                }
                // A single polygon may stand without parts.
                None if geometry.xy().is_some_and(|xy| !xy.is_empty()) => {
                    feature.add_polygon(rings(geometry)?);
                }
                None => {}
            }
        }
        GeometryType::GeometryCollection => {
            if depth == MAX_NESTING {
                return Err(format!("collections are nested deeper than {MAX_NESTING}"));
            }
            for part in geometry.parts().into_iter().flatten() {
                shape(&part, part.type_(), feature, depth + 1)?;
            }
        }
        _ if depth > 0 => feature.leave_out(name),
        _ => {}
    }
    Ok(())
}

/// The rings of a polygon.
fn rings(geometry: &Geometry<'_>) -> Result<Vec<Vec<Point>>, String> {
    let Some(xy) = geometry.xy().filter(|xy| !xy.is_empty()) else { return Ok(Vec::new()) };
    if xy.len() % 2 == 1 {
        return Err(format!("{} coordinates are no points", xy.len()));
    }
    let points: Vec<Point> =
        (0..xy.len() / 2).map(|k| Point::new(xy.get(2 * k), xy.get(2 * k + 1))).collect();
    let Some(ends) = geometry.ends().filter(|ends| !ends.is_empty()) else {
        return Ok(vec![points]);
    };
    let mut start = 0;
    ends.iter()
        .enumerate()
        .map(|(ring, end)| {
            let end = end as usize;
            let found = points.get(start..end).map(<[Point]>::to_vec);
            let n = points.len();
            let found =
                found.ok_or_else(|| format!("ring {ring} runs from point {start} to {end} of {n}"));
            start = end;
            found
        })
        .collect()
}
