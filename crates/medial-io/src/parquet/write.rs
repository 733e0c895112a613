use crate::table::{Cell, Kind, Rows, Table, WriteError, Written, unique};
use parquet::basic::{Compression, ConvertedType, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::Type;
use serde_json::{Value, json};
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;
use std::sync::Arc;

/// The column of the geometries.
const GEOMETRY: &str = "geometry";

/// Most rows of a row group, as GDAL has it.
const GROUP_ROWS: usize = 65_536;

/// Bytes of geometries and texts at which a row group is full.
const GROUP_BYTES: usize = 64 << 20;

impl From<parquet::errors::ParquetError> for WriteError {
    fn from(error: parquet::errors::ParquetError) -> Self {
        Self::of(&error)
    }
}

/// Writes a GeoParquet file, version 1.1, with geometries as well-known binary, compressed by Snappy, in row
/// groups of at most 65,536 rows.
///
/// # Errors
/// If the system fails.
pub fn write(path: &Path, table: &Table<'_>, rows: Rows<'_>) -> Result<Written, WriteError> {
    let mut written = Written::default();
    let columns = table.schema.columns();
    let plain = |name: &str, number: &str| format!("{name}{number}");
    let names = unique(columns.iter().map(|column| column.name.as_str()), &[GEOMETRY], plain);
    for (column, name) in columns.iter().zip(&names) {
        if column.name != *name {
            written.warnings.push(format!("the column `{}` is called `{name}`", column.name));
        }
    }
    let mut fields = Vec::new();
    for (column, name) in columns.iter().zip(&names) {
        let (kind, logical, converted) = match column.kind {
            Kind::Boolean => (Physical::BOOLEAN, None, ConvertedType::NONE),
            Kind::Integer => (Physical::INT64, None, ConvertedType::NONE),
            Kind::Real => (Physical::DOUBLE, None, ConvertedType::NONE),
            Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String), ConvertedType::UTF8),
        };
        let field = Type::primitive_type_builder(name, kind)
            .with_repetition(Repetition::OPTIONAL)
            .with_logical_type(logical)
            .with_converted_type(converted)
            .build()?;
        fields.push(Arc::new(field));
    }
    let geometry = Type::primitive_type_builder(GEOMETRY, Physical::BYTE_ARRAY);
    fields.push(Arc::new(geometry.with_repetition(Repetition::OPTIONAL).build()?));
    let schema = Type::group_type_builder("schema").with_fields(fields).build()?;
    let geo = KeyValue::new("geo".to_owned(), metadata(table, &mut written).to_string());
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_created_by(concat!("medial ", env!("CARGO_PKG_VERSION")).to_owned())
        .set_key_value_metadata(Some(vec![geo]))
        .build();
    let file = BufWriter::new(File::create(path)?);
    let mut writer = SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties))?;
    let mut group = Group::new(columns.iter().map(|column| column.kind));
    for row in rows {
        let row = row?;
        for (cell, values) in row.cells.iter().zip(&mut group.columns) {
            group.bytes += values.push(cell);
        }
        group.bytes += group.geometries.push_bytes(row.wkb);
        group.n_rows += 1;
        if group.n_rows == GROUP_ROWS || group.bytes >= GROUP_BYTES {
            group.write(&mut writer)?;
        }
    }
    if group.n_rows > 0 {
        group.write(&mut writer)?;
    }
    writer.close()?;
    Ok(written)
}

/// What a file says of its geometries.
fn metadata(table: &Table<'_>, written: &mut Written) -> Value {
    let kinds = table.schema.geometries.iter();
    let kinds: Vec<String> = kinds
        .map(|kind| format!("{}{}", kind.name(), if kind.in_space { " Z" } else { "" }))
        .collect();
    let mut column = json!({"encoding": "WKB", "geometry_types": kinds});
    if let Some(extent) = table.schema.extent() {
        column["bbox"] = extent.as_slice().into();
    }
    let of_text = |text: &str| serde_json::from_str(text).unwrap_or_default();
    match table.crs {
        // Nothing stands for longitudes and latitudes.
        Some(crs) if crs.authority() == Some(("OGC", "CRS84")) => {}
        Some(crs) => {
            let projjson = crs.projjson();
            if projjson.is_none() {
                written.warnings.push(format!(
                    "the reference system {crs} is left out, as nothing tells its PROJJSON, which \
                     GeoParquet needs"
                ));
            }
            column["crs"] = projjson.as_deref().map_or(Value::Null, of_text);
        }
        None => column["crs"] = Value::Null,
    }
    json!({"version": "1.1.0", "primary_column": GEOMETRY, "columns": {GEOMETRY: column}})
}

/// The rows of a row group, column by column.
struct Group {
    columns: Vec<Values>,
    geometries: Values,
    n_rows: usize,
    bytes: usize,
}

/// The values of a column, and for each row whether there is one.
struct Values {
    levels: Vec<i16>,
    values: Kinds,
}

enum Kinds {
    Boolean(Vec<bool>),
    Integer(Vec<i64>),
    Real(Vec<f64>),
    Bytes(Vec<ByteArray>),
}

impl Group {
    fn new(kinds: impl Iterator<Item = Kind>) -> Self {
        let columns = kinds.map(Values::new).collect();
        Self { columns, geometries: Values::new(Kind::Text), n_rows: 0, bytes: 0 }
    }

    /// Writes a row group, and is empty then.
    fn write(
        &mut self,
        writer: &mut SerializedFileWriter<BufWriter<File>>,
    ) -> Result<(), WriteError> {
        let mut group = writer.next_row_group()?;
        for values in self.columns.iter_mut().chain([&mut self.geometries]) {
            if let Some(column) = group.next_column()? {
                values.write(column)?;
            }
        }
        group.close()?;
        (self.n_rows, self.bytes) = (0, 0);
        Ok(())
    }
}

impl Values {
    fn new(kind: Kind) -> Self {
        let values = match kind {
            Kind::Boolean => Kinds::Boolean(Vec::new()),
            Kind::Integer => Kinds::Integer(Vec::new()),
            Kind::Real => Kinds::Real(Vec::new()),
            Kind::Text => Kinds::Bytes(Vec::new()),
        };
        Self { levels: Vec::new(), values }
    }

    /// Adds a value; gives about as many bytes as it takes.
    fn push(&mut self, cell: &Cell) -> usize {
        let mut size = size_of::<i64>();
        let is_there = match (cell, &mut self.values) {
            (Cell::Boolean(value), Kinds::Boolean(values)) => {
                values.push(*value);
                true
            }
            (Cell::Integer(value), Kinds::Integer(values)) => {
                values.push(*value);
                true
            }
            (Cell::Real(value), Kinds::Real(values)) => {
                values.push(*value);
                true
            }
            (Cell::Text(text), Kinds::Bytes(values)) => {
                size += text.len() + size_of::<ByteArray>();
                values.push(text.as_str().into());
                true
            }
            _ => false,
        };
        self.levels.push(i16::from(is_there));
        size
    }

    /// The same for bytes.
    fn push_bytes(&mut self, bytes: Option<Vec<u8>>) -> usize {
        self.levels.push(i16::from(bytes.is_some()));
        match (bytes, &mut self.values) {
            (Some(bytes), Kinds::Bytes(values)) => {
                let size = bytes.len() + size_of::<ByteArray>();
                values.push(bytes.into());
                size
            }
            _ => 0,
        }
    }

    fn write(&mut self, column: SerializedColumnWriter<'_>) -> Result<(), WriteError> {
        fn put<T: DataType>(
            mut column: SerializedColumnWriter<'_>,
            values: &mut Vec<T::T>,
            levels: &mut Vec<i16>,
        ) -> Result<(), WriteError> {
            column.typed::<T>().write_batch(values, Some(levels), None)?;
            values.clear();
            levels.clear();
            Ok(column.close()?)
        }
        match &mut self.values {
            Kinds::Boolean(values) => put::<BoolType>(column, values, &mut self.levels),
            Kinds::Integer(values) => put::<Int64Type>(column, values, &mut self.levels),
            Kinds::Real(values) => put::<DoubleType>(column, values, &mut self.levels),
            Kinds::Bytes(values) => put::<ByteArrayType>(column, values, &mut self.levels),
        }
    }
}
