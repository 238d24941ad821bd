//! Marked values: upright lines, each under a flag that names it.
//!
//! Flags stand in one row above the frame, moved sideways only as far as needed to stay apart and tied to
//! their lines by slanting leaders, which cannot cross. If the row is too short, flags are set upright.

use super::{Mark, View};
use crate::render::canvas::{Align, Canvas, Stand, Type};
use crate::render::style::{Stroke, TextSize};

/// Upright lines at marked values under flags that keep clear of each other.
#[derive(Clone, Debug)]
pub struct Rules {
    /// Position in data units and text of each.
    pub marks: Vec<(f64, String)>,
    /// How lines are drawn; flags take the colour.
    pub stroke: Stroke,
}

const FLAG: Type = Type::regular(TextSize::TICK);
const LEADER_PT: f64 = 7.0;
const UPRIGHT_PT: f64 = 8.5;
/// How far flags may reach over either end of the frame.
const REACH_PT: f64 = 4.0;

/// Where flags stand, and whether their texts are level.
struct Flags {
    middles: Vec<f64>,
    level: bool,
}

/// Middles of boxes of `widths` nearest to `wanted` (rising) that stay apart and, if they fit at all,
/// within `[low, high]`.
///
/// The mean of pushing everything right and pushing everything left; both keep apart, so their mean does.
fn spread(wanted: &[f64], widths: &[f64], [low, high]: [f64; 2]) -> Vec<f64> {
    let right = pushed(wanted, widths, low);
    let mirror = |values: &[f64]| -> Vec<f64> { values.iter().rev().map(|value| -value).collect() };
    let reversed: Vec<f64> = widths.iter().rev().copied().collect();
    let bounded_right = mirror(&pushed(&mirror(&right), &reversed, -high));
    let left = mirror(&pushed(&mirror(wanted), &reversed, -high));
    let bounded_left = pushed(&left, widths, low);
    bounded_right.iter().zip(&bounded_left).map(|(a, b)| a.midpoint(*b)).collect()
}

/// Middles moved right, each only as far as its left neighbour or `low` asks.
fn pushed(wanted: &[f64], widths: &[f64], low: f64) -> Vec<f64> {
    let mut end = low;
    let place = |(&middle, &width): (&f64, &f64)| {
        let at = middle.max(end + width / 2.0);
        end = at + width / 2.0;
        at
    };
    wanted.iter().zip(widths).map(place).collect()
}

impl Rules {
    /// Order of the marks from left to right.
    fn order(&self, view: &View) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.marks.len()).collect();
        order.sort_by(|&a, &b| self.pole(view, a).total_cmp(&self.pole(view, b)).then(a.cmp(&b)));
        order
    }

    fn pole(&self, view: &View, index: usize) -> f64 {
        view.at([self.marks[index].0, 0.0])[0]
    }

    fn flags(&self, view: &View, order: &[usize]) -> Flags {
        let poles: Vec<f64> = order.iter().map(|&index| self.pole(view, index)).collect();
        let texts = order.iter().map(|&index| FLAG.width_pt(&self.marks[index].1) + 5.0);
        let widths: Vec<f64> = texts.collect();
        let ends = [view.frame.x - REACH_PT, view.frame.right() + REACH_PT];
        let level = widths.iter().sum::<f64>() <= ends[1] - ends[0];
        let widths = if level { widths } else { vec![UPRIGHT_PT; order.len()] };
        Flags { middles: spread(&poles, &widths, ends), level }
    }
}

impl Mark for Rules {
    fn draw(&self, canvas: &mut Canvas, view: &View) {
        for index in 0..self.marks.len() {
            let x = self.pole(view, index);
            canvas.polyline(&[[x, view.frame.y], [x, view.frame.bottom()]], &self.stroke);
        }
    }

    fn draw_over(&self, canvas: &mut Canvas, view: &View) {
        let order = self.order(view);
        let flags = self.flags(view, &order);
        let top = view.frame.y - LEADER_PT;
        let level = FLAG.colored(self.stroke.color).aligned(Align::Middle, Stand::Base);
        let upright =
            Type { turn_deg: -90.0, ..FLAG.colored(self.stroke.color).aligned(Align::Start, Stand::Centre) };
        for (&index, &middle) in order.iter().zip(&flags.middles) {
            let thin = Stroke::solid(self.stroke.color, 0.5);
            canvas.polyline(&[[self.pole(view, index), view.frame.y], [middle, top]], &thin);
            canvas.text(
                [middle, top - 2.5],
                &self.marks[index].1,
                if flags.level { &level } else { &upright },
            );
        }
    }

    fn headroom_pt(&self, view: &View) -> f64 {
        let order = self.order(view);
        let widest = self.marks.iter().map(|(_, text)| FLAG.width_pt(text)).fold(0.0, f64::max);
        match (order.is_empty(), self.flags(view, &order).level) {
            (true, _) => 0.0,
            (false, true) => LEADER_PT + 10.0,
            (false, false) => LEADER_PT + widest + 5.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::seed;
    use rand::RngExt as _;

    #[test]
    fn spread_boxes_stay_apart_and_move_only_when_they_must() {
        let mut moved = 0;
        let mut kept = 0;
        for case in 0..500 {
            let mut random = seed::stream(seed::derive(case, &["spread"]));
            let mut wanted: Vec<f64> = (0..5).map(|_| random.random_range(0.0..100.0)).collect();
            wanted.sort_by(f64::total_cmp);
            let widths: Vec<f64> =
                (0..5).map(|_| random.random_range(2.0..if case % 2 == 0 { 19.0 } else { 7.0 })).collect();
            let got = spread(&wanted, &widths, [0.0, 100.0]);
            let fits = |middles: &[f64]| {
                let ends =
                    middles[0] - widths[0] / 2.0 >= -1e-9 && middles[4] + widths[4] / 2.0 <= 100.0 + 1e-9;
                let gap = |i: usize| middles[i + 1] - middles[i] - widths[i].midpoint(widths[i + 1]);
                ends && (0..4).all(|i| gap(i) >= -1e-9)
            };
            assert!(fits(&got), "case {case}: {wanted:?} {widths:?} -> {got:?}");
            if fits(&wanted) {
                let shift = wanted.iter().zip(&got).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(shift < 1e-9, "case {case}: moved by {shift}");
                kept += 1;
            } else {
                moved += 1;
            }
        }
        assert!(moved > 50 && kept > 20, "one-sided sample: {moved} moved, {kept} kept");
    }
}
