//! Changes between two runs.

use crate::report::text::prose::counted;
use mpm_subject::named;

named! {
    /// Kinds of changes of a case, the most important first.
    pub enum Rank {
        /// The case no longer meets its expectations.
        Broken = "newly failing",
        /// The verdict is worse, but whether the case meets its expectations has not changed.
        WorseVerdict = "worse verdict",
        /// The verdict is different, but neither better nor worse.
        OtherVerdict = "other verdict",
        /// The verdict is better, or the case meets its expectations again.
        BetterVerdict = "better verdict",
        /// An error is larger, or a level newly fails.
        LessAccurate = "less accurate",
        /// A stability limit is lower.
        LessStable = "less stable",
        /// More transfers are required on the same level.
        MoreExpensive = "more expensive",
        /// The case is more accurate, more stable or cheaper.
        Better = "better",
        /// The problem has changed, so changes of results give no information about the method.
        OtherProblem = "with a changed problem",
        /// The judged quantity or the refinement has changed, so the results cannot be compared.
        Otherwise = "judged or refined differently",
        /// The case is new.
        New = "new",
        /// The case was removed.
        Gone = "gone",
    }
}

impl Rank {
    /// Whether the change is for the worse.
    pub const fn is_worse(self) -> bool {
        matches!(
            self,
            Self::Broken
                | Self::WorseVerdict
                | Self::LessAccurate
                | Self::LessStable
                | Self::MoreExpensive
        )
    }
}

/// Result of comparing two runs.
#[derive(Debug, Clone, PartialEq)]
pub struct ReportComparison {
    pub(super) problems: Vec<ProblemMove>,
    /// Cases that changed, the most important first.
    pub(super) moved: Vec<Moved>,
    /// Target errors whose minimum work has changed, the more expensive ones first.
    pub(super) cheapest: Vec<CheapestMove>,
    pub(super) unchanged: usize,
    /// Values with a smaller relative difference count as unchanged.
    pub(super) tolerance: f64,
}

/// A suite whose problem has changed. Changes of its results give no information about a solver.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ProblemMove {
    pub(super) suite: String,
    /// Statement rows that differ: name, old value and new value.
    pub(super) rows: Vec<[String; 3]>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Moved {
    /// `SUITE::CASE`.
    pub(super) name: String,
    pub(super) rank: Rank,
    /// Old and new verdict.
    pub(super) verdict: [Option<String>; 2],
    /// Old and new observed order.
    pub(super) order: [Option<f64>; 2],
    pub(super) error: Option<ErrorMove>,
    /// Ratio of the new to the old transfers on one level.
    pub(super) work: Option<f64>,
    /// Remarks that the columns do not contain.
    pub(super) notes: Vec<String>,
    /// Sort key within a rank, in decreasing order.
    pub(super) weight: f64,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct ErrorMove {
    /// Old error; `None` if the level failed.
    pub(super) old: Option<f64>,
    /// New error; `None` if the level fails.
    pub(super) new: Option<f64>,
    pub(super) worse: bool,
    pub(super) level: String,
}

/// Change of the minimum work for a target error.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CheapestMove {
    /// Name of the suite, and of the problem if the suite has several.
    pub(super) place: String,
    pub(super) target: f64,
    /// Minimum work in the old run and its method; `None` if no method reaches the target.
    pub(super) old: Option<(f64, String)>,
    pub(super) new: Option<(f64, String)>,
}

impl CheapestMove {
    /// Returns the ratio of new to old work: infinite if the target is no longer reached, and zero
    /// if only the new run reaches it.
    pub(super) fn ratio(&self) -> f64 {
        match (&self.old, &self.new) {
            (Some((old, _)), Some((new, _))) => new / old,
            (Some(_), None) => f64::INFINITY,
            (None, _) => 0.0,
        }
    }
}

impl ErrorMove {
    pub(super) fn ratio(&self) -> Option<f64> {
        Some(self.new? / self.old?)
    }

    /// Returns the size of the change in either direction; infinite if a level newly fails.
    pub(super) fn weight(&self) -> f64 {
        self.ratio().map_or(f64::INFINITY, |ratio| libm::log(ratio).abs())
    }
}

impl ReportComparison {
    /// Counts the cases with this kind of change.
    pub fn count(&self, rank: Rank) -> usize {
        self.of(rank).count()
    }

    /// Whether any result has become worse.
    pub fn is_worse(&self) -> bool {
        let is_worse = self.cheapest.iter().any(|target| !(target.ratio() < 1.0));
        is_worse || self.moved.iter().any(|moved| moved.rank.is_worse())
    }

    pub(super) fn of(&self, rank: Rank) -> impl Iterator<Item = &Moved> {
        self.moved.iter().filter(move |moved| moved.rank == rank)
    }

    /// Summarises the changes in one line: `2 less accurate, 1 new, 816 unchanged`.
    pub(super) fn headline(&self) -> String {
        let counts = Rank::ALL.iter().map(|rank| (self.count(*rank), rank.name()));
        let counts = counts.chain([(self.unchanged, "unchanged")]).filter(|(count, _)| *count > 0);
        let mut parts: Vec<String> =
            counts.map(|(count, words)| format!("{count} {words}")).collect();
        let targets = |costs_more: bool, words: &str| {
            let of = |target: &&CheapestMove| (target.ratio() < 1.0) != costs_more;
            let count = self.cheapest.iter().filter(of).count();
            (count > 0).then(|| format!("{} {words}", counted(count, "target")))
        };
        parts.extend(targets(true, "more expensive to reach"));
        parts.extend(targets(false, "cheaper to reach"));
        if parts.is_empty() { "no cases".to_owned() } else { parts.join(", ") }
    }
}

/// Whether a ratio differs from one by more than the tolerance in either direction; true for NaN.
pub(super) fn ratio_moved(ratio: f64, tolerance: f64) -> bool {
    !(ratio <= 1.0 + tolerance && 1.0 / ratio <= 1.0 + tolerance)
}
