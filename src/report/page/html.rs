//! Generates HTML with balanced tags and escaped text.

/// A part of a page with balanced tags and escaped text.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Html(String);

impl Html {
    /// Converts plain text and escapes its special characters.
    pub(super) fn text(text: &str) -> Self {
        Self(escape(text))
    }

    /// Accepts markup that this crate has generated, without escaping.
    pub(super) fn trusted(markup: impl Into<String>) -> Self {
        Self(markup.into())
    }

    pub(super) fn tag(name: &str, attributes: &[(&str, &str)], content: impl Into<Self>) -> Self {
        let content: Self = content.into();
        Self(format!("<{name}{}>{}</{name}>", self::attributes(attributes), content.0))
    }

    /// Creates an element with each part of its content on a separate line.
    pub(super) fn block(name: &str, attributes: &[(&str, &str)], content: &[Self]) -> Self {
        let lines: Vec<&str> = content.iter().map(|part| part.0.as_str()).collect();
        let (open, inside) = (self::attributes(attributes), lines.join("\n"));
        Self(format!("<{name}{open}>\n{inside}\n</{name}>"))
    }

    pub(super) fn void(name: &str, attributes: &[(&str, &str)]) -> Self {
        Self(format!("<{name}{}>", self::attributes(attributes)))
    }

    pub(super) fn into_string(self) -> String {
        self.0
    }
}

impl From<&str> for Html {
    fn from(text: &str) -> Self {
        Self::text(text)
    }
}

impl From<String> for Html {
    fn from(text: String) -> Self {
        Self::text(&text)
    }
}

impl From<Vec<Html>> for Html {
    fn from(parts: Vec<Html>) -> Self {
        parts.into_iter().collect()
    }
}

impl FromIterator<Html> for Html {
    fn from_iter<T: IntoIterator<Item = Html>>(parts: T) -> Self {
        Self(parts.into_iter().map(|part| part.0).collect())
    }
}

fn attributes(attributes: &[(&str, &str)]) -> String {
    let attribute = |(name, value): &(&str, &str)| format!(" {name}=\"{}\"", escape(value));
    attributes.iter().map(attribute).collect()
}

/// Escapes special characters. Forbidden and bidirectional control characters become U+FFFD.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            '\n' | '\t' => escaped.push(c),
            c if c.is_control()
                || matches!(c, '\u{fdd0}'..='\u{fdef}' | '\u{fffe}' | '\u{ffff}') =>
            {
                escaped.push('\u{fffd}');
            }
            // Bidirectional control characters, which reorder the rest of a line in a browser.
            '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case("a < b & \"c\"", "a &lt; b &amp; &quot;c&quot;")]
    #[case("</script><script>alert('1')", "&lt;/script&gt;&lt;script&gt;alert(&#39;1&#39;)")]
    #[case("<!-- ]]> -->", "&lt;!-- ]]&gt; --&gt;")]
    #[case("bell\u{7} nul\0\n", "bell\u{fffd} nul\u{fffd}\n")]
    #[case("\u{202e}txt.exe", "\u{fffd}txt.exe")]
    #[case("&amp;", "&amp;amp;")]
    fn text_is_escaped(#[case] text: &str, #[case] escaped: &str) {
        assert_eq!(Html::text(text).into_string(), escaped);
    }

    #[test]
    fn attribute_values_are_escaped() {
        let link = Html::tag("a", &[("href", "#\" onclick=\"alert(1)")], "x<y");
        assert_eq!(link.into_string(), "<a href=\"#&quot; onclick=&quot;alert(1)\">x&lt;y</a>");
    }
}
