//! Runs the commands of the tour block by block, in order and in one folder. Each block must print
//! the text of the next block.

use super::markdown::Document;
use crate::common::folder::Folder;
use std::path::Path;
use std::process::{Command, Output};

/// Runs a block of commands in a shell that finds the program.
fn run(commands: &str, folder: &Folder) -> Output {
    let program = Path::new(env!("CARGO_BIN_EXE_mpm-verify"));
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let known = program.parent().map(Path::to_owned).into_iter();
    let known = known.chain(std::env::split_paths(&folders));
    let path = std::env::join_paths(known).expect("a path");
    Command::new("sh")
        .args(["-e", "-c", commands])
        .env("PATH", path)
        .current_dir(folder.path())
        .stdin(std::process::Stdio::null())
        .output()
        .expect("a shell")
}

#[test]
fn tour_shows_the_output_of_its_commands() {
    let page = include_str!("../../../docs/tour.md");
    let (folder, mut said) = (Folder::new(), String::new());
    let mut shown = 0;
    for block in Document::new("docs/tour.md", page).blocks {
        match &*block.language {
            "console" => {
                let output = run(&block.text, &folder);
                said =
                    [output.stdout, output.stderr].map(|b| String::from_utf8(b).unwrap()).concat();
                assert!(output.status.success(), "docs/tour.md:{}\n{said}", block.line);
            }
            "text" => {
                for line in block.text.lines() {
                    assert!(said.contains(line), "docs/tour.md:{}: `{line}`\n{said}", block.line);
                    shown += 1;
                }
            }
            _ => {}
        }
    }
    assert!(shown > 10, "the tour shows {shown} lines of answers: are they still found?");
}
