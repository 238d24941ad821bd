//! Axes: how numbers become positions and where ticks stand.

use crate::render::RenderError;
use crate::render::canvas::Type;
use crate::render::style::TextSize;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use std::array;
use std::ops::Range;

/// The least and the greatest of each coordinate of `points`; infinite, the least above, if there are none.
pub fn bounds<const N: usize>(points: impl IntoIterator<Item = [f64; N]>) -> [[f64; N]; 2] {
    points.into_iter().fold([[f64::INFINITY; N], [f64::NEG_INFINITY; N]], |[low, high], point| {
        let with =
            |ends: [f64; N], pick: fn(f64, f64) -> f64| array::from_fn(|axis| pick(ends[axis], point[axis]));
        [with(low, f64::min), with(high, f64::max)]
    })
}

/// One axis of a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    label: String,
    low: f64,
    high: f64,
    scale: Scale,
    /// Ticks of a linear axis stand no closer than this.
    least_step: f64,
}

#[derive(Clone, Debug, PartialEq)]
enum Scale {
    Linear,
    Log,
    Names(Vec<String>),
}

/// A tick: where it stands and what it says (nothing for a minor tick).
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Position in data units.
    pub at: f64,
    /// Text beside it.
    pub label: String,
}

impl Axis {
    /// An even axis from `low` to `high`; `label` carries the unit, as in `time / s`.
    ///
    /// # Errors
    /// [`RenderError::Axis`] unless both ends are finite and `low < high`.
    pub fn linear(label: impl Into<String>, low: f64, high: f64) -> Result<Self, RenderError> {
        Self::checked(label.into(), low, high, Scale::Linear)
    }

    /// A logarithmic axis from `low` to `high`.
    ///
    /// # Errors
    /// [`RenderError::Axis`] unless both ends are finite and `0 < low < high`.
    pub fn log(label: impl Into<String>, low: f64, high: f64) -> Result<Self, RenderError> {
        Self::checked(label.into(), low, high, Scale::Log)
    }

    /// An axis of names; name `i` stands at `i`, with half a step of margin at either end.
    pub fn names<S: Into<String>>(label: impl Into<String>, names: impl IntoIterator<Item = S>) -> Self {
        let names: Vec<String> = names.into_iter().map(Into::into).collect();
        Self {
            label: label.into(),
            low: -0.5,
            high: names.len().max(1) as f64 - 0.5,
            scale: Scale::Names(names),
            least_step: 0.0,
        }
    }

    /// A linear axis over `values` and a margin of 4 %; over `[0, 1]` if there is no finite value.
    pub fn over(label: impl Into<String>, values: impl IntoIterator<Item = f64>) -> Self {
        let finite = values.into_iter().filter(|value| value.is_finite());
        let [[mut low], [mut high]] = bounds(finite.map(|value| [value]));
        if low > high {
            (low, high) = (0.0, 1.0);
        }
        let spread = high - low;
        let margin = if spread > 0.0 { 0.04 * spread } else { low.abs().max(1.0) * 0.1 };
        let (low, high) = (low - margin, high + margin);
        Self { label: label.into(), low, high, scale: Scale::Linear, least_step: 0.0 }
    }

    /// The same linear axis with ticks at whole numbers only.
    #[must_use]
    pub fn whole(self) -> Self {
        Self { least_step: 1.0, ..self }
    }

    /// The same axis turned around: its values fall from left to right or from bottom to top.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self { low: self.high, high: self.low, ..self }
    }

    fn checked(label: String, from: f64, to: f64, scale: Scale) -> Result<Self, RenderError> {
        let log = scale == Scale::Log;
        if from.is_finite() && to.is_finite() && from < to && (!log || from > 0.0) {
            return Ok(Self { label, low: from, high: to, scale, least_step: 0.0 });
        }
        let accepted = if log {
            "it must rise from above 0 to a finite end"
        } else {
            "it must rise between finite ends"
        };
        Err(RenderError::Axis { axis: label, from, to, accepted })
    }

    /// Text beside the axis.
    pub fn label(&self) -> &str {
        &self.label
    }

    /// Lower and upper end in data units (swapped if the axis is reversed).
    pub fn ends(&self) -> [f64; 2] {
        [self.low, self.high]
    }

    /// How far along the axis `value` lies: 0 at its start, 1 at its end.
    pub fn share(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Log => libm::log(value / self.low) / libm::log(self.high / self.low),
            Scale::Linear | Scale::Names(_) => (value - self.low) / (self.high - self.low),
        }
    }

    /// Ticks for an axis `length_pt` long, so few that labels along it stay apart.
    ///
    /// `sideways` says that labels follow each other along the axis, as they do on a horizontal one.
    pub fn ticks(&self, length_pt: f64, sideways: bool) -> Vec<Tick> {
        match &self.scale {
            Scale::Names(names) => {
                let named = names.iter().enumerate();
                named.map(|(index, name)| Tick { at: index as f64, label: name.clone() }).collect()
            }
            Scale::Log => self.log_ticks(),
            Scale::Linear => {
                let most = (length_pt / if sideways { 18.0 } else { 15.0 }).clamp(2.0, 9.0) as usize;
                let fits = |ticks: &Vec<Tick>| !sideways || self.fits(ticks, length_pt);
                let found = (2..=most).rev().map(|count| self.even_ticks(count)).find(fits);
                let found = found.unwrap_or_else(|| self.even_ticks(2));
                // A single tick says nothing of the scale: closer ones are tried as long as they fit.
                let closer = (3..=9).map(|count| self.even_ticks(count)).filter(fits);
                let closer = closer.into_iter().find(|ticks| ticks.len() > 1).filter(|_| found.len() < 2);
                closer.unwrap_or(found)
            }
        }
    }

    /// Whether labels of `ticks` fit side by side on `length_pt`.
    pub(super) fn fits(&self, ticks: &[Tick], length_pt: f64) -> bool {
        let set = Type::regular(TextSize::TICK);
        let mut spans: Vec<(f64, f64)> = ticks
            .iter()
            .filter(|tick| !tick.label.is_empty())
            .map(|tick| (self.share(tick.at) * length_pt, set.width_pt(&tick.label) / 2.0 + 3.0))
            .collect();
        spans.sort_by(|a, b| a.0.total_cmp(&b.0));
        spans.windows(2).all(|pair| pair[0].0 + pair[0].1 <= pair[1].0 - pair[1].1)
    }

    fn even_ticks(&self, most: usize) -> Vec<Tick> {
        let (low, high) = (self.low.min(self.high), self.low.max(self.high));
        let (step, decimals) = nice_step(((high - low) / most as f64).max(self.least_step));
        let slack = step * 1e-9;
        let (first, last) = (((low - slack) / step).ceil() as i64, ((high + slack) / step).floor() as i64);
        (first..=last)
            .map(|index| index as f64 * step)
            .map(|at| Tick { at, label: number(at, decimals) })
            .collect()
    }

    fn log_ticks(&self) -> Vec<Tick> {
        let (low, high) = (self.low.min(self.high), self.low.max(self.high));
        let decades = libm::log10(high / low);
        let mut ticks = Vec::new();
        for power in libm::log10(low).floor() as i32..=libm::log10(high).ceil() as i32 {
            for digit in 1..10 {
                let at = f64::from(digit) * libm::pow(10.0, f64::from(power));
                let named = digit == 1 || (decades < 2.0 && matches!(digit, 2 | 5));
                if (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(&at) {
                    let label = if named { power_label(digit, power) } else { String::new() };
                    ticks.push(Tick { at, label });
                }
            }
        }
        ticks
    }
}

/// An axis is a coordinate of plotters, in place of that crate's own linear and logarithmic ones. Those draw an infinite value on
/// the edge of the frame as if it were finite and panic far outside it. They choose ticks that miss an end of the axis by a
/// rounding error (±0.5) or name a decade twice.
impl Ranged for Axis {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let along = self.share(*value) * f64::from(limit.1 - limit.0);
        limit.0.saturating_add(along.round() as i32)
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        let ticks = match self.scale {
            Scale::Linear => self.even_ticks(hint.max_num_points()),
            Scale::Log | Scale::Names(_) => self.ticks(0.0, false),
        };
        ticks.into_iter().map(|tick| tick.at).collect()
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

/// The least of 1, 2 and 5 times a power of ten that is not below `rough`, and the decimals it needs.
fn nice_step(rough: f64) -> (f64, usize) {
    let power = libm::log10(rough).floor() as i32;
    for power in [power, power + 1] {
        for digit in [1.0, 2.0, 5.0] {
            let step = digit * libm::pow(10.0, f64::from(power));
            if step >= rough * (1.0 - 1e-9) {
                return (step, (-power).max(0) as usize);
            }
        }
    }
    (libm::pow(10.0, f64::from(power + 2)), 0)
}

fn power_label(digit: i32, power: i32) -> String {
    if (-3..=3).contains(&power) {
        return number(f64::from(digit) * libm::pow(10.0, f64::from(power)), (-power).max(0) as usize);
    }
    let raised: String = power
        .to_string()
        .chars()
        .map(|character| match character {
            '-' => '⁻',
            digit => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize - '0' as usize],
        })
        .collect();
    if digit == 1 { format!("10{raised}") } else { format!("{digit}·10{raised}") }
}

/// `value` with a true minus sign and, from 10 000 on, thin spaces between thousands.
pub fn number(value: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", value.abs());
    let negative = value < 0.0 && text.bytes().any(|byte| (b'1'..=b'9').contains(&byte));
    let (whole, rest) = text.split_at(text.find('.').unwrap_or(text.len()));
    let mut grouped = String::new();
    for (index, digit) in whole.chars().enumerate() {
        if whole.len() > 4 && index > 0 && (whole.len() - index).is_multiple_of(3) {
            grouped.push('\u{2009}');
        }
        grouped.push(digit);
    }
    format!("{}{grouped}{rest}", if negative { "−" } else { "" })
}

#[cfg(test)]
mod tests;
