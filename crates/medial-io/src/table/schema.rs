use super::GeometryKind;
use super::geometry::{EMPTY, joined};
use std::collections::{BTreeSet, HashMap};

/// A value of a row.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Cell {
    Null,
    Boolean(bool),
    Integer(i64),
    Real(f64),
    Text(String),
}

/// What the values of a column are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Kind {
    Boolean,
    Integer,
    Real,
    Text,
}

/// A column of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its name, which no other column has.
    pub name: String,
    /// What its values are; text if it has none.
    pub kind: Kind,
    /// Bytes of its longest value as text.
    pub width: usize,
}

/// A row: a value for each column, and the geometry.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// In the order of the columns, of their kinds or null.
    pub cells: Vec<Cell>,
    /// Well-known binary of the geometry, if there is one.
    pub wkb: Option<Vec<u8>>,
    /// Its box: least x and y, greatest x and y.
    pub bounds: [f64; 4],
}

/// What is known of a table once its rows have been seen.
#[derive(Clone, Debug)]
pub struct Schema {
    columns: Vec<Column>,
    /// Whether a value was seen.
    seen: Vec<bool>,
    numbers: HashMap<String, u32>,
    /// The kinds of its geometries.
    pub geometries: BTreeSet<GeometryKind>,
    /// The box of all geometries.
    pub bounds: [f64; 4],
    /// How many rows there are.
    pub n_rows: usize,
}

impl Default for Schema {
    fn default() -> Self {
        Self {
            columns: Vec::new(),
            seen: Vec::new(),
            numbers: HashMap::new(),
            geometries: BTreeSet::new(),
            bounds: EMPTY,
            n_rows: 0,
        }
    }
}

impl Schema {
    /// The columns, in the order in which they were met.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The number of the column with a name, a new one if there is none.
    pub(super) fn number(&mut self, name: &str) -> u32 {
        if let Some(&number) = self.numbers.get(name) {
            return number;
        }
        let number = self.columns.len() as u32;
        self.numbers.insert(name.to_owned(), number);
        self.columns.push(Column { name: name.to_owned(), kind: Kind::Text, width: 0 });
        self.seen.push(false);
        number
    }

    /// Takes note of a value.
    pub(super) fn note(&mut self, number: u32, cell: &Cell) {
        let Some(kind) = cell.kind() else { return };
        let column = &mut self.columns[number as usize];
        column.width = column.width.max(cell.width());
        let is_first = !std::mem::replace(&mut self.seen[number as usize], true);
        column.kind = match (column.kind, kind) {
            _ if is_first => kind,
            (a, b) if a == b => a,
            (Kind::Integer, Kind::Real) | (Kind::Real, Kind::Integer) => Kind::Real,
            _ => Kind::Text,
        };
    }

    /// Takes note of a geometry.
    pub(super) fn note_geometry(&mut self, kind: GeometryKind, bounds: [f64; 4]) {
        self.geometries.insert(kind);
        self.bounds = joined(self.bounds, bounds);
    }

    /// The box of all geometries, if there is one.
    #[must_use]
    pub fn extent(&self) -> Option<[f64; 4]> {
        (self.bounds[0] <= self.bounds[2]).then_some(self.bounds)
    }

    /// Whether some geometries have a third coordinate, and whether all have one.
    #[must_use]
    pub fn in_space(&self) -> (bool, bool) {
        let mut all = self.geometries.iter().map(|kind| kind.in_space);
        (all.clone().any(|is| is), all.all(|is| is))
    }
}

impl Cell {
    /// What it is, if it is something.
    fn kind(&self) -> Option<Kind> {
        match self {
            Self::Null => None,
            Self::Boolean(_) => Some(Kind::Boolean),
            Self::Integer(_) => Some(Kind::Integer),
            Self::Real(_) => Some(Kind::Real),
            Self::Text(_) => Some(Kind::Text),
        }
    }

    /// Bytes that it takes as text.
    fn width(&self) -> usize {
        match self {
            Self::Text(text) => text.len(),
            Self::Integer(value) => itoa::Buffer::new().format(*value).len(),
            // The longest double.
            Self::Real(_) => 24,
            Self::Boolean(_) => 5,
            Self::Null => 0,
        }
    }

    /// The value as one of another kind, as the column has it.
    pub(super) fn cast(self, kind: Kind) -> Self {
        match (self, kind) {
            (Self::Integer(value), Kind::Real) => Self::Real(value as f64),
            (Self::Integer(value), Kind::Text) => Self::Text(value.to_string()),
            (Self::Real(value), Kind::Text) => Self::Text(format!("{value:?}")),
            (Self::Boolean(value), Kind::Text) => Self::Text(value.to_string()),
            (value, _) => value,
        }
    }
}
