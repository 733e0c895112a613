//! Eight capsules side by side, as numbers of 32 bits that are tested together.
//!
//! # Contract
//! A test leaves out no capsule of which anything may be within the scope: all is rounded outwards.
//!
//! # Method
//! Plain loops over eight lanes, which compilers turn into vector instructions. On x86-64 the test is
//! written once more for AVX2, and taken where the machine has it: the same operations in the same
//! order, nothing contracted, so both give the same bits. Squares may overflow, of distances and of
//! limits: what is farther than an infinite limit is never left out.
//!
//! # Departures
//! None.

use super::{Point, capsule_tree::Scope};

/// Capsules side by side.
pub(super) const FAN: usize = 8;

/// Share of the lengths involved by which a test in 32 bits may be wrong, with room to spare.
const ROUNDING: f32 = 1.0 / (1 << 19) as f32;

/// The same, of the distance of a disk that is far larger than what it is tested against.
const FAR_ROUNDING: f64 = 1.0 / (1_u64 << 44) as f64;

/// Radius of a disk, in sizes of what it is tested against, from which numbers of 32 bits are too
/// coarse for coordinates relative to its centre.
const FAR_OUT: f32 = 256.0;

/// About the size of a tree in its own lengths, where squares nearly overflow 32 bits: so they vanish
/// only for what is 10^-35 of the tree.
pub(super) const SIZE: f64 = (1_u64 << 58) as f64;

/// Length of a tree below which squares in 32 bits vanish.
pub(super) const VANISHING: f32 = 1e-18;

/// Distance from which it makes no difference to a tree whether a disk's centre is farther still.
const FARTHEST: f64 = 1e36;

/// Length of a run, in widths of it, from which its capsule is as thin as can be, though a little
/// longer: flat disks reach far along a straight run, and meet all of it that is too wide.
const THIN: f32 = 4.0;

/// One number to a capsule.
type Eight = [f32; FAN];

/// All points within `width` of the segment from `centre - half` to `centre + half`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Capsule {
    pub centre: Point,
    pub half: [f32; 2],
    pub width: f32,
}

/// Segments, one to a lane, relative to an origin.
#[derive(Clone, Debug)]
pub(super) struct Lanes {
    origin: Point,
    /// No lane reaches farther from the origin than this.
    extent: f32,
    x: Eight,
    y: Eight,
    half_x: Eight,
    half_y: Eight,
}

/// Capsules, one to a lane.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub lanes: Lanes,
    pub width: Eight,
}

/// A scope as the tests need it, in lengths of a tree.
pub(super) struct Query {
    centre: Point,
    reach: f64,
    /// How far the disk reaches from its centre, with its share of the rounding.
    limit: f32,
    slack: f32,
    normal: Point,
    /// The same in 32 bits.
    direction: [f32; 2],
    /// Least product with the normal in the half-plane; minus infinity without one.
    level: f64,
}

/// Witness that the machine has AVX2.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wide(());

impl Wide {
    /// The witness, if it is so.
    pub fn detect() -> Option<Self> {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") {
            return Some(Self(()));
        }
        None
    }
}

impl Query {
    /// A scope in lengths of a tree, whose coordinates are all rounded by no more than `slack`.
    #[inline]
    pub fn new(scope: &Scope, scale: f64, slack: f32) -> Self {
        let reach = scope.reach * scale;
        // Lanes with anything within have their origin no farther out than the disk, but for their own
        // extent. Near the origin of the plane coordinates are finer than elsewhere.
        let size = scope.centre.x.abs() + scope.centre.y.abs() + 2.0 * scope.reach.abs();
        let slack = slack.min((64.0 * f64::EPSILON * size * scale) as f32 + VANISHING);
        let normal = scope.normal;
        let border = scope.border * scale;
        let halved = normal.x != 0.0 || normal.y != 0.0;
        let level = if halved {
            // What the origin of the lanes adds to the rounding is in the slack.
            normal.dot(border) - 8.0 * f64::EPSILON * (border.x.abs() + border.y.abs())
        } else {
            f64::NEG_INFINITY
        };
        let limit = reach as f32 * (1.0 + ROUNDING) + slack;
        let direction = [normal.x as f32, normal.y as f32];
        Self { centre: scope.centre * scale, reach, limit, slack, normal, direction, level }
    }
}

impl Lanes {
    /// Segments between two ends each, given relative to an origin.
    #[inline]
    pub fn between(origin: Point, ends: &[(Point, Point); FAN]) -> Self {
        let [mut ax, mut ay, mut bx, mut by] = [[0.0; FAN]; 4];
        for (k, &(a, b)) in ends.iter().enumerate() {
            (ax[k], ay[k]) = (a.x as f32, a.y as f32);
            (bx[k], by[k]) = (b.x as f32, b.y as f32);
        }
        Self {
            origin,
            extent: 0.0,
            x: each(|k| (ax[k] + bx[k]) * 0.5),
            y: each(|k| (ay[k] + by[k]) * 0.5),
            half_x: each(|k| (bx[k] - ax[k]) * 0.5),
            half_y: each(|k| (by[k] - ay[k]) * 0.5),
        }
        .measured(&[0.0; FAN])
    }

    /// The same with what the lanes reach to.
    #[inline]
    fn measured(mut self, width: &Eight) -> Self {
        let far = each(|k| {
            (self.x[k].abs() + self.half_x[k].abs())
                + (self.y[k].abs() + self.half_y[k].abs())
                + width[k]
        });
        self.extent = largest(&far) * (1.0 + ROUNDING);
        self
    }

    /// A capsule around all, along their chord or the longer side of their box.
    pub fn capsule(&self, width: &Eight) -> Capsule {
        let last = FAN - 1;
        let chord_x = (self.x[last] + self.half_x[last]) - (self.x[0] - self.half_x[0]);
        let chord_y = (self.y[last] + self.half_y[last]) - (self.y[0] - self.half_y[0]);
        let length = (chord_x * chord_x + chord_y * chord_y).sqrt();
        let mut axis = [1.0, 0.0];
        let mut frame = self.framed(axis, width);
        if length > VANISHING {
            let along = [chord_x / length, chord_y / length];
            let other = self.framed(along, width);
            if other.half[0] + other.half[1] < frame.half[0] + frame.half[1] {
                (axis, frame) = (along, other);
            }
        }
        let Frame { middle: [x, y], half: [long, wide] } = frame;
        let offset = [axis[0] * x - axis[1] * y, axis[1] * x + axis[0] * y];
        let (axis, long, wide) =
            if long >= wide { (axis, long, wide) } else { ([-axis[1], axis[0]], wide, long) };
        // How far both ends are along and across, at once: the farther one along need not be the farther
        // one across.
        let along = each(|k| {
            let (x, y) = (self.x[k] - offset[0], self.y[k] - offset[1]);
            (axis[0] * x + axis[1] * y).abs()
                + (axis[0] * self.half_x[k] + axis[1] * self.half_y[k]).abs()
        });
        let across = each(|k| {
            let (x, y) = (self.x[k] - offset[0], self.y[k] - offset[1]);
            (axis[0] * y - axis[1] * x).abs()
                + (axis[0] * self.half_y[k] - axis[1] * self.half_x[k]).abs()
        });
        let mut reach = long - wide;
        if long > THIN * wide {
            // The shortest segment with which no end makes the capsule wider than all of them are.
            let least = each(|k| {
                let room = wide - width[k];
                along[k] - larger(room * room - across[k] * across[k], 0.0).sqrt()
            });
            reach = larger(largest(&least), 0.0);
        }
        // Farthest of the ends from the segment.
        let far = each(|k| {
            let beyond = larger(along[k] - reach, 0.0);
            (beyond * beyond + across[k] * across[k]).sqrt() + width[k]
        });
        let width = largest(&far) * (1.0 + ROUNDING) + ROUNDING * self.extent + VANISHING;
        Capsule {
            centre: self.origin + Point::new(offset[0].into(), offset[1].into()),
            half: [axis[0] * reach, axis[1] * reach],
            width,
        }
    }

    /// The box of all along an axis.
    #[inline]
    fn framed(&self, [ux, uy]: [f32; 2], width: &Eight) -> Frame {
        let side = |ux: f32, uy: f32| {
            let at = each(|k| ux * self.x[k] + uy * self.y[k]);
            let half = each(|k| (ux * self.half_x[k] + uy * self.half_y[k]).abs() + width[k]);
            let high = largest(&each(|k| at[k] + half[k]));
            let low = -largest(&each(|k| half[k] - at[k]));
            ((low + high) * 0.5, (high - low) * 0.5)
        };
        let ((x, long), (y, wide)) = (side(ux, uy), side(-uy, ux));
        Frame { middle: [x, y], half: [long, wide] }
    }

    /// A bit for each lane, widened by that much, that may be within the scope.
    #[inline]
    pub fn within(&self, query: &Query, width: &Eight, wide: Option<Wide>) -> u32 {
        #[cfg(target_arch = "x86_64")]
        if let Some(wide) = wide {
            return wide.within(self, query, width);
        }
        let _ = wide;
        self.within_plain(query, width)
    }

    #[inline(never)]
    fn within_plain(&self, query: &Query, width: &Eight) -> u32 {
        let measures = if self.is_small(query) {
            self.measures_far(query, width)
        } else {
            self.measures_near(query, width)
        };
        let (at, least) = self.heights(query, width);
        mask_plain(&measures, &at, least)
    }

    /// Whether the disk is so much larger that it may have to be tested as if from far.
    #[inline(always)]
    fn is_small(&self, query: &Query) -> bool {
        query.limit > FAR_OUT * self.extent
    }

    /// How far in the direction of the half-plane a lane has to reach.
    #[inline(always)]
    fn least(&self, query: &Query) -> f32 {
        let level = query.level - query.normal.dot(self.origin);
        let least = level as f32;
        least - ROUNDING * (least.abs() + self.extent) - query.slack
    }

    /// How far each lane does, and how far it has to.
    #[inline(always)]
    fn heights(&self, query: &Query, width: &Eight) -> (Eight, f32) {
        let [nx, ny] = query.direction;
        let at = each(|k| {
            let half = (nx * self.half_x[k] + ny * self.half_y[k]).abs();
            (nx * self.x[k] + ny * self.y[k]) + half + width[k]
        });
        (at, self.least(query))
    }

    #[inline(always)]
    fn measures_near(&self, query: &Query, width: &Eight) -> Measures {
        let p = query.centre - self.origin;
        let (px, py) = (p.x as f32, p.y as f32);
        let limit = query.limit + ROUNDING * self.extent;
        let square = each(|k| {
            let (dx, dy) = (px - self.x[k], py - self.y[k]);
            let (hx, hy) = (self.half_x[k], self.half_y[k]);
            let t = (dx * hx + dy * hy) / larger(hx * hx + hy * hy, f32::MIN_POSITIVE);
            let t = larger(smaller(t, 1.0), -1.0);
            let (ex, ey) = (dx - t * hx, dy - t * hy);
            ex * ex + ey * ey
        });
        let limit = each(|k| {
            let limit = limit + width[k];
            limit * limit
        });
        Measures { square, limit }
    }

    /// The same where the disk is large: if it is far as well it is nearly a half-plane.
    #[inline(always)]
    fn measures_far(&self, query: &Query, width: &Eight) -> Measures {
        let extent = self.extent;
        let p = query.centre - self.origin;
        let distance = p.norm();
        if distance <= 4.0 * f64::from(extent) {
            return self.measures_near(query, width);
        }
        // A point q is within the disk if n·q - q·q/2d is at least (d² - r²)/2d, for the distance d
        // and the direction n of the centre. All of this is as small as the lanes are.
        let inverse = 1.0 / distance;
        let (nx, ny) = ((p.x * inverse) as f32, (p.y * inverse) as f32);
        let reach = query.reach;
        let level = (distance - reach) * (distance + reach) * (0.5 * inverse);
        let margin = f64::from(ROUNDING * extent + query.slack) + FAR_ROUNDING * (distance + reach);
        let level = (level - margin) as f32;
        let (d, bend) = (distance.min(FARTHEST) as f32, (0.5 * inverse) as f32);
        let widen = (reach * inverse) as f32 * (1.0 + ROUNDING);
        let limit = each(|k| {
            let (cx, cy) = (self.x[k], self.y[k]);
            let (hx, hy) = (self.half_x[k], self.half_y[k]);
            let square = larger(hx * hx + hy * hy, f32::MIN_POSITIVE);
            let t = (d * (nx * hx + ny * hy) - (cx * hx + cy * hy)) / square;
            let t = larger(smaller(t, 1.0), -1.0);
            let (qx, qy) = (cx + t * hx, cy + t * hy);
            let w = width[k];
            nx * qx + ny * qy - bend * (qx * qx + qy * qy) + w * (widen + bend * w)
        });
        Measures { square: [level; FAN], limit }
    }
}

/// A lane is outside the disk if `square` exceeds `limit`.
struct Measures {
    square: Eight,
    limit: Eight,
}

/// A function of its own, for compilers do badly with vectors whose lanes are taken apart.
#[inline(never)]
fn mask_plain(measures: &Measures, at: &Eight, least: f32) -> u32 {
    let bits: [u32; FAN] = std::array::from_fn(|k| {
        let outside = measures.square[k] > measures.limit[k];
        if outside | (at[k] < least) { 1 << k } else { 0 }
    });
    !bits.into_iter().fold(0, |all, bit| all | bit)
}

#[cfg(target_arch = "x86_64")]
impl Wide {
    #[inline]
    #[allow(unsafe_code, reason = "only the machine itself tells what instructions it has")]
    fn within(self, lanes: &Lanes, query: &Query, width: &Eight) -> u32 {
        // SAFETY: `self` is made only where the machine has AVX2.
        unsafe { within_wide(lanes, query, width) }
    }
}

/// [`Lanes::within_plain`] for AVX2, operation for operation: left to compilers, the loops come out well
/// in one build and full of shuffles in the next.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn within_wide(lanes: &Lanes, query: &Query, width: &Eight) -> u32 {
    use std::arch::x86_64::{
        _mm256_add_ps as add, _mm256_andnot_ps, _mm256_div_ps as div, _mm256_max_ps as max,
        _mm256_min_ps as min, _mm256_mul_ps as mul, _mm256_set1_ps as same, _mm256_sub_ps as sub,
    };
    if lanes.is_small(query) {
        return far_within_wide(lanes, query, width);
    }
    let (x, y) = (eight_wide(&lanes.x), eight_wide(&lanes.y));
    let (hx, hy) = (eight_wide(&lanes.half_x), eight_wide(&lanes.half_y));
    let width = eight_wide(width);
    let p = query.centre - lanes.origin;
    let (dx, dy) = (sub(same(p.x as f32), x), sub(same(p.y as f32), y));
    let t = div(
        add(mul(dx, hx), mul(dy, hy)),
        max(add(mul(hx, hx), mul(hy, hy)), same(f32::MIN_POSITIVE)),
    );
    let t = max(min(t, same(1.0)), same(-1.0));
    let (ex, ey) = (sub(dx, mul(t, hx)), sub(dy, mul(t, hy)));
    let square = add(mul(ex, ex), mul(ey, ey));
    let limit = add(same(query.limit + ROUNDING * lanes.extent), width);
    let limit = mul(limit, limit);
    let (nx, ny) = (same(query.direction[0]), same(query.direction[1]));
    let half = _mm256_andnot_ps(same(-0.0), add(mul(nx, hx), mul(ny, hy)));
    let at = add(add(add(mul(nx, x), mul(ny, y)), half), width);
    mask_wide([square, limit], at, lanes.least(query))
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
#[inline(never)]
fn far_within_wide(lanes: &Lanes, query: &Query, width: &Eight) -> u32 {
    let Measures { square, limit } = lanes.measures_far(query, width);
    let (at, least) = lanes.heights(query, width);
    mask_wide([eight_wide(&square), eight_wide(&limit)], eight_wide(&at), least)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
#[inline]
fn eight_wide(v: &Eight) -> std::arch::x86_64::__m256 {
    std::arch::x86_64::_mm256_setr_ps(v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7])
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
#[inline]
fn mask_wide(
    [square, limit]: [std::arch::x86_64::__m256; 2],
    at: std::arch::x86_64::__m256,
    least: f32,
) -> u32 {
    use std::arch::x86_64::{
        _CMP_GT_OQ, _CMP_LT_OQ, _mm256_cmp_ps, _mm256_movemask_ps, _mm256_or_ps, _mm256_set1_ps,
    };
    let outside = _mm256_cmp_ps::<_CMP_GT_OQ>(square, limit);
    let behind = _mm256_cmp_ps::<_CMP_LT_OQ>(at, _mm256_set1_ps(least));
    !_mm256_movemask_ps(_mm256_or_ps(outside, behind)) as u32
}

impl Node {
    /// Capsules side by side; there are one to eight.
    pub fn new(group: &[Capsule]) -> Self {
        let last = group.len() - 1;
        let origin = group[last / 2].centre;
        let mut lanes = Lanes {
            origin,
            extent: 0.0,
            x: [0.0; FAN],
            y: [0.0; FAN],
            half_x: [0.0; FAN],
            half_y: [0.0; FAN],
        };
        let mut width = [0.0; FAN];
        for k in 0..FAN {
            // Lanes to spare repeat the last one.
            let capsule = &group[k.min(last)];
            let at = capsule.centre - origin;
            (lanes.x[k], lanes.y[k]) = (at.x as f32, at.y as f32);
            [lanes.half_x[k], lanes.half_y[k]] = capsule.half;
            width[k] = capsule.width;
        }
        Self { lanes: lanes.measured(&width), width }
    }

    /// A capsule around all.
    pub fn capsule(&self) -> Capsule {
        self.lanes.capsule(&self.width)
    }
}

/// A box: its middle and half its sides.
struct Frame {
    middle: [f32; 2],
    half: [f32; 2],
}

#[inline(always)]
fn each(lane: impl Fn(usize) -> f32) -> Eight {
    let mut all = [0.0; FAN];
    for (k, slot) in all.iter_mut().enumerate() {
        *slot = lane(k);
    }
    all
}

/// The larger number; the second one if they have no order.
#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The smaller number; the second one if they have no order.
#[inline(always)]
fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline(always)]
fn largest(v: &Eight) -> f32 {
    let four = [larger(v[0], v[4]), larger(v[1], v[5]), larger(v[2], v[6]), larger(v[3], v[7])];
    larger(larger(four[0], four[2]), larger(four[1], four[3]))
}
