//! What a visit to the nodes is for.

/// What is wanted of a pass over the particles.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Wanted {
    /// The masses of nodes.
    pub mass: bool,
    /// Their momenta, into the column of velocities.
    pub momentum: bool,
    /// The internal forces.
    pub force: bool,
}

/// New velocities of particles, of what one visit to the nodes gives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recipe {
    /// `v_p += dt sum_i a_i N_i(x_p)`.
    pub change: bool,
    /// Then `v_p <- keep v_p + factor sum_i v_i N_i(x_p)`.
    pub mix: Option<(f64, f64)>,
}

impl Recipe {
    /// The passes that it stands for, with those of `moments`.
    pub fn passes(&self, moments: bool) -> u64 {
        [self.change, self.mix.is_some(), moments].map(u64::from).iter().sum()
    }
}
