use super::{Cell, Spool, line};
use std::io;

/// Rows of several layers of one file, told apart by a property.
///
/// ```
/// use medial_io::table::{Layers, Spool};
///
/// let mut layers = Layers::new("layer");
/// for name in ["border", "axis"] {
///     layers.spools.push((name.to_owned(), Spool::new(tempfile::tempfile()?)));
/// }
/// layers.add(b"{\"type\":\"Feature\",\"properties\":{\"layer\":\"axis\"},\"geometry\":null}\n")?;
/// let n_rows = layers.spools.iter().map(|(_, spool)| spool.schema().n_rows);
/// assert_eq!(n_rows.collect::<Vec<_>>(), [0, 1]);
/// # Ok::<(), std::io::Error>(())
/// ```
pub struct Layers {
    property: String,
    /// The name of each layer, and its rows.
    pub spools: Vec<(String, Spool)>,
}

impl Layers {
    /// No layers, which are named by this property of features.
    #[must_use]
    pub fn new(property: &str) -> Self {
        Self { property: property.to_owned(), spools: Vec::new() }
    }

    /// Adds features, each on a line of GeoJSON, to their layers.
    ///
    /// # Errors
    /// If the system fails, a line is no feature, or there is no layer of that name.
    pub fn add(&mut self, lines: &[u8]) -> io::Result<()> {
        line::split(lines).try_for_each(|line| {
            let (cells, geometry) = line::read(line)?;
            let named = cells.iter().find(|(name, _)| *name == self.property);
            let spool = self
                .spools
                .iter_mut()
                .find(|(layer, _)| matches!(named, Some((_, Cell::Text(name))) if name == layer));
            match spool {
                Some((_, spool)) => spool.push(&cells, geometry.as_ref()),
                None => Err(io::Error::other("a feature is of no layer")),
            }
        })
    }
}
