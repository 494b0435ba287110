//! Numbers out of buffers, each access checked: a file may say anything.

use ::gltf as format;
use format::accessor::sparse::IndexType;
use format::accessor::{Accessor, DataType, Dimensions};
use format::buffer::{Source, View};
use glam::Vec4;

use crate::mesh::Unfit;

/// The buffers of a file.
pub(super) struct Buffers(Vec<Vec<u8>>);

impl Buffers {
    /// Reads them all: from the file itself, from `data:` addresses, or from other files through `read`.
    pub fn load(file: &format::Gltf, read: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>) -> Result<Self, Unfit> {
        let mut buffers = Vec::new();
        for buffer in file.buffers() {
            let bytes = match buffer.source() {
                Source::Bin => file.blob.clone().ok_or_else(|| Unfit("lacks its binary part: save it anew".to_owned()))?,
                Source::Uri(uri) => match uri.split_once(':') {
                    Some(("data", data)) => data
                        .split_once(";base64,")
                        .and_then(|(_, text)| base64(text))
                        .ok_or_else(|| Unfit(format!("has a damaged buffer {}, not in base64: save it anew", buffer.index())))?,
                    Some((scheme, _)) if scheme.len() > 1 => {
                        let problem =
                            format!("has a buffer at a {scheme} address, and only files are read: save it as one .glb file");
                        return Err(Unfit(problem));
                    }
                    _ => read(&percent_decoded(uri)).map_err(Unfit)?,
                },
            };
            if bytes.len() < buffer.length() {
                let (index, length) = (buffer.index(), buffer.length());
                return Err(Unfit(format!("has {} of the {length} bytes of its buffer {index}: save it anew", bytes.len())));
            }
            buffers.push(bytes);
        }
        Ok(Self(buffers))
    }

    /// Vectors of this many components, the rest 0; integers as numbers from −1 to 1 or 0 to 1 where the file says so.
    pub fn vectors(&self, accessor: &Accessor, width: usize) -> Result<Vec<Vec4>, Unfit> {
        let components = match accessor.dimensions() {
            Dimensions::Scalar => 1,
            Dimensions::Vec2 => 2,
            Dimensions::Vec3 => 3,
            Dimensions::Vec4 => 4,
            _ => 0,
        };
        if components != width {
            let index = accessor.index();
            return Err(Unfit(format!("has an accessor {index} of another kind than it is used as: save it anew")));
        }
        let values = self.numbers(accessor, width)?;
        let vector = |value: &[f32]| Vec4::from_array(std::array::from_fn(|i| value.get(i).copied().unwrap_or(0.0)));
        Ok(values.chunks_exact(width).map(vector).collect())
    }

    /// 4×4 matrices, column by column.
    pub fn matrices(&self, accessor: &Accessor) -> Result<Vec<glam::Mat4>, Unfit> {
        if accessor.dimensions() != Dimensions::Mat4 || accessor.data_type() != DataType::F32 {
            let index = accessor.index();
            return Err(Unfit(format!("has an accessor {index} of another kind than it is used as: save it anew")));
        }
        Ok(self.numbers(accessor, 16)?.chunks_exact(16).map(glam::Mat4::from_cols_slice).collect())
    }

    /// Places of vertices.
    pub fn indices(&self, accessor: &Accessor) -> Result<Vec<u32>, Unfit> {
        let width = match (accessor.dimensions(), accessor.data_type()) {
            (Dimensions::Scalar, DataType::U8) => 1,
            (Dimensions::Scalar, DataType::U16) => 2,
            (Dimensions::Scalar, DataType::U32) => 4,
            _ => return Err(Unfit("has indices that are no whole numbers: save it anew".to_owned())),
        };
        if accessor.sparse().is_some() {
            return Err(Unfit("has sparse indices, which are not supported here: save it plainly".to_owned()));
        }
        let Some(view) = accessor.view() else { return Ok(Vec::new()) };
        self.elements(&view, accessor.offset(), accessor.count(), width).map(|elements| elements.map(unsigned).collect())
    }

    /// All components in a row, sparse ones put in their places.
    fn numbers(&self, accessor: &Accessor, components: usize) -> Result<Vec<f32>, Unfit> {
        let data_type = accessor.data_type();
        let (size, normalized) = (data_type.size(), accessor.normalized());
        let decode = |element: &[u8]| -> Vec<f32> {
            element.chunks_exact(size).map(|bytes| number(bytes, data_type, normalized)).collect()
        };
        let mut values = match accessor.view() {
            Some(view) => {
                self.elements(&view, accessor.offset(), accessor.count(), size * components)?.flat_map(decode).collect()
            }
            // A view that is absent is full of zeros; their number is bounded by what any use of them allows.
            None if accessor.count() <= 3 * crate::mesh::TRIANGLES_MAX => vec![0.0; accessor.count() * components],
            None => return Err(Unfit(format!("has an accessor of {} values and no data: save it anew", accessor.count()))),
        };
        if let Some(sparse) = accessor.sparse() {
            let width = match sparse.indices().index_type() {
                IndexType::U8 => 1,
                IndexType::U16 => 2,
                IndexType::U32 => 4,
            };
            let places = self.elements(&sparse.indices().view(), sparse.indices().offset(), sparse.count(), width)?;
            let own = self.elements(&sparse.values().view(), sparse.values().offset(), sparse.count(), size * components)?;
            for (place, element) in places.map(unsigned).zip(own) {
                let start = place as usize * components;
                let target = values.get_mut(start..start + components);
                let target =
                    target.ok_or_else(|| Unfit(format!("has a sparse value {place} beyond its accessor: save it anew")))?;
                target.copy_from_slice(&decode(element));
            }
        }
        Ok(values)
    }

    /// The bytes of each element of a view.
    fn elements<'a>(
        &'a self,
        view: &View,
        offset: usize,
        count: usize,
        width: usize,
    ) -> Result<impl Iterator<Item = &'a [u8]> + use<'a>, Unfit> {
        let stride = view.stride().unwrap_or(width).max(1);
        let whole = self.0.get(view.buffer().index()).and_then(|bytes| bytes.get(view.offset()..)?.get(..view.length()));
        let bytes = whole.and_then(|bytes| bytes.get(offset..)).unwrap_or_default();
        let fits = match count.checked_sub(1) {
            None => true,
            Some(last) => {
                last.checked_mul(stride).and_then(|start| start.checked_add(width)).is_some_and(|end| end <= bytes.len())
            }
        };
        if !fits {
            let index = view.index();
            return Err(Unfit(format!("has {count} values where its buffer view {index} has not that many bytes: save it anew")));
        }
        Ok((0..count).map(move |i| &bytes[i * stride..i * stride + width]))
    }
}

fn unsigned(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |value, &byte| value << 8 | u32::from(byte))
}

/// One component. Normalised integers as the format defines them.
fn number(bytes: &[u8], data_type: DataType, normalized: bool) -> f32 {
    let bits = unsigned(bytes);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        clippy::cast_precision_loss,
        reason = "that is what they are"
    )]
    let (value, largest) = match data_type {
        DataType::F32 => return f32::from_bits(bits),
        DataType::I8 => (f32::from(bits as u8 as i8), 127.0),
        DataType::U8 => (bits as f32, 255.0),
        DataType::I16 => (f32::from(bits as u16 as i16), 32767.0),
        DataType::U16 => (bits as f32, 65535.0),
        DataType::U32 => (bits as f32, 4_294_967_295.0),
    };
    if normalized { (value / largest).max(-1.0) } else { value }
}

/// Bytes of text in base64 (RFC 4648), padded or not.
fn base64(text: &str) -> Option<Vec<u8>> {
    let text = text.trim_end_matches('=');
    let mut bytes = Vec::with_capacity(text.len() * 3 / 4);
    let (mut bits, mut count) = (0_u32, 0);
    for letter in text.bytes() {
        let six = match letter {
            b'A'..=b'Z' => letter - b'A',
            b'a'..=b'z' => letter - b'a' + 26,
            b'0'..=b'9' => letter - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            _ => return None,
        };
        bits = bits << 6 | u32::from(six);
        count += 6;
        if count >= 8 {
            count -= 8;
            #[expect(clippy::cast_possible_truncation, reason = "the lowest eight that are left")]
            bytes.push((bits >> count) as u8);
        }
    }
    Some(bytes)
}

/// `%20` and its like as the bytes that they stand for.
fn percent_decoded(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, others)) = rest.split_first() {
        let code = (first == b'%').then(|| others.get(..2)).flatten();
        match code.and_then(|code| u8::from_str_radix(std::str::from_utf8(code).ok()?, 16).ok()) {
            Some(byte) => (bytes.push(byte), rest = &others[2..]).1,
            None => (bytes.push(first), rest = others).1,
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_decoded() {
        assert_eq!(base64("TWFu").unwrap(), b"Man");
        assert_eq!(base64("TWE=").unwrap(), b"Ma");
        assert_eq!(base64("TQ").unwrap(), b"M");
        assert_eq!(base64("+/8A").unwrap(), [0xfb, 0xff, 0x00]);
        assert_eq!(base64("T*"), None);
        assert_eq!(percent_decoded("a%20b%C3%A9%zz%"), "a bé%zz%");
    }

    #[test]
    fn integers_are_normalised_as_the_format_says() {
        assert_eq!(number(&[0x81], DataType::I8, true), -1.0);
        assert_eq!(number(&[0x80], DataType::I8, true), -1.0);
        assert_eq!(number(&[0xff, 0xff], DataType::U16, true), 1.0);
        assert_eq!(number(&[0xfe, 0xff], DataType::I16, false), -2.0);
        assert_eq!(number(&1.5_f32.to_le_bytes(), DataType::F32, false), 1.5);
    }
}
