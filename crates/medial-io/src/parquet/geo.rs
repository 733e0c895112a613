//! What a file says of its geometries [GeoParquet 1.1].

use crate::{Crs, Json};
use parquet::file::metadata::KeyValue;
use serde::Deserialize;
use std::collections::HashMap;

/// The metadata under the key `geo`.
#[derive(Deserialize)]
pub(super) struct Geo {
    pub primary_column: String,
    pub columns: HashMap<String, Column>,
}

/// What is said of a column of geometries.
#[derive(Deserialize)]
pub(super) struct Column {
    pub encoding: String,
    /// Absent: longitudes and latitudes. Null: not known.
    #[serde(default, deserialize_with = "present")]
    crs: Option<Json>,
    #[serde(default)]
    covering: Option<Covering>,
}

#[derive(Deserialize)]
struct Covering {
    #[serde(default)]
    bbox: HashMap<String, Vec<String>>,
}

/// A value that is there, be it null.
fn present<'de, D: serde::Deserializer<'de>>(deserializer: D) -> Result<Option<Json>, D::Error> {
    Json::deserialize(deserializer).map(Some)
}

/// The reference system of a name or a well-known text.
fn of_words(text: &str) -> Crs {
    match text.split_once(':') {
        Some((authority, code)) if !text.contains('[') => Crs::of_authority(authority, code),
        _ => Crs::of_wkt(text),
    }
}

/// What the type of a column says of its reference system: `srid:` and a number, which is taken for one of
/// EPSG, `projjson:` and the key of the metadata that has it, a name such as `EPSG:2193`, well-known text or
/// PROJJSON; nothing stands for longitudes and latitudes.
pub(super) fn of_type(crs: Option<&str>, pairs: &[KeyValue]) -> Option<Crs> {
    let of_json = |text: &str| serde_json::from_str(text).ok().map(Crs::of_projjson);
    let Some(crs) = crs.map(str::trim).filter(|crs| !crs.is_empty()) else {
        return Some(Crs::of_authority("OGC", "CRS84"));
    };
    if crs.starts_with('{') {
        return of_json(crs);
    }
    match crs.split_once(':') {
        Some(("srid", "0")) => None,
        Some(("srid", code)) => Some(Crs::of_authority("EPSG", code)),
        Some(("projjson", key)) => {
            let found = pairs.iter().find(|pair| pair.key == key)?;
            of_json(found.value.as_deref()?)
        }
        _ => Some(of_words(crs)),
    }
}

impl Column {
    /// The reference system.
    pub fn crs(self) -> Option<Crs> {
        match self.crs {
            None => Some(Crs::of_authority("OGC", "CRS84")),
            Some(crs) if crs.get() == "null" => None,
            // Versions before 1.0 had well-known text, and some writers have names.
            Some(crs) => match serde_json::from_str::<String>(crs.get()) {
                Ok(text) => Some(of_words(&text)),
                Err(_) => Some(Crs::of_projjson(crs)),
            },
        }
    }

    /// The column of boxes, which are no values of features.
    pub fn boxes(&self) -> Option<&str> {
        let path = self.covering.as_ref()?.bbox.values().next()?;
        path.first().map(String::as_str)
    }
}
