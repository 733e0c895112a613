use std::ops::{Add, Mul, Neg, Sub};

/// A point or a vector of the plane.
///
/// ```
/// use medial::geom::Point;
/// assert_eq!(Point::new(3.0, 4.0).dot(Point::new(3.0, 4.0)), 25.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// Abscissa, in units of the input.
    pub x: f64,
    /// Ordinate, in units of the input.
    pub y: f64,
}

/// Whole numbers in the order of finite doubles, with one zero.
#[inline]
pub(crate) fn order_key(value: f64) -> i64 {
    // Adding 0 turns -0 into 0. Of negative numbers all bits but the sign are turned round.
    let bits = (value + 0.0).to_bits() as i64;
    bits ^ (bits >> 63 & i64::MAX)
}

impl Point {
    /// The point with the given coordinates.
    #[inline]
    #[must_use]
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// The scalar product, rounded.
    #[inline]
    #[must_use]
    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// The third component of the cross product, rounded: positive when `other` lies to the left.
    #[inline]
    #[must_use]
    pub fn cross(self, other: Self) -> f64 {
        self.x * other.y - self.y * other.x
    }

    /// The vector turned by a quarter turn to the left.
    #[inline]
    #[must_use]
    pub fn perp(self) -> Self {
        Self::new(-self.y, self.x)
    }

    /// The squared length, rounded.
    #[inline]
    #[must_use]
    pub fn norm2(self) -> f64 {
        self.dot(self)
    }

    /// The length, rounded. Uses `sqrt` only, so it is the same on every platform.
    #[inline]
    #[must_use]
    pub fn norm(self) -> f64 {
        self.norm2().sqrt()
    }

    /// The centre of the circle through the origin and two points, if their cross product is not zero.
    #[inline]
    pub(crate) fn circumcentre(a: Self, b: Self) -> Self {
        let twice = 2.0 * a.cross(b);
        let (a2, b2) = (a.norm2(), b.norm2());
        Self::new((b.y * a2 - a.y * b2) / twice, (a.x * b2 - b.x * a2) / twice)
    }

    /// Orders by x, then by y.
    ///
    /// # Panics
    /// Never on finite coordinates.
    #[inline]
    #[must_use]
    pub fn lexicographic(self, other: Self) -> std::cmp::Ordering {
        self.x
            .partial_cmp(&other.x)
            .and_then(|o| self.y.partial_cmp(&other.y).map(|p| o.then(p)))
            .unwrap_or(std::cmp::Ordering::Equal)
    }
}

impl Add for Point {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y)
    }
}

impl Sub for Point {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y)
    }
}

impl Mul<f64> for Point {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self::new(self.x * factor, self.y * factor)
    }
}

impl Neg for Point {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_keys_are_in_the_order_of_the_numbers() {
        let numbers = [-1e300, -2.5, -1.0, -1e-300, 0.0, 1e-300, 1.0, 2.5, 1e300];
        assert!(numbers.windows(2).all(|pair| order_key(pair[0]) < order_key(pair[1])));
        assert_eq!(order_key(-0.0), order_key(0.0));
    }
}
