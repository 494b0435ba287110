//! A desktop of one's own: Xvfb with a small window manager, and hands for it.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// How long anything may take: a frame takes tens of milliseconds on a software adapter, and a loaded machine is ten times slower.
pub const PATIENCE: Duration = Duration::from_secs(120);

/// What must be installed.
const TOOLS: [&str; 5] = ["Xvfb", "openbox", "xdotool", "wmctrl", "import"];

/// A running X server with a window manager.
pub struct Desktop {
    display: String,
    children: Vec<Child>,
    /// One at a time: what a loaded machine takes for a frame must stay within patience.
    _turn: MutexGuard<'static, ()>,
}

impl Desktop {
    /// Starts one. Without the tools a test fails in CI (where `CI` is set), and elsewhere says loudly that it skips.
    pub fn start() -> Option<Self> {
        static TURN: Mutex<()> = Mutex::new(());
        if let Some(missing) = TOOLS.iter().find(|tool| !is_installed(tool)) {
            assert!(std::env::var_os("CI").is_none(), "{missing} is missing: scripts/test installs it");
            eprintln!("SKIPPED, no window is tested: {missing} is missing");
            return None;
        }
        let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1024x768x24", "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb starts");
        let mut number = String::new();
        BufReader::new(server.stdout.take().expect("it was piped")).read_line(&mut number).expect("Xvfb tells its display");
        let mut desktop = Self { display: format!(":{}", number.trim()), children: vec![server], _turn: turn };
        // Openbox loses windows that appear while it starts: it says itself when it has.
        let folder = tempfile::tempdir().expect("a temporary folder");
        let started = folder.path().join("started");
        let manager = desktop
            .command("openbox")
            .arg("--startup")
            .arg(format!("touch '{}'", started.display()))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("openbox starts");
        desktop.children.push(manager);
        wait_for("the window manager", || started.exists());
        Some(desktop)
    }

    /// A program on this desktop.
    pub fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command.env("DISPLAY", &self.display).env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
        command
    }

    /// Starts the program in `directory`, and waits until its window shows its first frame: then its title names the scene.
    pub fn open(&self, directory: &Path, scene: &str, arguments: &[&str]) -> Program<'_> {
        let mut child = self
            .command(env!("CARGO_BIN_EXE_rilievo"))
            .args(["live", "--scene", scene])
            .args(arguments)
            .current_dir(directory)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let mut window = String::new();
        wait_for("the window", || {
            if child.try_wait().is_ok_and(|status| status.is_some()) {
                let mut said = String::new();
                child.stderr.take().map(|mut stderr| stderr.read_to_string(&mut said));
                panic!("the program ended before its window was there: {said}");
            }
            let found =
                self.command("xdotool").args(["search", "--onlyvisible", "--name", &format!("^{scene} .* Rilievo$")]).output();
            window = found.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned()).unwrap_or_default();
            !window.is_empty()
        });
        Program { desktop: self, child: Some(child), window }
    }
}

impl Drop for Desktop {
    fn drop(&mut self) {
        for child in self.children.iter_mut().rev() {
            // Asked to go, a server takes its lock and its socket with it; it may be gone already, and then nothing is left to do.
            let asked = Command::new("kill").arg(child.id().to_string()).stderr(Stdio::null()).status();
            if asked.is_err() {
                let _ = child.kill();
            }
            let _ = child.wait();
        }
    }
}

/// The program and its window.
pub struct Program<'a> {
    desktop: &'a Desktop,
    child: Option<Child>,
    window: String,
}

impl Program<'_> {
    /// Runs `xdotool` with these words, in which `WINDOW` stands for the window.
    pub fn hand(&self, words: &str) {
        let words = words.split_whitespace().map(|word| if word == "WINDOW" { self.window.as_str() } else { word });
        let output = self.desktop.command("xdotool").args(words).output().expect("xdotool runs");
        assert!(output.status.success(), "xdotool: {}", String::from_utf8_lossy(&output.stderr));
    }

    /// The window's title.
    pub fn title(&self) -> String {
        let output = self.desktop.command("xdotool").args(["getwindowname", &self.window]).output().expect("xdotool runs");
        String::from_utf8_lossy(&output.stdout).trim().to_owned()
    }

    /// What the window shows.
    pub fn picture(&self) -> image::RgbImage {
        self.picture_that("a picture of the window", |_| true)
    }

    /// Waits until the window's picture is as it shall be, and returns it.
    pub fn picture_that(&self, is: &str, fits: impl Fn(&image::RgbImage) -> bool) -> image::RgbImage {
        let mut picture = image::RgbImage::default();
        wait_for(is, || {
            let taken = self.desktop.command("import").args(["-silent", "-window", &self.window, "png:-"]).output();
            // A window that is only just on its way back to the screen has no picture yet.
            let taken = taken.ok().and_then(|output| image::load_from_memory(&output.stdout).ok());
            taken.map(|taken| picture = taken.into_rgb8()).is_some() && fits(&picture)
        });
        picture
    }

    /// Whether it has not ended.
    pub fn runs(&mut self) -> bool {
        self.child.as_mut().is_some_and(|child| child.try_wait().expect("its state can be asked").is_none())
    }

    /// How much memory it has, KiB; none once it has ended.
    pub fn resident_kibibytes(&self) -> Option<u64> {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.child.as_ref()?.id())).ok()?;
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
        line.split_whitespace().next()?.parse().ok()
    }

    /// Sends the program a signal, by its short name.
    pub fn signal(&self, name: &str) {
        signal(self.child.as_ref().expect("it has not ended"), name);
    }

    /// Asks the window to close, as a user does.
    pub fn close(&self) {
        let status = self.desktop.command("wmctrl").args(["-i", "-c", &self.window]).status().expect("wmctrl runs");
        assert!(status.success());
    }

    /// Waits until the program has ended, and returns what it said.
    pub fn end(mut self) -> Output {
        let child = self.child.as_mut().expect("it is ended only once");
        wait_for("the end of the program", || child.try_wait().is_ok_and(|status| status.is_some()));
        self.child.take().expect("it is ended only once").wait_with_output().expect("it ended")
    }
}

impl Drop for Program<'_> {
    fn drop(&mut self) {
        if let Some(mut child) = self.child.take() {
            // Only where a test failed: it must not leave the program behind.
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

fn is_installed(tool: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(tool).is_file())
}

/// Sends a program a signal, by its short name.
pub fn signal(child: &Child, name: &str) {
    let status = Command::new("kill").arg(format!("-{name}")).arg(child.id().to_string()).status().expect("kill runs");
    assert!(status.success(), "it has ended already");
}

/// Asks again and again until it is so.
pub fn wait_for(what: &str, mut so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !so() {
        assert!(start.elapsed() < PATIENCE, "waited {PATIENCE:?} for {what}");
        sleep(Duration::from_millis(50));
    }
}
