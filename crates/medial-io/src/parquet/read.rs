use super::geo::{self, Geo};
use super::pages::Pages;
use crate::apart::{Rows, read_apart};
use crate::{Error, Feature, FeatureError, Json, Layer, Part, attribute, wkb};
use medial::geom::Point;
use parquet::basic::{LogicalType, TimeUnit};
use parquet::data_type::Decimal;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, List, Row};
use parquet::schema::types::{Type, TypePtr};
use serde_json::Value;
use std::collections::{BTreeSet, HashMap};
use std::fs::File;
use std::panic::AssertUnwindSafe;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// What a column is to a feature.
#[derive(Clone, Copy, PartialEq)]
enum Role {
    Geometry(Encoding),
    /// Nothing.
    Omitted,
    /// Text that is not marked as such in the older way.
    Text,
    /// A moment in nanoseconds, or in what the value says, in UTC or not.
    Nanoseconds {
        is_utc: bool,
    },
    Moment {
        is_utc: bool,
    },
    Value,
}

/// How geometries are written.
#[derive(Clone, Copy, PartialEq)]
enum Encoding {
    Wkb,
    Polygon,
    MultiPolygon,
    /// Points and lines.
    Other,
}

/// Opens a GeoParquet file, or a Parquet file with a column of well-known binary that has a type for
/// geometries or the name `geometry`.
///
/// # Errors
/// If the file cannot be read, is no Parquet file, or has no geometries.
pub fn open(path: &Path) -> Result<Layer<'static>, Error> {
    let wrong = |why: String| Error::File { why };
    let file = File::open(path).map_err(|source| Error::Interrupted { source })?;
    // The library trusts in what it reads.
    let (file, are_pages) = Pages::new(file);
    let file = AssertUnwindSafe(file);
    let opened = std::panic::catch_unwind(|| {
        let AssertUnwindSafe(file) = { file };
        SerializedFileReader::new(file)
    });
    let reader = opened
        .map_err(|_| wrong("it is no Parquet file that can be read; copy it again".to_owned()))?
        .map_err(|error| {
            wrong(format!(
                "it is no Parquet file: {}; copy it again if it is cut off",
                plain(&error)
            ))
        })?;
    let metadata = reader.metadata().file_metadata();
    let schema = metadata.schema();
    let pairs = metadata.key_value_metadata().map_or(&[][..], Vec::as_slice);
    let geo = pairs.iter().find(|pair| pair.key == "geo").and_then(|pair| pair.value.as_deref());
    let crs;
    let mut omitted = None;
    let (name, encoding) = match geo {
        Some(text) => {
            let mut geo: Geo = serde_json::from_str(text)
                .map_err(|error| wrong(format!("its metadata `geo` is malformed: {error}")))?;
            let name = geo.primary_column;
            let column = geo.columns.remove(&name).ok_or_else(|| {
                wrong(format!("its metadata `geo` says nothing of its column `{name}`"))
            })?;
            let encoding = match column.encoding.to_ascii_lowercase().as_str() {
                "wkb" => Encoding::Wkb,
                "polygon" => Encoding::Polygon,
                "multipolygon" => Encoding::MultiPolygon,
                "point" | "linestring" | "multipoint" | "multilinestring" => Encoding::Other,
                other => return Err(wrong(format!("the encoding `{other}` is not known"))),
            };
            omitted = column.boxes().map(ToOwned::to_owned);
            crs = column.crs();
            (name, encoding)
        }
        None => {
            let fields = schema.get_fields();
            let is_geometry = |field: &Type| {
                matches!(
                    field.get_basic_info().logical_type_ref(),
                    Some(LogicalType::Geometry(_) | LogicalType::Geography(_))
                )
            };
            let typed = fields.iter().find(|field| is_geometry(field));
            let named = || fields.iter().find(|field| field.name() == "geometry");
            let field = typed.or_else(named).ok_or_else(|| {
                wrong(
                    "it has no geometries: no metadata `geo`, no column `geometry`; write it as GeoParquet"
                        .to_owned(),
                )
            })?;
            crs = match field.get_basic_info().logical_type_ref() {
                Some(LogicalType::Geometry(found)) => geo::of_type(found.crs.as_deref(), pairs),
                Some(LogicalType::Geography(found)) => geo::of_type(found.crs.as_deref(), pairs),
                _ => None,
            };
            (field.name().to_owned(), Encoding::Wkb)
        }
    };
    if !schema.get_fields().iter().any(|field| field.name() == name) {
        return Err(wrong(format!(
            "there is no column `{name}`, which should have the geometries"
        )));
    }
    let (fields, repeated) = told_apart(schema.get_fields());
    let mut warnings = Vec::new();
    let mut projection = None;
    if !repeated.is_empty() {
        warnings.push(format!(
            "several columns have one name, {}; only the last one of each is read: rename the others",
            repeated.join(", ")
        ));
        let fields = fields.iter().map(|field| Arc::clone(field)).collect();
        let part = Type::group_type_builder(schema.name()).with_fields(fields).build();
        projection = Some(part.map_err(|error| wrong(plain(&error)))?);
    }
    let roles: Arc<[Role]> = fields
        .iter()
        .map(|field| match field.name() {
            of if of == name => Role::Geometry(encoding),
            of if Some(of) == omitted.as_deref() => Role::Omitted,
            _ => role(field),
        })
        .collect();
    let len = usize::try_from(metadata.num_rows()).ok();
    are_pages.store(true, Ordering::Relaxed);
    let find = move |rows: &mut Rows| {
        read(&reader, projection.as_ref(), &roles, rows).map_err(|error| plain(&error))
    };
    let parts = read_apart(find).map_err(|source| Error::Interrupted { source })?;
    Ok(Layer { crs, len, warnings, ..Layer::of_parts(parts) })
}

/// The columns that can be told apart, as the library looks for them by name and finds the last one; and names
/// that several have.
fn told_apart(fields: &[TypePtr]) -> (Vec<&TypePtr>, Vec<String>) {
    let last: HashMap<&str, usize> =
        fields.iter().enumerate().map(|(k, field)| (field.name(), k)).collect();
    let is_last = |k: usize, field: &TypePtr| last.get(field.name()) == Some(&k);
    let kept = fields.iter().enumerate().filter(|(k, field)| is_last(*k, field));
    let others = fields.iter().enumerate().filter(|(k, field)| !is_last(*k, field));
    let repeated: BTreeSet<String> =
        others.map(|(_, field)| format!("`{}`", field.name())).collect();
    (kept.map(|(_, field)| field).collect(), repeated.into_iter().collect())
}

/// What the library says, without its own kind of error.
fn plain(error: &impl ToString) -> String {
    let text = error.to_string();
    text.split_once(": ").map_or(text.as_str(), |(_, why)| why).replace('\n', " ")
}

fn role(field: &Type) -> Role {
    if field.is_group() {
        return Role::Value;
    }
    match field.get_basic_info().logical_type_ref() {
        Some(LogicalType::String | LogicalType::Json | LogicalType::Enum) => Role::Text,
        Some(LogicalType::Timestamp(found)) => {
            let is_utc = found.is_adjusted_to_u_t_c;
            match found.unit {
                TimeUnit::NANOS => Role::Nanoseconds { is_utc },
                _ => Role::Moment { is_utc },
            }
        }
        _ => Role::Value,
    }
}

/// Hands over the rows of a file.
fn read(
    reader: &SerializedFileReader<Pages>,
    projection: Option<&Type>,
    roles: &Arc<[Role]>,
    rows: &mut Rows,
) -> parquet::errors::Result<()> {
    let mut index = 0;
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group)?;
        for row in group.get_row_iter(projection.cloned())? {
            if !rows.push(part(row?, index, Arc::clone(roles))) {
                return Ok(());
            }
            index += 1;
        }
    }
    Ok(())
}

/// A row as a feature.
fn part(row: Row, index: usize, roles: Arc<[Role]>) -> Part<'static> {
    let columns = row.into_columns();
    let size = columns.iter().map(|(name, field)| name.len() + size(field)).sum();
    Part::of_row(size, move || {
        let mut feature = Feature::numbered(index);
        feature.geometry = "without a geometry".to_owned();
        let mut geometry = None;
        for ((name, field), role) in columns.into_iter().zip(roles.iter()) {
            match role {
                Role::Geometry(encoding) => geometry = Some((*encoding, field)),
                Role::Omitted => {}
                _ => feature.properties.push((name, value(&field, *role))),
            }
        }
        let read =
            geometry.map_or(Ok(()), |(encoding, field)| shape(encoding, field, &mut feature));
        match read {
            Ok(()) => Ok(feature),
            Err(error) => Err(FeatureError { feature: index, id: None, error }),
        }
    })
}

/// About as many bytes as a value has.
fn size(field: &Field) -> usize {
    match field {
        Field::Str(text) => text.len(),
        Field::Bytes(bytes) => bytes.len(),
        Field::ListInternal(list) => list.elements().iter().map(size).sum(),
        Field::Group(row) => row.get_column_iter().map(|(_, field)| size(field)).sum(),
        _ => size_of::<f64>(),
    }
}

/// Reads a geometry into a feature.
fn shape(encoding: Encoding, field: Field, feature: &mut Feature) -> Result<(), Error> {
    let wrong = |why: &str| Error::Value { place: "geometry".to_owned(), why: why.to_owned() };
    match (encoding, field) {
        (_, Field::Null) => Ok(()),
        (Encoding::Wkb, Field::Bytes(bytes)) => wkb::read_alone(bytes.data(), feature),
        (Encoding::Polygon, Field::ListInternal(list)) => {
            "a Polygon".clone_into(&mut feature.geometry);
            feature.add_polygon(polygon(&list).ok_or_else(|| wrong("it is no polygon"))?);
            Ok(())
        }
        (Encoding::MultiPolygon, Field::ListInternal(list)) => {
            "a MultiPolygon".clone_into(&mut feature.geometry);
            feature.polygonal = true;
            for part in list.elements() {
                let Field::ListInternal(part) = part else {
                    return Err(wrong("it is no multipolygon"));
                };
                feature.add_polygon(polygon(part).ok_or_else(|| wrong("it is no polygon"))?);
            }
            Ok(())
        }
        (Encoding::Other, _) => {
            "no polygon by its encoding".clone_into(&mut feature.geometry);
            Ok(())
        }
        _ => Err(wrong("its type is not that of its encoding")),
    }
}

/// A list of lists of points.
fn polygon(rings: &List) -> Option<Vec<Vec<Point>>> {
    let coordinate = |row: &Row, name: &str| {
        row.get_column_iter().find(|(found, _)| *found == name).and_then(|(_, value)| match value {
            Field::Double(value) => Some(*value),
            Field::Float(value) => Some(f64::from(*value)),
            _ => None,
        })
    };
    let point = |field: &Field| match field {
        Field::Group(row) => Some(Point::new(coordinate(row, "x")?, coordinate(row, "y")?)),
        _ => None,
    };
    let ring = |field: &Field| match field {
        Field::ListInternal(points) => points.elements().iter().map(point).collect(),
        _ => None,
    };
    rings.elements().iter().map(ring).collect()
}

fn value(field: &Field, role: Role) -> Json {
    match (field, role) {
        (Field::Long(units), Role::Nanoseconds { is_utc }) => {
            attribute::text(&attribute::moment(*units, 1_000_000_000, is_utc))
        }
        (Field::TimestampMillis(units), Role::Moment { is_utc }) => {
            attribute::text(&attribute::moment(*units, 1000, is_utc))
        }
        (Field::TimestampMicros(units), Role::Moment { is_utc }) => {
            attribute::text(&attribute::moment(*units, 1_000_000, is_utc))
        }
        (Field::Bytes(bytes), Role::Text) => {
            attribute::text(&String::from_utf8_lossy(bytes.data()))
        }
        _ => plain_value(field),
    }
}

fn plain_value(field: &Field) -> Json {
    match field {
        Field::Null => attribute::null(),
        Field::Bool(value) => attribute::boolean(*value),
        Field::Byte(value) => attribute::integer(*value),
        Field::Short(value) => attribute::integer(*value),
        Field::Int(value) => attribute::integer(*value),
        Field::Long(value) => attribute::integer(*value),
        Field::UByte(value) => attribute::integer(*value),
        Field::UShort(value) => attribute::integer(*value),
        Field::UInt(value) => attribute::integer(*value),
        Field::ULong(value) => attribute::integer(*value),
        Field::Float16(value) => attribute::single(value.to_f32()),
        Field::Float(value) => attribute::single(*value),
        Field::Double(value) => attribute::real(*value),
        Field::Decimal(value) => decimal(value),
        Field::Str(text) => attribute::text(text),
        Field::Bytes(bytes) => attribute::bytes(bytes.data()),
        Field::Date(days) => attribute::text(&attribute::date(i64::from(*days))),
        Field::TimeMillis(units) => attribute::text(&attribute::time(i64::from(*units), 1000)),
        Field::TimeMicros(units) => attribute::text(&attribute::time(*units, 1_000_000)),
        Field::TimestampMillis(units) => attribute::text(&attribute::moment(*units, 1000, true)),
        Field::TimestampMicros(units) => {
            attribute::text(&attribute::moment(*units, 1_000_000, true))
        }
        nested => attribute::json(&tree(nested).to_string()),
    }
}

/// A value with others in it.
fn tree(field: &Field) -> Value {
    match field {
        Field::Group(row) => row
            .get_column_iter()
            .map(|(name, field)| (name.clone(), tree(field)))
            .collect::<serde_json::Map<_, _>>()
            .into(),
        Field::ListInternal(list) => list.elements().iter().map(tree).collect(),
        Field::MapInternal(map) => map
            .entries()
            .iter()
            .map(|(key, value)| {
                let key = tree(key);
                let key = key.as_str().map_or_else(|| key.to_string(), ToOwned::to_owned);
                (key, tree(value))
            })
            .collect::<serde_json::Map<_, _>>()
            .into(),
        plain => serde_json::from_str(plain_value(plain).get()).unwrap_or_default(),
    }
}

/// A decimal number as it is written, as far as it has no more digits than an integer of 128 bits.
fn decimal(value: &Decimal) -> Json {
    let bytes = value.data();
    let scale = usize::try_from(value.scale()).ok().filter(|&scale| scale <= 38);
    let (Some(scale), 1..=16) = (scale, bytes.len()) else { return attribute::bytes(bytes) };
    let fill = if bytes[0] >= 0x80 { -1_i128 } else { 0 };
    let whole = bytes.iter().fold(fill, |whole, &byte| whole << 8 | i128::from(byte));
    let sign = if whole < 0 { "-" } else { "" };
    let digits = format!("{:0width$}", whole.unsigned_abs(), width = scale + 1);
    let (before, behind) = digits.split_at(digits.len() - scale);
    let point = if behind.is_empty() { "" } else { "." };
    attribute::json(&format!("{sign}{before}{point}{behind}"))
}
