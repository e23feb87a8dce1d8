//! Does Ctrl-C end long work at once, with a sentence and without half a result?
#![cfg(unix)]

use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Starts long work, presses Ctrl-C once it is under way, and gives what it left: exit code, output, complaint, seconds.
fn stopped(arguments: &[&str]) -> (Option<i32>, String, String, Duration) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewise"));
    let child = command.args(arguments).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
    let child = child.unwrap();
    sleep(Duration::from_millis(1500));
    let start = Instant::now();
    let interrupt = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(interrupt.success(), "the work ended before it could be stopped");
    let output = child.wait_with_output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr), start.elapsed())
}

#[test]
fn fits_and_studies_stop_at_their_next_step() {
    let folder = tempfile::tempdir().unwrap();
    let plot = folder.path().join("table.svg");
    let plot = plot.to_str().unwrap();
    let studies: [&[&str]; 4] = [
        &["fit", "--all", "--method", "black-box"],
        &["study", "accuracy", "--searches", "--plot", plot],
        &["study", "accuracy", "--evidence"],
        &["study", "speed"],
    ];
    for arguments in studies {
        let (code, printed, said, seconds) = stopped(arguments);
        assert_eq!((code, printed.as_str()), (Some(130), ""), "{arguments:?}: {said}");
        assert!(said.contains("edgewise: stopped"), "{arguments:?}: {said}");
        // Another program may have the processor; the whole work takes minutes here.
        assert!(seconds < Duration::from_secs(20), "{arguments:?}: {seconds:?}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "nothing is half written");
}
