//! Points of a raster at which a motion is the same, since it does not vary along some axis.

use crate::exact::motion::Motion;

/// The places of a raster at which a motion differs.
pub(super) struct DistinctPlaces {
    /// The first point of the raster at each place.
    pub(super) first: Vec<usize>,
    /// The place of each point.
    pub(super) of_point: Vec<usize>,
}

impl DistinctPlaces {
    /// Those of a raster of `count` points, `per_axis` of them along each axis, the first axis
    /// running fastest.
    pub(super) fn of(motion: &Motion, count: usize, per_axis: usize) -> Self {
        let varying: Vec<bool> =
            (0..motion.dimension()).map(|axis| motion.varies_along(axis)).collect();
        let of_point: Vec<usize> =
            (0..count).map(|point| place(point, per_axis, &varying)).collect();
        let mut first = Vec::new();
        for (point, place) in of_point.iter().enumerate() {
            if *place == first.len() {
                first.push(point);
            }
        }
        Self { first, of_point }
    }
}

/// The place of a point: its number on a raster of the axes along which the motion varies.
fn place(mut point: usize, per_axis: usize, varying: &[bool]) -> usize {
    let (mut place, mut stride) = (0, 1);
    for varies in varying {
        if *varies {
            place += stride * (point % per_axis);
            stride *= per_axis;
        }
        point /= per_axis;
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_along_an_axis_of_no_change_are_one_place() {
        let of = |varying: &[bool; 3]| (0..27).map(|point| place(point, 3, varying)).collect();
        let all: Vec<usize> = of(&[true, true, true]);
        assert!(all.into_iter().eq(0..27));
        let middle: Vec<usize> = of(&[false, true, false]);
        assert_eq!(middle[..9], [0, 0, 0, 1, 1, 1, 2, 2, 2]);
        assert_eq!(middle[9..18], middle[..9]);
        let ends: Vec<usize> = of(&[true, false, true]);
        assert_eq!((ends[2], ends[5], ends[9], ends[26]), (2, 2, 3, 8));
    }
}
