use crate::FeatureError;
use medial::geom::Point;
use serde_json::value::RawValue;

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
    /// The coordinate reference system of the layer, as its format writes it.
    pub crs: Option<Json>,
    /// The number of features, where it is known beforehand.
    pub len: Option<usize>,
    pub(crate) parts: Box<dyn Iterator<Item = Part<'a>> + Send + 'a>,
}

/// A feature of an input, found but perhaps not read yet.
pub struct Part<'a>(State<'a>);

enum State<'a> {
    Read(Box<Result<Feature, FeatureError>>),
    Unread { text: &'a str, part: &'a str, index: usize, read: Reading },
}

/// Reads `part`, a slice of `text`, as the feature with a number.
type Reading = fn(text: &str, part: &str, index: usize) -> Result<Feature, FeatureError>;

impl Part<'_> {
    /// About as many bytes as the feature has as text.
    #[must_use]
    pub fn size(&self) -> usize {
        match &self.0 {
            State::Read(read) => read.as_ref().as_ref().map_or(0, Feature::size),
            State::Unread { part, .. } => part.len(),
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
        }
    }
}

impl<'a> Layer<'a> {
    /// A layer of features that are read where they are found.
    pub(crate) fn new(
        features: impl Iterator<Item = Result<Feature, FeatureError>> + Send + 'a,
    ) -> Self {
        let parts = features.map(|read| Part(State::Read(Box::new(read))));
        Self { crs: None, len: None, parts: Box::new(parts) }
    }

    /// A layer of the features in these slices of `text`, in their order.
    pub(crate) fn of_slices(
        text: &'a str,
        slices: impl Iterator<Item = &'a str> + Send + 'a,
        read: Reading,
    ) -> Self {
        let part = move |(index, part)| Part(State::Unread { text, part, index, read });
        Self { crs: None, len: None, parts: Box::new(slices.enumerate().map(part)) }
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
