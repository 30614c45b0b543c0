//! The program as its users see it: runs the binary in a folder of its own, on small decks and meshes.
#![allow(dead_code)] // Each test file uses its own part.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};
use urto::exodus::{self, Results};
use urto::mesh::{Block, Mesh, NodeSet, SideSet};

/// The program under test.
pub const URTO: &str = env!("CARGO_BIN_EXE_urto");

/// A folder for one test; it goes when the test ends.
pub struct Desk {
    folder: tempfile::TempDir,
}

/// How the program left.
#[derive(Debug)]
pub struct Left {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

impl Desk {
    pub fn new() -> Desk {
        Desk { folder: tempfile::tempdir().expect("a temporary folder") }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn has(&self, name: &str) -> bool {
        self.path(name).exists()
    }

    /// Writes a file, with its folders.
    pub fn put(&self, name: &str, text: &str) {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
        std::fs::write(path, text).expect("a file");
    }

    pub fn text(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    pub fn put_mesh(&self, name: &str, mesh: &Mesh) {
        exodus::write_mesh(&self.path(name), mesh).expect("a mesh file");
    }

    pub fn results(&self, name: &str) -> Results {
        Results::open(&self.path(name)).expect("readable results")
    }

    /// The program with these arguments, to be run in this folder, free of any launcher's environment.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(URTO);
        command.args(arguments).current_dir(self.folder.path()).stdin(Stdio::null());
        command.env_remove("URTO_SIMD");
        command
    }

    pub fn urto(&self, arguments: &[&str]) -> Left {
        Left::of(self.command(arguments).output().expect("the program starts"))
    }

    /// Starts the program and leaves it to run.
    pub fn start(&self, arguments: &[&str]) -> Child {
        self.command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts")
    }
}

impl Left {
    pub fn of(output: Output) -> Left {
        Left {
            code: output.status.code(),
            out: String::from_utf8_lossy(&output.stdout).into_owned(),
            err: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }

    /// Asserts the exit code; shows everything when it is another.
    pub fn with(self, code: i32) -> Left {
        assert_eq!(self.code, Some(code), "\nstdout:\n{}\nstderr:\n{}", self.out, self.err);
        self
    }

    pub fn says(&self, words: &[&str]) {
        let all = format!("{}\n{}", self.out, self.err);
        for word in words {
            assert!(all.contains(word), "{word:?} is not in\n{all}");
        }
    }
}

/// Waits until `done` or for a minute; says whether it came true.
pub fn wait_for(mut done: impl FnMut() -> bool) -> bool {
    let begun = Instant::now();
    while !done() {
        if begun.elapsed() > Duration::from_secs(60) {
            return false;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    true
}

/// A box of `n` hexahedra along each axis, `size` large, with a corner at the origin; in two blocks 1 and 2, lower and
/// upper half, when there are two layers at least. Node sets: 1 the plane x = 0, 2 the plane y = 0, 3 the bottom, 4 the
/// top, 5 the edge x, y at their largest. Side sets: 100 the bottom, 200 the top, 300 the face where x is largest.
pub fn box_mesh(n: [usize; 3], size: [f64; 3], two_blocks: bool) -> Mesh {
    let node = |i: usize, j: usize, k: usize| (i + (n[0] + 1) * (j + (n[1] + 1) * k)) as u32;
    let grid = |top: [usize; 3]| {
        let rows = (0..top[2]).flat_map(move |k| (0..top[1]).map(move |j| (j, k)));
        rows.flat_map(move |(j, k)| (0..top[0]).map(move |i| [i, j, k]))
    };
    let nodes: Vec<[usize; 3]> = grid([n[0] + 1, n[1] + 1, n[2] + 1]).collect();
    let cells: Vec<[usize; 3]> = grid(n).collect();
    let hex = |&[i, j, k]: &[usize; 3]| {
        let ring = |k| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
        let (low, high) = (ring(k), ring(k + 1));
        [low[0], low[1], low[2], low[3], high[0], high[1], high[2], high[3]]
    };
    let split = if two_blocks { cells.len() / n[2] * (n[2] / 2) } else { cells.len() };
    let block = |id, cells: &[[usize; 3]]| Block::hexahedra_of(id, cells.iter().map(hex));
    let mut blocks = vec![block(1, &cells[..split])];
    if two_blocks {
        blocks.push(block(2, &cells[split..]));
    }
    let nodes_where = |id, test: &dyn Fn(&[usize; 3]) -> bool| {
        let chosen = (0..nodes.len() as u32).filter(|&i| test(&nodes[i as usize]));
        NodeSet { id, nodes: chosen.collect(), ..NodeSet::default() }
    };
    let sides_where = |id, side, test: &dyn Fn(&[usize; 3]) -> bool| {
        let chosen = (0..cells.len()).filter(|&e| test(&cells[e])).map(|e| (e as u32, side));
        SideSet { id, sides: chosen.collect(), ..SideSet::default() }
    };
    Mesh {
        title: "box".into(),
        coordinates: nodes.iter().map(|g| [0, 1, 2].map(|i| size[i] * g[i] as f64 / n[i] as f64)).collect(),
        node_ids: (1..=nodes.len() as i64).collect(),
        element_ids: (1..=cells.len() as i64).collect(),
        node_sets: vec![
            nodes_where(1, &|g| g[0] == 0),
            nodes_where(2, &|g| g[1] == 0),
            nodes_where(3, &|g| g[2] == 0),
            nodes_where(4, &|g| g[2] == n[2]),
            nodes_where(5, &|g| g[0] == n[0] && g[1] == n[1]),
        ],
        side_sets: vec![
            sides_where(100, 4, &|c| c[2] == 0),
            sides_where(200, 5, &|c| c[2] == n[2] - 1),
            sides_where(300, 1, &|c| c[0] == n[0] - 1),
        ],
        blocks,
        ..Mesh::default()
    }
}

/// The bar of `decks/commands.i`.
pub fn commands_mesh() -> Mesh {
    box_mesh([2, 2, 8], [0.01, 0.01, 0.04], true)
}

/// A file of this project.
pub fn project(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// A deck and mesh `bar.i`, `bar.g` of an elastic bar that flies, 0.01 x 0.01 x 0.04, running to `end`; `more` are
/// further commands.
pub fn put_bar(desk: &Desk, end: f64, more: &str) {
    desk.put_mesh("bar.g", &box_mesh([2, 2, 8], [0.01, 0.01, 0.04], false));
    desk.put("bar.i", &bar_deck(end, more));
}

/// See [`put_bar`].
pub fn bar_deck(end: f64, more: &str) -> String {
    format!(
        "TITLE\n A bar\nTERMINATION TIME, {end:e}\nMATERIAL, 1, ELASTIC, 2700.\nYOUNGS MODULUS = 70.E9\n\
         POISSONS RATIO = 0.33\nEND\nINITIAL VELOCITY MATERIAL, 1, 0., 0., -10.\n{more}EXIT\n"
    )
}

/// The launcher of so many MPI processes, when this build and this machine can.
pub fn mpiexec(ranks: usize) -> Option<Command> {
    if !cfg!(feature = "mpi") || Command::new("mpiexec").arg("--version").output().is_err() {
        return None;
    }
    let mut command = Command::new("mpiexec");
    command.args(["-n", &ranks.to_string()]);
    // Open MPI refuses root and more ranks than cores otherwise; other libraries ignore these.
    for permission in ["OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_rmaps_base_oversubscribe"]
    {
        command.env(permission, "1");
    }
    command.env("PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe");
    Some(command)
}
