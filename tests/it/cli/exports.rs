//! `run --format csv`, `--format latex`, `--junit` and the files of `--out`: results for papers,
//! spreadsheets and continuous integration.

use super::{BAD_INPUT, BAR, FAILED, Folder, SOUND, ambitious};
use rstest::rstest;
use serde_json::Value;
use std::collections::BTreeMap;

/// Returns the value in a JSON document that a column name such as `errors.rms` refers to.
fn member<'a>(row: &'a Value, column: &str) -> &'a Value {
    column.split('.').fold(row, |value, key| match key.parse::<usize>() {
        Ok(index) => &value[index],
        Err(_) => &value[key],
    })
}

#[test]
fn csv_contains_each_number_of_the_json() {
    let folder = Folder::new();
    let run = |format: &str| folder.accepted(&["run", "vibrating-bar", "--format", format]);
    let document: Value = serde_json::from_str(&run("json")).unwrap();
    let csv = run("csv");
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let rows: Vec<BTreeMap<String, String>> =
        reader.deserialize().collect::<Result<_, _>>().unwrap();
    let cases = document["suites"][0]["cases"].as_array().unwrap();
    let levels: Vec<(&Value, &Value)> = cases
        .iter()
        .flat_map(|case| case["levels"].as_array().unwrap().iter().map(move |level| (case, level)))
        .collect();
    assert_eq!(rows.len(), levels.len());
    let mut numbers = 0;
    for (row, (case, level)) in rows.iter().zip(levels) {
        for (column, field) in row.iter().filter(|(column, _)| *column != "suite") {
            let value = [case, level].map(|of| member(of, column));
            let value = value.into_iter().find(|value| !value.is_null()).unwrap_or(&Value::Null);
            match value {
                Value::Null => assert_eq!(field, "", "{column}"),
                Value::String(text) => assert_eq!(field, text, "{column}"),
                Value::Number(number) => {
                    numbers += 1;
                    let read: f64 = field.parse().unwrap();
                    assert_eq!(Some(read.to_bits()), number.as_f64().map(f64::to_bits), "{column}");
                }
                other => assert_eq!(*field, other.to_string(), "{column}"),
            }
        }
    }
    assert!(numbers > 500, "{numbers}");
}

#[test]
fn suite_without_levels_has_its_own_rows() {
    let csv = Folder::new().accepted(&["run", "grid-crossing", "--format", "csv"]);
    let mut lines = csv.lines();
    let head = lines.next().unwrap();
    assert!(head.starts_with("suite,case,") && head.contains(",forces.force,"), "{head}");
    assert!(lines.count() > 10, "{csv}");
}

#[test]
fn a_latex_table_has_errors_and_orders() {
    let folder = Folder::with("bar.yaml", BAR);
    let table = folder.accepted(&["run", "bar.yaml", "--format", "latex"]);
    insta::assert_snapshot!(table, @r#"
    % Written by mpm-verify 0.1.0. Needs \usepackage{booktabs}.
    \begin{table}
      \centering
      \caption{Short bar: rms error of displacement at the end (m).}
      \label{tab:short-bar}
      \begin{tabular}{rrrrr}
        \toprule
        & \multicolumn{2}{c}{mpm-linear-flip-musl} & \multicolumn{2}{c}{fem-linear-lumped} \\
        \cmidrule(lr){2-3} \cmidrule(lr){4-5}
        cells & error & order & error & order \\
        \midrule
        $4$ & $7.205 \times 10^{-7}$ & -- & $4.062 \times 10^{-7}$ & -- \\
        $6$ & $3.206 \times 10^{-7}$ & $2.00$ & $1.800 \times 10^{-7}$ & $2.01$ \\
        $8$ & $1.800 \times 10^{-7}$ & $2.01$ & $1.008 \times 10^{-7}$ & $2.02$ \\
        $12$ & $7.940 \times 10^{-8}$ & $2.02$ & $4.417 \times 10^{-8}$ & $2.03$ \\
        \midrule
        order (95\,\%) & \multicolumn{2}{c}{$2.01$ [$1.99$, $2.02$]} & \multicolumn{2}{c}{$2.02$ [$2.00$, $2.04$]} \\
        \bottomrule
      \end{tabular}
    \end{table}
    "#);
}

#[test]
fn junit_has_one_test_for_each_case() {
    let folder = Folder::with("bar.yaml", ambitious());
    folder.write("good.yaml", BAR);
    folder.call(&["run", "bar.yaml", "good.yaml", "--junit", "out/junit.xml"]).ended(FAILED);
    let xml = folder.read("out/junit.xml");
    let report = quick_junit::Report::deserialize_from_str(&xml).unwrap();
    assert_eq!((report.tests, report.failures, report.test_suites.len()), (4, 2, 2), "{xml}");
    assert!(xml.contains("with the order within [2.90, 3.10]"), "{xml}");
    let (start, whole) = (report.timestamp.unwrap(), report.time.unwrap());
    assert!(!whole.is_zero(), "{xml}");
    for suite in &report.test_suites {
        assert!(suite.timestamp == Some(start) && suite.time.unwrap() <= whole, "{xml}");
    }
}

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
    quick_junit::Report::deserialize_from_str(&xml).unwrap();
    assert!(xml.contains("no \u{fffd}, no \u{fffd}, no "), "{xml}");
    assert!(!xml.contains(['\u{1}', '\u{fffe}', '\u{ffff}']), "{xml}");
}

#[test]
fn files_that_cannot_be_written_are_named_before_the_run() {
    let folder = Folder::with("bar.yaml", BAR);
    folder.write("folder/file", "");
    let answer = folder.call(&["run", "bar.yaml", "--junit", "folder"]).ended(BAD_INPUT);
    insta::assert_snapshot!(answer.errors, @"error: --junit folder: this is a folder");
    assert_eq!(answer.out, "");
}

#[test]
fn a_folder_of_results_has_tables_and_sources_of_figures() {
    let folder = Folder::with("bar.yaml", BAR);
    folder.call(&["run", "bar.yaml", "--out", "out"]).ended(SOUND);
    for figure in ["short-bar", "short-bar-work-transfers"] {
        let tex = folder.read(&format!("out/{figure}.tex"));
        assert!(tex.ends_with("\\end{tikzpicture}\n\\end{document}\n"), "{tex}");
        assert!(folder.read(&format!("out/{figure}.svg")).starts_with("<svg "));
    }
    assert!(folder.read("out/report.csv").starts_with("suite,case,"));
    assert!(folder.read("out/short-bar-table.tex").contains("\\begin{tabular}"));
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

#[rstest]
#[case(
    "--label|mpm-linear-flip-mus=a",
    "error: --label mpm-linear-flip-mus: no case has this name; did you mean `mpm-linear-flip-musl`?"
)]
#[case(
    "--label|fem-linear-lumped=a|--label|mpm-linear-flip-musl=a",
    "error: --label a: another case has this label"
)]
#[case(
    "--label|a",
    "error: invalid value 'a' for '--label <CASE=TEXT>': expected the name of a case, `=` and a text"
)]
fn invalid_labels_are_refused(#[case] options: &str, #[case] error: &str) {
    let folder = Folder::with("bar.yaml", BAR);
    let options: Vec<&str> = options.split('|').collect();
    let errors = folder.refused(&[&["run", "bar.yaml"], &options[..]].concat());
    assert_eq!(errors.lines().next(), Some(error), "{errors}");
}
