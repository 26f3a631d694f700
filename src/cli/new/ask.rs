//! Questions on a terminal.

use mpm_verify::nearest;
use std::io::{BufRead, IsTerminal, Write};

/// A choice that no option has made.
pub(super) struct Question<'a> {
    /// Subject of the question.
    pub(super) what: &'a str,
    pub(super) choices: &'a [&'a str],
    /// The choice of who does not answer.
    pub(super) default: &'a str,
}

impl Question<'_> {
    /// The answer on standard input if that is a terminal; the default otherwise, and where there
    /// is nothing to choose.
    pub(super) fn ask(&self) -> String {
        let input = std::io::stdin();
        if self.choices.len() < 2 || !input.is_terminal() {
            return self.default.to_owned();
        }
        self.ask_on(&mut input.lock(), &mut std::io::stderr())
    }

    /// Asks until one of the choices is named; an empty line, or the end of input, takes the
    /// default.
    fn ask_on(&self, input: &mut impl BufRead, out: &mut impl Write) -> String {
        let Self { what, choices, default } = self;
        loop {
            let _ = write!(out, "{what} ({}) [{default}]: ", choices.join(", "));
            let _ = out.flush();
            let mut line = String::new();
            let is_over = !input.read_line(&mut line).is_ok_and(|bytes| bytes > 0);
            let answer = line.trim();
            if is_over || answer.is_empty() {
                return (*default).to_owned();
            }
            if choices.contains(&answer) {
                return answer.to_owned();
            }
            let near = nearest(answer, choices.iter().copied());
            let help = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
            let _ = writeln!(out, "`{answer}` is none of these{help}");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case::named("usl\n", "usl", 1)]
    #[case::nothing_said("\n", "musl", 1)]
    #[case::spaces("  usf \n", "usf", 1)]
    #[case::end_of_input("", "musl", 1)]
    #[case::asked_again("mulsl\nusl\n", "usl", 2)]
    #[case::no_line_end("usf", "usf", 1)]
    fn answers(#[case] typed: &str, #[case] wanted: &str, #[case] asked: usize) {
        let question =
            Question { what: "time scheme", choices: &["usf", "usl", "musl"], default: "musl" };
        let mut out = Vec::new();
        assert_eq!(question.ask_on(&mut typed.as_bytes(), &mut out), wanted);
        let out = String::from_utf8(out).unwrap();
        assert_eq!(out.matches("time scheme (usf, usl, musl) [musl]: ").count(), asked, "{out}");
        assert_eq!(out.contains("did you mean `musl`?"), asked > 1, "{out}");
    }
}
