//! How the classes of a claim under the interpretations that count make one.

use super::super::class::{Polarity, Verdict, combined as weakest};
use super::count::Group;

/// Of results that speak for and leave open, or against and leave open, how many of ten must speak.
const TENTHS: usize = 9;

/// The results that speak against what most of them say, where they speak both ways; of as many, against the default's.
pub fn flips(groups: &[Group]) -> Vec<&Group> {
    let of = |wanted| groups.iter().filter(move |group| group.class.polarity() == wanted);
    let (holds, fails) = (of(Polarity::For).count(), of(Polarity::Against).count());
    if holds == 0 || fails == 0 {
        return Vec::new();
    }
    let default = groups.first().map(|group| group.class.polarity());
    let most_hold = holds > fails || (holds == fails && default != Some(Polarity::Against));
    of(if most_hold { Polarity::Against } else { Polarity::For }).collect()
}

/// The class of each result: one that speaks against what most say counts only if a second seed says so too, and is open if
/// it does not.
pub fn confirmed(groups: &[Group], second: impl Fn(&Group) -> Option<Verdict>) -> Vec<Verdict> {
    let flips = flips(groups);
    let class = |group: &Group| {
        let is_flip = flips.iter().any(|flip| flip.interpretation == group.interpretation);
        let is_confirmed = || second(group).is_some_and(|again| again.polarity() == group.class.polarity());
        if is_flip && !is_confirmed() { Verdict::Undecided } else { group.class }
    };
    groups.iter().map(class).collect()
}

/// The class across interpretations of these, one for each result that counts.
///
/// One witness makes an existential claim. What speaks one way gives the weakest of it; what speaks both ways is undecided;
/// what is open under more than a tenth is undecided.
pub fn combined(classes: &[Verdict], is_existential: bool) -> Verdict {
    let of = |wanted| classes.iter().copied().filter(move |class| class.polarity() == wanted);
    let holds = of(Polarity::For).count();
    let open = of(Polarity::Open).count();
    let fails = of(Polarity::Against).count();
    let enough = |speak: usize| speak * 10 >= TENTHS * (speak + open);
    let weakest_of = |wanted| weakest(of(wanted), false);
    if is_existential && holds > 0 {
        // One interpretation gives it: the strongest of those that do.
        return of(Polarity::For).min().unwrap_or(Verdict::Undecided);
    }
    if holds > 0 && fails > 0 {
        return Verdict::Undecided;
    }
    if holds > 0 {
        return if enough(holds) { weakest_of(Polarity::For) } else { Verdict::Undecided };
    }
    if fails > 0 {
        let is_proved = classes.iter().all(|class| *class == Verdict::Impossible);
        let class = if is_proved { Verdict::Impossible } else { Verdict::NotReproduced };
        return if enough(fails) { class } else { Verdict::Undecided };
    }
    let is_lacking = !classes.is_empty() && classes.iter().all(|class| *class == Verdict::Untestable);
    if is_lacking { Verdict::Untestable } else { Verdict::Undecided }
}
