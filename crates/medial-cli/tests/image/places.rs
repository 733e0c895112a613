//! Where images lie, and where what is made of them does.

use super::*;

/// A GeoTIFF of letters, `r` red and others blue, with pixels of 2 by 2 from (100, 50) on downwards, in a reference
/// system of EPSG, or none for 0.
pub fn geotiff(path: &Path, rows: &[&str], epsg: u16) {
    let colour = |letter: u8| if letter == b'r' { [200, 30, 30] } else { [30, 40, 180] };
    let pixels: Vec<u8> = rows.iter().flat_map(|row| row.bytes()).flat_map(colour).collect();
    tiff(path, [rows[0].len() as u32, rows.len() as u32], 3, &pixels, epsg);
}

/// One of real numbers.
pub fn geotiff_of_numbers(path: &Path, rows: &[&[f32]], epsg: u16) {
    let pixels: Vec<u8> = rows.iter().copied().flatten().flat_map(|v| v.to_le_bytes()).collect();
    tiff(path, [rows[0].len() as u32, rows.len() as u32], 1, &pixels, epsg);
}

/// One of three bytes a pixel, or of one number.
fn tiff(path: &Path, [columns, n_rows]: [u32; 2], each: u32, pixels: &[u8], epsg: u16) {
    let doubles = [2.0, 2.0, 0.0, 0.0, 0.0, 0.0, 100.0, 50.0, 0.0_f64];
    let keys = [1, 1, 0, 1, 3072, 0, 1, epsg];
    // A header of 8 bytes, the pixels, their depths, the doubles, the keys, then the directory.
    let [depths, numbers] = [8 + pixels.len() as u32, 14 + pixels.len() as u32];
    let keys_at = numbers + 72;
    let directory = keys_at + 16;
    let mut bytes = [b"II\x2a\0", &directory.to_le_bytes()[..], pixels].concat();
    bytes.extend([8_u16; 3].into_iter().flat_map(u16::to_le_bytes));
    bytes.extend(doubles.into_iter().flat_map(f64::to_le_bytes));
    bytes.extend(keys.into_iter().flat_map(u16::to_le_bytes));
    let is_real = each == 1;
    // Tag, kind (3 for 16 bits, 4 for 32, 12 for doubles), count, and a value or where it is.
    let entries: [(u16, u16, u32, u32); 13] = [
        (256, 4, 1, columns),
        (257, 4, 1, n_rows),
        (258, 3, each, if is_real { 32 } else { depths }),
        (259, 3, 1, 1),
        (262, 3, 1, if is_real { 1 } else { 2 }),
        (273, 4, 1, 8),
        (277, 3, 1, each),
        (278, 4, 1, n_rows),
        (279, 4, 1, pixels.len() as u32),
        (339, 3, 1, if is_real { 3 } else { 1 }),
        (33550, 12, 3, numbers),
        (33922, 12, 6, numbers + 24),
        (34735, 3, 8, keys_at),
    ];
    bytes.extend((entries.len() as u16).to_le_bytes());
    for (tag, kind, count, value) in entries {
        bytes.extend([tag, kind].into_iter().flat_map(u16::to_le_bytes));
        bytes.extend([count, value].into_iter().flat_map(u32::to_le_bytes));
    }
    bytes.extend([0; 4]);
    fs::write(path, bytes).unwrap();
}

#[test]
fn points_and_layers_are_in_the_plane_of_a_georeferenced_image() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.tif");
    geotiff(&scene, &["......", ".rrrr.", ".rrrr.", "......"], 0);
    let run = medial(&words(scene.to_str().unwrap(), &["--at", "105,47", "--prune", "none"]));
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let layers = by_layer(run.text());
    let border = &layers["border"][0];
    assert_eq!(border["properties"]["area"], 32.0);
    let ring = &border["geometry"]["coordinates"][0];
    assert_eq!(ring[0], serde_json::json!([102.0, 48.0]));
    let widest = |f: &Value| f["properties"]["radius_max"].as_f64().unwrap();
    let radius = layers["axis"].iter().map(widest).fold(0.0, f64::max);
    assert!((2.0..2.1).contains(&radius), "{radius}");
    let outside = medial(&words(scene.to_str().unwrap(), &["--at", "3,-2"]));
    assert_eq!(outside.status, Some(1));
    assert!(outside.errors.contains("which reaches from 100,42 to 112,50"), "{}", outside.errors);
}

#[test]
fn pictures_tell_where_they_lie() {
    let folder = tempfile::tempdir().unwrap();
    let name = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let [scene, bare] = [name("scene.tif"), name("bare.tif")];
    geotiff(Path::new(&scene), &["......", ".rrrr.", "......"], 32633);
    geotiff(Path::new(&bare), &["......", ".rrrr.", "......"], 0);
    // The regions, a pixel for each: the centre of the first one is half of 2 by 2 from (100, 50).
    let run = medial(&["segment", &scene, "-o", &name("regions.png")]);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    assert_eq!(fs::read_to_string(name("regions.pgw")).unwrap(), "2\n0\n0\n-2\n101\n49\n");
    assert!(fs::read_to_string(name("regions.prj")).unwrap().starts_with("PROJCS[\"WGS 84 / UTM"));
    // The layers: 12 units are 1000 pixels, twice, with 28 pixels to the left and 62 above.
    for more in [&[][..], &["--compare", &scene]] {
        let layers = name("layers.png");
        let run = medial(&words(&scene, &[&["-o", &layers], more].concat()));
        assert_eq!(run.status, Some(0), "{}", run.errors);
        let told = fs::read_to_string(name("layers.pgw")).unwrap();
        let told: Vec<f64> = told.lines().map(|line| line.parse().unwrap()).collect();
        let step = 12.0 / 2000.0;
        let expected =
            [step, 0.0, 0.0, -step, 100.0 - 55.5 * step, 50.0 + (2.0 * 62.0 - 0.5) * step];
        assert!(told.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{told:?}");
        fs::remove_file(name("layers.pgw")).unwrap();
    }
    assert!(Path::new(&name("layers.prj")).exists());
    let svg = medial(&words(&scene, &["--to", "svg"]));
    assert!(svg.text().contains("EPSG/0/32633\" svg:transform=\"matrix("), "{}", svg.errors);
    // Without a system there is no text for it, and what has no place tells none.
    let run = medial(&["segment", &bare, "-o", &name("bare.png")]);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    assert!(Path::new(&name("bare.pgw")).exists() && !Path::new(&name("bare.prj")).exists());
    let plain = picture(folder.path(), "plain.png", &["....", ".rr.", "...."]);
    let run = medial(&words(&plain, &["-o", &name("drawn.png")]));
    assert_eq!(run.status, Some(0), "{}", run.errors);
    assert!(!Path::new(&name("drawn.pgw")).exists());
}

#[test]
fn files_beside_an_image_say_where_it_lies() {
    let folder = tempfile::tempdir().unwrap();
    let scene = picture(folder.path(), "scene.png", &["....", ".rr.", "...."]);
    let beside = |name: &str| folder.path().join(name);
    fs::write(beside("scene.pgw"), "2\n0\n0\n-2\n101\n49\n").unwrap();
    fs::write(beside("scene.prj"), "LOCAL_CS[\"here\",UNIT[\"metre\",1]]").unwrap();
    let labels = beside("labels.tiff").to_str().unwrap().to_owned();
    let chosen = ["-q", "--at", "103,47", "--layers", "border", "--to", "wkt"];
    let run = medial(&words(&scene, &[&chosen[..], &["--labels", &labels]].concat()));
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let border = "POLYGON ((102 48, 102 46, 106 46, 106 48, 102 48))\n";
    assert_eq!(run.text(), border);
    // What is made of it lies there, too.
    let again = ["image", &labels, "--method", "labels", "--layers", "border", "--to", "wkt"];
    let run = medial(&again);
    assert_eq!((run.status, run.text()), (Some(0), border), "{}", run.errors);
    // And its mask.
    let run = medial(&["axis", &scene, "--prune", "none", "--to", "wkt"]);
    assert!(run.text().contains("(103 47, 105 47)"), "{}", run.text());
    // Nothing takes the place of a file that says where an image lies.
    for (name, command) in [("scene.pgw", "segment"), ("scene.prj", "image"), ("scene.pgw", "axis")]
    {
        let file = beside(name).to_str().unwrap().to_owned();
        let run = medial(&[command, &scene, "--report", &file, "--to", "csv"]);
        assert_eq!(run.status, Some(2), "{}", run.errors);
        assert!(run.errors.contains("is the input"), "{}", run.errors);
    }
    // Left beside a picture without a place it is told.
    let other = picture(folder.path(), "other.png", &["....", ".rr.", "...."]);
    let run = medial(&["segment", &scene, "-q", "-o", beside("drawn.png").to_str().unwrap()]);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let run = medial(&["segment", &other, "-o", beside("drawn.png").to_str().unwrap()]);
    assert!(run.errors.contains("drawn.pgw was there before and says"), "{}", run.errors);
    // A place of its own comes first.
    let tiff = beside("scene.tif");
    geotiff(&tiff, &["....", ".rr.", "...."], 32633);
    fs::write(beside("scene.tfw"), "7\n0\n0\n-7\n0\n0\n").unwrap();
    let run = medial(&words(tiff.to_str().unwrap(), &["--layers", "border", "--to", "wkt"]));
    assert!(!run.text().contains("-3.5"), "{}", run.text());
    for (text, why) in [
        ("2\n0\n0\n-2\n101\n", "begins with 5 numbers, not with six"),
        ("2\n0.5\n0\n-2\n101\n49\n", "turns the image; warp it first"),
        ("1e-9\n0\n0\n-1e-9\n431000\n0\n", "are too small for coordinates up to 431000"),
    ] {
        fs::write(beside("scene.pgw"), text).unwrap();
        for command in ["axis", "segment", "image"] {
            let run = medial(&[command, &scene]);
            assert_eq!((run.status, run.text()), (Some(1), ""));
            assert!(run.errors.contains("scene.p") && run.errors.contains(why), "{}", run.errors);
        }
    }
}
