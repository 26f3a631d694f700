//! A face of a body, with the condition on the motion there.

use super::condition::Condition;
use std::sync::Arc;

/// One face of a box-shaped body.
#[derive(Debug, Clone)]
pub struct Face {
    /// Name that a suite gives it.
    pub name: &'static str,
    /// Axis of its normal.
    pub axis: usize,
    /// Whether it is the face with the larger coordinate.
    pub high: bool,
    /// Length (m) of the axis on which the body moves: a period, where the axis has no end. It is
    /// that of the body itself, unless a periodic body starts deformed.
    pub period: f64,
    /// Condition on the motion there.
    pub condition: Arc<dyn Condition>,
}
