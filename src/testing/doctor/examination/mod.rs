mod clay;
mod conversation;
mod faces;
mod fall;
mod force;
mod laws;
mod periodic;
mod rest;
mod soils;
mod start;
mod stress;
mod transfer;
mod translation;
mod units;
mod vibration;
mod walls;

use super::patient::Examination;

/// All examinations, one per file, starting with the simplest. The first one examines the protocol.
pub(super) const ALL: &[Examination] = &[
    conversation::EXAMINATION,
    rest::EXAMINATION,
    transfer::INITIAL_VELOCITY,
    translation::EXAMINATION,
    faces::EXAMINATION,
    fall::EXAMINATION,
    force::EXAMINATION,
    transfer::EXAMINATION,
    stress::EXAMINATION,
    periodic::EXAMINATION,
    laws::EXAMINATION,
    soils::EXAMINATION,
    clay::EXAMINATION,
    start::EXAMINATION,
    vibration::EXAMINATION,
    walls::EXAMINATION,
    periodic::ENDS,
    units::EXAMINATION,
];
