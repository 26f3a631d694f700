//! Creates solvers from the model, and converts the names in the model to types.

pub(crate) mod bar;
pub(crate) mod body;
pub(crate) mod dispatch;
pub(crate) mod initial_state;
