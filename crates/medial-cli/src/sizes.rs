//! What `medial compress` tells: the bytes of each feature, and of all.

use crate::args::Rows;
use medial::geom::Point;
use medial::ops::Compressed;
use medial::raster::Mask;
use medial_io::maxis::{Record, Sizes, sizes};
use medial_io::{Json, image};
use serde::Serialize;
use serde_json::Value;

/// The sizes of one feature, or of all.
#[derive(Serialize)]
pub struct Row {
    /// The feature; none for the row of all.
    feature: Option<usize>,
    id: Option<Json>,
    /// `disks`, `corners`, `simplified`, or the method of a mask; of all how many features have disks.
    stored: Value,
    /// The largest error, in units of the input.
    error: f64,
    corners: usize,
    disks: usize,
    maxis: usize,
    wkb: usize,
    deflated_wkb: usize,
    ratio: f64,
    deflated_ratio: f64,
    /// Of images: bytes as PNG, and the share of the cells that is not rebuilt.
    png: Option<usize>,
    xor: Option<f64>,
}

const COLUMNS: [&str; 13] = [
    "feature",
    "id",
    "stored",
    "error",
    "corners",
    "disks",
    "maxis",
    "wkb",
    "deflated_wkb",
    "ratio",
    "deflated_ratio",
    "png",
    "xor",
];

impl Row {
    /// The row of a feature with these polygons, or this mask.
    pub fn of(
        record: &Record,
        polygons: &[Vec<Vec<Point>>],
        mask: Option<&Mask>,
        sizes: Sizes,
    ) -> Self {
        let (stored, disks) = match &record.shape {
            Compressed::Disks(graph) => ("disks", graph.disks().len()),
            Compressed::Corners(corners) if corners.error > 0.0 => ("simplified", 0),
            Compressed::Corners(_) => ("corners", 0),
            Compressed::Mask(code) => (code.method().name(), code.balls().len()),
        };
        let closing = |ring: &[Point]| usize::from(ring.len() > 1 && ring.first() == ring.last());
        Self {
            feature: Some(record.feature),
            id: record.id.clone(),
            stored: stored.into(),
            error: record.shape.error(),
            corners: polygons.iter().flatten().map(|ring| ring.len() - closing(ring)).sum(),
            disks,
            png: mask.map(|mask| image::write_png(mask).len()),
            xor: match (&record.shape, mask) {
                (Compressed::Mask(code), Some(mask)) => {
                    Some(code.missing as f64 / mask.count() as f64)
                }
                _ => None,
            },
            ..Self::empty(sizes)
        }
    }

    fn empty(sizes: Sizes) -> Self {
        Self {
            feature: None,
            id: None,
            stored: Value::Null,
            error: 0.0,
            corners: 0,
            disks: 0,
            maxis: sizes.maxis,
            wkb: sizes.wkb,
            deflated_wkb: sizes.deflated_wkb,
            ratio: sizes.ratio(),
            deflated_ratio: sizes.deflated_ratio(),
            png: None,
            xor: None,
        }
    }

    /// The row in a form.
    pub fn written(&self, form: Rows) -> Vec<u8> {
        match form {
            Rows::Json => {
                let mut line = serde_json::to_string(self).unwrap_or_default();
                line.push('\n');
                line.into_bytes()
            }
            Rows::Csv => record(&self.cells()),
            Rows::Text => self.text().into_bytes(),
        }
    }

    /// What the columns hold.
    fn cells(&self) -> [String; COLUMNS.len()] {
        [
            self.feature.map_or_else(String::new, |feature| feature.to_string()),
            self.id.as_ref().map_or_else(String::new, |id| id.get().to_owned()),
            self.stored.as_str().map_or_else(|| self.stored.to_string(), str::to_owned),
            self.error.to_string(),
            self.corners.to_string(),
            self.disks.to_string(),
            self.maxis.to_string(),
            self.wkb.to_string(),
            self.deflated_wkb.to_string(),
            self.ratio.to_string(),
            self.deflated_ratio.to_string(),
            self.png.map_or_else(String::new, |png| png.to_string()),
            self.xor.map_or_else(String::new, |xor| xor.to_string()),
        ]
    }

    /// The row as a line for people.
    fn text(&self) -> String {
        let name = match self.feature {
            Some(feature) => format!("feature {feature}"),
            None => "all".to_owned(),
        };
        let what = match (self.feature, self.stored.as_str()) {
            (Some(_), Some("disks")) => {
                format!("{} disks for {} corners", self.disks, self.corners)
            }
            (Some(_), Some(method @ ("chain" | "cover"))) => {
                format!("a {method} of {} disks", self.disks)
            }
            (Some(_), Some("squares")) => format!("{} squares", self.disks),
            (Some(_), _) => format!("{} corners", self.corners),
            (None, _) => {
                format!("{} features as disks, {} corners in all", self.stored, self.corners)
            }
        };
        let image = match (self.png, self.xor) {
            (Some(png), Some(xor)) => {
                let times = png as f64 / self.maxis as f64;
                format!("; PNG {png} ({times:.2} times), {:.3}% of the cells missing", 100.0 * xor)
            }
            _ => String::new(),
        };
        format!(
            "{name}: {what}, {} bytes; WKB {} ({:.2} times), deflated {} ({:.2} times); error {:e}{image}\n",
            self.maxis, self.wkb, self.ratio, self.deflated_wkb, self.deflated_ratio, self.error,
        )
    }
}

/// The names of the columns.
pub fn csv_header() -> Vec<u8> {
    record(&COLUMNS.map(str::to_owned))
}

fn record(cells: &[String]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Writing to memory does not fail.
    let _ = writer.write_record(cells);
    writer.into_inner().unwrap_or_default()
}

/// All features so far.
#[derive(Default)]
pub struct Totals {
    records: Vec<Record>,
    wkb: Vec<u8>,
    with_disks: usize,
    error: f64,
    corners: usize,
    disks: usize,
    png: Option<usize>,
    xor: Option<f64>,
}

impl Totals {
    pub fn add(&mut self, record: Record, row: &Row, wkb: &[u8]) {
        self.with_disks += usize::from(row.disks > 0);
        self.error = self.error.max(row.error);
        self.corners += row.corners;
        self.disks += row.disks;
        // An image is one feature.
        (self.png, self.xor) = (row.png, row.xor);
        self.records.push(record);
        self.wkb.extend_from_slice(wkb);
    }

    pub fn records(&self) -> &[Record] {
        &self.records
    }

    /// The row of all in one file.
    pub fn row(&self, crs: Option<&Json>) -> Row {
        Row {
            stored: self.with_disks.into(),
            error: self.error,
            corners: self.corners,
            disks: self.disks,
            png: self.png,
            xor: self.xor,
            ..Row::empty(sizes(crs, &self.records, &self.wkb))
        }
    }
}
