//! Laws of the bar in uniaxial strain, `P(F)`, written apart from those of MPM and of the truth.

use super::setup::ScalarFunction;
use crate::named::named;

named! {
    /// Laws that the bar knows.
    pub enum BarLaw {
        /// `P = M (F - 1)`, `M = lambda + 2 mu`.
        SmallStrain = "small_strain",
        /// `P = M ln F`, to which the rate form of linear elasticity integrates in 1-D.
        LogStrain = "log_strain",
        /// `P = lambda ln(F)/F + mu (F - 1/F)`.
        NeoHookean = "neo_hookean",
        /// `P = M ln(F)/F`.
        Hencky = "hencky",
    }
}

impl BarLaw {
    /// The law of this name, if the bar knows it.
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|law| law.name() == name)
    }

    /// P(F) (Pa), from Young's modulus (Pa) and Poisson's ratio.
    pub fn piola(self, young: f64, poisson: f64) -> ScalarFunction {
        let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
        let mu = young / (2.0 * (1.0 + poisson));
        let modulus = lambda + 2.0 * mu;
        match self {
            Self::SmallStrain => Box::new(move |f| modulus * (f - 1.0)),
            Self::LogStrain => Box::new(move |f| modulus * libm::log(f)),
            Self::NeoHookean => Box::new(move |f| lambda * libm::log(f) / f + mu * (f - 1.0 / f)),
            Self::Hencky => Box::new(move |f| modulus * libm::log(f) / f),
        }
    }
}
