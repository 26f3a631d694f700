//! Validates values against the part of JSON Schema that the schemas of this crate use. A complete
//! validator would require forty packages, and features that a build without tests does not have.

use serde_json::{Map, Value};

/// Keywords that impose no constraint.
const NOTES: [&str; 7] =
    ["$schema", "title", "description", "default", "definitions", "$defs", "format"];

/// A schema that values are validated against.
pub(crate) struct JsonSchema(Value);

impl JsonSchema {
    pub(crate) fn new(text: &str) -> Self {
        Self(serde_json::from_str(text).expect("JSON"))
    }

    /// Returns position and reason of the first violation.
    pub(crate) fn refusal(&self, value: &Value) -> Option<String> {
        self.check(&self.0, value).err()
    }

    fn check(&self, schema: &Value, value: &Value) -> Result<(), String> {
        let Value::Object(keywords) = schema else {
            return if schema == true { Ok(()) } else { Err(": nothing may stand there".into()) };
        };
        keywords.iter().try_for_each(|(keyword, by)| self.keyword(keywords, keyword, by, value))
    }

    fn keyword(
        &self,
        all: &Map<String, Value>,
        keyword: &str,
        by: &Value,
        value: &Value,
    ) -> Result<(), String> {
        let fits = |schema: &&Value| self.check(schema, value).is_ok();
        let list = || by.as_array().expect("a list");
        let holds = match keyword {
            "$ref" => {
                let pointer = by.as_str().and_then(|to| to.strip_prefix('#')).expect("a pointer");
                return self.check(self.0.pointer(pointer).expect(pointer), value);
            }
            "allOf" => return list().iter().try_for_each(|one| self.check(one, value)),
            "if" => {
                let branch = if fits(&by) { "then" } else { "else" };
                return all.get(branch).map_or(Ok(()), |schema| self.check(schema, value));
            }
            "properties" => {
                let given = |(key, schema)| Some((key, schema, value.get(key)?));
                let mut given = by.as_object().expect("a map").iter().filter_map(given);
                return given.try_for_each(|(key, schema, value)| self.inside(key, schema, value));
            }
            "additionalProperties" => {
                let named =
                    |key: &str| all.get("properties").is_some_and(|of| of.get(key).is_some());
                let mut others = value.as_object().into_iter().flatten();
                return others.try_for_each(|(key, value)| {
                    if named(key) { Ok(()) } else { self.inside(key, by, value) }
                });
            }
            "items" => {
                let mut items = value.as_array().into_iter().flatten().enumerate();
                return items.try_for_each(|(i, value)| self.inside(&i.to_string(), by, value));
            }
            "anyOf" => list().iter().any(|one| fits(&one)),
            "oneOf" => list().iter().filter(fits).count() == 1,
            "not" => !fits(&by),
            "type" => match by {
                Value::Array(types) => types.iter().any(|name| is(name, value)),
                name => is(name, value),
            },
            "enum" => list().contains(value),
            "const" => by == value,
            "required" => {
                let lacks = |key: &&Value| value.get(key.as_str().expect("a key")).is_none();
                match list().iter().find(lacks) {
                    Some(key) if value.is_object() => return Err(format!(": {key} is missing")),
                    _ => true,
                }
            }
            "minItems" => value.as_array().is_none_or(|list| list.len() as u64 >= whole(by)),
            "maxItems" => value.as_array().is_none_or(|list| list.len() as u64 <= whole(by)),
            "minimum" => value.as_f64().is_none_or(|value| Some(value) >= by.as_f64()),
            "maximum" => value.as_f64().is_none_or(|value| Some(value) <= by.as_f64()),
            "then" | "else" => true,
            note if NOTES.contains(&note) => true,
            other => panic!("the schema has a keyword that is not known here: `{other}`"),
        };
        if holds { Ok(()) } else { Err(format!(": {value} against `{keyword}: {by}`")) }
    }

    fn inside(&self, key: &str, schema: &Value, value: &Value) -> Result<(), String> {
        self.check(schema, value).map_err(|reason| format!("/{key}{reason}"))
    }
}

fn whole(value: &Value) -> u64 {
    value.as_u64().expect("a count")
}

fn is(name: &Value, value: &Value) -> bool {
    match name.as_str().expect("the name of a type") {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "integer" => value.as_f64().is_some_and(|value| value.fract() == 0.0),
        "number" => value.is_number(),
        "string" => value.is_string(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        other => panic!("there is no type `{other}`"),
    }
}
