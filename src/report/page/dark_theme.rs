//! Dark colours for readers who prefer them: a style sheet that knows the light ones.
//!
//! Presentation attributes yield to any style sheet, so that the figure stays what it is in print
//! and in programs that read no style sheets.

use crate::report::figure::plot::style::{CONTEXT, FRONT, GRID, INK, NEUTRAL, PAPER};

/// Light colours and what takes their place. Series keep their hue; what is dark among them is
/// lightened.
const PAIRS: [(&str, &str); 11] = [
    (PAPER, "#15181c"),
    (INK, "#e8e8e8"),
    (GRID, "#33383e"),
    (NEUTRAL, "#b9bec4"),
    (FRONT, "#4a4a2a"),
    (CONTEXT, "#5d636a"),
    ("#0072b2", "#7b8ff5"),
    ("#d55e00", "#f07d28"),
    ("#009e73", "#2cc79a"),
    ("#cc79a7", "#de92bd"),
    ("#000000", "#ffffff"),
];

/// The document with the style sheet as its first element.
pub(crate) fn with_dark_colours(svg: &str) -> String {
    let rule = |(light, dark): &(&str, &str)| {
        format!("[fill=\"{light}\"]{{fill:{dark}}}[stroke=\"{light}\"]{{stroke:{dark}}}")
    };
    let rules: String = PAIRS.iter().map(rule).collect();
    let sheet = format!("<style>@media (prefers-color-scheme: dark){{{rules}}}</style>");
    match svg.split_once('>') {
        Some((root, rest)) => format!("{root}>\n{sheet}{rest}"),
        None => svg.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::figure::plot::style::look;
    use crate::report::page::colour_contrast::contrast;

    fn dark(light: &'static str) -> &'static str {
        PAIRS.iter().find(|(known, _)| *known == light).map_or(light, |(_, dark)| dark)
    }

    #[test]
    fn texts_and_lines_stand_out_on_either_paper() {
        for (text, least) in [(INK, 7.0), (NEUTRAL, 7.0)] {
            assert!(contrast(text, PAPER) >= least, "{text}");
            assert!(contrast(dark(text), dark(PAPER)) >= least, "{text}");
        }
        for index in 0..7 {
            let colour = look(index).colour;
            assert!(contrast(dark(colour), dark(PAPER)) >= 4.5, "{colour}");
        }
        // Above the band of the front too.
        for index in 0..7 {
            let colour = look(index).colour;
            assert!(contrast(dark(colour), dark(FRONT)) >= 2.3, "{colour}");
        }
    }

    #[test]
    fn the_sheet_comes_first() {
        let svg = with_dark_colours("<svg a=\"b\"><rect/></svg>");
        assert!(svg.starts_with("<svg a=\"b\">\n<style>@media"), "{svg}");
        assert!(svg.ends_with("</style><rect/></svg>"), "{svg}");
    }
}
