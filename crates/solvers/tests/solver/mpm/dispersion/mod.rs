//! Dispersion and damping in closed form, compared with an independent derivation and with the
//! solver.

mod figures;
mod solver;
