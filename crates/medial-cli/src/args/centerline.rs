use super::{Common, Height, Pruning, count, engine, point, positive, two_points};
use clap::{Args, ValueEnum};
use medial::axis::Engine;
use medial::geom::Point;
use medial_io::Format;
use std::num::NonZeroUsize;
use std::path::PathBuf;

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
