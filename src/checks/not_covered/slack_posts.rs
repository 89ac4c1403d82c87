//! The main rope pulls the head of a post along the net by its friction. Two retaining ropes that part across the channel hold that as long as both are
//! taut; where one would go slack first, nothing but friction holds the head, as with a single rope.

use super::context::CheckContext;
use crate::checks::outcome::{Kind, OpenReason, Outcome};
use crate::larger::larger_or_nan;

/// Share of that pull that the ropes must hold.
const HELD: f64 = 0.999;

pub fn leave_open(CheckContext { design, guideline, .. }: CheckContext, outcomes: &mut [Outcome]) {
    let Some(posts) = design.posts().filter(|posts| posts.retaining.count() > 1) else { return };
    let held = guideline.posts.iter().map(|post| post.head.along);
    // Asked as "held", so that what is not a number is not.
    let Some(share) = held.reduce(|a, b| -larger_or_nan(-a, -b)).filter(|_| !posts.at.is_empty()) else { return };
    let holds = share >= HELD;
    if holds {
        return;
    }
    let share = if share.is_nan() { "an unknown share".to_string() } else { format!("{:.0} %", 100.0 * share) };
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.kind == Kind::Posts && outcome.holds()) {
        outcome.leave_open(OpenReason::NotGiven(format!(
            "one of the two retaining ropes of a post goes slack under {share} of the pull of the main rope along the net, and then nothing but friction holds the head (give a larger posts.retaining_ropes.spread)"
        )));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::check_all;
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::Demands;
    use crate::design::read::read_design;
    use crate::design::{BarrierDesign, Design};
    use crate::guideline::guideline;

    /// Ropes that part by metres hold the pull of the main rope to either side, ropes that part by a centimetre next to nothing of it.
    #[test]
    fn a_token_spread_of_the_retaining_ropes_holds_no_head() {
        let open = |spread: f64| {
            let text = include_str!("../../../designs/net_with_posts.yaml");
            let mut design: Design =
                read_design("x", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design;
            let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
            net.posts.as_mut().expect("posts").retaining.spread = spread;
            let guideline = guideline(&design);
            let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
            for outcome in outcomes.iter_mut().filter(|outcome| outcome.kind == Kind::Posts) {
                (outcome.verdict, outcome.open) = (CheckVerdict::Pass, None);
            }
            leave_open(CheckContext { design: &design, guideline: &guideline, seen: None }, &mut outcomes);
            let words =
                outcomes.iter().filter_map(|outcome| outcome.open.as_ref()).map(|open| open.words().to_string());
            let told: Vec<String> = words.filter(|words| words.contains("goes slack")).collect();
            (told.len(), told.first().cloned().unwrap_or_default())
        };
        let (count, words) = open(0.01);
        assert!(count > 3, "{count} {words}");
        assert_eq!(open(2.0).0, 0, "{:?}", open(2.0));
    }
}
