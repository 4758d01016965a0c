//! What some pictures have and others lack. A branch on a number of the frame would not do: graphics in software take both of its
//! ways, and most frames have no use for one of them. So there are pipelines without.

use bevy::shader::ShaderDefVal;

/// A set of features; the shaders know them by their names in capitals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Features(u8);

impl Features {
    /// The air is shown.
    pub const AIR: Self = Self(1);
    /// Something glows, and lights what is near.
    pub const GLOW: Self = Self(2);
    /// Surfaces have their light and clouds their swirls looked up pixel by pixel.
    pub const RICH: Self = Self(4);
    /// There are liquids in the second field of bodies.
    pub const MORE: Self = Self(8);
    /// All of them.
    pub const ALL: Self = Self(15);

    const NAMES: [(Self, &str); 4] =
        [(Self::AIR, "AIR"), (Self::GLOW, "GLOW"), (Self::RICH, "RICH"), (Self::MORE, "MORE")];

    /// Those of `features` that hold.
    pub fn of(features: [(Self, bool); 4]) -> Self {
        Self(features.into_iter().filter(|(_, holds)| *holds).fold(0, |set, (feature, _)| set | feature.0))
    }

    /// Those of one set or of another.
    pub const fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Those that are in both.
    pub fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// How many there are.
    pub fn count(self) -> u32 {
        self.0.count_ones()
    }

    /// What the shaders are told.
    pub fn definitions(self) -> Vec<ShaderDefVal> {
        Self::NAMES
            .into_iter()
            .filter(|(feature, _)| self.and(*feature) == *feature)
            .map(|(_, name)| name.into())
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shaders_are_told_what_a_picture_has_and_nothing_else() {
        let features = Features::of([
            (Features::AIR, false),
            (Features::GLOW, true),
            (Features::RICH, false),
            (Features::MORE, true),
        ]);
        assert_eq!(features, Features::GLOW.or(Features::MORE));
        assert_eq!(features.definitions(), ["GLOW".into(), "MORE".into()]);
        assert_eq!(Features::default().definitions(), []);
        assert_eq!((features.count(), Features::ALL.count()), (2, Features::NAMES.len() as u32));
        assert_eq!(features.and(Features::AIR.or(Features::MORE)), Features::MORE);
    }

    #[test]
    fn the_shader_knows_each_feature() {
        for (_, name) in Features::NAMES {
            assert!(crate::game::render::SHADER.contains(&format!("#ifdef {name}\n")), "{name}");
        }
    }
}
