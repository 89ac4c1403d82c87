//! The film, packed small enough to travel in the page: what `templates/replay.js` unpacks and draws.
//!
//! Every quantity is a channel: an integer of one or two bytes for each body in each frame. Places are given in steps of 1/65534 of
//! the scene's largest extent (65535 stands for a grain that is gone), the rest in steps of 1/255 (axes 1/127) of its largest
//! value. A channel is stored as differences: from frame to frame where it has one byte, the differences of the differences where it
//! has two, low bytes before high bytes. All channels one after the other are deflated (zlib) and written in base 64.

use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use serde::Serialize;

use crate::report::segment_kinds::{DRAWN_WIDTHS, code};
use dem::Vec3;
use dem::recorders::film::{Film, Frame, Pose};

/// Size that the packed film must not exceed (bytes of base 64): the page is to stay below 4 MB.
const MOST_BYTES: usize = 2_900_000;
/// Grains shown at the most; of more, every other, every third, … is shown.
const MOST_GRAINS: usize = 20_000;
/// A film with fewer frames is no film.
const FEWEST_FRAMES: usize = 12;
/// Largest place in steps; what is above means: gone.
const STEPS: f32 = 65534.0;
const GONE: u16 = 65535;

#[derive(Debug, Serialize)]
pub struct Replay {
    /// JSON that the viewer reads first.
    pub head: String,
    pub data: String,
    /// What is shown, in words.
    pub note: String,
}

#[derive(Serialize)]
struct Head {
    times: Vec<f64>,
    grains: usize,
    nodes: usize,
    /// Radius and offset of each grain (mm).
    looks: Vec<[u32; 2]>,
    /// Nodes of each element of the barrier, and its kind as numbered by [`code`].
    ropes: Vec<[u32; 3]>,
    /// Half the width at which each kind is drawn (pixels).
    widths: [f32; 6],
    origin: [f32; 3],
    /// Largest extent of the scene (m), of which places are shares.
    extent: f32,
    /// Largest values of speed (m/s), force on the barrier (N) and tension (N).
    speed: f32,
    force: f32,
    tension: f32,
    /// Corners of the flat pieces of the ground (m); empty for a level bed between vertical walls.
    ground: Vec<Vec<[f32; 3]>>,
    /// Of the channel (m), its slope (rad), and the top of a rigid wall over its foot (m along the channel, m normal to the bed), zeros for a net.
    width: f64,
    slope: f64,
    wall: [f64; 2],
    /// Where the wall ends across the channel (m).
    wall_ends: [f64; 2],
}

/// The channel that the film was taken in.
#[derive(Clone, Debug)]
pub struct Stage {
    /// Flat pieces of the ground; empty for a level bed between vertical walls.
    pub ground: Vec<Vec<Vec3>>,
    /// m
    pub width: f64,
    /// rad
    pub slope: f64,
    /// Top of a rigid wall over its foot (m along the channel, m normal to the bed), if that is the barrier.
    pub wall: Option<[f64; 2]>,
    /// Where it ends across the channel (m).
    pub wall_ends: [f64; 2],
}

/// Packs a film, with fewer frames if it would be too large; nothing if there is too little to show.
pub fn pack(film: &Film, stage: &Stage) -> Option<Replay> {
    let share = film.looks.len().div_ceil(MOST_GRAINS).max(1);
    let mut count = film.frames.len();
    while count >= FEWEST_FRAMES {
        let frames: Vec<&Frame> = chosen(&film.frames, count);
        let (head, data) = Packer::new(film, &frames, share).pack(stage)?;
        if data.len() <= MOST_BYTES {
            let some = match share {
                1 => String::new(),
                _ => format!("; one grain of {share} is shown"),
            };
            let last = frames.last().map_or(0.0, |frame| frame.time);
            let note = format!("{count} moments over {last:.1} s, straight lines between them{some}");
            return Some(Replay { head: serde_json::to_string(&head).ok()?, data, note });
        }
        count = (count * MOST_BYTES / data.len()).min(count - 1);
    }
    None
}

/// `count` frames, evenly spread, the first and the last among them.
fn chosen(frames: &[Frame], count: usize) -> Vec<&Frame> {
    (0..count).map(|index| &frames[index * (frames.len() - 1) / (count - 1)]).collect()
}

struct Packer<'a> {
    film: &'a Film,
    frames: &'a [&'a Frame],
    /// One grain of so many is shown.
    share: usize,
    origin: [f32; 3],
    extent: f32,
}

impl<'a> Packer<'a> {
    fn new(film: &'a Film, frames: &'a [&'a Frame], share: usize) -> Self {
        let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        let mut packer = Self { film, frames, share, origin: low, extent: 0.0 };
        let places = frames.iter().flat_map(|frame| packer.poses(frame).flatten().map(|pose| pose.place));
        let nodes = frames.iter().flat_map(|frame| frame.nodes.iter().copied());
        for place in places.chain(nodes) {
            for axis in 0..3 {
                low[axis] = low[axis].min(place[axis]);
                high[axis] = high[axis].max(place[axis]);
            }
        }
        packer.origin = low;
        packer.extent = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f32::max);
        packer
    }

    fn poses<'b>(&self, frame: &'b Frame) -> impl Iterator<Item = Option<&'b Pose>> + use<'b> {
        frame.grains.iter().step_by(self.share).map(Option::as_ref)
    }

    fn pack(&self, stage: &Stage) -> Option<(Head, String)> {
        if !(self.extent > 0.0 && self.extent.is_finite()) {
            return None;
        }
        let largest =
            |values: &dyn Fn(&Frame) -> f32| self.frames.iter().map(|frame| values(frame)).fold(0.0, f32::max);
        let of_poses =
            |frame: &Frame, value: fn(&Pose) -> f32| self.poses(frame).flatten().map(value).fold(0.0, f32::max);
        let speed = largest(&|frame| of_poses(frame, |pose| pose.speed));
        let force = largest(&|frame| of_poses(frame, |pose| pose.force));
        let tension = largest(&|frame| frame.tensions.iter().copied().fold(0.0, f32::max));
        let looks = self.film.looks.iter().step_by(self.share);
        // To the millimetre.
        let corner = |place: &Vec3| [place.x, place.y, place.z].map(|length| (1e3 * length).round() as f32 / 1e3);
        let head = Head {
            times: self.frames.iter().map(|frame| (frame.time * 1e4).round() / 1e4).collect(),
            grains: looks.len(),
            nodes: self.frames[0].nodes.len(),
            looks: looks.map(|look| look.map(|length| (1e3 * length).round() as u32)).collect(),
            ropes: self.film.ropes.iter().map(|(nodes, of)| [nodes[0], nodes[1], code(of).into()]).collect(),
            widths: DRAWN_WIDTHS,
            origin: self.origin,
            extent: self.extent,
            speed,
            force,
            tension,
            ground: stage.ground.iter().map(|piece| piece.iter().map(corner).collect()).collect(),
            width: stage.width,
            slope: stage.slope,
            wall: stage.wall.unwrap_or_default(),
            wall_ends: stage.wall_ends,
        };
        let mut bytes = Vec::new();
        for axis in 0..3 {
            self.wide(&mut bytes, |frame| {
                self.poses(frame).map(|pose| pose.map_or(GONE, |pose| self.step(pose.place[axis], axis))).collect()
            });
        }
        for axis in 0..3 {
            self.wide(&mut bytes, |frame| frame.nodes.iter().map(|node| self.step(node[axis], axis)).collect());
        }
        for axis in 0..3 {
            self.narrow(&mut bytes, |frame| {
                let share = |pose: &Pose| (127.0 * pose.axis[axis]).round().clamp(-127.0, 127.0) as i8 as u8;
                self.poses(frame).map(|pose| pose.map_or(0, share)).collect()
            });
        }
        let share =
            |value: f32, most: f32| (255.0 * value / most.max(f32::MIN_POSITIVE)).round().clamp(0.0, 255.0) as u8;
        self.narrow(&mut bytes, |frame| {
            self.poses(frame).map(|pose| pose.map_or(0, |pose| share(pose.speed, speed))).collect()
        });
        self.narrow(&mut bytes, |frame| {
            self.poses(frame).map(|pose| pose.map_or(0, |pose| share(pose.force, force))).collect()
        });
        self.narrow(&mut bytes, |frame| frame.tensions.iter().map(|value| share(*value, tension)).collect());
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::new(8));
        encoder.write_all(&bytes).ok()?;
        Some((head, STANDARD.encode(encoder.finish().ok()?)))
    }

    fn step(&self, place: f32, axis: usize) -> u16 {
        (STEPS * (place - self.origin[axis]) / self.extent).round().clamp(0.0, STEPS) as u16
    }

    /// A channel of two bytes.
    fn wide(&self, bytes: &mut Vec<u8>, values: impl Fn(&Frame) -> Vec<u16>) {
        let mut past: [Vec<u16>; 2] = Default::default();
        let (mut low, mut high) = (Vec::new(), Vec::new());
        for frame in self.frames {
            let now = values(frame);
            past.iter_mut().for_each(|past| past.resize(now.len(), 0));
            for (index, value) in now.iter().enumerate() {
                let foreseen = past[0][index].wrapping_mul(2).wrapping_sub(past[1][index]);
                let [first, second] = value.wrapping_sub(foreseen).to_le_bytes();
                low.push(first);
                high.push(second);
            }
            past = [now, std::mem::take(&mut past[0])];
        }
        bytes.append(&mut low);
        bytes.append(&mut high);
    }

    /// A channel of one byte.
    fn narrow(&self, bytes: &mut Vec<u8>, values: impl Fn(&Frame) -> Vec<u8>) {
        let mut past = Vec::new();
        for frame in self.frames {
            let now = values(frame);
            past.resize(now.len(), 0);
            bytes.extend(now.iter().zip(&past).map(|(now, past)| now.wrapping_sub(*past)));
            past = now;
        }
    }
}
