//! `cost`: the cost of accuracy on this machine. Times differ from run to run; the tests check only
//! what is the same in all runs.

use super::{BAR, Folder, assert_contains};

/// With twice the stable time step a method fails. Its levels must still be in the table.
#[test]
fn failed_level_has_a_row() {
    let folder = Folder::with(
        "bar.yaml",
        BAR.replace("until: 0.05, dt: 1e-3", "until: 4, dt: \"0.16*h\", instants: 1"),
    );
    let out = folder.accepted(&["cost", "bar.yaml", "--figures", "figures"]);
    let broken = out.lines().filter(|line| line.split_whitespace().any(|w| w == "failed"));
    assert!(broken.count() > 0, "{out}");
    let figure = folder.read("figures/short-bar-work-transfers.svg");
    assert!(figure.contains("failed or not finite"));
    assert!(folder.files("figures").contains(&"short-bar-work-seconds.svg".to_owned()));
}

#[test]
fn unwritable_folder_is_refused() {
    let folder = Folder::with("bar.yaml", BAR);
    let errors = folder.refused(&["cost", "bar.yaml", "--figures", "bar.yaml/x"]);
    assert_contains(&errors, &["--figures bar.yaml/x: "]);
}
