//! Dispersion and damping in closed form: figures of an independent derivation, and the solver.

mod figures;
mod solver;
