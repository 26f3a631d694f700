//! Parameters of materials: what they are, what they may be, and how reports write them.

/// A parameter that a suite gives to a material.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Parameter {
    /// What it is, for complaints: `Young's modulus`.
    pub what: &'static str,
    /// Its letter in reports: `E`.
    pub symbol: &'static str,
    /// Its unit, empty for a ratio.
    pub unit: &'static str,
    /// What it may be.
    pub range: Range,
}

/// Values that make sense.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Range {
    /// Above zero.
    Positive,
    /// Zero or above.
    NotNegative,
    /// Above -1 and below 1/2: an isotropic solid is stable there, and compressible.
    PoissonsRatio,
}

const fn parameter(
    what: &'static str,
    symbol: &'static str,
    unit: &'static str,
    range: Range,
) -> Parameter {
    Parameter { what, symbol, unit, range }
}

pub(super) const YOUNG: Parameter = parameter("Young's modulus", "E", "Pa", Range::Positive);
pub(super) const POISSON: Parameter = parameter("Poisson's ratio", "nu", "", Range::PoissonsRatio);
pub(super) const YIELD: Parameter = parameter("the yield stress", "Y", "Pa", Range::Positive);
pub(super) const HARDENING: Parameter =
    parameter("the hardening modulus", "H", "Pa", Range::NotNegative);
pub(super) const BULK: Parameter = parameter("the bulk modulus", "K", "Pa", Range::Positive);
pub(super) const VISCOSITY: Parameter =
    parameter("the viscosity", "eta", "Pa s", Range::NotNegative);
pub(super) const DENSITY: Parameter = parameter("the density", "rho0", "kg/m^D", Range::Positive);
