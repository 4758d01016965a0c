//! The dice that a random world is made with. What they give depends on seed and index alone, on every machine: no function
//! is called that platforms round in their own ways.

use crate::kernel::random::Random;
use glam::Vec2;

/// Random numbers that belong to a seed and the index of a world.
#[derive(Clone, Debug)]
pub(super) struct Dice(Random);

impl Dice {
    /// The dice of a world.
    pub fn new(seed: u64, index: u64) -> Self {
        // Neighbouring seeds and indices become unrelated numbers (the finaliser of SplitMix64, Steele et al. 2014).
        let scramble = |mut word: u64| {
            word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            word ^ (word >> 31)
        };
        let index = index.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        Self(Random::new(scramble(scramble(seed) ^ index)))
    }

    /// A whole number from 0 to below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        self.0.below(count)
    }

    /// Whether something that has `chances` of `of` comes.
    pub fn comes(&mut self, chances: usize, of: usize) -> bool {
        self.below(of) < chances
    }

    /// One of these.
    pub fn one<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }

    /// A number from `low` to `high`, with four digits that count.
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        short(low + (high - low) * f64::from(self.0.share()), low, high)
    }

    /// A whole number from `low` to `high`.
    pub fn whole(&mut self, low: u32, high: u32) -> u32 {
        low + self.below((high - low + 1) as usize) as u32
    }

    /// A number of a range: one end, the other, or anything between, of each order of magnitude as often where there are
    /// several.
    pub fn number(&mut self, low: f64, high: f64) -> f64 {
        match self.below(4) {
            0 => low,
            1 => high,
            _ if low > 0.0 && high / low > 100.0 => {
                let doublings = (1..).take_while(|&k| low * doubled(k) <= high).count();
                let from = low * doubled(self.below(doublings + 1));
                self.within(from, (2.0 * from).min(high))
            }
            _ => self.within(low, high),
        }
    }

    /// A whole number of a range, with its ends as often as [`Dice::number`] gives them.
    pub fn count(&mut self, low: u32, high: u32) -> u32 {
        match self.below(5) {
            0 => low,
            1 => high,
            _ => self.whole(low, high),
        }
    }

    /// Both coordinates from −`most` to `most`.
    pub fn vector(&mut self, most: f32) -> Vec2 {
        Vec2::new(self.0.offset(), self.0.offset()) * most
    }

    /// A number from 0 to 1.
    pub fn share(&mut self) -> f32 {
        self.0.share()
    }
}

/// 2 to the power of `k`.
fn doubled(k: usize) -> f64 {
    (0..k).fold(1.0, |power, _| 2.0 * power)
}

/// A number as a file has it: of four digits that count, if that is still in the range.
fn short(number: f64, low: f64, high: f64) -> f64 {
    let short = format!("{number:.3e}").parse().unwrap_or(number);
    if (low..=high).contains(&short) { short } else { number }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_world_has_dice_of_its_own() {
        let throws = |seed, index| {
            let mut dice = Dice::new(seed, index);
            (0..8).map(|_| dice.below(1000)).collect::<Vec<_>>()
        };
        assert_eq!(throws(1, 2), throws(1, 2));
        let all = [throws(1, 2), throws(1, 3), throws(2, 2), throws(2, 1), throws(0, 0)];
        for (k, one) in all.iter().enumerate() {
            let same = |other: &&Vec<usize>| one.iter().zip(*other).filter(|(a, b)| a == b).count() > 2;
            assert_eq!(all[..k].iter().filter(same).count(), 0, "{all:?}");
        }
    }

    #[test]
    fn numbers_come_from_the_whole_range_and_no_other() {
        let mut dice = Dice::new(5, 0);
        let numbers: Vec<f64> = (0..2000).map(|_| dice.number(0.001, 1000.0)).collect();
        assert!(numbers.iter().all(|number| (0.001..=1000.0).contains(number)));
        for end in [0.001, 1000.0] {
            assert!(numbers.iter().filter(|number| **number == end).count() > 300);
        }
        for low in [0.001, 0.01, 0.1, 1.0, 10.0, 100.0] {
            let between = numbers.iter().filter(|&&number| number > low && number < 10.0 * low).count();
            assert!((60..400).contains(&between), "{between} from {low} to ten times that");
        }
        let counts: Vec<u32> = (0..400).map(|_| dice.count(1, 64)).collect();
        assert!(counts.contains(&1) && counts.contains(&64) && counts.iter().all(|count| (1..=64).contains(count)));
    }
}
