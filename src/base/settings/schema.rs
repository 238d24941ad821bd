//! A part of a JSON Schema, as far as our types use the language.

use serde_json::Value;

/// A part of a schema, and the whole that its references are into.
#[derive(Clone, Copy)]
pub(super) struct Node<'a> {
    root: &'a Value,
    value: &'a Value,
}

/// The smallest and the largest whole number of the formats that say no bounds themselves; how far a machine counts is no bound.
const INTEGERS: [(&str, f64, f64); 6] = [
    ("uint32", 0.0, f64::INFINITY),
    ("uint64", 0.0, f64::INFINITY),
    ("uint", 0.0, f64::INFINITY),
    ("int32", f64::NEG_INFINITY, f64::INFINITY),
    ("int64", f64::NEG_INFINITY, f64::INFINITY),
    ("int", f64::NEG_INFINITY, f64::INFINITY),
];

impl<'a> Node<'a> {
    pub(super) fn root(root: &'a Value) -> Self {
        Self { root, value: root }.resolved()
    }

    /// The part itself, after its reference was followed.
    fn resolved(self) -> Self {
        let Some(name) = self.text("$ref") else { return self };
        let name = name.strip_prefix("#/$defs/").expect("our schemas refer to their own definitions alone");
        let value = self.root["$defs"]
            .as_object()
            .and_then(|all| all.get(name))
            .expect("what is referred to is defined");
        Self { value, ..self }.resolved()
    }

    fn at(self, value: &'a Value) -> Self {
        Self { value, ..self }.resolved()
    }

    pub(super) fn get(self, key: &str) -> Option<&'a Value> {
        self.value.as_object()?.get(key)
    }

    pub(super) fn text(self, key: &str) -> Option<&'a str> {
        self.get(key)?.as_str()
    }

    pub(super) fn part(self, key: &str) -> Option<Self> {
        self.get(key).map(|value| self.at(value))
    }

    pub(super) fn list(self, key: &str) -> impl Iterator<Item = Self> {
        self.get(key).and_then(Value::as_array).into_iter().flatten().map(move |value| self.at(value))
    }

    /// Whether it is `false`: nothing is accepted.
    pub(super) fn refuses_all(self) -> bool {
        self.value == &Value::Bool(false)
    }

    /// Keys of a table that have a meaning of their own; each part as it is, with its own description.
    pub(super) fn properties(self) -> impl Iterator<Item = (&'a str, Self)> {
        let all = self.get("properties").and_then(Value::as_object).into_iter().flatten();
        all.map(move |(key, value)| (key.as_str(), Self { value, ..self }))
    }

    pub(super) fn property(self, key: &str) -> Option<Self> {
        let value = self.get("properties")?.as_object()?.get(key)?;
        Some(self.at(value))
    }

    pub(super) fn required(self) -> impl Iterator<Item = &'a str> {
        self.get("required").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str)
    }

    /// The ways to fulfil it, if there are several; TOML has no null, so that it is none.
    pub(super) fn branches(self) -> Vec<Self> {
        let all = self.list("anyOf").chain(self.list("oneOf"));
        let all = all.filter(|branch| branch.text("type") != Some("null"));
        all.flat_map(|branch| match branch.branches() {
            inner if inner.is_empty() => vec![branch],
            inner => inner,
        })
        .collect()
    }

    /// The words it is limited to; none if it is not.
    pub(super) fn words(self) -> Vec<&'a str> {
        let listed = self.get("enum").and_then(Value::as_array).into_iter().flatten();
        listed.chain(self.get("const")).filter_map(Value::as_str).collect()
    }

    /// The kinds of value it takes, null left out; empty if it takes any.
    pub(super) fn kinds(self) -> Vec<&'a str> {
        let kinds = match self.get("type") {
            Some(Value::String(kind)) => vec![kind.as_str()],
            Some(Value::Array(kinds)) => kinds.iter().filter_map(Value::as_str).collect(),
            _ => Vec::new(),
        };
        kinds.into_iter().filter(|kind| *kind != "null").collect()
    }

    /// The least and the largest number, both accepted.
    pub(super) fn bounds(self) -> (f64, f64) {
        let format = self.text("format");
        let width = INTEGERS.iter().find(|(name, ..)| Some(*name) == format);
        let (low, high) = width.map_or((f64::NEG_INFINITY, f64::INFINITY), |(_, low, high)| (*low, *high));
        let number = |key: &str| self.get(key).and_then(Value::as_f64);
        (
            number("minimum").map_or(low, |least| least.max(low)),
            number("maximum").map_or(high, |most| most.min(high)),
        )
    }

    /// The end of the format's range that a whole number passes.
    pub(super) fn limit_passed(self, whole: i128) -> Option<i128> {
        let (least, most): (i128, i128) = match self.text("format")? {
            "uint32" => (0, u32::MAX.into()),
            "int32" => (i32::MIN.into(), i32::MAX.into()),
            "uint64" | "uint" => (0, u64::MAX.into()),
            "int64" | "int" => (i64::MIN.into(), i64::MAX.into()),
            _ => return None,
        };
        (whole < least).then_some(least).or((whole > most).then_some(most))
    }

    /// The numbers between which it lies, neither accepted.
    pub(super) fn open_bounds(self) -> (f64, f64) {
        let number = |key: &str| self.get(key).and_then(Value::as_f64);
        (
            number("exclusiveMinimum").unwrap_or(f64::NEG_INFINITY),
            number("exclusiveMaximum").unwrap_or(f64::INFINITY),
        )
    }

    /// How many elements an array has at least and at most.
    pub(super) fn counts(self) -> (u64, u64) {
        let number = |key: &str| self.get(key).and_then(Value::as_u64);
        (number("minItems").unwrap_or(0), number("maxItems").unwrap_or(u64::MAX))
    }

    /// How many characters a text has at least.
    pub(super) fn least_length(self) -> u64 {
        self.get("minLength").and_then(Value::as_u64).unwrap_or(0)
    }

    /// What is accepted of a number at most `furthest` away from 0, in words.
    pub(super) fn accepted_within(self, furthest: f64) -> String {
        self.number("a number", furthest)
    }

    /// What is accepted, in words.
    pub(super) fn accepted(self) -> String {
        let branches = self.branches();
        if !branches.is_empty() {
            let mut all: Vec<String> = Vec::new();
            for branch in branches.into_iter().map(Self::accepted) {
                if !all.contains(&branch) {
                    all.push(branch);
                }
            }
            return either(&all);
        }
        let words = self.words();
        if !words.is_empty() {
            return either(&words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>());
        }
        let kinds: Vec<String> = self.kinds().into_iter().map(|kind| self.of_kind(kind)).collect();
        if kinds.is_empty() { "any value".to_owned() } else { either(&kinds) }
    }

    fn of_kind(self, kind: &str) -> String {
        match kind {
            "integer" => self.number("a whole number", f64::INFINITY),
            "number" => self.number("a number", f64::INFINITY),
            "boolean" => "true or false".to_owned(),
            "string" if self.least_length() > 0 => "text in quotes, not empty,".to_owned(),
            "string" => "text in quotes".to_owned(),
            "array" => self.array(),
            "object" => self.table(),
            other => other.to_owned(),
        }
    }

    fn number(self, what: &str, furthest: f64) -> String {
        let (low, high) = self.bounds();
        let (above, below) = self.open_bounds();
        let (low, high) = (low.max(-furthest), high.min(furthest));
        let shown = |end: f64| {
            if what == "a number" && end.abs() >= 1e9 { format!("{end:e}") } else { end.to_string() }
        };
        let lower = match () {
            () if above >= low && above.is_finite() => Some(format!("above {above}")),
            () if low.is_finite() => Some(format!("from {}", shown(low))),
            () => None,
        };
        let upper = match () {
            () if below <= high && below.is_finite() => Some(format!("below {below}")),
            () if high.is_finite() => Some(format!("to {}", shown(high))),
            () => None,
        };
        match (lower, upper) {
            (None, None) => what.to_owned(),
            (Some(lower), None) if lower.starts_with("from") => format!("{what} of {low} or more"),
            (None, Some(upper)) if upper.starts_with("to") => format!("{what} of {high} or less"),
            (lower, upper) => {
                let bounds: Vec<String> = lower.into_iter().chain(upper).collect();
                format!("{what} {}", bounds.join(" "))
            }
        }
    }

    fn array(self) -> String {
        let each: Vec<String> = self.list("prefixItems").map(Self::accepted).collect();
        if !each.is_empty() {
            return format!("an array of {}", each.join(" and "));
        }
        let of = self.part("items").map_or_else(String::new, |item| format!(" ({} each)", item.accepted()));
        match self.counts() {
            (0, u64::MAX) => format!("an array{of}"),
            (least, u64::MAX) => format!("an array of {least} or more{of}"),
            (least, most) if least == most => format!("an array of {least}{of}"),
            (least, most) => format!("an array of {least} to {most}{of}"),
        }
    }

    fn table(self) -> String {
        let keys: Vec<String> = self.properties().map(|(key, _)| format!("`{key}`")).collect();
        match self.part("additionalProperties").filter(|part| part.value.is_object()) {
            Some(part) if keys.is_empty() => format!("a table of names, each {}", part.accepted()),
            _ if keys.is_empty() => "a table".to_owned(),
            _ => format!("a table with {}", keys.join(", ")),
        }
    }
}

fn either(all: &[String]) -> String {
    match all {
        [] => String::new(),
        [one] => one.clone(),
        [first, second] => format!("{first} or {second}"),
        [many @ .., last] => format!("{} or {last}", many.join(", ")),
    }
}

/// The defaults of a table's keys, switches aside.
pub(super) fn defaults(schema: &Value) -> Vec<(String, toml::Value)> {
    let keys = schema.get("properties").and_then(Value::as_object).into_iter().flatten();
    let given = keys.filter_map(|(key, part)| Some((key.clone(), part.get("default")?)));
    given
        .filter(|(_, value)| !matches!(value, Value::Null | Value::Bool(false)))
        .filter_map(|(key, value)| Some((key, toml::Value::try_from(value).ok()?)))
        .collect()
}
