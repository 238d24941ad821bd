//! Keys of relations that several checks have, each with its meaning.

/// A key and what it means.
pub type Key = (&'static str, &'static str);

pub const N: Key = ("n", "How many values are behind it, a whole number.");
pub const GRAIN: Key =
    ("grain", "What each value is a multiple of, in quotes if no whole number; 1 if absent.");
pub const LEAST: Key =
    ("least", "The least value that there can be, in quotes if no whole number; any if absent.");
pub const MOST: Key =
    ("most", "The greatest value that there can be, in quotes if no whole number; any if absent.");
pub const MEAN: Key = ("mean", "The mean, in quotes: the printed number, or the name of a cell.");
pub const SD: Key = (
    "sd",
    "The standard deviation, in quotes: the printed number, or the name of a cell; given like this or as `se`.",
);
pub const SE: Key = (
    "se",
    "The standard error of the mean, in quotes: the printed number, or the name of a cell; given like this or as `sd`.",
);
pub const DIVISOR: Key =
    ("divisor", "What the variance divides by: `sample`, n - 1; `population`, n; `either` if absent.");
pub const FROM: Key = ("from", "The start \"X:Y\", in cells.");
pub const TO: Key = ("to", "The goal \"X:Y\", in cells.");
pub const TURNS: Key =
    ("turns", "The sum of turns in degrees, in quotes: the printed number, or the name of a cell.");
pub const LENGTH: Key =
    ("length", "The path's length in cells, in quotes: the printed number, or the name of a cell.");
pub const OF_PATH: Key =
    ("value", "The path's length in cells, in quotes: the printed number, or the name of a cell.");
