//! Tables, remarks, JSON and figures for each kind of study.

use crate::report::columns::stability::json_columns;
use crate::report::columns::{force, gradient, json_objects, level, spectrum};
use crate::report::columns::{interval, number, with_case};
use crate::report::figure::Figure;
use crate::report::figure::{study, sweep};
use crate::report::text::table::Table;
use crate::report::text::{levels, stability};
use crate::verify::{
    Axis, CaseOutcome, Convergence, Floor, FloorCause, GradientStudy, InternalForce, Probe,
    SpectrumRow, SpectrumStudy, StabilityStudy, SuiteOutcome,
};
use serde_json::{Value, json};

/// Report of one kind of study. Cases of other kinds add nothing to the report.
pub(crate) struct StudyReport {
    pub(crate) tables: fn(&mut Vec<String>, &[CaseOutcome]),
    /// Returns remarks on one case, about results that no table shows.
    pub(crate) remarks: fn(&CaseOutcome) -> Vec<String>,
    /// Returns the JSON members of one case, with null for cases of another kind of study.
    pub(crate) json: fn(&CaseOutcome) -> Value,
    pub(crate) figures: fn(&SuiteOutcome) -> Vec<Figure>,
}

pub(crate) const KINDS: [StudyReport; 5] = [
    StudyReport {
        tables: |lines, cases| levels::tables(lines, &studies(cases, CaseOutcome::convergence)),
        remarks: |case| case.convergence().map_or(Vec::new(), remarks),
        json: convergence_json,
        figures: study::figures,
    },
    StudyReport {
        tables: force_tables,
        remarks: |_| Vec::new(),
        json: |case| {
            let rows = case.internal_force().map(|study| &study.rows);
            json!({"forces": rows.map(|rows| json_objects(&force::columns(), rows))})
        },
        figures: |_| Vec::new(),
    },
    StudyReport {
        tables: |lines, cases| stability::tables(lines, &studies(cases, CaseOutcome::stability)),
        remarks: |case| case.stability().map_or(Vec::new(), stability::remarks),
        json: |case| json!({"stability": case.stability().map(stability_json)}),
        figures: stability_figures,
    },
    StudyReport {
        tables: gradient_tables,
        remarks: |_| Vec::new(),
        json: |case| json!({"gradient": case.gradient().map(gradient_json)}),
        figures: |_| Vec::new(),
    },
    StudyReport {
        tables: wave_tables,
        remarks: |case| case.spectrum().map_or(Vec::new(), wave_remarks),
        json: |case| {
            let rows = case.spectrum().map(|study| &study.rows);
            json!({"spectrum": rows.map(|rows| json_objects(&spectrum::json_columns(), rows))})
        },
        figures: |_| Vec::new(),
    },
];

pub(crate) fn studies<'a, R>(
    cases: &'a [CaseOutcome],
    of: fn(&'a CaseOutcome) -> Option<&'a R>,
) -> Vec<(&'a str, &'a R)> {
    cases.iter().filter_map(|case| Some((case.case.as_str(), of(case)?))).collect()
}

fn convergence_json(case: &CaseOutcome) -> Value {
    let study = case.convergence();
    let levels = study.into_iter().flat_map(level::rows);
    json!({
        "axis": study.map(|study| study.axis.name()),
        "formal_order": study
            .filter(|study| study.axis != Axis::Particles)
            .map(|study| number(study.formal_order)),
        "judge": study.filter(|study| study.compared).map(judge),
        "observed_order": study.and_then(|study| study.judgement.order).map(interval),
        "floor": study.and_then(|study| study.floor.as_ref()).map(floor),
        "levels": json_objects(&level::json_columns(), levels),
    })
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

fn force_tables(lines: &mut Vec<String>, cases: &[CaseOutcome]) {
    for (name, InternalForce { rows }) in studies(cases, CaseOutcome::internal_force) {
        lines.extend([String::new(), format!("  {name}")]);
        lines.extend(Table::new(&force::columns(), rows).lines());
    }
}

fn stability_figures(outcome: &SuiteOutcome) -> Vec<Figure> {
    let limits = stability::map(outcome).map(|map| Figure {
        file: format!("{}.svg", outcome.suite),
        svg: map.to_svg(),
        pgfplots: map.to_pgfplots(),
    });
    limits.into_iter().chain(sweep::figures(outcome)).collect()
}

fn stability_json(study: &StabilityStudy) -> Value {
    json!({
        "swept": study.swept,
        "sought": study.sought,
        "rows": json_objects(&json_columns(study), &study.rows),
    })
}

fn gradient_tables(lines: &mut Vec<String>, cases: &[CaseOutcome]) {
    for (name, study) in studies(cases, CaseOutcome::gradient) {
        lines.extend([String::new(), format!("  {name}")]);
        lines.extend(Table::new(&gradient::levels(), gradient::level_rows(study)).lines());
        lines.push(String::new());
        lines.extend(Table::new(&gradient::taylor(), gradient::taylor_rows(study)).lines());
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

fn wave_tables(lines: &mut Vec<String>, cases: &[CaseOutcome]) {
    let mut waves: Vec<(&str, &SpectrumRow)> = Vec::new();
    let mut curves: Vec<(&str, &SpectrumRow)> = Vec::new();
    for (name, study) in studies(cases, CaseOutcome::spectrum) {
        for row in &study.rows {
            let is_known =
                |known: &(&str, &SpectrumRow)| known.0 == name && known.1.courant == row.courant;
            if row.limit.is_some() && !curves.iter().any(is_known) {
                curves.push((name, row));
            }
            waves.push((name, row));
        }
    }
    for (columns, rows) in [(spectrum::waves(), waves), (spectrum::curves(), curves)] {
        if !rows.is_empty() {
            lines.push(String::new());
            lines.extend(Table::new(&with_case(columns), rows).merged().lines());
        }
    }
}

fn wave_remarks(study: &SpectrumStudy) -> Vec<String> {
    let remark = |row: &SpectrumRow| {
        let reason = row.measured.as_ref().err()?;
        Some(format!("{} cells, C = {}: {reason}", row.cells, row.courant))
    };
    study.rows.iter().filter_map(remark).collect()
}
