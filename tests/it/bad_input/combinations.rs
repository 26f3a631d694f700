//! Parts of a method that cannot be combined.

use super::samples::BAR;
use super::{Edits, refused};
use rstest::rstest;

const METHOD: &str = "- mpm: {basis: linear, transfer: flip, scheme: [musl, usl]}";

#[rstest]
#[case::an_inertia_tensor_that_a_basis_lacks(
    "- ▸mpm: {basis: linear, transfer: [flip, mls], scheme: musl}",
    &["the transfer `mls`", "the basis `linear`"]
)]
#[case::two_approaches_to_one_matrix(
    "- ▸mpm: {basis: cpgimp, transfer: fmpm_2, scheme: musl, mass: consistent}",
    &["the transfer `fmpm_2`", "is not supported with the mass matrix `consistent`"]
)]
#[case::a_field_with_a_mass_that_amplifies_it(
    "- ▸mpm: {basis: cubic_bspline, transfer: apic, scheme: musl, mass: consistent}",
    &["the transfer `apic`", "is not supported with the mass matrix `consistent`"]
)]
#[case::domains_that_follow_what_the_frame_does_not_see(
    "- ▸mpm: {basis: cpdi, transfer: flip, scheme: musl, frame: total_lagrangian}",
    &["the basis `cpdi`", "the frame `total_lagrangian`"]
)]
#[case::integrals_over_cells_and_over_domains(
    "- ▸mpm: {basis: ugimp, transfer: tls, scheme: musl}",
    &["the transfer `tls`", "the basis `ugimp`"]
)]
#[case::a_fit_of_stresses_that_the_frame_lacks(
    "- ▸mpm: {basis: linear, transfer: tls, scheme: musl, frame: total_lagrangian}",
    &["the transfer `tls`", "the frame `total_lagrangian`"]
)]
#[case::a_transfer_that_nobody_knows(
    "- mpm: {basis: linear, transfer: ▸apci, scheme: musl}",
    &["unknown name `apci`", "did you mean `apic`?"]
)]
#[case::a_frame_that_nobody_knows(
    "- mpm: {basis: linear, transfer: flip, scheme: musl, frame: ▸total}",
    &["unknown name `total`", "total_lagrangian"]
)]
fn a_method_with(#[case] method: &str, #[case] words: &[&str]) {
    let edits: Edits<'_> = &[(METHOD, method)];
    refused(BAR, edits, words);
}
