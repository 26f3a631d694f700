//! `mpm-verify new`: creates a suite to start from.

mod template;

use super::arguments::FormatArgs;
use super::output;
use super::output::{CommandError, Status};
use clap::{Args, ValueEnum};
use mpm_verify::mpm::{BasisName, SchemeName, TransferName};
use mpm_verify::nearest;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::{Diagnostic, Source};
use std::fs::File;
use std::io::{self, BufRead, IsTerminal, Write};
use std::path::{Path, PathBuf};
use template::{Choices, LawChoice, NamedChoice, TruthChoice};

#[derive(Debug, Args)]
pub(super) struct NewArgs {
    /// Name of the suite: lower-case letters, digits and hyphens
    #[arg(value_name = "NAME")]
    name: String,
    /// Number of space dimensions [default: 1]
    #[arg(long, value_name = "D", value_parser = ["1", "2", "3"])]
    dimension: Option<String>,
    /// Material of the body [default: neo_hookean, or the one for the exact solution]
    #[arg(long, value_enum)]
    material: Option<LawChoice>,
    /// Exact solution [default: the one for the material]
    #[arg(long, value_enum)]
    truth: Option<TruthChoice>,
    /// Basis functions [default: quadratic_bspline]
    #[arg(long)]
    basis: Option<String>,
    /// Transfer between particles and grid [default: flip]
    #[arg(long)]
    transfer: Option<String>,
    /// Time scheme [default: musl]
    #[arg(long)]
    scheme: Option<String>,
    /// File to write; an existing file is not changed [default: NAME.yaml]
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    format: FormatArgs,
}

pub(super) fn new(args: &NewArgs) -> Result<Status, CommandError> {
    let path = written(args)?.display().to_string();
    output::print(&if args.format.is_json() {
        format!("{:#}\n", serde_json::json!({"file": path}))
    } else {
        format!("wrote {path}\nnext: mpm-verify check {path}\n")
    });
    Ok(Status::Passed)
}

fn written(args: &NewArgs) -> Result<PathBuf, CommandError> {
    let path = args.output.clone().unwrap_or_else(|| format!("{}.yaml", args.name).into());
    // The file is checked before any question is asked, and again in `save`.
    if path.exists() {
        return Err(in_the_way(&path));
    }
    let choices = choices(args)?;
    let text = template::text(&choices, &path);
    load(&choices, &path, &text)?;
    save(&path, &text)?;
    Ok(path)
}

fn choices(args: &NewArgs) -> Result<Choices, CommandError> {
    let law = law(args)?;
    let dimension = setting("dimension", args.dimension.as_ref(), vec!["1", "2", "3"], "1");
    let bases = BasisName::ALL.iter().map(|basis| basis.name()).collect();
    let transfers = TransferName::ALL.iter().map(|transfer| transfer.name()).collect();
    let schemes = SchemeName::ALL.iter().map(|scheme| scheme.name()).collect();
    Ok(Choices {
        name: args.name.clone(),
        dimension: dimension.value,
        law,
        basis: setting("basis functions", args.basis.as_ref(), bases, "quadratic_bspline"),
        transfer: setting("transfer", args.transfer.as_ref(), transfers, "flip"),
        scheme: setting("time scheme", args.scheme.as_ref(), schemes, "musl"),
    })
}

fn setting(
    what: &str,
    given: Option<&String>,
    known: Vec<&'static str>,
    default: &str,
) -> NamedChoice {
    let question = Question { what, choices: &known, default };
    let value = given.cloned().unwrap_or_else(|| question.ask());
    NamedChoice { value, known }
}

/// Chooses the material, which determines the exact solution.
fn law(args: &NewArgs) -> Result<LawChoice, CommandError> {
    if let (Some(law), Some(truth)) = (args.material, args.truth)
        && law.truth() != truth
    {
        let law = law.name();
        let reason = match truth {
            TruthChoice::Manufactured => format!(
                "a force cannot be manufactured for `{law}`: a law in rate form does not compute \
                 its stress from the deformation"
            ),
            TruthChoice::StandingWave => format!(
                "`{law}` has no standing wave, because waves of finite strain steepen: use \
                 `linear_elastic`"
            ),
        };
        return Err(CommandError::option("--truth", truth.name(), reason));
    }
    if let Some(law) = args.material {
        return Ok(law);
    }
    let all = [TruthChoice::Manufactured, TruthChoice::StandingWave];
    let truths = args.truth.as_ref().map_or(all.as_slice(), std::slice::from_ref);
    let laws: Vec<LawChoice> = truths.iter().flat_map(|truth| truth.laws()).copied().collect();
    let names: Vec<&str> = laws.iter().map(|law| law.name()).collect();
    let answer = Question { what: "material", choices: &names, default: names[0] }.ask();
    LawChoice::from_str(&answer, false).map_err(CommandError::Message)
}

/// Loads the suite. If an option causes an error, the diagnostic points to the option, because the
/// suite file does not exist yet.
fn load(choices: &Choices, path: &Path, text: &str) -> Result<Suite, Diagnostic> {
    let name = format!("{} (not written)", path.display());
    let loaded = Source::from_text(name, text).and_then(|source| Suite::load(&source));
    loaded.map_err(|diagnostic| at_its_option(choices, text, &diagnostic).unwrap_or(diagnostic))
}

fn at_its_option(choices: &Choices, text: &str, diagnostic: &Diagnostic) -> Option<Diagnostic> {
    let bytes = diagnostic.place()?.bytes();
    let key = text[..bytes.start].lines().last()?.split(':').next()?.trim();
    let (option, value) = match key {
        "suite" => ("NAME", choices.name.as_str()),
        "basis" => ("--basis", choices.basis.value.as_str()),
        "transfer" => ("--transfer", choices.transfer.value.as_str()),
        "scheme" => ("--scheme", choices.scheme.value.as_str()),
        _ => return None,
    };
    let wrong = text[bytes].trim_matches('"');
    let start = value.find(wrong).filter(|_| !wrong.is_empty());
    let range = start.map_or(0..value.len(), |start| start..start + wrong.len());
    let moved = Diagnostic::at(option, value, range, diagnostic.message());
    let (label, help) = (diagnostic.label(), diagnostic.help());
    Some(moved.with_label(label.unwrap_or_default()).with_help(help.unwrap_or_default()))
}

/// Writes a new file. A file that was created in the meantime is not overwritten.
fn save(path: &Path, text: &str) -> Result<(), CommandError> {
    let written = File::create_new(path).and_then(|mut file| file.write_all(text.as_bytes()));
    written.map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => in_the_way(path),
        _ => CommandError::about(path.display(), error),
    })
}

fn in_the_way(path: &Path) -> CommandError {
    let path = path.display();
    CommandError::Message(format!(
        "{path} already exists and is not overwritten; choose another file with --output"
    ))
}

struct Question<'a> {
    /// Name of the choice in the question.
    what: &'a str,
    choices: &'a [&'a str],
    /// Choice that an empty answer selects.
    default: &'a str,
}

impl Question<'_> {
    /// Asks the question if standard input is a terminal and there are alternatives, and returns
    /// the answer. Otherwise returns the default.
    fn ask(&self) -> String {
        let input = std::io::stdin();
        if self.choices.len() < 2 || !input.is_terminal() {
            return self.default.to_owned();
        }
        self.ask_on(&mut input.lock(), &mut std::io::stderr())
    }

    /// Asks until the answer is one of the choices. An empty line or the end of input selects the
    /// default.
    fn ask_on(&self, input: &mut impl BufRead, out: &mut impl Write) -> String {
        let Self { what, choices, default } = self;
        loop {
            let _ = write!(out, "{what} ({}) [{default}]: ", choices.join(", "));
            let _ = out.flush();
            let mut line = String::new();
            let is_over = !input.read_line(&mut line).is_ok_and(|bytes| bytes > 0);
            let answer = line.trim();
            if is_over || answer.is_empty() {
                return (*default).to_owned();
            }
            if choices.contains(&answer) {
                return answer.to_owned();
            }
            let near = nearest(answer, choices.iter().copied());
            let help = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
            let _ = writeln!(out, "`{answer}` is not one of these{help}");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case::named("usl\n", "usl", 1)]
    #[case::nothing_said("\n", "musl", 1)]
    #[case::spaces("  usf \n", "usf", 1)]
    #[case::end_of_input("", "musl", 1)]
    #[case::asked_again("mulsl\nusl\n", "usl", 2)]
    #[case::no_line_end("usf", "usf", 1)]
    fn answers(#[case] typed: &str, #[case] wanted: &str, #[case] asked: usize) {
        let question =
            Question { what: "time scheme", choices: &["usf", "usl", "musl"], default: "musl" };
        let mut out = Vec::new();
        assert_eq!(question.ask_on(&mut typed.as_bytes(), &mut out), wanted);
        let out = String::from_utf8(out).unwrap();
        assert_eq!(out.matches("time scheme (usf, usl, musl) [musl]: ").count(), asked, "{out}");
        assert_eq!(out.contains("did you mean `musl`?"), asked > 1, "{out}");
    }
}
