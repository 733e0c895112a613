//! Colours as L\*u\*v\* [CIE 1976], where equal distances look about equally far apart, and back.

/// Values of u' and v' of the white D65, after which sRGB is made.
const WHITE: [f32; 2] = [0.197_830, 0.468_320];

/// From linear red, green and blue to X, Y and Z [IEC 61966-2-1].
const TO_XYZ: [[f32; 3]; 3] = [
    [0.412_390_8, 0.357_584_34, 0.180_480_8],
    [0.212_639, 0.715_168_7, 0.072_192_32],
    [0.019_330_82, 0.119_194_78, 0.950_532_15],
];

/// The inverse.
const FROM_XYZ: [[f32; 3]; 3] = [
    [3.240_97, -1.537_383_2, -0.498_610_76],
    [-0.969_243_65, 1.875_967_5, 0.041_555_06],
    [0.055_630_08, -0.203_976_96, 1.056_971_5],
];

/// Below this share of the luminance of white, lightness is proportional to it.
const DARK: f32 = 216.0 / 24_389.0;
const SLOPE: f32 = 24_389.0 / 27.0;

/// A colour of sRGB, each value from 0 to 1, as L\*u\*v\*: lightness from 0 to 100, u\* and v\* from about -134 to
/// 220.
///
/// ```
/// let [l, u, v] = medial_image::luv([1.0, 0.0, 0.0]);
/// assert!((l - 53.24).abs() < 0.01 && (u - 175.01).abs() < 0.05 && (v - 37.76).abs() < 0.05);
/// assert_eq!(medial_image::luv([0.0; 3]), [0.0; 3]);
/// ```
#[must_use]
pub fn luv(srgb: [f32; 3]) -> [f32; 3] {
    of_linear(srgb.map(linear))
}

/// The same of linear values.
pub(crate) fn of_linear(rgb: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = TO_XYZ.map(|row| dot(row, rgb));
    let lightness = if y > DARK { 116.0 * y.cbrt() - 16.0 } else { SLOPE * y };
    let sum = x + 15.0 * y + 3.0 * z;
    if sum <= 0.0 {
        return [0.0; 3];
    }
    let [u, v] = [4.0 * x / sum - WHITE[0], 9.0 * y / sum - WHITE[1]];
    [lightness, 13.0 * lightness * u, 13.0 * lightness * v]
}

/// A colour of L\*u\*v\* as sRGB, each value from 0 to 1; what sRGB does not have is the nearest it has in each.
#[must_use]
pub fn srgb([l, u, v]: [f32; 3]) -> [f32; 3] {
    if l <= 0.0 {
        return [0.0; 3];
    }
    let y = if l > SLOPE * DARK { ((l + 16.0) / 116.0).powi(3) } else { l / SLOPE };
    let [u, v] = [u / (13.0 * l) + WHITE[0], v / (13.0 * l) + WHITE[1]];
    let x = y * 9.0 * u / (4.0 * v);
    let z = y * (12.0 - 3.0 * u - 20.0 * v) / (4.0 * v);
    FROM_XYZ.map(|row| compressed(dot(row, [x, y, z])).clamp(0.0, 1.0))
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Light of a value of sRGB.
pub(crate) fn linear(value: f32) -> f32 {
    if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

fn compressed(light: f32) -> f32 {
    if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_has_no_colour() {
        let [l, u, v] = luv([1.0; 3]);
        assert!((l - 100.0).abs() < 1e-3 && u.abs() < 2e-2 && v.abs() < 2e-2, "{l} {u} {v}");
    }

    #[test]
    fn colours_come_back() {
        for k in 0..729 {
            let colour = [k % 9, k / 9 % 9, k / 81].map(|step| step as f32 / 8.0);
            let back = srgb(luv(colour));
            for (a, b) in colour.into_iter().zip(back) {
                assert!((a - b).abs() < 2e-3, "{colour:?} {back:?}");
            }
        }
    }
}
