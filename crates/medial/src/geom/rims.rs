//! Edges relative to a circle that a run of them follows, for disks that follow it as well.
//!
//! # Contract
//! Whatever [`Rim::sift`] leaves out lies on a line that is certainly farther from a disk's centre, on
//! the side of the disk, than the radius. [`Pinned::touching`] gives the disk of three lines, with a
//! bound as of [`TouchingDisk`].
//!
//! # Method
//! Where thousands of edges touch nearly the same disk, their distances from its centre less its radius
//! are differences of the last bits of coordinates. Each edge keeps that residual for a circle nearby,
//! computed in pairs of doubles and rounded once; for a disk whose centre and radius are given relative
//! to such a circle, `h + n·δ - δ_r` is then right to half an ulp of δ, far below one of the radius.
//! Eight edges are tested together.
//!
//! A [`Hoop`] does the same for eight runs: each keeps one normal, how far those of its lines spread
//! around it, and the least of their residuals. For a unit vector `n` with `|n - m| <= s` and `t` across
//! `m`, `n·δ >= m·δ - |m·δ| s²/2 - |t·δ| s`.
//!
//! # Departures
//! None.

use super::lanes::{FAN, Wide};
use super::{Double, Point, TouchingDisk, U};

/// Rounding of a residual in pairs of doubles, relative to the sizes that enter it: twenty operations
/// of at most 2^-100 each, with room to spare.
const ROUNDING: f64 = 1.0 / (1_u128 << 90) as f64;

/// Error of a disk, as a share of its radius, up to which pairs of doubles are not needed.
const SHARP: f64 = 1.0 / (1_u128 << 72) as f64;

/// More than what underflows in a residual between doubles with exponents of at most 200 in magnitude.
const VANISHING: f64 = f64::from_bits((1023 - 480) << 52);

/// Radius of a circle, in lengths of the run, beyond which the run is as good as straight.
const FLAT: f64 = (1_u64 << 40) as f64;

/// Edges of a leaf that are shown without another look at them.
pub(super) const SOME: u32 = 2;

/// One number to an edge.
type Eight = [f64; FAN];

/// Eight edges and the circle they are measured by.
#[derive(Clone, Debug)]
pub struct Rim {
    centre: Point,
    radius: f64,
    /// Bound on the error of the residuals of the circle itself and of sums with them.
    blur: f64,
    /// Unit normals, each component within 4u of its own.
    nx: Eight,
    ny: Eight,
    /// Distances of the centre from the lines, less the radius.
    rest: Eight,
}

/// A disk relative to a circle near it, `|w·(c* - c) - (r* - r)| <= bound` for every unit vector `w`.
#[derive(Clone, Copy, Debug)]
pub struct Pinned {
    /// Middle of the circle.
    pub base: Point,
    /// Its radius.
    pub base_radius: f64,
    /// Centre of the disk, relative to that of the circle.
    pub centre: Point,
    /// Its radius, less that of the circle.
    pub radius: f64,
    /// Bound on the error.
    pub bound: f64,
    /// Where it is the disk of three lines, their normals, what the residual of each may be, and the
    /// inverse of twice the area of the triangle of normals; not a number where it is not.
    normals: [Point; 3],
    open: [f64; 3],
    per: f64,
}

/// A disk relative to the circle of a rim.
struct Moved {
    by: Point,
    more: f64,
    error: f64,
}

/// Centre of the circle through both ends of a run and the start of an edge in its middle, and the
/// distance of that edge from it; its end where there is no circle.
pub(super) fn circle(first: Point, (q, to): (Point, Point), last: Point) -> (Point, f64) {
    let (a, b) = (q - first, last - first);
    let way = Point::circumcentre(a, b);
    let centre = first + way;
    let d = to - q;
    let radius = (d.cross(centre - q) / d.norm()).abs();
    let near = way.norm2() <= FLAT * FLAT * (a.norm2() + b.norm2()) && radius.is_finite();
    if near { (centre, radius) } else { (to, 0.0) }
}

impl Rim {
    /// Edges, each given by its ends, relative to a circle.
    pub(super) fn new((centre, radius): (Point, f64), ends: &[(Point, Point); FAN]) -> Self {
        let mut rim =
            Self { centre, radius, blur: 0.0, nx: [0.0; FAN], ny: [0.0; FAN], rest: [0.0; FAN] };
        let mut blur = 0.0;
        for (k, &(a, b)) in ends.iter().enumerate() {
            let (dx, dy) = (Double::difference(b.x, a.x), Double::difference(b.y, a.y));
            let (qx, qy) = (Double::difference(centre.x, a.x), Double::difference(centre.y, a.y));
            let length = Double::sum_of_products(dx, dx, dy, dy).sqrt();
            let cross = Double::sum_of_products(dx, qy, -dy, qx);
            let rest = cross.less_product(radius.into(), length) / length.value();
            rim.nx[k] = -dy.value() / length.value();
            rim.ny[k] = dx.value() / length.value();
            rim.rest[k] = rest;
            let size = qx.value().abs() + qy.value().abs() + radius;
            // A residual that is not a number leaves out nothing.
            blur = f64::max(blur, 8.0 * U * rest.abs() + ROUNDING * size + VANISHING);
        }
        rim.blur = blur;
        rim
    }

    /// A disk relative to this circle, and what any residual of it may be off.
    ///
    /// Each difference is off by half an ulp of its own, and so are products and sums of them; with the
    /// normals that makes less than 12u for each length.
    #[inline]
    fn moved(&self, disk: &Pinned) -> Moved {
        let way = disk.base - self.centre;
        let by = way + disk.centre;
        let growth = disk.base_radius - self.radius;
        let more = growth + disk.radius;
        let size = way.x.abs()
            + way.y.abs()
            + disk.centre.x.abs()
            + disk.centre.y.abs()
            + growth.abs()
            + disk.radius.abs();
        Moved { by, more, error: 16.0 * U * size + self.blur }
    }

    /// The distance of a disk's centre from the line of an edge, less the radius, and a bound on its error.
    #[inline]
    #[must_use]
    pub fn rest(&self, k: usize, disk: &Pinned) -> (f64, f64) {
        let Moved { by, more, error } = self.moved(disk);
        let along = self.nx[k] * by.x + self.ny[k] * by.y;
        let bound = disk.bound_towards(Point::new(self.nx[k], self.ny[k]));
        ((along + self.rest[k]) - more, (error + bound) * (1.0 + 8.0 * U))
    }

    /// The bits of those edges whose lines are not certainly clear of a disk.
    #[inline]
    pub(super) fn sift(&self, disk: &Pinned, mask: u32, wide: Option<Wide>) -> u32 {
        let mask = self.sift_at_once(disk, mask, wide);
        // What a disk may be off differs by direction.
        if mask.count_ones() > SOME && disk.is_solved() {
            return mask & !clear_of(self, &[0.0; FAN], disk, true, wide);
        }
        mask
    }

    /// The same with one bound for all.
    #[inline]
    fn sift_at_once(&self, disk: &Pinned, mask: u32, wide: Option<Wide>) -> u32 {
        let Moved { by, more, error } = self.moved(disk);
        let least = more + (error + disk.bound) * (1.0 + 8.0 * U);
        #[cfg(target_arch = "x86_64")]
        if let Some(wide) = wide {
            return mask & !wide.clear_of(self, by, least);
        }
        let _ = wide;
        let mut mask = mask;
        for k in 0..FAN {
            if self.nx[k] * by.x + self.ny[k] * by.y + self.rest[k] > least {
                mask &= !(1 << k);
            }
        }
        mask
    }
}

/// Eight runs of edges relative to a circle.
#[derive(Clone, Debug)]
pub(super) struct Hoop {
    /// One normal of each run, and the least residual of its lines.
    rim: Rim,
    /// How far the normals of the lines of each run are from that one.
    spread: Eight,
}

impl Hoop {
    /// The runs that are the edges of some rims, of eight at most.
    pub(super) fn over_rims(rims: &[Rim]) -> Self {
        Self::over(rims.len(), |k| (&rims[k], &[0.0; FAN]))
    }

    /// The runs that are those of some others together, of eight at most.
    pub(super) fn over_hoops(hoops: &[Self]) -> Self {
        Self::over(hoops.len(), |k| (&hoops[k].rim, &hoops[k].spread))
    }

    fn over<'a>(n: usize, below: impl Fn(usize) -> (&'a Rim, &'a Eight)) -> Self {
        let middle = below(n / 2).0;
        let mut rim = Rim { nx: [0.0; FAN], ny: [0.0; FAN], rest: [0.0; FAN], ..*middle };
        let mut spread = [0.0; FAN];
        for (k, spread) in spread.iter_mut().enumerate() {
            // Lanes to spare repeat the last one.
            let (below, spreads) = below(k.min(n - 1));
            let m = Point::new(below.nx[FAN / 2], below.ny[FAN / 2]);
            let (way, growth) = (middle.centre - below.centre, middle.radius - below.radius);
            let (mut least, mut widest, mut size): (f64, f64, f64) = (f64::INFINITY, 0.0, 0.0);
            for (j, &spread) in spreads.iter().enumerate() {
                let n = Point::new(below.nx[j], below.ny[j]);
                let low = below.rest[j] + (lowest(n, spread, way) - growth);
                // What is not a number leaves out nothing.
                least = if low.is_nan() { f64::NEG_INFINITY } else { least.min(low) };
                widest = widest.max((n - m).norm() + spread);
                size = size.max(below.rest[j].abs());
            }
            let size = size + way.x.abs() + way.y.abs() + growth.abs();
            rim.blur = f64::max(rim.blur, below.blur + 32.0 * U * size);
            (rim.nx[k], rim.ny[k], rim.rest[k]) = (m.x, m.y, least);
            *spread = widest * (1.0 + 8.0 * U) + 16.0 * U;
        }
        Self { rim, spread }
    }

    /// The bits of those runs whose lines are not all certainly clear of a disk.
    #[inline]
    pub(super) fn sift(&self, disk: &Pinned, mask: u32, wide: Option<Wide>) -> u32 {
        let Self { rim, spread } = self;
        let clear = |by_direction| clear_of(rim, spread, disk, by_direction, wide);
        let mask = mask & !clear(false);
        // What a disk may be off differs by direction.
        if mask.count_ones() > SOME && disk.is_solved() {
            return mask & !clear(true);
        }
        mask
    }
}

/// The bits of those runs whose lines are all certainly clear of a disk, with one bound for all or, where
/// it was found from three lines, one by direction.
#[inline]
fn clear_of(
    rim: &Rim,
    spread: &Eight,
    disk: &Pinned,
    by_direction: bool,
    wide: Option<Wide>,
) -> u32 {
    #[cfg(target_arch = "x86_64")]
    if let Some(wide) = wide {
        return wide.runs_clear_of(rim, spread, disk, by_direction);
    }
    let _ = wide;
    runs_clear_of(rim, spread, disk, by_direction)
}

#[inline(always)]
fn runs_clear_of(rim: &Rim, spread: &Eight, disk: &Pinned, by_direction: bool) -> u32 {
    let Moved { by, more, error } = rim.moved(disk);
    let error = error + 16.0 * U * (by.x.abs() + by.y.abs());
    let most = disk.bound;
    let (mut low, mut bound) = ([0.0; FAN], [most; FAN]);
    for k in 0..FAN {
        low[k] = rim.rest[k] + lowest(Point::new(rim.nx[k], rim.ny[k]), spread[k], by);
    }
    if by_direction && disk.is_solved() {
        for k in 0..FAN {
            let towards = disk.weighted(Point::new(rim.nx[k], rim.ny[k]), spread[k]);
            bound[k] = if towards < most { towards } else { most };
        }
    }
    let mut mask = 0;
    for k in 0..FAN {
        let clear = low[k] > more + (error + bound[k]) * (1.0 + 8.0 * U);
        mask |= u32::from(clear) << k;
    }
    mask
}

/// The least product of a vector with a unit vector no farther than that from one that is given.
#[inline(always)]
fn lowest(m: Point, spread: f64, by: Point) -> f64 {
    let (along, across) = (m.dot(by), m.cross(by).abs());
    along - (along.abs() * (spread * spread / 2.0) + across * spread)
}

#[cfg(target_arch = "x86_64")]
impl Wide {
    #[inline]
    #[allow(unsafe_code, reason = "only the machine itself tells what instructions it has")]
    fn runs_clear_of(self, rim: &Rim, spread: &Eight, disk: &Pinned, by_direction: bool) -> u32 {
        // SAFETY: `self` is made only where the machine has AVX2.
        unsafe { runs_clear_of_wide(rim, spread, disk, by_direction) }
    }

    #[inline]
    #[allow(unsafe_code, reason = "only the machine itself tells what instructions it has")]
    fn clear_of(self, rim: &Rim, by: Point, least: f64) -> u32 {
        // SAFETY: `self` is made only where the machine has AVX2.
        unsafe { clear_of_wide(rim, by, least) }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn runs_clear_of_wide(rim: &Rim, spread: &Eight, disk: &Pinned, by_direction: bool) -> u32 {
    runs_clear_of(rim, spread, disk, by_direction)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn clear_of_wide(rim: &Rim, by: Point, least: f64) -> u32 {
    use std::arch::x86_64::{
        _CMP_GT_OQ, _mm256_add_pd as add, _mm256_cmp_pd, _mm256_movemask_pd, _mm256_mul_pd as mul,
        _mm256_set1_pd as same, _mm256_setr_pd,
    };
    let half = |v: &Eight, k: usize| _mm256_setr_pd(v[k], v[k + 1], v[k + 2], v[k + 3]);
    let (x, y, least) = (same(by.x), same(by.y), same(least));
    let clear = |k: usize| {
        let along = add(mul(half(&rim.nx, k), x), mul(half(&rim.ny, k), y));
        let rest = add(along, half(&rim.rest, k));
        _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_GT_OQ>(rest, least)) as u32
    };
    clear(0) | clear(4) << 4
}

impl Pinned {
    /// The disk touching three lines, each given by its place in a rim, contacts counterclockwise;
    /// `None` where doubles cannot prove that there is one.
    #[must_use]
    pub fn touching(lines: [(&Rim, usize); 3]) -> Option<Self> {
        let (base, base_radius) = (lines[1].0.centre, lines[1].0.radius);
        let normal = |(rim, k): (&Rim, usize)| Point::new(rim.nx[k], rim.ny[k]);
        let [n1, n2, n3] = [normal(lines[0]), normal(lines[1]), normal(lines[2])];
        let (b, e) = (n2 - n1, n3 - n1);
        let (lb, le) = (b.norm(), e.norm());
        let cross = b.cross(e);
        // Each difference is off by 12u and half an ulp of its own.
        let d = cross - U * (4.0 * lb * le + 16.0 * (lb + le) + 256.0 * U);
        if d.is_nan() || d <= 0.0 {
            return None;
        }
        let per = 1.0 / d * (1.0 + 2.0 * U);
        let mut disk = Self {
            base,
            base_radius,
            centre: Point::default(),
            radius: 0.0,
            bound: f64::INFINITY,
            normals: [n1, n2, n3],
            open: [f64::INFINITY; 3],
            per,
        };
        // Not `map`, which is not always inlined.
        let residual = |disk: &Self, line: usize| {
            let (rim, k) = lines[line];
            let Moved { by, more, error } = rim.moved(disk);
            ((rim.nx[k] * by.x + rim.ny[k] * by.y + rim.rest[k]) - more, error)
        };
        let sides = [(n2 - n3).norm() + 16.0 * U, le + 16.0 * U, lb + 16.0 * U];
        let factor = 2.0 * per * (1.0 + 32.0 * U);
        for _ in 0..3 {
            let (p1, p2, p3) = (residual(&disk, 0).0, residual(&disk, 1).0, residual(&disk, 2).0);
            let (p12, p13) = (p1 - p2, p1 - p3);
            let dx = Point::new((p12 * e.y - p13 * b.y) / cross, (b.x * p13 - e.x * p12) / cross);
            let mut next = disk;
            next.centre = disk.centre + dx;
            next.radius = disk.radius + (p1 + n1.dot(dx));
            let mut is_sharp = true;
            for line in 0..3 {
                let (rest, error) = residual(&next, line);
                next.open[line] = rest.abs() + error;
                is_sharp &= rest.abs() <= error;
            }
            next.bound = factor
                * (sides[0] * next.open[0] + sides[1] * next.open[1] + sides[2] * next.open[2]);
            if next.bound.is_nan() || next.bound >= disk.bound {
                break;
            }
            disk = next;
            if is_sharp {
                break;
            }
        }
        let radius = disk.base_radius + disk.radius;
        (disk.bound < radius * (1.0 - 8.0 * U)).then_some(disk)
    }
}

impl Pinned {
    /// Whether it was found from three lines.
    #[inline]
    #[must_use]
    pub fn is_solved(&self) -> bool {
        !self.per.is_nan()
    }

    /// Whether it is known as well as doubles hold its radius.
    #[inline]
    #[must_use]
    pub fn is_precise(&self) -> bool {
        self.bound <= 16.0 * U * (self.base_radius + self.radius)
    }

    /// Bound on the error for the one unit vector that is given within 4u: that is an affine combination
    /// of the normals with weights that are as small as it is near them.
    #[inline]
    fn bound_towards(&self, m: Point) -> f64 {
        let bound = self.weighted(m, 0.0);
        if bound < self.bound { bound } else { self.bound }
    }

    /// The same for all unit vectors no farther from one than that; it may be more than the bound for
    /// all, or not a number.
    #[inline(always)]
    fn weighted(&self, m: Point, spread: f64) -> f64 {
        let [n1, n2, n3] = self.normals;
        let (a, b, c) = (n1 - m, n2 - m, n3 - m);
        let sum = weight(b, c, spread) * self.open[0]
            + weight(c, a, spread) * self.open[1]
            + weight(a, b, spread) * self.open[2];
        sum * self.per * (1.0 + 32.0 * U)
    }

    /// Whether it is known far better than doubles hold its radius.
    #[inline]
    #[must_use]
    pub fn is_sharp(&self) -> bool {
        self.bound <= SHARP * (self.base_radius + self.radius)
    }
}

/// The most that two ways span, each off by the rounding of normals, to vectors that are `s` farther: for
/// these it is `s × (a - b)` more.
#[inline(always)]
fn weight(a: Point, b: Point, spread: f64) -> f64 {
    let sizes = a.x.abs() + a.y.abs() + b.x.abs() + b.y.abs();
    let apart = (a.x - b.x).abs() + (a.y - b.y).abs();
    a.cross(b).abs() + spread * apart + U * (24.0 * sizes + 512.0 * U)
}

impl From<&TouchingDisk> for Pinned {
    fn from(disk: &TouchingDisk) -> Self {
        let TouchingDisk { origin, centre, radius, bound } = *disk;
        let (normals, open) = ([Point::default(); 3], [0.0; 3]);
        Self { base: origin, base_radius: 0.0, centre, radius, bound, normals, open, per: f64::NAN }
    }
}

impl From<&Pinned> for TouchingDisk {
    fn from(disk: &Pinned) -> Self {
        let radius = disk.base_radius + disk.radius;
        let bound = (disk.bound + 2.0 * U * radius.abs()) * (1.0 + 8.0 * U);
        Self { origin: disk.base, centre: disk.centre, radius, bound }
    }
}

#[cfg(test)]
mod tests {
    use std::cmp::Ordering;

    use super::*;
    use crate::geom::predicates::{Element, ExactDisk};

    /// Rims over the edges of a closed polygon whose number of edges is a multiple of eight.
    fn rims(corners: &[Point], circle: (Point, f64)) -> Vec<Rim> {
        let n = corners.len();
        let edge = |k: usize| (corners[k % n], corners[(k + 1) % n]);
        let rim = |first: usize| Rim::new(circle, &std::array::from_fn(|k| edge(first + k)));
        (0..n).step_by(FAN).map(rim).collect()
    }

    #[test]
    fn the_sides_of_a_triangle_touch_its_incircle_whatever_circle_they_are_measured_by() {
        // Sides 3, 4, 5: the disk of radius 1 around (1, 1).
        let [a, b, c] = [Point::new(0.0, 0.0), Point::new(4.0, 0.0), Point::new(0.0, 3.0)];
        let mut edges = [(a, b); FAN];
        (edges[1], edges[2]) = ((b, c), (c, a));
        for circle in [(Point::new(1.0, 1.0), 1.0), (Point::new(0.5, 1.25), 0.75), (a, 0.0)] {
            let rim = Rim::new(circle, &edges);
            let disk = Pinned::touching([(&rim, 0), (&rim, 1), (&rim, 2)]).unwrap();
            let centre = disk.base + disk.centre;
            let off = (centre - Point::new(1.0, 1.0)).norm();
            let off = off + (disk.base_radius + disk.radius - 1.0).abs();
            assert!(off <= 1e-14 && disk.bound <= 1e-13, "{disk:?}");
            // Clockwise there is none.
            assert!(Pinned::touching([(&rim, 0), (&rim, 2), (&rim, 1)]).is_none());
        }
    }

    #[test]
    fn what_rests_tell_of_edges_around_a_disk_exact_arithmetic_tells_as_well() {
        const N: usize = 64;
        let corner = |k: usize| {
            let (sin, cos) = (std::f64::consts::TAU * k as f64 / N as f64).sin_cos();
            Point::new(7.0 + 3.0 * cos, 3.0 * sin - 1.0)
        };
        let corners: Vec<Point> = (0..N).map(corner).collect();
        let edge = |k: usize| Element::Edge(corners[k % N], corners[(k + 1) % N]);
        let apothem = 3.0 * (std::f64::consts::PI / N as f64).cos();
        let rims = rims(&corners, (Point::new(7.0, -1.0), apothem));
        let (mut told, mut cut) = (0, 0);
        for (i, j, k) in [(0, 1, 2), (0, 21, 43), (5, 6, 40), (3, 11, 30), (60, 62, 63)] {
            let line = |k: usize| (&rims[k / FAN], k % FAN);
            let disk = Pinned::touching([line(i), line(j), line(k)]).unwrap();
            let exact = ExactDisk::new([edge(i), edge(j), edge(k)]).unwrap();
            for e in 0..N {
                let (rest, error) = rims[e / FAN].rest(e % FAN, &disk);
                let side = exact.side(edge(e));
                if rest.abs() > error {
                    let sign = if rest > 0.0 { Ordering::Greater } else { Ordering::Less };
                    assert_eq!(side, sign, "edge {e} to {i}, {j}, {k}: {rest:e} {error:e}");
                    told += 1;
                    cut += usize::from(rest < 0.0);
                }
                // What is left out is clear.
                for wide in [None, Wide::detect()] {
                    let shown = rims[e / FAN].sift(&disk, 0xff, wide) >> (e % FAN) & 1;
                    assert!(shown == 1 || side == Ordering::Greater, "edge {e}");
                }
            }
        }
        // All but the governors themselves and edges that are mirror images of them.
        assert!(told >= 5 * (N - 6) && cut >= 20, "{told} {cut}");
    }

    #[test]
    fn hoops_leave_out_runs_only_whose_edges_are_all_clear() {
        const N: usize = 1024;
        // Each second corner by up to a part of the sagitta off the circle, if at all.
        for off in [0.0, 1e-6, 1e-3] {
            let corner = |k: usize| {
                let (sin, cos) = (std::f64::consts::TAU * k as f64 / N as f64).sin_cos();
                let r = 3.0 - off * f64::from((k * k * 7 + 3 * k) as u32 % 1000) / 1000.0;
                Point::new(7.0 + r * cos, r * sin - 1.0)
            };
            let corners: Vec<Point> = (0..N).map(corner).collect();
            let edge = |k: usize| Element::Edge(corners[k % N], corners[(k + 1) % N]);
            let rims = rims(&corners, (Point::new(7.0, -1.0), 2.999));
            let hoops: Vec<Hoop> = rims.chunks(FAN).map(Hoop::over_rims).collect();
            let above: Vec<Hoop> = hoops.chunks(FAN).map(Hoop::over_hoops).collect();
            let (mut left_out, mut disks) = (0, 0);
            for (i, j, k) in [(0, 1, 2), (0, 341, 683), (5, 6, 600), (3, 110, 300), (960, 4, 500)] {
                let line = |k: usize| (&rims[k / FAN], k % FAN);
                let Some(disk) = Pinned::touching([line(i), line(j), line(k)]) else { continue };
                let exact = ExactDisk::new([edge(i), edge(j), edge(k)]).unwrap();
                disks += 1;
                let clear: Vec<bool> =
                    (0..N).map(|e| exact.side(edge(e)) == Ordering::Greater).collect();
                for wide in [None, Wide::detect()] {
                    for (level, size) in [(&hoops, FAN), (&above, FAN * FAN)] {
                        for (run, lanes) in clear.chunks(size).zip(0..) {
                            let hoop: &Hoop = &level[lanes / FAN];
                            let shown = hoop.sift(&disk, 0xff, wide) >> (lanes % FAN) & 1 == 1;
                            assert!(shown || run.iter().all(|&clear| clear), "{off} {lanes}");
                            left_out += usize::from(!shown);
                        }
                    }
                }
            }
            assert!(disks > 1 && (off > 1e-4 || left_out > 100), "{off} {disks} {left_out}");
        }
    }

    #[test]
    fn a_circle_through_nothing_leaves_every_edge_to_others() {
        let p = Point::new(1.0, 2.0);
        let rim = Rim::new((p, 0.0), &[(p, p); FAN]);
        let disk = TouchingDisk { origin: p, centre: Point::default(), radius: 1.0, bound: 0.0 };
        assert_eq!(rim.sift(&Pinned::from(&disk), 0xff, None), 0xff);
        assert_eq!(rim.sift(&Pinned::from(&disk), 0xff, Wide::detect()), 0xff);
    }
}
