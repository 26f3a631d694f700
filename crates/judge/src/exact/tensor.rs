//! Tensors over any [`Number`], logarithmic strain and rotation of a deformation.

use super::formula::Number;

/// Stress or displacement gradient. With D < 3, components along the other axes are zero.
pub(super) type Tensor<T, const D: usize = 3> = [[T; D]; D];

/// Maximum number of terms in [`log_strain`] and [`rotation`], for stretches up to about ten.
const MOST_TERMS: i32 = 1000;

#[inline]
pub(super) fn tensor<T: Number, const D: usize>(
    component: impl Fn(usize, usize) -> T,
) -> Tensor<T, D> {
    let mut tensor = [[T::from(0.0); D]; D];
    for i in 0..D {
        for j in 0..D {
            tensor[i][j] = component(i, j);
        }
    }
    tensor
}

/// Returns the vector with these components, inlined, unlike `std::array::from_fn`.
#[inline]
pub(super) fn vector<T: Number, const D: usize>(component: impl Fn(usize) -> T) -> [T; D] {
    let mut vector = [T::from(0.0); D];
    for i in 0..D {
        vector[i] = component(i);
    }
    vector
}

#[inline]
pub(super) fn in_space<const D: usize>(inside: [f64; D]) -> [f64; 3] {
    vector(|i| if i < D { inside[i] } else { 0.0 })
}

#[inline]
pub(super) fn sum<T: Number, const D: usize>(term: impl Fn(usize) -> T) -> T {
    let mut sum = term(0);
    for i in 1..D {
        sum = sum + term(i);
    }
    sum
}

#[inline]
pub(super) fn unit<T: Number>(i: usize, j: usize) -> T {
    T::from(f64::from(u8::from(i == j)))
}

/// Computes the cofactor of f_ij, `F^-T = cof(F)/det(F)`, with ones on the missing diagonal.
#[inline]
pub(super) fn cofactor<T: Number, const D: usize>(f: &Tensor<T, D>, i: usize, j: usize) -> T {
    match D {
        1 => T::from(1.0),
        2 if i == j => f[1 - i][1 - j],
        2 => -f[1 - i][1 - j],
        _ => {
            let (a, b) = ((i + 1) % 3, (i + 2) % 3);
            let (c, d) = ((j + 1) % 3, (j + 2) % 3);
            f[a][c] * f[b][d] - f[a][d] * f[b][c]
        }
    }
}

/// Computes det F from its first row and the cofactors of that row.
#[inline]
pub(super) fn det<T: Number, const D: usize>(f: &Tensor<T, D>, cofactor: &Tensor<T, D>) -> T {
    sum::<T, D>(|j| f[0][j] * cofactor[0][j])
}

/// Returns `F = I + grad u`, its cofactors and its determinant.
#[inline]
pub(super) fn deformation<T: Number, const D: usize>(
    grad: &Tensor<T, D>,
) -> (Tensor<T, D>, Tensor<T, D>, T) {
    let f: Tensor<T, D> = tensor(|i, j| grad[i][j] + unit(i, j));
    let cofactors: Tensor<T, D> = tensor(|i, j| cofactor(&f, i, j));
    (f, cofactors, det(&f, &cofactors))
}

/// Computes the Cauchy stress `P F^T/J` for a given P, in the units of P.
pub(super) fn pushed_forward(piola: &Tensor<f64>, grad: &Tensor<f64>) -> Tensor<f64> {
    let f: Tensor<f64> = tensor(|i, j| grad[i][j] + f64::from(u8::from(i == j)));
    let det: f64 = (0..3).map(|b| f[0][b] * cofactor(&f, 0, b)).sum();
    tensor(|i, j| (0..3).map(|k| piola[i][k] * f[j][k]).sum::<f64>() / det)
}

pub(super) fn area<T: Number>(grad: &Tensor<T, 2>) -> T {
    let f: Tensor<T, 2> = tensor(|i, j| grad[i][j] + unit(i, j));
    f[0][0] * f[1][1] - f[0][1] * f[1][0]
}

/// Computes `det(I + grad) - 1` from the invariants of grad, without cancellation for small values.
pub(super) fn dilation(grad: &Tensor<f64>) -> f64 {
    let minors: Tensor<f64> = tensor(|i, j| cofactor(grad, i, j));
    det(grad, &minors) + sum::<f64, 3>(|i| grad[i][i] + minors[i][i])
}

#[inline]
pub(super) fn product<T: Number, const D: usize>(
    a: &Tensor<T, D>,
    b: &Tensor<T, D>,
) -> Tensor<T, D> {
    tensor(|i, j| sum::<T, D>(|k| a[i][k] * b[k][j]))
}

/// Computes the logarithmic strain `eps = ln(b)/2`, `b = F F^T`.
///
/// The strain follows from `tanh(eps) = X = (b - I)(b + I)^-1` by the series `X + X^3/3 + X^5/5 +
/// ...` (Higham 2008, *Functions of Matrices*, section 11.4), which is differentiable where
/// eigenvalues coincide. NaN if [`MOST_TERMS`] terms do not suffice. If all off-diagonal components
/// of F and their derivatives are zero, `eps_ii = ln F_ii` is faster.
pub(super) fn log_strain<T: Number, const D: usize>(f: &Tensor<T, D>) -> Tensor<T, D> {
    if !is_sheared(f) {
        return tensor(|i, j| if i == j { Number::ln(f[i][i]) } else { T::from(0.0) });
    }
    let b: Tensor<T, D> = tensor(|i, j| sum::<T, D>(|k| f[i][k] * f[j][k]));
    let shifted: Tensor<T, D> = tensor(|i, j| b[i][j] + unit(i, j));
    // b + I and its cofactors are symmetric.
    let cofactors: Tensor<T, D> = tensor(|i, j| cofactor(&shifted, i, j));
    let determinant = det(&shifted, &cofactors);
    let inverse = tensor(|i, j| cofactors[i][j] / determinant);
    let x = product(&tensor(|i, j| b[i][j] - unit(i, j)), &inverse);
    let square = product(&x, &x);
    let (mut power, mut strain) = (x, x);
    for k in 1..=MOST_TERMS {
        power = product(&power, &square);
        if size(&power) <= 1e-17 * size(&x) {
            return strain;
        }
        let share = T::from(1.0 / f64::from(2 * k + 1));
        strain = tensor(|i, j| strain[i][j] + power[i][j] * share);
    }
    tensor(|_, _| T::from(f64::NAN))
}

/// Computes the rotation R of the polar decomposition `F = R U` by Newton's iteration
/// `R <- (R + R^-T)/2`, starting at F (Higham 2008, *Functions of Matrices*, section 8.3). R = I if
/// F and its derivatives are diagonal and the diagonal of F is positive. NaN if [`MOST_TERMS`]
/// iterations do not suffice.
pub(super) fn rotation<T: Number, const D: usize>(f: &Tensor<T, D>) -> Tensor<T, D> {
    if !is_sheared(f) && (0..D).all(|i| f[i][i].value() > 0.0) {
        return tensor(unit);
    }
    let mut turn = *f;
    for _ in 0..MOST_TERMS {
        let (before, half) = (turn, T::from(0.5));
        let cofactors: Tensor<T, D> = tensor(|i, j| cofactor(&before, i, j));
        let det = det(&before, &cofactors);
        turn = tensor(|i, j| half * (before[i][j] + cofactors[i][j] / det));
        // Values converge one iteration before their derivatives. Each iteration squares the error,
        // so a change of 1e-12 shows that both are now accurate.
        let step: Tensor<T, D> = tensor(|i, j| turn[i][j] - before[i][j]);
        if size(&step) <= 1e-12 {
            return turn;
        }
    }
    tensor(|_, _| T::from(f64::NAN))
}

/// Whether an off-diagonal component or one of its derivatives is nonzero.
fn is_sheared<T: Number, const D: usize>(f: &Tensor<T, D>) -> bool {
    (0..D).any(|i| (0..D).any(|j| j != i && f[i][j] != T::from(0.0)))
}

fn size<T: Number, const D: usize>(t: &Tensor<T, D>) -> f64 {
    t.iter().flatten().map(|c| c.value() * c.value()).sum::<f64>().sqrt()
}
