//! Groups of problems drawn from one family.

use super::error::StudyError;
use super::family::{Entry, Family};
use super::inputs::Inputs;
use super::reading::ReadingChoice;
use base::settings::Settings;

/// A group of problems.
#[derive(Debug)]
pub struct Group {
    /// Its name in records.
    pub label: String,
    /// The family they are drawn from.
    pub family: &'static Entry,
    /// How many independent draws.
    pub replicates: u32,
    /// The name of its draws, if it shares them with other groups.
    pub draw: Option<String>,
    /// Whether the spec asks for more than one draw: their names then carry a number.
    pub is_numbered: bool,
    /// The family's settings.
    pub settings: Settings,
}

impl Group {
    /// The family under the reading `point`.
    ///
    /// # Errors
    /// A settings error of the family, or an input file that is missing or wrong.
    pub fn family(&self, point: &ReadingChoice, inputs: &Inputs) -> Result<Box<dyn Family>, StudyError> {
        let settings = point
            .over_problem()
            .fold(self.settings.clone(), |settings, (over, origin)| settings.overlaid(over, origin));
        (self.family.build)(&settings, inputs)
    }
}
