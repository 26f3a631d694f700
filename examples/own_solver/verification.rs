//! The suites of `suites/` as named tests of the solver: `cargo test --test own-solver`.

mod solver;
mod subject;

fn main() -> std::process::ExitCode {
    mpm_verify::testing::SuiteFolder::new("examples/own_solver/suites")
        .judging(subject::OwnSolver)
        .main()
}
