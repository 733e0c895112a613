//! What a file says of its geometries [GeoParquet 1.1].

use crate::{Crs, Json};
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

impl Column {
    /// The reference system.
    pub fn crs(self) -> Option<Crs> {
        match self.crs {
            None => Some(Crs::of_authority("OGC", "CRS84")),
            Some(crs) if crs.get() == "null" => None,
            // Versions before 1.0 had well-known text, and some writers have names.
            Some(crs) => match serde_json::from_str::<String>(crs.get()) {
                Ok(text) => match text.split_once(':') {
                    Some((authority, code)) if !text.contains('[') => {
                        Some(Crs::of_authority(authority, code))
                    }
                    _ => Some(Crs::of_wkt(&text)),
                },
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
