//! The names that a suite declares: taken, unused, or declared too late.

use super::{Evaluator, ParameterSpec};
use crate::suite::yaml::{Diagnostic, Ordered, Path};

impl Evaluator<'_> {
    /// Refuses a declared name that formulas need for one of their `variables`.
    pub(crate) fn refuse_taken(&self, variables: &[&str]) -> Result<(), Diagnostic> {
        let diagnostic = |path: &Path, name: &str| {
            let message = format!("`{name}` is a variable of formulas and cannot be declared");
            let help = format!("rename it; the variables are {}", variables.join(", "));
            Err(self.diagnostic_at_key(path, &message).with_help(&help))
        };
        for name in variables {
            let declared = self.scope.constants().map(|(known, _)| known);
            if declared.chain(self.scope.tables()).any(|known| known == *name) {
                return diagnostic(&Path::top("parameters").then(*name), name);
            }
            if let Some(head) = self.head_of(name) {
                return diagnostic(&Path::top("functions").then(head.as_str()), name);
            }
        }
        Ok(())
    }

    /// Complains of the first parameter or function that nothing uses.
    pub(crate) fn refuse_unused(
        &self,
        parameters: &Ordered<ParameterSpec>,
        functions: &Ordered<String>,
    ) -> Result<(), Diagnostic> {
        let used = self.used.borrow();
        for (name, _) in parameters.as_slice() {
            if !used.contains(name) {
                let path = Path::top("parameters").then(name.as_str());
                let message = format!("the parameter `{name}` is never used");
                return Err(self
                    .diagnostic_at_key(&path, &message)
                    .with_help("remove it, or use it"));
            }
        }
        for (head, _) in functions.as_slice() {
            let name = name_in(head);
            if !used.contains(name) {
                let path = Path::top("functions").then(head.as_str());
                let message = format!("the function `{name}` is never used");
                return Err(self
                    .diagnostic_at_key(&path, &message)
                    .with_help("remove it, or use it"));
            }
        }
        Ok(())
    }

    /// Whether a name is that of a parameter whose value is not known yet.
    pub(super) fn comes_later(&self, name: &str) -> bool {
        self.parameters.iter().any(|known| known == name)
            && !self.scope.constants().any(|(known, _)| known == name)
            && !self.scope.tables().any(|known| known == name)
    }

    /// The head under which the file declares `function`.
    pub(super) fn head_of(&self, function: &str) -> Option<&String> {
        self.heads.iter().find(|head| name_in(head) == function)
    }
}

/// `s` in `s(tau)`.
fn name_in(head: &str) -> &str {
    head.split('(').next().unwrap_or(head).trim()
}
