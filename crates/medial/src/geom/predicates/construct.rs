//! The disks touching three elements, in homogeneous integer form.

use std::cmp::Ordering;

use dashu_int::IBig;

use super::Element;
use super::grid::{Grid, Vector};
use super::homogeneous::{Homogeneous, Radius};
use super::tower::{Surd, Tower, sign_of_integer};
use crate::geom::Point;

/// The elements turned so that corners come first, in the same cyclic order.
pub(super) fn corners_first([a, b, c]: [Element; 3]) -> [Element; 3] {
    let is_corner = |element| matches!(element, Element::Corner(_));
    if is_corner(a) && !is_corner(c) {
        [a, b, c]
    } else if is_corner(b) && !is_corner(a) {
        [b, c, a]
    } else if is_corner(c) && !is_corner(b) {
        [c, a, b]
    } else {
        // All of one kind.
        [a, b, c]
    }
}

/// A point every form below may use as origin: a corner that touches, or an end of the first edge.
fn local_origin(elements: &[Element; 3]) -> Point {
    match elements {
        [Element::Corner(p), ..] => *p,
        // An end shared with another edge makes its distance to both of them zero.
        [Element::Edge(a, b), second, third] => {
            let ends = |point: &Point| {
                [second, third]
                    .iter()
                    .any(|e| matches!(e, Element::Edge(c, d) if c == point || d == point))
            };
            if !ends(a) && ends(b) { *b } else { *a }
        }
    }
}

/// The disk touching the elements, which are in the order [`corners_first`] gives.
pub(super) fn construct(elements: &[Element; 3]) -> Option<Homogeneous> {
    let points = elements.map(|element| match element {
        Element::Corner(p) => [p, p],
        Element::Edge(a, b) => [a, b],
    });
    let grid = Grid::new(local_origin(elements), points.as_flattened());
    let through_origin = matches!(elements[0], Element::Corner(_));
    let Form { tower, x, y, w, radius } = form(elements, grid)?;
    Some(Homogeneous { grid, through_origin, tower, x, y, w, radius })
}

/// The numbers of a [`Homogeneous`] disk.
struct Form {
    tower: Tower,
    x: Surd,
    y: Surd,
    w: Surd,
    radius: Radius,
}

fn form(elements: &[Element; 3], grid: Grid) -> Option<Form> {
    match *elements {
        [Element::Corner(_), Element::Corner(q), Element::Corner(s)] => {
            three_corners(&grid.local(q), &grid.local(s))
        }
        [Element::Corner(_), Element::Corner(q), Element::Edge(a, b)] => {
            two_corners(&grid.local(q), &Line::new(grid, a, b)?)
        }
        [Element::Corner(_), Element::Edge(a, b), Element::Edge(c, d)] => {
            one_corner(&Line::new(grid, a, b)?, &Line::new(grid, c, d)?)
        }
        [Element::Edge(a, b), Element::Edge(c, d), Element::Edge(e, f)] => {
            no_corner(&[Line::new(grid, a, b)?, Line::new(grid, c, d)?, Line::new(grid, e, f)?])
        }
        // The order excludes the rest.
        _ => None,
    }
}

/// A supporting line.
struct Line {
    /// Its direction.
    d: Vector,
    /// `d·d`.
    n: IBig,
    /// `√n` times the signed distance of the origin.
    h: IBig,
}

impl Line {
    fn new(grid: Grid, a: Point, b: Point) -> Option<Self> {
        let d = grid.difference(a, b);
        if d.is_zero() {
            return None;
        }
        let d = d.direction();
        Some(Self { n: d.norm2(), h: grid.local(a).cross(&d), d })
    }

    /// `x·d + y·d⊥` for a vector given by its components times `√n`.
    fn place(&self, along: &Surd, across: &Surd) -> (Surd, Surd) {
        (
            along.scale(&self.d.x).sub(&across.scale(&self.d.y)),
            along.scale(&self.d.y).add(&across.scale(&self.d.x)),
        )
    }
}

/// Corners at the origin, `a` and `b`.
fn three_corners(a: &Vector, b: &Vector) -> Option<Form> {
    let w = a.cross(b) << 1;
    if sign_of_integer(&w) != Ordering::Greater {
        return None;
    }
    let (of_a, of_b) = (a.norm2(), b.norm2());
    let x = &b.y * &of_a - &a.y * &of_b;
    let y = &a.x * &of_b - &b.x * &of_a;
    // r = |a|·|b|·|a - b| / w
    let square = of_a * of_b * a.sub(b).norm2();
    Some(Form {
        tower: Tower::default(),
        x: Surd::integer(x),
        y: Surd::integer(y),
        w: Surd::integer(w),
        radius: Radius::Times { part: Surd::integer(IBig::ONE), n: square },
    })
}

/// Corners at the origin and `w`, and an edge.
fn two_corners(w: &Vector, edge: &Line) -> Option<Form> {
    let (u, v) = (edge.d.dot(w), edge.d.cross(w));
    let hp = &edge.h;
    let hq = hp + &v;
    if sign_of_integer(hp) == Ordering::Less || sign_of_integer(&hq) == Ordering::Less {
        return None;
    }
    let mut tower = Tower::default();
    if v.is_zero() {
        // The contact lies below the middle of the corners, to the left of the way from the first
        // to the second.
        if sign_of_integer(&u) != Ordering::Less || hp.is_zero() {
            return None;
        }
        let (u2, hp2) = (&u * &u, (hp * hp) << 2);
        // d·c = u/2,  r·√n = (u²/4 + hp²)/(2hp)
        let along = Surd::integer((&u * hp) << 2);
        let across = Surd::integer(&u2 - &hp2);
        let (x, y) = edge.place(&along, &across);
        return Some(Form {
            tower,
            x,
            y,
            w: Surd::integer((hp * &edge.n) << 3),
            radius: Radius::Over { part: Surd::integer((u2 + hp2) * &edge.n), n: edge.n.clone() },
        });
    }
    let nl = &edge.n * w.norm2();
    let root = tower.root(Surd::integer(&nl * hp * &hq));
    // d·c = foot/v,  foot² = hp·square
    let foot = root.clone().plus(&(hp * &u)).scale(&IBig::NEG_ONE);
    let square = root.scale(&(&u << 1)).plus(&(hp * &u * &u + nl * hq));
    let v2 = &v * &v;
    let hv = hp * &v2;
    let along = foot.scale(&(v << 1));
    let across = square.clone().plus(&-&hv);
    let (x, y) = edge.place(&along, &across);
    Some(Form {
        tower,
        x,
        y,
        w: Surd::integer((&edge.n * v2) << 1),
        // r·√n = (square + hp·v²)/(2v²)
        radius: Radius::Over { part: square.plus(&hv).scale(&edge.n), n: edge.n.clone() },
    })
}

/// A corner at the origin and two edges.
fn one_corner(first: &Line, second: &Line) -> Option<Form> {
    let (n1, h1, h2) = (&first.n, &first.h, &second.h);
    let (s1, s2) = (sign_of_integer(h1), sign_of_integer(h2));
    if s1 == Ordering::Less || s2 == Ordering::Less || (s1.is_eq() && s2.is_eq()) {
        return None;
    }
    let c = first.d.cross(&second.d);
    let g = first.d.dot(&second.d);
    let mut tower = Tower::default();
    if c.is_zero() {
        // Equal directions allow no disk between the lines; for opposite ones √(n1·n2) = -g.
        if sign_of_integer(&g) == Ordering::Greater {
            return None;
        }
        let alpha = -g;
        let (near, far) = (h1 * &alpha, h2 * n1);
        // d1·c = √(h1·h2·n1/alpha),  2r·√n1 = h1 + h2·n1/alpha
        let along = tower.root(Surd::integer(h1 * &far * &alpha)).shift(1);
        let (x, y) = first.place(&along, &Surd::integer(&far - &near));
        return Some(Form {
            tower,
            x,
            y,
            w: Surd::integer((n1 * alpha) << 1),
            radius: Radius::Over { part: Surd::integer((near + far) * n1), n: n1.clone() },
        });
    }
    let alpha = tower.root(Surd::integer(n1 * &second.n));
    let up = alpha.clone().plus(&g);
    let gamma = tower.root(up.scale(&((n1 * h1 * h2) << 1)));
    // The sign of the root that puts the contacts in the order given.
    let gamma = if sign_of_integer(&c).is_gt() { gamma.scale(&IBig::NEG_ONE) } else { gamma };
    // r·√n1 = reach/(alpha - g) = reach·up/c²
    let reach = alpha.scale(h1).plus(&(h2 * n1)).add(&gamma);
    let c2 = &c * &c;
    let reach = tower.mul(&reach, &up);
    // d1·c = -(h1·up + gamma)/c
    let along = up.scale(h1).add(&gamma).scale(&-c);
    let across = reach.clone().plus(&-(h1 * &c2));
    let (x, y) = first.place(&along, &across);
    Some(Form {
        tower,
        x,
        y,
        w: Surd::integer(n1 * c2),
        radius: Radius::Over { part: reach.scale(n1), n: n1.clone() },
    })
}

/// Three edges.
fn no_corner(lines: &[Line; 3]) -> Option<Form> {
    let [l1, l2, l3] = lines;
    let mut tower = Tower::default();
    let roots = [
        Surd::integer(l1.n.clone()),
        tower.root(Surd::integer(&l1.n * &l2.n)),
        tower.root(Surd::integer(&l1.n * &l3.n)),
    ];
    let crosses = [l2.d.cross(&l3.d), l3.d.cross(&l1.d), l1.d.cross(&l2.d)];
    // Twice the area of the triangle of the three normals, which the order makes positive.
    let w = weighted(&roots, &crosses);
    if tower.sign(&w) != Ordering::Greater {
        return None;
    }
    // r = m·√n1/w
    let m = &l1.h * &crosses[0] + &l2.h * &crosses[1] + &l3.h * &crosses[2];
    if sign_of_integer(&m) == Ordering::Less {
        return None;
    }
    // d_i⊥·c + h_i = r·√n_i; Cramer's rule for the two coordinates.
    let pairs = [(l2, l3), (l3, l1), (l1, l2)];
    let x = pairs.map(|(j, k)| &j.d.x * &k.h - &k.d.x * &j.h);
    let y = pairs.map(|(j, k)| &j.d.y * &k.h - &k.d.y * &j.h);
    Some(Form {
        x: weighted(&roots, &x),
        y: weighted(&roots, &y),
        tower,
        w,
        radius: Radius::Times { part: Surd::integer(m), n: l1.n.clone() },
    })
}

/// The sum of the roots times their integer factors.
fn weighted(roots: &[Surd; 3], factors: &[IBig; 3]) -> Surd {
    let [a, b, c] = [0, 1, 2].map(|i| roots[i].scale(&factors[i]));
    a.add(&b).add(&c)
}
