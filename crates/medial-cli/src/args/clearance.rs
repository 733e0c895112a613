use super::{Common, Region, Target, engine, positive};
use clap::Args;
use medial::axis::Engine;
use std::path::PathBuf;

const CLEARANCE_HELP: &str = "\
A neck is where the axis is nearer to the boundary than anywhere near: inside a place where the polygons are
narrow, outside (--side exterior) a place where two of them, or two parts of one, are near each other. Each
is a line between the two elements, which are named; the narrowest come first. Between parallel edges it
may be as long as a passage, and is drawn in its middle.
All polygons of a feature are one shape; with --together all features are.
Two elements that one tiny edge joins are near without a neck; polygons may have edges shorter than --min.

--profile writes the width along the main line of each feature, the one that medial centerline gives by
default: points so near each other that the width between them is linear within the tolerance.

Formats: geojson, geojsonl, csv, wkt, wkb, dxf; with --profile also svg, a plot.

Examples:
  medial clearance fixtures/river.geojson --min 2 -o narrow.geojson
  medial clearance fixtures/lake.rings --side exterior --min 1 --to csv
  medial clearance fixtures/logo.wkt --side exterior --together --to csv
  medial clearance fixtures/river.geojson --largest --to csv
  medial clearance fixtures/river.geojson --profile -o widths.svg
  medial clearance fixtures/river.geojson --profile --tolerance 0.01 --to csv

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

/// Arguments of `medial clearance`.
#[derive(Debug, Args)]
#[command(after_help = CLEARANCE_HELP)]
pub struct ClearanceArgs {
    /// Polygons in any format that --from knows; `-` for standard input
    pub input: PathBuf,
    #[command(flatten)]
    pub target: Target,
    /// Write necks narrower than this only, in units of the input
    #[arg(long, value_name = "W", value_parser = positive, allow_negative_numbers = true)]
    pub min: Option<f64>,
    /// Write where the largest inscribed disks lie instead, with twice the radius as width: points, or
    /// lines along passages between parallel edges
    #[arg(long, conflicts_with_all = ["min", "side", "frame"])]
    pub largest: bool,
    /// Write the width along the main line of each feature instead: points, or a plot
    #[arg(long, conflicts_with_all = ["min", "largest", "side", "frame"])]
    pub profile: bool,
    /// Largest error of the width of a profile between two of its points, in units of the input; by
    /// default 1e-4 of the longer side of the feature's box
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true,
          requires = "profile")]
    pub tolerance: Option<f64>,
    /// Take all features as one shape, which they must be: spacings between features, and both features named
    #[arg(long, conflicts_with = "profile")]
    pub together: bool,
    /// Who computes the axis: path_tracing, divide_and_conquer
    #[arg(long, value_name = "NAME", default_value = "path_tracing", value_parser = engine)]
    pub engine: Engine,
    #[command(flatten)]
    pub region: Region,
    #[command(flatten)]
    pub common: Common,
}
