//! From the model to subjects: names become types.

pub(crate) mod bar;
pub(crate) mod body;
pub(crate) mod dispatch;
pub(crate) mod initial_state;
