//! `problem --all` and `judge`: results of a solver in files.

use super::bar;
use super::program::{HELLO, SECOND_ORDER};
use crate::cli::{BAR, FAILED, Folder};
use crate::common::folder::{assert_contains, flat};
use rstest::rstest;
use serde_json::Value;
use std::fs::File;

/// Two levels of two and four particles, each with results at two times.
fn short() -> Folder {
    let suite = BAR.replace("[4, 6, 8, 12], ppc: 4", "[1, 2], ppc: 2");
    let folder = Folder::with("bar.yaml", suite.replace("until: 0.05", "until: 0.002"));
    folder.write("results/1.csv", TABLE);
    folder
}

const TABLE: &str = "t,X,u_x,v_x\n.001,.25,0,0\n.001,.75,0,0\n.002,.25,0,0\n.002,.75,0,0\n";

/// Replaces a part of [`TABLE`]; `*` stands for all of it.
#[rstest]
#[case(".75,0,0\n.0", ".75,abc,0\n.0", ":3:10", "`abc` is not a finite number")]
#[case(".75,0,0\n.0", ".75,NaN,0\n.0", ":3:10", "`NaN` is not a finite number")]
#[case("\n.002,.75,0", "\n.002,.75,-inf", ":5:10", "`-inf` is not a finite number")]
#[case("\n.002,.75,0", "\n.002,.75,1e999", ":5:10", "`1e999` is not a finite number")]
#[case("\n.002,.75,0", "\n.002,.75,1.5D-3", ":5:10", "expected a number such as 0.125")]
#[case("\n.002,.75", "\n.002,\".75\"", ":5:6", "without quotes")]
#[case("\n.002,.75", "\n.002,", ":5:6", "`` is not a finite number")]
#[case("\n.002,.75,0,0", "\n.002,.75,0", ":5:1", "found 3 cells, expected 4")]
#[case("\n.002,.75,0,0", "\n.002,.75,0,0,7", ":5:14", "found 5 cells")]
#[case("\n.002,.75", "\n.002,0,75", ":5:13", "expected points in numbers")]
#[case("*", "t;X;u_x\n0,001;0,25;0\n", ":1:1", "commas between them")]
#[case("*", "t\tX\tu_x\n", ":1:1", "unknown column `t\\u{9}X\\u{9}u_x`")]
#[case("t,X,u_x,v_x\n", "", ":1:1", "the first line has names")]
#[case("t,X", "t,\"X\"", ":1:3", "unknown column `\"X\"`")]
#[case("v_x", "V_x", ":1:9", "did you mean `v_x`?")]
#[case("v_x", "u_y", ":1:9", "unknown column `u_y`")]
#[case("X", "position_x", ":1:3", "unknown column `position_x`")]
#[case("v_x", "u_x", ":1:9", "column `u_x` is doubled")]
#[case("u_x", "F_xx", ":1:1", "lacks the displacement (`u_x`, ...)")]
#[case("X,u_x,v_x\n", "u_x,v_x,F_xx\n", ":1:1", "lacks either labels (`X`, ...)")]
#[case("v_x", "particle", ":1:1", "lacks either labels")]
#[case("t,X", "F_xx,X", ":1:1", "expected results at t = [0.001, 0.002]")]
#[case("\n.002,.75", "\n.003,.75", ":5:1", "the nearest one is t = 0.002, X = 0.75")]
#[case("\n.001,.75", "\n0,.75", ":3:1", "no row is expected for t = 0, X = 0.75")]
#[case("\n.002,.75", "\n.002,.25", ":5:1", "help: see line 4")]
#[case(
    "*",
    "t,X,u_x\n.001,.25,0\n.001,.25,0\n",
    ":3:1",
    "the row of t = 0.001, X = 0.25 is doubled"
)]
#[case("\n.002,.75,0,0", "", "", "there is no row for t = 0.002, X = 0.75")]
#[case("*", "t,X,u_x\n.001,.25,0\n.001,.75,0\n", "", "2 of 4 rows are missing")]
#[case("*", "t,X,u_x\n", "", "4 of 4 rows are missing")]
#[case("*", "", "", "the file is empty")]
#[case("*", "\u{feff}\n \r\n", "", "the file is empty")]
#[case("\n.002,.75", "\n.002,.8", ":5:6", "the nearest one is t = 0.002, X = 0.75")]
#[case("*", "t,X,u_x\n.001,250,0\n.001,750,0\n", ":2:6", "the labels look like mm")]
#[case("*", "t,particle,u_x\n.001,0,0\n", ":2:6", "the nearest one is t = 0.001, particle = 1")]
#[case("*", "t,particle,u_x\n.001,1.5,0\n", ":2:6", "for t = 0.001, particle = 1.5")]
#[case("*", "t,particle,u_x\n.001,1e300,0\n", ":2:6", "the nearest one is t = 0.00")]
#[case("*", "t,particle,u_x\n.001,-1,0\n", ":2:6", "the nearest one is t = 0.001, particle = 1")]
#[case("v_x\n", "weight\n", ":2:12", "expected a positive weight")]
fn invalid_table_is_refused(
    #[case] from: &str,
    #[case] to: &str,
    #[case] place: &str,
    #[case] message: &str,
) {
    let folder = short();
    let table = if from == "*" { to.to_owned() } else { TABLE.replacen(from, to, 1) };
    assert_ne!(table, TABLE);
    folder.write("results/1.csv", table);
    let errors = folder.refused(&["judge", "bar.yaml", "--from", "results"]);
    let place = format!("--> results/1.csv{place} ");
    assert_contains(&(flat(&errors) + " "), &[&place, message]);
    assert!(!errors.contains("as many rows"), "the other level has 8 rows: {errors}");
}

/// Each file replaces the results of the second level.
#[rstest]
#[case::of_another_level(TABLE.as_bytes(), "1.csv has as many rows as this file")]
#[case::not_text(
    b"t,X,u_x\n.001,\xff",
    "the file is not UTF-8 text: byte 13 does not fit --> results/2.csv:2:6"
)]
fn invalid_file_is_refused(#[case] bytes: &[u8], #[case] message: &str) {
    let folder = short();
    folder.write("results/2.csv", bytes);
    let errors = folder.refused(&["judge", "bar.yaml", "--from", "results"]);
    assert_contains(&flat(&errors), &[message]);
}

#[test]
fn results_that_are_not_there_are_refused() {
    let folder = short();
    let refused = |from: &str| flat(&folder.refused(&["judge", "bar.yaml", "--from", from]));
    let missing = "there is no such file --> results/2.csv = help: expected the files 1.csv, 2.csv";
    assert_contains(&refused("results"), &[missing]);
    assert_contains(&refused("elsewhere"), &["there is no such file --> elsewhere/1.csv"]);
    let file = File::create(folder.path().join("results/1.csv")).expect("a file");
    file.set_len((1 << 30) + 1).expect("a sparse file");
    assert_contains(&refused("results"), &["the file is too large: 1048577 KiB"]);
}

/// The script of a program with the protocol logs its states, which become files.
#[rstest]
#[case::particles("t,particle,u_x,v_x\n", false)]
#[case::labels_in_another_order("\u{feff}v_x,X,u_x,t\r\n", true)]
fn files_have_the_verdict_of_the_protocol(#[case] names: &str, #[case] has_labels: bool) {
    let folder = Folder::with("bar.yaml", bar());
    let solver = SECOND_ORDER
        .replace("HELLO", HELLO)
        .replace("\n        }'", "\n        }' > one-$$; cat one-$$ >> log-$$; cat one-$$");
    folder.write("solver.sh", solver);
    let run = ["run", "bar.yaml", "--gate", "--format", "json", "--solver", "sh solver.sh"];
    let expected = folder.accepted(&run);
    assert_eq!(folder.accepted(&["problem", "bar.yaml", "--all", "all"]), "wrote all/README.md\n");
    for file in folder.files(".").iter().filter(|file| file.starts_with("log-")) {
        let states = folder.read(file);
        let states: Vec<Value> =
            states.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
        let count = states[0]["columns"]["velocity"].as_array().map_or(0, Vec::len);
        let level = folder.read(&format!("all/{}.csv", count / 4));
        let labels: Vec<&str> =
            level.lines().skip(1).map(|line| line.split(',').next().expect("X")).collect();
        let mut rows = Vec::new();
        for (k, state) in states.iter().enumerate() {
            let t = 0.004 * (k + 1) as f64 / states.len() as f64;
            for p in 0..count {
                let [u, v] = ["displacement", "velocity"].map(|name| &state["columns"][name][p]);
                rows.push(if has_labels {
                    format!("{v},{},{u},{t}\r\n", labels[p])
                } else {
                    format!("{t},{},{u},{v}\n", p + 1)
                });
            }
        }
        rows.reverse();
        folder.write(&format!("results/{}.csv", count / 4), names.to_owned() + &rows.concat());
    }
    let judge = ["judge", "bar.yaml", "--gate", "--format", "json", "--from", "results"];
    let found = folder.accepted(&[&judge[..], &["--name", "odd"]].concat());
    assert_eq!(found.replace("results in results", "1"), expected);
    assert!(found.contains("\"verdict\": \"converging\""), "{found}");
}

#[test]
fn judged_quantity_without_a_column_is_not_applicable() {
    let folder = short();
    folder.write(
        "bar.yaml",
        folder.read("bar.yaml").replace("observe:", "judge: {of: velocity}\nobserve:"),
    );
    folder.write("results/2.csv", "t,particle,u_x\n.001,1,0\n.001,2,0\n.001,3,0\n.001,4,0\n.002,1,0\n.002,2,0\n.002,3,0\n.002,4,0\n");
    let found = folder.call(&["judge", "bar.yaml", "--from", "results", "--format", "json"]);
    assert_eq!(found.code, FAILED, "{}", found.errors);
    assert_contains(&found.out, &["the solver lacks columns: velocity"]);
}

#[test]
fn problem_does_not_replace_other_files() {
    let folder = short();
    let call = ["problem", "bar.yaml", "--all", "results"];
    let errors = folder.refused(&call);
    assert_contains(&errors, &["results/1.csv: this file exists with other content"]);
    assert_eq!(folder.files("results"), ["1.csv"]);
    for _ in 0..2 {
        folder.accepted(&["problem", "bar.yaml", "--all", "levels", "--format", "json"]);
    }
    assert_eq!(folder.files("levels"), ["1.json", "2.json", "README.md", "results"]);
}

/// The names have the numbers of `problem --level`.
#[test]
fn levels_of_a_refined_time_step_are_numbered_from_1() {
    let suite = BAR.replace("until: 0.05, dt: 1e-3", "until: 0.002");
    let suite = suite.replace("[4, 6, 8, 12], ppc: 4", "2, ppc: 2, dt: [1e-3, 5e-4]");
    let folder = Folder::with("bar.yaml", suite);
    folder.accepted(&["problem", "bar.yaml", "--all", "levels", "--format", "json"]);
    let level = ["problem", "bar.yaml", "--format", "json", "--level", "1"];
    assert_eq!(folder.read("levels/level-1.json"), folder.accepted(&level));
    assert_eq!(folder.files("levels"), ["README.md", "level-1.json", "level-2.json", "results"]);
}

#[test]
fn readme_describes_the_problem_its_levels_and_the_results() {
    let suite = super::handover::suite(2)
        .replace("ppc: 4}", "ppc: 4, full: [8]}")
        .replace("methods:", "judge: {of: deviatoric_stress}\nmethods:");
    let folder = Folder::with("body.yaml", suite);
    folder.accepted(&["problem", "body.yaml", "--all", "all files", "--full"]);
    let readme = folder.read("all files/README.md");
    let motion =
        |a: &str| format!("{a}*sin(pi*(X - 0.25)/1)*sin(pi*(Y - -0.5)/1.5)*(1 + 2*t + 3*t^2)");
    let level = |cells: u64, h: &str| {
        let (along, count) = (3 * cells / 2, 6 * cells * cells);
        format!(
            "- {cells}.csv: {count} particles; grid of {cells} x {along} cells of {h} m, lowest \
             corner (0.25, -0.5) m; 6 steps of 0.0029999999999999996 s; results after steps 2, 4, \
             6, at t = 0.005999999999999999, 0.011999999999999999, 0.018 s\n"
        )
    };
    let expected = format!(
        "## Problem\n\n\
         - body: (0.25, -0.5) to (1.25, 1) m, density 2 + X + 0.5*X*Y\n\
         - material: neo hookean, E = 30 Pa, nu = 0.3\n\
         - left: fixed\n- right: fixed\n- bottom: fixed\n- top: fixed\n\
         - gravity: (5*t, -9.81) [m/s2]\n\
         - initial stress: S0 with xx = 0.3 + X, yy = -0.4, xy = 0.2*Y [Pa], and P includes the \
         term F S0\n\
         - motion: {}, {}\n\
         - body force: manufactured, b = u_tt - Div P / rho0\n\
         - equation: neo-Hookean, rho0 u_tt = Div P + rho0 b, P = lambda ln(J) F^-T + mu (F - F^-T)\n\
         - amplitude: largest |u| 1.037e-1 m, largest |grad u| 3.258e-1\n\
         - dt: 0.003 s, rounded to whole steps\n\
         - instants: 3\n\
         - particles: 4 per cell, equally spaced\n\
         - further levels: 8 cells, with the option --full\n\
         - judged: rms error of the deviatoric stress\n\
         - crossing levels: counted\n\
         - material in SI units: neo_hookean, density = 3.875, young = 30, poisson = 0.3\n\n\
         ## Levels\n\n{}{}{}{}\n\
         Required columns of the results: t, X, Y, u_x, u_y, stress_xx, stress_xy, stress_yx, \
         stress_yy, stress_zz\n",
        motion("0.1"),
        motion("-0.06"),
        level(2, "0.5"),
        level(4, "0.25"),
        level(6, "0.16666666666666666"),
        level(8, "0.125"),
    );
    let (_, described) = readme.split_once("\n\n\n\n").expect("a heading and no text");
    let (described, results) = described.split_once("\n## Results").expect("results");
    assert_eq!(described, expected);
    let command = "\n    mpm-verify judge body.yaml --from 'all files/results' --gate --full\n";
    assert_contains(results, &[command]);
}
