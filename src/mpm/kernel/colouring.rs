//! Blocks of particles, so that threads can share the way from particles to nodes.
//!
//! Particles that lie next to each other in memory mostly see neighbouring layers of nodes: those across
//! the last axis. So the particles of a large scene are cut into blocks, and these have two colours in
//! turn. Blocks of one colour see no node in common: each has its own stretch of the field, and they
//! may run at once. A block of the other colour adds to what its two neighbours have left.
//!
//! Where blocks are cut depends on the particles alone, and never on the number of threads: the bits do not
//! either. Particles in no order at all, and small scenes, are one block.

use crate::mpm::{
    algebra::Matrix,
    basis::{Basis, Domain},
    grid::Grid,
    packed_grid::{MARGIN, layers},
    particles::Particles,
    simd::BATCH,
    threads::RowChunks,
};
use std::ops::Range;

/// Fewest particles of a scene that is cut: others stay near as they are.
const MIN_PARTICLES: usize = 1 << 17;

/// Fewest particles of a block: the nodes that its neighbours see as well must be few beside them.
const MIN_BLOCK: usize = 1 << 13;

/// Chunks of such a block: particles whose layers are looked up together.
pub(in crate::mpm) const CHUNKS: usize = 8;

/// Particles that are looked at together.
const TOGETHER: usize = 8;

/// Numbers of blocks that are tried, largest first: so many that the nodes of one stay in a cache.
const COUNTS: [usize; 8] = [512, 256, 128, 64, 32, 16, 8, 4];

/// Particles in a row, and the nodes that they see.
#[derive(Debug)]
pub(in crate::mpm) struct ParticleBlock {
    pub(in crate::mpm) particles: Range<usize>,
    /// Layers of nodes across the last axis.
    pub(in crate::mpm) layers: Range<usize>,
}

/// How far particles reach along the last axis (m).
#[derive(Debug, Clone, Copy)]
struct Span {
    low: f64,
    high: f64,
}

/// The blocks of a scene by colour. Where all particles are one block, there is one colour.
#[derive(Debug)]
pub(in crate::mpm) struct Blocks {
    /// Fewest particles of all blocks, and of one.
    pub(in crate::mpm) fewest: usize,
    pub(in crate::mpm) least: usize,
    spans: Vec<Span>,
    pub(in crate::mpm) colours: [Vec<ParticleBlock>; 2],
}

impl Default for Blocks {
    fn default() -> Self {
        Self {
            fewest: MIN_PARTICLES,
            least: MIN_BLOCK,
            spans: Vec::new(),
            colours: Default::default(),
        }
    }
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

    /// That of some particles. One whose position is not a number sees zero.
    fn of<B: Basis, const D: usize>(particles: &Particles<D>, these: Range<usize>) -> Self {
        let (mut span, x) = (Self::NONE, &particles.x[these.clone()]);
        if B::DOMAIN == Domain::Point {
            // Several at a time: one would wait for the one before.
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

    /// The layers of nodes that may be seen, of all that a packed field has.
    fn layers<B: Basis, const D: usize>(self, grid: &Grid<D>) -> Range<usize> {
        let axis = D - 1;
        let (cells, all) = (grid.cells[axis] as f64, layers(grid).end);
        let local = |x: f64| (x - grid.origin[axis]) * grid.inverse_h();
        let (low, high) = (local(self.low), local(self.high));
        // Domains see whole groups of nodes, and their ends are known but for rounding.
        let (below, above) = match B::DOMAIN {
            Domain::Point => (0.0, f64::from(B::DEGREE)),
            Domain::Fixed | Domain::Follows => (1.0, MARGIN as f64 + 1.0),
        };
        let wraps = low - below < 0.0 || high + (above - f64::from(B::DEGREE)) >= cells;
        // Beyond a seam stand the nodes of the other end.
        if !(low <= high) || grid.periodic[axis] && wraps {
            return 0..all;
        }
        let first = libm::floor(low.clamp(0.0, cells - 1.0)) - below;
        let last = libm::floor(high.clamp(0.0, cells - 1.0)) + above;
        first.max(0.0) as usize..all.min(last as usize + 1)
    }
}

impl Blocks {
    /// Particles whose layers are looked up together: a multiple of those that a loop takes at once.
    fn chunk(&self) -> usize {
        (self.least / CHUNKS).next_multiple_of(BATCH)
    }

    /// Cuts the particles into blocks, if there are enough and they are in order.
    pub(in crate::mpm) fn cut<B: Basis, const D: usize>(
        &mut self,
        grid: &Grid<D>,
        particles: &Particles<D>,
    ) {
        let (total, least, chunk) = (particles.len(), self.least, self.chunk());
        let is_large = total >= self.fewest;
        let enough = |count: &usize| is_large && count * least <= total;
        if COUNTS.iter().any(enough) {
            self.spans.resize(total.div_ceil(chunk), Span::NONE);
            RowChunks { length: 1, few: CHUNKS }.each(&mut self.spans, &|k, span| {
                span[0] = Span::of::<B, D>(particles, k * chunk..total.min((k + 1) * chunk));
            });
        }
        let mut counts = COUNTS.into_iter().filter(enough);
        if !counts.any(|count| self.cut_into::<B, D>(count, grid, total)) {
            self.colours.iter_mut().for_each(Vec::clear);
            self.colours[0].push(ParticleBlock { particles: 0..total, layers: layers(grid) });
        }
    }

    /// Cuts into so many blocks, and returns whether they lie in their order and those of a colour have no
    /// node in common.
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
