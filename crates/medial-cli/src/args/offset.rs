use super::{Common, Target, coordinate, engine, positive};
use clap::Args;
use medial::axis::Engine;
use std::path::PathBuf;

const OFFSET_HELP: &str = "\
Positive distances give what lies farther inside the polygons than that, negative ones the polygons grown
by it, rounded at corners: the true parallel curve, of segments and arcs. All polygons of a feature are
one shape. A distance at which nothing is left gives no result.

Formats: geojson, geojsonl, csv, wkt, wkb, rings (arcs within the tolerance); json, svg and dxf (arcs
as they are).

Examples:
  medial offset fixtures/river.geojson --distance 0.3,0.6,1,-1,-2 -o offsets.svg
  medial offset fixtures/river.geojson --distance=-0.5 -o bank.geojson
  medial offset fixtures/shapes/l_with_unit_arms.wkt --distance 0.25,0.4 --to json

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

/// Arguments of `medial offset`.
#[derive(Debug, Args)]
#[command(after_help = OFFSET_HELP)]
pub struct OffsetArgs {
    /// Polygons in any format that --from knows; `-` for standard input
    pub input: PathBuf,
    #[command(flatten)]
    pub target: Target,
    /// Distances from the boundary, separated by commas, in units of the input: inward if positive,
    /// outward if negative
    #[arg(long, value_name = "D,D", required = true, value_delimiter = ',', value_parser = coordinate,
          allow_negative_numbers = true, allow_hyphen_values = true)]
    pub distance: Vec<f64>,
    /// Who computes the axis: path_tracing, divide_and_conquer
    #[arg(long, value_name = "NAME", default_value = "path_tracing", value_parser = engine)]
    pub engine: Engine,
    /// Largest distance between an arc and the polyline drawn for it, in units of the input; by
    /// default 1e-4 of the longer side of the feature's box
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    #[command(flatten)]
    pub common: Common,
}
