//! The Pareto front: the rows that no other beats.
//!
//! A row is beaten by one that takes no more time and has no more error, and less of at least one. Where a scene has air
//! but the error is the liquid's, the other one may not smear the air more either: the density error does not see what a
//! finer air grid or a better scheme buys.

use super::row::Row;
use crate::kernel::params::{AirAdvection, Quality};
use std::collections::BTreeMap;

/// What rows are compared by; less is better in each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Time.
    pub ms: f64,
    /// Error.
    pub error: f64,
    /// Coarseness of what the error does not see.
    pub coarseness: f32,
}

impl Point {
    fn is_no_worse(&self, other: &Self) -> bool {
        self.ms <= other.ms && self.error <= other.error && self.coarseness <= other.coarseness
    }
}

/// Which points no other beats, in their order. Equal points don't beat each other; a point that is not a number beats
/// none and is on no front.
pub fn front(points: &[Point]) -> Vec<bool> {
    let comparable = |point: &Point| point.ms.is_finite() && point.error.is_finite();
    let mut order: Vec<usize> = (0..points.len()).filter(|k| comparable(&points[*k])).collect();
    // A point that beats another stands before it in this order.
    order.sort_by(|a, b| {
        let (a, b) = (&points[*a], &points[*b]);
        a.ms.total_cmp(&b.ms).then(a.error.total_cmp(&b.error)).then(a.coarseness.total_cmp(&b.coarseness))
    });
    let mut on_front = vec![false; points.len()];
    let mut kept: Vec<Point> = Vec::new();
    for k in order {
        let point = points[k];
        // What beats it is on the front itself or beaten by one that is.
        if !kept.iter().any(|other| other.is_no_worse(&point) && *other != point) {
            on_front[k] = true;
            kept.push(point);
        }
    }
    on_front
}

/// What a row is compared by.
pub(super) fn point(row: &Row, air_is_unseen: bool) -> Point {
    let coarseness = if air_is_unseen { air_viscosity(&row.setting.quality) } else { 0.0 };
    Point { ms: row.ms, error: row.error, coarseness }
}

/// Viscosity by which the air's scheme smears an eddy, multiples of the eddy's speed, d: at most what the exam's vortex finds
/// (docs/exam.md).
fn air_viscosity(quality: &Quality) -> f32 {
    match quality.air_advection {
        AirAdvection::FirstOrder => 0.18 * quality.air_cell,
        AirAdvection::SecondOrder => 0.012 * quality.air_cell,
    }
}

/// Marks the rows on both fronts, those of each number of threads by themselves: threads change no error. Density
/// errors are shares of the run's own spacing, and compared at the same detail only.
pub(super) fn mark(rows: &mut [Row], air_is_unseen: bool) {
    let of_detail = |row: &Row| (row.setting.threads, row.setting.detail().to_bits());
    let by_density = on_front(rows, of_detail, |row| point(row, air_is_unseen));
    let truth = |row: &Row| Point { error: row.true_error().unwrap_or(f64::NAN), ..point(row, false) };
    let by_truth = on_front(rows, |row| row.setting.threads, truth);
    for ((row, by_density), by_truth) in rows.iter_mut().zip(by_density).zip(by_truth) {
        (row.front, row.true_front) = (by_density, by_truth);
    }
}

/// Which rows are on the front of those that they are compared with.
fn on_front<K: Ord>(rows: &[Row], group: impl Fn(&Row) -> K, point: impl Fn(&Row) -> Point) -> Vec<bool> {
    let mut groups: BTreeMap<K, Vec<usize>> = BTreeMap::new();
    for (k, row) in rows.iter().enumerate().filter(|(_, row)| row.is_valid()) {
        groups.entry(group(row)).or_default().push(k);
    }
    let mut marks = vec![false; rows.len()];
    for own in groups.values() {
        let points: Vec<Point> = own.iter().map(|k| point(&rows[*k])).collect();
        own.iter().zip(front(&points)).for_each(|(k, mark)| marks[*k] = mark);
    }
    marks
}

#[cfg(test)]
mod tests {
    use super::{super::row::tests::row, *};
    use crate::{kernel::random::Random, lab::coarse::Distance};

    /// The definition, pair by pair.
    fn brute_force(points: &[Point]) -> Vec<bool> {
        let beats = |a: &Point, b: &Point| {
            let no_worse = a.ms <= b.ms && a.error <= b.error && a.coarseness <= b.coarseness;
            no_worse && (a.ms < b.ms || a.error < b.error || a.coarseness < b.coarseness)
        };
        points.iter().map(|point| !points.iter().any(|other| beats(other, point))).collect()
    }

    #[test]
    fn the_front_is_what_the_definition_says() {
        let mut random = Random::new(1);
        let mut draw = |values: usize| random.below(values);
        // Few values, so that there are ties and equal points; many, so that there are long fronts.
        for values in [1, 2, 4, 1000] {
            for count in [0, 1, 2, 3, 10, 100] {
                for _ in 0..20 {
                    let points: Vec<Point> = (0..count)
                        .map(|_| Point {
                            ms: draw(values) as f64,
                            error: draw(values) as f64,
                            coarseness: draw(values.min(4)) as f32,
                        })
                        .collect();
                    assert_eq!(front(&points), brute_force(&points), "{points:?}");
                }
            }
        }
    }

    #[test]
    fn what_is_no_number_is_on_no_front() {
        let point = |ms, error| Point { ms, error, coarseness: 0.0 };
        assert_eq!(front(&[point(1.0, f64::NAN), point(2.0, 1.0), point(f64::NAN, 0.0)]), [false, true, false]);
    }

    #[test]
    fn invalid_rows_and_other_threads_beat_no_one() {
        let mut rows = [row("slow", 2.0, 0.2), row("broken", 0.5, 0.0), row("threads", 1.0, 0.2), row("bad", 3.0, 0.3)];
        rows[1].faults.push("exploded".to_owned());
        rows[2].setting.threads = 2;
        mark(&mut rows, false);
        assert_eq!(rows.map(|row| row.front), [true, false, true, false]);
    }

    #[test]
    fn density_is_compared_at_one_detail_and_truth_at_all() {
        let known = |name: &str, detail: f64, ms: f64, truth: f64| {
            let mut row = row(name, ms, 0.01);
            row.setting.asked_detail = detail;
            row.found.accuracy.distance = Some(Distance { share: Some(truth), ..Distance::default() });
            row
        };
        let mut rows = [known("coarse", 0.5, 0.2, 0.01), known("own", 1.0, 1.0, 0.002), known("slow", 1.0, 2.0, 0.003)];
        mark(&mut rows, false);
        assert_eq!(rows.each_ref().map(|row| row.front), [true, true, false]);
        assert_eq!(rows.each_ref().map(|row| row.true_front), [true, true, false]);
        rows[0].found.accuracy.distance = rows[1].found.accuracy.distance;
        mark(&mut rows, false);
        assert_eq!(rows.map(|row| row.true_front), [true, false, false]);
    }

    #[test]
    fn coarser_air_is_no_cheaper_way_to_the_same_liquid() {
        let mut rows = [row("fine air", 2.0, 0.2), row("coarse air", 1.0, 0.2)];
        rows[0].setting.quality.air_cell = 2.0;
        rows[1].setting.quality.air_cell = 8.0;
        mark(&mut rows, true);
        assert!(rows.iter().all(|row| row.front));
        mark(&mut rows, false);
        assert!(!rows[0].front, "without air the cells make no difference");
    }
}
