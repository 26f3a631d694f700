//! `run --format latex`, `--junit` and the files of `--out`, and the figures of `cost`: results for
//! papers and continuous integration.

use super::{BAR, FAILED, Folder, SOUND, assert_refusals};

/// XML forbids U+FFFE and U+FFFF, which JSON allows in the answer of a solver.
#[test]
fn junit_has_no_forbidden_characters() {
    let folder = Folder::with("bar.yaml", BAR);
    let script = r#"read -r m; echo '{"type":"hello","protocol":1,"name":"odd","version":"1","capabilities":{"dimensions":[1],"laws":["linear_elastic"],"conditions":["free","fixed"]}}'
while read -r m; do echo '{"type":"cannot","reason":"no \ufffe, no \uffff, no \u0001"}'; done"#;
    folder.write("solver.sh", script);
    let run = ["run", "bar.yaml", "--solver", "sh solver.sh", "--gate", "--junit", "junit.xml"];
    folder.call(&run).ended(FAILED);
    let xml = folder.read("junit.xml");
    let report = quick_junit::Report::deserialize_from_str(&xml).unwrap();
    let (suite, whole) = (&report.test_suites[0], report.time.unwrap());
    let is_timed = suite.time.is_some_and(|time| !time.is_zero() && time <= whole);
    assert!(is_timed && suite.timestamp == report.timestamp, "{xml}");
    assert!(xml.contains("no \u{fffd}, no \u{fffd}, no "), "{xml}");
    assert!(!xml.contains(['\u{1}', '\u{fffe}', '\u{ffff}']), "{xml}");
}

#[test]
fn a_folder_of_results_has_tables_and_sources_of_figures() {
    let folder = Folder::with("bar.yaml", BAR);
    let printed = folder.accepted(&["run", "bar.yaml", "--out", "new/out"]);
    let read = |file: &str| folder.read(&format!("new/out/{file}"));
    assert!(printed.contains(&read("short-bar.txt")), "{printed}");
    for figure in ["short-bar", "short-bar-work-transfers"] {
        let tex = read(&format!("{figure}.tex"));
        assert!(tex.ends_with("\\end{tikzpicture}\n\\end{document}\n"), "{tex}");
        assert!(read(&format!("{figure}.svg")).starts_with("<svg "));
    }
    for (format, start) in [("csv", "suite,case,"), ("json", "{")] {
        let printed = folder.accepted(&["run", "bar.yaml", "--format", format]);
        assert!(printed.starts_with(start) && read(&format!("report.{format}")) == printed);
    }
    assert!(read("short-bar-table.tex").contains("\\begin{tabular}"));
}

#[test]
fn titles_and_labels_change_only_tables_and_figures() {
    let folder = Folder::with("bar.yaml", BAR);
    let labels = ["--title", "Bar of E = 1", "--label", "mpm-linear-flip-musl=MPM"];
    let out = ["run", "bar.yaml", "--out", "out", "--format", "latex"];
    let answer = folder.call(&[&out[..], &labels].concat());
    assert_eq!((answer.code, answer.errors.as_str()), (SOUND, "wrote out\n"));
    for text in [&answer.out, &folder.read("out/short-bar.tex"), &folder.read("out/short-bar.svg")]
    {
        assert!(text.contains("Bar of E = 1") && text.contains("MPM"), "{text}");
        assert!(!text.contains("mpm-linear-flip-musl"), "{text}");
    }
    let report = folder.read("out/short-bar.txt");
    assert!(report.contains("mpm-linear-flip-musl") && !report.contains("Bar of E"), "{report}");
}

#[test]
fn invalid_labels_are_refused() {
    let expected = "
$ run bar.yaml --label mpm-linear-flip-mus=a
error: --label mpm-linear-flip-mus: no case has this name; did you mean `mpm-linear-flip-musl`?
$ run bar.yaml --label fem-linear-lumped=a --label mpm-linear-flip-musl=a
error: --label a: another case has this label
$ run bar.yaml --label a
error: invalid value 'a' for '--label <CASE=TEXT>': expected the name of a case, `=` and a text
";
    assert_refusals(&Folder::with("bar.yaml", BAR), expected);
}

/// With twice the stable time step a method fails. Its levels must still be in the table.
#[test]
fn failed_level_has_a_row_in_the_costs() {
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
