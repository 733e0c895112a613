//! Polynomials on the unit interval in Bernstein form, and their roots.

/// A polynomial by its coefficients in Bernstein form; never empty.
#[derive(Clone, Debug)]
pub(super) struct Polynomial(Vec<f64>);

/// Roots nearer to one another than this, or to an end of the interval, are one.
///
/// It keeps pieces of curves from being shorter than what rounding makes of their ends.
const SAME_ROOT: f64 = 1e-7;

/// Coefficients that are at most this share of the terms they are sums of are rounding.
const ROUNDING: f64 = 1e-11;

impl Polynomial {
    pub fn new(coefficients: Vec<f64>) -> Self {
        debug_assert!(!coefficients.is_empty(), "a polynomial has a coefficient");
        Self(coefficients)
    }

    fn degree(&self) -> usize {
        self.0.len() - 1
    }

    pub fn derivative(&self) -> Self {
        let n = self.degree();
        if n == 0 {
            return Self(vec![0.0]);
        }
        Self(self.0.windows(2).map(|w| n as f64 * (w[1] - w[0])).collect())
    }

    pub fn times(&self, other: &Self) -> Self {
        let (m, n) = (self.degree(), other.degree());
        let (rows, columns, sums) = (binomials(m), binomials(n), binomials(m + n));
        let mut product = vec![0.0; m + n + 1];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] += a * b * (rows[i] * columns[j] / sums[i + j]);
            }
        }
        Self(product)
    }

    pub fn scaled(&self, factor: f64) -> Self {
        Self(self.0.iter().map(|c| c * factor).collect())
    }

    /// The largest coefficient, without its sign.
    fn size(&self) -> f64 {
        self.0.iter().fold(0.0, |most, c| f64::max(most, c.abs()))
    }

    /// The same polynomial with a higher degree in name.
    fn raised(&self, degree: usize) -> Self {
        let mut raised = self.clone();
        while raised.degree() < degree {
            raised = raised.times(&Self(vec![1.0, 1.0]));
        }
        raised
    }

    /// The sum of terms; nothing if what they leave of one another is rounding.
    pub fn sum(terms: &[Self]) -> Option<Self> {
        let degree = terms.iter().map(Self::degree).max()?;
        let mut sum = vec![0.0; degree + 1];
        let mut size: f64 = 0.0;
        for term in terms {
            let term = term.raised(degree);
            size = size.max(term.size());
            sum.iter_mut().zip(&term.0).for_each(|(s, c)| *s += c);
        }
        let sum = Self(sum);
        (sum.size() > ROUNDING * size).then_some(sum)
    }

    /// Its roots inside of the unit interval, in order.
    pub fn roots(&self) -> Vec<f64> {
        let mut found = Vec::new();
        let mut ahead = vec![(self.0.clone(), 0.0, 1.0)];
        while let Some((coefficients, low, high)) = ahead.pop() {
            let width = high - low;
            match sign_changes(&coefficients) {
                0 => continue,
                1 if width < 1.0 / 16.0 || self.degree() < 4 => {
                    found.push(low + width * single(&coefficients));
                    continue;
                }
                _ if width < SAME_ROOT / 4.0 => {
                    found.push(low + 0.5 * width);
                    continue;
                }
                _ => {}
            }
            let middle = 0.5 * (low + high);
            let (left, right) = halves(coefficients);
            // A root in the middle changes the sign of neither half.
            if right[0] == 0.0 {
                found.push(middle);
            }
            ahead.push((right, middle, high));
            ahead.push((left, low, middle));
        }
        found.sort_by(f64::total_cmp);
        tidy(found)
    }
}

/// Places in the unit interval, in order, without those that are the same as an end or one another.
pub(super) fn tidy(mut places: Vec<f64>) -> Vec<f64> {
    places.retain(|t| SAME_ROOT < *t && *t < 1.0 - SAME_ROOT);
    places.sort_by(f64::total_cmp);
    places.dedup_by(|b, a| *b - *a < SAME_ROOT);
    places
}

fn sign_changes(coefficients: &[f64]) -> usize {
    let signs = coefficients.iter().filter(|c| **c != 0.0).map(|c| *c > 0.0);
    let mut changes = 0;
    let mut last = None;
    for sign in signs {
        changes += usize::from(last.is_some_and(|last| last != sign));
        last = Some(sign);
    }
    changes
}

/// The only root of a polynomial whose coefficients change their sign once.
fn single(coefficients: &[f64]) -> f64 {
    let at_end = coefficients.last().is_some_and(|c| *c > 0.0)
        || coefficients.iter().rev().find(|c| **c != 0.0).is_some_and(|c| *c > 0.0);
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (value(coefficients, middle) > 0.0) == at_end {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}

fn value(coefficients: &[f64], t: f64) -> f64 {
    let mut row = coefficients.to_vec();
    for len in (1..row.len()).rev() {
        for k in 0..len {
            row[k] = (1.0 - t) * row[k] + t * row[k + 1];
        }
    }
    row[0]
}

fn halves(mut row: Vec<f64>) -> (Vec<f64>, Vec<f64>) {
    let mut left = vec![row[0]];
    for len in (1..row.len()).rev() {
        for k in 0..len {
            row[k] = 0.5 * (row[k] + row[k + 1]);
        }
        left.push(row[0]);
    }
    (left, row)
}

/// The numbers `n` over `k`.
fn binomials(n: usize) -> Vec<f64> {
    let mut row = vec![1.0];
    for k in 0..n {
        row.push(row[k] * (n - k) as f64 / (k + 1) as f64);
    }
    row
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(root: f64) -> Polynomial {
        Polynomial::new(vec![-root, 1.0 - root])
    }

    #[test]
    fn roots_of_products_are_those_of_the_factors() {
        let roots = [0.125, 0.3, 0.5, 0.75, 0.9];
        let product = roots.iter().map(|r| line(*r)).reduce(|a, b| a.times(&b)).unwrap();
        let found = product.roots();
        assert_eq!(found.len(), 5, "{found:?}");
        assert!(found.iter().zip(roots).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
    }

    #[test]
    fn double_roots_are_one_or_none() {
        let found = line(0.3).times(&line(0.3)).roots();
        assert!(found.iter().all(|t| (t - 0.3).abs() < 1e-6), "{found:?}");
        assert!(line(1.5).times(&line(-0.5)).roots().is_empty());
    }

    #[test]
    fn what_cancels_is_nothing() {
        let a = line(0.3).times(&line(0.7));
        assert!(Polynomial::sum(&[a.clone(), a.scaled(-1.0)]).is_none());
    }
}
