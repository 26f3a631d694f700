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
