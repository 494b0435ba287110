//! The program: parse, run one mode, print the error once, set the exit code.

use std::io::IsTerminal as _;
use std::io::Write as _;
use std::panic::{self, AssertUnwindSafe};
use std::process::ExitCode;
use std::sync::Mutex;

use rilievo::cli::{self, Command, Refusal, Verbosity};
use rilievo::modes::{self, ModeError};
use rilievo::{interruption, io, io::scene_file};

/// The arguments alone were refused.
const REFUSED: u8 = 2;
/// There is no usable adapter.
const NO_ADAPTER: u8 = 3;
/// Content or surroundings were at fault.
const FAILED: u8 = 1;

fn main() -> ExitCode {
    silence_device_selection();
    let command = match cli::parse(std::env::args_os()) {
        Ok(command) => command,
        Err(Refusal::Told(text)) => return exit(io::print(&text).map_err(anyhow::Error::from)),
        Err(Refusal::Refused(sentence)) => return say(&sentence, REFUSED),
    };
    start_log(command.verbosity());
    keep_panics_quiet();
    if let Err(error) = interruption::listen() {
        log::warn!("Ctrl-C will end this run at once, without putting anything in order: {error}");
    }
    // Unwinding, not aborting, removes what was half written.
    match panic::catch_unwind(AssertUnwindSafe(|| run(&command))) {
        Ok(outcome) => exit(outcome),
        Err(_) => say(&defect(), FAILED),
    }
}

/// Mesa's device selection asks a Wayland compositor which GPU is its own, and where there is none it complains on stderr, as if
/// this program had failed. It only reorders the adapters, and this program chooses by its own order.
#[expect(unsafe_code, reason = "Mesa reads its switch from the environment alone")]
fn silence_device_selection() {
    if std::env::var_os("XDG_RUNTIME_DIR").is_none_or(|path| path.is_empty()) {
        // SAFETY: this is the first thing that the program does: no other thread exists that could read the environment.
        unsafe { std::env::set_var("NODEVICE_SELECT", "1") };
    }
}

/// Runs one mode.
fn run(command: &Command) -> anyhow::Result<()> {
    match command {
        Command::Live(options) => modes::live::run(options)?,
        Command::Capture(options) => modes::capture::run(options, command.verbosity())?,
        Command::Stress(options) => io::print(&modes::stress::run(options, command.verbosity())?)?,
        Command::Compare(options) => io::print(&modes::compare::run(options, command.verbosity())?)?,
        Command::Adapters(options) => io::print(&modes::adapters::list(&options.machine.preference())?)?,
        Command::Scenes => io::print(&scenes())?,
    }
    Ok(())
}

/// Every scene with its description, a line each.
fn scenes() -> String {
    scene_file::list().into_iter().map(|(name, description)| format!("{name:<12} {description}\n")).collect()
}

/// Prints the error, if there is one, and chooses the exit code.
fn exit(outcome: anyhow::Result<()>) -> ExitCode {
    let Err(error) = outcome else { return ExitCode::SUCCESS };
    let code = match error.downcast_ref() {
        Some(ModeError::Adapter(_)) => NO_ADAPTER,
        Some(ModeError::Interrupted { .. }) => interruption::exit_code(),
        _ => FAILED,
    };
    say(&format!("{error:#}"), code)
}

/// Prints one sentence to stderr.
fn say(sentence: &str, code: u8) -> ExitCode {
    // Words of drivers and decoders may span lines. And where stderr itself is closed nobody can be told.
    let sentence = sentence.split_whitespace().collect::<Vec<_>>().join(" ");
    let _ = writeln!(std::io::stderr(), "error: {sentence}");
    ExitCode::from(code)
}

/// Notes for those who watch, warnings always; `RUST_LOG` chooses freely.
fn start_log(verbosity: Verbosity) {
    if std::env::var_os("RUST_LOG").is_some() {
        env_logger::init();
        return;
    }
    let filters = match verbosity {
        Verbosity::Quiet => "rilievo=error",
        Verbosity::Normal if std::io::stderr().is_terminal() => "rilievo=info",
        Verbosity::Normal => "rilievo=warn",
        Verbosity::Verbose => "warn,rilievo=debug",
    };
    let mut builder = env_logger::Builder::new();
    builder.parse_filters(filters).format(|line, record| match record.level() {
        log::Level::Info => writeln!(line, "{}", record.args()),
        level => writeln!(line, "{}: {}", level.as_str().to_lowercase(), record.args()),
    });
    builder.init();
}

/// The last panic: what was said, and where.
static PANIC: Mutex<String> = Mutex::new(String::new());

/// A panic is a defect of this program: it is told as the sentence of an error, and with its backtrace only to who asks.
fn keep_panics_quiet() {
    let default_hook = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        if std::env::var_os("RUST_BACKTRACE").is_some() {
            default_hook(info);
        }
        let what = info.payload_as_str().unwrap_or("no reason given");
        let place = info.location().map(|place| format!(" at {place}")).unwrap_or_default();
        if let Ok(mut last) = PANIC.lock() {
            *last = format!("{what}{place}");
        }
    }));
}

/// The sentence for the last panic.
fn defect() -> String {
    let what = PANIC.lock().map(|last| last.clone()).unwrap_or_default();
    format!("rilievo came upon a defect of its own ({what}): run it again with RUST_BACKTRACE=1 and report what it says")
}
