//! What a paper leaves open about lengths that it prints without their ends, as tasks' settings write it.
//!
//! A [`Variant`] is one way to fill it in; [`answers`] asks a question of [`engine::length_inversion`] under each.

use crate::name::slug;
use crate::preprocessing::lattice::CornerSetting;
use crate::preprocessing::workspace_map::{ElbowSetting, HopSetting, ShapeSetting, TouchSetting};
use base::grid::{Grid2, Moves};
use base::text::listed;
use engine::length_inversion::Match;
use engine::search::{Octile, ScaledOctile, Ties};
use engine::space::{ArmRules, ArmWorld, HopRule, Obstacle, Zone};
use schemars::JsonSchema;
use serde::Deserialize;

/// How many ways there may be to give each obstacle of a case a shape.
const MOST_CHOICES: usize = 4096;

/// How many hops of either kind a printed path may have, so that its scaled length is far from the end of 32 bits.
const MOST_HOPS: u32 = 100_000;

/// One case: where the obstacles are and how long the printed path is.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Centres of the obstacles.
    pub obstacles_cm: Vec<[f64; 2]>,
    /// Straight and diagonal hops of the printed path, one step of the lattice each.
    pub hops: [u32; 2],
}

impl Case {
    /// The printed length.
    pub fn length(&self) -> Octile {
        Octile { straight: self.hops[0], diagonal: self.hops[1] }
    }

    /// The printed length in the units of [`ScaledOctile`].
    pub fn target(&self) -> u32 {
        ScaledOctile::scaled(self.length())
    }
}

/// One way to fill in what the paper leaves open; what is absent is as the problem group has it.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// Its name in records.
    pub label: String,
    /// The shape of every obstacle.
    pub shape: ShapeChoice,
    /// The diameter of every obstacle.
    pub diameter_cm: f64,
    /// Whether touching an obstacle counts as a collision.
    touching: Option<TouchSetting>,
    /// How far the tip must stay from the base.
    inner_radius_cm: Option<f64>,
    /// On which side the elbow is.
    elbow: Option<ElbowSetting>,
    /// When a diagonal move past blocked cells is allowed.
    corner_rule: Option<CornerSetting>,
    /// How the move between neighbouring cells is checked.
    hop_check: Option<HopSetting>,
    /// Whether the paper's A* lowers the g of an open node; lowered if absent.
    open_node: Option<OpenNode>,
    /// The order among equal f of that A*, which matters only where open nodes are never lowered; first in first out
    /// if absent.
    ties: Option<TieOrder>,
}

/// The shapes that obstacles may have.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "one of circle, square, square_inscribed, hexagon, hexagon_turned, triangle, triangle_turned is accepted \
                 as a shape, or a list of them"
)]
pub enum ShapeChoice {
    /// All have this one.
    Uniform(ShapeSetting),
    /// Each has any of these, in each case anew.
    Free(Vec<ShapeSetting>),
}

/// What the paper's A* does with an open node to which a better way is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OpenNode {
    /// It takes it, so that lengths are shortest.
    Lowered,
    /// It does not, as the pseudocode may be read.
    Never,
}

/// The order among equal f.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TieOrder {
    /// The one opened first.
    Fifo,
    /// The one opened last.
    Lifo,
    /// The one with the larger g.
    LargerG,
}

impl From<TieOrder> for Ties {
    fn from(order: TieOrder) -> Self {
        match order {
            TieOrder::Fifo => Self::Fifo,
            TieOrder::Lifo => Self::Lifo,
            TieOrder::LargerG => Self::LargerG,
        }
    }
}

impl Variant {
    /// The order among equal f where A* never lowers open nodes; nothing where lengths are shortest.
    pub fn never_lowered(&self) -> Option<Ties> {
        let ties = self.ties.map_or(Ties::Fifo, Into::into);
        self.open_node.filter(|rule| *rule == OpenNode::Never).map(|_| ties)
    }

    /// What is wrong with it, if anything: ties that do not matter, or shapes left open where that cannot be searched.
    fn fault(&self, cases: &[Case]) -> Option<(&'static str, String)> {
        let label = &self.label;
        let never = self.never_lowered().is_some();
        if self.ties.is_some() && !never {
            let message = format!("variant `{label}` has ties, which only matter with open_node = \"never\"");
            return Some(("ties", message));
        }
        let centers = || cases.iter().flat_map(|case| &case.obstacles_cm);
        let shapes: &[ShapeSetting] = match &self.shape {
            ShapeChoice::Uniform(shape) => std::slice::from_ref(shape),
            ShapeChoice::Free(shapes) => shapes,
        };
        let mut made =
            shapes.iter().flat_map(|shape| centers().map(|at| shape.obstacle(*at, self.diameter_cm)));
        if let Some(reason) = made.find_map(Result::err) {
            let message = format!("variant `{label}` (diameter_cm is {}): {reason}", self.diameter_cm);
            return Some(("diameter_cm", message));
        }
        if !self.is_free() {
            return None;
        }
        let most = cases.iter().map(|case| case.obstacles_cm.len() as u32).max().unwrap_or_default();
        let (key, fault) = if never {
            ("shape", "open nodes are never lowered with one shape only".to_owned())
        } else if self.hop_check.is_some_and(|check| check != HopSetting::EndPoints) {
            ("hop_check", "hops are judged by their end points then".to_owned())
        } else if shapes.is_empty() {
            ("shape", "at least one shape is needed".to_owned())
        } else if shapes.len().checked_pow(most).is_none_or(|ways| ways > MOST_CHOICES) {
            let found = format!("{} shapes for {most} obstacles", shapes.len());
            ("shape", format!("up to {MOST_CHOICES} choices a case are accepted, not those of {found}"))
        } else {
            return None;
        };
        Some((key, format!("variant `{label}` leaves shapes open; {fault}")))
    }

    /// The rules of `base` with this variant's laid over them.
    pub fn rules(&self, base: &ArmRules) -> ArmRules {
        ArmRules {
            touch: self.touching.map_or(base.touch, Into::into),
            inner_radius_cm: self.inner_radius_cm.unwrap_or(base.inner_radius_cm),
            elbow: self.elbow.map_or(base.elbow, Into::into),
            corner_rule: self.corner_rule.map_or(base.corner_rule, Into::into),
            hop: self.hop_check.map_or(base.hop, Into::into),
            ..*base
        }
    }

    /// Whether each obstacle has a shape of its own.
    pub fn is_free(&self) -> bool {
        matches!(self.shape, ShapeChoice::Free(_))
    }

    /// The grids that each case may be on: one, or one for each way to give every obstacle a shape.
    ///
    /// # Errors
    /// A sentence if an obstacle cannot be made, or shapes are left open and hops are swept.
    pub fn grids(&self, base: &ArmRules, cases: &[Case]) -> Result<Vec<Vec<Moves>>, String> {
        let of_case = |case: &Case| match &self.shape {
            ShapeChoice::Uniform(shape) => Ok(vec![self.world(base, case, *shape)?.eight_moves()]),
            ShapeChoice::Free(shapes) => self.free_grids(base, case, shapes),
        };
        cases.iter().map(of_case).collect()
    }

    /// The grids of every way to give each obstacle a shape; the last obstacle's changes first. Hops are judged by their end
    /// points.
    fn free_grids(
        &self,
        base: &ArmRules,
        case: &Case,
        shapes: &[ShapeSetting],
    ) -> Result<Vec<Moves>, String> {
        let rules = self.rules(base);
        if rules.hop != HopRule::EndPoints {
            return Err("shapes are left open; hops are judged by their end points then".to_owned());
        }
        let blocked = |centers: &[[f64; 2]], shape| {
            let alone = Case { obstacles_cm: centers.to_vec(), hops: case.hops };
            let world = self.world(base, &alone, shape)?;
            Ok::<_, String>(world.zones().iter().map(|zone| *zone != Zone::Free).collect::<Vec<bool>>())
        };
        let bare = blocked(&[], ShapeSetting::Circle)?;
        let of_center = |center| shapes.iter().map(|shape| blocked(&[center], *shape)).collect();
        let blocked: Vec<Vec<Vec<bool>>> =
            case.obstacles_cm.iter().copied().map(of_center).collect::<Result<_, String>>()?;
        let mut choices: Vec<Vec<&Vec<bool>>> = vec![vec![&bare]];
        for shapes in &blocked {
            let longer = choices.iter().flat_map(|choice| shapes.iter().map(move |shape| (choice, shape)));
            choices = longer.map(|(choice, shape)| choice.iter().copied().chain([shape]).collect()).collect();
        }
        Ok(choices.iter().map(|blocked| moves_among(&rules, blocked)).collect())
    }

    /// The workspace of `case` with every obstacle of one shape.
    ///
    /// # Errors
    /// A sentence if an obstacle cannot be made.
    pub fn world(&self, base: &ArmRules, case: &Case, shape: ShapeSetting) -> Result<ArmWorld, String> {
        let obstacles = case.obstacles_cm.iter().map(|center| shape.obstacle(*center, self.diameter_cm));
        Ok(ArmWorld::new(self.rules(base), obstacles.collect::<Result<Vec<Obstacle>, _>>()?))
    }
}

/// The key of what is wrong with `cases`, `variants` or their names in records, and what it is, if anything.
pub fn fault(cases: &[Case], variants: &[Variant]) -> Option<(String, String)> {
    for (key, count) in [("cases", cases.len()), ("variants", variants.len())] {
        if count == 0 {
            return Some((key.to_owned(), format!("{key} is empty; at least one is accepted")));
        }
    }
    let is_odd = |case: &Case| case.hops == [0, 0] || case.hops.iter().any(|hops| *hops > MOST_HOPS);
    if let Some((index, case)) = cases.iter().enumerate().find(|(_, case)| is_odd(case)) {
        let accepted = format!("at least one hop and at most {MOST_HOPS} of a kind are accepted");
        return Some((format!("cases.{index}.hops"), format!("hops is {}; {accepted}", listed(case.hops))));
    }
    for (index, variant) in variants.iter().enumerate() {
        let name = slug(&variant.label);
        if let Some(other) = variants[..index].iter().find(|other| slug(&other.label) == name) {
            let labels = format!("variants `{}` and `{}`", other.label, variant.label);
            let message = format!("{labels} have one name in records, `{name}`");
            return Some((format!("variants.{index}.label"), message));
        }
    }
    variants.iter().enumerate().find_map(|(index, variant)| {
        let (key, message) = variant.fault(cases)?;
        Some((format!("variants.{index}.{key}"), message))
    })
}

/// The key of a limit on how far below a length a shortest path may be, in steps, if anything.
pub fn fault_of_excess(excess_steps: f64) -> Option<(String, String)> {
    let is_right = (0.0..50.0).contains(&excess_steps);
    let message = || format!("excess_steps is {excess_steps}; 0 and more, below 50, is accepted");
    (!is_right).then(|| ("excess_steps".to_owned(), message()))
}

/// What is asked of the grids of all cases; printed lengths are the asker's.
pub trait Question {
    /// What comes out.
    type Answer;

    /// The answers where paths are shortest, one for each alternative of [`engine::length_inversion::pairs`].
    fn shortest(&self, cases: &[Vec<Moves>], rule: Match) -> Vec<Self::Answer>;

    /// The answers where A* never lowers open nodes, on one grid a case, one for each order of `ties`.
    fn never_lowered(&self, cases: &[Moves], ties: &[Ties]) -> Vec<Self::Answer>;
}

/// The answer under each of `variants`; all that have one shape and shortest paths are searched together, and so are those on the
/// same grids where A* never lowers open nodes.
///
/// # Errors
/// A sentence for a variant of which an obstacle cannot be made.
pub fn answers<Q: Question>(
    question: &Q,
    base: &ArmRules,
    cases: &[Case],
    variants: &[&Variant],
) -> Vec<Result<Q::Answer, String>> {
    let grids: Vec<Result<Vec<Vec<Moves>>, String>> =
        variants.iter().map(|variant| variant.grids(base, cases)).collect();
    let is_together = |variant: &Variant| !variant.is_free() && variant.never_lowered().is_none();
    let together: Vec<&Vec<Vec<Moves>>> = variants
        .iter()
        .zip(&grids)
        .filter(|(variant, _)| is_together(variant))
        .filter_map(|(_, grids)| grids.as_ref().ok())
        .collect();
    let of_case = |case: usize| together.iter().map(|grids| grids[case][0].clone()).collect();
    let by_case: Vec<Vec<Moves>> = (0..cases.len()).map(of_case).collect();
    let mut together = question.shortest(&by_case, Match::ByPlace).into_iter();
    let mut never = never_lowered(question, variants, &grids);
    let answer = |((place, variant), grids): ((usize, &&Variant), Result<Vec<Vec<Moves>>, String>)| {
        let grids = grids?;
        let answer = match variant.never_lowered() {
            Some(_) => never[place].take(),
            None if variant.is_free() => question.shortest(&grids, Match::Freely).pop(),
            None => together.next(),
        };
        Ok(answer.expect("a question has an answer for each alternative"))
    };
    variants.iter().enumerate().zip(grids).map(answer).collect()
}

/// The answers under those of `variants` where A* never lowers open nodes; all orders among equals on the same grids are asked for
/// at once.
fn never_lowered<Q: Question>(
    question: &Q,
    variants: &[&Variant],
    grids: &[Result<Vec<Vec<Moves>>, String>],
) -> Vec<Option<Q::Answer>> {
    let mut answers: Vec<Option<Q::Answer>> = variants.iter().map(|_| None).collect();
    let mut asked: Vec<(usize, Vec<Moves>, Ties)> = Vec::new();
    for (place, (variant, grids)) in variants.iter().zip(grids).enumerate() {
        if let (Some(ties), Ok(grids)) = (variant.never_lowered(), grids) {
            asked.push((place, grids.concat(), ties));
        }
    }
    while let Some((_, grids, _)) = asked.first() {
        let grids = grids.clone();
        let is_same = |other: &[Moves]| other.iter().zip(&grids).all(|(one, other)| is_equal(one, other));
        let (same, rest): (Vec<_>, Vec<_>) = asked.into_iter().partition(|(_, other, _)| is_same(other));
        let ties: Vec<Ties> = same.iter().map(|(_, _, ties)| *ties).collect();
        for ((place, ..), answer) in same.iter().zip(question.never_lowered(&grids, &ties)) {
            answers[*place] = Some(answer);
        }
        asked = rest;
    }
    answers
}

fn is_equal(one: &Moves, other: &Moves) -> bool {
    let size = |moves: &Moves| (moves.width(), moves.cell_count());
    size(one) == size(other) && (0..one.cell_count()).all(|cell| one.mask(cell) == other.mask(cell))
}

/// The moves on the lattice of `rules` if a point is free unless one of `blocked` has it.
fn moves_among(rules: &ArmRules, blocked: &[&Vec<bool>]) -> Moves {
    let size = rules.lattice.size();
    let mut grid = Grid2::new(size[0], size[1]).expect("the size is that of a workspace");
    for cell in 0..grid.cell_count() {
        grid.set_blocked(cell, blocked.iter().any(|blocked| blocked[cell as usize]));
    }
    Moves::new(&grid, rules.corner_rule)
}

#[cfg(test)]
mod tests;
