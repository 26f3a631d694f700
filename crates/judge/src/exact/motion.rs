//! A motion given by formulas: displacement, velocity and all derivatives that checks need.

use super::formula::{Formula, Hoisted, Jet, Number, NumberBatch, Slope};
use super::truth::Truth;
use mpm_subject::with_dimension;

/// A displacement field u(X, t): one formula of the coordinates and t for each component.
#[derive(Debug, Clone)]
pub struct Motion {
    pub(super) components: Vec<Formula>,
    pub(super) dimension: usize,
}

/// Derivatives of a motion at one point and time; zero on axes that the body does not have.
#[derive(Debug, Clone, Copy, Default)]
pub struct Derivatives {
    /// u (m).
    pub u: [f64; 3],
    /// u_t (m/s).
    pub velocity: [f64; 3],
    /// u_tt (m/s2).
    pub acceleration: [f64; 3],
    /// `grad[i][j] = du_i/dX_j`.
    pub grad: [[f64; 3]; 3],
    /// `grad_rate[i][j] = d2 u_i/dX_j dt` (1/s).
    pub grad_rate: [[f64; 3]; 3],
    /// `second[k][a][b] = d2 u_k/dX_a dX_b` (1/m).
    pub second: [[[f64; 3]; 3]; 3],
}

impl Motion {
    /// Creates a motion from its components.
    pub fn new(components: Vec<Formula>) -> Self {
        Self { dimension: components.len(), components }
    }

    /// Returns the text of the formulas.
    pub fn source(&self) -> String {
        self.components.iter().map(Formula::source).collect::<Vec<_>>().join(", ")
    }

    /// Whether no component has a kink anywhere ([`Formula::is_smooth`]).
    pub fn is_smooth(&self) -> bool {
        self.components.iter().all(Formula::is_smooth)
    }

    /// Whether the motion varies along `axis`.
    pub fn varies_along(&self, axis: usize) -> bool {
        self.components.iter().any(|component| component.reads(axis))
    }

    /// Returns the number of space dimensions.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// Evaluates component i of the displacement.
    pub fn component(&self, i: usize, label: &[f64], t: f64) -> f64 {
        self.components[i].at(label, t)
    }

    /// Computes the motion and its derivatives, by automatic differentiation.
    pub fn derivatives(&self, label: &[f64], t: f64) -> Derivatives {
        with_dimension!(self.dimension(), D => {
            let (seeds, mut all) = (seeds::<{ D + 1 }>(label, t), Derivatives::default());
            gather(self.components.iter().map(|formula| formula.eval(&seeds)), &mut all);
            all
        })
    }

    /// Prepares the evaluation of the motion at the reference positions `labels` (m). This call
    /// computes the terms that do not depend on time.
    pub fn at_places(&self, labels: &[&[f64]]) -> Box<dyn Places> {
        with_dimension!(self.dimension(), D => {
            Box::new(self.hoisted::<Jet<{ D + 1 }>>(labels, Jet::variable))
        })
    }

    /// Prepares the evaluation like [`Self::at_places`], but with first derivatives only. Second
    /// derivatives are not written.
    pub fn slopes_at_places(&self, labels: &[&[f64]]) -> Box<dyn Places> {
        with_dimension!(self.dimension(), D => {
            Box::new(self.hoisted::<Slope<{ D + 1 }>>(labels, Slope::variable))
        })
    }

    fn hoisted<T: Number>(&self, labels: &[&[f64]], variable: fn(f64, usize) -> T) -> Hoisted<T> {
        let mut places = Hoisted::new(&self.components, self.dimension() + 1);
        for label in labels {
            let seeds: Vec<T> = label.iter().enumerate().map(|(a, x)| variable(*x, a)).collect();
            places.add(&seeds);
        }
        places
    }
}

/// A motion at fixed positions, evaluated at one time after another.
pub trait Places: Send {
    /// Sets the time to `t` (s).
    fn set_time(&mut self, t: f64);

    /// Writes the derivatives at the position with index `place`, except those on missing axes. The
    /// values are bit-identical to those of [`Motion::derivatives`]. Does not allocate.
    fn derivatives(&mut self, place: usize, into: &mut Derivatives);
}

impl<const N: usize> Places for Hoisted<Jet<N>> {
    fn set_time(&mut self, t: f64) {
        self.set_time(Jet::variable(t, N - 1));
    }

    fn derivatives(&mut self, place: usize, into: &mut Derivatives) {
        gather(self.eval(place), into);
    }
}

impl<const N: usize> Places for Hoisted<Slope<N>> {
    fn set_time(&mut self, t: f64) {
        self.set_time(Slope::variable(t, N - 1));
    }

    fn derivatives(&mut self, place: usize, into: &mut Derivatives) {
        for (i, slope) in self.eval(place).enumerate() {
            into.u[i] = slope.value();
            into.velocity[i] = slope.d(N - 1);
            for a in 0..N - 1 {
                into.grad[i][a] = slope.d(a);
            }
        }
    }
}

/// Collects the derivatives from the jets of all components; the last jet variable is time.
#[inline]
fn gather<const N: usize>(components: impl Iterator<Item = Jet<N>>, all: &mut Derivatives) {
    let time = N - 1;
    for (i, jet) in components.enumerate() {
        all.u[i] = jet.value();
        all.velocity[i] = jet.d(time);
        all.acceleration[i] = jet.dd(time, time);
        for a in 0..time {
            all.grad[i][a] = jet.d(a);
            all.grad_rate[i][a] = jet.dd(a, time);
            for b in 0..time {
                all.second[i][a][b] = jet.dd(a, b);
            }
        }
    }
}

/// Returns the coordinates followed by the time. Formulas use the first D + 1 numbers.
#[inline]
pub fn variables(label: &[f64], t: f64) -> [f64; 4] {
    let mut all = [0.0; 4];
    all[..label.len()].copy_from_slice(label);
    all[label.len()] = t;
    all
}

/// Returns the coordinates and the time as variables of differentiation.
pub(super) fn seeds<const N: usize>(label: &[f64], t: f64) -> [Jet<N>; N] {
    std::array::from_fn(|a| Jet::variable(if a + 1 == N { t } else { label[a] }, a))
}

impl Formula {
    /// Evaluates a formula of the coordinates and t.
    #[inline]
    pub fn at(&self, label: &[f64], t: f64) -> f64 {
        self.eval(&variables(label, t)[..=label.len()])
    }
}

impl Truth for Motion {
    fn displacement(&self, label: &[f64], t: f64, into: &mut [f64]) {
        for (i, u) in into.iter_mut().enumerate() {
            *u = self.component(i, label, t);
        }
    }

    fn displacements(&self, d: usize, labels: &[f64], t: f64, into: &mut [f64]) {
        for (labels, into) in
            labels.chunks(d * NumberBatch::LEN).zip(into.chunks_mut(d * NumberBatch::LEN))
        {
            // Lanes of a batch that have no point use the last point.
            let last = labels.len() / d - 1;
            let mut all = [NumberBatch::from(t); 4];
            for axis in 0..d {
                all[axis] = NumberBatch::new(|lane| labels[lane.min(last) * d + axis]);
            }
            for (i, formula) in self.components.iter().enumerate() {
                let u = formula.eval(&all[..=d]);
                (0..=last).for_each(|lane| into[lane * d + i] = u.get(lane));
            }
        }
    }

    fn velocity(&self, label: &[f64], t: f64, into: &mut [f64]) {
        into.copy_from_slice(&self.derivatives(label, t).velocity[..self.dimension()]);
    }

    fn deformation_gradient(&self, label: &[f64], t: f64, into: &mut [f64]) -> bool {
        let mut f = self.derivatives(label, t).grad;
        (0..3).for_each(|i| f[i][i] += 1.0);
        write(&f, self.dimension(), into);
        true
    }
}

/// Writes the leading `dimension` x `dimension` block of a tensor, row by row.
pub(super) fn write(tensor: &[[f64; 3]; 3], dimension: usize, into: &mut [f64]) {
    for (i, row) in into.chunks_exact_mut(dimension).enumerate() {
        row.copy_from_slice(&tensor[i][..dimension]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::tests::bind;

    fn motion(texts: [&str; 2]) -> Motion {
        Motion::new(texts.map(|text| bind(text, &["X", "Y", "t"])).to_vec())
    }

    #[test]
    fn slopes_are_bit_identical_to_full_derivatives() {
        let motion = motion(["sin(2*X - t)*exp(-Y^2)", "atan2(Y, X + 2)*max(t - X, 0)^2/(1 + t)"]);
        let labels = [[0.1, 0.7], [0.9, 0.0], [0.3, -0.2]];
        let mut places = motion.slopes_at_places(&labels.each_ref().map(<[f64; 2]>::as_slice));
        for t in [0.0, 0.45, 1.3] {
            places.set_time(t);
            for (place, label) in labels.iter().enumerate() {
                let (all, mut first) = (motion.derivatives(label, t), Derivatives::default());
                places.derivatives(place, &mut first);
                assert_eq!((first.u, first.velocity, first.grad), (all.u, all.velocity, all.grad));
                assert_eq!(first.second, [[[0.0; 3]; 3]; 3]);
            }
        }
    }

    #[test]
    fn a_deformation_gradient_has_the_identity() {
        let mut f = [f64::NAN; 4];
        assert!(motion(["t*Y", "Y"]).deformation_gradient(&[0.3, 0.7], 0.5, &mut f));
        assert_eq!(f, [1.0, 0.5, 0.0, 2.0]);
    }

    #[test]
    fn motion_varies_only_along_axes_in_its_formulas() {
        let varies = |texts: [&str; 2]| {
            let motion = motion(texts);
            [motion.varies_along(0), motion.varies_along(1)]
        };
        assert_eq!(varies(["sum(n, 1, 3, sin(n*X))*t", "0"]), [true, false]);
        assert_eq!(varies(["t", "Y"]), [false, true]);
        assert_eq!(varies(["0", "X + Y"]), [true, true]);
        assert_eq!(varies(["t", "0*2"]), [false, false]);
    }
}
