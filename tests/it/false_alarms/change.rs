//! Changes of a problem that must not affect a verdict.

use mpm_verify::external::LevelProblem;

/// A change of units, axes, positions and order. A vector of the problem becomes `scale Q v`, with
/// the signed permutation `Q` of `axes`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Change {
    pub(super) name: &'static str,
    /// Length, mass and time in the changed problem, for length, mass and time one in the original
    /// problem.
    pub(super) length: f64,
    pub(super) mass: f64,
    pub(super) time: f64,
    /// Whether the direction of the axes is reversed.
    pub(super) mirrored: bool,
    /// Whether the order of the axes is reversed.
    pub(super) exchanged: bool,
    /// Translation of body, grid and walls along each axis, in cells.
    pub(super) moved: f64,
    /// Translation of the grid relative to the body, in cells.
    pub(super) shifted: f64,
    /// Step from one particle to the next in the original order; one keeps the order.
    pub(super) stride: usize,
}

const NONE: Change = Change {
    name: "nothing",
    length: 1.0,
    mass: 1.0,
    time: 1.0,
    mirrored: false,
    exchanged: false,
    moved: 0.0,
    shifted: 0.0,
    stride: 1,
};

/// All changes; the first one changes nothing.
pub(super) const CHANGES: [Change; 13] = [
    NONE,
    Change { name: "length x 4", length: 4.0, ..NONE },
    Change { name: "mass x 4", mass: 4.0, ..NONE },
    Change { name: "time x 4", time: 4.0, ..NONE },
    Change { name: "length x 1000", length: 1e3, ..NONE },
    Change { name: "mass x 1e-6", mass: 1e-6, ..NONE },
    Change { name: "time x 1e3", time: 1e3, ..NONE },
    Change { name: "axes mirrored", mirrored: true, ..NONE },
    Change { name: "axes exchanged", exchanged: true, ..NONE },
    Change { name: "all moved by 12.3 cells", moved: 12.3, ..NONE },
    Change { name: "particles in another order", stride: 7, ..NONE },
    Change { name: "the grid 0.3 cells lower", shifted: -0.3, ..NONE },
    Change { name: "the grid 0.45 cells lower", shifted: -0.45, ..NONE },
];

impl Change {
    /// Whether results keep their bits, because numbers are multiplied by powers of two only.
    pub(super) fn keeps_bits(&self) -> bool {
        let power = |scale: f64| scale == 1.0 || scale == 4.0;
        let scales = [self.length, self.mass, self.time].into_iter().all(power);
        let same = Self { name: "", length: 1.0, mass: 1.0, time: 1.0, ..*self };
        scales && same == Self { name: "", ..NONE }
    }

    /// Reason why the change affects a problem, or is not possible for it.
    pub(super) fn excluded(&self, problem: &LevelProblem) -> Option<&'static str> {
        let held = problem.faces.iter().any(|face| face.condition != "free");
        if self.shifted != 0.0 && held {
            return Some("walls lie on nodes");
        }
        (self.exchanged && problem.dimension == 1).then_some("one axis")
    }

    /// Returns the axis that replaces axis `i` of `d`, with its sign.
    pub(super) fn axis(&self, i: usize, d: usize) -> (usize, f64) {
        let axis = if self.exchanged { d - 1 - i } else { i };
        (axis, if self.mirrored { -1.0 } else { 1.0 })
    }

    /// Converts a vector to the changed axes, and multiplies it by a scale.
    pub(super) fn vector(&self, v: &[f64], scale: f64) -> Vec<f64> {
        let d = v.len();
        let mut changed = vec![0.0; d];
        for (i, component) in v.iter().enumerate() {
            let (axis, sign) = self.axis(i, d);
            changed[axis] = sign * component * scale;
        }
        changed
    }

    /// Converts a tensor (rows) to the changed axes, and multiplies it by a scale.
    pub(super) fn tensor(&self, rows: &[f64], d: usize, scale: f64) -> Vec<f64> {
        let mut changed = vec![0.0; d * d];
        for i in 0..d {
            for j in 0..d {
                let ((a, s), (b, t)) = (self.axis(i, d), self.axis(j, d));
                changed[a * d + b] = s * t * rows[i * d + j] * scale;
            }
        }
        changed
    }

    /// Converts a position to the changed units and axes. Both changes of axes are their own
    /// inverses.
    pub(super) fn place(&self, x: &[f64], h: f64) -> Vec<f64> {
        let moved = self.vector(x, self.length);
        moved.into_iter().map(|x| x + self.moved * h * self.length).collect()
    }

    /// Returns the new value of one unit of stress in `d` dimensions.
    pub(super) fn stress(&self, d: usize) -> f64 {
        let per_time = 1.0 / (self.time * self.time);
        self.mass * per_time * self.length.powi(2 - d as i32)
    }

    pub(super) fn energy(&self) -> f64 {
        self.mass * self.length * self.length / (self.time * self.time)
    }

    /// Returns the index of each of `n` particles in the changed problem.
    pub(super) fn order(&self, n: usize) -> Vec<usize> {
        let stride = (self.stride..self.stride + n.max(1)).find(|s| gcd(*s, n) == 1).unwrap_or(1);
        (0..n).map(|k| k * stride % n.max(1)).collect()
    }
}

/// Returns the greatest common divisor.
pub(super) fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}
