//! A table, one particle a line.

use super::shape::{is_scalar, is_tensor};
use crate::external::problem::LevelProblem;

const AXES: [&str; 3] = ["x", "y", "z"];

/// The table, whose head names the columns: `position_x`, `stress_xy`.
pub(super) fn written(problem: &LevelProblem) -> String {
    let (d, columns) = (problem.dimension, problem.particles.columns());
    let mut head = Vec::new();
    for (name, column) in &columns {
        let width = problem.width(column);
        let component = |k: usize| {
            if is_tensor(name) {
                format!("{name}_{}{}", AXES[k / d], AXES[k % d])
            } else {
                format!("{name}_{}", AXES[k])
            }
        };
        if is_scalar(name) {
            head.push((*name).to_owned());
        } else {
            head.extend((0..width).map(component));
        }
    }
    let mut lines = vec![head.join(",")];
    lines.extend((0..problem.particles.len()).map(|p| {
        let numbers = columns.iter().flat_map(|(_, column)| {
            let width = problem.width(column);
            &column[p * width..(p + 1) * width]
        });
        numbers.map(f64::to_string).collect::<Vec<_>>().join(",")
    }));
    lines.join("\n") + "\n"
}
