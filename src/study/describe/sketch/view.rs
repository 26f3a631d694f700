//! The plane region that a sketch shows, and the map from this region to the canvas.

use crate::report::figure::plot::style::WIDTH;
use crate::report::figure::plot::svg::Pt;
use crate::suite::model::stability::StabilityPlan;
use crate::suite::model::{ConvergencePlan, Scene, Suite};
use crate::suite::scene::grid_axis;

/// Distance of the grid from the edges of the canvas (px).
pub(super) const MARGIN: f64 = 52.0;

/// Maximum height of the grid on the canvas (px).
const HIGHEST: f64 = 260.0;

/// Minimum height of the grid on the canvas (px); a bar has this height.
const LOWEST: f64 = 34.0;

/// The scene, and the grid of the coarsest level in the plane of the first two axes.
pub(super) struct View {
    pub(super) scene: Scene,
    pub(super) from: [f64; 2],
    pub(super) to: [f64; 2],
    /// Cell size (m).
    pub(super) h: f64,
}

impl View {
    /// Creates the view of a suite's scene. For a stability study this is the scene of the first
    /// row.
    pub(super) fn of(suite: &Suite) -> Option<Self> {
        if let Some(plan) = suite.plan::<ConvergencePlan>() {
            return Some(Self::over(plan.scene.clone(), plan.refine.levels.first()?.h));
        }
        let plan = suite.plan::<StabilityPlan>()?;
        let first = [(plan.swept.as_str(), *plan.values.first()?)];
        let setup = plan.template.setup(&first).ok()?;
        Some(Self::over(setup.scene, setup.level.h))
    }

    fn over(scene: Scene, h: f64) -> Self {
        // A bar is drawn with the height of one cell.
        let (mut from, mut to) = ([0.0; 2], [0.0, h]);
        for axis in 0..scene.dimension().min(2) {
            let (start, cells) = grid_axis(&scene, axis, h);
            (from[axis], to[axis]) = (start, start + cells * h);
        }
        Self { scene, from, to, h }
    }

    /// Returns the lengths (m) of the grid along the first two axes.
    pub(super) fn size(&self) -> [f64; 2] {
        [self.to[0] - self.from[0], self.to[1] - self.from[1]]
    }

    /// Returns the scale (px/m) along each axis. The second scale is larger than the first for
    /// bodies that would otherwise be too flat.
    pub(super) fn scale(&self) -> [f64; 2] {
        let size = self.size();
        let equal = f64::min((WIDTH - 2.0 * MARGIN) / size[0], HIGHEST / size[1]);
        match self.scene.dimension() {
            1 => [(WIDTH - 2.0 * MARGIN) / size[0], LOWEST / size[1]],
            _ => [equal, equal.max(LOWEST / size[1])],
        }
    }

    pub(super) fn is_to_scale(&self) -> bool {
        let [across, up] = self.scale();
        self.scene.dimension() == 1 || across == up
    }

    /// Returns the height (px) of the grid including its margins.
    pub(super) fn height(&self) -> f64 {
        self.size()[1] * self.scale()[1] + 2.0 * MARGIN
    }

    pub(super) fn place(&self, (x, y): Pt) -> Pt {
        let (scale, size) = (self.scale(), self.size());
        let left = 0.5 * (WIDTH - size[0] * scale[0]);
        let bottom = self.height() - MARGIN;
        (left + (x - self.from[0]) * scale[0], bottom - (y - self.from[1]) * scale[1])
    }

    /// Returns the lower and upper end of a body along the second axis (m).
    pub(super) fn rise(&self, body: &Scene) -> Pt {
        if body.dimension() == 1 { (0.0, self.h) } else { (body.from[1], body.to[1]) }
    }

    /// Converts a position in the plane to a position in the scene: on the axis of a bar, or in the
    /// middle of the third axis.
    pub(super) fn in_scene(body: &Scene, (x, y): Pt) -> Vec<f64> {
        let coordinate = |axis: usize| match axis {
            0 => x,
            1 => y,
            _ => 0.5 * (body.from[axis] + body.to[axis]),
        };
        (0..body.dimension()).map(coordinate).collect()
    }

    pub(super) fn covers(body: &Scene, place: Pt) -> bool {
        let place = Self::in_scene(body, place);
        let inside = |(axis, x): (usize, &f64)| (body.from[axis]..=body.to[axis]).contains(x);
        place.iter().enumerate().all(inside)
            && body.outline.as_ref().is_none_or(|outline| outline.holds(&place))
    }
}
