//! `mpm-verify completions` and `mpm-verify man`: for shells and for `man`, from the words of the
//! command line.

use super::args::{Cli, CompletionsArgs, ManArgs};
use super::output;
use super::status::{BAD_INPUT, PASSED};
use clap::{Command, CommandFactory};
use clap_mangen::Man;

/// Prints what a shell completes.
pub(super) fn completions(args: &CompletionsArgs) -> u8 {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "mpm-verify", &mut script);
    output::print_bytes(&script);
    PASSED
}

/// Prints the page of the program, or that of one of its commands.
pub(super) fn man(args: &ManArgs) -> u8 {
    let mut cli = Cli::command().disable_help_subcommand(true);
    cli.build();
    let page = match &args.command {
        None => Some(Man::new(cli)),
        Some(name) => cli.find_subcommand(name).map(|command| {
            Man::new(titled(command, name))
                .source(concat!("mpm-verify ", env!("CARGO_PKG_VERSION")))
        }),
    };
    let mut text = Vec::new();
    let Some(Ok(())) = page.map(|page| page.render(&mut text)) else {
        let name = args.command.as_deref().unwrap_or_default();
        output::complain(&format!("error: there is no command called `{name}`"));
        return BAD_INPUT;
    };
    output::print_bytes(&text);
    PASSED
}

/// The command under the name of its page, `mpm-verify-run`.
fn titled(command: &Command, name: &str) -> Command {
    command.clone().display_name(format!("mpm-verify-{name}"))
}
