//! The film as files for ParaView: a `.vtp` (XML PolyData) for every frame, of the spheres and of the ropes, and a `.pvd` that
//! ties each series to its times.

use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::report::folder::ReportFile;
use crate::report::segment_kinds::code;
use dem::Vec3;
use dem::recorders::film::{Film, Frame};

/// Folder of the files within the report's.
pub const FOLDER: &str = "vtk";

/// All files of a film, and of the ground it was taken on.
pub fn files(film: &Film, ground: &[Vec<Vec3>]) -> Vec<ReportFile> {
    let mut files = Vec::new();
    let mut series = |name: &str, text: &dyn Fn(&Frame) -> String| {
        let names: Vec<String> = (0..film.frames.len()).map(|number| format!("{name}_{number:04}.vtp")).collect();
        files.push(ReportFile::new(format!("{name}.pvd"), collection(&names, &film.frames)));
        files.extend(names.into_iter().zip(&film.frames).map(|(file, frame)| ReportFile::new(file, text(frame))));
    };
    series("grains", &|frame| grains(film, frame));
    if !film.ropes.is_empty() {
        series("barrier", &|frame| barrier(film, frame));
    }
    files.push(ReportFile::new("ground.vtp".to_string(), ground_pieces(ground)));
    files
}

/// The ground in flat pieces.
fn ground_pieces(ground: &[Vec<Vec3>]) -> String {
    let points: Vec<f32> =
        ground.iter().flatten().flat_map(|corner| [corner.x, corner.y, corner.z].map(|c| c as f32)).collect();
    let corners: Vec<u32> = (0..points.len() as u32 / 3).collect();
    let ends: Vec<u32> = ground
        .iter()
        .scan(0, |end, piece| {
            *end += piece.len() as u32;
            Some(*end)
        })
        .collect();
    poly_data(&points, "Polys", [&corners, &ends], "CellData", &[])
}

fn collection(files: &[String], frames: &[Frame]) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n",
    );
    for (file, Frame { time, .. }) in files.iter().zip(frames) {
        let _ = writeln!(text, "<DataSet timestep=\"{time:.6}\" part=\"0\" file=\"{file}\"/>");
    }
    text + "</Collection>\n</VTKFile>\n"
}

/// The spheres of all grains in the model.
fn grains(film: &Film, frame: &Frame) -> String {
    let mut points = Vec::new();
    let [mut radius, mut speed, mut force, mut number] = [const { Vec::<f32>::new() }; 4];
    for (id, (pose, [size, offset])) in frame.grains.iter().zip(&film.looks).enumerate() {
        let Some(pose) = pose else { continue };
        let sides: &[f32] = if *offset > 0.0 { &[-1.0, 1.0] } else { &[0.0] };
        for side in sides {
            points.extend((0..3).map(|axis| pose.place[axis] + side * offset * pose.axis[axis]));
            radius.push(*size);
            speed.push(pose.speed);
            force.push(pose.force);
            number.push(id as f32);
        }
    }
    let count = radius.len();
    let data = [
        array("radius_m", 1, &radius),
        array("speed_m_s", 1, &speed),
        array("force_on_barrier_n", 1, &force),
        array("grain", 1, &number),
    ];
    let each: Vec<u32> = (0..count as u32).collect();
    let ends: Vec<u32> = (1..=count as u32).collect();
    poly_data(&points, "Verts", [&each, &ends], "PointData", &data)
}

/// The ropes of the barrier.
fn barrier(film: &Film, frame: &Frame) -> String {
    let points: Vec<f32> = frame.nodes.iter().flatten().copied().collect();
    let nodes: Vec<u32> = film.ropes.iter().flat_map(|(nodes, _)| *nodes).collect();
    let ends: Vec<u32> = (1..=film.ropes.len() as u32).map(|rope| 2 * rope).collect();
    let kinds: Vec<f32> = film.ropes.iter().map(|(_, of)| code(of).into()).collect();
    let data = [array("tension_n", 1, &frame.tensions), array("kind", 1, &kinds)];
    poly_data(&points, "Lines", [&nodes, &ends], "CellData", &data)
}

fn poly_data(
    points: &[f32],
    cells: &str,
    [connectivity, offsets]: [&[u32]; 2],
    place: &str,
    data: &[String],
) -> String {
    let count = points.len() / 3;
    let pieces = offsets.len();
    let count_of = |kind: &str| if kind == cells { pieces } else { 0 };
    let counts = ["Verts", "Lines", "Strips", "Polys"].map(|kind| format!("NumberOf{kind}=\"{}\"", count_of(kind)));
    let counts = counts.join(" ");
    format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n<PolyData>\n<Piece NumberOfPoints=\"{count}\" {counts}>\n<Points>\n{}</Points>\n<{cells}>\n{}{}</{cells}>\n<{place}>\n{}</{place}>\n</Piece>\n</PolyData>\n</VTKFile>\n",
        array("Points", 3, points),
        integers("connectivity", connectivity),
        integers("offsets", offsets),
        data.concat()
    )
}

fn array(name: &str, components: usize, values: &[f32]) -> String {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    data_array("Float32", name, components, &bytes)
}

fn integers(name: &str, values: &[u32]) -> String {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    data_array("UInt32", name, 1, &bytes)
}

/// Binary data with its length in bytes before it, in base 64.
fn data_array(kind: &str, name: &str, components: usize, bytes: &[u8]) -> String {
    let block = [&(bytes.len() as u32).to_le_bytes(), bytes].concat();
    let coded = STANDARD.encode(block);
    format!(
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"binary\">{coded}</DataArray>\n"
    )
}
