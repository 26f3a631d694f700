//! Contract of the family of loads, whose members are next to this file.

use crate::dimension::in_every_dimension;
use crate::exact::heat::Conduction;
use crate::exact::{Condition, Term};
use crate::fem::TimeFunction;
use crate::members::each_effect;
use crate::mpm::{BasisName, Effect, Grid, Particles};
use crate::named::named;
use crate::subject::SubjectError;
use crate::suite::scene::boundary::thermal::SceneHeat;
use crate::suite::scene::numbers::LoadNumbers;
use std::ops::Deref;
use std::sync::Arc;

/// Declares the names of the loads and effects, from the lines of [`each_effect`](crate::members).
macro_rules! names {
    ($(
        $(#[$meta:meta])*
        $member:ident = $text:literal => $spec_file:ident::$spec:ident
        $(, effect $file:ident::$effect:ident)?
        $(, needs [$($need:ident),+])?;
    )+) => {
        named! {
            /// Names of the loads and effects in suites. Those on the same part of a scene are
            /// applied in this order.
            pub enum EffectName {
                $($(#[$meta])* $member = $text,)+
            }
        }

        impl EffectName {
            /// The effects that this one requires.
            pub fn needs(self) -> &'static [Self] {
                match self {
                    $(Self::$member => &[$($(Self::$need),+)?],)+
                }
            }
        }
    };
}

each_effect!(names);

impl EffectName {
    /// Refuses a list of effects if one needs another that is missing.
    ///
    /// # Errors
    /// The effect that is at fault, and one line that names both.
    pub fn combine(listed: &[Self]) -> Result<(), (Self, String)> {
        for &effect in listed {
            if let Some(needed) = effect.needs().iter().find(|needed| !listed.contains(needed)) {
                let (name, needed) = (effect.name(), needed.name());
                return Err((effect, format!("`{name}` needs `{needed}`, which is not listed")));
            }
        }
        Ok(())
    }
}

/// Part of the scene that a load acts on. Solvers apply loads in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum LoadTarget {
    /// The whole body.
    Body,
    /// A face, by its number.
    Face(usize),
    /// A rim of a round body, by its number in [`Outline::rims`](crate::exact::Outline::rims).
    Rim(usize),
    /// A set of particles, by its number.
    Set(usize),
}

impl LoadTarget {
    /// The number of the face, if the load acts on a face.
    pub(crate) fn face(self) -> Option<usize> {
        match self {
            Self::Face(number) => Some(number),
            Self::Body | Self::Rim(_) | Self::Set(_) => None,
        }
    }
}

/// A body in D dimensions, for which effects are built.
pub(crate) struct BodySite<'a, const D: usize> {
    pub(crate) grid: &'a Grid<D>,
    pub(crate) basis: BasisName,
    /// The heat problem that the temperature solves.
    pub(crate) heat: Option<&'a Conduction>,
    pub(crate) particles: &'a mut Particles<D>,
}

/// Reason why a load has no effect on a body.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub(crate) enum BuildError {
    /// The set with this name is empty.
    #[error("the set `{0}` holds no particle")]
    EmptySet(String),
    /// No solver has this number of dimensions.
    #[error("there is no MPM in {0} dimensions")]
    Dimension(usize),
}

impl From<BuildError> for SubjectError {
    fn from(error: BuildError) -> Self {
        Self::Unsupported(error.to_string())
    }
}

/// A load as an effect of the solver.
pub(crate) trait BuildEffect<const D: usize> {
    /// The effect on the body at `site`.
    ///
    /// # Errors
    /// The reason why there is none.
    fn build(&self, site: &mut BodySite<'_, D>) -> Result<Box<dyn Effect<D>>, BuildError>;
}

in_every_dimension! {
    /// A load as an effect of the solver in any dimension.
    BuildEffects: BuildEffect
}

/// A load or effect that a scene lists, with every number computed.
pub(crate) trait SceneLoad: BuildEffects + Term + 'static {
    /// Part of the scene on which it acts.
    fn target(&self) -> LoadTarget {
        LoadTarget::Body
    }

    /// Numbers for external solvers; empty for a load that cannot be passed to them.
    fn numbers(&self) -> LoadNumbers {
        LoadNumbers::default()
    }

    /// Rows of name and value for reports.
    fn rows(&self) -> Vec<(String, String)>;

    /// The boundary condition of the exact solution on the face of the load.
    fn condition(self: Arc<Self>) -> Option<Arc<dyn Condition>> {
        None
    }

    /// Tension (Pa) that the load puts on the end `x` (m) of a bar, a function of t; `outwards` is
    /// the sign of the end's outward normal.
    fn tension(&self, _x: f64, _outwards: f64) -> Option<TimeFunction> {
        None
    }

    /// Force per reference area (Pa) on the undeformed face at the coordinates and the time that
    /// `values` are; empty of a load on no face.
    fn traction(&self, _values: &[f64]) -> Vec<f64> {
        Vec::new()
    }

    /// The conduction; `None` for other loads.
    fn heat(&self) -> Option<&SceneHeat> {
        None
    }

    /// Whether it sets a body in motion that rests without stress, or damps its motion.
    fn disturbs_rest(&self) -> bool {
        true
    }
}

/// A load that a scene lists, and its name.
#[derive(Debug, Clone)]
pub(crate) struct ListedLoad {
    pub(crate) effect: EffectName,
    pub(crate) load: Arc<dyn SceneLoad>,
}

impl Deref for ListedLoad {
    type Target = dyn SceneLoad;

    fn deref(&self) -> &Self::Target {
        self.load.as_ref()
    }
}

/// The effect of `load` in D dimensions.
///
/// # Errors
/// The reason why there is none.
pub(crate) fn build<const D: usize>(
    load: &ListedLoad,
    site: &mut BodySite<'_, D>,
) -> Result<Box<dyn Effect<D>>, BuildError> {
    let load: Arc<dyn BuildEffects> = load.load.clone();
    let load = load.in_dimension::<D>();
    load.ok_or(BuildError::Dimension(D))?.build(site)
}
