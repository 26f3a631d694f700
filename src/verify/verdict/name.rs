//! Names of verdicts.

use std::fmt;
use std::str::FromStr;

/// Behaviour of a series of errors. Only [`Verdict::Converging`] supports a claimed order; every
/// other verdict is a reason why it is not supported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Verdict {
    /// The whole confidence interval of the observed order lies in the expected range.
    Converging,
    /// The observed order is above the expected range: a defect in the test, not a success.
    TooGood,
    /// The observed order is below the expected range.
    TooLow,
    /// The error stops falling: round-off, or the plateau of an axis that was not refined.
    AtFloor,
    /// The error falls, but no window of levels has a settled order.
    PreAsymptotic,
    /// The error rises and falls under refinement without a clear trend.
    Oscillatory,
    /// The error grows under refinement.
    Divergent,
    /// A level failed, or a figure is not one that an error or a spacing can have.
    Failed,
    /// Fewer usable levels than any claim needs.
    TooFewLevels,
}

impl Verdict {
    /// Every verdict, in the order of their declaration.
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

    /// The verdict as reports print it.
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
#[non_exhaustive]
pub struct UnknownVerdict {
    /// The given name.
    pub word: String,
}

impl FromStr for Verdict {
    type Err = UnknownVerdict;

    /// Reads the name as printed or in snake case (`too_good`, `pre_asymptotic`).
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
