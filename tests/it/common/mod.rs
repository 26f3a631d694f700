//! Helpers of several tests: folders, JSON Schemas and VTK files.

pub(crate) mod folder;
pub(crate) mod json_schema;
pub(crate) mod vtk;
