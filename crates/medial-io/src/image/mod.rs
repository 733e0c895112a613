//! Masks from images: PNG and TIFF, with the place that GeoTIFF gives them; and masks as PNG.
//!
//! # Contract
//! An image gives one feature, which carries the [mask](crate::Feature::mask) and its outline as polygons.
//! Cells of the shape are those whose value is above a threshold: colours count by their brightness, and
//! what is transparent, has the value for no data, or is not a number, lies outside. Without a threshold it
//! is the middle between the least and the greatest value, so a mask of two values needs none; a mask of one
//! value is inside if that is above 0.
//!
//! Rows are decoded one after the other and kept as bits, so a large image takes little more memory than its
//! file and its mask. An image without a threshold is decoded twice if it has many pixels.
//!
//! Coordinates are those of the georeference, in the image or in a [world file](WorldFile) beside it. Without one they
//! are pixels from the upper left corner, x to the right and y upwards, so that y is the negative of rows, as with
//! drawings.

mod jpeg;
mod palette;
mod png;
mod tiff;
mod world;
mod write;

pub use palette::{PaletteColour, hexadecimal, palette_gpl, palette_table};
pub use world::{WorldFile, world_file};
pub use write::{write_colours, write_labels, write_png};

use crate::{Crs, Error, Feature, Format, Layer, ReadOptions};
use medial::geom::Point;
use medial::raster::{Grid, Mask, outline};
use std::ops::Range;
use std::sync::Arc;

/// An image, which is decoded some rows after the others.
trait Image {
    fn header(&self) -> &Header;

    /// Decodes all rows: gives the number of the first one and the values of some whole ones, not a number
    /// where there is no data.
    fn decode(
        self: Box<Self>,
        wanted: Wanted<'_>,
        take: &mut dyn FnMut(u32, Values),
    ) -> Result<(), Error>;
}

/// What is wanted of each pixel.
#[derive(Clone, Copy)]
enum Wanted<'a> {
    /// One value: that of the only band, or the brightness.
    Value,
    /// Red, green and blue, from 0 to 1.
    Colour,
    /// Up to three bands as they are, by their numbers from 0.
    Bands(&'a [usize]),
}

/// What an image says of itself.
#[derive(Clone, Debug)]
struct Header {
    columns: u32,
    rows: u32,
    place: Option<Place>,
    /// Samples of a pixel, but for transparency behind them.
    n_bands: usize,
    /// That of them, from 0, which says how opaque a pixel is, wherever it is.
    alpha: Option<usize>,
    /// Whether these are a colour, or grey.
    is_colour: bool,
    /// Whether values go up to 65,535.
    is_wide: bool,
    /// What the image says that is not used.
    warnings: Vec<String>,
}

impl Header {
    /// A mask with no cell in it where the image, or else a file beside it, says that it lies, and the reference system of
    /// that place.
    fn placed(&self, world: &WorldFile) -> Result<(Mask, Option<Crs>), Error> {
        let Self { columns, rows, .. } = *self;
        let place = match &self.place {
            Some(place) => Some(place.clone()),
            None => world.place()?,
        };
        let (grid, crs) = match place {
            Some(Place { origin, cell, crs }) => (Grid { origin, cell, columns, rows }, crs),
            None => (Grid::of_image(columns, rows), None),
        };
        if let Some(why) = coarse(&grid) {
            return Err(Error::File { why });
        }
        let mask = Mask::empty(grid).map_err(|error| Error::File { why: error.to_string() })?;
        Ok((mask, crs))
    }
}

/// Why coordinates do not tell parts of pixels apart, if they do not.
fn coarse(grid: &Grid) -> Option<String> {
    /// Numbers between one side of a pixel and the other.
    const LEAST: f64 = 1024.0;
    let ends = [grid.corner(0, 0), grid.corner(grid.columns, grid.rows)];
    let greatest =
        |of: fn(Point) -> f64| ends.map(of).map(f64::abs).into_iter().fold(0.0, f64::max);
    let reach = [greatest(|p| p.x), greatest(|p| p.y)];
    let pairs = reach.into_iter().zip(grid.cell.map(f64::abs));
    let mut fine = pairs.filter(|&(reach, cell)| cell < LEAST * f64::EPSILON * reach);
    fine.next().map(|(reach, cell)| {
        format!(
            "pixels of {cell} are too small for coordinates up to {reach}, of which doubles have too few between them; \
             move the origin nearer"
        )
    })
}

/// Values of pixels.
enum Values {
    Bytes(Vec<u8>),
    Words(Vec<u16>),
    Numbers(Vec<f32>),
    /// Where single precision is not enough.
    Doubles(Vec<f64>),
    /// Three a pixel.
    Triples(Vec<[f32; 3]>),
}

/// Where a picture lies.
#[derive(Clone, Debug)]
struct Place {
    origin: Point,
    cell: [f64; 2],
    crs: Option<Crs>,
}

impl Values {
    fn len(&self) -> usize {
        match self {
            Self::Bytes(values) => values.len(),
            Self::Words(values) => values.len(),
            Self::Numbers(values) => values.len(),
            Self::Doubles(values) => values.len(),
            Self::Triples(values) => values.len(),
        }
    }

    /// The least and the greatest finite value; `None` if there is none.
    fn range(&self) -> Option<(f64, f64)> {
        fn of<T: Copy + PartialOrd + Into<f64>>(values: &[T]) -> Option<(f64, f64)> {
            let numbers = values.iter().map(|&value| value.into()).filter(|v: &f64| v.is_finite());
            numbers.fold(None, |range, v| {
                let (low, high) = range.unwrap_or((v, v));
                Some((v.min(low), v.max(high)))
            })
        }
        match self {
            Self::Bytes(values) => {
                let least = values.iter().min().copied()?;
                Some((f64::from(least), f64::from(values.iter().max().copied()?)))
            }
            Self::Words(values) => of(values),
            Self::Numbers(values) => of(values),
            Self::Doubles(values) => of(values),
            Self::Triples(_) => None,
        }
    }

    /// Sets the cells, from a row on, whose values are above a threshold, or not above it.
    fn fill(&self, mask: &mut Mask, first: u32, threshold: f64, inverted: bool) {
        let columns = mask.grid().columns as usize;
        for (k, row) in (0..self.len() / columns.max(1)).zip(first..) {
            self.fill_row(mask, row, k * columns..(k + 1) * columns, threshold, inverted);
        }
    }

    fn fill_row(
        &self,
        mask: &mut Mask,
        row: u32,
        span: Range<usize>,
        threshold: f64,
        inverted: bool,
    ) {
        fn put<T: Copy + Into<f64>>(
            mask: &mut Mask,
            row: u32,
            of: &[T],
            is_in: impl Fn(f64) -> bool,
        ) {
            let mut bytes = vec![0_u8; of.len().div_ceil(8)];
            for (byte, eight) in bytes.iter_mut().zip(of.chunks(8)) {
                for (bit, &value) in eight.iter().enumerate() {
                    *byte |= u8::from(is_in(value.into())) << bit;
                }
            }
            mask.put_row(row, &bytes);
        }
        // What is not a number is neither above nor below.
        let is_in = |value: f64| if inverted { value <= threshold } else { value > threshold };
        match self {
            Self::Bytes(values) => put(mask, row, &values[span], is_in),
            Self::Words(values) => put(mask, row, &values[span], is_in),
            Self::Numbers(values) => put(mask, row, &values[span], is_in),
            Self::Doubles(values) => put(mask, row, &values[span], is_in),
            Self::Triples(_) => {}
        }
    }
}

/// The mask of an image, and the coordinate reference system that it names.
///
/// # Errors
/// If the bytes are no such image, are damaged, or the image is too large.
pub fn read_mask(
    format: Format,
    bytes: &[u8],
    options: &ReadOptions,
) -> Result<(Mask, Option<Crs>), Error> {
    /// Values of so many pixels at most are kept until the threshold is known.
    const KEPT: u64 = 1 << 24;
    let (mut mask, crs) = open(format, bytes)?.header().placed(&options.world)?;
    let grid = *mask.grid();
    let Grid { columns, rows, .. } = grid;
    let mut fill = |first: u32, values: &Values, threshold: f64| {
        values.fill(&mut mask, first, threshold, options.invert);
    };
    let mut n_values = 0;
    let is_kept = options.threshold.is_none() && grid.n_cells() <= KEPT;
    let mut kept = Vec::new();
    let mut range: Option<(f64, f64)> = None;
    open(format, bytes)?.decode(Wanted::Value, &mut |first, values| {
        n_values += values.len() as u64;
        if let Some(threshold) = options.threshold {
            return fill(first, &values, threshold);
        }
        if let Some((low, high)) = values.range() {
            let (least, greatest) = range.unwrap_or((low, high));
            range = Some((least.min(low), greatest.max(high)));
        }
        if is_kept {
            kept.push((first, values));
        }
    })?;
    if n_values != grid.n_cells() {
        let why = format!("the image has {n_values} values for {columns} by {rows} pixels");
        return Err(Error::File { why });
    }
    if let Some((low, high)) = range {
        let threshold = if low < high { 0.5 * (low + high) } else { 0.0 };
        if is_kept {
            kept.iter().for_each(|(first, values)| fill(*first, values, threshold));
        } else {
            open(format, bytes)?
                .decode(Wanted::Value, &mut |first, values| fill(first, &values, threshold))?;
        }
    }
    Ok((mask, crs))
}

/// An image of a format, or of another one if its first bytes say so: names of images are often wrong.
fn open<'b>(format: Format, bytes: &'b [u8]) -> Result<Box<dyn Image + 'b>, Error> {
    let is_image = matches!(format, Format::Png | Format::Tiff | Format::Jpeg);
    let told = match bytes {
        [0x89, b'P', b'N', b'G', ..] => Format::Png,
        [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..] => Format::Tiff,
        [0xFF, 0xD8, 0xFF, ..] => Format::Jpeg,
        _ => format,
    };
    match if is_image { told } else { format } {
        Format::Png => png::open(bytes),
        Format::Tiff => tiff::open(bytes),
        Format::Jpeg => jpeg::open(bytes),
        other => Err(Error::Unreadable { format: other }),
    }
}

/// An image of three numbers a pixel.
#[derive(Clone, Debug)]
pub struct Colours {
    /// Where the pixels lie.
    pub grid: Grid,
    /// The coordinate reference system that the image names.
    pub crs: Option<Crs>,
    /// Row by row: red, green and blue of sRGB from 0 to 1, or bands as they are; not numbers where there is no
    /// data or the image is transparent.
    pub values: Vec<[f32; 3]>,
    /// Whether they are bands.
    pub are_bands: bool,
    /// How many of the three there are; the others are 0.
    pub n_bands: usize,
    /// What the image says that is not used, or what its values make doubtful.
    pub warnings: Vec<String>,
}

/// The colours of an image, or some of its bands, by their numbers from 1; an image whose bands are no colours
/// gives the first three if none are named. A band that is not there is 0.
///
/// # Errors
/// If the bytes are no such image, are damaged, the image is too large or has no such band.
pub fn read_colours(
    format: Format,
    bytes: &[u8],
    bands: &[usize],
    world: &WorldFile,
) -> Result<Colours, Error> {
    let image = open(format, bytes)?;
    let &Header { columns, rows, n_bands, alpha, is_colour, is_wide, .. } = image.header();
    let mut warnings = image.header().warnings.clone();
    let refused = |why: String| Err(Error::File { why });
    if let Some(band) = bands.iter().find(|&&band| band == 0 || band > n_bands) {
        return refused(format!("the image has no band {band}; they go from 1 to {n_bands}"));
    }
    if bands.len() > 3 {
        return refused(format!(
            "{} bands are more than can be looked at; name up to 3",
            bands.len()
        ));
    }
    let chosen: Vec<usize> = match bands {
        [] => (0..n_bands).filter(|&band| alpha != Some(band)).take(3).collect(),
        bands => bands.iter().map(|band| band - 1).collect(),
    };
    let are_bands = !bands.is_empty() || !is_colour;
    // Labels are masks in the end.
    let (mask, crs) = image.header().placed(world)?;
    let grid = *mask.grid();
    let mut values = Vec::new();
    let wanted = if are_bands { Wanted::Bands(&chosen) } else { Wanted::Colour };
    image.decode(wanted, &mut |_, rows| {
        if let Values::Triples(rows) = rows {
            values.extend(rows);
        }
    })?;
    if values.len() as u64 != grid.n_cells() {
        let n = values.len();
        return refused(format!("the image has {n} values for {columns} by {rows} pixels"));
    }
    if is_wide && !are_bands {
        warnings.extend(darkness(&values, n_bands));
    }
    let n_bands = if are_bands { chosen.len() } else { 3 };
    Ok(Colours { grid, crs, values, are_bands, n_bands, warnings })
}

/// An image of one number a pixel, as of labels.
#[derive(Clone, Debug)]
pub struct Numbers {
    /// Where the pixels lie.
    pub grid: Grid,
    /// The coordinate reference system that the image names.
    pub crs: Option<Crs>,
    /// Row by row, the numbers of the only band, or of a colour that of its three bytes; not numbers where there is no
    /// data or the image is transparent.
    pub values: Vec<f64>,
    /// Whether they stand for colours.
    pub are_colours: bool,
    /// What the image says that is not used.
    pub warnings: Vec<String>,
}

/// The numbers of an image of labels: a grey image or a band gives its values as they are, another one a number for each
/// colour.
///
/// # Errors
/// As [`read_mask`], and if the image has several bands that are no colours, or numbers that doubles do not tell apart.
pub fn read_numbers(format: Format, bytes: &[u8], world: &WorldFile) -> Result<Numbers, Error> {
    let image = open(format, bytes)?;
    let Header { columns, rows, n_bands, is_colour, warnings, .. } = image.header().clone();
    if n_bands > 1 && !is_colour {
        let why =
            format!("the image has {n_bands} bands; labels need an image of one, or of colours");
        return Err(Error::File { why });
    }
    let (mask, crs) = image.header().placed(world)?;
    let grid = *mask.grid();
    let mut values: Vec<f64> = Vec::new();
    let wanted = if n_bands > 1 { Wanted::Colour } else { Wanted::Value };
    image.decode(wanted, &mut |_, rows| match rows {
        Values::Bytes(rows) => values.extend(rows.into_iter().map(f64::from)),
        Values::Words(rows) => values.extend(rows.into_iter().map(f64::from)),
        Values::Numbers(rows) => values.extend(rows.into_iter().map(f64::from)),
        Values::Doubles(rows) => values.extend(rows),
        Values::Triples(rows) => values.extend(rows.into_iter().map(|colour| {
            // Not a number goes through all of this.
            let [red, green, blue] = colour.map(|value| (255.0 * f64::from(value)).round());
            (red * 256.0 + green) * 256.0 + blue
        })),
    })?;
    if values.len() as u64 != grid.n_cells() {
        let why = format!("the image has {} values for {columns} by {rows} pixels", values.len());
        return Err(Error::File { why });
    }
    const MOST: f64 = (1_u64 << 53) as f64;
    if let Some(large) = values.iter().find(|number| number.abs() >= MOST) {
        let why = format!(
            "the number {large} is too large to be told from the next one; number the labels anew, below 2^53"
        );
        return Err(Error::File { why });
    }
    Ok(Numbers { grid, crs, values, are_colours: n_bands > 1, warnings })
}

/// What to do about colours of 16 bits that are all nearly black, as 10 or 12 bits are that were not stretched.
fn darkness(values: &[[f32; 3]], n_bands: usize) -> Option<String> {
    const DARK: f32 = 4096.0 / 65_535.0;
    let greatest = values.iter().flatten().copied().fold(0.0, f32::max);
    let bands = if n_bands < 3 { "1" } else { "1,2,3" };
    (0.0 < greatest && greatest < DARK).then(|| {
        format!(
            "the greatest of its values is {:.0} of 65535, so all of it is nearly black; --bands {bands} takes \
             the values by their own range",
            65_535.0 * greatest
        )
    })
}

/// Reads an image as one feature, whose polygons are the outline of its mask, unless masks are to come alone.
///
/// # Errors
/// As [`read_mask`].
pub fn read<'a>(format: Format, bytes: &[u8], options: &ReadOptions) -> Result<Layer<'a>, Error> {
    let (mask, crs) = read_mask(format, bytes, options)?;
    let feature = Feature {
        polygons: if options.masks_alone { Vec::new() } else { outline(&mask) },
        geometry: "a mask".to_owned(),
        polygonal: true,
        mask: Some(Arc::new(mask)),
        ..Feature::default()
    };
    let mut layer = Layer::new(std::iter::once(Ok(feature)));
    (layer.crs, layer.len) = (crs, Some(1));
    layer.warnings.clone_from(&open(format, bytes)?.header().warnings);
    Ok(layer)
}

/// Most bytes that an image may have in memory: an image of so many bytes in its file that has more is
/// damaged, or made to fill the memory.
fn most_bytes(in_file: usize) -> usize {
    /// Blank pages shrink most; those of this size are read whatever their file has.
    const ALWAYS: usize = 1 << 30;
    /// More than the usual compressions make of anything but blank pages.
    const RATIO: usize = 2000;
    ALWAYS.max(in_file.saturating_mul(RATIO))
}

/// The brightness of a colour [ITU-R BT.709], as its values are stored.
fn brightness([red, green, blue]: [f64; 3]) -> f64 {
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

/// Red, green and blue of pixels of several samples up to a greatest value; the last sample may say how opaque a
/// pixel is.
fn coloured(
    samples: &[f32],
    each: usize,
    colours: usize,
    has_alpha: bool,
    greatest: f32,
) -> Values {
    let colour = |pixel: &[f32]| {
        let hidden = has_alpha && pixel[each - 1] < 0.5 * greatest;
        match colours {
            _ if hidden => [f32::NAN; 3],
            3 => [0, 1, 2].map(|k| pixel[k] / greatest),
            // Four inks.
            4 => [0, 1, 2].map(|k| (1.0 - pixel[k] / greatest) * (1.0 - pixel[3] / greatest)),
            _ => [pixel[0] / greatest; 3],
        }
    };
    Values::Triples(samples.chunks_exact(each).map(colour).collect())
}

/// Some samples of each pixel; the last one may say how opaque it is, up to a greatest value.
fn banded(samples: &[f32], each: usize, bands: &[usize], has_alpha: bool, greatest: f32) -> Values {
    let triple = |pixel: &[f32]| {
        if has_alpha && pixel[each - 1] < 0.5 * greatest {
            return [f32::NAN; 3];
        }
        [0, 1, 2].map(|k| bands.get(k).and_then(|&band| pixel.get(band)).copied().unwrap_or(0.0))
    };
    Values::Triples(samples.chunks_exact(each).map(triple).collect())
}

/// One value for each pixel of several samples, the last of which may say how opaque it is, up to `opaque`.
fn flattened<T: Copy + Into<f64>>(
    samples: &[T],
    each: usize,
    colours: usize,
    opaque: Option<f64>,
) -> Values {
    let value = |pixel: &[T]| {
        let hidden = opaque.is_some_and(|opaque| pixel[each - 1].into() < 0.5 * opaque);
        let value = match colours {
            3 => brightness([pixel[0], pixel[1], pixel[2]].map(Into::into)),
            _ => pixel[0].into(),
        };
        if hidden { f32::NAN } else { value as f32 }
    };
    Values::Numbers(samples.chunks_exact(each).map(value).collect())
}

#[cfg(test)]
mod tests;
