//! A rope that is held by bolts and loaded between them.

/// Largest tension (N) of a rope with EA (N) that lay straight between two bolts and now carries a load (N), spread evenly. With the span s,
/// the sag f = P s/(8 H) and the stretch 8 f²/(3 s²) = H/EA its part along the span is H = (P² EA/24)^⅓, whatever the span; at a bolt half of
/// the load comes beside it.
pub fn tension_between(load: f64, axial: f64) -> f64 {
    libm::hypot(libm::cbrt(load * load * axial / 24.0), 0.5 * load)
}

/// EA of a rope that is loaded by so many rings in each space, over the EA of one that an even load pulls as hard: forces at the middles of m
/// equal parts stretch it by P² (1/24 + 1/(12 m²))/H² of its length, for one ring at mid-span three times as much as an even load.
pub fn concentration(rings: f64) -> f64 {
    let rings = rings.floor().max(1.0);
    1.0 + 2.0 / (rings * rings)
}

/// Load (N) under which that rope has a tension (N). NaN stays NaN.
fn load_of(tension: f64, axial: f64) -> f64 {
    // Half of the load is less than the tension.
    let (mut low, mut high) = (0.0, 2.0 * tension);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if tension_between(middle, axial) < tension {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Tension (N) of that rope under `more` times the load under which it has the given one (N). NaN stays NaN.
pub fn tension_under_more(tension: f64, more: f64, axial: f64) -> f64 {
    tension_between(more * load_of(tension, axial), axial)
}

/// Load (N) of the bolt at an end of the rope, which no rope pulls from the other side, or of one along it if that is more.
pub fn end_bolt(load: f64, axial: f64) -> f64 {
    let end = tension_between(load, axial);
    // Written so that a NaN stays one.
    if end <= load { load } else { end }
}

/// Load (N) of that bolt under `more` times the load under which it has the given one (N). NaN stays NaN.
pub fn end_bolt_under_more(bolt: f64, more: f64, axial: f64) -> f64 {
    let at_the_end = load_of(bolt, axial);
    // Where the rope pulls less than the load of a bolt along it, that is the load itself.
    let load = if at_the_end > bolt { bolt } else { at_the_end };
    end_bolt(more * load, axial)
}
