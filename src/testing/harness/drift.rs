//! Reports against their snapshots.

use crate::report;
use insta::{Comparator, Settings, Snapshot, assert_snapshot};
use libtest_mimic::Failed;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, absolute};

/// Compares the report of the suite called `suite` with the snapshot of its name in `folder`.
pub(super) fn compare(suite: &str, text: &str, folder: &Path) -> Result<(), Failed> {
    let mut settings = Settings::clone_current();
    settings.set_snapshot_path(absolute(folder)?);
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_comparator(Box::new(ReportDrift));
    let compare = || assert_snapshot!(suite, text);
    let outcome = catch_unwind(AssertUnwindSafe(|| settings.bind(compare)));
    outcome.map_err(|_| {
        let file = folder.join(format!("{suite}.snap"));
        let what = if file.exists() { "has drifted from" } else { "is not yet kept as" };
        format!(
            "the report of {suite} {what} {} (the difference stands above).\nIf the change is \
             meant, accept it with `cargo insta review`, or with `INSTA_UPDATE=always cargo test \
             {suite}`, and say in the commit why it moved.",
            file.display()
        )
        .into()
    })
}

/// Compares reports number by number; see [`report::drift`].
#[derive(Clone)]
struct ReportDrift;

impl Comparator for ReportDrift {
    fn matches(&self, reference: &Snapshot, test: &Snapshot) -> bool {
        match (reference.as_text(), test.as_text()) {
            (Some(old), Some(new)) => report::drift::same(&old.to_string(), &new.to_string()),
            _ => false,
        }
    }

    fn dyn_clone(&self) -> Box<dyn Comparator> {
        Box::new(self.clone())
    }
}
