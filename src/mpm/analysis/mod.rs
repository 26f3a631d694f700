//! Analyses of a solver: its stable time step, its null space, and the dispersion and damping of
//! waves in closed form.

pub(crate) mod dispersion;
pub(crate) mod null_space;
pub(crate) mod stable_time_step;
pub(crate) mod wave_symbols;
