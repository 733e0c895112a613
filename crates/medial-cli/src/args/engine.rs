use super::{named, positive};
use crate::failure::Failure;
use clap::Args;
use medial::axis::Engine;
use medial::engine::{Burning, RidgeSearch, RidgeThinning};
use medial_io::{Feature, Format};
use std::num::NonZeroU32;

/// Who computes an axis, for commands that know sampled ones.
#[derive(Clone, Debug, Args)]
pub struct ChosenEngine {
    /// Who computes the axis: path_tracing, divide_and_conquer, raster_transform, ridge_following,
    /// brushfire, delaunay_dual; by default path_tracing for polygons, raster_transform for masks, delaunay_dual for
    /// colour images
    #[arg(long, value_name = "NAME", value_parser = engine)]
    pub engine: Option<Engine>,
    /// The size of cells into which polygons are put by engines that sample, in units of the input; by
    /// default a thousandth of the longer side of the feature's box
    #[arg(long, value_name = "SIZE", value_parser = positive, allow_negative_numbers = true)]
    pub cell: Option<f64>,
    /// Rows of an image whose distances raster_transform and brushfire hold at a time, to save memory; by
    /// default all of them, or of images above 67 megapixels so many that they are 17
    #[arg(long, value_name = "ROWS")]
    pub band_rows: Option<NonZeroU32>,
    /// The largest distance between samples of the boundary that delaunay_dual takes, in units of the input; by
    /// default a thousandth of the longer side of the feature's box, and half the side of a pixel for images
    #[arg(long, value_name = "D", value_parser = positive, allow_negative_numbers = true)]
    pub spacing: Option<f64>,
    /// The width of a Gaussian along the outline of an image by which delaunay_dual smooths it, in pixels; samples move
    /// by a quarter of a pixel at most, borders between regions of pictures by 0.35
    #[arg(long, value_name = "SIGMA", value_parser = positive, allow_negative_numbers = true)]
    pub smooth_border: Option<f64>,
    /// Let delaunay_dual draw the border back to where hairs begin: what lies behind branches with a chord residual of
    /// no more than this, in units of the input, becomes arcs
    #[arg(long, value_name = "V", value_parser = positive, allow_negative_numbers = true)]
    pub retract: Option<f64>,
    /// How ridge_following finds the two nearest elements: tree, sorted (as in the report), six_vertices (which
    /// may miss one)
    #[arg(long, value_name = "NAME", value_parser = named::<RidgeSearch>)]
    pub search: Option<RidgeSearch>,
    /// How ridge_following thins: queue (worst first), report, five_by_five, full (not at all)
    #[arg(long, value_name = "NAME", value_parser = named::<RidgeThinning>)]
    pub thinning: Option<RidgeThinning>,
    /// How brushfire burns: sequential, alternating, marking, isotropic, zhang_suen, guo_hall, hilditch; by
    /// default isotropic
    #[arg(long, value_name = "NAME", value_parser = named::<Burning>)]
    pub burning: Option<Burning>,
}

impl ChosenEngine {
    /// Fails if something is said to an engine that another one would listen to.
    pub fn check(&self) -> Result<(), Failure> {
        let others: [(&str, bool, Engine); 6] = [
            ("--smooth-border", self.smooth_border.is_some(), Engine::DelaunayDual),
            ("--retract", self.retract.is_some(), Engine::DelaunayDual),
            ("--spacing", self.spacing.is_some(), Engine::DelaunayDual),
            ("--search", self.search.is_some(), Engine::RidgeFollowing),
            ("--thinning", self.thinning.is_some(), Engine::RidgeFollowing),
            ("--burning", self.burning.is_some(), Engine::Brushfire),
        ];
        let wrong = others.iter().find(|(_, said, engine)| *said && self.engine != Some(*engine));
        match wrong {
            Some((option, _, engine)) => {
                Err(Failure::Usage(format!("{option} is for --engine {engine}")))
            }
            None => Ok(()),
        }
    }

    /// Fails if something is said of images, and the input is none.
    pub fn check_input(&self, format: Format) -> Result<(), Failure> {
        let is_image = matches!(format, Format::Png | Format::Jpeg | Format::Tiff);
        match self.smooth_border {
            Some(_) if !is_image => Err(Failure::Usage(format!(
                "--smooth-border is for images, whose outlines have steps; the input is {format}"
            ))),
            _ => Ok(()),
        }
    }

    /// The engine for images.
    pub fn of_images(&self) -> Engine {
        self.engine.unwrap_or(Engine::RasterTransform)
    }

    /// The engine for a feature.
    pub fn of(&self, feature: &Feature) -> Engine {
        engine_for(feature, self.engine)
    }
}

/// The engine that was asked for, else the usual one for polygons or images.
pub fn engine_for(feature: &Feature, asked: Option<Engine>) -> Engine {
    let usual = match feature.mask {
        Some(_) => Engine::RasterTransform,
        None => Engine::PathTracing,
    };
    asked.unwrap_or(usual)
}

pub(super) fn engine(word: &str) -> Result<Engine, String> {
    named(word)
}
