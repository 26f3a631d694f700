//! Failures of one body, with indices among the particles of all.

use crate::subject::{Failure, Site};

/// The failure of a body whose particles come after `first` others.
pub(in crate::mpm) fn among(failure: Failure, first: usize) -> Failure {
    let shifted = |site: Site| match site {
        Site::Particle(p) => Site::Particle(first + p),
        other => other,
    };
    match failure {
        Failure::NonFinite { quantity, site } => {
            Failure::NonFinite { quantity, site: shifted(site) }
        }
        Failure::Inverted { site, j } => Failure::Inverted { site: shifted(site), j },
        Failure::LeftDomain { site, position } => {
            Failure::LeftDomain { site: shifted(site), position }
        }
        other => other,
    }
}
