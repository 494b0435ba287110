//! What keys and the mouse mean. Plain data and pure functions: the window feeds them, tests drive them without one.

use glam::{DVec2, DVec3};
use winit::event::MouseButton;
use winit::keyboard::{Key, KeyCode, NamedKey};

/// What a key or a button of the panel asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Stop the simulation, or let it go on.
    TogglePause,
    /// One step of the clock, paused.
    Step,
    /// Back to the start of the scene.
    Reset,
    /// The scene from its start, with another seed.
    NewSeed,
    /// The last stroke of the brush taken back.
    Undo,
    /// The scene of this place in the list.
    Scene(usize),
    /// The next thing to look at.
    NextView,
    /// Split the screen, or join it again.
    ToggleSplit,
    /// The next technique.
    NextTechnique,
    /// Show or hide the panel.
    TogglePanel,
    /// Show or hide the keys.
    ToggleKeys,
    /// Hide the keys.
    HideKeys,
    /// Fill the screen, or leave it.
    ToggleFullscreen,
    /// Save a picture.
    Picture,
    /// Build the shaders anew from their folder.
    ReloadShaders,
    /// Change between orbit and flight.
    ToggleFly,
    /// Back to the scene's own camera.
    ResetCamera,
}

/// A key, as it is printed on the user's keyboard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Trigger {
    Named(NamedKey),
    /// A character that needs no shift, or needs the one that is on its keyboard.
    Character(&'static str),
    /// A letter with shift.
    Shift(&'static str),
    /// A letter with control.
    Control(&'static str),
}

/// A key and its action.
#[derive(Clone, Copy, Debug)]
pub struct Shortcut {
    /// How the keys are written.
    pub keys: &'static str,
    /// What they do.
    pub does: &'static str,
    triggers: &'static [Trigger],
    action: Action,
}

const fn shortcut(keys: &'static str, does: &'static str, triggers: &'static [Trigger], action: Action) -> Shortcut {
    Shortcut { keys, does, triggers, action }
}

/// Every key with one action. F12 and Print Screen are left alone: they belong to frame debuggers.
pub const SHORTCUTS: &[Shortcut] = &[
    shortcut("Space", "pause, or go on", &[Trigger::Named(NamedKey::Space)], Action::TogglePause),
    shortcut(".", "one step, paused", &[Trigger::Character(".")], Action::Step),
    shortcut("R", "reset the scene", &[Trigger::Character("r")], Action::Reset),
    shortcut("Shift+R", "reset it with a new seed", &[Trigger::Shift("r")], Action::NewSeed),
    shortcut("Ctrl+Z", "take back the last stroke", &[Trigger::Control("z")], Action::Undo),
    shortcut("T", "next technique", &[Trigger::Character("t")], Action::NextTechnique),
    shortcut("V", "next view", &[Trigger::Character("v")], Action::NextView),
    shortcut("B", "split the screen, or not", &[Trigger::Character("b")], Action::ToggleSplit),
    shortcut("F", "fly, or orbit", &[Trigger::Character("f")], Action::ToggleFly),
    shortcut("C", "the scene's own camera", &[Trigger::Character("c")], Action::ResetCamera),
    shortcut(
        "H or Tab",
        "show or hide the panel",
        &[Trigger::Character("h"), Trigger::Named(NamedKey::Tab)],
        Action::TogglePanel,
    ),
    shortcut("P", "save a picture here (PNG)", &[Trigger::Character("p")], Action::Picture),
    shortcut("F5", "reload the shaders from ./shaders", &[Trigger::Named(NamedKey::F5)], Action::ReloadShaders),
    shortcut("F11", "fill the screen", &[Trigger::Named(NamedKey::F11)], Action::ToggleFullscreen),
    shortcut("F1 or ?", "show these keys", &[Trigger::Named(NamedKey::F1), Trigger::Character("?")], Action::ToggleKeys),
    shortcut("Esc", "hide them", &[Trigger::Named(NamedKey::Escape)], Action::HideKeys),
];

/// Keys and buttons that are more than one action.
pub const GESTURES: &[(&str, &str)] = &[
    ("1 … 9", "choose a scene"),
    ("Drag the divider", "of a split screen"),
    ("Left mouse", "what the brush does, where the surface is"),
    ("Right mouse", "orbit, or look about in flight"),
    ("Middle, Shift+right", "pan"),
    ("Wheel", "nearer, or faster in flight"),
    ("Ctrl+wheel", "size of the brush"),
    ("W A S D, Q E", "fly: ahead, aside, down and up"),
];

/// What a pressed key asks for. `shift` and `control` say whether they are held.
pub fn action(key: &Key, shift: bool, control: bool) -> Option<Action> {
    if !control
        && let Key::Character(text) = key
        && let Some(digit @ 1..=9) = text.parse::<usize>().ok()
    {
        return Some(Action::Scene(digit - 1));
    }
    let fits = |trigger: &Trigger| match (*trigger, key) {
        (Trigger::Control(letter), Key::Character(text)) => control && !shift && text.to_lowercase() == letter,
        _ if control => false,
        (Trigger::Named(name), Key::Named(pressed)) => name == *pressed,
        (Trigger::Shift(letter), Key::Character(text)) => shift && text.to_lowercase() == letter,
        (Trigger::Character(character), Key::Character(text)) => {
            let is_letter = character.chars().all(char::is_alphabetic);
            !(shift && is_letter) && text.to_lowercase() == character
        }
        _ => false,
    };
    SHORTCUTS.iter().find(|shortcut| shortcut.triggers.iter().any(fits)).map(|shortcut| shortcut.action)
}

/// The keys of flight that are held down, by their place on the keyboard: WASD is a shape, not four letters.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlightKeys {
    held: Vec<KeyCode>,
}

impl FlightKeys {
    const DIRECTIONS: [(KeyCode, DVec3); 6] = [
        (KeyCode::KeyW, DVec3::Z),
        (KeyCode::KeyS, DVec3::NEG_Z),
        (KeyCode::KeyD, DVec3::X),
        (KeyCode::KeyA, DVec3::NEG_X),
        (KeyCode::KeyE, DVec3::Y),
        (KeyCode::KeyQ, DVec3::NEG_Y),
    ];

    /// Notes a key; says whether it is one of flight's.
    pub fn note(&mut self, code: KeyCode, pressed: bool) -> bool {
        let ours = Self::DIRECTIONS.iter().any(|&(key, _)| key == code);
        self.held.retain(|&held| held != code);
        if ours && pressed {
            self.held.push(code);
        }
        ours
    }

    /// Lets go of all: the window lost the keyboard.
    pub fn release(&mut self) {
        self.held.clear();
    }

    /// Right, up, forward; each −1 to 1.
    pub fn movement(&self) -> DVec3 {
        Self::DIRECTIONS.iter().filter(|(key, _)| self.held.contains(key)).map(|&(_, direction)| direction).sum()
    }
}

/// Who has the mouse from a press to its release.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grip {
    /// The panel: nothing of it reaches the surface or the camera.
    Panel,
    /// The brush.
    Brush,
    /// The camera, turning.
    Turn,
    /// The camera, panning.
    Pan,
}

/// The mouse. Who owns a drag is decided at the press and stays so until its release.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pointer {
    position: Option<DVec2>,
    grip: Option<(MouseButton, Grip)>,
}

impl Pointer {
    /// Where it is, pixels from the upper left corner; `None` outside the window.
    pub fn position(&self) -> Option<DVec2> {
        self.position
    }

    /// Who has it.
    pub fn grip(&self) -> Option<Grip> {
        self.grip.map(|(_, grip)| grip)
    }

    /// A button went down: returns who has the mouse now. A second button changes nothing while the first is held.
    pub fn press(&mut self, button: MouseButton, over_panel: bool, shift: bool) -> Option<Grip> {
        if self.grip.is_none() {
            let grip = match (button, over_panel) {
                (_, true) => Grip::Panel,
                (MouseButton::Left, _) => Grip::Brush,
                (MouseButton::Right, _) if shift => Grip::Pan,
                (MouseButton::Right, _) => Grip::Turn,
                (MouseButton::Middle, _) => Grip::Pan,
                _ => return None,
            };
            self.grip = Some((button, grip));
        }
        self.grip()
    }

    /// A button went up.
    pub fn release(&mut self, button: MouseButton) {
        if self.grip.is_some_and(|(held, _)| held == button) {
            self.grip = None;
        }
    }

    /// It moved: returns who drags it and by how many pixels, right and down.
    pub fn moved(&mut self, position: DVec2) -> Option<(Grip, DVec2)> {
        let before = self.position.replace(position)?;
        self.grip().map(|grip| (grip, position - before))
    }

    /// It left the window. A drag goes on: it may come back.
    pub fn left(&mut self) {
        if self.grip.is_none() {
            self.position = None;
        }
    }

    /// The window lost the focus, and with it the release of a button: lets go. Where the mouse is does not change.
    pub fn let_go(&mut self) {
        self.grip = None;
    }
}

/// Repeats a brush that is held: at once, then at a rate that the frame's clock keeps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Repeat {
    wait_seconds: f64,
    held: bool,
}

impl Repeat {
    /// Whether the brush acts in this frame, `dt_seconds` after the one before; at most once a frame.
    pub fn acts(&mut self, held: bool, dt_seconds: f64, per_second: f64) -> bool {
        let began = held && !self.held;
        self.held = held;
        if !held {
            return false;
        }
        self.wait_seconds = if began { 0.0 } else { self.wait_seconds - dt_seconds };
        // A microsecond of rounding must not cost a frame.
        let acts = self.wait_seconds <= 1e-6;
        if acts {
            let period = 1.0 / per_second;
            self.wait_seconds += period;
            // What a slow frame missed is not made up for: a burst would surprise.
            if self.wait_seconds <= 0.0 {
                self.wait_seconds = period;
            }
        }
        acts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn character(text: &str) -> Key {
        Key::Character(text.into())
    }

    #[test]
    fn every_shortcut_is_reached_by_its_keys_and_no_key_has_two() {
        for shortcut in SHORTCUTS {
            for trigger in shortcut.triggers {
                let (key, shift, control) = match *trigger {
                    Trigger::Named(name) => (Key::Named(name), false, false),
                    Trigger::Character("?") => (character("?"), true, false),
                    Trigger::Character(text) => (character(text), false, false),
                    Trigger::Shift(text) => (character(&text.to_uppercase()), true, false),
                    Trigger::Control(text) => (character(text), false, true),
                };
                assert_eq!(action(&key, shift, control), Some(shortcut.action), "{}", shortcut.keys);
            }
        }
    }

    #[test]
    fn digits_choose_scenes_and_others_are_left_alone() {
        assert_eq!(action(&character("1"), false, false), Some(Action::Scene(0)));
        assert_eq!(action(&character("9"), false, false), Some(Action::Scene(8)));
        assert_eq!(action(&character("0"), false, false), None);
        for key in [NamedKey::F12, NamedKey::PrintScreen] {
            assert_eq!(action(&Key::Named(key), false, false), None);
        }
    }

    #[test]
    fn caps_lock_does_not_act_as_shift() {
        assert_eq!(action(&character("R"), false, false), Some(Action::Reset));
        assert_eq!(action(&character("R"), true, false), Some(Action::NewSeed));
        assert_eq!(action(&character("T"), true, false), None);
    }

    #[test]
    fn control_takes_back_and_does_nothing_else() {
        assert_eq!(action(&character("z"), false, false), None);
        for key in ["r", "1", "t"] {
            assert_eq!(action(&character(key), false, true), None, "{key}");
        }
    }

    #[test]
    fn flight_keys_add_up_and_cancel_out() {
        let mut keys = FlightKeys::default();
        assert!(keys.note(KeyCode::KeyW, true));
        assert!(keys.note(KeyCode::KeyW, true));
        assert!(keys.note(KeyCode::KeyE, true));
        assert!(!keys.note(KeyCode::KeyR, true));
        assert_eq!(keys.movement(), DVec3::new(0.0, 1.0, 1.0));
        keys.note(KeyCode::KeyS, true);
        assert_eq!(keys.movement(), DVec3::Y);
        keys.release();
        assert_eq!(keys.movement(), DVec3::ZERO);
    }

    #[test]
    fn who_owns_a_drag_is_decided_at_the_press() {
        let mut pointer = Pointer::default();
        assert_eq!(pointer.moved(DVec2::new(5.0, 5.0)), None);
        assert_eq!(pointer.press(MouseButton::Left, true, false), Some(Grip::Panel));
        // Over the surface by now, and with another button: still the panel's.
        assert_eq!(pointer.moved(DVec2::new(500.0, 5.0)), Some((Grip::Panel, DVec2::new(495.0, 0.0))));
        assert_eq!(pointer.press(MouseButton::Right, false, false), Some(Grip::Panel));
        pointer.release(MouseButton::Right);
        assert_eq!(pointer.grip(), Some(Grip::Panel));
        pointer.release(MouseButton::Left);
        assert_eq!(pointer.grip(), None);
        assert_eq!(pointer.press(MouseButton::Right, false, false), Some(Grip::Turn));
        pointer.left();
        assert_eq!(pointer.moved(DVec2::new(510.0, 0.0)), Some((Grip::Turn, DVec2::new(10.0, -5.0))));
        pointer.let_go();
        assert_eq!((pointer.position(), pointer.grip()), (Some(DVec2::new(510.0, 0.0)), None));
        assert_eq!(pointer.press(MouseButton::Right, false, true), Some(Grip::Pan));
    }

    #[test]
    fn a_held_brush_repeats_at_its_rate_and_never_in_bursts() {
        let mut repeat = Repeat::default();
        let frames: Vec<bool> = (0..9).map(|_| repeat.acts(true, 1.0 / 60.0, 15.0)).collect();
        assert_eq!(frames, [true, false, false, false, true, false, false, false, true]);
        assert!(!repeat.acts(false, 1.0 / 60.0, 15.0));
        assert!(repeat.acts(true, 1.0 / 60.0, 15.0), "a new press acts at once");
        assert!(repeat.acts(true, 5.0, 15.0));
        assert!(!repeat.acts(true, 0.0, 15.0), "what a slow frame missed is not made up for");
    }
}
