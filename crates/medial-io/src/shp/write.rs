use super::rings::area;
use super::{HEADER, kind};
use crate::table::{Cell, Column, Geometry, Kind, Place, Rows, Table, WriteError, Written, unique};
use medial::geom::Point;
use std::fs::File;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Bytes of the name of a column.
const NAME: usize = 10;

/// Bytes of a text.
const TEXT: usize = 254;

/// Bytes of a number with a fraction: the longest text of a double that reads back to it.
const REAL: usize = 24;

/// Most columns, as other writers have it.
const COLUMNS: usize = 255;

/// Writes a shapefile: the shapes to the path, and `.shx`, `.dbf`, `.cpg` and `.prj` beside it, with these
/// extensions behind its whole name.
///
/// Outer rings run clockwise and holes counterclockwise, as the format has it. Numbers are written so that
/// they read back exactly. Points among lines become lines of no length.
///
/// # Errors
/// If geometries are of several kinds, if there is more than the format holds, or if the system fails.
pub fn write(path: &Path, table: &Table<'_>, rows: Rows<'_>) -> Result<Written, WriteError> {
    let mut written = Written::default();
    let schema = table.schema;
    let (in_space, _) = schema.in_space();
    let kind = kind_of(table)?;
    let is_lines = kind == kind::POLYLINE;
    let kind = kind + if in_space { kind::IN_SPACE } else { 0 };
    let columns = schema.columns();
    if columns.len() > COLUMNS {
        let why = format!(
            "a shapefile has at most {COLUMNS} columns, and these are {}; use gpkg",
            columns.len()
        );
        return Err(WriteError::unfit(why));
    }
    if u32::try_from(schema.n_rows).is_err() {
        return Err(WriteError::unfit("these are more rows than a shapefile holds; use gpkg"));
    }
    let beside = |extension: &str| named(path, extension);
    let mut shapes = BufWriter::new(File::create(path)?);
    let mut places = BufWriter::new(File::create(beside("shx"))?);
    let mut values = BufWriter::new(File::create(beside("dbf"))?);
    let names = names(columns, &mut written);
    let fields: Vec<Field> =
        columns.iter().zip(names).map(|(c, name)| Field::new(c, name)).collect();
    shapes.write_all(&[0; HEADER])?;
    places.write_all(&[0; HEADER])?;
    begin(&mut values, &fields, schema.n_rows)?;
    let mut heights = [f64::INFINITY, f64::NEG_INFINITY];
    let mut words = (HEADER / 2) as u64;
    let mut content = Vec::new();
    let mut cut = vec![0_usize; columns.len()];
    let mut n_stretched = 0_usize;
    for (row, number) in rows.zip(1_u32..) {
        let row = row?;
        content.clear();
        let mut geometry = row.wkb.as_deref().and_then(Geometry::of_wkb);
        if let Some(Geometry::Point(place)) = geometry
            && is_lines
        {
            geometry = Some(Geometry::LineString(vec![place; 2]));
            n_stretched += 1;
        }
        match geometry {
            Some(geometry) => {
                shape(&mut content, kind, in_space, &geometry, row.bounds, &mut heights);
            }
            None => content.extend(kind::NULL.to_le_bytes()),
        }
        let too_large = || {
            WriteError::unfit("the shapes are more than the 4 GiB that a shapefile holds; use gpkg")
        };
        let here = i32::try_from(words).map_err(|_| too_large())?;
        let size = i32::try_from(content.len() / 2).map_err(|_| too_large())?;
        places.write_all(&here.to_be_bytes())?;
        places.write_all(&size.to_be_bytes())?;
        shapes.write_all(&number.to_be_bytes())?;
        shapes.write_all(&size.to_be_bytes())?;
        shapes.write_all(&content)?;
        words += 4 + content.len() as u64 / 2;
        content.clear();
        content.push(b' ');
        for ((cell, field), cut) in row.cells.iter().zip(&fields).zip(&mut cut) {
            *cut += usize::from(field.put(&mut content, cell));
        }
        values.write_all(&content)?;
    }
    values.write_all(&[0x1a])?;
    let extent = schema.extent().unwrap_or_default();
    let heights = if heights[0] <= heights[1] { heights } else { [0.0; 2] };
    let n = schema.n_rows as u64;
    finish(shapes, kind, words, extent, heights)?;
    finish(places, kind, (HEADER / 2) as u64 + 4 * n, extent, heights)?;
    values.flush()?;
    std::fs::write(beside("cpg"), "UTF-8")?;
    let wkt = table.crs.and_then(|crs| crs.first_wkt());
    if let Some(wkt) = &wkt {
        std::fs::write(beside("prj"), wkt.as_bytes())?;
    } else if let Some(crs) = table.crs {
        written.warnings.push(format!(
            "no .prj is written, as the well-known text (version 1) of the reference system {crs} is not \
             known"
        ));
    }
    if n_stretched > 0 {
        written.warnings.push(format!(
            "points among lines are written as lines of no length: a shapefile holds one kind of geometry, \
             and {n_stretched} of {} are points",
            schema.n_rows
        ));
    }
    for (column, cut) in columns.iter().zip(cut).filter(|(_, cut)| *cut > 0) {
        let name = &column.name;
        written.warnings.push(format!(
            "{cut} texts of the column `{name}` are cut to the {TEXT} bytes that a shapefile holds"
        ));
    }
    written.beside = self::beside(path);
    written.beside.retain(|&(_, extension)| extension != "prj" || wkt.is_some());
    Ok(written)
}

/// The files beside the shapes, with their extensions.
pub(crate) fn beside(path: &Path) -> Vec<(PathBuf, &'static str)> {
    ["shx", "dbf", "cpg", "prj"].map(|extension| (named(path, extension), extension)).into()
}

fn named(path: &Path, extension: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".");
    name.push(extension);
    name.into()
}

/// The type of all shapes.
fn kind_of(table: &Table<'_>) -> Result<i32, WriteError> {
    let of = |number: u32| match number {
        1 => kind::POINT,
        4 => kind::MULTIPOINT,
        2 | 5 => kind::POLYLINE,
        _ => kind::POLYGON,
    };
    let mut kinds: Vec<i32> = table.schema.geometries.iter().map(|kind| of(kind.number)).collect();
    kinds.sort_unstable();
    kinds.dedup();
    match kinds[..] {
        [only] => Ok(only),
        // Nothing at all is most likely to have been lines.
        [] | [kind::POINT, kind::POLYLINE] => Ok(kind::POLYLINE),
        _ => {
            let mut names: Vec<&str> =
                table.schema.geometries.iter().map(|kind| kind.name()).collect();
            names.dedup();
            Err(WriteError::unfit(format!(
                "a shapefile holds one kind of geometry, and these are {}; use gpkg",
                names.join(" and ")
            )))
        }
    }
}

/// Names of at most ten bytes that differ.
fn names(columns: &[Column], written: &mut Written) -> Vec<String> {
    let given = columns.iter().map(|column| column.name.as_str());
    let names = unique(given, &[], |name, number| {
        let name = if name.is_empty() { "column" } else { name };
        let mut end = name.len().min(NAME - number.len());
        while !name.is_char_boundary(end) {
            end -= 1;
        }
        format!("{}{number}", name[..end].replace('\0', " "))
    });
    let renamed: Vec<String> = columns
        .iter()
        .zip(&names)
        .filter(|(column, name)| column.name != **name)
        .map(|(column, name)| format!("`{}` as `{name}`", column.name))
        .collect();
    if !renamed.is_empty() {
        let list = renamed.join(", ");
        written.warnings.push(format!("columns of a shapefile have names of 10 bytes: {list}"));
    }
    names
}

/// A column of the table of values.
struct Field {
    name: String,
    kind: Kind,
    width: usize,
}

impl Field {
    fn new(column: &Column, name: String) -> Self {
        let width = match column.kind {
            Kind::Boolean => 1,
            Kind::Real => REAL,
            Kind::Integer | Kind::Text => column.width.clamp(1, TEXT),
        };
        Self { name, kind: column.kind, width }
    }

    /// Appends a value; true if it does not fit and is cut.
    fn put(&self, out: &mut Vec<u8>, cell: &Cell) -> bool {
        let end = out.len() + self.width;
        let mut is_cut = false;
        match cell {
            Cell::Null if self.kind == Kind::Boolean => out.push(b'?'),
            Cell::Null => {}
            Cell::Boolean(value) => out.push(if *value { b'T' } else { b'F' }),
            Cell::Text(text) => {
                let mut size = text.len().min(self.width);
                while !text.is_char_boundary(size) {
                    size -= 1;
                }
                is_cut = size < text.len();
                out.extend(&text.as_bytes()[..size]);
            }
            Cell::Integer(_) | Cell::Real(_) => {
                let text = match cell {
                    Cell::Integer(value) => value.to_string(),
                    Cell::Real(value) => crate::number::shortest(*value),
                    _ => String::new(),
                };
                // Numbers stand to the right.
                out.resize(end.saturating_sub(text.len()), b' ');
                out.extend(text.as_bytes());
            }
        }
        out.resize(end, b' ');
        is_cut
    }
}

/// Writes the header of the table of values.
fn begin(values: &mut impl Write, fields: &[Field], n_rows: usize) -> Result<(), WriteError> {
    let row = 1 + fields.iter().map(|field| field.width).sum::<usize>();
    let row = u16::try_from(row)
        .map_err(|_| WriteError::unfit("the rows are longer than a shapefile holds; use gpkg"))?;
    let mut head = [0; 32];
    // The date of the last change is not known to be of use to anybody; a constant makes files that are equal.
    head[..4].copy_from_slice(&[3, 126, 1, 1]);
    head[4..8].copy_from_slice(&(n_rows as u32).to_le_bytes());
    head[8..10].copy_from_slice(&(33 + 32 * fields.len() as u16).to_le_bytes());
    head[10..12].copy_from_slice(&row.to_le_bytes());
    values.write_all(&head)?;
    for field in fields {
        let mut described = [0; 32];
        described[..field.name.len()].copy_from_slice(field.name.as_bytes());
        let (kind, decimals) = match field.kind {
            Kind::Boolean => (b'L', 0),
            Kind::Integer => (b'N', 0),
            Kind::Real => (b'N', 15),
            Kind::Text => (b'C', 0),
        };
        described[11] = kind;
        described[16] = field.width as u8;
        described[17] = decimals;
        values.write_all(&described)?;
    }
    values.write_all(b"\r")?;
    Ok(())
}

/// Appends the content of a record.
fn shape(
    out: &mut Vec<u8>,
    kind: i32,
    in_space: bool,
    geometry: &Geometry,
    bounds: [f64; 4],
    heights: &mut [f64; 2],
) {
    /// Less than -1e38 means nothing.
    const NO_MEASURE: f64 = -1e39;
    out.extend(kind.to_le_bytes());
    let number = |out: &mut Vec<u8>, value: f64| out.extend(value.to_le_bytes());
    let mut own = [f64::INFINITY, f64::NEG_INFINITY];
    geometry.each(&mut |place| {
        let z = place.z.unwrap_or(0.0);
        own = [own[0].min(z), own[1].max(z)];
    });
    if in_space {
        *heights = [heights[0].min(own[0]), heights[1].max(own[1])];
    }
    if let Geometry::Point(place) = geometry {
        number(out, place.x);
        number(out, place.y);
        if in_space {
            number(out, place.z.unwrap_or(0.0));
            number(out, NO_MEASURE);
        }
        return;
    }
    bounds.iter().for_each(|&value| number(out, value));
    let parts = parts(geometry);
    let count = |out: &mut Vec<u8>, n: usize| out.extend((n as u32).to_le_bytes());
    if !matches!(geometry, Geometry::MultiPoint(_)) {
        count(out, parts.len());
    }
    count(out, parts.iter().map(Vec::len).sum());
    if !matches!(geometry, Geometry::MultiPoint(_)) {
        let mut start = 0;
        for part in &parts {
            count(out, start);
            start += part.len();
        }
    }
    for place in parts.iter().flatten() {
        number(out, place.x);
        number(out, place.y);
    }
    if in_space {
        own.iter().for_each(|&value| number(out, value));
        parts.iter().flatten().for_each(|place| number(out, place.z.unwrap_or(0.0)));
    }
}

/// Lines, or rings in the direction that the format has for them.
fn parts(geometry: &Geometry) -> Vec<Vec<Place>> {
    match geometry {
        Geometry::Point(place) => vec![vec![*place]],
        Geometry::MultiPoint(places) | Geometry::LineString(places) => vec![places.clone()],
        Geometry::MultiLineString(lines) => lines.clone(),
        Geometry::Polygon(rings) => directed(rings),
        Geometry::MultiPolygon(polygons) => {
            polygons.iter().flat_map(|rings| directed(rings)).collect()
        }
    }
}

fn directed(rings: &[Vec<Place>]) -> Vec<Vec<Place>> {
    let directed = |(k, ring): (usize, &Vec<Place>)| {
        let points: Vec<Point> = ring.iter().map(|place| Point::new(place.x, place.y)).collect();
        let is_hole = k > 0;
        let mut ring = ring.clone();
        if (area(&points) > 0.0) != is_hole {
            ring.reverse();
        }
        ring
    };
    rings.iter().enumerate().map(directed).collect()
}

/// Puts the header in front of a file of shapes or places, and what was gathered into it.
fn finish(
    mut file: BufWriter<File>,
    kind: i32,
    words: u64,
    extent: [f64; 4],
    heights: [f64; 2],
) -> io::Result<()> {
    let mut header = Vec::with_capacity(HEADER);
    header.extend([0, 0, 0x27, 0x0a]);
    header.resize(24, 0);
    header.extend((words as u32).to_be_bytes());
    header.extend(1000_i32.to_le_bytes());
    header.extend(kind.to_le_bytes());
    extent.into_iter().chain(heights).for_each(|value| header.extend(value.to_le_bytes()));
    header.resize(HEADER, 0);
    file.seek(SeekFrom::Start(0))?;
    file.write_all(&header)?;
    file.flush()
}
