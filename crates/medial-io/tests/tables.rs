//! Tables of features: what is written reads back, and damaged files are refused.

use medial::geom::Point;
use medial_io::table::{self, Spool, WriteError, Written};
use medial_io::{Crs, Error, Feature, Format, Layer, ReadOptions, open};
use std::path::{Path, PathBuf};

const TABLES: [Format; 4] = [Format::Gpkg, Format::Shp, Format::Fgb, Format::Parquet];

/// Two polygons and one of two parts, with doubles that need all their digits.
const POLYGONS: &str = concat!(
    r#"{"type":"Feature","properties":{"name":"é \"a\"","n":1,"x":0.1,"is":true,"none":null},"geometry":"#,
    r#"{"type":"Polygon","coordinates":[[[0.1,0.2],[10.3,0.2],[10.3,10.7],[0.1,0.2]],[[5.0,1.0],[7.0,3.0],[7.0,1.0],[5.0,1.0]]]}}"#,
    "\n",
    r#"{"type":"Feature","properties":{"name":null,"n":-7,"x":5e-324,"is":false},"geometry":"#,
    r#"{"type":"MultiPolygon","coordinates":[[[[20.0,0.0],[21.0,0.0],[21.0,1.0],[20.0,0.0]]],[[[30.0,0.0],[31.333333333333332,0.0],[31.0,1.0],[30.0,0.0]]]]}}"#,
    "\n",
    r#"{"type":"Feature","properties":{"x":-1.7976931348623157e308,"n":9007199254740993},"geometry":"#,
    r#"{"type":"Polygon","coordinates":[[[-0.5,-1e-5],[1e300,0.0],[1.0,1.0],[-0.5,-1e-5]]]}}"#,
    "\n",
);

const POINT_AND_LINE: &str = concat!(
    r#"{"type":"Feature","properties":{"a_long_name_1":1,"a_long_name_2":2,"A_LONG_NAME":3},"geometry":"#,
    r#"{"type":"Point","coordinates":[1.0,2.0,3.0]}}"#,
    "\n",
    r#"{"type":"Feature","properties":{},"geometry":"#,
    r#"{"type":"LineString","coordinates":[[1.0,2.0,3.0],[2.0,2.0,4.0]]}}"#,
    "\n",
);

fn write(
    format: Format,
    path: &Path,
    lines: &str,
    crs: Option<&Crs>,
) -> Result<Written, WriteError> {
    let mut spool = Spool::new(tempfile::tempfile().unwrap());
    spool.add(lines.as_bytes()).unwrap();
    let written = table::write(format, path, "layer", crs, &mut spool)?;
    for (from, extension) in &written.beside {
        std::fs::rename(from, path.with_extension(extension)).unwrap();
    }
    Ok(written)
}

fn read(format: Format, path: &Path) -> Layer<'static> {
    open(format, path, &ReadOptions::default()).unwrap()
}

fn file(folder: &tempfile::TempDir, format: Format) -> PathBuf {
    folder.path().join(format!("layer.{format}"))
}

/// Features by the value of a column that all have, as an index may sort them.
fn sorted(layer: Layer<'_>) -> Vec<Feature> {
    let mut features: Vec<Feature> = layer.map(Result::unwrap).collect();
    features.sort_by_key(|feature| value(feature, "n").parse::<i64>().unwrap());
    features
}

fn value(feature: &Feature, name: &str) -> String {
    let found = feature.properties.iter().find(|(found, _)| found == name);
    found.map_or_else(String::new, |(_, value)| value.get().to_owned())
}

/// Rings from their least point on, counterclockwise: the shape, not how it was written.
fn shape(feature: &Feature) -> Vec<Vec<Vec<(u64, u64)>>> {
    let ring = |ring: &Vec<Point>| {
        let mut points = ring.clone();
        assert_eq!(points.first(), points.last(), "closed");
        points.pop();
        let twice: f64 = (0..points.len())
            .map(|k| (points[k], points[(k + 1) % points.len()]))
            .map(|(a, b)| (b.x - a.x) * (b.y + a.y))
            .sum();
        if twice > 0.0 {
            points.reverse();
        }
        let least = (0..points.len()).min_by(|&a, &b| {
            points[a].x.total_cmp(&points[b].x).then(points[a].y.total_cmp(&points[b].y))
        });
        points.rotate_left(least.unwrap());
        points.iter().map(|p| (p.x.to_bits(), p.y.to_bits())).collect()
    };
    feature.polygons.iter().map(|rings| rings.iter().map(ring).collect()).collect()
}

#[test]
fn polygons_and_values_come_back_from_every_table() {
    let source = medial_io::read(Format::GeoJsonLines, POLYGONS.as_bytes()).unwrap();
    let source = sorted(source);
    for format in TABLES {
        let folder = tempfile::tempdir().unwrap();
        let path = file(&folder, format);
        write(format, &path, POLYGONS, Some(&Crs::epsg(4326))).unwrap();
        let layer = read(format, &path);
        assert_eq!(layer.crs.as_ref().and_then(Crs::epsg_code), Some(4326), "{format}");
        assert_eq!(layer.len, Some(3), "{format}");
        let found = sorted(layer);
        assert_eq!(found.len(), 3);
        for (found, source) in found.iter().zip(&source) {
            assert_eq!(shape(found), shape(source), "{format}");
            for name in ["name", "n", "x", "is"] {
                let expected = match value(source, name).as_str() {
                    "" => "null".to_owned(),
                    other => other.to_owned(),
                };
                let read = value(found, name);
                match (read.parse::<f64>(), expected.parse::<f64>()) {
                    (Ok(read), Ok(expected)) => assert_eq!(read.to_bits(), expected.to_bits()),
                    _ => assert_eq!(read, expected, "{format}: {name}"),
                }
            }
        }
        assert_eq!(value(&found[2], "n"), "9007199254740993", "{format}: no double");
    }
}

#[test]
fn reference_systems_pass_through() {
    for format in TABLES {
        let folder = tempfile::tempdir().unwrap();
        let path = file(&folder, format);
        let crs = |crs: Option<&Crs>| {
            let written = write(format, &path, POLYGONS, crs).unwrap();
            (read(format, &path).crs, written.warnings)
        };
        let (found, _) = crs(Some(&Crs::of_geojson()));
        assert!(found.as_ref().is_some_and(Crs::is_geographic), "{format}");
        assert_eq!(found.unwrap().epsg_code(), Some(4326), "{format}");
        let (found, warnings) = crs(Some(&Crs::epsg(2193)));
        assert_eq!(found.unwrap().epsg_code(), Some(2193), "{format}");
        assert!(warnings.iter().all(|warning| !warning.contains("reference system")));
        let own = "PROJCS[\"mine\",GEOGCS[\"g\"],UNIT[\"metre\",1]]";
        let (found, warnings) = crs(Some(&Crs::of_wkt(own)));
        if format == Format::Parquet {
            assert!(found.is_none() && warnings[0].contains("PROJJSON"), "{warnings:?}");
        } else {
            assert_eq!(found.unwrap().wkt().as_deref(), Some(own), "{format}");
        }
        let folder = tempfile::tempdir().unwrap();
        let path = file(&folder, format);
        write(format, &path, POLYGONS, None).unwrap();
        assert!(read(format, &path).crs.is_none(), "{format}");
    }
}

/// A system that no authority knows.
const OWN: &str = "PROJCS[\"mine\",GEOGCS[\"g\",DATUM[\"d\",SPHEROID[\"s\",6378137,298.25]],\
    PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],\
    PROJECTION[\"Albers_Conic_Equal_Area\"],PARAMETER[\"latitude_of_center\",10],\
    PARAMETER[\"longitude_of_center\",20],PARAMETER[\"standard_parallel_1\",5],\
    PARAMETER[\"standard_parallel_2\",15],PARAMETER[\"false_easting\",1000],\
    PARAMETER[\"false_northing\",0],UNIT[\"US survey foot\",0.304800609601219],\
    AXIS[\"Easting\",EAST],AXIS[\"Northing\",NORTH]]";

#[test]
fn a_system_of_ones_own_goes_through_parquet_into_every_table() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, Format::Parquet);
    let written = write(Format::Parquet, &path, POLYGONS, Some(&Crs::of_wkt(OWN))).unwrap();
    assert!(written.warnings.is_empty(), "{:?}", written.warnings);
    let crs = read(Format::Parquet, &path).crs.unwrap();
    let projjson: serde_json::Value = serde_json::from_str(&crs.projjson().unwrap()).unwrap();
    let conversion = &projjson["conversion"];
    assert_eq!(conversion["method"]["id"]["code"], 9822);
    assert_eq!(conversion["parameters"][4]["value"], 1000);
    assert_eq!(conversion["parameters"][4]["unit"]["conversion_factor"], 0.304800609601219);
    for format in [Format::Gpkg, Format::Shp, Format::Fgb] {
        let path = file(&folder, format);
        write(format, &path, POLYGONS, Some(&crs)).unwrap();
        let found = read(format, &path).crs.unwrap();
        assert_eq!(found.name().as_deref(), Some("mine"), "{format}");
        if format == Format::Shp {
            assert_eq!(found.wkt().unwrap(), OWN);
        }
    }
}

/// The first page of a column of one text of a million letters claims to be as large as its size can say in
/// as many bytes.
#[test]
fn a_page_of_parquet_that_claims_too_much_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, Format::Parquet);
    let line = POLYGONS.lines().next().unwrap();
    let line = line.replace("\"n\":1", &format!("\"n\":\"{}\"", "a".repeat(1_100_000)));
    write(Format::Parquet, &path, &line, None).unwrap();
    let mut bytes = std::fs::read(&path).unwrap();
    let is_size = |window: &[u8]| {
        // The type of a page of data is 0, or of a dictionary 4; its size is behind it.
        let [0x15, 0 | 4, 0x15, a, b, c, d, 0x15] = *window else { return false };
        let size =
            [a, b, c, d].iter().rev().fold(0_u32, |n, &byte| n << 7 | u32::from(byte & 0x7f));
        (2_200_000..2_300_000).contains(&size)
    };
    let at = bytes.windows(8).position(is_size).unwrap();
    bytes[at + 3..at + 7].copy_from_slice(&[0xfe, 0xff, 0xff, 0x7f]);
    std::fs::write(&path, bytes).unwrap();
    let features: Vec<_> = read(Format::Parquet, &path).collect();
    let error = features.last().unwrap().as_ref().unwrap_err().to_string();
    assert!(error.contains("claims to hold 134217727"), "{error}");
}

#[test]
fn columns_of_parquet_with_one_name_are_told() {
    use parquet::data_type::{ByteArrayType, Int64Type};
    use parquet::file::writer::SerializedFileWriter;
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, Format::Parquet);
    let schema = "message m { required int64 a; required binary geometry; required int64 b; \
                  required int64 a; }";
    let schema = parquet::schema::parser::parse_message_type(schema).unwrap();
    let out = std::fs::File::create(&path).unwrap();
    let mut writer = SerializedFileWriter::new(out, schema.into(), Default::default()).unwrap();
    let mut group = writer.next_row_group().unwrap();
    let mut wkb = vec![1, 3, 0, 0, 0, 1, 0, 0, 0, 4, 0, 0, 0];
    for number in [0.0_f64, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0] {
        wkb.extend(number.to_le_bytes());
    }
    for k in 0..4_i64 {
        let mut column = group.next_column().unwrap().unwrap();
        if k == 1 {
            let values = [wkb.clone().into()];
            column.typed::<ByteArrayType>().write_batch(&values, None, None).unwrap();
        } else {
            column.typed::<Int64Type>().write_batch(&[k], None, None).unwrap();
        }
        column.close().unwrap();
    }
    group.close().unwrap();
    writer.close().unwrap();
    let layer = read(Format::Parquet, &path);
    let warning =
        "several columns have one name, `a`; only the last one of each is read: rename the others";
    assert_eq!(layer.warnings, [warning]);
    let feature = layer.map(Result::unwrap).next().unwrap();
    assert!(feature.polygonal);
    let told: Vec<_> =
        feature.properties.iter().map(|(name, value)| (name.as_str(), value.get())).collect();
    assert_eq!(told, [("b", "2"), ("a", "3")]);
}

#[test]
fn projjson_passes_through_parquet() {
    let text = r#"{"type":"ProjectedCRS","name":"x","id":{"authority":"EPSG","code":28992}}"#;
    let crs = Crs::of_projjson(serde_json::from_str(text).unwrap());
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, Format::Parquet);
    write(Format::Parquet, &path, POLYGONS, Some(&crs)).unwrap();
    let found = read(Format::Parquet, &path).crs.unwrap();
    assert_eq!(found.epsg_code(), Some(28992));
}

#[test]
fn a_shapefile_has_one_kind_of_geometry() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, Format::Shp);
    let written = write(Format::Shp, &path, POINT_AND_LINE, None).unwrap();
    assert!(written.warnings.iter().any(|warning| warning.contains("1 of 2 are points")));
    let mixed = [POINT_AND_LINE, POLYGONS].concat();
    let error = write(Format::Shp, &path, &mixed, None).unwrap_err();
    assert!(error.to_string().contains("Point and LineString and Polygon and "), "{error}");
    for format in [Format::Gpkg, Format::Fgb, Format::Parquet] {
        write(format, &file(&folder, format), POINT_AND_LINE, None).unwrap();
        let found: Vec<_> = read(format, &file(&folder, format)).map(Result::unwrap).collect();
        assert_eq!(found.len(), 2, "{format}");
        assert!(found.iter().all(|feature| !feature.polygonal), "{format}");
        let mut names: Vec<&str> = found.iter().map(|feature| feature.geometry.as_str()).collect();
        names.sort_unstable();
        assert_eq!(names, ["a LineString", "a Point"], "{format}");
    }
}

#[test]
fn names_of_a_shapefile_are_short_and_differ() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, Format::Shp);
    let line = POINT_AND_LINE.lines().next().unwrap();
    let written = write(Format::Shp, &path, line, None).unwrap();
    let warning = "`a_long_name_1` as `a_long_nam`, `a_long_name_2` as `a_long_n_1`, `A_LONG_NAME` as `A_LONG_N_2`";
    assert!(written.warnings[0].ends_with(warning), "{:?}", written.warnings);
    let found = read(Format::Shp, &path).next().unwrap().unwrap();
    assert_eq!(found.properties[1].0, "a_long_n_1");
}

#[test]
fn names_of_a_geopackage_differ_from_its_own() {
    let line = r#"{"type":"Feature","properties":{"FID":1,"geom":2,"a":3,"A":4,"x\"; DROP TABLE layer; --":5},"geometry":{"type":"Point","coordinates":[0.0,0.0]}}"#;
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, Format::Gpkg);
    let written = write(Format::Gpkg, &path, line, None).unwrap();
    assert_eq!(written.warnings.len(), 3);
    let found = read(Format::Gpkg, &path).next().unwrap().unwrap();
    let names: Vec<&str> = found.properties.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["FID_1", "geom_1", "a", "A_1", "x\"; DROP TABLE layer; --"]);
    assert_eq!(found.id.unwrap().get(), "1");
}

#[test]
fn a_table_without_rows_is_one() {
    for format in TABLES {
        let folder = tempfile::tempdir().unwrap();
        let path = file(&folder, format);
        write(format, &path, "", None).unwrap();
        assert_eq!(read(format, &path).count(), 0, "{format}");
    }
}

#[test]
fn a_layer_has_the_name_of_its_file_or_is_missed() {
    for format in TABLES {
        let folder = tempfile::tempdir().unwrap();
        let path = file(&folder, format);
        write(format, &path, POLYGONS, None).unwrap();
        let layer = |name: &str| {
            open(format, &path, &ReadOptions { layer: Some(name.to_owned()), ..Default::default() })
        };
        assert!(layer("layer").is_ok(), "{format}");
        let error = layer("lakes").err().unwrap();
        assert!(matches!(error, Error::Layer { .. }), "{format}");
        assert!(error.to_string().contains("`lakes`") && error.to_string().contains("`layer`"));
    }
}

#[test]
fn a_file_of_another_format_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for format in TABLES {
        for bytes in [&b""[..], b"x", b"SQLite format 3\0", b"fgb\x03fgb\0", b"PAR1PAR1", &[0; 200]]
        {
            let path = file(&folder, format);
            std::fs::write(&path, bytes).unwrap();
            assert!(open(format, &path, &ReadOptions::default()).is_err(), "{format}: {bytes:?}");
        }
        let error = open(format, Path::new("/nowhere/x"), &ReadOptions::default()).err().unwrap();
        assert!(matches!(error, Error::Interrupted { .. }), "{format}");
    }
}

#[test]
fn layers_of_a_geopackage_are_named_where_there_are_several() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, Format::Gpkg);
    write(Format::Gpkg, &path, POLYGONS, None).unwrap();
    let database = rusqlite::Connection::open(&path).unwrap();
    database
        .execute_batch(
            "CREATE TABLE other (id INTEGER PRIMARY KEY, shape BLOB, flag BOOLEAN, at DATE, raw BLOB);
             INSERT INTO other VALUES (5, x'00', 1, '2026-11-29', x'4d616e'), (6, NULL, 0, NULL, NULL);
             INSERT INTO gpkg_contents (table_name, data_type, srs_id) VALUES ('other', 'features', 0);
             INSERT INTO gpkg_geometry_columns VALUES ('other', 'shape', 'POLYGON', 0, 0, 0);",
        )
        .unwrap();
    drop(database);
    let error = open(Format::Gpkg, &path, &ReadOptions::default()).err().unwrap();
    let expected = "there are several layers, `layer`, `other`; choose one with --layer";
    assert_eq!(error.to_string(), expected);
    let options = ReadOptions { layer: Some("other".to_owned()), ..ReadOptions::default() };
    let layer = open(Format::Gpkg, &path, &options).unwrap();
    assert!(layer.crs.as_ref().is_some_and(Crs::is_geographic), "undefined, but geographic");
    let rows: Vec<_> = layer.collect();
    let error = rows[0].as_ref().unwrap_err();
    assert_eq!(error.id.as_ref().unwrap().get(), "5");
    assert_eq!(error.to_string(), "geometry: it has no header of a GeoPackage");
    let second = rows[1].as_ref().unwrap();
    assert_eq!((value(second, "flag"), value(second, "raw")), ("false".into(), "null".into()));
    assert_eq!(second.geometry, "without a geometry");
}

/// The folder of a written layer of the three polygons, one file of which is cut off or gone.
fn cut(format: Format, extension: &str, keep: impl Fn(&[u8]) -> usize) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, format);
    write(format, &path, POLYGONS, None).unwrap();
    let path = path.with_extension(extension);
    let bytes = std::fs::read(&path).unwrap();
    std::fs::write(path, &bytes[..keep(&bytes)]).unwrap();
    folder
}

#[test]
fn an_index_that_is_cut_off_loses_no_shapes() {
    for keep in [50, 100, 108, 113] {
        let folder = cut(Format::Shp, "shx", |_| keep);
        let layer = read(Format::Shp, &file(&folder, Format::Shp));
        let whole = if keep < 100 { 100 } else { 124 };
        let expected = format!("has {keep} of {whole} bytes");
        assert!(layer.warnings.iter().any(|warning| warning.contains(&expected)), "{keep}");
        assert_eq!(layer.map(Result::unwrap).count(), 3, "{keep}");
    }
}

#[test]
fn shapes_without_values_are_noted() {
    let folder = cut(Format::Shp, "dbf", |bytes| bytes.len() - 20);
    let found: Vec<Feature> =
        read(Format::Shp, &file(&folder, Format::Shp)).map(Result::unwrap).collect();
    let codes = |k: usize| found[k].notes.iter().map(|note| note.code).collect::<Vec<_>>();
    assert_eq!((codes(1), codes(2)), (vec![], vec!["values_missing"]));
    // A table that says that it has fewer rows.
    let path = file(&folder, Format::Shp).with_extension("dbf");
    let mut bytes = std::fs::read(&path).unwrap();
    bytes[4] = 1;
    std::fs::write(&path, bytes).unwrap();
    let found = read(Format::Shp, &file(&folder, Format::Shp)).map(Result::unwrap);
    assert_eq!(found.map(|feature| feature.notes.len()).collect::<Vec<_>>(), [0, 1, 1]);
}

#[test]
fn shapes_that_break_off_between_two_of_them_are_missed() {
    // Behind the first record, and within the second one.
    for more in [0, 4, 20] {
        let folder = cut(Format::Shp, "shp", |bytes| {
            let words = u32::from_be_bytes(*bytes[104..].first_chunk().unwrap()) as usize;
            100 + 8 + 2 * words + more
        });
        let path = file(&folder, Format::Shp);
        std::fs::remove_file(path.with_extension("shx")).unwrap();
        let found: Vec<_> = read(Format::Shp, &path).collect();
        assert_eq!(found.len(), 2, "{more}");
        let error = &found[1].as_ref().unwrap_err().error;
        assert!(matches!(error, Error::Interrupted { .. }), "{error}");
    }
}

#[test]
fn a_flatgeobuf_that_breaks_off_between_two_features_is_short_of_some() {
    let whole = cut(Format::Fgb, "fgb", <[u8]>::len);
    let bytes = std::fs::read(file(&whole, Format::Fgb)).unwrap();
    let size = |at: usize| u32::from_le_bytes(*bytes[at..].first_chunk().unwrap()) as usize;
    // Behind the header is the index: three leaves and a root of 40 bytes each.
    let mut starts = Vec::new();
    let mut at = 8 + 4 + size(8) + 4 * 40;
    while at < bytes.len() {
        starts.push(at);
        at += 4 + size(at);
    }
    assert_eq!(starts.len(), 3);
    let folder = cut(Format::Fgb, "fgb", |_| starts[2]);
    let found: Vec<_> = read(Format::Fgb, &file(&folder, Format::Fgb)).collect();
    assert_eq!(found.len(), 3);
    let error = &found[2].as_ref().unwrap_err().error;
    assert_eq!(error.to_string(), "the file ends after 2 of 3 features");
    assert!(matches!(error, Error::Interrupted { .. }));
}

#[test]
fn nothing_is_left_beside_a_geopackage_that_had_a_log() {
    let folder = tempfile::tempdir().unwrap();
    // What means something in names of the library.
    let path = folder.path().join("a %41?b#c.gpkg");
    write(Format::Gpkg, &path, POLYGONS, None).unwrap();
    let database = rusqlite::Connection::open(&path).unwrap();
    let mode: String =
        database.query_row("PRAGMA journal_mode = WAL", [], |row| row.get(0)).unwrap();
    assert_eq!(mode, "wal");
    let count = || read(Format::Gpkg, &path).map(Result::unwrap).count();
    // Changes that are in the log alone count too.
    database.execute_batch("DELETE FROM \"layer\" WHERE fid = 1").unwrap();
    assert_eq!(count(), 2);
    database.close().unwrap();
    let names = || -> Vec<_> {
        std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect()
    };
    assert_eq!(names().len(), 1, "{:?}", names());
    assert_eq!(count(), 2);
    assert_eq!(names().len(), 1, "{:?}", names());
}

#[test]
fn a_name_that_is_reserved_in_a_geopackage_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut spool = Spool::new(tempfile::tempfile().unwrap());
    spool.add(POLYGONS.as_bytes()).unwrap();
    let path = file(&folder, Format::Gpkg);
    let error = table::write(Format::Gpkg, &path, "SQLite_x", None, &mut spool).unwrap_err();
    assert!(matches!(error, WriteError::Unfit { .. }));
    assert!(error.to_string().ends_with("name the file otherwise"), "{error}");
}

#[test]
fn reference_systems_of_shapefiles_are_read_in_their_encoding() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(&folder, Format::Shp);
    write(Format::Shp, &path, POLYGONS, None).unwrap();
    let of = |text: &[u8]| {
        std::fs::write(path.with_extension("prj"), text).unwrap();
        let layer = read(Format::Shp, &path);
        (layer.crs.and_then(|crs| crs.name()), layer.warnings)
    };
    assert_eq!(of(b"PROJCS[\"Gau\xdf\"]"), (Some("Gauß".to_owned()), vec![]));
    assert_eq!(of("\u{feff}PROJCS[\"Gauß\"]".as_bytes()), (Some("Gauß".to_owned()), vec![]));
    assert_eq!(of(b" \n"), (None, vec![]));
    let (name, warnings) = of(b"hello world");
    assert!(name.is_none() && warnings[0].contains("`hello world` begins no"), "{warnings:?}");
    assert_eq!(Crs::of_wkt("PROJCS[]").to_string(), "without a name");
}

#[test]
fn messages_of_damaged_tables_say_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let said = |format: Format, bytes: &[u8]| {
        let path = file(&folder, format);
        std::fs::write(&path, bytes).unwrap();
        open(format, &path, &ReadOptions::default()).err().unwrap().to_string()
    };
    let why = said(Format::Parquet, &[0; 200]);
    assert!(why.ends_with("; copy it again if it is cut off"), "{why}");
    let why = said(Format::Gpkg, &[b'x'; 2000]);
    assert!(why.ends_with("; name its format with --from"), "{why}");
    let path = file(&folder, Format::Gpkg);
    write(Format::Gpkg, &path, POLYGONS, None).unwrap();
    let mut bytes = std::fs::read(&path).unwrap();
    bytes[100..4096].fill(0xff);
    let why = said(Format::Gpkg, &bytes);
    assert!(why.contains("; copy it again, or repair it"), "{why}");
}

/// A small generator of numbers, the same on every run.
struct Dice(u64);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % n as u64) as usize
    }
}

#[test]
fn damaged_tables_are_read_or_refused() {
    let mut dice = Dice(0x9e37_79b9_7f4a_7c15);
    for format in TABLES {
        let folder = tempfile::tempdir().unwrap();
        let path = file(&folder, format);
        write(format, &path, POLYGONS, Some(&Crs::epsg(4326))).unwrap();
        let members: Vec<PathBuf> =
            std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().path()).collect();
        let (mut good, mut bad) = (0, 0);
        for _ in 0..400 {
            let member = &members[dice.below(members.len())];
            let whole = std::fs::read(member).unwrap();
            let mut bytes = whole.clone();
            for _ in 0..=dice.below(3) {
                let at = dice.below(bytes.len());
                match dice.below(4) {
                    0 => bytes[at] = [0, 1, 0x7f, 0x80, 0xff][dice.below(5)],
                    1 => drop(bytes.drain(at..(at + 1 + dice.below(9)).min(bytes.len()))),
                    2 => bytes[at] ^= 1 << dice.below(8),
                    _ => bytes.truncate(at.max(1)),
                }
                if bytes.is_empty() {
                    bytes.push(0);
                }
            }
            std::fs::write(member, &bytes).unwrap();
            // What panics on the way is an item that says so; nothing else may.
            match open(format, &path, &ReadOptions::default()) {
                Ok(layer) => layer.take(1000).for_each(|read| match read {
                    Ok(_) => good += 1,
                    Err(_) => bad += 1,
                }),
                Err(_) => bad += 1,
            }
            std::fs::write(member, &whole).unwrap();
        }
        assert!(good > 100 && bad > 10, "{format}: {good} {bad}");
    }
}
