//! Interruption: Ctrl-C, a request to end, or a terminal that closes ends a run between two frames, and what it has is left in order.
//!
//! The first signal is only noted; whoever makes frames asks for it before each. A second one ends the program at once, whatever it
//! does. A signal that was ignored when the program began stays ignored: so do `nohup`, and a script that starts it in the
//! background, protect it.

use std::ffi::c_int;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// The signals that ask for an end.
#[cfg(unix)]
const SIGNALS: [c_int; 3] = [SIGINT, SIGTERM, signal_hook::consts::SIGHUP];
/// The signals that ask for an end.
#[cfg(not(unix))]
const SIGNALS: [c_int; 2] = [SIGINT, SIGTERM];

/// How long after the first signal another one is the same request: `timeout` sends it to a program and then to its whole group, and
/// some that pass on a Ctrl-C do so to programs that the terminal has told already.
const SAME_REQUEST: Duration = Duration::from_millis(500);

/// How often a thread that waits for a signal looks. A handler can set a flag on every system, and wake a thread on few.
const LOOK_AGAIN: Duration = Duration::from_millis(50);

/// The last signal; 0: there was none.
static SIGNAL: AtomicUsize = AtomicUsize::new(0);

/// Whether the next signal ends the program at once.
static IMPATIENT: AtomicBool = AtomicBool::new(false);

/// Notes signals from now on, instead of ending the program at the first.
///
/// # Errors
///
/// The system refuses; then signals do what they did before.
pub fn listen() -> std::io::Result<()> {
    for signal in SIGNALS.into_iter().filter(|&signal| !is_ignored(signal)) {
        flag::register_conditional_shutdown(signal, c_int::from(exit_code_of(signal)), &IMPATIENT)?;
        flag::register_usize(signal, &SIGNAL, signal as usize)?;
    }
    std::thread::Builder::new().name("interruption".to_owned()).spawn(|| {
        wait();
        std::thread::sleep(SAME_REQUEST);
        IMPATIENT.store(true, Ordering::SeqCst);
    })?;
    Ok(())
}

/// Whether the run is to end.
pub fn is_asked() -> bool {
    SIGNAL.load(Ordering::SeqCst) != 0
}

/// Returns when the run is to end.
pub fn wait() {
    while !is_asked() {
        std::thread::sleep(LOOK_AGAIN);
    }
}

/// What a shell expects of a program that was interrupted: 128 and the signal's number.
pub fn exit_code() -> u8 {
    exit_code_of(SIGNAL.load(Ordering::SeqCst) as c_int)
}

fn exit_code_of(signal: c_int) -> u8 {
    // A signal's number has seven bits.
    128 | signal as u8
}

/// Whether a signal is ignored.
#[cfg(unix)]
#[expect(unsafe_code, reason = "the system's call is the only way to ask without changing anything")]
fn is_ignored(signal: c_int) -> bool {
    let mut action = std::mem::MaybeUninit::<libc::sigaction>::zeroed();
    // SAFETY: with no new action the call only writes the present one, to memory of its type; all zeros are a valid `sigaction` (no
    // handler, no flags), should it fail.
    let action = unsafe {
        libc::sigaction(signal, std::ptr::null(), action.as_mut_ptr());
        action.assume_init()
    };
    action.sa_sigaction == libc::SIG_IGN
}

/// Whether a signal is ignored: none is.
#[cfg(not(unix))]
fn is_ignored(_: c_int) -> bool {
    false
}
