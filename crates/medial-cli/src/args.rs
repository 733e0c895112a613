use crate::failure::{Failure, Status};
use clap::error::ErrorKind;
use clap::{Args, Parser, Subcommand, ValueEnum};
use medial::axis::{Engine, Side};
use medial::geom::Point;
use medial::ops::Measure;
use medial_io::Format;
use medial_io::svg::Extra;
use std::num::NonZeroUsize;
use std::path::PathBuf;

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
    /// Compute the main line of polygons, or the longest few, with widths
    Centerline(CenterlineArgs),
    /// Compute the Voronoi diagram of the boundary elements of polygons
    Voronoi(VoronoiArgs),
    /// Find what of the boundary of polygons is nearest to a point
    Locate(LocateArgs),
    /// Find every defect of an axis document
    Check(CheckArgs),
    /// Run every engine on the same polygons
    Compare(CompareArgs),
}

const AXIS_HELP: &str = "\
Examples:
  medial axis fixtures/river.geojson -o river.svg
  medial axis fixtures/river.geojson -o river.png --draw disks
  medial axis fixtures/river.geojson -o river.axis.json
  medial axis fixtures/river.geojson -o river.csv --report report.json --timings timings.json
  medial axis fixtures/shapes/plus_of_unit_squares.wkt --keypoints --z radius -o plus.geojson
  medial axis - --to wkt < fixtures/shapes/l_with_unit_arms.wkt
  medial axis fixtures/shapes/l_with_unit_arms.wkt --side both --frame 2 -o l.svg

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

const PRUNE_HELP: &str = "\
Points of the axis below a value of a measure are removed, from the leaves inwards, so components and
cycles stay; paths are cut where the value is reached. Measures, in units of the input but for those of the
last line:
  excess        how far the boundary moves if a disk takes the place of what is removed
  potential, chord, circularity
                boundary that is cut off; less its chord; less the arc of the disk that faces it
  erosion, length
                burn time less radius; the longest way to a leaf
  half_chord, radius
                half the distance of the footpoints, the radius: both may keep more than lies above
  relative_excess, angle
                excess as a share of the radius; the angle between footpoints in radians (may keep more)

Examples:
  medial prune fixtures/river.geojson --max-error 2 -o river.svg
  medial prune fixtures/river.geojson --prune relative_excess=0.1 -o river.geojson
  medial prune fixtures/river.geojson --prune erosion=1.5 --to json > river.axis.json

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

/// Arguments of `medial axis` and `medial prune`.
#[derive(Debug, Args)]
#[command(after_help = AXIS_HELP)]
pub struct AxisArgs {
    /// Polygons: GeoJSON, GeoJSON lines, WKT, WKB or rings; `-` for standard input
    pub input: PathBuf,
    /// File to write; by default, and for `-`, standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Format of the output: geojson, geojsonl, json (axis document), wkt, wkb, csv, svg, png;
    /// by
    /// default that of the extension, on standard output geojson
    #[arg(long, value_name = "FORMAT")]
    pub to: Option<Format>,
    /// Who computes the axis: path_tracing, divide_and_conquer
    #[arg(long, value_name = "NAME", default_value = "path_tracing", value_parser = engine)]
    pub engine: Engine,
    #[command(flatten)]
    pub region: Region,
    #[command(flatten)]
    pub pruning: Pruning,
    /// Largest distance between a curve and the polyline drawn for it, in units of the input; by
    /// default 1e-4 of the longer side of the feature's box
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    /// Write keypoints too (geojson, geojsonl, wkt, wkb; pictures and axis documents have them)
    #[arg(long)]
    pub keypoints: bool,
    /// Write the radius as third coordinate (geojson, geojsonl, wkt, wkb, csv)
    #[arg(long, value_name = "VALUE")]
    pub z: Option<Height>,
    /// What a picture shows besides, separated by commas: disks, footpoints, cells, zones,
    /// governors
    #[arg(long, value_name = "WHAT", value_delimiter = ',', value_parser = extra)]
    pub draw: Vec<Extra>,
    #[command(flatten)]
    pub common: Common,
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
    /// Polygons: GeoJSON, GeoJSON lines, WKT, WKB or rings; `-` for standard input
    pub input: PathBuf,
    /// File to write; by default, and for `-`, standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Format of the output: geojson, geojsonl, wkt, csv, svg; by default that of the extension, on
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
    /// Write the radius as third coordinate (geojson, geojsonl, wkt, csv)
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
    /// Polygons: GeoJSON, GeoJSON lines, WKT, WKB or rings; `-` for standard input
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
    /// Polygons: GeoJSON, GeoJSON lines, WKT, WKB or rings; `-` for standard input
    pub input: PathBuf,
    /// File to write; by default, and for `-`, standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
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
    /// Polygons: GeoJSON, GeoJSON lines, WKT, WKB or rings; `-` for standard input
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
    /// Polygons: GeoJSON, GeoJSON lines, WKT, WKB or rings; `-` for standard input
    pub input: PathBuf,
    /// File to write; by default, and for `-`, standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Form of the result, a row for each feature, side and engine: json (lines), csv, or text for
    /// people; by default that of the extension (.csv, .txt), else json
    #[arg(long, value_name = "FORM")]
    pub to: Option<Rows>,
    /// Engines to compare, separated by commas; by default all: path_tracing, divide_and_conquer
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = engine,
          default_values_t = Engine::ALL.to_vec(), hide_default_value = true)]
    pub engine: Vec<Engine>,
    #[command(flatten)]
    pub region: Region,
    #[command(flatten)]
    pub common: Common,
}

/// What is removed from axes.
#[derive(Debug, Args)]
pub struct Pruning {
    /// Remove what lies below this value of a measure, from the leaves inwards: excess,
    /// relative_excess, potential, chord, circularity, erosion, length, angle, half_chord, radius
    #[arg(long, value_name = "MEASURE=VALUE", value_parser = threshold,
          conflicts_with = "max_error")]
    pub prune: Option<(Measure, f64)>,
    /// Remove branches for as long as the boundary moves by less than this, in units of the input:
    /// short for --prune excess=V
    #[arg(long, value_name = "V", value_parser = not_negative, allow_negative_numbers = true)]
    pub max_error: Option<f64>,
}

impl Pruning {
    /// The measure and the value below which points are removed, if any are.
    pub fn threshold(&self) -> Option<(Measure, f64)> {
        self.prune.or(self.max_error.map(|error| (Measure::Excess, error)))
    }
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

/// Arguments of every command that reads polygons.
#[derive(Debug, Args)]
pub struct Common {
    /// Format of the polygons: geojson, geojsonl, wkt, wkb, rings; by default that of the
    /// extension, else told by the content
    #[arg(long, value_name = "FORMAT")]
    pub from: Option<Format>,
    /// Refuse what would be repaired
    #[arg(long)]
    pub strict: bool,
    /// Find out which rings are holes by their depth, whatever their place
    #[arg(long)]
    pub regroup: bool,
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
    const LATER: [&str; 4] = ["delaunay_dual", "ridge_following", "brushfire", "raster_transform"];
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
        Ok(value) if value >= 0.0 => Ok(value),
        _ => Err("a number that is not negative is needed".to_owned()),
    }
}

fn count(word: &str) -> Result<NonZeroUsize, String> {
    word.parse().map_err(|_| "a whole number from 1 on is needed".to_owned())
}

fn threshold(word: &str) -> Result<(Measure, f64), String> {
    let (name, value) = word.split_once('=').ok_or("MEASURE=VALUE is needed, as excess=2.5")?;
    let measure = name.parse().map_err(|error: medial::axis::UnknownName| error.to_string())?;
    Ok((measure, not_negative(value)?))
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
        assert!(engine("brushfire").unwrap_err().contains("use path_tracing"));
    }
}
