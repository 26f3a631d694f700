//! The seeded defects, `tests/defects/FAMILY.txt`, which `ci/defects` puts behind switches of a
//! copy.
//!
//! A first line `# family`, then one block for each defect: `name: likely origin`, the file after
//! `in`, and the original text in lines that begin with `-`. This text is unique in the file, or
//! the first one after the text of a line `after`. Lines that begin with `+` are the changed text.

/// One defect.
#[derive(Debug, Default)]
pub(crate) struct Defect {
    /// Where it is written, `file: name`.
    pub(crate) site: String,
    pub(crate) name: String,
    /// File of the source that it changes.
    pub(crate) file: String,
    after: Option<String>,
    original: String,
    changed: String,
}

/// The defects of a file of the registry.
///
/// # Errors
/// An unknown line.
pub(crate) fn parse(file: &str, text: &str) -> Result<Vec<Defect>, String> {
    text.trim().split("\n\n").skip(1).map(|block| defect(file, block)).collect()
}

fn defect(file: &str, block: &str) -> Result<Defect, String> {
    let mut lines = block.lines();
    let first = lines.next().and_then(|first| first.split_once(": "));
    let (name, _) = first.ok_or_else(|| format!("{file}: `{block}` has no name"))?;
    let site = format!("{file}: {name}");
    let mut defect = Defect { site, name: name.to_owned(), ..Defect::default() };
    for line in lines {
        let (key, rest) = line.split_once(' ').unwrap_or((line, ""));
        match key {
            "in" => rest.clone_into(&mut defect.file),
            "after" => defect.after = Some(rest.to_owned()),
            "-" => join(&mut defect.original, rest),
            "+" => join(&mut defect.changed, rest),
            // Reason why theory does not detect it.
            "only" => {}
            _ => return Err(format!("{}: `{line}` says nothing known", defect.site)),
        }
    }
    Ok(defect)
}

fn join(lines: &mut String, line: &str) {
    if !lines.is_empty() {
        lines.push('\n');
    }
    lines.push_str(line);
}

impl Defect {
    /// Checks that the defect applies exactly once to the text `source`, and changes it.
    ///
    /// # Errors
    /// The reason why it does not apply.
    pub(crate) fn check(&self, source: &str) -> Result<(), String> {
        let Self { site, file, after, original, changed, .. } = self;
        let mark = after.as_ref().unwrap_or(original);
        let times = source.matches(mark).count();
        if mark.is_empty() || times != 1 {
            return Err(format!("{site}: {file} has `{mark}` {times} times, not once"));
        }
        let (_, below) = source.split_once(mark).unwrap_or_default();
        if after.is_some() && !below.contains(original) {
            return Err(format!("{site}: {file} does not have `{original}` after `{mark}`"));
        }
        if original == changed {
            return Err(format!("{site} changes nothing"));
        }
        Ok(())
    }
}
