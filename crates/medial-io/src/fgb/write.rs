use crate::table::{Cell, Geometry, Kind, Place, Rows, Table, WriteError, Written};
use flatgeobuf::geozero::error::Result;
use flatgeobuf::geozero::{ColumnValue, GeomProcessor, GeozeroGeometry, PropertyProcessor as _};
use flatgeobuf::{ColumnType, FgbCrs, FgbWriter, FgbWriterOptions, GeometryType};
use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::Path;

/// Writes a FlatGeobuf with an index, by which features are sorted. The boxes of all features are held in
/// memory meanwhile, some 140 bytes each.
///
/// # Errors
/// If the system fails.
pub fn write(
    path: &Path,
    table: &Table<'_>,
    rows: Rows<'_>,
) -> std::result::Result<Written, WriteError> {
    let schema = table.schema;
    let kind = kind_of(table);
    let (in_space, _) = schema.in_space();
    let wkt = table.crs.and_then(|crs| crs.wkt());
    let name = table.crs.and_then(|crs| crs.name());
    let code = table.crs.and_then(|crs| crs.epsg_code()).and_then(|code| i32::try_from(code).ok());
    let other = table.crs.filter(|_| code.is_none()).and_then(|crs| crs.authority());
    let other_code = other.and_then(|(_, code)| code.parse().ok());
    let crs = FgbCrs {
        org: code.map(|_| "EPSG").or(other.map(|(authority, _)| authority)),
        code: code.or(other_code).unwrap_or_default(),
        name: name.as_deref(),
        wkt: wkt.as_deref(),
        code_string: other.filter(|_| other_code.is_none()).map(|(_, code)| code),
        description: None,
    };
    let options = FgbWriterOptions {
        write_index: schema.extent().is_some(),
        detect_type: false,
        promote_to_multi: false,
        crs,
        has_z: in_space,
        ..FgbWriterOptions::default()
    };
    let failed = |error: flatgeobuf::Error| WriteError::of(&error);
    let mut writer = FgbWriter::create_with_options(table.name, kind, options).map_err(failed)?;
    for column in schema.columns() {
        let kind = match column.kind {
            Kind::Boolean => ColumnType::Bool,
            Kind::Integer => ColumnType::Long,
            Kind::Real => ColumnType::Double,
            Kind::Text => ColumnType::String,
        };
        writer.add_column(&column.name, kind, |_, _| {});
    }
    let mut n_without = 0_usize;
    for row in rows {
        let row = row?;
        let Some(geometry) = row.wkb.as_deref().and_then(Geometry::of_wkb) else {
            n_without += 1;
            continue;
        };
        let shape = Shape { geometry: &geometry, is_multi: is_multi(kind), in_space };
        let mut put = Ok(());
        let added = writer.add_feature_geom(shape, |feature| {
            for (k, cell) in row.cells.iter().enumerate() {
                let value = match cell {
                    Cell::Null => continue,
                    Cell::Boolean(value) => ColumnValue::Bool(*value),
                    Cell::Integer(value) => ColumnValue::Long(*value),
                    Cell::Real(value) => ColumnValue::Double(*value),
                    Cell::Text(text) => ColumnValue::String(text),
                };
                if let Err(error) = feature.property(k, &schema.columns()[k].name, &value) {
                    put = Err(error);
                }
            }
        });
        added.and(put).map_err(|error| WriteError::of(&error))?;
    }
    let mut out = BufWriter::new(File::create(path)?);
    writer.write(&mut out).map_err(failed)?;
    out.flush()?;
    let mut written = Written::default();
    if n_without > 0 {
        let why = format!("{n_without} features without a geometry are left out of a FlatGeobuf");
        written.warnings.push(why);
    }
    Ok(written)
}

/// The type of all geometries: of one kind and its multiple that of the multiple.
fn kind_of(table: &Table<'_>) -> GeometryType {
    let mut numbers: Vec<u32> = table.schema.geometries.iter().map(|kind| kind.number).collect();
    numbers.dedup();
    match numbers[..] {
        [1] => GeometryType::Point,
        [2] => GeometryType::LineString,
        [3] => GeometryType::Polygon,
        [4] => GeometryType::MultiPoint,
        [5] | [2, 5] => GeometryType::MultiLineString,
        [6] | [3, 6] => GeometryType::MultiPolygon,
        _ => GeometryType::Unknown,
    }
}

fn is_multi(kind: GeometryType) -> bool {
    matches!(kind, GeometryType::MultiLineString | GeometryType::MultiPolygon)
}

/// A geometry as the library takes it.
struct Shape<'a> {
    geometry: &'a Geometry,
    is_multi: bool,
    in_space: bool,
}

impl GeozeroGeometry for Shape<'_> {
    fn process_geom<P: GeomProcessor>(&self, out: &mut P) -> Result<()> {
        let put = |out: &mut P, place: &Place, k: usize| {
            if self.in_space {
                let z = Some(place.z.unwrap_or(0.0));
                out.coordinate(place.x, place.y, z, None, None, None, k)
            } else {
                out.xy(place.x, place.y, k)
            }
        };
        let places = |out: &mut P, places: &[Place]| {
            places.iter().enumerate().try_for_each(|(k, place)| put(out, place, k))
        };
        let line = |out: &mut P, is_whole: bool, line: &[Place], k: usize| {
            out.linestring_begin(is_whole, line.len(), k)?;
            places(out, line)?;
            out.linestring_end(is_whole, k)
        };
        let polygon = |out: &mut P, is_whole: bool, rings: &[Vec<Place>], k: usize| {
            out.polygon_begin(is_whole, rings.len(), k)?;
            rings.iter().enumerate().try_for_each(|(k, ring)| line(out, false, ring, k))?;
            out.polygon_end(is_whole, k)
        };
        let lines = |out: &mut P, lines: &[&[Place]]| {
            out.multilinestring_begin(lines.len(), 0)?;
            lines.iter().enumerate().try_for_each(|(k, each)| line(out, false, each, k))?;
            out.multilinestring_end(0)
        };
        let polygons = |out: &mut P, polygons: &[&[Vec<Place>]]| {
            out.multipolygon_begin(polygons.len(), 0)?;
            polygons.iter().enumerate().try_for_each(|(k, each)| polygon(out, false, each, k))?;
            out.multipolygon_end(0)
        };
        match self.geometry {
            Geometry::Point(place) => {
                out.point_begin(0)?;
                put(out, place, 0)?;
                out.point_end(0)
            }
            Geometry::MultiPoint(points) => {
                out.multipoint_begin(points.len(), 0)?;
                places(out, points)?;
                out.multipoint_end(0)
            }
            Geometry::LineString(points) if self.is_multi => lines(out, &[points]),
            Geometry::LineString(points) => line(out, true, points, 0),
            Geometry::MultiLineString(parts) => {
                lines(out, &parts.iter().map(Vec::as_slice).collect::<Vec<_>>())
            }
            Geometry::Polygon(rings) if self.is_multi => polygons(out, &[rings]),
            Geometry::Polygon(rings) => polygon(out, true, rings, 0),
            Geometry::MultiPolygon(parts) => {
                polygons(out, &parts.iter().map(Vec::as_slice).collect::<Vec<_>>())
            }
        }
    }
}
