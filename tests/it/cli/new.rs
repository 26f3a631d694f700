//! `new`: suites that run without changes.

use super::{Folder, SOUND, assert_contains};
use mpm_verify::mpm::{BasisName, SchemeName, TransferName};
use rstest::rstest;

#[rstest]
fn new_suite_is_valid_and_has_an_order(#[values("1", "2", "3")] dimension: &str) {
    let folder = Folder::new();
    let made = folder.call(&["new", "first", "--dimension", dimension]);
    let said = "wrote first.yaml\nnext: mpm-verify check first.yaml\n";
    assert_eq!((made.code, made.out.as_str(), made.errors.as_str()), (SOUND, said, ""));
    folder.accepted(&["check", "--strict", "first.yaml"]);
    let document = super::json::document(&folder, &["first.yaml"], SOUND);
    let case = &document["suites"][0]["cases"][0];
    let order = case["observed_order"]["value"].as_f64().expect("an order");
    assert!((1.9..=2.1).contains(&order), "{order}");
    // In 3-D the order settles only on finer levels.
    assert!(case["verdict"] == "converging" || dimension == "3", "{}", case["verdict"]);
    let text = folder.read("first.yaml");
    assert_eq!(text.lines().find(|line| line.len() > 100), None);
    // The material that a comment names is valid too.
    folder.write("first.yaml", text.replace("{neo_hookean: ", "{hencky: "));
    folder.accepted(&["check", "--strict", "first.yaml"]);
}

/// The suite lists the names of all methods, and is valid with each of them.
#[test]
fn every_listed_method_gives_a_valid_suite() {
    let (bases, transfers, schemes) = (
        BasisName::ALL.iter().map(|basis| ("basis: quadratic_bspline", basis.name())),
        TransferName::ALL.iter().map(|transfer| ("transfer: flip", transfer.name())),
        SchemeName::ALL.iter().map(|scheme| ("scheme: musl", scheme.name())),
    );
    let folder = Folder::new();
    folder.accepted(&["new", "first"]);
    let text = folder.read("first.yaml");
    for (default, name) in bases.chain(transfers).chain(schemes) {
        let (key, _) = default.split_once(' ').expect("a key");
        assert!(text.contains(name) && text.contains(default), "{name}");
        folder.write("first.yaml", text.replace(default, &format!("{key} {name}")));
        folder.accepted(&["check", "first.yaml"]);
    }
}

#[test]
fn existing_file_is_not_changed() {
    let folder = Folder::with("first.yaml", "mine");
    let errors = folder.refused(&["new", "first"]);
    insta::assert_snapshot!(errors, @"error: first.yaml already exists and is not overwritten; choose another file with --output");
    assert_eq!(folder.read("first.yaml"), "mine");
    folder.accepted(&["new", "first", "--output", "suites of mine.yaml"]);
    folder.accepted(&["check", "--strict", "suites of mine.yaml"]);
}

#[rstest]
#[case::dimension(&["first", "--dimension", "4"], "--dimension", "4 is not in 1..=3")]
#[case::capitals(&["First"], "NAME:1:1", "expected lower-case letters, digits and hyphens")]
#[case::a_path(&["../first"], "NAME:1:1", "this is not a name for a suite")]
#[case::quotes(&["a\"b"], "NAME:1:1", "this is not a name for a suite")]
#[case::no_name(&[""], "NAME:1:1", "this is not a name for a suite")]
#[case::no_folder(&["first", "--output", "none/first.yaml"], "none/first.yaml", "error: ")]
fn invalid_option_is_reported_with_its_position(
    #[case] words: &[&str],
    #[case] place: &str,
    #[case] help: &str,
) {
    let folder = Folder::new();
    let errors = folder.refused(&[&["new"], words].concat());
    assert_contains(&errors, &[place, help]);
    assert!(folder.files(".").is_empty());
}

/// YAML must not read such names as values of another type.
#[rstest]
fn names_that_look_like_numbers_are_names(#[values("2", "1e3", "true", "null")] name: &str) {
    let folder = Folder::new();
    folder.accepted(&["new", name]);
    let listed = folder.call(&["list", &format!("{name}.yaml")]);
    assert!(listed.out.starts_with(&format!("{name}: ")), "{}{}", listed.out, listed.errors);
}
