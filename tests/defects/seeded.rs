//! Switches of seeded defects, in the scratch copy that `ci/defects` builds only.
//!
//! The variable `SEEDED` has the number of the active defect. With `SEEDED_REACHED`, the number of
//! every executed switch is written to that file.

use std::env;
use std::fs::OpenOptions;
use std::io::Write;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

const UNKNOWN: usize = usize::MAX;
const NOTING: usize = usize::MAX - 1;
const MOST: usize = 1000;

static ACTIVE: AtomicUsize = AtomicUsize::new(UNKNOWN);
static NOTED: [AtomicBool; MOST] = [const { AtomicBool::new(false) }; MOST];

/// Whether the defect of this number is on.
#[inline(always)]
pub fn on(number: usize) -> bool {
    let active = ACTIVE.load(Ordering::Relaxed);
    if active >= NOTING { first(active, number) } else { active == number }
}

#[cold]
#[inline(never)]
fn first(active: usize, number: usize) -> bool {
    if active == UNKNOWN {
        let noting = env::var_os("SEEDED_REACHED").is_some();
        let wanted = || env::var("SEEDED").map_or(0, |text| text.parse().expect("a number"));
        let active = if noting { NOTING } else { wanted() };
        ACTIVE.store(active, Ordering::Relaxed);
        return on(number);
    }
    // The load before the swap keeps repeated calls cheap.
    if !NOTED[number].load(Ordering::Relaxed) && !NOTED[number].swap(true, Ordering::Relaxed) {
        let file = env::var_os("SEEDED_REACHED").expect("a file to note in");
        let mut file = OpenOptions::new().append(true).open(file).expect("the file can be opened");
        file.write_all(format!("{number}\n").as_bytes()).expect("a line is written");
    }
    false
}
