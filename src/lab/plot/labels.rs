//! Where words find room: each is tried around its anchor, nearest first, and stands where it covers the least.

/// A rectangle, pixels, y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Area {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Area {
    /// Width of what two rectangles have in common times its height.
    fn shared(&self, other: &Self) -> f64 {
        let width = self.right.min(other.right) - self.left.max(other.left);
        let height = self.bottom.min(other.bottom) - self.top.max(other.top);
        if width > 0.0 && height > 0.0 { width * height } else { 0.0 }
    }

    fn size(&self) -> f64 {
        (self.right - self.left) * (self.bottom - self.top)
    }

    /// Distance of a point to the rectangle.
    fn distance(&self, [x, y]: [f64; 2]) -> f64 {
        (x.clamp(self.left, self.right) - x).hypot(y.clamp(self.top, self.bottom) - y)
    }

    fn contains(&self, [x, y]: [f64; 2]) -> bool {
        self.left <= x && x <= self.right && self.top <= y && y <= self.bottom
    }
}

/// Directions in the order in which they are tried: right first, left last.
const DIRECTIONS: [[f64; 2]; 12] = [
    [1.0, 0.0],
    [0.9, -0.44],
    [0.9, 0.44],
    [0.7, -0.7],
    [0.7, 0.7],
    [0.0, -1.0],
    [0.0, 1.0],
    [-0.7, -0.7],
    [-0.7, 0.7],
    [-0.9, -0.44],
    [-0.9, 0.44],
    [-1.0, 0.0],
];
/// Distances of a label to its anchor in the order in which they are tried, pixels.
const DISTANCES: [f64; 6] = [8.0, 14.0, 22.0, 32.0, 44.0, 60.0];
/// Distance from which on a thread ties a label to its anchor, pixels.
const THREAD_FROM: f64 = 12.0;

/// What a pixel covered costs: of another label, of the room outside, of a line or marker.
const COST: [f64; 3] = [4.0, 8.0, 12.0];
/// What it costs that another anchor is nearer than the label's own.
const COST_OF_DOUBT: f64 = 120.0;
/// What being further away costs, a pixel.
const COST_OF_DISTANCE: f64 = 0.8;
/// What a less liked direction costs.
const COST_OF_DIRECTION: f64 = 1.5;

/// Where a label stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub area: Area,
    /// Whether it is far enough from its anchor to need a thread.
    pub thread: bool,
}

/// What takes up room already.
#[derive(Clone, Debug)]
pub(super) struct Room {
    /// Where labels may stand.
    pub bounds: Area,
    /// Points on lines and markers, each about a pixel wide.
    pub ink: Vec<[f64; 2]>,
    /// Points that have a label or will get one.
    pub anchors: Vec<[f64; 2]>,
    taken: Vec<Area>,
}

impl Room {
    /// Free room.
    pub fn new(bounds: Area) -> Self {
        Self { bounds, ink: Vec::new(), anchors: Vec::new(), taken: Vec::new() }
    }

    /// Finds a place for a label of this size by its anchor, and takes it.
    pub fn place(&mut self, anchor: [f64; 2], [width, height]: [f64; 2]) -> Place {
        let mut best = (f64::INFINITY, Place { area: around(anchor, [width, height], [1.0, 0.0], 0.0), thread: false });
        for distance in DISTANCES {
            for (rank, direction) in DIRECTIONS.into_iter().enumerate() {
                let area = around(anchor, [width, height], direction, distance);
                let cost = self.cost(&area)
                    + self.doubt(&area, anchor)
                    + COST_OF_DISTANCE * distance
                    + COST_OF_DIRECTION * rank as f64;
                if cost < best.0 {
                    best = (cost, Place { area, thread: distance > THREAD_FROM });
                }
            }
        }
        self.taken.push(best.1.area);
        best.1
    }

    fn cost(&self, area: &Area) -> f64 {
        let labels: f64 = self.taken.iter().map(|taken| area.shared(taken)).sum();
        let outside = area.size() - area.shared(&self.bounds);
        let ink = self.ink.iter().filter(|ink| area.contains(**ink)).count() as f64;
        COST[0] * labels + COST[1] * outside + COST[2] * ink
    }

    /// Cost of whatever else the label could be taken to belong to.
    fn doubt(&self, area: &Area, own: [f64; 2]) -> f64 {
        let distance = area.distance(own);
        let nearer = self.anchors.iter().filter(|anchor| **anchor != own && area.distance(**anchor) < distance);
        COST_OF_DOUBT * nearer.count() as f64
    }
}

/// The rectangle of a size that lies `distance` from a point in a direction.
fn around([x, y]: [f64; 2], [width, height]: [f64; 2], [along, down]: [f64; 2], distance: f64) -> Area {
    // Straight up it stands centred above the point, at half right its corner is at it.
    let side = |direction: f64| (direction * std::f64::consts::SQRT_2).clamp(-1.0, 1.0);
    let centre = [x + along * distance + side(along) * width / 2.0, y + down * distance + side(down) * height / 2.0];
    Area {
        left: centre[0] - width / 2.0,
        top: centre[1] - height / 2.0,
        right: centre[0] + width / 2.0,
        bottom: centre[1] + height / 2.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Area = Area { left: 0.0, top: 0.0, right: 300.0, bottom: 200.0 };

    #[test]
    fn labels_of_one_place_do_not_cover_each_other_and_stay_in_bounds() {
        let mut room = Room::new(BOUNDS);
        let places: Vec<Place> = (0..8).map(|_| room.place([150.0, 100.0], [50.0, 14.0])).collect();
        for (k, place) in places.iter().enumerate() {
            assert_eq!(place.area.shared(&BOUNDS), place.area.size(), "{place:?} is out of bounds");
            assert!(places[..k].iter().all(|other| other.area.shared(&place.area) == 0.0), "{places:?}");
        }
        assert!(!places[0].thread && places[0].area.left > 150.0, "the first has its favourite place");
    }

    #[test]
    fn labels_avoid_lines_and_edges() {
        let mut room = Room::new(BOUNDS);
        room.ink = (0..=100).map(|k| [f64::from(k) * 3.0, 100.0]).collect();
        let place = room.place([295.0, 100.0], [60.0, 14.0]);
        assert!(place.area.bottom < 100.0 || place.area.top > 100.0, "{place:?} covers the line");
        assert!(place.area.right <= 300.0, "{place:?} is out of bounds");
    }
}
