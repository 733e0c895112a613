use crate::{Error, Format, Layer, Part, ReadOptions, fgb, gpkg, parquet, shp};
use std::path::Path;

/// Reads the features of a file in a format that [is a table](Format::is_table).
///
/// Not more of them are held than are asked for, and a few that are read ahead. A file that turns out to be
/// damaged on the way gives [`Error::Interrupted`] as its last item.
///
/// ```no_run
/// use medial_io::{Format, ReadOptions, open};
///
/// let layer = open(Format::Gpkg, "lakes.gpkg".as_ref(), &ReadOptions::default())?;
/// for feature in layer {
///     println!("{}", feature?.polygons.len());
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the file cannot be opened, is not of that format, or has not just one layer and
/// [none is chosen](ReadOptions::layer).
pub fn open<'a>(format: Format, path: &Path, options: &ReadOptions) -> Result<Layer<'a>, Error> {
    match format {
        Format::Gpkg => gpkg::open(path, options.layer.as_deref()),
        Format::Shp => shp::open(path),
        Format::Fgb => fgb::open(path),
        Format::Parquet => parquet::open(path),
        other => Err(Error::Unreadable { format: other }),
    }
    .and_then(|layer| {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        match &options.layer {
            Some(name) if format != Format::Gpkg && *name != stem => {
                let why = format!(
                    "there is no layer `{name}`; a file of the format {format} has one layer, `{stem}`"
                );
                Err(Error::Layer { why })
            }
            #[expect(clippy::map_identity, reason = "the items are given a shorter lifetime")]
            _ => Ok(Layer {
                units: None,
                crs: layer.crs,
                warnings: layer.warnings,
                len: layer.len,
                parts: Box::new(layer.parts.map(|part| -> Part<'a> { part })),
            }),
        }
    })
}
