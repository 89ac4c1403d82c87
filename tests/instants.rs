//! What a barrier bears at an instant is no less than what it bears in the mean, whatever bears it: the recorders of both look at the same loads.

use barrier_check::design::entries::Purpose;
use barrier_check::design::read::read_design_for;
use barrier_check::fidelity::choose;
use barrier_check::scene::build::{Scene, build};
use dem::recorders::channels::Channel;
use dem::recorders::recorder::Recorder;
use dem::recorders::{of_anchors, of_posts, of_ropes};

/// Mean over a sample, and the largest at an instant of it.
type Pair = [&'static Channel; 2];

const OF_ROPES: [Pair; 4] = [
    [&of_ropes::LARGEST, &of_ropes::LARGEST_AT_ONCE],
    [&of_ropes::NET, &of_ropes::NET_AT_ONCE],
    [&of_ropes::LATERAL, &of_ropes::LATERAL_AT_ONCE],
    [&of_anchors::LOAD, &of_anchors::LOAD_AT_ONCE],
];
const OF_BOLTS: [Pair; 1] = [[&of_anchors::BOLT, &of_anchors::BOLT_AT_ONCE]];
const OF_POSTS: [Pair; 2] =
    [[&of_posts::COMPRESSION, &of_posts::COMPRESSION_AT_ONCE], [&of_posts::RETAINING, &of_posts::RETAINING_AT_ONCE]];
/// Samples at the most, and how many of them are looked at in which all is loaded.
const MOST_SAMPLES: usize = 1000;
const LOADED: usize = 8;

/// Runs a design until all is loaded, and holds each largest at an instant against the mean.
fn holds(design: &str, pairs: &[Pair]) {
    let open = |name: &str| std::fs::read(format!("designs/{name}")).map_err(|error| error.to_string());
    let text = std::fs::read(format!("designs/{design}")).expect("a design");
    let design = read_design_for(Purpose::Simulation, design, &text, &open).expect("sound").design;
    let Scene { mut simulation, recorder, .. } = build(&design, &choose(&design), 1).expect("a scene");
    assert!(simulation.barrier_substeps > 1, "instants are shorter than steps");
    let mut recorder = Recorder::new(recorder);
    let mut loaded = 0;
    while loaded < LOADED {
        assert!(recorder.histories.time.len() < MOST_SAMPLES, "not all is loaded");
        if !recorder.step(&mut simulation).expect("stable") {
            continue;
        }
        let channels = &recorder.histories.barrier;
        let last = |channel: &Channel| channels.rows(channel).iter().filter_map(|row| row.last()).copied();
        for [mean, instant] in pairs {
            let [means, instants] = [mean, instant].map(|channel| last(channel).collect::<Vec<f64>>());
            assert!(!means.is_empty() && means.len() == instants.len(), "{}", instant.name);
            for (mean, most) in means.iter().zip(&instants) {
                assert!(*most >= mean * (1.0 - 1e-12), "{}: {most} at an instant, {mean} in the mean", instant.name);
            }
        }
        loaded += usize::from(pairs.iter().all(|[mean, _]| last(mean).any(|mean| mean > 0.0)));
    }
}

/// All parts are loaded by the weight of the net alone.
#[test]
fn of_a_net_with_posts() {
    holds("net_with_posts.yaml", &[&OF_ROPES[..], &OF_POSTS].concat());
}

/// Its bolts are loaded by the flow.
#[test]
fn of_a_net_that_is_bolted_to_the_bed() {
    holds("small_net.yaml", &[&OF_ROPES[..], &OF_BOLTS].concat());
}
