//! Reports as LaTeX tables, for papers.

use crate::report::columns::level::{self, LevelRow, NamedStudy};
use crate::verify::{Axis, CaseOutcome, SuiteOutcome, Verdict, grouped};
use std::fmt::Write;

/// Maximum number of cases per table, limited by the width of a page.
const MOST_CASES: usize = 3;

/// Writes the errors and orders of convergence studies as tables in the style of `booktabs`.
///
/// Each table has a row for each level and two columns for each case. Cases with different levels
/// or different judged errors are in different tables. Suites without a convergence study have no
/// table. The text requires `\usepackage{booktabs}` and no other package.
pub fn latex(outcomes: &[SuiteOutcome]) -> String {
    let tables = outcomes.iter().flat_map(tables).collect::<Vec<_>>().join("\n");
    let version = env!("CARGO_PKG_VERSION");
    format!("% Written by mpm-verify {version}. Needs \\usepackage{{booktabs}}.\n{tables}")
}

fn tables(outcome: &SuiteOutcome) -> Vec<String> {
    let studies = outcome.results(CaseOutcome::convergence);
    let compared = studies.filter(|(_, study)| study.compared);
    let key = |named: &NamedStudy<'_>| (named.1.judged(), level::names(named.1));
    let groups = grouped(compared.map(|named| (key(&named), named)));
    let parts: Vec<(String, Vec<NamedStudy<'_>>)> = groups
        .into_iter()
        .flat_map(|((judged, _), cases)| {
            let parts: Vec<_> = cases.chunks(MOST_CASES).map(<[_]>::to_vec).collect();
            parts.into_iter().map(move |part| (judged.clone(), part))
        })
        .collect();
    let numbered = parts.len() > 1;
    let table = |(index, (judged, cases)): (usize, &(String, Vec<NamedStudy<'_>>))| {
        let number = if numbered { format!("-{}", index + 1) } else { String::new() };
        table(outcome, &format!("tab:{}{number}", outcome.suite), judged, cases)
    };
    parts.iter().enumerate().map(table).collect()
}

fn table(outcome: &SuiteOutcome, label: &str, judged: &str, cases: &[NamedStudy<'_>]) -> String {
    let axis = cases.first().map_or(Axis::Space, |(_, study)| study.axis);
    let head = match axis {
        Axis::Space => "cells",
        Axis::Time => "$\\Delta t$ (s)",
        Axis::Particles => "particles per cell",
    };
    let mut text = String::new();
    let mut line = |line: &str| {
        let _ = writeln!(text, "{line}");
    };
    line("\\begin{table}");
    line("  \\centering");
    let all_rows = || cases.iter().flat_map(|(_, study)| level::rows(study));
    let is_aside = |row: LevelRow<'_>| level::judged().cell(&row).text.starts_with('(');
    let aside = if all_rows().any(is_aside) {
        " Levels in parentheses do not count for the order."
    } else {
        ""
    };
    let (title, judged) = (escaped(&outcome.title), escaped(judged));
    line(&format!("  \\caption{{{title}: {judged}.{aside}}}"));
    line(&format!("  \\label{{{label}}}"));
    line(&format!("  \\begin{{tabular}}{{r{}}}", "rr".repeat(cases.len())));
    line("    \\toprule");
    let names =
        cases.iter().map(|(name, _)| format!(" & \\multicolumn{{2}}{{c}}{{{}}}", escaped(name)));
    line(&format!("   {} \\\\", names.collect::<String>()));
    let rules = (0..cases.len()).map(|k| format!("\\cmidrule(lr){{{}-{}}}", 2 * k + 2, 2 * k + 3));
    line(&format!("    {}", rules.collect::<Vec<_>>().join(" ")));
    line(&format!("    {head}{} \\\\", " & error & order".repeat(cases.len())));
    line("    \\midrule");
    let rows: Vec<Vec<LevelRow<'_>>> =
        cases.iter().map(|(_, study)| level::rows(study).collect()).collect();
    for index in 0..rows.first().map_or(0, Vec::len) {
        let name = level::name(axis).cell(&rows[0][index]).text;
        let mut cells = vec![number(&name)];
        for row in &rows {
            cells.push(number(&level::judged().cell(&row[index]).text));
            cells.push(number(&level::order().cell(&row[index]).text));
        }
        line(&format!("    {} \\\\", cells.join(" & ")));
    }
    line("    \\midrule");
    let orders = cases.iter().map(|(_, study)| {
        let order = study.judgement.order.filter(|_| study.verdict() == Verdict::Converging);
        let order = order.map_or_else(
            || study.verdict().name().to_owned(),
            |order| format!("${:.2}$ [${:.2}$, ${:.2}$]", order.value, order.low, order.high),
        );
        format!(" & \\multicolumn{{2}}{{c}}{{{order}}}")
    });
    line(&format!("    order (95\\,\\%){} \\\\", orders.collect::<String>()));
    line("    \\bottomrule");
    line("  \\end{tabular}");
    line("\\end{table}");
    text
}

/// Converts a cell to LaTeX: `1.235e-05` to a power of ten, and `-` (no value) to a dash.
fn number(text: &str) -> String {
    let (before, rest) = text.strip_prefix('(').map_or(("", text), |rest| ("(", rest));
    let (inner, after) = rest.strip_suffix(')').map_or((rest, ""), |inner| (inner, ")"));
    let power = inner.split_once('e').and_then(|(mantissa, exponent)| {
        let _: f64 = mantissa.parse().ok()?;
        let exponent: i32 = exponent.parse().ok()?;
        Some(format!("${mantissa} \\times 10^{{{exponent}}}$"))
    });
    let cell = match (power, inner) {
        (Some(power), _) => power,
        (None, "-") => "--".to_owned(),
        (None, _) if inner.parse::<f64>().is_ok_and(f64::is_finite) => format!("${inner}$"),
        (None, _) => escaped(inner),
    };
    format!("{before}{cell}{after}")
}

/// Escapes text for LaTeX. Characters outside Latin alphabets become their command or `?`.
pub(crate) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        let command = match c {
            '\\' => "\\textbackslash{}",
            '~' => "\\textasciitilde{}",
            '^' => "\\textasciicircum{}",
            '<' => "$<$",
            '>' => "$>$",
            '|' => "$|$",
            '*' => "$*$",
            '×' => "$\\times$",
            '·' => "$\\cdot$",
            '\u{2212}' => "$-$",
            '²' => "$^2$",
            '³' => "$^3$",
            '…' => "\\dots{}",
            '\u{2013}' => "--",
            '\u{2014}' => "---",
            '\u{2018}' | '\u{2019}' => "'",
            '\u{201c}' | '\u{201d}' => "''",
            'α' => "$\\alpha$",
            'λ' => "$\\lambda$",
            'μ' => "$\\mu$",
            'ν' => "$\\nu$",
            'π' => "$\\pi$",
            'ρ' => "$\\rho$",
            'σ' => "$\\sigma$",
            'τ' => "$\\tau$",
            'Δ' => "$\\Delta$",
            '\n' | '\r' | '\t' => " ",
            '#' | '$' | '%' | '&' | '_' | '{' | '}' => {
                escaped.push('\\');
                escaped.push(c);
                continue;
            }
            ' '..='~' | '\u{a1}'..='\u{17f}' => {
                escaped.push(c);
                continue;
            }
            _ => "?",
        };
        escaped.push_str(command);
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[test]
    fn numbers_of_cells() {
        assert_eq!(["(1.000e+00)", "nan"].map(number), ["($1.000 \\times 10^{0}$)", "nan"]);
    }

    #[rstest]
    #[case("50 % of rho_0 & {x}", "50 \\% of rho\\_0 \\& \\{x\\}")]
    #[case(
        "a\\b^2 ~ σ²",
        "a\\textbackslash{}b\\textasciicircum{}2 \\textasciitilde{} $\\sigma$$^2$"
    )]
    #[case("Müller 漢", "Müller ?")]
    fn characters_with_a_meaning_are_escaped(#[case] text: &str, #[case] latex: &str) {
        assert_eq!(escaped(text), latex);
    }
}
