//! Laws that hold for every input, tried on inputs from a written seed.

use base::seed;
use base::settings::Settings;
use proofs::printed::{Digits, Printed};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use study::slug;
use toml::{Table, Value};

fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 400,
        rng_seed: RngSeed::Fixed(1976),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

fn table() -> impl Strategy<Value = Table> {
    let value = prop_oneof![any::<i64>().prop_map(Value::from), "[a-z]{0,3}".prop_map(Value::from)];
    proptest::collection::btree_map("[a-e]", value, 0..5).prop_map(|entries| entries.into_iter().collect())
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn a_printed_number_reads_back_as_it_stands(
        sign in "-?",
        whole in 0_u64..1_000_000,
        fraction in "(\\.[0-9]{1,6})?",
    ) {
        let text = format!("{sign}{whole}{fraction}");
        let printed: Printed = text.parse().unwrap();
        let is_zero = text.bytes().all(|byte| b"-0.".contains(&byte));
        let shown = printed.to_string();
        prop_assert_eq!(&shown, if is_zero { text.trim_start_matches('-') } else { &text });
        prop_assert_eq!(printed.value(), text.parse::<f64>().unwrap());
        prop_assert_eq!(printed.decimals() as usize, fraction.len().saturating_sub(1));
    }

    #[test]
    fn a_number_agrees_with_its_own_printing_and_with_nothing_a_place_away(
        x in -1.0e4_f64..1.0e4,
        decimals in 0_usize..5,
    ) {
        let rounded: Printed = format!("{x:.decimals$}").parse().unwrap();
        prop_assert!(rounded.agrees(x, Digits::Rounded), "{} printed as {}", x, rounded);
        prop_assert!(rounded.agrees(x, Digits::Unknown));
        let place = 10_f64.powi(-(decimals as i32));
        let text = format!("{:.decimals$}", (x / place).trunc() * place);
        let truncated: Printed = text.parse().unwrap();
        prop_assert!(truncated.agrees(x, Digits::Truncated), "{} cut to {}", x, truncated);
        prop_assert!(truncated.agrees(x, Digits::Unknown));
        for far in [x + 2.01 * place, x - 2.01 * place] {
            for digits in [Digits::Rounded, Digits::Truncated, Digits::Unknown] {
                prop_assert!(!rounded.agrees(far, digits), "{} printed as {}", far, rounded);
            }
        }
    }

    #[test]
    fn a_slug_is_plain_and_a_slug_of_itself(label in "\\PC{0,20}") {
        let slugged = slug(&label);
        prop_assert!(slugged.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-'));
        prop_assert!(!slugged.starts_with('-') && !slugged.ends_with('-') && !slugged.contains("--"));
        prop_assert_eq!(slug(&slugged), slugged.clone());
        prop_assert_eq!(slug(&label.to_uppercase().to_lowercase()), slug(&label.to_uppercase()));
    }

    #[test]
    fn an_overlay_wins_where_it_speaks_and_is_silent_elsewhere(base in table(), over in table()) {
        let under = Settings::composed("spec", base.clone());
        let laid = under.overlaid(&over, "interpretation");
        let keys: std::collections::BTreeSet<&String> = base.keys().chain(over.keys()).collect();
        prop_assert_eq!(laid.table().len(), keys.len());
        for key in keys {
            prop_assert_eq!(laid.table().get(key), over.get(key).or(base.get(key)));
        }
        prop_assert_eq!(laid.overlaid(&over, "again"), laid.clone());
        prop_assert_eq!(under.overlaid(&base, "itself"), under);
    }

    #[test]
    fn seeds_tell_every_division_of_names_apart(text in "[a-z]{2,8}", cut in 1_usize..7, root in any::<u64>()) {
        let cut = cut.min(text.len() - 1);
        let (head, tail) = text.split_at(cut);
        let whole = seed::derive(root, &[&text]);
        prop_assert_ne!(seed::derive(root, &[head, tail]), whole);
        prop_assert_ne!(seed::derive(root.wrapping_add(1), &[&text]), whole);
        prop_assert_eq!(seed::derive(root, &[&text]), whole);
        prop_assert!(i64::try_from(whole).is_ok());
    }
}
