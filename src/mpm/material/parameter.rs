//! Parameters of materials: name, symbol, unit and range.

/// A parameter that a suite gives to a material.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MaterialParameter {
    /// Its name in messages: `Young's modulus`.
    pub what: &'static str,
    /// Its letter in reports: `E`.
    pub symbol: &'static str,
    /// Its unit, empty for a ratio.
    pub unit: &'static str,
    /// Its valid values.
    pub range: Range,
}

/// Valid values of a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Range {
    /// Above zero.
    Positive,
    /// Zero or above.
    NotNegative,
    /// Above -1 and below 1/2: an isotropic solid is stable there, and compressible.
    PoissonsRatio,
    /// Zero or above, and below 90 (degrees).
    Angle,
}

const fn parameter(
    what: &'static str,
    symbol: &'static str,
    unit: &'static str,
    range: Range,
) -> MaterialParameter {
    MaterialParameter { what, symbol, unit, range }
}

pub(super) const YOUNG: MaterialParameter =
    parameter("Young's modulus", "E", "Pa", Range::Positive);
pub(super) const POISSON: MaterialParameter =
    parameter("Poisson's ratio", "nu", "", Range::PoissonsRatio);
pub(super) const YIELD: MaterialParameter =
    parameter("the yield stress", "Y", "Pa", Range::Positive);
pub(super) const HARDENING: MaterialParameter =
    parameter("the hardening modulus", "H", "Pa", Range::NotNegative);
pub(super) const FRICTION: MaterialParameter =
    parameter("the coefficient of friction", "eta", "", Range::NotNegative);
pub(super) const DILATION: MaterialParameter =
    parameter("the coefficient of dilation", "etab", "", Range::NotNegative);
pub(super) const STRENGTH: MaterialParameter =
    parameter("the strength without mean stress", "k", "Pa", Range::NotNegative);
pub(super) const FRICTION_ANGLE: MaterialParameter =
    parameter("the friction angle", "phi", "degrees", Range::Angle);
pub(super) const DILATION_ANGLE: MaterialParameter =
    parameter("the dilation angle", "psi", "degrees", Range::Angle);
pub(super) const COHESION: MaterialParameter =
    parameter("the cohesion", "c", "Pa", Range::NotNegative);
pub(super) const BULK: MaterialParameter =
    parameter("the bulk modulus", "K", "Pa", Range::Positive);
pub(super) const VISCOSITY: MaterialParameter =
    parameter("the viscosity", "eta", "Pa s", Range::NotNegative);
pub(super) const DENSITY: MaterialParameter =
    parameter("the density", "rho0", "kg/m3", Range::Positive);
