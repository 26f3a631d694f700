//! The cheapest gate that notices a change of each number.

use super::grammar::Node;
use super::leaf::{Change, Place, words};
use super::reasons::reason;
use super::solver::Known;
use super::{Keys, page};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Mutex;

/// The change that some gate is to notice.
const ONE_PERCENT: Change = Change::Times(1.01);

/// Changes that are tried if this one is not noticed.
const LARGER: [f64; 7] = [1.1, 2.0, 0.5, 10.0, 0.1, 1e3, 1e-3];

/// Changes that are tried if it is noticed.
const SMALLER: [f64; 2] = [1.001, 1.0001];

/// Number of cheapest suites, and of cheapest other suites with an expected order, in which larger
/// changes are tried, and all changes of keys of the judge or with a reason. A suite that is exact
/// to rounding has no order to lose.
const FEW: usize = 6;

/// First keys of the numbers that a solver uses; all others belong to the judge, or to the exact
/// solution.
const OF_SOLVER: [&str; 6] =
    ["scene", "manufactured", "particles", "methods.mpm", "stability.particles", "internal_force"];

/// First keys of an exact solution, whose change is noticed when a suite is loaded.
const OF_TRUTH: [&str; 2] = ["exact.", "equilibrium."];

/// Everything that was found.
pub(super) struct Found {
    /// Every number of the grammar.
    pub(super) keys: BTreeSet<String>,
    /// Keys whose number was changed.
    pub(super) rows: Vec<Row>,
    /// Key and name, and the number of suites that have it.
    pub(super) names: BTreeMap<(String, String), usize>,
}

/// A number of the grammar.
pub(super) struct Row {
    pub(super) key: String,
    /// Suites that use it.
    pub(super) suites: usize,
    pub(super) seen: Option<Seen>,
}

/// The gate that notices a change.
pub(super) struct Seen {
    pub(super) gate: String,
    pub(super) suite: String,
    /// None of a suite that is refused.
    pub(super) case: Option<String>,
    /// The smallest change that this case notices.
    pub(super) least: Change,
    pub(super) seconds: f64,
}

/// Whether a key is of the solver's side.
pub(super) fn is_of_solver(key: &str) -> bool {
    let below = |first: &str| {
        key.strip_prefix(first).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    };
    OF_SOLVER.iter().any(|first| below(first)) && !key.contains(".expect.")
}

/// A suite, and all places of a number in it.
type Use = (usize, Vec<Place>);

/// Uses of each number, by its key, in cheap suites first.
type Uses = BTreeMap<String, Vec<Use>>;

fn uses(grammars: &[(&str, Node)], suites: &[Known]) -> (Uses, BTreeMap<(String, String), usize>) {
    let (mut numbers, mut names) = (Uses::new(), BTreeMap::new());
    for (i, known) in suites.iter().enumerate() {
        let mut own = BTreeSet::new();
        for word in of_suite(grammars, known) {
            if let Some(place) = word.number {
                let of_key = numbers.entry(word.key).or_default();
                match of_key.last_mut() {
                    Some((suite, places)) if *suite == i => places.push(place),
                    _ => of_key.push((i, vec![place])),
                }
            } else if let Some(name) = word.name {
                own.insert((word.key, name));
            }
        }
        for word in own {
            *names.entry(word).or_default() += 1;
        }
    }
    (numbers, names)
}

fn of_suite(grammars: &[(&str, Node)], known: &Known) -> Vec<super::leaf::Word> {
    let grammar = grammars.iter().find(|(study, _)| *study == known.study);
    words(&grammar.expect("a kind of study").1, &known.study, &known.text)
}

/// Changes every number of the grammar that has `part` in its key.
pub(super) fn search(
    keys: &Keys,
    part: &str,
    grammars: &[(&str, Node)],
    suites: &[Known],
) -> Found {
    let (numbers, used) = uses(grammars, suites);
    let control = Control { suites, known: Mutex::default() };
    let of_key = |key: &String| {
        let uses = numbers.get(key).map_or(&[][..], Vec::as_slice);
        let seen = control.seen(key, uses);
        let row = Row { key: key.clone(), suites: uses.len(), seen };
        eprintln!("{}", row.shown());
        row
    };
    let all = keys.iter().filter(|(_, (is_number, _))| *is_number);
    let all: BTreeSet<String> = all.map(|(key, _)| key.clone()).collect();
    let wanted: Vec<&String> = all.iter().filter(|key| key.contains(part)).collect();
    let rows = wanted.into_par_iter().map(of_key).collect();
    let every = keys
        .iter()
        .flat_map(|(key, (_, names))| names.iter().map(move |name| (key.clone(), name.clone())));
    let names = every.map(|word| (word.clone(), used.get(&word).copied().unwrap_or(0))).collect();
    Found { keys: all, rows, names }
}

/// A row of the table that no longer holds is a failure.
pub(super) fn still_noticed(row: &page::Sampled, grammars: &[(&str, Node)], suites: &[Known]) {
    let i = suites.iter().position(|known| known.suite.name == row.suite).expect("a suite");
    let (numbers, _) = uses(grammars, &suites[i..=i]);
    let control = Control { suites, known: Mutex::default() };
    let places = numbers[&row.key].iter().flat_map(|(_, places)| places);
    let mut gates =
        places.filter_map(|place| control.noticed(&row.key, (i, place), row.least).ok()?);
    assert!(
        gates.next().is_some(),
        "{}: {} no longer notices {}",
        row.key,
        row.suite,
        row.least.shown()
    );
}

/// Suites, and the cases that pass without a change.
struct Control<'a> {
    suites: &'a [Known],
    known: Mutex<HashMap<(usize, usize), bool>>,
}

/// Every place of a number in suites.
fn each<'a>(uses: &[&'a Use]) -> impl Iterator<Item = (usize, &'a Place)> + Clone {
    uses.iter().flat_map(|(suite, places)| places.iter().map(|place| (*suite, place)))
}

/// A gate, and the case; `None` if the suite is refused.
type Noticed = (&'static str, Option<usize>);

impl Control<'_> {
    fn passes(&self, suite: usize, case: usize) -> bool {
        let known = self.known.lock().expect("no panic").get(&(suite, case)).copied();
        known.unwrap_or_else(|| {
            let passes = self.suites[suite].unchanged().passes(case);
            self.known.lock().expect("no panic").insert((suite, case), passes);
            passes
        })
    }

    /// The first gate of a suite that notices a change.
    ///
    /// # Errors
    /// Why the changed suite is refused.
    fn noticed(
        &self,
        key: &str,
        (suite, place): (usize, &Place),
        change: Change,
    ) -> Result<Option<Noticed>, String> {
        let known = &self.suites[suite];
        let changed = match known.with(key, place, change) {
            Err(_) if OF_TRUTH.iter().any(|first| key.starts_with(first)) => {
                return Ok(Some(("load", None)));
            }
            changed => changed?,
        };
        let gate = |case: usize| {
            let gate = changed.gate(case)?;
            self.passes(suite, case).then_some((gate, Some(case)))
        };
        Ok(known.cases().into_iter().find_map(gate))
    }

    /// The first suite that notices the smallest of the changes that any notices.
    fn seen(&self, key: &str, uses: &[Use]) -> Option<Seen> {
        let (first, rest) = uses.split_at(uses.len().min(FEW));
        let with_order = rest.iter().filter(|(suite, _)| self.suites[*suite].expects_an_order());
        let cheap: Vec<&Use> = first.iter().chain(with_order.take(FEW)).collect();
        let uses = if is_of_solver(key) && reason(key).is_none() {
            uses.iter().collect()
        } else {
            cheap.clone()
        };
        let mut refused = Vec::new();
        for at in each(&uses) {
            match self.noticed(key, at, ONE_PERCENT) {
                Ok(Some(found)) => return Some(self.smallest(key, at, found)),
                Ok(None) => {}
                Err(_) => refused.push(at),
            }
        }
        // A count has no hundredths.
        let one_more = refused.into_iter().map(|at| (at, Change::PlusOne));
        let larger = LARGER
            .into_iter()
            .flat_map(|factor| each(&cheap).map(move |at| (at, Change::Times(factor))));
        one_more.chain(larger).find_map(|(at, change)| {
            let found = self.noticed(key, at, change).ok()??;
            Some(self.described(at.0, found, change))
        })
    }

    /// The smallest change that a gate notices which notices one per cent.
    fn smallest(&self, key: &str, at: (usize, &Place), found: Noticed) -> Seen {
        let is_noticed = |factor: &f64| {
            let change = Change::Times(*factor);
            match (self.suites[at.0].with(key, at.1, change), found.1) {
                (Ok(changed), Some(case)) => changed.gate(case).is_some(),
                (changed, case) => changed.is_err() && case.is_none(),
            }
        };
        let least = SMALLER.into_iter().take_while(is_noticed).last();
        self.described(at.0, found, least.map_or(ONE_PERCENT, Change::Times))
    }

    fn described(&self, suite: usize, (gate, case): Noticed, least: Change) -> Seen {
        let known = &self.suites[suite];
        let case = case.map(|case| known.suite.case_names()[case].to_owned());
        let (gate, seconds) = (gate.to_owned(), known.seconds);
        Seen { gate, suite: known.suite.name.clone(), case, least, seconds }
    }
}
