//! Parts of a body that become particles, and merging of small parts. A lattice cell is the box of
//! one particle of a regular lattice.

use super::ROUNDING;
use std::collections::BTreeMap;

/// Minimum size of a piece, as a share of a lattice cell. A smaller piece would limit the time step
/// if it were the only particle in the support of a node.
const LEAST: f64 = 0.25;

/// The part of a lattice cell that belongs to the body.
#[derive(Debug, Clone, PartialEq)]
pub enum Cut {
    /// No part of the cell belongs to the body.
    Nothing,
    /// The whole cell counts as part of the body.
    Whole,
    /// The pieces of the cell that belong to the body.
    Pieces(Vec<Piece>),
}

/// Part of a plane body that becomes one particle.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// Volume (m2).
    pub volume: f64,
    /// Centroid (m).
    pub place: [f64; 2],
    /// Mean products of the coordinates relative to the centroid: xx, xy, yy (m2).
    pub(super) spread: [f64; 3],
    /// Lengths (m) of the boundaries shared with the left, right, lower and upper neighbour cells.
    pub(super) joints: [f64; 4],
}

impl Piece {
    pub(super) fn whole(place: [f64; 2], half: [f64; 2]) -> Self {
        let [width, height] = half.map(|half| 2.0 * half);
        let spread = [width * width / 12.0, 0.0, height * height / 12.0];
        Self { volume: width * height, place, spread, joints: [height, height, width, width] }
    }

    /// Returns the domain of the particle: the half-lengths (m), row by row, of a parallelogram
    /// with the volume of the piece, and with mean products of coordinates proportional to those of
    /// the piece. Its columns are those of the symmetric root `(Q + s I)/t`, where Q is three times
    /// the matrix of mean products, `s = sqrt(det Q)` and `t = sqrt(tr Q + 2 s)` (Higham 2008,
    /// *Functions of Matrices*, problem 6.2).
    pub fn domain(&self) -> [f64; 4] {
        let [xx, xy, yy] = self.spread.map(|product| 3.0 * product);
        let root = (xx * yy - xy * xy).sqrt();
        // The area of a piece that degenerates to a line is a rounding error.
        if !(root > ROUNDING * (xx + yy)) {
            let half = 0.5 * self.volume.sqrt();
            return [half, 0.0, 0.0, half];
        }
        let scale = (0.25 * self.volume / root).sqrt() / (xx + yy + 2.0 * root).sqrt();
        [xx + root, xy, xy, yy + root].map(|entry| scale * entry)
    }

    fn with(&self, other: &Self) -> Self {
        let volume = self.volume + other.volume;
        let shares = [self.volume / volume, other.volume / volume];
        let place = [0, 1].map(|i| shares[0] * self.place[i] + shares[1] * other.place[i]);
        let mut spread = [0.0; 3];
        for (piece, share) in [self, other].into_iter().zip(shares) {
            let [x, y] = [0, 1].map(|i| piece.place[i] - place[i]);
            for (into, (own, shift)) in
                spread.iter_mut().zip(piece.spread.iter().zip([x * x, x * y, y * y]))
            {
                *into += share * (own + shift);
            }
        }
        Self { volume, place, spread, joints: other.joints }
    }
}

/// Merges pieces smaller than a quarter of a lattice cell with the neighbour that shares the
/// longest boundary, if the centroid stays in the body (`holds`), the smallest piece first. Volumes
/// and first moments do not change. `cuts` contains all cells, row by row with `along` per row;
/// the cells have half-lengths `half` (m) around their `centres` (m).
pub fn join_small(
    cuts: &mut [Cut],
    along: usize,
    half: [f64; 2],
    centres: &dyn Fn(usize) -> [f64; 2],
    holds: &dyn Fn(&[f64]) -> bool,
) {
    let least = LEAST * 4.0 * half[0] * half[1];
    let only = |cut: &Cut| match cut {
        Cut::Pieces(pieces) if pieces.len() == 1 => pieces.first().cloned(),
        _ => None,
    };
    let mut small: Vec<(usize, f64)> = cuts
        .iter()
        .enumerate()
        .filter_map(|(p, cut)| Some((p, only(cut)?.volume)))
        .filter(|(_, volume)| *volume < least)
        .collect();
    small.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut taken_by = BTreeMap::new();
    for (p, _) in small {
        let Some(piece) = only(&cuts[p]).filter(|piece| piece.volume < least) else { continue };
        let beside = [(p % along > 0).then(|| p - 1), (p % along + 1 < along).then_some(p + 1)];
        let beside = [beside[0], beside[1], p.checked_sub(along), Some(p + along)];
        let mut links: Vec<(f64, usize)> = piece
            .joints
            .into_iter()
            .zip(beside)
            .filter_map(|(length, q)| Some((length, q.filter(|q| *q < cuts.len())?)))
            .filter(|(length, _)| *length > ROUNDING * (half[0] + half[1]))
            .collect();
        links.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (_, mut q) in links {
            while let Some(next) = taken_by.get(&q) {
                q = *next;
            }
            let other = match &cuts[q] {
                Cut::Whole => Some(Piece::whole(centres(q), half)),
                cut => only(cut),
            };
            let Some(joined) = other.filter(|_| q != p).map(|other| piece.with(&other)) else {
                continue;
            };
            if holds(&joined.place) {
                (cuts[p], cuts[q]) = (Cut::Nothing, Cut::Pieces(vec![joined]));
                taken_by.insert(p, q);
                break;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_make_a_whole() {
        let half = |x: f64| Piece::whole([x, 0.5], [1.0, 0.5]);
        let (joined, whole) = (half(1.0).with(&half(3.0)), Piece::whole([2.0, 0.5], [2.0, 0.5]));
        assert_eq!((joined.volume, joined.place), (4.0, [2.0, 0.5]));
        assert_eq!(
            (whole.volume, whole.place, whole.joints),
            (4.0, [2.0, 0.5], [1.0, 1.0, 4.0, 4.0])
        );
        for (a, b) in joined.spread.iter().zip(whole.spread) {
            assert!((a - b).abs() < 1e-15, "{joined:?}");
        }
        for (a, b) in joined.domain().iter().zip([2.0, 0.0, 0.0, 0.5]) {
            assert!((a - b).abs() < 1e-15, "{:?}", joined.domain());
        }
    }
}
