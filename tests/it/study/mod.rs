//! Studies, run through their runner.

mod interrupted;
