//! Kits: each that ships makes a barrier, and what a design says goes before what its kit says.

use barrier_check::design::entries::Purpose;
use barrier_check::design::read::{DesignFile, read_design_for};
use barrier_check::design::{AnchorResistance, BarrierDesign, Bottom, FlexibleNet, PostStrength};

/// A gully of 14 m at its top with this barrier.
fn with(barrier: &str) -> Result<DesignFile, String> {
    let design = include_str!("../designs/site_village.yaml");
    let (before, rest) = design.split_once("\nbarrier:\n").expect("a barrier");
    let (_, after) = rest.split_once("\nlimits:\n").expect("limits");
    let text = format!("{before}\nbarrier:\n{barrier}\nlimits:\n{after}");
    let open = |name: &str| std::fs::read(format!("designs/{name}")).map_err(|error| error.to_string());
    read_design_for(Purpose::Simulation, "kit.yaml", text.as_bytes(), &open).map_err(|problems| problems.to_string())
}

fn net(file: &DesignFile) -> &FlexibleNet {
    match &file.design.barrier {
        BarrierDesign::FlexibleNet(net) => net,
        BarrierDesign::RigidWall(_) => panic!("a net"),
    }
}

#[test]
fn each_kit_that_ships_makes_a_barrier() {
    let mut kits = 0;
    for entry in std::fs::read_dir("designs/kits").expect("kits") {
        let name = entry.expect("a file").file_name().to_string_lossy().into_owned();
        let posts = if name.contains("posts") { "  flexible_net: {posts: {at: [-2.5 m, 2.5 m]}}\n" } else { "" };
        let file =
            with(&format!("  kit: kits/{name}\n{posts}")).unwrap_or_else(|problems| panic!("{name}: {problems}"));
        // The kit is kept with the design, and every value of it tells where it is from.
        assert!(file.attached.contains_key(&format!("kits/{name}")));
        let anchored = &file.entries.values["barrier.flexible_net.anchors.bed_bolt_spacing"].remark;
        assert!(anchored.starts_with(&format!("kit kits/{name}: ")), "{anchored}");
        kits += 1;
    }
    assert!(kits >= 3);
}

#[test]
fn what_the_design_says_goes_before_the_kit() {
    let plain = with("  kit: kits/ring_net_4m.yaml\n").expect("a design");
    assert_eq!((net(&plain).height, net(&plain).main_ropes.levels.len()), (4.0, 3));
    // A single key, a list as a whole, and another way to tell the same.
    let changed = "  kit: kits/ring_net_4m.yaml\n  flexible_net:\n    height: 3.6 m\n    main_ropes: {heights: [0 m, 1.8 m, 3.6 m]}\n    anchors: {resistance: 400 kN}   # tested again\n";
    let file = with(changed).unwrap_or_else(|problems| panic!("{problems}"));
    let changed = net(&file);
    assert_eq!(changed.height, 3.6);
    assert_eq!(changed.main_ropes.heights(), [0.0, 1.8, 3.6]);
    assert!(changed.main_ropes.levels.iter().all(|level| level.ropes == 1));
    assert_eq!(changed.anchor_designs.all.resistance, AnchorResistance::Characteristic(400e3));
    assert_eq!(changed.rings, net(&plain).rings);
    let remark = |path: &str| file.entries.values[path].remark.clone();
    assert_eq!(remark("barrier.flexible_net.anchors.resistance"), "tested again");
    assert_eq!(remark("barrier.flexible_net.height"), "");
    assert!(remark("barrier.flexible_net.net.rings.windings").contains("kit"));
}

/// Where the same thing can be given in different ways, the design's way stands alone.
#[test]
fn the_way_of_the_design_stands_alone() {
    let of = |kit: &str, own: &str| {
        let file = with(&format!("  kit: kits/{kit}.yaml\n  flexible_net:\n{own}"))
            .unwrap_or_else(|problems| panic!("{own}: {problems}"));
        net(&file).clone()
    };
    let posts = "    posts: {at: [-2.5 m, 2.5 m]";
    let given = of("ring_net_5m_posts", &format!("{posts}, resistance: 900 kN, bending_resistance: 90 kN m}}\n"));
    assert!(matches!(given.posts.expect("posts").strength, PostStrength::Given { .. }));
    let thicker = of("ring_net_5m_posts", &format!("{posts}, retaining_ropes: {{rope: 6x36-IWRC 32 mm 1770}}}}\n"));
    assert_eq!(thicker.posts.expect("posts").retaining.rope.diameter, 0.032);
    let typed = "    main_ropes: {diameter: 30 mm, modulus: 50 GPa, breaking_load: 500 kN}\n";
    assert_eq!(of("ring_net_4m", typed).main_ropes.levels[1].rope.diameter, 0.03);
    // A breaking load beside the name of the kit is that of a certificate.
    assert_eq!(
        of("ring_net_4m", "    main_ropes: {breaking_load: 300 kN}\n").main_ropes.levels[1].rope.breaking_load,
        300e3
    );
    let curve = "    dissipators: {curve: {after_unloading: [[0 m, 90 kN], [1 m, 120 kN]]}}\n";
    assert_eq!(of("rope_net_2m", curve).dissipators.expect("dissipators").plateau, 120e3);
    let plateau = "    dissipators: {plateau_force: 90 kN, stroke: 1 m}\n";
    assert_eq!(of("ring_net_4m", plateau).dissipators.expect("dissipators").stroke, 1.0);
    let stroke = "    dissipators: {stroke: 1.1 m}\n";
    assert_eq!(of("rope_net_2m", stroke).dissipators.expect("dissipators").stroke, 1.1);
    let mesh = "    mesh_opening: 300 mm\n    net_rope: {rope: 6x36-IWRC 16 mm 1770}\n    main_ropes: {rings: {spacing: 424 mm}}\n";
    assert!(of("ring_net_4m", mesh).rings.is_none());
    let free = "    bottom: {opening: 0.3 m}\n    anchors: {design_resistance: 280 kN}\n";
    let free = of("ring_net_4m", free);
    assert_eq!(
        (free.bottom, free.anchor_designs.all.resistance),
        (Bottom::Opening(0.3), AnchorResistance::Design(280e3))
    );
}

#[test]
fn a_design_equals_the_same_written_out() {
    let kit = std::fs::read_to_string("designs/kits/ring_net_4m.yaml").expect("a kit");
    let written: String = kit.lines().map(|line| format!("  {line}\n")).collect();
    let [one, other] =
        [with("  kit: kits/ring_net_4m.yaml\n"), with(&written)].map(|file| file.expect("a design").design);
    assert_eq!(one, other);
}
