/// The shortest decimal that reads back to this double, as in WKT and CSV: `4`, `0.1`, `1e300`.
pub(crate) fn shortest(value: f64) -> String {
    let mut text = format!("{value:?}");
    if text.ends_with(".0") {
        text.truncate(text.len() - 2);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::shortest;

    #[test]
    fn doubles_read_back_exactly() {
        for value in [0.1, 4.0, -0.0, 1e300, 5e-324, 1830874.975, 1.0 / 3.0, f64::MAX] {
            assert_eq!(shortest(value).parse::<f64>().unwrap().to_bits(), value.to_bits());
        }
        assert_eq!(shortest(4.0), "4");
        assert_eq!(shortest(1e300), "1e300");
    }
}
