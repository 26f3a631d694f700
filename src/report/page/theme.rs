//! Colours of the page, light and dark, and what becomes of the colours of figures.
//!
//! Figures are drawn once, for white paper. On the page a rule for each of their colours replaces
//! it by one that stands out from the page by 3:1 at least, as WCAG 2.2 asks of graphics (1.4.11);
//! texts have 4.5:1 (1.4.3). Fields of maps and the numbers in them keep their colours, which go
//! together.

/// A named colour, on a light and on a dark page.
struct Colour {
    name: &'static str,
    light: &'static str,
    dark: &'static str,
}

const fn colour(name: &'static str, light: &'static str, dark: &'static str) -> Colour {
    Colour { name, light, dark }
}

const COLOURS: [Colour; 21] = [
    colour("page", "#ffffff", "#15181e"),
    colour("raised", "#f3f5f7", "#1f242c"),
    colour("rule", "#d5d9de", "#3a414c"),
    colour("ink", "#222222", "#e6e6e6"),
    colour("muted", "#565b63", "#adb3bd"),
    colour("link", "#0b5cad", "#7db8f2"),
    colour("ok", "#1a6b3c", "#6fd09a"),
    colour("bad", "#b3261e", "#ff9a90"),
    // Of figures.
    colour("grid", "#e3e3e3", "#333943"),
    colour("shade", "#f3f3f3", "#23282f"),
    colour("neutral", "#4d4d4d", "#b4b8bf"),
    colour("exact", "#929292", "#6d727b"),
    colour("context", "#8e8e8e", "#747a83"),
    colour("front", "#fbe9a6", "#4a4a2a"),
    colour("blue", "#0072b2", "#4ba6e3"),
    colour("vermilion", "#d55e00", "#f0803c"),
    colour("green", "#009e73", "#1fbf92"),
    colour("purple", "#cc79a7", "#d98cba"),
    colour("orange", "#b97f00", "#e69f00"),
    colour("sky", "#2f94cf", "#8fd0f5"),
    colour("black", "#000000", "#ffffff"),
];

/// Colours that figures are drawn with, and the names of those that replace them.
const DRAWN: [(&str, &str); 13] = [
    ("#e3e3e3", "grid"),
    ("#f3f3f3", "shade"),
    ("#4d4d4d", "neutral"),
    ("#bdbdbd", "exact"),
    ("#b8b8b8", "context"),
    ("#fbe9a6", "front"),
    ("#0072b2", "blue"),
    ("#d55e00", "vermilion"),
    ("#009e73", "green"),
    ("#cc79a7", "purple"),
    ("#e69f00", "orange"),
    ("#56b4e9", "sky"),
    ("#000000", "black"),
];

/// Paper and ink of figures need care: in the fields of a map they are the colours of numbers.
const PAPER_AND_INK: &str = "\
svg [fill=\"#ffffff\"]:not(text){fill:var(--page)}
svg [stroke=\"#ffffff\"]{stroke:var(--page)}
svg[fill=\"#222222\"]{fill:var(--ink)}
svg [fill=\"#222222\"]:not(text){fill:var(--ink)}
svg [stroke=\"#222222\"]{stroke:var(--ink)}
";

/// Variables for both schemes, and the rules for figures. Paper is white.
pub(super) fn css() -> String {
    let set = |of: fn(&Colour) -> &'static str| -> String {
        let variable = |colour: &Colour| format!("--{}:{};", colour.name, of(colour));
        COLOURS.iter().map(variable).collect()
    };
    let replace = |(drawn, name): &(&str, &str)| {
        format!(
            "svg [fill=\"{drawn}\"]{{fill:var(--{name})}}\n\
             svg [stroke=\"{drawn}\"]{{stroke:var(--{name})}}\n"
        )
    };
    let figures: String = DRAWN.iter().map(replace).collect();
    format!(
        "\n:root{{{}}}\n@media screen and (prefers-color-scheme:dark){{:root{{{}}}}}\n{figures}{PAPER_AND_INK}",
        set(|colour| colour.light),
        set(|colour| colour.dark),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::figure::{
        ConvergencePlot, Curve, HistoryPlot, Map, MapField, Mark, PlotPoint, PlotSeries,
    };
    use crate::report::page::colour_contrast::contrast;
    use rstest::rstest;

    type Scheme = fn(&Colour) -> &'static str;
    const SCHEMES: [Scheme; 2] = [|colour| colour.light, |colour| colour.dark];

    fn find(name: &str) -> &'static Colour {
        COLOURS.iter().find(|colour| colour.name == name).expect(name)
    }

    #[rstest]
    #[case("#000000", "#ffffff", 21.0)]
    #[case("#777777", "#ffffff", 4.48)]
    #[case("#ff0000", "#ffffff", 4.0)]
    fn contrasts_are_those_of_the_standard(#[case] a: &str, #[case] b: &str, #[case] ratio: f64) {
        assert!((contrast(a, b) - ratio).abs() < 0.005, "{}", contrast(a, b));
    }

    #[rstest]
    fn texts_can_be_read(
        #[values("ink", "muted", "link", "ok", "bad", "neutral")] text: &str,
        #[values("page", "raised")] behind: &str,
        #[values(0, 1)] scheme: usize,
    ) {
        let ratio = contrast(SCHEMES[scheme](find(text)), SCHEMES[scheme](find(behind)));
        assert!(ratio >= 4.5, "{text} on {behind}: {ratio:.2}");
    }

    #[rstest]
    fn lines_of_figures_stand_out(#[values(0, 1)] scheme: usize) {
        for (_, name) in
            DRAWN.iter().filter(|(_, name)| !matches!(*name, "grid" | "shade" | "front"))
        {
            let ratio = contrast(SCHEMES[scheme](find(name)), SCHEMES[scheme](find("page")));
            assert!(ratio >= 3.0, "{name}: {ratio:.2}");
        }
    }

    /// Values of `fill` and `stroke` in a figure.
    fn colours(svg: &str) -> Vec<&str> {
        let values = ["fill=\"", "stroke=\""].into_iter().flat_map(|key| {
            svg.match_indices(key).filter_map(|(at, key)| svg[at + key.len()..].split('"').next())
        });
        values.filter(|colour| colour.starts_with('#')).collect()
    }

    /// A colour that is added to figures must be given its place here.
    #[test]
    fn every_colour_of_a_figure_has_its_rule() {
        let known = |colour: &&str| {
            matches!(*colour, "#ffffff" | "#222222")
                || DRAWN.iter().any(|(drawn, _)| drawn == colour)
        };
        let marks = [Mark::Window, Mark::OutsideWindow, Mark::Crossing, Mark::Failed];
        let points = [0.5, 0.25, 0.1, 0.05].iter().zip(marks).map(|(h, mark)| PlotPoint {
            h: *h,
            error: *h,
            mark,
        });
        let series = |k: usize| PlotSeries {
            name: k.to_string(),
            look: k,
            points: points.clone().collect(),
        };
        let label = || "x".to_owned();
        let plot = ConvergencePlot {
            title: label(),
            x_label: label(),
            y_label: label(),
            series: (0..8).map(series).collect(),
            reference_orders: vec![1.0],
        };
        let curve = Curve {
            name: label(),
            look: 0,
            points: vec![(0.0, 0.0), (1.0, 1.0)],
            exact: true,
            markers: true,
        };
        let history =
            HistoryPlot { title: label(), x_label: label(), y_label: label(), curves: vec![curve] };
        let field = MapField { value: None, text: label() };
        let map = Map {
            title: label(),
            x_label: label(),
            z_label: label(),
            columns: vec![label()],
            rows: vec![(label(), vec![field])],
        };
        for svg in [plot.to_svg(), history.to_svg()] {
            let unknown: Vec<&str> = colours(&svg).into_iter().filter(|c| !known(c)).collect();
            assert!(unknown.is_empty(), "{unknown:?}");
        }
        // Of a map, whatever is no field.
        let map = map.to_svg();
        let outside: String = map.lines().filter(|line| !line.starts_with("<rect")).collect();
        assert!(colours(&outside).iter().all(known), "{outside}");
    }

    /// Two drawn colours never fall together.
    #[test]
    fn colours_that_differ_still_do() {
        for scheme in SCHEMES {
            let mut all: Vec<&str> = DRAWN.iter().map(|(_, name)| scheme(find(name))).collect();
            all.sort_unstable();
            all.dedup();
            assert_eq!(all.len(), DRAWN.len());
        }
    }
}
