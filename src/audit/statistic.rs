//! Statistics of a sample, and the words that name them.

use proofs::exact::{self, whole};

/// A statistic of a sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Statistic {
    /// The least value.
    Min,
    /// The quantile at a share in ten-thousandths.
    Quantile(u32),
    /// The greatest value.
    Max,
    /// The arithmetic mean.
    Mean,
    /// The standard deviation.
    Sd,
    /// The standard error of the mean.
    Se,
    /// The sum.
    Total,
}

impl Statistic {
    /// The words that are known, for messages.
    pub const WORDS: &str = "mean, sd, se, min, q1, median, q3, max, total, and quantiles as 5% or q95";

    /// The statistic that a word such as `mean`, `std`, `25%`, `q95` names; `q1` to `q3` are quartiles.
    pub fn named(word: &str) -> Option<Self> {
        let word = word.trim().to_lowercase();
        Some(match word.as_str() {
            "mean" | "avg" | "avg." | "average" => Self::Mean,
            "sd" | "std" | "std." | "stdev" | "stddev" => Self::Sd,
            "se" | "sem" => Self::Se,
            "min" | "minimum" => Self::Min,
            "max" | "maximum" => Self::Max,
            "q1" => Self::Quantile(2500),
            "median" | "q2" => Self::Quantile(5000),
            "q3" => Self::Quantile(7500),
            "total" | "sum" => Self::Total,
            other => {
                let share = other.strip_suffix('%').or_else(|| other.strip_prefix('q'))?;
                let share =
                    exact::parse(share.trim()).filter(|share| *share > whole(0) && *share < whole(100))?;
                let parts = exact::mul(share, whole(100)).filter(|parts| *parts.denom() == 1)?;
                Self::Quantile(u32::try_from(*parts.numer()).ok()?)
            }
        })
    }

    /// In words.
    pub fn name(self) -> String {
        match self {
            Self::Min => "minimum".to_owned(),
            Self::Max => "maximum".to_owned(),
            Self::Mean => "mean".to_owned(),
            Self::Sd => "standard deviation".to_owned(),
            Self::Se => "standard error".to_owned(),
            Self::Total => "total".to_owned(),
            Self::Quantile(5000) => "median".to_owned(),
            Self::Quantile(parts) => format!("{} % quantile", f64::from(parts) / 100.0),
        }
    }
}
