use super::{blob, quoted};
use crate::Crs;
use crate::table::{Cell, Kind, Rows, Schema, Table, WriteError, Written, unique};
use rusqlite::types::ToSqlOutput;
use rusqlite::{Connection, ToSql, params};
use std::io;
use std::path::Path;

/// The column of the numbers of rows, and that of the geometries.
const KEY: &str = "fid";
const GEOMETRY: &str = "geom";

/// Number of the reference system that is not defined, with plane coordinates.
const UNDEFINED: i32 = -1;

/// First number of reference systems without one of their own.
const OWN: i32 = 100_000;

/// The tables that every GeoPackage has, and those of this one that have features and an index.
const TABLES: &str = r#"
CREATE TABLE gpkg_spatial_ref_sys (
  srs_name TEXT NOT NULL, srs_id INTEGER PRIMARY KEY, organization TEXT NOT NULL,
  organization_coordsys_id INTEGER NOT NULL, definition TEXT NOT NULL, description TEXT);
CREATE TABLE gpkg_contents (
  table_name TEXT NOT NULL PRIMARY KEY, data_type TEXT NOT NULL, identifier TEXT UNIQUE,
  description TEXT DEFAULT '',
  last_change DATETIME NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')),
  min_x DOUBLE, min_y DOUBLE, max_x DOUBLE, max_y DOUBLE, srs_id INTEGER,
  CONSTRAINT fk_gc_r_srs_id FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys(srs_id));
CREATE TABLE gpkg_geometry_columns (
  table_name TEXT NOT NULL, column_name TEXT NOT NULL, geometry_type_name TEXT NOT NULL,
  srs_id INTEGER NOT NULL, z TINYINT NOT NULL, m TINYINT NOT NULL,
  CONSTRAINT pk_geom_cols PRIMARY KEY (table_name, column_name),
  CONSTRAINT uk_gc_table_name UNIQUE (table_name),
  CONSTRAINT fk_gc_tn FOREIGN KEY (table_name) REFERENCES gpkg_contents(table_name),
  CONSTRAINT fk_gc_srs FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys(srs_id));
CREATE TABLE gpkg_extensions (
  table_name TEXT, column_name TEXT, extension_name TEXT NOT NULL, definition TEXT NOT NULL,
  scope TEXT NOT NULL, CONSTRAINT ge_tce UNIQUE (table_name, column_name, extension_name));
INSERT INTO gpkg_spatial_ref_sys VALUES
  ('Undefined Cartesian SRS', -1, 'NONE', -1, 'undefined', 'undefined Cartesian coordinate reference system'),
  ('Undefined geographic SRS', 0, 'NONE', 0, 'undefined', 'undefined geographic coordinate reference system');
"#;

/// The index of boxes, and what keeps it up to date in programs that know the functions [OGC 12-128r17,
/// F.3]: T and C are the names of table and column, I is that of the key.
const INDEX: &str = r#"
CREATE TRIGGER "rtree_T_C_insert" AFTER INSERT ON "T"
  WHEN (NEW."C" NOT NULL AND NOT ST_IsEmpty(NEW."C"))
BEGIN INSERT OR REPLACE INTO "rtree_T_C" VALUES (NEW."I",
  ST_MinX(NEW."C"), ST_MaxX(NEW."C"), ST_MinY(NEW."C"), ST_MaxY(NEW."C")); END;
CREATE TRIGGER "rtree_T_C_update1" AFTER UPDATE OF "C" ON "T"
  WHEN OLD."I" = NEW."I" AND (NEW."C" NOTNULL AND NOT ST_IsEmpty(NEW."C"))
BEGIN INSERT OR REPLACE INTO "rtree_T_C" VALUES (NEW."I",
  ST_MinX(NEW."C"), ST_MaxX(NEW."C"), ST_MinY(NEW."C"), ST_MaxY(NEW."C")); END;
CREATE TRIGGER "rtree_T_C_update2" AFTER UPDATE OF "C" ON "T"
  WHEN OLD."I" = NEW."I" AND (NEW."C" ISNULL OR ST_IsEmpty(NEW."C"))
BEGIN DELETE FROM "rtree_T_C" WHERE id = OLD."I"; END;
CREATE TRIGGER "rtree_T_C_update3" AFTER UPDATE ON "T"
  WHEN OLD."I" != NEW."I" AND (NEW."C" NOTNULL AND NOT ST_IsEmpty(NEW."C"))
BEGIN DELETE FROM "rtree_T_C" WHERE id = OLD."I";
INSERT OR REPLACE INTO "rtree_T_C" VALUES (NEW."I",
  ST_MinX(NEW."C"), ST_MaxX(NEW."C"), ST_MinY(NEW."C"), ST_MaxY(NEW."C")); END;
CREATE TRIGGER "rtree_T_C_update4" AFTER UPDATE ON "T"
  WHEN OLD."I" != NEW."I" AND (NEW."C" ISNULL OR ST_IsEmpty(NEW."C"))
BEGIN DELETE FROM "rtree_T_C" WHERE id IN (OLD."I", NEW."I"); END;
CREATE TRIGGER "rtree_T_C_delete" AFTER DELETE ON "T" WHEN OLD."C" NOT NULL
BEGIN DELETE FROM "rtree_T_C" WHERE id = OLD."I"; END;
"#;

impl From<rusqlite::Error> for WriteError {
    fn from(error: rusqlite::Error) -> Self {
        Self::System(io::Error::other(error.to_string()))
    }
}

impl ToSql for Cell {
    fn to_sql(&self) -> rusqlite::Result<ToSqlOutput<'_>> {
        match self {
            Self::Null => Ok(ToSqlOutput::from(rusqlite::types::Null)),
            Self::Boolean(value) => value.to_sql(),
            Self::Integer(value) => value.to_sql(),
            Self::Real(value) => value.to_sql(),
            Self::Text(text) => text.to_sql(),
        }
    }
}

/// Writes a GeoPackage of one layer, with an index.
///
/// # Errors
/// If the system fails, or the name of the layer is reserved.
pub fn write(path: &Path, table: &Table<'_>, rows: Rows<'_>) -> Result<Written, WriteError> {
    let mut package = Package::create(path, table.crs)?;
    package.add(table, rows)?;
    package.finish()
}

/// A GeoPackage that is being written.
pub(crate) struct Package {
    database: Connection,
    /// The number of the reference system of all layers.
    srs: i32,
    written: Written,
}

impl Package {
    /// A GeoPackage without layers in the place of a file.
    pub fn create(path: &Path, crs: Option<&Crs>) -> Result<Self, WriteError> {
        // What was there is no part of it.
        std::fs::File::create(path)?;
        let database = Connection::open(path)?;
        // The file is not anybody's until it is complete, so there is nothing to go back to.
        database.execute_batch(
            "PRAGMA page_size = 4096; PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; \
             PRAGMA locking_mode = EXCLUSIVE; PRAGMA cache_size = -65536; \
             PRAGMA application_id = 1196444487; PRAGMA user_version = 10300; BEGIN;",
        )?;
        database.execute_batch(TABLES)?;
        let srs = reference(&database, crs)?;
        Ok(Self { database, srs, written: Written::default() })
    }

    /// Adds a layer, with an index.
    pub fn add(&mut self, table: &Table<'_>, rows: Rows<'_>) -> Result<(), WriteError> {
        if table.name.to_ascii_lowercase().starts_with("sqlite_") {
            let why = format!(
                "a layer of a GeoPackage cannot have the name `{}`, as those with `sqlite_` are reserved; name the \
                 file otherwise",
                table.name
            );
            return Err(WriteError::unfit(why));
        }
        let Self { database, srs, written } = self;
        let columns = table.schema.columns();
        let names = names(table.schema, written);
        describe(database, table, *srs, &names)?;
        let index = format!("rtree_{}_{GEOMETRY}", table.name);
        database.execute_batch(&format!(
            "CREATE VIRTUAL TABLE {} USING rtree(id, minx, maxx, miny, maxy)",
            quoted(&index)
        ))?;
        {
            let places = vec!["?"; columns.len() + 2].join(", ");
            let insert = format!("INSERT INTO {} VALUES ({places})", quoted(table.name));
            let mut insert = database.prepare(&insert)?;
            let mut boxes = database
                .prepare(&format!("INSERT INTO {} VALUES (?, ?, ?, ?, ?)", quoted(&index)))?;
            let mut blob = Vec::new();
            for (row, id) in rows.zip(1_i64..) {
                let row = row?;
                insert.raw_bind_parameter(1, id)?;
                match &row.wkb {
                    Some(wkb) => {
                        blob.clear();
                        blob::write(*srs, row.bounds, wkb, &mut blob);
                        insert.raw_bind_parameter(2, blob.as_slice())?;
                    }
                    None => insert.raw_bind_parameter(2, rusqlite::types::Null)?,
                }
                for (cell, place) in row.cells.iter().zip(3..) {
                    insert.raw_bind_parameter(place, cell)?;
                }
                insert.raw_execute()?;
                let [x, y, x_max, y_max] = row.bounds;
                if row.wkb.is_some() && x <= x_max {
                    boxes.execute(params![id, x, x_max, y, y_max])?;
                }
            }
        }
        let inside = |name: &str| name.replace('"', "\"\"");
        let triggers = INDEX
            .replace("\"I\"", &quoted(KEY))
            .replace("\"C\"", &quoted(GEOMETRY))
            .replace("rtree_T_C", &inside(&index))
            .replace("\"T\"", &quoted(table.name));
        database.execute_batch(&triggers)?;
        Ok(())
    }

    /// Ends the file.
    pub fn finish(self) -> Result<Written, WriteError> {
        self.database.execute_batch("COMMIT")?;
        self.database.close().map_err(|(_, error)| error)?;
        Ok(self.written)
    }
}

/// Names of the columns that differ where letter case does not matter, as SQL has it.
fn names(schema: &Schema, written: &mut Written) -> Vec<String> {
    let given: Vec<&str> = schema.columns().iter().map(|column| column.name.as_str()).collect();
    let names = unique(given.iter().copied(), &[KEY, GEOMETRY], |name, number| {
        let name = if name.is_empty() { "column" } else { name };
        format!("{}{number}", name.replace('\0', " "))
    });
    for (given, name) in given.iter().zip(&names) {
        if given != name {
            written.warnings.push(format!("the column `{given}` is called `{name}`"));
        }
    }
    names
}

/// Makes the table, and says what it is.
fn describe(
    database: &Connection,
    table: &Table<'_>,
    srs: i32,
    names: &[String],
) -> Result<(), WriteError> {
    let schema = table.schema;
    let mut create = format!(
        "CREATE TABLE {} ({} INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, {} {}",
        quoted(table.name),
        quoted(KEY),
        quoted(GEOMETRY),
        type_of(schema),
    );
    for (column, name) in schema.columns().iter().zip(names) {
        let kind = match column.kind {
            Kind::Boolean => "BOOLEAN",
            Kind::Integer => "INTEGER",
            Kind::Real => "REAL",
            Kind::Text => "TEXT",
        };
        create.push_str(&format!(", {} {kind}", quoted(name)));
    }
    create.push(')');
    database.execute_batch(&create)?;
    let [x, y, x_max, y_max] = schema.extent().map_or([None; 4], |extent| extent.map(Some));
    database.execute(
        "INSERT INTO gpkg_contents \
         (table_name, data_type, identifier, min_x, min_y, max_x, max_y, srs_id) \
         VALUES (?1, 'features', ?1, ?2, ?3, ?4, ?5, ?6)",
        params![table.name, x, y, x_max, y_max, srs],
    )?;
    let z = match schema.in_space() {
        (false, _) => 0,
        // Of a mixture of geometries readers of OGR's take no more than that it may have heights.
        (true, true) if type_of(schema) != "GEOMETRY" => 1,
        (true, _) => 2,
    };
    database.execute(
        "INSERT INTO gpkg_geometry_columns VALUES (?, ?, ?, ?, ?, 0)",
        params![table.name, GEOMETRY, type_of(schema), srs, z],
    )?;
    database.execute(
        "INSERT INTO gpkg_extensions VALUES (?, ?, 'gpkg_rtree_index', \
         'http://www.geopackage.org/spec120/#extension_rtree', 'write-only')",
        params![table.name, GEOMETRY],
    )?;
    Ok(())
}

/// The type of all geometries, as the standard calls it.
fn type_of(schema: &Schema) -> &'static str {
    let mut numbers = schema.geometries.iter().map(|kind| kind.number);
    let first = numbers.next();
    match first.filter(|first| numbers.all(|number| number == *first)) {
        Some(1) => "POINT",
        Some(2) => "LINESTRING",
        Some(3) => "POLYGON",
        Some(4) => "MULTIPOINT",
        Some(5) => "MULTILINESTRING",
        Some(6) => "MULTIPOLYGON",
        _ => "GEOMETRY",
    }
}

/// Adds the reference system, and WGS 84, which every GeoPackage has; gives the number of the system.
fn reference(database: &Connection, crs: Option<&Crs>) -> Result<i32, WriteError> {
    let add = |srs: i32, organization: &str, code: i32, crs: &Crs| {
        let wkt = crs.first_wkt().or_else(|| crs.wkt());
        database.execute(
            "INSERT INTO gpkg_spatial_ref_sys VALUES (?, ?, ?, ?, ?, NULL)",
            params![
                crs.name().unwrap_or_else(|| crs.to_string()),
                srs,
                organization,
                code,
                wkt.as_deref().unwrap_or("undefined"),
            ],
        )
    };
    const WGS_84: i32 = 4326;
    add(WGS_84, "EPSG", WGS_84, &Crs::epsg(4326))?;
    let Some(crs) = crs else { return Ok(UNDEFINED) };
    if let Some(code) = crs.epsg_code().and_then(|code| i32::try_from(code).ok()) {
        if code != WGS_84 {
            add(code, "EPSG", code, crs)?;
        }
        return Ok(code);
    }
    let code = crs.authority().and_then(|(name, code)| Some((name, code.parse().ok()?)));
    match code {
        Some((authority, code)) => add(OWN, authority, code, crs)?,
        None if crs.wkt().is_some() => add(OWN, "NONE", OWN, crs)?,
        None => return Ok(UNDEFINED),
    };
    Ok(OWN)
}
