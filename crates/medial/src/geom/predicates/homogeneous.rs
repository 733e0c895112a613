//! A disk as numbers of a tower, and the exact forms of the questions about it.

use std::borrow::Cow;
use std::cmp::Ordering;

use dashu_int::IBig;

use super::grid::{Grid, Vector};
use super::tower::{Surd, Tower};
use crate::geom::Point;

/// A disk on a grid: centre `(x, y)/w` from the grid's origin.
#[derive(Clone, Debug)]
pub(super) struct Homogeneous {
    pub(super) grid: Grid,
    /// The grid's origin lies on the circle.
    pub(super) through_origin: bool,
    /// The roots that all the numbers below are made of.
    pub(super) tower: Tower,
    pub(super) x: Surd,
    pub(super) y: Surd,
    /// Always positive.
    pub(super) w: Surd,
    pub(super) radius: Radius,
}

/// A radius, given through a number `part` of the tower.
#[derive(Clone, Debug)]
pub(super) enum Radius {
    /// `part/(√n·w)`
    Over { part: Surd, n: IBig },
    /// `part·√n/w`
    Times { part: Surd, n: IBig },
}

impl Radius {
    fn part(&self) -> &Surd {
        match self {
            Self::Over { part, .. } | Self::Times { part, .. } => part,
        }
    }
}

impl Homogeneous {
    /// The order of the distance of a corner against the radius.
    pub(super) fn side_of_corner(&self, p: Point) -> Ordering {
        let disk = self.on_grid_of(&[p]);
        let p = disk.grid.local(p);
        if disk.through_origin {
            // (|p - c|² - |c|²)·w
            let chord = disk.linear(&p).shift(1);
            return disk.tower.sign(&disk.w.scale(&p.norm2()).sub(&chord));
        }
        let x = disk.x.sub(&disk.w.scale(&p.x));
        let y = disk.y.sub(&disk.w.scale(&p.y));
        let distance = disk.tower.square(&x).add(&disk.tower.square(&y));
        let difference = match &disk.radius {
            Radius::Over { part, n } => distance.scale(n).sub(&disk.tower.square(part)),
            Radius::Times { part, n } => distance.sub(&disk.tower.square(part).scale(n)),
        };
        disk.tower.sign(&difference)
    }

    /// The order of the signed distance of a supporting line against the radius.
    pub(super) fn side_of_line(&self, a: Point, b: Point) -> Ordering {
        let disk = self.on_grid_of(&[a, b]);
        let d = disk.grid.difference(a, b).direction();
        let distance = disk.linear_from(&disk.grid.local(a), &d.perp());
        let mut tower = disk.tower.clone();
        // The two distances times w·√(d·d), and in the first case also times n.
        let (distance, radius) = match &disk.radius {
            Radius::Over { part, n } => {
                let root = tower.root(Surd::integer(n * d.norm2()));
                (distance.scale(n), tower.mul(part, &root))
            }
            Radius::Times { part, n } => {
                let root = tower.root(Surd::integer(n * d.norm2()));
                (distance, tower.mul(part, &root))
            }
        };
        tower.sign(&distance.sub(&radius))
    }

    /// The sign of `(b - a)×(c - a)`.
    pub(super) fn front(&self, a: Point, b: Point) -> Ordering {
        let disk = self.on_grid_of(&[a, b]);
        let across = disk.grid.difference(a, b).direction().perp();
        disk.tower.sign(&disk.linear_from(&disk.grid.local(a), &across))
    }

    /// The sign of `(b - a)·(c - p)`.
    pub(super) fn along(&self, a: Point, b: Point, p: Point) -> Ordering {
        let disk = self.on_grid_of(&[a, b, p]);
        let direction = disk.grid.difference(a, b).direction();
        disk.tower.sign(&disk.linear_from(&disk.grid.local(p), &direction))
    }

    /// The order of the radius against a length that is not negative.
    pub(super) fn compare_radius(&self, length: f64) -> Ordering {
        let ends = [Point::default(), Point::new(length, 0.0)];
        let disk = self.on_grid_of(&ends);
        let length = disk.grid.difference(ends[0], ends[1]).x;
        // Squares of the radius and of the length times w, and in the first case also times n.
        let square = |number: &Surd| disk.tower.square(number);
        let difference = match &disk.radius {
            Radius::Over { part, n } => {
                square(part).sub(&square(&disk.w).scale(&(&length * &length * n)))
            }
            Radius::Times { part, n } => {
                square(part).scale(n).sub(&square(&disk.w).scale(&(&length * &length)))
            }
        };
        disk.tower.sign(&difference)
    }

    /// The order of the radius against that of another disk.
    pub(super) fn compare_radii(&self, other: &Self) -> Ordering {
        let unit = self.grid.unit.min(other.grid.unit);
        let (this, other) = (self.on_unit(unit), other.on_unit(unit));
        let mut tower = this.tower.clone();
        let roots = tower.adjoin(&other.tower);
        let part = tower.image(other.radius.part(), &roots);
        let w = tower.image(&other.w, &roots);
        // Squares of both radii times those of both w, without fractions.
        let ours = tower.mul(&tower.square(this.radius.part()), &tower.square(&w));
        let theirs = tower.mul(&tower.square(&part), &tower.square(&this.w));
        let (ours, theirs) = match (&this.radius, &other.radius) {
            (Radius::Over { n, .. }, Radius::Over { n: m, .. }) => (ours.scale(m), theirs.scale(n)),
            (Radius::Over { n, .. }, Radius::Times { n: m, .. }) => (ours, theirs.scale(&(n * m))),
            (Radius::Times { n, .. }, Radius::Over { n: m, .. }) => (ours.scale(&(n * m)), theirs),
            (Radius::Times { n, .. }, Radius::Times { n: m, .. }) => {
                (ours.scale(n), theirs.scale(m))
            }
        };
        tower.sign(&ours.sub(&theirs))
    }

    /// The sign of `v·(c - c')` for another disk, with `v` the direction `a` → `b` after a turn.
    pub(super) fn compare(
        &self,
        other: &Self,
        a: Point,
        b: Point,
        turn: impl FnOnce(Vector) -> Vector,
    ) -> Ordering {
        // Both disks on one grid unit, each with its own origin.
        let grid = self.grid.refined(&[a, b, other.grid.origin]).at_most(other.grid.unit);
        let (this, other) = (self.on_unit(grid.unit), other.on_unit(grid.unit));
        let v = turn(grid.difference(a, b).direction());
        let ours = this.linear_from(&grid.local(other.grid.origin), &v);
        let theirs = other.linear(&v);
        let mut tower = this.tower.clone();
        let roots = tower.adjoin(&other.tower);
        let theirs = tower.mul(&tower.image(&theirs, &roots), &this.w);
        let ours = tower.mul(&ours, &tower.image(&other.w, &roots));
        tower.sign(&ours.sub(&theirs))
    }

    /// `v·c·w`, for the centre from the origin.
    fn linear(&self, v: &Vector) -> Surd {
        self.x.scale(&v.x).add(&self.y.scale(&v.y))
    }

    /// `v·(c - p)·w`, for `p` from the origin.
    fn linear_from(&self, p: &Vector, v: &Vector) -> Surd {
        self.linear(v).sub(&self.w.scale(&v.dot(p)))
    }

    /// The same disk on a grid that also holds the given points.
    fn on_grid_of(&self, points: &[Point]) -> Cow<'_, Self> {
        self.on_unit(self.grid.refined(points).unit)
    }

    /// The same disk on a finer grid, or as it is.
    fn on_unit(&self, unit: i32) -> Cow<'_, Self> {
        if unit >= self.grid.unit {
            return Cow::Borrowed(self);
        }
        // Only lengths change: the centre and the radius, not the ratios.
        let bits = (self.grid.unit - unit) as usize;
        let radius = match &self.radius {
            Radius::Over { part, n } => Radius::Over { part: part.shift(bits), n: n.clone() },
            Radius::Times { part, n } => Radius::Times { part: part.shift(bits), n: n.clone() },
        };
        Cow::Owned(Self {
            grid: Grid { unit, ..self.grid },
            through_origin: self.through_origin,
            tower: self.tower.clone(),
            x: self.x.shift(bits),
            y: self.y.shift(bits),
            w: self.w.clone(),
            radius,
        })
    }
}
