//! Splits work among threads by recursive halving. Each number is computed by one thread from the
//! same inputs, so results do not depend on the number of threads.

/// Maximum number of particles or nodes that one thread processes without a split. Unit tests are
/// compiled without optimisation, so they split smaller bodies.
pub(in crate::mpm) const FEW: usize = if cfg!(test) { 1 << 10 } else { 1 << 14 };

/// Runs both closures, in parallel if there are several threads. With one thread, the closures are
/// called directly, because rayon would wake another thread.
pub(in crate::mpm) fn join(one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
    if rayon::current_num_threads() == 1 {
        one();
        other();
    } else {
        let (mut one, mut other) = (Some(one), Some(other));
        join_any(&mut || call_once(&mut one), &mut || call_once(&mut other));
    }
}

fn call_once(work: &mut Option<impl FnOnce()>) {
    if let Some(work) = work.take() {
        work();
    }
}

/// Joins closures as trait objects, so that `rayon::join` is compiled only once.
fn join_any(one: &mut (dyn FnMut() + Send), other: &mut (dyn FnMut() + Send)) {
    rayon::join(one, other);
}

pub(in crate::mpm) fn split<T>(
    column: Option<&mut [T]>,
    count: usize,
) -> (Option<&mut [T]>, Option<&mut [T]>) {
    column.map(|column| column.split_at_mut(count.min(column.len()))).unzip()
}

/// Divides a column into pieces that fit into the cache, and distributes the pieces among threads.
pub(in crate::mpm) const PIECES: RowChunks = RowChunks { length: FEW / 4, few: FEW };

/// Divides a field into rows, and distributes the rows among threads.
#[derive(Debug, Clone, Copy)]
pub(in crate::mpm) struct RowChunks {
    /// Number of entries in a row; the last row may have fewer.
    pub(in crate::mpm) length: usize,
    /// Maximum number of entries that one thread processes without a split.
    pub(in crate::mpm) few: usize,
}

impl RowChunks {
    /// Calls `work` with the index and entries of each row of `field`.
    pub(in crate::mpm) fn each<T: Send>(
        self,
        field: &mut [T],
        work: &(dyn Fn(usize, &mut [T]) + Sync),
    ) {
        self.each_from(0, field, work);
    }

    fn each_from<T: Send>(
        self,
        first: usize,
        field: &mut [T],
        work: &(dyn Fn(usize, &mut [T]) + Sync),
    ) {
        let middle = field.len().div_ceil(self.length) / 2;
        if field.len() <= self.few || middle == 0 {
            let rows = field.chunks_mut(self.length).enumerate();
            return rows.for_each(|(k, row)| work(first + k, row));
        }
        let (low, high) = field.split_at_mut(middle * self.length);
        join(|| self.each_from(first, low, work), || self.each_from(first + middle, high, work));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::ThreadPoolBuilder;
    use rstest::rstest;

    #[rstest]
    fn each_row_is_visited_once(
        #[values(0, 1, 7, 8, 9, 1000)] total: usize,
        #[values(1, 8)] length: usize,
        #[values(1, 3)] threads: usize,
    ) {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut field = vec![0; total];
        pool.install(|| {
            RowChunks { length, few: 16 }
                .each(&mut field, &|k, row| row.iter_mut().for_each(|entry| *entry += k + 1));
        });
        let expected: Vec<usize> = (0..total).map(|i| i / length + 1).collect();
        assert_eq!(field, expected);
    }
}
