//! Inputs printed from simulated data, each number by the rounding of its column, in exact integers throughout: tables with a row a
//! planner, tables with a row a statistic, and relations.

mod long;
mod relations;
mod summaries;
mod wide;

use proofs::exact::{Exact, whole};
use proofs::printed::Printed;
use rand::{RngExt, SeedableRng, rngs::SmallRng};
use replan_audit::reader::Format;

/// Every way to end digits that a program can have.
pub const ROUNDINGS: [&str; 5] = ["half up", "half even", "floor", "ceiling", "truncation"];

/// The input of a seed.
pub fn input(seed: u64) -> (String, Format) {
    let mut rng = SmallRng::seed_from_u64(seed);
    match seed % 4 {
        0 | 1 if rng.random_bool(0.2) => (summaries::table(&mut rng), Format::Markdown),
        0 | 1 => (wide::table(&mut rng), Format::Markdown),
        2 => (long::table(&mut rng), Format::Markdown),
        _ => (relations::document(&mut rng), Format::Toml),
    }
}

/// How a column prints its numbers.
#[derive(Clone)]
struct Style {
    rounding: &'static str,
    decimals: u32,
    /// That many digits count, and zeros at the end are left out.
    significant: Option<usize>,
    is_written: bool,
}

impl Style {
    fn drawn(rng: &mut SmallRng) -> Self {
        let significant = rng.random_bool(0.15).then_some(6);
        Self { significant, ..Self::plain(rng) }
    }

    /// One that leaves no zeros out.
    fn plain(rng: &mut SmallRng) -> Self {
        let rounding = ROUNDINGS[rng.random_range(0..5)];
        Self {
            rounding,
            decimals: rng.random_range(0..4),
            significant: None,
            is_written: rng.random_bool(0.5),
        }
    }

    /// The same with other decimals.
    fn other(&self, rng: &mut SmallRng) -> Self {
        Self { decimals: rng.random_range(0..4), ..self.clone() }
    }

    /// What the annotation says of it.
    fn annotation(&self) -> String {
        let rounding = if self.is_written { format!(", rounding={}", self.rounding) } else { String::new() };
        rounding + &self.significant.map_or(String::new(), |digits| format!(", digits={digits}"))
    }

    fn value(&self, value: Exact) -> String {
        self.ratio(*value.numer(), *value.denom())
    }

    /// `above / below` as it is printed; `below` is above 0.
    fn ratio(&self, above: i128, below: i128) -> String {
        self.printed(|decimals| {
            let scaled = above * 10_i128.pow(decimals);
            let down = scaled.div_euclid(below);
            let rest = scaled.rem_euclid(below);
            self.units(down, rest > 0, (2 * rest).cmp(&below))
        })
    }

    /// The root of `above / below` as it is printed.
    fn root(&self, above: i128, below: i128) -> String {
        self.printed(|decimals| {
            let scale = 10_i128.pow(2 * decimals);
            let down = (above * scale / below).isqrt();
            let middle = (2 * down + 1) * (2 * down + 1) * below;
            self.units(down, down * down * below < above * scale, (4 * above * scale).cmp(&middle))
        })
    }

    /// The printed units next to `down` of them; `has_rest` if the value is above them, `tie` how it compares with the middle.
    fn units(&self, down: i128, has_rest: bool, tie: std::cmp::Ordering) -> i128 {
        let is_up = match self.rounding {
            // Away from 0, whose other side has the larger absolute value below.
            "half up" => {
                if down < 0 {
                    tie.is_gt()
                } else {
                    tie.is_ge()
                }
            }
            "half even" => tie.is_gt() || tie.is_eq() && down.rem_euclid(2) == 1,
            "ceiling" => has_rest,
            "truncation" => has_rest && down < 0,
            _ => false,
        };
        down + i128::from(is_up)
    }

    fn printed(&self, units: impl Fn(u32) -> i128) -> String {
        let text =
            |decimals| Printed::from_units(i64::try_from(units(decimals)).unwrap(), decimals).to_string();
        let Some(significant) = self.significant else { return text(self.decimals) };
        let length = |units: i128| units.abs().to_string().len();
        let decimals = (0..=11).rev().find(|decimals| length(units(*decimals)) <= significant).unwrap();
        let text = text(decimals);
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    }
}

/// Sum and n times the sum of squared deviations.
fn moments(values: &[i128]) -> (i128, i128) {
    let n = values.len() as i128;
    let sum = values.iter().sum::<i128>();
    (sum, n * values.iter().map(|x| x * x).sum::<i128>() - sum * sum)
}

/// `n` whole numbers in rising order, sometimes all alike, sometimes spread out, sometimes below 0.
fn values(rng: &mut SmallRng, n: i128) -> Vec<i128> {
    let most = [0, 1, 3, 20, 1000][rng.random_range(0..5)];
    let shift = if rng.random_bool(0.3) { rng.random_range(-1000..=0) } else { 0 };
    let mut values: Vec<i128> = (0..n).map(|_| shift + rng.random_range(0..=most)).collect();
    values.sort_unstable();
    values
}

/// The quantile of rising values by one of Hyndman and Fan's nine rules; the seventh is linear.
fn quantile(values: &[Exact], share: Exact, rule: usize) -> Exact {
    let offset = match rule {
        3 => Exact::new(-1, 2),
        1 | 2 | 4 => whole(0),
        5 => Exact::new(1, 2),
        6 => share,
        7 => whole(1) - share,
        8 => (share + whole(1)) / whole(3),
        _ => share / whole(4) + Exact::new(3, 8),
    };
    let place = whole(values.len() as i128) * share + offset;
    let at = place.floor();
    let rest = place - at;
    let value = |at: Exact| values[(at.to_integer() - 1).clamp(0, values.len() as i128 - 1) as usize];
    let weight = match rule {
        1 => {
            if rest > whole(0) {
                whole(1)
            } else {
                whole(0)
            }
        }
        2 => {
            if rest > whole(0) {
                whole(1)
            } else {
                Exact::new(1, 2)
            }
        }
        3 => {
            if rest == whole(0) && at.to_integer() % 2 == 0 {
                whole(0)
            } else {
                whole(1)
            }
        }
        _ => rest,
    };
    value(at) * (whole(1) - weight) + value(at + whole(1)) * weight
}

/// Columns with as many cells as there are rows.
struct Sheet {
    rows: usize,
    columns: Vec<(String, Vec<String>)>,
}

impl Sheet {
    fn add(&mut self, header: String, cells: Vec<String>) {
        assert_eq!(cells.len(), self.rows, "{header}");
        self.columns.push((header, cells));
    }

    fn markdown(&self) -> String {
        let line = |cells: Vec<&str>| format!("| {} |\n", cells.join(" | "));
        let header = line(self.columns.iter().map(|(header, _)| header.as_str()).collect());
        let rows = (0..self.rows)
            .map(|row| line(self.columns.iter().map(|(_, cells)| cells[row].as_str()).collect()));
        format!("{header}{}|\n{}", "|-".repeat(self.columns.len()), rows.collect::<String>())
    }
}

/// Moves to one of eight neighbours. Printed of them: the straight and the diagonal ones, the displacement and the turns.
struct Walk {
    moves: Vec<[i128; 2]>,
}

impl Walk {
    fn drawn(rng: &mut SmallRng, most: usize) -> Self {
        let count = rng.random_range(1..=most);
        let drawn = (0..count).map(|_| [rng.random_range(-1..=1), rng.random_range(-1..=1)]);
        let moves: Vec<[i128; 2]> = drawn.filter(|step| *step != [0, 0]).collect();
        if moves.is_empty() { Self { moves: vec![[1, 1]] } } else { Self { moves } }
    }

    fn straight(&self) -> i128 {
        self.moves.iter().filter(|step| step.contains(&0)).count() as i128
    }

    fn diagonal(&self) -> i128 {
        self.moves.len() as i128 - self.straight()
    }

    fn end(&self) -> [i128; 2] {
        [0, 1].map(|axis| self.moves.iter().map(|step| step[axis]).sum())
    }

    /// The sum of changes of direction, or of the angles between moves that differ, in degrees.
    fn turns(&self, is_interior: bool) -> i128 {
        const AROUND: [[i128; 2]; 8] = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]];
        let at = |step: &[i128; 2]| AROUND.iter().position(|known| known == step).unwrap() as i128;
        let change = |pair: &[[i128; 2]]| {
            let apart = (at(&pair[0]) - at(&pair[1])).abs();
            apart.min(8 - apart)
        };
        let changes = self.moves.windows(2).map(change).filter(|change| *change > 0);
        changes.map(|change| 45 * if is_interior { 4 - change } else { change }).sum()
    }

    /// Its length as it is printed, with diagonal moves of √2.
    fn length(&self, style: &Style) -> String {
        let straight = self.straight();
        let diagonal = self.diagonal();
        style.printed(|decimals| {
            let scale = 10_i128.pow(decimals);
            let root = 2 * diagonal * diagonal * scale * scale;
            let down = straight * scale + root.isqrt();
            // The length is whole or irrational, so that it never lies in the middle.
            let doubled = 2 * straight * scale + (4 * root).isqrt();
            let tie = if doubled > 2 * down { std::cmp::Ordering::Greater } else { std::cmp::Ordering::Less };
            style.units(down, diagonal > 0, tie)
        })
    }
}
