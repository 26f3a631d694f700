//! Messages from a process, as they come.

use super::answer::{Answer, announced};
use super::frame::MessageFrame;
use std::io::{self, BufRead, BufReader};
use std::process::ChildStdout;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::SyncSender;

/// Reads messages until the output ends, or one breaks the protocol. `longest` is the most bytes
/// that one may have.
pub(super) fn read_all(
    output: ChildStdout,
    longest: &AtomicUsize,
    to: &SyncSender<Result<MessageFrame, String>>,
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

/// Reads answers from `bytes` as from a process, with all their columns, up to the first that
/// breaks the protocol; returns how many are sound. For the fuzzer.
pub(super) fn read_answers(mut bytes: &[u8]) -> usize {
    let longest = AtomicUsize::new(bytes.len());
    let mut count = 0;
    while let Ok(Some(frame)) = read_one(&mut bytes, &longest) {
        let Ok(answer) = Answer::read(&frame) else { break };
        if answer.columns().into_iter().any(|(name, column)| {
            let entries = column.count();
            column.numbers(&name, entries, &frame.bytes).is_err()
        }) {
            break;
        }
        count += 1;
    }
    count
}

/// The next message; `None` at the end of the output.
fn read_one(
    output: &mut impl BufRead,
    longest: &AtomicUsize,
) -> Result<Option<MessageFrame>, String> {
    let unreadable = |error: io::Error| format!("cannot be read: {error}");
    // It is asked anew while a line grows: the first answer comes before the problem is known.
    let too_long = |size: usize| {
        let most = longest.load(Ordering::Relaxed);
        (size > most).then(|| format!("answered with more than {most} bytes"))
    };
    let mut frame = MessageFrame::default();
    loop {
        let part = output.fill_buf().map_err(unreadable)?;
        let (used, done) = match part.iter().position(|byte| *byte == b'\n') {
            Some(end) => (end + 1, true),
            None => (part.len(), part.is_empty()),
        };
        frame.line.extend_from_slice(&part[..used]);
        output.consume(used);
        if let Some(reason) = too_long(frame.line.len()) {
            return Err(reason);
        }
        if done {
            break;
        }
    }
    if frame.line.is_empty() {
        return Ok(None);
    }
    if frame.line.pop_if(|last| *last == b'\n').is_none() {
        return Err("ended in the middle of an answer".to_owned());
    }
    let following = announced(&frame.line);
    if let Some(reason) = too_long(following) {
        return Err(reason);
    }
    frame.bytes = vec![0; following];
    match output.read_exact(&mut frame.bytes) {
        Ok(()) => Ok(Some(frame)),
        Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
            Err("ended in the middle of a block of bytes".to_owned())
        }
        Err(error) => Err(unreadable(error)),
    }
}
