//! Patterns for names of cases and suites.

/// Whether the pattern `glob` matches `name`; `*` matches any text.
pub fn fits(glob: &str, name: &str) -> bool {
    let mut parts = glob.split('*');
    let Some(rest) = parts.next().and_then(|first| name.strip_prefix(first)) else { return false };
    let parts: Vec<&str> = parts.collect();
    let Some((last, middle)) = parts.split_last() else { return rest.is_empty() };
    let mut rest = rest;
    for part in middle {
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    rest.ends_with(last)
}

#[cfg(test)]
mod tests {
    use rstest::rstest;

    #[rstest]
    #[case("fem-linear-lumped", "fem-linear-lumped", true)]
    #[case("fem-linear-lumped", "fem-linear-lumped-x", false)]
    #[case("*", "anything", true)]
    #[case("fem-*", "fem-linear-lumped", true)]
    #[case("fem-*", "mpm-linear", false)]
    #[case("*-lumped", "fem-linear-lumped", true)]
    #[case("fem-*-nodes", "fem-linear-lumped-nodes", true)]
    #[case("fem-*-*-nodes", "fem-linear-nodes", false)]
    #[case("*usl*usl", "a-usl", false)]
    #[case("", "x", false)]
    fn globs(#[case] glob: &str, #[case] name: &str, #[case] wanted: bool) {
        assert_eq!(super::fits(glob, name), wanted);
    }
}
