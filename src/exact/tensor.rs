//! Tensors over any [`Number`], and the logarithmic strain.

use super::formula::Number;

/// Stress or gradient in three dimensions; what lies beyond the problem's dimension is zero, so a
/// motion in fewer dimensions is one of plane or uniaxial strain.
pub(super) type Tensor<T> = [[T; 3]; 3];

/// Largest number of terms of the series below: enough for stretches up to about ten.
const MOST_TERMS: i32 = 1000;

pub(super) fn tensor<T>(component: impl Fn(usize, usize) -> T) -> Tensor<T> {
    std::array::from_fn(|i| std::array::from_fn(|j| component(i, j)))
}

/// 1 on the diagonal, 0 elsewhere.
pub(super) fn unit<T: Number>(i: usize, j: usize) -> T {
    T::from(f64::from(u8::from(i == j)))
}

/// Cofactor of f_ij: `F^-T = cof(F)/det(F)`.
pub(super) fn cofactor<T: Number>(f: &Tensor<T>, i: usize, j: usize) -> T {
    let (a, b) = ((i + 1) % 3, (i + 2) % 3);
    let (c, d) = ((j + 1) % 3, (j + 2) % 3);
    f[a][c] * f[b][d] - f[a][d] * f[b][c]
}

/// det F, by its first row and the cofactors of that.
pub(super) fn det<T: Number>(f: &Tensor<T>, cofactor: &Tensor<T>) -> T {
    f[0][0] * cofactor[0][0] + f[0][1] * cofactor[0][1] + f[0][2] * cofactor[0][2]
}

pub(super) fn product<T: Number>(a: &Tensor<T>, b: &Tensor<T>) -> Tensor<T> {
    tensor(|i, j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j])
}

/// The logarithmic strain `eps = ln(b)/2`, `b = F F^T`.
///
/// From `tanh(eps) = X = (b - I)(b + I)^-1` by the series of the inverse, `X + X^3/3 + X^5/5 + ...`
/// (Higham 2008, *Functions of Matrices*, section 11.4): no eigenvalues, whose derivatives would not
/// exist where they coincide. NaN where [`MOST_TERMS`] do not suffice. Where nothing shears, and with
/// no derivative either, the strains are logarithms, which is quicker.
pub(super) fn log_strain<T: Number>(f: &Tensor<T>) -> Tensor<T> {
    let zero = T::from(0.0);
    let sheared = |i: usize| (0..3).any(|j| j != i && f[i][j] != zero);
    if !(0..3).any(sheared) {
        return tensor(|i, j| if i == j { Number::ln(f[i][i]) } else { zero });
    }
    let b: Tensor<T> = tensor(|i, j| f[i][0] * f[j][0] + f[i][1] * f[j][1] + f[i][2] * f[j][2]);
    let sum = tensor(|i, j| b[i][j] + unit(i, j));
    // b + I is symmetric, and so are its cofactors.
    let cofactors = tensor(|i, j| cofactor(&sum, i, j));
    let determinant = det(&sum, &cofactors);
    let inverse = tensor(|i, j| cofactors[i][j] / determinant);
    let x = product(&tensor(|i, j| b[i][j] - unit(i, j)), &inverse);
    let square = product(&x, &x);
    let (mut power, mut strain) = (x, x);
    for k in 1..=MOST_TERMS {
        power = product(&power, &square);
        // What this bounds is, relative to X, the derivative of the rest too.
        if size(&power) <= 1e-17 * size(&x) {
            return strain;
        }
        let share = T::from(1.0 / f64::from(2 * k + 1));
        strain = tensor(|i, j| strain[i][j] + power[i][j] * share);
    }
    tensor(|_, _| T::from(f64::NAN))
}

fn size<T: Number>(t: &Tensor<T>) -> f64 {
    t.iter().flatten().map(|c| c.value() * c.value()).sum::<f64>().sqrt()
}
