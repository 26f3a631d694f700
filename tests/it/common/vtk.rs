//! Reads the files for ParaView that this crate writes.

/// Returns the numbers of the array called `name`.
pub(crate) fn numbers(file: &[u8], name: &str) -> Vec<f64> {
    let (xml, appended) = parts(file);
    let head = format!("<DataArray Name=\"{name}\" ");
    let line = xml.lines().find(|line| line.starts_with(&head));
    let line = line.unwrap_or_else(|| panic!("no {name} in {xml}"));
    let offset: usize = attribute(line, "offset").parse().expect("an offset");
    let appended = decode(&appended[offset..]);
    let bytes = |from: usize| appended[from..from + 8].try_into().expect("eight bytes");
    let length = u64::from_le_bytes(bytes(0)) as usize;
    (8..8 + length).step_by(8).map(|at| f64::from_le_bytes(bytes(at))).collect()
}

/// Decodes base64 up to the first padding or the end of the text.
fn decode(text: &[u8]) -> Vec<u8> {
    let digit = |c: &u8| match c {
        b'A'..=b'Z' => Some(c - b'A'),
        b'a'..=b'z' => Some(c - b'a' + 26),
        b'0'..=b'9' => Some(c - b'0' + 52),
        b'+' => Some(62),
        b'/' => Some(63),
        _ => None,
    };
    let digits: Vec<u32> = text.iter().map_while(digit).map(u32::from).collect();
    let group = |group: &[u32]| {
        let number = group.iter().enumerate().fold(0, |n, (k, digit)| n | digit << (18 - 6 * k));
        let [_, bytes @ ..] = u32::to_be_bytes(number);
        bytes.into_iter().take(group.len() - 1)
    };
    digits.chunks(4).flat_map(group).collect()
}

/// Returns the value of an attribute in the first line that has this attribute.
pub(crate) fn attribute<'a>(xml: &'a str, name: &str) -> &'a str {
    let (_, behind) = xml.split_once(&format!(" {name}=\"")).unwrap_or_else(|| panic!("{xml}"));
    behind.split('"').next().expect("a quote at its end")
}

/// Returns the text before the numbers, and the bytes after it.
pub(crate) fn parts(file: &[u8]) -> (&str, &[u8]) {
    let mark = b"<AppendedData encoding=\"base64\">\n_";
    let at = file.windows(mark.len()).position(|bytes| bytes == mark).expect("appended data");
    let xml = std::str::from_utf8(&file[..at]).expect("text");
    (xml, &file[at + mark.len()..])
}
