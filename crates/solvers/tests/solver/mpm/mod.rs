//! Parts of the solver, tested through their public interfaces.

mod dispersion;
mod heat;
mod kernel;
mod laws;
mod null_space;
mod quasi_static;
mod reaction;
mod second_opinion;
mod stable_time_step;
mod traction;
mod volume_average;
