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
pub(super) const BULK: MaterialParameter =
    parameter("the bulk modulus", "K", "Pa", Range::Positive);
pub(super) const VISCOSITY: MaterialParameter =
    parameter("the viscosity", "eta", "Pa s", Range::NotNegative);
pub(super) const DENSITY: MaterialParameter =
    parameter("the density", "rho0", "kg/m3", Range::Positive);
