use super::{ChosenEngine, Common, Height, Pruning, Region, extra, measure, positive};
use clap::{Args, ValueEnum};
use medial::ops::Measure;
use medial_io::Format;
use medial_io::svg::Extra;
use std::path::PathBuf;

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

pub(super) const PRUNE_HELP: &str = "\
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
