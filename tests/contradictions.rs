//! Each rule between the values of a design at its limit: just beyond it speaks, just within it is silent. The limits are worked out from the
//! numbers of `tests/fixtures/even_net.yaml` and `designs/rigid_wall.yaml`.

use barrier_check::design::read::read_design;

const NET: &str = include_str!("fixtures/even_net.yaml");
const WALL: &str = include_str!("../designs/rigid_wall.yaml");

type Changes<'a> = &'a [(&'a str, &'a str)];

/// What is said of a design with some of its text replaced.
fn said(base: &str, changes: Changes) -> String {
    let mut text = base.to_string();
    for (from, to) in changes {
        assert!(text.contains(from), "no {from:?}");
        text = text.replacen(from, to, 1);
    }
    read_design("x.yaml", text.as_bytes()).err().map_or(String::new(), |problems| problems.to_string())
}

#[track_caller]
fn speaks(base: &str, phrase: &str, beyond: Changes, within: Changes) {
    let [loud, silent] = [said(base, beyond), said(base, within)];
    assert!(loud.contains(phrase), "{phrase:?} with {beyond:?}: {loud}");
    assert!(!silent.contains(phrase), "{phrase:?} with {within:?}: {silent}");
}

/// The same text replaced by one of two.
#[track_caller]
fn at(base: &str, phrase: &str, from: &str, beyond: &str, within: &str) {
    speaks(base, phrase, &[(from, beyond)], &[(from, within)]);
}

#[test]
fn mesh_and_rings() {
    let mesh = "mesh_opening: 200 mm";
    // 1.8 m/√2; a third of 3 m over √2; 0.9 m over 0.6 √2.
    at(NET, "in a barrier 1.8 m high", mesh, "mesh_opening: 1.28 m", "mesh_opening: 1.27 m");
    at(NET, "across a channel of 3 m", mesh, "mesh_opening: 0.71 m", "mesh_opening: 0.70 m");
    at(NET, "apart with a mesh diagonal", mesh, "mesh_opening: 1.07 m", "mesh_opening: 1.06 m");
    // 3 m · 1.8 m over the square of it.
    at(NET, "with about", mesh, "mesh_opening: 10.3 mm", "mesh_opening: 10.4 mm");
    // 10 % either side of 282.8 mm.
    at(NET, "rings every", "spacing: 283 mm", "spacing: 312 mm", "spacing: 310 mm");
    at(NET, "rings every", "spacing: 283 mm", "spacing: 254 mm", "spacing: 255 mm");
}

#[test]
fn main_ropes() {
    let count = "count: 3 ";
    at(NET, "0.9 m after 0.9 m", count, "heights: [0 m, 0.9 m, 0.9 m, 1.8 m] ", "heights: [0 m, 0.9 m, 1.8 m] ");
    at(NET, "0.5 m after 0.9 m", count, "heights: [0 m, 0.9 m, 0.5 m, 1.8 m] ", "heights: [0 m, 0.4 m, 0.9 m, 1.8 m] ");
    // Ropes out of order say nothing of their distance.
    assert!(!said(NET, &[(count, "heights: [0 m, 1.8 m, 0.9 m] ")]).contains("apart with a mesh diagonal"));
    // The closest two, not all of them: 0.6 diagonals are 170 mm.
    at(
        NET,
        "apart with a mesh diagonal",
        count,
        "heights: [0 m, 1.2 m, 1.64 m, 1.8 m] ",
        "heights: [0 m, 1.2 m, 1.62 m, 1.8 m] ",
    );
    let spans = "height(s) from";
    at(NET, spans, count, "heights: [0.1 m, 1.8 m] ", "heights: [0 m, 1.8 m] ");
    at(NET, spans, count, "heights: [0 m, 1.7 m] ", "heights: [0 m, 1.800001 m] ");
    at(NET, spans, count, "heights: [0 m, 1.80001 m] ", "heights: [0 m, 0.9 m, 1.8 m] ");
    at(NET, spans, count, "heights: [0 m] ", "heights: [0 m, 1.8 m] ");
    at(NET, "count and heights", count, "count: 3\n      heights: [0 m, 1.8 m] ", "heights: [0 m, 1.8 m] ");
    at(NET, "none of count, heights and levels", count, "# ", count);
    let without_bolts = said(NET, &[("bed_bolt_spacing: 0.2 m ", "# ")]);
    assert!(without_bolts.contains("a resistance of one bolt without their distance"), "{without_bolts}");
    assert_eq!(said(NET, &[("bed_bolt_resistance: 800 kN ", "# ")]), "");
    let twice = "bed_resistance: 1 MN\n      bed_bolt_resistance: 800 kN ";
    at(
        NET,
        "the resistance of all bolts and that of one",
        "bed_bolt_resistance: 800 kN ",
        twice,
        "bed_resistance: 1 MN ",
    );
}

/// 30 ropes of 200 m: 6 000 m of rope, in pieces of 0.6 m 10 000.
#[test]
fn cylinders() {
    let long = |model: &str, piece: &str| {
        said(
            NET,
            &[
                ("width: 3 m", "width: 200 m"),
                ("count: 3 ", &format!("count: 30\n      element_length: {piece} ")),
                ("barrier_model: sliding_ropes ", &format!("barrier_model: {model} ")),
            ],
        )
    };
    let phrase = "cylinders of main ropes";
    assert!(long("cylinders", "0.59 m").contains(phrase), "{}", long("cylinders", "0.59 m"));
    assert!(!long("cylinders", "0.61 m").contains(phrase));
    assert!(!long("sliding_ropes", "0.59 m").contains(phrase));
    let slack = |model: &str, slack: &str| {
        let mesh = format!("mesh_opening: 200 mm\n    net_slack: {slack}");
        said(
            NET,
            &[("mesh_opening: 200 mm", &mesh), ("barrier_model: sliding_ropes", &format!("barrier_model: {model}"))],
        )
    };
    assert!(slack("cylinders", "1 %").contains("with barrier_model cylinders"));
    assert_eq!(slack("cylinders", "0 %"), "");
    assert_eq!(slack("sliding_ropes", "1 %"), "");
}

#[test]
fn ropes_that_draw_out_and_dissipators() {
    for (load, part) in
        [("308", "breaking_load: 308 kN "), ("602", "breaking_load: 602 kN "), ("443", "breaking_load: 443 kN ")]
    {
        let with = |limit: &str| format!("elastic_limit: {limit}\n      {part}");
        at(NET, &format!("with a breaking load of {load} kN"), part, &with(&format!("{load} kN")), &with("140 kN"));
        let breaks = with("140 kN\n      at_breaking_load: breaks");
        at(NET, "an elastic limit and `at_breaking_load: breaks`", part, &breaks, &with("140 kN"));
    }
    let bottom = "fixed: to_bed ";
    at(NET, "an opening of", bottom, "opening: 1.8 m ", "opening: 1.79 m ");
    // 150 kN over a quarter of 0.9 m.
    at(NET, "an elastic travel", "stiffness: 8 MN/m", "stiffness: 0.66 MN/m", "stiffness: 0.67 MN/m");
    let tied = ("tied_to: rope_ends ", "tied_to: dissipators ");
    let none = ("    dissipators:\n      plateau_force: 150 kN\n      stroke: 0.9 m\n      stiffness: 8 MN/m\n", "");
    let phrase = "in a barrier without dissipators";
    assert!(said(NET, &[tied, none]).contains(phrase) && !said(NET, &[tied]).contains(phrase));
    assert!(!said(NET, &[none]).contains(phrase));
}

#[test]
fn flow_and_densities() {
    let volume = "volume: 5 m3 ";
    at(NET, "mass `7 t` and volume `5 m3`", volume, "mass: 7 t\n  volume: 5 m3 ", "mass: 7 t ");
    at(NET, "neither mass nor volume", volume, "# ", volume);
    // Without a flow that is what is told.
    assert!(!said(NET, &[("\nflow:", "\nflows:")]).contains("neither mass nor volume"));
    // A layer thinner than its grains by its depth, and by the length that the volume leaves.
    let small = |depth: &str| said(NET, &[(volume, "volume: 0.9 m3 "), ("depth: 0.6 m", depth)]);
    assert!(small("depth: 0.2 m").contains("a layer thinner than themselves"), "{}", small("depth: 0.2 m"));
    assert!(small("depth: 1.9 m").contains("too thin the other way"), "{}", small("depth: 1.9 m"));
    // A thousandth is rounding.
    at(
        NET,
        "no less than the flow itself",
        volume,
        "volume: 5 m3\n  event_volume: 4.99 m3 ",
        "volume: 5 m3\n  event_volume: 4.996 m3 ",
    );
    // Of the mass as well: 7 t of 1400 kg/m³ are 5 m³.
    at(
        NET,
        "no less than the flow itself",
        volume,
        "mass: 7 t\n  event_volume: 4.99 m3 ",
        "mass: 7 t\n  event_volume: 5.01 m3 ",
    );
    let solid = "solid_density: 2650 kg/m3";
    at(NET, "not below the solid density", solid, "solid_density: 1400 kg/m3", "solid_density: 1401 kg/m3");
    // 63 % of 2650 kg/m³ are 1669.5 kg/m³; grains as dense as the flow are another fault.
    let bulk = "bulk_density: 1400 kg/m3";
    at(NET, "a packing of 63 % grains", bulk, "bulk_density: 1670 kg/m3", "bulk_density: 1669 kg/m3");
    assert!(!said(NET, &[(solid, "solid_density: 1400 kg/m3")]).contains("a packing of"));
    let version = "schema_version: ";
    at(
        NET,
        "a newer barrier-check is needed",
        "\nproject:",
        &format!("\n{version}99\nproject:"),
        &format!("\n{version}1\nproject:"),
    );
}

#[test]
fn grain_sizes() {
    let curve = "curve:                           # by mass; any two or more of d1 to d100\n      d10: 170 mm\n      d30: 220 mm\n      d50: 260 mm\n      d70: 300 mm\n      d90: 360 mm\n";
    let uniform = |min: &str, max: &str| format!("uniform: {{min: {min}, max: {max}}}\n");
    at(NET, "above max", curve, &uniform("301 mm", "300 mm"), &uniform("300 mm", "300 mm"));
    at(NET, "quantile(s)", curve, "curve: {d50: 260 mm}\n", "curve: {d50: 260 mm, d90: 300 mm}\n");
    let quantile = "d50: 260 mm";
    at(NET, "d50 = 0.22 m, not above d30 = 0.22 m", quantile, "d50: 220 mm", "d50: 221 mm");
    at(NET, "d50 = 0.2 m, not above d30 = 0.22 m", quantile, "d50: 200 mm", quantile);
    // A third of 3 m.
    at(NET, "in a channel 3 m wide", curve, &uniform("0.9 m", "1.01 m"), &uniform("0.9 m", "0.99 m"));
    // 5 m³ · 1400/2650 of spheres of one size: 400 000 of 23.28 mm.
    let [beyond, within] = ["23.2 mm", "23.4 mm"].map(|size| uniform(size, size));
    at(NET, "grains, the finest", curve, &beyond, &within);
    let cut =
        |sizes: &str| said(NET, &[(curve, sizes), ("fidelity: standard ", "coarsen: auto\n  fidelity: standard ")]);
    assert!(!cut("curve: {d10: 10 mm, d50: 100 mm, d90: 300 mm}\n").contains("grains, the finest"));
    // No cut of nine tenths makes twenty thousand of a sand.
    assert!(cut(&uniform("2 mm", "2.1 mm")).contains("grains, the finest"));
}

/// 340 t of 1376 kg/m³ are 247.09 m³: 2.3223 m high on 7 m by 15.2 m.
#[test]
fn blocks_and_surges() {
    let length = "length: 7 m ";
    for (beyond, within) in [("2.44 m", "2.43 m"), ("2.20 m", "2.21 m")] {
        let height = |height: &str| format!("height: {height}\n      length: 7 m ");
        at(WALL, "while the volume needs 2.3223 m", length, &height(beyond), &height(within));
    }
    at(WALL, "high between walls of", "wall_height: 10 m", "wall_height: 2.32 m", "wall_height: 2.33 m");
    // 5 m³ over 0.6 m by 3 m: 2.7778 m.
    let depth = "depth: 0.6 m\n";
    for (beyond, within) in [("2.92 m", "2.91 m"), ("2.63 m", "2.65 m")] {
        let surge = |length: &str| format!("depth: 0.6 m\n      length: {length}\n");
        at(NET, "while the volume needs 2.7778 m", depth, &surge(beyond), &surge(within));
    }
    at(NET, "deep between walls of", depth, "depth: 2.51 m\n", "depth: 2.5 m\n");
    // 1.2 · 579 mm, of a block of 16.256 m² along the channel; and of a surge of 1.6667 m².
    let grains = "of grains up to";
    at(WALL, grains, length, "length: 23.41 m ", "length: 23.38 m ");
    at(WALL, grains, length, "length: 0.694 m ", "length: 0.696 m ");
    let uniform = "curve: {d10: 200 mm, d90: 300 mm}\n    #";
    let largest = 0.35;
    for (deep, loud) in [(1.2 * largest - 0.03, true), (1.2 * largest + 0.03, false)] {
        let told = said(NET, &[(depth, &format!("depth: {deep:.3} m\n")), ("curve:  ", &format!("{uniform} "))]);
        assert!(!told.contains(grains) || loud, "{told}");
    }
    let slope = "base_friction: 25 deg";
    at(WALL, "or the block stops on its way", slope, "base_friction: 40 deg", "base_friction: 39.9 deg");
    assert!(
        !said(NET, &[("base_friction: 22 deg", "base_friction: 30 deg")]).contains("or the block stops on its way")
    );
    // 5.5 m · sin 40° and half a grain of 579 mm; a wall normal to the bed reaches no further than half a grain.
    let distance = "distance: 23 m ";
    at(WALL, "a gate", distance, "distance: 3.82 m ", "distance: 3.83 m ");
    let normal = ("tilt: 0 deg ", "# ");
    speaks(WALL, "a gate", &[normal, (distance, "distance: 0.28 m ")], &[normal, (distance, "distance: 0.29 m ")]);
}

/// A rope breaks at no more than 2 GPa over the circle of its diameter: 628.3, 1231.5 and 904.8 kN of 20, 28 and 24 mm.
#[test]
fn ropes() {
    for (load, beyond, within) in
        [("308 kN ", "630 kN ", "628 kN "), ("602 kN ", "1232 kN ", "1231 kN "), ("443 kN ", "906 kN ", "904 kN ")]
    {
        let of = |load: &str| format!("breaking_load: {load}");
        at(NET, "error", &of(load), &of(beyond), &of(within));
    }
}

/// The share below which nothing is given of a curve; and a cut that leaves as many grains as run in minutes, and hardly fewer.
#[test]
fn what_of_a_curve_is_given_and_cut() {
    let read =
        |text: &str| read_design("x.yaml", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design;
    assert_eq!(read(NET).flow.known_from, 0.1);
    assert_eq!(read(&NET.replacen("      d10: 170 mm\n", "", 1)).flow.known_from, 0.3);
    assert_eq!(read(WALL).flow.known_from, 0.0);
    let fine = NET.replacen("d10: 170 mm", "d10: 10 mm", 1).replacen("d30: 220 mm", "d30: 40 mm", 1);
    let cut = read(&fine.replacen("fidelity: standard ", "coarsen: auto\n  fidelity: standard ", 1));
    let count = cut.flow.sizes.count(5.0 * 1400.0 / 2650.0);
    assert!((19_000.0..=20_000.0).contains(&count), "{count}");
    assert!(cut.flow.cut.is_some() && read(NET).flow.cut.is_none());
}

#[test]
fn loads() {
    // 1.8 m · cos 25°, 0.1 m more above a gap; 5.5 m · cos 40°, or all of it where the wall is normal to the bed.
    let boulder = |height: &str| format!("loads:\n  point_load: {{force: 1 kN, height: {height}}}\n\nlimits:");
    let above = "no more than the barrier's top";
    at(NET, above, "limits:", &boulder("1.64 m"), &boulder("1.63 m"));
    let gap = ("fixed: to_bed ", "opening: 0.1 m ");
    speaks(NET, above, &[gap, ("limits:", &boulder("1.74 m"))], &[gap, ("limits:", &boulder("1.73 m"))]);
    let hit = |height: &str| format!("loads:\n  point_load: {{force: 1 kN, height: {height}}}\n");
    at(WALL, above, "loads:\n", &hit("4.22 m"), &hit("4.21 m"));
    let normal = ("tilt: 0 deg ", "# ");
    speaks(WALL, above, &[normal, ("loads:\n", &hit("5.51 m"))], &[normal, ("loads:\n", &hit("5.49 m"))]);
    // 1.8 m · cos 35°, and 5.5 m · cos 30°.
    let leaning = ("tilt: 0 deg ", "tilt: 10 deg ");
    speaks(NET, above, &[leaning, ("limits:", &boulder("1.48 m"))], &[leaning, ("limits:", &boulder("1.47 m"))]);
    let leaning = ("tilt: 0 deg ", "tilt: -10 deg ");
    speaks(WALL, above, &[leaning, ("loads:\n", &hit("4.77 m"))], &[leaning, ("loads:\n", &hit("4.76 m"))]);
    at(WALL, "the weight of a rigid wall", "loads:\n", "loads:\n  self_weight: 100 Pa\n", "loads:\n");
    assert_eq!(said(NET, &[("limits:", "loads: {self_weight: 100 Pa}\n\nlimits:")]), "");
    let drag = |keys: &str| format!("loads: {{overflow_depth: 0.1 m, {keys}}}\n\nlimits:");
    let both = drag("overflow_friction: 20 deg, overflow_length: 0.5 m");
    at(NET, "no `loads.overflow_length`", "limits:", &drag("overflow_friction: 20 deg"), &both);
    at(NET, "no `loads.overflow_friction`", "limits:", &drag("overflow_length: 0.5 m"), &both);
    assert_eq!(said(NET, &[("limits:", "loads: {overflow_depth: 0.1 m}\n\nlimits:")]), "");
}

#[test]
fn leaning_barriers_and_walls() {
    // Slope and tilt from −0.35 to 1.31 rad: −45.05° and 50.06° beside a slope of 25°.
    let leans = "against the bed's normal";
    at(NET, leans, "tilt: 0 deg ", "tilt: -45.1 deg ", "tilt: -45 deg ");
    at(NET, leans, "tilt: 0 deg ", "tilt: 50.1 deg ", "tilt: 50 deg ");
    at(WALL, leans, "tilt: 0 deg ", "tilt: 35.1 deg ", "tilt: 35 deg ");
    at(WALL, "parts that add up to", "# segments:", "segments: [2 m, 3.4 m] #", "segments: [2 m, 3.5 m] #");
    // A millionth is rounding.
    at(WALL, "parts that add up to", "# segments:", "segments: [2 m, 3.50001 m] #", "segments: [2 m, 3.500003 m] #");
    let wall = |keys: &str| {
        format!(
            "rigid_wall:\n    stability: {{thickness: 2 m, density: 2400 kg/m3, base_friction: 35 deg, sliding_factor: 1.1, overturning_factor: 1.5, {keys}}}\n"
        )
    };
    let section = "rigid_wall:\n";
    at(WALL, "at least the thickness", section, &wall("base_width: 1.9 m"), &wall("base_width: 2 m"));
    let normal = ("tilt: 0 deg ", "# ");
    speaks(
        WALL,
        "no more than the slope of the bed",
        &[normal, (section, &wall("base_slope: 41 deg"))],
        &[normal, (section, &wall("base_slope: 39 deg"))],
    );
    // 0.1 rad.
    at(WALL, "a face upright on its base", section, &wall("base_slope: 5.8 deg"), &wall("base_slope: 5.7 deg"));
    let upright = ("tilt: 0 deg ", "tilt: -8 deg ");
    assert!(!said(WALL, &[upright, (section, &wall("base_slope: 8 deg"))]).contains("a face upright on its base"));
    let leaning = ("tilt: 0 deg ", "tilt: 5.8 deg ");
    speaks(
        WALL,
        "a face upright on its base",
        &[leaning, (section, &wall("base_slope: 0 deg"))],
        &[(section, &wall("base_slope: 0 deg"))],
    );
}
