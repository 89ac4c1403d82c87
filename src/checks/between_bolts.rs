//! A rope that is held by bolts and loaded between them.

/// Largest tension (N) of a rope with EA (N) that lay straight between two bolts and now carries a load (N), spread evenly. With the span s,
/// the sag f = P s/(8 H) and the stretch 8 f²/(3 s²) = H/EA its part along the span is H = (P² EA/24)^⅓, whatever the span; at a bolt half of
/// the load comes beside it.
pub fn tension_between(load: f64, axial: f64) -> f64 {
    libm::hypot(libm::cbrt(load * load * axial / 24.0), 0.5 * load)
}

/// Tension (N) of that rope under `more` times the load under which it has the given one (N). NaN stays NaN.
pub fn tension_under_more(tension: f64, more: f64, axial: f64) -> f64 {
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
    tension_between(more * high, axial)
}
