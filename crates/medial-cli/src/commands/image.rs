use super::axis::{dual, measured, traced};
use super::changes;
use super::features::Run;
use super::means::Means;
use super::painting::{Drawn, Painting, lines};
use super::place::{TIFF, check_beside, check_file, check_inputs, is_georeferenced, write_labels};
use super::records::{Found, Plan};
use super::regions::{self, Parted};
use super::sink::title;
use crate::args::{
    ChosenEngine, Height, ImageArgs, ImageLayer, Line, Pruning, Region, Sides, Target,
};
use crate::failure::{Failure, Status};
use crate::output::Output;
use crate::parallel::kept;
use crate::report::Entry;
use crate::timings::{Stages, timed};
use medial::axis::{Engine, Joining, Side};
use medial::domain::{self, Domain};
use medial::engine::{self, DelaunayDual, DualKind};
use medial::geom::Point;
use medial::ops::Measure;
use medial::raster::{Mask, outline};
use medial_image::{Borders, Labels, Object, Objects};
use medial_io::record::{Record, Shape, Value};
use medial_io::svg::Overlay;
use medial_io::{
    Crs, Drawing, Feature, Format, Layer, image, line_columns, line_records, point_record,
};
use std::sync::Arc;

/// Columns of what is written of a region, before those of lines.
const COLUMNS: &[&str] =
    &["layer", "region", "n_regions", "pixels", "area", "color", "mean_1", "mean_2", "mean_3"];

/// Formats of what is written.
pub const FORMATS: &[Format] = &[
    Format::GeoJson,
    Format::GeoJsonLines,
    Format::Csv,
    Format::Wkt,
    Format::Wkb,
    Format::Dxf,
    Format::Svg,
    Format::Png,
];

/// `medial image`.
pub fn run(args: &'static ImageArgs) -> Result<Status, Failure> {
    args.check()?;
    regions::check(&args.segmentation)?;
    let layers = args.layers();
    let format = checked_format(args, &layers)?;
    let others = [
        ("--labels", args.labels.as_deref()),
        ("--report", args.run.run.report.as_deref()),
        ("--timings", args.run.run.timings.as_deref()),
    ];
    check_beside(args.target.output.as_deref(), format, &others)?;
    check_file("--labels", args.labels.as_deref(), TIFF)?;
    let segmentation = &args.segmentation;
    check_inputs(&[
        Some(&args.input),
        args.compare.as_deref(),
        segmentation.mask.as_deref(),
        args.compare_mask.as_deref(),
        args.choice.clicks.as_deref(),
        args.compare_clicks.as_deref(),
    ])?;
    let mut run = Run::new(kept(args.run.common()))?;
    run.knows_metric = false;
    let is_picture = matches!(format, Format::Svg | Format::Png);
    let labels = args.labels.as_deref().map(Output::beside).transpose()?;
    let mask = segmentation.mask.as_deref();
    let parted = regions::parted(segmentation, &args.input, mask, &mut run, is_picture, None)?;
    let objects = timed(&mut run.stages.operations, || parted.chosen(&args.choice, None))?;
    if let Some(other) = &args.compare {
        return changes::run(args, run, format, &parted, &objects, other);
    }
    if objects.all().is_empty() {
        return Err(parted.unchosen(None));
    }
    let Parted { input, crs, means, colours, .. } = parted;
    let (grid, objects) = (*objects.grid(), Arc::new(objects));
    let is_georeferenced = is_georeferenced(&grid, crs.as_ref());
    if let Some(output) = labels {
        timed(&mut run.stages.write, || {
            let bytes = labels_of(&objects, crs.as_ref(), input.bytes());
            write_labels(output, &bytes, is_georeferenced, args.run.run.quiet)
        })?;
    }
    let cell = grid.cell_size();
    let plan = Plan {
        target: &args.target,
        thing: "layers",
        formats: FORMATS,
        columns: columns(&args.measures),
        engine: args.engine(cell).engine,
        layers: several(&layers),
    };
    let overlay = Overlay { grid, colours, layers: Vec::new(), is_georeferenced, crs: crs.clone() };
    let borders = timed(&mut run.stages.operations, || borders(&objects, args));
    let has_borders = borders.is_some();
    let layer = timed(&mut run.stages.operations, || {
        let takes_masks = args.engine(cell).engine.is_some_and(|engine| !engine.is_exact());
        layer(&objects, crs, takes_masks, borders)
    });
    let drafter = Drafter {
        engine: args.engine(cell),
        pruning: args.pruning(cell),
        region: Region { side: Sides::Interior, frame: None },
        layers: args.layers(),
        drawing: Drawing {
            tolerance: args.tolerance,
            radius_as_z: args.z == Some(Height::Radius),
            by: Some(match args.by {
                Line::Branch => Joining::Branches,
                Line::Path => Joining::Governors,
            }),
            ..Drawing::default()
        },
        means,
        has_borders,
        measures: args.measures.clone(),
        objects,
    };
    let title = title("Regions", &args.input);
    let painting = Painting { args, format, title, overlay, layers };
    painting.run(&plan, run, &input.name, layer, move |feature, domain, stages, options| {
        let records = drafter.records(feature, domain, stages, options)?;
        Ok(if is_picture {
            // What a line is drawn through anyway needs no dot.
            let is_drawn = |(layer, record): &(ImageLayer, Record)| {
                *layer != ImageLayer::Nodes
                    || !record.values.contains(&DualKind::Internal.name().into())
            };
            let drawn = |(layer, record): (ImageLayer, Record)| (layer, lines(record.shape));
            let records = records.into_iter().filter(is_drawn);
            Found::Part(records.map(drawn).collect::<Vec<Drawn>>())
        } else {
            Found::Records(records.into_iter().map(|(_, record)| record).collect())
        })
    })
}

/// The format of the output, if layers have it.
fn checked_format(args: &'static ImageArgs, layers: &[ImageLayer]) -> Result<Format, Failure> {
    let target: &'static Target = &args.target;
    let plan = Plan {
        target,
        thing: "layers",
        formats: FORMATS,
        columns: COLUMNS,
        engine: None,
        layers: Vec::new(),
    };
    let format = plan.format()?;
    let usage = |why: String| Err(Failure::Usage(why));
    if format.is_table() && format != Format::Gpkg && layers.len() > 1 {
        let names = several(layers).join(", ");
        return usage(format!(
            "the format {format} holds one layer, and here are {names}; name one with --layers, or write gpkg, which \
             holds all"
        ));
    }
    let is_picture = matches!(format, Format::Svg | Format::Png);
    if args.window.is_some() && !is_picture {
        return usage(format!("--window is for svg and png, not for {format}"));
    }
    let has_values =
        matches!(format.encoding(), Format::GeoJson | Format::GeoJsonLines | Format::Csv);
    if !args.measures.is_empty() && !has_values {
        return usage(format!(
            "--measures is for geojson, geojsonl, csv and tables, not for {format}"
        ));
    }
    if args.z.is_some() && is_picture {
        return usage(format!("--z is not for {format}"));
    }
    Ok(format)
}

/// The borders between objects that are other ones than the sides of pixels.
fn borders(objects: &Objects, args: &ImageArgs) -> Option<Borders> {
    let simple = args.simplify.map(|tolerance| objects.borders(tolerance));
    simple.or_else(|| args.engine.smooth_border.map(|width| objects.smooth_borders(width)))
}

/// The names of layers, if there are several.
pub fn several(layers: &[ImageLayer]) -> Vec<&'static str> {
    if layers.len() > 1 { layers.iter().map(|layer| layer.name()).collect() } else { Vec::new() }
}

/// A feature for each object: its mask with its outline, its polygons, or those between these borders.
fn layer(
    objects: &Arc<Objects>,
    crs: Option<Crs>,
    takes_masks: bool,
    borders: Option<Borders>,
) -> Layer<'static> {
    let n = objects.all().len();
    let objects = Arc::clone(objects);
    let feature = move |index: usize| {
        let number = index as u32;
        let mask = match borders {
            None if takes_masks => objects.mask(number).ok().map(Arc::new),
            _ => None,
        };
        let polygons = match &borders {
            Some(borders) => objects.polygons_between(number, borders),
            // Parts that meet at corners only are polygons of their own; that they hang together the mask tells.
            None => objects.polygons(number),
        };
        Feature {
            index,
            polygons,
            geometry: "a region".to_owned(),
            polygonal: true,
            mask,
            ..Feature::default()
        }
    };
    Layer::of_features(crs, (0..n).map(feature))
}

/// What makes layers of objects.
struct Drafter {
    engine: ChosenEngine,
    pruning: Pruning,
    region: Region,
    layers: Vec<ImageLayer>,
    drawing: Drawing,
    means: Means,
    measures: Vec<Measure>,
    /// Whether the polygons of objects are other ones than those of their pixels.
    has_borders: bool,
    objects: Arc<Objects>,
}

impl Drafter {
    /// The records of an object, each with its layer.
    fn records(
        &self,
        feature: &Feature,
        domain: &Domain,
        stages: &mut Stages,
        options: &engine::Options<'_>,
    ) -> Result<Vec<(ImageLayer, Record)>, Entry> {
        let layers = &self.layers;
        let has = |layer: ImageLayer| layers.contains(&layer);
        let graphs = [ImageLayer::Delaunay, ImageLayer::Crust, ImageLayer::Dual, ImageLayer::Nodes];
        // Borders of this object alone.
        let moves = self.engine.retract.is_some();
        let needs_graph = graphs.into_iter().any(has) || (moves && has(ImageLayer::Border));
        let mut graph = None;
        let mut axis = None;
        if self.engine.engine == Some(Engine::DelaunayDual) {
            if needs_graph || has(ImageLayer::Axis) {
                let cell = self.objects.grid().cell_size();
                let options = engine::Options { spacing: self.engine.spacing, ..*options };
                let found = timed(&mut stages.engine, || {
                    dual(&self.engine, &self.region, Side::Interior, feature, domain, &options)
                });
                let found = found.map_err(|error| Entry::unfinished(&error))?;
                stages.sampling = Some(found.sampling());
                if has(ImageLayer::Axis) {
                    let whole = timed(&mut stages.engine, || {
                        found.axis(self.pruning.of_dual(feature, cell))
                    });
                    axis = Some(whole.map_err(|error| Entry::unfinished(&error))?);
                }
                graph = Some(found);
            }
        } else if has(ImageLayer::Axis) {
            let (chosen, region, pruning) = (&self.engine, &self.region, &self.pruning);
            let axes = timed(&mut stages.engine, || {
                traced(chosen, region, pruning, feature, domain, options, &mut None)
            });
            axis = axes?.pop();
        }
        let axis = match axis {
            Some(axis) => Some(timed(&mut stages.operations, || {
                let is_asked =
                    !self.measures.is_empty() || self.pruning.removes(feature, axis.engine);
                let whole = feature.mask.as_deref().filter(|_| is_asked).map(of_outline);
                let whole = whole.transpose()?;
                let domain = whole.as_ref().unwrap_or(domain);
                measured(&self.pruning, &self.measures, feature, domain, axis)
            })?),
            None => None,
        };
        let border = || match &graph {
            Some(graph) if moves => graph.border(),
            _ if self.has_borders => feature.polygons.clone(),
            _ => self.objects.polygons(feature.index as u32),
        };
        let edges = |layer: ImageLayer| {
            let graph = graph.as_ref();
            Shape::Lines(graph.map_or_else(Vec::new, |graph| lines_of(graph, layer)))
        };
        let mut records = Vec::new();
        for &layer in layers {
            let told = |record: Record| (layer, self.record(feature, layer, record));
            match layer {
                ImageLayer::Axis => {
                    let lines = axis.as_ref().map_or_else(Vec::new, |(axis, significance)| {
                        line_records(axis, significance, self.drawing)
                    });
                    records.extend(lines.into_iter().map(told));
                }
                ImageLayer::Nodes => {
                    let nodes = graph.as_ref().map_or_else(Vec::new, DelaunayDual::nodes);
                    records.extend(nodes.into_iter().map(|node| {
                        let shape = Shape::Point(node.middle);
                        told(point_record(
                            node.radius,
                            node.kind.name(),
                            self.measures.len(),
                            shape,
                        ))
                    }));
                }
                _ => {
                    let shape = match layer {
                        ImageLayer::Border => Shape::Polygons(border()),
                        _ => edges(layer),
                    };
                    let values = vec![Value::None; line_columns(&self.measures).len()];
                    records.push(told(Record { values, shape }));
                }
            }
        }
        Ok(records)
    }

    /// A record with what is known of the object.
    fn record(&self, feature: &Feature, layer: ImageLayer, record: Record) -> Record {
        let Object { regions, whole } = &self.objects.all()[feature.index];
        let cell = self.objects.grid().cell;
        let mut values: Vec<Value> = vec![
            layer.name().into(),
            regions[0].into(),
            regions.len().into(),
            (whole.cells as usize).into(),
            (whole.cells as f64 * (cell[0] * cell[1]).abs()).into(),
            self.means.color(regions[0], whole.mean),
        ];
        values.extend(self.means.told(regions[0], whole.mean));
        values.extend(record.values);
        Record { values, shape: record.shape }
    }
}

/// The domain whose edges the axis of a mask names: its outline, in which parts that meet at corners hang together.
fn of_outline(mask: &Mask) -> Result<Domain, Entry> {
    let domain = Domain::from_polygons(&outline(mask), &domain::Options::default());
    domain.map_err(|error| Entry::internal(&error))
}

/// The columns of what is written of a region, with those of measures.
fn columns(measures: &[Measure]) -> &'static [&'static str] {
    let names = line_columns(measures).into_iter().map(|name| -> &'static str { name.leak() });
    COLUMNS.iter().copied().chain(names).collect::<Vec<_>>().leak()
}

/// The number of each pixel's object from 1 on, as an image.
fn labels_of(objects: &Objects, crs: Option<&Crs>, like: &[u8]) -> Vec<u8> {
    let number = |&number: &u32| match number {
        Objects::REST => 0,
        Labels::NONE => Labels::NONE,
        number => number + 1,
    };
    let numbers: Vec<u32> = objects.numbers().iter().map(number).collect();
    image::write_labels(objects.grid(), crs, &numbers, Labels::NONE, like)
}

/// The lines of a graph in a layer.
fn lines_of(graph: &DelaunayDual<'_>, layer: ImageLayer) -> Vec<Vec<Point>> {
    match layer {
        ImageLayer::Delaunay => graph.delaunay_edges().map(|(edge, _)| edge.to_vec()).collect(),
        ImageLayer::Crust => graph.crust_edges().map(|edge| edge.to_vec()).collect(),
        _ => {
            let nodes = graph.nodes();
            let middle = |node: u32| nodes[node as usize].middle;
            graph.edges().map(|edge| edge.map(middle).to_vec()).collect()
        }
    }
}
