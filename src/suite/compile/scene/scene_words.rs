//! The words of a scene. Those of its loads and boundary conditions stand in the files of the loads
//! and conditions: the grammar leaves them out, and they are read here, from the same text.

use crate::suite::grammar::{SceneSpec, read};
use crate::suite::scene::boundary::BoundarySpec;
#[cfg(feature = "schemas")]
use crate::suite::scene::face::by_face;
use crate::suite::scene::load::LoadSpec;
use crate::suite::yaml::{Diagnostic, Ordered, Source};
use serde::Deserialize;
use std::ops::Deref;

/// All words of a scene.
pub(crate) struct SceneWords<'a> {
    scene: &'a SceneSpec,
    pub(crate) boundary: Ordered<BoundarySpec>,
    pub(crate) loads: Vec<LoadSpec>,
}

/// A suite, of which only this part is read.
#[derive(Deserialize)]
struct SuiteOfFamilies {
    scene: SceneOfFamilies,
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub(crate) struct SceneOfFamilies {
    /// Conditions on faces; one that is not named is free.
    #[serde(default)]
    #[cfg_attr(feature = "schemas", schemars(schema_with = "by_face::<BoundarySpec>"))]
    boundary: Ordered<BoundarySpec>,
    /// Loads and effects.
    #[serde(default)]
    loads: Vec<LoadSpec>,
}

impl<'a> SceneWords<'a> {
    /// The words of the `scene` that `source` holds.
    ///
    /// # Errors
    /// The first mistake in its loads and boundary conditions, with its place.
    pub(crate) fn read(source: &Source, scene: &'a SceneSpec) -> Result<Self, Diagnostic> {
        let SuiteOfFamilies { scene: SceneOfFamilies { boundary, loads } } = read(source, "")?;
        Ok(Self { scene, boundary, loads })
    }
}

impl Deref for SceneWords<'_> {
    type Target = SceneSpec;

    fn deref(&self) -> &SceneSpec {
        self.scene
    }
}
