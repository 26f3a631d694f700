//! `--watch`: the same once more whenever a file changes.

use super::status::BAD_INPUT;
use super::{output, select};
use mpm_verify::suite::yaml::Source;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, SystemTime};

/// Time between two looks at the files.
const INTERVAL: Duration = Duration::from_millis(100);

/// Every file with its time of change and its length (bytes); none for one that is not there.
type FileStates = BTreeMap<PathBuf, Option<(SystemTime, u64)>>;

/// Calls `run`, and again after every change of what `targets` name, until the program is ended.
/// Returns only if there is no file to watch, or nothing can be printed.
pub(super) fn repeat(targets: &[PathBuf], mut run: impl FnMut() -> u8) -> u8 {
    let places = match select::places(targets) {
        Ok(places) => places,
        Err(diagnostic) => {
            output::diagnose(&diagnostic);
            return BAD_INPUT;
        }
    };
    // Looked at before the run: a change during it counts.
    let mut states = look(&places);
    loop {
        let code = run();
        if output::failure().is_some() {
            return code;
        }
        output::complain(&format!("watching {}; Ctrl-C ends it", listed(&places)));
        let (now, changed) = wait_for_change(&places, &states, INTERVAL);
        output::complain(&format!("changed: {}", listed(&changed)));
        states = now;
    }
}

fn listed(paths: &[PathBuf]) -> String {
    let names: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
    names.join(", ")
}

/// Waits until `places` differ from `before`, and returns their states and the files that differ.
/// Two looks must agree: an editor may write a file in parts, or put a new one in its place.
fn wait_for_change(
    places: &[PathBuf],
    before: &FileStates,
    interval: Duration,
) -> (FileStates, Vec<PathBuf>) {
    let mut last = before.clone();
    loop {
        thread::sleep(interval);
        let now = look(places);
        if now == last && now != *before {
            let differs = |path: &&PathBuf| now.get(*path) != before.get(*path);
            let gone = before.keys().filter(|path| !now.contains_key(*path));
            let changed = now.keys().filter(differs).chain(gone).cloned().collect();
            return (now, changed);
        }
        last = now;
    }
}

/// States of files, and of the suites in folders.
fn look(places: &[PathBuf]) -> FileStates {
    let files = |place: &PathBuf| match Source::files_in(place) {
        Ok(files) if place.is_dir() => files,
        _ => vec![place.clone()],
    };
    places.iter().flat_map(files).map(|file| (file.clone(), state(&file))).collect()
}

fn state(file: &Path) -> Option<(SystemTime, u64)> {
    let metadata = fs::metadata(file).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc;

    const BRIEF: Duration = Duration::from_millis(10);

    /// A new folder; its test removes it.
    fn folder(name: &str) -> PathBuf {
        let path = std::env::temp_dir().join(format!("mpm-verify-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        path
    }

    /// Names of files in `place` that have changed when waiting ends; `change` is made meanwhile.
    fn changed_by(place: &Path, change: impl FnOnce()) -> Vec<String> {
        let places = vec![place.to_path_buf()];
        let before = look(&places);
        let (sender, receiver) = mpsc::channel();
        thread::spawn(move || sender.send(wait_for_change(&places, &before, BRIEF)));
        assert!(receiver.recv_timeout(4 * BRIEF).is_err(), "nothing has changed");
        change();
        let (_, changed) = receiver.recv_timeout(Duration::from_secs(60)).unwrap();
        let name = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().into_owned();
        changed.iter().map(name).collect()
    }

    #[test]
    fn waiting_ends_with_the_file_that_has_changed() {
        let folder = folder("watch");
        let [a, b, notes] = ["a.yaml", "b.yaml", "notes.txt"].map(|name| folder.join(name));
        for file in [&a, &b, &notes] {
            fs::write(file, "one").unwrap();
        }
        let write = |file: &Path, text: &str| fs::write(file, text).unwrap();
        assert_eq!(changed_by(&folder, || write(&b, "longer")), ["b.yaml"]);
        let added = folder.join("c.yaml");
        assert_eq!(changed_by(&folder, || write(&added, "new")), ["c.yaml"]);
        assert_eq!(changed_by(&folder, || fs::remove_file(&a).unwrap()), ["a.yaml"]);
        let later = SystemTime::now() + Duration::from_secs(5);
        let touch = || {
            let file = fs::File::options().write(true).open(&b).unwrap();
            file.set_modified(later).unwrap();
        };
        assert_eq!(changed_by(&folder, touch), ["b.yaml"]);
        let other = || {
            write(&notes, "not a suite");
            write(&added, "changed");
        };
        assert_eq!(changed_by(&folder, other), ["c.yaml"]);
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_file_that_is_not_there_yet_is_waited_for() {
        let folder = folder("later");
        let file = folder.join("later.yaml");
        assert_eq!(changed_by(&file, || fs::write(&file, "here").unwrap()), ["later.yaml"]);
        fs::remove_dir_all(folder).unwrap();
    }
}
