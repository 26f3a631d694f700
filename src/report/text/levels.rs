//! Tables of convergence studies, with a row for each case and a column for each level.

use super::prose::{indented, row};
use super::table::{Table, shared};
use crate::report::columns::level::{LevelColumn, NamedStudy};
use crate::report::columns::{TableColumn, decimals, level, short, with_case};
use crate::verify::{
    Axis, Convergence, EstimateRefusal, LevelOutcome, LimitEstimate, Quantity, StepKind, distinct,
    format_number, grouped,
};

/// Adds tables of errors and orders, values on the finest levels, drifts, rates and limits.
pub(crate) fn tables(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    settings(lines, studies);
    first_crossings(lines, studies);
    for alike in by_levels(studies) {
        errors(lines, &alike);
        spreads(lines, &alike);
        observed_velocities(lines, &alike);
    }
    finest(lines, studies);
    drifts(lines, studies);
    rates(lines, studies);
    observed_limits(lines, studies);
}

fn settings(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    for (levels, names) in shared(studies.iter().map(|(name, study)| (*name, setting(study)))) {
        lines.extend(indented(&format!("levels{names}")).lines().map(str::to_owned));
        lines.extend(levels.lines().map(|fact| format!("    {fact}")));
    }
}

/// Lists the coarsest level on which particles change cells, unless no case has crossings, or each
/// case has a single level, whose crossings the table of the finest levels shows.
fn first_crossings(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    let crossings = |level: &LevelOutcome| level.run.counters.crossings;
    let first = |study: &Convergence| {
        study.levels.iter().position(|level| crossings(level).unwrap_or(0) > 0)
    };
    let listed = studies_with(studies, |study| {
        study.levels.len() > 1 && study.levels.iter().any(|level| crossings(level).is_some())
    });
    if listed.iter().all(|(_, study)| first(study).is_none()) {
        return;
    }
    let text = |study: &Convergence| match first(study) {
        Some(0) => "particles change cells on every level".to_owned(),
        Some(level) if level + 1 == study.levels.len() => {
            "particles change cells on the finest level only".to_owned()
        }
        Some(level) => {
            let name = study.levels[level].name(study.axis);
            format!("particles change cells on the level with {name} and on finer levels")
        }
        None => "no particle changes its cell".to_owned(),
    };
    for (text, names) in shared(listed.iter().map(|(name, study)| (*name, text(study)))) {
        row(lines, "crossings", &format!("{text}{names}"));
    }
}

/// Describes the levels, one fact in each line: `8, 16, 32 cells along X`, `dt = ... s`.
fn setting(study: &Convergence) -> String {
    // A failed level has fewer steps than planned, so it is excluded.
    let levels = || study.levels.iter().filter(|level| level.run.failure.is_none());
    let span = |value: &dyn Fn(&LevelOutcome) -> Option<String>| {
        let mut values: Vec<String> = levels().filter_map(value).collect();
        values.dedup();
        match &values[..] {
            [] => None,
            [only] => Some(only.clone()),
            [first, .., last] => Some(format!("{first} ... {last}")),
        }
    };
    let all = level::names(study).join(", ");
    let count = |what: &str, value: &dyn Fn(&LevelOutcome) -> Option<String>| {
        span(value).map(|values| format!("{values} {what}"))
    };
    let of_axis = |axis: Axis, value: Option<String>| value.filter(|_| study.axis != axis);
    let refined = match study.axis {
        Axis::Space => format!("{all} cells along X"),
        Axis::Time => format!("dt = {all} s"),
        Axis::Particles => format!("{all} particles per cell"),
    };
    let parts = [
        Some(refined),
        of_axis(Axis::Space, count("cells along X", &|level| Some(level.cells.to_string()))),
        span(&|level| Some(format_number(level.h))).map(|h| format!("h = {h} m")),
        of_axis(Axis::Time, span(&|level| Some(format_number(level.dt))))
            .filter(|_| study.steps == StepKind::Time)
            .map(|dt| format!("dt = {dt} s")),
        of_axis(
            Axis::Particles,
            count("particles per cell", &|level| level.ppc.map(|ppc| ppc.to_string())),
        ),
        count("particles", &|level| level.run.counters.particles.map(|count| count.to_string())),
        span(&|level| Some(level.run.steps.to_string())).map(|steps| {
            if study.steps == StepKind::Load {
                format!("load steps: {steps}")
            } else {
                format!("{steps} steps")
            }
        }),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join("\n")
}

fn by_levels<'a>(studies: &[NamedStudy<'a>]) -> Vec<Vec<NamedStudy<'a>>> {
    let key = |study: &Convergence| format!("{} {}", study.judged(), level::names(study).join(" "));
    let compared = studies.iter().filter(|(_, study)| study.compared);
    let groups = grouped(compared.map(|named| (key(named.1), *named)));
    groups.into_iter().map(|(_, group)| group).collect()
}

fn errors(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    let Some((_, first)) = studies.first() else { return };
    let judged = first.judged();
    if first.levels.len() == 1 {
        // The table of verdicts contains the error.
        return row(lines, "error", &judged);
    }
    by_level(lines, &judged, studies, &level::judged(), false);
    let is_excluded = |study: &Convergence| {
        level::rows(study).any(|row| level::judged().cell(&row).text.starts_with('('))
    };
    if studies.iter().any(|(_, study)| is_excluded(study)) {
        lines
            .push("  (in parentheses: errors that are not used to determine the order)".to_owned());
    }
    by_level(lines, "order between neighbouring levels", studies, &level::order(), true);
}

fn studies_with<'a>(
    studies: &[NamedStudy<'a>],
    condition: impl Fn(&Convergence) -> bool,
) -> Vec<NamedStudy<'a>> {
    studies.iter().filter(|(_, study)| condition(study)).copied().collect()
}

fn spreads(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    let repeated =
        studies_with(studies, |study| study.levels.iter().any(|one| one.spread.is_some()));
    let heading = "spread between runs, in the norm of the error";
    by_level(lines, heading, &repeated, &level::spread(), false);
}

fn observed_velocities(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    let observed = studies_with(studies, |study| study.history().is_some());
    let Some(place) = observed.iter().find_map(|(_, study)| study.place()) else { return };
    let heading = format!(
        "rms error over time of the velocity near X = {place} m, divided by its largest exact value"
    );
    by_level(lines, &heading, &observed, &level::velocity(), false);
}

/// Adds a table of `column`. If `is_pair`, a value belongs to a level and the next coarser one.
fn by_level<'a>(
    lines: &mut Vec<String>,
    heading: &str,
    studies: &[NamedStudy<'a>],
    column: &LevelColumn<'a>,
    is_pair: bool,
) {
    let Some((_, first)) = studies.first() else { return };
    let names = level::names(first);
    let of_level = |k: usize| if is_pair { pair_heading(&names, k) } else { names[k].clone() };
    let headings = std::iter::once(level::name(first.axis).heading.into_owned());
    let headings = headings.chain((0..names.len()).map(of_level)).collect();
    let cells = |(name, study): &NamedStudy<'a>| {
        let cells = level::rows(study).map(|row| column.cell(&row).text);
        std::iter::once((*name).to_owned()).chain(cells).collect()
    };
    let rows: Vec<Vec<String>> = studies.iter().map(cells).collect();
    let table = Table::of_cells(headings, rows).without_empty_columns();
    if table.columns() > 1 {
        heading_lines(lines, heading);
        lines.extend(table.merged().lines());
    }
}

/// Returns the names of a level and the next coarser one, or their numbers if the names are long.
fn pair_heading(names: &[String], index: usize) -> String {
    let fine = &names[index];
    match index.checked_sub(1).map(|coarser| &names[coarser]) {
        Some(coarse) if coarse.len() + fine.len() <= LONGEST_PAIR => format!("{coarse}-{fine}"),
        _ => format!("levels {index}-{}", index + 1),
    }
}

/// Maximum length (characters) of two level names in one heading.
const LONGEST_PAIR: usize = 9;

/// Adds a table of the finest levels below a heading, with one row for each case. Columns that
/// contain only dashes or only `0` are omitted; if no column remains, nothing is added.
fn by_case<'a>(
    lines: &mut Vec<String>,
    heading: &str,
    studies: &[NamedStudy<'a>],
    columns: impl IntoIterator<Item = LevelColumn<'a>>,
) {
    let finest = |(name, study): &NamedStudy<'a>| Some((*name, level::rows(study).last()?));
    let table = Table::new(&with_case(columns), studies.iter().filter_map(finest));
    let table = table.without_columns_of("0").without_empty_columns().merged();
    if table.columns() > 1 {
        heading_lines(lines, heading);
        lines.extend(table.lines());
    }
}

fn finest(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    let of_levels = ["particles", "steps"];
    let counters = level::counters().into_iter();
    let counters = counters.filter(|column| !of_levels.contains(&column.heading.as_ref()));
    let of = studies.first().map(|(_, study)| study.of).filter(|of| of.is_primary());
    let of = of.unwrap_or(Quantity::Displacement);
    let columns = level::largest_error(of).into_iter().chain(counters);
    let heading = if has_levels(studies) { "on the finest level" } else { "further results" };
    by_case(lines, heading, studies, columns);
}

fn has_levels(studies: &[NamedStudy<'_>]) -> bool {
    studies.iter().any(|(_, study)| study.levels.len() > 1)
}

fn drifts(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    let sums = distinct(studies.iter().flat_map(|(_, study)| study.drifts.iter().copied()));
    let asked = studies_with(studies, |study| !study.drifts.is_empty());
    let levels = if has_levels(&asked) { ", all levels" } else { "" };
    let heading = format!(
        "conservation{levels}: largest change since t = 0, divided by the sum of magnitudes over \
         the body"
    );
    by_case(lines, &heading, &asked, sums.into_iter().map(level::largest_drift));
}

fn rates(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    let rated = studies_with(studies, |study| study.rated);
    let heading = "rate of the energy on the finest level, d ln E/dt (1/s)";
    by_case(lines, heading, &rated, level::energy_rate());
}

/// Adds the table of extrapolated displacements, with their true errors if these are known.
fn observed_limits(lines: &mut Vec<String>, studies: &[NamedStudy<'_>]) {
    let Some(place) = studies.iter().find_map(|(_, study)| study.place()) else { return };
    let rows = studies_with(studies, |study| study.observed_limit.is_some());
    if rows.is_empty() {
        return;
    }
    let answered = rows.iter().filter(|row| limit(row).is_some()).count();
    let heading = format!(
        "u at X = {place} m at the end, extrapolated from the four finest levels to zero spacing; \
         {answered} of {} cases have an estimate",
        rows.len()
    );
    heading_lines(lines, &heading);
    let table = Table::new(&limit_columns(), &rows).without_empty_columns();
    lines.extend(table.merged().lines());
}

fn heading_lines(lines: &mut Vec<String>, heading: &str) {
    lines.push(String::new());
    lines.extend(indented(heading).lines().map(str::to_owned));
}

/// Rounds the limit to the second significant digit of its half-width.
fn limit_shown(estimate: &LimitEstimate) -> String {
    let (value, half_width) = (estimate.limit.value, estimate.limit.half_width());
    let digits = libm::floor(libm::log10(value.abs())) - libm::floor(libm::log10(half_width));
    format!("{value:.*e}", (digits + 1.0).clamp(1.0, 15.0) as usize)
}

fn limit((_, study): &NamedStudy<'_>) -> Option<LimitEstimate> {
    study.observed_limit?.ok()
}

fn limit_columns<'a>() -> [TableColumn<'a, NamedStudy<'a>>; 8] {
    type LimitColumn<'a> = TableColumn<'a, NamedStudy<'a>>;
    let of = |heading, about, text: fn(&LimitEstimate) -> String| {
        LimitColumn::text(heading, about, move |row| limit(row).as_ref().map(text))
    };
    [
        LimitColumn::text("case", "case", |(name, _)| *name).flush_left(),
        of("order", "order of the finest three values", |estimate| {
            decimals(2)(estimate.order.value)
        }),
        of("+-", "half-width of the interval of the order", |estimate| {
            decimals(2)(estimate.order.half_width())
        }),
        of("extrapolated u", "extrapolated value (m)", limit_shown),
        of("+- (95 %)", "half-width of the interval of the limit (m)", |estimate| {
            short(estimate.limit.half_width())
        }),
        LimitColumn::text("true error", "distance of the limit from the exact value (m)", |row| {
            let (exact, estimate) = (row.1.observed_exact()?, limit(row)?);
            Some(short((estimate.limit.value - exact).abs()))
        }),
        LimitColumn::text(
            "exact u inside",
            "whether the interval contains the exact value",
            |(_, study)| study.limit_is_covered().map(|covered| if covered { "yes" } else { "no" }),
        ),
        LimitColumn::text("reason for no estimate", "why there is no limit", |(_, study)| {
            study.observed_limit?.err().map(EstimateRefusal::name)
        })
        .flush_left(),
    ]
}
