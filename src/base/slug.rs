//! Labels as parts of names.

/// `label` in lower case with everything but letters and digits turned into dashes, `*` spelled out: part of a
/// trial's name that any shell takes as it is.
pub fn slug(label: &str) -> String {
    let spelled = label.to_lowercase().replace('*', "-star").replace('+', "-plus");
    let dashed: String = spelled.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    dashed.split('-').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("-")
}
