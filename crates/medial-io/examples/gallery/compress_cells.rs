use crate::lesson::Lesson;
use crate::shape::Fallible;
use crate::sheet::Sheet;
use crate::style::{CELL, DISK, MEDIAL};
use medial::geom::Point;
use medial::ops::{Compressed, MaskMethod, MaskOptions, compress_mask};
use medial::raster::{Grid, Mask};
use medial_io::maxis::{self, Record};
use medial_io::{Format, ReadOptions, image};

pub const LESSON: Lesson = Lesson {
    title: "Cells in few bytes",
    text: "`medial compress horse.png --invert` by three of its methods: the chain of the medial cells, \
           the disks that cover 99% of the shape, and as many squares as that takes, which are the medial axis \
           of the distance by rows and columns. The outline alone takes fewer bytes than any of them.",
    draw,
};

/// The share of the shape that is covered.
const COVERAGE: f64 = 0.99;

fn draw() -> Fallible<String> {
    let bytes = include_bytes!("../../../../fixtures/images/horse.png");
    let options = ReadOptions { invert: true, ..ReadOptions::default() };
    let (mask, _) = image::read_mask(Format::Png, bytes, &options)?;
    let Grid { columns, rows, .. } = *mask.grid();
    let window = (Point::new(0.0, -f64::from(rows)), Point::new(columns.into(), 0.0));
    let mut sheet = Sheet::new(2, (400.0, 330.0));
    for method in MaskMethod::ALL.iter().copied() {
        let code = compress_mask(
            &mask,
            &MaskOptions { method, coverage: COVERAGE, ..MaskOptions::default() },
        )?;
        let back = code.mask()?;
        let lost = 100.0 * code.missing as f64 / mask.count() as f64;
        let n = code.balls().len();
        let shape = Compressed::Mask(code.clone());
        let size = maxis::write(None, &[Record { feature: 0, id: None, shape }]).len();
        let what = match method {
            MaskMethod::Chain => format!("a chain of {n} cells"),
            MaskMethod::Cover => format!("{n} disks"),
            MaskMethod::Squares => format!("{n} squares"),
            MaskMethod::Crack => "the outline".to_owned(),
        };
        let mut panel = sheet.panel(window, &format!("{what}: {size} bytes, {lost:.1}% lost"));
        panel.cells(&back, CELL);
        let mut centres = Mask::empty(*mask.grid())?;
        for ball in code.balls() {
            centres.put(ball.x, ball.y, true);
            let centre = mask.grid().centre(ball.x, ball.y);
            match method {
                MaskMethod::Cover => panel.disk(centre, f64::from(ball.size).sqrt() - 0.5, DISK),
                MaskMethod::Squares => {
                    let reach = f64::from(ball.size) - 0.5;
                    let corner = Point::new(reach, reach);
                    panel.rectangle(centre - corner, centre + corner, DISK);
                }
                MaskMethod::Chain | MaskMethod::Crack => {}
            }
        }
        if method == MaskMethod::Chain {
            panel.cells(&centres, MEDIAL);
        }
    }
    Ok(sheet.finish(LESSON.title))
}
