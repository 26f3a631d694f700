//! The process of a solver, with limits on its time and memory.
//!
//! Two threads read the output of the process, and another one writes its input, so that a process
//! that neither reads nor writes does not block the caller. Each thread ends when its pipe closes,
//! at the latest when the process is killed.

use super::answer::Answer;
use super::error::{ProgramError, printable};
use super::frame::{MessageFrame, Outgoing, read_all};
use std::io::{Read, Write};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Maximum length (bytes) of an answer that arrives before a problem has been sent.
const SHORT: usize = 1 << 20;

const LAST_BYTES: usize = 2000;

/// Maximum number of lines of standard error in an error message.
const LAST_LINES: usize = 3;

/// Maximum time for a process to exit by itself, unless the response timeout is shorter.
const GRACE: Duration = Duration::from_secs(1);

/// Polling interval for a process that does not respond.
const GLANCE: Duration = Duration::from_millis(50);

/// Limits on each process of a solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProgramLimits {
    /// Response timeout.
    pub silence: Duration,
    /// Maximum address space (bytes), on Unix; `None` for the limit of the operating system.
    pub memory: Option<u64>,
}

impl Default for ProgramLimits {
    fn default() -> Self {
        Self { silence: Duration::from_secs(60), memory: None }
    }
}

/// A process with its pipes. Dropping the connection kills the process and its group.
pub(super) struct Connection {
    child: Child,
    requests: Option<Sender<Vec<u8>>>,
    answers: Receiver<Result<MessageFrame, ProgramError>>,
    longest: Arc<AtomicUsize>,
    last_bytes: Arc<Mutex<Vec<u8>>>,
    listener: JoinHandle<()>,
    silence: Duration,
}

impl Connection {
    pub(super) fn start(command: &[String], limits: ProgramLimits) -> Result<Self, ProgramError> {
        let mut process = limited(command, limits.memory)?;
        process.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut process, 0);
        let name = &command[0];
        let mut child = process
            .spawn()
            .map_err(|error| ProgramError::Start { program: printable(name), error })?;
        let mut input = child.stdin.take().ok_or(ProgramError::Pipe)?;
        let output = child.stdout.take().ok_or(ProgramError::Pipe)?;
        let mut errors = child.stderr.take().ok_or(ProgramError::Pipe)?;
        let (requests, to_write) = channel::<Vec<u8>>();
        thread::spawn(move || {
            // A process that has stopped reading will not answer, which is reported.
            while let Ok(message) = to_write.recv() {
                if input.write_all(&message).and_then(|()| input.flush()).is_err() {
                    break;
                }
            }
        });
        let longest = Arc::new(AtomicUsize::new(SHORT));
        // The channel is bounded, so a process with unlimited output blocks on its own pipe.
        let (found, answers) = sync_channel(1);
        let most = Arc::clone(&longest);
        thread::spawn(move || read_all(output, &most, &found));
        let last_bytes = Arc::new(Mutex::new(Vec::new()));
        let kept = Arc::clone(&last_bytes);
        let listener = thread::spawn(move || {
            let mut part = [0; 1024];
            while let Ok(read @ 1..) = errors.read(&mut part) {
                let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
                kept.extend_from_slice(&part[..read]);
                let surplus = kept.len().saturating_sub(LAST_BYTES);
                kept.drain(..surplus);
            }
        });
        let silence = limits.silence;
        let requests = Some(requests);
        Ok(Self { child, requests, answers, longest, last_bytes, listener, silence })
    }

    /// Sets the maximum length of later answers (bytes).
    pub(super) fn expect_up_to(&mut self, bytes: usize) {
        self.longest.store(SHORT.max(bytes), Ordering::Relaxed);
    }

    /// Sends a message. If the process does not read the message, the response timeout applies.
    pub(super) fn send(&mut self, message: Outgoing) {
        if let Some(requests) = &self.requests {
            let _ = requests.send(message.into_bytes());
        }
    }

    /// Waits for the next answer and its block of bytes. A failure kills the process.
    pub(super) fn answer(&mut self) -> Result<(Answer, Vec<u8>), ProgramError> {
        let found = match self.heard() {
            Ok(Ok(frame)) => Answer::read(&frame).map(|answer| (answer, frame.bytes)),
            Ok(Err(error)) => Err(error),
            Err(RecvTimeoutError::Timeout) => Err(ProgramError::Silent(self.silence.as_secs_f64())),
            Err(RecvTimeoutError::Disconnected) => Err(self.ended()),
        };
        found.map_err(|error| {
            self.kill();
            self.with_standard_error(error)
        })
    }

    /// Returns the next message, if it arrives in time. A child of the process may keep the pipe
    /// open, so this function also polls whether the process has ended.
    fn heard(&mut self) -> Result<Result<MessageFrame, ProgramError>, RecvTimeoutError> {
        let start = Instant::now();
        loop {
            let left = self.silence.saturating_sub(start.elapsed());
            match self.answers.recv_timeout(left.min(GLANCE)) {
                Err(RecvTimeoutError::Timeout) if left > GLANCE => {}
                found => return found,
            }
            if matches!(self.child.try_wait(), Ok(Some(_))) {
                let last = self.answers.recv_timeout(GLANCE);
                return last.map_err(|_| RecvTimeoutError::Disconnected);
            }
        }
    }

    fn ended(&mut self) -> ProgramError {
        match self.status() {
            Some(status) => ProgramError::Ended(shown(status)),
            None => ProgramError::ClosedOutput,
        }
    }

    fn with_standard_error(&self, error: ProgramError) -> ProgramError {
        // The process has ended, but the last part of its output may not have arrived.
        patiently(GRACE, || self.listener.is_finished().then_some(()));
        let kept = self.last_bytes.lock().unwrap_or_else(PoisonError::into_inner);
        let text = String::from_utf8_lossy(&kept);
        // The last lines of a Python traceback are the position, the source line and the error.
        let lines = text.lines().map(str::trim).filter(|line| line.contains(char::is_alphanumeric));
        let mut last: Vec<String> = lines.rev().take(LAST_LINES).map(printable).collect();
        last.reverse();
        if last.is_empty() {
            error
        } else {
            ProgramError::WithStandardError { error: error.into(), lines: last.join(" | ") }
        }
    }

    fn status(&mut self) -> Option<ExitStatus> {
        patiently(GRACE.min(self.silence), || self.child.try_wait().ok().flatten())
    }

    pub(super) fn end(mut self) {
        self.send(Outgoing::new("bye", serde_json::Value::Null, false));
        self.requests = None;
        self.status();
    }

    fn kill(&mut self) {
        #[cfg(unix)]
        let _ = rustix::process::kill_process_group(
            rustix::process::Pid::from_child(&self.child),
            rustix::process::Signal::KILL,
        );
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Drop for Connection {
    fn drop(&mut self) {
        self.kill();
    }
}

/// Calls `look` until `look` returns a result or the time `most` has passed.
fn patiently<T>(most: Duration, mut look: impl FnMut() -> Option<T>) -> Option<T> {
    let start = Instant::now();
    loop {
        let found = look();
        if found.is_some() || start.elapsed() >= most {
            return found;
        }
        thread::sleep(Duration::from_millis(2));
    }
}

/// Creates the command. `memory` limits the address space (bytes), also of child processes.
fn limited(command: &[String], memory: Option<u64>) -> Result<Command, ProgramError> {
    let Some(memory) = memory else {
        let mut process = Command::new(&command[0]);
        process.args(&command[1..]);
        return Ok(process);
    };
    if cfg!(not(unix)) {
        return Err(ProgramError::MemoryLimit);
    }
    let mut process = Command::new("sh");
    process.args(["-c", "ulimit -v \"$0\" && exec \"$@\"", &(memory / 1024).to_string()]);
    process.args(command);
    Ok(process)
}

fn shown(status: ExitStatus) -> String {
    #[cfg(unix)]
    if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
        return format!("killed by signal {signal}");
    }
    status.code().map_or("no status".to_owned(), |code| format!("exit status {code}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    /// Starts a script in a shell with this response timeout (s).
    fn shell(script: &str, silence: f64) -> Connection {
        let command = ["sh", "-c", script].map(str::to_owned);
        let silence = Duration::from_secs_f64(silence);
        let limits = ProgramLimits { silence, ..ProgramLimits::default() };
        Connection::start(&command, limits).expect("a shell")
    }

    /// The documentation of `--solver-timeout` states the same default.
    #[test]
    fn default_response_timeout_is_a_minute() {
        assert_eq!(ProgramLimits::default().silence, Duration::from_secs(60));
    }

    /// The message is longer than the pipe, so that its writer blocks.
    #[rstest]
    #[case::silence("exec sleep 99", 0.05, 0, "did not answer within 0.05 s")]
    #[case::nothing_read("exec sleep 99", 0.05, 1_000_000, "did not answer within 0.05 s")]
    #[case::long_standard_error(
        "yes progress | head -n 300 >&2; echo broken >&2; exit 3",
        60.0,
        0,
        "ended without an answer (exit status 3); its last output on standard error: progress | \
         progress | broken"
    )]
    #[case::a_closed_pipe("exec >&-; exec sleep 99", 60.0, 0, "closed its output but did not end")]
    fn process_without_an_answer_fails(
        #[case] script: &str,
        #[case] silence: f64,
        #[case] length: usize,
        #[case] message: &str,
    ) {
        let mut connection = shell(script, silence);
        connection.send(Outgoing::new(
            "problem",
            serde_json::json!({"x": "x".repeat(length)}),
            false,
        ));
        assert_eq!(connection.answer().expect_err("no answer").to_string(), message);
    }
}
