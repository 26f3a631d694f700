//! Words to who ends a run by Ctrl-C: how to go on.

use std::borrow::Cow;

/// How to go on with the run of this command line, whose results are kept or not.
pub(super) fn note(kept: bool) -> String {
    let words: Vec<String> = std::env::args().skip(1).collect();
    note_of(&words, kept)
}

fn note_of(words: &[String], kept: bool) -> String {
    let mut words: Vec<Cow<'_, str>> = words.iter().map(|word| quoted(word)).collect();
    if words.first().is_none_or(|word| word != "run") {
        words.insert(0, "run".into());
    }
    let line = words.join(" ");
    if kept {
        format!("interrupted: `mpm-verify {line}` goes on from here")
    } else {
        format!(
            "interrupted, and nothing is kept: with a folder for results, `mpm-verify {line} \
             --resume kept`, a run that is interrupted goes on"
        )
    }
}

/// The word as a shell reads it.
fn quoted(word: &str) -> Cow<'_, str> {
    shlex::try_quote(word).unwrap_or(word.into())
}

#[cfg(test)]
mod tests {
    use super::note_of;
    use rstest::rstest;

    #[rstest]
    #[case(&["run", "heat", "--resume", "a b"], true, "`mpm-verify run heat --resume 'a b'` goes on")]
    #[case(&["run", "--full", "mms-*"], false, "`mpm-verify run --full 'mms-*' --resume kept`")]
    #[case(&[], false, "`mpm-verify run --resume kept`")]
    fn the_note_has_a_line_that_can_be_pasted(
        #[case] words: &[&str],
        #[case] kept: bool,
        #[case] wanted: &str,
    ) {
        let words: Vec<String> = words.iter().map(ToString::to_string).collect();
        let note = note_of(&words, kept);
        assert!(note.contains(wanted), "{note}");
    }
}
