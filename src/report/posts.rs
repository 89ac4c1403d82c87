//! The posts of a net: what their heads carry, what holds them, and how that follows from the loads.

use dem::Vec3;

use crate::checks::posts::strut;
use crate::design::{PostStrength, Posts};
use crate::guideline::posts::input;
use crate::guideline::{PostLoad, height_over_bed};
use crate::pipeline::Run;
use crate::quantities::observed::Observed;
use crate::quantities::posts::{FOOT_ACROSS, FOOT_ALONG, FOOT_UP, MOMENT};
use crate::quantities::quantity::Quantity;
use crate::report::anchors::parts;
use crate::report::numbers::with_unit;
use crate::report::table::Table;

/// Nothing where the barrier has none.
pub fn table(run: &Run) -> Option<Table> {
    let posts = run.file.design.posts()?;
    let seen = run.simulated.as_ref().map(|simulated| simulated.first());
    let row = |(number, load): (usize, &PostLoad)| {
        let value = |quantity: &Quantity| {
            let value = |seen: &Observed| seen.nth(quantity, number);
            seen.map(value)
        };
        let judged = |id: &str| {
            let id = format!("post_{}_{id}", number + 1);
            let Some(outcome) = run.outcomes.iter().find(|outcome| outcome.id == id) else { return "–".to_string() };
            let show = |value: Option<f64>| value.map_or("–".to_string(), |it| with_unit(it, outcome.unit.symbol()));
            format!(
                "{} / {} of {}",
                show(outcome.demand.guideline),
                show(outcome.demand.simulation),
                show(outcome.capacity)
            )
        };
        let moment = value(&MOMENT).map_or("–".to_string(), |value| with_unit(value, "N m"));
        let foot = [&FOOT_ALONG, &FOOT_ACROSS, &FOOT_UP].map(value);
        let foot = foot[0].zip(foot[1]).zip(foot[2]).map(|((x, y), z)| parts(&Vec3::new(x, y, z)));
        vec![
            (number + 1).to_string(),
            format!("{:.2} m, {:.2} m long; {}", posts.at[number], load.length, ropes(run, posts, number)),
            judged("retaining_tension"),
            judged("retaining_stroke"),
            judged("compression"),
            format!("{} / {moment}", with_unit(load.own.moment, "N m")),
            judged("foot"),
            foot.unwrap_or("–".into()),
        ]
    };
    Some(Table {
        columns: vec![
            "Post",
            "Where, how long, and its ropes with their fall",
            "Tension of a retaining rope",
            "Stroke of its dissipator",
            "Compression",
            "Bending moment from direct pressure",
            "Force on the foundation",
            "The same as a vector: downstream, left, up",
        ],
        rows: run.guideline.posts.iter().enumerate().map(row).collect(),
        note: format!(
            "By the equations / by the simulation, of the capacity, as in the checks, with partial factors; compression counts with its bending. Moment and vector are those of the first run of the flow without partial factors; the vector acts on the ground. Places count {}, to the right looking downstream.",
            if run.file.design.channel.survey.is_some() {
                "like the points of the section"
            } else {
                "from the middle of the channel"
            }
        ),
    })
}

/// How the loads of the posts by the equations follow; empty where there are none.
pub fn working(run: &Run) -> String {
    let Some(posts) = run.file.design.posts() else { return String::new() };
    let Some((worst, load)) =
        run.guideline.posts.iter().enumerate().max_by(|a, b| a.1.head.tension.total_cmp(&b.1.head.tension))
    else {
        return String::new();
    };
    let ropes = run.guideline.ropes.last().map_or(1, |rope| rope.ropes);
    let turned = match posts.retaining.count() {
        1 => "which the rope over its head is left to bear".to_string(),
        _ => "of which one of its two ropes takes more and the other less".to_string(),
    };
    format!(
        "Post {}: {} half the load of the bays on either side, q (L₁ + L₂)/2 = {:.1} kN normal to the net, and by friction on its head up to T (1 − exp(−μ θ)) = {:.1} kN along the rope, {turned}. What presses on the post's own width of {:.0} mm adds {:.1} kN at the head and bends it with {:.1} kN m, as a beam from foot to head. The head is in equilibrium between these, its retaining rope{} with T = {:.1} kN and the post with N = {:.1} kN. The equations do not know how the net pulls the head down, nor how grains jam at a post, so that they alone let no post pass. {}",
        worst + 1,
        match ropes {
            1 => "the uppermost rope hands it".to_string(),
            ropes => format!("the {ropes} uppermost ropes together hand it"),
        },
        load.from_rope / 1e3,
        load.along / 1e3,
        posts.width * 1e3,
        load.own.head / 1e3,
        load.own.moment / 1e3,
        if posts.retaining.count() > 1 { "s" } else { "" },
        load.head.tension / 1e3,
        load.head.compression / 1e3,
        strength(run, posts, worst)
    )
}

/// Length and fall of the ropes that retain a post.
fn ropes(run: &Run, posts: &Posts, number: usize) -> String {
    let design = &run.file.design;
    let held = input(design, posts, posts.at[number], height_over_bed(design));
    let of = |[length, falls]: [f64; 2]| format!("{length:.2} m at {:.0}°", falls.to_degrees());
    let ropes: Vec<String> = held.ropes(design.channel.slope).into_iter().map(of).collect();
    format!("ropes of {}", ropes.join(" and "))
}

fn strength(run: &Run, posts: &Posts, number: usize) -> String {
    let Some(strut) = strut(&run.file.design, posts, number) else {
        return "What the posts withstand is not given.".to_string();
    };
    let critical = match posts.strength {
        PostStrength::Section(_) => {
            format!("N_b = χ A f_y/γ = {:.0} kN (N_cr = {:.0} kN)", strut.compression / 1e3, strut.critical / 1e3)
        }
        _ => format!("N_b = {:.0} kN (N_cr is taken to be no more)", strut.compression / 1e3),
    };
    let bending = match posts.strength {
        PostStrength::Section(section) => match section.lateral_torsional {
            Some(share) => format!("M_R = χ_LT W f_y/γ with χ_LT = {share:.2}"),
            None => "M_R = W f_y/γ".to_string(),
        },
        _ => "M_R".to_string(),
    };
    format!(
        "Resistance: {critical}, {bending} = {:.1} kN m; together N + N_b M/(M_R (1 − N/N_cr)) ≤ N_b.",
        strut.bending / 1e3
    )
}
