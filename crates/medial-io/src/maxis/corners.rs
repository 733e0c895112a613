//! Polygons, corner by corner, bit for bit.

use super::cursor::Fault;
use super::numbers::{EXPONENTS, MOST_PLACES, Scale, push, push_signed};
use super::read::Body;
use super::write::{Columns, EFFORT, engine};
use super::{Anchor, BINARY, BITS, Column, DECIMAL, DOUBLES, origin};
use medial::geom::Point;
use medial::ops::Corners;

pub(super) fn write(columns: &mut Columns, corners: &Corners, anchor: &mut Option<Anchor>) {
    let points = corners.polygons.iter().flatten().flatten();
    let scale = Scale::of(points.flat_map(|p| [p.x, p.y]));
    let mut grid = match scale {
        Scale::Decimal(places) => (DECIMAL, places.into()),
        Scale::Binary(exponent) => (BINARY, exponent.into()),
        Scale::Bits => (BITS, 0),
    };
    let [mut x, mut y] = steps(corners, scale, origin(*anchor, grid));
    if scale == Scale::Bits {
        // Where points are there twice, differences only hide it.
        let plain = doubles(corners);
        if deflated(&plain) < deflated(&[&x[..], &y].concat()) {
            (grid, x, y) = ((DOUBLES, 0), plain, Vec::new());
        }
    }
    let first = corners.polygons.iter().flatten().flatten().next();
    if let Some(first) = first.filter(|_| grid.0 != DOUBLES) {
        *anchor = Some(Anchor { grid, x: scale.number(first.x), y: scale.number(first.y) });
    }
    let plan = columns.of(Column::Plan);
    plan.push(grid.0);
    plan.push(engine(corners.engine));
    push_signed(plan, grid.1.into());
    push(plan, single(corners.error).to_bits().into());
    push(plan, 2 * corners.polygons.len() as u64 + u64::from(corners.regroup));
    for polygon in &corners.polygons {
        push(plan, polygon.len() as u64);
        for ring in polygon {
            push(plan, 2 * own(ring).len() as u64 + u64::from(is_closed(ring)));
        }
    }
    columns.of(Column::X).extend(x);
    columns.of(Column::Y).extend(y);
}

/// The points that are written, as differences.
fn steps(corners: &Corners, scale: Scale, mut first: (i64, i64)) -> [Vec<u8>; 2] {
    let [mut xs, mut ys] = [const { Vec::new() }; 2];
    for ring in corners.polygons.iter().flatten() {
        let mut last = first;
        for (k, point) in own(ring).iter().enumerate() {
            let (x, y) = (scale.number(point.x), scale.number(point.y));
            push_signed(&mut xs, x.wrapping_sub(last.0));
            push_signed(&mut ys, y.wrapping_sub(last.1));
            last = (x, y);
            if k == 0 {
                first = last;
            }
        }
    }
    [xs, ys]
}

/// The points that are written, as they are.
fn doubles(corners: &Corners) -> Vec<u8> {
    let points = corners.polygons.iter().flatten().flat_map(|ring| own(ring));
    points.flat_map(|p| [p.x, p.y]).flat_map(f64::to_le_bytes).collect()
}

fn deflated(bytes: &[u8]) -> usize {
    miniz_oxide::deflate::compress_to_vec(bytes, EFFORT).len()
}

/// The points of a ring without the one that closes it.
fn own(ring: &[Point]) -> &[Point] {
    &ring[..ring.len() - usize::from(is_closed(ring))]
}

/// The least number of single precision that is no less, or the largest there is.
fn single(error: f64) -> f32 {
    let near = error as f32;
    let up = if f64::from(near) < error { near.next_up() } else { near };
    up.clamp(0.0, f32::MAX)
}

/// Whether the last point of a ring is the first one again, bit for bit.
fn is_closed(ring: &[Point]) -> bool {
    let bits = |p: &Point| (p.x.to_bits(), p.y.to_bits());
    ring.len() > 1 && ring.first().map(bits) == ring.last().map(bits)
}

pub(super) fn read(
    body: &mut Body,
    kind: u8,
    anchor: &mut Option<Anchor>,
) -> Result<Corners, Fault> {
    let engine = body.engine()?;
    let detail = body.signed(Column::Plan)?;
    let off = || format!("a grid of {detail} is out of range");
    let scale = match kind {
        DECIMAL => Scale::Decimal(
            u8::try_from(detail).ok().filter(|&places| places <= MOST_PLACES).ok_or_else(off)?,
        ),
        BINARY => Scale::Binary(
            i16::try_from(detail).ok().filter(|e| EXPONENTS.contains(e)).ok_or_else(off)?,
        ),
        BITS | DOUBLES if detail == 0 => Scale::Bits,
        BITS | DOUBLES => return Err(off()),
        _ => return Err(format!("{kind} is no kind of feature")),
    };
    // In range: checked above.
    let grid = (kind, detail as i32);
    let error = u32::try_from(body.number(Column::Plan)?).map(f32::from_bits).ok();
    let error = error.filter(|error| error.is_finite() && !error.is_sign_negative());
    let error = error.ok_or("its error is out of range")?.into();
    let head = body.number(Column::Plan)?;
    let (n_polygons, regroup) = (body.fits(Column::Plan, head >> 1)?, head & 1 == 1);
    let mut first = origin(*anchor, grid);
    let mut is_first = true;
    let mut polygons = Vec::new();
    for _ in 0..n_polygons {
        let n_rings = body.number(Column::Plan)?;
        let mut rings = Vec::new();
        for _ in 0..body.fits(Column::Plan, n_rings)? {
            let head = body.number(Column::Plan)?;
            let n = body.fits(Column::X, head >> 1)?;
            let mut ring = Vec::with_capacity(n + 1);
            let mut last = first;
            for k in 0..n {
                if kind == DOUBLES {
                    ring.push(Point::new(body.double(Column::X)?, body.double(Column::X)?));
                    continue;
                }
                last.0 = last.0.wrapping_add(body.signed(Column::X)?);
                last.1 = last.1.wrapping_add(body.signed(Column::Y)?);
                ring.push(Point::new(scale.value(last.0), scale.value(last.1)));
                if k == 0 {
                    first = last;
                }
                if std::mem::take(&mut is_first) {
                    *anchor = Some(Anchor { grid, x: last.0, y: last.1 });
                }
            }
            if let (1, Some(&start)) = (head & 1, ring.first()) {
                ring.push(start);
            }
            rings.push(ring);
        }
        polygons.push(rings);
    }
    Ok(Corners { engine, regroup, error, polygons })
}
