//! Ways to damage a file.

use base::seed::Stream;
use rand::RngExt as _;
use std::ops::Range;

/// What stands in place of a number.
const NUMBERS: [&str; 26] = [
    "0",
    "-0",
    "1",
    "-1",
    "2",
    "-2",
    "255",
    "256",
    "65535",
    "65536",
    "70000",
    "2147483647",
    "4000000000",
    "4294967296",
    "9223372036854775807",
    "18446744073709551615",
    "0.5",
    "-0.0",
    "1e-300",
    "5e-324",
    "1e308",
    "-1e308",
    "inf",
    "-inf",
    "nan",
    "1e400",
];

/// What stands in place of a value of any kind.
const VALUES: [&str; 12] = [
    "[]",
    "[[]]",
    "{}",
    "\"\"",
    "true",
    "\"nan\"",
    "[1, 2]",
    "[0.0, 0.0, 0.0]",
    "\"..\"",
    "\"\\u0000\"",
    "[\"\"]",
    "1979-05-27",
];

/// `bytes` with one damage, rarely with several; which ones follows from `stream`.
pub fn damaged(stream: &mut Stream, bytes: &[u8]) -> Vec<u8> {
    let times = if stream.random_range(0..5) == 0 { stream.random_range(2..=4) } else { 1 };
    let mut damaged = bytes.to_vec();
    for _ in 0..times {
        damaged = match stream.random_range(0..12) {
            0 => flipped(stream, damaged),
            1 => damaged[..stream.random_range(0..=damaged.len())].to_vec(),
            2..=4 => of_lines(stream, &damaged),
            kind => of_text(stream, &damaged, kind),
        };
    }
    damaged
}

/// What opens a list, a table or an element in some form.
const OPENINGS: [&str; 6] = ["[", "{\"a\":", "{a: ", "- ", "<link>", "[["];

/// What no text begins with, or no text holds.
const ODD_BYTES: [&[u8]; 5] = [b"\xff", b"\0", b"\xef\xbb\xbf", b"\xc3", b"\x1b[2J"];

/// `bytes` with one damage of [`damaged`], or, once in ten times, with one of form and size: a long name, thousands of openings, keys or
/// pieces, bytes of no text.
pub fn misshapen(stream: &mut Stream, bytes: &[u8]) -> Vec<u8> {
    let times = |stream: &mut Stream| [30, 300, 3000][stream.random_range(0..3)];
    let at = stream.random_range(0..=bytes.len());
    let new = match stream.random_range(0..50) {
        0 => "x".repeat(times(stream)).into_bytes(),
        1 => OPENINGS[stream.random_range(0..OPENINGS.len())].repeat(10 * times(stream)).into_bytes(),
        2 => bytes[at..bytes.len().min(at + stream.random_range(1..40))].repeat(times(stream)),
        3 => (0..times(stream)).flat_map(|key| format!("\"k{key}\": 0,\n").into_bytes()).collect(),
        4 => ODD_BYTES[stream.random_range(0..ODD_BYTES.len())].to_vec(),
        _ => return damaged(stream, bytes),
    };
    [&bytes[..at], &new, &bytes[at..]].concat()
}

/// Up to four bytes flipped, or bytes that no text has put in.
pub fn flipped(stream: &mut Stream, mut bytes: Vec<u8>) -> Vec<u8> {
    for _ in 0..stream.random_range(1..=4) {
        if !bytes.is_empty() {
            let at = stream.random_range(0..bytes.len());
            bytes[at] ^= 1 << stream.random_range(0..8);
        }
    }
    bytes
}

/// A line gone, a line twice, or two lines in each other's place.
fn of_lines(stream: &mut Stream, bytes: &[u8]) -> Vec<u8> {
    let mut lines: Vec<&[u8]> = bytes.split_inclusive(|byte| *byte == b'\n').collect();
    if lines.is_empty() {
        return Vec::new();
    }
    let [at, other] = [0; 2].map(|_| stream.random_range(0..lines.len()));
    match stream.random_range(0..3) {
        0 => drop(lines.remove(at)),
        1 => lines.insert(other, lines[at]),
        _ => lines.swap(at, other),
    }
    lines.concat()
}

/// A number, string or value in place of another.
fn of_text(stream: &mut Stream, bytes: &[u8], kind: usize) -> Vec<u8> {
    let places = match kind {
        5..=7 => numbers(bytes),
        8 | 9 => strings(bytes),
        _ => values(bytes),
    };
    if places.is_empty() {
        return flipped(stream, bytes.to_vec());
    }
    let [one, other] = [0; 2].map(|_| places[stream.random_range(0..places.len())].clone());
    let new = match kind {
        5 | 6 => NUMBERS[stream.random_range(0..NUMBERS.len())].as_bytes(),
        10 => VALUES[stream.random_range(0..VALUES.len())].as_bytes(),
        _ => &bytes[other],
    };
    [&bytes[..one.start], new, &bytes[one.end..]].concat()
}

/// Where numbers stand.
pub fn numbers(bytes: &[u8]) -> Vec<Range<usize>> {
    runs(
        bytes,
        |byte| byte.is_ascii_digit() || b".-+_".contains(&byte),
        |run| run.iter().any(u8::is_ascii_digit),
    )
}

/// Where strings stand, with their quotes: of one line, without escapes, which is nearly all of them.
fn strings(bytes: &[u8]) -> Vec<Range<usize>> {
    let quotes: Vec<usize> = (0..bytes.len()).filter(|at| bytes[*at] == b'"').collect();
    let is_one_line = |range: &Range<usize>| !bytes[range.clone()].contains(&b'\n');
    quotes.chunks_exact(2).map(|pair| pair[0]..pair[1] + 1).filter(is_one_line).collect()
}

/// Where values stand: what is between `=` and the end of the line.
fn values(bytes: &[u8]) -> Vec<Range<usize>> {
    let mut at = 0;
    let mut found = Vec::new();
    for line in bytes.split_inclusive(|byte| *byte == b'\n') {
        let end = at + line.trim_ascii_end().len();
        if let Some(equals) = line.iter().position(|byte| *byte == b'=') {
            found.extend((at + equals < end).then(|| at + equals + 1..end));
        }
        at += line.len();
    }
    found
}

/// The longest runs of bytes that are `part`, of those that are `whole`.
fn runs(bytes: &[u8], part: impl Fn(u8) -> bool, whole: impl Fn(&[u8]) -> bool) -> Vec<Range<usize>> {
    let mut at = 0;
    let mut found = Vec::new();
    for run in bytes.chunk_by(|a, b| part(*a) == part(*b)) {
        if part(run[0]) && whole(run) {
            found.push(at..at + run.len());
        }
        at += run.len();
    }
    found
}
