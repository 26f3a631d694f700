//! Animated picture (SVG) of the particles of a run, which light up when they change their cell.

use crate::subject::BodyFields;
use std::fmt::Write;

/// Maximum number of drawn particles.
const PARTICLES: usize = 2000;

/// Maximum number of drawn cell boundaries along an axis.
const LINES: f64 = 1000.0;

/// Larger side of the picture (px), without its margin.
const SIDE: f64 = 800.0;

/// Positions of the particles of one- and two-dimensional bodies at several instants.
#[derive(Debug, Default)]
pub(crate) struct ParticleMotion {
    dimension: usize,
    /// Lowest node and cell size (m) of the grid.
    grid: Option<([f64; 2], f64)>,
    /// Positions of the particles (m) at each instant. The second coordinate is 0 in 1-D.
    instants: Vec<Vec<[f64; 2]>>,
}

impl ParticleMotion {
    /// Adds the positions (m) of an instant, `dimension` numbers for each particle.
    pub(crate) fn add(&mut self, dimension: usize, positions: &[f64], bodies: &[BodyFields]) {
        let padded = |x: &[f64]| [x[0], x.get(1).copied().unwrap_or(0.0)];
        let body = bodies.iter().find(|body| body.h > 0.0);
        self.grid = body.map(|body| (padded(&body.origin), body.h));
        self.dimension = dimension;
        let d = dimension.max(1);
        let each = (positions.len() / d).div_ceil(PARTICLES).max(1);
        self.instants.push(positions.chunks_exact(d).step_by(each).map(padded).collect());
    }

    /// Returns the animation; `None` in 3-D, or without two instants with finite positions.
    pub(crate) fn to_svg(&self, title: &str) -> Option<String> {
        if self.dimension > 2 {
            return None;
        }
        let (low, high) = self.extent().filter(|_| self.instants.len() > 1)?;
        let scale = SIDE / (high[0] - low[0]).max(high[1] - low[1]).max(f64::MIN_POSITIVE);
        let in_a_row = libm::pow(self.instants[0].len() as f64, 1.0 / self.dimension as f64);
        let radius = (SIDE / in_a_row / 5.0).clamp(0.5, 5.0);
        // Particles of a bar are drawn as strokes, which remain visible if there are many.
        let half_height = if self.dimension == 1 { 10.0 } else { radius };
        let size = [0, 1].map(|axis| (high[axis] - low[axis]) * scale + 4.0 * radius);
        let place = |[x, y]: [f64; 2]| {
            [(x - low[0]) * scale + 2.0 * radius, (high[1] - y) * scale + 2.0 * radius]
        };
        let title = title.replace('&', "&amp;").replace('<', "&lt;");
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.1} {:.1}\" role=\"img\">\n\
             <title>{title}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
            size[0], size[1]
        );
        self.draw_cells(&mut svg, low, high, &place);
        for particle in 0..self.instants[0].len() {
            let path: Vec<[f64; 2]> =
                self.instants.iter().filter_map(|all| all.get(particle)).copied().collect();
            let [x, y] = [0, 1].map(|axis| listed(path.iter().map(|at| place(*at)[axis])));
            let crosses = |k: usize| k > 0 && self.cell(path[k]) != self.cell(path[k - 1]);
            let fill = |k| if crosses(k) { "#d55e00" } else { "#0072b2" };
            let fills: Vec<&str> = (0..path.len()).map(fill).collect();
            let animate = |name: &str, values: &str, more: &str| {
                format!(
                    "<animate attributeName=\"{name}\" values=\"{values}\" dur=\"6s\" \
                     repeatCount=\"indefinite\"{more}/>"
                )
            };
            let parts = [
                animate("cx", &x, ""),
                animate("cy", &y, ""),
                animate("fill", &fills.join(";"), " calcMode=\"discrete\""),
            ];
            let shape = format!("<ellipse rx=\"{radius:.1}\" ry=\"{half_height:.1}\">");
            let _ = writeln!(svg, "{shape}{}</ellipse>", parts.concat());
        }
        Some(svg + "</svg>\n")
    }

    fn draw_cells(
        &self,
        svg: &mut String,
        low: [f64; 2],
        high: [f64; 2],
        place: &dyn Fn([f64; 2]) -> [f64; 2],
    ) {
        let Some((origin, h)) = self.grid else { return };
        for axis in 0..self.dimension {
            // Particles of a failed run can be far away.
            if !((high[axis] - low[axis]) / h <= LINES) {
                continue;
            }
            let cell = |x: f64| libm::floor((x - origin[axis]) / h) as i64;
            for line in cell(low[axis])..=cell(high[axis]) + 1 {
                let at = |mut end: [f64; 2]| {
                    end[axis] = origin[axis] + line as f64 * h;
                    place(end)
                };
                let [[x1, y1], [x2, y2]] = [low, high].map(at);
                let _ = writeln!(
                    svg,
                    "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" \
                     stroke=\"#bbb\"/>"
                );
            }
        }
    }

    fn cell(&self, at: [f64; 2]) -> Option<[i64; 2]> {
        let (origin, h) = self.grid?;
        Some([0, 1].map(|axis| libm::floor((at[axis] - origin[axis]) / h) as i64))
    }

    fn extent(&self) -> Option<([f64; 2], [f64; 2])> {
        let all = || self.instants.iter().flatten();
        let bound = |axis: usize, start: f64, of: fn(f64, f64) -> f64| {
            all().map(|at| at[axis]).fold(start, of)
        };
        let low = [0, 1].map(|axis| bound(axis, f64::INFINITY, f64::min));
        let high = [0, 1].map(|axis| bound(axis, f64::NEG_INFINITY, f64::max));
        // A line of particles gets a band of some height.
        let band = if low[1] == high[1] { (high[0] - low[0]) / 40.0 } else { 0.0 };
        let is_finite = all().flatten().all(|x| x.is_finite()) && high[0] > low[0];
        is_finite.then_some(([low[0], low[1] - band], [high[0], high[1] + band]))
    }
}

fn listed(values: impl Iterator<Item = f64>) -> String {
    values.map(|value| format!("{value:.2}")).collect::<Vec<_>>().join(";")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_particle_that_changes_its_cell_lights_up() {
        let motion = |x: f64| ParticleMotion {
            dimension: 1,
            grid: Some(([0.0; 2], 1.0)),
            instants: [[0.5, 1.5], [x, 1.75], [x, 1.75]]
                .map(|at| at.map(|x| [x, 0.0]).into())
                .into(),
        };
        let svg = motion(1.25).to_svg("a < b").expect("a picture");
        let fills: Vec<&str> = svg.split("\"fill\" values=\"").skip(1).map(|s| &s[..23]).collect();
        assert_eq!(fills, ["#0072b2;#d55e00;#0072b2", "#0072b2;#0072b2;#0072b2"]);
        // The extent is 1.25 m wide; the margin is twice the radius of 5 px.
        let path = |x: f64| format!("\"cx\" values=\"10.00;{x:.2};{x:.2}\"");
        assert!(svg.contains(&path(10.0 + 0.75 / 1.25 * 800.0)), "{svg}");
        assert_eq!(svg.matches("<line ").count(), 3, "0, 1 and 2 m\n{svg}");
        assert!(svg.contains("<title>a &lt; b</title>"));
        let far = motion(1e300).to_svg("").expect("a picture");
        assert_eq!(far.matches("<line ").count(), 0, "too many cells");
        assert_eq!(motion(f64::NAN).to_svg(""), None);
        assert_eq!(ParticleMotion { dimension: 3, ..motion(1.25) }.to_svg(""), None);
        assert_eq!(ParticleMotion::default().to_svg(""), None);
    }

    /// The extent is from (1, 2) to (3, 6) m, and y points up: 200 px/m and a radius of 5 px.
    #[test]
    fn drawing_has_the_axes_and_cells_of_the_plane() {
        let mut motion = ParticleMotion::default();
        let grid = |h| BodyFields { origin: vec![0.5, 1.5], h, ..BodyFields::default() };
        for positions in [[1.0, 2.0, 3.0, 3.0], [1.25, 6.0, 1.5, 2.5]] {
            motion.add(2, &positions, &[grid(0.0), grid(2.0)]);
        }
        let svg = motion.to_svg("").expect("a picture");
        for part in [
            "viewBox=\"0 0 420.0 820.0\"",
            "\"cx\" values=\"10.00;60.00\"",
            "\"cy\" values=\"810.00;10.00\"",
            "\"cx\" values=\"410.00;110.00\"",
            "\"cy\" values=\"610.00;710.00\"",
            "<line x1=\"-90.0\" y1=\"810.0\" x2=\"-90.0\" y2=\"10.0\"",
            "<line x1=\"310.0\" y1=\"810.0\" x2=\"310.0\" y2=\"10.0\"",
            "<line x1=\"10.0\" y1=\"910.0\" x2=\"410.0\" y2=\"910.0\"",
            "<line x1=\"10.0\" y1=\"510.0\" x2=\"410.0\" y2=\"510.0\"",
        ] {
            assert_eq!(svg.matches(part).count(), 1, "{part} in\n{svg}");
        }
        assert_eq!(svg.matches("<line ").count(), 3 + 4);
        let fills: Vec<&str> = svg.split("\"fill\" values=\"").skip(1).map(|s| &s[..15]).collect();
        assert_eq!(fills, ["#0072b2;#d55e00", "#0072b2;#d55e00"]);
    }
}
