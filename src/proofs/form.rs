//! The range of a third number that follows from two printed cells: a quotient, a speed-up, a percentage reduction.

use super::exact::{Span, whole};

/// What a printed number says of two cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// `a / b`.
    Quotient,
    /// `a / b`, as "2 times as fast".
    Times,
    /// `a / b − 1`, as "once faster".
    TimesMore,
    /// `100 (a − b) / a` per cent.
    OfFirst,
    /// `100 (a − b) / b` per cent.
    OfSecond,
}

impl Form {
    /// Its name in findings and certificates.
    pub fn name(self) -> &'static str {
        match self {
            Self::Quotient | Self::Times => "a/b",
            Self::TimesMore => "a/b-1",
            Self::OfFirst => "100(a-b)/a",
            Self::OfSecond => "100(a-b)/b",
        }
    }

    /// What the cells allow it to be; none if a divisor may be 0, or if 128 bits do not suffice.
    pub fn span(self, a: &Span, b: &Span) -> Option<Span> {
        let less_one = || a.over(b)?.plus(&Span::point(whole(-1)));
        match self {
            Self::Quotient | Self::Times => a.over(b),
            Self::TimesMore => less_one(),
            Self::OfSecond => less_one()?.times(whole(100)),
            Self::OfFirst => b.over(a)?.times(whole(100))?.negated().plus(&Span::point(whole(100))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::exact::{Exact, Print};
    use super::super::printed::Digits;
    use super::*;

    fn span(text: &str, digits: Digits) -> Span {
        Print { printed: text.parse().unwrap(), digits }.span()
    }

    fn reduction(before: &str, after: &str, digits: Digits) -> Span {
        Form::OfFirst.span(&span(before, digits), &span(after, digits)).unwrap()
    }

    /// The reduction of the cells exactly as printed.
    fn as_printed(before: &str, after: &str) -> Exact {
        let point = |text: &str| {
            Span::point(Print { printed: text.parse().unwrap(), digits: Digits::Rounded }.value())
        };
        Form::OfFirst.span(&point(before), &point(after)).unwrap().low
    }

    #[test]
    fn the_grid_papers_eight_reductions_follow_from_its_cells() {
        for (before, after, percent) in [
            ("0.0018", "0.0015", "16.67"),
            ("0.0020", "0.0016", "20"),
            ("270.00", "229.17", "15.12"),
            ("315.00", "309.14", "1.86"),
            ("14.65", "13.40", "8.5"),
            ("17.56", "16.40", "6.6"),
            ("69", "45", "34.78"),
            ("89", "46", "48.31"),
        ] {
            let exact = as_printed(before, after);
            assert!(span(percent, Digits::Rounded).contains(exact), "{before} {after}: {exact}");
            let possible = reduction(before, after, Digits::Unknown);
            assert!(possible.meets(&span(percent, Digits::Unknown)), "{before} {after}: {possible:?}");
        }
        // The length that 12 + 4√2 truncates to would have given another percentage.
        assert!(!span("6.6", Digits::Unknown).contains(as_printed("17.65", "16.40")));
        assert!(span("7.08", Digits::Rounded).contains(as_printed("17.65", "16.40")));
        assert!(!reduction("17.65", "16.40", Digits::Unknown).meets(&span("6.6", Digits::Unknown)));
    }

    #[test]
    fn the_possible_reductions_are_those_of_the_cells_readings() {
        for (before, after) in
            [("14.65", "13.40"), ("5", "0"), ("2.0", "3.1"), ("1", "9"), ("-3", "1"), ("4", "-2")]
        {
            let possible = reduction(before, after, Digits::Rounded);
            let (from, to) = (span(before, Digits::Rounded), span(after, Digits::Rounded));
            let at = |ends: &Span, i: i128| ends.low + (ends.high - ends.low) * Exact::new(i, 40);
            let all: Vec<Exact> = (0..=40)
                .flat_map(|i| (0..=40).map(move |j| (i, j)))
                .map(|(i, j)| whole(100) * (whole(1) - at(&to, j) / at(&from, i)))
                .collect();
            assert_eq!(all.iter().min(), Some(&possible.low));
            assert_eq!(all.iter().max(), Some(&possible.high));
        }
    }

    #[test]
    fn a_reduction_from_nothing_has_no_span() {
        let found = Form::OfFirst.span(&span("0", Digits::Rounded), &span("1", Digits::Rounded));
        assert_eq!(found, None);
    }
}
