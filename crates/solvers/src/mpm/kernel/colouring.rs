//! Blocks of particles in two colours, for P2G on several threads.
//!
//! The last axis divides the nodes into layers. The particles of a large body are divided into
//! consecutive blocks of alternating colour, even and odd, because neighbours in memory mostly have
//! nodes in neighbouring layers. Blocks of one colour have no common node and run in parallel. An
//! odd block then adds to the sums of its even neighbours.
//!
//! The division, and therefore the rounding of the results, does not depend on the number of
//! threads. A small body, or a body whose particles are not in spatial order, is one block.

use super::contract::LoopSettings;
use crate::mpm::basis::{Basis, Domain};
use crate::mpm::foundation::algebra::Matrix;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::packed_grid::{MARGIN, layers};
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::BATCH;
use crate::mpm::foundation::threads::RowChunks;
use std::ops::Range;

/// Number of chunks in the smallest block. A chunk is a group of consecutive particles.
const CHUNKS: usize = 8;

/// Number of minima and maxima that one loop over positions computes in parallel.
const TOGETHER: usize = 8;

/// Numbers of blocks to try, largest first. The nodes of one block should fit the cache.
const COUNTS: [usize; 8] = [512, 256, 128, 64, 32, 16, 8, 4];

/// A block of consecutive particles, with the layers that contain their nodes.
#[derive(Debug)]
pub(in crate::mpm) struct ParticleBlock {
    pub(in crate::mpm) particles: Range<usize>,
    /// Layers of nodes across the last axis.
    pub(in crate::mpm) layers: Range<usize>,
}

/// Extent of particles along the last axis (m).
#[derive(Debug, Clone, Copy)]
struct Span {
    low: f64,
    high: f64,
}

/// Blocks of a body, separated by colour; a single block is even.
#[derive(Debug)]
pub(in crate::mpm) struct Blocks {
    settings: LoopSettings,
    spans: Vec<Span>,
    pub(in crate::mpm) colours: [Vec<ParticleBlock>; 2],
}

impl Span {
    const NONE: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };
    const ALL: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };

    #[inline(always)]
    fn include(&mut self, x: f64) {
        self.low = if x < self.low { x } else { self.low };
        self.high = if x > self.high { x } else { self.high };
    }

    fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Returns the extent of these particles. A particle with a NaN position has no nodes.
    fn from_particles<B: Basis, const D: usize>(
        particles: &Particles<D>,
        these: Range<usize>,
    ) -> Self {
        let (mut span, x) = (Self::NONE, &particles.x[these.clone()]);
        if B::DOMAIN == Domain::Point {
            // Several minima are computed in parallel, because each comparison of a single minimum
            // would wait for the previous one.
            let (many, rest) = x.as_chunks::<TOGETHER>();
            let mut spans = [span; TOGETHER];
            for several in many {
                for (span, x) in spans.iter_mut().zip(several) {
                    span.include(x[D - 1]);
                }
            }
            for x in rest {
                span.include(x[D - 1]);
            }
            return spans.into_iter().fold(span, Self::union);
        }
        for (p, x) in these.zip(x) {
            let of_domain = |r: &Matrix<D>| r.row(D - 1).iter().map(|r| r.abs()).sum();
            let reach: f64 =
                particles.domain.get(p).map_or(0.5 * particles.spacing[D - 1].abs(), of_domain);
            if !reach.is_finite() {
                return Self::ALL;
            }
            span = span.union(Self { low: x[D - 1] - reach, high: x[D - 1] + reach });
        }
        span
    }

    /// Returns the layers of the packed field that may contain nodes of particles in this extent.
    fn layers<B: Basis, const D: usize>(self, grid: &Grid<D>) -> Range<usize> {
        let axis = D - 1;
        let (cells, all) = (grid.cells[axis] as f64, layers(grid).end);
        let local = |x: f64| (x - grid.origin[axis]) * grid.inverse_h();
        let (low, high) = (local(self.low), local(self.high));
        // A domain uses all nodes of the cells that it overlaps, and the ends of the domain are
        // known only up to rounding.
        let (below, above) = match B::DOMAIN {
            Domain::Point => (0.0, f64::from(B::DEGREE)),
            Domain::Fixed | Domain::Follows => (1.0, MARGIN as f64 + 1.0),
        };
        let wraps = low - below < 0.0 || high + (above - f64::from(B::DEGREE)) >= cells;
        // A block at one end of a periodic axis also has nodes at the opposite end, so all layers
        // are returned.
        if !(low <= high) || grid.periodic[axis] && wraps {
            return 0..all;
        }
        // The number of nodes per cell depends on the basis.
        let per_cell = (B::count(2, true) - B::count(1, true)) as f64;
        let node = |x: f64| libm::floor(x.clamp(0.0, cells - 1.0)) * per_cell;
        let (first, last) = (node(low) - below, node(high) + above);
        first.max(0.0) as usize..all.min(last as usize + 1)
    }
}

impl Blocks {
    pub(in crate::mpm) fn new(settings: LoopSettings) -> Self {
        Self { settings, spans: Vec::new(), colours: Default::default() }
    }

    /// Returns the number of particles in a chunk, a multiple of the batch size.
    fn chunk(&self) -> usize {
        (self.settings.min_block / CHUNKS).next_multiple_of(BATCH)
    }

    /// Divides the particles into blocks, if there are enough particles and they are in spatial
    /// order.
    pub(in crate::mpm) fn cut<B: Basis, const D: usize>(
        &mut self,
        grid: &Grid<D>,
        particles: &Particles<D>,
    ) {
        let LoopSettings { min_particles, min_block, .. } = self.settings;
        let (total, chunk) = (particles.len(), self.chunk());
        let enough = |count: &usize| total >= min_particles && count * min_block <= total;
        if COUNTS.iter().any(enough) {
            self.spans.resize(total.div_ceil(chunk), Span::NONE);
            RowChunks { length: 1, few: CHUNKS }.each(&mut self.spans, &|k, span| {
                span[0] =
                    Span::from_particles::<B, D>(particles, k * chunk..total.min((k + 1) * chunk));
            });
        }
        let mut counts = COUNTS.into_iter().filter(enough);
        if !counts.any(|count| self.cut_into::<B, D>(count, grid, total)) {
            self.colours.iter_mut().for_each(Vec::clear);
            self.colours[0].push(ParticleBlock { particles: 0..total, layers: layers(grid) });
        }
    }

    /// Divides the particles into `count` blocks. Returns whether the blocks are in spatial order
    /// and blocks of one colour have no common node.
    fn cut_into<B: Basis, const D: usize>(
        &mut self,
        count: usize,
        grid: &Grid<D>,
        particles: usize,
    ) -> bool {
        let (chunks, chunk) = (self.spans.len(), self.chunk());
        let mut start = 0;
        self.colours.iter_mut().for_each(Vec::clear);
        (0..count).all(|k| {
            let (from, to) = (k * chunks / count, (k + 1) * chunks / count);
            let span = self.spans[from..to].iter().fold(Span::NONE, |all, span| all.union(*span));
            let layers = span.layers::<B, D>(grid);
            let colour = &mut self.colours[k % 2];
            let is_apart = colour.last().is_none_or(|before| before.layers.end <= layers.start);
            let is_in_order = start <= layers.start;
            start = layers.start;
            colour
                .push(ParticleBlock { particles: from * chunk..particles.min(to * chunk), layers });
            is_apart && is_in_order
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::basis::laws::exercise::QuadraticBernstein;
    use crate::mpm::basis::{BasisName, with_basis};
    use crate::mpm::foundation::algebra::Vector;
    use crate::mpm::foundation::particles::Block;
    use rstest::rstest;

    /// Creates a body in a grid that is long along its last axis, with slightly displaced
    /// particles.
    fn scene<B: Basis, const D: usize>(periodic: bool) -> (Grid<D>, Particles<D>) {
        let h = 0.25;
        let cells = std::array::from_fn(|axis| match (axis + 1 == D, D) {
            (true, 1) => 600,
            (true, _) => 60,
            (false, 2) => 9,
            (false, _) => 3,
        });
        let counts = cells.map(|cells| B::count(cells, periodic));
        let grid = Grid::new(Vector::zeros(), h, cells, [periodic; D], counts);
        let to = Vector::from_fn(|axis, _| h * cells[axis] as f64);
        let block = Block { from: Vector::zeros(), to, density: 2.0 };
        let mut particles = Particles::fill(&block, h, 2);
        particles.track_domains();
        for p in 0..particles.len() {
            particles.x[p] +=
                Vector::from_fn(|i, _| 0.2 * h * libm::sin((7 * p + 3 * i + 1) as f64));
            particles.domain[p] *= 1.1;
        }
        (grid, particles)
    }

    fn is_cut<B: Basis, const D: usize>(periodic: bool) {
        let settings = LoopSettings { min_particles: 0, min_block: 128, ..LoopSettings::default() };
        let (mut blocks, (grid, particles)) = (Blocks::new(settings), scene::<B, D>(periodic));
        blocks.cut::<B, D>(&grid, &particles);
        let has_seam = periodic && B::DOMAIN != Domain::Point;
        assert_eq!(
            blocks.colours[1].len() >= 2,
            !has_seam,
            "domains beyond a periodic end have nodes at both ends of the field"
        );
        let of_layer: usize = grid.counts[..D - 1].iter().product();
        for block in blocks.colours.iter().flatten().filter(|_| !periodic) {
            for p in block.particles.clone() {
                B::visit(&grid, &particles, p, |at| {
                    assert!(block.layers.contains(&(at.node / of_layer)), "{at:?} in {block:?}");
                });
            }
        }
    }

    fn is_cut_in_every_dimension<B: Basis>(periodic: bool) {
        is_cut::<B, 1>(periodic);
        is_cut::<B, 2>(periodic);
        is_cut::<B, 3>(periodic);
    }

    #[rstest]
    fn long_body_is_divided_into_blocks(#[values(false, true)] periodic: bool) {
        for &name in BasisName::ALL {
            with_basis!(name, B => is_cut_in_every_dimension::<B>(periodic));
        }
        // The Bernstein basis has two functions per cell.
        is_cut_in_every_dimension::<QuadraticBernstein>(periodic);
    }
}
