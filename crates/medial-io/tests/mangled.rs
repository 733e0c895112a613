//! Drawings and fonts with wrong bytes: features or errors, never a panic.

use medial_io::{Format, ReadOptions, read_with};

/// Whole numbers that follow from a seed.
struct Draw(u64);

impl Draw {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % n.max(1)
    }
}

/// Bytes with a few changed, doubled, dropped, or put in the place of numbers.
fn mangled(draw: &mut Draw, bytes: &[u8]) -> Vec<u8> {
    const WORDS: [&[u8]; 8] =
        [b"1e300", b"-1", b"nan", b"0", b"99999999", b"-1e-300", b"\xff\xfe", b"\n"];
    let mut out = bytes.to_vec();
    for _ in 0..1 + draw.below(6) {
        let at = draw.below(out.len());
        match draw.below(5) {
            0 => out[at] = draw.below(256) as u8,
            1 => out.truncate(at.max(8)),
            2 => {
                let end = (at + draw.below(40)).min(out.len());
                let part = out[at..end].to_vec();
                let to = draw.below(out.len());
                out.splice(to..to, part);
            }
            3 => {
                let end = (at + draw.below(20)).min(out.len());
                out.drain(at..end);
            }
            _ => {
                // The number around this byte, if it is one.
                let is_digit = |b: &u8| b.is_ascii_digit() || matches!(b, b'.' | b'-');
                let end = at + out[at..].iter().take_while(|b| is_digit(b)).count();
                let word = WORDS[draw.below(WORDS.len())];
                out.splice(at..end, word.iter().copied());
            }
        }
        if out.len() < 8 {
            break;
        }
    }
    out
}

#[test]
fn wrong_bytes_give_features_or_errors() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/drawings/");
    let mut draw = Draw(11);
    for (format, name) in
        [(Format::Svg, "plate.svg"), (Format::Dxf, "slot.dxf"), (Format::Ttf, "two_letters.ttf")]
    {
        let bytes = std::fs::read(format!("{folder}{name}")).unwrap();
        let n = std::env::var("MEDIAL_MANGLED").ok().and_then(|n| n.parse().ok()).unwrap_or(400);
        for k in 0..n {
            let mangled = mangled(&mut draw, &bytes);
            let text = (k % 2 == 0).then(|| "LV".to_owned());
            let options = ReadOptions { text, ..ReadOptions::default() };
            let Ok(layer) = read_with(format, &mangled, &options) else { continue };
            for feature in layer.flatten() {
                let Some(curves) = &feature.curves else { continue };
                for (rings, edges) in feature.polygons.iter().zip(&curves.edges) {
                    assert!(rings.iter().map(Vec::len).eq(edges.iter().map(Vec::len)));
                }
                for end in curves.pieces.iter().flat_map(|piece| [piece.start, piece.end]) {
                    assert!(!end.curvature.is_nan(), "{format}: {end:?}");
                    assert!((end.tangent.norm() - 1.0).abs() < 1e-6, "{format}: {end:?}");
                }
            }
        }
    }
}
