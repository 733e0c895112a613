//! Disks that touch three boundary elements, in doubles, with a certified bound on their error.
//!
//! # Contract
//! [`TouchingDisk::guess`] is fast and may be wrong. [`TouchingDisk::certified`] carries `bound`:
//! exactly one disk near it touches the three elements, in the order given, and
//! `|w·(c* - c) - (r* - r)| <= bound` for every unit vector `w`.
//!
//! # Method
//! 1. A closed form that is stable for each combination of corners and edges gives a start.
//! 2. Newton steps on the three residuals `distance - r`, relative to a corner of a governor.
//! 3. With normals `n_i`, `D = (n2 - n1) × (n3 - n1) > 0` proves the order of the contacts, and
//!    `(2/D) Σ |n_j - n_k| (|ρ_i| + ε_i)` bounds the error, because any unit vector is an affine
//!    combination of the normals with weights of at most `2|n_j - n_k| / D`.
//! 4. Where a corner is an end of a touched edge two normals agree; then the centre is put on the
//!    normal of that edge, and one residual remains.
//!
//! # Departures
//! None: where the bound is refused the caller asks [`ExactDisk`](super::predicates::ExactDisk).

use super::Point;

/// Half an ulp of 1.
pub(crate) const U: f64 = f64::EPSILON / 2.0;

/// Twice the area of the triangle of three normals from which plain differences of distances will do.
const WIDE: f64 = 1e-3;

/// Error of the distance from a line, as a share of its two products, in half ulps: three for the
/// direction, one each for the difference, the product and the sum, and a margin.
const LINE_ERROR: f64 = 6.5;

/// Share of their rounding errors below which residuals need no further step.
const SETTLED: f64 = 0.25;

/// Newton steps of a certificate, at most.
const MOST_STEPS: usize = 4;

/// A boundary element with what doubles need to compute with it.
#[derive(Clone, Copy, Debug)]
pub enum Governor {
    /// A reflex corner.
    Corner(Point),
    /// An edge with its unit direction.
    Edge {
        /// Where it starts.
        start: Point,
        /// Where it ends.
        end: Point,
        /// Unit vector from start to end.
        direction: Point,
    },
}

impl Governor {
    fn end(&self) -> Point {
        match *self {
            Self::Corner(p) => p,
            Self::Edge { end, .. } => end,
        }
    }

    fn anchor(&self) -> Point {
        match *self {
            Self::Corner(p) => p,
            Self::Edge { start, .. } => start,
        }
    }
}

/// A disk in doubles, relative to a local origin, with a bound on its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TouchingDisk {
    /// Local origin: a corner of one of the governors.
    pub origin: Point,
    /// Centre, relative to the origin.
    pub centre: Point,
    /// Radius.
    pub radius: f64,
    /// Bound on the error; infinite for a guess.
    pub bound: f64,
}

/// A governor relative to the origin of a disk.
#[derive(Clone, Copy, Debug)]
struct Local {
    /// The corner, or an end of the edge.
    at: Point,
    /// Unit vector along the edge.
    direction: Option<Point>,
    /// What the place adds to the rounding of distances.
    far: f64,
}

impl Local {
    /// Unit normal towards the centre, residual `distance - r` and its rounding error; not a number in
    /// a corner.
    #[inline(always)]
    fn residual(&self, centre: Point, radius: f64) -> (Point, f64, f64) {
        let q = centre - self.at;
        match self.direction {
            None => {
                let distance = q.norm();
                let error = U * (4.0 * distance + self.far + radius);
                (q * (1.0 / distance), distance - radius, error)
            }
            Some(u) => {
                let (left, right) = (q.y * u.x, q.x * u.y);
                let error = U * (LINE_ERROR * (left.abs() + right.abs()) + self.far + radius);
                (u.perp(), (left - right) - radius, error)
            }
        }
    }
}

/// Doubles cannot tell whether there is such a disk, or where.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unsure;

/// Sine-like half angles: twice the sine of half the angle from `i` to `j`.
fn sigma(c: f64, g: f64) -> f64 {
    if g >= 0.0 { c / ((1.0 + g) / 2.0).sqrt() } else { (2.0 * (1.0 - g)).sqrt() * sign(c) }
}

/// `(1 + g, 1 - g)` without cancellation, from the sine `c` and the cosine `g`.
fn complements(c: f64, g: f64) -> (f64, f64) {
    if g >= 0.0 {
        let up = 1.0 + g;
        (up, c * c / up)
    } else {
        let um = 1.0 - g;
        (c * c / um, um)
    }
}

/// The sign of `x`, +1 for either zero.
fn sign(x: f64) -> f64 {
    if x < 0.0 { -1.0 } else { 1.0 }
}

/// How much faster than the radius a disk in the corner of two edges comes near a third one, for
/// directions that differ little: `1 - cos ψ / cos φ` for edges turned by φ from their middle, and the
/// third one by ψ.
#[cold]
#[inline(never)]
fn narrow_opening([incoming, outgoing]: [Point; 2], direction: Point) -> f64 {
    let turn = |d: Point| sigma(d.cross(direction), d.dot(direction));
    turn(incoming) * turn(outgoing) / (2.0 * (1.0 + incoming.dot(outgoing))).sqrt()
}

/// Distance of `p` from the line of an edge; 0 at its ends, so no rounding loses the disk.
fn height(p: Point, start: Point, end: Point, direction: Point) -> f64 {
    if p == start || p == end { 0.0 } else { direction.cross(p - start) }
}

impl TouchingDisk {
    /// Centre in the coordinates of the input, rounded.
    #[inline]
    #[must_use]
    pub fn position(&self) -> Point {
        self.origin + self.centre
    }

    /// Bound on the error of the length of the way `q` from a point to the centre, less the radius, and of
    /// its products with unit vectors; `a` is the point relative to the origin.
    #[inline]
    pub(crate) fn doubt(&self, a: Point, q: Point) -> f64 {
        self.bound
            + U * (16.0 * (q.x.abs() + q.y.abs()) + a.x.abs() + a.y.abs() + 2.0 * self.radius)
    }

    /// Whether its position and radius, rounded, are within 4 ulp of max(|x|, |y|, radius).
    #[inline]
    #[must_use]
    pub fn is_precise(&self) -> bool {
        let position = self.position();
        let size = larger(larger(position.x.abs(), position.y.abs()), self.radius);
        // Three and a half units in the last place at most; rounding adds half a one.
        self.bound <= 3.5 * unit_in_the_last_place(size)
    }

    /// The disk that touches three elements counterclockwise in the order given, uncertified.
    ///
    /// `near` chooses the local origin among the ends of the elements.
    #[inline(always)]
    #[must_use]
    pub fn guess(governors: &[Governor; 3], near: Point) -> Option<Self> {
        let g = corners_first(governors);
        let mut origin = g[0].anchor();
        if let [
            &Governor::Edge { start: a, end: b, .. },
            &Governor::Edge { start: c, end: d, .. },
            &Governor::Edge { start: e, end: f, .. },
        ] = g
        {
            origin = nearest([a, b, c, d, e, f], near);
        }
        Self::form(g, origin)
    }

    /// The closed form, for governors with corners first; for three edges relative to an end of one.
    #[inline(always)]
    fn form(g: [&Governor; 3], origin: Point) -> Option<Self> {
        use Governor::{Corner, Edge};
        let (origin, centre, radius) = match g {
            [&Corner(p), &Corner(q), &Corner(s)] => {
                let (a, b) = (q - p, s - p);
                if a.cross(b) <= 0.0 {
                    return None;
                }
                let c = Point::circumcentre(a, b);
                (p, c, c.norm())
            }
            [&Corner(p), &Corner(q), &Edge { start, end, direction }] => {
                two_corners_and_edge(p, q, start, end, direction)?
            }
            [
                &Corner(p),
                &Edge { start: a1, end: b1, direction: t1 },
                &Edge { start: a2, end: b2, direction: t2 },
            ] => {
                let (h1, h2) = (height(p, a1, b1, t1).max(0.0), height(p, a2, b2, t2).max(0.0));
                let (c12, g12) = (t1.cross(t2), t1.dot(t2));
                let (up, um) = complements(c12, g12);
                if um <= 0.0 {
                    return None;
                }
                let s = (2.0 * up * h1 * h2).sqrt();
                let tau = -sign(c12);
                let r = if tau > 0.0 {
                    (h1 + h2 + s) / um
                } else {
                    ((h1 - h2) * (h1 - h2) + 2.0 * um * h1 * h2) / (um * (h1 + h2 + s))
                };
                let inner = up * h1 + tau * s;
                let k = -sign(c12) * if inner == 0.0 { tau } else { sign(inner) };
                let along = (h1 * (2.0 * r - h1)).max(0.0).sqrt();
                (p, t1.perp() * (r - h1) + t1 * (k * along), r)
            }
            [
                &Edge { start: a, end: b, direction: t },
                &Edge { start: c, end: d, direction: u },
                &Edge { start: e, end: f, direction: v },
            ] => three_edges([a, b, c, d, e, f], [t, u, v], origin)?,
            _ => return None,
        };
        let sound = centre.x.is_finite() && centre.y.is_finite() && radius.is_finite();
        (sound && radius > 0.0).then_some(Self { origin, centre, radius, bound: f64::INFINITY })
    }

    /// The disk that touches two edges beside their convex corner `v`, and a third element beyond,
    /// uncertified. `incoming` and `outgoing` are the directions of the edges.
    #[inline]
    #[must_use]
    pub fn in_corner(v: Point, incoming: Point, outgoing: Point, other: &Governor) -> Option<Self> {
        // The centre of radius r is v + k r.
        let (sine, cosine) = (incoming.cross(outgoing), incoming.dot(outgoing));
        let k = if cosine > 0.0 {
            (incoming + outgoing).perp() * (1.0 / (1.0 + cosine))
        } else {
            (outgoing - incoming) * (1.0 / sine)
        };
        let radius = match *other {
            Governor::Corner(q) => {
                // The smaller root: the corner lies beyond both contacts.
                let w = q - v;
                let (square, along) = (w.norm2(), k.dot(w));
                let rest = along * along - (k.norm2() - 1.0) * square;
                if along <= 0.0 || rest < 0.0 {
                    return None;
                }
                square / (along + rest.sqrt())
            }
            Governor::Edge { start, direction, .. } => {
                let h = direction.cross(v - start);
                if h <= 0.0 {
                    return None;
                }
                let open = 1.0 - direction.cross(k);
                let narrow = open < WIDE && cosine > 0.0;
                h / if narrow { narrow_opening([incoming, outgoing], direction) } else { open }
            }
        };
        let sound = radius > 0.0 && radius.is_finite();
        sound.then_some(Self { origin: v, centre: k * radius, radius, bound: f64::INFINITY })
    }

    /// The certified disk that touches three elements counterclockwise in the order given.
    ///
    /// The same for every rotation of the three, bit for bit. `None` where doubles find none or
    /// cannot prove it.
    #[must_use]
    pub fn touching(governors: &[Governor; 3]) -> Option<Self> {
        if let Some((edge, corner, other)) = touching_end(governors) {
            let (&Governor::Edge { direction, .. }, &Governor::Corner(v)) =
                (&governors[edge], &governors[corner])
            else {
                return None;
            };
            return Self::on_normal(v, direction, &governors[other], f64::INFINITY).ok().flatten();
        }
        Self::apart(governors)
    }

    /// The same for governors none of which ends at another one.
    #[must_use]
    pub(crate) fn apart(governors: &[Governor; 3]) -> Option<Self> {
        let [a, b, c] = corners_first(governors);
        let g = match (a, c) {
            // One kind only: the rotation is chosen by the places.
            (Governor::Corner(_), Governor::Corner(_))
            | (Governor::Edge { .. }, Governor::Edge { .. }) => {
                let least = |x: &Governor, y: &Governor| {
                    x.anchor()
                        .lexicographic(y.anchor())
                        .then(x.end().lexicographic(y.end()))
                        .is_le()
                };
                if least(a, b) && least(a, c) {
                    [a, b, c]
                } else if least(b, c) {
                    [b, c, a]
                } else {
                    [c, a, b]
                }
            }
            _ => [a, b, c],
        };
        let mut disk = Self::form(g, g[0].anchor())?;
        if let [
            &Governor::Edge { start: a, end: b, .. },
            &Governor::Edge { start: c, end: d, .. },
            &Governor::Edge { start: e, end: f, .. },
        ] = g
        {
            // The nearest end is the best origin.
            let centre = disk.position();
            disk.origin = nearest([a, b, c, d, e, f], centre);
            disk.centre = centre - disk.origin;
        }
        disk.certify(g)
    }

    /// The certified disk with its centre on the normal at `v` of an edge that ends there, touching
    /// one more element; `Ok(None)` if there certainly is none of at most the `largest` radius.
    ///
    /// # Errors
    /// [`Unsure`] where doubles cannot tell.
    #[inline(always)]
    pub fn on_normal(
        v: Point,
        direction: Point,
        other: &Governor,
        largest: f64,
    ) -> Result<Option<Self>, Unsure> {
        let normal = direction.perp();
        let (radius, error) = match *other {
            Governor::Corner(w) => {
                // w·w = 2r n·w
                let w = w - v;
                let (square, along) = (w.norm2(), normal.dot(w));
                let radius = square / (2.0 * along);
                // Each component of the normal is off by at most 4u, w by u of its own.
                let share = 12.0 * U * square.sqrt() / along;
                if along.is_nan() || along <= 0.0 || share > 0.125 {
                    let most = along + 12.0 * U * square.sqrt();
                    let none = most < 0.0 || square > 2.0 * most * largest;
                    return if none { Ok(None) } else { Err(Unsure) };
                }
                (radius, radius * (2.0 * share + 8.0 * U))
            }
            Governor::Edge { start, end, direction: t } => {
                // h = r (1 - n·m) for the distance h of the edge's line
                let from_start = v - start;
                let q = either(t.dot(from_start) > t.dot(end - v), [v - end, from_start]);
                let (left, right) = (t.x * q.y, t.y * q.x);
                let h = left - right;
                let h_error = 8.0 * U * (left.abs() + right.abs());
                let cosine = t.dot(direction);
                let (g, g_error) = if cosine < 0.5 {
                    (1.0 - cosine, 16.0 * U)
                } else {
                    let difference = direction - t;
                    let square = difference.norm2();
                    (square / 2.0, 16.0 * U * square.sqrt())
                };
                if h.is_nan() || h <= 0.0 || g <= 2.0 * g_error {
                    let none = -h > h_error || h - h_error > (g + g_error) * largest;
                    return if none { Ok(None) } else { Err(Unsure) };
                }
                let radius = h / g;
                let error = (h_error + radius * (g_error + 4.0 * U * g)) / (g - g_error);
                (radius, error)
            }
        };
        if radius - error > largest {
            return Ok(None);
        }
        let bound = 2.0 * error + 16.0 * U * radius;
        let disk = Self { origin: v, centre: normal * radius, radius, bound };
        if radius > 0.0 && bound < radius && radius.is_finite() {
            Ok(Some(disk))
        } else {
            Err(Unsure)
        }
    }

    /// The certified disk near this one; `None` where doubles cannot prove it.
    #[must_use]
    pub fn certified(&self, governors: &[Governor; 3]) -> Option<Self> {
        if let Some((edge, corner, other)) = touching_end(governors) {
            return self.certified_on_normal(
                &governors[edge],
                &governors[corner],
                &governors[other],
            );
        }
        self.certify([&governors[0], &governors[1], &governors[2]])
    }

    /// The same for governors none of which ends at another one.
    #[inline(always)]
    fn certify(&self, governors: [&Governor; 3]) -> Option<Self> {
        let mut disk = *self;
        let [g1, g2, g3] = governors;
        let locals = [disk.local(g1), disk.local(g2), disk.local(g3)];
        let mut before = f64::INFINITY;
        for _ in 0..=MOST_STEPS {
            let residual = |k: usize| locals[k].residual(disk.centre, disk.radius);
            let [(n1, p1, e1), (n2, p2, e2), (n3, p3, e3)] =
                [residual(0), residual(1), residual(2)];
            let (b, e) = (n2 - n1, n3 - n1);
            let d = b.cross(e);
            if d.is_nan() || d <= 12.0 * U {
                return None;
            }
            let off = p1.abs() + p2.abs() + p3.abs();
            // A start that is good needs no step; a poor one converges quadratically.
            if off > SETTLED * (e1 + e2 + e3) && off < before / 2.0 {
                before = off;
                let (p12, p13) = (p1 - p2, p1 - p3);
                let per = 1.0 / d;
                let dx = Point::new((p12 * e.y - p13 * b.y) * per, (b.x * p13 - e.x * p12) * per);
                disk.centre = disk.centre + dx;
                disk.radius += p1 + n1.dot(dx);
                continue;
            }
            if disk.radius.is_nan() || disk.radius <= 0.0 {
                return None;
            }
            let (l1, l2, l3) = ((n2 - n3).norm(), e.norm(), b.norm());
            let factor = 2.0 / (d - 12.0 * U);
            let mut bound =
                factor * (l1 * (p1.abs() + e1) + l2 * (p2.abs() + e2) + l3 * (p3.abs() + e3));
            if locals.iter().any(|g| g.direction.is_none()) {
                let k = factor * (l1 + l2 + l3);
                if 32.0 * k * bound > disk.radius {
                    return None;
                }
                bound *= 1.25;
            }
            disk.bound = bound;
            return (bound < disk.radius).then_some(disk);
        }
        None
    }

    /// A governor relative to the origin of this disk, an edge by its end nearer to the centre, where
    /// rounding is least.
    #[inline]
    fn local(&self, g: &Governor) -> Local {
        let relative = |p: Point| p - self.origin;
        match *g {
            Governor::Corner(p) => {
                let at = relative(p);
                Local { at, direction: None, far: at.x.abs() + at.y.abs() }
            }
            Governor::Edge { start, end, direction: u } => {
                let (from, to) = (relative(start), relative(end));
                let nearer = (self.centre - from).norm2() <= (self.centre - to).norm2();
                let at = either(nearer, [from, to]);
                Local { at, direction: Some(u), far: (at.y * u.x).abs() + (at.x * u.y).abs() }
            }
        }
    }

    /// Unit normal towards the centre, distance and error bound of the residual; not a number in
    /// a corner.
    #[inline]
    fn distance(&self, g: &Governor) -> (Point, f64, f64) {
        let (n, rho, error) = self.local(g).residual(self.centre, 0.0);
        (n, rho, error + U * self.radius)
    }

    /// The disk whose centre lies on the normal of `edge` at its end `corner`, touching `other`.
    fn certified_on_normal(
        &self,
        edge: &Governor,
        corner: &Governor,
        other: &Governor,
    ) -> Option<Self> {
        let (&Governor::Edge { direction, .. }, &Governor::Corner(v)) = (edge, corner) else {
            return None;
        };
        let normal = direction.perp();
        let mut disk = Self { origin: v, ..*self };
        let mut step = f64::INFINITY;
        let (g, rho, error) = loop {
            disk.centre = normal * disk.radius;
            let (n, distance, error) = disk.distance(other);
            let g = 1.0 - n.dot(normal);
            if g.is_nan() || g <= 16.0 * U {
                return None;
            }
            let rho = distance - disk.radius;
            if rho.abs() <= 8.0 * U * disk.radius || rho.abs() >= step / 2.0 {
                break (g, rho, error);
            }
            step = rho.abs();
            disk.radius += rho / g;
        };
        let r = disk.radius;
        let mut bound = 2.0 * (rho.abs() + error + 16.0 * U * r) / (g - 8.0 * U) + 16.0 * U * r;
        if matches!(other, Governor::Corner(_)) {
            if 64.0 * bound > r * g {
                return None;
            }
            bound *= 1.25;
        }
        disk.bound = bound;
        (r > 0.0 && bound < r).then_some(disk)
    }
}

/// The larger of two numbers.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The distance of a positive number from the next larger one; zero for very small ones.
#[inline(always)]
fn unit_in_the_last_place(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & f64::INFINITY.to_bits()) * f64::EPSILON
}

/// The first of the points nearest to one.
///
/// Which one it is cannot be foreseen, so nothing branches on it.
#[inline(always)]
fn nearest(points: [Point; 6], to: Point) -> Point {
    let (mut least, mut first) = ((points[0] - to).norm2(), 0);
    for (k, &p) in points.iter().enumerate().skip(1) {
        let distance = (p - to).norm2();
        let nearer = distance < least;
        least = if nearer { distance } else { least };
        first = if nearer { k } else { first };
    }
    points[first]
}

/// The first point if so, else the second one, without a branch.
#[inline(always)]
fn either(first: bool, points: [Point; 2]) -> Point {
    points[usize::from(!first)]
}

/// The governors turned so that corners come first.
#[inline(always)]
fn corners_first([a, b, c]: &[Governor; 3]) -> [&Governor; 3] {
    let is_corner = |g: &Governor| matches!(g, Governor::Corner(_));
    match (is_corner(a), is_corner(b), is_corner(c)) {
        (false, true, _) => [b, c, a],
        (true, false, true) | (false, false, true) => [c, a, b],
        _ => [a, b, c],
    }
}

/// Positions of an edge, a corner that ends it, and the third element.
#[inline(always)]
fn touching_end(governors: &[Governor; 3]) -> Option<(usize, usize, usize)> {
    for corner in 0..3 {
        let Governor::Corner(p) = governors[corner] else { continue };
        for (edge, governor) in governors.iter().enumerate() {
            if let Governor::Edge { start, end, .. } = *governor
                && (start == p || end == p)
            {
                return Some((edge, corner, 3 - edge - corner));
            }
        }
    }
    None
}

#[inline(always)]
fn two_corners_and_edge(
    p: Point,
    q: Point,
    start: Point,
    end: Point,
    t: Point,
) -> Option<(Point, Point, f64)> {
    let (hp, hq) = (height(p, start, end, t).max(0.0), height(q, start, end, t).max(0.0));
    let w = q - p;
    let (u, v) = (t.dot(w), t.cross(w));
    let s = ((u * u + v * v) * hp * hq).sqrt();
    let x = if hp == 0.0 {
        0.0
    } else if u >= 0.0 {
        -(hp * u + s) / v
    } else {
        hp * (u * u + v * hq) / (hp * u - s)
    };
    let r = if hp >= hq {
        (x * x + hp * hp) / (2.0 * hp)
    } else {
        ((x - u) * (x - u) + hq * hq) / (2.0 * hq)
    };
    Some((p, t * x + t.perp() * (r - hp), r))
}

#[inline(always)]
fn three_edges(ends: [Point; 6], t: [Point; 3], origin: Point) -> Option<(Point, Point, f64)> {
    let (across, along) = (t[1] - t[0], t[2] - t[0]);
    let spread = across.cross(along);
    if spread > WIDE {
        // Two differences of the three distances from the lines; no roots.
        let h: [f64; 3] = std::array::from_fn(|k| t[k].cross(origin - ends[2 * k]));
        let (p, q) = (h[0] - h[1], h[0] - h[2]);
        let centre = (along * p - across * q) * (1.0 / spread);
        return Some((origin, centre, h[0] + t[0].cross(centre)));
    }
    let h: [f64; 3] = std::array::from_fn(|k| height(origin, ends[2 * k], ends[2 * k + 1], t[k]));
    let c = [t[0].cross(t[1]), t[1].cross(t[2]), t[2].cross(t[0])];
    let cos = [t[0].dot(t[1]), t[1].dot(t[2]), t[2].dot(t[0])];
    let product: f64 = (0..3).map(|k| sigma(c[k], cos[k])).product();
    // Counterclockwise contacts make the sum of the three sines positive.
    let same = (c[0] >= 0.0) == (c[1] >= 0.0) && (c[1] >= 0.0) == (c[2] >= 0.0);
    let d = if same { product / 2.0 } else { -product / 2.0 };
    if d.is_nan() || d <= 0.0 {
        return None;
    }
    let r = (h[0] * c[1] + h[1] * c[2] + h[2] * c[0]) / d;
    // c12 and c13 = -c31; take the larger.
    let (j, c1j, g1j) =
        if c[0].abs() >= c[2].abs() { (1, c[0], cos[0]) } else { (2, -c[2], cos[2]) };
    let (_, um) = complements(c1j, g1j);
    let x = (r * um + h[0] * g1j - h[j]) / -c1j;
    Some((origin, t[0] * x + t[0].perp() * (r - h[0]), r))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edge(a: (f64, f64), b: (f64, f64)) -> Governor {
        let (start, end) = (Point::new(a.0, a.1), Point::new(b.0, b.1));
        let d = end - start;
        Governor::Edge { start, end, direction: d * (1.0 / d.norm()) }
    }

    fn corner(x: f64, y: f64) -> Governor {
        Governor::Corner(Point::new(x, y))
    }

    fn check(g: [Governor; 3], x: f64, y: f64, r: f64) {
        for turn in 0..3 {
            let mut g = g;
            g.rotate_left(turn);
            let disk = TouchingDisk::guess(&g, Point::default()).unwrap();
            let disk = disk.certified(&g).unwrap();
            let off = (disk.position() - Point::new(x, y)).norm() + (disk.radius - r).abs();
            assert!(off <= 2.0 * disk.bound && disk.bound < 1e-13 * r, "{disk:?}");
        }
    }

    #[test]
    fn three_four_five_triangle_has_radius_one() {
        let g = [
            edge((0.0, 0.0), (4.0, 0.0)),
            edge((4.0, 0.0), (0.0, 3.0)),
            edge((0.0, 3.0), (0.0, 0.0)),
        ];
        check(g, 1.0, 1.0, 1.0);
    }

    #[test]
    fn a_corner_between_two_walls_of_an_l() {
        let q = 2.0 - 2.0_f64.sqrt();
        let g = [corner(1.0, 1.0), edge((0.0, 3.0), (0.0, 0.0)), edge((0.0, 0.0), (3.0, 0.0))];
        check(g, q, q, q);
    }

    #[test]
    fn the_end_of_an_edge_and_the_wall_opposite() {
        let g = [corner(1.0, 1.0), edge((3.0, 1.0), (1.0, 1.0)), edge((0.0, 0.0), (3.0, 0.0))];
        check(g, 1.0, 0.5, 0.5);
    }

    #[test]
    fn the_disk_in_a_flat_corner_is_as_precise_as_the_directions_of_its_edges() {
        use crate::geom::predicates::{Element, ExactDisk};
        // Three edges of a polygon around (0, 1), each turned by 1e-5.
        let at = |k: usize| {
            let (sin, cos) = (1e-5 * k as f64).sin_cos();
            (sin, 1.0 - cos)
        };
        let [a, b, c] = [0, 1, 2].map(|k| edge(at(k), at(k + 1)));
        let of = |g: Governor| match g {
            Governor::Edge { start, end, direction } => (Element::Edge(start, end), direction),
            Governor::Corner(p) => (Element::Corner(p), p),
        };
        let [(e, incoming), (f, outgoing), (g, _)] = [a, b, c].map(of);
        let disk = TouchingDisk::in_corner(b.anchor(), incoming, outgoing, &c).unwrap();
        let (_, radius) = ExactDisk::new([e, f, g]).unwrap().approximate();
        assert!((disk.radius / radius - 1.0).abs() < 1e-9, "{} {radius}", disk.radius);
    }

    #[test]
    fn two_corners_and_the_wall_below() {
        // 5² + (r - 1)² = r² at the corners (-5, 1) and (5, 1): r = 13.
        let g = [corner(5.0, 1.0), corner(-5.0, 1.0), edge((-9.0, 0.0), (9.0, 0.0))];
        check(g, 0.0, 13.0, 13.0);
    }

    #[test]
    fn three_corners_give_the_circumcircle() {
        check([corner(0.0, 0.0), corner(8.0, 0.0), corner(0.0, 6.0)], 4.0, 3.0, 5.0);
    }

    #[test]
    fn clockwise_order_gives_no_disk() {
        let g = [
            edge((0.0, 3.0), (0.0, 0.0)),
            edge((4.0, 0.0), (0.0, 3.0)),
            edge((0.0, 0.0), (4.0, 0.0)),
        ];
        assert!(TouchingDisk::guess(&g, Point::default()).is_none());
    }
}
