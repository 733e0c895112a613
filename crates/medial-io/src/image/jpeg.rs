use super::{Header, Image, Values, Wanted, banded, coloured, flattened};
use crate::Error;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// A JPEG image: grey, coloured, or of four inks; decoded whole, as its parts may come more than once.
struct Jpeg<'b> {
    decoder: JpegDecoder<ZCursor<&'b [u8]>>,
    header: Header,
}

fn wrong(error: impl std::fmt::Debug) -> Error {
    let error = format!("{error:?}").replace('\n', " ");
    let why = format!("the image cannot be read: {}; save it again as JPEG or PNG", error.trim());
    Error::File { why }
}

/// Opens a JPEG image.
pub(super) fn open(bytes: &[u8]) -> Result<Box<dyn Image + '_>, Error> {
    // What is broken off is an error, not grey.
    let options = DecoderOptions::default()
        .set_strict_mode(true)
        .set_max_width(usize::from(u16::MAX))
        .set_max_height(usize::from(u16::MAX));
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(wrong)?;
    let info = decoder.info().ok_or_else(|| wrong("it has no head"))?;
    let is_grey = info.components == 1;
    let space = if is_grey { ColorSpace::Luma } else { ColorSpace::RGB };
    decoder.set_options(options.jpeg_set_out_colorspace(space));
    let (columns, rows) = (u32::from(info.width), u32::from(info.height));
    let n_bands = if is_grey { 1 } else { 3 };
    let header = Header {
        columns,
        rows,
        place: None,
        n_bands,
        alpha: None,
        is_colour: true,
        is_wide: false,
        warnings: Vec::new(),
    };
    Ok(Box::new(Jpeg { decoder, header }))
}

impl Image for Jpeg<'_> {
    fn header(&self) -> &Header {
        &self.header
    }

    fn decode(
        mut self: Box<Self>,
        wanted: Wanted<'_>,
        take: &mut dyn FnMut(u32, Values),
    ) -> Result<(), Error> {
        let samples = self.decoder.decode().map_err(wrong)?;
        let each = self.header.n_bands;
        let numbers = || samples.iter().copied().map(f32::from).collect::<Vec<_>>();
        take(
            0,
            match wanted {
                Wanted::Colour => coloured(&numbers(), each, each, false, 255.0),
                Wanted::Bands(bands) => banded(&numbers(), each, bands, false, 255.0),
                Wanted::Value if each == 1 => Values::Bytes(samples),
                Wanted::Value => flattened(&samples, each, each, None),
            },
        );
        Ok(())
    }
}
