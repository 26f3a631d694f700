#![doc = include_str!("basis/exercise/adding_a_basis.md")]

#[cfg(test)]
mod tests {
    //! The page's diff is real: it applies to the sources as they are, and the file that it adds is
    //! the one that `basis/laws.rs` compiles and holds to the laws.

    use std::{fs, path::Path};

    const PAGE: &str = include_str!("basis/exercise/adding_a_basis.md");
    const FILE: &str = include_str!("basis/exercise/quadratic_bernstein.rs");

    /// What the diff does to one file: hunks of marked lines, as they stand on the page.
    struct Patch<'a> {
        from: &'a str,
        to: &'a str,
        hunks: Vec<(&'a str, Vec<&'a str>)>,
    }

    fn patches() -> Vec<Patch<'static>> {
        let (_, diff) = PAGE.split_once("```diff\n").expect("the page has a diff");
        let (diff, _) = diff.split_once("\n```\n").expect("the diff has an end");
        diff.split("diff --git ").filter(|text| !text.is_empty()).map(patch).collect()
    }

    fn patch(text: &'static str) -> Patch<'static> {
        let mut lines = text.lines().skip_while(|line| !line.starts_with("--- "));
        let mut path = |mark| lines.next().and_then(|line| line.strip_prefix(mark)).expect(mark);
        let (from, to) = (path("--- "), path("+++ "));
        let mut hunks: Vec<(&str, Vec<&str>)> = Vec::new();
        for line in lines {
            match hunks.last_mut() {
                _ if line.starts_with("@@ ") => hunks.push((line, Vec::new())),
                Some((_, marked)) => marked.push(line),
                None => panic!("`{line}` stands before the first hunk of {to}"),
            }
        }
        Patch { from, to, hunks }
    }

    /// The lines of a hunk with one of `marks`, without it.
    fn side(marked: &[&str], marks: &str) -> String {
        let kept = marked.iter().filter(|line| line.starts_with(|mark| marks.contains(mark)));
        kept.flat_map(|line| [&line[1..], "\n"]).collect()
    }

    fn source(path: &str) -> String {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
        fs::read_to_string(file).expect("the diff changes files that exist")
    }

    #[test]
    fn the_diff_is_one_file_and_one_line_of_registration() {
        let [registration, file] = &patches()[..] else { panic!("two files") };
        assert_eq!((file.from, file.to), ("/dev/null", "b/src/mpm/basis/quadratic_bernstein.rs"));
        let added = |patch: &Patch<'_>, marks| -> String {
            patch.hunks.iter().map(|(_, marked)| side(marked, marks)).collect()
        };
        assert_eq!(
            added(file, "+"),
            FILE,
            "the page and src/mpm/basis/exercise/quadratic_bernstein.rs differ"
        );
        assert_eq!(added(registration, "-"), "");
        assert_eq!(
            added(registration, "+").lines().map(str::trim).collect::<Vec<_>>(),
            [
                "mod quadratic_bernstein;",
                r#""quadratic_bernstein" => quadratic_bernstein::QuadraticBernstein,"#
            ]
        );
    }

    /// `git apply` counts the lines of a hunk.
    #[test]
    fn the_hunks_are_as_long_as_they_say() {
        for (head, marked) in patches().iter().flat_map(|patch| &patch.hunks) {
            let words: Vec<&str> = head.split([' ', ',']).collect();
            let lines = |marks| side(marked, marks).lines().count().to_string();
            assert_eq!((words[2], words[4]), (&*lines(" -"), &*lines(" +")), "{head}");
        }
    }

    /// Or has been applied: whoever does the exercise shall not fail this test.
    #[test]
    fn the_diff_applies_to_the_present_sources() {
        let registration = &patches()[0];
        let text = source(registration.to.trim_start_matches("b/"));
        for (head, marked) in &registration.hunks {
            let [old, new] = [side(marked, " -"), side(marked, " +")];
            let places = text.matches(&old).count() + text.matches(&new).count();
            assert_eq!(places, 1, "{head} of {} is not there:\n{old}", registration.to);
        }
    }
}
