//! Where a GeoTIFF lies.

use super::Source;
use crate::image::Place;
use crate::{Crs, Error};
use medial::geom::Point;
use medial::raster::Grid;
use std::io::Cursor;
use tiff::decoder::Decoder;
use tiff::tags::Tag;

/// The tags of GeoTIFF.
const PIXEL_SCALE: Tag = Tag::Unknown(33550);
const TIE_POINTS: Tag = Tag::Unknown(33922);
const TRANSFORMATION: Tag = Tag::Unknown(34264);
const GEO_KEYS: Tag = Tag::Unknown(34735);
const GEO_DOUBLES: Tag = Tag::Unknown(34736);
const GEO_TEXTS: Tag = Tag::Unknown(34737);

/// Keys of GeoTIFF whose values are codes of EPSG, and the one that says what coordinates are those of.
const GEOGRAPHIC_KEY: u16 = 2048;
const PROJECTED_KEY: u16 = 3072;
const RASTER_KEY: u16 = 1025;

/// The code for a system that the file describes in another way.
const USER_DEFINED: u16 = 32_767;

/// What tags of GeoTIFF say, as they are.
#[derive(Default)]
pub(in crate::image) struct Georeference {
    pub(in crate::image) doubles: Vec<(Tag, Vec<f64>)>,
    pub(in crate::image) keys: Option<(Tag, Vec<u16>)>,
    pub(in crate::image) text: Option<(Tag, String)>,
}

impl Georeference {
    /// The tags that say where a grid lies; of its reference system the code, if it has one.
    pub(in crate::image) fn of(grid: &Grid, crs: Option<&Crs>) -> Self {
        const MODEL_KEY: u16 = 1024;
        const PROJECTED: u16 = 1;
        const GEOGRAPHIC: u16 = 2;
        const AREA: u16 = 1;
        let ([width, height], Point { x, y }) = (grid.cell, grid.origin);
        let doubles = if width > 0.0 && height < 0.0 {
            vec![
                (PIXEL_SCALE, vec![width, -height, 0.0]),
                (TIE_POINTS, vec![0.0, 0.0, 0.0, x, y, 0.0]),
            ]
        } else {
            let rows =
                [[width, 0.0, 0.0, x], [0.0, height, 0.0, y], [0.0; 4], [0.0, 0.0, 0.0, 1.0]];
            vec![(TRANSFORMATION, rows.concat())]
        };
        let code = crs.and_then(|crs| Some((crs, u16::try_from(crs.epsg_code()?).ok()?)));
        let keys = code.map(|(crs, code)| {
            let (model, key) = match crs.is_geographic() {
                true => (GEOGRAPHIC, GEOGRAPHIC_KEY),
                false => (PROJECTED, PROJECTED_KEY),
            };
            let entries = [[MODEL_KEY, 0, 1, model], [RASTER_KEY, 0, 1, AREA], [key, 0, 1, code]];
            let head = [1, 1, 0, entries.len() as u16];
            (GEO_KEYS, [head].iter().chain(&entries).copied().flatten().collect())
        });
        Self { doubles, keys, text: None }
    }
}

/// What a file says of its place, if it is a TIFF.
pub(in crate::image) fn georeference(bytes: &[u8]) -> Georeference {
    let Ok(mut decoder) = Decoder::new(Cursor::new(bytes)) else {
        return Georeference::default();
    };
    let tags = [PIXEL_SCALE, TIE_POINTS, TRANSFORMATION, GEO_DOUBLES];
    let mut numbers = |tag| Some((tag, decoder.get_tag_f64_vec(tag).ok()?));
    Georeference {
        doubles: tags.into_iter().filter_map(&mut numbers).collect(),
        keys: decoder.get_tag_u16_vec(GEO_KEYS).ok().map(|keys| (GEO_KEYS, keys)),
        text: decoder.get_tag_ascii_string(GEO_TEXTS).ok().map(|text| (GEO_TEXTS, text)),
    }
}

/// Where the image lies, if it says so, and what of that is not used.
pub(super) fn place(decoder: &mut Source<'_>) -> Result<(Option<Place>, Vec<String>), Error> {
    let numbers = |decoder: &mut Source<'_>, tag| decoder.get_tag_f64_vec(tag).ok();
    let keys = decoder.get_tag_u16_vec(GEO_KEYS).unwrap_or_default();
    // Four numbers a key, behind four of the directory: key, where its value is, how many, value.
    let key = |wanted: u16| {
        let mut keys = keys.chunks_exact(4).skip(1);
        keys.find(|key| key[0] == wanted && key[1] == 0).map(|key| key[3])
    };
    let (origin, cell) = if let Some(matrix) = numbers(decoder, TRANSFORMATION) {
        let [a, b, _, d, e, f, _, h] = matrix[..].first_chunk::<8>().copied().unwrap_or_default();
        if b != 0.0 || e != 0.0 {
            let why = "the image is turned or sheared in its coordinate system; warp it first, as with gdalwarp";
            return Err(Error::File { why: why.to_owned() });
        }
        (Point::new(d, h), [a, f])
    } else {
        let scale = numbers(decoder, PIXEL_SCALE);
        let tie = numbers(decoder, TIE_POINTS);
        let (Some([width, height, ..]), Some([i, j, _, x, y, ..])) =
            (scale.as_deref(), tie.as_deref())
        else {
            let are_points = tie.is_some_and(|tie| !tie.is_empty());
            let warning = "its tie points have no scale and are not used: coordinates are those of pixels; warp it \
                           first, as gdalwarp does";
            return Ok((None, are_points.then(|| warning.to_owned()).into_iter().collect()));
        };
        // Rows go down.
        (Point::new(x - i * width, y + j * height), [*width, -height])
    };
    // The numbers are those of the centre of the first pixel.
    let is_point = key(RASTER_KEY) == Some(2);
    let shift = if is_point { 0.5 } else { 0.0 };
    let origin = Point::new(origin.x - shift * cell[0], origin.y - shift * cell[1]);
    let code = key(PROJECTED_KEY).or_else(|| key(GEOGRAPHIC_KEY));
    let warning = "its reference system has no code of EPSG and is left out; assign the one it is, as \
                   gdal_edit.py -a_srs EPSG:CODE does, if output is to name it";
    let warning = (code == Some(USER_DEFINED)).then(|| warning.to_owned());
    let code = code.filter(|&code| code != 0 && code != USER_DEFINED);
    let place = Place { origin, cell, crs: code.map(|code| Crs::epsg(u32::from(code))) };
    Ok((Some(place), warning.into_iter().collect()))
}
