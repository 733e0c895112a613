use super::{blob, quoted};
use crate::apart::{Rows, read_apart};
use crate::{Crs, Error, Feature, FeatureError, Json, Layer, Part, attribute};
use rusqlite::types::ValueRef;
use rusqlite::{Connection, ErrorCode, OpenFlags, OptionalExtension as _, Row};
use std::io::Read as _;
use std::path::Path;

/// Tables of which the rows are counted, so that few features share the threads.
const COUNTED: usize = 1000;

/// A table of features.
struct Table {
    name: String,
    geometry: String,
    srs: i64,
    /// The column that numbers the rows.
    key: Option<String>,
    columns: Vec<Column>,
}

/// A column of values.
struct Column {
    name: String,
    is_boolean: bool,
    is_real: bool,
}

/// Opens a layer of a GeoPackage: the one with this name, or the only one. Features come in the order of
/// their rows.
///
/// # Errors
/// If the file is no GeoPackage, or the layer is not there or not the only one.
pub fn open(path: &Path, layer: Option<&str>) -> Result<Layer<'static>, Error> {
    let broken = |error: rusqlite::Error| Error::File { why: said(&error) };
    // What is missing should not be said to be no database.
    std::fs::File::open(path).map_err(|source| Error::Interrupted { source })?;
    let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let database = match is_settled(path) {
        // Else the files of its log would be made beside it, and stay.
        true => Connection::open_with_flags(immutable(path), flags | OpenFlags::SQLITE_OPEN_URI),
        false => Connection::open_with_flags(path, flags),
    };
    let database = database.map_err(broken)?;
    database
        .execute_batch("PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON;")
        .map_err(broken)?;
    let table = table(&database, layer)?;
    let crs = reference(&database, table.srs).map_err(broken)?;
    let count =
        format!("SELECT count(*) FROM (SELECT 1 FROM {} LIMIT {COUNTED})", quoted(&table.name));
    // Where the file is damaged the rows before that can be read.
    let count: Option<i64> = database.query_row(&count, [], |row| row.get(0)).ok();
    let len = count.and_then(|count| usize::try_from(count).ok()).filter(|&count| count < COUNTED);
    let parts = read_apart(move |rows| read(&database, table, rows).map_err(|error| said(&error)))
        .map_err(|source| Error::Interrupted { source })?;
    Ok(Layer { crs, len, ..Layer::of_parts(parts) })
}

/// Whether a database keeps a log of its own beside it (WAL), but has nothing in it.
fn is_settled(path: &Path) -> bool {
    /// The version of the format to read, in its header, with such a log.
    const LOGGED: (usize, u8) = (19, 2);
    let mut header = [0; 20];
    let read = std::fs::File::open(path).and_then(|mut file| file.read_exact(&mut header));
    let mut log = path.as_os_str().to_owned();
    log.push("-wal");
    let is_empty = std::fs::metadata(log).map_or(true, |found| found.len() == 0);
    read.is_ok() && header[LOGGED.0] == LOGGED.1 && is_empty
}

/// The name under which a database is opened as one that nobody changes.
fn immutable(path: &Path) -> String {
    let mut name = "file:".to_owned();
    for &byte in path.as_os_str().as_encoded_bytes() {
        match byte {
            b'/' | b'.' | b'-' | b'_' => name.push(byte.into()),
            byte if byte.is_ascii_alphanumeric() => name.push(byte.into()),
            // Windows has two more characters that have to stay.
            b'\\' if cfg!(windows) => name.push('/'),
            b':' if cfg!(windows) => name.push(':'),
            byte => name.push_str(&format!("%{byte:02X}")),
        }
    }
    name + "?immutable=1"
}

/// What the database says of a failure, and what to do.
fn said(error: &rusqlite::Error) -> String {
    let why = match error {
        rusqlite::Error::SqliteFailure(_, Some(why)) => why.clone(),
        other => other.to_string(),
    };
    match error.sqlite_error_code() {
        Some(ErrorCode::DatabaseCorrupt) => {
            format!("{why}; copy it again, or repair it with `.recover` of sqlite3")
        }
        Some(ErrorCode::NotADatabase) => {
            format!("it is no GeoPackage: {why}; name its format with --from")
        }
        _ => why,
    }
}

/// The table that is asked for.
fn table(database: &Connection, layer: Option<&str>) -> Result<Table, Error> {
    let broken = |error: rusqlite::Error| Error::File { why: said(&error) };
    let none = |why: &str| Error::File { why: format!("it is no GeoPackage: {why}") };
    let has = |name: &str| {
        database
            .query_row("SELECT 1 FROM sqlite_master WHERE lower(name) = ?1", [name], |_| Ok(()))
            .optional()
            .map(|found| found.is_some())
    };
    for name in ["gpkg_contents", "gpkg_geometry_columns"] {
        if !has(name).map_err(broken)? {
            return Err(none(&format!("there is no table {name}")));
        }
    }
    let mut layers = database
        .prepare(
            "SELECT g.table_name, g.column_name, g.srs_id FROM gpkg_contents c \
             JOIN gpkg_geometry_columns g ON lower(c.table_name) = lower(g.table_name) \
             WHERE c.data_type = 'features' ORDER BY c.rowid",
        )
        .map_err(broken)?;
    let layers: Vec<(String, String, i64)> = layers
        .query_map([], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)))
        .and_then(Iterator::collect)
        .map_err(broken)?;
    let names = layers.iter().map(|(name, ..)| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    let found = match layer {
        Some(asked) => layers.iter().find(|(name, ..)| name == asked).ok_or_else(|| {
            let there = if names.is_empty() { "none".to_owned() } else { names.clone() };
            Error::Layer {
                why: format!("there is no layer `{asked}`; of features there are {there}"),
            }
        })?,
        None => match &layers[..] {
            [] => return Err(Error::File { why: "there is no layer of features".to_owned() }),
            [only] => only,
            _ => {
                let why = format!("there are several layers, {names}; choose one with --layer");
                return Err(Error::Layer { why });
            }
        },
    };
    let (name, geometry, srs) = found.clone();
    let mut info =
        database.prepare("SELECT name, type, pk FROM pragma_table_info(?1)").map_err(broken)?;
    let described: Vec<(String, String, i64)> = info
        .query_map([&name], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)))
        .and_then(Iterator::collect)
        .map_err(broken)?;
    let is_geometry = |column: &str| column.eq_ignore_ascii_case(&geometry);
    if !described.iter().any(|(column, ..)| is_geometry(column)) {
        return Err(none(&format!("the table `{name}` has no column `{geometry}`")));
    }
    let keys = described.iter().filter(|(.., pk)| *pk > 0).count();
    let is_key = |kind: &str, pk: i64| keys == 1 && pk == 1 && kind.eq_ignore_ascii_case("INTEGER");
    let key = described.iter().find(|(_, kind, pk)| is_key(kind, *pk));
    let key = key.map(|(column, ..)| column.clone());
    let columns =
        described.iter().filter(|(column, kind, pk)| !is_geometry(column) && !is_key(kind, *pk));
    let columns = columns
        .map(|(column, kind, _)| {
            let kind = kind.to_ascii_uppercase();
            Column {
                name: column.clone(),
                is_boolean: kind == "BOOLEAN",
                is_real: ["DOUBLE", "FLOAT", "REAL"].contains(&kind.as_str()),
            }
        })
        .collect();
    Ok(Table { name, geometry, srs, key, columns })
}

/// The reference system with this number; those that stand for none are none.
fn reference(database: &Connection, srs: i64) -> rusqlite::Result<Option<Crs>> {
    type Found = (String, i64, String);
    let found: Option<Found> = database
        .query_row(
            "SELECT organization, organization_coordsys_id, definition FROM gpkg_spatial_ref_sys \
             WHERE srs_id = ?1",
            [srs],
            |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)),
        )
        .optional()?;
    // Undefined Cartesian and geographic; the latter one has degrees at least.
    Ok(match (srs, found) {
        (-1, _) | (_, None) => None,
        (0, _) => Some(Crs::of_wkt("GEOGCS[\"Undefined geographic SRS\"]")),
        (_, Some((organization, code, wkt))) => {
            let has_text = wkt.contains('[');
            let is_known = !organization.eq_ignore_ascii_case("none") && code > 0;
            match (is_known, has_text) {
                (true, true) => {
                    Some(Crs::of_authority(&organization, &code.to_string()).with_wkt(&wkt))
                }
                (true, false) => Some(Crs::of_authority(&organization, &code.to_string())),
                (false, true) => Some(Crs::of_wkt(&wkt)),
                (false, false) => None,
            }
        }
    })
}

/// Hands over the rows of a table.
fn read(database: &Connection, table: Table, rows: &mut Rows) -> rusqlite::Result<()> {
    let key = table.key.as_deref().map_or_else(|| "NULL".to_owned(), quoted);
    let mut query = format!("SELECT {key}, {}", quoted(&table.geometry));
    for column in &table.columns {
        query.push_str(", ");
        query.push_str(&quoted(&column.name));
    }
    query.push_str(" FROM ");
    query.push_str(&quoted(&table.name));
    let mut statement = database.prepare(&query)?;
    let mut found = statement.query([])?;
    let mut index = 0;
    while let Some(row) = found.next()? {
        if !rows.push(part(row, index, &table.columns)?) {
            break;
        }
        index += 1;
    }
    Ok(())
}

/// A row as a feature: its values now, its geometry when it is read.
fn part(row: &Row<'_>, index: usize, columns: &[Column]) -> rusqlite::Result<Part<'static>> {
    let mut feature = Feature::numbered(index);
    if let ValueRef::Integer(id) = row.get_ref(0)? {
        feature.id = Some(attribute::integer(id));
    }
    feature.properties.reserve_exact(columns.len());
    let mut size = 0;
    for (k, column) in columns.iter().enumerate() {
        let value = value(row.get_ref(k + 2)?, column);
        size += column.name.len() + value.get().len();
        feature.properties.push((column.name.clone(), value));
    }
    let blob = match row.get_ref(1)? {
        ValueRef::Blob(blob) => Some(blob.to_vec()),
        ValueRef::Null => None,
        _ => Some(Vec::new()),
    };
    size += blob.as_ref().map_or(0, Vec::len);
    Ok(Part::of_row(size, move || {
        let Some(blob) = blob else {
            feature.geometry = "without a geometry".to_owned();
            return Ok(feature);
        };
        match blob::read(&blob, &mut feature) {
            Ok(()) => Ok(feature),
            Err(error) => Err(FeatureError { feature: index, id: feature.id, error }),
        }
    }))
}

fn value(value: ValueRef<'_>, column: &Column) -> Json {
    match value {
        ValueRef::Null => attribute::null(),
        ValueRef::Integer(value) if column.is_boolean => attribute::boolean(value != 0),
        ValueRef::Integer(value) if column.is_real => attribute::real(value as f64),
        ValueRef::Integer(value) => attribute::integer(value),
        ValueRef::Real(value) => attribute::real(value),
        ValueRef::Text(text) => attribute::text(&String::from_utf8_lossy(text)),
        ValueRef::Blob(bytes) => attribute::bytes(bytes),
    }
}
