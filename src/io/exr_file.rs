//! Channels as OpenEXR: one part, scanlines, 32-bit float, lossless.

use std::collections::BTreeMap;
use std::path::Path;

use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes, LineOrder,
    ReadChannels as _, ReadLayers as _, Vec2, WritableImage as _,
};

use super::atomic::{self, WriteError};

/// Channels by name, each `width · height` values in rows from the top.
pub type Channels = BTreeMap<String, Vec<f32>>;

/// Writes the channels, infinities and all. Names may have dots (`position.X`).
///
/// # Errors
///
/// The file cannot be written.
///
/// # Panics
///
/// A channel has not as many values as the size says.
pub fn write(path: &Path, size: [u32; 2], channels: Channels) -> Result<(), WriteError> {
    let size = Vec2(size[0] as usize, size[1] as usize);
    let channels = channels.into_iter().map(|(name, values)| {
        assert_eq!(values.len(), size.area(), "values of channel {name}");
        AnyChannel::new(name.as_str(), FlatSamples::F32(values))
    });
    // ZIP over 16 lines: lossless for floats and read by everything.
    let encoding = Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let layer = Layer::new(size, LayerAttributes::default(), encoding, AnyChannels::sort(channels.collect()));
    let image = Image::from_layer(layer);
    atomic::write(path, |file| image.write().to_buffered(file).map_err(io_error))
}

/// Reads every channel of the first part as f32.
///
/// # Errors
///
/// The file cannot be read as such a file.
pub fn read(path: &Path) -> Result<([u32; 2], Channels), exr::error::Error> {
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_file(path)?;
    let size = image.layer_data.size;
    let side = |extent: usize| u32::try_from(extent).map_err(|_| exr::error::Error::Invalid("a side beyond 32 bits".into()));
    let channels = image.layer_data.channel_data.list.into_iter();
    let channels = channels.map(|channel| (channel.name.to_string(), channel.sample_data.values_as_f32().collect()));
    Ok(([side(size.width())?, side(size.height())?], channels.collect()))
}

fn io_error(error: exr::error::Error) -> std::io::Error {
    match error {
        exr::error::Error::Io(error) => error,
        other => std::io::Error::other(other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bit_survives() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.exr");
        let names =
            ["position.X", "position.Y", "position.Z", "normal.X", "uv.U", "height.H", "visibility.V", "steps.S", "lod.L", "H"];
        let values =
            [f32::INFINITY, 0.0, -0.0, 1.0, f32::MIN_POSITIVE, 1e-42, f32::MAX, -1.5, 0.1, 1.0 / 3.0, f32::NEG_INFINITY, 7.0];
        for size in [[4, 3], [1, 12], [12, 1]] {
            let channels: Channels = names.iter().map(|&name| (name.to_owned(), values.to_vec())).collect();
            write(&path, size, channels.clone()).unwrap();
            let (read_size, read) = super::read(&path).unwrap();
            assert_eq!(read_size, size);
            assert_eq!(read.keys().collect::<Vec<_>>(), channels.keys().collect::<Vec<_>>());
            for (name, written) in &channels {
                let bits = |values: &[f32]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
                assert_eq!(bits(&read[name]), bits(written), "{name}");
            }
        }
    }

    #[test]
    fn the_same_channels_give_the_same_bytes() {
        let directory = tempfile::tempdir().unwrap();
        let [a, b] = ["a.exr", "b.exr"].map(|name| {
            let path = directory.path().join(name);
            let values: Vec<f32> = (0..300 * 200).map(|i| (i as f32 * 0.01).sin()).collect();
            write(&path, [300, 200], [("H".to_owned(), values)].into()).unwrap();
            std::fs::read(path).unwrap()
        });
        assert!(a == b);
    }
}
