//! The levels of a series, and which of them have a place on logarithmic axes.

/// The error at one level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlotPoint {
    /// Cell size.
    pub h: f64,
    /// Error; one which is not finite is drawn as failed, zero is noted below the figure.
    pub error: f64,
    /// Role of the level.
    pub mark: Mark,
}

/// Role of a level in the judgement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// In the asymptotic window: filled, joined by a solid line.
    Window,
    /// Measured and not judged: as in the window, and no word in the legend.
    Measured,
    /// Outside the window: hollow, joined by a thin dashed line.
    OutsideWindow,
    /// Particles changed cell: hollow with a cross.
    Crossing,
    /// No finite error: an arrow at the upper edge of the frame.
    Failed,
}

/// A point as it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlotLevel {
    pub(super) h: f64,
    /// The error, unless the level failed.
    pub(super) error: Option<f64>,
    /// The mark; [`Mark::Failed`] exactly where there is no error.
    pub(super) mark: Mark,
}

/// The points which can be drawn, from fine to coarse.
pub(super) fn levels(points: &[PlotPoint]) -> Vec<PlotLevel> {
    let mut levels: Vec<PlotLevel> = points.iter().filter_map(level).collect();
    levels.sort_by(|a, b| a.h.total_cmp(&b.h));
    levels
}

fn level(&PlotPoint { h, error, mark }: &PlotPoint) -> Option<PlotLevel> {
    let failed = mark == Mark::Failed || !error.is_finite();
    let drawable = h.is_finite() && h > 0.0 && (failed || error > 0.0);
    drawable.then_some(if failed {
        PlotLevel { h, error: None, mark: Mark::Failed }
    } else {
        PlotLevel { h, error: Some(error), mark }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case(0.1, 0.5, Mark::Window, Some((Some(0.5), Mark::Window)))]
    #[case(0.1, f64::NAN, Mark::Window, Some((None, Mark::Failed)))]
    #[case(0.1, f64::INFINITY, Mark::OutsideWindow, Some((None, Mark::Failed)))]
    #[case(0.1, 0.5, Mark::Failed, Some((None, Mark::Failed)))]
    #[case(0.1, 0.0, Mark::Window, None)]
    #[case(0.1, -0.5, Mark::Window, None)]
    #[case(0.0, 0.5, Mark::Window, None)]
    #[case(f64::NAN, 0.5, Mark::Failed, None)]
    fn places(
        #[case] h: f64,
        #[case] error: f64,
        #[case] mark: Mark,
        #[case] drawn: Option<(Option<f64>, Mark)>,
    ) {
        let levels = levels(&[PlotPoint { h, error, mark }]);
        assert_eq!(levels.first().map(|l| (l.error, l.mark)), drawn);
    }

    #[test]
    fn levels_are_ordered_by_cell_size() {
        let points = [0.1, 0.4, 0.2].map(|h| PlotPoint { h, error: h, mark: Mark::Window });
        let sorted: Vec<f64> = levels(&points).iter().map(|l| l.h).collect();
        assert_eq!(sorted, [0.1, 0.2, 0.4]);
    }
}
