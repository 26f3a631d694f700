//! Tables, remarks, JSON and figures for each kind of study.

use crate::report::columns::stability::json_columns;
use crate::report::columns::{TableColumn, interval, number};
use crate::report::columns::{force, gradient, json_objects, level, spectrum};
use crate::report::figure::Figure;
use crate::report::figure::{study, sweep};
use crate::report::text::table::Table;
use crate::report::text::{levels, stability};
use crate::verify::{
    Axis, CaseOutcome, Convergence, Floor, FloorCause, GradientStudy, InternalForce, Probe,
    SpectrumRow, SpectrumStudy, StabilityStudy, SuiteOutcome,
};
use serde_json::{Map, Value, json};

pub(crate) const KINDS: [&dyn StudyReport; 5] =
    [&ConvergenceReport, &InternalForceReport, &StabilityReport, &GradientReport, &SpectrumReport];

/// Report of one kind of study. Cases of other kinds add nothing to the report.
pub(crate) trait StudyReport: Sync {
    fn tables(&self, lines: &mut Vec<String>, cases: &[CaseOutcome]);

    /// Returns remarks on one case, about results that no table shows.
    fn remarks(&self, _case: &CaseOutcome) -> Vec<String> {
        Vec::new()
    }

    /// Returns the JSON members of one case, with null for cases of another kind of study.
    fn json(&self, case: &CaseOutcome) -> Map<String, Value>;

    fn figures(&self, _: &SuiteOutcome) -> Vec<Figure> {
        Vec::new()
    }
}

pub(crate) fn studies<'a, R>(
    cases: &'a [CaseOutcome],
    of: fn(&'a CaseOutcome) -> Option<&'a R>,
) -> Vec<(&'a str, &'a R)> {
    cases.iter().filter_map(|case| Some((case.case.as_str(), of(case)?))).collect()
}

pub(crate) fn members(object: Value) -> Map<String, Value> {
    match object {
        Value::Object(members) => members,
        _ => Map::new(),
    }
}

pub(crate) struct ConvergenceReport;

impl StudyReport for ConvergenceReport {
    fn tables(&self, lines: &mut Vec<String>, cases: &[CaseOutcome]) {
        levels::tables(lines, &studies(cases, CaseOutcome::convergence));
    }

    fn remarks(&self, case: &CaseOutcome) -> Vec<String> {
        case.convergence().map_or(Vec::new(), remarks)
    }

    fn json(&self, case: &CaseOutcome) -> Map<String, Value> {
        let study = case.convergence();
        let levels = study.into_iter().flat_map(level::rows);
        members(json!({
            "axis": study.map(|study| study.axis.name()),
            "formal_order": study
                .filter(|study| study.axis != Axis::Particles)
                .map(|study| number(study.formal_order)),
            "judge": study.filter(|study| study.compared).map(judge),
            "observed_order": study.and_then(|study| study.judgement.order).map(interval),
            "floor": study.and_then(|study| study.floor.as_ref()).map(floor),
            "levels": json_objects(&level::json_columns(), levels),
        }))
    }

    fn figures(&self, outcome: &SuiteOutcome) -> Vec<Figure> {
        study::figures(outcome)
    }
}

/// Returns remarks about too long time steps, failed runs, and causes of error floors.
fn remarks(study: &Convergence) -> Vec<String> {
    let too_long = study.levels.iter().filter(|level| level.is_too_long());
    let too_long: Vec<String> = too_long.map(|level| level.name(study.axis)).collect();
    let too_long = (!too_long.is_empty())
        .then(|| format!("steps are longer than the stable time step: {}", too_long.join(", ")));
    // Equal failures of consecutive levels are one remark.
    let failures = study.levels.chunk_by(|a, b| a.run.failure == b.run.failure);
    let failures = failures.filter_map(|levels| {
        let (first, last) = (levels.first()?, levels.last()?);
        let (from, failure) = (first.name(study.axis), first.run.failure.as_ref()?);
        Some(match levels.len() {
            1 => format!("{from}: {failure}"),
            count => format!("{from} to {} ({count} levels): {failure}", last.name(study.axis)),
        })
    });
    let floor = study.floor.iter().filter(|floor| !floor.probes.is_empty()).map(Floor::sentence);
    let gate = study.remarks.iter().cloned();
    too_long.into_iter().chain(failures).chain(floor).chain(gate).collect()
}

fn judge(study: &Convergence) -> Value {
    let corner = |corner: &[f64]| corner.iter().map(|x| number(*x)).collect::<Vec<_>>();
    let within = study.within.as_ref();
    json!({
        "of": study.of.name(),
        "norm": study.norm.name(),
        "scale": study.scale.map(number),
        "within": within.map(|of| json!({"from": corner(&of.from), "to": corner(&of.to)})),
    })
}

fn floor(floor: &Floor) -> Value {
    let probe = |probe: &Probe| {
        json!({
            "axis": probe.axis.name(),
            "error": probe.error.as_ref().ok().copied().map(number),
            "failure": probe.error.as_ref().err(),
        })
    };
    json!({
        "cause": floor.cause().map(FloorCause::name),
        "error": number(floor.error),
        "probes": floor.probes.iter().map(probe).collect::<Vec<_>>(),
    })
}

pub(crate) struct InternalForceReport;

impl StudyReport for InternalForceReport {
    fn tables(&self, lines: &mut Vec<String>, cases: &[CaseOutcome]) {
        for case in cases {
            if let Some(InternalForce { rows }) = case.internal_force() {
                lines.extend([String::new(), format!("  {}", case.case)]);
                lines.extend(Table::new(&force::columns(), rows).lines());
            }
        }
    }

    fn json(&self, case: &CaseOutcome) -> Map<String, Value> {
        let objects = |study: &InternalForce| json_objects(&force::columns(), &study.rows);
        members(json!({"forces": case.internal_force().map(objects)}))
    }
}

pub(crate) struct StabilityReport;

impl StudyReport for StabilityReport {
    fn tables(&self, lines: &mut Vec<String>, cases: &[CaseOutcome]) {
        stability::tables(lines, &studies(cases, CaseOutcome::stability));
    }

    fn remarks(&self, case: &CaseOutcome) -> Vec<String> {
        case.stability().map_or(Vec::new(), stability::remarks)
    }

    fn json(&self, case: &CaseOutcome) -> Map<String, Value> {
        members(json!({"stability": case.stability().map(stability_json)}))
    }

    fn figures(&self, outcome: &SuiteOutcome) -> Vec<Figure> {
        let limits = stability::map(outcome).map(|map| Figure {
            file: format!("{}.svg", outcome.suite),
            svg: map.to_svg(),
            pgfplots: map.to_pgfplots(),
        });
        limits.into_iter().chain(sweep::figures(outcome)).collect()
    }
}

fn stability_json(study: &StabilityStudy) -> Value {
    json!({
        "swept": study.swept,
        "sought": study.sought,
        "rows": json_objects(&json_columns(study), &study.rows),
    })
}

pub(crate) struct GradientReport;

impl StudyReport for GradientReport {
    fn tables(&self, lines: &mut Vec<String>, cases: &[CaseOutcome]) {
        for (name, study) in studies(cases, CaseOutcome::gradient) {
            lines.extend([String::new(), format!("  {name}")]);
            lines.extend(Table::new(&gradient::levels(), gradient::level_rows(study)).lines());
            lines.push(String::new());
            lines.extend(Table::new(&gradient::taylor(), gradient::taylor_rows(study)).lines());
        }
    }

    fn json(&self, case: &CaseOutcome) -> Map<String, Value> {
        members(json!({"gradient": case.gradient().map(gradient_json)}))
    }
}

fn gradient_json(study: &GradientStudy) -> Value {
    json!({
        "functional": study.functional,
        "parameter": study.parameter,
        "state": study.state().0.name(),
        "value": number(study.value.computed),
        "reported_value": number(study.value.reported),
        "order": number(study.order()),
        "levels": json_objects(&gradient::levels(), gradient::level_rows(study)),
        "taylor": json_objects(&gradient::taylor(), gradient::taylor_rows(study)),
        "sweep": gradient::sweep(study),
        "points": json_objects(&gradient::points(), &study.points),
    })
}

pub(crate) struct SpectrumReport;

impl StudyReport for SpectrumReport {
    fn tables(&self, lines: &mut Vec<String>, cases: &[CaseOutcome]) {
        let mut waves: Vec<NamedWave> = Vec::new();
        let mut curves: Vec<NamedWave> = Vec::new();
        for (name, study) in studies(cases, CaseOutcome::spectrum) {
            for row in &study.rows {
                let is_known =
                    |(case, known): &NamedWave| case == name && known.courant == row.courant;
                if row.limit.is_some() && !curves.iter().any(is_known) {
                    curves.push((name.to_owned(), row.clone()));
                }
                waves.push((name.to_owned(), row.clone()));
            }
        }
        for (columns, rows) in [(spectrum::waves(), waves), (spectrum::curves(), curves)] {
            if !rows.is_empty() {
                lines.push(String::new());
                lines.extend(Table::new(&with_case(columns), rows).merged().lines());
            }
        }
    }

    fn remarks(&self, case: &CaseOutcome) -> Vec<String> {
        let remark = |row: &SpectrumRow| {
            let reason = row.measured.as_ref().err()?;
            Some(format!("{} cells, C = {}: {reason}", row.cells, row.courant))
        };
        let study = case.spectrum();
        study.map_or(Vec::new(), |study| study.rows.iter().filter_map(remark).collect())
    }

    fn json(&self, case: &CaseOutcome) -> Map<String, Value> {
        let objects = |study: &SpectrumStudy| json_objects(&spectrum::json_columns(), &study.rows);
        members(json!({"spectrum": case.spectrum().map(objects)}))
    }
}

type NamedWave = (String, SpectrumRow);

fn with_case(columns: Vec<TableColumn<'_, SpectrumRow>>) -> Vec<TableColumn<'_, NamedWave>> {
    let name = TableColumn::text("case", "case", |(name, _): &NamedWave| name.clone());
    let of_row = columns.into_iter().map(|column| column.within(|(_, row)| Some(row)));
    std::iter::once(name.flush_left()).chain(of_row).collect()
}
