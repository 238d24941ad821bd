//! Samples: the values behind printed statistics, and what is known of them.
//!
//! A share k of n is the mean of n values that are 0 or the whole. A mean over seeds is one of S values that are shares of
//! T trials each. So every check of means, deviations and quantiles is one of samples.

use super::meaning::{Count, Divisor, Kind, Meaning};
use super::statistic::Statistic;
use super::table::{Column, Quoted, Table, named_by, quoted};
use proofs::exact::{Exact, Print, div, whole};

/// Values behind printed statistics.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// What it is called: the row and column.
    pub name: String,
    /// `table/column`, where statistics stand in rows.
    pub path: String,
    /// How many values; `None` if it is not known.
    pub n: Option<u64>,
    /// Values are multiples of this.
    pub grain: Option<Exact>,
    /// No value is below …
    pub least: Option<Exact>,
    /// … or above.
    pub most: Option<Exact>,
    /// Whether the mean is printed as a count: the sum of the values.
    pub is_count: bool,
    /// How many are the whole, where `29/30` is printed beside the share.
    pub successes: Option<u64>,
    /// Seeds, if the values are shares of `trials` each.
    pub trials: Option<u64>,
    /// How deviations divide.
    pub divisor: Divisor,
    /// Whether quantiles interpolate linearly.
    pub is_linear: bool,
    /// The printed statistics.
    pub numbers: Vec<(Statistic, Quoted)>,
}

impl Sample {
    /// A statistic as printed.
    pub fn get(&self, statistic: Statistic) -> Option<&Quoted> {
        self.numbers.iter().find(|(known, _)| *known == statistic).map(|(_, quoted)| quoted)
    }

    /// Whether every value is one of the two ends: a share of trials.
    pub fn is_binary(&self) -> bool {
        self.least == Some(whole(0)) && self.most.is_some() && self.most == self.grain
    }

    /// What the values are, in words.
    pub fn values(&self) -> String {
        let n = self.n.map_or_else(|| "values".to_owned(), |n| format!("{n} values"));
        if self.is_binary() {
            return format!("{n}, each 0 or {}", self.most.map_or_else(String::new, |most| most.to_string()));
        }
        let mut text = n;
        if let Some(grain) = self.grain {
            let whole_ones = if grain == whole(1) {
                ", each a whole number".to_owned()
            } else {
                format!(", each a multiple of {grain}")
            };
            text += &whole_ones;
        }
        match (self.least, self.most) {
            (Some(least), Some(most)) => text += &format!(", from {least} to {most}"),
            (Some(least), None) => text += &format!(", at least {least}"),
            (None, Some(most)) => text += &format!(", at most {most}"),
            (None, None) => {}
        }
        text
    }
}

/// The number of trials that an annotation writes down.
pub fn number(meaning: &Meaning) -> Option<u64> {
    match meaning.n {
        Some(Count::Number(n)) => Some(n),
        _ => None,
    }
}

/// The sample that `meaning` describes, with `n` trials or values.
pub fn of_meaning(
    name: &str,
    meaning: &Meaning,
    n: Option<u64>,
    numbers: Vec<(Statistic, Quoted)>,
) -> Sample {
    let mut sample = Sample {
        name: name.to_owned(),
        path: name.to_owned(),
        n,
        grain: meaning.grain,
        least: meaning.least,
        most: meaning.most,
        is_count: false,
        successes: None,
        trials: None,
        divisor: meaning.divisor,
        is_linear: meaning.is_linear,
        numbers,
    };
    if let Kind::Share { whole: of } = meaning.kind {
        let all = whole(if of == 0 { 1 } else { of });
        sample.is_count = of == 0;
        (sample.grain, sample.least, sample.most) = (Some(all), Some(whole(0)), Some(all));
        if let Some(seeds) = meaning.seeds {
            sample.grain = n.and_then(|trials| div(all, whole(trials)));
            (sample.n, sample.trials) = (Some(seeds), n);
        }
    }
    sample
}

/// Gives every sample in `table`, which is number `index`.
pub fn each(index: usize, table: &Table, give: &mut dyn FnMut(&Sample)) {
    if let Some(column) = table.statistics() {
        return down_rows(index, table, column, give);
    }
    let described = |group: Group| {
        let meaning = group.meaning(&table.columns);
        (group, meaning)
    };
    let groups: Vec<(Group, Meaning)> = groups(&table.columns).into_iter().map(described).collect();
    (0..table.rows.len()).for_each(|row| in_row(index, table, row, &groups, give));
}

/// Samples whose statistics stand below each other: rows that are named alike in the columns that hold no numbers, up to
/// the row in which a statistic stands a second time.
fn down_rows(index: usize, table: &Table, statistics: usize, give: &mut dyn FnMut(&Sample)) {
    let is_name = |at: &usize| *at != statistics && table.columns[*at].meaning.kind == Kind::Skip;
    let names: Vec<usize> = (0..table.columns.len()).filter(is_name).collect();
    let label = |row: usize| -> Vec<&str> {
        names.iter().filter_map(|at| Some(table.rows[row].get(*at)?.text.as_str())).collect()
    };
    let mut groups: Vec<Vec<(usize, Statistic)>> = Vec::new();
    for row in 0..table.rows.len() {
        let cell = table.rows[row].get(statistics);
        let Some(statistic) = cell.and_then(|cell| Statistic::named(&cell.text)) else { continue };
        let is_more = |group: &&mut Vec<(usize, Statistic)>| {
            group.iter().all(|(_, known)| *known != statistic)
                && group.first().is_none_or(|(first, _)| label(*first) == label(row))
        };
        match groups.last_mut().filter(is_more) {
            Some(group) => group.push((row, statistic)),
            None => groups.push(vec![(row, statistic)]),
        }
    }
    for named in &groups {
        for (at, column) in table.columns.iter().enumerate() {
            if at == statistics || matches!(column.meaning.kind, Kind::Skip) {
                continue;
            }
            let numbers: Vec<_> = named
                .iter()
                .filter_map(|&(row, statistic)| Some((statistic, quoted(index, table, row, at)?)))
                .collect();
            if !numbers.is_empty() {
                let mut sample = of_meaning(&column.name, &column.meaning, number(&column.meaning), numbers);
                sample.path = format!("{}/{}", table.name, column.name);
                give(&sample);
            }
        }
    }
}

/// A group of columns whose numbers in one row are statistics of the same values.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// What the values are called.
    pub name: String,
    /// The columns, each with its statistic.
    pub columns: Vec<(usize, Statistic)>,
}

impl Group {
    /// What its columns say of the values together: the mean's column first.
    fn meaning(&self, columns: &[Column]) -> Meaning {
        let mut order = self.columns.clone();
        order.sort_by_key(|(_, statistic)| *statistic != Statistic::Mean);
        let mut meanings = order.into_iter().map(|(at, _)| &columns[at].meaning);
        let mut all = meanings.next().cloned().unwrap_or_default();
        meanings.for_each(|other| all.fill_from(other));
        all
    }
}

/// The columns whose numbers belong together in a row: those with one `of=` or one name. A group ends before the column
/// that repeats a statistic, since that one belongs to other values.
pub fn groups(columns: &[Column]) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for (at, Column { name, meaning, .. }) in columns.iter().enumerate() {
        let statistic = match meaning.kind {
            Kind::Statistic(statistic) => statistic,
            Kind::Share { .. } => Statistic::Mean,
            _ => continue,
        };
        let key = meaning.of.as_ref().unwrap_or(name);
        let last = groups.iter_mut().rev().find(|group| group.name == *key);
        match last.filter(|group| group.columns.iter().all(|(_, known)| *known != statistic)) {
            Some(group) => group.columns.push((at, statistic)),
            None => groups.push(Group { name: key.clone(), columns: vec![(at, statistic)] }),
        }
    }
    groups
}

/// Samples whose statistics stand in one row.
fn in_row(
    index: usize,
    table: &Table,
    row: usize,
    groups: &[(Group, Meaning)],
    give: &mut dyn FnMut(&Sample),
) {
    for (group, meaning) in groups {
        let mut numbers = Vec::new();
        for (at, statistic) in &group.columns {
            let Some(number) = quoted(index, table, row, *at) else { continue };
            let spread = table.rows[row][*at].spread.map(|printed| Quoted {
                name: format!("spread of {}", number.name),
                print: Print { printed, digits: table.columns[*at].meaning.digits },
                cell: None,
                ..number.clone()
            });
            numbers.push((*statistic, number));
            numbers.extend(table.columns[*at].meaning.spread.zip(spread));
        }
        if !numbers.is_empty() {
            let fraction = group.columns.iter().find_map(|(at, _)| table.rows[row][*at].k_of_n);
            let n = count(table, row, group.columns[0].0, meaning).or(fraction.map(|[_, n]| n));
            let name = format!("{} of {}", group.name, table.row_name(row));
            let mut sample = of_meaning(&name, meaning, n, numbers);
            sample.successes = fraction.filter(|[_, of]| n == Some(*of) && !sample.is_count).map(|[k, _]| k);
            give(&sample);
        }
    }
}

/// How many trials or values: written in the header, or in a column of the row.
fn count(table: &Table, row: usize, by: usize, meaning: &Meaning) -> Option<u64> {
    match meaning.n.as_ref()? {
        Count::Number(n) => Some(*n),
        Count::Column(name) => {
            let value = table.rows[row].get(named_by(&table.columns, by, name)?)?.value?;
            (value.decimals() == 0).then(|| u64::try_from(value.units()).ok()).flatten().filter(|n| *n > 0)
        }
    }
}
