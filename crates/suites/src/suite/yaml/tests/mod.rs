//! Tests of the YAML reader with a typical suite, and with mistakes in this suite.

pub(crate) mod files;
pub(crate) mod good;
pub(crate) mod hostile;
pub(crate) mod mistakes;
pub(crate) mod properties;

use crate::suite::yaml::{NumberText, OneOrMany, Ordered};
use serde::Deserialize;

pub(crate) const SAMPLE: &str = r#"suite: vibrating-bar
parameters: {L: 25, E: 100, rho: 1, omega: "pi/(2*L)*sqrt(E/rho)"}
scene:
  dimension: 1
  body: {box: {from: [0], to: [L]}}
  material: {linear_elastic: {young: E, poisson: 0, density: rho}}
  boundary: {left: fixed}
  loads: [{gravity: ["-g"]}, {traction: {on: right, value: ["p0"]}}]
refine: {cells: [5, 10, 20], ppc: 4}
methods:
  - mpm: {basis: linear, transfer: flip, scheme: [musl, usl]}
expect:
  - {order: [1.9, 2.1], because: "..."}
"#;

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Suite {
    #[serde(rename = "suite")]
    pub(crate) name: String,
    #[serde(default)]
    pub(crate) parameters: Ordered<NumberText>,
    pub(crate) scene: Scene,
    pub(crate) refine: Refine,
    pub(crate) methods: Vec<Method>,
    #[serde(default)]
    pub(crate) expect: Vec<Expect>,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Scene {
    pub(crate) dimension: OneOrMany<u8>,
    pub(crate) body: Body,
    pub(crate) material: OneOrMany<Material>,
    pub(crate) boundary: Option<Boundary>,
    #[serde(default)]
    pub(crate) loads: Vec<Load>,
    #[serde(default)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum Body {
    Box { from: Vec<NumberText>, to: Vec<NumberText> },
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum Material {
    LinearElastic(Elastic),
    NeoHookean { young: NumberText },
    Rigid,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Elastic {
    pub(crate) young: OneOrMany<NumberText>,
    pub(crate) poisson: NumberText,
    pub(crate) density: NumberText,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Boundary {
    pub(crate) left: Option<Wall>,
    pub(crate) right: Option<Wall>,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Wall {
    Fixed,
    Roller,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum Load {
    Gravity(Vec<NumberText>),
    Traction { on: String, value: Vec<NumberText> },
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Refine {
    pub(crate) cells: Vec<usize>,
    pub(crate) ppc: u16,
    pub(crate) until: Option<f64>,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum Method {
    Mpm(Box<Mpm>),
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Mpm {
    pub(crate) basis: Basis,
    pub(crate) transfer: String,
    pub(crate) scheme: OneOrMany<Scheme>,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Basis {
    Linear,
    QuadraticBspline,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Scheme {
    Musl,
    Usl,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Expect {
    pub(crate) order: [f64; 2],
    pub(crate) because: String,
}
