//! Assembly of a symmetric sparse matrix from entries, many of which share a place.
//!
//! In a run the entries of one step mostly belong to the places of the step before. So the order in
//! which they are added up is kept, and found anew only where places have changed: that takes
//! sorting, several times as long as the sums.

use nalgebra_sparse::pattern::SparsityPattern;

/// Where the entries of a matrix go.
pub(super) struct Assembly {
    /// Where the matrix is not zero.
    pub(super) pattern: SparsityPattern,
    /// The numbers of the entries, those of a place behind each other, place after place.
    order: Vec<usize>,
    /// Where in `order` the entries of each place end.
    ends: Vec<usize>,
}

impl Assembly {
    /// For a matrix of `size` rows with entries at `places`, row and column; those without are left
    /// out.
    ///
    /// Entries of a place are added in the order of a sort that is not stable, but the same
    /// everywhere: that of `nalgebra_sparse` for a `CooMatrix`, and so are the bits.
    pub(super) fn new(size: usize, places: impl Iterator<Item = Option<(usize, usize)>>) -> Self {
        let mut columns = vec![Vec::new(); size];
        let mut row = Vec::new();
        for (entry, place) in places.enumerate() {
            row.push(place.map_or(0, |(i, _)| i));
            if let Some((_, j)) = place {
                columns[j].push(entry);
            }
        }
        let (mut order, mut ends) = (Vec::with_capacity(row.len()), Vec::new());
        let (mut offsets, mut rows) = (vec![0], Vec::new());
        for mut column in columns {
            column.sort_unstable_by_key(|entry| row[*entry]);
            for same in column.chunk_by(|a, b| row[*a] == row[*b]) {
                rows.push(row[same[0]]);
                order.extend_from_slice(same);
                ends.push(order.len());
            }
            offsets.push(rows.len());
        }
        let pattern = SparsityPattern::try_from_offsets_and_indices(size, size, offsets, rows)
            .expect("rows are sorted, and each occurs once in a column");
        Self { pattern, order, ends }
    }

    /// The values of the matrix, column by column, from those of all entries.
    pub(super) fn add_up(&self, entries: &[f64], values: &mut Vec<f64>) {
        values.clear();
        let mut start = 0;
        for end in &self.ends {
            let sum = self.order[start..*end].iter().map(|entry| entries[*entry]);
            values.push(sum.reduce(|sum, entry| sum + entry).unwrap_or_default());
            start = *end;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra_sparse::{CooMatrix, CscMatrix};
    use proptest::prelude::*;

    proptest! {
        /// Columns with few entries and with many: sorting takes other ways for short lists.
        #[test]
        fn the_bits_are_those_of_the_library(
            entries in proptest::collection::vec((0..6_usize, 0..6_usize, 1e-3..1.0_f64), 0..900),
        ) {
            // The row and column 5 is that of nodes that are held.
            let free = |i: usize, j: usize| (i < 5 && j < 5).then_some((i, j));
            let mut matrix = CooMatrix::new(5, 5);
            for &(i, j, value) in &entries {
                if let Some((i, j)) = free(i, j) {
                    matrix.push(i, j, value);
                }
            }
            let expected = CscMatrix::from(&matrix);
            let found = Assembly::new(5, entries.iter().map(|&(i, j, _)| free(i, j)));
            prop_assert_eq!(&found.pattern, expected.pattern());
            let mut values = Vec::new();
            let masses: Vec<f64> = entries.iter().map(|entry| entry.2).collect();
            found.add_up(&masses, &mut values);
            prop_assert_eq!(values, expected.values());
        }
    }
}
