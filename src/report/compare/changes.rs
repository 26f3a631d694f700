//! Changes between two runs.

use super::equal_error::EqualError;
use super::shared_words::SharedWord;

/// Kind of a change, the most important first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rank {
    /// It met its expectations and no longer does.
    Broken,
    /// Its verdict is a worse one, which its suite expects or expected before.
    WorseVerdict,
    /// Its verdict is another one, neither better nor worse.
    OtherVerdict,
    /// Its verdict is better, or it meets its expectations again.
    BetterVerdict,
    /// An error is larger, or a level has begun to fail.
    LessAccurate,
    /// A stability limit is lower.
    LessStable,
    /// An equal error takes more transfers; if this cannot be compared, a level takes more.
    MoreExpensive,
    /// It is more accurate, more stable or cheaper.
    Better,
    /// Its problem has changed, so that a change of its figures says nothing about the method.
    OtherProblem,
    /// Its judged quantity or its refinement has changed, so that there is nothing to compare.
    Otherwise,
    /// It is new.
    New,
    /// It was removed.
    Gone,
}

impl Rank {
    /// Every rank, in order.
    pub const ALL: [Self; 12] = [
        Self::Broken,
        Self::WorseVerdict,
        Self::OtherVerdict,
        Self::BetterVerdict,
        Self::LessAccurate,
        Self::LessStable,
        Self::MoreExpensive,
        Self::Better,
        Self::OtherProblem,
        Self::Otherwise,
        Self::New,
        Self::Gone,
    ];

    /// Text in reports.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Broken => "no longer as expected",
            Self::WorseVerdict => "worse verdict",
            Self::OtherVerdict => "other verdict",
            Self::BetterVerdict => "better verdict",
            Self::LessAccurate => "less accurate",
            Self::LessStable => "less stable",
            Self::MoreExpensive => "more expensive",
            Self::Better => "better",
            Self::OtherProblem => "of another problem",
            Self::Otherwise => "judged or refined otherwise",
            Self::New => "new",
            Self::Gone => "gone",
        }
    }

    /// Whether that is for the worse.
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

/// Two runs side by side.
#[derive(Debug, Clone, PartialEq)]
pub struct ReportComparison {
    /// Suites whose problem has changed.
    pub(super) problems: Vec<ProblemMove>,
    /// Cases that changed, the most important first.
    pub(super) moved: Vec<Moved>,
    /// Words in the names of worse cases that other cases do not have.
    pub(super) shared_words: Vec<SharedWord>,
    /// Target errors whose least work moved, the more expensive first.
    pub(super) cheapest: Vec<CheapestMove>,
    /// Number of cases without a change.
    pub(super) unchanged: usize,
    /// Largest relative change of a figure that counts as no change.
    pub(super) tolerance: f64,
}

/// A suite whose problem has changed: its figures say nothing about a solver.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ProblemMove {
    pub(super) suite: String,
    /// Rows that differ: name, old and new value.
    pub(super) rows: Vec<[String; 3]>,
}

/// A case that moved.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Moved {
    /// `SUITE::CASE`.
    pub(super) name: String,
    pub(super) rank: Rank,
    /// Verdicts, old and new.
    pub(super) verdict: [Option<String>; 2],
    /// Observed orders.
    pub(super) order: [Option<f64>; 2],
    pub(super) error: Option<ErrorMove>,
    /// Transfers on the same level, new over old.
    pub(super) work: Option<f64>,
    /// Transfers for the same error.
    pub(super) equal: Option<EqualError>,
    /// Remarks in addition to the columns.
    pub(super) notes: Vec<String>,
    /// Sort key within a rank, in decreasing order.
    pub(super) weight: f64,
}

/// An error that moved.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ErrorMove {
    /// `None` if the level failed.
    pub(super) old: Option<f64>,
    /// `None` if the level fails.
    pub(super) new: Option<f64>,
    pub(super) worse: bool,
    /// The level.
    pub(super) level: String,
}

/// Change of the minimum work for a target error.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CheapestMove {
    /// The suite, and its problem if it has several.
    pub(super) place: String,
    pub(super) target: f64,
    /// Minimum work in the old run, and its method; `None` if no method reaches the target.
    pub(super) old: Option<(f64, String)>,
    pub(super) new: Option<(f64, String)>,
}

impl CheapestMove {
    /// New work over old work; infinite if the target is no longer reached, zero if only the new
    /// run reaches it.
    pub(super) fn ratio(&self) -> f64 {
        match (&self.old, &self.new) {
            (Some((old, _)), Some((new, _))) => new / old,
            (Some(_), None) => f64::INFINITY,
            (None, _) => 0.0,
        }
    }
}

impl ErrorMove {
    /// New over old.
    pub(super) fn ratio(&self) -> Option<f64> {
        Some(self.new? / self.old?)
    }

    /// Size of the change, in either direction; infinite if a level newly fails.
    pub(super) fn weight(&self) -> f64 {
        self.ratio().map_or(f64::INFINITY, |ratio| libm::log(ratio).abs())
    }
}

impl ReportComparison {
    /// Cases with this rank.
    pub fn count(&self, rank: Rank) -> usize {
        self.of(rank).count()
    }

    /// Cases that are the same in both runs.
    pub fn unchanged(&self) -> usize {
        self.unchanged
    }

    /// Whether anything got worse.
    pub fn is_worse(&self) -> bool {
        let is_worse = self.cheapest.iter().any(|target| !(target.ratio() < 1.0));
        is_worse || self.moved.iter().any(|moved| moved.rank.is_worse())
    }

    /// Changes of this rank.
    pub(super) fn of(&self, rank: Rank) -> impl Iterator<Item = &Moved> {
        self.moved.iter().filter(move |moved| moved.rank == rank)
    }

    /// Words in common of the cases that got worse, with the share of the cases that have them.
    pub(super) fn in_common(&self) -> Option<String> {
        let part = |SharedWord { word, worse, all }: &SharedWord| {
            format!("{worse} of all {all} cases with `{word}` in their names")
        };
        let parts: Vec<String> = self.shared_words.iter().map(part).collect();
        (!parts.is_empty()).then(|| format!("worse are {}", parts.join(", ")))
    }

    /// Summary in one line: `2 less accurate, 1 new, 816 unchanged`.
    pub(super) fn headline(&self) -> String {
        let counts = Rank::ALL.into_iter().map(|rank| (self.count(rank), rank.words()));
        let counts = counts.chain([(self.unchanged, "unchanged")]).filter(|(count, _)| *count > 0);
        let mut parts: Vec<String> =
            counts.map(|(count, words)| format!("{count} {words}")).collect();
        let targets = |costs_more: bool, words: &str| {
            let of = |target: &&CheapestMove| (target.ratio() < 1.0) != costs_more;
            let count = self.cheapest.iter().filter(of).count();
            let noun = if count == 1 { "target" } else { "targets" };
            (count > 0).then(|| format!("{count} {noun} {words}"))
        };
        parts.extend(targets(true, "more expensive to reach"));
        parts.extend(targets(false, "cheaper to reach"));
        if parts.is_empty() { "no cases".to_owned() } else { parts.join(", ") }
    }
}

/// Whether a ratio differs from one by more than the tolerance, whichever side is the larger. NaN
/// does.
pub(super) fn ratio_moved(ratio: f64, tolerance: f64) -> bool {
    !(ratio <= 1.0 + tolerance && 1.0 / ratio <= 1.0 + tolerance)
}
