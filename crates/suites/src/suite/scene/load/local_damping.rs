//! Local damping: opposes the motion with a share of the unbalanced force.

use super::contract::{BodySite, SceneLoad};
use super::entry::{LoadEntry, LoadKeys, StudyFacts};
use crate::exact::Term;
use crate::mpm::LocalDamping;
use crate::mpm::input::EffectInput;
use crate::suite::evaluator::shown;
use crate::suite::scene::numbers::LoadNumbers;
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Share of the unbalanced force that opposes the motion at each node.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub(crate) struct LocalDampingSpec(NumberText);

impl LoadKeys for LocalDampingSpec {
    fn example(_: &str) -> String {
        "s".to_owned()
    }

    fn compile(&self, entry: &LoadEntry<'_>) -> Result<Arc<dyn SceneLoad>, Diagnostic> {
        entry.refuse_second("local damping")?;
        let share = entry.path.number(&self.0)?;
        if !(0.0..1.0).contains(&share) {
            let message = format!("the share of local damping is {}", shown(share));
            let label = "expected zero or a number below 1";
            return Err(entry.path.diagnostic(&message).with_label(label));
        }
        Ok(Arc::new(LocalDampingLoad(share)))
    }

    /// Refuses a manufactured force, because local damping would also oppose this force.
    fn check(&self, entry: &LoadEntry<'_>, study: &StudyFacts) -> Result<(), Diagnostic> {
        if !study.manufactured {
            return Ok(());
        }
        let message = "`local_damping` needs the whole force, but a part of it is manufactured";
        let diagnostic = entry.path.evaluator.top("manufactured").diagnostic_at_key(message);
        Err(diagnostic.with_help("state the motion under `exact`, or use `damping`"))
    }

    fn lacked_by_fem(&self) -> Option<&'static str> {
        Some("damping")
    }
}

#[derive(Debug)]
struct LocalDampingLoad(f64);

/// Adds `-zeta |Div P / rho0 + b| sign(u_t)` to each component of the equation (Cundall 1987).
impl Term for LocalDampingLoad {
    fn resistance(&self, _: f64, velocity: f64, unbalanced: &dyn Fn() -> f64) -> f64 {
        let sign = if velocity == 0.0 { 0.0 } else { velocity.signum() };
        -self.0 * unbalanced().abs() * sign
    }

    fn resists_imbalance(&self) -> bool {
        true
    }
}

impl SceneLoad for LocalDampingLoad {
    fn numbers(&self) -> LoadNumbers {
        LoadNumbers::constants(&[("share", self.0)])
    }

    fn rows(&self) -> Vec<(String, String)> {
        let text = format!("{} times the out-of-balance force", shown(self.0));
        vec![("local damping".to_owned(), text)]
    }

    fn disturbs_rest(&self) -> bool {
        false
    }

    fn input(&self, _: &BodySite<'_>) -> EffectInput {
        EffectInput::LocalDamping(LocalDamping(self.0))
    }
}
