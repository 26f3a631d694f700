//! Loads and effects of a scene: the family. A member is one file and one line of `members`, and an
//! effect with physics of its own is a file of the solver's family besides.

mod contract;
pub(crate) mod fields;
pub(crate) mod listed;
mod registry;
mod thermal_face;

pub(crate) use contract::{LoadEntry, LoadWords, StudyFacts};

use crate::members::each_effect;
use crate::suite::model::load::EffectName;
use crate::suite::yaml::Path;
use registry::loads;

each_effect!(loads);

impl LoadSpec {
    /// Path of the value of the entry with this `number` in the list of loads.
    pub(crate) fn path(&self, number: usize) -> Path {
        Path::top("scene").then("loads").then(number).then(self.effect().name())
    }
}
