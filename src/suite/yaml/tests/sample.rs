//! A realistic suite, and types to read it into.

use crate::suite::yaml::{NumberText, OneOrMany, Ordered};
use serde::Deserialize;

pub(super) const SAMPLE: &str = r#"suite: vibrating-bar
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
pub(super) struct Suite {
    #[serde(rename = "suite")]
    pub(super) name: String,
    #[serde(default)]
    pub(super) parameters: Ordered<NumberText>,
    pub(super) scene: Scene,
    pub(super) refine: Refine,
    pub(super) methods: Vec<Method>,
    #[serde(default)]
    pub(super) expect: Vec<Expect>,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(super) struct Scene {
    pub(super) dimension: OneOrMany<u8>,
    pub(super) body: Body,
    pub(super) material: OneOrMany<Material>,
    pub(super) boundary: Option<Boundary>,
    #[serde(default)]
    pub(super) loads: Vec<Load>,
    #[serde(default)]
    pub(super) quiet: bool,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum Body {
    Box { from: Vec<NumberText>, to: Vec<NumberText> },
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum Material {
    LinearElastic(Elastic),
    NeoHookean { young: NumberText },
    Rigid,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(super) struct Elastic {
    pub(super) young: OneOrMany<NumberText>,
    pub(super) poisson: NumberText,
    pub(super) density: NumberText,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(super) struct Boundary {
    pub(super) left: Option<Wall>,
    pub(super) right: Option<Wall>,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case")]
pub(super) enum Wall {
    Fixed,
    Roller,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum Load {
    Gravity(Vec<NumberText>),
    Traction { on: String, value: Vec<NumberText> },
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(super) struct Refine {
    pub(super) cells: Vec<usize>,
    pub(super) ppc: u16,
    pub(super) until: Option<f64>,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum Method {
    Mpm(Box<Mpm>),
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(super) struct Mpm {
    pub(super) basis: Basis,
    pub(super) transfer: String,
    pub(super) scheme: OneOrMany<Scheme>,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case")]
pub(super) enum Basis {
    Linear,
    QuadraticBspline,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case")]
pub(super) enum Scheme {
    Musl,
    Usl,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(super) struct Expect {
    pub(super) order: [f64; 2],
    pub(super) because: String,
}
