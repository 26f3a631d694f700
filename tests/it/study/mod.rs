//! Studies, run through their runner.

mod interrupted;
mod predicted_error;
mod preflight;
