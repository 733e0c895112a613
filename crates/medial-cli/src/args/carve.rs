use super::{Common, Target, engine, not_negative, positive};
use clap::{Args, ValueEnum};
use medial::axis::Engine;
use std::path::PathBuf;

const CARVE_HELP: &str = "\
A bit with a point, moved along the axis as deep as the boundary is away, cuts the shape out and just reaches
its outline, up into the corners. z is 0 at the surface and negative below. With --depth the floor is flat
below that: its wall is cut along the offset, and --clear adds the rounds of the tool that clears it.
The order of moves takes few lifts: short ways are gone twice rather than to lift the bit for them (--lift).
Curves that were drawn with segments have a small corner at each, which takes a way of its own: --leave
leaves them out, and most of the way.

Formats: geojson, geojsonl, csv, wkt, wkb (a record for each move, curves within the tolerance; their exact
form is in the columns), dxf (lines in space), svg (seen from above, curves as they are), gcode (a program for LinuxCNC, Grbl and
the like; needs --feed and --safe-height).

Examples:
  medial carve fixtures/glyph.wkt --angle 60 --leave 3 -o glyph.svg
  medial carve fixtures/logo.wkt --angle 60 --depth 6 --clear 1,0.8 --to csv
  medial carve fixtures/logo.wkt --angle 60 --feed 800 --safe-height 5 --spindle 18000 -o logo.nc

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

/// Arguments of `medial carve`.
#[derive(Debug, Args)]
#[command(after_help = CARVE_HELP)]
pub struct CarveArgs {
    /// Polygons in any format that --from knows; `-` for standard input
    pub input: PathBuf,
    #[command(flatten)]
    pub target: Target,
    /// Full angle of the bit's point, in degrees, from 0.01 to 179.99
    #[arg(long, value_name = "DEG", value_parser = angle)]
    pub angle: f64,
    /// Depth at which the floor is flat, in units of the input
    #[arg(long, value_name = "H", value_parser = positive, allow_negative_numbers = true)]
    pub depth: Option<f64>,
    /// Clear the floor where a tool of this radius fits (0 for the bit itself), in rounds so far apart, its
    /// radius at most, in units of the input
    #[arg(long, value_name = "R,STEP", value_parser = clearing, requires = "depth")]
    pub clear: Option<(f64, f64)>,
    /// Leave what reaches no farther than this out of all that is cut, as the corners of curves that were drawn
    /// with segments, in units of the input
    #[arg(long, value_name = "E", value_parser = positive, allow_negative_numbers = true)]
    pub leave: Option<f64>,
    /// Way over what is cut already that is gone rather than to lift the bit, in units of the input; by default
    /// four times the greatest distance from the boundary
    #[arg(long, value_name = "L", value_parser = not_negative, allow_negative_numbers = true)]
    pub lift: Option<f64>,
    /// Largest distance between a curve and the lines drawn for it, in units of the input; by default a
    /// small share of the size of each feature
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    /// Unit of the input, for gcode; by default mm
    #[arg(long, value_name = "UNIT")]
    pub units: Option<Units>,
    /// Feed of cutting moves, in units a minute, for gcode
    #[arg(long, value_name = "F", value_parser = positive, allow_negative_numbers = true)]
    pub feed: Option<f64>,
    /// Feed on the way down, in units a minute, for gcode; by default half of --feed
    #[arg(long, value_name = "F", value_parser = positive, allow_negative_numbers = true)]
    pub plunge: Option<f64>,
    /// Height over the material at which the tool moves on, in units of the input, for gcode
    #[arg(long, value_name = "H", value_parser = positive, allow_negative_numbers = true)]
    pub safe_height: Option<f64>,
    /// Turns of the spindle a minute, for gcode; the spindle is not switched by default
    #[arg(long, value_name = "RPM", value_parser = positive, allow_negative_numbers = true)]
    pub spindle: Option<f64>,
    /// Who computes the axis: path_tracing, divide_and_conquer
    #[arg(long, value_name = "NAME", default_value = "path_tracing", value_parser = engine)]
    pub engine: Engine,
    #[command(flatten)]
    pub common: Common,
}

/// The unit of lengths for machines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Units {
    /// Millimetres
    Mm,
    /// Inches
    Inch,
}

fn angle(word: &str) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(value) if (0.01..=179.99).contains(&value) => Ok(value),
        _ => Err("an angle from 0.01 to 179.99 degrees is needed".to_owned()),
    }
}

fn clearing(word: &str) -> Result<(f64, f64), String> {
    let why = "a radius and a step are needed, as in 3,2".to_owned();
    let (radius, step) = word.split_once(',').ok_or(why)?;
    Ok((not_negative(radius.trim())?, positive(step.trim())?))
}
