//! Interprets bytes as a scene and the state of its particles. Every byte string is valid; missing
//! bytes are zero, which stands for usual values.

use super::scene::{Scene, body, every_method, materials};
use mpm_solvers::mpm::{Matrix, SchemeName, Vector};
use mpm_subject::Start;

/// Numbers at which arithmetic changes its behaviour.
const TURNS: [f64; 20] = [
    0.0,
    -0.0,
    0.5,
    1.0,
    -1.0,
    2.0,
    1e-3,
    1e150,
    -1e150,
    1e300,
    -1e300,
    1e-160,
    1e-300,
    5e-324,
    1e19,
    f64::MAX,
    f64::MIN,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
];

struct Bytes<'a>(std::slice::Iter<'a, u8>);

impl Bytes<'_> {
    fn byte(&mut self) -> usize {
        self.0.next().copied().unwrap_or(0).into()
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.byte() % all.len()]
    }

    /// Returns the usual number, one of `TURNS`, a number up to 32 in steps of 1/1024, or any
    /// number.
    fn number(&mut self, usual: f64) -> f64 {
        match self.byte() % 4 {
            0 => usual,
            1 => self.one_of(&TURNS),
            2 => f64::from(i16::from_le_bytes(std::array::from_fn(|_| self.byte() as u8))) / 1024.0,
            _ => f64::from_le_bytes(std::array::from_fn(|_| self.byte() as u8)),
        }
    }
}

/// Runs steps from the state in the bytes. Panics if a step panics, or hides a NaN.
pub(crate) fn step(bytes: &[u8]) {
    let mut bytes = Bytes(bytes.iter());
    let dimension = bytes.byte();
    let scene = Scene {
        method: bytes.one_of(&every_method()),
        scheme: bytes.one_of(SchemeName::ALL),
        material: bytes.one_of(&materials()),
        start: bytes.one_of(Start::ALL),
        periodic: bytes.byte() % 2 == 1,
        cells: bytes.one_of(&[4, 1, 2, 3, 7]),
        dt: bytes.number(0.01),
    };
    match dimension % 3 {
        0 => in_dimension::<1>(&scene, &mut bytes),
        1 => in_dimension::<2>(&scene, &mut bytes),
        _ => in_dimension::<3>(&scene, &mut bytes),
    }
}

fn in_dimension<const D: usize>(scene: &Scene, bytes: &mut Bytes<'_>) {
    let mut body = body::<D>();
    body.spacing = body.spacing.map(|size| bytes.number(size));
    let deformed = bytes.byte() % 2 == 1;
    if deformed {
        body.track_deformation();
    }
    for p in 0..body.len() {
        let x = body.x[p];
        body.x[p] = Vector::from_fn(|axis, _| bytes.number(x[axis]));
        body.v[p] = Vector::from_fn(|_, _| bytes.number(0.0));
        body.mass[p] = bytes.number(1.0);
        body.vol[p] = bytes.number(body.vol[p]);
        body.vol0[p] = bytes.number(body.vol0[p]);
        body.sigma[p] = Matrix::from_fn(|_, _| bytes.number(0.0));
        body.grad_v[p] = Matrix::from_fn(|_, _| bytes.number(0.0));
        if deformed {
            let identity = Matrix::<D>::identity();
            body.def_grad[p] = Matrix::from_fn(|i, j| bytes.number(identity[(i, j)]));
        }
    }
    scene.holds("bytes", body);
}
