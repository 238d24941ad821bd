//! The known name that somebody may have meant who wrote an unknown one.

/// A longer name is not compared: it takes the product of the lengths.
const LONGEST: usize = 64;

use super::renamed::renamed;

/// ` (did you mean X?)` with the known name nearest to `written`, or nothing if none is near.
///
/// A name longer than 64 characters is near to none. Near is at most a third of the letters added, left out, changed or
/// swapped with their neighbour, whatever their case. A name is near as well if it begins with `written`, or ends in it
/// after a `/`.
///
/// ` (it is X now)` if it was renamed to a known name.
pub fn did_you_mean<'a>(written: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    if let Some(now) = renamed("names").get(written).filter(|now| known.contains(&now.as_str())) {
        return format!(" (it is `{now}` now)");
    }
    nearest(written, known)
        .filter(|name| *name != written)
        .map_or_else(String::new, |name| format!(" (did you mean `{name}`?)"))
}

/// The known name nearest to `written`, if one is near.
pub(super) fn nearest<'a>(written: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let lower = written.to_lowercase();
    let length = lower.chars().count();
    if length > LONGEST {
        return None;
    }
    let apart = |name: &str| {
        let name = name.to_lowercase();
        // A name that was not written out is nearer than one with other letters.
        let is_part = name.starts_with(&lower) || name.rsplit_once('/').is_some_and(|(_, end)| end == lower);
        if length > 2 && is_part { 0 } else { strsim::damerau_levenshtein(&lower, &name) }
    };
    let nearest = known.into_iter().map(|name| (apart(name), name)).min();
    nearest.filter(|(apart, _)| *apart <= length / 3).map(|(_, name)| name)
}

/// The message that `written` is no name of the kind `what`: with the nearest name and all there are.
pub fn none_called<'a>(what: &str, written: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    let hint = did_you_mean(written, known.iter().copied());
    let known = if known.is_empty() { "none at all".to_owned() } else { known.join(", ") };
    format!("there is no {what} `{written}`{hint}; there are {known}")
}
