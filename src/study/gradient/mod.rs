//! Gradient studies: derivatives of a differentiable solver, compared with its own values, with
//! exact sensitivities, and over an interval of a parameter.

mod exact;
mod run;
mod runner;
