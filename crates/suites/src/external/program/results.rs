//! Results of a solver in files: one table (CSV) for each level, in place of a running process.

use super::answer::{ColumnText, Hello, Points, State, StatedCapabilities};
use super::inquiry::Inquiry;
use super::solver::PROTOCOL;
use super::subject::ProgramSubject;
use crate::external::SolverFactory;
use crate::external::capabilities::{Capabilities, ProblemNeeds, everything, hint};
use crate::external::problem::LevelProblem;
use crate::subject::{Failure, Precision, Subject, SubjectError};
use crate::suite::yaml::{Diagnostic, read_text};
use serde_json::{Value, json};
use std::f64::consts::{E, PI, SQRT_2};
use std::path::Path;

/// Maximum size of a file (bytes).
const MOST_BYTES: usize = 1 << 30;

/// Maximum difference between a label in a table and the label of its particle, relative to the
/// distance between particles, and between a time and the time of a result, relative to the step.
/// Rounding in the table has no effect on the result.
const TOLERANCE: f64 = 0.01;

/// Factors whose ratios are irrational, for the projection of keys.
const IRRATIONAL: [f64; 4] = [1.0, SQRT_2, PI, E];

/// Units of length, with their number in a metre.
const UNITS: [(&str, f64); 5] =
    [("mm", 1e3), ("cm", 1e2), ("um", 1e6), ("inches", 1.0 / 0.0254), ("km", 1e-3)];

/// A level whose results are in a file.
#[derive(Debug, Clone)]
pub struct ResultLevel {
    /// File name without extension.
    pub name: String,
    /// Problem of the level.
    pub problem: LevelProblem,
}

impl ResultLevel {
    /// Returns the names of the columns that a table of this level must have, with labels in place
    /// of particle numbers.
    pub fn required_columns(&self, needs: &ProblemNeeds) -> Vec<String> {
        let time = (self.problem.instants.len() > 1).then_some("t");
        let velocity = needs.velocity.then_some("velocity");
        let quantities = time.into_iter().chain(["reference_position", "displacement"]);
        let quantities = quantities.chain(velocity).chain(needs.columns.iter().copied());
        quantities.flat_map(|quantity| columns(quantity, self.problem.dimension)).collect()
    }

    fn rows(&self) -> usize {
        self.problem.particles.len() * self.problem.instants.len()
    }
}

/// An external solver whose results are in a folder.
#[derive(Debug)]
pub struct ResultFolder {
    hello: Hello,
    levels: Vec<LevelResults>,
}

#[derive(Debug)]
pub(super) struct LevelResults {
    problem: Value,
    points: Option<Points>,
    pub(super) states: Vec<State>,
}

impl ResultFolder {
    /// Reads the results of all `levels` of a solver with the name, order and precision of
    /// [`SolverFactory`].
    ///
    /// # Errors
    /// If a file is missing or invalid, or does not have one row for each particle and time.
    pub fn read(
        folder: &Path,
        levels: &[ResultLevel],
        name: &str,
        formal_order: f64,
        precision: Precision,
    ) -> Result<Self, Diagnostic> {
        let file = |level: &ResultLevel| format!("{}.csv", level.name);
        let names: Vec<String> = levels.iter().map(file).collect();
        let read = |level: &ResultLevel| {
            let path = folder.join(file(level));
            let text = read_text(&path, MOST_BYTES, "table").map_err(|diagnostic| {
                diagnostic.with_help(&format!("expected the files {}", names.join(", ")))
            })?;
            read_level(&path.display().to_string(), &text, level, levels)
        };
        let levels: Vec<LevelResults> = levels.iter().map(read).collect::<Result<_, _>>()?;
        let states = || levels.iter().flat_map(|level| &level.states);
        let mut columns: Vec<String> = REPORTED.map(str::to_owned).to_vec();
        columns.retain(|name| states().all(|state| state.columns.contains_key(name)));
        let known = Capabilities { columns, ..everything() };
        let hello = Hello {
            protocol: PROTOCOL,
            name: name.to_owned(),
            version: format!("results in {}", folder.display()),
            formal_order,
            precision,
            capabilities: StatedCapabilities { known, keys: Vec::new() },
        };
        Ok(Self { hello, levels })
    }

    fn has_velocity(&self) -> bool {
        self.hello.capabilities.known.columns.iter().any(|column| column == "velocity")
    }
}

impl SolverFactory for ResultFolder {
    fn name(&self) -> &str {
        &self.hello.name
    }

    fn formal_order(&self) -> f64 {
        self.hello.formal_order
    }

    fn precision(&self) -> Precision {
        self.hello.precision
    }

    fn settings(&self) -> Vec<(String, String)> {
        self.hello.settings()
    }

    fn lacks(&self, needs: &ProblemNeeds) -> Vec<String> {
        let mut lacking = self.hello.capabilities.known.lacking(needs);
        if needs.velocity && !self.has_velocity() {
            lacking.push("columns: velocity".to_owned());
        }
        if needs.crossings {
            lacking.push("the number of particles that change cells".to_owned());
        }
        lacking
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        let (key, h, dt) = (json!(problem), problem.grid.h, problem.dt);
        let level = self.levels.iter().find(|level| level.problem == key);
        let level = level.ok_or_else(|| format!("no results for h = {h} m and dt = {dt} s"))?;
        let mut states = level.states.clone().into_iter();
        let next = move |_, _: &mut Inquiry| Ok((states.next().unwrap_or_default(), Vec::new()));
        let (inquiry, points) = (Inquiry::new(&problem, PROTOCOL, false), level.points.clone());
        let subject =
            ProgramSubject::new(Box::new(next), inquiry, &problem, points, &[], &self.hello);
        let subject = subject.map_err(|error| Failure::External(error.to_string()))?;
        Ok(Box::new(if self.has_velocity() { subject } else { subject.omit_velocities() }))
    }
}

/// Quantities of a state, as in the protocol.
const REPORTED: [&str; 5] =
    ["displacement", "velocity", "stress", "stress_across", "deformation_gradient"];

/// Returns the names of the columns of a quantity in `d` dimensions.
fn columns(quantity: &str, d: usize) -> Vec<String> {
    let axes = &["x", "y", "z"][..d];
    let vector = |name: &str| axes.iter().map(|i| format!("{name}_{i}")).collect();
    let tensor = |name: &'static str| {
        (0..d * d).map(move |k| format!("{name}_{}{}", axes[k / d], axes[k % d])).collect()
    };
    match quantity {
        "reference_position" => axes.iter().map(|i| i.to_uppercase()).collect(),
        "displacement" => vector("u"),
        "velocity" => vector("v"),
        "stress" => tensor("stress"),
        "deformation_gradient" => tensor("F"),
        "stress_across" if d != 2 => Vec::new(),
        "stress_across" => vec!["stress_zz".to_owned()],
        name => vec![name.to_owned()],
    }
}

/// Rows of numbers with named columns.
struct ResultTable<'a> {
    file: &'a str,
    text: &'a str,
    dimension: usize,
    /// Byte offsets of the lines that are not empty. The first line has the names.
    lines: Vec<usize>,
    names: Vec<&'a str>,
    numbers: Vec<f64>,
}

impl<'a> ResultTable<'a> {
    fn parse(file: &'a str, text: &'a str, dimension: usize) -> Result<Self, Diagnostic> {
        let quantities = ["t", "particle", "weight", "reference_position"].iter().chain(&REPORTED);
        let known: Vec<String> = quantities.flat_map(|name| columns(name, dimension)).collect();
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let (lines, names, numbers) = (Vec::new(), Vec::new(), Vec::new());
        let mut table = Self { file, text, dimension, lines, names, numbers };
        let mut start = 0;
        for line in text.split_inclusive('\n') {
            start += line.len();
            if line.trim().is_empty() {
                continue;
            }
            table.lines.push(start - line.len());
            let (row, cells) = (table.lines.len() - 1, line.split(',').count());
            for (column, word) in line.split(',').map(str::trim).enumerate() {
                let number = word.parse().ok().filter(|number: &f64| number.is_finite());
                let (message, help) = if row == 0 && !known.contains(&word) {
                    let help = "the first line has names, and commas between them";
                    (format!("unknown column `{word}`"), format!("{}; {help}", hint(word, &known)))
                } else if row == 0 && table.names.contains(&word) {
                    (format!("column `{word}` is doubled"), String::new())
                } else if row == 0 {
                    table.names.push(word);
                    continue;
                } else if column == table.names.len() || cells < table.names.len() {
                    let message = format!("found {cells} cells, expected {}", table.names.len());
                    (message, "expected points in numbers, and commas between them".to_owned())
                } else if let Some(number) = number {
                    table.numbers.push(number);
                    continue;
                } else {
                    let help = "expected a number such as 0.125 or 1.25e-1, without quotes";
                    (format!("`{word}` is not a finite number"), help.to_owned())
                };
                return Err(table.at(row, column, &message, &help));
            }
        }
        match table.lines.as_slice() {
            [] => Err(Diagnostic::about(file, "the file is empty")),
            _ => Ok(table),
        }
    }

    /// Creates an error about a cell; row 0 has the names.
    fn at(&self, row: usize, column: usize, message: &str, help: &str) -> Diagnostic {
        let line = self.text[self.lines[row]..].lines().next().unwrap_or_default();
        let before: usize = line.split(',').take(column).map(|cell| cell.len() + 1).sum();
        let cell = line.split(',').nth(column).unwrap_or_default();
        let start = self.lines[row] + before + cell.len() - cell.trim_start().len();
        let range = start..start + cell.trim().len();
        Diagnostic::at(self.file, self.text, range, message).with_help(help)
    }

    /// Returns the columns of a quantity; empty without any of them.
    fn columns(&self, quantity: &str) -> Result<Vec<usize>, Diagnostic> {
        let at = |name: &str| self.names.iter().position(|known| *known == name);
        let names = columns(quantity, self.dimension);
        let Some(first) = names.iter().find_map(|name| at(name)) else { return Ok(Vec::new()) };
        let missing = |name| {
            self.at(0, first, &format!("column `{name}` is missing"), "expected all components")
        };
        names.iter().map(|name| at(name).ok_or_else(|| missing(name))).collect()
    }

    fn numbers(&self, row: usize, columns: &[usize]) -> Vec<f64> {
        let start = (row - 1) * self.names.len();
        columns.iter().map(|column| self.numbers[start + column]).collect()
    }

    /// Returns the row of each of the `expected` keys, which are numbers in the columns `keys`.
    /// Keys whose distances add up to at most [`TOLERANCE`] agree.
    fn order(
        &self,
        keys: &[usize],
        expected: &[Vec<f64>],
        scales: &[f64],
        advice: &str,
    ) -> Result<Vec<usize>, Diagnostic> {
        // The projections of different keys are different, as far as possible.
        let projected = |key: &[f64]| -> f64 {
            let terms = key.iter().zip(scales).zip(IRRATIONAL);
            terms.map(|((number, scale), factor)| factor * number / scale).sum()
        };
        let distances = |a: &[f64], b: &[f64]| -> Vec<f64> {
            a.iter().zip(b).zip(scales).map(|((a, b), scale)| (a - b).abs() / scale).collect()
        };
        let distance = |i: usize, key: &[f64]| distances(&expected[i], key).iter().sum::<f64>();
        let shown = |key: &[f64]| {
            let each =
                keys.iter().zip(key).map(|(k, number)| format!("{} = {number}", self.names[*k]));
            each.collect::<Vec<_>>().join(", ")
        };
        let mut sorted: Vec<(f64, usize)> =
            expected.iter().enumerate().map(|(i, key)| (projected(key), i)).collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        let reach = TOLERANCE * PI;
        let mut order = vec![0; expected.len()];
        for row in 1..self.lines.len() {
            let key = self.numbers(row, keys);
            let at = projected(&key);
            let start = sorted.partition_point(|(other, _)| *other < at - reach);
            let near = sorted[start..].iter().take_while(|(other, _)| *other <= at + reach);
            let found = near.map(|(_, i)| *i).find(|i| distance(*i, &key) <= TOLERANCE);
            let Some(i) = found else {
                let by_distance =
                    |a: &usize, b: &usize| distance(*a, &key).total_cmp(&distance(*b, &key));
                let nearest = (0..expected.len()).min_by(by_distance).map(|i| &expected[i]);
                let nearest = nearest.map_or(&[][..], Vec::as_slice);
                let far = distances(nearest, &key).iter().position(|far| *far > TOLERANCE);
                let message = format!("no row is expected for {}", shown(&key));
                let help = format!("the nearest one is {}{advice}", shown(nearest));
                return Err(self.at(row, keys[far.unwrap_or_default()], &message, &help));
            };
            let first = std::mem::replace(&mut order[i], row);
            if first > 0 {
                let line = 1 + self.text[..self.lines[first]].matches('\n').count();
                let message = format!("the row of {} is doubled", shown(&expected[i]));
                return Err(self.at(row, keys[0], &message, &format!("see line {line}")));
            }
        }
        if let Some(first) = order.iter().position(|row| *row == 0) {
            let missing = order.iter().filter(|row| **row == 0).count();
            let message = format!("there is no row for {}", shown(&expected[first]));
            let help = format!("{missing} of {} rows are missing{advice}", order.len());
            return Err(Diagnostic::about(self.file, &message).with_help(&help));
        }
        Ok(order)
    }
}

/// Reads the table `text` of a level. `all` are the levels of the suite.
pub(super) fn read_level(
    file: &str,
    text: &str,
    level: &ResultLevel,
    all: &[ResultLevel],
) -> Result<LevelResults, Diagnostic> {
    let (problem, d) = (&level.problem, level.problem.dimension);
    let table = ResultTable::parse(file, text.strip_prefix('\u{feff}').unwrap_or(text), d)?;
    let (label, weight) = (table.columns("reference_position")?, table.columns("weight")?);
    let (particle, time) = (table.columns("particle")?, table.columns("t")?);
    let times = problem.times();
    let missing = if table.columns("displacement")?.is_empty() {
        Some("the displacement (`u_x`, ...)")
    } else if label.is_empty() == particle.is_empty() || label.len() < weight.len() {
        Some("either labels (`X`, ...) or the row in the level file (`particle`)")
    } else {
        (times.len() > 1 && time.is_empty()).then_some("the time (`t`)")
    };
    if let Some(missing) = missing {
        let help = format!("expected results at t = {times:?}");
        return Err(table.at(0, 0, &format!("the table lacks {missing}"), &help));
    }
    let is_negative = |row: &usize| table.numbers(*row, &weight).iter().any(|x| *x <= 0.0);
    if let Some(row) = (1..table.lines.len()).find(is_negative) {
        return Err(table.at(row, weight[0], "expected a positive weight", ""));
    }
    let is_first = |row: &usize| {
        table.numbers(*row, &time).iter().all(|t| (t - times[0]).abs() <= TOLERANCE * problem.dt)
    };
    let of_first = |columns: &[usize]| -> Vec<f64> {
        let rows = (1..table.lines.len()).filter(is_first);
        rows.flat_map(|row| table.numbers(row, columns)).collect()
    };
    let points = (!weight.is_empty()).then(|| [of_first(&label), of_first(&weight)]);
    let labels = points.as_ref().map_or(&problem.particles.reference_position, |[label, _]| label);
    let size = |numbers: &[f64]| numbers.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    let ratio = size(&of_first(&label)) / size(labels);
    let unit = UNITS.iter().find(|(_, factor)| (ratio / factor - 1.0).abs() < 1e-3);
    let rows = table.lines.len() - 1;
    let other = all.iter().find(|other| other.rows() == rows && level.rows() != rows);
    let advice = match (unit, other) {
        (Some((unit, _)), _) => format!("; the labels look like {unit}, expected m"),
        (None, Some(other)) => format!("; {}.csv has as many rows as this file", other.name),
        (None, None) => String::new(),
    };
    let per_cell = problem.particles_per_cell.unwrap_or(1) as f64;
    let spacing = problem.grid.h / libm::pow(per_cell, 1.0 / d as f64);
    let mut scales = vec![problem.dt; time.len()];
    scales.extend(label.iter().map(|_| spacing).chain(particle.iter().map(|_| 1.0)));
    let mut expected = Vec::new();
    for t in &times {
        for (p, at) in labels.chunks_exact(d).enumerate() {
            let number = (p + 1) as f64;
            let place = if label.is_empty() { std::slice::from_ref(&number) } else { at };
            expected.push([&vec![*t; time.len()], place].concat());
        }
    }
    let order = table.order(&[time, label, particle].concat(), &expected, &scales, &advice)?;
    let mut states = vec![State::default(); times.len()];
    for quantity in REPORTED {
        let columns = table.columns(quantity)?;
        for (state, rows) in states.iter_mut().zip(order.chunks(labels.len().max(d) / d)) {
            if !columns.is_empty() {
                let numbers = rows.iter().flat_map(|row| table.numbers(*row, &columns)).collect();
                state.columns.insert(quantity.to_owned(), ColumnText::Numbers(numbers));
            }
        }
    }
    let points = points.map(|[label, weight]| Points {
        reference_position: ColumnText::Numbers(label),
        weight: ColumnText::Numbers(weight),
    });
    Ok(LevelResults { problem: json!(problem), points, states })
}
