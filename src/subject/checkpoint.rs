//! Records the state of a solver during a run as bytes, and restores it bit for bit.
//!
//! [`Memory::visit`] both records and restores, so every number that is written is also read.
//! Numbers are stored without names, as eight bytes in little-endian order on any machine. The
//! caller must ensure that bytes are read by the same program with the same set-up.

use super::{Samples, Totals};

/// State that a checkpoint can record and restore.
pub trait Memory {
    /// Passes each number to `checkpoint`, which records or replaces it.
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>);

    /// Visits each of `entries` in order.
    fn visit_each(entries: &mut [Self], checkpoint: &mut Checkpoint<'_>)
    where
        Self: Sized,
    {
        for entry in entries {
            entry.visit(checkpoint);
        }
    }
}

/// A state that is being recorded or restored.
#[derive(Debug)]
pub struct Checkpoint<'a>(Way<'a>);

#[derive(Debug)]
enum Way<'a> {
    Out(Vec<u8>),
    /// Bytes that have not been read yet.
    In(&'a [u8]),
    /// Reading has failed; later visits replace nothing.
    Misfit,
}

impl<'a> Checkpoint<'a> {
    /// Creates an empty checkpoint that records a state.
    pub fn empty() -> Self {
        Self(Way::Out(Vec::new()))
    }

    /// Creates a checkpoint from the bytes of [`Checkpoint::into_bytes`]. The same sequence of
    /// visits must read these bytes.
    pub fn from_bytes(bytes: &'a [u8]) -> Self {
        Self(Way::In(bytes))
    }

    /// Returns the recorded bytes.
    pub fn into_bytes(self) -> Vec<u8> {
        match self.0 {
            Way::Out(bytes) => bytes,
            Way::In(_) | Way::Misfit => Vec::new(),
        }
    }

    /// Whether all bytes were read and were valid. Otherwise the visited state is invalid.
    pub fn is_used_up(&self) -> bool {
        matches!(self.0, Way::In([]))
    }

    /// Records or restores `memory`.
    pub fn visit<T: Memory + ?Sized>(&mut self, memory: &mut T) {
        memory.visit(self);
    }

    /// Records a number that the set-up determines. If the number differs when the bytes are read,
    /// the checkpoint is invalid.
    pub fn same(&mut self, number: usize) {
        let mut found = number as u64;
        self.visit(&mut found);
        if found != number as u64 {
            self.refuse();
        }
    }

    /// Marks the checkpoint as invalid, because the last value that was read is invalid.
    pub fn refuse(&mut self) {
        self.0 = Way::Misfit;
    }

    fn is_misfit(&self) -> bool {
        matches!(self.0, Way::Misfit)
    }

    #[inline]
    fn word(&mut self, word: u64) -> u64 {
        match &mut self.0 {
            Way::Out(bytes) => bytes.extend_from_slice(&word.to_le_bytes()),
            Way::In(bytes) => {
                if let Some((first, rest)) = bytes.split_first_chunk() {
                    *bytes = rest;
                    return u64::from_le_bytes(*first);
                }
                self.refuse();
            }
            Way::Misfit => {}
        }
        word
    }
}

impl Memory for u64 {
    #[inline]
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        *self = checkpoint.word(*self);
    }
}

impl Memory for f64 {
    #[inline]
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        *self = Self::from_bits(checkpoint.word(self.to_bits()));
    }

    /// Visits all entries in one call, because this is faster and analyses restore a state before
    /// each of many steps.
    fn visit_each(entries: &mut [Self], checkpoint: &mut Checkpoint<'_>) {
        match &mut checkpoint.0 {
            Way::Out(bytes) => {
                bytes.reserve(size_of_val(entries));
                for entry in entries {
                    bytes.extend_from_slice(&entry.to_le_bytes());
                }
            }
            Way::In(bytes) => {
                let (words, _) = bytes.as_chunks();
                let Some(words) = words.get(..entries.len()) else { return checkpoint.refuse() };
                for k in 0..entries.len() {
                    entries[k] = Self::from_le_bytes(words[k]);
                }
                *bytes = &bytes[size_of_val(entries)..];
            }
            Way::Misfit => {}
        }
    }
}

impl Memory for bool {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        match checkpoint.word(u64::from(*self)) {
            0 => *self = false,
            1 => *self = true,
            _ => checkpoint.refuse(),
        }
    }
}

/// The length of a slice is fixed, and is stored only to detect bytes that do not fit.
impl<T: Memory> Memory for [T] {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        checkpoint.same(self.len());
        if !checkpoint.is_misfit() {
            T::visit_each(self, checkpoint);
        }
    }
}

impl<T: Memory, const N: usize> Memory for [T; N] {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        T::visit_each(self, checkpoint);
    }
}

/// The length is stored, because vectors may grow during a run. Every entry must contain at least
/// one number, so that reading with a wrong length ends when no bytes remain.
impl<T: Memory + Default> Memory for Vec<T> {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let mut len = self.len() as u64;
        len.visit(checkpoint);
        if matches!(checkpoint.0, Way::In(_)) {
            self.clear();
            for _ in 0..len {
                let mut entry = T::default();
                entry.visit(checkpoint);
                if checkpoint.is_misfit() {
                    return;
                }
                self.push(entry);
            }
        } else {
            T::visit_each(self, checkpoint);
        }
    }
}

impl<T: Memory + Default> Memory for Option<T> {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let mut is_there = self.is_some();
        is_there.visit(checkpoint);
        if is_there {
            self.get_or_insert_default().visit(checkpoint);
        } else {
            *self = None;
        }
    }
}

impl<A: Memory, B: Memory> Memory for (A, B) {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        self.0.visit(checkpoint);
        self.1.visit(checkpoint);
    }
}

impl Memory for Totals {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self {
            mass,
            momentum,
            momentum_size,
            angular_momentum,
            angular_momentum_size,
            kinetic_energy,
            strain_energy,
            second_moment,
            reference_second_moment,
        } = self;
        for number in [mass, momentum_size, angular_momentum_size, kinetic_energy] {
            checkpoint.visit(number);
        }
        checkpoint.visit(momentum);
        checkpoint.visit(angular_momentum);
        checkpoint.visit(second_moment);
        checkpoint.visit(reference_second_moment);
        checkpoint.visit(strain_energy);
    }
}

impl Memory for Samples {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self {
            dimension,
            label,
            displacement,
            velocity,
            weight,
            mass,
            stress,
            stress_across,
            deformation_gradient,
            temperature,
        } = self;
        checkpoint.same(*dimension);
        for column in [label, displacement, velocity, weight, mass] {
            checkpoint.visit(column);
        }
        for column in [stress, stress_across, deformation_gradient, temperature] {
            checkpoint.visit(column);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use rstest::rstest;

    type All = (Vec<f64>, ([u64; 2], (Option<f64>, (bool, Vec<(f64, Totals)>))));

    fn written(memory: &mut (impl Memory + ?Sized)) -> Vec<u8> {
        let mut checkpoint = Checkpoint::empty();
        checkpoint.visit(memory);
        checkpoint.into_bytes()
    }

    fn taken_back(memory: &mut (impl Memory + ?Sized), bytes: &[u8]) -> bool {
        let mut checkpoint = Checkpoint::from_bytes(bytes);
        checkpoint.visit(memory);
        checkpoint.is_used_up()
    }

    fn some(x: f64, n: u64) -> All {
        let totals =
            Totals { mass: x, momentum: [-x, 0.0, x], strain_energy: Some(x), ..Totals::default() };
        let account = vec![(-0.0, totals), (x, Totals { strain_energy: None, ..totals })];
        (
            vec![x; (n % 7) as usize],
            ([n, 1], (n.is_multiple_of(2).then_some(x), (n.is_multiple_of(3), account))),
        )
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

        /// All bits are restored, including those of NaN and -0, for any previous state.
        #[test]
        fn every_bit_is_restored(x in prop::num::f64::ANY, n in any::<u64>(), m in any::<u64>()) {
            let bytes = written(&mut some(x, n));
            let mut back = some(0.5, m);
            prop_assert!(taken_back(&mut back, &bytes));
            prop_assert_eq!(written(&mut back), bytes);
        }

        #[test]
        fn arbitrary_bytes_are_rejected(mut bytes in prop::collection::vec(any::<u8>(), 0..400)) {
            bytes.push(0);
            bytes.truncate(bytes.len() / 8 * 8 + 1);
            prop_assert!(!taken_back(&mut some(1.0, 0), &bytes), "no whole number of words");
        }
    }

    #[test]
    fn wrong_number_of_bytes_is_rejected() {
        let bytes = written(&mut some(1.5, 6));
        for end in 0..bytes.len() {
            assert!(!taken_back(&mut some(1.5, 6), &bytes[..end]), "{end}");
        }
        assert!(!taken_back(&mut some(1.5, 6), &[&bytes[..], &[0]].concat()));
    }

    #[rstest]
    #[case::shorter(&mut [0.0; 2])]
    #[case::longer(&mut [0.0; 4])]
    fn column_of_another_length_is_not_changed(#[case] column: &mut [f64]) {
        assert!(!taken_back(column, &written(&mut [1.0, 2.0, 3.0][..])));
        assert!(column.iter().all(|entry| *entry == 0.0));
    }
}
