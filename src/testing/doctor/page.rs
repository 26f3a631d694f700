//! The report as text.

use super::finding::{DoctorReport, ExaminationResult, FindingWeight, SolverFinding};
use crate::report::text::prose::{paragraph_lines, row};

/// The report of all examinations as a page.
pub fn page(report: &DoctorReport) -> String {
    let mut lines = Vec::new();
    let settings = report.settings.iter().map(|(name, value)| format!("{name}: {value}"));
    paragraph_lines(&mut lines, &settings.collect::<Vec<_>>().join("; "));
    for made in &report.examinations {
        lines.push(String::new());
        let words = match &made.result {
            ExaminationResult::Examined { findings, .. } => heading(findings),
            ExaminationResult::NotApplicable { .. } => "not applicable",
            ExaminationResult::LeftOut { .. } => "left out",
        };
        lines.push(format!("{}: {words}", made.examination));
        row(&mut lines, "expected", made.expected);
        match &made.result {
            ExaminationResult::Examined { measured, findings } => {
                row(&mut lines, "measured", measured);
                for finding in findings {
                    finding_lines(&mut lines, finding);
                }
            }
            ExaminationResult::NotApplicable { lacks } => {
                row(&mut lines, "what is missing", lacks);
            }
            ExaminationResult::LeftOut { after } => {
                let why = format!("it says nothing as long as `{after}` has a defect");
                row(&mut lines, "because", &why);
            }
        }
    }
    lines.push(String::new());
    paragraph_lines(&mut lines, &verdict(report));
    lines.join("\n") + "\n"
}

fn heading(findings: &[SolverFinding]) -> &'static str {
    let heaviest = findings.iter().map(|finding| finding.weight).min();
    heaviest.map_or("sound", |weight| match weight {
        FindingWeight::Defect => "DEFECT",
        FindingWeight::Remark => "sound, with a remark",
    })
}

fn finding_lines(lines: &mut Vec<String>, finding: &SolverFinding) {
    row(lines, finding.weight.name(), finding.name);
    row(lines, "  seen", &finding.seen);
    row(lines, "  likely cause", &finding.cause);
    row(lines, "  look at", &finding.look_at);
}

/// The verdict in one sentence.
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
    let left_out = count(|result| matches!(result, ExaminationResult::LeftOut { .. }));
    let not = count(|result| matches!(result, ExaminationResult::NotApplicable { .. }));
    let mut text = match report.defects() {
        0 => format!("verdict: nothing wrong was found in {made} examinations"),
        _ => format!("verdict: {}", names(FindingWeight::Defect)),
    };
    for (number, what) in [(not, "not applicable"), (left_out, "left out until that is mended")] {
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
