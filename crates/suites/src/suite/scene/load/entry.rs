//! The keys of a load, and the context in which they are compiled.

use super::contract::{LoadTarget, SceneLoad};
use super::name::EffectName;
use crate::exact::{Circle, Region};
use crate::mpm::input::{FaceInput, SetInput};
use crate::mpm::{Placement, Side};
use crate::subject::PlaneState;
use crate::suite::evaluator::{SuitePath, suggestion};
use crate::suite::scene::Scene;
use crate::suite::scene::face::face;
use crate::suite::yaml::Diagnostic;
use std::sync::Arc;

pub(crate) struct StudyFacts {
    pub(crate) manufactured: bool,
    /// End of the longest run (s).
    pub(crate) until: f64,
}

/// Keys of a load: one entry of `loads`.
pub(crate) trait LoadKeys {
    /// Returns the YAML of an example load with strength `s` (zero: no effect) and the vector value
    /// `vector`, on the face `right` or the set `some`. The tests of all loads use this example.
    fn example(vector: &str) -> String
    where
        Self: Sized;

    fn compile(&self, entry: &LoadEntry<'_>) -> Result<Arc<dyn SceneLoad>, Diagnostic>;

    fn check(&self, _: &LoadEntry<'_>, _: &StudyFacts) -> Result<(), Diagnostic> {
        Ok(())
    }

    /// Returns a name for the load if the FEM of this crate does not support it; otherwise `None`.
    fn lacked_by_fem(&self) -> Option<&'static str> {
        None
    }

    /// Returns the reason why the load is invalid for this plane state; `None` if it is valid.
    fn against_plane(&self, _: PlaneState) -> Option<&'static str> {
        None
    }

    fn face(&self) -> Option<&str> {
        None
    }

    fn acts_on_rims(&self) -> bool {
        false
    }

    fn is_of_one_body(&self) -> bool {
        self.face().is_some()
    }

    fn acts_at_rest(&self) -> bool {
        false
    }
}

/// Context for compiling a load: its path in the file, and the scene with the previous loads.
pub(crate) struct LoadEntry<'a> {
    pub(crate) effect: EffectName,
    pub(crate) path: SuitePath<'a>,
    pub(crate) scene: &'a Scene,
}

impl LoadEntry<'_> {
    pub(crate) fn dimension(&self) -> usize {
        self.scene.dimension()
    }

    pub(crate) fn refuse_second(&self, title: &str) -> Result<(), Diagnostic> {
        if self.scene.lists(self.effect) {
            return Err(self.path.diagnostic(&format!("{title} appears twice")));
        }
        Ok(())
    }

    pub(crate) fn free_face(&self, name: &str) -> Result<LoadedFace, Diagnostic> {
        let scene = self.scene;
        let path = self.path.then("on");
        if scene.sets.iter().any(|set| set.name == name) {
            // Tractions and pressures are forces per area, and a set has no area.
            let message = format!("`{name}` is a set, but a {} acts on a face", self.effect.name());
            let help = format!("give the total force: `force: {{on: {name}, value: [...]}}`");
            return path.refuse(&message, &help);
        }
        let number = face(&path, name, self.dimension(), false)?;
        let hold = &scene.faces[number].hold;
        if !hold.is_free() {
            return Err(path.diagnostic(&format!("the face `{name}` {}", hold.kind().verb)));
        }
        self.refuse_loaded(&path, LoadTarget::Face(number), &format!("face `{name}`"))?;
        Ok(LoadedFace { number, name: scene.faces[number].name })
    }

    pub(crate) fn free_rim(&self, name: &str) -> Result<Circle, Diagnostic> {
        let scene = self.scene;
        let path = self.path.then("on");
        let rims = scene.outline.as_ref().map_or_else(Vec::new, |outline| outline.circles());
        let known: Vec<&str> = rims.iter().map(|circle| circle.name).collect();
        let Some(circle) = rims.iter().find(|circle| circle.name == name) else {
            let diagnostic = path.diagnostic(&format!("the body has no rim `{name}`"));
            return Err(diagnostic.with_help(&suggestion("rims", name, &known)));
        };
        self.refuse_loaded(&path, LoadTarget::Rim(circle.number), &format!("rim `{name}`"))?;
        Ok(circle.clone())
    }

    pub(crate) fn free_set(&self, name: &str) -> Result<LoadedSet, Diagnostic> {
        let path = self.path.then("on");
        let number = set_number(&path, name, &self.scene.sets)?;
        self.refuse_loaded(&path, LoadTarget::Set(number), &format!("set `{name}`"))?;
        Ok(LoadedSet { number, region: self.scene.sets[number].clone() })
    }

    fn refuse_loaded(
        &self,
        path: &SuitePath<'_>,
        target: LoadTarget,
        title: &str,
    ) -> Result<(), Diagnostic> {
        let Some(other) = self.scene.loads_on(target).next() else { return Ok(()) };
        Err(path.diagnostic(&format!("the {title} already has a {}", other.effect.name())))
    }
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct LoadedFace {
    /// Index in axis order, with the low face of each axis before the high face.
    pub(crate) number: usize,
    pub(crate) name: &'static str,
}

impl LoadedFace {
    pub(crate) fn row(self, load: &str, placement: Placement) -> (String, String) {
        let place = match placement {
            Placement::Particles => "",
            Placement::Surface => ", applied at the surface",
        };
        (self.name.to_owned(), format!("{load}{place}"))
    }

    pub(crate) fn place(self) -> FaceInput {
        let side = if self.number % 2 == 1 { Side::High } else { Side::Low };
        FaceInput { axis: self.number / 2, side }
    }
}

#[derive(Debug, Clone)]
pub(crate) struct LoadedSet {
    pub(crate) number: usize,
    pub(crate) region: Region,
}

impl LoadedSet {
    pub(crate) fn row(&self, load: &str) -> (String, String) {
        let Region { name, from, to } = &self.region;
        let corner = |c: &[f64]| {
            let coordinates = c.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
            if c.len() == 1 { coordinates } else { format!("({coordinates})") }
        };
        let text = format!("{} to {} m, {load}", corner(from), corner(to));
        (format!("particle set `{name}`"), text)
    }

    pub(crate) fn input(&self) -> SetInput {
        let region = self.region.clone();
        SetInput { name: region.name.clone(), holds: Box::new(move |label| region.holds(label)) }
    }
}

fn set_number(path: &SuitePath<'_>, name: &str, sets: &[Region]) -> Result<usize, Diagnostic> {
    sets.iter().position(|set| set.name == name).ok_or_else(|| {
        let diagnostic = path.diagnostic(&format!("there is no set `{name}`"));
        let known: Vec<&str> = sets.iter().map(|set| set.name.as_str()).collect();
        diagnostic.with_help(&match known[..] {
            [] => format!("declare it: `sets: {{{name}: {{box: {{from: [...], to: [...]}}}}}}`"),
            _ => suggestion("sets", name, &known),
        })
    })
}
