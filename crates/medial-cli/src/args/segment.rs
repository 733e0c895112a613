use super::{Common, RunOptions, Target, count, positive};
use clap::{Args, ValueEnum};
use medial_image::Resolution;
use medial_io::Format;
use std::num::NonZeroUsize;
use std::path::PathBuf;

const SEGMENT_HELP: &str = "\
Every pixel of the image comes into one region; regions are connected by sides of pixels, numbered row by row,
and their polygons share their borders exactly. feature_space looks for the colours that stand out in the whole
image, mean_shift for what is alike in place and colour; threshold cuts at values of the first band in its own units,
or of the lightness L*, colours takes what is near to colours that are named. Colours are compared in L*u*v*; bands
that are no colours go from 0, their least value, to 100 for distances and means. labels takes the regions that an
image of numbers says, such as one of --labels: all pixels of a number, or of a colour, are one region.
What is transparent, has the value for no data, or is not a number, is in no region; neither is what --mask or
--no-data leaves out. A world file beside the image, and a .prj with it, say where it lies if it does not itself.

Formats: geojson, geojsonl, csv, wkt, wkb, rings, dxf and tables, a polygon for each region with its number,
pixels, area, mean values, colour and class; png, the regions in their mean colours.

Examples:
  medial segment fixtures/images/horse.png --method threshold --limits 50 -o horse.geojson
  medial segment fixtures/images/horse.png --method feature-space --min-region 20 --to csv
  medial segment fixtures/images/horse.png --method mean-shift -o smooth.png --labels n.tiff
  medial segment fixtures/images/lake.png --palette lake.gpl --labels lake.tiff -o lake.gpkg

Exit status: 0 all done; 1 no usable result; 2 wrong usage; 3 some regions were left out.";

/// Arguments of `medial segment`.
#[derive(Debug, Args)]
#[command(after_help = SEGMENT_HELP)]
pub struct SegmentArgs {
    /// An image (png, jpeg, tiff); `-` for standard input
    pub input: PathBuf,
    #[command(flatten)]
    pub target: Target,
    #[command(flatten)]
    pub segmentation: Segmentation,
    /// Write to FILE, as a TIFF image of 32 bits, the number of each pixel's region from 1 on; 0 for no data
    #[arg(long, value_name = "FILE")]
    pub labels: Option<PathBuf>,
    /// Write to FILE the palette, the classes that have a region: the feature colours of feature_space, what lies
    /// between thresholds, or near to each of colours; a table as csv, or for GIMP and others a file .gpl
    #[arg(long, value_name = "FILE")]
    pub palette: Option<PathBuf>,
    #[command(flatten)]
    pub run: ImageRun,
}

/// How an image is parted into regions.
#[derive(Debug, Args)]
pub struct Segmentation {
    /// How pixels come into regions: feature_space, mean_shift, threshold, colours, labels
    #[arg(long, value_name = "NAME", default_value = "feature_space", value_parser = method)]
    pub method: Method,
    /// How finely feature_space looks: under, over, quantization
    #[arg(long, value_name = "CLASS")]
    pub resolution: Option<Fineness>,
    /// What the random choices of feature_space start from
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// The least number of pixels of a region: smaller ones go to the neighbour that is most alike; by default
    /// 20 for mean_shift, 10 in 512 by 512 for feature_space, else 1
    #[arg(long, value_name = "N")]
    pub min_region: Option<u64>,
    /// The radius of mean_shift in the image, in pixels; by default 7
    #[arg(long, value_name = "R", value_parser = positive, allow_negative_numbers = true)]
    pub spatial: Option<f64>,
    /// The radius of mean_shift among the values; by default 6.5
    #[arg(long, value_name = "R", value_parser = positive, allow_negative_numbers = true)]
    pub range: Option<f64>,
    /// Limits of threshold, in increasing order, separated by commas: in units of the first band, or lightness from 0
    /// to 100 for colours
    #[arg(long, value_name = "T,T", value_delimiter = ',', allow_negative_numbers = true)]
    pub limits: Vec<f32>,
    /// Colours of colours, as RRGGBB, separated by commas
    #[arg(long, value_name = "RRGGBB,…", value_delimiter = ',', value_parser = colour)]
    pub color: Vec<[u8; 3]>,
    /// How far from its colour a pixel of colours may be, in L*u*v*; by default 20
    #[arg(long, value_name = "D", value_parser = positive, allow_negative_numbers = true)]
    pub color_tolerance: Option<f64>,
    /// Bands to look at, up to three, by their numbers from 1, separated by commas; by default the colours, or
    /// the first three
    #[arg(long, value_name = "N,N", value_delimiter = ',', value_parser = count)]
    pub bands: Vec<NonZeroUsize>,
    /// An image of the same pixels: where it is 0 or transparent there is no data
    #[arg(long, value_name = "FILE")]
    pub mask: Option<PathBuf>,
    /// What stands for no data besides what the image says: a colour as RRGGBB, or of bands a number that all that are
    /// looked at have
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub no_data: Option<String>,
}

/// What commands on colour images say of a run.
#[derive(Debug, Args)]
pub struct ImageRun {
    /// Format of the image: png, jpeg, tiff; by default that of the extension, else told by the content
    #[arg(long, value_name = "FORMAT")]
    pub from: Option<Format>,
    #[command(flatten)]
    pub run: RunOptions,
}

impl ImageRun {
    /// The same, as commands on polygons say it.
    pub fn common(&self) -> Common {
        Common {
            from: self.from,
            layer: None,
            text: None,
            font: Vec::new(),
            threshold: None,
            invert: false,
            metric: false,
            strict: false,
            regroup: false,
            fill: None,
            dissolve: false,
            max_vertices: None,
            run: self.run.clone(),
        }
    }
}

/// How pixels come into regions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    FeatureSpace,
    MeanShift,
    Threshold,
    Colours,
    Labels,
}

fn method(word: &str) -> Result<Method, String> {
    match word.replace('-', "_").as_str() {
        "feature_space" => Ok(Method::FeatureSpace),
        "mean_shift" => Ok(Method::MeanShift),
        "threshold" => Ok(Method::Threshold),
        "colours" => Ok(Method::Colours),
        "labels" => Ok(Method::Labels),
        _ => Err("known are feature_space, mean_shift, threshold, colours, labels".to_owned()),
    }
}

/// How finely the feature space is looked at.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Fineness {
    /// Few large regions
    Under,
    /// More and smaller ones
    Over,
    /// As many colours as it takes to look alike
    Quantization,
}

impl From<Fineness> for Resolution {
    fn from(fineness: Fineness) -> Self {
        match fineness {
            Fineness::Under => Self::Under,
            Fineness::Over => Self::Over,
            Fineness::Quantization => Self::Quantization,
        }
    }
}

/// Red, green and blue of six hexadecimal digits.
pub fn colour(word: &str) -> Result<[u8; 3], String> {
    let digits = word.strip_prefix('#').unwrap_or(word);
    let number = u32::from_str_radix(digits, 16).ok().filter(|_| digits.len() == 6);
    let number = number.ok_or("a colour is six hexadecimal digits, as ff8000")?;
    let [_, red, green, blue] = number.to_be_bytes();
    Ok([red, green, blue])
}
