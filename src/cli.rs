//! Arguments to [`Command`]: pure, no file is opened and nothing is printed here.
//!
//! What can be refused by reading the arguments alone is refused here, in one sentence ([`Refusal`]), with exit code 2. Names of
//! scenes are content, not arguments: `io::scene_file` refuses those.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Args, Parser, Subcommand};

use crate::gpu::Preference;
use crate::io::scene_file::{CameraPlacement, FieldSize, SceneOverrides};
use crate::scene;
use crate::suggest;
use crate::surface::{Shadow, Technique};

/// What the user asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// A window.
    Live(LiveOptions),
    /// Pictures and channels, to files.
    Capture(CaptureOptions),
    /// Numbers.
    Stress(StressOptions),
    /// The list of GPU adapters.
    Adapters(AdaptersOptions),
    /// The list of scenes.
    Scenes,
}

impl Command {
    /// How much it shall tell of itself on stderr.
    pub fn verbosity(&self) -> Verbosity {
        match self {
            Self::Live(options) => options.common.machine.verbosity(),
            Self::Capture(options) => options.common.machine.verbosity(),
            Self::Stress(options) => options.common.machine.verbosity(),
            Self::Adapters(options) => options.machine.verbosity(),
            Self::Scenes => Verbosity::Normal,
        }
    }
}

/// How much the program tells of itself on stderr.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verbosity {
    /// Errors only.
    Quiet,
    /// Notes and warnings.
    Normal,
    /// Its own details, and other crates' warnings.
    Verbose,
}

/// What every mode that shows a scene takes.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct CommonOptions {
    /// A scene's name, or a file that ends in .toml or lies behind a path
    #[arg(long, value_name = "NAME|FILE.toml", default_value = "ripples", help_heading = "Scene")]
    pub scene: String,

    #[arg(long, value_name = "T", value_parser = technique, help = technique_help(), help_heading = "Scene")]
    technique: Option<Technique>,

    #[arg(long, value_name = "S", value_parser = shadow, help = shadow_help(), help_heading = "Scene")]
    shadow: Option<Shadow>,

    /// Seed of everything random [default: the scene's]
    #[arg(long, value_name = "N", value_parser = whole_u64, allow_negative_numbers = true, help_heading = "Scene")]
    seed: Option<u64>,

    /// Size of the picture or window, pixels
    #[arg(long = "size", value_name = "WxH", value_parser = size, default_value = "960x600", allow_hyphen_values = true)]
    pub image_size: [u32; 2],

    /// Size of the height field, texels; N alone keeps the aspect of an image [default: the image's, or else the scene's]
    #[arg(long, value_name = "N|WxH", value_parser = field, allow_negative_numbers = true, help_heading = "Scene")]
    field: Option<FieldSize>,

    /// A PNG or EXR file whose heights replace the scene's starting height [default: none, the scene's own]
    #[arg(long, value_name = "IMAGE", help_heading = "Scene")]
    height: Option<PathBuf>,

    /// The values in the image that become heights 0 and 1 [default: 0,1]
    #[arg(long, value_name = "LO,HI", value_parser = height_range, allow_hyphen_values = true, help_heading = "Scene")]
    height_range: Option<[f32; 2]>,

    /// Text in relief, as large as fits, that replaces the scene's starting height; \n begins another line [default: none, the scene's own]
    #[arg(long, value_name = "STRING", value_parser = sign, allow_hyphen_values = true, help_heading = "Scene")]
    #[arg(conflicts_with_all = ["height", "height_range"])]
    text: Option<String>,

    /// A TTF or OTF file for the text [default: the scene's, the program's own unless its file says otherwise]
    #[arg(long, value_name = "FILE", conflicts_with_all = ["height", "height_range"], help_heading = "Scene")]
    font: Option<PathBuf>,

    /// A PNG file whose colours lie over the whole field [default: none, the scene's albedo]
    #[arg(long, value_name = "IMAGE", help_heading = "Scene")]
    albedo: Option<PathBuf>,

    /// Depth of height 0 below the plane, metres [default: the scene's]
    #[arg(long, value_name = "METRES", value_parser = depth, allow_negative_numbers = true, help_heading = "Scene")]
    depth: Option<f32>,

    /// Eye and target, metres; replaces every camera motion [default: the scene's, which shows the whole plane]
    #[arg(long, value_name = "EX,EY,EZ,TX,TY,TZ", value_parser = camera, allow_hyphen_values = true, help_heading = "Scene")]
    camera: Option<CameraPlacement>,

    /// Vertical field of view, degrees [default: the scene's, 45 unless its file says otherwise]
    #[arg(long, value_name = "DEGREES", value_parser = fov, allow_negative_numbers = true, help_heading = "Scene")]
    fov: Option<f64>,

    /// Which machine, and how much it tells.
    #[command(flatten)]
    pub machine: MachineOptions,
}

impl CommonOptions {
    /// What the arguments change in the scene.
    pub fn overrides(&self) -> SceneOverrides {
        SceneOverrides {
            height: self.height.clone(),
            height_range: self.height_range,
            text: self.text.clone(),
            font: self.font.clone(),
            albedo: self.albedo.clone(),
            field: self.field,
            depth_metres: self.depth,
            technique: self.technique,
            shadow: self.shadow,
            seed: self.seed,
            camera: self.camera,
            vertical_fov_degrees: self.fov,
        }
    }
}

/// Which adapter, and how much to tell.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct MachineOptions {
    /// Use the adapter whose name contains this, in any case [default: $WGPU_ADAPTER_NAME, or else the best there is]
    #[arg(long, value_name = "SUBSTRING", value_parser = non_empty, help_heading = "Machine")]
    pub adapter: Option<String>,

    /// vulkan, metal, dx12 or gl [default: $WGPU_BACKEND, or else all of them]
    #[arg(long, value_name = "BACKEND", value_parser = backend, help_heading = "Machine")]
    pub backend: Option<wgpu::Backends>,

    /// Tell more on stderr; $RUST_LOG chooses freely [default: notes and warnings]
    #[arg(short, long, conflicts_with = "quiet", help_heading = "Machine")]
    verbose: bool,

    /// Tell nothing on stderr but errors [default: notes and warnings]
    #[arg(short, long, help_heading = "Machine")]
    quiet: bool,
}

impl MachineOptions {
    /// The adapters that may be used, hardware first; the environment completes what the arguments leave open.
    pub fn preference(&self) -> Preference {
        Preference { name: self.adapter.clone(), backend: self.backend, ..Preference::default() }.with_environment()
    }

    fn verbosity(&self) -> Verbosity {
        match (self.quiet, self.verbose) {
            (true, _) => Verbosity::Quiet,
            (_, true) => Verbosity::Verbose,
            _ => Verbosity::Normal,
        }
    }
}

/// `rilievo live`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct LiveOptions {
    /// What every mode takes.
    #[command(flatten)]
    pub common: CommonOptions,

    /// Run this many frames at a fixed step of 1/60 s, then exit [default: none, until the window is closed]
    #[arg(long, value_name = "N", value_parser = frames, requires = "out", allow_negative_numbers = true)]
    pub frames: Option<u32>,

    /// Write the last of those frames here, as capture would [default: none, nothing is written]
    #[arg(long, value_name = "DIR", requires = "frames")]
    pub out: Option<PathBuf>,
}

/// `rilievo capture`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct CaptureOptions {
    /// What every mode takes.
    #[command(flatten)]
    pub common: CommonOptions,

    /// The directory to write to; frames, fields and the manifest of an earlier run are removed from it
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,

    /// How many frames to write
    #[arg(long, value_name = "N", value_parser = frames, default_value = "1", allow_negative_numbers = true)]
    pub frames: u32,

    /// Time from frame to frame, seconds [default: 1/60]
    #[arg(long, value_name = "SECONDS", value_parser = dt, default_value = "0.016666666666666666", hide_default_value = true)]
    #[arg(allow_negative_numbers = true)]
    pub dt: f64,

    /// How many frames to run before the first that is written
    #[arg(long, value_name = "N", value_parser = whole_u32, default_value = "0", allow_negative_numbers = true)]
    pub warmup: u32,

    /// Which channels to write, of color, position, normal, uv, height, visibility, steps and lod; color always is
    #[arg(long, value_name = "LIST", value_parser = channel, value_delimiter = ',', default_value = "color")]
    channels: Vec<Channel>,
}

impl CaptureOptions {
    /// Whether this channel was asked for. Colour always is.
    pub fn wants(&self, channel: Channel) -> bool {
        channel == Channel::Color || self.channels.contains(&channel)
    }

    /// The channels to write, each once, in the order of [`Channel::ALL`].
    pub fn channels(&self) -> Vec<Channel> {
        Channel::ALL.iter().copied().filter(|&channel| self.wants(channel)).collect()
    }
}

/// What can be captured of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Channel {
    /// The picture.
    Color,
    /// World position, metres.
    Position,
    /// World normal, as shaded.
    Normal,
    /// Texture coordinates, not wrapped.
    Uv,
    /// Height at the point that is seen, and the height field itself.
    Height,
    /// How much of the light arrives.
    Visibility,
    /// Height samples and nodes visited.
    Steps,
    /// Level of detail.
    Lod,
}

impl Channel {
    /// All of them, in the order of the documentation.
    pub const ALL: [Self; 8] =
        [Self::Color, Self::Position, Self::Normal, Self::Uv, Self::Height, Self::Visibility, Self::Steps, Self::Lod];

    /// Its name on the command line and in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Color => "color",
            Self::Position => "position",
            Self::Normal => "normal",
            Self::Uv => "uv",
            Self::Height => "height",
            Self::Visibility => "visibility",
            Self::Steps => "steps",
            Self::Lod => "lod",
        }
    }
}

/// `rilievo stress`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct StressOptions {
    /// What every mode takes.
    #[command(flatten)]
    pub common: CommonOptions,

    /// How many frames to measure
    #[arg(long, value_name = "N", value_parser = frames, default_value = "60", allow_negative_numbers = true)]
    pub frames: u32,

    /// How many seeded discs to stamp each frame
    #[arg(long, value_name = "K", value_parser = stamps, default_value = "0", allow_negative_numbers = true)]
    pub stamps: u32,

    /// Their radius, texels
    #[arg(long, value_name = "TEXELS", value_parser = stamp_radius, default_value = "8", allow_negative_numbers = true)]
    pub stamp_radius: f32,

    /// Also write the numbers here [default: none, they are only printed]
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
}

/// `rilievo adapters`.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct AdaptersOptions {
    /// Which of them, and how much to tell.
    #[command(flatten)]
    pub machine: MachineOptions,
}

/// A GPU laboratory for height fields that move.
///
/// Simulates, stamps, derives, traces and shows a height field, every frame. Without a mode it opens a window.
#[derive(Parser, Debug)]
#[command(name = "rilievo", version, args_conflicts_with_subcommands = true)]
struct Arguments {
    #[command(subcommand)]
    mode: Option<Mode>,
    #[command(flatten)]
    live: LiveOptions,
}

#[derive(Subcommand, Debug)]
enum Mode {
    /// Show a scene in a window (the default)
    Live(LiveOptions),
    /// Write pictures and channels to files, without a window
    Capture(CaptureOptions),
    /// Measure frames, without a window
    Stress(StressOptions),
    /// List the GPU adapters
    Adapters(AdaptersOptions),
    /// List the scenes
    Scenes,
}

/// Why there is no command to run.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// Help or the version was asked for: print this on stdout, exit with 0.
    Told(String),
    /// The arguments make no sense: print this sentence on stderr, exit with 2.
    Refused(String),
}

/// Reads the arguments, the program's own name first.
pub fn parse(arguments: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> Result<Command, Refusal> {
    let arguments = Arguments::try_parse_from(arguments).map_err(|error| match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => Refusal::Told(error.render().to_string()),
        _ => Refusal::Refused(sentence(&error)),
    })?;
    Ok(match arguments.mode {
        None => Command::Live(arguments.live),
        Some(Mode::Live(options)) => Command::Live(options),
        Some(Mode::Capture(options)) => Command::Capture(options),
        Some(Mode::Stress(options)) => Command::Stress(options),
        Some(Mode::Adapters(options)) => Command::Adapters(options),
        Some(Mode::Scenes) => Command::Scenes,
    })
}

/// clap explains in paragraphs; here is the same in one sentence.
fn sentence(error: &clap::Error) -> String {
    let text = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.clone()),
        Some(ContextValue::Strings(texts)) => Some(texts.join("`, `")),
        _ => None,
    };
    // clap says `--size <WxH>`; the flag alone reads better.
    let flag = |kind| text(kind).map(|argument| argument.split(" <").next().unwrap_or_default().to_owned());
    let argument = flag(ContextKind::InvalidArg).unwrap_or_default();
    // One sentence is one line, whatever someone writes into an argument.
    let value = text(ContextKind::InvalidValue).unwrap_or_default().replace(char::is_control, "\u{fffd}");
    match error.kind() {
        ErrorKind::UnknownArgument => match text(ContextKind::SuggestedArg) {
            Some(near) => format!("unknown argument `{argument}`: did you mean `{near}`, of those that `--help` lists?"),
            None => format!("unknown argument `{argument}`: `--help` lists those there are"),
        },
        ErrorKind::InvalidSubcommand => {
            let name = text(ContextKind::InvalidSubcommand).unwrap_or_default();
            suggest::unknown("mode", &name, &["live", "capture", "stress", "adapters", "scenes"])
        }
        ErrorKind::ValueValidation => {
            let cause = std::error::Error::source(error).map(ToString::to_string).unwrap_or_default();
            match (cause.contains("known are") || cause.starts_with("unknown "), value.is_empty()) {
                (true, _) => cause,
                (false, true) => format!("`{argument}` is empty: give it a value"),
                (false, false) => format!("`{argument}` cannot be `{value}`: {cause}"),
            }
        }
        ErrorKind::InvalidValue => format!("`{argument}` needs a value"),
        ErrorKind::MissingRequiredArgument => format!("`{argument}` is missing: `--help` says what it is for"),
        ErrorKind::ArgumentConflict => match flag(ContextKind::PriorArg) {
            Some(prior) if argument.is_empty() => {
                format!("`{prior}` stands before the mode: write the mode first, as in `rilievo capture --out DIR {prior}`")
            }
            Some(prior) if prior == argument => format!("`{argument}` is given twice: give it once"),
            Some(prior) => format!("`{argument}` and `{prior}` exclude each other: give one of them"),
            None => format!("`{argument}` contradicts another argument: `--help` says what it is for"),
        },
        // Every other kind is rare; its first line is a sentence already.
        _ => {
            let rendered = error.render().to_string();
            let line = rendered.lines().next().unwrap_or_default();
            line.strip_prefix("error: ").unwrap_or(line).to_owned()
        }
    }
}

fn technique_help() -> String {
    let names: Vec<_> = Technique::ALL.iter().map(|choice| choice.name()).collect();
    format!("How the surface is traced: {} [default: the scene's]", suggest::enumerate(&names, "or"))
}

fn shadow_help() -> String {
    let names: Vec<_> = Shadow::ALL.iter().map(|choice| choice.name()).collect();
    format!("The shadow upon it: {} [default: the scene's]", suggest::enumerate(&names, "or"))
}

fn technique(text: &str) -> Result<Technique, String> {
    let names: Vec<_> = Technique::ALL.iter().map(|choice| choice.name()).collect();
    Technique::from_name(text).ok_or_else(|| suggest::unknown("technique", text, &names))
}

fn shadow(text: &str) -> Result<Shadow, String> {
    let names: Vec<_> = Shadow::ALL.iter().map(|choice| choice.name()).collect();
    Shadow::from_name(text).ok_or_else(|| suggest::unknown("shadow", text, &names))
}

fn channel(text: &str) -> Result<Channel, String> {
    let names = Channel::ALL.map(Channel::name);
    let found = Channel::ALL.into_iter().find(|channel| channel.name() == text);
    found.ok_or_else(|| suggest::unknown("channel", text, &names))
}

fn backend(text: &str) -> Result<wgpu::Backends, String> {
    match text {
        "vulkan" => Ok(wgpu::Backends::VULKAN),
        "metal" => Ok(wgpu::Backends::METAL),
        "dx12" => Ok(wgpu::Backends::DX12),
        "gl" => Ok(wgpu::Backends::GL),
        _ => Err(suggest::unknown("backend", text, &["vulkan", "metal", "dx12", "gl"])),
    }
}

fn non_empty(text: &str) -> Result<String, String> {
    if text.is_empty() { Err("it is empty".to_owned()) } else { Ok(text.to_owned()) }
}

fn whole_u64(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("it must be a whole number from 0 to {}", u64::MAX))
}

fn whole_u32(text: &str) -> Result<u32, String> {
    text.parse().map_err(|_| format!("it must be a whole number from 0 to {}", u32::MAX))
}

/// Stamps of a frame. A stamp is 48 bytes before the bins can say that their tiles are too many.
fn stamps(text: &str) -> Result<u32, String> {
    const MOST: u32 = 1 << 22;
    whole_u32(text).ok().filter(|count| *count <= MOST).ok_or_else(|| format!("it must be a whole number from 0 to {MOST}"))
}

fn positive_u32(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(number) if number > 0 => Ok(number),
        _ => Err(format!("it must be a whole number from 1 to {}", u32::MAX)),
    }
}

fn frames(text: &str) -> Result<u32, String> {
    positive_u32(text)
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once(['x', 'X']).map(|(width, height)| (positive_u32(width), positive_u32(height)));
    match sides {
        Some((Ok(width), Ok(height))) => Ok([width, height]),
        _ => Err("it must be a width and a height of at least 1, like 640x480".to_owned()),
    }
}

fn field(text: &str) -> Result<FieldSize, String> {
    if let Ok(width) = positive_u32(text) {
        return Ok(FieldSize::Width(width));
    }
    size(text)
        .map(FieldSize::Exactly)
        .map_err(|_| "it must be a width like 512, or a size like 1024x512, of at least 1".to_owned())
}

/// Finite numbers between commas, exactly `N` of them.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|part| part.trim().parse().ok().filter(|number: &f64| number.is_finite())).collect();
    numbers?.try_into().ok()
}

/// One finite number within a range that excludes its lower end where that is 0.
fn number_within(text: &str, range: scene::Range) -> Result<f64, String> {
    match numbers::<1>(text) {
        Some([number]) if range.contains(number) => Ok(number),
        _ => Err(format!("it must be {range}")),
    }
}

#[expect(clippy::cast_possible_truncation, reason = "metres and texels are f32 throughout")]
fn depth(text: &str) -> Result<f32, String> {
    number_within(text, scene::DEPTH_METRES).map(|number| number as f32)
}

#[expect(clippy::cast_possible_truncation, reason = "metres and texels are f32 throughout")]
fn stamp_radius(text: &str) -> Result<f32, String> {
    number_within(text, scene::Range::above(0.0, 65536.0, "texels")).map(|number| number as f32)
}

fn fov(text: &str) -> Result<f64, String> {
    number_within(text, scene::VERTICAL_FOV_DEGREES)
}

fn dt(text: &str) -> Result<f64, String> {
    // An hour a frame: beyond it a simulation that keeps its own step would seem to hang.
    number_within(text, scene::Range::above(0.0, 3600.0, "seconds"))
}

fn height_range(text: &str) -> Result<[f32; 2], String> {
    #[expect(clippy::cast_possible_truncation, reason = "images are read as f32")]
    let range = numbers::<2>(text).map(|range| range.map(|bound| bound as f32));
    match range {
        Some([low, high]) if low < high && (high - low).is_finite() => Ok([low, high]),
        Some(_) => Err("the first number must be less than the second".to_owned()),
        None => Err("it must be two numbers, like 0,1000".to_owned()),
    }
}

/// The words of a sign. A shell's quotes keep `\n` as two characters: here it ends a line, as in a scene.
fn sign(text: &str) -> Result<String, String> {
    let text = text.replace("\\n", "\n");
    scene::check_text(&text).map(|()| text)
}

fn camera(text: &str) -> Result<CameraPlacement, String> {
    let Some([ex, ey, ez, tx, ty, tz]) = numbers::<6>(text) else {
        return Err("it must be six numbers, eye and target in metres, like 0,1,1,0,0,0".to_owned());
    };
    let camera = CameraPlacement { eye: [ex, ey, ez], target: [tx, ty, tz] };
    scene::check_camera(camera.eye, camera.target).map(|()| camera)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(line: &str) -> Result<Command, Refusal> {
        super::parse(std::iter::once("rilievo").chain(line.split_whitespace()))
    }

    fn capture(line: &str) -> CaptureOptions {
        match parse(&format!("capture --out DIR {line}")) {
            Ok(Command::Capture(options)) => options,
            other => panic!("{line}: {other:?}"),
        }
    }

    #[test]
    fn clap_finds_no_fault_with_the_declaration() {
        <Arguments as clap::CommandFactory>::command().debug_assert();
    }

    #[test]
    fn the_defaults_are_those_of_the_contract() {
        let options = capture("");
        assert_eq!((options.frames, options.dt, options.warmup), (1, 1.0 / 60.0, 0));
        assert_eq!(options.channels(), [Channel::Color]);
        assert_eq!(options.common.overrides(), SceneOverrides::default());
        let Ok(Command::Stress(options)) = parse("stress") else { panic!() };
        assert_eq!((options.frames, options.stamps, options.stamp_radius, options.json), (60, 0, 8.0, None));
        let Ok(Command::Live(options)) = parse("live") else { panic!() };
        assert_eq!((options.frames, options.out), (None, None));
    }

    #[test]
    fn without_a_mode_it_is_live() {
        assert_eq!(parse(""), parse("live"));
        assert_eq!(parse("--scene relief --seed 3"), parse("live --scene relief --seed 3"));
        assert_eq!(parse("--frames 3 --out DIR"), parse("live --frames 3 --out DIR"));
    }

    #[test]
    fn values_arrive() {
        let options = capture(
            "--scene a.toml --technique pom --shadow pom-soft --seed 18446744073709551615 --size 7x9 --field 31 --height h.png \
             --height-range -5,7.5 --albedo c.png --depth 0.25 --camera -1,2,-3,0,-.5,1e-3 --fov 30 --adapter llvm --backend gl -v \
             --frames 5 --dt 0.5 --warmup 9 --channels lod,height,lod",
        );
        assert_eq!(options.common.scene, "a.toml");
        assert_eq!(options.common.image_size, [7, 9]);
        assert_eq!(options.common.machine.adapter.as_deref(), Some("llvm"));
        assert_eq!(options.common.machine.backend, Some(wgpu::Backends::GL));
        assert_eq!(
            options.common.overrides(),
            SceneOverrides {
                height: Some("h.png".into()),
                height_range: Some([-5.0, 7.5]),
                text: None,
                font: None,
                albedo: Some("c.png".into()),
                field: Some(FieldSize::Width(31)),
                depth_metres: Some(0.25),
                technique: Some(Technique::Pom),
                shadow: Some(Shadow::PomSoft),
                seed: Some(u64::MAX),
                camera: Some(CameraPlacement { eye: [-1.0, 2.0, -3.0], target: [0.0, -0.5, 1e-3] }),
                vertical_fov_degrees: Some(30.0),
            }
        );
        let overrides = capture("--text Two\\nlines --font f.ttf").common.overrides();
        assert_eq!((overrides.text.as_deref(), overrides.font), (Some("Two\nlines"), Some("f.ttf".into())));
        assert_eq!(capture("--text -a").common.overrides().text.as_deref(), Some("-a"));
        assert_eq!((options.frames, options.dt, options.warmup), (5, 0.5, 9));
        assert_eq!(options.channels(), [Channel::Color, Channel::Height, Channel::Lod]);
        assert_eq!(Command::Capture(options).verbosity(), Verbosity::Verbose);
        assert_eq!(capture("--field 31x7").common.overrides().field, Some(FieldSize::Exactly([31, 7])));
        assert_eq!(parse("live --camera=-1,2,3,0,0,0"), parse("live --camera -1,2,3,0,0,0"));
    }

    #[test]
    fn help_tells_every_default() {
        for line in ["--help", "live --help", "capture --help", "stress --help", "adapters --help"] {
            let Err(Refusal::Told(help)) = parse(line) else { panic!("{line}") };
            // Each flag up to the next, whatever the lines are broken into. Help and version do nothing unless asked.
            let flags = help.split("\n  ").map(|part| part.split_whitespace().collect::<Vec<_>>().join(" "));
            let mut paragraphs: Vec<String> = Vec::new();
            for part in flags {
                if part.starts_with('-') || paragraphs.is_empty() {
                    paragraphs.push(part)
                } else {
                    *paragraphs.last_mut().unwrap() += &part
                }
            }
            let flags =
                paragraphs.iter().filter(|part| part.starts_with('-') && !part.contains("--help") && !part.contains("--version"));
            for flag in flags.filter(|flag| !(line.starts_with("capture") && flag.starts_with("--out"))) {
                assert!(flag.contains("[default:"), "{line}: {flag}");
            }
        }
        assert!(matches!(parse("--version"), Err(Refusal::Told(_))));
    }

    #[test]
    fn nonsense_is_refused_in_one_sentence() {
        let lines = [
            ("--sceen x", "--scene"),
            ("fly", "known are live, capture, stress, adapters and scenes"),
            ("captur --out DIR", "capture"),
            ("capture", "--out"),
            ("capture --out", "--out"),
            ("capture --out=", "--out"),
            ("--size 8x8 capture --out DIR", "mode"),
            ("capture --out DIR extra", "extra"),
            ("capture --out a --out b", "twice"),
            ("live -v -q", "exclude"),
            ("live --frames 3", "--out"),
            ("live --out DIR", "--frames"),
            ("live --technique exat", "did you mean `exact`, of normal, pom and exact?"),
            ("live --technique", "--technique"),
            ("live --shadow soft", "none, pom-soft and hard"),
            ("live --backend vulcan", "did you mean `vulkan`"),
            ("live --adapter=", "--adapter"),
            ("capture --out DIR --channels color,hight", "did you mean `height`"),
            ("capture --out DIR --channels color,", "known are color"),
        ];
        let values = [
            ("seed", "-1 1.5 x 18446744073709551616"),
            ("size", "0x5 5x0 5 5x 5x5x5 -5x5 5.5x5 4294967296x1 axb"),
            ("field", "0 0x5 5x0 -5 5.5 5x x 4294967296"),
            ("height-range", "1,1 5,1 1 1,2,3 nan,1 0,inf a,b , -1e39,1e39"),
            ("depth", "0 -1 nan inf x 1e9"),
            ("camera", "1,2,3 1,2,3,1,2,3 nan,0,0,1,1,1 inf,0,0,1,1,1 1,2,3,4,5,6,7 a,b,c,d,e,f 1e12,0,0,0,0,0"),
            ("fov", "0 -45 180 nan inf x"),
            ("frames", "0 -1 1.5 x 4294967296"),
            ("dt", "0 -1 nan inf x 1e9"),
            ("warmup", "-1 1.5 x"),
        ];
        let values = values.into_iter().flat_map(|(flag, values)| {
            values.split(' ').map(move |value| (format!("capture --out DIR --{flag} {value}"), format!("--{flag}")))
        });
        let stress = [
            ("frames", "0"),
            ("stamps", "-1"),
            ("stamps", "4294967295"),
            ("stamp-radius", "0"),
            ("stamp-radius", "-3"),
            ("stamp-radius", "nan"),
        ];
        let stress = stress.map(|(flag, value)| (format!("stress --{flag} {value}"), format!("--{flag}")));
        for (line, part) in lines.map(|(line, part)| (line.to_owned(), part.to_owned())).into_iter().chain(values).chain(stress) {
            match parse(&line) {
                Err(Refusal::Refused(sentence)) => {
                    assert!(sentence.contains(&part), "{line}: {sentence}");
                    assert!(!sentence.contains('\n') && !sentence.contains("``"), "{line}: {sentence}");
                }
                other => panic!("{line}: {other:?}"),
            }
        }
    }

    #[test]
    fn a_scene_is_content() {
        assert!(parse("live --scene nowhere").is_ok());
    }

    #[cfg(unix)]
    #[test]
    fn paths_need_not_be_text() {
        use std::os::unix::ffi::OsStringExt as _;
        let path = OsString::from_vec(vec![b'a', 0xff]);
        let arguments = [OsString::from("rilievo"), "capture".into(), "--out".into(), path.clone()];
        let Ok(Command::Capture(options)) = super::parse(arguments) else { panic!() };
        assert_eq!(options.out, PathBuf::from(path));
    }
}
