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
pub struct Layer<'a> {
    /// The coordinate reference system of the layer, as its format writes it.
    pub crs: Option<Json>,
    /// The number of features, where it is known beforehand.
    pub len: Option<usize>,
    pub(crate) features: Box<dyn Iterator<Item = Result<Feature, FeatureError>> + Send + 'a>,
}

impl<'a> Layer<'a> {
    pub(crate) fn new(
        features: impl Iterator<Item = Result<Feature, FeatureError>> + Send + 'a,
    ) -> Self {
        Self { crs: None, len: None, features: Box::new(features) }
    }
}

impl Iterator for Layer<'_> {
    type Item = Result<Feature, FeatureError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.features.next()
    }
}

impl Feature {
    pub(crate) fn numbered(index: usize) -> Self {
        Self { index, ..Self::default() }
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
