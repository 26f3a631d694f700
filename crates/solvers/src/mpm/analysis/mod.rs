//! Analyses of a solver: its stable time step, its null space, the dispersion and damping of waves
//! in closed form, and the force on a node that a particle crosses.

pub(crate) mod crossing_force;
pub(crate) mod dispersion;
pub(crate) mod null_space;
pub(crate) mod stable_time_step;
pub(crate) mod wave_symbols;
