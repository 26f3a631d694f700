//! Constitutive laws as the truth knows them, written apart from those of the solver.

pub(crate) mod plastic;
