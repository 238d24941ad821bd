//! The meaning of a column: the annotation in brackets after its name, such as `success [% of 250]`.
//!
//! An annotation is a list of items with commas between them. [`ITEMS`] has every item; nothing else is accepted.

pub mod contradiction;

use super::statistic::Statistic;
use proofs::exact::{self, Exact, whole};
use proofs::printed::Digits;

/// Every item of an annotation, with what it says.
pub const ITEMS: &[(&str, &str)] = &[
    ("% of N, share of N, count of N", "k of N trials as a percentage, a fraction, or the count itself"),
    (
        "mean U, sd U, se U, min U, q25 U, median U, max U, total U",
        "a statistic of n values in unit U (any text); q1, q2, q3 are quartiles, any other is in per cent",
    ),
    ("statistic", "the column names each row's statistic: mean, std, min, 25%, 50%, max"),
    ("n=N", "how many values are behind it: a number or the name of a column"),
    ("integers, tick=Q, binary", "each value behind it is whole, a multiple of Q (0.001, 1/64), or 0 or 1"),
    ("least=Q, most=Q", "no value behind it is below or above"),
    ("±sd, ±se", "what is printed after ± or in brackets"),
    ("sample, population", "the deviation divides by n − 1, or by n; either, if neither is written"),
    ("seeds=S", "the mean over S seeds of a share of N trials each"),
    (
        "quantiles=linear",
        "quantiles interpolate linearly, as numpy and pandas do; any usual rule, if it is not written",
    ),
    ("rounding=R", "how digits end: any, nearest, half up, half even, floor, ceiling, truncation"),
    (
        "digits=D",
        "D digits count, and zeros at the end of decimals are left out: with 6, 67.408 stands for 67.4080",
    ),
    (
        "of=NAME",
        "statistics of the same NAME in a row belong together; the column's name, if it is not written",
    ),
    ("parts=NAME", "shares of the whole called NAME, which sum to one"),
    ("sum=A+B", "for each problem, the sum of the columns A and B"),
    ("ratio=A/B", "for each problem, the quotient of the columns A and B"),
    ("a+b√2, a+b1.4141, step=Q", "a length of straight and diagonal moves on a lattice of step Q"),
    ("from=X:Y, to=X:Y", "the ends of the path, cells or points"),
    ("turns=COLUMN", "the turn sum in degrees of the same 8-connected path stands in COLUMN"),
    ("free=N", "expansions of distinct cells, of which N are free"),
    ("samples", "the number of samples, by which success is to rise"),
    ("rises, anytime", "expected to rise with samples; anytime: the larger sample contains the smaller"),
    ("lower is better, higher is better", "what bold is to mean"),
    ("unit=U", "the unit; numbers that are held against each other must have the same"),
    ("label, skip", "text, or a column that is not looked at"),
];

/// A number of trials: written down, or in a column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Count {
    /// This many.
    Number(u64),
    /// As many as the column of this name says.
    Column(String),
}

/// What kind of number a column holds.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Kind {
    /// Text, or not to be looked at.
    Skip,
    /// Names the statistic of each row.
    Statistics,
    /// k of n; `whole` is 100 for a percentage, 1 for a fraction, and n itself for a count (0 here).
    Share {
        /// What all of n would print as; 0 for a count.
        whole: u32,
    },
    /// A statistic of n values.
    Statistic(Statistic),
    /// A number of its own, or what rows' statistics are of.
    #[default]
    Value,
    /// The number of samples.
    Samples,
}

/// Which way is better.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Better {
    /// The lowest is best.
    Lower,
    /// The highest is best.
    Higher,
}

/// How a standard deviation divides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Divisor {
    /// By n − 1.
    Sample,
    /// By n.
    Population,
    /// By n − 1 or by n: the table does not say.
    #[default]
    Either,
}

/// What the annotation of a column says of its numbers.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Meaning {
    /// The kind of number.
    pub kind: Kind,
    /// How many values, or trials of a share; `None` if no annotation gives it.
    pub n: Option<Count>,
    /// Values behind it are multiples of this.
    pub grain: Option<Exact>,
    /// No value behind it is below …
    pub least: Option<Exact>,
    /// … or above.
    pub most: Option<Exact>,
    /// Seeds whose shares were averaged.
    pub seeds: Option<u64>,
    /// What stands after `±` or in brackets: the deviation or the standard error.
    pub spread: Option<Statistic>,
    /// How deviations divide.
    pub divisor: Divisor,
    /// Whether quantiles interpolate linearly.
    pub is_linear: bool,
    /// How digits end.
    pub digits: Digits,
    /// Significant digits, where trailing zeros are left out.
    pub significant: Option<u32>,
    /// Statistics of one name in a row belong together.
    pub of: Option<String>,
    /// The whole whose parts these are.
    pub parts: Option<String>,
    /// The columns that it sums.
    pub sum: Vec<String>,
    /// The columns that it divides.
    pub ratio: Option<[String; 2]>,
    /// Lattice lengths: the step, and what a diagonal counts (none: √2).
    pub lattice: Option<Lattice>,
    /// The ends of the path.
    pub ends: [Option<[Exact; 2]>; 2],
    /// The column with the turn sums of the same paths.
    pub turns: Option<String>,
    /// Free cells.
    pub free: Option<u64>,
    /// Whether it is to rise with the samples, and whether the larger sample contains the smaller.
    pub rises: Option<bool>,
    /// What bold is to mean.
    pub better: Option<Better>,
    /// The unit of what is printed.
    pub unit: Option<String>,
}

/// Lengths of moves on a lattice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lattice {
    /// The lattice's step in printed units.
    pub step: Exact,
    /// What a diagonal move counts in steps; none for √2.
    pub diagonal: Option<Exact>,
}

impl Divisor {
    /// What it may be for n values, above 0.
    pub fn values(self, n: i128) -> Vec<i128> {
        let all = match self {
            Self::Sample => vec![n - 1],
            Self::Population => vec![n],
            Self::Either => vec![n - 1, n],
        };
        all.into_iter().filter(|divisor| *divisor > 0).collect()
    }
}

impl Meaning {
    /// What an annotation says.
    ///
    /// # Errors
    /// What is wrong with an item, and what is accepted, in words.
    pub fn parse(annotation: &str) -> Result<Self, String> {
        let mut meaning = Self::default();
        let mut known: Vec<(&str, Self)> = Vec::new();
        for item in annotation.split(',').map(str::trim).filter(|item| !item.is_empty()) {
            let mut alone = Self::default();
            alone.take(item)?;
            for (other, earlier) in &known {
                if let Some(what) = contradiction::of_items(earlier, &alone) {
                    return Err(format!("`{other}` and `{item}` contradict each other: both say {what}"));
                }
            }
            known.push((item, alone));
            meaning.take(item)?;
        }
        match contradiction::of_whole(&meaning) {
            Some(why) => Err(format!("`{annotation}` contradicts itself: {why}")),
            None => Ok(meaning),
        }
    }

    /// Takes what `other` says of the same values and this leaves unsaid.
    pub fn fill_from(&mut self, other: &Self) {
        let other = other.clone();
        self.n = self.n.take().or(other.n);
        self.grain = self.grain.or(other.grain);
        self.least = self.least.or(other.least);
        self.most = self.most.or(other.most);
        self.seeds = self.seeds.or(other.seeds);
        if self.divisor == Divisor::Either {
            self.divisor = other.divisor;
        }
        self.is_linear |= other.is_linear;
    }

    /// The columns that it names.
    pub fn named_columns(&self) -> Vec<&str> {
        let n = match &self.n {
            Some(Count::Column(name)) => Some(name.as_str()),
            _ => None,
        };
        let sum = self.sum.iter().map(String::as_str);
        let ratio = self.ratio.iter().flatten().map(String::as_str);
        n.into_iter().chain(sum).chain(ratio).chain(self.turns.as_deref()).collect()
    }

    fn take(&mut self, item: &str) -> Result<(), String> {
        if self.take_word(item) || self.take_share(item)? {
            return Ok(());
        }
        if let Some(count) = item.strip_prefix("of ") {
            return Err(wrong(item, &format!("`% of {count}`, `share of {count}` or `count of {count}`")));
        }
        if let Some((key, value)) = item.split_once('=') {
            return self.take_setting(key.trim(), value.trim());
        }
        if let Some(diagonal) = item.strip_prefix("a+b") {
            let spelled = diagonal.trim_start_matches('*').trim_end_matches("cells").trim();
            let diagonal = match spelled {
                "√2" | "sqrt2" | "sqrt(2)" => None,
                other => Some(positive(other).ok_or_else(|| wrong(item, "a+b√2 or a+b1.4141"))?),
            };
            let step = self.lattice.map_or(whole(1), |lattice| lattice.step);
            self.lattice = Some(Lattice { step, diagonal });
            return Ok(());
        }
        let word = item.split_whitespace().next().unwrap_or_default();
        let statistic = Statistic::named(word).ok_or_else(|| {
            let known: Vec<&str> = ITEMS.iter().map(|(item, _)| *item).collect();
            wrong(item, &known.join("; "))
        })?;
        self.kind = Kind::Statistic(statistic);
        let unit = item[word.len()..].trim();
        self.unit = (!unit.is_empty()).then(|| unit.to_owned());
        Ok(())
    }

    /// Takes an item that is one fixed text; false if it is none.
    fn take_word(&mut self, item: &str) -> bool {
        match item {
            "label" | "skip" => self.kind = Kind::Skip,
            "statistic" => self.kind = Kind::Statistics,
            "value" => self.kind = Kind::Value,
            "samples" => self.kind = Kind::Samples,
            "integers" => self.grain = Some(whole(1)),
            "binary" => {
                (self.grain, self.least, self.most) = (Some(whole(1)), Some(whole(0)), Some(whole(1)));
            }
            "±sd" | "± sd" | "(sd)" => self.spread = Some(Statistic::Sd),
            "±se" | "± se" | "(se)" => self.spread = Some(Statistic::Se),
            "sample" => self.divisor = Divisor::Sample,
            "population" => self.divisor = Divisor::Population,
            "rises" => self.rises = Some(self.rises.unwrap_or(false)),
            "anytime" => self.rises = Some(true),
            "lower is better" => self.better = Some(Better::Lower),
            "higher is better" => self.better = Some(Better::Higher),
            _ => return false,
        }
        true
    }

    /// Takes `% of 250` and its like; false if the item is none.
    fn take_share(&mut self, item: &str) -> Result<bool, String> {
        let Some((whole, rest)) = [("%", 100), ("share", 1), ("count", 0)]
            .into_iter()
            .find_map(|(word, whole)| Some((whole, item.strip_prefix(word)?.trim())))
        else {
            return Ok(false);
        };
        match rest.strip_prefix("of ").map(str::trim) {
            Some("?") => {}
            Some(count) => self.n = Some(counted(item, count)?),
            None if rest.is_empty() => {}
            None => return Ok(false),
        }
        self.kind = Kind::Share { whole };
        Ok(true)
    }

    fn take_setting(&mut self, key: &str, value: &str) -> Result<(), String> {
        let item = format!("{key}={value}");
        let exact = || exact::parse(value).ok_or_else(|| wrong(&item, "a decimal or a fraction"));
        let above_0 = || positive(value).ok_or_else(|| wrong(&item, "a decimal or a fraction above 0"));
        let natural = || natural(value).ok_or_else(|| wrong(&item, "a whole number from 1 to 1000000000"));
        let names = |between: char| value.split(between).map(|name| name.trim().to_owned());
        match key {
            "n" => self.n = if value == "?" { None } else { Some(counted(&item, value)?) },
            "tick" => self.grain = Some(above_0()?),
            "least" => self.least = Some(exact()?),
            "most" => self.most = Some(exact()?),
            "seeds" => self.seeds = Some(natural()?),
            "digits" => self.significant = Some(natural()?.min(15) as u32),
            "quantiles" if value == "linear" => self.is_linear = true,
            "quantiles" => return Err(wrong(&item, "quantiles=linear")),
            "rounding" => self.digits = rounding(value).ok_or_else(|| wrong(&item, &roundings()))?,
            "of" => self.of = Some(value.to_owned()),
            "parts" => self.parts = Some(value.to_owned()),
            "sum" => self.sum = names('+').collect(),
            "ratio" => {
                let parts: Vec<String> = names('/').collect();
                self.ratio = Some(parts.try_into().map_err(|_| wrong(&item, "ratio=A/B, two columns"))?);
            }
            "step" => {
                let diagonal = self.lattice.and_then(|lattice| lattice.diagonal);
                self.lattice = Some(Lattice { step: above_0()?, diagonal });
            }
            "from" => self.ends[0] = Some(point(value).ok_or_else(|| wrong(&item, "from=X:Y"))?),
            "to" => self.ends[1] = Some(point(value).ok_or_else(|| wrong(&item, "to=X:Y"))?),
            "turns" => self.turns = Some(value.to_owned()),
            "unit" => self.unit = Some(value.to_owned()),
            "free" => self.free = Some(natural()?),
            _ => {
                let known: Vec<&str> = ITEMS.iter().map(|(item, _)| *item).collect();
                return Err(wrong(&item, &known.join("; ")));
            }
        }
        Ok(())
    }
}

/// The rounding called `name`.
pub fn rounding(name: &str) -> Option<Digits> {
    Digits::NAMED.iter().find(|(known, _)| *known == name).map(|(_, digits)| *digits)
}

/// The names of all roundings, for messages.
pub fn roundings() -> String {
    let names: Vec<&str> = Digits::NAMED.iter().map(|(name, _)| *name).collect();
    names.join(", ")
}

/// A whole number from 1 to 10⁹.
pub fn natural(text: &str) -> Option<u64> {
    text.parse().ok().filter(|number| (1..=1_000_000_000).contains(number))
}

fn counted(item: &str, value: &str) -> Result<Count, String> {
    if value.starts_with(|c: char| c.is_ascii_digit() || c == '-') {
        let number = natural(value);
        return number.map(Count::Number).ok_or_else(|| wrong(item, "a whole number from 1 to 1000000000"));
    }
    if value.is_empty() {
        Err(wrong(item, "a number or a column's name"))
    } else {
        Ok(Count::Column(value.to_owned()))
    }
}

fn positive(text: &str) -> Option<Exact> {
    exact::parse(text).filter(|value| *value > whole(0))
}

/// A point `X:Y`.
pub fn point(text: &str) -> Option<[Exact; 2]> {
    let (x, y) = text.split_once(':')?;
    Some([exact::parse(x)?, exact::parse(y)?])
}

fn wrong(item: &str, accepted: &str) -> String {
    format!("`{item}` is no item of an annotation; accepted: {accepted}")
}
