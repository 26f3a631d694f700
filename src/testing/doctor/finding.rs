//! Findings, and the report of all examinations as text.

use crate::report::text::prose::{hanging, paragraph_lines, row, row_of_width};
use mpm_subject::named;
use serde::Serialize;

named! {
    /// Weight of a finding.
    pub enum FindingWeight {
        /// A defect that should be repaired.
        Defect = "defect",
        /// A property that is not a defect, reported for information.
        Remark = "remark",
    }
}

/// A finding on a solver.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SolverFinding {
    /// Defect or remark.
    pub weight: FindingWeight,
    /// Name of the finding, such as `gravity-left-on`.
    pub name: &'static str,
    /// Observed values.
    pub seen: String,
    /// Likely cause.
    pub cause: String,
    /// Parts of the solver's code to check.
    pub look_at: String,
}

impl SolverFinding {
    pub(super) fn defect(name: &'static str, seen: String, cause: &str, look_at: &str) -> Self {
        let (cause, look_at) = (cause.to_owned(), look_at.to_owned());
        Self { weight: FindingWeight::Defect, name, seen, cause, look_at }
    }

    pub(super) fn remark(name: &'static str, seen: String, cause: &str, look_at: &str) -> Self {
        Self { weight: FindingWeight::Remark, ..Self::defect(name, seen, cause, look_at) }
    }
}

/// Result of one examination.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "result", rename_all = "snake_case")]
#[non_exhaustive]
pub enum ExaminationResult {
    /// The examination was completed.
    Examined {
        /// Measured values.
        measured: String,
        /// The findings, if any.
        findings: Vec<SolverFinding>,
    },
    /// The solver lacks a required capability.
    NotApplicable {
        /// Missing capabilities, or the solver's own reason.
        lacks: String,
    },
    /// The examination was skipped because another examination has findings.
    Skipped {
        /// Name of the examination with findings.
        after: &'static str,
    },
}

/// An examination and its result.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ExaminationReport {
    /// Name of the examination, such as `fall`.
    pub examination: &'static str,
    /// Expected behaviour of a correct solver, in one sentence.
    pub expected: &'static str,
    /// Result of the examination.
    #[serde(flatten)]
    pub result: ExaminationResult,
}

/// Results of all examinations of a solver.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct DoctorReport {
    /// Name of the solver.
    pub solver: String,
    /// The solver's description of itself, as pairs of name and value.
    pub settings: Vec<(String, String)>,
    /// Reason why no examination was possible; `None` if at least one was.
    pub silent: Option<String>,
    /// The examinations, starting with the simplest.
    pub examinations: Vec<ExaminationReport>,
    /// Capabilities that the solver declares and that no examination covers.
    pub not_examined: Vec<UnexaminedCapability>,
}

/// A capability that a solver declares and that no examination covers.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct UnexaminedCapability {
    /// The capability as an entry of `hello`, such as `loads: traction` or `contact`.
    pub capability: String,
    /// Names of up to three built-in suites that need this capability and that the solver can run.
    pub suites: Vec<&'static str>,
}

impl DoctorReport {
    /// Returns the findings of all examinations.
    pub fn findings(&self) -> impl Iterator<Item = &SolverFinding> {
        self.examinations.iter().flat_map(|report| report.result.findings())
    }

    /// Returns the number of defects.
    pub fn defects(&self) -> usize {
        self.findings().filter(|finding| finding.weight == FindingWeight::Defect).count()
    }
}

impl ExaminationResult {
    /// Returns the findings; empty if the examination was not completed.
    pub fn findings(&self) -> &[SolverFinding] {
        match self {
            Self::Examined { findings, .. } => findings,
            Self::NotApplicable { .. } | Self::Skipped { .. } => &[],
        }
    }
}

pub(super) const LIGHT_NODES: &str = "light-nodes-left-out";

pub(super) const MASS_THRESHOLD: &str = "the threshold on nodal mass below which nodes get no \
                                         velocity: this threshold must be zero, or far below the \
                                         particle mass times the smallest weight";

/// Formats all examinations with their measured values, the findings and the verdict.
pub fn page(report: &DoctorReport) -> String {
    let mut lines = Vec::new();
    for made in &report.examinations {
        examination_lines(&mut lines, made);
    }
    not_examined_lines(&mut lines, &report.not_examined);
    with_ends(report, &lines)
}

/// Formats the names of the examinations by result, the findings and the verdict.
pub fn brief_page(report: &DoctorReport) -> String {
    let has_defect = |made: &&ExaminationReport| heading(&made.result) == DEFECT;
    let names = |key: &str, names: Vec<&str>| match names.len() {
        0 => None,
        count => Some((format!("{key} ({count})"), names.join(", "))),
    };
    let by_result = [SOUND, "with a remark", "not applicable", "skipped"].map(|key| {
        let equal = report.examinations.iter().filter(|made| heading(&made.result) == key);
        names(key, equal.map(|made| made.examination).collect())
    });
    let claimed = report.not_examined.iter().map(|one| one.capability.as_str()).collect();
    let mut lines = vec![String::new()];
    for (key, names) in by_result.into_iter().chain([names("not examined", claimed)]).flatten() {
        row_of_width(&mut lines, 19, &key, &names);
    }
    for finding in report.findings().filter(|finding| finding.weight == FindingWeight::Remark) {
        lines.push(String::new());
        row(&mut lines, "remark", finding.name);
        row(&mut lines, "  likely cause", &finding.cause);
        row(&mut lines, "  check", &finding.look_at);
    }
    for made in report.examinations.iter().filter(has_defect) {
        examination_lines(&mut lines, made);
    }
    with_ends(report, &lines)
}

fn with_ends(report: &DoctorReport, middle: &[String]) -> String {
    let mut lines = Vec::new();
    let settings = report.settings.iter().map(|(name, value)| format!("{name}: {value}"));
    paragraph_lines(&mut lines, &settings.collect::<Vec<_>>().join("; "));
    lines.extend_from_slice(middle);
    lines.push(String::new());
    paragraph_lines(&mut lines, &verdict(report));
    lines.join("\n") + "\n"
}

fn examination_lines(lines: &mut Vec<String>, made: &ExaminationReport) {
    let (label, text) = match &made.result {
        ExaminationResult::Examined { measured, .. } => ("measured", measured),
        ExaminationResult::NotApplicable { lacks } => ("not supported", lacks),
        ExaminationResult::Skipped { after } => {
            ("reason", &format!("`{after}` has a defect that would invalidate this result"))
        }
    };
    lines.extend([String::new(), format!("{}: {}", made.examination, heading(&made.result))]);
    row(lines, "expected", made.expected);
    row(lines, label, text);
    for finding in made.result.findings() {
        row(lines, finding.weight.name(), finding.name);
        row(lines, "  observed", &finding.seen);
        row(lines, "  likely cause", &finding.cause);
        row(lines, "  check", &finding.look_at);
    }
}

const SOUND: &str = "no defect";
const DEFECT: &str = "DEFECT";

fn heading(result: &ExaminationResult) -> &'static str {
    match result {
        ExaminationResult::NotApplicable { .. } => "not applicable",
        ExaminationResult::Skipped { .. } => "skipped",
        ExaminationResult::Examined { findings, .. } => {
            match findings.iter().map(|finding| finding.weight).min() {
                None => SOUND,
                Some(FindingWeight::Defect) => DEFECT,
                Some(FindingWeight::Remark) => "with a remark",
            }
        }
    }
}

/// Adds the capabilities that no examination covers, one row for those that the same suites test.
fn not_examined_lines(lines: &mut Vec<String>, all: &[UnexaminedCapability]) {
    let mut rows: Vec<(Vec<&str>, &[&str])> = Vec::new();
    for one in all {
        match rows.iter_mut().find(|(_, suites)| *suites == one.suites) {
            Some((capabilities, _)) => capabilities.push(&one.capability),
            None => rows.push((vec![&one.capability], &one.suites)),
        }
    }
    if !rows.is_empty() {
        lines.extend([String::new(), "claimed, not examined:".to_owned()]);
    }
    for (capabilities, suites) in rows {
        let suites = match suites {
            [] => "no built-in suite that this solver can run tests it".to_owned(),
            _ => format!("suites that test it: {}", suites.join(", ")),
        };
        hanging(lines, "-", &format!("{}; {suites}", capabilities.join(", ")));
    }
}

fn verdict(report: &DoctorReport) -> String {
    if let Some(why) = &report.silent {
        return format!("verdict: {} cannot be examined: {why}", report.solver);
    }
    let names = |weight: FindingWeight| {
        let found = report.findings().filter(|finding| finding.weight == weight);
        found.map(|finding| finding.name).collect::<Vec<_>>().join(", ")
    };
    let count = |is: fn(&ExaminationResult) -> bool| {
        report.examinations.iter().filter(|made| is(&made.result)).count()
    };
    let made = count(|result| matches!(result, ExaminationResult::Examined { .. }));
    let skipped = count(|result| matches!(result, ExaminationResult::Skipped { .. }));
    let not = count(|result| matches!(result, ExaminationResult::NotApplicable { .. }));
    let claimed = report.not_examined.len();
    let mut text = match report.defects() {
        0 => format!("verdict: no defect found in {made} examinations"),
        _ => format!("verdict: {}", names(FindingWeight::Defect)),
    };
    for (number, what) in [
        (not, "not applicable"),
        (skipped, "skipped until all defects are corrected"),
        (claimed, "claimed capabilities not examined"),
    ] {
        if number > 0 {
            text.push_str(&format!("; {number} {what}"));
        }
    }
    let remarks = names(FindingWeight::Remark);
    if !remarks.is_empty() {
        text.push_str(&format!("; remarks: {remarks}"));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heading_of_a_remark_and_a_defect_is_defect() {
        let kinds = [SolverFinding::remark, SolverFinding::defect];
        let findings = kinds.map(|new| new("drag", String::new(), "", "")).to_vec();
        let result = ExaminationResult::Examined { measured: String::new(), findings };
        assert_eq!(heading(&result), "DEFECT");
    }
}
