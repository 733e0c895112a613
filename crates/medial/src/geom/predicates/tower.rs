//! Numbers with nested square roots, and their exact sign.

use std::cmp::Ordering;

use dashu_int::ops::SquareRootRem;
use dashu_int::{IBig, Sign};

use super::rough::Rough;

/// An element of a [`Tower`]: an integer combination of products of its roots.
///
/// Coefficient `i` belongs to the product of the roots whose bit is set in `i`, so an element that
/// uses no root above level `k` has `2^k` coefficients.
/// The number of coefficients is a power of two; missing ones are zero.
#[derive(Clone, Debug)]
pub(super) struct Surd(Vec<IBig>);

impl Surd {
    /// An ordinary integer.
    pub(super) fn integer(value: IBig) -> Self {
        Self(vec![value])
    }

    /// The sum.
    pub(super) fn add(&self, other: &Self) -> Self {
        Self(add(&self.0, &other.0))
    }

    /// The difference.
    pub(super) fn sub(&self, other: &Self) -> Self {
        Self(sub(&self.0, &other.0))
    }

    /// The sum with an integer.
    pub(super) fn plus(mut self, value: &IBig) -> Self {
        self.0[0] += value;
        self
    }

    /// The product with an integer.
    pub(super) fn scale(&self, factor: &IBig) -> Self {
        Self(self.0.iter().map(|c| c * factor).collect())
    }

    /// The product with a power of two.
    pub(super) fn shift(&self, bits: usize) -> Self {
        Self(self.0.iter().map(|c| c << bits).collect())
    }

    /// The coefficients, as the invariant above describes them.
    pub(super) fn coefficients(&self) -> &[IBig] {
        &self.0
    }
}

/// A tower of real quadratic extensions of the rationals: each root is that of a positive element
/// of the levels below it.
#[derive(Clone, Debug, Default)]
pub(super) struct Tower {
    /// The element at place `k` is positive and uses the first `k` roots only.
    radicands: Vec<Surd>,
    /// The roots of the radicands, rounded.
    roots: Vec<Rough>,
}

impl Tower {
    /// The radicands, lowest level first.
    pub(super) fn radicands(&self) -> &[Surd] {
        &self.radicands
    }

    /// The roots of the radicands, rounded.
    pub(super) fn roots(&self) -> &[Rough] {
        &self.roots
    }

    /// The product.
    pub(super) fn mul(&self, a: &Surd, b: &Surd) -> Surd {
        Surd(self.product(&a.0, &b.0))
    }

    /// The square.
    pub(super) fn square(&self, a: &Surd) -> Surd {
        Surd(self.product(&a.0, &a.0))
    }

    /// The exact sign of an element, as its order against zero.
    pub(super) fn sign(&self, a: &Surd) -> Ordering {
        self.sign_of(&a.0)
    }

    /// The square root of an element, which becomes a new level unless it is known already.
    ///
    /// An integer that is a square gives an integer, and an integer met before its earlier root.
    /// An element that is not positive gives zero.
    pub(super) fn root(&mut self, radicand: Surd) -> Surd {
        if self.sign(&radicand) != Ordering::Greater {
            return Surd::integer(IBig::ZERO);
        }
        let coefficients = trimmed(&radicand.0);
        if let [value] = coefficients {
            return self.root_of_integer(value);
        }
        let known = Surd(coefficients.to_vec());
        self.level_of(known)
    }

    /// The square root of a positive integer.
    fn root_of_integer(&mut self, value: &IBig) -> Surd {
        // An even number of trailing zero bits leaves the radicand, so that more radicands agree.
        let half = value.trailing_zeros().unwrap_or(0) / 2;
        let odd = value >> (2 * half);
        let (_, magnitude) = odd.clone().into_parts();
        let (root, rest) = magnitude.sqrt_rem();
        let root = if rest.is_zero() {
            Surd::integer(IBig::from(root))
        } else {
            self.level_of(Surd(vec![odd]))
        };
        root.shift(half)
    }

    /// The root of a positive radicand: that of an equal radicand if there is one, else a new level.
    fn level_of(&mut self, radicand: Surd) -> Surd {
        let level = match self.radicands.iter().position(|known| known.0 == radicand.0) {
            Some(level) => level,
            None => {
                self.roots.push(Rough::of(&radicand.0, &self.roots, 0).root());
                self.radicands.push(radicand);
                self.radicands.len() - 1
            }
        };
        let mut coefficients = vec![IBig::ZERO; 2 << level];
        coefficients[1 << level] = IBig::ONE;
        Surd(coefficients)
    }

    /// Adds the roots of another tower to this one; gives each of them as an element of this one.
    pub(super) fn adjoin(&mut self, other: &Tower) -> Vec<Surd> {
        let mut roots = Vec::with_capacity(other.radicands.len());
        for radicand in &other.radicands {
            let image = self.image(radicand, &roots);
            let root = self.root(image);
            roots.push(root);
        }
        roots
    }

    /// An element of another tower as one of this tower, given the images of the other's roots.
    pub(super) fn image(&self, element: &Surd, roots: &[Surd]) -> Surd {
        self.image_of(trimmed(&element.0), roots)
    }

    fn image_of(&self, a: &[IBig], roots: &[Surd]) -> Surd {
        if a.len() == 1 {
            return Surd(a.to_vec());
        }
        let (low, high) = a.split_at(a.len() / 2);
        let level = high.len().trailing_zeros() as usize;
        let high = self.mul(&self.image_of(high, roots), &roots[level]);
        self.image_of(low, roots).add(&high)
    }

    fn product(&self, a: &[IBig], b: &[IBig]) -> Vec<IBig> {
        let (a, b) = (trimmed(a), trimmed(b));
        if a.len() < b.len() {
            return self.product(b, a);
        }
        if a.len() == 1 {
            return vec![&a[0] * &b[0]];
        }
        let half = a.len() / 2;
        let (a_low, a_high) = a.split_at(half);
        if b.len() <= half {
            // (a0 + a1·√c)·b
            return joined(self.product(a_low, b), self.product(a_high, b), half);
        }
        let radicand = &self.radicands[half.trailing_zeros() as usize].0;
        let (b_low, b_high) = b.split_at(half);
        // (a0 + a1·√c)(b0 + b1·√c) = a0·b0 + c·a1·b1 + (a0·b1 + a1·b0)·√c
        let highs = self.product(&self.product(a_high, b_high), radicand);
        let low = add(&self.product(a_low, b_low), &highs);
        let high = add(&self.product(a_low, b_high), &self.product(a_high, b_low));
        joined(low, high, half)
    }

    fn sign_of(&self, a: &[IBig]) -> Ordering {
        let a = trimmed(a);
        if a.len() == 1 {
            return sign_of_integer(&a[0]);
        }
        if let Some(sign) = Rough::sign(a, &self.roots) {
            return sign;
        }
        let half = a.len() / 2;
        let (low, high) = a.split_at(half);
        let (of_low, of_high) = (self.sign_of(low), self.sign_of(high));
        if of_low == of_high || of_high == Ordering::Equal {
            return of_low;
        }
        if of_low == Ordering::Equal {
            return of_high;
        }
        // The two parts pull in opposite directions: the larger square wins.
        let radicand = &self.radicands[half.trailing_zeros() as usize].0;
        let high = self.product(&self.product(high, high), radicand);
        let difference = self.sign_of(&sub(&self.product(low, low), &high));
        if of_low == Ordering::Greater { difference } else { difference.reverse() }
    }
}

/// The sign of `low + high·√radicand`, for a radicand that is not negative.
pub(super) fn sign_with_root(low: &IBig, high: &IBig, radicand: &IBig) -> Ordering {
    let (of_low, of_high) = (sign_of_integer(low), sign_of_integer(high));
    if of_low == of_high || of_high.is_eq() || radicand.is_zero() {
        return of_low;
    }
    if of_low.is_eq() {
        return of_high;
    }
    let larger = (low * low).cmp(&(high * high * radicand));
    if of_low.is_gt() { larger } else { larger.reverse() }
}

/// The order of an integer against zero.
pub(super) fn sign_of_integer(value: &IBig) -> Ordering {
    if value.is_zero() {
        Ordering::Equal
    } else if value.sign() == Sign::Positive {
        Ordering::Greater
    } else {
        Ordering::Less
    }
}

/// The coefficients without the upper levels that are zero throughout.
fn trimmed(mut a: &[IBig]) -> &[IBig] {
    while a.len() > 1 {
        let (low, high) = a.split_at(a.len() / 2);
        if high.iter().any(|c| !c.is_zero()) {
            break;
        }
        a = low;
    }
    a
}

/// `low + high·√c`, where each part belongs to the `half` lower coefficients.
fn joined(mut low: Vec<IBig>, mut high: Vec<IBig>, half: usize) -> Vec<IBig> {
    low.resize(half, IBig::ZERO);
    high.resize(half, IBig::ZERO);
    low.append(&mut high);
    low
}

fn add(a: &[IBig], b: &[IBig]) -> Vec<IBig> {
    let (long, short) = if a.len() < b.len() { (b, a) } else { (a, b) };
    let mut sum = long.to_vec();
    for (to, from) in sum.iter_mut().zip(short) {
        *to += from;
    }
    sum
}

fn sub(a: &[IBig], b: &[IBig]) -> Vec<IBig> {
    let mut difference = a.to_vec();
    if difference.len() < b.len() {
        difference.resize(b.len(), IBig::ZERO);
    }
    for (to, from) in difference.iter_mut().zip(b) {
        *to -= from;
    }
    difference
}

#[cfg(test)]
mod tests {
    use super::*;

    fn integer(value: i64) -> Surd {
        Surd::integer(IBig::from(value))
    }

    #[test]
    fn roots_of_squares_are_integers() {
        let mut tower = Tower::default();
        let root = tower.root(integer(49 << 12));
        assert_eq!(root.coefficients(), [IBig::from(7 << 6)]);
        assert!(tower.radicands().is_empty());
    }

    #[test]
    fn equal_radicands_share_a_level() {
        let mut tower = Tower::default();
        let (a, b) = (tower.root(integer(3)), tower.root(integer(12)));
        assert_eq!(tower.radicands().len(), 1);
        assert_eq!(tower.sign(&a.scale(&IBig::from(2)).sub(&b)), Ordering::Equal);
    }

    #[test]
    fn nested_roots_that_cancel_are_zero() {
        // √(3 + 2√2) = 1 + √2
        let mut tower = Tower::default();
        let two = tower.root(integer(2));
        let nested = two.scale(&IBig::from(2)).plus(&IBig::from(3));
        let nested = tower.root(nested);
        let difference = nested.sub(&two).plus(&IBig::NEG_ONE);
        assert_eq!(tower.sign(&difference), Ordering::Equal);
        // The smallest change shows, however long the numbers are.
        let long = IBig::ONE << 3000;
        let more = difference.scale(&long);
        assert_eq!(tower.sign(&more.clone().plus(&IBig::ONE)), Ordering::Greater);
        assert_eq!(tower.sign(&more.plus(&IBig::NEG_ONE)), Ordering::Less);
    }

    #[test]
    fn dependent_roots_on_two_levels_cancel() {
        // √2·√3 = √6
        let mut tower = Tower::default();
        let [two, three, six] = [2, 3, 6].map(|n| tower.root(integer(n)));
        let product = tower.mul(&two, &three);
        assert_eq!(tower.sign(&product.sub(&six)), Ordering::Equal);
        assert_eq!(tower.sign(&six.sub(&two).sub(&three)), Ordering::Less);
    }

    #[test]
    fn elements_keep_their_value_in_another_tower() {
        // √5 + √7 with the roots met in the other order.
        let (mut first, mut second) = (Tower::default(), Tower::default());
        let [a, b] = [5, 7].map(|n| first.root(integer(n)));
        let a = a.add(&b);
        let [c, d] = [7, 5].map(|n| second.root(integer(n)));
        let b = c.add(&d);
        let roots = first.adjoin(&second);
        assert_eq!(first.radicands().len(), 2);
        assert_eq!(first.sign(&a.sub(&first.image(&b, &roots))), Ordering::Equal);
    }

    #[test]
    fn one_root_has_a_sign_without_a_tower() {
        let sign =
            |a: i64, b: i64, c: i64| sign_with_root(&IBig::from(a), &IBig::from(b), &IBig::from(c));
        assert_eq!(sign(-3, 2, 2), Ordering::Less);
        assert_eq!(sign(-7, 5, 2), Ordering::Greater);
        assert_eq!(sign(10, -5, 4), Ordering::Equal);
        assert_eq!(sign(0, -5, 4), Ordering::Less);
        assert_eq!(sign(0, -5, 0), Ordering::Equal);
    }
}
