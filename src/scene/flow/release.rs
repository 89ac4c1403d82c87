//! The flow as it starts: packed upstream of the barrier, at rest behind a gate or already moving.

use serde::{Deserialize, Serialize};

use crate::design::{Arrival, Boulders, Channel, DamBreak, Flow, Surge};
use crate::scene::flow::packing::{Attempts, Growth, PackingError, PackingRoom, pack_watched, push_apart};
use crate::scene::ground::{across, bed_at, ground_of, lowest_at, survey_at};
use crate::section::{Section, Survey};
use crate::units::GRAVITY;
use dem::Vec3;
use dem::tables::grains::{Grain, GrainBody, GrainShape};

/// Where the block stands: x of the foot of its downstream face, and its sizes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Block {
    pub front: f64,
    /// Along the bed (m).
    pub length: f64,
    pub height: f64,
    /// Length along the bed over which its downstream face rises to the full height (m); 0 for a vertical face.
    pub nose: f64,
    /// Share of the nose, as long as the full body, that it lacks: a half between vertical walls.
    pub lack: f64,
    /// Area along the channel, on the mean width, of the tip of the nose that is too thin for grains (m²).
    pub tip: f64,
    pub velocity: f64,
}

/// Depth of the tip of a nose that holds no grains, over their mean diameter.
const TIP: f64 = 0.75;

/// Share of its v² at the barrier that a surge has at the least when it is let go, and on its way.
const CROSSING: f64 = 0.25;

/// What a nose between vertical walls lacks of a full body.
const LACK: f64 = 0.5;

/// Share of the length of an even flow that its nose may take at the most, on the middle of the height: so that a short surge still has
/// a surface.
const LONGEST_NOSE: f64 = 0.8;

impl Block {
    /// The velocity of a surge is that of its arrival: what slope and friction of the bed give or take on the run-in s is left out or
    /// added at the release, v₀² = v² − 2 g (sin α − tan φ cos α) s, but no less than half the velocity.
    pub fn of(flow: &Flow, channel: &Channel, upstream_reach: f64) -> Self {
        let section = section_of(flow, channel, upstream_reach);
        let thin = TIP * flow.sizes.quantile(0.5);
        match flow.arrival {
            Arrival::DamBreak(DamBreak { length, height, distance, .. }) => {
                let height = match section {
                    Section::Rectangle { .. } => height,
                    Section::Surveyed(_) => higher(&section, height, thin),
                };
                Self { front: -distance, length, height, nose: 0.0, lack: LACK, tip: 0.0, velocity: 0.0 }
            }
            Arrival::Surge(Surge { length, depth, velocity, front_angle, run_in }) => {
                // On a raster the section where the surge starts is another one than that at the barrier.
                let length = if channel.relief.is_some() { flow.volume() / section.area(depth) } else { length };
                let nose = (depth / libm::tan(front_angle)).clamp(0.0, 2.0 * LONGEST_NOSE * length);
                let friction = flow.effective(channel.base_friction);
                let gain = match &channel.profile {
                    None => 2.0 * GRAVITY * (libm::sin(channel.slope) - friction * libm::cos(channel.slope)) * run_in,
                    // Fast enough to cross what is flat on its way.
                    Some(profile) => {
                        let gain = profile.gain(run_in, friction);
                        let crosses = profile.largest_gain(run_in, friction) - gain;
                        2.0 * GRAVITY * gain.min(CROSSING * velocity * velocity / (2.0 * GRAVITY) - crosses)
                    }
                };
                let velocity = (velocity * velocity - gain).max(CROSSING * velocity * velocity).sqrt();
                let thin = thin.min(depth);
                let (lack, tip, even) = match section {
                    Section::Rectangle { .. } => (LACK, 0.5 * thin * thin * nose / depth, length),
                    Section::Surveyed(_) => {
                        let area = section.area(depth);
                        let lack = 1.0 - section.moment(depth) / (depth * area);
                        let tip = section.moment(thin) * nose / area;
                        (lack, tip, length * area / section.deep_area(depth, thin))
                    }
                };
                // What the nose lacks, and the tip that holds nothing, are made up for by length.
                let length = even + lack * nose + tip / depth;
                Self { front: -upstream_reach - run_in, length, height: depth, nose, lack, tip, velocity }
            }
        }
    }

    /// What stands behind an inlet that is so far upstream of the barrier's foot (m).
    pub fn behind_an_inlet(distance: f64, length: f64, height: f64, velocity: f64) -> Self {
        Self { front: -distance, length, height, nose: 0.0, lack: LACK, tip: 0.0, velocity }
    }

    /// Of its section along the channel, as far as it holds grains (m²).
    pub fn area(&self) -> f64 {
        self.height * (self.length - self.lack * self.nose) - self.tip
    }
}

/// The section in which the flow starts.
fn section_of(flow: &Flow, channel: &Channel, upstream_reach: f64) -> Section {
    let surveyed = |along: f64| survey_at(channel, along).map(|(survey, _)| Section::Surveyed(survey));
    match flow.arrival {
        Arrival::Surge(surge) => surveyed(-(upstream_reach + surge.run_in + 0.5 * surge.length)),
        Arrival::DamBreak(_) => None,
    }
    .unwrap_or_else(|| channel.section())
}

/// Height of a block that holds what one of a given height would, if there were grains in the thin wedges along its banks (m).
fn higher(section: &Section, height: f64, thin: f64) -> f64 {
    let area = section.area(height);
    let (mut low, mut high) = (height, height + thin);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if section.deep_area(middle, thin.min(middle)) < area { low = middle } else { high = middle }
    }
    high
}

/// The bodies of all grains, from the design's size curve.
pub fn bodies(flow: &Flow) -> Vec<GrainBody> {
    let diameters = flow.sizes.grains(flow.mass_of_grains(), flow.grain_density());
    diameters.iter().map(|&diameter| GrainBody::clump(diameter, flow.aspect, flow.grain_density())).collect()
}

/// The bodies of the boulders at the front, or of those in the flow.
fn boulders(flow: &Flow, at_front: bool) -> Vec<GrainBody> {
    let those = flow.boulders.iter().filter(|boulders| boulders.at_front == at_front);
    those.flat_map(|boulders| vec![body_of(boulders, flow); boulders.number as usize]).collect()
}

/// A boulder has the shape of the grains.
fn body_of(boulders: &Boulders, flow: &Flow) -> GrainBody {
    GrainBody::clump(boulders.diameter, flow.aspect, boulders.density)
}

/// Boulders of a flow.
pub fn count_of_boulders(flow: &Flow) -> u32 {
    flow.boulders.iter().map(|boulders| boulders.number).sum()
}

/// The boulders at the front, in rows from its foot on downstream, side by side on the bed: as in a room whose length is that of the block. Which part
/// of the barrier they come to is a matter of chance: each lies anywhere in its share of the width.
/// One that has a row for itself lies no further aside than between the `low` banks.
fn ahead(flow: &Flow, length: f64, [from, to]: [f64; 2], low: [f64; 2], first: u32, seed: u64) -> Vec<Grain> {
    let mut grains = Vec::new();
    let mut chance = fastrand::Rng::with_seed(seed);
    let mut start = length;
    for boulders in flow.boulders.iter().filter(|boulders| boulders.at_front) {
        let (abreast, long) = boulders.rows(to - from, boulders.extent(flow.aspect));
        let body = body_of(boulders, flow);
        let rows = boulders.number.div_ceil(abreast);
        for number in 0..boulders.number {
            let (row, place) = (number / abreast, number % abreast);
            let in_row = abreast.min(boulders.number - row * abreast);
            let [left, right] = if in_row == 1 { low } else { [from, to] };
            let share = (right - left) / f64::from(in_row);
            let free = boulders.room_aside(share, flow.aspect);
            let across = left + share * (f64::from(place) + 0.5) + free * (chance.f64() - 0.5);
            let along = start + long * (f64::from(row) + 0.5) / f64::from(rows);
            let id = first + grains.len() as u32;
            grains.push(Grain::at(id, Vec3::new(along, across, body.radius), Vec3::y(), body));
        }
        start += long;
    }
    grains
}

/// Places across a sphere at which the ground below it is sought.
const PLACES: i32 = 40;

/// Height of the centre of a grain whose axis is across the channel, where it lies on the ground (m).
fn lying_on(survey: &Survey, grain: &Grain) -> f64 {
    let GrainBody { radius, offset, .. } = grain.body;
    let on = |y: f64| {
        let place = |place: i32| {
            let aside = radius * f64::from(place) / f64::from(PLACES);
            survey.ground(y + aside) + (radius * radius - aside * aside).sqrt()
        };
        (-PLACES..=PLACES).map(place).fold(0.0, f64::max)
    };
    on(grain.position.y - offset).max(on(grain.position.y + offset))
}

/// One or two spheres to a grain.
pub fn shape(flow: &Flow) -> GrainShape {
    if flow.aspect > 1.0 { GrainShape::Clump } else { GrainShape::Sphere }
}

/// Packs the flow into its block and gives it its velocity. The block may come out longer than asked.
pub fn packed_block(
    flow: &Flow,
    channel: &Channel,
    block: &Block,
    seed: u64,
    attempts: Attempts,
) -> Result<(Vec<Grain>, Block), PackingError> {
    let middle = block.front - 0.5 * block.length;
    let on_a_raster = survey_at(channel, middle);
    let ground = on_a_raster.as_ref().map(|(survey, _)| survey.clone()).or_else(|| channel.ground());
    let breadth = ground.as_ref().map_or(channel.width, |survey| Section::Surveyed(survey.clone()).breadth());
    let room = PackingRoom {
        size: Vec3::new(block.length, breadth, block.height),
        nose: block.nose,
        apart: block.moves(),
        ground: ground.as_ref(),
        grows: Growth::Along,
        parts: None,
        raised: 1.0,
    };
    let stop = attempts.stop;
    let packed: Vec<GrainBody> = bodies(flow).into_iter().chain(boulders(flow, false)).collect();
    let (mut grains, growth) = pack_watched(&packed, shape(flow), room, seed, attempts)?;
    let length = block.length * growth;
    let at_the_surface = ground.as_ref().map_or([0.0, channel.width], |survey| survey.banks(block.height));
    let half_way_up = ground.as_ref().map_or([0.0, channel.width], |survey| survey.banks(0.5 * block.height));
    let mut front = ahead(flow, length, at_the_surface, half_way_up, packed.len() as u32, seed);
    if let Some(survey) = &ground {
        front.iter_mut().for_each(|grain| grain.position.z = lying_on(survey, grain));
    }
    grains.extend(front);
    let block = Block { length, ..*block };
    let start = block.front - length;
    for grain in &mut grains {
        // As far along the bed, and as high over it, as in the room.
        let place = grain.position;
        let (origin, [downstream, up]) = bed_at(channel, start + place.x);
        // On a raster the lowest ground winds.
        let aside = on_a_raster.as_ref().and_then(|(_, lowest)| Some(lowest_at(channel, start + place.x)? - lowest));
        grain.position = origin + Vec3::y() * (place.y + aside.unwrap_or(0.0)) + up * place.z;
        grain.velocity = downstream * block.velocity;
        let axis = grain.axis;
        grain.axis = downstream * axis.x + Vec3::y() * axis.y + up * axis.z;
    }
    if let (Some(survey), Some(_)) = (&ground, &channel.profile) {
        // Where the bed breaks, what was straight is bent.
        // Level distances.
        let level = |grain: &Grain| {
            let (sine, cosine) = libm::sincos(channel.slope);
            grain.position.x * cosine + grain.position.z * sine
        };
        let places = grains.iter().map(level);
        let [from, to] = places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
        let along = [from - FOLDED, to + FOLDED];
        let terrain = ground_of(channel, survey, along, |_| 0.0);
        // What is under the ground of another section than that of the room comes to lie on it.
        let across = across(channel);
        for grain in &mut grains {
            let (clear, _) = across.clearance(&grain.position);
            grain.position.z += (grain.body.radius - clear).max(0.0);
        }
        grains = push_apart(grains, shape(flow), terrain, stop)?;
    }
    Ok((grains, block))
}

/// How far the ground goes on beyond a flow that is laid over the breaks of its bed (m).
const FOLDED: f64 = 10.0;

impl Block {
    /// Whether it moves when it is let go. Grains that move freely must not press on each other then: what their contacts store would be
    /// motion that nobody asked for.
    fn moves(&self) -> bool {
        self.velocity > 0.0
    }
}
