//! Certificates: what a finding of impossibility rests on, as a small JSON document that another program can verify.
//!
//! A certificate has the check's name, the printed numbers with the reading of their digits, what was given besides, the
//! premises in words, and the steps. Integers and rationals are exact: rationals are texts such as `3/8`.
//! `crosscheck/certificates` verifies them with nothing but Python's `fractions`.

use super::checks::arguments::json_span;
use super::checks::{Proof, Test};
use proofs::exact::Print;
use serde_json::{Value, json};

/// The value of the field `format`.
pub const FORMAT: &str = "replan audit certificate 1";

/// The certificate of `proof`.
pub fn certificate(check: &str, test: &dyn Test, prints: &[Print], proof: &Proof) -> Value {
    let numbers = test.numbers().iter().zip(prints).map(|(number, print)| {
        json!({
            "name": number.name,
            "printed": print.printed.to_string(),
            "significant": print.printed.significant(),
            "digits": print.digits.name(),
            "span": json_span(&print.span()),
        })
    });
    json!({
        "format": FORMAT,
        "check": check,
        "premises": test.premises(),
        "numbers": numbers.collect::<Vec<_>>(),
        "given": proof.given,
        "steps": proof.steps,
    })
}
