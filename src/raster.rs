//! A terrain raster: an ESRI ASCII grid or a GeoTIFF.

use std::io::Cursor;

use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

/// Cells at the most.
const MOST_CELLS: f64 = 2.5e7;
/// Bytes that the decoder of a TIFF may take for an image.
const MOST_BYTES: usize = 256 << 20;
/// Cells of so little, in the unit of the coordinates, between coordinates of a globe are degrees.
const DEGREES: f64 = 0.1;
/// Tags of a GeoTIFF: size of a cell, a place that is known, what stands for no value, and the keys of its coordinates.
const PIXEL_SCALE: Tag = Tag::ModelPixelScaleTag;
const TIE_POINT: Tag = Tag::ModelTiepointTag;
const NO_DATA: Tag = Tag::GdalNodata;
const GEO_KEYS: Tag = Tag::GeoKeyDirectoryTag;
/// Key and value of coordinates in degrees, and of rasters whose values are told of points rather than of cells.
const MODEL_TYPE: u16 = 1024;
const GEOGRAPHIC: u16 = 2;
const RASTER_TYPE: u16 = 1025;
/// Key of the unit of lengths, and the metre.
const LINEAR_UNIT: u16 = 3076;
const METRE: u16 = 9001;
const OF_POINTS: u16 = 2;

/// Heights of cells over the coordinates of their centres.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    /// Centre of the cell in the lower left corner: east and north.
    pub first: [f64; 2],
    pub cell: f64,
    pub columns: usize,
    pub rows: usize,
    /// Row by row from the north, each from the west; NaN where there is no value.
    heights: Vec<f32>,
}

/// What is wrong with a file, and what would help.
pub type Wrong = (String, String);

fn wrong(found: impl Into<String>, hint: impl Into<String>) -> Wrong {
    (found.into(), hint.into())
}

/// Reads a raster, whichever of both it is.
pub fn read(bytes: &[u8]) -> Result<Raster, Wrong> {
    let raster = match bytes {
        [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..] => read_tiff(bytes)?,
        _ => read_ascii(bytes)?,
    };
    raster.is_metric()?;
    Ok(raster)
}

impl Raster {
    fn new(first: [f64; 2], cell: f64, [columns, rows]: [usize; 2], heights: Vec<f32>) -> Self {
        Self { first, cell, columns, rows, heights }
    }

    /// Coordinates of a globe are no lengths.
    fn is_metric(&self) -> Result<(), Wrong> {
        let [east, north] = self.first;
        if east.abs() <= 180.0 && north.abs() <= 90.0 && self.cell < DEGREES {
            let found = format!("whose cells of {} at {east:.4}, {north:.4} look like degrees", self.cell);
            return Err(wrong(found, "project it to metres first, as to a national grid or UTM"));
        }
        Ok(())
    }

    /// Easternmost and northernmost centre.
    pub fn last(&self) -> [f64; 2] {
        [self.first[0] + self.cell * (self.columns - 1) as f64, self.first[1] + self.cell * (self.rows - 1) as f64]
    }

    /// Height at a place, by straight lines between the centres; nothing outside them or where one of the four has no value.
    pub fn height(&self, [east, north]: [f64; 2]) -> Option<f64> {
        let [column, row] = [(east - self.first[0]) / self.cell, (north - self.first[1]) / self.cell];
        let rounding = 1e-6;
        let inside = |place: f64, count: usize| place >= -rounding && place <= (count - 1) as f64 + rounding;
        if !(inside(column, self.columns) && inside(row, self.rows)) {
            return None;
        }
        let split = |place: f64, count: usize| {
            let place = place.clamp(0.0, (count - 1) as f64);
            let before = (place as usize).min(count.saturating_sub(2));
            (before, place - before as f64)
        };
        let ((column, across), (row, up)) = (split(column, self.columns), split(row, self.rows));
        let at = |column: usize, row: usize| {
            let (column, row) = (column.min(self.columns - 1), row.min(self.rows - 1));
            f64::from(self.heights[(self.rows - 1 - row) * self.columns + column])
        };
        let corners = [at(column, row), at(column + 1, row), at(column, row + 1), at(column + 1, row + 1)];
        let weights = [(1.0 - across) * (1.0 - up), across * (1.0 - up), (1.0 - across) * up, across * up];
        // A corner without weight need not have a value.
        let parts = corners.into_iter().zip(weights).filter(|(_, weight)| *weight > 0.0);
        let height = parts.map(|(height, weight)| height * weight).sum::<f64>();
        height.is_finite().then_some(height)
    }
}

/// Heights of the ground (m).
const HEIGHTS: [f64; 2] = [-500.0, 9000.0];
/// What stands for no value where a file does not say it.
const USUAL_NO_DATA: f64 = -9999.0;

/// A height, or NaN for what stands for none.
fn height_of(value: f64, no_data: Option<f64>) -> Result<f32, Wrong> {
    // As the file holds it: a number of 32 bits may have been written in decimals.
    let is = |mark: f64| value as f32 == mark as f32 || (value - mark).abs() <= 1e-5 * mark.abs();
    if value.is_nan() || is(no_data.unwrap_or(USUAL_NO_DATA)) {
        return Ok(f32::NAN);
    }
    if !(HEIGHTS[0]..=HEIGHTS[1]).contains(&value) {
        let hint = "heights are metres above the sea; what stands for no value is told by `NODATA_value`, or by the tag of GDAL";
        return Err(wrong(format!("which holds the height {value:.6e}"), hint));
    }
    Ok(value as f32)
}

/// Cells are counted before memory is taken for them.
fn bearable(columns: f64, rows: f64) -> Result<(), Wrong> {
    if !(columns >= 2.0 && rows >= 2.0) {
        return Err(wrong(
            format!("of {columns} by {rows} cells"),
            "a raster has two columns and two rows at the least",
        ));
    }
    if columns * rows > MOST_CELLS {
        let found = format!("of {:.2e} cells", columns * rows);
        return Err(wrong(found, format!("cut it to the gully: at most {MOST_CELLS:.1e} cells are read")));
    }
    Ok(())
}

const HEAD: &str = "an ESRI ASCII grid begins with `ncols`, `nrows`, `xllcorner` or `xllcenter`, `yllcorner` or `yllcenter`, `cellsize`, and \
                    perhaps `NODATA_value`";

fn read_ascii(bytes: &[u8]) -> Result<Raster, Wrong> {
    let text = std::str::from_utf8(bytes).map_err(|_| wrong("which is neither an ESRI ASCII grid nor a TIFF", HEAD))?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut words = text.split_ascii_whitespace().peekable();
    let [mut columns, mut rows, mut cell, mut no_data] = [None; 4];
    let mut corner = [None; 2];
    let mut half = [0.0; 2];
    while let Some(word) = words.peek().filter(|word| word.starts_with(|first: char| first.is_ascii_alphabetic())) {
        let name = word.to_ascii_lowercase();
        words.next();
        let value = words.next().and_then(|word| word.parse::<f64>().ok());
        let value = value.ok_or_else(|| wrong(format!("whose head gives no number for `{name}`"), HEAD))?;
        match name.as_str() {
            "ncols" => columns = Some(value),
            "nrows" => rows = Some(value),
            "cellsize" => cell = Some(value),
            "nodata_value" => no_data = Some(value),
            "xllcorner" => (corner[0], half[0]) = (Some(value), 0.5),
            "yllcorner" => (corner[1], half[1]) = (Some(value), 0.5),
            "xllcenter" => corner[0] = Some(value),
            "yllcenter" => corner[1] = Some(value),
            _ => return Err(wrong(format!("whose head has the unknown word `{name}`"), HEAD)),
        }
    }
    let missing = |name: &str| wrong(format!("whose head has no `{name}`"), HEAD);
    let columns = columns.ok_or_else(|| missing("ncols"))?;
    let rows = rows.ok_or_else(|| missing("nrows"))?;
    let cell = cell.ok_or_else(|| missing("cellsize"))?;
    let [east, north] =
        [corner[0].ok_or_else(|| missing("xllcorner"))?, corner[1].ok_or_else(|| missing("yllcorner"))?];
    if !(cell > 0.0 && cell.is_finite()) || columns.fract() != 0.0 || rows.fract() != 0.0 {
        return Err(wrong(format!("of {columns} by {rows} cells of {cell}"), HEAD));
    }
    bearable(columns, rows)?;
    let count = columns as usize * rows as usize;
    let mut heights = Vec::with_capacity(count);
    for word in words {
        let value = word.parse::<f64>().map_err(|_| {
            wrong(
                format!("whose value {} is `{word}`, not a number", heights.len() + 1),
                "values have a decimal point and are parted by blanks",
            )
        })?;
        heights.push(height_of(value, no_data)?);
        if heights.len() > count {
            break;
        }
    }
    if heights.len() != count {
        let more = if heights.len() > count { "more values than" } else { "fewer values than" };
        return Err(wrong(
            format!("which holds {more} the {count} of its head"),
            "was it cut short, or put together of two?",
        ));
    }
    let first = [east + half[0] * cell, north + half[1] * cell];
    Ok(Raster::new(first, cell, [columns as usize, rows as usize], heights))
}

fn read_tiff(bytes: &[u8]) -> Result<Raster, Wrong> {
    let broken = |error: tiff::TiffError| {
        wrong(
            format!("a TIFF that cannot be read: {error}"),
            "write it as a plain GeoTIFF with one band of 32-bit numbers, uncompressed, LZW or deflate; or as an ESRI ASCII grid",
        )
    };
    let mut limits = Limits::default();
    limits.decoding_buffer_size = MOST_BYTES;
    let mut decoder = Decoder::new(Cursor::new(bytes)).map_err(broken)?.with_limits(limits);
    let (columns, rows) = decoder.dimensions().map_err(broken)?;
    bearable(f64::from(columns), f64::from(rows))?;
    let scale = decoder.get_tag_f64_vec(PIXEL_SCALE).ok().filter(|scale| scale.len() >= 2);
    let tie = decoder.get_tag_f64_vec(TIE_POINT).ok().filter(|tie| tie.len() >= 6);
    let (Some(scale), Some(tie)) = (scale, tie) else {
        return Err(wrong(
            "a TIFF without coordinates",
            "a GeoTIFF has the size of its cells and one known place (ModelPixelScale, ModelTiepoint)",
        ));
    };
    if (scale[0] - scale[1]).abs() > 1e-9 * scale[0].abs() || scale[0] <= 0.0 {
        return Err(wrong(format!("with cells of {} by {}", scale[0], scale[1]), "cells must be square"));
    }
    let keys = decoder.get_tag_u16_vec(GEO_KEYS).unwrap_or_default();
    let key = |name: u16| keys.chunks_exact(4).skip(1).find(|key| key[0] == name && key[1] == 0).map(|key| key[3]);
    if key(MODEL_TYPE) == Some(GEOGRAPHIC) {
        return Err(wrong("whose coordinates are degrees", "project it to metres first, as to a national grid or UTM"));
    }
    if let Some(unit) = key(LINEAR_UNIT).filter(|unit| *unit != METRE) {
        return Err(wrong(
            format!("whose coordinates are in the unit {unit} of EPSG, not in metres"),
            "project it to a grid in metres first",
        ));
    }
    let orientation = decoder_tag(&mut decoder, Tag::Orientation);
    let white_is_zero = decoder_tag(&mut decoder, Tag::PhotometricInterpretation);
    if orientation.is_some_and(|orientation| orientation != 1) || white_is_zero == Some(0) {
        return Err(wrong(
            "a TIFF that is turned or inverted",
            "write it with the north up and the first row in the north, as GDAL does",
        ));
    }
    let no_data = decoder.get_tag_ascii_string(NO_DATA).ok();
    let no_data = no_data.and_then(|text| text.trim_matches(['\0', ' ']).parse::<f64>().ok());
    let values: Vec<f64> = match decoder.read_image().map_err(broken)? {
        DecodingResult::F32(values) => values.into_iter().map(f64::from).collect(),
        DecodingResult::F64(values) => values,
        DecodingResult::I16(values) => values.into_iter().map(f64::from).collect(),
        DecodingResult::I32(values) => values.into_iter().map(f64::from).collect(),
        DecodingResult::U16(values) => values.into_iter().map(f64::from).collect(),
        DecodingResult::U32(values) => values.into_iter().map(f64::from).collect(),
        _ => return Err(wrong("a TIFF of another kind of values", "heights are numbers of 16, 32 or 64 bits")),
    };
    let (columns, rows) = (columns as usize, rows as usize);
    if values.len() != columns * rows {
        return Err(wrong("a TIFF of several bands", "give the heights as one band"));
    }
    let heights = values.into_iter().map(|value| height_of(value, no_data)).collect::<Result<_, _>>()?;
    // The known place is the corner of a cell, or its centre, counted from the north-west.
    let half = if key(RASTER_TYPE) == Some(OF_POINTS) { 0.0 } else { 0.5 };
    let cell = scale[0];
    let west = tie[3] + (half - tie[0]) * cell;
    let north = tie[4] - (half - tie[1]) * cell;
    Ok(Raster::new([west, north - cell * (rows - 1) as f64], cell, [columns, rows], heights))
}

/// A tag that is one number.
fn decoder_tag(decoder: &mut Decoder<Cursor<&[u8]>>, tag: Tag) -> Option<u32> {
    decoder.find_tag_unsigned(tag).ok().flatten()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use tiff::encoder::{TiffEncoder, colortype};

    const GRID: &str =
        "ncols 3\nnrows 2\nxllcorner 1000\nyllcorner 2000\ncellsize 2\nNODATA_value -9999\n1 2 3\n4 5 -9999\n";

    #[test]
    fn a_grid_is_read_from_the_north_west() {
        let raster = read(GRID.as_bytes()).unwrap();
        assert_eq!((raster.first, raster.last(), raster.cell), ([1001.0, 2001.0], [1005.0, 2003.0], 2.0));
        for (place, height) in
            [([1001.0, 2003.0], 1.0), ([1005.0, 2003.0], 3.0), ([1001.0, 2001.0], 4.0), ([1002.0, 2002.0], 3.0)]
        {
            assert_relative_eq!(raster.height(place).unwrap(), height, max_relative = 1e-12);
        }
        assert_eq!((raster.height([1005.0, 2001.0]), raster.height([1000.0, 2001.0])), (None, None));
        // What is told by nobody stands for no value as well.
        let untold = read(GRID.replace("NODATA_value -9999\n", "").as_bytes()).unwrap();
        assert_eq!(untold.height([1005.0, 2001.0]), None);
        let centred = GRID.replace("llcorner", "llcenter");
        assert_eq!(read(centred.as_bytes()).unwrap().first, [1000.0, 2000.0]);
    }

    #[test]
    fn a_tiff_says_the_same_as_the_grid() {
        let mut bytes = Cursor::new(Vec::new());
        let mut encoder = TiffEncoder::new(&mut bytes).unwrap();
        let mut image = encoder.new_image::<colortype::Gray32Float>(3, 2).unwrap();
        image.encoder().write_tag(PIXEL_SCALE, &[2.0_f64, 2.0, 0.0][..]).unwrap();
        image.encoder().write_tag(TIE_POINT, &[0.0_f64, 0.0, 0.0, 1000.0, 2004.0, 0.0][..]).unwrap();
        image.encoder().write_tag(NO_DATA, "-9999").unwrap();
        image.write_data(&[1.0_f32, 2.0, 3.0, 4.0, 5.0, -9999.0]).unwrap();
        let (tiff, grid) = (read(bytes.get_ref()).unwrap(), read(GRID.as_bytes()).unwrap());
        assert_eq!((tiff.first, tiff.cell), (grid.first, grid.cell));
        for place in [[1001.0, 2003.0], [1002.3, 2002.1], [1005.0, 2001.0]] {
            assert_eq!(tiff.height(place), grid.height(place));
        }
    }

    #[test]
    fn what_is_wrong_with_a_raster_is_told() {
        for (text, found) in [
            (GRID.replace("ncols 3\n", ""), "whose head has no `ncols`"),
            (GRID.replace("ncols 3", "ncols three"), "whose head gives no number for `ncols`"),
            (GRID.replace("4 5", "4"), "which holds fewer values than the 6 of its head"),
            (GRID.replace("4 5", "4 5 6"), "which holds more values than the 6 of its head"),
            (GRID.replace("4 5", "4 x"), "whose value 5 is `x`, not a number"),
            (GRID.replace("ncols 3", "ncols 100000").replace("nrows 2", "nrows 100000"), "of 1.00e10 cells"),
            (GRID.replace("cellsize 2", "cellsize 0"), "of 3 by 2 cells of 0"),
            (
                GRID.replace("1000", "7.5").replace("2000", "46.5").replace("cellsize 2", "cellsize 0.0001"),
                "look like degrees",
            ),
            ("hello".into(), "whose head gives no number for `hello`"),
            (GRID.replace("4 5", "4 -3.4e38"), "which holds the height -3.4"),
        ] {
            let told = read(text.as_bytes()).unwrap_err().0;
            assert!(told.contains(found), "{told} instead of {found}");
        }
        assert!(read(b"II*\0garbage").unwrap_err().0.contains("a TIFF that cannot be read"));
        assert!(read(&[0xff, 0xfe, 0x00]).unwrap_err().0.contains("neither"));
    }
}
