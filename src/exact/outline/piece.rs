//! Parts of a body that become particles, and merging of small parts with their neighbours.

use super::ROUNDING;
use std::collections::BTreeMap;

/// Minimum size of a piece, as a share of a lattice cell: a smaller one is merged with a neighbour.
/// A sliver may be the only particle in the support of a node, and limit the time step like a cell
/// of its own width.
const LEAST: f64 = 0.25;

/// Part of a share of a lattice that belongs to a body.
#[derive(Debug, Clone, PartialEq)]
pub enum Cut {
    /// None of it.
    Nothing,
    /// All of it, by the rule of the outline.
    Whole,
    /// Pieces of it.
    Pieces(Vec<Piece>),
}

/// Part of a body in the plane that becomes one particle.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// Its volume (m2).
    pub volume: f64,
    /// Its centroid (m).
    pub place: [f64; 2],
    /// Mean products of coordinates about the centroid: xx, xy, yy (m2).
    pub(super) spread: [f64; 3],
    /// Lengths (m) of common lines with the lattice cells on the left, the right, below and above.
    pub(super) joints: [f64; 4],
}

impl Piece {
    /// A whole share.
    pub(super) fn whole(place: [f64; 2], half: [f64; 2]) -> Self {
        let [width, height] = half.map(|half| 2.0 * half);
        let spread = [width * width / 12.0, 0.0, height * height / 12.0];
        Self { volume: width * height, place, spread, joints: [height, height, width, width] }
    }

    /// Half-lengths (m) of a parallelogram of its volume, row after row, with the same mean
    /// products of coordinates in shape: the columns are those of the symmetric root of Q, three
    /// times the matrix of these products, `(Q + s I)/t` with `s = sqrt(det Q)` and
    /// `t = sqrt(tr Q + 2 s)` (Higham 2008, *Functions of Matrices*, problem 6.2). For a rectangle
    /// along the axes it is this rectangle.
    pub fn domain(&self) -> [f64; 4] {
        let [xx, xy, yy] = self.spread.map(|product| 3.0 * product);
        let root = (xx * yy - xy * xy).sqrt();
        // A line has no area but by rounding.
        if !(root > ROUNDING * (xx + yy)) {
            let half = 0.5 * self.volume.sqrt();
            return [half, 0.0, 0.0, half];
        }
        let scale = (0.25 * self.volume / root).sqrt() / (xx + yy + 2.0 * root).sqrt();
        [xx + root, xy, xy, yy + root].map(|entry| scale * entry)
    }

    /// Both together.
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

/// Merges pieces of less than a quarter of a lattice cell with the neighbours that they touch along
/// the longest lines, the smallest first, if the body contains the common centroid (`holds`).
/// `cuts` are those of all lattice cells, `along` of them in a row, of half-lengths `half` (m)
/// about their `centres` (m). Volumes and first moments do not change.
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

    /// Two halves of a rectangle are that rectangle: volume, centroid, moments and domain.
    #[test]
    fn halves_make_a_whole() {
        let half = |x: f64| Piece::whole([x, 0.5], [1.0, 0.5]);
        let (joined, whole) = (half(1.0).with(&half(3.0)), Piece::whole([2.0, 0.5], [2.0, 0.5]));
        assert_eq!((joined.volume, joined.place), (whole.volume, whole.place));
        for (a, b) in joined.spread.iter().zip(whole.spread) {
            assert!((a - b).abs() < 1e-15, "{joined:?}");
        }
        for (a, b) in joined.domain().iter().zip([2.0, 0.0, 0.0, 0.5]) {
            assert!((a - b).abs() < 1e-15, "{:?}", joined.domain());
        }
    }
}
