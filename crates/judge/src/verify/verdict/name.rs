//! Names of verdicts.

use std::fmt;
use std::str::FromStr;

/// Behaviour of a series of errors. Only [`Verdict::Converging`] supports a claimed order. Every
/// other verdict names the reason why the order is not supported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Verdict {
    /// The whole confidence interval of the observed order lies in the expected range.
    Converging,
    /// The observed order is above the expected range, which indicates a defect of the test.
    TooGood,
    /// The observed order is below the expected range.
    TooLow,
    /// The error stops decreasing because of round-off or an axis that was not refined.
    AtFloor,
    /// The error decreases, but no window of levels has a settled order.
    PreAsymptotic,
    /// The error rises and falls under refinement without a clear trend.
    Oscillatory,
    /// The error grows under refinement.
    Divergent,
    /// A level failed, or a number is invalid as an error or a spacing.
    Failed,
    /// There are fewer usable levels than a claimed order requires.
    TooFewLevels,
}

impl Verdict {
    /// All verdicts, in the order of declaration.
    pub const ALL: [Self; 9] = [
        Self::Converging,
        Self::TooGood,
        Self::TooLow,
        Self::AtFloor,
        Self::PreAsymptotic,
        Self::Oscillatory,
        Self::Divergent,
        Self::Failed,
        Self::TooFewLevels,
    ];

    /// Returns the name of the verdict in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Converging => "converging",
            Self::TooGood => "too good",
            Self::TooLow => "too low",
            Self::AtFloor => "at floor",
            Self::PreAsymptotic => "pre-asymptotic",
            Self::Oscillatory => "oscillatory",
            Self::Divergent => "divergent",
            Self::Failed => "failed",
            Self::TooFewLevels => "too few levels",
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A name that is not a verdict.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{word}` is not a verdict; known: {}", Verdict::ALL.map(Verdict::name).join(", "))]
pub struct UnknownVerdict {
    /// Name that is not a verdict.
    pub word: String,
}

impl FromStr for Verdict {
    type Err = UnknownVerdict;

    /// Parses the name as printed or in snake case (`too_good`, `pre_asymptotic`).
    fn from_str(word: &str) -> Result<Self, UnknownVerdict> {
        Self::ALL
            .into_iter()
            .find(|verdict| word == verdict.name() || word == snake_case(verdict.name()))
            .ok_or_else(|| UnknownVerdict { word: word.into() })
    }
}

fn snake_case(name: &str) -> String {
    name.replace([' ', '-'], "_")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_reads_back_in_both_spellings() {
        for verdict in Verdict::ALL {
            assert_eq!(verdict.to_string().parse(), Ok(verdict));
            assert_eq!(snake_case(verdict.name()).parse(), Ok(verdict));
        }
    }

    #[test]
    fn an_unknown_word_is_refused_and_the_known_ones_are_listed() {
        let diagnostic = "fine".parse::<Verdict>().unwrap_err().to_string();
        assert!(diagnostic.starts_with("`fine` is not a verdict"));
        assert!(Verdict::ALL.iter().all(|v| diagnostic.contains(v.name())));
    }
}
