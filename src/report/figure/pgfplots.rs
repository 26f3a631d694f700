//! Writes figures and their data as source for the LaTeX package PGFPlots.
//!
//! Each document compiles on its own or within a paper (class and package `standalone`).

use super::log_log::order_name;
use super::plot::style::{CONTEXT, MarkerShape, NEUTRAL, look};
use super::{LogLogPlot, Map, Mark, PlotSeries};
use crate::report::latex::escaped;

const LEGEND: &str = "legend pos=outer north east, legend cell align=left";

/// Minimum length (decades) of a logarithmic axis with labels at powers of ten only.
const SHORT: f64 = 2.0;

struct PgfDocument {
    text: String,
}

impl PgfDocument {
    fn new() -> Self {
        let mut document = Self { text: String::new() };
        document.line(&format!("% Written by mpm-verify {}.", env!("CARGO_PKG_VERSION")));
        document.line("\\documentclass{standalone}");
        document.line("\\usepackage{pgfplots}");
        document.line("\\pgfplotsset{compat=1.15}");
        document.line("\\begin{document}");
        document.line("\\begin{tikzpicture}");
        document
    }

    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    fn colour(&mut self, name: &str, colour: &str) {
        let digits = colour.trim_start_matches('#').to_uppercase();
        self.line(&format!("\\definecolor{{{name}}}{{HTML}}{{{digits}}}"));
    }

    fn plot(&mut self, options: &str, points: impl Iterator<Item = (f64, f64)>) {
        self.line(&format!("\\addplot[{options}] table {{"));
        self.line("x y");
        for (x, y) in points {
            self.line(&format!("{} {}", number(x), number(y)));
        }
        self.line("};");
    }

    /// Adds a legend entry with a line or marker of this style, even if its curve has no points.
    fn legend(&mut self, style: &str, name: &str) {
        self.line(&format!("\\addlegendimage{{{style}}}"));
        self.line(&format!("\\addlegendentry{{{name}}}"));
    }

    fn finished(mut self, environment: &str) -> String {
        self.line(&format!("\\end{{{environment}}}"));
        self.line("\\end{tikzpicture}");
        self.line("\\end{document}");
        self.text
    }
}

fn number(value: f64) -> String {
    if value.is_finite() { format!("{value:e}") } else { "nan".to_owned() }
}

/// Returns tick options with labels between powers of ten; empty except for short axes.
fn log_ticks(axis: &str, values: impl Iterator<Item = f64> + Clone) -> String {
    let (low, high) = (values.clone().fold(f64::INFINITY, f64::min), values.fold(0.0, f64::max));
    if !(low > 0.0 && libm::log10(high / low) < SHORT) {
        return String::new();
    }
    let exponents = libm::floor(libm::log10(low)) as i32..=libm::ceil(libm::log10(high)) as i32;
    let ticks = exponents.flat_map(|exponent| [1, 2, 5].map(|digit| format!("{digit}e{exponent}")));
    let labels = ticks.clone().map(|tick| {
        let (digit, exponent) = tick.split_once('e').unwrap_or((&tick, "0"));
        let factor = if digit == "1" { String::new() } else { format!("{digit} \\cdot ") };
        match exponent {
            "-2" | "-1" | "0" | "1" | "2" => {
                format!("${}$", tick.parse::<f64>().unwrap_or(f64::NAN))
            }
            _ => format!("${factor}10^{{{exponent}}}$"),
        }
    });
    let labels: Vec<String> = labels.collect();
    let ticks: Vec<String> = ticks.collect();
    format!(", {axis}tick={{{}}}, {axis}ticklabels={{{}}}", ticks.join(","), labels.join(","))
}

fn titles(title: &str, x_label: &str, y_label: &str) -> String {
    format!(
        "title={{{}}}, xlabel={{{}}}, ylabel={{{}}}",
        escaped(title),
        escaped(x_label),
        escaped(y_label)
    )
}

fn mark(shape: MarkerShape, is_filled: bool) -> String {
    let (mark, rotation) = match shape {
        MarkerShape::Circle => ("*", 0),
        MarkerShape::Square => ("square*", 0),
        MarkerShape::Up => ("triangle*", 0),
        MarkerShape::Diamond => ("diamond*", 0),
        MarkerShape::Down => ("triangle*", 180),
        MarkerShape::Pentagon => ("pentagon*", 0),
        MarkerShape::Right => ("triangle*", 270),
        MarkerShape::Star => ("star", 0),
    };
    let fill = if is_filled { "" } else { "fill=white, " };
    format!("mark={mark}, mark options={{solid, {fill}rotate={rotation}}}")
}

impl LogLogPlot {
    /// Creates the figure as a LaTeX document. A solid line connects the levels of the asymptotic
    /// window, a thin dashed line all levels. Reference orders are dotted grey lines.
    pub fn to_pgfplots(&self) -> String {
        let mut document = PgfDocument::new();
        let titles = titles(&self.title, &self.x_label, &self.y_label);
        let points =
            || self.series.iter().chain(&self.others).flat_map(|one| sorted(one, |_| true));
        let x_ticks = log_ticks("x", points().map(|point| point.0));
        let y_ticks = log_ticks("y", points().map(|point| point.1));
        document.line(&format!(
            "\\begin{{loglogaxis}}[{titles}, grid=major, {LEGEND}{x_ticks}{y_ticks}]"
        ));
        document.colour("neutral", NEUTRAL);
        document.colour("context", CONTEXT);
        for series in &self.others {
            document.plot("context, forget plot", sorted(series, |_| true).into_iter());
        }
        for (number, series) in self.series.iter().enumerate() {
            let look = look(series.look);
            let colour = format!("series{number}");
            document.colour(&colour, look.colour);
            let thin = format!("{colour}, dashed, thin, forget plot, {}", mark(look.shape, false));
            document.plot(&thin, sorted(series, |_| true).into_iter());
            let thick = format!("{colour}, thick, {}", mark(look.shape, true));
            let in_window = |mark| matches!(mark, Mark::Window | Mark::Measured);
            let window = sorted(series, in_window);
            document.plot(&format!("{thick}, forget plot"), window.into_iter());
            document.legend(&thick, &escaped(&series.name));
        }
        if !self.front.is_empty() {
            let style = "context, line width=4pt, opacity=0.3";
            document.plot(&format!("{style}, forget plot"), self.front.iter().copied());
            document.legend(style, "Pareto front");
        }
        for (order, ends) in self.reference_lines() {
            let style = "neutral, dotted, thick";
            document.plot(&format!("{style}, forget plot"), ends.into_iter());
            document.legend(style, &format!("order ${}$", order_name(order)));
        }
        document.finished("loglogaxis")
    }
}

/// Returns the points whose mark `is_chosen` accepts, sorted by their horizontal coordinate.
fn sorted(series: &PlotSeries, is_chosen: impl Fn(Mark) -> bool) -> Vec<(f64, f64)> {
    let drawn = series.points.iter().filter(|point| point.is_drawn() && is_chosen(point.mark));
    let mut points: Vec<(f64, f64)> = drawn.map(|point| (point.x, point.error)).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points
}

impl Map {
    /// Creates the figure as a LaTeX document. Each number is printed on a coloured field.
    pub fn to_pgfplots(&self) -> String {
        let mut document = PgfDocument::new();
        let titles = titles(&self.title, &self.x_label, "");
        let list = |names: &mut dyn Iterator<Item = &str>| {
            names.map(|name| format!("{{{}}}", escaped(name))).collect::<Vec<_>>().join(", ")
        };
        let columns = list(&mut self.columns.iter().map(String::as_str));
        let rows = list(&mut self.rows.iter().map(|(name, _)| name.as_str()));
        let (across, down) = (self.columns.len(), self.rows.len());
        let (width, height) = (2.0 + 1.6 * across as f64, 2.0 + 0.6 * down as f64);
        document.line(&format!(
            "\\begin{{axis}}[{titles}, width={width:.1}cm, height={height:.1}cm, scale only axis, \
             enlargelimits=false, y dir=reverse, colormap/viridis, colorbar, \
             colorbar style={{ylabel={{{}}}}}, \
             xtick={{0,...,{}}}, xticklabels={{{columns}}}, ytick={{0,...,{}}}, yticklabels={{{rows}}}, \
             xmin=-0.5, xmax={}.5, ymin=-0.5, ymax={}.5]",
            escaped(&self.z_label),
            across.saturating_sub(1),
            down.saturating_sub(1),
            across.saturating_sub(1),
            down.saturating_sub(1),
        ));
        document.line(&format!(
            "\\addplot[matrix plot*, mesh/cols={across}, point meta=explicit] table[meta=z] {{"
        ));
        document.line("x y z");
        for (y, (_, fields)) in self.rows.iter().enumerate() {
            for (x, field) in fields.iter().enumerate() {
                document.line(&format!("{x} {y} {}", number(field.value.unwrap_or(f64::NAN))));
            }
        }
        document.line("};");
        for (y, (_, fields)) in self.rows.iter().enumerate() {
            for (x, field) in fields.iter().enumerate() {
                let text = escaped(&field.text);
                document.line(&format!(
                    "\\node[font=\\scriptsize, fill=white, fill opacity=0.7, text opacity=1, inner sep=1pt] at (axis cs:{x},{y}) {{{text}}};"
                ));
            }
        }
        document.finished("axis")
    }
}
