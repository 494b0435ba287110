//! What `capture --export` can write.

/// What can be exported of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Export {
    /// The height field, 16-bit grey.
    HeightPng,
    /// The height field, to the bit.
    HeightExr,
    /// Its normals, 16-bit RGB, green up the image.
    NormalGlPng,
    /// The same, green down the image.
    NormalDxPng,
    /// The base with its stamps, before anything moves over it; not clamped.
    ReliefExr,
    /// What water stands on; not clamped.
    BedExr,
    /// The heights of a source of this name, as it has them.
    SourceExr(&'static str),
}

impl Export {
    /// All of them, in the order of the documentation.
    pub const ALL: [Self; 11] = [
        Self::HeightPng,
        Self::HeightExr,
        Self::NormalGlPng,
        Self::NormalDxPng,
        Self::ReliefExr,
        Self::BedExr,
        Self::SourceExr("noise"),
        Self::SourceExr("sequence"),
        Self::SourceExr("gas"),
        Self::SourceExr("shallow-water"),
        Self::SourceExr("wave"),
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::HeightPng => "height-png",
            Self::HeightExr => "height-exr",
            Self::NormalGlPng => "normal-gl-png",
            Self::NormalDxPng => "normal-dx-png",
            Self::ReliefExr => "relief-exr",
            Self::BedExr => "bed-exr",
            Self::SourceExr("noise") => "noise-exr",
            Self::SourceExr("sequence") => "sequence-exr",
            Self::SourceExr("gas") => "gas-exr",
            Self::SourceExr("shallow-water") => "shallow-water-exr",
            Self::SourceExr(_) => "wave-exr",
        }
    }

    /// What its file is called after the frame's number.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::HeightPng | Self::HeightExr => "",
            Self::NormalGlPng => "_normal-gl",
            Self::NormalDxPng => "_normal-dx",
            Self::ReliefExr => "_relief",
            Self::BedExr => "_bed",
            Self::SourceExr("noise") => "_noise",
            Self::SourceExr("sequence") => "_sequence",
            Self::SourceExr("gas") => "_gas",
            Self::SourceExr("shallow-water") => "_shallow-water",
            Self::SourceExr(_) => "_wave",
        }
    }

    /// Its file for a frame.
    pub fn file(self, index: u32) -> String {
        let ending = if self.name().ends_with("-png") { "png" } else { "exr" };
        format!("field_{index:05}{}.{ending}", self.suffix())
    }
}
