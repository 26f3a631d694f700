//! Checks the structure of XML.

/// Checks that tags are balanced and attributes quoted, and that markup appears nowhere else.
pub(super) fn well_formed(svg: &str) -> Result<(), String> {
    let mut open = Vec::new();
    let mut rest = svg;
    while let Some(start) = rest.find('<') {
        entities(&rest[..start])?;
        let end = rest[start..].find('>').ok_or("unclosed tag")? + start;
        let tag = &rest[start + 1..end];
        rest = &rest[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            if open.pop() != Some(name) {
                return Err(format!("</{name}> closes nothing"));
            }
            continue;
        }
        let body = tag.strip_suffix('/').unwrap_or(tag);
        let (name, attributes) = body.split_once(' ').unwrap_or((body, ""));
        let quoted: Vec<_> = attributes.split('"').collect();
        let names_only = quoted.iter().step_by(2).all(|gap| {
            let name = gap.trim();
            name.is_empty() || name.ends_with('=') && !name.contains(' ')
        });
        if !names_only || quoted.len() % 2 == 0 || tag.contains('<') {
            return Err(format!("<{tag}>"));
        }
        entities(attributes)?;
        if !tag.ends_with('/') {
            open.push(name);
        }
    }
    (open.is_empty() && rest.trim().is_empty())
        .then_some(())
        .ok_or_else(|| format!("{open:?} left open"))
}

fn entities(text: &str) -> Result<(), String> {
    let known = ["amp;", "lt;", "gt;", "quot;", "apos;"];
    text.split('&')
        .skip(1)
        .all(|after| known.iter().any(|entity| after.starts_with(entity)))
        .then_some(())
        .ok_or_else(|| text.to_owned())
}

/// Whether the values of attributes contain no invalid number, such as NaN.
pub(super) fn without_bad_numbers(svg: &str) -> bool {
    svg.split('"')
        .skip(1)
        .step_by(2)
        .all(|value| !["NaN", "inf", "-0.00"].iter().any(|bad| value.contains(bad)))
}
