//! Rewrites messages of serde and of the parser in plain English.

/// Converts serde's description of an expected value to plain text without Rust type names.
pub(crate) fn expected(serde: &str) -> String {
    let words = match serde {
        "f64" | "f32" => "a number",
        "usize" | "u64" | "u128" => "a whole number, zero or more",
        "u32" => "a whole number from 0 to 4294967295",
        "u16" => "a whole number from 0 to 65535",
        "u8" => "a whole number from 0 to 255",
        "isize" | "i128" | "i64" | "i32" | "i16" | "i8" => "a whole number",
        "a boolean" => "`true` or `false`",
        "a sequence" => "a list",
        "a map" | "struct variant" => "a map (`key: value`)",
        "unit" | "null" => "nothing",
        _ => return expected_of(serde),
    };
    words.to_owned()
}

/// Converts a description that contains a type name or a count to plain text.
fn expected_of(serde: &str) -> String {
    let count = serde.split(' ').find_map(|word| word.parse::<usize>().ok());
    match (serde, count) {
        _ if serde.starts_with("enum ") => "a name, or a name with its settings".to_owned(),
        (_, Some(1)) if is_list(serde) => "a list of 1 value".to_owned(),
        (_, Some(count)) if is_list(serde) => format!("a list of {count} values"),
        _ if serde.starts_with("struct ") => "a map (`key: value`)".to_owned(),
        _ if serde.starts_with("tuple ") => "a list".to_owned(),
        _ if serde.ends_with(" identifier") => "a name".to_owned(),
        _ => serde.to_owned(),
    }
}

fn is_list(serde: &str) -> bool {
    ["an array", "a tuple", "tuple", "sequence", "struct"]
        .iter()
        .any(|list| serde.starts_with(list))
}

/// Converts serde's description of the value in the file to plain text.
pub(crate) fn found(serde: &str) -> String {
    match serde {
        "sequence" => return "a list".to_owned(),
        "map" => return "a map (`key: value`)".to_owned(),
        "unit value" | "Option value" => return "nothing".to_owned(),
        _ => {}
    }
    let number = serde.strip_prefix("integer ").or_else(|| serde.strip_prefix("floating point "));
    if let Some(number) = number {
        return format!("the number {}", number.trim_matches('`'));
    }
    serde.strip_prefix("boolean ").map_or_else(
        || {
            serde
                .strip_prefix("string ")
                .map_or_else(|| serde.to_owned(), |text| format!("the string {text}"))
        },
        ToOwned::to_owned,
    )
}

pub(crate) fn listed(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    quoted.join(", ")
}

/// Returns message and help for an error of the YAML parser about invalid text.
pub(crate) fn syntax(error: &str) -> Option<(&'static str, &'static str)> {
    const TABLE: [(&str, &str, &str); 13] = [
        (
            "expected ',' or ']'",
            "expected `,` or `]` here",
            "entries of a list are separated by `,`",
        ),
        ("expected ',' or '}'", "expected `,` or `}` here", "keys of a map are separated by `,`"),
        (
            "did not find expected key",
            "expected a key here",
            "check the indentation, and quotes around text that holds `:`, `#` or quotes",
        ),
        (
            "did not find expected '-' indicator",
            "expected `- ` here, as in the entries above",
            "check the indentation",
        ),
        (
            "mapping values are not allowed",
            "`:` is not possible here",
            "check the indentation; put text that holds `: ` in quotes",
        ),
        ("invalid trailing content", "text after a closing quote", "put the whole value in quotes"),
        (
            "must be followed by a valid YAML whitespace",
            "expected a blank before this",
            "write `key: value`",
        ),
        (
            "block sequence entries are not allowed",
            "`- ` is not possible here",
            "start the list on a line of its own",
        ),
        ("mapping keys are not allowed", "a key is not possible here", "check the indentation"),
        ("simple key expect", "expected `:` after the key", "write `key: value`"),
        (
            "unexpected character",
            "a value cannot start with this character",
            "put the value in quotes",
        ),
        (
            "found unknown escape character",
            "unknown escape in double quotes",
            "use single quotes to keep `\\` as it is",
        ),
        (
            "invalid indentation",
            "text in brackets or quotes needs more indentation than its key",
            "indent the following lines",
        ),
    ];
    let (_, message, help) = TABLE.iter().find(|(problem, ..)| error.contains(problem))?;
    Some((message, help))
}
