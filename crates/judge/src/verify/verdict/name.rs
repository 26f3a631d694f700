//! Names of verdicts.

use mpm_subject::named;
use std::fmt;
use std::str::FromStr;

named! {
    /// Behaviour of a series of errors. Only [`Verdict::Converging`] supports a claimed order.
    /// Every other verdict names the reason why the order is not supported.
    pub enum Verdict {
        /// The whole confidence interval of the observed order lies in the expected range.
        Converging = "converging",
        /// The observed order is above the expected range, which indicates a defect of the test.
        TooGood = "too good",
        /// The observed order is below the expected range.
        TooLow = "too low",
        /// The error stops decreasing because of round-off or an axis that was not refined.
        AtFloor = "at floor",
        /// The error decreases, but no window of levels has a settled order.
        PreAsymptotic = "pre-asymptotic",
        /// The error rises and falls under refinement without a clear trend.
        Oscillatory = "oscillatory",
        /// The error grows under refinement.
        Divergent = "divergent",
        /// A level failed, or a number is invalid as an error or a spacing.
        Failed = "failed",
        /// There are fewer usable levels than a claimed order requires.
        TooFewLevels = "too few levels",
    }
}

impl Verdict {
    /// Returns the name as suites write it, in snake case (`too_good`, `pre_asymptotic`).
    pub fn key(self) -> String {
        self.name().replace([' ', '-'], "_")
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A name that is not a verdict.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{word}` is not a verdict; known: {}", names().join(", "))]
pub struct UnknownVerdict {
    /// Name that is not a verdict.
    pub word: String,
}

impl FromStr for Verdict {
    type Err = UnknownVerdict;

    /// Parses the name as printed or in snake case (`too_good`, `pre_asymptotic`).
    fn from_str(word: &str) -> Result<Self, UnknownVerdict> {
        let is_name = |verdict: &Self| word == verdict.name() || word == verdict.key();
        let found = Self::ALL.iter().copied().find(is_name);
        found.ok_or_else(|| UnknownVerdict { word: word.into() })
    }
}

fn names() -> Vec<&'static str> {
    Verdict::ALL.iter().map(|verdict| verdict.name()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_reads_back_in_both_spellings() {
        for &verdict in Verdict::ALL {
            assert_eq!(verdict.to_string().parse(), Ok(verdict));
            assert_eq!(verdict.key().parse(), Ok(verdict));
        }
    }

    #[test]
    fn an_unknown_word_is_refused_and_the_known_ones_are_listed() {
        let diagnostic = "fine".parse::<Verdict>().unwrap_err().to_string();
        assert!(diagnostic.starts_with("`fine` is not a verdict"));
        assert!(Verdict::ALL.iter().all(|v| diagnostic.contains(v.name())));
    }
}
