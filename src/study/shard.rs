//! Parts of a run of several suites, with about equal predicted cost.

use super::preflight::{UNKNOWN, estimates};
use crate::suite::Extent;
use crate::suite::model::Suite;
use std::str::FromStr;

/// Maximum number of parts of a run.
const MOST: usize = 10_000;

/// Time (s) of a case in addition to its steps.
const SET_UP: f64 = 1e-3;

/// One of several parts of a run: `2/5`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    number: usize,
    count: usize,
}

/// The text does not have the form `K/N`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("expected a number and a count, such as `2/5`, up to {MOST}")]
pub struct ShardError;

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        let parts = text.split_once('/').map(|(number, count)| (number.parse(), count.parse()));
        match parts {
            Some((Ok(number), Ok(count))) if (1..=count).contains(&number) && count <= MOST => {
                Ok(Self { number, count })
            }
            _ => Err(ShardError),
        }
    }
}

impl Shard {
    /// The cases of `suites` in this part; suites without such a case are excluded. The most
    /// expensive remaining case is assigned to the part with the least cost so far (Graham 1969,
    /// SIAM J. Appl. Math. 17, 416: no part takes more than 4/3 of the optimum). The assignment is
    /// the same in every part.
    pub fn of(self, suites: &[Suite], extent: Extent) -> Vec<Suite> {
        let costs: Vec<Vec<f64>> = suites.iter().map(|suite| seconds(suite, extent)).collect();
        let mut all: Vec<(usize, usize)> = Vec::new();
        for (suite, costs) in costs.iter().enumerate() {
            all.extend((0..costs.len()).map(|case| (suite, case)));
        }
        let cost = |(suite, case): (usize, usize)| costs[suite][case];
        all.sort_by(|a, b| cost(*b).total_cmp(&cost(*a)).then(a.cmp(b)));
        let mut loads = vec![0.0; self.count];
        let mut own: Vec<Vec<bool>> = costs.iter().map(|costs| vec![false; costs.len()]).collect();
        for at in all {
            let least = (0..self.count).min_by(|a, b| f64::total_cmp(&loads[*a], &loads[*b]));
            let least = least.unwrap_or(0);
            loads[least] += cost(at);
            own[at.0][at.1] = least + 1 == self.number;
        }
        let parts = suites.iter().zip(&own).filter(|(_, own)| own.contains(&true));
        parts.map(|(suite, own)| suite.only(&|case| own[case])).collect()
    }
}

/// Predicted time (s) of each case.
fn seconds(suite: &Suite, extent: Extent) -> Vec<f64> {
    let predicted = estimates(suite, extent).into_iter();
    predicted.map(|cost| SET_UP + cost.map_or(UNKNOWN, |cost| cost.seconds)).collect()
}
