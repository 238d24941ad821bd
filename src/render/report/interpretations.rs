//! The effect of interpretations, as the details show it: which interpretations vote, with their source, and which
//! claims each moves.

use super::chapter::Page;
use super::{item, links, paragraph};
use crate::analysis::verdict::{ClaimVerdict, Effect, Fit, SettingFit};
use crate::render::figure::claims_by_choices::named;
use crate::render::prose::markdown;
use study::Choice;
use study::spec::OptionSpec;

impl Page<'_> {
    /// What the paper leaves open, and what each choice does.
    pub(super) fn interpretations(&self, text: &mut String) {
        let choices = &self.evidence.paper.choices;
        if !choices.is_empty() {
            self.explored(text);
        }
        if choices.is_empty() {
            *text += "The paper leaves nothing open that was varied.\n";
        }
        for choice in choices {
            let option = |name: &String| {
                if *name == choice.default { format!("**{name}** (default)") } else { name.clone() }
            };
            let options: Vec<String> = choice.options.keys().map(option).collect();
            let about = format!("`{}`: {}. {}", choice.id, options.join(", "), markdown(&choice.why));
            *text += &item(0, &about);
            text.extend(votes(choice).iter().map(|line| item(1, &markdown(line))));
            text.extend(self.moves(&choice.id).iter().map(|line| item(1, line)));
        }
        let fits = self.verdicts.explored.as_ref().map_or(&[][..], |explored| &explored.fits);
        if let Some(fitted) = choices.iter().find(|choice| choice.fitted).filter(|_| !fits.is_empty()) {
            *text += &settings(fits, fitted);
        }
    }

    /// What was explored, and on what it rests.
    fn explored(&self, text: &mut String) {
        let Some(explored) = &self.verdicts.explored else {
            *text += "The choices were not explored: every verdict is by the defaults alone.\n\n";
            return;
        };
        let mut about = format!(
            "Explored: {} interpretations, {} trials. An interpretation votes if the paper's words or a practice support each of its options. \
             A verdict counts those that vote and agree with what the studies were calibrated to. Equal results count once. A result \
             against most others counts only if the second seed gives it too.",
            explored.interpretations, explored.trials
        );
        if explored.none_compatible {
            about += " No voting interpretation agrees with all that the studies were calibrated to, so all of them are judged.";
        }
        *text += &paragraph(&about);
        for (claims, what) in
            [(&explored.stale, "the exploration"), (&explored.second_stale, "the second seed")]
        {
            if !claims.is_empty() {
                *text += &item(0, &format!("stale in {what}, and not counted: {}", links(claims)));
            }
        }
    }

    /// Which claims an interpretation moves alone, by how.
    fn moves(&self, choice: &str) -> Vec<String> {
        let of = |effect: Effect| {
            let is_it = |judged: &&ClaimVerdict| {
                let across = judged.across.as_ref();
                across.and_then(|across| across.effects.get(choice)).is_some_and(|own| own.effect == effect)
            };
            self.verdicts.claims.iter().filter(is_it).map(|judged| judged.claim.as_str()).collect::<Vec<_>>()
        };
        let kinds = [
            (Effect::Turns, "turns"),
            (Effect::Opens, "opens or decides"),
            (Effect::Outcome, "changes the outcome, not the direction, of"),
        ];
        let effects = |(effect, what)| {
            let claims = of(effect);
            (!claims.is_empty()).then(|| format!("{what} {}", links(&claims)))
        };
        kinds.into_iter().filter_map(effects).collect()
    }
}

/// A table of the settings of all other choices: what each is, and under which options of the `fitted` choice it agrees with what the
/// studies were calibrated to.
fn settings(fits: &[SettingFit], fitted: &Choice) -> String {
    let mut text = format!("\n| setting | options | counts with {} = |\n|---|---|---|\n", fitted.id);
    for (row, name) in fits.iter().zip(named(fits)) {
        let options = if name == row.setting { "" } else { &row.setting };
        let best = fitted.options.keys().filter(|option| row.fits.get(*option) == Some(&Fit::Best));
        let best: Vec<&str> = best.map(String::as_str).collect();
        let best = if best.is_empty() { "none".to_owned() } else { best.join(", ") };
        text += &format!("| {} | {} | {best} |\n", markdown(&name), markdown(options));
    }
    text
}

/// Which options vote and on what ground, and which are probes.
fn votes(choice: &Choice) -> Vec<String> {
    let source = |name: &str, option: &OptionSpec| {
        let bounds = choice.bounds.as_ref().filter(|_| option.value.is_some());
        let own = [option.paper.clone(), option.practice.clone(), bounds.map(|bounds| bounds.source.clone())];
        let sources: Vec<String> = own.into_iter().flatten().collect();
        (!sources.is_empty()).then(|| format!("{name} votes: {}", sources.join("; ")))
    };
    let voting = choice.options.iter().filter(|(name, _)| choice.votes(name));
    let mut lines: Vec<String> = voting.filter_map(|(name, option)| source(name, option)).collect();
    let lost = choice.not_run().map(|(name, why)| {
        format!(
            "{name} cannot be run here: {why}. Claims on studies that inherit the choice stay inconclusive."
        )
    });
    lines.extend(lost);
    let probes: Vec<&str> =
        choice.options.keys().filter(|name| !choice.is_meant(name)).map(String::as_str).collect();
    if !probes.is_empty() {
        lines.push(format!("probes, never counted: {}", probes.join(", ")));
    }
    lines
}

/// What interpretations do to a claim beyond the words beside its verdict.
pub fn across_lines(judged: &ClaimVerdict) -> impl Iterator<Item = String> {
    let across = judged.across.as_ref();
    let counts = across.map(|across| {
        let mut parts = vec![format!("{} interpretations give {} results", across.looked, across.counted)];
        let more = [
            (across.not_looked_at, "do not look at it or lack power"),
            (across.incompatible, "contradict what the studies were calibrated to"),
            (
                across.unconfirmed,
                "differ from most others, are not confirmed by the second seed, and count as open",
            ),
        ];
        if !across.refused.is_empty() {
            parts.push(format!(
                "set apart because the verifier refuses their paths: {}",
                across.refused.join(" · ")
            ));
        }
        parts.extend(
            more.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}")),
        );
        format!("under the defaults: {}; {}", judged.outcome.name(), parts.join(", "))
    });
    let moves = across.into_iter().flat_map(|across| {
        let moving = across.effects.iter().filter(|(_, of)| of.effect > Effect::Number);
        moving.map(|(choice, of)| format!("{choice} = {} alone: {}", of.option, of.outcome.name()))
    });
    let tested = across.into_iter().flat_map(|across| across.tested.iter().cloned());
    let probes = across.filter(|across| !across.probes.is_empty());
    let probes = probes.map(|across| format!("probes, not counted: {}", across.probes.join("; ")));
    let settles = across.and_then(|across| across.settles.as_ref());
    let settles = settles.map(|settles| format!("what would settle it: {settles}"));
    counts.into_iter().chain(settles).chain(moves).chain(tested).chain(probes)
}
