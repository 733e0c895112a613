use super::{Common, Target, engine, not_negative, positive};
use clap::Args;
use medial::axis::Engine;
use std::path::PathBuf;

const WALLS_HELP: &str = "\
Where the polygons are no narrower than --min and no wider than --max, lines along their middle, with the width
of the shape at every point: drawn with a round pen that wide they fill it, which slicers know as medial axis or
gap fill. Lines end at junctions, and where it gets narrower or wider. Loose ends into corners, or to where it
gets too narrow, are left out if they reach less than --ends out of the pen that stays. A spot that is thin
all around is a point.

Formats: geojson, geojsonl, csv, wkt, wkb, dxf (the third coordinate is the width), svg.

Examples:
  medial walls fixtures/glyph.wkt --min 20 --max 120 -o walls.svg
  medial walls fixtures/logo.wkt --max 20 --to csv

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

/// Arguments of `medial walls`.
#[derive(Debug, Args)]
#[command(after_help = WALLS_HELP)]
pub struct WallsArgs {
    /// Polygons in any format that --from knows; `-` for standard input
    pub input: PathBuf,
    #[command(flatten)]
    pub target: Target,
    /// Least width, in units of the input
    #[arg(long, value_name = "W", default_value = "0", value_parser = not_negative, allow_negative_numbers = true)]
    pub min: f64,
    /// Greatest width, in units of the input
    #[arg(long, value_name = "W", value_parser = positive, allow_negative_numbers = true)]
    pub max: f64,
    /// How far loose ends must reach out of what stays, along the line and with their pen, in units of the
    /// input; by default a quarter of --max
    #[arg(long, value_name = "L", value_parser = not_negative, allow_negative_numbers = true)]
    pub ends: Option<f64>,
    /// Largest distance between a line, or the width along it, and what is drawn, in units of the input; by
    /// default a small share of the size of each feature
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    /// Who computes the axis: path_tracing, divide_and_conquer
    #[arg(long, value_name = "NAME", default_value = "path_tracing", value_parser = engine)]
    pub engine: Engine,
    #[command(flatten)]
    pub common: Common,
}
