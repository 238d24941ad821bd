//! Scene files with numbers that are drawn with each instance, each evenly between two bounds.
//!
//! A table `[drawn]` names the numbers and their bounds. In any list of the file a text may stand for a number: a sum of numbers,
//! names and multiples of names, as in `"802 - 0.5*width"`. Every name has a stream of its own, so one more name moves no other.

use base::seed;
use base::settings::{Document, Faults, SettingsError};
use rand::RngExt as _;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;
use toml::{Table, Value};

/// The table of names and bounds.
const DRAWN: &str = "drawn";
/// Draws after which a scene counts as impossible.
const TRIES: u32 = 2_000;

/// A scene file with drawn numbers.
#[derive(Debug, Clone)]
pub(super) struct DrawnScene {
    path: PathBuf,
    table: Table,
    bounds: BTreeMap<String, [f64; 2]>,
}

impl DrawnScene {
    /// What `document` says, if it has a table of drawn numbers.
    ///
    /// # Errors
    /// Bounds that are no two rising numbers, or a text in a list that is no sum of numbers and known names, each at its place.
    pub(super) fn read(document: &Document) -> Result<Option<Self>, SettingsError> {
        let mut table: Table = document.read_stored()?;
        let Some(drawn) = table.remove(DRAWN) else { return Ok(None) };
        let mut faults = Faults::default();
        let mut bounds = BTreeMap::new();
        for (name, value) in drawn.as_table().into_iter().flatten() {
            let numbers: Vec<f64> = value.as_array().into_iter().flatten().filter_map(number).collect();
            match numbers[..] {
                [low, high] if low <= high => drop(bounds.insert(name.clone(), [low, high])),
                _ => {
                    let message = format!(
                        "drawn.{name} is {value}; [least, greatest], two rising numbers, is accepted"
                    );
                    faults.add(document.error_at(&format!("{DRAWN}.{name}"), message));
                }
            }
        }
        let scene = Self { path: document.path().to_owned(), table, bounds };
        let middle = scene.values(|[low, high], _| low.midpoint(high));
        let mut wrong = Vec::new();
        for (key, value) in &scene.table {
            filled(value, &middle, key, &mut wrong);
        }
        for (place, message) in wrong {
            faults.add(document.error_at(&place, message));
        }
        faults.or(Some(Some(scene)))
    }

    /// The file with every number in the middle of its bounds.
    pub(super) fn middle(&self) -> Arc<Document> {
        self.with(&self.values(|[low, high], _| low.midpoint(high)))
    }

    /// What `accept` makes of the first drawn file that it does not refuse; `None` if it refuses all of [`TRIES`].
    pub(super) fn draw<T>(
        &self,
        seed: u64,
        mut accept: impl FnMut(&Arc<Document>) -> Option<T>,
    ) -> Option<T> {
        (0..TRIES).find_map(|number| {
            let number = number.to_string();
            let value = |[low, high]: [f64; 2], name: &str| {
                let mut stream = seed::stream(seed::derive(seed, &["scene", name, &number]));
                low + (high - low) * stream.random::<f64>()
            };
            accept(&self.with(&self.values(value)))
        })
    }

    fn values(&self, of: impl Fn([f64; 2], &str) -> f64) -> BTreeMap<&str, f64> {
        self.bounds.iter().map(|(name, bounds)| (name.as_str(), of(*bounds, name))).collect()
    }

    /// The file with these numbers.
    fn with(&self, values: &BTreeMap<&str, f64>) -> Arc<Document> {
        let table: Table = self
            .table
            .iter()
            .map(|(key, value)| (key.clone(), filled(value, values, key, &mut Vec::new())))
            .collect();
        let text = toml::to_string(&table).expect("a table that was read can be written");
        Document::new(&self.path, text)
    }
}

fn number(value: &Value) -> Option<f64> {
    value
        .as_float()
        .or_else(|| value.as_integer().map(|whole| whole as f64))
        .filter(|number| number.is_finite())
}

/// `value`, which stands at `place`, with numbers in place of the texts in its lists; what is wrong with a text goes to `wrong`.
fn filled(
    value: &Value,
    values: &BTreeMap<&str, f64>,
    place: &str,
    wrong: &mut Vec<(String, String)>,
) -> Value {
    match value {
        Value::Table(table) => {
            let at = |(key, value): (&String, &Value)| {
                (key.clone(), filled(value, values, &format!("{place}.{key}"), wrong))
            };
            Value::Table(table.iter().map(at).collect())
        }
        Value::Array(elements) => {
            let at = |(index, element): (usize, &Value)| {
                let place = format!("{place}.{index}");
                let Some(text) = element.as_str() else { return filled(element, values, &place, wrong) };
                let sum = sum(text, values).unwrap_or_else(|message| {
                    wrong.push((place, message));
                    f64::NAN
                });
                Value::Float(sum)
            };
            Value::Array(elements.iter().enumerate().map(at).collect())
        }
        other => other.clone(),
    }
}

/// The sum that `text` writes: numbers, names and multiples of names (`0.5*width`), with `+` or `-` between them.
fn sum(text: &str, values: &BTreeMap<&str, f64>) -> Result<f64, String> {
    let term = |term: &str| -> Result<f64, String> {
        let (times, name) = match term.split_once('*') {
            Some((times, name)) => (times.trim().parse::<f64>().ok(), name.trim()),
            None => (Some(1.0), term),
        };
        let factor = |name: &str| values.get(name).copied().or_else(|| name.parse().ok());
        times.zip(factor(name)).map(|(times, value)| times * value).ok_or_else(|| {
            let known = values.keys().copied().collect::<Vec<_>>().join(", ");
            format!(
                "`{term}` in `{text}` is no number, no drawn name and no multiple of one; drawn are {known}"
            )
        })
    };
    let mut total = 0.0;
    let mut sign = 1.0;
    let mut rest = text.trim();
    loop {
        let end = rest.find([' ', '+']).unwrap_or(rest.len());
        total += sign * term(&rest[..end])?;
        rest = rest[end..].trim_start();
        sign = match rest.chars().next() {
            None => return Ok(total),
            Some('+') => 1.0,
            Some('-') => -1.0,
            Some(_) => return Err(format!("`{text}` is no sum; `+` or `-` is accepted between its terms")),
        };
        rest = rest[1..].trim_start();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    const FILE: &str = "name = \"a\"\n[drawn]\nwide = [10, 20]\nhigh = [1, 3]\n[[box]]\nname = \"b\"\n\
        min = [\"5 - 0.5*wide\", 0, 0]\nmax = [\"5 + 0.5*wide\", 1, \"high\"]\n";

    fn read(text: &str) -> Result<Option<DrawnScene>, String> {
        let document = Document::new(Path::new("scene.toml"), text.to_owned());
        DrawnScene::read(&document).map_err(|error| error.to_string())
    }

    fn corners(document: &Document) -> [f64; 3] {
        let table: Table = document.text().parse().unwrap();
        let of = |key: &str, index: usize| table["box"][0][key][index].as_float().unwrap();
        [of("min", 0), of("max", 0), of("max", 2)]
    }

    #[test]
    fn drawn_numbers_lie_in_their_bounds_and_one_name_more_moves_no_other() {
        let scene = read(FILE).unwrap().unwrap();
        assert_eq!(corners(&scene.middle()), [-2.5, 12.5, 2.0]);
        let more = read(&FILE.replace("wide = [10, 20]", "deep = [0, 1]\nwide = [10, 20]")).unwrap().unwrap();
        let mut seen = Vec::new();
        for seed in 0..200 {
            let drawn = scene.draw(seed, |document| Some(corners(document))).unwrap();
            let [low, high, top] = drawn;
            assert!(
                (10.0..=20.0).contains(&(high - low)) && (1.0..=3.0).contains(&top),
                "seed {seed}: {drawn:?}"
            );
            assert!((low + high - 10.0).abs() < 1e-9, "one number stands twice: {drawn:?}");
            assert_eq!(more.draw(seed, |document| Some(corners(document))), Some(drawn), "seed {seed}");
            seen.push(top);
        }
        seen.sort_by(f64::total_cmp);
        assert!(seen[0] < 1.1 && seen[199] > 2.9, "the bounds are reached: {} to {}", seen[0], seen[199]);
    }

    #[test]
    fn a_refused_draw_is_followed_by_another_until_none_are_left() {
        let scene = read(FILE).unwrap().unwrap();
        for seed in 0..20 {
            let top =
                scene.draw(seed, |document| Some(corners(document)[2]).filter(|top| *top > 2.5)).unwrap();
            assert!(top > 2.5, "seed {seed}: {top}");
        }
        assert_eq!(scene.draw(0, |_| None::<()>), None);
        assert!(read("name = \"a\"\n").unwrap().is_none(), "nothing is drawn without bounds");
    }

    #[test]
    fn sums_hold_numbers_names_and_multiples() {
        let values = BTreeMap::from([("a", 4.0), ("b_2", 10.0)]);
        for (text, expected) in
            [("a", 4.0), ("1 + a", 5.0), ("-3", -3.0), ("b_2 - 0.5*a - 1", 7.0), ("2*a+b_2", 18.0)]
        {
            assert_eq!(sum(text, &values), Ok(expected), "{text}");
        }
        for (text, part) in
            [("c", "`c` in `c` is no number"), ("a b_2", "is no sum"), ("1 + ", "`` in"), ("x*a", "`x*a`")]
        {
            assert!(sum(text, &values).unwrap_err().contains(part), "{text}");
        }
    }

    #[test]
    fn wrong_bounds_and_unknown_names_are_refused_at_their_places() {
        for (from, to, part) in [
            ("[10, 20]", "[20, 10]", "drawn.wide is [20, 10]; [least, greatest]"),
            ("[10, 20]", "12", "drawn.wide is 12"),
            ("5 - 0.5*wide", "5 - 0.5*wild", "`0.5*wild` in `5 - 0.5*wild`"),
        ] {
            let refused = read(&FILE.replace(from, to)).unwrap_err();
            assert!(refused.contains(part) && refused.contains("scene.toml"), "{refused}");
        }
    }
}
