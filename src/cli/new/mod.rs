//! `mpm-verify new`: a suite to begin with.

mod args;
mod ask;
mod template;

use super::output;
use super::status::{BAD_INPUT, PASSED};
pub(super) use args::NewArgs;
use args::{LawChoice, TruthChoice};
use ask::Question;
use clap::ValueEnum;
use mpm_verify::mpm::{BasisName, SchemeName, TransferName};
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::{Diagnostic, Source};
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use template::{Choices, NamedChoice};

/// Writes a suite, and says where it is and what comes next.
pub(super) fn new(args: &NewArgs) -> u8 {
    match written(args) {
        Ok(path) => {
            let path = path.display().to_string();
            output::print(&if args.format.is_json() {
                format!("{:#}\n", serde_json::json!({"file": path}))
            } else {
                format!("wrote {path}\nnext: mpm-verify check {path}\n")
            });
            PASSED
        }
        Err(message) => {
            output::complain(&message);
            BAD_INPUT
        }
    }
}

fn written(args: &NewArgs) -> Result<PathBuf, String> {
    let path = args.output.clone().unwrap_or_else(|| format!("{}.yaml", args.name).into());
    // Before any question; `save` makes sure.
    if path.exists() {
        return Err(in_the_way(&path));
    }
    let choices = choices(args)?;
    let text = template::text(&choices, &path);
    load(&choices, &path, &text).map_err(|diagnostic| diagnostic.to_string())?;
    save(&path, &text)?;
    Ok(path)
}

/// All choices: those of the options, and the answers or defaults.
fn choices(args: &NewArgs) -> Result<Choices, String> {
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

/// The material, which settles the truth.
fn law(args: &NewArgs) -> Result<LawChoice, String> {
    if let (Some(law), Some(truth)) = (args.material, args.truth)
        && law.truth() != truth
    {
        let law = law.name();
        return Err(match truth {
            TruthChoice::Manufactured => format!(
                "error: --truth manufactured: no force is manufactured for `{law}`, a law in rate \
                 form has no stress of the deformation alone"
            ),
            TruthChoice::StandingWave => format!(
                "error: --truth standing_wave: no wave of `{law}` stands, waves of finite strain \
                 steepen; it is a truth of `linear_elastic`"
            ),
        });
    }
    if let Some(law) = args.material {
        return Ok(law);
    }
    let all = [TruthChoice::Manufactured, TruthChoice::StandingWave];
    let truths = args.truth.as_ref().map_or(all.as_slice(), std::slice::from_ref);
    let laws: Vec<LawChoice> = truths.iter().flat_map(|truth| truth.laws()).copied().collect();
    let names: Vec<&str> = laws.iter().map(|law| law.name()).collect();
    let answer = Question { what: "material", choices: &names, default: names[0] }.ask();
    LawChoice::from_str(&answer, false)
}

/// Loads the suite. Where an option is to blame, the diagnostic shows that, not a file that is not
/// there.
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

/// Writes a new file; one that has come meanwhile stays as it is.
fn save(path: &Path, text: &str) -> Result<(), String> {
    let written = File::create_new(path).and_then(|mut file| file.write_all(text.as_bytes()));
    written.map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => in_the_way(path),
        _ => format!("error: {}: {error}", path.display()),
    })
}

fn in_the_way(path: &Path) -> String {
    let path = path.display();
    format!("error: {path} is there already, and is not overwritten; --output names another file")
}
