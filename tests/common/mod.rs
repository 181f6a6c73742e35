//! Running the built binary.

use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};

/// The program under test and the arguments that it takes: a package above `lobefit` has a binary
/// for one verb, which takes what follows the verb.
fn program<'a>(arguments: &'a [&'a str]) -> (&'static str, &'a [&'a str]) {
    let verb = [
        option_env!("CARGO_BIN_EXE_lobefit-audit"),
        option_env!("CARGO_BIN_EXE_lobefit-formula"),
        option_env!("CARGO_BIN_EXE_lobefit-gpu"),
        option_env!("CARGO_BIN_EXE_lobefit-studies"),
    ];
    match (option_env!("CARGO_BIN_EXE_lobefit"), verb.into_iter().flatten().next()) {
        (Some(program), _) => (program, arguments),
        (None, Some(program)) => (program, &arguments[1..]),
        (None, None) => panic!("a package without a program"),
    }
}

/// Runs the program in a folder, with bytes on its standard input, and with the cache of all tests: it
/// names a result by the code that computes it and by all its inputs.
#[allow(dead_code, reason = "some tests name a cache")]
pub fn lobefit(folder: &Path, arguments: &[&str], input: &[u8]) -> Output {
    lobefit_with(&Path::new(env!("CARGO_TARGET_TMPDIR")).join("cache"), folder, arguments, input)
}

/// The same with this cache.
pub fn lobefit_with(cache: &Path, folder: &Path, arguments: &[&str], input: &[u8]) -> Output {
    let mut child = start(cache, folder, arguments);
    // A program that ends before it has read everything closes the pipe: no failure of the test.
    let _ = child.stdin.take().expect("piped").write_all(input);
    child.wait_with_output().expect("the binary ends")
}

/// Starts the program.
pub fn start(cache: &Path, folder: &Path, arguments: &[&str]) -> Child {
    let (program, arguments) = program(arguments);
    let mut command = Command::new(program);
    command.env("LOBEFIT_CACHE", cache).args(arguments).current_dir(folder);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().expect("the binary runs")
}

/// Seconds of a processor, twice what is promised for those that share one, and KiB of addresses: the program
/// itself and the stacks of its threads take 32 MiB.
const LIMITS: &str = "ulimit -t 4 && ulimit -v 294912 && exec \"$@\"";

/// Runs the program on a file that is made to hurt: within 2 s of a processor and 288 MiB of addresses.
#[allow(dead_code, reason = "few tests limit the program")]
pub fn limited(folder: &Path, arguments: &[&str]) -> Output {
    let (program, arguments) = program(arguments);
    let mut command = Command::new("sh");
    command.args(["-c", LIMITS, "sh", program]).args(arguments).current_dir(folder);
    // An arena of the allocator takes 64 MiB of addresses, whatever is in it.
    command
        .env("LOBEFIT_CACHE", folder.join("cache"))
        .env("MALLOC_ARENA_MAX", "1")
        .env("RAYON_NUM_THREADS", "2");
    command.stdin(Stdio::null()).stdout(Stdio::null()).output().expect("a shell")
}

/// Names in a folder, sorted.
#[allow(dead_code, reason = "not every test looks at a folder")]
pub fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .expect("the folder is there")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// Every file below a folder with its bytes.
#[allow(dead_code, reason = "not every test compares folders")]
pub fn bytes(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    for name in names(folder) {
        let path = folder.join(&name);
        match path.is_dir() {
            true => files
                .extend(bytes(&path).into_iter().map(|(below, bytes)| (format!("{name}/{below}"), bytes))),
            false => files.push((name, std::fs::read(path).expect("a file"))),
        }
    }
    files
}

/// Standard error as text, without the lines that name stages: `[3/14] fits of sheen`.
pub fn stderr(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stderr);
    let stage = |line: &&str| line.starts_with('[') && line.contains("] ");
    text.split_inclusive('\n').filter(|line| !stage(line)).collect()
}

/// Sends a signal by its name to a program that has not ended.
#[allow(dead_code, reason = "some tests stop or break off a program at work")]
pub fn signal(child: &Child, name: &str) {
    let sent = Command::new("sh").arg("-c").arg(format!("kill -{name} {}", child.id())).status();
    assert!(sent.expect("a shell").success());
}

/// Waits until a program that was started announces its first stage: it is at work, and has written
/// nothing.
#[allow(dead_code, reason = "some tests change what lies around a program at work")]
pub fn first_stage(child: &mut Child) {
    let mut first = String::new();
    let said = child.stderr.as_mut().expect("piped");
    while !first.ends_with('\n') {
        let mut byte = [0];
        said.read_exact(&mut byte).expect("a line");
        first.push(char::from(byte[0]));
    }
    assert!(first.starts_with("[1/"), "{first}");
}
