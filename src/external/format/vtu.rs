//! Particles of a problem, for ParaView.

use super::shape::{is_scalar, is_tensor};
use crate::external::problem::LevelProblem;
use crate::subject::StateField;
use crate::vtk::{TensorRank, points};

/// One vertex for each particle, at its position.
pub(super) fn written(problem: &LevelProblem) -> Vec<u8> {
    let rank = |name: &str| match name {
        name if is_scalar(name) => TensorRank::Scalar,
        name if is_tensor(name) => TensorRank::Tensor,
        _ => TensorRank::Vector,
    };
    let field = |(name, column): (&str, &[f64])| {
        let (name, components) = (name.to_owned(), problem.width(column));
        (rank(&name), StateField { name, components, numbers: column.to_vec() })
    };
    let fields: Vec<(TensorRank, StateField)> =
        problem.particles.columns().into_iter().map(field).collect();
    points(problem.dimension, &problem.particles.position, &fields)
}
