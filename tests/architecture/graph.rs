//! Imports between files: the paths of every file, resolved to the files that define the named
//! items.
//!
//! Definition of an import of one file by another:
//! - A path counts for the file that *defines* what it names. `crate::mpm::Grid` is an import of
//!   `mpm/grid.rs`, found through the `pub use` in `mpm/mod.rs`, and not one of `mpm/mod.rs`. A
//!   name that cannot be resolved further counts as defined in the deepest module of its path.
//! - `mod child;` is no import, and neither is a `pub use` of something below the same folder: a
//!   `mod.rs` may re-export items of its children while they import each other through it.
//! - `use super::child;` only gives the module a name: `child::thing` is the import.
//! - Method calls name no file and are ignored, as is code that a macro generates.

use crate::import::{Import, imports};
use crate::source::{Module, Source};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// An import of one file by another.
#[derive(Debug, Clone)]
pub(crate) struct Edge {
    pub(crate) from: Module,
    pub(crate) to: Module,
    /// Place, and the path as written.
    pub(crate) file: String,
    pub(crate) line: usize,
    pub(crate) path: String,
}

struct Graph<'a> {
    files: BTreeMap<&'a [String], (&'a Source, Vec<Import>)>,
}

/// Target of a path.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Target {
    /// A module itself.
    Module(Module),
    /// Something that this module defines.
    Item(Module),
}

/// Every import between two different files.
pub(crate) fn edges(sources: &[Source]) -> Vec<Edge> {
    let files = sources.iter().map(|source| {
        let paths = imports(&source.code);
        (&source.module[..], (source, paths))
    });
    let graph = Graph { files: files.collect() };
    graph.files.values().flat_map(|(source, paths)| graph.edges_of(source, paths)).collect()
}

impl Graph<'_> {
    fn edges_of(&self, source: &Source, paths: &[Import]) -> Vec<Edge> {
        let mut edges = Vec::new();
        for import in paths {
            for target in self.resolve(&source.module, &import.path, &mut BTreeSet::new()) {
                let Target::Item(to) = target else { continue };
                let shown = import.exported && to.starts_with(&source.module);
                if to != source.module && !shown {
                    edges.push(Edge {
                        from: source.module.clone(),
                        to,
                        file: source.file.clone(),
                        line: import.line,
                        path: import.path.join("::"),
                    });
                }
            }
        }
        edges
    }

    /// Resolves `path` of `module`; a path to another crate resolves to nothing.
    fn resolve(
        &self,
        module: &[String],
        path: &[String],
        trail: &mut BTreeSet<(Module, String)>,
    ) -> Vec<Target> {
        let mut base = module;
        let mut rest = path;
        while let Some((first, after)) = rest.split_first() {
            base = match first.as_str() {
                "crate" | "mpm_verify" => &[],
                "super" => &base[..base.len().saturating_sub(1)],
                "self" => base,
                _ => break,
            };
            rest = after;
        }
        let targets = self.walk(base, rest, trail);
        // A plain name that its file neither declares nor imports is another crate or a local type.
        if rest.len() == path.len() && targets.is_empty() {
            return Vec::new();
        }
        if targets.is_empty() { vec![Target::Item(base.to_vec())] } else { targets }
    }

    /// Resolves `rest` downwards from `module`, through its imports; empty if there is no such
    /// name.
    fn walk(
        &self,
        module: &[String],
        rest: &[String],
        trail: &mut BTreeSet<(Module, String)>,
    ) -> Vec<Target> {
        let Some((name, after)) = rest.split_first() else {
            return vec![Target::Module(module.to_vec())];
        };
        let mut targets = Vec::new();
        if let Some(child) = self.child(module, name) {
            if !after.is_empty() {
                let found = self.walk(&child, after, trail);
                return if found.is_empty() { vec![Target::Item(child)] } else { found };
            }
            targets.push(Target::Module(child));
            // A function may have the name of a module: `mpm::kernel` is both.
            if self.has_function(module, name) {
                targets.push(Target::Item(module.to_vec()));
            }
        }
        let Some((_, imports)) = self.files.get(module) else { return targets };
        for import in imports.iter().filter(|import| import.name.as_deref() == Some(name)) {
            if trail.insert((module.to_vec(), import.path.join("::"))) {
                let path = [&import.path[..], after].concat();
                targets.extend(self.resolve(module, &path, trail));
            }
        }
        targets
    }

    fn child(&self, module: &[String], name: &str) -> Option<Module> {
        // The children of `main.rs` are in its folder.
        let base = if module == ["main"] { &[] } else { module };
        let child = [base, &[name.to_owned()]].concat();
        self.files.contains_key(&child[..]).then_some(child)
    }

    fn has_function(&self, module: &[String], name: &str) -> bool {
        self.files.get(module).is_some_and(|(source, _)| {
            source.code.windows(2).any(|pair| pair[0].text == "fn" && pair[1].text == name)
        })
    }
}

/// The shortest cycle through each module that is on one, each cycle once.
pub(crate) fn cycles(edges: &[Edge]) -> Vec<Vec<&Edge>> {
    let mut leaving: BTreeMap<&Module, Vec<&Edge>> = BTreeMap::new();
    for edge in edges {
        leaving.entry(&edge.from).or_default().push(edge);
    }
    let mut seen = BTreeSet::new();
    let shortest = leaving.keys().filter_map(|start| cycle(&leaving, start));
    shortest
        .filter(|cycle| {
            seen.insert(cycle.iter().map(|edge| edge.from.clone()).collect::<BTreeSet<_>>())
        })
        .collect()
}

/// The shortest way from `start` back to it.
fn cycle<'a>(
    leaving: &BTreeMap<&'a Module, Vec<&'a Edge>>,
    start: &Module,
) -> Option<Vec<&'a Edge>> {
    let mut reached: BTreeMap<&Module, &Edge> = BTreeMap::new();
    let mut waiting = VecDeque::from([start]);
    while let Some(module) = waiting.pop_front() {
        for edge in leaving.get(module).into_iter().flatten() {
            if !reached.contains_key(&edge.to) {
                reached.insert(&edge.to, *edge);
                waiting.push_back(&edge.to);
            }
        }
    }
    let mut way = vec![*reached.get(start)?];
    while way[0].from != *start {
        way.insert(0, reached[&way[0].from]);
    }
    Some(way)
}
