//! Examination of modified Cam-clay along three strain paths: swelling, compression, and shear.
//!
//! The motion of the heavy body is prescribed. Paths end at states whose mean stress p and
//! deviatoric stress q follow from closed forms (Roscoe & Burland 1968), with the ratio of moduli
//! `r = G/K`:
//!
//! - swelling: `p = p0 exp(eps_v/kappa)` and `q = 2 r |p - p0|`, because G is proportional to p;
//! - every yielding state: `p + q^2/(M^2 p) = pc`, where `pc` has grown by the factor
//!   `exp(eps_p/(lambda - kappa))` and `eps_p = eps_v - kappa ln(p/p0)` is the plastic compaction;
//! - long shear: the critical state `q = M p`;
//! - long uniaxial compression: the constant ratio `q/p` of the K0 line.
//!
//! None of these relations depends on the scheme that integrates the law.
//!
//! ```text
//! measure   the runs, and the state at the end of each path
//! judge     the finding that explains these states
//! ```

mod judge;
mod measure;

use crate::testing::doctor::prelude::*;
use judge::finding;
use measure::{PATHS, PathEnd, STEPS, path};

pub(super) const EXAMINATION: Examination = Examination {
    name: "clay",
    expected: "Cam-clay swells along the swelling line with a shear modulus proportional to p; \
               when it yields, the stress is on a yield surface that grows with the plastic \
               compaction, and approaches the critical state in shear and the K0 line in \
               compression",
    after: &["translation", "force", "transfer", "stress", "laws"],
    covers: &["laws: cam_clay"],
    examine,
};

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = |kind: Kind| path(kind, &PATHS[0].1);
    // In one dimension the lateral stress is unknown, and so are p and q.
    let first = patient.able_with(&[2, 3], &["cam_clay"], &scene, &|needs| {
        needs.columns = vec!["stress"];
    })?;
    let scenes = PATHS.map(|(_, gradient)| path((first.dimension, first.law), &gradient));
    let end = |k: usize| {
        let mut problem = scenes[k].problem()?;
        // Only the last of the many states is needed.
        problem.instants = vec![STEPS];
        PathEnd::measure(PATHS[k].0, &scenes[k], &patient.run_problem(&scenes[k], problem)?)
    };
    let ends = [end(0)?, end(1)?, end(2)?];
    let texts = ends
        .each_ref()
        .map(|end| format!("p/p0 {} and q/p0 {} after {}", shown(end.p), shown(end.q), end.path));
    let measured = format!("cam_clay in {}-D: {}", first.dimension, texts.join(", "));
    Ok(Examined::new(measured, finding(&ends)))
}
