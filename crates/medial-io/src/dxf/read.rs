//! Closed outlines of drawings as polygons.
//!
//! # Contract
//! Closed outlines of a layer that lie in one another are one polygon with holes, by their depth; lines that
//! end where others begin are one outline. A hatch is a feature of its own. What bounds no polygon is an item
//! of the layer too, with the reason. Only model space is read, seen from above. What nobody sees, on layers
//! that are off or frozen and entities that are invisible, is passed over, unless its layer is asked for.

use super::chain::{Chain, chains};
use super::entity::{Drawn, Entity, Fields};
use super::groups::{Group, groups};
use super::nest::{Nest, nests};
use crate::curves::{Affine, Contour, flatten};
use crate::json::{quoted, whole};
use crate::{Error, Feature, FeatureError, Json, Layer, Note, Part, ReadOptions};
use medial::domain::FillRule;
use medial::geom::Point;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Deepest nesting of blocks.
const DEPTH: usize = 32;

/// Most entities that are drawn, those of blocks each time.
const MOST: usize = 1_000_000;

/// Units of length by their number in the header.
pub(super) const UNITS: [(i64, &str); 24] = [
    (1, "in"),
    (2, "ft"),
    (3, "mi"),
    (4, "mm"),
    (5, "cm"),
    (6, "m"),
    (7, "km"),
    (8, "microinch"),
    (9, "mil"),
    (10, "yd"),
    (11, "angstrom"),
    (12, "nm"),
    (13, "um"),
    (14, "dm"),
    (15, "dam"),
    (16, "hm"),
    (17, "Gm"),
    (18, "au"),
    (19, "ly"),
    (20, "pc"),
    (21, "us-ft"),
    (22, "us-in"),
    (23, "us-yd"),
    (24, "us-mi"),
];

/// Reads the outlines of a drawing.
///
/// # Errors
/// If the bytes are no DXF. An entity that is wrong is an item of the layer.
pub fn read<'a>(bytes: &[u8], options: &ReadOptions) -> Result<Layer<'a>, Error> {
    if bytes.trim_ascii().is_empty() {
        return Err(Error::Empty);
    }
    let groups = groups(bytes)?;
    let file = File::new(&groups)?;
    let mut drawing = Drawing::default();
    let top = Place { to_plane: Affine::IDENTITY, layer: None, block: None, depth: 0 };
    let mut n_drawn = 0;
    let only = options.layer.as_deref();
    drawing.asked = only.map(ToOwned::to_owned);
    for entity in &file.entities {
        drawing.add(&file, *entity, &top, &mut n_drawn);
    }
    if let Some(only) = only {
        let layers = drawing.layers();
        if !layers.contains(only) {
            let names: Vec<String> = layers.iter().map(|name| format!("`{name}`")).collect();
            let names = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
            let why = format!("there is nothing on a layer `{only}`; of layers there are {names}");
            return Err(Error::Layer { why });
        }
    }
    let (n_unseen, unseen) = std::mem::take(&mut drawing.unseen);
    let items = drawing.items(file.units, only);
    let tolerance = options.tolerance;
    let len = Some(items.len());
    let features = (0..).zip(items).map(move |(index, item)| {
        // Curves are flattened where features are read.
        Part::of_row(item.size(), move || item.feature(index, tolerance))
    });
    let mut warnings = drawing_warnings(n_unseen, &unseen);
    warnings.extend(file.unknown_units.map(|number| {
        format!("its units are not known ($INSUNITS is {number}) and are left out; set them in the drawing")
    }));
    Ok(Layer { len, warnings, units: file.units, ..Layer::of_parts(features) })
}

/// What to say of entities that nobody sees, and of the layers they are on.
fn drawing_warnings(n: usize, layers: &BTreeSet<String>) -> Vec<String> {
    if n == 0 {
        return Vec::new();
    }
    let names: Vec<String> = layers.iter().map(|name| format!("`{name}`")).collect();
    vec![format!(
        "entities that are not seen, as they or their layers are off or frozen, are passed over: {n} on {}; \
         --layer reads one of them",
        names.join(", ")
    )]
}

/// Whether what is on a layer is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Seen {
    /// Not at all, nor is what blocks have on other layers.
    Frozen,
    /// Not itself.
    Off,
}

/// The parts of a file that are used.
struct File<'a> {
    units: Option<&'static str>,
    /// The number of units that are none.
    unknown_units: Option<i64>,
    /// Layers that are not seen, by their names in capitals.
    unseen: HashMap<String, Seen>,
    blocks: HashMap<String, Block<'a>>,
    entities: Vec<Entity<'a>>,
}

struct Block<'a> {
    base: Point,
    entities: Vec<Entity<'a>>,
}

impl<'a> File<'a> {
    fn new(groups: &'a [Group<'a>]) -> Result<Self, Error> {
        if !groups.iter().find(|g| g.code != 999).is_some_and(|g| g.is(0, "SECTION")) {
            let why = "the file does not begin with a section, as DXF does".to_owned();
            return Err(Error::Syntax { line: 1, column: 1, why });
        }
        let mut file = Self {
            units: None,
            unknown_units: None,
            unseen: HashMap::new(),
            blocks: HashMap::new(),
            entities: Vec::new(),
        };
        let mut has_entities = false;
        let mut rest = groups;
        while let Some(start) = rest.iter().position(|group| group.is(0, "SECTION")) {
            let section = &rest[start + 1..];
            let end = section.iter().position(|g| g.is(0, "ENDSEC"));
            let (section, after) = section.split_at(end.ok_or_else(|| cut_off(groups))?);
            rest = after;
            let Some((name, content)) = section.split_first() else { continue };
            match name.text().as_ref() {
                "HEADER" => file.header(content),
                "TABLES" => file.tables(content),
                "BLOCKS" => file.blocks(content),
                "ENTITIES" => {
                    file.entities = entities(content);
                    has_entities = true;
                }
                _ => {}
            }
        }
        // Files made by hand often end behind their last section.
        let has_end = groups.last().is_some_and(|group| group.is(0, "EOF"));
        if has_end || has_entities { Ok(file) } else { Err(cut_off(groups)) }
    }

    fn header(&mut self, groups: &[Group]) {
        let variable = groups.iter().position(|group| group.is(9, "$INSUNITS"));
        let number = variable.and_then(|k| groups.get(k + 1)).and_then(|g| g.whole().ok());
        self.units = UNITS.iter().find(|(n, _)| Some(*n) == number).map(|(_, name)| *name);
        // Without units it is 0.
        self.unknown_units = number.filter(|number| *number != 0 && self.units.is_none());
    }

    fn tables(&mut self, groups: &'a [Group<'a>]) {
        const FROZEN: i64 = 1;
        for entry in entities(groups).iter().filter(|entry| entry.name() == "LAYER") {
            let fields = entry.fields();
            let Some(name) = fields.find(2) else { continue };
            // Colours of layers that are off are negative.
            let seen = if fields.whole_or(70, 0).unwrap_or(0) & FROZEN != 0 {
                Seen::Frozen
            } else if fields.whole_or(62, 0).unwrap_or(0) < 0 {
                Seen::Off
            } else {
                continue;
            };
            self.unseen.insert(name.text().to_uppercase(), seen);
        }
    }

    fn blocks(&mut self, groups: &'a [Group<'a>]) {
        let mut rest = groups;
        while let Some(start) = rest.iter().position(|group| group.is(0, "BLOCK")) {
            let block = &rest[start..];
            let end = block.iter().position(|g| g.is(0, "ENDBLK")).unwrap_or(block.len());
            let (block, after) = block.split_at(end);
            rest = after;
            let head =
                block.iter().skip(1).position(|g| g.code == 0).map_or(block.len(), |k| k + 1);
            let fields = Fields(&block[..head]);
            if let Some(name) = fields.find(2) {
                let base = fields.point(10).unwrap_or_default();
                let name = name.text().to_uppercase();
                self.blocks.insert(name, Block { base, entities: entities(&block[head..]) });
            }
        }
    }
}

/// The error that a file ends before its end.
fn cut_off(groups: &[Group]) -> Error {
    let why = "the file is cut off behind this; save or copy it again";
    groups.last().map_or(Error::Empty, |last| last.wrong(why))
}

/// The entities in a list of groups, with the parts that follow some of them.
fn entities<'a>(groups: &'a [Group<'a>]) -> Vec<Entity<'a>> {
    let mut found = Vec::new();
    let mut rest = groups;
    while let Some(start) = rest.iter().position(|group| group.code == 0) {
        let own = &rest[start..];
        let end = own.iter().skip(1).position(|g| g.code == 0).map_or(own.len(), |k| k + 1);
        let (own, mut after) = own.split_at(end);
        let mut parts: &[Group] = &[];
        // Attributes of an insertion follow only if it says so.
        let has_parts = own[0].is(0, "POLYLINE")
            || own[0].is(0, "INSERT") && Fields(own).whole_or(66, 0).unwrap_or(0) == 1;
        if has_parts {
            let is_part = |g: &Group| g.is(0, "VERTEX") || g.is(0, "ATTRIB") || g.is(0, "SEQEND");
            let end = after.iter().position(|g| g.code == 0 && !is_part(g));
            (parts, after) = after.split_at(end.unwrap_or(after.len()));
        }
        found.push(Entity { groups: own, parts });
        rest = after;
    }
    found
}

/// Where entities stand.
#[derive(Clone)]
struct Place {
    to_plane: Affine,
    /// The layer of what is on layer 0 of a block.
    layer: Option<String>,
    block: Option<String>,
    depth: usize,
}

/// What is said of an entity.
#[derive(Clone, Debug)]
struct Source {
    name: String,
    handle: Option<String>,
    layer: String,
    color: Option<i64>,
    linetype: Option<String>,
    block: Option<String>,
}

/// An outline or a part of one, with its place in the drawing.
struct Line {
    order: usize,
    source: Source,
    contour: Contour,
}

/// A closed outline of some lines, how many repeat them, and the widest gap between them.
struct Outline<'a> {
    lines: Vec<&'a Line>,
    contour: Contour,
    n_repeats: usize,
    gap: f64,
}

impl Outline<'_> {
    /// The line that comes first in the drawing.
    fn first(&self) -> Option<&Line> {
        self.lines.iter().copied().min_by_key(|line| line.order)
    }

    fn order(&self) -> usize {
        self.first().map_or(0, |line| line.order)
    }
}

/// What a drawing draws, in its order.
#[derive(Default)]
struct Drawing {
    closed: Vec<Line>,
    open: Vec<Line>,
    items: Vec<(usize, Item)>,
    n: usize,
    /// The layer that is asked for, be it seen or not.
    asked: Option<String>,
    /// How many entities are not seen, and on which layers.
    unseen: (usize, BTreeSet<String>),
}

/// What becomes a feature.
struct Item {
    id: Option<Json>,
    properties: Vec<(String, Json)>,
    geometry: String,
    notes: Vec<Note>,
    /// `None` if it is no polygon.
    polygons: Option<Result<Vec<Vec<Contour>>, Error>>,
}

impl Drawing {
    fn add(&mut self, file: &File, entity: Entity, place: &Place, n_drawn: &mut usize) {
        *n_drawn += 1;
        if *n_drawn > MOST + 1 || matches!(entity.name().as_str(), "SEQEND" | "VIEWPORT" | "") {
            return;
        }
        let source = Source::new(entity, place);
        if self.is_unseen(file, entity, &source) {
            self.unseen.0 += 1;
            self.unseen.1.insert(source.layer);
            return;
        }
        let order = self.n;
        self.n += 1;
        if *n_drawn == MOST + 1 || place.depth > DEPTH {
            let why = "blocks insert one another more often than is read; explode them";
            let error = entity.groups[0].wrong(why);
            self.items.push((order, Item::of(&source, Some(Err(error)))));
            return;
        }
        let fields = entity.fields();
        if fields.whole_or(67, 0).unwrap_or(0) == 1 {
            let mut item = Item::of(&source, None);
            item.geometry += " in paper space";
            self.items.push((order, item));
            return;
        }
        if source.name == "INSERT" {
            self.n = order;
            if let Err(error) = self.insert(file, entity, place, &source, n_drawn) {
                self.items.push((order, Item::of(&source, Some(Err(error)))));
                self.n = self.n.max(order + 1);
            }
            return;
        }
        let to_plane = |contour: &Contour| place.to_plane.contour(contour);
        match entity.drawn() {
            Ok(Drawn::Closed(contour)) => {
                self.closed.push(Line { order, source, contour: to_plane(&contour) });
            }
            Ok(Drawn::Open(contour)) => {
                self.open.push(Line { order, source, contour: to_plane(&contour) });
            }
            Ok(Drawn::Filled(contours, style)) => {
                let contours: Vec<Contour> = contours.iter().map(to_plane).collect();
                let nests = style.filled(nests(&contours.iter().collect::<Vec<_>>()));
                let polygon =
                    |nest: Nest| nest.rings.into_iter().map(|k| contours[k].clone()).collect();
                let polygons = nests.into_iter().map(polygon).collect();
                self.items.push((order, Item::of(&source, Some(Ok(polygons)))));
            }
            Ok(Drawn::Other) => self.items.push((order, Item::of(&source, None))),
            Err(error) => self.items.push((order, Item::of(&source, Some(Err(error))))),
        }
    }

    /// Whether nobody sees an entity, nor asks for its layer.
    fn is_unseen(&self, file: &File, entity: Entity, source: &Source) -> bool {
        if self.asked.as_deref() == Some(source.layer.as_str()) {
            return false;
        }
        const INVISIBLE: i64 = 1;
        let is_invisible = entity.fields().whole_or(60, 0).unwrap_or(0) == INVISIBLE;
        let seen = file.unseen.get(&source.layer.to_uppercase());
        let is_block = source.name == "INSERT";
        is_invisible || seen.is_some_and(|seen| !is_block || *seen == Seen::Frozen)
    }

    fn insert(
        &mut self,
        file: &File,
        entity: Entity,
        place: &Place,
        source: &Source,
        n_drawn: &mut usize,
    ) -> Result<(), Error> {
        let fields = entity.fields();
        let name = fields.find(2).map(|g| g.text().into_owned()).unwrap_or_default();
        let Some(block) = file.blocks.get(&name.to_uppercase()) else {
            return Err(entity.groups[0].wrong(format!("there is no block `{name}`")));
        };
        let at = fields.point(10)?;
        let (sx, sy) = (fields.real_or(41, 1.0)?, fields.real_or(42, 1.0)?);
        let turn = fields.real_or(50, 0.0)?;
        let (n_columns, n_rows) = (fields.whole_or(70, 1)?.max(1), fields.whole_or(71, 1)?.max(1));
        let (dx, dy) = (fields.real_or(44, 0.0)?, fields.real_or(45, 0.0)?);
        let (sin, cos) = match turn.rem_euclid(360.0) {
            0.0 => (0.0, 1.0),
            90.0 => (1.0, 0.0),
            180.0 => (0.0, -1.0),
            270.0 => (-1.0, 0.0),
            _ => turn.to_radians().sin_cos(),
        };
        let rotation = Affine { a: cos, b: sin, c: -sin, d: cos, e: 0.0, f: 0.0 };
        let outer =
            place.to_plane.after(&fields.plane(30)?).after(&Affine::translation(at.x, at.y));
        let inner =
            Affine::scaling(sx, sy).after(&Affine::translation(-block.base.x, -block.base.y));
        for row in 0..n_rows {
            for column in 0..n_columns {
                if *n_drawn > MOST {
                    return Ok(());
                }
                let step = Affine::translation(column as f64 * dx, row as f64 * dy);
                let place = Place {
                    to_plane: outer.after(&rotation).after(&step).after(&inner),
                    layer: Some(source.layer.clone()),
                    block: Some(name.clone()),
                    depth: place.depth + 1,
                };
                // An empty block counts too, as it may be inserted any number of times.
                *n_drawn += 1;
                for entity in &block.entities {
                    self.add(file, *entity, &place, n_drawn);
                }
            }
        }
        Ok(())
    }

    /// The layers on which something is.
    fn layers(&self) -> BTreeSet<String> {
        let lines = self.closed.iter().chain(&self.open).map(|line| line.source.layer.clone());
        lines.chain(self.items.iter().map(|(_, item)| item.layer())).collect()
    }

    /// All that is to become features, in their order; of one layer if it is named.
    fn items(mut self, units: Option<&str>, only: Option<&str>) -> Vec<Item> {
        let is_asked = |layer: &str| only.is_none_or(|only| only == layer);
        let mut by_layer: BTreeMap<String, [Vec<usize>; 2]> = BTreeMap::new();
        for (kind, list) in [&self.closed, &self.open].into_iter().enumerate() {
            for (k, line) in list.iter().enumerate() {
                by_layer.entry(line.source.layer.clone()).or_default()[kind].push(k);
            }
        }
        self.items.retain(|(_, item)| is_asked(&item.layer()));
        for (layer, [closed, open]) in by_layer {
            if !is_asked(&layer) {
                continue;
            }
            let mut outlines: Vec<Outline> = Vec::new();
            for k in closed {
                let line = &self.closed[k];
                outlines.push(Outline {
                    lines: vec![line],
                    contour: line.contour.clone(),
                    n_repeats: 0,
                    gap: 0.0,
                });
            }
            let lines: Vec<Contour> = open.iter().map(|k| self.open[*k].contour.clone()).collect();
            for chain in chains(&lines) {
                let lines: Vec<&Line> = chain.parts.iter().map(|k| &self.open[open[*k]]).collect();
                let Chain { contour, n_repeats, gap, closed, .. } = chain;
                let outline = Outline { lines, contour, n_repeats, gap };
                if closed {
                    outlines.push(outline);
                } else {
                    self.items.extend(unclosed(&outline));
                }
            }
            outlines.sort_by_key(Outline::order);
            for nest in nests(&outlines.iter().map(|outline| &outline.contour).collect::<Vec<_>>())
            {
                let rings = || nest.rings.iter().map(|k| &outlines[*k]);
                let first = rings().map(Outline::order).min().unwrap_or(0);
                let outer = &outlines[nest.rings[0]];
                let Some(line) = outer.first() else { continue };
                let contours = rings().map(|ring| ring.contour.clone()).collect();
                let mut item = Item::of(&line.source, Some(Ok(vec![contours])));
                if outer.lines.len() > 1 {
                    item.properties.push(("entities".to_owned(), whole(outer.lines.len() as i64)));
                }
                let gap = rings().map(|ring| ring.gap).fold(0.0, f64::max);
                if gap > 0.0 {
                    let text = format!("ends of lines that are up to {gap:e} apart are joined");
                    item.notes.push(Note { code: "gap_closed", text });
                }
                let n_repeats: usize = rings().map(|ring| ring.n_repeats).sum();
                if n_repeats > 0 {
                    let text = format!(
                        "lines that are drawn more than once are taken once: {n_repeats} left out"
                    );
                    item.notes.push(Note { code: "duplicate_line", text });
                }
                self.items.push((first, item));
            }
        }
        self.items.sort_by_key(|(order, _)| *order);
        let mut items: Vec<Item> = self.items.into_iter().map(|(_, item)| item).collect();
        if let Some(units) = units {
            for item in &mut items {
                item.properties.push(("units".to_owned(), quoted(units)));
            }
        }
        items
    }
}

/// Lines that close nothing.
fn unclosed(outline: &Outline) -> Option<(usize, Item)> {
    let first = outline.first()?;
    let mut kinds: Vec<&str> = outline.lines.iter().map(|line| line.source.name.as_str()).collect();
    kinds.sort_unstable();
    kinds.dedup();
    let (a, b) = (outline.contour.start, outline.contour.end());
    let repeats = match outline.n_repeats {
        0 => String::new(),
        1 => ", 1 repeat left out,".to_owned(),
        n => format!(", {n} repeats left out,"),
    };
    let what = format!(
        "a chain of {} {}{repeats} on layer `{}` from ({}, {}) to ({}, {})",
        outline.lines.len(),
        kinds.join(", "),
        first.source.layer,
        a.x,
        a.y,
        b.x,
        b.y
    );
    Some((first.order, Item::of(&first.source, Some(Err(Error::OpenChain { what })))))
}

impl Source {
    fn new(entity: Entity, place: &Place) -> Self {
        let fields = entity.fields();
        let text = |code: i32| fields.find(code).map(|group| group.text().into_owned());
        let layer = text(8).unwrap_or_else(|| "0".to_owned());
        let layer = match &place.layer {
            Some(outer) if layer == "0" => outer.clone(),
            _ => layer,
        };
        Self {
            name: entity.name(),
            handle: text(5),
            layer,
            color: fields.find(62).and_then(|group| group.whole().ok()),
            linetype: text(6),
            block: place.block.clone(),
        }
    }
}

impl Item {
    fn of(source: &Source, polygons: Option<Result<Vec<Vec<Contour>>, Error>>) -> Self {
        let mut properties = vec![
            ("layer".to_owned(), quoted(&source.layer)),
            ("entity".to_owned(), quoted(&source.name)),
        ];
        let mut add = |name: &str, value: Option<Json>| {
            properties.extend(value.map(|value| (name.to_owned(), value)));
        };
        add("handle", source.handle.as_deref().map(quoted));
        add("color", source.color.map(whole));
        add("linetype", source.linetype.as_deref().map(quoted));
        add("block", source.block.as_deref().map(quoted));
        Self {
            id: source.handle.as_deref().map(quoted),
            properties,
            geometry: format!("a DXF {}", source.name),
            notes: Vec::new(),
            polygons,
        }
    }

    fn layer(&self) -> String {
        let layer = self.properties.first().map(|(_, value)| value.get()).unwrap_or_default();
        serde_json::from_str(layer).unwrap_or_default()
    }

    /// About as many bytes as it has as text.
    fn size(&self) -> usize {
        let polygons = self.polygons.iter().flatten().flatten();
        polygons.flatten().map(Contour::size).sum()
    }

    fn feature(self, index: usize, tolerance: Option<f64>) -> Result<Feature, FeatureError> {
        let polygonal = self.polygons.is_some();
        let flat = match self.polygons {
            Some(Ok(polygons)) => flatten(&polygons, tolerance).map_err(Error::from),
            Some(Err(error)) => Err(error),
            None => Ok((Vec::new(), None)),
        };
        match flat {
            Ok((polygons, curves)) => Ok(Feature {
                index,
                id: self.id,
                properties: self.properties,
                polygons,
                geometry: self.geometry,
                polygonal,
                fill: FillRule::EvenOdd,
                curves,
                notes: self.notes,
                points: None,
                mask: None,
            }),
            Err(error) => Err(FeatureError { feature: index, id: self.id, error }),
        }
    }
}
