//! Free space in the frame: how far every place is from the data.
//!
//! The data are rasterised into small cells, from which distances spread in two sweeps (a chamfer
//! distance transform). A query then costs one look-up, so that a legend or a slope triangle can
//! be tried at thousands of places.

use super::svg::Pt;

/// An axis-parallel box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rect {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) w: f64,
    pub(crate) h: f64,
}

impl Rect {
    /// The right-hand side.
    pub(crate) fn right(&self) -> f64 {
        self.x + self.w
    }

    /// The lower side.
    pub(crate) fn bottom(&self) -> f64 {
        self.y + self.h
    }

    /// The box with every side moved outwards by `margin`.
    pub(crate) fn grown(&self, margin: f64) -> Self {
        Self {
            x: self.x - margin,
            y: self.y - margin,
            w: self.w + 2.0 * margin,
            h: self.h + 2.0 * margin,
        }
    }

    /// Whether `other` lies wholly inside.
    pub(crate) fn contains(&self, other: &Self) -> bool {
        other.x >= self.x
            && other.y >= self.y
            && other.right() <= self.right()
            && other.bottom() <= self.bottom()
    }

    /// Whether the two boxes share any area.
    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        self.x < other.right()
            && other.x < self.right()
            && self.y < other.bottom()
            && other.y < self.bottom()
    }
}

/// Side of a raster cell in pixels.
const CELL: f64 = 3.0;

/// Distances from the data within a frame.
#[derive(Debug)]
pub(crate) struct Space {
    frame: Rect,
    columns: usize,
    rows: usize,
    distance: Vec<f64>,
}

impl Space {
    /// The space in `frame` left free by lines through each of `paths`.
    pub(crate) fn new(frame: Rect, paths: &[Vec<Pt>]) -> Self {
        let columns = libm::ceil(frame.w / CELL) as usize + 1;
        let rows = libm::ceil(frame.h / CELL) as usize + 1;
        let mut space =
            Self { frame, columns, rows, distance: vec![f64::INFINITY; columns * rows] };
        for path in paths {
            if let [only] = path.as_slice() {
                space.occupy(*only);
            }
            for ends in path.windows(2) {
                space.occupy_line(ends[0], ends[1]);
            }
        }
        space.spread();
        space
    }

    /// Distance from `place` to the nearest data, in pixels.
    pub(crate) fn clearance(&self, place: Pt) -> f64 {
        self.distance[self.cell(place)]
    }

    /// Smallest distance from anywhere in `area` to the data.
    pub(crate) fn clearance_of(&self, area: &Rect) -> f64 {
        let steps = |length: f64| (length / CELL) as usize + 1;
        let (across, down) = (steps(area.w), steps(area.h));
        let mut least = f64::INFINITY;
        for i in 0..=across {
            for j in 0..=down {
                let x = area.x + area.w * i as f64 / across as f64;
                let y = area.y + area.h * j as f64 / down as f64;
                least = least.min(self.clearance((x, y)));
            }
        }
        least
    }

    fn cell(&self, (x, y): Pt) -> usize {
        // The cast truncates, and takes what lies before the frame to the first cell.
        let index = |offset: f64, count: usize| ((offset / CELL + 0.5) as usize).min(count - 1);
        index(y - self.frame.y, self.rows) * self.columns + index(x - self.frame.x, self.columns)
    }

    fn occupy(&mut self, place: Pt) {
        let cell = self.cell(place);
        self.distance[cell] = 0.0;
    }

    fn occupy_line(&mut self, from: Pt, to: Pt) {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let steps = libm::ceil(dx.abs().max(dy.abs()) / CELL).max(1.0);
        for i in 0..=steps as usize {
            let s = i as f64 / steps;
            self.occupy((from.0 + s * dx, from.1 + s * dy));
        }
    }

    fn spread(&mut self) {
        let cells = self.rows * self.columns;
        for cell in 0..cells {
            self.reach(cell, 1);
        }
        for cell in (0..cells).rev() {
            self.reach(cell, -1);
        }
    }

    /// Takes over the distance of the four neighbours which a sweep in `direction` has visited.
    fn reach(&mut self, cell: usize, direction: isize) {
        let (columns, rows) = (self.columns as isize, self.rows as isize);
        let (i, j) = (cell as isize % columns, cell as isize / columns);
        for (di, dj, pace) in [(-1, 0, 1.0), (-1, -1, 1.4), (0, -1, 1.0), (1, -1, 1.4)] {
            let (a, b) = (i + direction * di, j + direction * dj);
            if (0..columns).contains(&a) && (0..rows).contains(&b) {
                let via = self.distance[(b * columns + a) as usize] + pace * CELL;
                self.distance[cell] = self.distance[cell].min(via);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    const FRAME: Rect = Rect { x: 10.0, y: 20.0, w: 300.0, h: 200.0 };

    #[rstest]
    #[case((110.0, 120.0), 0.0)]
    #[case((110.0, 60.0), 60.0)]
    #[case((10.0, 120.0), 50.0)]
    #[case((260.0, 120.0), 50.0)]
    #[case((250.0, 160.0), 56.6)]
    fn distance_to_a_line(#[case] place: Pt, #[case] expected: f64) {
        let space = Space::new(FRAME, &[vec![(60.0, 120.0), (210.0, 120.0)]]);
        assert!((space.clearance(place) - expected).abs() < 2.0 * CELL);
    }

    #[test]
    fn an_area_is_as_clear_as_its_nearest_point() {
        let space = Space::new(FRAME, &[vec![(160.0, 120.0)]]);
        let around = Rect { x: 100.0, y: 100.0, w: 100.0, h: 50.0 };
        let beside = Rect { x: 180.0, y: 100.0, w: 50.0, h: 50.0 };
        assert!(space.clearance_of(&around) <= CELL);
        assert!((space.clearance_of(&beside) - 20.0).abs() < 2.0 * CELL);
    }

    #[test]
    fn an_empty_frame_is_free_everywhere() {
        assert!(Space::new(FRAME, &[]).clearance((50.0, 50.0)).is_infinite());
    }
}
