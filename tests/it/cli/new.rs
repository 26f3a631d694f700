//! `new`: suites that run without changes.

use super::{Folder, SOUND, assert_contains, refusals};
use mpm_verify::mpm::{BasisName, SchemeName, TransferName};
use rstest::rstest;
use serde_json::Value;

#[rstest]
fn new_suite_is_valid_and_has_an_order(
    #[values("1", "2", "3")] dimension: &str,
    #[values("linear_elastic", "neo_hookean", "hencky")] material: &str,
) {
    let folder = Folder::new();
    let made = folder.call(&["new", "first", "--dimension", dimension, "--material", material]);
    let said = "wrote first.yaml\nnext: mpm-verify check first.yaml\n";
    assert_eq!((made.code, made.out.as_str(), made.errors.as_str()), (SOUND, said, ""));
    folder.accepted(&["check", "--strict", "first.yaml"]);
    let run = folder.call(&["run", "--format", "json", "first.yaml"]);
    assert_eq!(run.code, SOUND, "{}{}", run.out, run.errors);
    let document: Value = serde_json::from_str(&run.out).expect("one document");
    let case = &document["suites"][0]["cases"][0];
    let order = case["observed_order"]["value"].as_f64().expect("an order");
    assert!((1.9..=2.1).contains(&order), "{order}");
    // In 3-D the order settles only on finer levels.
    assert!(case["verdict"] == "converging" || dimension == "3", "{}", case["verdict"]);
    let long = folder.read("first.yaml").lines().find(|line| line.len() > 100).map(str::to_owned);
    assert_eq!(long, None);
}

#[test]
fn defaults_apply_without_options() {
    let folder = Folder::new();
    folder.call(&["new", "first"]);
    let text = folder.read("first.yaml");
    assert_contains(
        &text,
        &[
            "  dimension: 1\n",
            "{neo_hookean: {young: E, poisson: nu, density: rho}}",
            "      basis: quadratic_bspline\n",
            "      transfer: flip\n",
            "      scheme: musl\n",
        ],
    );
}

#[test]
fn exact_solution_determines_the_default_material() {
    let folder = Folder::new();
    folder.call(&["new", "wave", "--truth", "standing_wave"]);
    assert!(folder.read("wave.yaml").contains("{linear_elastic: "));
    folder.call(&["new", "motion", "--truth", "manufactured"]);
    assert!(folder.read("motion.yaml").contains("{neo_hookean: "));
}

#[test]
fn solution_that_does_not_fit_the_material_is_refused() {
    let folder = Folder::new();
    let calls = [
        "new first --truth manufactured --material linear_elastic",
        "new first --truth standing_wave --material hencky",
    ];
    insta::assert_snapshot!(refusals(&folder, &calls), @"
    new first --truth manufactured --material linear_elastic
    error: --truth manufactured: a force cannot be manufactured for `linear_elastic`: a law in rate form does not compute its stress from the deformation
    new first --truth standing_wave --material hencky
    error: --truth standing_wave: `hencky` has no standing wave, because waves of finite strain steepen: use `linear_elastic`
    ");
    assert!(folder.files(".").is_empty());
}

/// Every combination of offered choices gives a suite, or is refused as an invalid combination.
#[test]
fn every_offered_choice_gives_a_valid_suite() {
    let bases = BasisName::ALL.iter().map(|basis| ("--basis", basis.name()));
    let transfers = TransferName::ALL.iter().map(|transfer| ("--transfer", transfer.name()));
    let schemes = SchemeName::ALL.iter().map(|scheme| ("--scheme", scheme.name()));
    let folder = Folder::new();
    for (option, value) in bases.chain(transfers).chain(schemes) {
        let name = format!("first-{}", value.replace('_', "-"));
        folder.accepted(&["new", &name, option, value]);
        assert!(folder.read(&format!("{name}.yaml")).contains(&format!(": {value}\n")), "{value}");
    }
}

#[test]
fn options_accept_lists_and_parameters_in_suite_notation() {
    let folder = Folder::new();
    let basis = ["--basis", "[linear, cpdi]", "--transfer", "{fmpm: 8}"];
    folder.accepted(&[&["new", "first"], basis.as_slice()].concat());
    assert!(folder.call(&["check", "first.yaml"]).out.contains("sound, 2 cases"));
}

#[test]
fn proposals_for_a_new_suite_are_valid_expectations() {
    let folder = Folder::new();
    folder.call(&["new", "first", "--output", "suites of mine.yaml"]);
    let path = "suites of mine.yaml";
    let proposed = folder.call(&["propose", path]);
    folder.write(path, folder.read(path) + &proposed.out);
    let out = folder.accepted(&["run", "--brief", path]);
    assert_contains(&out, &["  pass  first::"]);
    let checked = folder.call(&["check", "--strict", path]);
    assert_eq!(checked.code, SOUND, "{}", checked.errors);
}

#[test]
fn existing_file_is_not_changed() {
    let folder = Folder::with("first.yaml", "mine");
    let errors = folder.refused(&["new", "first"]);
    insta::assert_snapshot!(errors, @"error: first.yaml already exists and is not overwritten; choose another file with --output");
    assert_eq!(folder.read("first.yaml"), "mine");
}

#[rstest]
#[case::basis(&["first", "--basis", "quadratc_bspline"], "--basis:1:1", "`quadratic_bspline`?")]
#[case::transfer(&["first", "--transfer", "flp"], "--transfer:1:1", "did you mean `flip`?")]
#[case::scheme(&["first", "--scheme", "muls"], "--scheme:1:1", "did you mean `musl`?")]
#[case::one_of_a_list(&["first", "--basis", "[linear, cpdy]"], "--basis:1:10", "`cpdi`?")]
#[case::out_of_range(&["first", "--transfer", "{fmpm: 0}"], "--transfer:1:", "expected a whole")]
#[case::nothing(&["first", "--basis", ""], "--basis", "expected")]
#[case::material(&["first", "--material", "neo_hooken"], "--material", "'neo_hookean'")]
#[case::dimension(&["first", "--dimension", "4"], "--dimension", "1, 2, 3")]
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
