//! `mpm-verify merge`.

use super::args::MergeArgs;
use super::output;
use super::run::{Judging, report, threads};
use super::status::BAD_INPUT;
use mpm_verify::study::ResultCache;

/// Reports what the parts of a run have found, as one run of all would.
pub(super) fn merge(args: &MergeArgs) -> u8 {
    if let Err(message) = threads(args.report.jobs) {
        output::complain(&message);
        return BAD_INPUT;
    }
    match ResultCache::of_parts(&args.from) {
        Ok(parts) => report(&args.report, |suites| Ok((suites, Judging::of_kept(parts)))),
        Err((folder, error)) => {
            output::complain(&format!("error: --from {}: {error}", folder.display()));
            BAD_INPUT
        }
    }
}
