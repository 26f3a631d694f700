//! The paths in code: of `use` declarations, expressions and types.

use crate::token::Token;

/// One path, as written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Import {
    /// Its segments; the last is `*` if a `use` takes everything.
    pub(crate) path: Vec<String>,
    pub(crate) line: usize,
    /// The name that a `use` gives it in its file; `None` for a path outside `use`.
    pub(crate) name: Option<String>,
    /// Whether it is a `pub use`, with any visibility.
    pub(crate) exported: bool,
}

/// Every path of `code`, except in the bodies of `macro_rules!`, which are code of their callers.
pub(crate) fn imports(code: &[Token]) -> Vec<Import> {
    let mut reader = Reader { code, at: 0, found: Vec::new() };
    while reader.at < code.len() {
        match (reader.text(0), reader.text(1)) {
            ("macro_rules", "!") => reader.skip_macro(),
            ("use", next) if next != "<" => reader.import(),
            (first, "::") if is_name(first) => reader.path(),
            _ => reader.at += 1,
        }
    }
    reader.found
}

fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

struct Reader<'a> {
    code: &'a [Token],
    at: usize,
    found: Vec<Import>,
}

impl<'a> Reader<'a> {
    /// The token `ahead` of the present one; empty beyond the end.
    fn text(&self, ahead: usize) -> &'a str {
        self.code.get(self.at + ahead).map_or("", |token| token.text.as_str())
    }

    fn before(&self) -> &'a str {
        self.at.checked_sub(1).map_or("", |at| self.code[at].text.as_str())
    }

    fn skip_macro(&mut self) {
        let mut depth = 0;
        while self.at < self.code.len() {
            depth += match self.text(0) {
                "(" | "[" | "{" => 1,
                ")" | "]" | "}" => -1,
                _ => 0,
            };
            let closed = depth == 0 && matches!(self.text(0), ")" | "]" | "}");
            self.at += 1;
            if closed {
                return;
            }
        }
    }

    /// `use` or `pub use`, with its tree of names.
    fn import(&mut self) {
        let exported = matches!(self.before(), "pub" | ")");
        self.at += 1;
        self.tree(&[], exported);
    }

    fn tree(&mut self, above: &[String], exported: bool) {
        let (mut path, line) = (above.to_vec(), self.code[self.at.min(self.code.len() - 1)].line);
        loop {
            match self.text(0) {
                "{" => return self.branches(&path, exported),
                "::" if path.is_empty() => path.push(String::new()),
                "::" => {}
                "self" if !path.is_empty() => {}
                text if is_name(text) || text == "*" => path.push(text.to_owned()),
                _ => break,
            }
            self.at += 1;
            if self.text(0) == "as" {
                self.at += 1;
                break;
            }
        }
        let renamed = self.before() == "as";
        let name = if renamed { Some(self.text(0).to_owned()) } else { path.last().cloned() };
        self.at += usize::from(renamed);
        self.found.push(Import { path, line, name, exported });
    }

    fn branches(&mut self, path: &[String], exported: bool) {
        self.at += 1;
        while !matches!(self.text(0), "}" | "") {
            let before = self.at;
            self.tree(path, exported);
            // A comma, or an invalid `use` tree: continue in any case.
            self.at += usize::from(self.text(0) == "," || self.at == before);
        }
        self.at += 1;
    }

    /// `a::b::c` outside `use`. The path in `pub(in a::b)` is not an import.
    fn path(&mut self) {
        let line = self.code[self.at].line;
        let wanted = !matches!(self.before(), "::" | "$" | "in");
        let mut path = vec![self.text(0).to_owned()];
        while self.text(1) == "::" && is_name(self.text(2)) {
            path.push(self.text(2).to_owned());
            self.at += 2;
        }
        self.at += 1;
        if wanted && path.len() > 1 {
            self.found.push(Import { path, line, name: None, exported: false });
        }
    }
}
