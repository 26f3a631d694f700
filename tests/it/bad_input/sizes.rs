//! Suites that would need too much memory or time are refused before anything is allocated.

use super::samples::{BAR, SWEPT};
use super::{Edits, for_each_row, refused};
use allocation_counter::measure;
use rstest::rstest;

/// Asserts the error, and that the heap use stays far below that of a thousand million cases or
/// fifty million nodes.
fn refused_unallocated(sound: &str, edits: Edits<'_>, words: &[&str]) {
    let bytes = measure(|| refused(sound, edits, words)).bytes_max;
    assert!(bytes < 20_000_000, "{bytes} bytes");
}

#[test]
fn sizes_are_refused_unallocated() {
    for_each_row("", SIZES, refused_unallocated);
}

const SIZES: &str = r"
@cube
[4, 8] → [▸10000000]
⇒ with 10000000 cells along the first axis, 1.6e21 nodes … expected at most 5e7 nodes
[4, 8] → [4, ▸200]
ppc: 8 → ppc: 64
⇒ with 200 cells along the first axis, 5.1e8 particles … expected at most 5e7 particles
@plate
to: [1, 0.5] → to: [1, 1e9]
[4, 8] → [▸4, 8]
⇒ with 4 cells along the first axis, … expected at most 5e7 nodes
@bar
[L + 5] → [▸1e300] ⇒ the box is 1e300 m long … expected a length from 1e-30 to 1e30
";

/// Creates a list that contains `word` this number of times.
fn list(word: &str, times: usize) -> String {
    format!("[{}]", vec![word; times].join(","))
}

#[test]
fn more_levels_than_a_list_may_have() {
    let levels = format!("▸{}", list("9", 1001));
    refused_unallocated(BAR, &[("[6, 12]", &levels)], &["this list has more than 1000 entries"]);
}

#[rstest]
#[case(BAR, "flip, scheme: [musl, usl]", 1000)]
#[case(SWEPT, "[flip, pic, apic], scheme: [usl, usf, musl]", 500)]
fn lists_whose_product_is_a_thousand_million_cases(
    #[case] suite: &str,
    #[case] transfer: &str,
    #[case] most: usize,
) {
    let method = format!(
        "- ▸mpm: {{basis: {}, transfer: {}, scheme: {}}}",
        list("linear", 1000),
        list("flip", 1000),
        list("usl", 1000)
    );
    let right = format!("- mpm: {{basis: linear, transfer: {transfer}}}");
    let most = format!("expected at most {most} in a suite");
    let words = ["these lists give 1000000000 cases", &most];
    refused_unallocated(suite, &[(&right, &method)], &words);
}
