//! Name of the gate that reports an unmet expectation.

use mpm_verify::verify::{CaseOutcome, Unmet, UnmetCode};

/// The gate that reports `unmet`. A wrong order is a separate gate, for any verdict.
pub(crate) fn gate(case: &CaseOutcome, unmet: &Unmet) -> &'static str {
    match unmet.code {
        _ if case.study.is_none() => "verdict",
        UnmetCode::OrderTooLow | UnmetCode::OrderTooHigh => "order",
        UnmetCode::NotConserved if unmet.text.contains("energy") => "energy",
        UnmetCode::NotConserved => "conservation",
        UnmetCode::StabilityDiffers => "stability",
        UnmetCode::ForceDiffers => "force",
        // Deviations from the closed form are bounded.
        UnmetCode::BoundExceeded | UnmetCode::CrossingsDiffer | UnmetCode::SpectrumDiffers => {
            "bound"
        }
        _ => "verdict",
    }
}
