//! Parts of the solver, by their public interfaces.

mod kernel;
