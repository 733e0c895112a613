//! Letters of strokes, for pictures that must not depend on the fonts of a machine.

use super::canvas::{Anchor, number};
use medial::geom::Point;
use std::fmt::Write as _;

/// Between two letters, and a space, in steps of the grid.
const GAP: f64 = 1.5;
const SPACE: f64 = 2.0;
/// A step of the grid to the right and upwards, as shares of the size of the text.
const STEP: (f64, f64) = (0.1, 0.7 / 6.0);

/// Lines of a letter, separated by spaces; each point a digit for x (0 to 4) and one for y, where
/// the base line is 2, small letters reach up to 6 and capitals to 8.
const LETTERS: &[(char, &str)] = &[
    ('0', "321203071838474332"),
    ('1', "172822 1232"),
    ('2', "07183847460242"),
    ('3', "07183847463525 354443321203"),
    ('4', "380444 3832"),
    ('5', "480805354443321203"),
    ('6', "473818070312324344351504"),
    ('7', "084812"),
    ('8', "15060718384746351504031232434435"),
    ('9', "0312324347381807061535 3546"),
    ('A', "022842 1434"),
    ('B', "02083847463505 3544433202"),
    ('C', "4738180703123243"),
    ('D', "02082846442202"),
    ('E', "48080242 0535"),
    ('F', "480802 0535"),
    ('G', "47381807031232434525"),
    ('H', "0802 4842 0545"),
    ('I', "2822 1838 1232"),
    ('J', "4843321203"),
    ('K', "0802 4804 1542"),
    ('L', "080242"),
    ('M', "0208254842"),
    ('N', "02084248"),
    ('O', "321203071838474332"),
    ('P', "02083847463505"),
    ('Q', "321203071838474332 2442"),
    ('R', "02083847463505 2542"),
    ('S', "473818070615354443321203"),
    ('T', "0848 2822"),
    ('U', "080312324348"),
    ('V', "082248"),
    ('W', "0812263248"),
    ('X', "0842 4802"),
    ('Y', "082548 2522"),
    ('Z', "08480242"),
    ('a', "0516364542 441403123243"),
    ('b', "0802 0516364543321203"),
    ('c', "4536160503123243"),
    ('d', "4842 4536160503123243"),
    ('e', "04444536160503123243"),
    ('f', "38281712 0636"),
    ('g', "46413010 4536160503123243"),
    ('h', "0802 0516364542"),
    ('i', "2622 2828"),
    ('j', "262110 2828"),
    ('k', "0802 4604 2542"),
    ('l', "2822"),
    ('m', "0206 05162522 25364542"),
    ('n', "0206 0516364542"),
    ('o', "163645433212030516"),
    ('p', "0600 0516364543321203"),
    ('q', "4640 4536160503123243"),
    ('r', "0206 051636"),
    ('s', "45361605143443321203"),
    ('t', "18132232 0636"),
    ('u', "0603123243 4642"),
    ('v', "062246"),
    ('w', "0612253246"),
    ('x', "0642 4602"),
    ('y', "0622 462210"),
    ('z', "06460242"),
    ('.', "2222"),
    (',', "2211"),
    ('-', "1434"),
    ('–', "0444"),
    ('—', "0444"),
    ('+', "0545 2723"),
    (':', "2525 2222"),
    (';', "2525 2211"),
    ('·', "2424"),
    ('/', "0248"),
    ('(', "38262432"),
    (')', "18262412"),
    ('[', "38181232"),
    (']', "18383212"),
    ('<', "470543"),
    ('>', "074503"),
    ('_', "0141"),
    ('=', "0646 0444"),
    ('%', "0248 0707 4343"),
    ('#', "1812 3832 0646 0444"),
    ('&', "4216172837360403122244"),
    ('*', "2723 0644 0446"),
    ('\'', "2826"),
    ('"', "1816 3836"),
    ('?', "071838474624 2222"),
    ('!', "2824 2222"),
    ('|', "2820"),
    ('~', "05163546"),
];

/// A box, for every letter without strokes.
const UNKNOWN: &str = "0208484202";

/// Path data of a line of text.
pub(super) fn strokes(text: &str, at: Point, size: f64, anchor: Anchor) -> String {
    let mut x = match anchor {
        Anchor::Start => at.x,
        Anchor::Middle => at.x - 0.5 * width(text, size),
        Anchor::End => at.x - width(text, size),
    };
    let mut data = String::new();
    for letter in text.chars() {
        let (low, advance) = extent(letter);
        if letter != ' ' {
            for line in lines(letter).split(' ') {
                stroke(&mut data, line, Point::new(x - STEP.0 * low * size, at.y), size);
            }
        }
        x += STEP.0 * (advance + GAP) * size;
    }
    data
}

/// The width of a line of text.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let advances: f64 = text.chars().map(|letter| extent(letter).1 + GAP).sum();
    STEP.0 * (advances - GAP).max(0.0) * size
}

fn lines(letter: char) -> &'static str {
    LETTERS.iter().find(|(l, _)| *l == letter).map_or(UNKNOWN, |(_, lines)| lines)
}

/// The least x of a letter and its width, in steps of the grid.
fn extent(letter: char) -> (f64, f64) {
    if letter == ' ' {
        return (0.0, SPACE);
    }
    let xs = || lines(letter).split(' ').flat_map(|line| line.bytes().step_by(2));
    let (low, high) = (xs().min().unwrap_or(b'0'), xs().max().unwrap_or(b'4'));
    (f64::from(low - b'0'), f64::from(high - low))
}

fn stroke(data: &mut String, line: &str, at: Point, size: f64) {
    for (k, pair) in line.as_bytes().chunks_exact(2).enumerate() {
        let [gx, gy] = [pair[0], pair[1]].map(|digit| f64::from(digit) - f64::from(b'0'));
        // Dots are lines from a point to itself; a hair of length shows their round caps.
        let hair = 0.01 * k as f64;
        let x = at.x + STEP.0 * gx * size + hair;
        let y = at.y - (gy - 2.0) * STEP.1 * size;
        let verb = if k == 0 { 'M' } else { 'L' };
        let _ = write!(data, "{verb}{} {}", number(x), number(y));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_letter_is_made_of_points_on_the_grid() {
        for (letter, lines) in LETTERS {
            for line in lines.split(' ') {
                assert!(line.len() >= 4 && line.len() % 2 == 0, "{letter}");
                for pair in line.as_bytes().chunks_exact(2) {
                    assert!((b'0'..=b'4').contains(&pair[0]), "{letter}");
                    assert!((b'0'..=b'8').contains(&pair[1]), "{letter}");
                }
            }
        }
    }

    #[test]
    fn a_line_of_text_is_anchored() {
        // `L` is 4 steps wide, 4 at size 10, and 7 high.
        let start = strokes("L", Point::new(0.0, 0.0), 10.0, Anchor::Start);
        assert_eq!(start, "M0 -7L0.01 0L4.02 0");
        assert_eq!(width("L", 10.0), 4.0);
        assert_eq!(strokes("L", Point::new(4.0, 0.0), 10.0, Anchor::End), start);
        assert_eq!(strokes("L", Point::new(2.0, 0.0), 10.0, Anchor::Middle), start);
    }
}
