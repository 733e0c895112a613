//! An independent construction in binary floats of 1600 bits.
//!
//! The equations of two elements less that of the third are linear in centre and radius; their common
//! line meets the cone of the third element in at most two points. Nothing here knows the closed forms
//! of the library. What is below [`ZERO`] counts as zero: rounding stays near 2^-1400 for the sizes
//! used here, and no value that is not zero comes near it.

use std::cmp::Ordering;

use crate::geom::Point;
use crate::geom::predicates::Element;
use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

pub type Real = FBig<HalfEven, 2>;

/// Bits of every number.
const BITS: usize = 1600;

/// The exponent of two below which a value counts as zero.
const ZERO: isize = -400;

pub fn real(value: f64) -> Real {
    Real::try_from(value).expect("a finite double").with_precision(BITS).value()
}

pub fn sign(value: &Real) -> Ordering {
    let zero = Real::from_parts(1.into(), ZERO);
    if *value > zero {
        Ordering::Greater
    } else if *value < -zero {
        Ordering::Less
    } else {
        Ordering::Equal
    }
}

pub fn nearest(value: &Real) -> f64 {
    if sign(value) == Ordering::Equal { 0.0 } else { value.to_f64().value() }
}

#[derive(Clone, Debug)]
pub struct Vector {
    pub x: Real,
    pub y: Real,
}

impl Vector {
    pub fn new(p: Point) -> Self {
        Self { x: real(p.x), y: real(p.y) }
    }

    pub fn between(a: Point, b: Point) -> Self {
        Self::new(b).sub(&Self::new(a))
    }

    pub fn sub(&self, other: &Self) -> Self {
        Self { x: &self.x - &other.x, y: &self.y - &other.y }
    }

    pub fn dot(&self, other: &Self) -> Real {
        &self.x * &other.x + &self.y * &other.y
    }

    pub fn cross(&self, other: &Self) -> Real {
        &self.x * &other.y - &self.y * &other.x
    }

    pub fn norm(&self) -> Real {
        self.dot(self).sqrt()
    }

    fn scaled(&self, factor: &Real) -> Self {
        Self { x: &self.x * factor, y: &self.y * factor }
    }
}

/// The inward unit normal of an edge.
fn normal(a: Point, b: Point) -> Option<Vector> {
    let d = Vector::between(a, b);
    let length = d.norm();
    (sign(&length) == Ordering::Greater).then(|| Vector { x: -(&d.y / &length), y: &d.x / &length })
}

/// A disk with its centre and radius as long floats.
pub struct Disk {
    pub c: Vector,
    pub r: Real,
}

impl Disk {
    /// The disk the library promises for the same elements.
    pub fn new(elements: [Element; 3]) -> Option<Self> {
        let corner = elements.iter().position(|e| matches!(e, Element::Corner(_)));
        let candidates = match corner {
            None => Self::by_planes(elements),
            Some(k) => {
                let Element::Corner(p) = elements[k] else { return None };
                Self::by_cone(p, elements[(k + 1) % 3], elements[(k + 2) % 3])
            }
        };
        candidates
            .into_iter()
            .find(|disk| disk.radius_fits(corner.is_some()) && disk.order_fits(elements))
    }

    fn radius_fits(&self, with_corner: bool) -> bool {
        sign(&self.r) == Ordering::Greater || (!with_corner && sign(&self.r) == Ordering::Equal)
    }

    /// Contacts counterclockwise, or two of them the same.
    fn order_fits(&self, elements: [Element; 3]) -> bool {
        let outward = elements.map(|element| match element {
            Element::Corner(p) => {
                let v = Vector::new(p).sub(&self.c);
                let length = v.norm();
                Vector { x: &v.x / &length, y: &v.y / &length }
            }
            Element::Edge(a, b) => {
                let n = normal(a, b).expect("an edge of some length");
                Vector { x: -n.x, y: -n.y }
            }
        });
        let [p, q, s] = outward;
        let area = q.sub(&p).cross(&s.sub(&p));
        match sign(&area) {
            Ordering::Greater => true,
            // Only a corner on a line shares its contact with that line; equal corners are no disk.
            Ordering::Equal => {
                elements.iter().any(|e| matches!(e, Element::Corner(_)))
                    && elements.iter().any(|e| matches!(e, Element::Edge(..)))
            }
            Ordering::Less => false,
        }
    }

    /// Three equations n·c - r = n·a.
    fn by_planes(elements: [Element; 3]) -> Vec<Self> {
        let mut rows = Vec::new();
        for element in elements {
            let Element::Edge(a, b) = element else { return Vec::new() };
            let Some(n) = normal(a, b) else { return Vec::new() };
            rows.push((n.clone(), n.dot(&Vector::new(a))));
        }
        // Subtract the first row, solve two equations for the centre.
        let (n1, k1) = &rows[0];
        let (m2, m3) = (rows[1].0.sub(n1), rows[2].0.sub(n1));
        let (e2, e3) = (&rows[1].1 - k1, &rows[2].1 - k1);
        let det = m2.cross(&m3);
        if sign(&det) == Ordering::Equal {
            return Vec::new();
        }
        let c =
            Vector { x: (&e2 * &m3.y - &e3 * &m2.y) / &det, y: (&e3 * &m2.x - &e2 * &m3.x) / &det };
        let r = n1.dot(&c) - k1;
        vec![Self { c, r }]
    }

    /// The centre relative to a corner `p`: two planes and the cone |c| = r.
    fn by_cone(p: Point, a: Element, b: Element) -> Vec<Self> {
        let (Some(a), Some(b)) = (plane(p, a), plane(p, b)) else { return Vec::new() };
        // The line of both planes: direction (v, s), a point (o, t) of it.
        let v = Vector { x: &a.0.y * &b.1 - &a.1 * &b.0.y, y: &a.1 * &b.0.x - &a.0.x * &b.1 };
        let s = a.0.cross(&b.0);
        let size = v.dot(&v) + &s * &s;
        if sign(&size) == Ordering::Equal {
            return Vec::new();
        }
        // The point nearest to the origin: ((ka·B - kb·A) × (v, s)) / size, with A, B the normals.
        let m = Vector { x: &a.2 * &b.0.x - &b.2 * &a.0.x, y: &a.2 * &b.0.y - &b.2 * &a.0.y };
        let mz = &a.2 * &b.1 - &b.2 * &a.1;
        let o = Vector { x: (&m.y * &s - &mz * &v.y) / &size, y: (&mz * &v.x - &m.x * &s) / &size };
        let t = m.cross(&v) / &size;
        // |o + λv|² = (t + λs)²
        let qa = v.dot(&v) - &s * &s;
        let qb = o.dot(&v) - &t * &s;
        let qc = o.dot(&o) - &t * &t;
        let mut roots = Vec::new();
        if sign(&qa) == Ordering::Equal {
            if sign(&qb) != Ordering::Equal {
                roots.push(-(qc / (qb * real(2.0))));
            }
        } else {
            let discriminant = &qb * &qb - &qa * &qc;
            match sign(&discriminant) {
                Ordering::Less => {}
                Ordering::Equal => roots.push(-(qb / qa)),
                Ordering::Greater => {
                    let root = discriminant.sqrt();
                    roots.push((-&qb - &root) / &qa);
                    roots.push((-&qb + &root) / &qa);
                }
            }
        }
        let at = |lambda: Real| {
            let c = v.scaled(&lambda);
            let c = Vector { x: c.x + &o.x + real(p.x), y: c.y + &o.y + real(p.y) };
            Self { c, r: &t + lambda * &s }
        };
        roots.into_iter().map(at).collect()
    }

    /// What the library calls the side of an element.
    pub fn side(&self, element: Element) -> Ordering {
        sign(&match element {
            Element::Corner(p) => Vector::new(p).sub(&self.c).norm() - &self.r,
            Element::Edge(a, b) => {
                let n = normal(a, b).expect("an edge of some length");
                n.dot(&self.c.sub(&Vector::new(a))) - &self.r
            }
        })
    }

    pub fn front(&self, a: Point, b: Point) -> Ordering {
        sign(&Vector::between(a, b).cross(&self.c.sub(&Vector::new(a))))
    }

    pub fn along(&self, a: Point, b: Point, p: Point) -> Ordering {
        sign(&Vector::between(a, b).dot(&self.c.sub(&Vector::new(p))))
    }

    pub fn compare_radius(&self, length: f64) -> Ordering {
        sign(&(&self.r - real(length)))
    }

    pub fn orientation(&self, p: Point, q: Point) -> Ordering {
        sign(&Vector::new(p).sub(&self.c).cross(&Vector::new(q).sub(&self.c)))
    }
}

/// A touching element as the plane n·c + z·r = k around a touching corner `p`.
fn plane(p: Point, element: Element) -> Option<(Vector, Real, Real)> {
    match element {
        Element::Corner(q) => {
            let w = Vector::between(p, q);
            let k = w.dot(&w) / real(2.0);
            Some((w, real(0.0), k))
        }
        Element::Edge(a, b) => {
            let n = normal(a, b)?;
            let k = n.dot(&Vector::between(p, a));
            Some((n, real(-1.0), k))
        }
    }
}
