//! Counts that are read with their limits: a size that nobody can mean is refused where it is written, before anything of
//! that size is made.

use serde::{Deserialize, Deserializer, de::Error as _};
use std::fmt::Display;
use toml::Spanned;

/// A count or several.
pub trait Counted {
    /// The first of its counts that is not in `least..=most`.
    fn outside(&self, least: u64, most: u64) -> Option<u64>;
}

macro_rules! counted {
    ($($whole:ty),*) => {
        $(impl Counted for $whole {
            fn outside(&self, least: u64, most: u64) -> Option<u64> {
                let count = *self as u64;
                (!(least..=most).contains(&count)).then_some(count)
            }
        })*
    };
}

counted!(u8, u32, u64, usize);

impl<T: Counted> Counted for Option<T> {
    fn outside(&self, least: u64, most: u64) -> Option<u64> {
        self.as_ref()?.outside(least, most)
    }
}

impl<T: Counted> Counted for Spanned<T> {
    fn outside(&self, least: u64, most: u64) -> Option<u64> {
        self.get_ref().outside(least, most)
    }
}

impl<T: Counted, const N: usize> Counted for [T; N] {
    fn outside(&self, least: u64, most: u64) -> Option<u64> {
        self.iter().find_map(|count| count.outside(least, most))
    }
}

/// Reads counts from `LEAST` to `MOST`: `#[serde(deserialize_with = "count::<1, 1000, _, _>")]`.
///
/// # Errors
/// A count beyond them, with both limits.
pub fn count<'de, const LEAST: u64, const MOST: u64, D, T>(deserializer: D) -> Result<T, D::Error>
where
    D: Deserializer<'de>,
    T: Counted + Deserialize<'de>,
{
    let read = T::deserialize(deserializer)?;
    match read.outside(LEAST, MOST) {
        None => Ok(read),
        Some(found) => Err(D::Error::custom(beyond(found, LEAST, MOST))),
    }
}

/// What is said of a count that is not in `least..=most`.
fn beyond(found: impl Display, least: u64, most: u64) -> String {
    format!("found {found}; a whole number from {least} to {most} is accepted")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::Document;
    use std::path::Path;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Sizes {
        #[serde(deserialize_with = "count::<1, 10, _, _>")]
        side: u32,
        #[serde(default, deserialize_with = "count::<0, 1000, _, _>")]
        most: Option<Spanned<u64>>,
        #[serde(default, deserialize_with = "count::<2, 9, _, _>")]
        pair: Option<[usize; 2]>,
    }

    fn read(text: &str) -> Result<Sizes, String> {
        Document::new(Path::new("a.toml"), text.to_owned()).read().map_err(|e| e.to_string())
    }

    #[test]
    fn a_count_beyond_its_limits_is_refused_at_its_line_with_both() {
        for (text, said) in [
            ("side = 11", "a.toml:1:8: found 11; a whole number from 1 to 10 is accepted"),
            ("side = 0", "a.toml:1:8: found 0; a whole number from 1 to 10 is accepted"),
            ("side = 1\nmost = 4000000000", "a.toml:2:8: found 4000000000; a whole number from 0 to 1000"),
            ("side = 1\npair = [2, 10]", "a.toml:2:8: found 10; a whole number from 2 to 9"),
            ("side = -1", "a.toml:1:8: invalid value: integer `-1`"),
        ] {
            let refused = read(text).unwrap_err();
            assert!(refused.starts_with(said), "{text}: {refused}");
        }
    }

    #[test]
    fn counts_at_their_limits_and_absent_ones_are_read() {
        let whole = read("side = 10\nmost = 0\npair = [2, 9]").unwrap();
        assert_eq!(
            (whole.side, whole.most.map(Spanned::into_inner), whole.pair),
            (10, Some(0), Some([2, 9]))
        );
        let bare = read("side = 1").unwrap();
        assert!(bare.most.is_none() && bare.pair.is_none());
    }
}
