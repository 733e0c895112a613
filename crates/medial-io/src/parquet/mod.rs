//! GeoParquet, versions 1.0 and 1.1: columns of Apache Parquet, one of them of geometries.

mod geo;
mod pages;
mod read;
mod write;

pub use read::open;
pub use write::write;

#[cfg(test)]
mod tests {
    use parquet::basic::{LogicalType, Repetition, Type as Physical};
    use parquet::data_type::{ByteArray, ByteArrayType};
    use parquet::file::metadata::KeyValue;
    use parquet::file::properties::WriterProperties;
    use parquet::file::writer::SerializedFileWriter;
    use parquet::schema::types::Type;
    use std::sync::Arc;

    /// A file with a column of a type for geometries with a reference system, and no metadata `geo`.
    fn typed(crs: Option<&str>) -> Option<String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("typed.parquet");
        let kind = LogicalType::geometry(crs.map(ToOwned::to_owned));
        let field = Type::primitive_type_builder("shape", Physical::BYTE_ARRAY)
            .with_repetition(Repetition::OPTIONAL)
            .with_logical_type(Some(kind))
            .build()
            .unwrap();
        let schema = Type::group_type_builder("schema").with_fields(vec![Arc::new(field)]);
        let key = "mine".to_owned();
        let projjson =
            "{\"type\":\"ProjectedCRS\",\"name\":\"x\",\"id\":{\"authority\":\"A\",\"code\":7}}";
        let pairs = vec![KeyValue::new(key, projjson.to_owned())];
        let properties = WriterProperties::builder().set_key_value_metadata(Some(pairs)).build();
        let file = std::fs::File::create(&path).unwrap();
        let schema = Arc::new(schema.build().unwrap());
        let mut writer = SerializedFileWriter::new(file, schema, Arc::new(properties)).unwrap();
        let mut group = writer.next_row_group().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        // An empty polygon.
        let polygon = ByteArray::from(vec![1, 3, 0, 0, 0, 0, 0, 0, 0]);
        column.typed::<ByteArrayType>().write_batch(&[polygon], Some(&[1]), None).unwrap();
        column.close().unwrap();
        group.close().unwrap();
        writer.close().unwrap();
        let layer = super::open(&path).unwrap();
        let crs = layer.crs.as_ref().map(ToString::to_string);
        assert!(layer.map(Result::unwrap).all(|feature| feature.polygonal));
        crs
    }

    #[test]
    fn the_type_of_a_column_tells_the_reference_system() {
        let projjson = "{\"type\":\"ProjectedCRS\",\"name\":\"x\",\"id\":{\"authority\":\"EPSG\",\"code\":28992}}";
        for (crs, expected) in [
            (None, Some("OGC:CRS84")),
            (Some("EPSG:2193"), Some("EPSG:2193")),
            (Some("srid:5070"), Some("EPSG:5070")),
            (Some("srid:0"), None),
            (Some("projjson:mine"), Some("A:7")),
            (Some("projjson:other"), None),
            (Some(projjson), Some("EPSG:28992")),
        ] {
            assert_eq!(typed(crs).as_deref(), expected, "{crs:?}");
        }
    }
}
