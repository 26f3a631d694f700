//! A suite file in memory, with the positions of its values.

use super::tree::{Scalar, TreeNode, tree};
use super::{Diagnostic, Place};
use std::fs::{self, File, Metadata};
use std::io::{self, Read};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Maximum file size (bytes), about ten times the size of a long suite.
pub const MAX_BYTES: usize = 64 * 1024;

/// A text that is safe to parse, with its file name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    name: String,
    text: String,
    scalars: Vec<Scalar>,
    root: TreeNode,
    is_trusted: bool,
}

impl Source {
    /// Reads a file.
    ///
    /// # Errors
    /// If the file does not exist, is a folder, is too large or not UTF-8, or if
    /// [`Source::from_text`] refuses the text.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Diagnostic> {
        let path = path.as_ref();
        Self::from_text(path.display().to_string(), read_text(path, MAX_BYTES, "suite file")?)
    }

    /// Reads the output of a program, up to the maximum file size of a suite.
    ///
    /// # Errors
    /// If reading fails, or the output is too large, not UTF-8, or refused by
    /// [`Source::from_text`].
    pub fn from_reader(name: &str, reader: impl Read) -> Result<Self, Diagnostic> {
        Self::from_text(name, limited(name, reader, MAX_BYTES)?)
    }

    /// Checks a text in memory, such as a suite embedded in the program.
    ///
    /// # Errors
    /// If the text is too large, contains control characters or is not YAML. Also if it nests too
    /// deeply or has too long lists or maps, duplicate keys, keys that are not names, numbers that
    /// are not finite, anchors, aliases, tags, merge keys, directives, or more than one document.
    pub fn from_text(name: impl Into<String>, text: impl Into<String>) -> Result<Self, Diagnostic> {
        let (name, mut text) = (name.into(), text.into());
        if text.len() > MAX_BYTES {
            return Err(too_large(&name, Some(text.len() as u64), MAX_BYTES));
        }
        // A byte order mark has no meaning in UTF-8, and would shift the columns of the first line.
        if text.starts_with('\u{feff}') {
            text.remove(0);
        }
        characters(&name, &text)?;
        let (scalars, root) = tree(&name, &text)?;
        Ok(Self { name, text, scalars, root, is_trusted: false })
    }

    /// Returns this text as one whose solution is not checked when the suite is loaded. The
    /// built-in suites load three times as fast. A suite that runs must be checked.
    #[must_use]
    pub fn trusted(self) -> Self {
        Self { is_trusted: true, ..self }
    }

    pub(crate) fn is_trusted(&self) -> bool {
        self.is_trusted
    }

    /// Returns the paths of the suites (`.yaml` and `.yml`) in a folder and its subfolders, sorted
    /// by file name.
    ///
    /// # Errors
    /// If a folder cannot be read.
    pub fn files_in(folder: &Path) -> io::Result<Vec<PathBuf>> {
        let is_suite = |path: &PathBuf| path.extension().is_some_and(|e| e == "yaml" || e == "yml");
        let is_hidden =
            |path: &Path| path.file_name().is_some_and(|name| name.as_encoded_bytes()[0] == b'.');
        let mut paths = entries(folder)?;
        for group in paths.clone().iter().filter(|path| path.is_dir() && !is_hidden(path)) {
            paths.extend(entries(group)?);
        }
        paths.retain(is_suite);
        paths.sort_by(|a, b| a.file_name().cmp(&b.file_name()).then_with(|| a.cmp(b)));
        Ok(paths)
    }

    /// Returns the name of the folder that contains a file. This name is the group of the suite.
    pub fn group_of(file: &Path) -> String {
        let folder = file.parent().and_then(Path::file_name);
        folder.unwrap_or_default().to_string_lossy().into_owned()
    }

    pub(crate) fn group(&self) -> String {
        Self::group_of(Path::new(&self.name))
    }

    /// Returns the file name, as given by the user.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the text of the file, without byte order mark.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Creates a diagnostic at a position in this file.
    pub fn diagnostic(&self, place: Place, message: &str) -> Diagnostic {
        Diagnostic::at(&self.name, &self.text, place.bytes(), message)
    }

    pub(crate) fn scalar_from(&self, offset: usize) -> Option<&Scalar> {
        self.scalars.get(self.scalars.partition_point(|scalar| scalar.range.start < offset))
    }

    pub(crate) fn root(&self) -> &TreeNode {
        &self.root
    }

    pub(crate) fn scalar(&self, index: usize) -> &Scalar {
        &self.scalars[index]
    }

    pub(crate) fn is_empty(&self) -> bool {
        match &self.root {
            TreeNode::Empty(_) => true,
            TreeNode::Scalar(scalar) => {
                matches!(
                    &self.text[self.scalars[*scalar].range.clone()],
                    "~" | "null" | "Null" | "NULL"
                )
            }
            TreeNode::List(_) | TreeNode::Map(_) => false,
        }
    }

    pub(crate) fn scalar_at(&self, offset: usize) -> Option<&Scalar> {
        self.scalar_from(offset).filter(|scalar| scalar.range.start == offset)
    }

    pub(crate) fn token_at(&self, offset: usize) -> Range<usize> {
        self.scalar_at(offset).map_or(offset..offset + 1, |scalar| scalar.range.clone())
    }
}

/// Reads a file of UTF-8 text with at most `most` bytes. `kind` is the expected kind of file, a
/// noun phrase for messages.
pub(crate) fn read_text(path: &Path, most: usize, kind: &str) -> Result<String, Diagnostic> {
    let name = &path.display().to_string();
    let unreadable = |error: &io::Error| Diagnostic::about(name, &unreadable(error));
    let metadata = fs::metadata(path).map_err(|error| unreadable(&error))?;
    if metadata.is_dir() {
        let diagnostic = Diagnostic::about(name, &format!("this is a folder, not a {kind}"));
        return Err(diagnostic.with_help("name a file in it"));
    }
    if is_named_pipe(path, &metadata) {
        let diagnostic = Diagnostic::about(name, &format!("this is a named pipe, not a {kind}"));
        return Err(
            diagnostic.with_help("a pipe of the shell is read as `/dev/stdin` or `<(COMMAND)`")
        );
    }
    if metadata.len() > most as u64 {
        return Err(too_large(name, Some(metadata.len()), most));
    }
    limited(name, File::open(path).map_err(|error| unreadable(&error))?, most)
}

/// Checks the maximum size while reading, because the file size may be unknown or grow.
fn limited(name: &str, reader: impl Read, most: usize) -> Result<String, Diagnostic> {
    let mut bytes = Vec::new();
    let read = reader.take(most as u64 + 1).read_to_end(&mut bytes);
    read.map_err(|error| Diagnostic::about(name, &unreadable(&error)))?;
    if bytes.len() > most {
        return Err(too_large(name, None, most));
    }
    String::from_utf8(bytes)
        .map_err(|error| not_utf8(name, error.as_bytes(), error.utf8_error().valid_up_to()))
}

/// Whether the file is a named pipe that may have no writer, so that reading would block. Pipes of
/// the shell have a writer, and the result is false.
fn is_named_pipe(path: &Path, metadata: &Metadata) -> bool {
    #[cfg(unix)]
    let is_pipe = std::os::unix::fs::FileTypeExt::is_fifo(&metadata.file_type());
    #[cfg(not(unix))]
    let is_pipe = false;
    is_pipe && !path.starts_with("/dev") && !path.starts_with("/proc")
}

fn unreadable(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "no permission to read this file".to_owned(),
        _ => format!("cannot read this file: {error}"),
    }
}

fn too_large(name: &str, bytes: Option<u64>, most: usize) -> Diagnostic {
    let limit = most / 1024;
    let message = match bytes {
        Some(bytes) => {
            format!("the file is too large: {} KiB, at most {limit} KiB", bytes.div_ceil(1024))
        }
        None => format!("the file is too large: at most {limit} KiB"),
    };
    Diagnostic::about(name, &message)
}

fn not_utf8(name: &str, bytes: &[u8], offset: usize) -> Diagnostic {
    let text = String::from_utf8_lossy(bytes);
    let end = offset + char::REPLACEMENT_CHARACTER.len_utf8();
    let message = format!("the file is not UTF-8 text: byte {offset} does not fit");
    let diagnostic = Diagnostic::at(name, &text, offset..end, &message);
    let utf16 = bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff");
    let was = if utf16 { " (it looks like UTF-16)" } else { "" };
    diagnostic.with_help(&format!("save the file as UTF-8{was}"))
}

fn characters(name: &str, text: &str) -> Result<(), Diagnostic> {
    let bad = text.char_indices().find(|(at, c)| match c {
        '\t' | '\n' => false,
        '\r' => !text[at + 1..].starts_with('\n'),
        '\u{ad}' | '\u{200b}' | '\u{2028}' | '\u{2029}' | '\u{2060}' | '\u{feff}' | '\u{fffe}'
        | '\u{ffff}' => true,
        // A space that YAML does not recognise joins a key to its value.
        '\u{a0}' | '\u{2007}' | '\u{202f}' | '\u{3000}' => {
            let before = text[..*at].rsplit('\n').next().unwrap_or_default();
            before.trim().is_empty() || before.ends_with([':', '-'])
        }
        c => c.is_control(),
    });
    let Some((at, c)) = bad else { return Ok(()) };
    let message = format!("character U+{:04X} is not allowed", u32::from(c));
    Err(Diagnostic::at(name, text, at..at + c.len_utf8(), &message)
        .with_label("an invisible character")
        .with_help(if c.is_whitespace() { "replace it by a space" } else { "delete it" }))
}

fn entries(folder: &Path) -> io::Result<Vec<PathBuf>> {
    std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect()
}
