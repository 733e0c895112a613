use crate::{Crs, Error, FeatureError};
use medial::domain::{Curves, FillRule};
use medial::geom::Point;
use medial::raster::Mask;
use serde_json::value::RawValue;
use std::sync::Arc;

/// A piece of JSON exactly as it was written, so that large numbers and the order of members
/// survive.
pub type Json = Box<RawValue>;

/// The polygons of a feature: each an outer ring and its holes, points as given.
pub type Polygons = Vec<Vec<Vec<Point>>>;

/// One feature of the input.
#[derive(Clone, Debug, Default)]
pub struct Feature {
    /// Number in the input, from 0.
    pub index: usize,
    /// Its identifier, if it has one.
    pub id: Option<Json>,
    /// Its properties, in their order.
    pub properties: Vec<(String, Json)>,
    /// Its polygons; none if it is no polygon, or an empty one.
    pub polygons: Polygons,
    /// What its geometry is, in words: `a LineString`, `an empty polygon`.
    pub geometry: String,
    /// Whether the geometry is polygonal, be it an empty one.
    pub polygonal: bool,
    /// Its points, if its geometry is a point or several, in formats in which [points](crate::points) may stand for a
    /// border.
    pub points: Option<Vec<Point>>,
    /// Which points its rings enclose.
    pub fill: FillRule,
    /// The curves that its edges were flattened from, if there were any.
    pub curves: Option<Curves>,
    /// The mask whose outline the polygons are, if it was an image.
    pub mask: Option<Arc<Mask>>,
    /// What was left out or reinterpreted on the way.
    pub notes: Vec<Note>,
}

/// A remark on what reading changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// A word from a closed list, in snake case: `part_not_polygon`, `line_as_ring`.
    pub code: &'static str,
    /// The remark for people.
    pub text: String,
}

/// The features of an input, read one by one.
///
/// [`Layer::parts`] gives them unread, for several threads to read.
pub struct Layer<'a> {
    /// The coordinate reference system of the layer, if it has one.
    pub crs: Option<Crs>,
    /// The unit of its coordinates, where its format names one: `mm`, `in`.
    pub units: Option<&'static str>,
    /// The number of features, where it is known beforehand.
    pub len: Option<usize>,
    /// What was passed over in the whole of the input, for people.
    pub warnings: Vec<String>,
    pub(crate) parts: Box<dyn Iterator<Item = Part<'a>> + Send + 'a>,
}

/// A feature of an input, found but perhaps not read yet.
pub struct Part<'a>(State<'a>);

enum State<'a> {
    Read(Box<Result<Feature, FeatureError>>),
    Unread {
        text: &'a str,
        part: &'a str,
        index: usize,
        read: Reading,
    },
    /// A text of its own, behind so many lines of the input.
    Alone {
        text: String,
        before: usize,
        index: usize,
        read: fn(&str, usize) -> Result<Feature, FeatureError>,
    },
    /// A row of a table, of about so many bytes.
    Row {
        size: usize,
        read: Box<dyn FnOnce() -> Result<Feature, FeatureError> + Send>,
    },
}

/// Reads `part`, a slice of `text`, as the feature with a number.
type Reading = fn(text: &str, part: &str, index: usize) -> Result<Feature, FeatureError>;

impl Part<'_> {
    /// A feature that is read already.
    pub(crate) fn of_read(read: Result<Feature, FeatureError>) -> Self {
        Self(State::Read(Box::new(read)))
    }

    /// The feature with a number that cannot be read.
    pub(crate) fn broken(index: usize, error: Error) -> Self {
        Self::of_read(Err(FeatureError { feature: index, id: None, error }))
    }

    /// The feature in a text that is behind so many lines of the input.
    pub(crate) fn of_text(
        text: String,
        before: usize,
        index: usize,
        read: fn(&str, usize) -> Result<Feature, FeatureError>,
    ) -> Self {
        Self(State::Alone { text, before, index, read })
    }

    /// The feature in a row of a table that takes about so many bytes.
    pub(crate) fn of_row(
        size: usize,
        read: impl FnOnce() -> Result<Feature, FeatureError> + Send + 'static,
    ) -> Self {
        Self(State::Row { size, read: Box::new(read) })
    }

    /// About as many bytes as the feature has as text.
    #[must_use]
    pub fn size(&self) -> usize {
        match &self.0 {
            State::Read(read) => read.as_ref().as_ref().map_or(0, Feature::size),
            State::Unread { part, .. } => part.len(),
            State::Alone { text, .. } => text.len(),
            State::Row { size, .. } => *size,
        }
    }

    /// Reads the feature.
    ///
    /// # Errors
    /// If it is malformed.
    pub fn read(self) -> Result<Feature, FeatureError> {
        match self.0 {
            State::Read(read) => *read,
            State::Unread { text, part, index, read } => read(text, part, index),
            State::Alone { text, before, index, read } => {
                read(&text, index).map_err(|mut error| {
                    error.error = error.error.after(before);
                    error
                })
            }
            State::Row { read, .. } => read(),
        }
    }
}

impl From<Result<Feature, FeatureError>> for Part<'_> {
    fn from(read: Result<Feature, FeatureError>) -> Self {
        Self::of_read(read)
    }
}

impl<'a> Layer<'a> {
    /// A layer of features that are read where they are found.
    pub(crate) fn new(
        features: impl Iterator<Item = Result<Feature, FeatureError>> + Send + 'a,
    ) -> Self {
        Self::of_parts(features.map(Part::of_read))
    }

    /// A layer of so many features that are made where they are found.
    #[must_use]
    pub fn of_features(
        crs: Option<Crs>,
        features: impl ExactSizeIterator<Item = Feature> + Send + 'a,
    ) -> Self {
        let len = Some(features.len());
        Self { crs, len, ..Self::new(features.map(Ok)) }
    }

    /// A layer of the features in these slices of `text`, in their order.
    pub(crate) fn of_slices(
        text: &'a str,
        slices: impl Iterator<Item = &'a str> + Send + 'a,
        read: Reading,
    ) -> Self {
        let part = move |(index, part)| Part(State::Unread { text, part, index, read });
        Self::of_parts(slices.enumerate().map(part))
    }

    /// A layer of which nothing is known but its parts.
    pub(crate) fn of_parts(parts: impl Iterator<Item = Part<'a>> + Send + 'a) -> Self {
        Self { crs: None, units: None, len: None, warnings: Vec::new(), parts: Box::new(parts) }
    }

    /// The features unread, as far as their format lets them be found before they are read.
    pub fn parts(self) -> impl Iterator<Item = Part<'a>> + Send + 'a {
        self.parts
    }
}

impl Iterator for Layer<'_> {
    type Item = Result<Feature, FeatureError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.parts.next().map(Part::read)
    }
}

impl Feature {
    pub(crate) fn numbered(index: usize) -> Self {
        Self { index, ..Self::default() }
    }

    /// About as many bytes as it has as text.
    fn size(&self) -> usize {
        /// Two numbers of ten characters.
        const POINT: usize = 20;
        POINT * self.polygons.iter().flatten().map(Vec::len).sum::<usize>()
    }

    /// Adds one polygon; an empty one keeps its number.
    pub(crate) fn add_polygon(&mut self, rings: Vec<Vec<Point>>) {
        self.polygonal = true;
        self.polygons.push(rings);
    }

    /// Notes that a part of a collection is left out.
    pub(crate) fn leave_out(&mut self, kind: &str) {
        self.notes.push(Note {
            code: "part_not_polygon",
            text: format!("a {kind} in the collection is no polygon and is left out"),
        });
    }
}
