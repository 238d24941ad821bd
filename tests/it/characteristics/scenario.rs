//! A criterion, a truth, how claims come out under it, and how often they may come out wrong.

use super::synthetic::{Made, Synthetic};
use base::seed::{self, Stream};
use replan::analysis::outcome::Outcome;
use stats::proportion::clopper_pearson;
use study::store::Records;

/// One paper and our records, with what is true of the claim.
pub struct World {
    pub records: Records,
    /// What the paper prints, by claim.
    pub printed: Vec<(&'static str, String)>,
    /// Whether the claim is true.
    pub holds: bool,
    /// Whether its sign is.
    pub sign: bool,
}

impl World {
    /// A claim that prints nothing, and is true or false as it stands.
    pub fn new(records: Records, holds: bool) -> Self {
        Self { records, printed: Vec::new(), holds, sign: holds }
    }

    /// A claim of a number.
    pub fn printing(self, printed: String) -> Self {
        Self { printed: vec![(super::synthetic::ASKED, printed)], ..self }
    }

    /// A claim whose sign is true whatever becomes of its size.
    pub fn of_true_sign(self) -> Self {
        Self { sign: true, ..self }
    }
}

/// What may be said at most, or must be said at least, each as a share of the papers.
#[derive(Clone, Copy, Default)]
pub struct Bounds {
    /// For a claim that is false.
    pub false_for: Option<f64>,
    /// Against a claim that is true.
    pub false_against: Option<f64>,
    /// "holds", whatever is true.
    pub reproduced: Option<f64>,
    /// Anything for or against it, whatever is true.
    pub firm: Option<f64>,
    /// What is true, at least: so that a criterion which says nothing fails.
    pub right: Option<f64>,
}

/// A criterion under one truth.
pub struct Scenario {
    pub criterion: &'static str,
    /// `true`, `false`, `false by a little`, …
    pub truth: &'static str,
    /// What is drawn, in words.
    pub about: String,
    /// The claim, as TOML.
    pub claim: String,
    pub made: Made,
    pub world: Box<dyn Fn(&mut Stream) -> World + Send + Sync>,
    pub bounds: Bounds,
}

/// How often a scenario came out how.
#[derive(Default)]
pub struct Counts {
    pub papers: usize,
    pub outcomes: [usize; 8],
    pub false_for: usize,
    pub false_against: usize,
    pub right: usize,
}

impl Counts {
    pub fn count(&self, outcome: Outcome) -> usize {
        self.outcomes[Outcome::ALL.iter().position(|own| *own == outcome).unwrap()]
    }

    fn add(&mut self, outcome: Outcome, world: (bool, bool)) {
        let (holds, sign) = world;
        let says_all = matches!(outcome, Outcome::Holds | Outcome::Fitted | Outcome::Attainable);
        let says_sign = outcome == Outcome::SignOnly;
        let says_no = matches!(outcome, Outcome::Fails | Outcome::Proved);
        self.papers += 1;
        self.outcomes[Outcome::ALL.iter().position(|own| *own == outcome).unwrap()] += 1;
        self.false_for += usize::from(!holds && says_all || !sign && says_sign);
        self.false_against += usize::from(holds && (says_no || says_sign));
        self.right += usize::from(holds && says_all || !holds && (says_no || sign && says_sign));
    }
}

/// Chance at which a scenario that errs as often as its bound allows is refused all the same.
const NOISE: f64 = 1e-4;

impl Scenario {
    /// Its name in messages.
    pub fn name(&self) -> String {
        format!("{}, {}, {}", self.criterion, self.truth, self.about)
    }

    /// Judges so many papers, each drawn by a seed of its own.
    pub fn run(&self, papers: usize) -> Counts {
        let mut synthetic = Synthetic::new(&self.claim, self.made);
        let mut counts = Counts::default();
        for paper in 0..papers {
            let names = [self.criterion, self.truth, &self.about, &paper.to_string()];
            let mut stream = seed::stream(seed::derive(14, &names));
            let World { records, printed, holds, sign } = (self.world)(&mut stream);
            counts.add(synthetic.judged(records, &printed), (holds, sign));
        }
        counts
    }

    /// What is said more or less often than its bounds allow, beyond what so few papers can tell.
    pub fn broken(&self, counts: &Counts) -> Vec<String> {
        let firm = counts.papers - counts.count(Outcome::Open) - counts.count(Outcome::Lacking);
        let Bounds { false_for, false_against, reproduced, firm: most_firm, right } = self.bounds;
        let message = |what: &str, count: usize, bound: f64| {
            format!("{}: {what} {count} of {} papers, bound {bound:.4}", self.name(), counts.papers)
        };
        let interval = |count| clopper_pearson(count, counts.papers, 1.0 - 2.0 * NOISE).unwrap();
        let most = [
            ("for a false claim", counts.false_for, false_for),
            ("against a true claim", counts.false_against, false_against),
            ("holds", counts.count(Outcome::Holds), reproduced),
            ("firm", firm, most_firm),
        ];
        let above = most.into_iter().filter_map(|(what, count, bound)| {
            bound.filter(|bound| interval(count).low > *bound).map(|bound| message(what, count, bound))
        });
        let below = right.filter(|least| interval(counts.right).high < *least);
        above.chain(below.map(|least| message("right", counts.right, least))).collect()
    }
}
