//! `mpm-verify schema`: JSON Schemas.

use super::args::{SchemaArgs, SchemaName};
use super::output;
use super::status::PASSED;
use mpm_verify::external::protocol_schema;
use mpm_verify::report::report_schema;
use mpm_verify::suite::suite_schema;

/// Prints the schema that the command line names.
pub(super) fn schema(args: &SchemaArgs) -> u8 {
    output::print(&match args.of {
        SchemaName::Suite => suite_schema(),
        SchemaName::Json => report_schema(),
        SchemaName::Protocol => protocol_schema(),
    });
    PASSED
}
