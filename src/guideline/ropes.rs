//! The main ropes under the guideline's loads: each carries the strip of the net that is nearest to it.

use std::cell::Cell;

use crate::design::{Bank, BarrierDesign, Bottom, Design, DissipatorDesign, FlexibleNet};
use crate::guideline::face::{height_over_bed, lean};
use crate::guideline::posts;
use crate::guideline::rope_load::RopeLoad;
use crate::larger::larger_or_nan;
use crate::loads::cases::later_surge;
use crate::loads::cases::load_case::{AdditionalActions, LoadCase};
use crate::loads::input::GuidelineInput;
use crate::loads::rope::{RopeInput, RopeState, Yielding};
use crate::section::{Section, Survey};

/// What may load a rope: the flows, the load cases that they make, and what hits at one place.
#[derive(Clone, Copy)]
pub struct Cases<'a> {
    pub flows: &'a [GuidelineInput],
    pub stages: &'a [LoadCase],
    /// What acts beside each flow.
    pub extras: &'a dyn Fn(&GuidelineInput) -> AdditionalActions,
}

/// The dissipators of the main ropes, if there are any.
pub fn dissipator(design: &Design) -> Option<Yielding> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return None };
    net.dissipators.as_ref().map(Yielding::from)
}

impl From<&DissipatorDesign> for Yielding {
    fn from(given: &DissipatorDesign) -> Self {
        Self { largest: given.plateau, stroke: given.stroke, curve: given.curve.clone() }
    }
}

/// Each rope under the case that loads its tributary height most. The lowest rope also takes what an open gap below it
/// would let through; the topmost carries the weight of the net.
pub fn loads(net: &FlexibleNet, design: &Design, cases: &Cases) -> Vec<RopeLoad> {
    let top = height_over_bed(design);
    let above_bed = |along: f64| top - (net.height - along) * libm::cos(lean(design));
    let heights: Vec<f64> = net.main_ropes.levels.iter().map(|level| above_bed(level.height)).collect();
    (0..heights.len()).map(|index| Strip::of(net, design, &heights, index).under(cases)).collect()
}

/// A main rope with the strip of the net that it carries.
struct Strip<'a> {
    net: &'a FlexibleNet,
    design: &'a Design,
    /// Of the channel.
    section: Section,
    /// Of all main ropes, and which of them it is.
    heights: &'a [f64],
    index: usize,
    /// Heights above the bed between which the rope carries the net (m).
    low: f64,
    high: f64,
    /// Where across the channel the rope begins, runs over posts, and ends (m).
    stops: Vec<f64>,
    rope: RopeInput,
    /// Of the net that hangs on it (N/m).
    weight: f64,
}

/// Margin for rounding on an upper bound.
const ROUNDING: f64 = 1.0 + 1e-9;

impl<'a> Strip<'a> {
    fn of(net: &'a FlexibleNet, design: &'a Design, heights: &'a [f64], index: usize) -> Self {
        let (section, last) = (design.channel.section(), heights.len() - 1);
        // The bed holds the lowest rope from bank to bank, or it hangs over its opening.
        let ends = if is_held(net, index) { section.bed_ends() } else { section.banks(heights[index]) };
        let stops = if index == last { posts::stops(design, ends) } else { ends.to_vec() };
        let mut other_spans: Vec<f64> = stops.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let longest = (0..other_spans.len()).max_by(|a, b| other_spans[*a].total_cmp(&other_spans[*b])).unwrap_or(0);
        let span = other_spans.remove(longest);
        let behind = [Bank::Right, Bank::Left].map(|bank| net.anchor_designs.of(index, bank).set_back);
        let weight = design.loads.self_weight.map_or(0.0, |weight| weight * net.height);
        Self {
            low: if index == 0 { 0.0 } else { 0.5 * (heights[index - 1] + heights[index]) },
            high: if index == last { f64::INFINITY } else { 0.5 * (heights[index] + heights[index + 1]) },
            rope: RopeInput {
                span,
                other_spans,
                to_anchors: behind[0] + behind[1],
                axial_stiffness: net.main_ropes.levels[index].rope.axial_stiffness(),
                dissipator: dissipator(design),
            },
            weight: if index == last { weight } else { 0.0 },
            net,
            design,
            section,
            heights,
            index,
            stops,
        }
    }

    /// Load along the bed that a case spreads over the rope (N/m).
    fn spread(&self, case: &LoadCase) -> f64 {
        let Section::Surveyed(survey) = &self.section else { return case.strip_force(self.low, self.high) };
        let loaded = self.high.min(case.diagram.top);
        // A level piece of ground has one force, and so has all of what lies below the strip.
        let last = Cell::new((f64::NAN, 0.0));
        let per_width = |ground: f64| {
            let from = self.low.max(ground);
            if last.get().0 != from {
                last.set((from, case.strip_force(from, self.high)));
            }
            last.get().1
        };
        let bay = |bay: usize| even_load(survey, &self.stops, bay, loaded, per_width);
        (0..self.stops.len() - 1).map(bay).fold(0.0, larger_or_nan)
    }

    /// The point load of a case as an even load (N/m).
    fn point(&self, case: &LoadCase) -> f64 {
        point_on_rope(case, self.heights, self.index, self.rope.span)
    }

    /// Load of a case across the rope (N/m): normal to the net's plane, which leans upstream from plumb by its tilt; the weight hangs plumb.
    fn on_rope(&self, case: &LoadCase) -> f64 {
        let spread = (self.spread(case) + self.point(case)) / libm::cos(lean(self.design));
        let hung = self.weight;
        (spread * spread + hung * hung - 2.0 * spread * hung * libm::sin(self.net.tilt)).sqrt()
    }

    /// Upper bound of the load of a case (N/m): that of ground as low all along as the lowest, with what presses beside the spans at their ends. An
    /// even load q that also presses on w beside a span L pushes on its supports like an even load of q (1 + 2 w/L). Infinite where the exact load
    /// is as quickly worked out.
    fn may_reach(&self, case: &LoadCase) -> f64 {
        if matches!(self.section, Section::Rectangle { .. }) || self.weight > 0.0 {
            return f64::INFINITY;
        }
        let widest = self.section.breadth() - self.rope.length();
        let narrowest = self.rope.other_spans.iter().copied().fold(self.rope.span, f64::min);
        let beside = 1.0 + 2.0 * widest.max(0.0) / narrowest;
        let most = beside * case.strip_force(self.low, self.high) * ROUNDING;
        (most + self.point(case)) / libm::cos(lean(self.design))
    }

    /// Surges whose moving flow starts or ends with the strip, which may lie between the stages.
    fn between_stages(&self, cases: &Cases) -> Vec<LoadCase> {
        let surge = |flow: &GuidelineInput, deposit: f64| {
            let room = (flow.fill_height - flow.moving_depth()).max(0.0);
            let case = later_surge::case(flow, deposit.clamp(0.0, room));
            let hit = (cases.extras)(flow).point.map(|hit| hit.over(case.deposit, flow.barrier_height));
            LoadCase { point: hit, ..case }
        };
        let upper = self.high.min(height_over_bed(self.design));
        let of = |flow: &GuidelineInput| [self.low, upper - flow.depth].map(|deposit| surge(flow, deposit));
        cases.flows.iter().flat_map(of).collect()
    }

    /// The case that loads the rope most, and that load (N/m). From the one that may reach furthest on, until no other can reach the hardest found.
    fn governing<'c>(&self, cases: impl Iterator<Item = &'c LoadCase>) -> Option<(f64, &'c LoadCase)> {
        let mut all: Vec<(f64, &LoadCase)> = cases.map(|case| (self.may_reach(case), case)).collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut hardest: Option<(f64, &LoadCase)> = None;
        for (most, case) in all {
            // What is not a number is always worked out.
            if hardest.is_some_and(|(load, _)| most < load) {
                break;
            }
            let load = self.on_rope(case);
            if hardest.is_none_or(|(before, _)| load.total_cmp(&before).is_ge()) {
                hardest = Some((load, case));
            }
        }
        hardest
    }

    /// By which friction on the heads lets the pull of an inner span be more than that at the ends.
    fn over_heads(&self, state: &RopeState) -> f64 {
        let Some(posts) = self.net.posts.as_ref().filter(|_| self.index + 1 == self.heights.len()) else { return 1.0 };
        let bays: Vec<f64> = self.stops.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let slope = |bay: f64| libm::atan(4.0 * state.sag * bay / (self.rope.span * self.rope.span));
        let turns: Vec<f64> = bays.windows(2).map(|pair| slope(pair[0]) + slope(pair[1])).collect();
        let from_the_nearer_end = |bay: usize| {
            let before: f64 = turns[..bay].iter().sum();
            before.min(turns[bay..].iter().sum())
        };
        let most = (0..bays.len()).map(from_the_nearer_end).fold(0.0, larger_or_nan);
        libm::exp(posts.head_friction * most)
    }

    /// The rope under its governing case.
    fn under(self, cases: &Cases) -> RopeLoad {
        let (factor, level) = (self.design.factors.load, self.net.main_ropes.levels[self.index]);
        let own = self.between_stages(cases);
        let governing = self.governing(cases.stages.iter().chain(&own));
        let load = factor * governing.map_or(0.0, |(load, _)| load);
        let spread = governing.map_or(0.0, |(_, case)| self.point(case)) / libm::cos(lean(self.design));
        let point = 0.5 * factor * spread * self.rope.span;
        // A boulder hits one of them.
        let shared = 1.0 / f64::from(level.ropes);
        let held = is_held(self.net, self.index);
        let of_one = if held { load } else { load * shared + factor * spread * (1.0 - shared) };
        let of_all = RopeLoad {
            strip: [self.low, self.high],
            ropes: level.ropes,
            span: self.rope.span,
            load,
            of_one,
            point,
            over_heads: 1.0,
            ..RopeLoad::default()
        };
        if held {
            // It neither sags nor pulls at anchors: the bed takes its load where it is.
            return of_all;
        }
        let state = self.rope.under(of_one);
        let weaker = self.net.dissipators.as_ref().and_then(DissipatorDesign::weakest);
        let weak = |given: DissipatorDesign| {
            RopeInput { dissipator: Some(Yielding::from(&given)), ..self.rope.clone() }.under(of_one)
        };
        let across = 0.5 * of_one * self.rope.span;
        let along = (state.tension.powi(2) - across.powi(2)).max(0.0).sqrt();
        RopeLoad {
            case: governing.map(|(_, case)| case.clone()),
            state,
            weak: weaker.map(weak),
            over_heads: self.over_heads(&state),
            anchor: [along, across],
            other_spans: self.rope.other_spans,
            to_anchors: self.rope.to_anchors,
            ..of_all
        }
    }
}

/// Whether the bed holds a rope along its length.
fn is_held(net: &FlexibleNet, rope: usize) -> bool {
    rope == 0 && net.bottom == Bottom::Fixed
}

/// Slices of a span over which the load of a rope is summed.
const SLICES: f64 = 100.0;

/// The ground between two places across the channel, from point to point.
fn pieces(survey: &Survey, [from, to]: [f64; 2]) -> Vec<[[f64; 2]; 2]> {
    let cut = |pair: &[[f64; 2]]| {
        let [start, end] = [pair[0][0].max(from), pair[1][0].min(to)];
        let at = |y: f64| {
            let run = pair[1][0] - pair[0][0];
            let share = if run > 0.0 { (y - pair[0][0]) / run } else { 0.0 };
            [y, pair[0][1] + share * (pair[1][1] - pair[0][1])]
        };
        let whole = start == pair[0][0] && end == pair[1][0];
        match whole {
            true => Some([pair[0], pair[1]]),
            false => (start < end).then(|| [at(start), at(end)]),
        }
    };
    survey.points().windows(2).filter_map(cut).collect()
}

/// The even load over a span that bends a beam and pushes on its supports no less than what a section hands to it (N/m): `per_width` gives the
/// force on a metre of width whose ground is at a height, up to `top`, above which there is none. What presses beside the first and the last
/// span, between banks and posts, goes to their ends.
fn even_load(survey: &Survey, stops: &[f64], bay: usize, top: f64, per_width: impl Fn(f64) -> f64) -> f64 {
    let [from, to] = [stops[bay], stops[bay + 1]];
    let within =
        [if bay == 0 { f64::NEG_INFINITY } else { from }, if bay + 2 == stops.len() { f64::INFINITY } else { to }];
    let span = to - from;
    let mut loads: Vec<[f64; 2]> = Vec::new();
    for pair in pieces(survey, within) {
        // As far as it is lower than the load.
        let below = |height: f64| ((top - pair[0][1]) / (height - pair[0][1])).clamp(0.0, 1.0);
        let shares = match (pair[0][1] < top, pair[1][1] < top) {
            (true, true) => [0.0, 1.0],
            (true, false) => [0.0, below(pair[1][1])],
            (false, true) => [below(pair[1][1]), 1.0],
            (false, false) => continue,
        };
        let point = |share: f64| [0, 1].map(|axis| pair[0][axis] + share * (pair[1][axis] - pair[0][axis]));
        let [start, end] = shares.map(point);
        let count = (SLICES * (end[0] - start[0]) / span).ceil();
        for slice in 0..count as usize {
            let share = (slice as f64 + 0.5) / count;
            let [y, ground] = [0, 1].map(|axis| start[axis] + share * (end[axis] - start[axis]));
            loads.push([((y - from) / span).clamp(0.0, 1.0), per_width(ground) * (end[0] - start[0]) / count]);
        }
    }
    let total: f64 = loads.iter().map(|[_, force]| force).sum();
    let at_the_end: f64 = loads.iter().map(|[place, force]| place * force).sum();
    let at_the_start = total - at_the_end;
    // Largest moment of the beam: where the shear changes its sign.
    let (mut shear, mut moment, mut largest, mut before) = (at_the_start, 0.0, 0.0_f64, 0.0);
    for [place, force] in &loads {
        moment += shear * (place - before) * span;
        largest = largest.max(moment);
        (shear, before) = (shear - force, *place);
    }
    let bends = 8.0 * largest / (span * span);
    let pushes = 2.0 * larger_or_nan(at_the_start, at_the_end) / span;
    larger_or_nan(bends, pushes)
}

/// A point load as the uniform load with the same moment at midspan, 2 P/L (N/m), shared by lever between the ropes above
/// and below it.
fn point_on_rope(case: &LoadCase, heights: &[f64], index: usize, span: f64) -> f64 {
    let Some(point) = case.point else { return 0.0 };
    let height = point.height.clamp(heights[0], heights[heights.len() - 1]);
    let share = |here: f64, other: f64| (1.0 - (height - here).abs() / (other - here).abs()).max(0.0);
    let neighbour = if height < heights[index] { index.checked_sub(1) } else { Some(index + 1) };
    let other = neighbour.and_then(|neighbour| heights.get(neighbour));
    let share = other.map_or(if height == heights[index] { 1.0 } else { 0.0 }, |&other| share(heights[index], other));
    2.0 * point.force * share / span
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::guideline::guideline;
    use crate::loads::cases::load_case::Hit;
    use approx::assert_relative_eq;

    #[test]
    fn a_point_load_is_shared_by_the_ropes_beside_it() {
        let point = Hit { force: 100.0, height: Some(1.25), over_deposit: 0.0, of_boulder: 0.0 };
        let input = crate::loads::cases::tests::input();
        let case = crate::loads::cases::point_load::case(&input, point);
        let heights = [0.0, 1.0, 2.0];
        let shares: Vec<f64> = (0..3).map(|rope| point_on_rope(&case, &heights, rope, 10.0)).collect();
        assert_relative_eq!(shares[0], 0.0);
        assert_relative_eq!(shares[1], 15.0);
        assert_relative_eq!(shares[2], 5.0);
        // Three quarters on the rope at 1 m, a quarter on the one at 3 m; what hits the top rope is all its own.
        let uneven = |height: f64| {
            let case = crate::loads::cases::point_load::case(
                &input,
                Hit { force: 100.0, height: Some(height), over_deposit: 0.0, of_boulder: 0.0 },
            );
            [0, 1, 2].map(|rope| point_on_rope(&case, &[0.0, 1.0, 3.0], rope, 10.0))
        };
        assert_eq!(uneven(1.5), [0.0, 15.0, 5.0]);
        assert_eq!(uneven(3.0), [0.0, 0.0, 20.0]);
        assert_eq!(uneven(0.25), [15.0, 5.0, 0.0]);
    }

    /// Of all cases the one that governs is that of the largest load, whatever the bounds leave out.
    #[test]
    fn no_case_that_governs_is_left_out() {
        let mut left_out = 0;
        for text in [include_str!("../../designs/gully.yaml"), include_str!("../../designs/site_village.yaml")] {
            let open = |_: &str| Err("the design is read alone".to_string());
            let purpose = crate::design::entries::Purpose::Equations;
            let file = crate::design::read::read_design_for(purpose, "x", text.as_bytes(), &open).unwrap();
            let design = file.design;
            let BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
            let found = guideline(&design);
            let heights: Vec<f64> = {
                let top = height_over_bed(&design);
                let levels = net.main_ropes.levels.iter();
                levels.map(|level| top - (net.height - level.height) * libm::cos(lean(&design))).collect()
            };
            for (index, rope) in found.ropes.iter().enumerate() {
                let strip = Strip::of(net, &design, &heights, index);
                for case in &found.cases {
                    let load = strip.on_rope(case);
                    assert!(strip.may_reach(case) >= load, "rope {index}: {}", case.title);
                    left_out += u32::from(design.factors.load * strip.may_reach(case) < rope.load);
                    assert!(design.factors.load * load <= rope.load * (1.0 + 1e-12), "rope {index}: {}", case.title);
                }
            }
        }
        assert!(left_out > 0);
    }
}
