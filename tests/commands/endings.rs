//! How runs end before their time: by what goes wrong in them, by signals, by what can no longer be written.

use crate::program::{Desk, Left, put_bar, wait_for};
use std::process::{Child, Command, Stdio};

/// A time that the bar does not reach while we watch.
const NEVER: f64 = 1e3;

#[test]
fn an_inverted_element_ends_the_run_with_its_name_and_advice() {
    let desk = Desk::new();
    let crush = "NO DISPLACEMENT, Z, 3\nFUNCTION, 1\n0., 0.\n1.E-6, 1.\nEND\nPRESCRIBED DISPLACEMENT, Z, 4, 1, -0.03\n\
                 MATERIAL POINT, 0., 0., 0.04\n";
    put_bar(&desk, 1e-4, crush);
    let left = desk.urto(&["bar.i", "--quiet", "--ranks", "3"]).with(1);
    left.says(&["stopped at step", "time", "element ", "of block 1", "at (", "help: "]);
    assert_eq!(left.err.matches("error:").count(), 1, "{}", left.err);
    assert_eq!(left.out, "");
    let log = desk.text("bar.o");
    for words in ["***** ERROR: AT STEP", "of block 1", "advice: ", "W H E R E   T H E   T I M E"] {
        assert!(log.contains(words), "{words} is not in\n{log}");
    }
    last_state_is_that_of_the_log(&desk);
    assert_eq!(desk.results("bar.h").times().last(), desk.results("bar.e").times().last(), "histories end there too");
}

#[test]
fn an_unstable_run_is_stopped() {
    let desk = Desk::new();
    put_bar(&desk, 1e-2, "RIGID SURFACE, 100, 0., 0., 0., 0., 0., 1.\nTIME STEP SCALE, 1.8\n");
    let left = desk.urto(&["bar.i", "--quiet"]).with(1);
    left.says(&["stopped at step", "help: "]);
    last_state_is_that_of_the_log(&desk);
}

/// The plot file ends with the state in which the run stopped.
fn last_state_is_that_of_the_log(desk: &Desk) {
    let results = desk.results("bar.e");
    let steps = results.global_names().iter().position(|name| name == "NSTEPS").expect("NSTEPS");
    let globals = results.global(results.times().len() - 1).expect("globals");
    let step = format!("AT STEP {}, TIME", globals[steps]);
    assert!(desk.text("bar.o").contains(&step), "{step} is not in the log");
}

#[test]
fn signals_and_the_shutdown_file_end_a_run_in_good_order() {
    for (signal, code, words) in [
        ("INT", 130, "BY SIGINT"),
        ("TERM", 143, "BY SIGTERM"),
        ("HUP", 129, "BY SIGHUP"),
        ("USR1", 138, "BY SIGUSR1"),
        ("", 0, "BY THE SHUTDOWN FILE"),
    ] {
        // The program would rightly not hear it, see below, and the run would never end.
        if signal == "HUP" && hangups_are_ignored() {
            continue;
        }
        let desk = Desk::new();
        put_bar(&desk, NEVER, "PLOT TIME, 1.E2\n");
        desk.put("bar.shutdown", "left from before");
        let child = desk.start(&["bar.i", "--ranks", "2"]);
        assert!(wait_for(|| desk.has("bar.o") && desk.text("bar.o").contains("SECONDS PER")), "the run begins");
        std::thread::sleep(std::time::Duration::from_millis(50));
        match signal {
            "" => desk.put("bar.shutdown", ""),
            _ => send(signal, &child),
        }
        let left = Left::of(child.wait_with_output().expect("the program ends")).with(code);
        left.says(&["stopped on request", "2 plot states"]);
        assert!(desk.text("bar.o").contains(words));
        assert!(!desk.has("bar.shutdown"), "removed at the start, and once obeyed");
        last_state_is_that_of_the_log(&desk);
    }
}

/// Whether whoever runs these tests has them ignore the end of the terminal, which children inherit.
fn hangups_are_ignored() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:")).unwrap_or("0");
    u64::from_str_radix(mask.trim(), 16).is_ok_and(|mask| mask & 1 == 1)
}

/// `nohup` asks that the end of the terminal be ignored.
#[test]
fn the_end_of_the_terminal_is_ignored_where_nohup_asks_for_it() {
    let desk = Desk::new();
    put_bar(&desk, NEVER, "PLOT TIME, 1.E2\n");
    let mut command = Command::new("nohup");
    command.arg(env!("CARGO_BIN_EXE_urto")).args(["bar.i", "--ranks", "1"]).current_dir(desk.path("."));
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("nohup");
    assert!(wait_for(|| desk.has("bar.o") && desk.text("bar.o").contains("SECONDS PER")), "the run begins");
    send("HUP", &child);
    std::thread::sleep(std::time::Duration::from_millis(300));
    send("TERM", &child);
    let left = Left::of(child.wait_with_output().expect("the program ends")).with(143);
    left.says(&["stopped on request"]);
}

fn send(signal: &str, child: &Child) {
    let sent = Command::new("kill").args([format!("-{signal}"), child.id().to_string()]).status();
    assert!(sent.expect("kill").success());
}

#[test]
fn a_reader_that_leaves_early_is_no_trouble() {
    let desk = Desk::new();
    put_bar(&desk, 1e-4, "");
    for arguments in [&["explain"][..], &["bar.i"], &["check", "bar.i"], &["--help"], &["generate", "man"]] {
        let mut child = desk.start(arguments);
        drop(child.stdout.take());
        let left = Left::of(child.wait_with_output().expect("the program ends")).with(0);
        assert!(!left.err.contains("panicked"), "{}", left.err);
    }
    // With the standard error closed too.
    let mut child = desk.command(&["bar.i"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it starts");
    drop((child.stdout.take(), child.stderr.take()));
    assert_eq!(child.wait().expect("it ends").code(), Some(0));
}

#[test]
fn a_full_disk_ends_all_ranks_with_one_message() {
    let desk = Desk::new();
    put_bar(&desk, 1e-2, "PLOT TIME, 1.E-9\n");
    // A limit on the size of files stands for the full disk.
    let script = format!("ulimit -f 200; exec '{}' bar.i --quiet --ranks 3", crate::program::URTO);
    let output = Command::new("sh").args(["-c", &script]).current_dir(desk.path(".")).output().expect("sh");
    let left = Left::of(output).with(1);
    left.says(&["error: ", "bar.e"]);
    // Beside the warning about so many states.
    let errors: Vec<&str> = left.err.lines().filter(|line| line.contains("error")).collect();
    assert!(errors.len() == 1 && left.err.ends_with(&format!("{}\n", errors[0])), "{}", left.err);
    assert!(desk.results("bar.e").times().len() > 1, "what was written before can be read");
}
