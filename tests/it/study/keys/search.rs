//! Finds the cheapest gate that notices a change of each number.

use super::grammar::Node;
use super::leaf::{Change, Place, words};
use super::reasons::reason;
use super::solver::Known;
use super::{Keys, page};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Mutex;

/// Change that at least one gate must notice.
const ONE_PERCENT: Change = Change::Times(1.01);

/// Factors that are tried if the change of 1 % is not noticed.
const LARGER: [f64; 7] = [1.1, 2.0, 0.5, 10.0, 0.1, 1e3, 1e-3];

/// Factors that are tried if the change of 1 % is noticed.
const SMALLER: [f64; 2] = [1.001, 1.0001];

/// Number of suites in which larger changes are tried: the cheapest ones, and as many of the other
/// cheapest ones with an expected order. All changes are tried only in these suites for keys of the
/// judge and keys with a reason. A suite that is exact to rounding has no order to lose.
const FEW: usize = 6;

/// First keys of the numbers that a solver uses. All other numbers belong to the judge or to the
/// exact solution.
const OF_SOLVER: [&str; 6] =
    ["scene", "manufactured", "particles", "methods.mpm", "stability.particles", "internal_force"];

/// First keys of an exact solution. A change of such a number is noticed when the suite is loaded.
const OF_TRUTH: [&str; 2] = ["exact.", "equilibrium."];

/// Results of the search.
pub(super) struct Found {
    /// Keys of all numbers in the grammar.
    pub(super) keys: BTreeSet<String>,
    /// Results for the keys whose number was changed.
    pub(super) rows: Vec<Row>,
    /// Number of suites that use each name, by key and name.
    pub(super) names: BTreeMap<(String, String), usize>,
}

/// Result for one number of the grammar.
pub(super) struct Row {
    pub(super) key: String,
    /// Number of suites that use the number.
    pub(super) suites: usize,
    pub(super) seen: Option<Seen>,
}

/// The gate that notices a change, and the change.
pub(super) struct Seen {
    pub(super) gate: String,
    pub(super) suite: String,
    /// Name of the case; `None` if the suite is refused.
    pub(super) case: Option<String>,
    /// Smallest change that this case notices.
    pub(super) least: Change,
    pub(super) seconds: f64,
}

/// Whether a solver uses the number of the key.
pub(super) fn is_of_solver(key: &str) -> bool {
    let below = |first: &str| {
        key.strip_prefix(first).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    };
    OF_SOLVER.iter().any(|first| below(first)) && !key.contains(".expect.")
}

/// Index of a suite, and all paths of a number in it.
type Use = (usize, Vec<Place>);

/// Uses of each number, by its key. Cheap suites come first.
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

/// Changes every number of the grammar whose key contains `part`.
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

/// Asserts that a row of the table still holds.
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

/// Lists every position of a number in suites.
fn each<'a>(uses: &[&'a Use]) -> impl Iterator<Item = (usize, &'a Place)> + Clone {
    uses.iter().flat_map(|(suite, places)| places.iter().map(|place| (*suite, place)))
}

/// Name of a gate, and the index of the case; `None` if the suite is refused.
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

    /// Returns the first gate of a suite that notices a change.
    ///
    /// # Errors
    /// Reason why the changed suite is refused.
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

    /// Returns the first suite that notices the smallest change that any suite notices.
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
        // A change of 1 % is not possible for an integer.
        let one_more = refused.into_iter().map(|at| (at, Change::PlusOne));
        let larger = LARGER
            .into_iter()
            .flat_map(|factor| each(&cheap).map(move |at| (at, Change::Times(factor))));
        one_more.chain(larger).find_map(|(at, change)| {
            let found = self.noticed(key, at, change).ok()??;
            Some(self.described(at.0, found, change))
        })
    }

    /// Returns the smallest change that a gate notices. The gate already notices a change of 1 %.
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
