//! A line of GeoJSON as values and a geometry.

use super::{Cell, Geometry, Place};
use crate::json::Members;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::value::RawValue;
use std::borrow::Cow;

/// The line of a feature.
#[derive(Deserialize)]
struct Line<'a> {
    properties: Members,
    #[serde(borrow)]
    geometry: Option<Shape<'a>>,
}

#[derive(Deserialize)]
struct Shape<'a> {
    #[serde(borrow, rename = "type")]
    kind: Cow<'a, str>,
    #[serde(borrow)]
    coordinates: &'a RawValue,
}

/// The properties of a feature, and its geometry.
type Found = (Vec<(String, Cell)>, Option<Geometry>);

/// The lines of a text that have something on them.
pub(super) fn split(lines: &[u8]) -> impl Iterator<Item = &[u8]> {
    lines.split(|&byte| byte == b'\n').filter(|line| !line.is_empty())
}

/// The properties and the geometry in a line.
///
/// # Errors
/// If it is no feature, or its geometry is a collection.
pub(super) fn read(line: &[u8]) -> serde_json::Result<Found> {
    let line: Line = serde_json::from_slice(line)?;
    let cells = line.properties.0.into_iter().map(|(name, value)| (name, cell(&value)));
    let geometry = line.geometry.map(|shape| shape.read()).transpose()?;
    Ok((cells.collect(), geometry))
}

impl Shape<'_> {
    fn read(&self) -> serde_json::Result<Geometry> {
        fn of<T: DeserializeOwned>(text: &RawValue) -> serde_json::Result<T> {
            serde_json::from_str(text.get())
        }
        let at = self.coordinates;
        Ok(match self.kind.as_ref() {
            "Point" => Geometry::Point(of::<Place>(at)?),
            "LineString" => Geometry::LineString(of(at)?),
            "Polygon" => Geometry::Polygon(of(at)?),
            "MultiPoint" => Geometry::MultiPoint(of(at)?),
            "MultiLineString" => Geometry::MultiLineString(of(at)?),
            "MultiPolygon" => Geometry::MultiPolygon(of(at)?),
            other => {
                let why = format!("a {other} is no geometry of a table");
                return Err(serde::de::Error::custom(why));
            }
        })
    }
}

/// A value as a cell; lists and objects as the text that they are.
fn cell(value: &RawValue) -> Cell {
    let text = value.get();
    match text.as_bytes().first() {
        Some(b'n') => Cell::Null,
        Some(b't') => Cell::Boolean(true),
        Some(b'f') => Cell::Boolean(false),
        Some(b'"') => serde_json::from_str(text).map_or(Cell::Null, Cell::Text),
        Some(b'-' | b'0'..=b'9') => {
            // A zero with a sign is no whole number.
            match text.parse::<i64>() {
                Ok(whole) if text != "-0" => Cell::Integer(whole),
                _ => match text.parse::<f64>() {
                    Ok(value) if value.is_finite() => Cell::Real(value),
                    _ => Cell::Text(text.to_owned()),
                },
            }
        }
        _ => Cell::Text(text.to_owned()),
    }
}
