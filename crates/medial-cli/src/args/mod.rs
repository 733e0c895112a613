mod axis;
mod carve;
mod centerline;
mod clearance;
mod compress;
mod engine;
mod image;
mod offset;
mod pruning;
mod run;
mod segment;
mod walls;

pub use axis::{AxisArgs, Line};
pub use carve::{CarveArgs, Units};
pub use centerline::{CenterlineArgs, Extend, Purpose};
pub use clearance::ClearanceArgs;
pub use compress::CompressArgs;
pub use engine::{ChosenEngine, engine_for};
pub use image::{Choice, ImageArgs, Layer as ImageLayer};
pub use offset::OffsetArgs;
pub use pruning::{Prune, Pruning};
pub use run::{OnError, RunOptions, When};
pub use segment::{ImageRun, Method as SegmentMethod, SegmentArgs, Segmentation, colour};
pub use walls::WallsArgs;

use crate::failure::{Failure, Status};
use axis::PRUNE_HELP;
use clap::error::ErrorKind;
use clap::{Args, Parser, Subcommand, ValueEnum};
use engine::engine;
use medial::axis::{Engine, Side, UnknownName};
use medial::domain::{self, FillRule};
use medial::geom::Point;
use medial::ops::Measure;
use medial_io::Format;
use medial_io::svg::Extra;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::str::FromStr;
use std::time::Instant;

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
    /// Write polygons or images as few disks of their axes, within an error, or without any
    Compress(CompressArgs),
    /// Part colour images into regions, as polygons
    Segment(SegmentArgs),
    /// Compute borders, Delaunay graphs, their duals and the medial axes of regions of colour images, or what
    /// became of regions
    Image(Box<ImageArgs>),
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
Compressed images come back as they were compressed, as their outline or as an image (png).

Formats: geojson, geojsonl, csv, wkt, wkb, rings, dxf; png for compressed images.

Examples:
  medial axis fixtures/river.geojson --to json | medial reconstruct - --from json --to wkt
  medial reconstruct fixtures/river.geojson --method tangents --step 1 -o river.wkt
  medial reconstruct fixtures/river.geojson --max-error 2 -o pruned.geojson
  medial compress fixtures/images/horse.png --invert -o horse.maxis && medial reconstruct horse.maxis -o horse.png

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
    /// ridge_following, brushfire, delaunay_dual; by default all that know the side
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = engine)]
    pub engine: Vec<Engine>,
    /// The size of cells of engines that sample, in units of the input; by default a thousandth of the longer
    /// side of the feature's box
    #[arg(long, value_name = "SIZE", value_parser = positive, allow_negative_numbers = true)]
    pub cell: Option<f64>,
    /// The largest distance between samples of delaunay_dual, in units of the input; by default a thousandth of the
    /// longer side of the feature's box
    #[arg(long, value_name = "D", value_parser = positive, allow_negative_numbers = true)]
    pub spacing: Option<f64>,
    #[command(flatten)]
    pub region: Region,
    #[command(flatten)]
    pub flattening: Flattening,
    #[command(flatten)]
    pub common: Common,
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
    #[arg(long, value_name = "T", value_parser = finite, allow_negative_numbers = true)]
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
    #[command(flatten)]
    pub run: RunOptions,
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
        Instant::now().checked_add(self.run.limit()?)
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

fn named<T: FromStr<Err = UnknownName>>(word: &str) -> Result<T, String> {
    word.parse().map_err(|error: UnknownName| error.to_string())
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

fn finite(word: &str) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err("a finite number is needed".to_owned()),
    }
}

fn count(word: &str) -> Result<NonZeroUsize, String> {
    word.parse().map_err(|_| "a whole number from 1 on is needed".to_owned())
}

fn measure(word: &str) -> Result<Measure, String> {
    named(word)
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
        assert_eq!(engine("delaunay-dual"), Ok(Engine::DelaunayDual));
        assert!(engine("straight_skeleton").unwrap_err().contains("path_tracing"));
    }
}
