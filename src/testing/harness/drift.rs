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

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// Whoever has planted a change by hand is told which file, and how a change is accepted.
    #[test]
    fn a_difference_says_which_file_and_how_it_is_accepted() {
        let folder = std::env::temp_dir().join(format!("mpm-verify-drift-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        let said = |suite: &str| {
            let failed = compare(suite, "error  1.0e-3\n", &folder).expect_err("a difference");
            failed.message().unwrap_or_default().to_owned()
        };
        fs::write(folder.join("bar.snap"), "---\n---\nerror  1.1e-3\n").expect("a snapshot");
        let (kept, new) = (said("bar"), said("beam"));
        fs::remove_dir_all(&folder).expect("the folder");
        assert!(kept.starts_with("the report of bar has drifted from "), "{kept}");
        assert!(kept.contains("`INSTA_UPDATE=always cargo test bar`"), "{kept}");
        assert!(new.starts_with("the report of beam is not yet kept as "), "{new}");
    }
}
