//! What a world sounds like, in two dozen numbers.

/// What is known of a control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Control {
    /// Its name.
    pub name: &'static str,
    /// Lowest value.
    pub min: f32,
    /// Highest value.
    pub max: f32,
}

macro_rules! controls {
    ($($(#[$doc:meta])* $name:ident: $min:literal ..= $max:literal, $silent:literal;)+) => {
        /// What a world sounds like. A level is the effective value of its sound as a share of full scale: 0.1 is −20 dB. A pan is
        /// where it comes from: −1 left, 0 the middle, 1 right. What is out of range, or no number, counts as the nearest that
        /// is in it, or as silence.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Controls {
            $($(#[$doc])* pub $name: f32,)+
        }

        impl Controls {
            /// All of them, in the order in which [`Controls::to_array`] has them.
            pub const ALL: [Control; [$(stringify!($name)),+].len()] =
                [$(Control { name: stringify!($name), min: $min, max: $max }),+];

            /// Of a world that makes no sound.
            pub const SILENT: Self = Self { $($name: $silent,)+ };

            /// Their values.
            pub fn to_array(&self) -> [f32; Self::ALL.len()] {
                [$(self.$name),+]
            }

            /// Controls of these values.
            pub fn from_array([$($name),+]: [f32; Self::ALL.len()]) -> Self {
                Self { $($name,)+ }
            }

            /// The same with each within its range.
            pub fn within(self) -> Self {
                let within = |value: f32, silent: f32, min: f32, max: f32| {
                    if value.is_nan() { silent } else { value.clamp(min, max) }
                };
                Self { $($name: within(self.$name, $silent, $min, $max),)+ }
            }
        }
    };
}

controls! {
    /// Bubbles that splashes leave behind, 1/s. 0 … 400.
    splash_rate: 0.0 ..= 400.0, 0.0;
    /// Radius of most of these bubbles, m; raising it makes them deeper (3 m/s over the radius, in Hz). 0.0004 … 0.02.
    splash_radius: 0.0004 ..= 0.02, 0.003;
    /// Level of splashes. 0 … 0.7.
    splash_level: 0.0 ..= 0.7, 0.0;
    /// Where splashes are. −1 … 1.
    splash_pan: -1.0 ..= 1.0, 0.0;
    /// Level of running water. 0 … 0.5.
    stream_level: 0.0 ..= 0.5, 0.0;
    /// Middle of its rush, Hz; raising it makes it thinner and faster. 150 … 3000.
    stream_pitch: 150.0 ..= 3000.0, 500.0;
    /// Where it runs. −1 … 1.
    stream_pan: -1.0 ..= 1.0, 0.0;
    /// Level of the wind. 0 … 0.5.
    wind_level: 0.0 ..= 0.5, 0.0;
    /// Pitch at which it howls, Hz. 60 … 2000.
    wind_pitch: 60.0 ..= 2000.0, 200.0;
    /// Where it blows. −1 … 1.
    wind_pan: -1.0 ..= 1.0, 0.0;
    /// Level of grains that slide. 0 … 0.4.
    hiss_level: 0.0 ..= 0.4, 0.0;
    /// Middle of their hiss, Hz; raising it makes them finer. 800 … 9000.
    hiss_pitch: 800.0 ..= 9000.0, 3000.0;
    /// Where they slide. −1 … 1.
    hiss_pan: -1.0 ..= 1.0, 0.0;
    /// Level of grains that strike: that of their knocks, with silence between. 0 … 0.5.
    clatter_level: 0.0 ..= 0.5, 0.0;
    /// Where they strike. −1 … 1.
    clatter_pan: -1.0 ..= 1.0, 0.0;
    /// Snaps of what burns, 1/s. 0 … 120.
    fire_crackle: 0.0 ..= 120.0, 0.0;
    /// Level of its roar, out of which the snaps stand. 0 … 0.4.
    fire_level: 0.0 ..= 0.4, 0.0;
    /// Where it burns. −1 … 1.
    fire_pan: -1.0 ..= 1.0, 0.0;
    /// Bubbles of what boils, 1/s. 0 … 300.
    boil_rate: 0.0 ..= 300.0, 0.0;
    /// Level of its bubbles and of the steam that hisses. 0 … 0.3.
    boil_level: 0.0 ..= 0.3, 0.0;
    /// Where it boils. −1 … 1.
    boil_pan: -1.0 ..= 1.0, 0.0;
    /// Level of the blast that arrives. 0 … 1.
    blast_level: 0.0 ..= 1.0, 0.0;
    /// Where it comes from. −1 … 1.
    blast_pan: -1.0 ..= 1.0, 0.0;
    /// By what all of it is multiplied: 0 is silence, 1 as it is. 0 … 2.
    gain: 0.0 ..= 2.0, 1.0;
}

impl Default for Controls {
    fn default() -> Self {
        Self::SILENT
    }
}

impl Controls {
    /// Whether nothing sounds: of a sound that has a level that is 0, or everything by the gain.
    pub fn is_silent(&self) -> bool {
        let levels = [
            self.splash_level,
            self.stream_level,
            self.wind_level,
            self.hiss_level,
            self.clatter_level,
            self.fire_level,
            self.boil_level,
            self.blast_level,
        ];
        self.gain <= 0.0 || levels.iter().all(|level| *level <= 0.0)
    }
}
