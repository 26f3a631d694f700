//! The words of the command line, ready to be parsed.

use super::args::Cli;
use super::select;
use clap::{Command, CommandFactory};
use mpm_verify::nearest;
use std::ffi::OsString;

/// The words with `run` in front of those that name no command.
///
/// # Errors
/// If the first word is neither a command nor a suite, and a command is what it comes nearest to.
pub(super) fn with_command(words: Vec<OsString>) -> Result<Vec<OsString>, String> {
    let at = first(&words);
    let word = words.get(at).map(|word| word.to_string_lossy());
    let word = word.as_deref().unwrap_or_default();
    if ["help", "-h", "--help", "-V", "--version"].contains(&word) {
        return Ok(words);
    }
    let cli = Cli::command();
    let commands: Vec<&str> = cli.get_subcommands().map(Command::get_name).collect();
    if commands.contains(&word) {
        return Ok(words);
    }
    if !word.is_empty() && !word.starts_with('-') && !select::is_known(word) {
        let suites = select::suite_names();
        let known = suites.iter().map(String::as_str).chain(commands.iter().copied());
        let near = nearest(word, known).filter(|near| commands.contains(near));
        if let Some(command) = near.filter(|near| suites.iter().all(|suite| suite != near)) {
            let message = format!("there is no command or suite called `{word}`");
            return Err(format!("error: {message}\nhelp: did you mean the command `{command}`?"));
        }
    }
    let mut words = words;
    words.insert(at, "run".into());
    Ok(words)
}

/// Place of the first word behind the program's name and the options that any command has.
fn first(words: &[OsString]) -> usize {
    let mut at = words.len().min(1);
    while let Some(word) = words.get(at).and_then(|word| word.to_str()) {
        match word {
            "--color" => at += 2,
            _ if word.starts_with("--color=") => at += 1,
            _ => break,
        }
    }
    at.min(words.len())
}
