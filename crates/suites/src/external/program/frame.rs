//! Writes and reads messages of the protocol.

use super::error::ProgramError;
use serde::Deserialize;
use serde_json::{Map, Value, json};
use std::io::{self, BufRead, BufReader};
use std::process::ChildStdout;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::SyncSender;

/// A received message: a line without its newline, and the block of bytes that follows it.
#[derive(Debug, Default)]
pub(super) struct MessageFrame {
    pub(super) line: Vec<u8>,
    pub(super) bytes: Vec<u8>,
}

pub(super) struct Outgoing {
    message: Map<String, Value>,
    bytes: Vec<u8>,
    /// Whether columns may be sent as bytes.
    binary: bool,
}

impl Outgoing {
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

    pub(super) fn column(&mut self, key: &str, name: &str, numbers: &[f64]) {
        let column = self.numbers(numbers);
        let object = self.message.entry(key).or_insert_with(|| json!({}));
        if let Value::Object(object) = object {
            object.insert(name.to_owned(), column);
        }
    }

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

#[derive(Deserialize)]
struct Announced {
    #[serde(default)]
    bytes: usize,
}

/// Returns the announced number of bytes after the line; zero for an invalid message, which the
/// parser reports later.
fn announced(line: &[u8]) -> usize {
    // A line without the key "bytes" need not be parsed here.
    if !line.windows(7).any(|word| word == b"\"bytes\"") {
        return 0;
    }
    serde_json::from_slice::<Announced>(line).map_or(0, |announced| announced.bytes)
}

/// Reads messages of at most `longest` bytes until the output ends or a message is invalid.
pub(super) fn read_all(
    output: ChildStdout,
    longest: &AtomicUsize,
    to: &SyncSender<Result<MessageFrame, ProgramError>>,
) {
    let mut output = BufReader::new(output);
    loop {
        let frame = match read_one(&mut output, longest) {
            Ok(Some(frame)) => Ok(frame),
            Ok(None) => return,
            Err(reason) => Err(reason),
        };
        let broken = frame.is_err();
        if to.send(frame).is_err() || broken {
            return;
        }
    }
}

pub(super) fn read_one(
    output: &mut impl BufRead,
    longest: &AtomicUsize,
) -> Result<Option<MessageFrame>, ProgramError> {
    // The limit is loaded for each check, because it can change while a line is read.
    let check_size = |size: usize| {
        let most = longest.load(Ordering::Relaxed);
        let too_long = || ProgramError::Protocol(format!("answered with more than {most} bytes"));
        if size > most { Err(too_long()) } else { Ok(()) }
    };
    let truncated = |part| ProgramError::Protocol(format!("ended in the middle of {part}"));
    let mut frame = MessageFrame::default();
    loop {
        let part = output.fill_buf().map_err(ProgramError::Unreadable)?;
        let (used, done) = match part.iter().position(|byte| *byte == b'\n') {
            Some(end) => (end + 1, true),
            None => (part.len(), part.is_empty()),
        };
        frame.line.extend_from_slice(&part[..used]);
        output.consume(used);
        check_size(frame.line.len())?;
        if done {
            break;
        }
    }
    if frame.line.is_empty() {
        return Ok(None);
    }
    if frame.line.pop_if(|last| *last == b'\n').is_none() {
        return Err(truncated("an answer"));
    }
    let following = announced(&frame.line);
    check_size(following)?;
    frame.bytes = vec![0; following];
    match output.read_exact(&mut frame.bytes) {
        Ok(()) => Ok(Some(frame)),
        Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
            Err(truncated("a block of bytes"))
        }
        Err(error) => Err(ProgramError::Unreadable(error)),
    }
}
