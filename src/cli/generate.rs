//! Generates JSON Schemas, shell completions and manual pages.

use super::output::{self, CommandError, Status};
use clap::{Args, Command, ValueEnum};
use clap_complete::Shell;
use clap_mangen::Man;
use mpm_verify::external::protocol_schema;
use mpm_verify::report::report_schema;
use mpm_verify::suite::suite_schema;

#[derive(Debug, Args)]
pub(super) struct SchemaArgs {
    /// Documents to describe
    #[arg(value_enum)]
    of: SchemaName,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum SchemaName {
    /// Suite files, for completion and checks in an editor
    Suite,
    /// JSON reports of `run --format json`
    Json,
    /// Messages between the harness and an external solver
    Protocol,
}

pub(super) fn schema(args: &SchemaArgs) -> Status {
    output::print(&match args.of {
        SchemaName::Suite => suite_schema(),
        SchemaName::Json => report_schema(),
        SchemaName::Protocol => protocol_schema(),
    });
    Status::Passed
}

#[derive(Debug, Args)]
pub(super) struct CompletionsArgs {
    /// Shell that runs the script
    #[arg(value_enum)]
    shell: Shell,
}

#[derive(Debug, Args)]
pub(super) struct ManArgs {
    /// Command whose page is printed [default: the page of the program]
    #[arg(value_name = "COMMAND")]
    command: Option<String>,
}

pub(super) fn completions(args: &CompletionsArgs, mut cli: Command) -> Status {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut cli, "mpm-verify", &mut script);
    output::print_bytes(&script);
    Status::Passed
}

pub(super) fn man(args: &ManArgs, cli: Command) -> Result<Status, CommandError> {
    let mut cli = cli.disable_help_subcommand(true);
    cli.build();
    let page = match &args.command {
        None => Some(Man::new(cli)),
        Some(name) => cli.find_subcommand(name).map(|command| {
            Man::new(command.clone().display_name(format!("mpm-verify-{name}")))
                .source(concat!("mpm-verify ", env!("CARGO_PKG_VERSION")))
        }),
    };
    let mut text = Vec::new();
    let Some(Ok(())) = page.map(|page| page.render(&mut text)) else {
        let name = args.command.as_deref().unwrap_or_default();
        return Err(CommandError::Message(format!("there is no command called `{name}`")));
    };
    output::print_bytes(&text);
    Ok(Status::Passed)
}
