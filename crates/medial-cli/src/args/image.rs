use super::segment::colour;
use super::{
    ChosenEngine, Height, ImageRun, Line, Pruning, Segmentation, Target, measure, not_negative,
    point, positive, two_points,
};
use crate::failure::Failure;
use clap::{Args, ValueEnum};
use medial::axis::Engine;
use medial::geom::Point;
use medial::ops::Measure;
use std::path::PathBuf;

const IMAGE_HELP: &str = "\
The image is parted into regions as by `medial segment`. All of them are taken, or those that options choose: by
their size, by their mean colour, or by points. --at X,Y takes the region at a point as an object of its own, with
--combine all such regions as one object, and --remove X,Y takes a region out again. A file of clicks does all of
that in its order: rows of CSV below `action,x,y`, or JSON lines such as {\"action\": \"add\", \"x\": 3, \"y\": -2}; actions
are add, combine (with the object of the click before) and remove. Where only points are given, nothing else is
chosen. Coordinates are those of the output: of the reference system, else pixels from the upper left corner, x to
the right and y upwards, so negative.

Layers, which are in the property `layer` and in pictures have these colours:
  border    the polygons of the regions, exact along the sides of pixels or simplified (yellow, dotted)
  delaunay  the Delaunay graph of samples of the border, inside (white, thin)
  crust     its edges that tell the border from the samples alone (orange)
  dual      the dual graph: middles of triangles (blue, dashed)
  nodes     its nodes by their kind: dangling, internal, ramification_1, ramification_2; pictures leave internal ones
            out (green)
  axis      the medial axis, a line a branch, pruned by a chord residual of 2 pixels (red); with --prune none, --by path
            and --measures chord all levels of it at once: what lies above a value is the axis at that level
Of --compare they are: change, an outline of each object in either image (white), gained (green), lost (red).

--simplify and --smooth-border change the borders between regions, once for both sides, so that regions still fit;
--retract draws back that of each region by its own axis, so that neighbours part.

Formats: geojson, geojsonl, csv, wkt, wkb, dxf, svg, png; gpkg, with a table for each layer; other tables (shp, fgb,
parquet) of one layer.

What was chosen can be kept and compared: --labels writes the number of each pixel's object, and --method labels reads
it again, also as the other image of --compare; so the objects of either image are chosen in their own way.

Examples:
  medial image fixtures/images/lake.png -o scene.geojson
  medial image fixtures/images/lake.png --at 25,-65 --layers delaunay,crust,dual,axis -o lake.svg
  medial image fixtures/images/atlas.png --clicks fixtures/images/atlas.clicks.csv -o map.png
  medial image fixtures/images/lake.png --min-pixels 9 --simplify 1 --engine path_tracing --to wkt
  medial image fixtures/images/lake.png --compare fixtures/images/lake.png --layers change --to csv
  medial image fixtures/images/lake.png --at 25,-65 --labels lake.tiff -o lake.geojson
  medial image lake.tiff --method labels --compare lake.tiff --to csv

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some regions were left out.";

/// Arguments of `medial image`.
#[derive(Debug, Args)]
#[command(after_help = IMAGE_HELP)]
pub struct ImageArgs {
    /// An image (png, jpeg, tiff); `-` for standard input
    pub input: PathBuf,
    #[command(flatten)]
    pub target: Target,
    #[command(flatten)]
    pub segmentation: Segmentation,
    #[command(flatten)]
    pub choice: Choice,
    #[command(flatten)]
    pub engine: ChosenEngine,
    #[command(flatten)]
    pub pruning: Pruning,
    /// Simplify the borders between regions within this distance, in units of the input: once for both sides, so
    /// that regions still fit, and without a change of topology; axes of delaunay_dual end where borders touch
    /// themselves in a corner of 180 degrees or more
    #[arg(long, value_name = "D", value_parser = positive, allow_negative_numbers = true)]
    pub simplify: Option<f64>,
    /// What is written, separated by commas: border, delaunay, crust, dual, nodes, axis; by default border and axis. Of
    /// --compare: change, gained, lost, by default all
    #[arg(long, value_name = "LAYER", value_delimiter = ',')]
    pub layers: Vec<Layer>,
    /// Write these measures of significance of the axis, separated by commas: the largest value and those at both ends;
    /// see `medial prune --help`
    #[arg(long, value_name = "MEASURE", value_delimiter = ',', value_parser = measure)]
    pub measures: Vec<Measure>,
    /// What makes one line of the axis: a branch between ends and junctions, or a path between neighbours
    #[arg(long, value_name = "WHAT", default_value = "branch")]
    pub by: Line,
    /// Write to FILE, as a TIFF image of 32 bits, the number of each pixel's object from 1 on, 0 in none
    #[arg(long, value_name = "FILE", conflicts_with = "compare")]
    pub labels: Option<PathBuf>,
    /// Largest distance between a curve of the axis and the polyline drawn for it, in units of the input; by
    /// default 1e-4 of the longer side of the region's box
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    /// Write the radius as third coordinate of the axis (geojson, geojsonl, csv, wkt, wkb, dxf, tables)
    #[arg(long, value_name = "VALUE")]
    pub z: Option<Height>,
    /// The part of the image that a picture shows (svg, png)
    #[arg(long, value_name = "X1,Y1,X2,Y2", value_parser = two_points, allow_hyphen_values = true)]
    pub window: Option<[Point; 2]>,
    /// Part another image of the same place in the same way, choose the same of it, and write what became of the
    /// objects of the first one; bands go from 0 to 100 as in the first one
    #[arg(long, value_name = "IMAGE")]
    pub compare: Option<PathBuf>,
    /// The same as --mask, for the image of --compare
    #[arg(long, value_name = "FILE", requires = "compare")]
    pub compare_mask: Option<PathBuf>,
    /// Clicks for the image of --compare, instead of --at, --remove and --clicks
    #[arg(long, value_name = "FILE", requires = "compare")]
    pub compare_clicks: Option<PathBuf>,
    /// The least overlap of an object with what it became: what both share, of what either has; less of it, and one
    /// vanished and another appeared
    #[arg(long, value_name = "SHARE", value_parser = not_negative, default_value = "0.1",
        requires = "compare")]
    pub min_overlap: f64,
    #[command(flatten)]
    pub run: ImageRun,
}

/// Which regions are taken.
#[derive(Debug, Args)]
pub struct Choice {
    /// Take the region at this point, to be given several times
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    pub at: Vec<Point>,
    /// Take the regions of all --at together as one object
    #[arg(long, requires = "at")]
    pub combine: bool,
    /// Do not take the region at this point, to be given several times
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    pub remove: Vec<Point>,
    /// A file of points with what each does (csv, JSON lines), after --at and --remove
    #[arg(long, value_name = "FILE")]
    pub clicks: Option<PathBuf>,
    /// Take regions of at least so many pixels
    #[arg(long, value_name = "N")]
    pub min_pixels: Option<u64>,
    /// Take regions of at most so many pixels
    #[arg(long, value_name = "N")]
    pub max_pixels: Option<u64>,
    /// Take regions whose mean colour is near one of these, as RRGGBB, separated by commas
    #[arg(long, value_name = "RRGGBB,…", value_delimiter = ',', value_parser = colour)]
    pub select_color: Vec<[u8; 3]>,
    /// How near that is, in L*u*v*; by default 20
    #[arg(long, value_name = "D", value_parser = positive, allow_negative_numbers = true,
        requires = "select_color")]
    pub select_tolerance: Option<f64>,
}

/// What is written of regions, and of what became of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Layer {
    Border,
    Delaunay,
    Crust,
    Dual,
    Nodes,
    Axis,
    Change,
    Gained,
    Lost,
}

impl Layer {
    pub fn name(self) -> &'static str {
        match self {
            Self::Border => "border",
            Self::Delaunay => "delaunay",
            Self::Crust => "crust",
            Self::Dual => "dual",
            Self::Nodes => "nodes",
            Self::Axis => "axis",
            Self::Change => "change",
            Self::Gained => "gained",
            Self::Lost => "lost",
        }
    }

    /// Whether it tells what became of objects.
    pub fn is_of_changes(self) -> bool {
        matches!(self, Self::Change | Self::Gained | Self::Lost)
    }
}

impl ImageArgs {
    /// The layers to write, each once, the lowest one in a picture first.
    pub fn layers(&self) -> Vec<Layer> {
        use Layer::{Axis, Border, Change, Crust, Delaunay, Dual, Gained, Lost, Nodes};
        let usual: &[Layer] =
            if self.compare.is_some() { &[Change, Gained, Lost] } else { &[Border, Axis] };
        let asked = if self.layers.is_empty() { usual } else { &self.layers[..] };
        let all = [Delaunay, Crust, Border, Dual, Axis, Nodes, Gained, Lost, Change];
        all.into_iter().filter(|layer| asked.contains(layer)).collect()
    }

    /// The engine, with what it is to know of pixels of this size.
    pub fn engine(&self, cell: f64) -> ChosenEngine {
        let mut engine = self.engine.clone();
        let chosen = *engine.engine.get_or_insert(Engine::DelaunayDual);
        let has_borders = self.simplify.is_some() || self.engine.smooth_border.is_some();
        if has_borders && chosen == Engine::DelaunayDual {
            engine.spacing.get_or_insert(0.5 * cell);
        } else if has_borders && !chosen.is_exact() {
            engine.cell.get_or_insert(cell);
        }
        engine
    }

    /// What leaves axes: if nothing is said, what images are pruned by.
    pub fn pruning(&self, cell: f64) -> Pruning {
        /// The chord residual below which branches go, in pixels.
        const RESIDUAL: f64 = 2.0;
        let Pruning { prune, max_error, keep_artefacts } = self.pruning;
        let is_said = prune.is_some() || max_error.is_some();
        let usual = super::Prune::Below(Measure::Chord, RESIDUAL * cell);
        let prune = if is_said { prune } else { Some(usual) };
        Pruning { prune, max_error, keep_artefacts }
    }

    /// Fails if options contradict one another.
    pub fn check(&self) -> Result<(), Failure> {
        let usage = |why: String| Err(Failure::Usage(why));
        let engine = self.engine(1.0);
        engine.check()?;
        self.pruning.check(&engine)?;
        let layers = self.layers();
        let is_other = |layer: &&Layer| layer.is_of_changes() != self.compare.is_some();
        if let Some(layer) = layers.iter().find(is_other) {
            let name = layer.name();
            return usage(match self.compare {
                Some(_) => {
                    format!("--layers {name} is not for --compare; it has change, gained, lost")
                }
                None => format!("--layers {name} is for --compare"),
            });
        }
        let graphs = [Layer::Delaunay, Layer::Crust, Layer::Dual, Layer::Nodes];
        if engine.engine != Some(Engine::DelaunayDual)
            && let Some(layer) = graphs.iter().find(|layer| layers.contains(layer))
        {
            return usage(format!("--layers {} is for --engine delaunay_dual", layer.name()));
        }
        if self.simplify.is_some() && (engine.smooth_border.is_some() || engine.retract.is_some()) {
            let why = "--simplify makes straight borders, --smooth-border and --retract round ones; leave one out";
            return usage(why.to_owned());
        }
        if !self.measures.is_empty() && self.compare.is_none() && !layers.contains(&Layer::Axis) {
            return usage("--measures are those of the layer axis; name it in --layers".to_owned());
        }
        let of_axes = [
            ("--engine", self.engine.engine.is_some()),
            ("--prune", self.pruning.prune.is_some()),
            ("--max-error", self.pruning.max_error.is_some()),
            ("--simplify", self.simplify.is_some()),
            ("--spacing", self.engine.spacing.is_some()),
            ("--smooth-border", self.engine.smooth_border.is_some()),
            ("--retract", self.engine.retract.is_some()),
            ("--z", self.z.is_some()),
            ("--measures", !self.measures.is_empty()),
        ];
        if let Some((name, _)) = of_axes.iter().find(|(_, said)| *said && self.compare.is_some()) {
            return usage(format!("{name} is not for --compare, which computes no axes"));
        }
        if self.min_overlap >= 1.0 {
            return usage("--min-overlap is a share below 1".to_owned());
        }
        if !self.choice.select_color.is_empty() && !self.segmentation.bands.is_empty() {
            return usage("--select-color is for colours, not for --bands".to_owned());
        }
        if let (Some(least), Some(most)) = (self.choice.min_pixels, self.choice.max_pixels)
            && least > most
        {
            return usage(format!("no region has at least {least} and at most {most} pixels"));
        }
        Ok(())
    }
}
