//! Cylinder: a straight piece of wire rope with axial, bending and twisting stiffness between two nodes that turn.
//!
//! The element is the Euler-Bernoulli beam in a frame that goes with it (co-rotational): the first axis e₁ runs from node to
//! node, the second lies between those of the two nodes, so that rigid motion strains nothing, however large. With L the
//! length now, L₀ at rest, θ₁ and θ₂ the rotations of the nodes against that frame,
//!
//! N = EA/L₀ (L − L₀),  M₁ = EI/L₀ (4 θ₁ + 2 θ₂),  M₂ = EI/L₀ (2 θ₁ + 4 θ₂) across e₁,  T = GJ/L₀ (θ₂ − θ₁) along it,
//!
//! and the shear force (M₁ + M₂)/L keeps the balance of moments, so that momentum and angular momentum are conserved
//! to rounding. For a round section I = πR⁴/4 and J = πR⁴/2; this is the pair k_t = 12 EI/L³ at mid-length and k_b = EI/L
//! of Albaba 2015, section 4.3.1, with the true I and J (the printed ones are half).

use serde::{Deserialize, Serialize};

use nalgebra::{Quaternion, UnitQuaternion};

use crate::Vec3;
use crate::elements::segment::AxialMember;
use crate::elements::segment::SegmentKind;
use crate::elements::strength::Strength;
use crate::simd::eight::{Eight, LANES, Row, each_lane, joined, parted};
use crate::simd::quad::Quad;
use crate::simd::real::{Real, Triple, add_scaled, cross, dot, minus, negative, plus, scaled};
use crate::simd::widest::{Work, with_widest};
use crate::tables::nodes::{Frame, Node};
use crate::time::integrate::small_turn;

/// Rounds over the two ends of a cylinder that yields in bending; each leaves a quarter of what is wrong.
const HINGE_ROUNDS: usize = 12;

/// A cylinder between two nodes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cylinder {
    pub nodes: [u32; 2],
    pub kind: SegmentKind,
    /// m
    pub rest_length: f64,
    pub section: Section,
    /// Damping over stiffness along the axis (s).
    pub damping_time: f64,
    /// The same against bending and twisting (s).
    pub turning_time: f64,
    /// Frame of the cylinder at rest as each node sees it: turned by the node's orientation it is the node's own axes.
    pub rest_frames: [UnitQuaternion<f64>; 2],
    pub strength: Strength,
}

/// Stiffness of a cross-section.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Section {
    /// m
    pub radius: f64,
    /// EA (N)
    pub axial: f64,
    /// EI (N m²)
    pub bending: f64,
    /// GJ (N m²)
    pub twisting: f64,
}

impl Section {
    /// A solid round section of `radius` (m), Young's modulus (Pa) and Poisson's ratio.
    pub fn round(radius: f64, modulus: f64, poisson: f64) -> Self {
        let area = std::f64::consts::PI * radius * radius;
        let bending = modulus * area * radius * radius / 4.0;
        // J = 2 I, G = E/(2 (1 + ν)).
        Self { radius, axial: modulus * area, bending, twisting: bending / (1.0 + poisson) }
    }
}

/// What a cylinder does to its nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Strain<R = f64> {
    /// Axial force (N), tension positive.
    pub tension: R,
    /// Force on the second node (N); the first gets the opposite.
    pub force: Triple<R>,
    /// Moments on the nodes (N m).
    pub moments: [Triple<R>; 2],
    /// Elastic energy (J).
    pub stored: R,
    /// Dissipated power (W).
    pub power_lost: R,
}

impl Cylinder {
    pub fn member(&self) -> AxialMember {
        AxialMember { nodes: self.nodes, kind: self.kind, rest_length: Some(self.rest_length) }
    }

    /// A cylinder that is at rest as its nodes lie and are turned now.
    pub fn between(
        nodes: [u32; 2],
        kind: SegmentKind,
        section: Section,
        places: [&Vec3; 2],
        frames: [&Frame; 2],
    ) -> Self {
        let line = places[1] - places[0];
        let own = frame_along(&line);
        Self {
            nodes,
            kind,
            rest_length: line.norm(),
            section,
            damping_time: 0.0,
            turning_time: 0.0,
            rest_frames: frames.map(|frame| frame.orientation.inverse() * own),
            strength: Strength::default(),
        }
    }

    /// Lets the cylinder break: it does nothing more to its nodes.
    pub fn part(&mut self) {
        self.strength.broken = true;
        (self.section.axial, self.section.bending, self.section.twisting) = (0.0, 0.0, 0.0);
    }

    /// Whether a strain may be more than the cylinder withstands; its dashpots make that a little early.
    #[inline]
    pub fn doubtful(&self, strain: &Strain) -> bool {
        let least = self.strength.least();
        if least == f64::INFINITY {
            return false;
        }
        let [across, along] = self.strength.moments(self.section.radius);
        let moment = across.min(along);
        strain.tension > least || strain.moments.iter().any(|&of| dot(of, of) > moment * moment)
    }

    /// The cylinder as its nodes lie and move now.
    fn bent(&self, nodes: &[Node], frames: &[Frame]) -> Bent<f64> {
        let [a, b] = self.nodes.map(|node| node as usize);
        Bent {
            line: (nodes[b].position - nodes[a].position).into(),
            parting: (nodes[b].velocity - nodes[a].velocity).into(),
            orientations: [a, b].map(|node| frames[node].orientation.coords.into()),
            spins: [a, b].map(|node| frames[node].spin.into()),
            rest_frames: self.rest_frames.map(|frame| frame.coords.into()),
            rest_length: self.rest_length,
            axial: self.section.axial,
            bending: self.section.bending,
            twisting: self.section.twisting,
            damping_time: self.damping_time,
            turning_time: self.turning_time,
        }
    }

    /// What becomes of the cylinder where it is overloaded: itself as it is after, the strain that goes with it, and the
    /// energy lost by giving way in the step just made, of length `step` (J).
    ///
    /// Elastic and after the yield, primed and not: lost = E' − E − ½ Σ (Q' − Q) Δq over the axial force with the elongation
    /// and the end moments with the turns of the step, as for a rope segment.
    pub fn give_way(&self, nodes: &[Node], frames: &[Frame], step: f64) -> Option<(Self, Strain, f64)> {
        let undamped = Self { damping_time: 0.0, turning_time: 0.0, ..self.clone() };
        let before = undamped.bent(nodes, frames);
        let elastic = before.strain();
        let mut after = self.clone();
        if elastic.tension > self.strength.breaking {
            after.part();
        } else {
            after.draw_out(elastic.tension, dot(before.line, before.line).sqrt());
            after.turn_out(&before, frames);
            if after == *self {
                return None;
            }
        }
        let kept = Self { damping_time: 0.0, turning_time: 0.0, ..after.clone() }.bent(nodes, frames).strain();
        let [stretched, turned1, turned2] = before.moved(step);
        let work = (elastic.tension - kept.tension) * stretched[0]
            - dot(minus(elastic.moments[0], kept.moments[0]), turned1)
            - dot(minus(elastic.moments[1], kept.moments[1]), turned2);
        let lost = elastic.stored - kept.stored - 0.5 * work;
        let strain = after.bent(nodes, frames).strain();
        Some((after, strain, lost))
    }

    /// Lets the axis yield under `tension` (N) at its present `length` (m).
    fn draw_out(&mut self, tension: f64, length: f64) {
        if tension <= self.strength.elastic {
            return;
        }
        let rest_length = self.strength.rest_length_at_limit(self.section.axial, length);
        self.strength.drawn_out += rest_length - self.rest_length;
        self.rest_length = rest_length;
    }

    /// Lets the ends yield where bending or twisting is beyond the limits: turns the frames at rest by what is too much.
    fn turn_out(&mut self, before: &Bent<f64>, frames: &[Frame]) {
        let [most_across, most_along] = self.strength.moments(self.section.radius);
        let (along, first, last) = before.turns();
        let k = before.bending / before.rest_length;
        let (moment1, moment2) = bending_moments(k, along, first, last);
        let twist = dot(minus(last, first), along);
        let torque = before.twisting / before.rest_length * twist;
        let beyond = |moment: Triple<f64>| scaled(moment, (1.0 - most_across / dot(moment, moment).sqrt()).max(0.0));
        let over_twist = twist * (1.0 - most_along / torque.abs()).max(0.0);
        // A hinge at one end eases the other by half, so that a few rounds settle both; a turn may shrink again.
        let (mut turn1, mut turn2) = ([0.0; 3], [0.0; 3]);
        for _ in 0..HINGE_ROUNDS {
            turn1 = scaled(beyond(add_scaled(moment1, -2.0 * k, turn2)), 0.25 / k);
            turn2 = scaled(beyond(add_scaled(moment2, -2.0 * k, turn1)), 0.25 / k);
        }
        let half_twist = scaled(along, 0.5 * over_twist);
        let turns = [minus(turn1, half_twist), plus(turn2, half_twist)];
        if turns == [[0.0; 3]; 2] {
            return;
        }
        for ((rest, node), turn) in self.rest_frames.iter_mut().zip(self.nodes).zip(turns) {
            let orientation = frames[node as usize].orientation;
            let back = small_turn(&-Vec3::from(turn));
            *rest = orientation.inverse() * back * orientation * *rest;
        }
    }
}

/// A cylinder as its nodes lie and move now, or several side by side. Turns are quaternions with the real part last.
pub struct Bent<R> {
    /// From node to node (m), and how fast it changes (m/s).
    pub line: Triple<R>,
    pub parting: Triple<R>,
    pub orientations: [[R; 4]; 2],
    /// rad/s
    pub spins: [Triple<R>; 2],
    pub rest_frames: [[R; 4]; 2],
    /// m
    pub rest_length: R,
    /// EA (N), EI and GJ (N m²).
    pub axial: R,
    pub bending: R,
    pub twisting: R,
    /// s
    pub damping_time: R,
    pub turning_time: R,
}

impl<R: Real> Bent<R> {
    // No closures and no `map`: the compiler would not put vector instructions into them.
    #[inline(always)]
    pub fn strain(&self) -> Strain<R> {
        let one = R::all(1.0);
        let length = dot(self.line, self.line).root();
        let (along, first, last) = self.turns();
        let stretch = length - self.rest_length;
        let per_length = one / self.rest_length;
        let (k_axial, k_bend, k_twist) =
            (self.axial * per_length, self.bending * per_length, self.twisting * per_length);
        // Rates; rigid turning of the frame, seen from the nodes, is that of the line between them.
        let turning = scaled(cross(along, self.parting), one / length);
        let (rate1, rate2) = (minus(self.spins[0], turning), minus(self.spins[1], turning));
        let rate = dot(self.parting, along);
        let k_lossy = k_bend * self.turning_time;
        let (elastic1, elastic2) = bending_moments(k_bend, along, first, last);
        let (lossy1, lossy2) = bending_moments(k_lossy, along, rate1, rate2);
        let twist = dot(minus(last, first), along);
        let twist_rate = dot(minus(rate2, rate1), along);
        let torsion = scaled(along, k_twist * (twist + self.turning_time * twist_rate));
        let tension = k_axial * (stretch + self.damping_time * rate);
        let moments = [minus(torsion, plus(elastic1, lossy1)), negative(plus(torsion, plus(elastic2, lossy2)))];
        let shear = scaled(cross(along, plus(moments[0], moments[1])), one / length);
        let stored = k_axial * stretch * stretch + k_twist * twist * twist + dot(elastic1, first) + dot(elastic2, last);
        let power_lost = self.damping_time * k_axial * rate * rate
            + self.turning_time * k_twist * twist_rate * twist_rate
            + dot(lossy1, rate1)
            + dot(lossy2, rate2);
        Strain { tension, force: add_scaled(shear, -tension, along), moments, stored: stored * 0.5, power_lost }
    }
}

impl<R: Real> Bent<R> {
    /// Direction of the line, and how both nodes are turned against the frame that goes with it (rad).
    #[inline(always)]
    fn turns(&self) -> (Triple<R>, Triple<R>, Triple<R>) {
        let along = unit(self.line);
        let axes1 = axes_of(times(self.orientations[0], self.rest_frames[0]));
        let axes2 = axes_of(times(self.orientations[1], self.rest_frames[1]));
        let third = unit(cross(along, plus(axes1[1], axes2[1])));
        let frame = [along, cross(third, along), third];
        (along, turn_between(&frame, &axes1), turn_between(&frame, &axes2))
    }
}

impl Bent<f64> {
    /// Elongation (m, the first number alone) and turns of both ends against the line (rad) over a step of length `step` (s).
    fn moved(&self, step: f64) -> [Triple<f64>; 3] {
        let length = dot(self.line, self.line).sqrt();
        let along = scaled(self.line, 1.0 / length);
        let turning = scaled(cross(along, self.parting), 1.0 / length);
        let turned = |spin: Triple<f64>| scaled(minus(spin, turning), step);
        [[dot(self.parting, along) * step, 0.0, 0.0], turned(self.spins[0]), turned(self.spins[1])]
    }
}

/// k (4 θ₁ + 2 θ₂) and k (2 θ₁ + 4 θ₂), of the parts of both turns across the line.
#[inline(always)]
fn bending_moments<R: Real>(k: R, along: Triple<R>, first: Triple<R>, last: Triple<R>) -> (Triple<R>, Triple<R>) {
    let first = scaled(add_scaled(first, -dot(first, along), along), k * 2.0);
    let last = scaled(add_scaled(last, -dot(last, along), along), k * 2.0);
    let both = plus(first, last);
    (plus(both, first), plus(both, last))
}

/// One turn after another.
#[inline(always)]
fn times<R: Real>([ax, ay, az, aw]: [R; 4], [bx, by, bz, bw]: [R; 4]) -> [R; 4] {
    let vector = plus(add_scaled(scaled([bx, by, bz], aw), bw, [ax, ay, az]), cross([ax, ay, az], [bx, by, bz]));
    [vector[0], vector[1], vector[2], aw * bw - dot([ax, ay, az], [bx, by, bz])]
}

/// The three axes turned.
#[inline(always)]
fn axes_of<R: Real>([x, y, z, w]: [R; 4]) -> [Triple<R>; 3] {
    let one = R::all(1.0);
    let (x2, y2, z2) = (x * 2.0, y * 2.0, z * 2.0);
    let (xx, yy, zz) = (x * x2, y * y2, z * z2);
    let (xy, yz, xz) = (x * y2, y * z2, x * z2);
    let (wx, wy, wz) = (w * x2, w * y2, w * z2);
    [[one - yy - zz, xy + wz, xz - wy], [xy - wz, one - xx - zz, yz + wx], [xz + wy, yz - wx, one - xx - yy]]
}

#[inline(always)]
fn unit<R: Real>(vector: Triple<R>) -> Triple<R> {
    scaled(vector, R::all(1.0) / dot(vector, vector).root())
}

/// The rotation (rad) that takes the axes e of `from` to the axes t of `to`.
///
/// With S = ½ Σ e × t = n sin θ and Σ e·t = 1 + 2 cos θ the vector v = n sin(θ/2) is S/√(1 + Σ e·t), and θ n = 2 v arcsin|v|/|v| by
/// the series of the arcsine up to |v|⁸: good to 1e-4 up to 69° and to 1e-3 up to a right angle.
#[inline(always)]
fn turn_between<R: Real>(from: &[Triple<R>; 3], to: &[Triple<R>; 3]) -> Triple<R> {
    let sine = plus(plus(cross(from[0], to[0]), cross(from[1], to[1])), cross(from[2], to[2]));
    let cosines = dot(from[0], to[0]) + dot(from[1], to[1]) + dot(from[2], to[2]);
    // Turned by half a revolution the axis is lost; whatever comes near it is beyond any rope.
    let half = scaled(sine, R::all(0.5) / (cosines + 1.0).or_larger(R::all(1e-12)).root());
    let square = dot(half, half);
    let series = square * (square * (square * (square * (35.0 / 1152.0) + 5.0 / 112.0) + 3.0 / 40.0) + 1.0 / 6.0) + 1.0;
    scaled(half, series * 2.0)
}

/// Strains many cylinders, eight side by side, and hands what each does to its nodes to `take`, in their order.
pub fn strain_all(cylinders: &[Cylinder], nodes: &[Node], frames: &[Frame], take: impl FnMut(usize, &Strain)) {
    with_widest(StrainAll { cylinders, nodes, frames, take });
}

/// Rows of numbers that a cylinder is strained from.
const ROWS: usize = 9;

#[inline(always)]
fn columns<E: Eight>(rows: &[Quad; LANES]) -> [E; 4] {
    E::columns(each_lane!(|lane| E::Row::load(&rows[lane])))
}

struct StrainAll<'a, F> {
    cylinders: &'a [Cylinder],
    nodes: &'a [Node],
    frames: &'a [Frame],
    take: F,
}

impl<F: FnMut(usize, &Strain)> Work for StrainAll<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run<E: Eight>(self) {
        let Self { cylinders, nodes, frames, mut take } = self;
        for (part, eight) in cylinders.chunks(LANES).enumerate() {
            let last = eight.len() - 1;
            let mut sheet = [[Quad::default(); LANES]; ROWS];
            for lane in 0..LANES {
                let cylinder = &eight[lane.min(last)];
                let [a, b] = cylinder.nodes.map(|node| node as usize);
                let Section { axial, bending, twisting, .. } = cylinder.section;
                let line = nodes[b].position - nodes[a].position;
                let parting = nodes[b].velocity - nodes[a].velocity;
                sheet[0][lane] = Quad::new(&line, cylinder.rest_length);
                sheet[1][lane] = Quad::new(&parting, cylinder.damping_time);
                sheet[2][lane] = Quad::new(&frames[a].spin, axial);
                sheet[3][lane] = Quad::new(&frames[b].spin, bending);
                sheet[4][lane] = Quad(frames[a].orientation.coords.into());
                sheet[5][lane] = Quad(frames[b].orientation.coords.into());
                sheet[6][lane] = Quad(cylinder.rest_frames[0].coords.into());
                sheet[7][lane] = Quad(cylinder.rest_frames[1].coords.into());
                sheet[8][lane] = Quad([twisting, cylinder.turning_time, 0.0, 0.0]);
            }
            let (line, rest_length) = parted(columns::<E>(&sheet[0]));
            let (parting, damping_time) = parted(columns::<E>(&sheet[1]));
            let (spin1, axial) = parted(columns::<E>(&sheet[2]));
            let (spin2, bending) = parted(columns::<E>(&sheet[3]));
            let [twisting, turning_time, ..] = columns::<E>(&sheet[8]);
            let bent = Bent {
                line,
                parting,
                orientations: [columns::<E>(&sheet[4]), columns::<E>(&sheet[5])],
                spins: [spin1, spin2],
                rest_frames: [columns::<E>(&sheet[6]), columns::<E>(&sheet[7])],
                rest_length,
                axial,
                bending,
                twisting,
                damping_time,
                turning_time,
            };
            let strain = bent.strain();
            let force = E::rows(joined(strain.force, strain.tension));
            let first = E::rows(joined(strain.moments[0], strain.stored));
            let second = E::rows(joined(strain.moments[1], strain.power_lost));
            let mut rows = [[Quad::default(); 3]; LANES];
            each_lane!(|lane| {
                force[lane].store(&mut rows[lane][0]);
                first[lane].store(&mut rows[lane][1]);
                second[lane].store(&mut rows[lane][2]);
            });
            for (lane, [force, first, second]) in rows[..eight.len()].iter().enumerate() {
                let strain = Strain {
                    tension: force.fourth(),
                    force: parted(force.0).0,
                    moments: [parted(first.0).0, parted(second.0).0],
                    stored: first.fourth(),
                    power_lost: second.fourth(),
                };
                take(part * LANES + lane, &strain);
            }
        }
    }
}

/// A frame whose first axis runs along `line`: turned from the x axis by the shortest way, by a half turn about z where that is not one.
/// With the unit vector t along the line the quaternion is (1 + x·t, x × t), made one long.
pub fn frame_along(line: &Vec3) -> UnitQuaternion<f64> {
    let along = line.normalize();
    let turn = Quaternion::from_parts(1.0 + along.x, Vec3::x().cross(&along));
    let half_turn = UnitQuaternion::new_unchecked(Quaternion::new(0.0, 0.0, 0.0, 1.0));
    UnitQuaternion::try_new(turn, 1e-12).unwrap_or(half_turn)
}
