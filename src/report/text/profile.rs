//! Cost of a step: effects, passes, visits and memory, in rows for reports and `explain`.

use crate::subject::{ColumnSize, Holder, Profile};

/// Rows of name and text.
pub fn profile(profile: &Profile) -> Vec<(&'static str, String)> {
    vec![
        ("effects", effects(profile, "none")),
        ("a step", profile.passes.join(", ")),
        ("particle visits", visits(profile)),
        ("particle memory", memory(profile, Holder::Particle)),
        ("node memory", memory(profile, Holder::Node)),
    ]
}

/// The effects that are active, or the word for none.
pub(crate) fn effects(profile: &Profile, none: &str) -> String {
    if profile.effects.is_empty() { none.to_owned() } else { profile.effects.join(", ") }
}

/// Differences of two profiles: the lines of the first that the second has not, and those that it
/// has instead.
pub fn difference(with: &Profile, without: &Profile) -> Vec<(&'static str, String)> {
    let rows = profile(with).into_iter().zip(profile(without));
    let changed = rows.filter(|((_, before), (_, after))| before != after);
    changed.flat_map(|((key, before), (_, after))| [(key, before), ("  becomes", after)]).collect()
}

/// `p2g mass, p2g momentum x 2, p2g point force at 4 of 20 particles`.
fn visits(profile: &Profile) -> String {
    let particles = profile.particles as u64;
    let part = |&(name, visited): &(&str, u64)| match visited.checked_div(particles) {
        Some(1) if visited % particles == 0 => name.to_owned(),
        Some(times) if visited % particles == 0 => format!("{name} x {times}"),
        _ => format!("{name} at {visited} of {particles} particles"),
    };
    profile.visits.iter().map(part).collect::<Vec<_>>().join(", ")
}

/// `168 B: X 16, x 16, ...`, the columns with fewer entries than there are holders after them.
fn memory(profile: &Profile, holder: Holder) -> String {
    let holders = profile.holders(holder);
    let (whole, partial): (Vec<&ColumnSize>, Vec<&ColumnSize>) = profile
        .columns
        .iter()
        .filter(|column| column.holder == holder)
        .partition(|column| column.entries == holders);
    let mut texts = vec![format!("{} B", whole.iter().map(|column| column.bytes).sum::<usize>())];
    let listed: Vec<String> =
        whole.iter().map(|column| format!("{} {}", column.name, column.bytes)).collect();
    if !listed.is_empty() {
        texts.push(format!(": {}", listed.join(", ")));
    }
    for column in partial {
        let ColumnSize { name, entries, bytes, .. } = column;
        texts.push(format!("; {name} {bytes} at {entries} of {holders}"));
    }
    texts.concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::subject::Column;

    fn sample() -> Profile {
        Profile {
            effects: vec!["gravity", "traction"],
            particles: 20,
            nodes: 9,
            columns: vec![
                Column::of_particles("v", &[0.0; 20]).size,
                Column::of_particles("layer", &[0_usize; 4]).size,
                Column::of_nodes("mass", &[0.0; 9]).size,
            ],
            passes: vec!["P2G(mass)".to_owned(), "G2P(stress)".to_owned()],
            visits: vec![("p2g mass", 20), ("g2p velocity", 40), ("p2g point force", 4)],
        }
    }

    #[test]
    fn whole_columns_and_visits_are_told_from_partial_ones() {
        let rows = profile(&sample());
        let text = |key| &rows.iter().find(|(name, _)| *name == key).expect("a row").1;
        assert_eq!(text("effects"), "gravity, traction");
        assert_eq!(text("a step"), "P2G(mass), G2P(stress)");
        let visits = "p2g mass, g2p velocity x 2, p2g point force at 4 of 20 particles";
        assert_eq!(text("particle visits"), visits);
        assert_eq!(text("particle memory"), "8 B: v 8; layer 8 at 4 of 20");
        assert_eq!(text("node memory"), "8 B: mass 8");
    }

    #[test]
    fn only_what_changes_is_a_difference() {
        let with = sample();
        assert!(difference(&with, &with).is_empty());
        let without = Profile { effects: vec!["gravity"], ..sample() };
        let found = difference(&with, &without);
        let expected =
            vec![("effects", "gravity, traction".to_owned()), ("  becomes", "gravity".to_owned())];
        assert_eq!(found, expected);
    }
}
