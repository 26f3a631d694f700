//! `run --html`: one page with all results.

use super::{
    BAD_INPUT, BAR, FAILED, Folder, SOUND, ambitious, assert_contains, mistaken, without_files,
};

#[test]
fn page_has_verdicts_figures_reports_and_suites() {
    let folder = Folder::with("bar.yaml", BAR);
    let arguments = ["run", "bar.yaml", "grid-crossing", "--html", "new/page.html"];
    let out = folder.accepted(&arguments);
    let page = folder.read("new/page.html");
    assert_contains(
        &page,
        &[
            "<p class=\"ok finding\">2 suites, ",
            "<section id=\"suite-short-bar\" class=\"suite\">",
            "<a href=\"#case-short-bar.fem-linear-lumped\">",
            "<tr id=\"case-short-bar.fem-linear-lumped\">",
            "<figure id=\"figure-short-bar.1\">",
            "<details id=\"yaml-short-bar\"><summary>bar.yaml</summary>",
            "initial_velocity: [&quot;1e-3*sin(pi*X/2)&quot;]",
        ],
    );
    // The printed text is the same as without a page, and each run writes the same bytes.
    assert_eq!(without_files(&out), folder.call(&arguments[..3]).out);
    folder.call(&["run", "bar.yaml", "grid-crossing", "--html", "again.html", "--jobs", "1"]);
    // Only the line with commit, date and machine differs.
    let again = folder.read("again.html");
    let lines = |page: &'_ str| -> Vec<String> {
        page.lines().filter(|line| !line.contains("\"muted run\"")).map(str::to_owned).collect()
    };
    assert!(lines(&page) == lines(&again), "the page depends on more than the run");
    let here = folder.path().display().to_string();
    assert!(!page.contains(&here), "the page names a folder of this machine");
}

#[test]
fn page_begins_with_a_figure_and_the_findings() {
    let folder = Folder::new();
    folder.accepted(&["run", "vibrating-bar", "grid-crossing", "--html", "page.html"]);
    let page = folder.read("page.html");
    let parts = [
        "id=\"first-figure\"",
        "id=\"findings\"",
        "id=\"methods\"",
        "id=\"suites\"",
        "id=\"verdicts\"",
    ];
    assert!(parts.map(|part| page.find(part).expect(part)).is_sorted());
    assert_contains(
        &page,
        &[
            "<p class=\"ok finding\">2 suites, 9 cases: 8 pass, 1 known limit, 0 FAIL.</p>",
            "<figcaption><a href=\"#suite-vibrating-bar\">vibrating-bar</a>: 2 pass, 1 known limit. ",
            "vibrating-bar::mpm-linear-flip-usf</a>: USF updates the stress",
            // Two of three time schemes have the expected order; the third has a lower one.
            "<span class=\"share\" style=\"--share:66%\">2 of 3</span>",
            "<td><span class=\"known_limit\">1.75..1.96</span></td>",
            // A study of internal forces has no order.
            "<td><span class=\"pass\">see report</span></td>",
        ],
    );
}

#[test]
fn page_lists_unexpected_results() {
    let folder = Folder::with("bar.yaml", ambitious());
    folder.write("bad.yaml", mistaken());
    assert_eq!(folder.call(&["run", "bar.yaml", "--html", "page.html"]).code, FAILED);
    let page = folder.read("page.html");
    assert!(page.contains("1 suite, 2 cases: 2 FAIL."));
    assert!(page.contains("ambitious-bar::mpm-linear-flip-musl</a>: "));
    folder.call(&["run", "bar.yaml", "bad.yaml", "--html", "page.html"]).ended(BAD_INPUT);
    assert!(folder.read("page.html").contains("1 file could not be used."));
}

/// Skipped suites do not shift the files of other suites.
#[test]
fn a_page_of_chosen_cases_has_the_files_of_their_suites() {
    let folder = Folder::with(
        "a.yaml",
        BAR.replace("  - mpm: {basis: linear, transfer: flip, scheme: musl}\n", ""),
    );
    folder.write("b.yaml", BAR.replace("short-bar", "other-bar"));
    let arguments = ["run", "a.yaml", "b.yaml", "--case", "mpm", "--html", "page.html"];
    assert_eq!(folder.call(&arguments).code, SOUND);
    let page = folder.read("page.html");
    assert!(page.contains("<details id=\"yaml-other-bar\"><summary>b.yaml</summary>"));
    assert!(!page.contains("a.yaml"));
}
