//! Creates subjects from the model: converts names to types.

pub(crate) mod bar;
pub(crate) mod body;
pub(crate) mod dispatch;
pub(crate) mod initial_state;
