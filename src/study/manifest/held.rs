//! Statements of a stored manifest that the study and its inputs do not bear out: for `replan judge --check`.

use super::Manifest;
use crate::choice::Interpretation;
use crate::runner::BuiltStudy;
use crate::{Inputs, Study, StudyError};

impl Manifest {
    /// How it differs from the manifest that a run of `study` would get now, one sentence each. Record files are compared with it
    /// where they are read. The command and the machine cannot be found out again, and are believed.
    ///
    /// # Errors
    /// Those of [`Manifest::new`].
    pub fn untrue(&self, study: &Study, inputs: &Inputs) -> Result<Vec<String>, StudyError> {
        let study = Study { seed: self.seed, ..study.clone() };
        let study = if self.quick { study.quick() } else { study };
        let points = match self.points(&study) {
            Ok(points) => points,
            Err(message) => return Ok(vec![message]),
        };
        let built = BuiltStudy::new(&study, &points, inputs)?;
        let now = Self::new(&study, &points, &built, self.command.clone(), self.quick)?;
        let mut found = now.differs_from(self);
        for (key, is_same) in [
            ("study", self.study == now.study),
            ("spec", self.spec == now.spec),
            ("depends", self.depends == now.depends),
            ("recorded", self.recorded == now.recorded),
            ("defaults", self.defaults == now.defaults),
            ("inputs", self.inputs == now.inputs),
            ("problems", self.problems == now.problems),
            ("contenders", self.contenders == now.contenders),
        ] {
            if !is_same && found.is_empty() {
                found.push(format!("`{key}` is not what the study and its inputs give"));
            }
        }
        let numbers = self.sessions.iter().map(|session| session.number);
        if !numbers.eq(1..=self.sessions.len() as u32) {
            found.push("`session` has numbers that do not count from 1".to_owned());
        }
        Ok(found)
    }

    /// The interpretations that it lists.
    fn points(&self, study: &Study) -> Result<Vec<Interpretation>, String> {
        if self.interpretations.is_empty() {
            return Err("`interpretations` lists none".to_owned());
        }
        let point = |options: &Vec<String>| {
            if options.len() != self.choices.len() {
                return Err(format!(
                    "`interpretations` has {} options for {} choices",
                    options.len(),
                    self.choices.len()
                ));
            }
            let chosen = self.choices.iter().cloned().zip(options.iter().cloned()).collect();
            Interpretation::new(&study.choices, &chosen)
                .map_err(|message| format!("`interpretations`: {message}"))
        };
        self.interpretations.iter().map(point).collect()
    }
}
