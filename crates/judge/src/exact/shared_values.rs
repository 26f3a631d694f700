//! Values of an exact solution that several runs of a study need at the same positions and times.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Maximum number of stored `f64` (32 MiB), enough for all built-in suites.
const MOST: usize = 1 << 22;

/// Cache of forces and displacements by positions and time. Once full, each run computes its own.
#[derive(Debug, Default)]
pub struct SharedValues(Mutex<Tables>);

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum SharedQuantity {
    Force,
    Displacement,
}

#[derive(Debug, Default)]
struct Tables {
    /// Sets of positions, each with all coordinates in sequence.
    places: Vec<Vec<f64>>,
    /// Values at all positions of a set. Key: quantity, index of the set and bits of the time.
    values: BTreeMap<(SharedQuantity, usize, u64), Arc<[f64]>>,
    size: usize,
}

impl SharedValues {
    fn tables(&self) -> MutexGuard<'_, Tables> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the index of the set `places`; bit-identical sets have the same index. `None` if the
    /// set is new and the cache is full.
    pub(super) fn number_of(&self, places: &[f64]) -> Option<usize> {
        let mut tables = self.tables();
        let are_same = |known: &Vec<f64>| {
            let mut pairs = known.iter().zip(places);
            known.len() == places.len() && pairs.all(|(a, b)| a.to_bits() == b.to_bits())
        };
        let known = tables.places.iter().position(are_same);
        if known.is_some() || tables.size + places.len() > MOST {
            return known;
        }
        tables.size += places.len();
        tables.places.push(places.to_vec());
        Some(tables.places.len() - 1)
    }

    /// Returns the values at the positions with index `places` at time `t` (s), if they are stored.
    pub(super) fn get(
        &self,
        quantity: SharedQuantity,
        places: Option<usize>,
        t: f64,
    ) -> Option<Arc<[f64]>> {
        self.tables().values.get(&(quantity, places?, t.to_bits())).cloned()
    }

    pub(super) fn put(
        &self,
        quantity: SharedQuantity,
        places: Option<usize>,
        t: f64,
        values: &[f64],
    ) {
        let (mut tables, Some(places)) = (self.tables(), places) else { return };
        if tables.size + values.len() <= MOST {
            let key = (quantity, places, t.to_bits());
            if tables.values.insert(key, values.into()).is_none() {
                tables.size += values.len();
            }
        }
    }

    /// Removes all values. Later runs compute the values that they need again.
    pub fn clear(&self) {
        let mut tables = self.tables();
        // The sets of positions remain, because running studies still use their indices.
        tables.size = tables.places.iter().map(Vec::len).sum();
        tables.values.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_identical_positions_share_values() {
        let shared = SharedValues::default();
        let number = |places: &[f64]| shared.number_of(places).unwrap();
        let first = number(&[0.5, 1.5]);
        assert_eq!(number(&[0.5, 1.5]), first);
        let others =
            [number(&[0.5]), number(&[0.5, 2.5]), number(&[-0.0, 1.5]), number(&[0.0, 1.5])];
        assert_eq!(others, [1, 2, 3, 4].map(|more| first + more));
        shared.put(SharedQuantity::Force, Some(first), 2.0, &[7.0]);
        let values =
            |quantity, places, t| shared.get(quantity, Some(places), t).map(|v| v.to_vec());
        assert_eq!(values(SharedQuantity::Force, first, 2.0), Some(vec![7.0]));
        assert_eq!(values(SharedQuantity::Force, others[0], 2.0), None);
        assert_eq!(values(SharedQuantity::Force, first, 3.0), None);
        assert_eq!(values(SharedQuantity::Displacement, first, 2.0), None);
    }
}
