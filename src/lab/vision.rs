//! How different colours look, to all kinds of colour vision: for tests of what is shown.

use crate::lab::colours::Rgb;
use bevy::math::ops;

/// What is seen of red, green and blue light.
type Matrix = [[f32; 3]; 3];

/// Full colour vision, and the three in which one kind of cone is missing (Machado, Oliveira & Fernandes 2009, "A physiologically-based
/// model for simulation of color vision deficiency", table 1, severity 1).
pub const KINDS: [(&str, Matrix); 4] = [
    ("all", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
    ("protan", [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]),
    ("deutan", [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]),
    ("tritan", [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]),
];

/// The light of a colour's channels, 0 … 1 each (IEC 61966-2-1: sRGB).
pub fn linear(colour: Rgb) -> [f32; 3] {
    colour.map(|channel| {
        let value = f32::from(channel) / 255.0;
        if value <= 0.04045 { value / 12.92 } else { ops::powf((value + 0.055) / 1.055, 2.4) }
    })
}

/// Lightness, green–red and blue–yellow of a colour (Ottosson 2020, "A perceptual color space for image processing": OKLab), as
/// somebody sees it. Two colours side by side are just told apart at a distance of some 0.02.
pub fn oklab(colour: Rgb, seen: &Matrix) -> [f32; 3] {
    let linear = linear(colour);
    let mixed = |matrix: &Matrix, of: [f32; 3]| matrix.map(|row| row[0] * of[0] + row[1] * of[1] + row[2] * of[2]);
    let light = mixed(seen, linear).map(|value| value.clamp(0.0, 1.0));
    let cones = mixed(
        &[
            [0.412_221_46, 0.536_332_55, 0.051_445_995],
            [0.211_903_5, 0.680_699_5, 0.107_396_96],
            [0.088_302_46, 0.281_718_85, 0.629_978_7],
        ],
        light,
    );
    mixed(
        &[
            [0.210_454_26, 0.793_617_8, -0.004_072_047],
            [1.977_998_5, -2.428_592_2, 0.450_593_7],
            [0.025_904_037, 0.782_771_77, -0.808_675_77],
        ],
        cones.map(ops::cbrt),
    )
}

/// How far two colours are apart.
pub fn distance(a: Rgb, b: Rgb, seen: &Matrix) -> f32 {
    let (a, b) = (oklab(a, seen), oklab(b, seen));
    (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f32>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::elements;

    #[test]
    fn white_is_light_black_is_dark_and_grey_has_no_hue() {
        for (name, seen) in &KINDS[..1] {
            assert!((oklab([255; 3], seen)[0] - 1.0).abs() < 1e-3 && oklab([0; 3], seen)[0] < 1e-3, "{name}");
            let [_, a, b] = oklab([120; 3], seen);
            assert!(a.abs() < 1e-3 && b.abs() < 1e-3, "{name}: {a} {b}");
        }
    }

    /// Elements of different categories are told apart by how they are drawn: surfaces, grains, clouds, stone. Within a category
    /// three times the distance at which colours are just told apart is asked for with full colour vision, and twice with each
    /// other kind.
    #[test]
    fn elements_that_are_drawn_alike_have_colours_that_everybody_tells_apart() {
        let table = elements().expect("the elements");
        let mut alike = Vec::new();
        for (id, a) in table.iter() {
            for (_, b) in table.iter().skip(id.index() + 1).filter(|(_, b)| b.category == a.category) {
                for (k, (kind, seen)) in KINDS.iter().enumerate() {
                    let (found, wanted) = (distance(a.colour, b.colour, seen), if k == 0 { 0.06 } else { 0.04 });
                    if found < wanted {
                        alike.push(format!("{} and {}: {found:.3} ({kind})", a.name, b.name));
                    }
                }
            }
        }
        assert!(alike.is_empty(), "{alike:#?}");
    }
}
