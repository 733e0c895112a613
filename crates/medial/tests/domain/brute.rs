//! The verdict on a polygon with small integer coordinates, straight from the definitions: all
//! pairs of edges, and winding numbers on both sides of every piece.

use medial::geom::Point;

pub type P = (i128, i128);

#[derive(Debug, PartialEq, Eq)]
pub struct Verdict {
    pub degenerate: bool,
    pub crossing: bool,
    pub overlap: bool,
    pub wrong_side: bool,
    /// Number of pieces of the boundary that are left.
    pub pieces: usize,
    pub twice_area: i128,
    pub bridges: usize,
}

impl Verdict {
    pub fn accepted(&self) -> bool {
        !(self.degenerate || self.crossing || self.overlap || self.wrong_side) && self.pieces > 0
    }
}

fn cross(a: P, b: P, c: P) -> i128 {
    (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)
}

struct Ring {
    points: Vec<P>,
    raw: Vec<P>,
    folded: bool,
}

fn clean(ring: &[Point]) -> Option<Ring> {
    let raw: Vec<P> = ring.iter().map(|p| (p.x as i128, p.y as i128)).collect();
    let mut points = raw.clone();
    let mut folded = false;
    'again: loop {
        let n = points.len();
        if n < 3 {
            return None;
        }
        for k in 0..n {
            let (a, b, c) = (points[(k + n - 1) % n], points[k], points[(k + 1) % n]);
            if a == b || cross(a, b, c) == 0 {
                let dot = (b.0 - a.0) * (c.0 - b.0) + (b.1 - a.1) * (c.1 - b.1);
                folded |= dot < 0;
                points.remove(k);
                continue 'again;
            }
        }
        return Some(Ring { points, raw, folded });
    }
}

fn twice_area(points: &[P]) -> i128 {
    let n = points.len();
    (0..n).map(|k| cross((0, 0), points[k], points[(k + 1) % n])).sum()
}

fn inside(p: P, a: P, b: P) -> bool {
    p != a && p != b && cross(a, b, p) == 0 && {
        (p.0 - a.0) * (p.0 - b.0) <= 0 && (p.1 - a.1) * (p.1 - b.1) <= 0
    }
}

/// Winding number around the point just beside the middle of `a` → `b`, on its left or right.
fn winding(edges: &[(usize, P, P)], a: P, b: P, left: bool) -> i128 {
    // Doubled coordinates, so that the middle is an integer.
    let m = (a.0 + b.0, a.1 + b.1);
    let s = if left { 1 } else { -1 };
    let n = (-(b.1 - a.1) * s, (b.0 - a.0) * s);
    let beyond = |x: i128| 2 * x > m.0 || 2 * x == m.0 && n.0 < 0;
    let mut sum = 0;
    for &(_, c, d) in edges {
        if beyond(c.0) == beyond(d.0) {
            continue;
        }
        // Above the point, if the point is to the right of the edge seen from left to right.
        let (l, r, sign) = if beyond(d.0) { (c, d, -1) } else { (d, c, 1) };
        let (l2, r2) = ((2 * l.0, 2 * l.1), (2 * r.0, 2 * r.1));
        let mut side = cross(l2, r2, m);
        if side == 0 {
            side = (r.0 - l.0) * n.1 - (r.1 - l.1) * n.0;
        }
        if side < 0 {
            sum += sign;
        }
    }
    sum
}

/// Whether two polygons that are valid by themselves overlap.
pub fn overlap(one: &[Vec<Point>], other: &[Vec<Point>]) -> bool {
    let sides = [directed(one), directed(other)];
    let crosses = |(a, b): (P, P), (c, d): (P, P)| {
        cross(a, b, c).signum() * cross(a, b, d).signum() < 0
            && cross(c, d, a).signum() * cross(c, d, b).signum() < 0
    };
    let corners: Vec<P> = sides.iter().flatten().map(|e| e.1).collect();
    [0, 1].into_iter().any(|k| {
        let (own, theirs) = (&sides[k], &sides[1 - k]);
        own.iter().any(|&(_, a, b)| {
            let mut on: Vec<P> = corners.iter().copied().filter(|&p| inside(p, a, b)).collect();
            on.extend([a, b]);
            on.sort_unstable_by_key(|p| (p.0 - a.0).abs() + (p.1 - a.1).abs());
            on.dedup();
            theirs.iter().any(|&(_, c, d)| crosses((a, b), (c, d)))
                || on.windows(2).any(|w| {
                    winding(own, w[0], w[1], true) == 1 && winding(theirs, w[0], w[1], true) == 1
                        || winding(own, w[0], w[1], false) == 1
                            && winding(theirs, w[0], w[1], false) == 1
                })
        })
    })
}

/// Edges with the interior on the left, with their ring.
fn directed(rings: &[Vec<Point>]) -> Vec<(usize, P, P)> {
    let mut edges = Vec::new();
    for (k, ring) in rings.iter().enumerate() {
        let Some(mut ring) = clean(ring) else { continue };
        if (twice_area(&ring.points) < 0) == (k == 0) {
            ring.points.reverse();
        }
        let n = ring.points.len();
        edges.extend((0..n).map(|i| (k, ring.points[i], ring.points[(i + 1) % n])));
    }
    edges
}

pub fn verdict(rings: &[Vec<Point>]) -> Verdict {
    let mut v = Verdict {
        degenerate: false,
        crossing: false,
        overlap: false,
        wrong_side: false,
        pieces: 0,
        twice_area: 0,
        bridges: 0,
    };
    let mut all: Vec<Ring> = Vec::new();
    for (k, ring) in rings.iter().enumerate() {
        match clean(ring) {
            Some(mut ring) => {
                let area = twice_area(&ring.points);
                if area != 0 && (area < 0) == (k == 0) {
                    ring.points.reverse();
                }
                all.push(ring);
            }
            None if k == 0 => {
                v.degenerate = true;
                return v;
            }
            None => {}
        }
    }
    v.twice_area = all.iter().map(|r| twice_area(&r.points)).sum();
    let edges: Vec<(usize, P, P)> = all
        .iter()
        .enumerate()
        .flat_map(|(ring, r)| {
            let n = r.points.len();
            (0..n).map(move |k| (ring, r.points[k], r.points[(k + 1) % n]))
        })
        .collect();
    for (i, &(ri, a, b)) in edges.iter().enumerate() {
        for &(rj, c, d) in &edges[..i] {
            let (c1, c2) = (cross(a, b, c), cross(a, b, d));
            let (d1, d2) = (cross(c, d, a), cross(c, d, b));
            v.crossing |= c1.signum() * c2.signum() < 0 && d1.signum() * d2.signum() < 0;
            if c1 != 0 || c2 != 0 {
                continue;
            }
            // On one line: the overlap lies between the second and third of the ends.
            let mut ends = [a, b, c, d];
            ends.sort_unstable();
            let (from, to) = (ends[1], ends[2]);
            if a.min(b).max(c.min(d)) >= a.max(b).min(c.max(d)) {
                continue;
            }
            if (a < b) == (c < d) {
                v.overlap = true;
                continue;
            }
            for (ring, e, f) in [(ri, a, b), (rj, c, d)] {
                for p in [from, to] {
                    if p == e || p == f {
                        continue;
                    }
                    v.overlap |= !all[ring].folded && !on_run(&all[ring].raw, p, e, f);
                }
            }
        }
    }
    if v.crossing || v.overlap {
        return v;
    }
    let corners: Vec<P> = all.iter().flat_map(|r| r.points.iter().copied()).collect();
    let mut pieces: Vec<(P, P)> = Vec::new();
    for &(_, a, b) in &edges {
        let mut on: Vec<P> = corners.iter().copied().filter(|&p| inside(p, a, b)).collect();
        on.extend([a, b]);
        on.sort_unstable_by_key(|p| (p.0 - a.0).abs() + (p.1 - a.1).abs());
        on.dedup();
        pieces.extend(on.windows(2).map(|w| (w[0], w[1])));
    }
    for &(a, b) in &pieces {
        if pieces.contains(&(b, a)) {
            v.bridges += 1;
            continue;
        }
        v.pieces += 1;
        v.wrong_side |= winding(&edges, a, b, true) != 1 || winding(&edges, a, b, false) != 0;
    }
    v
}

/// Whether `p` is a vertex of the ring as given on its way between `a` and `b`.
fn on_run(raw: &[P], p: P, a: P, b: P) -> bool {
    let n = raw.len();
    (0..n).any(|k| {
        raw[k] == p
            && [1, n - 1].into_iter().all(|step| {
                // Walk away in one direction until the run ends.
                let mut at = k;
                for _ in 0..n {
                    at = (at + step) % n;
                    if raw[at] == a || raw[at] == b {
                        return true;
                    }
                    if !inside(raw[at], a, b) {
                        return false;
                    }
                }
                false
            })
    })
}
