use crate::lesson::Lesson;
use crate::shape::Fallible;
use crate::sheet::{Sample, Sheet};
use crate::style::{CELL, LOST, MEDIAL};
use medial::axis::MedialAxis;
use medial::engine::{Burning, Options, brushfire, raster_transform};
use medial::geom::Point;
use medial::raster::{Grid, Mask, mask_of_disks};
use medial_io::{Format, ReadOptions, image};

pub const LESSON: Lesson = Lesson {
    title: "Inversion of medial cells [VS87, Fig. 14]",
    text: "A silhouette of few pixels, and what the disks of its medial cells give back. \
           A brushfire takes some of the cells for medial; the disks around them leave pixels out, and the same \
           brushfire in what came back takes others. The cells of `raster_transform --prune none` give back every \
           pixel, and are found again. [docs/raster.md](../raster.md) has the numbers for 210 silhouettes.",
    draw,
};

/// Of so many pixels in each direction one is taken.
const EVERY: u32 = 6;

fn draw() -> Fallible<String> {
    let mask = small_horse()?;
    let Grid { columns, rows, .. } = *mask.grid();
    let window = (Point::new(0.0, -f64::from(rows)), Point::new(columns.into(), 0.0));
    let options = Options::default();
    let exact = Options { residual: None, ..options };
    let burn = |mask: &Mask| brushfire(mask, Burning::Isotropic, &options);
    let transform = |mask: &Mask| raster_transform(mask, &exact);
    let mut sheet = Sheet::new(2, (430.0, 340.0));
    for (name, axis, again) in [
        ("brushfire", burn(&mask)?, &burn as &dyn Fn(&Mask) -> _),
        ("raster_transform, all cells", transform(&mask)?, &transform),
    ] {
        let back = mask_of_disks(&axis, mask.grid())?;
        let lost = Mask::new(*mask.grid(), |x, y| mask.get(x, y) && !back.get(x, y))?;
        let mut panel = sheet.panel(window, &format!("(a), (b): medial cells of {name}"));
        panel.cells(&mask, CELL);
        panel.cells(&cells(&axis, mask.grid())?, MEDIAL);
        let caption = format!("(c): what comes back, {} pixels less", lost.count());
        let mut panel = sheet.panel(window, &caption);
        panel.cells(&lost, LOST);
        panel.cells(&back, CELL);
        panel.cells(&cells(&again(&back)?, mask.grid())?, MEDIAL);
    }
    sheet.legend(&[
        (Sample::Area(CELL), "pixels of the shape"),
        (Sample::Area(MEDIAL), "medial"),
        (Sample::Area(LOST), "not given back"),
    ]);
    Ok(sheet.finish(LESSON.title))
}

/// The horse with fewer pixels.
fn small_horse() -> Fallible<Mask> {
    let bytes = include_bytes!("../../../../fixtures/images/horse.png");
    let options = ReadOptions { invert: true, ..ReadOptions::default() };
    let (horse, _) = image::read_mask(Format::Png, bytes, &options)?;
    let grid = Grid::of_image(horse.grid().columns / EVERY, horse.grid().rows / EVERY);
    Ok(Mask::new(grid, |x, y| horse.get(EVERY * x + EVERY / 2, EVERY * y + EVERY / 2))?)
}

/// The cells at the keypoints of an axis.
fn cells(axis: &MedialAxis, grid: &Grid) -> Fallible<Mask> {
    let mut cells = Mask::empty(*grid)?;
    for keypoint in axis.keypoints() {
        let [x, y] = grid.locate(keypoint.position);
        cells.put(x as u32, y as u32, true);
    }
    Ok(cells)
}
