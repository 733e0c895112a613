//! What the values of regions say: colours, bands, or numbers of labels.

use medial_image::srgb;
use medial_io::image::hexadecimal;
use medial_io::record::Value;
use std::sync::Arc;

/// What the means of regions are means of.
#[derive(Clone)]
pub enum Means {
    /// L*u*v* of colours.
    Colours,
    /// So many bands, from 0 to 100.
    Bands(usize),
    /// Numbers of labels.
    Labels(Arc<Numbers>),
}

/// The numbers of labels.
pub struct Numbers {
    /// That of each region.
    pub of: Vec<f64>,
    /// Whether they stand for colours, red, green and blue in a byte each.
    pub are_colours: bool,
}

impl Means {
    /// How many of three values there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Colours => 3,
            Self::Bands(n) => *n,
            Self::Labels(_) => 1,
        }
    }

    /// Whether they are no colours that can be compared.
    pub fn are_bands(&self) -> bool {
        !matches!(self, Self::Colours)
    }

    /// What they are called.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Colours => "colours",
            Self::Bands(_) => "bands",
            Self::Labels(numbers) if numbers.are_colours => "labels by their colours",
            Self::Labels(_) => "labels by their numbers",
        }
    }

    /// The means of a region, none of values that are not there.
    pub fn told(&self, region: u32, means: [f32; 3]) -> [Value; 3] {
        let value = |k: usize| match self {
            Self::Labels(numbers) => Value::from(numbers.of[region as usize]),
            _ => Value::from(f64::from(means[k])),
        };
        [0, 1, 2].map(|k| if k < self.len() { value(k) } else { Value::None })
    }

    /// The colour in which a region is shown, of red, green and blue from 0 to 1: bands have none, theirs is grey.
    pub fn shown(&self, region: u32, means: [f32; 3]) -> [f32; 3] {
        match self {
            Self::Colours => srgb(means),
            Self::Bands(_) => [means[0] / 100.0; 3],
            Self::Labels(numbers) => colour_of(numbers.of[region as usize], numbers.are_colours),
        }
    }

    /// The same from 0 to 255.
    pub fn bytes(&self, region: u32, means: [f32; 3]) -> [u8; 3] {
        self.shown(region, means).map(|v| (255.0 * v.clamp(0.0, 1.0)).round() as u8)
    }

    /// That colour as text.
    pub fn color(&self, region: u32, means: [f32; 3]) -> Value {
        Value::Text(hexadecimal(self.bytes(region, means)))
    }
}

/// The colour of a number of labels: the one that it stands for, or one of its own; nearly black for 0, and none without
/// data.
pub fn colour_of(number: f64, are_colours: bool) -> [f32; 3] {
    /// The golden section of the circle of colours from one number to the next, in parts of 2^64 of it: no two that are
    /// near one another are alike.
    const TURN: u64 = 0x9e37_79b9_7f4a_7c15;
    if number.is_nan() {
        return [f32::NAN; 3];
    }
    if are_colours {
        let bytes = number as u32;
        return [16, 8, 0].map(|shift| (bytes >> shift & 255) as f32 / 255.0);
    }
    if number == 0.0 {
        return [0.1; 3];
    }
    let whole = if number.fract() == 0.0 { number as i64 as u64 } else { number.to_bits() };
    let turns = whole.wrapping_mul(TURN) as f64 / 2.0_f64.powi(64);
    [0.0, 1.0 / 3.0, 2.0 / 3.0].map(|phase: f64| {
        let (sin, _) = (std::f64::consts::TAU * (turns + phase)).sin_cos();
        (0.6 + 0.35 * sin) as f32
    })
}
