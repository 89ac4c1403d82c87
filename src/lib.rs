//! Checks rigid and flexible debris-flow barriers: guideline loads, granular-flow simulation, verdict, report.
//!
//! # Map
//! The run is one chain, all of it in [`pipeline::run`], its simulations in [`simulated::simulate`]:
//!
//! [`design`] (what is asked) → [`flow_cases`] (the flow as it is, and factored) → [`fidelity`] (how finely to model) → [`scene`] (bodies, and the event itself)
//! → histories of [`dem`] → [`demand`] (one number per check, by guideline and by simulation) → [`checks`]
//! (demand over capacity) → verdict → [`report`].
//!
//! | to add | go to |
//! |---|---|
//! | a key of the design file | a line in [`design::schema`], a field in [`design`], its reading in [`design::resolve`] or, for channel, flow, ropes, rings, dissipators, posts and anchors, in the file of that part (`design::*_entries`, `design::posts`, ...); a factor is set to 1 or named in `studies::limit_states` |
//! | another way to give the section of a channel | its key in [`design::schema`], what it makes in `design::channel_entries`; all else asks [`section`] and [`profile`] |
//! | a format of terrain rasters | [`raster`]; how it is turned into the barrier's directions in `design::terrain_file` and [`relief`] |
//! | a file that a design names | a key of the kind `File`, and `design::attached` |
//! | a contradiction between keys | a function and a line in [`design::rules`], a fixture in `tests/bad_designs` |
//! | a key of a surge, or another way for the flow to come | its key in [`design::schema`], what it makes in `design::surge_entries` and `Flow`; it is let go by [`scene::surges`], told surge by surge in [`stages`] and [`report::surges`] |
//! | a contact law | a file beside [`dem::contact::law`], called by `law::respond`, through which every contact goes, and its springs by `law::Spring`, from which the stable step and what is shown go as well; its damping in [`dem::contact::restitution`] |
//! | a step of its own for some bodies | [`dem::time::multi_rate`], and who watches it: `Simulation::audit` |
//! | a pair of shapes | a file in [`dem::contact`] with its geometry in [`dem::geometry`] |
//! | another kind of net | its key in `design::schema` under `net`, its rules and numbers in files beside `design::net_rings`, its law in a file beside [`ring_law`], its elements in [`dem::elements`], how it hangs in a file beside `scene::net::ring_net`, and its check in [`checks::ropes`]; its lattice in [`lattice`], which `scene::net::grid` and `scene::net::cut` fit to the barrier, and what asks of `net.rings` elsewhere (`guideline`, [`fidelity`], [`report::site`], [`report::statements`]) asks of the new kind too |
//! | a key of posts or anchors | `design::posts`, `design::anchors` and their rules; how they stand in `scene::net::posts`, by the equations in `guideline::posts` and `loads::posts`, their checks in [`checks::posts`] and [`checks::anchors`], their tables in [`report::posts`] and [`report::anchors`] |
//! | a rule of buckling | `Column` and `Strut` in `loads::posts`, told in [`report::posts`] |
//! | a kit that ships, or another way to give a thing that kits give | a file in `designs/kits`; a line in `WAYS` of `design::kit` |
//! | a rope that can be named | a line in `design/ropes.csv` |
//! | what an overloaded rope does | [`dem::elements::strength`], [`dem::elements::rope`] and `Cylinder::give_way` |
//! | a structural element | a file in [`dem::elements`], a variant of `SegmentKind` with its matches (recorders, [`report::segment_kinds`], [`report::pictures`]), its list in [`dem::tables::barrier`], with what it tells of itself in `Barrier::axial_members`, `Barrier::springs` and `Barrier::connect` (stable step, film, snapshots and loads of ropes go by these), its forces in [`dem::net`], its place in [`scene::net::build`] (rings and cylinders: [`scene::net::rings`]), a load of its own in [`dem::recorders`]; raise the `FORMAT` of [`checkpoint::file`] |
//! | vector instructions | a file in [`dem::simd`] and its choice in [`dem::simd::widest`] |
//! | a load case | a file in [`loads::cases`] and a line in its two lists; what the design gives for it is a design key, handed on by `loads::cases::load_case::AdditionalActions` and `guideline`; its working with [`loads::cases::working`] |
//! | another impact model | an entry of [`loads::other_models::MODELS`] |
//! | a rule of detailing | a function and a line in [`checks::detailing`] |
//! | a shape of surface | a file in [`dem::tables`] beside `surfaces` and `terrain`, and its lines in [`dem::tables::fixed`], with a field of [`dem::model::Model`]; what grains do to it follows, but where one contact goes on in another ([`dem::contact::surfaces`]); where it stands in [`scene::build`]; raise the `FORMAT` of [`checkpoint::file`] |
//! | an input to vary | a line in [`sensitivity`] (equations) or [`sensitivity::simulated`] (simulation) |
//! | a rule on where a formula holds | [`checks::range`]; a rule of [`checks::detailing`] with its bearing |
//! | a load case that is simulated, or where a partial factor stands | [`flow_cases`]; its runs in `pipeline::simulate_cases`, [`simulated`] and [`demand`]; raise the `FORMAT` of [`report::recording`] |
//! | a quantity that is measured | a file in [`quantities`] and a line in its list; recordings, `result.json`, scatter and comparison follow, and with `.demanded(..)` the demands that checks are made of (make `tests/fixtures/recorded.bin` anew). One that is not recorded yet: a [`dem::recorders::channels::Channel`] in the file of its body in [`dem::recorders`], and a line in `CHANNELS` there; raise the `FORMAT` of [`checkpoint::file`]. A check on it takes one of the variants of `quantities::quantity::Demanded` |
//! | a check | a file in [`checks`] and a line in its list; it names a quantity and holds it against a capacity |
//! | a load or a course of the event that nothing covers | a file in [`checks::not_covered`] and a line in its list |
//! | a reason to distrust a simulation | a limit in [`checks::credibility`], or, where the design must be known, a function of `arriving` or one beside it |
//! | what a check, a load case or a warning means | its [`text`], in the file of the check or the load case, of warnings in [`explain`]; `docs/reference.md` is made of them |
//! | a warning to the reviewer | a function and a line in [`report::warnings`], its text in [`explain`]; a usual range of an input in [`checks::implausible`] |
//! | a field of `result.json` | [`report::json`]; raise its `schema_version` where one changes or goes |
//! | where a rule is from | [`sources`] |
//! | a part of the program | a module here, and in `LAYERS` of `tests/layers.rs` whom it may name |
//! | a unit | a line in [`units`] |
//! | a set of factors that a code gives | [`design::factor_sets`] |
//! | a kind of report | [`report::kind`] |
//! | a question that a new design asks | a line in [`new_design::QUESTIONS`], its flag in `src/main.rs`, its place in `templates/new_design.yaml` |
//! | something that the page of `serve` asks for | a function in `commands::serve::requests`, its address in `commands::serve::router`; the page itself in `templates/serve`, whose README says how its bundle is built |
//! | a file beside the report for another program | a field of [`exports::Exports`], its flag in `src/main.rs`, a file in [`report`], its line in [`commands::output`], in `commands::messages` and in `commands::serve::runs`; raise the `FORMAT` of [`checkpoint::file`] |
//! | a command | a file in [`commands`], its arguments in `src/main.rs` |
//! | a time series of the barrier | a channel in the file of its body in [`dem::recorders`] and a line in `CHANNELS` there |
//! | a validation case | a file in the folder of its suite in [`validation`] and a line in [`validation::CASES`] |
//! | a scene of the bench | a line in `benches/throughput.rs`, its state in `benches/states` |
//! | a row of the report | [`report::findings`] (simulation), [`report::reliability`] (how far it can be relied on), [`report::loads`] (equations), [`report::holding`] (what the barrier holds and how high it must be), [`report::statements`] (assumptions); [`report::view`] gathers them, the templates loop over them |
//! | a rung of the ladder | [`fidelity::ladder::RUNGS`] |
//! | a kind of study | its plan in a file of [`studies`] and a line in `studies::plan`, what runs it in a file of [`commands`], its page in [`report`] |
//! | a distribution of an input | a variant of [`reliability::distribution::Distribution`], its key in `studies::reliability_plan`, its word in `report::probability` |
//! | a method that works out a probability | a file in [`reliability`], its use in [`studies::reliability`], what the page says of it in `report::probability` |
//! | an engine that makes runs | a variant of [`commands::engines::Engine`], its script in `templates/engines`, and the name of that in `report::folder` |
//! | a quantity that a price stands on | [`studies::bill::Measure`] |
//! | a lattice of meshes or rings | a variant of [`lattice::Lattice`] |
//! | a knob to study | a variant and its lines in [`studies::knobs`] |
//! | a scene of the stability map | a function and a line in [`studies::stability_scenes::SCENES`] |
//! | something a run depends on | a field that is kept with [`dem::simulation::Simulation`]; raise the `FORMAT` of [`checkpoint::file`] |
//! | something recorded | a field of what [`report::recording`] writes; raise its `FORMAT` and make `tests/fixtures/recorded.bin` anew |
//! | what the replay shows | [`dem::recorders::film`], its packing in [`report::replay`], its drawing in `templates/replay.js` |
//! | a picture of the report | [`report::pictures`] of a simulation, [`report::site`] of the design alone, its drawing in [`report::plots`], its style in `templates/pictures.css` |
//!
//! # Invariants
//! * The engine is a crate of its own, `crates/dem`, so that the compiler keeps it from the rest. `design` knows no later link of the chain;
//!   `loads` and `checks` never see `dem`; files do not import each other in a circle. `tests/layers.rs` holds the list of who may import
//!   whom against every path in the code.
//! * Everything inside is SI; units live at the borders, in [`units`].
//! * The same file and seed give the same result bit for bit, on any number of threads: work is cut into blocks by the
//!   number of grains alone, blocks never write each other's rows, and sums run in a fixed order. Vector instructions
//!   are chosen at run time ([`dem::simd::widest`]), but always eight numbers stand side by side, every lane does the same
//!   operations in the same order, and nothing is fused. What is not rounded exactly (sines, powers) goes through the crate `libm`, not
//!   through the system's library; `clippy.toml` keeps it so.
//! * A block of grains is moved as soon as the forces on it and on all blocks before it are summed ([`dem::sweep`]); until then the rows of
//!   its grains do not change.
//! * A pair of bodies that could touch in the step at hand is evaluated in it: lists expire and sleeping pairs wake by bounds
//!   on motion, never by guesses ([`dem::neighbours::clocks`]).
//! * The channel frame: x down the slope with the barrier's foot at 0, y across, z normal to the bed.
//! * A run that becomes unstable or breaks a limit of [`checks::credibility`] never passes.
//! * A run that is kept at a stop and resumed goes on bit for bit ([`checkpoint`]): whatever a step depends on is either kept or made
//!   anew at every stop of every run.
//! * Only [`commands`], the writers of reports and checkpoints and the lock of a folder touch files; only one file names the broad-phase library; `unsafe` stands in
//!   [`dem::workers`], [`dem::simd`], [`dem::tables::prefetch`], and around the rows that are moved while others are read
//!   ([`dem::tables::grain_rows`], [`dem::sweep`]).

// The map above is for those who work on the crate.
#![allow(rustdoc::private_intra_doc_links)]

mod arriving;
mod checkpoint;
pub mod checks;
pub mod commands;
pub mod container;
pub mod demand;
pub mod design;
pub mod explain;
pub mod exports;
pub mod fidelity;
mod first_surge;
pub mod flow_cases;
pub mod guideline;
mod larger;
pub mod lattice;
mod loads;
mod lock;
mod new_design;
pub mod pipeline;
mod problem;
pub mod profile;
mod program;
pub mod quantities;
pub(crate) mod raster;
mod reliability;
pub mod relief;
pub mod report;
pub mod ring_law;
pub mod scene;
pub mod section;
mod sensitivity;
pub mod simulated;
mod sources;
pub mod stages;
mod starts;
mod studies;
pub mod terminal;
mod text;
mod units;
pub mod validation;
pub mod yield_curve;
