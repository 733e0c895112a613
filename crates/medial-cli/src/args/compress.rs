use super::pruning::prune;
use super::{Common, Flattening, Prune, Rows, engine, named, not_negative};
use crate::failure::Failure;
use clap::Args;
use medial::axis::Engine;
use medial::engine::Options;
use medial::ops::{MaskMethod, MaskOptions, Measure};
use std::path::PathBuf;

const COMPRESS_HELP: &str = "\
Each feature becomes disks on a grid, with what is linear between them; the boundary of their union and
that of the polygons are within V of one another. Features whose corners take fewer bytes, and all with
V = 0, keep their corners bit for bit: the exact axis follows from them.

An image becomes cells, by one of these methods, unless --engine names an exact one:
  chain    the medial cells one after the other, with their distances; pruned by chord=2 if nothing else is
           said, distances rounded down to quarters; with --prune none the image comes back cell for cell
  cover    few disks, taken by what they gain, that cover a share of the image (--coverage)
  squares  the same with squares
  crack    the outline, crack by crack: always without loss, and usually the smallest file
None of them adds a cell. `medial reconstruct FILE.maxis -o FILE.png` gives the image back.

With -o the standard output tells the bytes of each feature, as if it were alone in a file, and of all:
as maxis, as WKB, and as WKB deflated; of images also as PNG.

Examples:
  medial compress fixtures/river.geojson --max-error 1 -o river.maxis --sizes text
  medial compress fixtures/river.geojson --max-error 0 -o river.maxis
  medial compress fixtures/lake.rings --max-error 5 --simplify -o lake.maxis
  medial compress - --max-error 0.01 < fixtures/shapes/l_with_unit_arms.wkt > l.maxis
  medial compress fixtures/images/horse.png --invert -o horse.maxis --sizes text
  medial compress fixtures/images/horse.png --invert --method cover --coverage 0.99 -o horse.maxis

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some features were left out.";

/// Arguments of `medial compress`.
#[derive(Debug, Args)]
#[command(after_help = COMPRESS_HELP)]
pub struct CompressArgs {
    /// Polygons or an image in any format that --from knows; `-` for standard input
    pub input: PathBuf,
    /// File to write (maxis); by default, and for `-`, standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// How far the boundary may move, in units of the input; 0 keeps every corner. For images: the Hausdorff
    /// distance of the cells, and of those outside
    #[arg(long, value_name = "V", value_parser = not_negative, allow_negative_numbers = true)]
    pub max_error: Option<f64>,
    /// Keep simplified corners, within the same error, where they take fewer bytes than disks: the axis
    /// is then that of the simplified polygon
    #[arg(long)]
    pub simplify: bool,
    /// What stands for the cells of an image: chain, cover, squares, crack; by default chain
    #[arg(long, value_name = "NAME", value_parser = named::<MaskMethod>)]
    pub method: Option<MaskMethod>,
    /// Take cells of an image for medial above this chord residual, in units of the input, or `none`: as many
    /// as their disks need to be the image again (chain); by default chord=2 cells
    #[arg(long, value_name = "chord=VALUE", value_parser = prune, conflicts_with = "max_error")]
    pub prune: Option<Prune>,
    /// The share of the cells of an image that is covered (cover, squares), up to 1; by default 1
    #[arg(long, value_name = "SHARE", value_parser = share, conflicts_with = "max_error")]
    pub coverage: Option<f64>,
    /// Who computes the axis: path_tracing, divide_and_conquer, for images also of their outline; by default
    /// path_tracing for polygons, raster_transform for images
    #[arg(long, value_name = "NAME", value_parser = engine)]
    pub engine: Option<Engine>,
    /// Form of the sizes, a row for each feature and one for all: json (lines), csv, or text for people
    #[arg(long, value_name = "FORM", default_value = "json")]
    pub sizes: Rows,
    #[command(flatten)]
    pub flattening: Flattening,
    #[command(flatten)]
    pub common: Common,
}

fn share(word: &str) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(value) if (0.0..=1.0).contains(&value) => Ok(value),
        _ => Err("a number from 0 to 1 is needed".to_owned()),
    }
}

impl CompressArgs {
    /// Whether an input becomes cells: it is an image, and no exact engine is to see its outline.
    pub fn as_cells(&self, is_image: bool) -> bool {
        is_image && self.engine.is_none_or(|engine| engine == Engine::RasterTransform)
    }

    /// Fails if something is said that is not for polygons, or for cells.
    pub fn check(&self, as_cells: bool) -> Result<(), Failure> {
        let usage = |why: &str| Err(Failure::Usage(why.to_owned()));
        if !as_cells {
            if self.method.is_some() || self.prune.is_some() || self.coverage.is_some() {
                return usage("--method, --prune and --coverage are for cells of images");
            }
            if self.max_error.is_none() {
                let why = "polygons need --max-error V, how far their boundary may move; images \
                           become polygons with any engine but raster_transform";
                return usage(why);
            }
            return Ok(());
        }
        let method = self.method.unwrap_or(MaskMethod::Chain);
        if self.simplify {
            return usage("--simplify is for corners of polygons; name an exact --engine");
        }
        match self.prune {
            Some(_) if method != MaskMethod::Chain => usage("--prune is for --method chain"),
            Some(Prune::Below(measure, _)) if measure != Measure::Chord => {
                usage("cells of images are pruned by chord=VALUE or none")
            }
            Some(Prune::Leaves) => usage("cells of images are pruned by chord=VALUE or none"),
            _ if self.coverage.is_some()
                && !matches!(method, MaskMethod::Cover | MaskMethod::Squares) =>
            {
                usage("--coverage is for --method cover and squares")
            }
            _ => Ok(()),
        }
    }

    /// How cells of a size become few numbers.
    pub fn mask_options(&self, cell: f64) -> MaskOptions {
        let residual = match self.prune {
            Some(Prune::Nothing | Prune::Leaves) => None,
            Some(Prune::Below(_, value)) => Some(value / cell),
            None => Options::default().residual,
        };
        let usual = MaskOptions::default();
        MaskOptions {
            method: self.method.unwrap_or(usual.method),
            residual,
            coverage: self.coverage.unwrap_or(usual.coverage),
            max_error: self.max_error,
            ..usual
        }
    }
}
