//! The manufactured source of a run: at the same places, step after step.

use super::field::TemperaturePlaces;
use super::problem::Conduction;
use crate::exact::motion::{Derivatives, Places};

/// The manufactured source of heat at places that have been given once.
pub struct HeatForcing {
    problem: Conduction,
    warm: Box<dyn TemperaturePlaces>,
    motion: Option<Box<dyn Places>>,
}

impl HeatForcing {
    /// The source of `problem` at `labels` (m), D numbers each.
    pub fn new<'a>(problem: &Conduction, labels: impl Iterator<Item = &'a [f64]>) -> Self {
        let labels: Vec<Vec<f64>> = labels.map(<[f64]>::to_vec).collect();
        let all = || labels.iter().map(Vec::as_slice);
        Self {
            warm: problem.temperature.at_places(all()),
            motion: problem.motion.as_ref().map(|motion| motion.at_places(all())),
            problem: problem.clone(),
        }
    }

    /// Fills in the source (W/kg) at each place at time `t` (s), as
    /// [`Conduction::manufactured_source`] gives it for one. Allocates nothing.
    pub fn at(&mut self, t: f64, into: &mut [f64]) {
        self.warm.set_time(t);
        if let Some(motion) = &mut self.motion {
            motion.set_time(t);
        }
        let mut moved = Derivatives::default();
        for (place, source) in into.iter_mut().enumerate() {
            if let Some(motion) = &mut self.motion {
                motion.derivatives(place, &mut moved);
            }
            *source = self.problem.balance(&moved, &self.warm.derivatives(place));
        }
    }
}
