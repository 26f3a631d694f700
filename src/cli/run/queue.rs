//! Runs jobs on several threads, and passes their messages and results on in the order of the jobs.

use std::collections::BTreeMap;
use std::sync::mpsc::{self, Sender};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

pub(super) enum JobOutput<T> {
    Message(String),
    Result(T),
}

pub(super) struct Job<'a, T> {
    pub(super) number: usize,
    send: Sender<(usize, JobOutput<T>)>,
    queue: &'a Queue,
    blocks_next: bool,
}

/// The jobs that have not started, and the number of those that run.
#[derive(Default)]
struct Queue {
    state: Mutex<QueueState>,
    changed: Condvar,
}

#[derive(Default)]
struct QueueState {
    next: usize,
    running: usize,
    /// Whether the last started job blocks the start of the next one.
    is_blocked: bool,
}

impl QueueState {
    /// Whether a waiting thread may continue: the next of `count` jobs may start, or none is left.
    fn may_start(&self, count: usize, waits: impl Fn(usize) -> bool) -> bool {
        let is_early = self.running > 0 && self.next < count && waits(self.next);
        !self.is_blocked && !is_early
    }
}

impl Queue {
    fn state(&self) -> MutexGuard<'_, QueueState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait_while(&self, condition: impl Fn(&QueueState) -> bool) -> MutexGuard<'_, QueueState> {
        let guard = self.changed.wait_while(self.state(), |state| condition(state));
        guard.unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until the next of `count` jobs may start, and returns its number.
    fn start(&self, count: usize, waits: impl Fn(usize) -> bool) -> Option<usize> {
        let mut state = self.wait_while(|state| !state.may_start(count, &waits));
        let number = state.next;
        if number >= count {
            return None;
        }
        *state = QueueState { next: number + 1, running: state.running + 1, is_blocked: true };
        Some(number)
    }
}

impl<T> Job<'_, T> {
    /// Lets the next job start, which happens at the end of this job otherwise. A job that calls
    /// this when it begins its parallel work is served before later jobs.
    pub(super) fn let_next_start(&mut self) {
        if std::mem::take(&mut self.blocks_next) {
            self.queue.state().is_blocked = false;
            self.queue.changed.notify_all();
        }
    }

    pub(super) fn say(&self, text: String) {
        // If the receiver is gone, the calling thread has panicked.
        let _ = self.send.send((self.number, JobOutput::Message(text)));
    }
}

impl<T> Drop for Job<'_, T> {
    fn drop(&mut self) {
        self.let_next_start();
        self.queue.state().running -= 1;
        self.queue.changed.notify_all();
    }
}

/// Runs `count` jobs on `threads` threads. A job for which `waits` is true starts only after all
/// earlier jobs have ended. `take` is called on the calling thread with the messages and then the
/// result of each job, in their order; messages of the first unfinished job arrive immediately.
pub(super) fn in_order<T: Send>(
    count: usize,
    threads: usize,
    waits: impl Fn(usize) -> bool + Sync,
    run: impl Fn(&mut Job<'_, T>) -> T + Sync,
    mut take: impl FnMut(JobOutput<T>),
) {
    let queue = Queue::default();
    let (send, received) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..threads.min(count) {
            let send = send.clone();
            let (queue, waits, run) = (&queue, &waits, &run);
            scope.spawn(move || {
                while let Some(number) = queue.start(count, waits) {
                    let mut job = Job { number, send: send.clone(), queue, blocks_next: true };
                    let result = run(&mut job);
                    let _ = send.send((number, JobOutput::Result(result)));
                }
            });
        }
        drop(send);
        let (mut current, mut later) = (0, BTreeMap::<usize, Vec<JobOutput<T>>>::new());
        for (job, output) in received {
            later.entry(job).or_default().push(output);
            while let Some(all) = later.remove(&current) {
                let is_finished = matches!(all.last(), Some(JobOutput::Result(_)));
                all.into_iter().for_each(&mut take);
                if !is_finished {
                    break;
                }
                current += 1;
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;
    use std::sync::Barrier;

    fn outputs(count: usize, threads: usize, run: impl Fn(usize) + Sync) -> String {
        let mut text = String::new();
        let run = |job: &mut Job<'_, String>| {
            let number = job.number;
            job.say(format!("m{number} "));
            job.let_next_start();
            run(number);
            job.say(format!("n{number} "));
            format!("r{number} ")
        };
        let take = |output| match output {
            JobOutput::Message(output) | JobOutput::Result(output) => text += &output,
        };
        in_order(count, threads, |_| false, run, take);
        text
    }

    #[rstest]
    fn messages_and_results_are_in_order(#[values(1, 2, 7)] threads: usize) {
        assert_eq!(outputs(3, threads, |_| ()), "m0 n0 r0 m1 n1 r1 m2 n2 r2 ");
        assert_eq!(outputs(0, threads, |_| ()), "");
    }

    /// Job 0 ends after job 1, because it waits for job 2.
    #[test]
    fn a_job_that_ends_early_waits_for_its_turn() {
        let barrier = Barrier::new(2);
        let run = |number| {
            if number != 1 {
                barrier.wait();
            }
        };
        assert_eq!(outputs(3, 2, run), "m0 n0 r0 m1 n1 r1 m2 n2 r2 ");
    }

    #[test]
    fn a_message_of_the_first_job_arrives_before_the_job_ends() {
        let barrier = Barrier::new(2);
        let run = |job: &mut Job<'_, ()>| {
            job.say(String::new());
            barrier.wait();
        };
        let take = |output| {
            if let JobOutput::Message(_) = output {
                barrier.wait();
            }
        };
        in_order(1, 1, |_| false, run, take);
    }

    /// Job 2 of 4 waits for all earlier jobs.
    #[test]
    fn job_starts_when_the_earlier_jobs_allow() {
        let queue = Queue::default();
        let waits = |number| number == 2;
        let (send, _received) = mpsc::channel::<(usize, JobOutput<()>)>();
        let start = || {
            let number = queue.start(4, waits)?;
            Some(Job { number, send: send.clone(), queue: &queue, blocks_next: true })
        };
        let may_start = || queue.state().may_start(4, waits);
        let number = |job: &Option<Job<'_, ()>>| job.as_ref().map(|job| job.number);
        let mut jobs: Vec<_> = vec![start()];
        assert!(!may_start(), "job 0 does not allow it");
        jobs[0].as_mut().expect("job 0").let_next_start();
        assert!(may_start());
        jobs.push(start());
        jobs[1] = None;
        assert!(!may_start(), "job 0 runs");
        jobs[0] = None;
        assert!(may_start());
        jobs.push(start());
        jobs[2] = None;
        jobs.push(start());
        assert_eq!(jobs.iter().map(number).collect::<Vec<_>>(), [None, None, None, Some(3)]);
        assert!(!may_start(), "a thread that waits must not end before job 3 allows it");
        jobs[3] = None;
        assert!(start().is_none());
    }
}
