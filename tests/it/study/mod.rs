//! Studies, which run through their runner.

mod causes;
mod diagnosis;
mod error_scale;
mod fine_grid;
mod foundation;
mod keys;
mod polygons;
mod preflight;
mod single_precision;
