//! Updates the stresses of a body in one loop over the particles:
//!
//! ```text
//! threads   the body is halved recursively, down to some thousands of particles
//! blocks    128 particles, whose columns fit into the L1 cache:  F  ->  law  ->  checks
//! ```

use crate::mpm::foundation::algebra::{Matrix, product, zeros};
use crate::mpm::foundation::finite_check::all_finite;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::vectorized;
use crate::mpm::foundation::threads::{FEW, join};

/// Number of particles in a block. A particle has 232 bytes in 3-D.
const BLOCK: usize = 128;

/// Update of the stresses of a body over a time step.
#[derive(Debug)]
pub struct StressUpdate<'a, const D: usize> {
    dt: f64,
    particles: &'a mut Particles<D>,
    /// Whether F still has its value at the start of the step.
    awaits_strain: bool,
    /// Smallest J after the last call of a law, if all J were positive and all stresses finite.
    least_j: Option<f64>,
}

/// Columns of a block of particles, which a law reads and writes. Columns that the body does not
/// have are empty.
#[derive(Debug)]
pub struct StressBlock<'a, const D: usize> {
    /// F at the end of the step.
    pub def_grad: &'a mut [Matrix<D>],
    /// Velocity gradients (1/s).
    pub grad_v: &'a [Matrix<D>],
    /// Masses (kg).
    pub mass: &'a [f64],
    /// Reference volumes (m^D).
    pub vol0: &'a [f64],
    /// Volumes (m^D), which the law sets.
    pub vol: &'a mut [f64],
    /// Cauchy stresses (Pa), which the law sets.
    pub sigma: &'a mut [Matrix<D>],
    /// Out-of-plane stretches.
    pub across: &'a mut [f64],
    /// Out-of-plane stresses (Pa).
    pub stress_across: &'a mut [f64],
}

/// A law for one block of particles. The second argument is the state of the law for each particle.
type BlockLaw<'a, const D: usize, S> = dyn Fn(&mut StressBlock<'_, D>, &mut [S]) + Sync + 'a;

impl<'a, const D: usize> StressUpdate<'a, D> {
    /// Creates an update over `dt` (s). F must already have its value at the end of the step.
    pub fn new(dt: f64, particles: &'a mut Particles<D>) -> Self {
        Self { dt, particles, awaits_strain: false, least_j: None }
    }

    /// Creates an update over `dt` (s) for particles with F at the start of the step. For each
    /// block, F is advanced from the velocity gradients immediately before the law is called.
    pub(in crate::mpm) fn straining(dt: f64, particles: &'a mut Particles<D>) -> Self {
        Self { awaits_strain: true, ..Self::new(dt, particles) }
    }

    /// Returns the time step (s).
    pub fn dt(&self) -> f64 {
        self.dt
    }

    /// Returns the number of particles.
    pub fn count(&self) -> usize {
        self.particles.len()
    }

    /// Returns all particles, with F at the end of the step.
    pub fn particles(&mut self) -> &mut Particles<D> {
        if std::mem::take(&mut self.awaits_strain) {
            strain_by(self.dt, &self.particles.grad_v, &mut self.particles.def_grad);
        }
        self.least_j = None;
        self.particles
    }

    /// Calls `law` for all particles, block by block, on all threads.
    pub fn by_block(&mut self, law: impl Fn(&mut StressBlock<'_, D>) + Sync) {
        self.by_block_with(&mut Vec::<()>::new(), &|block, _| law(block));
    }

    /// Calls `law` for all particles, block by block, on all threads. `law` also receives the
    /// entries of `state` for these particles. The first call creates the entries of `state`.
    pub fn by_block_with<S: Clone + Default + Send>(
        &mut self,
        state: &mut Vec<S>,
        law: &BlockLaw<'_, D, S>,
    ) {
        state.resize(self.particles.len(), S::default());
        let strain = std::mem::take(&mut self.awaits_strain).then_some(self.dt);
        self.least_j = visit(StressBlock::from_particles(self.particles), state, strain, law);
    }

    /// Returns the smallest J (infinity without particles). `None` unless every J is positive and
    /// finite and all stresses are finite.
    pub(in crate::mpm) fn least_j(mut self) -> Option<f64> {
        if self.least_j.is_none() {
            self.by_block(|_| {});
        }
        self.least_j
    }
}

impl<'a, const D: usize> StressBlock<'a, D> {
    fn from_particles(particles: &'a mut Particles<D>) -> Self {
        let Particles { def_grad, grad_v, mass, vol0, vol, sigma, .. } = particles;
        let Particles { across, stress_across, .. } = particles;
        Self { def_grad, grad_v, mass, vol0, vol, sigma, across, stress_across }
    }

    /// Splits off the first `count` particles, or all particles if there are fewer.
    fn take_first(&mut self, count: usize) -> Self {
        Self {
            def_grad: first_mut(&mut self.def_grad, count),
            grad_v: self.grad_v.split_off(..count.min(self.grad_v.len())).unwrap_or_default(),
            mass: self.mass.split_off(..count.min(self.mass.len())).unwrap_or_default(),
            vol0: self.vol0.split_off(..count.min(self.vol0.len())).unwrap_or_default(),
            vol: first_mut(&mut self.vol, count),
            sigma: first_mut(&mut self.sigma, count),
            across: first_mut(&mut self.across, count),
            stress_across: first_mut(&mut self.stress_across, count),
        }
    }

    fn least_j(&self) -> Option<f64> {
        let least = least_ratio(self.vol, self.vol0)?;
        let is_sound = all_finite(self.sigma) && self.stress_across.iter().all(|s| s.is_finite());
        is_sound.then_some(least)
    }
}

#[allow(clippy::mut_mut, reason = "what is taken is gone from the column")]
fn first_mut<'a, T>(column: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    column.split_off_mut(..count.min(column.len())).unwrap_or_default()
}

/// Calls `law` block by block. If `strain` is a time step (s), F is advanced over this step before
/// the law is called. Returns the smallest J, see [`StressUpdate::least_j`].
fn visit<S: Send, const D: usize>(
    mut body: StressBlock<'_, D>,
    mut state: &mut [S],
    strain: Option<f64>,
    law: &BlockLaw<'_, D, S>,
) -> Option<f64> {
    let total = body.vol.len();
    let both = |one: Option<f64>, other: Option<f64>| Some(one?.min(other?));
    if total > FEW {
        let middle = (total / 2).next_multiple_of(BLOCK);
        let (low, state_of_low) = (body.take_first(middle), first_mut(&mut state, middle));
        let (mut one, mut other) = (None, None);
        join(
            || one = visit(low, state_of_low, strain, law),
            || other = visit(body, state, strain, law),
        );
        return both(one, other);
    }
    let mut least_j = Some(f64::INFINITY);
    while !body.vol.is_empty() {
        let mut block = body.take_first(BLOCK);
        if let Some(dt) = strain {
            strain_by(dt, block.grad_v, block.def_grad);
        }
        law(&mut block, first_mut(&mut state, BLOCK));
        least_j = both(least_j, block.least_j());
    }
    least_j
}

/// Advances F: `F <- (I + grad v dt) F`.
fn strain_by<const D: usize>(dt: f64, grad_v: &[Matrix<D>], def_grad: &mut [Matrix<D>]) {
    vectorized(
        #[inline(always)]
        || {
            for (f, grad_v) in def_grad.iter_mut().zip(grad_v) {
                let mut step = zeros();
                for j in 0..D {
                    for i in 0..D {
                        let unit = if i == j { 1.0 } else { 0.0 };
                        step[(i, j)] = unit + grad_v[(i, j)] * dt;
                    }
                }
                *f = product(&step, f);
            }
        },
    );
}

const TOGETHER: usize = 4;

/// Returns the smallest `a / b` if all ratios are positive and finite; infinity for empty slices.
/// The loop has no early exit, because failures are rare, and divides several numbers at a time.
fn least_ratio(a: &[f64], b: &[f64]) -> Option<f64> {
    let (many_a, rest_a) = a.as_chunks::<TOGETHER>();
    let (many_b, rest_b) = b.as_chunks::<TOGETHER>();
    let (mut least, mut sound) = ([f64::INFINITY; TOGETHER], [1.0; TOGETHER]);
    vectorized(
        #[inline(always)]
        || {
            for (a, b) in many_a.iter().zip(many_b) {
                for k in 0..TOGETHER {
                    let ratio = a[k] / b[k];
                    // Adds zero if the ratio is finite. Otherwise the sum becomes NaN and remains
                    // NaN.
                    sound[k] += ratio * 0.0;
                    least[k] = if ratio < least[k] { ratio } else { least[k] };
                }
            }
        },
    );
    let (mut all_sound, mut least_of_all) = (0.0, f64::INFINITY);
    for k in 0..TOGETHER {
        all_sound += sound[k];
        least_of_all = least_of_all.min(least[k]);
    }
    for (a, b) in rest_a.iter().zip(rest_b) {
        let ratio = a / b;
        all_sound += ratio * 0.0;
        least_of_all = least_of_all.min(ratio);
    }
    (least_of_all > 0.0 && all_sound.is_finite()).then_some(least_of_all)
}

#[cfg(test)]
mod tests {
    use super::super::specimen::{every, scattered};
    use super::*;
    use crate::mpm::foundation::algebra::{Vector, det};
    use rayon::ThreadPoolBuilder;
    use rstest::rstest;

    /// Creates squares at rest, each with its own velocity gradient (1/s), so that a batch has
    /// small and large strains.
    fn squares(total: usize) -> Particles<2> {
        let mut squares = Particles::cubes([total, 1]);
        squares.track_deformation();
        for (p, grad_v) in squares.grad_v.iter_mut().enumerate() {
            *grad_v = scattered([0.2, 0.02, 1e-3][p % 3], p as f64);
        }
        squares
    }

    /// Compares each particle of an update with an update of this particle alone.
    #[rstest]
    fn blocks_on_threads_are_bit_identical_to_single_particles(#[values(1, 3)] threads: usize) {
        let (total, dt) = (2 * FEW + 37, 0.5);
        for plan in every() {
            let (mut body, mut law) = (squares(total), plan.build::<2>());
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let least_j = pool.install(|| {
                let mut update = StressUpdate::straining(dt, &mut body);
                law.update(&mut update);
                update.least_j()
            });
            for p in [0, 1, BLOCK - 1, BLOCK, FEW, FEW + 19, total / 2, total - 1] {
                let mut alone = squares(1);
                alone.grad_v[0] = body.grad_v[p];
                alone.def_grad[0] = Matrix::identity() + body.grad_v[p] * dt;
                plan.build().update(&mut StressUpdate::new(dt, &mut alone));
                let state = |body: &Particles<2>, p| (body.def_grad[p], body.sigma[p], body.vol[p]);
                assert_eq!(state(&body, p), state(&alone, 0), "{plan:?}, particle {p}");
            }
            let j = body.vol.iter().zip(&body.vol0).map(|(vol, vol0)| vol / vol0);
            assert_eq!(least_j, Some(j.fold(f64::INFINITY, f64::min)), "{plan:?}");
        }
    }

    /// With these rates the particle is undefined, inverted or flat.
    #[rstest]
    fn one_invalid_particle_of_many_is_detected(#[values(f64::NAN, -3.0, -2.0)] rate: f64) {
        for p in [0, FEW + 5, 2 * FEW + 36] {
            let mut body = squares(2 * FEW + 37);
            body.grad_v[p] = Matrix::from_diagonal(&Vector::<2>::new(rate, 0.0));
            let mut update = StressUpdate::straining(0.5, &mut body);
            every()[0].build().update(&mut update);
            assert_eq!(update.least_j(), None);
        }
    }

    /// The volume of a particle is changed outside the law.
    #[test]
    fn particles_are_strained_once_and_checked_after_changes() {
        let mut body = squares(3);
        let mut update = StressUpdate::straining(0.5, &mut body);
        let f = update.particles().def_grad[2];
        assert_eq!(f, Matrix::identity() + update.particles().grad_v[2] * 0.5);
        update.by_block(|block| block.vol.copy_from_slice(&[2.0, det(&f), 3.0]));
        update.particles().vol[1] = 0.25;
        assert_eq!(update.particles().def_grad[2], f, "once only");
        assert_eq!(update.least_j(), Some(0.25));
    }

    #[rstest]
    #[case::of_several(&[2.0, 1.0, 3.0, 4.0, 1.5], Some(1.0))]
    #[case::in_the_rest(&[2.0, 1.0, 3.0, 4.0, 0.5], Some(0.5))]
    #[case::of_none(&[], Some(f64::INFINITY))]
    #[case::inverted(&[2.0, -1.0, 3.0, 4.0, 0.5], None)]
    #[case::flat(&[2.0, 1.0, 3.0, 4.0, 0.0], None)]
    #[case::nan(&[2.0, 1.0, f64::NAN, 4.0, 1.0], None)]
    #[case::nan_in_the_rest(&[2.0, 1.0, 1.0, 4.0, f64::NAN], None)]
    #[case::infinite(&[f64::INFINITY, 1.0, 1.0, 4.0, 1.0, 1.0, 1.0, 1.0], None)]
    fn least_ratio_requires_positive_finite_ratios(#[case] a: &[f64], #[case] least: Option<f64>) {
        assert_eq!(least_ratio(a, &vec![1.0; a.len()]), least);
    }
}
