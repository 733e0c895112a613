//! What the samples of a TIFF mean.

use crate::image::{Values, Wanted, brightness};
use tiff::decoder::DecodingResult;

/// What samples mean.
pub(super) struct Kind {
    /// Bits of a sample.
    pub(super) bits: u8,
    /// Samples of a pixel.
    pub(super) each: usize,
    /// Those of them that make its colour, the first ones.
    pub(super) n_colours: usize,
    /// That of them which says how opaque the pixel is.
    pub(super) alpha: Option<usize>,
    /// Whether they are a colour, or grey.
    pub(super) is_colour: bool,
    /// Whether the colour is one brightness and two differences, as JPEG has it.
    pub(super) is_ycbcr: bool,
    /// Whether they are floating-point numbers.
    pub(super) is_floating: bool,
    /// Red, green and blue of each number, from 0 to 1.
    pub(super) palette: Option<Vec<[f32; 3]>>,
    pub(super) no_data: Option<f64>,
}

/// What the numbers of a type go up to.
#[derive(Clone, Copy)]
struct Scale {
    /// That of a colour.
    greatest: f64,
    /// That of a pixel which is opaque.
    opaque: f64,
    /// Whether single precision is not enough.
    is_double: bool,
}

impl Kind {
    /// The values of pixels, of which so many make a row.
    pub(super) fn values(
        &self,
        samples: DecodingResult,
        columns: usize,
        wanted: Wanted<'_>,
    ) -> Values {
        let scale = scale(&samples, self.bits);
        let is_plain = self.each == 1 && self.palette.is_none() && self.no_data.is_none();
        match (unpacked(samples, self.bits, columns * self.each), wanted) {
            (DecodingResult::U8(samples), Wanted::Value) if is_plain => Values::Bytes(samples),
            (DecodingResult::U16(samples), Wanted::Value) if is_plain => Values::Words(samples),
            (DecodingResult::U8(samples), _) => self.pixels(&samples, f64::from, scale, wanted),
            (DecodingResult::U16(samples), _) => self.pixels(&samples, f64::from, scale, wanted),
            (DecodingResult::F32(samples), _) => self.pixels(&samples, f64::from, scale, wanted),
            (samples, _) => self.pixels(&doubles(samples), |v| v, scale, wanted),
        }
    }

    /// The samples of a pixel that are looked at.
    pub(super) fn needed(&self, wanted: Wanted<'_>) -> Vec<usize> {
        let bands = if let Wanted::Bands(bands) = wanted { bands } else { &[] };
        let is_needed =
            |&k: &usize| k < self.n_colours || self.alpha == Some(k) || bands.contains(&k);
        (0..self.each).filter(is_needed).collect()
    }

    /// The same of planes, each of one sample of all pixels.
    pub(super) fn values_of_planes(
        &self,
        planes: Vec<(usize, DecodingResult)>,
        [columns, rows]: [usize; 2],
        wanted: Wanted<'_>,
    ) -> Values {
        let Some(scale) = planes.first().map(|(_, plane)| scale(plane, self.bits)) else {
            return Values::Doubles(Vec::new());
        };
        let mut samples = vec![f64::NAN; columns * rows * self.each];
        for (k, plane) in planes {
            let plane = doubles(unpacked(plane, self.bits, columns));
            let places = samples.iter_mut().skip(k).step_by(self.each);
            places.zip(plane).for_each(|(place, sample)| *place = sample);
        }
        self.pixels(&samples, |v| v, scale, wanted)
    }

    fn pixels<T: Copy>(
        &self,
        samples: &[T],
        number: impl Fn(T) -> f64,
        scale: Scale,
        wanted: Wanted<'_>,
    ) -> Values {
        let pixels = samples.chunks_exact(self.each);
        match wanted {
            Wanted::Value if scale.is_double => {
                Values::Doubles(pixels.map(|pixel| self.value(pixel, &number, scale)).collect())
            }
            Wanted::Value => Values::Numbers(
                pixels.map(|pixel| self.value(pixel, &number, scale) as f32).collect(),
            ),
            Wanted::Colour => {
                let greatest = if self.palette.is_some() { 1.0 } else { scale.greatest };
                let colour = |pixel| {
                    let colour = self.colour(pixel, &number, scale);
                    colour.unwrap_or([f64::NAN; 3]).map(|v| (v / greatest) as f32)
                };
                Values::Triples(pixels.map(colour).collect())
            }
            Wanted::Bands(bands) => {
                let triple = |pixel| self.bands(pixel, &number, scale, bands);
                Values::Triples(pixels.map(triple).collect())
            }
        }
    }

    /// The first value of a pixel, or its brightness.
    fn value<T: Copy>(&self, pixel: &[T], number: impl Fn(T) -> f64, scale: Scale) -> f64 {
        if self.n_colours == 1 && self.palette.is_none() {
            let is_missing = self.is_missing(pixel, &number, scale);
            return if is_missing { f64::NAN } else { number(pixel[0]) };
        }
        let greatest = if self.palette.is_some() { 65_535.0 } else { 1.0 };
        let colour = self.colour(pixel, number, scale);
        colour.map_or(f64::NAN, |colour| greatest * brightness(colour))
    }

    /// Red, green and blue of a pixel up to the greatest number, those of a palette up to 1; `None` if it is
    /// missing.
    fn colour<T: Copy>(
        &self,
        pixel: &[T],
        number: impl Fn(T) -> f64,
        scale: Scale,
    ) -> Option<[f64; 3]> {
        if self.is_missing(pixel, &number, scale) {
            return None;
        }
        if let Some(palette) = &self.palette {
            return palette.get(number(pixel[0]) as usize).map(|rgb| rgb.map(f64::from));
        }
        let Scale { greatest, .. } = scale;
        let sample = |k: usize| number(pixel[k]);
        Some(match self.n_colours {
            3 if self.is_ycbcr => of_ycbcr([sample(0), sample(1), sample(2)], greatest),
            3 => [sample(0), sample(1), sample(2)],
            // Four inks.
            4 => [0, 1, 2].map(|k| (greatest - sample(k)) * (greatest - sample(3)) / greatest),
            _ => [sample(0); 3],
        })
    }

    /// Up to three bands of a pixel, as they are; those of a palette from 0 to 1.
    fn bands<T: Copy>(
        &self,
        pixel: &[T],
        number: impl Fn(T) -> f64,
        scale: Scale,
        bands: &[usize],
    ) -> [f32; 3] {
        // Bands that are no colours have no data each for itself.
        let is_unknown = |&band: &usize| self.is_no_data(number(pixel[band]), scale);
        let is_missing = match self.is_colour {
            true => self.is_missing(pixel, &number, scale),
            false => self.is_hidden(pixel, &number, scale) || bands.iter().any(is_unknown),
        };
        let is_made = self.palette.is_some() || self.is_ycbcr;
        let colour = is_made.then(|| self.colour(pixel, &number, scale)).flatten();
        let band = |&band: &usize| match colour {
            _ if is_missing => f64::NAN,
            Some(colour) if band < 3 => colour[band],
            None if self.palette.is_some() => f64::NAN,
            _ => number(pixel[band]),
        };
        [0, 1, 2].map(|k| bands.get(k).map_or(0.0, band) as f32)
    }

    /// Whether a pixel is transparent, or all of its colour has the value for no data.
    fn is_missing<T: Copy>(&self, pixel: &[T], number: impl Fn(T) -> f64, scale: Scale) -> bool {
        self.is_hidden(pixel, &number, scale)
            || self.no_data.is_some()
                && pixel[..self.n_colours].iter().all(|&v| self.is_no_data(number(v), scale))
    }

    fn is_hidden<T: Copy>(&self, pixel: &[T], number: impl Fn(T) -> f64, scale: Scale) -> bool {
        self.alpha.is_some_and(|alpha| number(pixel[alpha]) < 0.5 * scale.opaque)
    }

    fn is_no_data(&self, value: f64, scale: Scale) -> bool {
        // What was written in double precision was rounded as the values were.
        let rounded = |v: f64| if scale.is_double { v } else { f64::from(v as f32) };
        self.no_data.is_some_and(|no_data| value == rounded(no_data))
    }
}

/// What samples of a type go up to, as colours and as opaque pixels.
fn scale(samples: &DecodingResult, bits: u8) -> Scale {
    let (greatest, is_double) = match samples {
        DecodingResult::U8(_) if bits < 8 => (f64::from((1_u16 << bits) - 1), false),
        DecodingResult::U8(_) => (255.0, false),
        DecodingResult::U16(_) => (65_535.0, false),
        DecodingResult::U32(_) => (f64::from(u32::MAX), true),
        DecodingResult::U64(_) => (u64::MAX as f64, true),
        DecodingResult::I8(_) => (127.0, false),
        DecodingResult::I16(_) => (32_767.0, false),
        DecodingResult::I32(_) => (f64::from(i32::MAX), true),
        DecodingResult::I64(_) => (i64::MAX as f64, true),
        DecodingResult::F16(_) | DecodingResult::F32(_) => (1.0, false),
        DecodingResult::F64(_) => (1.0, true),
    };
    // Where a range is not filled, what is opaque has any number but 0.
    let opaque = match samples {
        DecodingResult::U8(_) | DecodingResult::U16(_) | DecodingResult::I16(_) => greatest,
        _ => 1.0,
    };
    Scale { greatest, opaque, is_double }
}

/// Samples in double precision.
fn doubles(samples: DecodingResult) -> Vec<f64> {
    fn of<T: Copy>(samples: &[T], number: impl Fn(T) -> f64) -> Vec<f64> {
        samples.iter().map(|&sample| number(sample)).collect()
    }
    match samples {
        DecodingResult::U8(s) => of(&s, f64::from),
        DecodingResult::U16(s) => of(&s, f64::from),
        DecodingResult::U32(s) => of(&s, f64::from),
        DecodingResult::U64(s) => of(&s, |v| v as f64),
        DecodingResult::I8(s) => of(&s, f64::from),
        DecodingResult::I16(s) => of(&s, f64::from),
        DecodingResult::I32(s) => of(&s, f64::from),
        DecodingResult::I64(s) => of(&s, |v| v as f64),
        DecodingResult::F16(s) => of(&s, f64::from),
        DecodingResult::F32(s) => of(&s, f64::from),
        DecodingResult::F64(s) => s,
    }
}

/// Red, green and blue up to a greatest number, of a brightness and the differences of blue and red from it
/// [ITU-T T.871].
fn of_ycbcr([y, blue, red]: [f64; 3], greatest: f64) -> [f64; 3] {
    let middle = 128.0 / 255.0 * greatest;
    let (blue, red) = (blue - middle, red - middle);
    [y + 1.402 * red, y - 0.344_136 * blue - 0.714_136 * red, y + 1.772 * blue]
        .map(|v| v.clamp(0.0, greatest))
}

/// Samples of fewer than eight bits, a byte each; rows start at bytes.
fn unpacked(samples: DecodingResult, bits: u8, each_row: usize) -> DecodingResult {
    let packed = match samples {
        DecodingResult::U8(packed) if bits < 8 => packed,
        samples => return samples,
    };
    let row_bytes = (each_row * usize::from(bits)).div_ceil(8);
    // Samples may lie in two bytes.
    let sample = |row: &[u8], k: usize| {
        let at = k * usize::from(bits);
        let pair = [row[at / 8], row.get(at / 8 + 1).copied().unwrap_or(0)];
        (u16::from_be_bytes(pair) << (at % 8) >> (16 - bits)) as u8
    };
    let rows = packed.chunks_exact(row_bytes.max(1));
    DecodingResult::U8(rows.flat_map(|row| (0..each_row).map(move |k| sample(row, k))).collect())
}
