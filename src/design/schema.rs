//! Every key of the design file: meaning, bounds, default. The bounds say what can be, not what is wise.

use crate::design::factor_sets;
use crate::design::key::{Bounded, Key, Kind, quantity};
use crate::design::rope_table::{BREAKING_LOADS, DIAMETERS, MODULI};
use crate::design::{mesh_shape, posts};
use crate::units::Dimension as D;

/// Version of the table below; raised when a file that was good is read differently, or no more.
pub const SCHEMA_VERSION: f64 = 1.0;

const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// Steepest angle of a slope or of friction (rad): 80 degrees.
const STEEPEST: f64 = 80.0 * std::f64::consts::PI / 180.0;
const FRICTION: Kind = quantity(D::Angle, 0.0, STEEPEST);
const GRAIN: Kind = quantity(D::Length, 1e-4, 10.0);
/// From 5 to 89 degrees.
const BANK: Kind = Kind::Steepness { low: 5.0 * DEGREE, high: 89.0 * DEGREE };
const NOTE: Kind = Kind::Text;

/// The whole file.
pub const DESIGN: &[Key] = &[
    Key::default(
        "schema_version",
        Kind::Count { low: 0, high: 1_000_000 },
        "1",
        "version of this table of keys that the file was written for",
    ),
    Key::required("project", Kind::Section(PROJECT), "what the report is about"),
    Key::required("channel", Kind::Section(CHANNEL), "a straight channel: what lies across it, and how it falls"),
    Key::required("flow", Kind::Section(FLOW), "the design flow"),
    Key::required("barrier", Kind::OneOf(BARRIER), "the barrier"),
    Key::default("limits", Kind::Section(LIMITS), "", "what the design must keep"),
    Key::default("factors", Kind::Section(FACTORS), "", "guideline coefficients and partial factors"),
    Key::default("loads", Kind::Section(LOADS), "", "loads beside those of the design flow, and how a deposit stands"),
    Key::default("simulation", Kind::Section(SIMULATION), "", "how to simulate"),
];

const PROJECT: &[Key] = &[
    Key::required("name", NOTE, "name of the project"),
    Key::required("barrier", NOTE, "name of the barrier"),
    Key::default("revision", NOTE, "-", "revision of the design"),
    Key::default("author", NOTE, "-", "who made the design"),
    Key::default("checker", NOTE, "-", "who checks it"),
    Key::default("date", NOTE, "-", "date of the design, in words"),
    Key::default("notes", NOTE, "", "anything the reader of the report should know"),
];

const CHANNEL: &[Key] = &[
    Key::optional(
        "width",
        quantity(D::Length, 0.01, 200.0),
        "width between vertical side walls; give this or the section",
    ),
    Key::optional(
        "section",
        Kind::OneOf(CROSS_SECTION),
        "surveyed section across the gully; give this, the width or a terrain",
    ),
    Key::optional("terrain", Kind::Section(TERRAIN), "raster of the ground; give this, the width or a section"),
    Key::optional(
        "slope",
        quantity(D::Angle, 0.0, STEEPEST),
        "slope of the bed against the horizontal, at the barrier; a terrain tells it unless it is given",
    ),
    Key::optional("profile", Kind::Section(PROFILE), "reaches of the bed with other slopes than that at the barrier"),
    Key::optional(
        "wall_height",
        quantity(D::Length, 0.01, 500.0),
        "height of the side walls, normal to the bed; goes with the width",
    ),
    Key::optional(
        "bed_up_to",
        quantity(D::Angle, 0.0, STEEPEST),
        "slope across the gully up to which the ground beside the lowest point of section.points is bed, beyond which it is bank; by default 25 deg",
    ),
    Key::for_grains("base_friction", FRICTION, "friction angle between grains and bed"),
    Key::for_grains("side_friction", FRICTION, "friction angle between grains and side walls or banks"),
    Key::for_grains("barrier_friction", FRICTION, "friction angle between grains and barrier"),
];

const CROSS_SECTION: &[Key] = &[
    Key::optional("trapezoid", Kind::Section(TRAPEZOID), "a level bed between two even banks"),
    Key::optional(
        "points",
        Kind::Pairs { first: SURVEYED, second: SURVEYED, example: "[[-3 m, 2 m], [0 m, 0 m], [3 m, 2 m]]" },
        "points of the ground, from the left to the right looking downstream: distance and height, both as surveyed (heights vertical)",
    ),
    Key::optional(
        "file",
        Kind::File,
        "the same points as a table with two columns, distance and height, whose head names their units: `distance (m),height (m)`",
    ),
];

/// What a surveyor reads.
const SURVEYED: Bounded = Bounded { dimension: D::Length, low: -1e4, high: 1e4 };
/// From where a reach begins, and its slope.
const REACHES: Kind = Kind::Pairs {
    first: Bounded { dimension: D::Length, low: 0.1, high: 1e4 },
    second: Bounded { dimension: D::Angle, low: 0.0, high: STEEPEST },
    example: "[[25 m, 14 deg], [60 m, 20 deg]]",
};

/// A place in the coordinates of a raster.
const PLACE: Kind = Kind::Pair {
    first: Bounded { dimension: D::Length, low: -1e8, high: 1e8 },
    second: Bounded { dimension: D::Length, low: -1e8, high: 1e8 },
    example: "[2601234.5 m, 1199876.0 m]",
};

const TERRAIN: &[Key] = &[
    Key::required("file", Kind::File, "raster of heights in metres: an ESRI ASCII grid or a GeoTIFF"),
    Key::required("left_end", PLACE, "end of the barrier in the left bank, looking downstream: east, north"),
    Key::required("right_end", PLACE, "end of the barrier in the right bank, looking downstream: east, north"),
    Key::required(
        "upstream",
        quantity(D::Length, 2.0, 1e3),
        "level length of ground upstream of the barrier that is modelled",
    ),
    Key::required(
        "downstream",
        quantity(D::Length, 2.0, 1e3),
        "level length of ground downstream of the barrier that is modelled",
    ),
];

const PROFILE: &[Key] = &[
    Key::optional(
        "upstream",
        REACHES,
        "level distance upstream of the barrier from which the bed has another slope, up to the next entry: [[25 m, 14 deg]]",
    ),
    Key::optional(
        "downstream",
        REACHES,
        "level distance downstream of the barrier from which the bed has another slope, up to the next entry",
    ),
    Key::default(
        "rounded_over",
        quantity(D::Length, 0.0, 100.0),
        "0 m",
        "level length over which a break of slope is rounded, half of it on either side",
    ),
];

const TRAPEZOID: &[Key] = &[
    Key::required("bed_width", quantity(D::Length, 0.01, 200.0), "width of the level bed"),
    Key::required("left_bank", BANK, "slope of the left bank, looking downstream, against the horizontal"),
    Key::required("right_bank", BANK, "slope of the right bank, looking downstream, against the horizontal"),
    Key::required("depth", quantity(D::Length, 0.01, 500.0), "vertical height of the banks above the bed"),
];

const FLOW: &[Key] = &[
    Key::optional("mass", quantity(D::Mass, 1e-3, 1e9), "mass of the flow; give this or the volume"),
    Key::optional("volume", quantity(D::Volume, 1e-6, 1e6), "volume with pores; give this or the mass"),
    Key::optional(
        "event_volume",
        quantity(D::Volume, 1e-6, 1e7),
        "volume with pores of the whole event, where the flow is one of its surges; by default the flow's",
    ),
    Key::required("bulk_density", quantity(D::Density, 300.0, 3500.0), "density of the flow, grains with pores"),
    Key::for_grains("solid_density", quantity(D::Density, 500.0, 8000.0), "density of the grains alone"),
    Key::for_grains("grain_sizes", Kind::OneOf(GRAIN_SIZES), "how large the grains are"),
    Key::default(
        "grain_aspect",
        Kind::Number { low: 1.0, high: 2.0 },
        "1.5",
        "length over width of a grain; 1 is a sphere",
    ),
    Key::for_grains("grain_friction", FRICTION, "friction angle between grains"),
    Key::default("restitution", Kind::Number { low: 0.1, high: 1.0 }, "0.3", "normal restitution of grain contacts"),
    Key::default(
        "contact_modulus",
        quantity(D::Pressure, 1e4, 1e11),
        "0.1 GPa",
        "modulus E of grain contacts: k = 2 E r1 r2/(r1 + r2)",
    ),
    Key::optional(
        "pore_fluid",
        Kind::SectionOrNone(PORE_FLUID),
        "water and mud in the pores, which move with the grains and lower their friction; none, the default, is a dry flow",
    ),
    Key::optional(
        "boulders",
        Kind::Sections(BOULDERS),
        "boulders that the grain-size curve does not have, a part of the flow's mass; they come with the surge, or the first of several",
    ),
    Key::required("arrival", Kind::OneOf(ARRIVAL), "how the flow comes"),
];

const BOULDERS: &[Key] = &[
    Key::required("diameter", quantity(D::Length, 0.02, 10.0), "diameter of a sphere of the same volume"),
    Key::required("number", Kind::Count { low: 1, high: 200 }, "how many"),
    Key::default(
        "where",
        Kind::Choice(&["front", "spread"]),
        "front",
        "ahead of the surge, side by side on the bed with its velocity; or anywhere in it",
    ),
    Key::optional("density", quantity(D::Density, 1500.0, 4000.0), "by default flow.solid_density"),
];

const PORE_FLUID: &[Key] = &[
    Key::required(
        "density",
        quantity(D::Density, 900.0, 1800.0),
        "density of the fluid; the finest of the flow, in suspension, belong to it",
    ),
    Key::required(
        "pressure_ratio",
        Kind::Number { low: 0.0, high: 1.0 },
        "pore pressure over the total pressure as the flow arrives, r_u: friction at the bed, at the banks and between grains is (1 - r_u) tan(phi); density over bulk_density for a fluid at rest, 1 for a flow that floats",
    ),
    Key::required(
        "drains_in",
        quantity(D::Time, 0.001, 1e6),
        "time in which what it has above drains_to falls to 37 % where the flow rests",
    ),
    Key::optional(
        "drains_to",
        Kind::Number { low: 0.0, high: 1.0 },
        "pore pressure ratio that stays; by default that of the fluid at rest, density over bulk_density, or pressure_ratio if that is less; 0 where the fluid runs off through the barrier",
    ),
];

const GRAIN_SIZES: &[Key] = &[
    Key::optional("uniform", Kind::Section(UNIFORM), "uniform in number between two diameters"),
    Key::optional(
        "curve",
        Kind::Section(CURVE),
        "quantiles of the grain-size curve by mass, two or more, from d1 to d100",
    ),
];

const UNIFORM: &[Key] =
    &[Key::required("min", GRAIN, "smallest diameter"), Key::required("max", GRAIN, "largest diameter")];

const CURVE: &[Key] = &[
    Key::optional("d1", GRAIN, "1 % of the mass is finer"),
    Key::optional("d5", GRAIN, "5 % of the mass is finer"),
    Key::optional("d10", GRAIN, "10 % of the mass is finer"),
    Key::optional("d15", GRAIN, "15 % of the mass is finer"),
    Key::optional("d16", GRAIN, "16 % of the mass is finer"),
    Key::optional("d20", GRAIN, "20 % of the mass is finer"),
    Key::optional("d25", GRAIN, "25 % of the mass is finer"),
    Key::optional("d30", GRAIN, "30 % of the mass is finer"),
    Key::optional("d35", GRAIN, "35 % of the mass is finer"),
    Key::optional("d40", GRAIN, "40 % of the mass is finer"),
    Key::optional("d45", GRAIN, "45 % of the mass is finer"),
    Key::optional("d50", GRAIN, "50 % of the mass is finer"),
    Key::optional("d55", GRAIN, "55 % of the mass is finer"),
    Key::optional("d60", GRAIN, "60 % of the mass is finer"),
    Key::optional("d65", GRAIN, "65 % of the mass is finer"),
    Key::optional("d70", GRAIN, "70 % of the mass is finer"),
    Key::optional("d75", GRAIN, "75 % of the mass is finer"),
    Key::optional("d80", GRAIN, "80 % of the mass is finer"),
    Key::optional("d84", GRAIN, "84 % of the mass is finer"),
    Key::optional("d85", GRAIN, "85 % of the mass is finer"),
    Key::optional("d90", GRAIN, "90 % of the mass is finer"),
    Key::optional("d95", GRAIN, "95 % of the mass is finer"),
    Key::optional("d99", GRAIN, "99 % of the mass is finer"),
    Key::optional("d100", GRAIN, "100 % of the mass is finer"),
];

/// The keys of the grain-size curve with their shares of the mass, rising.
pub const QUANTILES: &[(&str, f64)] = &[
    ("d1", 0.01),
    ("d5", 0.05),
    ("d10", 0.1),
    ("d15", 0.15),
    ("d16", 0.16),
    ("d20", 0.2),
    ("d25", 0.25),
    ("d30", 0.3),
    ("d35", 0.35),
    ("d40", 0.4),
    ("d45", 0.45),
    ("d50", 0.5),
    ("d55", 0.55),
    ("d60", 0.6),
    ("d65", 0.65),
    ("d70", 0.7),
    ("d75", 0.75),
    ("d80", 0.8),
    ("d84", 0.84),
    ("d85", 0.85),
    ("d90", 0.9),
    ("d95", 0.95),
    ("d99", 0.99),
    ("d100", 1.0),
];

const ARRIVAL: &[Key] = &[
    Key::optional("dam_break", Kind::Section(DAM_BREAK), "a block at rest behind a gate that opens at once"),
    Key::optional("surge", Kind::Section(SURGE), "a body of grains upstream of the barrier, already moving"),
    Key::optional(
        "surges",
        Kind::Sections(SURGES),
        "surges one after another, each let go upstream of what those before it have left",
    ),
    Key::optional(
        "hydrograph",
        Kind::Section(HYDROGRAPH),
        "the flow by time at an inlet upstream of the barrier, through which its grains come in",
    ),
];

const HYDROGRAPH: &[Key] = &[
    Key::optional(
        "file",
        Kind::File,
        "table of time, depth or discharge, and velocity under a head that names them, as DebrisFrame and RAMMS write it; or give it here",
    ),
    Key::optional("times", Kind::Quantities { dimension: D::Time, low: 0.0, high: 1e6 }, "times of the rows, rising"),
    Key::optional(
        "depths",
        Kind::Quantities { dimension: D::Length, low: 0.0, high: 50.0 },
        "depth of the flow at the inlet at each time, normal to the bed",
    ),
    Key::optional(
        "discharges",
        Kind::Quantities { dimension: D::Discharge, low: 0.0, high: 1e5 },
        "discharge with pores at each time, in the place of the depth or of the velocity",
    ),
    Key::optional(
        "velocities",
        Kind::Quantities { dimension: D::Velocity, low: 0.0, high: 40.0 },
        "velocity of the flow at each time, along the bed",
    ),
    Key::optional("velocity", quantity(D::Velocity, 0.05, 40.0), "velocity at all times, where the table has none"),
    Key::optional(
        "run_in",
        quantity(D::Length, 0.0, 1e3),
        "way from the inlet to the barrier; by default as far as the whole flow reaches back when it lies there with a level surface, and two depths more, at least four depths",
    ),
];

const DAM_BREAK: &[Key] = &[
    Key::required("length", quantity(D::Length, 0.01, 1e3), "length of the block along the channel"),
    Key::optional("height", quantity(D::Length, 0.01, 100.0), "height of the block; by default what the volume needs"),
    Key::required("distance", quantity(D::Length, 0.0, 1e4), "from the gate to the foot of the barrier"),
    Key::optional(
        "depth_at_barrier",
        quantity(D::Length, 0.001, 50.0),
        "depth for the guideline loads; by default 4/9 of the block's height",
    ),
    Key::optional(
        "velocity_at_barrier",
        quantity(D::Velocity, 0.05, 60.0),
        "velocity for the guideline loads; by default that of a block sliding on the bed",
    ),
];

const SURGE: &[Key] = &[
    Key::required("depth", quantity(D::Length, 0.005, 50.0), "depth of the flow, normal to the bed"),
    Key::required("velocity", quantity(D::Velocity, 0.05, 40.0), "velocity of the flow along the bed"),
    Key::optional("length", quantity(D::Length, 0.01, 1e4), "length of the surge; by default what the volume needs"),
    FRONT_ANGLE,
    Key::optional(
        "run_in",
        quantity(D::Length, 0.0, 1e3),
        "way from the front of the surge at its release to the barrier, on which it loosens; by default four times the depth",
    ),
];

const FRONT_ANGLE: Key = Key::optional(
    "front_angle",
    quantity(D::Angle, 5.0 * DEGREE, 90.0 * DEGREE),
    "angle between the front face of the surge and the bed; by default that of a granular front, tan = (1 - r_u) tan(grain_friction) - tan(slope), r_u being flow.pore_fluid.pressure_ratio, at least 15 deg (Pouliquen 1999); 90 deg is a vertical face, which hits a barrier everywhere at once",
);

const SURGES: &[Key] = &[
    Key::optional("volume", quantity(D::Volume, 1e-6, 1e6), "volume with pores; give this or the length"),
    Key::optional("length", quantity(D::Length, 0.01, 1e4), "length of the surge; give this or the volume"),
    Key::required("depth", quantity(D::Length, 0.005, 50.0), "depth of the flow, normal to the bed"),
    Key::required("velocity", quantity(D::Velocity, 0.05, 40.0), "velocity of the flow along the bed"),
    FRONT_ANGLE,
    Key::optional(
        "run_in",
        quantity(D::Length, 0.0, 1e3),
        "way from the front of the surge at its release to the barrier, or to what earlier surges have left; by default four times the depth",
    ),
    Key::optional(
        "after",
        quantity(D::Time, 0.0, 1e4),
        "time from the release of the surge before; by default it waits until that has come to rest",
    ),
    Key::optional("grain_sizes", Kind::OneOf(GRAIN_SIZES), "its grains, where they are others than the flow's"),
];

const BARRIER: &[Key] = &[
    Key::optional("rigid_wall", Kind::Section(RIGID_WALL), "a wall across the channel"),
    Key::optional("flexible_net", Kind::Section(FLEXIBLE_NET), "a rope net on main ropes"),
    Key::optional(
        "kit",
        Kind::File,
        "a file with keys of the barrier beside the design: what the design says beside it overrides the kit",
    ),
];

const RIGID_WALL: &[Key] = &[
    Key::required("height", quantity(D::Length, 0.01, 50.0), "height along the face of the wall"),
    Key::optional(
        "tilt",
        quantity(D::Angle, -STEEPEST, STEEPEST),
        "angle of the face against the vertical, positive leans upstream; by default the face is normal to the bed, or upright on its base where stability is given",
    ),
    Key::optional(
        "segments",
        Kind::Quantities { dimension: D::Length, low: 0.001, high: 50.0 },
        "heights of the parts whose force is reported, from the bottom; by default six equal parts",
    ),
    Key::optional(
        "resistance",
        quantity(D::Force, 1.0, 1e12),
        "characteristic resistance of the whole wall, its foundation included, to the total force",
    ),
    Key::default(
        "resistance_factor",
        Kind::Number { low: 1.0, high: 5.0 },
        "1.5",
        "partial factor on that resistance (1.5: concrete, EN 1992-1-1); 1 where the resistance is a design value",
    ),
    Key::optional(
        "moment_resistance",
        quantity(D::MomentPerWidth, 1.0, 1e12),
        "characteristic resistance of the wall and its foundation to the moment at its foot, per metre of width; over the same partial factor",
    ),
    Key::optional(
        "stability",
        Kind::Section(STABILITY),
        "a wall that stands by its weight: checked against sliding, overturning and the pressure under its base",
    ),
];

const STABILITY: &[Key] = &[
    Key::required("thickness", quantity(D::Length, 0.05, 50.0), "thickness of the wall"),
    Key::required("density", quantity(D::Density, 500.0, 8000.0), "density of the wall"),
    Key::optional(
        "base_width",
        quantity(D::Length, 0.05, 50.0),
        "width of its base, which reaches downstream; by default the thickness",
    ),
    Key::optional(
        "base_slope",
        FRICTION,
        "slope of the base against the horizontal, 0 deg for a level one; where it is not given the base is taken as level and its checks stay open",
    ),
    Key::default(
        "founding_depth",
        quantity(D::Length, 0.0, 20.0),
        "0 m",
        "depth of the base below the bed at the face of the wall, down to which the wall goes on; a base that would stand above the ground downstream stays open",
    ),
    Key::required(
        "base_friction",
        FRICTION,
        "friction angle between base and ground, no more than that of the ground; the pressure of the ground on the buried part of the face is worked out with it, or with 35 deg where it is more",
    ),
    Key::default(
        "ground_density",
        quantity(D::Density, 1000.0, 3000.0),
        "2200 kg/m3",
        "bulk density of the ground that the wall is founded in, which presses on the buried part of its face; by default that of a dense wet gravel, on the safe side",
    ),
    Key::required(
        "sliding_factor",
        Kind::Number { low: 1.0, high: 5.0 },
        "partial factor on the resistance to sliding",
    ),
    Key::required(
        "overturning_factor",
        Kind::Number { low: 1.0, high: 5.0 },
        "partial factor on the moment that holds the wall",
    ),
    Key::optional(
        "bearing_resistance",
        quantity(D::Pressure, 1e3, 3e7),
        "characteristic bearing resistance of the ground under the base, for a load as eccentric and inclined as this one",
    ),
    Key::default(
        "bearing_factor",
        Kind::Number { low: 1.0, high: 5.0 },
        "1.4",
        "partial factor on the bearing resistance (1.4: EN 1997-1, design approach 2)",
    ),
    Key::optional(
        "block_length",
        quantity(D::Length, 0.5, 40.0),
        "length along the barrier, from joint to joint, of the shortest block of the wall that stands or moves as one piece, with reinforcement or bulk enough for it; without joints the length of the wall. A point load is then shared over the block, for sliding over 0.41 of it, because at the end of a block it turns the block as well; where it is not given, a point load is taken to spread at 45 deg to one side of where it hits, and the checks of the base that hold so stay open",
    ),
    Key::optional(
        "water_head",
        quantity(D::Length, 0.0, 50.0),
        "head of the water under the upstream edge of the base, which falls evenly to none at its downstream edge, 0 m for a base that is drained; a design value, no factor is applied to it; where it is not given the base is taken as dry and its checks stay open",
    ),
];

const FLEXIBLE_NET: &[Key] = &[
    Key::required("height", quantity(D::Length, 0.05, 30.0), "height along the barrier's plane"),
    Key::default(
        "tilt",
        quantity(D::Angle, -STEEPEST, STEEPEST),
        "0 deg",
        "angle against the vertical, positive leans upstream",
    ),
    Key::optional(
        "mesh_opening",
        Kind::LengthOrGrains { low: 0.005, high: 3.0 },
        "distance between opposite sides of a mesh, for a diamond the length of a side; give this with net_rope, or net.rings",
    ),
    Key::default(
        "mesh_shape",
        Kind::Choice(&mesh_shape::SHAPES),
        "squares",
        "squares on their corner, or regular hexagons with two vertical sides",
    ),
    Key::optional(
        "mesh_angle",
        quantity(D::Angle, 30.0 * DEGREE, 120.0 * DEGREE),
        "angle between the sides of a mesh at its upper and lower corner: less than 90 deg is a diamond taller than wide; by default 90 deg, a square on its corner",
    ),
    Key::optional("net_rope", Kind::Section(ROPE), "rope of the net"),
    Key::optional("net", Kind::OneOf(NETS), "a net that is no square mesh of ropes"),
    Key::default(
        "net_slack",
        quantity(D::Share, 0.0, 0.2),
        "0 %",
        "how much longer the net's ropes are than the straight sides of the mesh; not for barrier_model cylinders",
    ),
    Key::optional(
        "rope_table",
        Kind::File,
        "a table of ropes beside the design file: name, diameter, breaking_load and modulus, under a head that names their units",
    ),
    Key::optional(
        "net_pieces",
        Kind::Count { low: 1, high: 16 },
        "straight pieces of which the simulation makes each side of a mesh; by default 1, and with fidelity: fine as many as the grains need",
    ),
    Key::required("main_ropes", Kind::Section(MAIN_ROPES), "horizontal ropes that carry the net"),
    Key::required("lateral_ropes", Kind::Section(LATERAL_ROPES), "ropes along the sides of the net"),
    Key::optional("dissipators", Kind::Section(DISSIPATORS), "one at each end of every main rope that is free to move"),
    Key::required("anchors", Kind::Section(ANCHORS), "one at each end of every main rope that is free to move"),
    Key::required("bottom", Kind::OneOf(BOTTOM), "what holds the lowest main rope"),
    Key::optional(
        "side_extension",
        Kind::Section(SIDE_EXTENSION),
        "strips of net along the side walls, which close the windows that open beside the barrier when dissipators pay out",
    ),
    Key::optional(
        "posts",
        Kind::Section(POSTS),
        "equal posts on hinged feet in the plane of the barrier, whose heads carry the uppermost main ropes",
    ),
];

const POSTS: &[Key] = &[
    Key::required(
        "at",
        Kind::Quantities { dimension: D::Length, low: -500.0, high: 500.0 },
        "where they stand, from the left to the right looking downstream: in the coordinates of the section, or from the middle between side walls",
    ),
    Key::required("width", quantity(D::Length, 0.02, 2.0), "width that a post turns to the flow"),
    Key::required("area", quantity(D::Area, 1e-4, 0.5), "area of its steel section: EA = E A"),
    Key::default("modulus", quantity(D::Pressure, 1e9, 4e11), "210 GPa", "Young's modulus of the post"),
    Key::optional(
        "radius_of_gyration",
        quantity(D::Length, 0.005, 1.0),
        "radius of gyration of the section about its weaker axis; give this with section_modulus and yield_strength, or resistances",
    ),
    Key::optional(
        "section_modulus",
        quantity(D::Volume, 1e-6, 0.1),
        "elastic section modulus against bending down the channel",
    ),
    Key::optional("yield_strength", quantity(D::Pressure, 1e8, 1.5e9), "yield strength of the steel"),
    Key::optional(
        "lateral_torsional_factor",
        Kind::Number { low: 0.05, high: 1.0 },
        "share of the bending resistance of the section that lateral-torsional buckling leaves, chi_LT of EN 1993-1-1, 6.3.2; 1 for a hollow section; without it the checks of a section stay open",
    ),
    Key::default("buckling_curve", Kind::Choice(&posts::CURVES), "c", "buckling curve of the section by EN 1993-1-1"),
    Key::optional(
        "resistance",
        quantity(D::Force, 1.0, 1e9),
        "characteristic resistance of a post to compression, buckling included; give this with bending_resistance, or a section",
    ),
    Key::optional(
        "bending_resistance",
        quantity(D::Moment, 1.0, 1e9),
        "characteristic resistance of a post to bending",
    ),
    Key::optional(
        "foot_resistance",
        quantity(D::Force, 1.0, 1e9),
        "characteristic resistance of the foundation of a post to the force of its foot",
    ),
    Key::optional(
        "uplift_resistance",
        quantity(D::Force, 1.0, 1e9),
        "characteristic resistance of a post and its foundation to being pulled up; asked for where that is more than the weight of the post",
    ),
    Key::optional(
        "head_friction",
        FRICTION,
        "friction angle between a rope and the head of a post; by default that of the rings on the ropes",
    ),
    Key::required("retaining_ropes", Kind::Section(RETAINING_ROPES), "ropes that hold the head of a post upstream"),
];

const RETAINING_ROPES: &[Key] = &[
    NAMED,
    DIAMETER,
    MODULUS,
    BREAKING_LOAD,
    ELASTIC_LIMIT,
    AT_BREAKING_LOAD,
    Key::required(
        "set_back",
        quantity(D::Length, 0.1, 60.0),
        "distance of the anchors from the foot of the post, upstream along the bed",
    ),
    Key::default(
        "spread",
        quantity(D::Length, 0.0, 30.0),
        "0 m",
        "distance of the anchors to either side of the post, where it has two ropes; with 0 it has one",
    ),
    Key::optional("dissipators", Kind::Section(DISSIPATORS), "one at the anchor of every retaining rope"),
    Key::required("anchor_resistance", quantity(D::Force, 1.0, 1e9), "characteristic resistance of one anchor"),
];

const NETS: &[Key] =
    &[Key::optional("rings", Kind::Section(NET_RINGS), "a ring net: each ring meets four others, or six")];

const NET_RINGS: &[Key] = &[
    Key::required("diameter", quantity(D::Length, 0.02, 3.0), "diameter of a ring"),
    Key::default(
        "contacts",
        Kind::Count { low: 4, high: 6 },
        "4",
        "rings that each one meets: 4, in squares, or 6, in triangles",
    ),
    Key::required("windings", Kind::Count { low: 1, high: 100 }, "windings of wire in a ring"),
    Key::required("wire_diameter", quantity(D::Length, 2e-4, 0.02), "diameter of the wire"),
    Key::required("wire_strength", quantity(D::Pressure, 4e8, 2.4e9), "tensile strength of the wire"),
    Key::optional(
        "chain_test",
        Kind::Pairs {
            first: Bounded { dimension: D::Share, low: 0.01, high: 0.68 },
            second: Bounded { dimension: D::Force, low: 1.0, high: 1e7 },
            example: "[[48 %, 16 kN], [57 %, 108 kN]]",
        },
        "a chain of the very rings pulled to break: elongation over its length and force, where bending ends and at the break, as characteristic values; by default they follow from the wires, as tests of rings of 300 mm with 5 to 19 windings of 3 mm have them",
    ),
    Key::default(
        "at_breaking_load",
        Kind::Choice(&["holds", "breaks"]),
        "holds",
        "what a simulated ring does where a chain of such rings breaks: holds on, so that the load to be borne is seen, or breaks",
    ),
];

const SIDE_EXTENSION: &[Key] = &[
    Key::required("length", quantity(D::Length, 0.01, 30.0), "length of each strip, downstream along the side wall"),
    Key::default(
        "holding_force",
        quantity(D::Force, 0.01, 1e6),
        "1 kN",
        "force with which wall and deposit hold each knot of a strip where it lies",
    ),
];

const NAMED: Key = Key::optional(
    "rope",
    Kind::Text,
    "name of the rope in the table of the program or in rope_table, which gives its diameter, modulus and breaking load where they are not typed",
);
const DIAMETER: Key = Key::optional("diameter", quantity(D::Length, DIAMETERS[0], DIAMETERS[1]), "nominal diameter");
const MODULUS: Key = Key::optional(
    "modulus",
    quantity(D::Pressure, MODULI[0], MODULI[1]),
    "modulus with the full circle of the diameter: EA = E pi d2/4",
);
const BREAKING_LOAD: Key =
    Key::optional("breaking_load", quantity(D::Force, BREAKING_LOADS[0], BREAKING_LOADS[1]), "minimum breaking load");
const ELASTIC_LIMIT: Key = Key::optional(
    "elastic_limit",
    quantity(D::Force, 1.0, 1e9),
    "tension at which the simulated rope draws out and stays longer; by default it stays elastic at any tension",
);
const AT_BREAKING_LOAD: Key = Key::default(
    "at_breaking_load",
    Kind::Choice(&["holds", "breaks"]),
    "holds",
    "what the simulated rope does beyond its breaking load: holds on, so that the load to be borne is seen, or breaks",
);

const ROPE: &[Key] = &[NAMED, DIAMETER, MODULUS, BREAKING_LOAD, ELASTIC_LIMIT, AT_BREAKING_LOAD];

const MAIN_ROPES: &[Key] = &[
    Key::optional(
        "count",
        Kind::Count { low: 2, high: 30 },
        "number of ropes, evenly spaced; give this, heights or levels",
    ),
    Key::optional(
        "heights",
        Kind::Quantities { dimension: D::Length, low: 0.0, high: 30.0 },
        "heights along the barrier from its foot; the first is 0 and the last its height",
    ),
    Key::optional(
        "levels",
        Kind::Sections(LEVEL),
        "the same with the ropes that run side by side at each height, and their own kind where it is another",
    ),
    NAMED,
    DIAMETER,
    MODULUS,
    BREAKING_LOAD,
    ELASTIC_LIMIT,
    AT_BREAKING_LOAD,
    Key::required("rings", Kind::Section(RINGS), "rings that hang the net on the rope"),
    Key::default(
        "element_length",
        quantity(D::Length, 0.005, 5.0),
        "70 mm",
        "length of the cylinders of a main rope, about; for barrier_model cylinders",
    ),
];

const RINGS: &[Key] = &[
    Key::required("spacing", quantity(D::Length, 0.005, 5.0), "spacing along the rope"),
    Key::required("friction", FRICTION, "friction angle between ring and rope"),
    Key::default(
        "diameter",
        quantity(D::Length, 1e-4, 0.3),
        "16 mm",
        "thickness of the ring's own rod; for barrier_model cylinders",
    ),
    Key::default(
        "modulus",
        quantity(D::Pressure, 1e7, 4e11),
        "8 GPa",
        "modulus of the ring; for barrier_model cylinders",
    ),
];

const LEVEL: &[Key] = &[
    Key::required("height", quantity(D::Length, 0.0, 30.0), "height along the barrier from its foot"),
    Key::default(
        "ropes",
        Kind::Count { low: 1, high: 6 },
        "1",
        "equal ropes that run side by side and share the load, each with dissipators and anchors of its own",
    ),
    NAMED,
    DIAMETER,
    MODULUS,
    BREAKING_LOAD,
];

const LATERAL_ROPES: &[Key] = &[
    NAMED,
    DIAMETER,
    MODULUS,
    BREAKING_LOAD,
    ELASTIC_LIMIT,
    AT_BREAKING_LOAD,
    Key::default(
        "tied_to",
        Kind::Choice(&["rope_ends", "dissipators", "anchors"]),
        "rope_ends",
        "where the lateral ropes end: at the ends of the main ropes, so that their load passes through the dissipators (dissipators: the same, and they must be there), or at the anchors, past the dissipators",
    ),
];

const DISSIPATORS: &[Key] = &[
    Key::optional(
        "plateau_force",
        quantity(D::Force, 1.0, 1e8),
        "force at which the dissipator yields; give this with the stroke, or a curve",
    ),
    Key::optional("stroke", quantity(D::Length, 0.001, 20.0), "maximum stroke; a curve has its own"),
    Key::optional(
        "curve",
        Kind::OneOf(YIELD_CURVE),
        "force at which it yields against its stroke, from a test; the end of the curve is the maximum stroke",
    ),
    Key::required(
        "stiffness",
        quantity(D::Stiffness, 1e2, 1e10),
        "elastic stiffness before it yields and when it is unloaded",
    ),
    Key::default(
        "in_series",
        Kind::Count { low: 1, high: 10 },
        "1",
        "dissipators one behind the other at each end of a rope: strokes add up",
    ),
    Key::default(
        "side_by_side",
        Kind::Count { low: 1, high: 10 },
        "1",
        "dissipators next to each other at each end of a rope: forces add up",
    ),
    Key::optional(
        "lower_bound",
        Kind::Number { low: 0.3, high: 1.0 },
        "least force of a dissipator over its plateau or its curve, from its tests: strokes must be enough for it as well; factors.dissipator_overstrength is the upper bound",
    ),
];

/// Travel and force of a dissipator.
const TRAVEL_AND_FORCE: Kind = Kind::Pairs {
    first: Bounded { dimension: D::Length, low: 0.0, high: 20.0 },
    second: Bounded { dimension: D::Force, low: 0.0, high: 1e8 },
    example: "[[0 m, 60 kN], [0.2 m, 110 kN], [0.9 m, 140 kN]]",
};

const YIELD_CURVE: &[Key] = &[
    Key::optional("after_unloading", TRAVEL_AND_FORCE, "points of stroke and force, the stroke without elastic travel"),
    Key::optional(
        "under_load",
        TRAVEL_AND_FORCE,
        "points of travel and force as measured under the force, from [0 m, 0 kN] on; elastic travel is taken off",
    ),
    Key::optional(
        "file",
        Kind::File,
        "the same points as a table whose head names what it holds: `stroke (mm),force (kN)` for strokes after unloading, `travel (mm),force (kN)` for travel under load",
    ),
];

const RESISTANCE: Key = Key::optional(
    "resistance",
    quantity(D::Force, 1.0, 1e9),
    "characteristic resistance of one anchor; give this, proof_load or design_resistance",
);
const PROOF_LOAD: Key = Key::optional(
    "proof_load",
    quantity(D::Force, 1.0, 1e9),
    "load that each anchor was tested with, taken as its characteristic resistance",
);
const DESIGN_RESISTANCE: Key = Key::optional(
    "design_resistance",
    quantity(D::Force, 1.0, 1e9),
    "resistance of one anchor with its partial factor in it already",
);
const PLUNGE: Key = Key::optional(
    "plunge",
    quantity(D::Angle, 0.0, std::f64::consts::FRAC_PI_2),
    "how steeply an anchor dips into the ground; by default it lies in the line of its rope",
);
const BEARING: Key = Key::optional(
    "bearing",
    quantity(D::Angle, -std::f64::consts::FRAC_PI_2, std::f64::consts::FRAC_PI_2),
    "angle in plan between an anchor and the line of its rope, positive where the anchor points upstream; by default 0 deg",
);
/// How far behind the edge of a net an anchor lies (m).
const SET_BACK: Kind = quantity(D::Length, 0.0, 30.0);

const ANCHOR: &[Key] = &[
    Key::required("level", Kind::Count { low: 1, high: 30 }, "main rope that it holds, from 1 at the bottom"),
    Key::required("bank", Kind::Choice(&["left", "right"]), "bank that it is in, looking downstream"),
    RESISTANCE,
    PROOF_LOAD,
    DESIGN_RESISTANCE,
    Key::optional("set_back", SET_BACK, "distance from the edge of the net along the line of the rope"),
    PLUNGE,
    BEARING,
];

const ANCHORS: &[Key] = &[
    RESISTANCE,
    PROOF_LOAD,
    DESIGN_RESISTANCE,
    Key::default(
        "set_back",
        SET_BACK,
        "0 m",
        "distance of the anchors from the edge of the net along the line of their ropes",
    ),
    PLUNGE,
    BEARING,
    Key::optional("each", Kind::Sections(ANCHOR), "anchors that differ from the others, one by one"),
    Key::optional(
        "bed_resistance",
        quantity(D::Force, 1.0, 1e10),
        "characteristic resistance of all bolts of the lowest rope together; give this or bed_bolt_resistance",
    ),
    Key::optional(
        "bed_bolt_spacing",
        quantity(D::Length, 0.01, 100.0),
        "distance between the bolts that hold the lowest rope to the bed",
    ),
    Key::optional("bed_bolt_resistance", quantity(D::Force, 1.0, 1e9), "characteristic resistance of one such bolt"),
];

const BOTTOM: &[Key] = &[
    Key::optional("fixed", Kind::Choice(&["to_bed"]), "the lowest rope is bolted to the bed along its length"),
    Key::optional(
        "opening",
        Kind::LengthOrGrains { low: 0.0, high: 10.0 },
        "the lowest rope is free, this far above the bed",
    ),
];

const UTILISATION: Kind = quantity(D::Share, 0.01, 1.0);

const LIMITS: &[Key] = &[
    Key::default("retained_mass", quantity(D::Share, 0.0, 1.0), "90 %", "least share of the mass that must be held"),
    Key::default(
        "retained_of",
        Kind::Choice(&["mixture", "grains"]),
        "mixture",
        "what the share in retained_mass counts: the mixture with the fluid in its pores, which runs through a net, or the grains alone",
    ),
    Key::default("residual_height", quantity(D::Share, 0.0, 1.0), "50 %", "least height left over initial height"),
    Key::optional(
        "freeboard",
        quantity(D::Length, 0.0, 20.0),
        "height, normal to the bed, by which the barrier must rise above the level that the event reaches in front of it: run-up and deposit are checked against the barrier's height only where this is given",
    ),
    Key::default(
        "run_up",
        Kind::Choice(&["larger", "momentum_jump", "energy"]),
        "larger",
        "how the run-up for that check is worked out: by a momentum jump, by energy, or the larger of both",
    ),
    Key::default("rope_utilisation", UTILISATION, "100 %", "greatest tension over design resistance of ropes and net"),
    Key::default("anchor_utilisation", UTILISATION, "100 %", "greatest load over design resistance of anchors"),
    Key::default(
        "dissipator_utilisation",
        UTILISATION,
        "90 %",
        "greatest share of a dissipator's stroke that may be used",
    )
    .formerly("brake_utilisation"),
    Key::default(
        "outside_range",
        Kind::Choice(&["undecided", "warn"]),
        "undecided",
        "treatment of a check that is governed by a formula outside its range: it is left undecided, or stands with a warning",
    ),
];

const FACTORS: &[Key] = &[
    Key::default(
        "set",
        Kind::Choice(factor_sets::NAMES),
        "none",
        "named set of partial factors on loads, ropes and anchors; factors given one by one override it",
    ),
    Key::default(
        "earth_pressure_k",
        Kind::Number { low: 0.1, high: 20.0 },
        "1",
        "K of the static pressure K rho g H cos(slope)",
    ),
    Key::default(
        "dynamic_lambda",
        Kind::Number { low: 0.1, high: 20.0 },
        "2",
        "lambda of the dynamic pressure lambda rho v2",
    ),
    Key::default("load", Kind::Number { low: 1.0, high: 5.0 }, "1", "partial factor on loads"),
    Key::default("rope", Kind::Number { low: 1.0, high: 5.0 }, "1.5", "partial factor on rope resistance"),
    Key::default("anchor", Kind::Number { low: 1.0, high: 5.0 }, "1.1", "partial factor on anchor resistance"),
    Key::default(
        "post",
        Kind::Number { low: 1.0, high: 5.0 },
        "1.1",
        "partial factor on the resistance of posts; their foundations have that of anchors",
    ),
    Key::default(
        "rope_end",
        Kind::Number { low: 0.5, high: 1.0 },
        "1",
        "termination efficiency: share of its breaking load that a rope holds at its ends, 1 for sockets, less for ferrules and grips",
    ),
    Key::optional(
        "dissipator_overstrength",
        Kind::Number { low: 1.0, high: 3.0 },
        "largest force of a dissipator that yields, over its plateau or its curve, from its tests: ropes and anchors must bear it; by default the partial factor on loads",
    ),
];

const LOADS: &[Key] = &[
    Key::optional(
        "overflow_depth",
        quantity(D::Length, 0.001, 50.0),
        "depth of a flow over the full barrier; by default that of the surge, where the design flow fills the barrier",
    ),
    Key::optional(
        "overflow_friction",
        FRICTION,
        "friction angle of the overtopping flow on the barrier's top; its drag enters the checks if this and the length are given",
    ),
    Key::optional(
        "overflow_length",
        quantity(D::Length, 0.001, 100.0),
        "length over which the overtopping flow rides on the barrier's top",
    ),
    Key::default(
        "filling",
        Kind::Choice(&["to_the_top", "one_event"]),
        "to_the_top",
        "repeated surges until the barrier is full; or a single event, with the barrier cleared afterwards",
    ),
    Key::optional("drained", Kind::Section(DRAINED), "the deposit once it has drained"),
    Key::optional("point_load", Kind::Section(POINT_LOAD), "a boulder or log, added to every surge"),
    Key::optional("snow_pressure", quantity(D::Pressure, 1.0, 1e6), "uniform pressure of snow on the barrier"),
    Key::optional(
        "wood_factor",
        Kind::Number { low: 1.0, high: 5.0 },
        "factor on the dynamic pressure for wood in the flow; 1.2 to 1.5 at the same depth in 40 tests with logs against a bridge deck (Friedl et al. 2025)",
    ),
    Key::optional(
        "impact_reduction",
        Kind::Number { low: 0.05, high: 1.0 },
        "share of the elastic force (Hertz) with which a boulder of flow.boulders hits a rigid wall, where no point_load is given; a tenth in the practice of Hong Kong (from memory, uncertain), which the loads take unless it is given: checks that pass by it alone then stay open",
    ),
    Key::optional("self_weight", quantity(D::Pressure, 0.1, 1e5), "weight of the net per area, hung on the top rope"),
    Key::default(
        "filled_height",
        quantity(D::Share, 0.1, 1.0),
        "75 %",
        "height of the filled net as a share of its initial height, for the volume it holds (from practice, not verified)",
    ),
    Key::default(
        "deposit_slope",
        quantity(D::Share, 0.0, 0.99),
        "67 %",
        "slope of the deposit's surface as a share of that of the bed, for the volume it holds (from practice, not verified)",
    ),
];

const DRAINED: &[Key] = &[
    Key::required("earth_pressure_k", Kind::Number { low: 0.1, high: 20.0 }, "K of the drained deposit"),
    Key::required("density", quantity(D::Density, 300.0, 3500.0), "density of the drained deposit"),
];

const POINT_LOAD: &[Key] = &[
    Key::required("force", quantity(D::Force, 1.0, 1e9), "force along the channel"),
    Key::required("height", quantity(D::Length, 0.0, 50.0), "height above the bed"),
];

const SIMULATION: &[Key] = &[
    Key::default(
        "fidelity",
        Kind::Choice(&["fast", "standard", "fine", "auto"]),
        "standard",
        "how small a time step; auto: from the guideline calculation up, with model and number of runs as fine as the verdict needs",
    ),
    Key::default(
        "barrier_model",
        Kind::Choice(&["pinned_ropes", "sliding_ropes", "cylinders"]),
        "sliding_ropes",
        "ropes fixed to the rings of the net, or running through them with friction; or all of cylinders that bend, with rings as squares that slide on the ropes (some ten times the time)",
    ),
    Key::default(
        "coarsen",
        Kind::Choice(&["never", "auto"]),
        "never",
        "whether the fine end of the grain-size curve is cut where there are more grains than run in minutes; the report says where, and what of it the mesh would let through",
    ),
    Key::default(
        "seed",
        Kind::Count { low: 0, high: u32::MAX as u64 },
        "1",
        "seed of the initial packing of the grains",
    ),
    Key::default(
        "longest",
        quantity(D::Time, 0.01, 1e4),
        "60 s",
        "longest time to simulate if the flow does not come to rest",
    ),
];

/// Two keys of a section of which one at the most may stand there.
#[derive(Clone, Copy, Debug)]
pub struct Either {
    pub keys: &'static [&'static str],
    /// Whether one of them must.
    pub needed: bool,
    /// Keys of groups beside them that stand in their stead.
    pub instead: &'static [[&'static str; 2]],
    /// A key that tells the group that is meant, where others have the same keys; else empty.
    pub beside: &'static str,
}

/// The JSON Schema tells these; [`super::rules`] words what it says of them.
pub const EITHER: &[Either] = &[
    Either { keys: &["width", "section", "terrain"], needed: true, instead: &[], beside: "" },
    Either {
        keys: &["mass", "volume"],
        needed: true,
        instead: &[["arrival", "surges"], ["arrival", "hydrograph"]],
        beside: "",
    },
    Either { keys: &["volume", "length"], needed: true, instead: &[], beside: "" },
    Either { keys: &["count", "heights", "levels"], needed: true, instead: &[], beside: "" },
    Either { keys: &["mesh_opening", "net"], needed: true, instead: &[], beside: "" },
    Either { keys: &["plateau_force", "curve"], needed: true, instead: &[], beside: "" },
    Either { keys: &["bed_resistance", "bed_bolt_resistance"], needed: false, instead: &[], beside: "" },
    Either { keys: &["resistance", "proof_load", "design_resistance"], needed: true, instead: &[], beside: "each" },
    Either { keys: &["resistance", "radius_of_gyration"], needed: false, instead: &[], beside: "" },
];
