//! Pictures, looked at pixel by pixel: boxes of unit cubes, seen squarely, whose faces must be where a ruler puts them.
//!
//! In a picture of 1200 by 900 the body is fitted into columns 130 to 985 and rows 128 to 840, the colour bar stands
//! in columns 1035 to 1059 and rows 200 to 700, and the background is white.

use std::fs::File;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use tempfile::TempDir;
use tiny_skia::Pixmap;
use urto::exodus::{ResultsHeader, ResultsWriter, write_mesh};
use urto::mesh::{Block, Mesh};
use urto::postprocess::view::{MapChoice, StateChoice, ViewError, ViewOptions, draw, draw_many, draw_row};

const WHITE: [u8; 3] = [255; 3];

/// `counts` unit cubes in x, y, z from the origin; those with z below 1 are block 1, the others block 2.
fn boxes([nx, ny, nz]: [u32; 3]) -> Mesh {
    let node = |i: u32, j: u32, k: u32| (k * (ny + 1) + j) * (nx + 1) + i;
    let mut mesh = Mesh { title: "Boxes".to_owned(), ..Mesh::default() };
    for n in 0..(nx + 1) * (ny + 1) * (nz + 1) {
        let (i, j, k) = (n % (nx + 1), n / (nx + 1) % (ny + 1), n / ((nx + 1) * (ny + 1)));
        mesh.coordinates.push([i, j, k].map(f64::from));
    }
    let mut cubes: [Vec<[u32; 8]>; 2] = Default::default();
    for n in 0..nx * ny * nz {
        let (i, j, k) = (n % nx, n / nx % ny, n / (nx * ny));
        let floor = |k: u32| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
        let ([a, b, c, d], [e, f, g, h]) = (floor(k), floor(k + 1));
        cubes[usize::from(k > 0)].push([a, b, c, d, e, f, g, h]);
    }
    for (connectivity, id) in cubes.into_iter().zip(1..).filter(|(cubes, _)| !cubes.is_empty()) {
        mesh.blocks.push(Block::hexahedra_of(id, connectivity));
    }
    mesh.node_ids = (1..=mesh.coordinates.len() as i64).collect();
    mesh.element_ids = (1..=mesh.element_count() as i64).collect();
    mesh
}

/// One state of a results file: what the nodes' displacement and the elements' stress and death are.
struct State {
    displacement: fn([f64; 3]) -> [f64; 3],
    stress: Vec<f64>,
    death: Option<Vec<f64>>,
}

impl State {
    fn of(stress: &[f64]) -> State {
        State { displacement: |_| [0.0; 3], stress: stress.to_vec(), death: None }
    }
}

/// A results file in a folder that vanishes with it.
struct Run {
    folder: TempDir,
    results: PathBuf,
}

impl Run {
    fn new(counts: [u32; 3], states: &[State]) -> Run {
        let folder = TempDir::new().unwrap();
        let results = folder.path().join("run.e");
        let mesh = boxes(counts);
        let names = |list: &str| list.split(' ').map(str::to_owned).collect();
        let mortal = states.iter().any(|state| state.death.is_some());
        let header = ResultsHeader {
            mesh: &mesh,
            title: mesh.title.clone(),
            global: Vec::new(),
            nodal: names("DISPLX DISPLY DISPLZ"),
            element: names(if mortal { "VONMISES DEATH" } else { "VONMISES" }),
            qa: Default::default(),
            info: Vec::new(),
        };
        let mut writer = ResultsWriter::create(&results, &header).unwrap();
        for (number, state) in states.iter().enumerate() {
            let displacements: Vec<[f64; 3]> = mesh.coordinates.iter().map(|&x| (state.displacement)(x)).collect();
            let nodal = [0, 1, 2].map(|axis| displacements.iter().map(|d| d[axis]).collect());
            let mut element = vec![state.stress.clone()];
            element.extend(state.death.clone());
            writer.write_state(0.25 * number as f64, &[], &nodal, &element).unwrap();
        }
        drop(writer);
        Run { folder, results }
    }

    fn picture(&self, options: &ViewOptions) -> Pixmap {
        let path = self.folder.path().join("picture.png");
        draw(&self.results, &path, options).unwrap();
        Pixmap::load_png(path).unwrap()
    }

    fn refusal(&self, options: &ViewOptions) -> ViewError {
        draw(&self.results, &self.folder.path().join("picture.png"), options).unwrap_err()
    }
}

fn plain(from: &str) -> ViewOptions {
    ViewOptions { from: from.parse().unwrap(), edges: false, ..ViewOptions::default() }
}

fn pixel(picture: &Pixmap, [x, y]: [f64; 2]) -> [u8; 3] {
    let pixel = picture.pixel(x as u32, y as u32).unwrap();
    [pixel.red(), pixel.green(), pixel.blue()]
}

/// The colour of the bar at its lower (0) to upper (1) end.
fn bar(picture: &Pixmap, fraction: f64) -> [u8; 3] {
    pixel(picture, [1047.0, 698.0 - 497.0 * fraction])
}

/// The pixel is the bar's colour at this fraction, but for one brightness that all channels have in common. The bar
/// cannot be read at its very ends, which costs a few steps of 255.
fn has_bar_colour(picture: &Pixmap, place: [f64; 2], fraction: f64) -> bool {
    let (seen, bar) = (pixel(picture, place), bar(picture, fraction));
    let sum = |colour: [u8; 3]| colour.iter().map(|&c| f64::from(c)).sum::<f64>();
    let brightness = sum(seen) / sum(bar);
    let close = (0..3).all(|i| (f64::from(seen[i]) - brightness * f64::from(bar[i])).abs() < 12.0);
    close && (0.85..=1.01).contains(&brightness)
}

/// First and last column, first and last row of the body, found in the part of the picture that only it can be in.
fn extent(picture: &Pixmap) -> [u32; 4] {
    let inked = |x: u32, y: u32| pixel(picture, [f64::from(x), f64::from(y)]) != WHITE;
    let columns: Vec<u32> = (100..1000).filter(|&x| inked(x, 484)).collect();
    let rows: Vec<u32> = (120..870).filter(|&y| inked(x_middle(), y)).collect();
    [columns[0], columns[columns.len() - 1], rows[0], rows[rows.len() - 1]]
}

fn x_middle() -> u32 {
    (130 + 985) / 2
}

#[test]
fn faces_are_where_the_projection_puts_them_in_the_colours_of_the_bar() {
    // Four by two cubes seen from the front: 855 pixels wide, so 213.75 to a cube, around row 484.
    let run = Run::new([4, 1, 2], &[State::of(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0])]);
    let picture = run.picture(&plain("front"));
    assert_eq!((picture.width(), picture.height()), (1200, 900));
    for corner in [[0.0, 0.0], [1199.0, 0.0], [0.0, 899.0], [1199.0, 899.0]] {
        assert_eq!(pixel(&picture, corner), WHITE);
    }
    for element in 0..8 {
        let (i, k) = (f64::from(element % 4), f64::from(element / 4));
        let place = [130.0 + 213.75 * (i + 0.5), 484.0 - 213.75 * (k - 0.5)];
        assert!(has_bar_colour(&picture, place, f64::from(element) / 7.0), "element {element}");
    }
    assert_eq!(extent(&picture), [130, 984, 270, 697]);
}

#[test]
fn what_is_behind_is_hidden() {
    let run = Run::new([1, 2, 1], &[State::of(&[10.0, 20.0])]);
    let middle = [557.0, 484.0];
    assert!(has_bar_colour(&run.picture(&plain("front")), middle, 0.0));
    assert!(has_bar_colour(&run.picture(&plain("back")), middle, 1.0));
    // From the right both are seen, the one at y = 0 on the left.
    let right = run.picture(&plain("right"));
    assert!(has_bar_colour(&right, [343.0, 484.0], 0.0) && has_bar_colour(&right, [771.0, 484.0], 1.0));
}

#[test]
fn a_mirrored_half_makes_a_symmetric_whole() {
    let run = Run::new([2, 1, 2], &[State::of(&[1.0, 2.0, 3.0, 4.0])]);
    let picture = run.picture(&ViewOptions { mirror: [Some(0.0), None, None], edges: true, ..plain("front") });
    assert_eq!(extent(&picture), [130, 984, 270, 697]);
    let worst = (260..710).flat_map(|y| (120..557).map(move |x| (f64::from(x), f64::from(y)))).map(|(x, y)| {
        let (left, right) = (pixel(&picture, [x, y]), pixel(&picture, [1114.0 - x, y]));
        (0..3).map(|i| left[i].abs_diff(right[i])).max().unwrap()
    });
    // Rounding decides for single samples on the border of two faces.
    assert!(worst.max().unwrap() <= 40);
    assert!(has_bar_colour(&picture, [450.0, 590.0], 0.0) && has_bar_colour(&picture, [200.0, 377.0], 1.0));
}

#[test]
fn a_cut_shows_the_section_of_what_is_kept() {
    let run = Run::new([1, 2, 1], &[State::of(&[10.0, 20.0])]);
    let middle = [557.0, 484.0];
    let shows = |from: &str, at: f64, fraction: f64| {
        let options = ViewOptions { cuts: vec![(1, at)], range: Some((10.0, 20.0)), ..plain(from) };
        has_bar_colour(&run.picture(&options), middle, fraction)
    };
    assert!(shows("front", 0.5, 0.0) && shows("front", 1.0, 1.0) && shows("back", 0.5, 0.0));
    let gone = run.refusal(&ViewOptions { cuts: vec![(1, 9.0)], ..plain("front") });
    assert!(gone.to_string().contains("cut has taken off all"), "{gone}");
}

#[test]
fn a_section_has_the_values_between_the_nodes() {
    let run = Run::new([1, 2, 1], &[State { displacement: |x| [0.0, x[1], 0.0], ..State::of(&[0.0; 2]) }]);
    let options = ViewOptions {
        variable: Some("DISPLY".to_owned()),
        magnify: 0.0,
        cuts: vec![(1, 0.5)],
        range: Some((0.0, 2.0)),
        ..plain("front")
    };
    assert!(has_bar_colour(&run.picture(&options), [557.0, 484.0], 0.25));
}

/// The image of a mirrored body is cut where the plane goes through the image.
#[test]
fn mirrored_bodies_are_cut_as_wholes() {
    let run = Run::new([1, 2, 1], &[State::of(&[10.0, 20.0])]);
    for (at, fraction) in [(-1.5, 1.0), (-0.5, 0.0), (0.0, 0.0), (1.0, 1.0)] {
        let mirror = [None, Some(0.0), None];
        let options = ViewOptions { cuts: vec![(1, at)], mirror, range: Some((10.0, 20.0)), ..plain("front") };
        assert!(has_bar_colour(&run.picture(&options), [557.0, 484.0], fraction), "cut at {at}");
    }
}

#[test]
fn a_mirror_stands_where_it_is_put() {
    // A cube from 0 to 1 and its image from 5 to 6: 142.5 pixels to a length.
    let run = Run::new([1, 1, 1], &[State::of(&[1.0])]);
    let picture = run.picture(&ViewOptions { mirror: [Some(3.0), None, None], ..plain("front") });
    let inked = |x: f64| pixel(&picture, [x, 484.0]) != WHITE;
    assert!(inked(200.0) && inked(914.0) && !inked(557.0) && !inked(280.0) && !inked(835.0));
}

#[test]
fn values_of_both_signs_are_white_at_zero() {
    let run = Run::new([2, 1, 1], &[State::of(&[-4.0, 2.0])]);
    let picture = run.picture(&plain("front"));
    assert!(bar(&picture, 0.5).iter().all(|&c| c > 225), "{:?}", bar(&picture, 0.5));
    // The range is as wide on either side: 2 is at three quarters.
    assert!(has_bar_colour(&picture, [343.0, 484.0], 0.0) && has_bar_colour(&picture, [771.0, 484.0], 0.75));
    let rising = run.picture(&ViewOptions { map: MapChoice::Sequential, ..plain("front") });
    assert!(has_bar_colour(&rising, [771.0, 484.0], 1.0));
}

#[test]
fn states_stand_in_a_row_and_arrows_on_the_surface() {
    // Taller than wide, so that they stand side by side.
    let states = [0.0, 1.0, 2.0]
        .map(|stress| State { displacement: |x| [0.1 * x[2], 0.0, 0.0], ..State::of(&[stress, stress, 3.0]) });
    let run = Run::new([1, 1, 3], &states);
    let path = run.folder.path().join("row.png");
    let choices = [StateChoice::Number(1), StateChoice::Mesh, StateChoice::Last];
    let options = ViewOptions { size: (600, 450), ..plain("front") };
    let shown = draw_row(&run.results, &path, &choices, &options).unwrap();
    assert_eq!(shown.iter().map(|summary| summary.state).collect::<Vec<_>>(), [Some(1), None, Some(3)]);
    let picture = Pixmap::load_png(&path).unwrap();
    // Three bodies, with white between them.
    let inked: Vec<bool> = (66..490).map(|x| pixel(&picture, [f64::from(x), 235.0]) != WHITE).collect();
    assert_eq!(inked.chunk_by(|a, b| a == b).filter(|run| run[0]).count(), 3);
    let plain = ViewOptions { variable: Some("VONMISES".to_owned()), ..options };
    let dark = |options: &ViewOptions| {
        let picture = run.picture(options);
        picture.pixels().iter().filter(|p| p.red() < 40 && p.green() < 40 && p.blue() < 40).count()
    };
    let arrows = ViewOptions { arrows: Some("DISPL".to_owned()), ..plain.clone() };
    let (with, without) = (dark(&arrows), dark(&plain));
    assert!(with > without + 15, "{with} {without}");
    let none = run.refusal(&ViewOptions { arrows: Some("VEL".to_owned()), ..plain });
    assert!(none.to_string().contains("DISPL"), "{none}");
}

#[test]
fn displacements_move_the_surface_as_often_as_asked() {
    let stretched = State { displacement: |x| [0.0, 0.0, x[2]], ..State::of(&[0.0; 4]) };
    let run = Run::new([4, 1, 1], &[stretched]);
    let shown = |magnify: f64| extent(&run.picture(&ViewOptions { magnify, ..plain("front") }));
    // Four wide, and 1, 2, 4 high: 213.75 pixels to a length until the height of 712 is tighter.
    assert_eq!(shown(0.0), [130, 984, 377, 590]);
    assert_eq!(shown(1.0), [130, 984, 270, 697]);
    assert_eq!(shown(3.0), [201, 913, 128, 839]);
}

#[test]
fn dead_elements_are_gone() {
    let dead = State { death: Some(vec![0.0, 1.0, 0.0]), ..State::of(&[1.0, 2.0, 3.0]) };
    let run = Run::new([3, 1, 1], &[dead]);
    let picture = run.picture(&plain("front"));
    assert_eq!(pixel(&picture, [557.0, 484.0]), WHITE);
    assert!(has_bar_colour(&picture, [272.0, 484.0], 0.0) && has_bar_colour(&picture, [842.0, 484.0], 1.0));
}

#[test]
fn elements_that_flew_to_nowhere_are_left_out_and_counted() {
    let wrecked =
        State { displacement: |x| [0.0, if x[0] > 2.5 { f64::NAN } else { 0.0 }, 0.0], ..State::of(&[1.0; 3]) };
    let run = Run::new([3, 1, 1], &[wrecked]);
    let summary = draw(&run.results, &run.folder.path().join("wreck.png"), &plain("front")).unwrap();
    assert_eq!((summary.faces, summary.dropped), (9, 5));
}

#[test]
fn blocks_states_and_ranges_are_chosen() {
    let run = Run::new([2, 1, 2], &[State::of(&[1.0, 2.0, 3.0, 4.0]), State::of(&[5.0, 6.0, 7.0, 8.0])]);
    let path = run.folder.path().join("choice.png");
    let drawn = |options: &ViewOptions| draw(&run.results, &path, options).unwrap();
    let upper = ViewOptions { blocks: vec![2], ..plain("iso") };
    let hidden = ViewOptions { hide: vec![1], ..plain("iso") };
    assert_eq!(drawn(&hidden).faces, drawn(&upper).faces);
    assert_eq!((drawn(&upper).extremes, drawn(&upper).faces), (Some((7.0, 8.0)), 10));
    let first = ViewOptions { state: StateChoice::Number(1), ..upper.clone() };
    assert_eq!(drawn(&first).extremes, Some((3.0, 4.0)));
    let nearest = drawn(&ViewOptions { state: StateChoice::Nearest(0.2), ..plain("iso") });
    assert_eq!((nearest.state, nearest.time), (Some(2), Some(0.25)));
    let displacement = drawn(&ViewOptions { variable: Some("displ".to_owned()), ..plain("iso") });
    assert_eq!((displacement.variable.as_deref(), displacement.extremes), (Some("|DISPL|"), Some((0.0, 0.0))));
    let ranged = run.picture(&ViewOptions { range: Some((0.0, 10.0)), ..plain("front") });
    assert!(has_bar_colour(&ranged, [343.0, 590.0], 0.5));
}

#[test]
fn a_box_and_conditions_leave_the_rest_away() {
    let infinite = f64::INFINITY;
    let stress = [10.0, 20.0, 30.0, 40.0, 50.0, 60.0];
    let moved = State { displacement: |x| [0.0, 0.0, 10.0 * x[0].min(1.0)], ..State::of(&[1.0; 6]) };
    let run = Run::new([3, 1, 2], &[State::of(&stress), moved]);
    let path = run.folder.path().join("part.png");
    let first = ViewOptions { state: StateChoice::Number(1), ..plain("left") };
    let drawn = |options: &ViewOptions| draw(&run.results, &path, options).unwrap();
    // The two cubes in the middle, with faces that the body did not show, in the colours of their elements.
    let column = ViewOptions { region: [Some((1.0, 2.0)), None, None], ..first.clone() };
    assert_eq!((drawn(&column).faces, drawn(&column).extremes), (10, Some((20.0, 50.0))));
    let seen = run.picture(&ViewOptions { range: Some((10.0, 60.0)), ..column.clone() });
    assert!(has_bar_colour(&seen, [557.0, 660.0], 0.2) && has_bar_colour(&seen, [557.0, 310.0], 0.8));
    let one = ViewOptions { region: [Some((1.0, 2.0)), None, Some((1.0, infinite))], ..first.clone() };
    assert_eq!((drawn(&one).faces, drawn(&one).extremes), (6, Some((50.0, 50.0))));
    // Where the body is now decides: its right parts have gone up by ten.
    let now = ViewOptions { state: StateChoice::Number(2), ..one.clone() };
    assert_eq!(drawn(&now).faces, 10);
    // Four cubes in the shape of an L, and those of its foot that are in a box too.
    let strong = ViewOptions { criteria: vec![("vonmises".to_owned(), (25.0, infinite))], ..first.clone() };
    assert_eq!((drawn(&strong).faces, drawn(&strong).extremes), (18, Some((30.0, 60.0))));
    let both = ViewOptions { region: [None, None, Some((-infinite, 1.0))], ..strong.clone() };
    assert_eq!((drawn(&both).faces, drawn(&both).extremes), (6, Some((30.0, 30.0))));
    // Of nodes the mean of the corners counts: the cubes on the left have gone by half of ten.
    let gone = ViewOptions { criteria: vec![("DISPLZ".to_owned(), (4.0, 6.0))], ..plain("left") };
    assert_eq!(drawn(&gone).faces, 10);
    // Nothing in one state is no mistake in a film; nothing at all is one.
    let every = NonZeroUsize::MIN;
    let frames = draw_many(&run.results, &run.folder.path().join("film.png"), every, &strong).unwrap();
    assert_eq!(frames.iter().map(|frame| frame.faces).collect::<Vec<_>>(), [18, 0]);
    let [some, none] = [0, 1].map(|i| pixel(&Pixmap::load_png(&frames[i].path).unwrap(), [557.0, 310.0]));
    assert!(some != WHITE && none == WHITE);
    let said = |options: &ViewOptions| run.refusal(options).to_string();
    let nowhere = ViewOptions { region: [None, Some((7.0, 8.0)), None], ..first.clone() };
    assert!(said(&nowhere).contains("no element is in the region"), "{}", said(&nowhere));
    let unknown = ViewOptions { criteria: vec![("VONMISSES".to_owned(), (0.0, 1.0))], ..first };
    assert!(said(&unknown).contains("did you mean VONMISES?"));
    let mesh = ViewOptions { state: StateChoice::Mesh, ..strong };
    assert!(said(&mesh).contains("a mesh has no values"), "{}", said(&mesh));
}

#[test]
fn a_mesh_without_states_is_drawn_by_itself() {
    let folder = TempDir::new().unwrap();
    let (mesh, picture) = (folder.path().join("boxes.g"), folder.path().join("boxes.png"));
    write_mesh(&mesh, &boxes([2, 2, 2])).unwrap();
    let first = ViewOptions { state: StateChoice::Number(1), ..plain("iso") };
    assert!(matches!(draw(&mesh, &picture, &first), Err(ViewError::NoStates { .. })));
    let asked = ViewOptions { state: StateChoice::Mesh, ..plain("iso") };
    assert_eq!(draw(&mesh, &picture, &asked).unwrap(), draw(&mesh, &picture, &plain("iso")).unwrap());
    let summary = draw(&mesh, &picture, &asked).unwrap();
    assert_eq!((summary.faces, summary.variable, summary.state), (24, None, None));
}

#[test]
fn a_film_has_one_camera_and_one_meaning_of_its_colours() {
    let stretched = State { displacement: |x| [x[0], 0.0, 0.0], ..State::of(&[0.0, 4.0]) };
    let run = Run::new([2, 1, 1], &[State::of(&[0.0, 2.0]), State::of(&[0.0, 3.0]), stretched]);
    let every = |n: usize| NonZeroUsize::new(n).unwrap();
    let frames = draw_many(&run.results, &run.folder.path().join("film.png"), every(2), &plain("front")).unwrap();
    let names: Vec<_> = frames.iter().map(|frame| frame.path.file_name().unwrap().to_str().unwrap()).collect();
    assert_eq!(names, ["film_0001.png", "film_0003.png"]);
    // At the end the body is 4 long, at the start it fills the left half of the same frame.
    let [first, last] = [0, 1].map(|i| Pixmap::load_png(&frames[i].path).unwrap());
    assert!(has_bar_colour(&first, [450.0, 484.0], 0.5) && has_bar_colour(&last, [771.0, 484.0], 1.0));
    assert_eq!(pixel(&first, [771.0, 484.0]), WHITE);
    let film = run.folder.path().join("film.gif");
    draw_many(&run.results, &film, every(1), &plain("front")).unwrap();
    let mut decoder = gif::DecodeOptions::new().read_info(File::open(film).unwrap()).unwrap();
    let mut count = 0;
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        assert_eq!((frame.width, frame.height, frame.delay), (1200, 900, 10));
        count += 1;
    }
    assert_eq!(count, 3);
}

#[test]
fn the_smallest_picture_and_the_emptiest_field_are_drawn() {
    let run = Run::new([1, 1, 1], &[State::of(&[f64::NAN])]);
    let picture = run.picture(&ViewOptions { size: (200, 150), ..plain("-30,10") });
    assert_eq!((picture.width(), picture.height()), (200, 150));
    assert_ne!(pixel(&picture, [92.0, 80.0]), WHITE);
}

#[test]
fn mistakes_are_answered_with_what_there_is() {
    let run = Run::new([1, 1, 1], &[State::of(&[1.0])]);
    let said =
        |options: &ViewOptions| run.refusal(options).to_string().replace(&run.results.display().to_string(), "run.e");
    assert_eq!(
        said(&ViewOptions { variable: Some("VONMISSES".to_owned()), ..plain("iso") }),
        "run.e: there is no variable VONMISSES (did you mean VONMISES?); \
         the file has: DISPL, DISPLX, DISPLY, DISPLZ, VONMISES"
    );
    assert_eq!(
        said(&ViewOptions { state: StateChoice::Number(7), ..plain("iso") }),
        "run.e: there is no state 7; the file has states 1 to 1"
    );
    assert_eq!(
        said(&ViewOptions { blocks: vec![1, 3], ..plain("iso") }),
        "run.e: there is no block 3; the file has: 1"
    );
    assert_eq!(
        said(&ViewOptions { range: Some((2.0, 1.0)), ..plain("iso") }),
        "range is 2,1; expected two finite numbers, the smaller one first"
    );
    assert_eq!(
        said(&ViewOptions { size: (0, 900), ..plain("iso") }),
        "size is 0x900; expected 200x150 to 16384x16384 pixels"
    );
    let missing = draw(Path::new("nowhere.e"), Path::new("nowhere.png"), &plain("iso"));
    assert!(matches!(missing, Err(ViewError::Results(_))), "{missing:?}");
    let nowhere = draw(&run.results, &run.folder.path().join("no/folder/picture.png"), &plain("iso"));
    assert!(matches!(nowhere, Err(ViewError::Write { .. })), "{nowhere:?}");
}
