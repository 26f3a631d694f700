//! The examinations, one file each.

mod conversation;
mod faces;
mod fall;
mod force;
mod periodic;
mod rest;
mod stress;
mod translation;
mod units;
mod walls;

use super::question::Examination;

/// Every examination, the plainest first. The first one is the conversation itself.
pub(super) const ALL: &[Examination] = &[
    conversation::EXAMINATION,
    rest::EXAMINATION,
    translation::EXAMINATION,
    faces::EXAMINATION,
    periodic::EXAMINATION,
    fall::EXAMINATION,
    force::EXAMINATION,
    stress::EXAMINATION,
    walls::EXAMINATION,
    units::EXAMINATION,
];
