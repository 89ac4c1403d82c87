//! What the report says is assumed, and what nobody has looked at, as far as it bears on a design.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::design::{Arrival, Bank, BarrierDesign, BarrierModel, Bottom, Design};
use crate::fidelity::{needed_pieces, net_pieces};
use crate::pipeline::Run;
use crate::report::numbers::with_unit;
use crate::sources::{
    ALBABA_2015, CUNDALL_STRACK_1979, EN_1990, EN_1993_1_11, EN_1997_1, FRIEDL_2025, OTHER_MODELS, VOLKWEIN_2014,
};

/// An assumption, and whether a design that rests on it is the safer for it.
#[derive(Clone, Debug, Serialize)]
pub struct Assumption {
    pub text: String,
    pub safe: &'static str,
}

const SAFE: &str = "yes";
const UNSAFE: &str = "no";
const EITHER: &str = "may err on either side";

/// What is assumed, as far as it bears on this design.
pub fn assumptions(run: &Run) -> Vec<Assumption> {
    let design = &run.file.design;
    let simulated = run.simulated.is_some();
    let of_grains = if simulated { of_the_grains(design) } else { Vec::new() };
    let of_the_model = [of_the_channel(design), of_the_net(design, simulated), of_the_arrival(design, simulated)];
    let list = of_grains.into_iter().chain(of_the_model.into_iter().flatten()).chain(of_the_equations(design));
    let kept = list.filter(|(applies, ..)| *applies);
    let kept = kept.map(|(_, text, safe)| Assumption { text: text.to_string(), safe });
    let of_net = [of_ropes(design).map(str::to_string), of_gap(design)].into_iter().flatten().filter(|_| simulated);
    kept.chain(of_net.map(|text| Assumption { text, safe: EITHER })).collect()
}

/// A statement: whether it applies, what it says, on which side it errs.
type Statement = (bool, &'static str, &'static str);

/// What is taken of the channel.
fn of_the_channel(design: &Design) -> Vec<Statement> {
    let raster = design.channel.relief.is_some();
    let (rectangular, even) = (design.channel.survey.is_none(), design.channel.profile.is_none());
    vec![
        (
            rectangular && even,
            "The channel is straight, plane and of rectangular section; its base continues downstream of the barrier.",
            EITHER,
        ),
        (
            rectangular && !even,
            "The channel is straight and of rectangular section, with the slopes of the reaches given; the last reach on either side goes on.",
            EITHER,
        ),
        (
            raster,
            "The ground is that of the raster as far as it is read; in the guideline calculation the section is that between the barrier's ends, and the deposit is summed over the raster along the lowest line. Beyond the part that is read there is no ground: what goes over its edges is lost.",
            EITHER,
        ),
        (
            !rectangular && !raster,
            "The channel is straight and has the surveyed section all along, vertical heights over a bed of the slopes given; the last slope on either side goes on. Beyond the ends of the survey there is no ground: what goes over them is lost.",
            EITHER,
        ),
        (
            !rectangular,
            "In the guideline calculation the depth of the flow and of the deposit is that over the lowest point of the bed, under a surface that is level across the gully.",
            EITHER,
        ),
    ]
}

/// What is taken of the net.
fn of_the_net(design: &Design, simulated: bool) -> Vec<Statement> {
    let net = matches!(design.barrier, BarrierDesign::FlexibleNet(_));
    let extended = matches!(&design.barrier, BarrierDesign::FlexibleNet(net) if net.side_extension.is_some());
    let ringed = matches!(&design.barrier, BarrierDesign::FlexibleNet(net) if net.rings.is_some());
    let set_back = matches!(&design.barrier, BarrierDesign::FlexibleNet(net)
        if (0..net.main_ropes.levels.len()).any(|rope| [Bank::Right, Bank::Left].iter().any(|bank| net.anchor_designs.of(rope, *bank).set_back > 0.0)));
    let posted = matches!(&design.barrier, BarrierDesign::FlexibleNet(net) if net.posts.is_some());
    let bundled = matches!(&design.barrier, BarrierDesign::FlexibleNet(net)
        if net.main_ropes.levels.iter().any(|level| level.ropes > 1));
    vec![
        (
            net && !curved(design),
            "Dissipators are elastic, then perfectly plastic at their plateau, unload elastically, and are rigid once their stroke is used up.",
            EITHER,
        ),
        (
            net && curved(design),
            "Dissipators are elastic, then yield along the curve that is given, however fast they are drawn out, unload elastically, and are rigid at the end of the curve.",
            EITHER,
        ),
        (
            net && !any_breaks(design),
            "Ropes, net and anchors do not break; exceeding their resistance shows in the checks alone.",
            UNSAFE,
        ),
        (
            net && any_breaks(design),
            "Ropes break in the simulation where the design says so; other ropes and the anchors do not: there, exceeding the resistance shows in the checks alone.",
            UNSAFE,
        ),
        (
            set_back,
            "Anchors that are set back lie in the line of their ropes, in the bank; the rope is taken as free to stretch and to turn between them and the edge of the net. How it is led through the ground there is not looked at.",
            EITHER,
        ),
        (
            posted,
            "Posts are straight and stand on hinged feet that do not move. The uppermost rope runs over their heads; the net and all other ropes hang downstream of the posts, clear of them: a net that leans on a post is not modelled. Buckling, and bending by what presses on the post itself, are checked, not simulated.",
            EITHER,
        ),
        (
            posted,
            "By the equations the uppermost rope slides over the heads without friction, under the load of its worst span in all of them; its tension between posts is then raised by what friction on the heads can hold, and so is its pull on a head. The load that a yielding retaining rope hands back to the rope is left out: its dissipators are taken as used up. What ropes that sag more hand to the rope over the posts is left out, so that it, posts and their ropes pass with a simulation alone.",
            EITHER,
        ),
        (
            extended && simulated,
            "Side extensions of the net lie flat on the side walls downstream of the barrier; wall and deposit hold each of their knots by the holding force, which is given, not computed.",
            EITHER,
        ),
        (
            ringed && simulated,
            "Each ring of the net slides without friction through its contacts with its neighbours and runs straight between them: it resists bending elastically while its opposite contacts are further apart than its diameter, then one tension acts all round. The wires break earlier the more sharply a ring is turned; what is told is the force of a leg, which is the bundle of wires on one side of a ring, as that of a chain of rings that is as near to breaking. What rings take away by bending for good is left out.",
            EITHER,
        ),
        (
            ringed && simulated,
            "Rings that meet a bank or a bed that is not level are cut to it: as if smaller rings were shackled to the rope there.",
            EITHER,
        ),
        (
            bundled,
            "Ropes that run side by side at one level share its load evenly, and so the pull of the lateral ropes at their ends, each with dissipators and anchors of its own; tensions, strokes and anchor loads are those of one of them.",
            UNSAFE,
        ),
        (
            net && simulated && !ringed,
            "The mesh is stretched a little so that whole diagonals fit the width and each bay between main ropes.",
            EITHER,
        ),
        (
            simulated && straight_sides(design),
            "Each side of a mesh stays straight from knot to knot, while it would bend round a grain: beside a knot the net is up to two fifths too stiff, and it holds up to some 1 % more mass (barrier.flexible_net.net_pieces divides the sides, simulation.fidelity: fine does as well).",
            EITHER,
        ),
        (
            net && simulated && design.factors.load != 1.0,
            "The partial factor on loads makes the flow heavier, in the equations and in the simulation; its velocity, depth and volume stay as given.",
            EITHER,
        ),
    ]
}

/// How the flow comes.
fn of_the_arrival(design: &Design, simulated: bool) -> Vec<Statement> {
    let hydrograph = design.flow.hydrograph.as_ref();
    vec![
        (
            !design.flow.boulders.is_empty(),
            "Boulders are a part of the flow's mass, of the shape of its grains and with its contact law; those at the front lie side by side on the bed ahead of it, with its velocity. On a rigid wall the equations add the largest of them as a point load, its elastic force (Hertz 1882) times loads.impact_reduction, a tenth by default, which is uncertain; on a net boulders are in the simulation alone (loads.point_load adds one to the equations).",
            EITHER,
        ),
        (
            simulated && hydrograph.is_some(),
            "The flow comes in by its hydrograph, straight between its rows: packed at the bulk density, every grain with the velocity of that time along the bed, the same over the depth and across the channel, held together by what follows until it has passed the inlet. Fronts do not take shape before that.",
            EITHER,
        ),
        (
            hydrograph.is_some(),
            "The equations take the moments of the hydrograph than which none is both deeper and faster, each as a surge at every depth of the deposit; it runs up from what had come before the last of them.",
            SAFE,
        ),
        (
            simulated && hydrograph.is_none() && matches!(design.flow.arrival, Arrival::Surge(_)),
            "A surge is released upstream of the barrier as a body of even depth with a sloping front, every grain with the same velocity and none pressed on another, and runs in before it hits (flow.arrival.surge.front_angle and run_in). A vertical front without a run-in would hit the whole barrier at once, and the contact modulus of the grains would decide how hard.",
            EITHER,
        ),
    ]
}

/// What the simulation takes the flow for.
fn of_the_grains(design: &Design) -> Vec<Statement> {
    let wet = design.flow.pore_fluid.is_some();
    vec![
        (
            true,
            "Grains are two equal overlapping spheres (or spheres, for an aspect of 1), rigid but for a linear contact spring with a non-adhesive dashpot, and Coulomb friction with the smaller of the two friction angles.",
            EITHER,
        ),
        (!wet, "The flow is dry: no water pressure, no cohesion, no breakage of grains.", UNSAFE),
        (
            wet,
            "Grains and the fluid in their pores are one mixture: the fluid's mass moves with the grains, at the bulk density given, and its pressure, the share r_u of the whole, leaves (1 − r_u) tan φ of the friction at the bed, at the banks, on a wall and between grains; on ropes, between which the fluid runs off, the whole friction acts. No cohesion, no breakage of grains.",
            EITHER,
        ),
        (
            wet,
            "The barrier bears the whole weight, as if nothing of the fluid ran off through it: buoyancy is in the pressure ratio alone.",
            SAFE,
        ),
        (
            wet,
            "The pressure ratio is the same everywhere in the flow as it comes, falls where grains rest, towards the ratio that stays, and does not rise again when they move. What comes to rest settles to the density to which its grains pack, so that the deposit is somewhat denser and less deep than the flow. The contacts carry the pressure of the fluid as well, so that what rests presses on the barrier with up to a quarter less than fluid and grains together would, r_u + (1 − r_u) K of the grains; the guideline's K of 1 is no less than that.",
            UNSAFE,
        ),
    ]
}

/// What the equations rest on.
fn of_the_equations(design: &Design) -> Vec<Statement> {
    let net = matches!(design.barrier, BarrierDesign::FlexibleNet(_));
    let default_arrival = match design.flow.arrival {
        Arrival::DamBreak(block) => block.depth_at_barrier.is_none() || block.velocity_at_barrier.is_none(),
        Arrival::Surge(_) => false,
    };
    vec![
        (
            default_arrival,
            "For a dam break the guideline's depth is 4/9 of the block's height (Ritter 1892), and its velocity the larger of that of a block sliding on the bed and that of a front without inner friction, where the design does not give them: an upper bound, often twice what arrives.",
            SAFE,
        ),
        (
            matches!(&design.barrier, BarrierDesign::RigidWall(wall) if wall.stability.is_some_and(|it| it.founding_depth > 0.0)),
            "The ground presses on the part of the wall below the bed with active earth pressure (Rankine, with the friction of the base, 35° at the most, and the slope of the bed), and with what the deposit adds as it lies on the ground. The ground in front holds with no more than its active pressure; its passive resistance is left out.",
            SAFE,
        ),
        (
            matches!(&design.barrier, BarrierDesign::RigidWall(wall) if wall.stability.is_some_and(|it| it.block_length.is_some()))
                && crate::guideline::point_load(design, &crate::guideline::input(design)).is_some(),
            "Each block of the wall between its joints (stability.block_length) is taken as rigid, without help from its neighbours and the banks. It carries a point load as one piece: shared over its length for overturning and the pressure under it, over 0.41 of it for sliding, which is the least that friction holds of a push at the end of a block of even weight. That the block itself bears the load, in bending and shear along the wall and where it is hit, is not checked.",
            UNSAFE,
        ),
        (
            true,
            "In the guideline calculation pressures act normal to the barrier's face, and the forces of the load cases are their part along the bed: a face that leans by θ from the bed's normal takes R/cos θ.",
            EITHER,
        ),
        (
            net,
            "In the guideline calculation each main rope carries its strip as a uniform load across the channel; net and lateral ropes share no load.",
            EITHER,
        ),
    ]
}

/// Where the modelled net ends.
fn of_gap(design: &Design) -> Option<String> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return None };
    Some(format!(
        "The net ends {} from each {}, 70 mm or half a mesh, whichever is less; its main ropes go on through that gap to their anchors.",
        with_unit(net.side_gap(), "m"),
        design.channel.sides()
    ))
}

/// Whether sides of the mesh have fewer pieces in the simulation than the grains need.
fn straight_sides(design: &Design) -> bool {
    matches!(&design.barrier, BarrierDesign::FlexibleNet(net) if net_pieces(design, net) < needed_pieces(design, net))
}

/// Whether the dissipators yield along a curve.
fn curved(design: &Design) -> bool {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return false };
    net.dissipators.as_ref().is_some_and(|dissipators| !dissipators.curve.is_plateau())
}

/// Whether any of the ropes breaks in the simulation.
fn any_breaks(design: &Design) -> bool {
    matches!(&design.barrier, BarrierDesign::FlexibleNet(net) if net.ropes().any(|rope| rope.breaks))
}

/// What the model of the barrier assumes of its ropes.
fn of_ropes(design: &Design) -> Option<&'static str> {
    match (&design.barrier, design.simulation.barrier_model) {
        (BarrierDesign::RigidWall(_), _) => None,
        (BarrierDesign::FlexibleNet(net), BarrierModel::SlidingRopes) if net.rings.is_some() => Some(
            "Ropes pull and never push and do not bend; main ropes run through the rings of the net with friction; half the mass of each rope segment sits at each of its ends, and the mass of each ring at its contacts; axial damping of 5 % of critical is added.",
        ),
        (_, BarrierModel::PinnedRopes) => Some(
            "Ropes pull and never push and do not bend; the connecting rings between net and main ropes are fixed to them; half the mass of each rope segment sits at each of its ends; axial damping of 5 % of critical is added.",
        ),
        (_, BarrierModel::SlidingRopes) => Some(
            "Ropes pull and never push and do not bend; main ropes run through the connecting rings of the net with friction; half the mass of each rope segment sits at each of its ends; axial damping of 5 % of critical is added.",
        ),
        (_, BarrierModel::Cylinders) => Some(
            "Ropes are elastic cylinders that bend and twist as solid rods of their modulus; the connecting rings between net and main ropes are squares of four cylinders that slide on the main ropes with friction; axial damping of 5 % and bending damping of 20 % of critical is added.",
        ),
    }
}

/// What nobody has looked at.
pub fn not_checked(design: &Design) -> Vec<&'static str> {
    let (net, bolts, wall) = match &design.barrier {
        BarrierDesign::FlexibleNet(net) => {
            (true, net.bottom == Bottom::Fixed && net.bed_bolts.and_then(|bolts| bolts.resistance).is_none(), false)
        }
        BarrierDesign::RigidWall(wall) => (false, false, wall.stability.is_none()),
    };
    let loads = &design.loads;
    let section_is_held = matches!(&design.barrier, BarrierDesign::RigidWall(wall) if wall.resistance.is_some() && wall.moment_resistance.is_some());
    let ringed = matches!(&design.barrier, BarrierDesign::FlexibleNet(net) if net.rings.is_some());
    let list = [
        (
            true,
            "scour, abutments, and the ground under foundations (a post's foundation is held against the resistance that is given, no more)",
        ),
        (wall, "sliding, overturning and bearing of the wall (rigid_wall.stability would have them checked)"),
        (
            !net && !section_is_held,
            "bending and shear of the wall itself (rigid_wall.resistance and moment_resistance would have them checked; the segments' pressures are told for that)",
        ),
        (
            section_is_held,
            "bending and shear of the wall between its metres, its reinforcement and its joints (the resistances given are of whole metres)",
        ),
        (true, "corrosion, abrasion and maintenance"),
        (net && !ringed, "the rings that join the net to its main ropes; punching of the mesh by a single stone"),
        (ringed, "shackles and clamps of the net; punching of the net by a single stone"),
        (
            bolts,
            "the bolts or anchors that hold the lowest rope to the bed (anchors.bed_bolt_spacing and anchors.bed_bolt_resistance would have them checked)",
        ),
        (
            loads.point_load.is_none() && design.flow.boulders.is_empty(),
            "impact of single boulders larger than the design grains, and of single logs (loads.point_load)",
        ),
        (
            loads.wood_factor.is_none(),
            "wood in the flow: logs raised the peak force on a bridge deck 1.5 to 2 times, 1.2 to 1.5 times at the same depth of flow (Friedl et al. 2025; loads.wood_factor)",
        ),
        (loads.drained.is_none(), "drainage of the deposit"),
        (loads.snow_pressure.is_none(), "snow"),
    ];
    list.into_iter().filter(|(applies, _)| *applies).map(|(_, text)| text).collect()
}

/// Where what was used comes from, each once.
pub fn references(run: &Run) -> Vec<&'static str> {
    let of_cases = run.guideline.cases.iter().map(|case| case.source);
    let mut references = vec![VOLKWEIN_2014];
    references.extend(of_cases);
    if run.simulated.is_some() {
        references.extend([ALBABA_2015, CUNDALL_STRACK_1979]);
    }
    if run.simulated.as_ref().is_some_and(|seen| seen.starts.len() > 1) {
        references.push(EN_1990);
    }
    if matches!(run.file.design.barrier, BarrierDesign::FlexibleNet(_)) {
        references.extend([EN_1993_1_11, EN_1997_1]);
    }
    references.push(OTHER_MODELS);
    if run.file.design.loads.wood_factor.is_some() {
        references.push(FRIEDL_2025);
    }
    let mut seen = BTreeSet::new();
    references.into_iter().filter(|reference| seen.insert(*reference)).collect()
}
