//! Messages as they cross the pipe.

use serde_json::{Map, Value, json};

/// One message that was read: its line, without the newline, and the block of bytes after it.
#[derive(Debug, Default)]
pub(super) struct MessageFrame {
    pub(super) line: Vec<u8>,
    pub(super) bytes: Vec<u8>,
}

/// A message on its way out.
pub(super) struct Outgoing {
    message: Map<String, Value>,
    bytes: Vec<u8>,
    /// Whether columns may be bytes.
    binary: bool,
}

impl Outgoing {
    /// A message of the type `kind` with the keys of the object `content`.
    pub(super) fn new(kind: &str, content: Value, binary: bool) -> Self {
        let mut message = match content {
            Value::Object(message) => message,
            _ => Map::new(),
        };
        message.insert("type".to_owned(), json!(kind));
        Self { message, bytes: Vec::new(), binary }
    }

    pub(super) fn set(&mut self, key: &str, value: Value) {
        self.message.insert(key.to_owned(), value);
    }

    /// Adds a column to the object under `key`.
    pub(super) fn column(&mut self, key: &str, name: &str, numbers: &[f64]) {
        let column = self.numbers(numbers);
        let object = self.message.entry(key).or_insert_with(|| json!({}));
        if let Value::Object(object) = object {
            object.insert(name.to_owned(), column);
        }
    }

    /// Sets a column of its own.
    pub(super) fn set_numbers(&mut self, key: &str, numbers: &[f64]) {
        let column = self.numbers(numbers);
        self.set(key, column);
    }

    fn numbers(&mut self, numbers: &[f64]) -> Value {
        if !self.binary {
            return json!(numbers);
        }
        let offset = self.bytes.len();
        self.bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
        json!({"f64": [offset, numbers.len()]})
    }

    /// The message as it is written.
    pub(super) fn into_bytes(mut self) -> Vec<u8> {
        if !self.bytes.is_empty() {
            self.message.insert("bytes".to_owned(), json!(self.bytes.len()));
        }
        let mut all = Value::Object(self.message).to_string().into_bytes();
        all.push(b'\n');
        all.append(&mut self.bytes);
        all
    }
}
