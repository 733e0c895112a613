//! Fig. 14 of [VS87] for any bitmap: the medial cells of each engine, what their disks give back, and the medial
//! cells of that.

use medial::axis::MedialAxis;
use medial::domain::{Domain, FillRule, Options};
use medial::engine::{
    self, Burning, RidgeOptions, brushfire, path_tracing, raster_transform, ridge_following_of_mask,
};
use medial::ops::{Hierarchy, Measure, disks, tangent_polygons};
use medial::raster::{Grid, Mask, digitise, mask_of_disks, outline};

use crate::measure::Error;

/// How well a shape comes back.
pub struct Inverse {
    /// The engine and what is made of its axis.
    pub name: String,
    /// Cells of both the shape and what came back, as a share of those of either.
    pub common: f64,
    /// Farthest cell of one from the other, in pixels.
    pub distance: f64,
    /// Points of the axis for each cell of the shape.
    pub points: f64,
    /// Medial cells that are medial of both shapes, as a share of those of either; only for engines on cells.
    pub again: Option<f64>,
}

/// The chord residual, in pixels, at which axes are pruned.
const CHORD: f64 = 2.0;

/// The distance of points along exact axes, in pixels.
const STEP: f64 = 1.0;

/// All engines on a mask.
pub fn all(mask: &Mask) -> Result<Vec<Inverse>, Error> {
    let options = engine::Options::default();
    type Engine = Box<dyn Fn(&Mask) -> Result<MedialAxis, Error>>;
    let whole = engine::Options { residual: None, ..options };
    let mut engines: Vec<(String, Engine)> = vec![
        (
            "raster_transform, all".to_owned(),
            Box::new(move |mask| Ok(raster_transform(mask, &whole)?)),
        ),
        (
            "raster_transform".to_owned(),
            Box::new(move |mask| Ok(raster_transform(mask, &options)?)),
        ),
        (
            "ridge_following".to_owned(),
            Box::new(move |mask| {
                Ok(ridge_following_of_mask(mask, &RidgeOptions::default(), &options)?.axis)
            }),
        ),
    ];
    for &burning in Burning::ALL {
        let burn: Engine = Box::new(move |mask| Ok(brushfire(mask, burning, &options)?));
        engines.push((format!("brushfire, {burning}"), burn));
    }
    let mut found = exact(mask)?;
    for (name, engine) in engines {
        let axis = engine(mask)?;
        let back = mask_of_disks(&axis, mask.grid())?;
        let cells = cells(&axis, mask.grid())?;
        let again = match back.count() {
            0 => 0.0,
            _ => common(&cells, &self::cells(&engine(&back)?, mask.grid())?),
        };
        found.push(inverse(name, mask, &back, axis.keypoints().len(), Some(again)));
    }
    Ok(found)
}

/// The exact axis of the outline: the union of disks along it, and the polygons of II.C.
fn exact(mask: &Mask) -> Result<Vec<Inverse>, Error> {
    let domain = Domain::from_polygons(&outline(mask), &Options::default())?;
    let axis = path_tracing(&domain)?;
    let pruned = Hierarchy::new(&domain, &axis)?.pruned(Measure::Chord, CHORD).axis;
    let mut found = Vec::new();
    for (name, axis) in [("path_tracing", &axis), ("path_tracing, chord=2", &pruned)] {
        let disks = disks(axis, STEP);
        let mut back = Mask::empty(*mask.grid())?;
        for disk in &disks {
            draw(&mut back, disk.centre.x, -disk.centre.y, disk.radius);
        }
        found.push(inverse(format!("{name}, disks"), mask, &back, disks.len(), None));
        let options = Options { repair: true, fill: FillRule::NonZero, ..Options::default() };
        let back = tangent_polygons(axis, STEP)
            .map_err(Error::from)
            .and_then(|polygons| Ok(Domain::from_polygons(&polygons, &options)?))
            .and_then(|domain| Ok(digitise(&domain, mask.grid())?));
        if let Ok(back) = back {
            found.push(inverse(format!("{name}, polygons"), mask, &back, disks.len(), None));
        }
    }
    Ok(found)
}

/// Fills the cells whose centres lie in a disk, columns and rows from the upper left corner.
fn draw(mask: &mut Mask, x: f64, y: f64, radius: f64) {
    let Grid { columns, rows, .. } = *mask.grid();
    // Corners of cells are positions of the boundary; its own rounding must not lose a cell.
    let radius = radius + 1e-9;
    let first = (y - radius - 0.5).ceil().max(0.0) as u32;
    for row in (first..rows).take_while(|&row| f64::from(row) + 0.5 <= y + radius) {
        let down = f64::from(row) + 0.5 - y;
        let half = (radius * radius - down * down).max(0.0).sqrt();
        let from = (x - half - 0.5).ceil().max(0.0) as u32;
        let to = ((x + half + 0.5).floor().max(0.0) as u32).min(columns);
        if from < to {
            mask.fill(row, from, to);
        }
    }
}

fn inverse(name: String, mask: &Mask, back: &Mask, n: usize, again: Option<f64>) -> Inverse {
    let points = n as f64 / mask.count().max(1) as f64;
    let distance = away(mask, back).max(away(back, mask));
    Inverse { name, common: common(mask, back), distance, points, again }
}

/// The cells of an axis as a mask.
fn cells(axis: &MedialAxis, grid: &Grid) -> Result<Mask, Error> {
    let mut cells = Mask::empty(*grid)?;
    for keypoint in axis.keypoints() {
        let [x, y] = grid.locate(keypoint.position);
        cells.put(x as u32, y as u32, true);
    }
    Ok(cells)
}

/// Common cells as a share of all.
fn common(a: &Mask, b: &Mask) -> f64 {
    let count = |of: &dyn Fn(u8, u8) -> u8| -> f64 {
        let row = |y| a.row(y).iter().zip(b.row(y)).map(|(&a, &b)| of(a, b).count_ones());
        (0..a.grid().rows).flat_map(row).map(f64::from).sum()
    };
    count(&|a, b| a & b) / count(&|a, b| a | b).max(1.0)
}

/// How far cells of the one are from the other at most; infinite if that has none.
fn away(a: &Mask, b: &Mask) -> f64 {
    if b.count() == 0 {
        return f64::INFINITY;
    }
    let mut most = 0_i64;
    for y in 0..a.grid().rows {
        for x in a.cells(y).filter(|&x| !b.get(x, y)) {
            most = most.max(nearest(b, x.into(), y.into()));
        }
    }
    (most as f64).sqrt()
}

/// The square of the distance of a cell from the nearest one of a mask.
fn nearest(mask: &Mask, x: i64, y: i64) -> i64 {
    let mut best = i64::MAX;
    for ring in 0_i64.. {
        if ring * ring >= best {
            break;
        }
        for dy in -ring..=ring {
            let step = if dy.abs() == ring { 1 } else { (2 * ring).max(1) };
            for dx in (-ring..=ring).step_by(step as usize) {
                let at = (u32::try_from(x + dx), u32::try_from(y + dy));
                if let (Ok(u), Ok(v)) = at
                    && mask.get(u, v)
                {
                    best = best.min(dx * dx + dy * dy);
                }
            }
        }
    }
    best
}
