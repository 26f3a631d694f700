//! The words of a scene. Those of its loads stand in the files of the loads: the grammar leaves them
//! out, and they are read here, from the same text.

use crate::suite::grammar::{SceneSpec, read};
use crate::suite::scene::load::LoadSpec;
use crate::suite::yaml::{Diagnostic, Source};
use serde::Deserialize;
use std::ops::Deref;

/// All words of a scene.
pub(crate) struct SceneWords<'a> {
    scene: &'a SceneSpec,
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
    /// Loads and effects.
    #[serde(default)]
    loads: Vec<LoadSpec>,
}

impl<'a> SceneWords<'a> {
    /// The words of the `scene` that `source` holds.
    ///
    /// # Errors
    /// The first mistake in its loads, with its place.
    pub(crate) fn read(source: &Source, scene: &'a SceneSpec) -> Result<Self, Diagnostic> {
        let SuiteOfFamilies { scene: SceneOfFamilies { loads } } = read(source, "")?;
        Ok(Self { scene, loads })
    }
}

impl Deref for SceneWords<'_> {
    type Target = SceneSpec;

    fn deref(&self) -> &SceneSpec {
        self.scene
    }
}
