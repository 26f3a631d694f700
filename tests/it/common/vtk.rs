//! Reads the files for ParaView that this crate writes.

/// Returns the numbers of the array called `name`.
pub(crate) fn numbers(file: &[u8], name: &str) -> Vec<f64> {
    let (xml, appended) = parts(file);
    let head = format!("<DataArray Name=\"{name}\" type=\"Float64\" ");
    let line = xml.lines().find(|line| line.starts_with(&head));
    let line = line.unwrap_or_else(|| panic!("no {name} in {xml}"));
    let offset: usize = attribute(line, "offset").parse().expect("an offset");
    let bytes = |from: usize| appended[from..from + 8].try_into().expect("eight bytes");
    let length = u64::from_le_bytes(bytes(offset)) as usize;
    let from = offset + 8;
    (from..from + length).step_by(8).map(|at| f64::from_le_bytes(bytes(at))).collect()
}

/// Returns the value of an attribute in the first line that has this attribute.
pub(crate) fn attribute<'a>(xml: &'a str, name: &str) -> &'a str {
    let (_, behind) = xml.split_once(&format!(" {name}=\"")).unwrap_or_else(|| panic!("{xml}"));
    behind.split('"').next().expect("a quote at its end")
}

/// Returns the text before the numbers, and the bytes after it.
pub(crate) fn parts(file: &[u8]) -> (&str, &[u8]) {
    let mark = b"<AppendedData encoding=\"raw\">\n_";
    let at = file.windows(mark.len()).position(|bytes| bytes == mark).expect("appended data");
    let xml = std::str::from_utf8(&file[..at]).expect("text");
    (xml, &file[at + mark.len()..])
}
