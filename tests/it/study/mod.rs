//! Studies, run through their runner.

mod diagnosis;
mod interrupted;
mod predicted_error;
mod preflight;
