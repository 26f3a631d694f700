//! The names that most examinations use.

pub(super) use super::course::{
    AffineField, Course, Field, displacement, largest_difference, line, shown, shown_list,
    shown_vector, transposed, velocity,
};
pub(super) use super::finding::{FindingWeight, SolverFinding};
pub(super) use super::patient::{Examination, Examined, Hindrance, Patient, complete};
pub(super) use super::rules::{ANY, Pattern, Row, Rules};
pub(super) use super::scene::{ANY_LAW, BoxScene, ELASTIC, FINITE, H, Kind};
pub(super) use crate::testing::change::FACES;
pub(super) use nalgebra::Vector3;
