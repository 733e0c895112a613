/// Colours from small to large radius: the map `plasma` (CC0) without its palest end, which
/// would vanish on a light ground.
const ANCHORS: [[f64; 3]; 9] = [
    [13.0, 8.0, 135.0],
    [70.0, 3.0, 159.0],
    [114.0, 1.0, 168.0],
    [156.0, 23.0, 158.0],
    [189.0, 55.0, 134.0],
    [216.0, 87.0, 107.0],
    [237.0, 121.0, 83.0],
    [251.0, 159.0, 58.0],
    [253.0, 190.0, 42.0],
];

/// Number of colours the radius is shown with.
pub(super) const STEPS: usize = 40;

/// The colour of a step.
pub(super) fn color(step: usize) -> String {
    let at = (step.min(STEPS - 1) as f64 + 0.5) / STEPS as f64 * (ANCHORS.len() - 1) as f64;
    let k = (at as usize).min(ANCHORS.len() - 2);
    let share = at - k as f64;
    let [r, g, b] = [0, 1, 2].map(|c| {
        let value = ANCHORS[k][c] * (1.0 - share) + ANCHORS[k + 1][c] * share;
        value.round() as u8
    });
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A pale colour for cell number `k`, unlike those of its neighbours in number.
pub(super) fn pale(k: usize) -> String {
    // Steps of the golden section never come near one another.
    let hue = (k as f64 * 137.507_764) % 360.0;
    let [r, g, b] = [0.0, 120.0, 240.0].map(|shift| {
        let distance = ((hue - shift + 540.0) % 360.0 - 180.0).abs();
        let share = (2.0 - distance / 60.0).clamp(0.0, 1.0);
        (196.0 + 56.0 * share).round() as u8
    });
    format!("#{r:02x}{g:02x}{b:02x}")
}
