//! Manufactured forces that several runs ask for: the cases of a study differ in their methods, but
//! most have particles at the same places and take the same steps.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Most numbers that are kept: 32 MiB. The largest of our own suites has three quarters of it.
const MOST: usize = 1 << 22;

/// Forces by places and time, each computed by the run that asks first. When they are too many, the
/// rest are computed by each run.
#[derive(Debug, Default)]
pub struct SharedForces(Mutex<Tables>);

#[derive(Debug, Default)]
struct Tables {
    /// The coordinates of places, one after the other.
    places: Vec<Vec<f64>>,
    /// Forces at all places of one number, by that and by the bits of the time.
    forces: BTreeMap<(usize, u64), Arc<[f64]>>,
    /// Numbers that are kept.
    size: usize,
}

impl SharedForces {
    /// The number by which forces at `places` are known: the same for the same bits.
    pub(super) fn number_of(&self, places: Vec<f64>) -> usize {
        let mut tables = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let bits = f64::to_bits;
        let is_known =
            |known: &Vec<f64>| known.iter().copied().map(bits).eq(places.iter().copied().map(bits));
        let found = tables.places.iter().position(is_known);
        found.unwrap_or_else(|| {
            tables.size += places.len();
            tables.places.push(places);
            tables.places.len() - 1
        })
    }

    /// The forces at the time `t` (s), if they are known.
    pub(super) fn get(&self, places: usize, t: f64) -> Option<Arc<[f64]>> {
        let tables = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        tables.forces.get(&(places, t.to_bits())).cloned()
    }

    /// Keeps forces, if there is room for them.
    pub(super) fn put(&self, places: usize, t: f64, forces: Vec<f64>) {
        let mut tables = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if tables.size + forces.len() <= MOST {
            let size = forces.len();
            // Another run may have computed the same meanwhile.
            if tables.forces.insert((places, t.to_bits()), forces.into()).is_none() {
                tables.size += size;
            }
        }
    }

    /// Forgets all forces: nobody will ask again, or they will be computed again.
    pub fn clear(&self) {
        let mut tables = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        // Runs go on to know their places by number.
        tables.size = tables.places.iter().map(Vec::len).sum();
        tables.forces.clear();
    }
}
