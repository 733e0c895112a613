mod carve;
mod clearance;
mod offset;
mod walls;

pub use carve::{CarveArgs, Units};
pub use clearance::ClearanceArgs;
pub use offset::OffsetArgs;
pub use walls::WallsArgs;

use crate::failure::{Failure, Status};
use clap::error::ErrorKind;
use clap::{Args, Parser, Subcommand, ValueEnum};
use medial::axis::{Engine, Side, UnknownName};
use medial::domain::{self, FillRule};
use medial::engine::{self, Burning, RidgeSearch, RidgeThinning};
use medial::geom::Point;
use medial::ops::{Hierarchy, Measure, Pruned};
use medial_io::svg::Extra;
use medial_io::{Feature, Format};
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::str::FromStr;
use std::time::{Duration, Instant};

/// Exact medial axes of polygons.
#[derive(Debug, Parser)]
#[command(name = "medial", version, after_help = STATUS_HELP)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

const STATUS_HELP: &str = "\
Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out;
4 `check` found defects.";

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Compute the medial axis of polygons
    Axis(AxisArgs),
    /// Compute the medial axis of polygons and remove what is insignificant
    #[command(after_help = PRUNE_HELP)]
    Prune(AxisArgs),
    /// Compute the branches of the medial axis with their primitives, or peninsulas and bays
    #[command(after_help = BRANCHES_HELP)]
    Branches(BranchesArgs),
    /// Remove what stands out little, and rebuild the polygons
    #[command(after_help = SMOOTH_HELP)]
    Smooth(SmoothArgs),
    /// Rebuild polygons from their axes, pruned or not
    #[command(after_help = RECONSTRUCT_HELP)]
    Reconstruct(ReconstructArgs),
    /// Compute the main line of polygons, or the longest few, with widths
    Centerline(CenterlineArgs),
    /// Compute parallel curves of polygons, inward or outward
    Offset(OffsetArgs),
    /// Find where polygons are narrow, or near one another, their largest inscribed disks, or their width
    /// along the main line
    Clearance(ClearanceArgs),
    /// Compute the tool path of a V-bit that carves polygons
    Carve(CarveArgs),
    /// Find thin walls, as lines with the width of the shape
    Walls(WallsArgs),
    /// Compute the Voronoi diagram of the boundary elements of polygons
    Voronoi(VoronoiArgs),
    /// Find what of the boundary of polygons is nearest to a point
    Locate(LocateArgs),
    /// Find every defect of an axis document
    Check(CheckArgs),
    /// Run every engine on the same polygons
    Compare(CompareArgs),
    /// Write polygons as few disks of their axes, within an error, or without any
    Compress(CompressArgs),
}

const AXIS_HELP: &str = "\
Examples:
  medial axis fixtures/river.geojson -o river.svg
  medial axis fixtures/river.geojson -o river.png --draw disks
  medial axis fixtures/river.geojson -o river.axis.json
  medial axis fixtures/river.geojson -o river.csv --report report.json --timings timings.json
  medial axis fixtures/river.geojson -o edges.csv --nodes nodes.csv
  medial axis fixtures/shapes/plus_of_unit_squares.wkt --keypoints --z radius -o plus.geojson
  medial axis - --to wkt < fixtures/shapes/l_with_unit_arms.wkt
  medial axis fixtures/shapes/l_with_unit_arms.wkt --side both --frame 2 -o l.svg

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

const PRUNE_HELP: &str = "\
Points of the axis below a value of a measure are removed, from the leaves inwards, so components and
cycles stay; paths are cut where the value is reached. Measures, in units of the input but for those of the
last two:
  excess        how far the boundary moves if a disk takes the place of what is removed
  potential, chord, circularity
                boundary that is cut off; less its chord; less the arc of the disk that faces it
  erosion, length
                burn time less radius; the longest way to a leaf
  half_chord, radius
                half the distance of the footpoints, the radius: both may keep more than lies above
  relative_excess, prominence, angle
                excess as a share of the radius; the least of that from there to the root, by which limbs
                go as a whole; the angle between footpoints in radians (may keep more)
  scale         by how much all disks have to grow until a larger one holds this one (may keep more)

Examples:
  medial prune fixtures/river.geojson --max-error 2 -o river.svg
  medial prune fixtures/river.geojson --prune relative_excess=0.1 -o river.geojson
  medial prune fixtures/river.geojson --prune erosion=1.5 --to json > river.axis.json

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

/// Arguments of `medial axis` and `medial prune`.
#[derive(Debug, Args)]
#[command(after_help = AXIS_HELP)]
pub struct AxisArgs {
    /// Polygons in any format that --from knows; `-` for standard input
    pub input: PathBuf,
    /// File to write; by default, and for `-`, standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Format of the output: geojson, geojsonl, json (axis document), wkt, wkb, csv, gpkg, shp, fgb,
    /// parquet, svg, png, dxf; by default that of the extension, on standard output geojson
    #[arg(long, value_name = "FORMAT")]
    pub to: Option<Format>,
    #[command(flatten)]
    pub engine: ChosenEngine,
    #[command(flatten)]
    pub region: Region,
    #[command(flatten)]
    pub pruning: Pruning,
    /// Write these measures of significance for every path, separated by commas: the largest value and
    /// those at both ends (geojson, geojsonl, csv, json); see `medial prune --help`
    #[arg(long, value_name = "MEASURE", value_delimiter = ',', value_parser = measure)]
    pub measures: Vec<Measure>,
    /// Largest distance between a curve and the polyline drawn for it, in units of the input; by
    /// default 1e-4 of the longer side of the feature's box
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    /// What makes one line (all formats but json and pictures): a path between keypoints, or a branch between
    /// ends and junctions; by default paths, branches on an axis from samples
    #[arg(long, value_name = "WHAT")]
    pub by: Option<Line>,
    /// Write keypoints too (geojson, geojsonl, wkt, wkb, dxf; pictures and axis documents have them)
    #[arg(long)]
    pub keypoints: bool,
    /// Write the radius as third coordinate (geojson, geojsonl, wkt, wkb, csv, dxf)
    #[arg(long, value_name = "VALUE")]
    pub z: Option<Height>,
    /// Write the keypoints to this file besides, as a CSV table of nodes; with --to csv the paths are its
    /// edges, by the columns `from` and `to`
    #[arg(long, value_name = "FILE")]
    pub nodes: Option<PathBuf>,
    /// What a picture shows besides, separated by commas: disks, footpoints, cells, zones,
    /// governors
    #[arg(long, value_name = "WHAT", value_delimiter = ',', value_parser = extra)]
    pub draw: Vec<Extra>,
    #[command(flatten)]
    pub common: Common,
}

/// What makes one line of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Line {
    Path,
    Branch,
}

/// Where results go.
#[derive(Debug, Args)]
pub struct Target {
    /// File to write; by default, and for `-`, standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Format of the output; by default that of the extension, on standard output geojson
    #[arg(long, value_name = "FORMAT")]
    pub to: Option<Format>,
}

const BRANCHES_HELP: &str = "\
A branch runs from one end or junction to the next. Its primitives tell what the radius does: worm (stays),
wedge (changes at one rate), flare (its rate grows); opening or closing, and how the axis bends.
Limbs are branches with a free end, once small ones are pruned (by default relative_excess=0.5):
peninsulas inside, bays outside up to the convex hull. --match FILE lists the peninsulas of one file that
fit into bays of the other, as JSON lines with the turn and the shift that bring them together.

Formats: geojson, geojsonl, csv, wkt, wkb, dxf.

Examples:
  medial branches fixtures/river.geojson --max-error 2 -o branches.geojson
  medial branches fixtures/shapes/plus_of_unit_squares.wkt --by primitive --to csv
  medial branches fixtures/shapes/plus_of_unit_squares.wkt --limbs --side both --to csv
  medial branches fixtures/river.geojson --match fixtures/river.geojson --prune relative_excess=0.4

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

/// Arguments of `medial branches`.
#[derive(Debug, Args)]
pub struct BranchesArgs {
    /// Polygons in any format that --from knows; `-` for standard input
    pub input: PathBuf,
    #[command(flatten)]
    pub target: Target,
    #[command(flatten)]
    pub engine: ChosenEngine,
    #[command(flatten)]
    pub region: Region,
    #[command(flatten)]
    pub pruning: Pruning,
    /// One line for each branch, or for each primitive
    #[arg(long, value_name = "CUT", default_value = "branch")]
    pub by: Cut,
    /// Write peninsulas and bays instead
    #[arg(long, conflicts_with = "by")]
    pub limbs: bool,
    /// List the limbs that fit into those of this file, as JSON lines
    #[arg(long = "match", value_name = "FILE", conflicts_with_all = ["limbs", "to", "by"])]
    pub matching: Option<PathBuf>,
    /// Largest distance between a curve and the polyline drawn for it, in units of the input; by
    /// default 1e-4 of the longer side of the feature's box
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    #[command(flatten)]
    pub common: Common,
}

/// Where branches are cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Cut {
    /// At ends and junctions.
    Branch,
    /// Where the primitive changes, too.
    Primitive,
}

const SMOOTH_HELP: &str = "\
Limbs are removed that stand out of the disk where they grow out of the shape by less than a share of its
radius (prominence=0.1, after Ho and Dyer), or what is below another threshold (--prune, --max-error). The rest of the
boundary stays as it is; arcs close the gaps. `distance` is how far the boundary moved at most.

Formats: geojson, geojsonl, csv, wkt, wkb, rings, dxf. An axis document that is complete may stand for polygons.

Examples:
  medial smooth fixtures/river.geojson -o smooth.geojson
  medial smooth fixtures/river.geojson --prune prominence=0.3 --to wkt

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

/// Arguments of `medial smooth`.
#[derive(Debug, Args)]
pub struct SmoothArgs {
    /// Polygons or axis documents, in any format that --from knows; `-` for standard input
    pub input: PathBuf,
    #[command(flatten)]
    pub target: Target,
    /// Who computes the axis: path_tracing, divide_and_conquer
    #[arg(long, value_name = "NAME", default_value = "path_tracing", value_parser = engine)]
    pub engine: Engine,
    #[command(flatten)]
    pub pruning: Pruning,
    /// Largest distance between an arc and the polyline drawn for it, in units of the input; by
    /// default 1e-4 of the longer side of the feature's box
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    #[command(flatten)]
    pub common: Common,
}

const RECONSTRUCT_HELP: &str = "\
From an axis document, or from polygons by way of their axis. Methods:
  exact      the corners of a complete axis, bit for bit; where something was pruned, arcs of the last disks
  tangents   the polygonal algorithm of Volkmann and St. Clair, from points along the axis; where its rings
             cross themselves, what they wind around
  disks      the union of the disks at those points
`error` is the distance between the new boundary and the old one, where that is known.

Formats: geojson, geojsonl, csv, wkt, wkb, rings, dxf.

Examples:
  medial axis fixtures/river.geojson --to json | medial reconstruct - --from json --to wkt
  medial reconstruct fixtures/river.geojson --method tangents --step 1 -o river.wkt
  medial reconstruct fixtures/river.geojson --max-error 2 -o pruned.geojson

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

/// Arguments of `medial reconstruct`.
#[derive(Debug, Args)]
pub struct ReconstructArgs {
    /// Axis documents, or polygons in any format; `-` for standard input
    pub input: PathBuf,
    #[command(flatten)]
    pub target: Target,
    /// Who computes the axis of polygons: path_tracing, divide_and_conquer
    #[arg(long, value_name = "NAME", default_value = "path_tracing", value_parser = engine)]
    pub engine: Engine,
    #[command(flatten)]
    pub pruning: Pruning,
    /// How polygons are made of an axis
    #[arg(long, value_name = "NAME", default_value = "exact")]
    pub method: Method,
    /// Distance of points along the axis (tangents, disks), in units of the input; by default 1e-2 of
    /// the longer side of the feature's box
    #[arg(long, value_name = "D", value_parser = positive, allow_negative_numbers = true)]
    pub step: Option<f64>,
    /// Largest distance between an arc and the polyline drawn for it, in units of the input; by
    /// default 1e-4 of the longer side of the feature's box
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    #[command(flatten)]
    pub common: Common,
}

/// How polygons are made of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Method {
    /// Its corners, and arcs.
    Exact,
    /// Tangents of disks.
    Tangents,
    /// The union of disks.
    Disks,
}

impl Method {
    pub fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Tangents => "tangents",
            Self::Disks => "disks",
        }
    }
}

const CENTERLINE_HELP: &str = "\
The longest line runs through the axis between the two ends that are farthest apart, by the shortest way
between them; corners blunter than some 84 degrees are no ends. Around holes it takes the shorter side; a
ring without ends has one closed line. A line for a label stays where a text of --height fits, and loses
that height in length for each radian by which it turns. Further lines (--count) use no part of those
before. A line between points runs between the points of the axis nearest to them.

A smoothed or simplified line is nowhere farther than the tolerance from the exact one, nor the exact one
from it, and stays inside; of both the tolerances add up. Widths are those at its own points.

Examples:
  medial centerline fixtures/river.geojson -o river.line.geojson
  medial centerline fixtures/river.geojson --count 3 --extend boundary --tolerance 0.1
  medial centerline fixtures/river.geojson --smooth 0.2 --simplify 0.01 -o river.svg
  medial centerline fixtures/shapes/plus_of_unit_squares.wkt --max-error 0.2 --z radius --to wkt
  medial centerline fixtures/shapes/l_with_unit_arms.wkt --for label --height 0.5 --to csv
  medial centerline fixtures/shapes/l_with_unit_arms.wkt --between 0.5,3,3,0.5 --extend anchors

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

/// Arguments of `medial centerline`.
#[derive(Debug, Args)]
#[command(after_help = CENTERLINE_HELP)]
pub struct CenterlineArgs {
    /// Polygons in any format that --from knows; `-` for standard input
    pub input: PathBuf,
    /// File to write; by default, and for `-`, standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Format of the output: geojson, geojsonl, wkt, csv, svg, dxf; by default that of the extension, on
    /// standard output geojson
    #[arg(long, value_name = "FORMAT")]
    pub to: Option<Format>,
    /// Who computes the axis: path_tracing, divide_and_conquer
    #[arg(long, value_name = "NAME", default_value = "path_tracing", value_parser = engine)]
    pub engine: Engine,
    /// What the line is for: the longest one, or the best for a label, long, straight and wide
    #[arg(long = "for", value_name = "WHAT", default_value = "longest")]
    pub purpose: Purpose,
    /// Height of the text of a label, in units of the input; by default half of the greatest width of
    /// the feature
    #[arg(long, value_name = "H", value_parser = positive, allow_negative_numbers = true)]
    pub height: Option<f64>,
    /// How many lines of each feature, at most
    #[arg(long, value_name = "N", default_value = "1", value_parser = count)]
    pub count: NonZeroUsize,
    /// Two points between which the line runs
    #[arg(long, value_name = "X1,Y1,X2,Y2", value_parser = two_points, allow_hyphen_values = true,
          conflicts_with_all = ["anchor", "count", "purpose"])]
    pub between: Option<[Point; 2]>,
    /// A point to which the line runs, to be given several times: of more than two those farthest
    /// apart along the axis
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true,
          conflicts_with_all = ["count", "purpose"])]
    pub anchor: Vec<Point>,
    /// How far lines go on straight beyond the axis; anchors: to the points of --between or --anchor
    #[arg(long, value_name = "WHERE", default_value = "none")]
    pub extend: Extend,
    #[command(flatten)]
    pub pruning: Pruning,
    /// Largest distance between a curve and the polyline drawn for it, in units of the input; by
    /// default 1e-4 of the longer side of the feature's box
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    /// Write a smooth line no farther than this from the exact one, in units of the input
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    pub smooth: Option<f64>,
    /// Write a line with few points, no farther than this from the exact, or the smooth, one, in units
    /// of the input
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    pub simplify: Option<f64>,
    /// Write the radius as third coordinate (geojson, geojsonl, wkt, csv, dxf)
    #[arg(long, value_name = "VALUE")]
    pub z: Option<Height>,
    #[command(flatten)]
    pub common: Common,
}

/// What a centerline is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Purpose {
    /// The longest one.
    Longest,
    /// Long, straight, and wide enough for a text.
    Label,
}

/// How far a centerline goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Extend {
    /// Not beyond the axis.
    None,
    /// Up to the boundary.
    Boundary,
    /// To the points that are given.
    Anchors,
}

const VORONOI_HELP: &str = "\
Examples:
  medial voronoi fixtures/shapes/l_with_unit_arms.wkt -o l.svg
  medial voronoi fixtures/river.geojson --tolerance 0.1 -o cells.geojson
  medial voronoi fixtures/river.geojson --to json > river.voronoi.json
  medial voronoi fixtures/shapes/l_with_unit_arms.wkt --side both -o both.svg

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

/// Arguments of `medial voronoi`.
#[derive(Debug, Args)]
#[command(after_help = VORONOI_HELP)]
pub struct VoronoiArgs {
    /// Polygons in any format that --from knows; `-` for standard input
    pub input: PathBuf,
    /// File to write; by default, and for `-`, standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Format of the output: geojson, geojsonl, json (Voronoi document), svg; by default that of
    /// the extension, on standard output geojson
    #[arg(long, value_name = "FORMAT")]
    pub to: Option<Format>,
    /// Who computes the axes: path_tracing, divide_and_conquer
    #[arg(long, value_name = "NAME", default_value = "path_tracing", value_parser = engine)]
    pub engine: Engine,
    #[command(flatten)]
    pub region: Region,
    /// Largest distance between a curve and the polyline drawn for it, in units of the input
    /// (geojson, geojsonl); by default 1e-4 of the longer side of the feature's box
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    #[command(flatten)]
    pub common: Common,
}

const LOCATE_HELP: &str = "\
Examples:
  medial locate 2 0.75 fixtures/shapes/l_with_unit_arms.wkt
  medial locate -1 2 fixtures/river.geojson -o nearest.json

The result is JSON, one line for each feature: the side of the boundary on which the point lies, its
distance, and all nearest elements with their footpoints.

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

/// Arguments of `medial locate`.
#[derive(Debug, Args)]
#[command(after_help = LOCATE_HELP)]
pub struct LocateArgs {
    /// Abscissa of the point, in units of the input
    #[arg(value_parser = coordinate, allow_negative_numbers = true)]
    pub x: f64,
    /// Ordinate of the point, in units of the input
    #[arg(value_parser = coordinate, allow_negative_numbers = true)]
    pub y: f64,
    /// Polygons in any format that --from knows; `-` for standard input
    pub input: PathBuf,
    /// File to write; by default, and for `-`, standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub flattening: Flattening,
    #[command(flatten)]
    pub common: Common,
}

const CHECK_HELP: &str = "\
Examples:
  medial check fixtures/shapes/l_with_unit_arms.wkt fixtures/l_with_unit_arms.axis.json
  medial axis fixtures/river.geojson --to json | medial check fixtures/river.geojson - --to json

Exit status: 0 no defect; 1 no usable result; 2 wrong usage; 3 some features were left out;
4 there are defects.";

/// Arguments of `medial check`.
#[derive(Debug, Args)]
#[command(after_help = CHECK_HELP)]
pub struct CheckArgs {
    /// Polygons in any format that --from knows; `-` for standard input
    pub domain: PathBuf,
    /// Axis document of these polygons; `-` for standard input
    pub axis: PathBuf,
    /// File to write; by default, and for `-`, standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Form of the result: text, or json with one line for each feature
    #[arg(long, value_name = "FORM", default_value = "text")]
    pub to: Form,
    #[command(flatten)]
    pub flattening: Flattening,
    #[command(flatten)]
    pub common: Common,
}

const COMPARE_HELP: &str = "\
Features and engines take turns, so that times are those of an engine alone: on one thread, unless
--threads gives it more. The first exact engine that gives an axis of a feature is the reference of
the others.

Examples:
  medial compare fixtures/river.geojson --to text
  medial compare fixtures/river.geojson -o river.csv --report report.json
  medial compare fixtures/shapes/l_with_unit_arms.wkt --side both --to text
  medial compare - --engine divide_and_conquer < fixtures/shapes/l_with_unit_arms.wkt

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

/// Arguments of `medial compare`.
#[derive(Debug, Args)]
#[command(after_help = COMPARE_HELP)]
pub struct CompareArgs {
    /// Polygons in any format that --from knows; `-` for standard input
    pub input: PathBuf,
    /// File to write; by default, and for `-`, standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Form of the result, a row for each feature, side and engine: json (lines), csv, or text for
    /// people; by default that of the extension (.csv, .txt), else json
    #[arg(long, value_name = "FORM")]
    pub to: Option<Rows>,
    /// Engines to compare, separated by commas: path_tracing, divide_and_conquer, raster_transform,
    /// ridge_following, brushfire; by default all that know the side
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = engine)]
    pub engine: Vec<Engine>,
    /// The size of cells of engines that sample, in units of the input; by default a thousandth of the longer
    /// side of the feature's box
    #[arg(long, value_name = "SIZE", value_parser = positive, allow_negative_numbers = true)]
    pub cell: Option<f64>,
    #[command(flatten)]
    pub region: Region,
    #[command(flatten)]
    pub flattening: Flattening,
    #[command(flatten)]
    pub common: Common,
}

const COMPRESS_HELP: &str = "\
Each feature becomes disks on a grid, with what is linear between them; the boundary of their union and
that of the polygons are within V of one another. Features whose corners take fewer bytes, and all with
V = 0, keep their corners bit for bit: the exact axis follows from them.

With -o the standard output tells the bytes of each feature, as if it were alone in a file, and of all:
as maxis, as WKB, and as WKB deflated.

Examples:
  medial compress fixtures/river.geojson --max-error 1 -o river.maxis --sizes text
  medial compress fixtures/river.geojson --max-error 0 -o river.maxis
  medial compress fixtures/lake.rings --max-error 5 --simplify -o lake.maxis
  medial compress - --max-error 0.01 < fixtures/shapes/l_with_unit_arms.wkt > l.maxis

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

/// Arguments of `medial compress`.
#[derive(Debug, Args)]
#[command(after_help = COMPRESS_HELP)]
pub struct CompressArgs {
    /// Polygons in any format that --from knows; `-` for standard input
    pub input: PathBuf,
    /// File to write (maxis); by default, and for `-`, standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// How far the boundary may move, in units of the input; 0 keeps every corner
    #[arg(long, value_name = "V", value_parser = not_negative, allow_negative_numbers = true)]
    pub max_error: f64,
    /// Keep simplified corners, within the same error, where they take fewer bytes than disks: the axis
    /// is then that of the simplified polygon
    #[arg(long)]
    pub simplify: bool,
    /// Who computes the axis: path_tracing, divide_and_conquer
    #[arg(long, value_name = "NAME", default_value = "path_tracing", value_parser = engine)]
    pub engine: Engine,
    /// Form of the sizes, a row for each feature and one for all: json (lines), csv, or text for people
    #[arg(long, value_name = "FORM", default_value = "json")]
    pub sizes: Rows,
    #[command(flatten)]
    pub flattening: Flattening,
    #[command(flatten)]
    pub common: Common,
}

/// What is removed from axes.
#[derive(Debug, Args)]
pub struct Pruning {
    /// Remove what lies below this value of a measure, from the leaves inwards: excess,
    /// relative_excess, prominence, potential, chord, circularity, erosion, length, angle,
    /// half_chord, radius, scale
    ///
    /// Images are pruned by chord=2 cells if nothing else is said; `none` keeps what their disks need to be
    /// the image again
    #[arg(long, value_name = "MEASURE=VALUE", value_parser = prune, conflicts_with = "max_error")]
    pub prune: Option<Prune>,
    /// Remove branches for as long as the boundary moves by less than this, in units of the input:
    /// short for --prune excess=V
    #[arg(long, value_name = "V", value_parser = not_negative, allow_negative_numbers = true)]
    pub max_error: Option<f64>,
    /// Keep what the axis of flattened curves has that the axis of the curves has not
    #[arg(long)]
    pub keep_artefacts: bool,
}

impl Pruning {
    /// Whether anything may go of what an engine found for a feature.
    pub fn removes(&self, feature: &Feature, engine: Engine) -> bool {
        let curves = feature.curves.is_some() && engine.is_exact() && !self.keep_artefacts;
        self.left_to(engine).is_some() || curves
    }

    /// What is left of the axis of an engine, if anything may go.
    pub fn rest(
        &self,
        feature: &Feature,
        engine: Engine,
        hierarchy: &Hierarchy<'_>,
    ) -> Option<Pruned> {
        match (&feature.curves, self.left_to(engine)) {
            (Some(curves), threshold) if engine.is_exact() && !self.keep_artefacts => {
                Some(hierarchy.without_artefacts(&feature.polygons, curves, threshold))
            }
            (_, threshold) => threshold.map(|(measure, value)| hierarchy.pruned(measure, value)),
        }
    }

    /// The measure and the value below which points are removed, if any are.
    pub fn threshold(&self) -> Option<(Measure, f64)> {
        match self.prune {
            Some(Prune::Below(measure, value)) => Some((measure, value)),
            Some(Prune::Nothing) => None,
            None => self.max_error.map(|error| (Measure::Excess, error)),
        }
    }

    /// The same without what an engine sees to by itself.
    fn left_to(&self, engine: Engine) -> Option<(Measure, f64)> {
        self.threshold().filter(|&(measure, _)| engine.is_exact() || measure != Measure::Chord)
    }

    /// The chord residual, in cells of that size, that an engine on cells prunes by; the rest of pruning is
    /// done by [`rest`](Self::rest).
    pub fn residual(&self, cell: f64) -> Option<f64> {
        match self.prune {
            Some(Prune::Nothing) => None,
            Some(Prune::Below(Measure::Chord, value)) => Some(value / cell),
            _ => engine::Options::default().residual,
        }
    }
}

/// What `--prune` says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Prune {
    /// Remove nothing.
    Nothing,
    /// Remove what lies below a value of a measure.
    Below(Measure, f64),
}

/// Who computes an axis, for commands that know sampled ones.
#[derive(Debug, Args)]
pub struct ChosenEngine {
    /// Who computes the axis: path_tracing, divide_and_conquer, raster_transform, ridge_following,
    /// brushfire; by default path_tracing for polygons, raster_transform for images
    #[arg(long, value_name = "NAME", value_parser = engine)]
    pub engine: Option<Engine>,
    /// The size of cells into which polygons are put by engines that sample, in units of the input; by
    /// default a thousandth of the longer side of the feature's box
    #[arg(long, value_name = "SIZE", value_parser = positive, allow_negative_numbers = true)]
    pub cell: Option<f64>,
    /// How ridge_following finds the two nearest elements: tree, sorted (as in the report), six_vertices (which
    /// may miss one)
    #[arg(long, value_name = "NAME", value_parser = named::<RidgeSearch>)]
    pub search: Option<RidgeSearch>,
    /// How ridge_following thins: queue (worst first), report, five_by_five, full (not at all)
    #[arg(long, value_name = "NAME", value_parser = named::<RidgeThinning>)]
    pub thinning: Option<RidgeThinning>,
    /// How brushfire burns: sequential, alternating, marking, isotropic, zhang_suen, guo_hall, hilditch; by
    /// default isotropic
    #[arg(long, value_name = "NAME", value_parser = named::<Burning>)]
    pub burning: Option<Burning>,
}

fn named<T: FromStr<Err = UnknownName>>(word: &str) -> Result<T, String> {
    word.parse().map_err(|error: UnknownName| error.to_string())
}

impl ChosenEngine {
    /// Fails if something is said to an engine that another one would listen to.
    pub fn check(&self) -> Result<(), Failure> {
        let others: [(&str, bool, Engine); 3] = [
            ("--search", self.search.is_some(), Engine::RidgeFollowing),
            ("--thinning", self.thinning.is_some(), Engine::RidgeFollowing),
            ("--burning", self.burning.is_some(), Engine::Brushfire),
        ];
        let wrong = others.iter().find(|(_, said, engine)| *said && self.engine != Some(*engine));
        match wrong {
            Some((option, _, engine)) => {
                Err(Failure::Usage(format!("{option} is for --engine {engine}")))
            }
            None => Ok(()),
        }
    }

    /// The engine for a feature.
    pub fn of(&self, feature: &Feature) -> Engine {
        engine_for(feature, self.engine)
    }
}

/// The engine that was asked for, else the usual one for polygons or images.
pub fn engine_for(feature: &Feature, asked: Option<Engine>) -> Engine {
    let usual = match feature.mask {
        Some(_) => Engine::RasterTransform,
        None => Engine::PathTracing,
    };
    asked.unwrap_or(usual)
}

/// Where axes are computed.
#[derive(Debug, Args)]
pub struct Region {
    /// Side of the boundary: exterior is the complement of all polygons of a feature, holes included;
    /// both writes two results for each feature, the interior first
    #[arg(long, value_name = "SIDE", default_value = "interior")]
    pub side: Sides,
    /// How far from the box of a feature its exterior axis is cut off, in units of the input; by
    /// default the longer side of the box
    #[arg(long, value_name = "F", value_parser = positive, allow_negative_numbers = true)]
    pub frame: Option<f64>,
}

impl Region {
    /// Fails if a frame is given that nothing is cut at.
    pub fn check(&self) -> Result<(), Failure> {
        if self.frame.is_some() && self.side == Sides::Interior {
            return Err(Failure::Usage("--frame is for --side exterior and both".to_owned()));
        }
        Ok(())
    }
}

/// How curves are read, for commands that draw none.
#[derive(Debug, Args)]
pub struct Flattening {
    /// Largest distance between a curve of a drawing or a font and the edges read for it, in units of
    /// the input; by default 1e-4 of the longer side of the feature's box
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
}

/// Arguments of every command that reads polygons.
#[derive(Debug, Args)]
pub struct Common {
    /// Format of the polygons: geojson, geojsonl, wkt, wkb, rings, gpkg, shp, fgb, parquet, svg, dxf,
    /// ttf, png, tiff; by default that of the extension, else told by the content
    #[arg(long, value_name = "FORMAT")]
    pub from: Option<Format>,
    /// Layer to read, of a GeoPackage or a drawing with several
    #[arg(long, value_name = "NAME")]
    pub layer: Option<String>,
    /// Read the glyphs of this text from a font; by default all its glyphs
    #[arg(long, value_name = "STRING")]
    pub text: Option<String>,
    /// A font for the text of drawings (svg), to be given several times; by default those of the system
    #[arg(long, value_name = "FILE")]
    pub font: Vec<PathBuf>,
    /// Cells of an image (png, tiff) whose value is above T belong to the shape; by default the middle
    /// between its least and its greatest value
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    pub threshold: Option<f64>,
    /// Take the cells of an image that are not above the threshold for the shape
    #[arg(long)]
    pub invert: bool,
    /// Take coordinates for degrees of longitude and latitude and measure in metres, by the cosine of
    /// the latitude in the middle of each feature; GeoJSON and tables have degrees again
    #[arg(long)]
    pub metric: bool,
    /// Refuse what would be repaired
    #[arg(long)]
    pub strict: bool,
    /// Find out which rings are holes by their depth, whatever their place
    #[arg(long)]
    pub regroup: bool,
    /// Which points the rings of a polygon enclose where they cross or are nested in any way:
    /// even-odd, nonzero; by default what the format says, else even-odd
    #[arg(long, value_name = "RULE")]
    pub fill: Option<Fill>,
    /// Unite the polygons of each feature where they overlap or share an edge
    #[arg(long)]
    pub dissolve: bool,
    /// Leave out features with more vertices
    #[arg(long, value_name = "N")]
    pub max_vertices: Option<usize>,
    /// Leave out features whose domain and axes take longer, in seconds
    #[arg(long, value_name = "S", value_parser = positive, allow_negative_numbers = true)]
    pub max_seconds: Option<f64>,
    /// What to do about a bad feature
    #[arg(long, value_name = "WHAT", default_value = "skip")]
    pub on_error: OnError,
    /// Number of threads; by default one for each processor
    #[arg(long, value_name = "N")]
    pub threads: Option<NonZeroUsize>,
    /// Write to FILE, as JSON, what was repaired, dropped or refused
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// Write to FILE, as JSON, how long each stage took
    #[arg(long, value_name = "FILE")]
    pub timings: Option<PathBuf>,
    /// Show the progress on standard error; auto: on a terminal
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    pub progress: When,
    /// Print errors only, no warnings
    #[arg(short, long)]
    pub quiet: bool,
}

impl Common {
    /// How to make a domain of a feature, whose format has a fill rule.
    pub fn domain_options(&self, fill: FillRule) -> domain::Options {
        domain::Options {
            strict: self.strict,
            regroup: self.regroup,
            repair: !self.strict,
            fill: self.fill.map_or(fill, FillRule::from),
            dissolve: self.dissolve,
            deadline: self.deadline(),
        }
    }

    /// When a feature that is begun now must be done.
    pub fn deadline(&self) -> Option<Instant> {
        let limit = Duration::try_from_secs_f64(self.max_seconds?).ok()?;
        Instant::now().checked_add(limit)
    }
}

/// Names of fill rules.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Fill {
    /// Those that the rings go around an odd number of times.
    EvenOdd,
    /// Those that they go around, more often one way than the other.
    Nonzero,
}

impl From<Fill> for FillRule {
    fn from(fill: Fill) -> Self {
        match fill {
            Fill::EvenOdd => Self::EvenOdd,
            Fill::Nonzero => Self::NonZero,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Sides {
    /// Inside the polygons.
    Interior,
    /// Outside of them.
    Exterior,
    /// Inside, then outside.
    Both,
}

impl Sides {
    /// The sides in the order in which they are written.
    pub fn all(self) -> &'static [Side] {
        match self {
            Self::Interior => &[Side::Interior],
            Self::Exterior => &[Side::Exterior],
            Self::Both => &[Side::Interior, Side::Exterior],
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Height {
    /// The radius of the maximal disk.
    Radius,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Form {
    Text,
    Json,
}

/// A table for programs or for people.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Rows {
    Json,
    Csv,
    Text,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum OnError {
    /// Leave it out and go on.
    Skip,
    /// Stop without a result.
    Stop,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum When {
    /// If standard error is a terminal.
    Auto,
    Always,
    Never,
}

/// The command line, understood; help and errors are told in one line or as asked for.
pub fn parse() -> Result<Command, Failure> {
    Cli::try_parse().map(|cli| cli.command).map_err(|error| match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => match error.print() {
            Ok(()) => Failure::Told(Status::Done),
            Err(error) => Failure::write("<stdout>", &error),
        },
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            Failure::Usage("a command is missing; see `medial --help`".to_owned())
        }
        _ => Failure::Usage(one_line(&error.to_string())),
    })
}

/// The message of the parser without its usage lines, as one line.
fn one_line(text: &str) -> String {
    let text = text.strip_prefix("error: ").unwrap_or(text);
    let parts = text
        .split("\n\n")
        .map(str::trim)
        .filter(|part| !part.starts_with("Usage:") && !part.starts_with("For more information"))
        .map(|part| part.split_whitespace().collect::<Vec<_>>().join(" "));
    let said = parts.filter(|part| !part.is_empty()).collect::<Vec<_>>().join("; ");
    format!("{said}; see --help")
}

fn engine(word: &str) -> Result<Engine, String> {
    const LATER: [&str; 1] = ["delaunay_dual"];
    if LATER.contains(&word.replace('-', "_").as_str()) {
        return Err(format!("this build has no engine {word} yet; use path_tracing"));
    }
    word.parse().map_err(|error: medial::axis::UnknownName| error.to_string())
}

fn extra(word: &str) -> Result<Extra, String> {
    let found = Extra::NAMES.iter().find(|(name, _)| *name == word);
    found.map(|(_, extra)| *extra).ok_or_else(|| {
        let known = Extra::NAMES.map(|(name, _)| name).join(", ");
        format!("known are {known}")
    })
}

fn positive(word: &str) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(value) if value.is_finite() && value > 0.0 => Ok(value),
        _ => Err("a positive number is needed".to_owned()),
    }
}

fn not_negative(word: &str) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(value) if value >= 0.0 && value.is_finite() => Ok(value),
        _ => Err("a number that is not negative is needed".to_owned()),
    }
}

fn count(word: &str) -> Result<NonZeroUsize, String> {
    word.parse().map_err(|_| "a whole number from 1 on is needed".to_owned())
}

fn measure(word: &str) -> Result<Measure, String> {
    word.parse().map_err(|error: medial::axis::UnknownName| error.to_string())
}

fn prune(word: &str) -> Result<Prune, String> {
    if word == "none" {
        return Ok(Prune::Nothing);
    }
    threshold(word).map(|(measure, value)| Prune::Below(measure, value))
}

fn threshold(word: &str) -> Result<(Measure, f64), String> {
    let (name, value) = word.split_once('=').ok_or("MEASURE=VALUE is needed, as excess=2.5")?;
    Ok((measure(name)?, not_negative(value)?))
}

fn point(word: &str) -> Result<Point, String> {
    match coordinates(word)?[..] {
        [x, y] => Ok(Point::new(x, y)),
        _ => Err("X,Y is needed, as 3.5,-2".to_owned()),
    }
}

fn two_points(word: &str) -> Result<[Point; 2], String> {
    match coordinates(word)?[..] {
        [x1, y1, x2, y2] => Ok([Point::new(x1, y1), Point::new(x2, y2)]),
        _ => Err("X1,Y1,X2,Y2 is needed, as 0,1,3.5,-2".to_owned()),
    }
}

fn coordinates(word: &str) -> Result<Vec<f64>, String> {
    word.split(',').map(|word| coordinate(word.trim())).collect()
}

fn coordinate(word: &str) -> Result<f64, String> {
    let range = 2.0_f64.powi(-200)..=2.0_f64.powi(200);
    let fits = |value: f64| value == 0.0 || range.contains(&value.abs());
    match word.parse::<f64>() {
        Ok(value) if fits(value) => Ok(value),
        Ok(value) if value.is_finite() => {
            Err("it must be 0 or between 2^-200 and 2^200 in magnitude".to_owned())
        }
        _ => Err("a finite number is needed".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory as _;

    #[test]
    fn the_arguments_are_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn a_message_of_the_parser_becomes_one_line() {
        let error = Cli::try_parse_from(["medial", "axis"]).unwrap_err();
        let told = one_line(&error.to_string());
        let expected = "the following required arguments were not provided: <INPUT>; see --help";
        assert_eq!(told, expected);
    }

    #[test]
    fn engines_take_hyphens() {
        assert_eq!(engine("path-tracing"), Ok(Engine::PathTracing));
        assert!(engine("delaunay_dual").unwrap_err().contains("use path_tracing"));
    }
}
