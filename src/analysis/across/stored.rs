//! What exploring a paper's choices found: a row for every claim and result, under the interpretations that give it.

use super::super::claims::claim_hash;
use super::super::outcome::Outcome;
use super::super::verdict::Together;
use super::glance::{Glance, Sight};
use base::hash::sha256;
use base::settings::Document;
use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};
use study::explore::stamp;
use study::paper::Paper;
use study::store::write_whole;
use study::{Interpretation, Study, StudyError};

/// Interpretations of a paper under which its claims were judged.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exploration {
    /// The paper.
    pub paper: String,
    /// The command that made it.
    pub command: String,
    /// How many trials it took.
    pub trials: u64,
    /// The options that differ from the defaults of each choice, the default interpretation first.
    pub interpretations: Vec<BTreeMap<String, String>>,
    /// What the studies were when it was made, by name.
    pub studies: BTreeMap<String, String>,
    /// The claims, by id.
    #[serde(default)]
    pub claims: BTreeMap<String, ExploredClaim>,
    /// Which claims hold jointly under some interpretation.
    #[serde(default)]
    pub together: Vec<Together>,
}

/// A claim with all that was found about it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExploredClaim {
    /// What it said and how it was judged: a hash.
    pub asked: String,
    /// The studies that it looks at.
    pub studies: BTreeSet<String>,
    /// One witness would do.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub existential: bool,
    /// What was found, equal results once.
    pub results: Vec<ExploredResult>,
}

/// What was found about a claim under some interpretations.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExploredResult {
    /// The interpretations, by their places.
    pub interpretations: Vec<usize>,
    /// The outcome.
    pub outcome: Outcome,
    /// Whether that says something.
    pub sight: Sight,
    /// Our number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// Its interval.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interval: Option<[f64; 2]>,
    /// Of how many instances.
    #[serde(default)]
    pub n: usize,
    /// The share of paths that the verifier refuses.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub refused: f64,
    /// A hash of the trials' results.
    pub results: String,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks with a reference")]
fn is_zero(share: &f64) -> bool {
    *share == 0.0
}

/// What stands before the hash of all that follows, in a file's first line.
const SEAL: &str = "# sha256 of the lines below: ";

/// A number to the digits that are shown of it.
fn shown(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// What an interpretation is, by the options that differ from the defaults.
pub fn differing(paper: &Paper, point: &Interpretation) -> BTreeMap<String, String> {
    let interpretations = &paper.choices;
    let is_default = |id: &String, option: &String| {
        interpretations
            .iter()
            .any(|interpretation| interpretation.id == *id && interpretation.default == *option)
    };
    let other = point.options().iter().filter(|(id, option)| !is_default(id, option));
    other.map(|(id, option)| (id.clone(), option.clone())).collect()
}

impl Exploration {
    /// That of `glances` under `points`; `more` are those of points, by their places, that ran once more with more instances.
    pub fn new(
        paper: &Paper,
        points: &[Interpretation],
        glances: &[BTreeMap<String, Glance>],
        more: &BTreeMap<usize, BTreeMap<String, Glance>>,
    ) -> Self {
        let of_claim = |id: &String| {
            let mut seen = Vec::new();
            let mut studies = BTreeSet::new();
            let mut existential = false;
            for (place, glances) in glances.iter().enumerate() {
                let Some(first) = glances.get(id) else { continue };
                existential |= first.existential;
                studies.extend(first.studies.iter().cloned());
                seen.push((place, first, more.get(&place).and_then(|glances| glances.get(id))));
            }
            let results = results(&seen);
            let asked = paper.claim(id).map_or_else(String::new, |claim| claim_hash(paper, claim));
            (id.clone(), ExploredClaim { asked, studies, existential, results })
        };
        let ids: BTreeSet<&String> = glances.iter().flat_map(BTreeMap::keys).collect();
        Self {
            paper: paper.id.clone(),
            interpretations: points.iter().map(|point| differing(paper, point)).collect(),
            studies: paper.studies.iter().map(|study| (study.name.clone(), stamp(study))).collect(),
            claims: ids.into_iter().map(of_claim).collect(),
            ..Self::default()
        }
    }

    /// Where the first exploration of the paper whose runs are in `folder` lies.
    pub fn first(folder: &Path) -> PathBuf {
        folder.join("explored.toml.gz")
    }

    /// Where what was found on the second seed lies.
    pub fn second(folder: &Path) -> PathBuf {
        folder.join("second_seed.toml.gz")
    }

    /// The exploration in `path`, if there is one.
    ///
    /// # Errors
    /// [`StudyError::Touched`] if it was edited or cannot be understood.
    pub fn read(path: &Path) -> Result<Option<Self>, StudyError> {
        if !path.exists() {
            return Ok(None);
        }
        let again = "explore or confirm the paper again";
        let file = File::open(path).map_err(StudyError::io(path, "opening the file"))?;
        let mut text = String::new();
        let touched = |reason: &str| StudyError::Touched(format!("{}: {reason}; {again}", path.display()));
        let unpacked = GzDecoder::new(file).read_to_string(&mut text);
        unpacked.map_err(|error| touched(&format!("is no text packed by gzip ({error})")))?;
        let sealed = text.strip_prefix(SEAL).and_then(|rest| rest.split_once('\n'));
        if sealed.is_none_or(|(seal, body)| sha256(body.as_bytes()) != seal) {
            return Err(touched("is not what replan wrote: edited, or of an older version"));
        }
        let read = Document::new(path, text).read_stored();
        let found: Self = read.map_err(|error| StudyError::touched(error, again))?;
        let beyond = |result: &ExploredResult| {
            result.interpretations.iter().any(|place| *place >= found.interpretations.len())
        };
        if found.claims.values().flat_map(|claim| &claim.results).any(beyond) {
            return Err(touched("a result names an interpretation that is not listed"));
        }
        Ok(Some(found))
    }

    /// Writes it to `path`.
    ///
    /// # Errors
    /// [`StudyError::Io`].
    pub fn write(&self, path: &Path) -> Result<(), StudyError> {
        let body = toml::to_string(self).expect("an exploration is strings, numbers and tables of them");
        let text = format!("{SEAL}{}\n{body}", sha256(body.as_bytes()));
        // A claim has a row for each result: a megabyte as text, a tenth of that packed.
        let mut packed = GzEncoder::new(Vec::new(), Compression::best());
        let packed = packed.write_all(text.as_bytes()).and_then(|()| packed.finish());
        write_whole(path, &packed.map_err(StudyError::io(path, "packing the text"))?)
    }

    /// The place of the interpretation with these options, if it was explored.
    pub fn place(&self, options: &BTreeMap<String, String>) -> Option<usize> {
        self.interpretations.iter().position(|interpretation| interpretation == options)
    }

    /// What was found about the claim called `id` under the interpretation at `place`.
    pub fn result(&self, id: &str, place: usize) -> Option<&ExploredResult> {
        self.claims.get(id)?.results.iter().find(|result| result.interpretations.contains(&place))
    }

    /// Whether what is stored of the claim called `id` is of the claim and the studies as they are `now`.
    pub fn is_current(&self, now: &Now, id: &str) -> bool {
        let Some((stored, asked)) = self.claims.get(id).zip(now.asked.get(id)) else { return false };
        let is_as =
            |name: &String| now.studies.contains_key(name) && self.studies.get(name) == now.studies.get(name);
        // What stands for a study answers for it.
        let stands = now.stands_for.iter().filter(|(_, other)| stored.studies.contains(other));
        stored.asked == *asked && stored.studies.iter().all(is_as) && stands.map(|(name, _)| name).all(is_as)
    }

    /// The claims that it no longer speaks of.
    pub fn stale(&self, now: &Now) -> Vec<String> {
        now.ids.iter().filter(|id| !self.is_current(now, id)).cloned().collect()
    }
}

/// What a paper is now, by hashes: all that tells whether what was stored of it is of it as it is. It is made once and asked
/// for every claim.
#[derive(Debug, Default)]
pub struct Now {
    /// The claims in their order.
    ids: Vec<String>,
    /// What each says and how it is judged.
    asked: BTreeMap<String, String>,
    /// The studies.
    studies: BTreeMap<String, String>,
    /// The studies that stand for another one, and that one.
    stands_for: Vec<(String, String)>,
}

impl Now {
    /// That of `paper`.
    pub fn new(paper: &Paper) -> Self {
        let stands = |study: &Study| {
            let other = study.explore.as_ref()?.stands_for.clone()?;
            Some((study.name.clone(), other))
        };
        Self {
            ids: paper.claims.iter().map(|claim| claim.id.clone()).collect(),
            asked: paper.claims.iter().map(|claim| (claim.id.clone(), claim_hash(paper, claim))).collect(),
            studies: paper.studies.iter().map(|study| (study.name.clone(), stamp(study))).collect(),
            stands_for: paper.studies.iter().filter_map(stands).collect(),
        }
    }
}

impl ExploredResult {
    fn new(glance: &Glance) -> Self {
        let mut result = Self {
            interpretations: Vec::new(),
            outcome: glance.outcome,
            sight: glance.sight,
            value: None,
            interval: None,
            n: 0,
            refused: 0.0,
            results: glance.results.clone(),
        };
        result.set(glance);
        result
    }

    fn set(&mut self, glance: &Glance) {
        (self.outcome, self.sight) = (glance.outcome, glance.sight);
        self.refused = shown(glance.refused);
        self.value = glance.ours.map(|(value, ..)| shown(value)).filter(|value| value.is_finite());
        let interval = glance.ours.and_then(|(_, interval, _)| interval);
        self.interval =
            interval.map(|ends| ends.map(shown)).filter(|ends| ends.iter().all(|end| end.is_finite()));
        self.n = glance.ours.map_or(0, |(_, _, n)| n);
    }
}

/// What was found, equal results once, of a claim at a glance under the interpretation at each place, and with more instances where these ran.
/// Interpretations that few instances do not tell apart and more instances do are two results; where more instances did not run, an interpretation stays with
/// the first that was equal.
pub(super) fn results(seen: &[(usize, &Glance, Option<&Glance>)]) -> Vec<ExploredResult> {
    let mut found: Vec<(&str, Option<&Glance>, ExploredResult)> = Vec::new();
    for (place, first, more) in seen {
        let more = more.filter(|more| more.sight >= first.sight);
        let is_it = |(few, known, _): &(&str, Option<&Glance>, ExploredResult)| {
            let is_as_known = known.zip(more).is_none_or(|(known, more)| known.results == more.results);
            *few == first.results && is_as_known
        };
        let at = found.iter().position(is_it);
        let is_parted = at.is_none() && found.iter().any(|(few, ..)| *few == first.results);
        let at = at.unwrap_or_else(|| {
            found.push((&first.results, None, ExploredResult::new(first)));
            found.len() - 1
        });
        let (_, known, result) = &mut found[at];
        result.interpretations.push(*place);
        let Some(more) = more else { continue };
        *known = Some(more);
        result.set(more);
        if is_parted {
            result.results.clone_from(&more.results);
        }
    }
    found.into_iter().map(|(.., result)| result).collect()
}
