//! How high and how far a deposit stands behind the barrier, and how many surges fill it.
//!
//! On a bed of even slope α, behind a barrier that leans upstream by ε from the bed's normal, a deposit of height H whose plane surface falls at
//! α' downstream holds V = S(H) (cot(α − α') + tan ε), S being the first moment of the section's area: ½ b H² in a rectangle. With reaches of
//! other slopes the area under the surface is integrated along the bed, on each of them with S in closed form. Derived here.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::sync::Arc;

use crate::profile::Profile;
use crate::relief::Relief;
use crate::section::Section;

/// Steps of a deposit's height in which the area under a face is summed.
const STEPS: f64 = 40.0;
/// How close a height is sought, as a share, and tries at the most.
const CLOSE: f64 = 1e-9;
const MOST_TRIES: usize = 60;
/// Times that a height is brought closer before it is bracketed.
const CLOSER: usize = 3;
/// Steps over a raster, and heights of a deposit upstream of its barrier, after which a surface is taken never to meet the bed.
const MOST_STEPS: usize = 20_000;
const FURTHEST: f64 = 500.0;
/// Change of a depth over a reach, as a share, below which the mean of its area is that in the middle.
const NEARLY_EVEN: f64 = 1e-4;

/// The surface of a deposit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// Of this slope, falling downstream (rad); negative where it falls upstream.
    Plane(f64),
    /// Of this share of the slope of the bed below it.
    OfTheBed(f64),
}

/// The channel upstream of a barrier; lengths in m, angles in rad.
#[derive(Clone, Debug, PartialEq)]
pub struct Reservoir {
    pub section: Section,
    /// Of a rectangle, or the mean width on which volumes are told.
    pub width: f64,
    /// Of the bed at the barrier, α.
    pub slope: f64,
    /// By which the barrier leans upstream from the bed's normal, ε.
    pub lean: f64,
    /// The bed where it has several reaches.
    pub profile: Option<Profile>,
    /// The ground itself, where a raster tells it.
    pub relief: Option<Arc<Relief>>,
}

/// A height that was sought in a reservoir.
struct Found {
    of: Reservoir,
    volume: f64,
    surface: Surface,
    height: f64,
}

/// Heights that a thread remembers.
const REMEMBERED: usize = 16;

thread_local! {
    static FOUND: RefCell<VecDeque<Found>> = const { RefCell::new(VecDeque::new()) };
}

/// A deposit behind a barrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deposit {
    /// Of the bed at the barrier, α.
    pub slope: f64,
    /// By which the barrier leans upstream from the bed's normal.
    pub lean: f64,
    /// At the barrier, normal to the bed, H.
    pub height: f64,
    /// Slope of its surface at the barrier, α'.
    pub surface: f64,
}

/// What a barrier can hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Retention {
    pub deposit: Deposit,
    /// Volume held V (m³).
    pub volume: f64,
    /// Length of the deposit, level (m).
    pub length: f64,
    /// Volume held over that of one surge, the design flow: surges until it is full.
    pub surges: f64,
}

/// What a deposit comes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stored {
    /// m³
    pub volume: f64,
    /// Level length from the barrier's foot to where the surface meets the bed (m).
    pub length: f64,
    /// Volume times what slope less friction pulls it, ∫ A (tan α − tan φ) dX for a friction of the bed (m³); over several reaches from the
    /// upstream end on, and never less than 0.
    pub pull: f64,
}

impl Surface {
    /// Slope over a bed whose slope is tan α (tan).
    fn falls(self, bed: f64) -> f64 {
        match self {
            Self::Plane(slope) => libm::tan(slope),
            Self::OfTheBed(share) => libm::tan(share * libm::atan(bed)),
        }
    }

    /// Slope at a bed of this slope (rad).
    pub fn slope(self, bed: f64) -> f64 {
        match self {
            Self::Plane(slope) => slope,
            Self::OfTheBed(share) => share * bed,
        }
    }
}

impl Reservoir {
    /// The deposit of a height at the barrier, normal to the bed (m), on a bed with friction tan φ; nothing where its surface does not meet
    /// the bed.
    pub fn stored(&self, height: f64, surface: Surface, friction: f64) -> Option<Stored> {
        if let Some(profile) = &self.profile {
            return self.along(profile, height, surface, friction);
        }
        let falls = surface.slope(self.slope);
        let spread = libm::tan(self.slope - falls).recip() + libm::tan(self.lean);
        let base = height * spread;
        let volume = match &self.section {
            Section::Rectangle { width } => 0.5 * width * height * base,
            section @ Section::Surveyed(_) => section.moment(height) * spread,
        };
        let pull = volume * (libm::tan(self.slope) - friction);
        (self.slope > falls).then(|| Stored { volume, length: base * libm::cos(self.slope), pull })
    }

    /// The deposit over reaches of several slopes; nothing where its surface does not meet the bed.
    fn along(&self, profile: &Profile, height: f64, surface: Surface, friction: f64) -> Option<Stored> {
        let (parts, end) = self.parts(profile, height, surface);
        let volume = parts.iter().map(|part| part.volume).sum();
        Some(Stored { volume, length: -end?, pull: pull_of(&parts, friction) })
    }

    /// Volume times what slope less friction pulls a deposit with, where it does not end as well (m³). What friction holds back upstream does
    /// not pull on what is downstream of it.
    pub fn pull(&self, height: f64, surface: Surface, friction: f64) -> f64 {
        match &self.profile {
            Some(profile) => pull_of(&self.parts(profile, height, surface).0, friction),
            None => self.stored(height, surface, friction).map_or(0.0, |stored| stored.pull.max(0.0)),
        }
    }

    /// Parts of a deposit from the barrier upstream, and where the surface meets the bed (m).
    fn parts(&self, profile: &Profile, height: f64, surface: Surface) -> (Vec<Part>, Option<f64>) {
        // The top of the deposit at the barrier, level and plumb.
        let (sine, cosine) = libm::sincos(self.slope);
        let top_along = -height * libm::tan(self.lean);
        let top = [top_along * cosine + height * sine, height * cosine - top_along * sine];
        match &self.relief {
            Some(relief) => self.over_a_raster(relief, profile, surface, top),
            None => self.over_reaches(profile, surface, top, height),
        }
    }

    /// Parts over reaches in a section, reach by reach: where the depth d changes evenly with the way, ∫ A(d) dx is that of S with d.
    fn over_reaches(
        &self,
        profile: &Profile,
        surface: Surface,
        [top_x, top_z]: [f64; 2],
        height: f64,
    ) -> (Vec<Part>, Option<f64>) {
        let cosine = libm::cos(self.slope);
        // Plumb area under a plumb depth, and its integral over that.
        let area = |depth: f64| self.section.area(depth * cosine) / cosine;
        let moment = |depth: f64| self.section.moment(depth * cosine) / (cosine * cosine);
        let over = |way: f64, [from, to]: [f64; 2]| {
            if (from - to).abs() > NEARLY_EVEN * from.max(to) {
                way * (moment(from) - moment(to)) / (from - to)
            } else {
                way * area(0.5 * (from + to))
            }
        };
        let under = |x: f64, level: f64| area(level - profile.elevation(x));
        let mut parts = face_parts(&under, profile, surface, [top_x, top_z], height / STEPS);
        let (mut x, mut z) = behind_the_face(profile, surface, [top_x, top_z], height / STEPS);
        let furthest = x - FURTHEST * height;
        let corners = profile.corners();
        let mut ahead = corners.partition_point(|corner| corner[0] < x);
        while x > furthest {
            ahead = ahead.saturating_sub(1);
            let corner = corners.get(ahead).filter(|corner| corner[0] < x);
            let to = corner.map_or(furthest, |corner| corner[0].max(furthest));
            let falls = profile.falls(0.5 * (x + to));
            let next = z + surface.falls(falls) * (x - to);
            let [near, far] = [z - profile.elevation(x), next - profile.elevation(to)];
            if far <= 0.0 {
                let way = near / (near - far) * (x - to);
                parts.push(Part { falls, volume: over(way, [near, 0.0]) });
                return (parts, Some(x - way));
            }
            parts.push(Part { falls, volume: over(x - to, [near, far]) });
            (x, z) = (to, next);
        }
        (parts, None)
    }

    /// Parts over a raster, from row to row; a deposit that comes to an edge of what the raster tells has no end that is known.
    fn over_a_raster(
        &self,
        relief: &Relief,
        profile: &Profile,
        surface: Surface,
        top: [f64; 2],
    ) -> (Vec<Part>, Option<f64>) {
        let known = std::cell::Cell::new(true);
        let under = |x: f64, level: f64| {
            let (area, edge) = relief.area_under(x, level, relief.thalweg()[relief.nearest_row(x)]);
            if edge || x < relief.stretch()[0] {
                known.set(false);
            }
            area
        };
        let step = relief.x(1) - relief.x(0);
        let mut parts = face_parts(&under, profile, surface, top, step);
        let (mut x, mut z) = behind_the_face(profile, surface, top, step);
        let corners = profile.corners();
        for _ in 0..MOST_STEPS {
            // No step goes over a break of the bed.
            let upstream = corners.partition_point(|corner| corner[0] < x - 1e-9 * step);
            let corner = upstream.checked_sub(1).map(|last| corners[last][0]);
            let to = corner.map_or(x - step, |corner| corner.max(x - step));
            let falls = profile.falls(0.5 * (x + to));
            let next = z + surface.falls(falls) * (x - to);
            let [near, far] = [z - profile.elevation(x), next - profile.elevation(to)];
            if far <= 0.0 {
                let share = (near / (near - far)).clamp(0.0, 1.0);
                let end = x - share * (x - to);
                let volume = (x - end) * third(&under, [x, z], [end, profile.elevation(end)]);
                parts.push(Part { falls, volume });
                return (parts, known.get().then_some(end));
            }
            parts.push(Part { falls, volume: (x - to) * third(&under, [x, z], [to, next]) });
            if !known.get() {
                return (parts, None);
            }
            (x, z) = (to, next);
        }
        (parts, None)
    }

    /// Height at the barrier, normal to the bed, of a deposit of a volume over the width (m²) whose surface falls upstream at an angle ψ below
    /// the horizontal. ψ = 0 is the level surface of a fluid; a granular flow that is stopped while it runs up leaves a heap against the
    /// barrier, and ψ may be as much as its angle of repose. Infinite where the surface does not meet the bed.
    pub fn height(&self, per_width: f64, falls: f64) -> f64 {
        let spread = libm::tan(self.slope + falls).recip() + libm::tan(self.lean);
        if self.profile.is_some() {
            return self.height_once(per_width * self.width, Surface::Plane(-falls));
        }
        // On a level bed a level surface holds any volume at no height, but no channel is level for ever: how high it stands is not known.
        let meets = spread > 0.0 && self.slope + falls > 0.0;
        if !(meets && self.slope + falls < std::f64::consts::FRAC_PI_2 + self.lean) {
            return f64::INFINITY;
        }
        match &self.section {
            Section::Rectangle { .. } => (2.0 * per_width / spread).sqrt(),
            section @ Section::Surveyed(_) => section.height_of_moment(per_width * self.width / spread),
        }
    }

    /// The same reservoir is asked for the same height by every check, and by every sample of a study that changes other things.
    fn height_once(&self, volume: f64, surface: Surface) -> f64 {
        let known = |found: &Found| {
            found.volume == volume
                && found.surface == surface
                && [found.of.slope, found.of.lean] == [self.slope, self.lean]
                && match (&found.of.relief, &self.relief) {
                    (Some(one), Some(other)) => Arc::ptr_eq(one, other),
                    (None, None) => true,
                    _ => false,
                }
                && found.of.section == self.section
                && found.of.profile == self.profile
        };
        if let Some(height) = FOUND.with_borrow(|found| found.iter().find(|found| known(found)).map(|it| it.height)) {
            return height;
        }
        let height = self.height_by_search(volume, surface);
        FOUND.with_borrow_mut(|found| {
            found.truncate(REMEMBERED - 1);
            found.push_front(Found { of: self.clone(), volume, surface, height });
        });
        height
    }

    fn height_by_search(&self, volume: f64, surface: Surface) -> f64 {
        let holds = |height: f64| self.stored(height, surface, 0.0).map(|stored| stored.volume);
        if volume <= 0.0 {
            return 0.0;
        }
        let [mut low, mut high] = self.bracket(volume, surface).unwrap_or([0.0, 1.0]);
        loop {
            match holds(high) {
                // On a raster it may have come to an edge: beyond the highest that is known, how high it stands is not.
                None if self.relief.is_some() => {
                    let known = self.highest_known(surface, [low, high]);
                    if holds(known).is_none_or(|held| held < volume) {
                        return f64::INFINITY;
                    }
                    high = known;
                    break;
                }
                // The last reach goes on for ever, so that such a surface would hold any volume; but no channel does.
                None => return f64::INFINITY,
                Some(held) if held >= volume => break,
                Some(_) => (low, high) = (high, 2.0 * high),
            }
            if high > 1e4 {
                return f64::INFINITY;
            }
        }
        // Regula falsi on the square root, which is near to straight, with halving where one end stays (Illinois).
        let off = |height: f64| holds(height).map_or(f64::INFINITY, |held| held.max(0.0).sqrt()) - volume.sqrt();
        let (mut below, mut above) = (off(low.max(f64::MIN_POSITIVE)), off(high));
        let mut stays = 0;
        for _ in 0..MOST_TRIES {
            if high - low <= CLOSE * high {
                break;
            }
            let straight = low - below * (high - low) / (above - below);
            let next = if straight > low && straight < high { straight } else { 0.5 * (low + high) };
            let found = off(next);
            if found < 0.0 {
                (low, below) = (next, found);
                if stays < 0 {
                    above *= 0.5;
                }
                stays = -1;
            } else {
                (high, above) = (next, found);
                if stays > 0 {
                    below *= 0.5;
                }
                stays = 1;
            }
            if found.abs() <= CLOSE * volume.sqrt() {
                return next;
            }
        }
        high
    }

    /// Heights close below and above that of a volume (m), sought from that on an even bed; nothing where they are not.
    fn bracket(&self, volume: f64, surface: Surface) -> Option<[f64; 2]> {
        let holds = |height: f64| self.stored(height, surface, 0.0).map(|stored| stored.volume);
        let spread = libm::tan(self.slope - surface.slope(self.slope)).recip() + libm::tan(self.lean);
        if !(spread > 0.0 && spread.is_finite()) {
            return None;
        }
        let even = Some(self.section.height_of_moment(volume / spread)).filter(|height| height.is_normal())?;
        // Volumes go about with the square of the height.
        let mut near = even;
        for _ in 0..CLOSER {
            near *= (volume / holds(near)?).sqrt();
        }
        let around = [0.99 * near, 1.01 * near];
        (holds(around[0])? < volume && holds(around[1])? >= volume).then_some(around)
    }

    /// The largest height of a deposit whose end is known, between one that is known and one that is not (m).
    fn highest_known(&self, surface: Surface, [mut known, mut unknown]: [f64; 2]) -> f64 {
        while unknown - known > 1e-3 * unknown {
            let middle = 0.5 * (known + unknown);
            if self.stored(middle, surface, 0.0).is_some() { known = middle } else { unknown = middle }
        }
        known
    }

    /// Height that a deposit with a level surface surely has whose height is not known: of the largest that the raster tells of (m).
    pub fn higher_than(&self) -> f64 {
        let level = Surface::Plane(0.0);
        let mut high = 1e-3;
        while high < 1e4 && self.stored(high, level, 0.0).is_some() {
            high *= 2.0;
        }
        self.highest_known(level, [0.0, high])
    }

    /// What the barrier holds up to a height, nothing where the surface does not meet the bed.
    pub fn retention(&self, height: f64, surface: Surface, flow_volume: f64) -> Option<Retention> {
        let stored = self.stored(height, surface, 0.0)?;
        let deposit = Deposit { slope: self.slope, lean: self.lean, height, surface: surface.slope(self.slope) };
        let surges = stored.volume / flow_volume;
        Some(Retention { deposit, volume: stored.volume, length: stored.length, surges })
    }
}

/// A part of a deposit: tan of the bed's slope below it, and its volume (m³).
struct Part {
    falls: f64,
    volume: f64,
}

/// What the parts pull with, from the one furthest upstream on (m³); it is never negative, since a deposit bears no tension.
fn pull_of(parts: &[Part], friction: f64) -> f64 {
    parts.iter().rev().fold(0.0, |pull: f64, part| (pull + part.volume * (part.falls - friction)).max(0.0))
}

/// Parts between the foot of a face and its top: what is under the face is taken off, or added where it leans upstream.
fn face_parts(
    under: &impl Fn(f64, f64) -> f64,
    profile: &Profile,
    surface: Surface,
    [top_x, top_z]: [f64; 2],
    step: f64,
) -> Vec<Part> {
    if top_x == 0.0 {
        return Vec::new();
    }
    let at_the_foot = profile.falls(-0.5 * step);
    let pieces = (top_x.abs() / step).ceil().max(1.0) as usize;
    let part = |piece: usize| {
        let x = top_x * (piece as f64 + 0.5) / pieces as f64;
        let face = under(x, top_z * x / top_x);
        let area = if top_x < 0.0 { face } else { under(x, top_z - surface.falls(at_the_foot) * (x - top_x)) - face };
        Part { falls: profile.falls(x), volume: area * top_x.abs() / pieces as f64 }
    };
    (0..pieces).map(part).collect()
}

/// Where the surface goes on upstream of a face, and how high it is there (m).
fn behind_the_face(profile: &Profile, surface: Surface, [top_x, top_z]: [f64; 2], step: f64) -> (f64, f64) {
    let falls = surface.falls(profile.falls(-0.5 * step));
    (top_x.min(0.0), top_z + if top_x > 0.0 { falls * top_x } else { 0.0 })
}

/// Mean area over a step between two places with their levels, by Simpson's rule.
fn third(area: &impl Fn(f64, f64) -> f64, near: [f64; 2], far: [f64; 2]) -> f64 {
    let middle = area(0.5 * (near[0] + far[0]), 0.5 * (near[1] + far[1]));
    (area(near[0], near[1]) + 4.0 * middle + area(far[0], far[1])) / 6.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// A rectangle on an even bed.
    fn even(width: f64, slope: f64, lean: f64) -> Reservoir {
        Reservoir { section: Section::Rectangle { width }, width, slope, lean, profile: None, relief: None }
    }

    /// Height of a volume over the width, with a surface that falls upstream.
    fn deposit_height(per_width: f64, slope: f64, falls: f64, lean: f64) -> f64 {
        even(3.0, slope, lean).height(per_width, falls)
    }

    /// An even bed told as a profile is the same bed, whatever the lean of the barrier and the slope of the surface.
    #[test]
    fn the_sum_along_an_even_bed_is_the_closed_form() {
        let trapezoid =
            Section::Surveyed(crate::section::Survey::new(&[[-9.0, 8.0], [-1.0, 0.0], [1.0, 0.0], [9.0, 8.0]], 0.1));
        for section in [Section::Rectangle { width: 4.0 }, trapezoid] {
            for (slope, lean) in [(20.0_f64, 20.0_f64), (20.0, 0.0), (12.0, 30.0), (25.0, -10.0)] {
                let [slope, lean] = [slope, lean].map(f64::to_radians);
                let closed =
                    Reservoir { section: section.clone(), width: 4.0, slope, lean, profile: None, relief: None };
                let summed = Reservoir { profile: Some(Profile::new(slope, &[], &[], 0.0)), ..closed.clone() };
                for surface in [Surface::Plane(0.0), Surface::OfTheBed(2.0 / 3.0), Surface::Plane(-0.3)] {
                    let [a, b] = [&closed, &summed].map(|one| one.stored(2.0, surface, 0.2).expect("a deposit"));
                    assert_relative_eq!(a.volume, b.volume, max_relative = 3e-3);
                    assert_relative_eq!(a.pull, b.pull, max_relative = 3e-3);
                }
                assert_relative_eq!(closed.height(3.0, 0.4), summed.height(3.0, 0.4), max_relative = 3e-3);
            }
        }
    }

    /// 4 m wide and plumb, on 20° with 5° from 4 m upstream on. A level surface 3 m high: over the first 4 m the bed rises by 1.456 m; the
    /// other 1.544 m it rises over 17.65 m. (3 + 1.544)/2 · 4 + 1.544 · 17.65/2 = 22.71 m² of section along the bed.
    #[test]
    fn a_flatter_reach_upstream_holds_more() {
        let slope = 20_f64.to_radians();
        let profile = Profile::new(slope, &[[4.0, 5_f64.to_radians()]], &[], 0.0);
        let reach = Reservoir { profile: Some(profile), ..even(4.0, slope, slope) };
        let stored = reach.stored(3.0 * libm::cos(slope), Surface::Plane(0.0), 0.0).expect("a deposit");
        assert_relative_eq!(stored.volume, 4.0 * 22.713, max_relative = 2e-3);
        assert_relative_eq!(stored.length, 21.65, max_relative = 2e-3);
        // Weight pulls with the slope of the bed below it.
        let pull = 4.0 * (9.088 * libm::tan(slope) + 13.625 * libm::tan(5_f64.to_radians()));
        assert_relative_eq!(stored.pull, pull, max_relative = 5e-3);
        assert_relative_eq!(reach.height(22.713, 0.0), 3.0 * libm::cos(slope), max_relative = 2e-3);
        // What a flat reach holds back does not pull on the steep one below it.
        let steep = reach.stored(3.0 * libm::cos(slope), Surface::Plane(0.0), 0.2).expect("a deposit").pull;
        assert_relative_eq!(steep, 4.0 * 9.088 * (libm::tan(slope) - 0.2), max_relative = 2e-3);
        // A level reach that goes on for ever is never filled; how high a deposit stands on one is not known.
        let level = Reservoir { profile: Some(Profile::new(slope, &[[4.0, 0.0]], &[], 0.0)), ..reach };
        assert_eq!(level.stored(3.0, Surface::Plane(0.0), 0.0), None);
        assert_eq!(level.height(1e6, 0.0), f64::INFINITY);
    }

    #[test]
    fn a_level_deposit_fills_the_triangle_behind_the_barrier() {
        let height = deposit_height(10.0, 0.5, 0.0, 0.3);
        assert_relative_eq!(
            0.5 * height * height * (1.0 / libm::tan(0.5_f64) + libm::tan(0.3_f64)),
            10.0,
            max_relative = 1e-12
        );
        // How far a level bed goes on is not known.
        assert_eq!(deposit_height(10.0, 0.0, 0.0, 0.0), f64::INFINITY);
    }

    #[test]
    fn a_heap_at_the_angle_of_repose_stands_higher_than_a_level_deposit() {
        // A triangle of 12.5 m² on a level bed with a surface at 45°: 5 m by 5 m.
        assert_relative_eq!(deposit_height(12.5, 0.0, std::f64::consts::FRAC_PI_4, 0.0), 5.0, max_relative = 1e-12);
        let slope = 5_f64.to_radians();
        let [level, heap] = [0.0, 35_f64.to_radians()].map(|falls| deposit_height(12.5, slope, falls, 0.0));
        assert_relative_eq!(level, 1.479, max_relative = 1e-3);
        assert_relative_eq!(heap, 4.580, max_relative = 1e-3);
        // Too steep to end at the bed.
        assert_eq!(deposit_height(1.0, 1.0, 1.0, 0.0), f64::INFINITY);
    }

    #[test]
    fn matches_the_derived_volume() {
        // Plumb, H_b 5 m filled to 3/4, θ 20°, θ' 13.33°, b 12 m: 664.5 m³ over 29.5 m.
        let slope = 20_f64.to_radians();
        let surface = Surface::Plane(13.333_f64.to_radians());
        let held = even(12.0, slope, slope).retention(3.75 * libm::cos(slope), surface, 332.25).expect("a deposit");
        assert_relative_eq!(held.volume, 664.5, max_relative = 1e-3);
        assert_relative_eq!(held.length, 29.5, max_relative = 2e-3);
        assert_relative_eq!(held.surges, 2.0, max_relative = 1e-3);
    }

    /// A surface that falls by 60° and a bed of 20° meet behind a face that leans by 30°, not behind one that leans downstream by 15°.
    #[test]
    fn a_heap_needs_a_face_that_leans_less_than_its_surface_is_steep() {
        let height = |lean: f64| deposit_height(2.0, 20_f64.to_radians(), 60_f64.to_radians(), lean.to_radians());
        let by_hand = (4.0 / (1.0 / 5.671_282 + 0.577_350_f64)).sqrt();
        assert_relative_eq!(height(30.0), by_hand, max_relative = 1e-6);
        assert_eq!(height(-15.0), f64::INFINITY);
        // Beyond the plumb of the bed's normal the surface overhangs.
        let steep = deposit_height(2.0, 40_f64.to_radians(), 60_f64.to_radians(), 20_f64.to_radians());
        assert_relative_eq!(steep, (4.0 / (-0.176_327 + 0.363_970_f64)).sqrt(), max_relative = 1e-5);
        assert_eq!(deposit_height(2.0, 40_f64.to_radians(), 60_f64.to_radians(), 5_f64.to_radians()), f64::INFINITY);
    }
}
