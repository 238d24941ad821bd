//! Shortest polylines: each is searched for once and kept from one command to the next.
//!
//! The name of a kept answer is a hash of the question and of the code that answers it, so that no stale answer is ever
//! found. Losing it costs time alone.

use base::hash::sha256;
use proofs::turns::{Polyline, TurnQuery, shortest_polyline};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use study::store::write_whole;

/// Answers by their names.
type Answers = BTreeMap<String, Option<Polyline>>;

/// What was found so far.
#[derive(Debug, Default)]
pub struct Polylines {
    found: Mutex<BTreeMap<String, Arc<OnceLock<Option<Polyline>>>>>,
    /// What an earlier command found, and where it is kept.
    kept: Answers,
    file: Option<PathBuf>,
}

impl Polylines {
    /// Those that `file` keeps; none if there is no such file or it cannot be understood.
    pub fn kept_in(file: &Path) -> Self {
        let text = fs::read(file).unwrap_or_default();
        let kept = serde_json::from_slice(&text).unwrap_or_default();
        Self { kept, file: Some(file.to_owned()), ..Self::default() }
    }

    /// [`shortest_polyline`].
    ///
    /// # Panics
    /// As that function.
    pub fn shortest(&self, query: &TurnQuery) -> Option<Polyline> {
        let name = named(query);
        if let Some(known) = self.kept.get(&name) {
            return known.clone();
        }
        let mut found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        let answer = found.entry(name).or_default().clone();
        drop(found);
        answer.get_or_init(|| shortest_polyline(query)).clone()
    }

    /// Writes the answers found. What cannot be written is searched for again another time.
    pub fn keep(&self) {
        let found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(file) = self.file.as_ref().filter(|_| !found.is_empty()) else { return };
        let mut all = self.kept.clone();
        all.extend(found.iter().filter_map(|(name, answer)| Some((name.clone(), answer.get()?.clone()))));
        if let (Some(folder), Ok(text)) = (file.parent(), serde_json::to_vec(&all)) {
            let _ = fs::create_dir_all(folder).map(|()| write_whole(file, &text));
        }
    }
}

/// What names the answer to `query`: its words, and those of the code that answers.
fn named(query: &TurnQuery) -> String {
    static CODE: OnceLock<String> = OnceLock::new();
    let code = CODE.get_or_init(|| sha256(proofs::turns::SOURCE.concat().as_bytes()));
    sha256(format!("{code} {query:?}").as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proofs::turns::Convention;
    use stats::interval::Interval;

    #[test]
    fn what_is_kept_is_found_again_and_a_damaged_file_costs_time_alone() {
        let query = TurnQuery {
            size: [6, 6],
            starts: vec![[0, 0]],
            goals: vec![[4, 1]],
            headings: Vec::new(),
            convention: Convention::Exterior,
            turn_deg: Interval::new(44.9, 45.1),
            length: Interval::new(0.0, 8.0),
        };
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("cache/polylines.json");
        let first = Polylines::kept_in(&file);
        let answer = first.shortest(&query);
        assert_eq!(answer, shortest_polyline(&query));
        first.keep();
        let again = Polylines::kept_in(&file);
        assert!(again.kept.contains_key(&named(&query)) && again.shortest(&query) == answer);
        assert!(again.found.lock().unwrap().is_empty(), "it was searched for again");
        let other = TurnQuery { size: [6, 7], ..query.clone() };
        assert!(!again.kept.contains_key(&named(&other)), "another question has another name");
        fs::write(&file, "{ damaged").unwrap();
        assert_eq!(Polylines::kept_in(&file).shortest(&query), answer);
    }
}
