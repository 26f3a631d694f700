//! Tests of the architecture: allowed imports, and rules for code, comments and documents.
//!
//! ```text
//! token    text -> tokens, without comments and strings
//! source   files -> modules, without code that is compiled for tests only
//! import   tokens -> the paths that a file names
//! graph    paths -> which file imports which; cycles
//! rules    the rules about imports and code, each with its reason
//! words    names of types, phrases and comments
//!
//! markdown   text -> headings, links, spans of code, fenced blocks
//! documents  stale paths, names, commands and JSON in documents
//! pages      tables of documents that are generated from the suites
//! exercises  pages that add a member to a family, compared with the compiled members
//! licences   licences of the dependencies
//! defects    seeded defects: their original text still exists
//! ```
//!
//! [`scanner`] tests the scanners themselves on small texts with planted breaches.

mod defects;
mod documents;
mod exercises;
mod graph;
mod import;
mod licences;
mod markdown;
mod pages;
mod rules;
mod scanner;
mod source;
mod token;
mod words;

use rules::Breach;

/// Fails with a list of `breaches`, the rule and its reason.
fn hold(rule: &str, why: &str, breaches: &[Breach]) {
    let lines: Vec<String> =
        breaches.iter().map(|b| format!("  {}:{}: {}", b.file, b.line, b.what)).collect();
    assert!(lines.is_empty(), "\n{}\nrule: {rule}\nwhy:  {why}\n", lines.join("\n"));
}

#[test]
fn module_imports_have_no_cycles() {
    let edges = graph::edges(&source::OF_PACKAGES);
    let cycles = graph::cycles(&edges);
    let written: Vec<String> = cycles.iter().map(|cycle| in_words(cycle)).collect();
    assert!(
        written.is_empty(),
        "\n{}\nrule: no cycle among modules (a file is a module; see tests/architecture/graph.rs \
         for what counts as an import)\nwhy:  modules in a cycle can only be understood, tested \
         and changed all at once\n",
        written.join("\n")
    );
}

fn in_words(cycle: &[&graph::Edge]) -> String {
    let step = |edge: &&graph::Edge| {
        let (from, to) = (edge.from.join("::"), edge.to.join("::"));
        format!("    {from} -> {to}: {}:{} names `{}`\n", edge.file, edge.line, edge.path)
    };
    format!("  a cycle of {}:\n{}", cycle.len(), cycle.iter().map(step).collect::<String>())
}

#[test]
fn modules_import_only_allowed_modules() {
    let edges = graph::edges(&source::OF_PACKAGES);
    for import_rule in rules::IMPORT_RULES {
        let rule = match import_rule.may {
            [] => format!("`{}` imports no other part of the crate", import_rule.module),
            may => format!("`{}` imports only itself and {}", import_rule.module, may.join(", ")),
        };
        hold(&rule, import_rule.why, &rules::forbidden_imports(import_rule, &edges));
    }
}

#[test]
fn rules_and_exceptions_concern_existing_files() {
    let sources = &*source::OF_PACKAGES;
    for import_rule in rules::IMPORT_RULES {
        let inside = sources.iter().any(|source| rules::is_in(&source.module, import_rule.module));
        assert!(
            inside,
            "there is a rule about `{}`, which is not in the sources",
            import_rule.module
        );
    }
    for (file, reason) in rules::LONGER {
        let found = sources.iter().find(|source| source.file == file);
        let needed = found.is_some_and(|source| source.lines > rules::MOST_LINES);
        assert!(needed, "{file} may be long ({reason}) but is not: take it off the list");
    }
}

#[test]
fn only_one_file_lists_all_dimensions() {
    let (sources, all): (_, [&[&str]; 3]) =
        (&source::OF_PACKAGES, [&["<", "1", ">"], &["<", "2", ">"], &["<", "3", ">"]]);
    hold(
        "only crates/subject/src/dimension.rs has `<1>`, `<2>` and `<3>` together",
        "all else is written once for any dimension, so that no dimension is forgotten",
        &rules::mentions(sources, &all, "crates/subject/src/dimension.rs"),
    );
}

#[test]
fn only_the_yaml_module_names_the_yaml_libraries() {
    for library in ["serde_yaml", "yaml_serde", "saphyr_parser"] {
        hold(
            "only crates/suites/src/suite/yaml/ names the YAML libraries",
            "every text passes the same checks, and another library would change one folder",
            &rules::mentions(&source::OF_PACKAGES, &[&[library]], "crates/suites/src/suite/yaml/"),
        );
    }
}

#[test]
fn unit_tests_run_no_solver() {
    let unwanted: [&[&str]; 3] =
        [&["Solver", "::", "new"], &["Runner", "::"], &["Suite", "::", "load"]];
    hold(
        "unit tests step no solver and load no suite: such tests are in tests/it or crates/solvers/tests",
        "unit tests are compiled without optimisation, and would take ten times as long",
        &rules::tests_with(&source::ALL, &unwanted)
            .into_iter()
            .filter(|breach| !rules::LOADS_SUITES.iter().any(|(file, _)| *file == breach.file))
            .collect::<Vec<_>>(),
    );
}

#[test]
fn files_are_short() {
    hold(
        "a file has at most 500 lines, not counting its tests",
        "a file holds one idea; one that grows beyond has two",
        &rules::long(&source::OF_PACKAGES, &rules::LONGER),
    );
}

#[test]
fn modules_have_names() {
    hold(
        "no module is called utils, helpers, misc or common",
        "a name that fits everything attracts everything",
        &rules::nameless(&source::OF_PACKAGES),
    );
}

#[test]
fn modules_are_files() {
    hold(
        "no module but `tests` stands inside a file",
        "the rules about imports follow modules from file to file and would not see it",
        &rules::nested(&source::OF_PACKAGES),
    );
}

#[test]
fn code_that_depends_on_the_platform_is_refused() {
    let sources = &*source::OF_PACKAGES;
    hold(
        "transcendental functions and powers come from `libm`: `libm::sin(x)`, not `x.sin()`",
        "the standard library takes them from the platform, whose last bits differ between \
         machines; sqrt is exact by IEEE 754 and may be a method",
        &rules::platform_calls(sources),
    );
    hold(
        "products and sums are fused by `plus_product` of `mpm/foundation/simd`, in loops over nodes",
        "it rounds once where the formula as written rounds twice, on every processor; elsewhere a \
         fused operation may be a call, and a change between the two changes stored results",
        &rules::fused(sources),
    );
}

#[test]
fn texts_of_suites_have_no_unclear_phrase() {
    let texts: Vec<words::Text> =
        words::PLAIN_FILES.iter().flat_map(|(folder, end)| source::texts(folder, end)).collect();
    hold(
        "suites and their pages are in plain English (UNCLEAR_PHRASES in tests/architecture/words.rs)",
        "a reader understands each sentence at the first reading",
        &words::unclear_phrases(&texts),
    );
}

#[test]
fn no_two_types_have_one_name() {
    hold(
        "no two source files define a type of the same name",
        "who reads the name would have to look up which of them is meant",
        &words::twice(&source::OF_PACKAGES, words::TWICE),
    );
}

/// The sources whose comments follow the rules for prose.
fn plain_sources() -> Vec<words::Text> {
    words::PLAIN_SOURCES.iter().flat_map(|folder| source::texts(folder, ".rs")).collect()
}

#[test]
fn comments_are_short_and_name_the_thing() {
    hold(
        "no comment begins with \"What\", \"The same\" or another of UNCLEAR_BEGINNINGS \
         (tests/architecture/words.rs), and no line of a comment is longer than 100 columns",
        "a noun phrase that names the thing is understood without its neighbours",
        &words::comments(&plain_sources()),
    );
}

#[test]
fn comments_have_no_unclear_phrase() {
    hold(
        "comments are in plain English (UNCLEAR_PHRASES in tests/architecture/words.rs)",
        "a reader understands each sentence at the first reading",
        &words::unclear_phrases(&words::of_comments(&plain_sources())),
    );
}

fn documents() -> Vec<markdown::Document> {
    let texts = source::texts("", ".md");
    texts.iter().map(|(file, text)| markdown::Document::new(file, text)).collect()
}

#[test]
fn documents_refer_only_to_existing_things() {
    let manifest: String =
        source::texts("", "Cargo.toml").into_iter().map(|(_, text)| text).collect();
    let has = documents::Repository::new(&source::paths(""), &source::texts("", ".rs"), &manifest);
    let documents = documents();
    let stale = documents.iter().flat_map(|document| documents::stale(document, &documents, &has));
    hold(
        "paths, links, names of the crate, commands and JSON in documents exist",
        "a document that says what is no longer there costs its reader more than none",
        &stale.collect::<Vec<_>>(),
    );
}

/// The present page of suites, and the generated page.
fn page_of_suites() -> (String, String) {
    let page = std::fs::read_to_string(source::root().join(pages::SUITES)).expect("a page");
    let (anew, missing) = pages::with_tables(&page, &pages::suites());
    assert!(missing.is_empty(), "{} has no table of {missing:?}", pages::SUITES);
    (page, anew)
}

#[test]
fn page_of_suites_is_up_to_date() {
    let (page, anew) = page_of_suites();
    assert!(page == anew, "{} is stale: run ci/pages", pages::SUITES);
}

#[test]
#[ignore = "ci/pages runs it"]
fn the_page_of_suites_is_written() {
    let (_, anew) = page_of_suites();
    std::fs::write(source::root().join(pages::SUITES), anew).expect("a page is written");
}

#[test]
fn every_folder_page_links_the_report_of_each_suite() {
    let texts: std::collections::BTreeMap<_, _> =
        source::texts("verification", "README.md").into_iter().collect();
    let told = |row: &&pages::Row| {
        let page = texts.get(&format!("verification/{}/README.md", row.folder));
        // A suite of external solvers has no report.
        let report = format!("verification/{}/{}.snap", row.folder, row.name);
        let kind = if source::root().join(report).exists() { "snap" } else { "yaml" };
        page.is_some_and(|page| page.contains(&format!("[`{0}`]({0}.{kind})", row.name)))
    };
    let suites = pages::suites();
    let untold: Vec<_> = suites.iter().filter(|row| !told(row)).map(|row| &row.name).collect();
    assert!(untold.is_empty(), "not in the README.md of their folder: {untold:?}");
}

#[test]
fn quoted_reports_agree_with_snapshots() {
    for page in documents().iter().filter(|page| pages::QUOTING.contains(&page.file.as_str())) {
        let (quoted, wrong) = pages::misquoted(page);
        assert!(quoted > 0, "{} quotes no report: are they still found?", page.file);
        assert!(wrong.is_empty(), "{}: no report has what lines {wrong:?} quote", page.file);
    }
}

#[test]
fn dependencies_have_permissive_licences() {
    for (expression, is_known) in [
        ("MIT OR GPL-3.0", true),
        ("(MIT OR Apache-2.0) AND Unicode-3.0", true),
        ("MIT AND GPL-3.0", false),
        ("GPL-3.0", false),
        ("", false),
    ] {
        assert_eq!(licences::is_known(expression), is_known, "{expression}");
    }
    let found = licences::of_dependencies();
    assert!(found.len() > 50, "{} crates: are they still found?", found.len());
    let unknown: Vec<_> =
        found.iter().filter(|(_, licence)| !licences::is_known(licence)).collect();
    assert!(unknown.is_empty(), "licences to be looked at: {unknown:?}");
}

#[test]
fn the_book_has_every_document() {
    let summary = "docs/SUMMARY.md";
    let documents = documents();
    let book = documents.iter().find(|page| page.file == summary).expect("a table of contents");
    let listed: Vec<String> = book.links().into_iter().map(|link| link.text).collect();
    let link =
        |file: &str| file.strip_prefix("docs/").map_or_else(|| format!("../{file}"), str::to_owned);
    let pages = documents.iter().filter(|page| page.file != summary);
    let missing: Vec<_> = pages.filter(|page| !listed.contains(&link(&page.file))).collect();
    let missing: Vec<_> = missing.iter().map(|page| &page.file).collect();
    assert!(missing.is_empty(), "not in {summary}: {missing:?}");
}

#[test]
fn pages_of_exercises_show_the_compiled_members() {
    let pages = documents().into_iter().filter(|page| page.file.starts_with("docs/exercises/"));
    let stale = exercises::stale(&pages.collect::<Vec<_>>());
    assert!(stale.is_empty(), "\n{}", stale.join("\n"));
}

#[test]
fn exercises_touch_few_files() {
    let pages = documents().into_iter().filter(|page| page.file.starts_with("docs/exercises/"));
    let wrong = exercises::touching_too_much(&pages.collect::<Vec<_>>());
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn seeded_defects_apply_to_the_current_sources() {
    let files = source::texts("tests/defects", ".txt");
    let parsed = files.iter().map(|(file, text)| defects::parse(file, text));
    let all: Vec<Vec<defects::Defect>> =
        parsed.collect::<Result<_, _>>().unwrap_or_else(|what| panic!("{what}"));
    let all: Vec<defects::Defect> = all.into_iter().flatten().collect();
    assert!(all.len() >= 80, "only {} defects", all.len());
    let page = std::fs::read_to_string(source::root().join("docs/defects.md")).expect("a page");
    let mut names = std::collections::BTreeSet::new();
    let mut wrong = Vec::new();
    for defect in &all {
        let text = std::fs::read_to_string(source::root().join(&defect.file)).unwrap_or_default();
        wrong.extend(defect.check(&text).err());
        if !page.contains(&format!("| `{}` |", defect.name)) {
            wrong.push(format!("{}: not in docs/defects.md; run ci/defects", defect.site));
        }
        if !names.insert(&defect.name) {
            wrong.push(format!("{}: a second defect of this name", defect.site));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}
