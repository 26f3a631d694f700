use super::*;
use crate::report::figure::plot::style::contrast;
use crate::report::{svg, text};
use crate::verify::{ForceRow, InternalForce, StudyResults, SuiteOutcome, Unmet, UnmetCode};
use rstest::rstest;
use std::collections::BTreeSet;

const HOSTILE: &str = "</pre></script><script>alert(1)</script>\"'<img src=x onerror=alert(2)>&lt;";

/// Creates an internal-force study in which every text contains `words`.
fn outcome(suite: &str, words: &str, unmet: &[&str]) -> SuiteOutcome {
    let word = || words.to_owned();
    let row = |position| ForceRow { position, left: 1, right: 2, force: position, predicted: 0.5 };
    let case = |name: &str| CaseOutcome {
        expected: Some(word()),
        because: word(),
        verdict: word(),
        reason: word(),
        unmet: unmet
            .iter()
            .map(|unmet| Unmet::new(UnmetCode::RunFailed, format!("{unmet}{words}")))
            .collect(),
        study: Some(StudyResults::InternalForce(std::sync::Arc::new(InternalForce {
            rows: vec![row(0.0), row(1.0)],
        }))),
        ..CaseOutcome::new(&format!("{name}{words}"), "mpm", vec![(word(), word())])
    };
    SuiteOutcome {
        suite: suite.to_owned(),
        group: word(),
        title: word(),
        source: word(),
        about: format!("{words}\n\n{words}"),
        statement: vec![(word(), word())],
        meaning: 0,
        cases: vec![case("first"), case("second")],
    }
}

fn of(outcomes: &[SuiteOutcome], yaml: &str) -> String {
    let source = |outcome| SuiteSource { outcome, file: yaml, yaml };
    page(&outcomes.iter().map(source).collect::<Vec<_>>(), &RunFacts::default())
}

/// Returns all start tags with their attributes. Fails unless each tag is closed correctly.
fn tags(page: &str) -> Vec<(String, String)> {
    let (mut open, mut seen): (Vec<String>, _) = (Vec::new(), Vec::new());
    let mut rest = page.strip_prefix("<!DOCTYPE html>").expect("a document type");
    while let Some(start) = rest.find('<') {
        let end = start + rest[start..].find('>').expect("the end of a tag");
        let tag = &rest[start + 1..end];
        rest = &rest[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop().as_deref(), Some(name));
            continue;
        }
        let name = tag.split([' ', '/']).next().unwrap_or_default().to_owned();
        let closed = tag.ends_with('/') || ["meta", "link"].contains(&name.as_str());
        seen.push((name.clone(), tag.to_owned()));
        if ["script", "style"].contains(&name.as_str()) {
            rest = &rest[rest.find(&format!("</{name}>")).expect("its end")..];
        }
        if !closed {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "{open:?}");
    seen
}

fn values<'a>(page: &'a str, name: &str) -> Vec<&'a str> {
    let key = format!(" {name}=\"");
    let value = |(at, _)| page[at + key.len()..].split('"').next();
    page.match_indices(&key).filter_map(value).collect()
}

#[test]
fn markup_in_texts_is_escaped() {
    let page = of(&[outcome("a", HOSTILE, &["not met: "])], HOSTILE);
    let seen = tags(&page);
    let count = |name: &str| seen.iter().filter(|(tag, _)| tag == name).count();
    assert_eq!((count("script"), count("img"), count("style")), (1, 0, 1));
    let handlers = seen.iter().filter(|(_, tag)| {
        tag.split('"').step_by(2).any(|part| part.trim_start().starts_with("on"))
    });
    assert_eq!(handlers.count(), 0);
    assert!(page.matches("&lt;/pre&gt;&lt;/script&gt;").count() > 20, "texts are on the page");
}

#[test]
fn ids_are_unique_and_links_have_targets() {
    let page = of(&[outcome("a", " b", &[]), outcome("a-b", "", &["x"])], "suite: x");
    tags(&page);
    let ids = values(&page, "id");
    let unique: BTreeSet<&str> = ids.iter().copied().collect();
    assert_eq!(ids.len(), unique.len(), "{ids:?}");
    let links = values(&page, "href");
    assert!(links.len() > 10);
    for link in links.into_iter().filter(|link| *link != "data:,") {
        assert!(link.strip_prefix('#').is_some_and(|id| unique.contains(id)), "{link}");
    }
}

/// The page contains every line of the text report and every figure.
#[test]
fn the_page_contains_the_text_report_and_all_figures() {
    let outcome = outcome("a", "words & more", &[]);
    let page = of(std::slice::from_ref(&outcome), "");
    for line in text(&outcome).lines() {
        let line = Html::text(line).into_string();
        assert!(page.contains(&line), "{line}");
    }
    let figures = svg(&outcome);
    // The first figure is also on the first screen.
    assert_eq!(page.matches("<figure ").count(), figures.len() + figures.len().min(1));
    for figure in figures {
        let caption = format!(">{}</figcaption>", figure.file);
        let drawn = section::inline_svg(&figure.svg).into_string();
        assert!(page.contains(&caption) && page.contains(&drawn), "{}", figure.file);
    }
}

#[test]
fn failures_and_refused_files_are_marked_above_the_suites() {
    let sound = of(&[outcome("a", "x", &[])], "");
    assert!(sound.contains("<p class=\"ok finding\">1 suite, 2 cases: 2 pass, 0 FAIL.</p>"));
    let failed = of(&[outcome("a", "x", &["too low"])], "");
    let place = failed.find("<p class=\"bad finding\">1 suite, 2 cases: 2 FAIL.</p>");
    assert!(place.expect("a summary") < failed.find("<nav").expect("the list of suites"));
    assert!(failed.contains("a::firstx</a>: too lowx</li>"));
    let sources = [SuiteSource { outcome: &outcome("a", "x", &[]), file: "", yaml: "" }];
    let refused = page(&sources, &RunFacts { refused: 1, ..RunFacts::default() });
    assert!(refused.contains("<p class=\"bad finding\">1 suite, 2 cases: 2 pass, 0 FAIL. 1 file "));
    let none = page(&[], &RunFacts { refused: 2, ..RunFacts::default() });
    let summary = "<p class=\"bad finding\">0 suites, 0 cases. 2 files could not be used.</p>";
    assert!(none.contains(summary));
    tags(&none);
}

/// The page loads nothing from a network, and its content security policy forbids it.
#[test]
fn the_page_loads_no_resources() {
    let page = of(&[outcome("a", "http://example.org", &[])], "x");
    let addresses: Vec<&str> =
        values(&page, "src").into_iter().chain(values(&page, "xlink:href")).collect();
    assert!(addresses.is_empty(), "{addresses:?}");
    assert_eq!(page.matches("default-src &#39;none&#39;").count(), 1);
    assert!(commit().is_none_or(|commit| page.contains(&format!(", commit {commit}. "))));
    assert!(!STYLE.contains("url(") && !STYLE.contains("@import") && !SCRIPT.contains("fetch"));
}

/// Returns the light and the dark variant of a colour of the page.
fn colour(name: &str) -> [&'static str; 2] {
    let key = format!("--{name}:light-dark(");
    let (_, value) = STYLE.split_once(&key).expect(name);
    let (light, rest) = value.split_once(',').expect("two colours");
    [light, rest.split_once(')').expect("the end of the colours").0]
}

#[rstest]
fn texts_can_be_read(#[values("ink", "muted", "link", "ok", "bad")] text: &str) {
    for behind in [colour("page"), colour("raised")] {
        for (text, behind) in colour(text).into_iter().zip(behind) {
            assert!(contrast(text, behind) >= 4.5, "{text} on {behind}");
        }
    }
}

/// Browsers without support for `light-dark()` use the light colours.
#[test]
fn light_colours_are_the_fallback() {
    for name in ["page", "raised", "rule", "ink", "muted", "link", "ok", "bad"] {
        let plain = format!("--{name}:{}", colour(name)[0]);
        assert!(STYLE.split_once("@supports").expect("a fallback").0.contains(&plain), "{plain}");
    }
}
