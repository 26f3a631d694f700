//! The command line of the doctor. The solver is a script that moves every particle with its
//! initial velocity.

use crate::cli::{BAD_INPUT, FAILED, Folder};
use crate::common::folder::flat;
use crate::external::program::HELLO;

/// A solver that is exact for translation only, with an acceleration of `G`.
const MOVER: &str = r#"
read -r m; echo 'HELLO'
read -r problem || exit 0
case "$problem" in *'"bye"'*) exit 0;; esac
echo '{"type":"ready"}'
while read -r m; do
    case "$m" in *'"bye"'*) exit 0;; esac
    printf '%s\n%s\n' "$problem" "$m" | awk '
        function number(name, rest) {
            rest = substr($0, index($0, "\"" name "\":") + length(name) + 3)
            return rest + 0
        }
        NR == 1 {
            x = substr($0, index($0, "\"velocity\":[") + 12)
            n = split(substr(x, 1, index(x, "]") - 1), V, ",")
        }
        NR == 2 {
            t = number("from") + number("steps") * number("dt")
            for (p = 1; p <= n; p++) {
                u = u (p > 1 ? "," : "") sprintf("%.17g", V[p] * t + G * t * t / 2)
                v = v (p > 1 ? "," : "") sprintf("%.17g", V[p] + G * t)
            }
            printf "{\"type\":\"state\",\"columns\":{\"displacement\":[%s],\"velocity\":[%s]}}\n", u, v
        }'
done
"#;

/// Runs the doctor on a script.
fn call(script: &str, more: &[&str]) -> (i32, String, String) {
    let folder = Folder::new();
    folder.write("solver.sh", script.replace("HELLO", HELLO));
    let mut arguments = vec!["doctor", "--solver", "sh solver.sh"];
    arguments.extend(more);
    let found = folder.call(&arguments);
    (found.code, found.out, found.errors)
}

#[test]
fn built_in_gravity_of_a_program_is_reported() {
    let (code, out, errors) = call(&MOVER.replace('G', "9.81"), &[]);
    assert_eq!(code, FAILED, "{out}{errors}");
    let out = flat(&out);
    for words in ["solver: odd", "gravity-left-on", "an acceleration of (9.810) m/s2"] {
        assert!(out.contains(words), "no `{words}` in\n{out}");
    }
    assert!(
        out.contains(
            "verdict: gravity-left-on; 1 not applicable; 26 skipped until all defects are corrected"
        ),
        "{out}"
    );
    assert!(errors.contains("examining: rest"), "{errors}");
    assert!(out.contains("skipped (26)") && out.contains("next: mpm-verify doctor --verbose"));
}

#[test]
fn json_report_has_the_same_findings() {
    let (code, out, _) = call(&MOVER.replace('G', "0"), &["--format", "json"]);
    assert_eq!(code, FAILED, "{out}");
    let report: serde_json::Value = serde_json::from_str(&out).expect("JSON");
    let of = |name: &str| {
        let all = report["examinations"].as_array().expect("examinations");
        all.iter().find(|made| made["examination"] == name).expect("an examination").clone()
    };
    assert_eq!(of("translation")["findings"], serde_json::json!([]));
    assert_eq!(of("stress")["findings"][0]["name"], "stress-missing");
    assert_eq!(of("fall")["result"], "not_applicable");
    assert_eq!(of("fall")["lacks"], "loads: gravity");
    assert_eq!(of("walls")["after"], "stress");
    assert_eq!(report["not_examined"], serde_json::json!([]));
}

/// A capability that no examination covers is listed with the suites that test it.
#[test]
fn claimed_capabilities_without_an_examination_are_listed() {
    let claiming =
        HELLO.replace(r#""capabilities":{"#, r#""capabilities":{"varying_density":true,"#);
    let script = MOVER.replace("HELLO", &claiming).replace('G', "0");
    let (_, out, _) = call(&script, &["--format", "json"]);
    let report: serde_json::Value = serde_json::from_str(&out).expect("JSON");
    let unexamined = &report["not_examined"];
    assert_eq!(unexamined.as_array().map(Vec::len), Some(1), "{unexamined}");
    assert_eq!(unexamined[0]["capability"], "varying_density");
    let (_, out, _) = call(&script, &["--verbose"]);
    let out = flat(&out);
    assert!(out.contains("claimed, not examined: - varying_density; "), "{out}");
    assert!(out.contains("1 claimed capabilities not examined"), "{out}");
}

#[test]
fn terminated_program_cannot_be_examined() {
    let (code, out, _) = call("read -r m; echo 'HELLO'; read -r m; exit 3", &[]);
    assert_eq!(code, BAD_INPUT, "{out}");
    let flat = flat(&out);
    let words = "verdict: odd cannot be examined: step 1 of 6: the solver ended without an answer \
                 (exit status 3)";
    assert!(flat.contains(words), "{out}");
}

#[test]
fn program_without_capabilities_cannot_be_examined() {
    let poor = HELLO.replace(r#""dimensions":[1]"#, r#""dimensions":[]"#);
    let (code, out, _) = call(&MOVER.replace("HELLO", &poor).replace('G', "0"), &[]);
    assert_eq!(code, BAD_INPUT, "{out}");
    let words = "cannot be examined: the solver does not support the simplest problem, a body \
                 whose faces are all free: dimensions: 2";
    assert!(out.replace('\n', " ").contains(words), "{out}");
}

#[test]
fn a_command_that_does_not_start_is_bad_input() {
    let folder = Folder::new();
    assert_eq!(folder.call(&["doctor"]).code, BAD_INPUT);
    let found = folder.call(&["doctor", "--solver", "true"]);
    assert_eq!(found.code, BAD_INPUT);
    assert!(found.errors.contains("ended without an answer"), "{}", found.errors);
}
