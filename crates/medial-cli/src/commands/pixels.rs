//! The pixels of colour images, as they are read, without those that have no data.

use crate::args::{SegmentMethod, Segmentation};
use crate::failure::Failure;
use crate::guard::guarded;
use crate::input::{Input, world_of};
use medial_io::image::{self, Numbers};
use medial_io::{Content, Error, Format, ReadOptions};
use std::path::Path;

/// Pixels of an image: colours, bands, or numbers of labels.
pub struct Pixels {
    pub colours: image::Colours,
    /// The numbers of labels, and whether they stand for colours.
    pub numbers: Option<(Vec<f64>, bool)>,
}

impl Pixels {
    /// Reads those of an image, without what options and a mask leave out.
    pub fn read(
        args: &Segmentation,
        from: Option<Format>,
        path: &Path,
        input: &Input,
        mask: Option<&Path>,
    ) -> Result<Self, Failure> {
        let format = format_of(from, path, input)?;
        let world = world_of(path)?;
        let bands: Vec<usize> = args.bands.iter().map(|band| band.get()).collect();
        let mut pixels = match args.method {
            SegmentMethod::Labels => {
                let read = decoded(input, || image::read_numbers(format, input.bytes(), &world))?;
                Self::of_numbers(read)
            }
            method => {
                let read = || image::read_colours(format, input.bytes(), &bands, &world);
                let colours = decoded(input, read)?;
                if method == SegmentMethod::Colours && colours.are_bands {
                    let why = "has bands that are no colours; name a threshold instead";
                    return Err(input.wrong(why));
                }
                Self { colours, numbers: None }
            }
        };
        if let Some(value) = &args.no_data {
            pixels.leave_out_value(value)?;
        }
        if let Some(mask) = mask {
            pixels.leave_out_masked(mask, input)?;
        }
        Ok(pixels)
    }

    /// Numbers of labels stand for the first band.
    fn of_numbers(read: Numbers) -> Self {
        let Numbers { grid, crs, values, are_colours, warnings } = read;
        let value = |&number: &f64| [number as f32, 0.0, 0.0];
        let colours = image::Colours {
            grid,
            crs,
            values: values.iter().map(value).collect(),
            are_bands: true,
            n_bands: 1,
            warnings,
        };
        Self { colours, numbers: Some((values, are_colours)) }
    }

    /// Leaves out what has the value for no data.
    fn leave_out_value(&mut self, value: &str) -> Result<(), Failure> {
        let wrong = |what: &str| Failure::Usage(format!("--no-data {value} is no {what}"));
        let n_bands = self.colours.n_bands;
        if let Some((numbers, _)) = &self.numbers {
            let number: f64 = value.parse().map_err(|_| wrong("number, as labels have"))?;
            let is_it: Vec<bool> = numbers.iter().map(|&other| other == number).collect();
            self.leave_out(|k, _| is_it[k]);
        } else if self.colours.are_bands {
            let number: f32 = value.parse().map_err(|_| wrong("number, as bands have"))?;
            self.leave_out(|_, value| value[..n_bands].iter().all(|&band| band == number));
        } else {
            let colour = crate::args::colour(value).map_err(|_| wrong("colour, as 000000"))?;
            let bytes = |value: [f32; 3]| value.map(|v| (255.0 * v).round() as u8);
            self.leave_out(|_, value| !value[0].is_nan() && bytes(value) == colour);
        }
        Ok(())
    }

    /// Leaves out what another image has 0 for.
    fn leave_out_masked(&mut self, path: &Path, input: &Input) -> Result<(), Failure> {
        let file = Input::read(path)?;
        let format = format_of(None, path, &file)?;
        world_of(path)?;
        let options = ReadOptions { threshold: Some(0.0), ..ReadOptions::default() };
        let (mask, _) = decoded(&file, || image::read_mask(format, file.bytes(), &options))?;
        let grid = self.colours.grid;
        let (columns, rows) = (mask.grid().columns, mask.grid().rows);
        if (columns, rows) != (grid.columns, grid.rows) {
            return Err(file.wrong(format_args!(
                "has {columns} by {rows} pixels, {} {} by {}; name a mask of the same pixels",
                input.name, grid.columns, grid.rows
            )));
        }
        let columns = columns as usize;
        self.leave_out(|k, _| !mask.get((k % columns) as u32, (k / columns) as u32));
        Ok(())
    }

    /// Leaves out pixels, by their number and their values.
    fn leave_out(&mut self, is_out: impl Fn(usize, [f32; 3]) -> bool) {
        let values = self.colours.values.iter_mut().enumerate();
        for (k, value) in values.filter(|(k, value)| is_out(*k, **value)) {
            *value = [f32::NAN; 3];
            if let Some((numbers, _)) = &mut self.numbers {
                numbers[k] = f64::NAN;
            }
        }
    }
}

/// The format of an image: the one that is named, that of the extension, or else told by the content.
fn format_of(from: Option<Format>, path: &Path, input: &Input) -> Result<Format, Failure> {
    let named = from.or_else(|| Format::from_path(path).ok());
    let format = match named {
        Some(format) => format,
        None => match Format::of_content(input.bytes()) {
            Ok(Content::Polygons(format)) => format,
            _ => return Err(input.wrong("is no image; png, jpeg and tiff are read")),
        },
    };
    if !matches!(format, Format::Png | Format::Jpeg | Format::Tiff) {
        let why = format!("is {format}, no image; png, jpeg and tiff are read");
        return Err(input.wrong(why));
    }
    Ok(format)
}

/// What a decoder gives, which may panic as parsers of fonts may.
fn decoded<T>(input: &Input, read: impl FnOnce() -> Result<T, Error>) -> Result<T, Failure> {
    let read = guarded(read).map_err(|panic| input.wrong(panic))?;
    read.map_err(|error| input.wrong(error))
}
