//! Claims that a paper no longer has, each with the reason, which the report shows beside the changes of claims.

use super::Paper;
use base::settings::{Faults, Spanned};
use schemars::JsonSchema;
use serde::Deserialize;

/// Claims that are gone, for one reason.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Withdrawn {
    /// Their ids.
    pub claims: Vec<Spanned<String>>,
    /// Why, or which claim asks the same since.
    pub why: String,
}

impl Withdrawn {
    /// Whether the claim called `id` is one of them.
    pub fn names(&self, id: &str) -> bool {
        self.claims.iter().any(|claim| claim.get_ref() == id)
    }
}

impl Paper {
    /// Whether a reason is given for the claim called `id` being gone.
    pub fn explains_withdrawn(&self, id: &str) -> bool {
        self.withdrawn.iter().any(|withdrawn| withdrawn.names(id))
    }

    /// Claims that are there are not withdrawn.
    pub(super) fn check_withdrawn(&self, faults: &mut Faults) {
        for id in self.withdrawn.iter().flat_map(|withdrawn| &withdrawn.claims) {
            if self.claim(id.get_ref()).is_some() {
                let message =
                    format!("claim `{}` is withdrawn, and there is a claim of this name", id.get_ref());
                faults.add(self.document.error(id.span(), message));
            }
        }
    }
}
