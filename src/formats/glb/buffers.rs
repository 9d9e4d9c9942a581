//! The numbers in a glTF's buffers, which lie in the file itself, in its text, or in its folder.

use super::document::Accessor;
use super::{GltfReader, PACKED, unsigned};
use crate::formats::error::{FormatError, quoted_excerpt};
use crate::formats::include;
use crate::limits;
use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use std::borrow::Cow;

impl<'a> GltfReader<'a> {
    pub(super) fn accessor(&self, index: usize) -> Result<&'a Accessor, FormatError> {
        let accessors = &self.document.accessors;
        let expected = || format!("an accessor below {}", accessors.len());
        accessors.get(index).ok_or_else(|| self.bad(&expected(), index.to_string()))
    }

    pub(super) fn component(&self, code: u64) -> Result<Component, FormatError> {
        Component::from_code(code)
            .ok_or_else(|| self.bad("a component type from 5120 to 5126", code.to_string()))
    }

    /// The bytes of every element, one after the other, with what a sparse accessor replaces.
    ///
    /// - `packed`: the compression that the primitive has, if the bytes are nowhere else
    pub(super) fn elements(
        &mut self,
        accessor: &Accessor,
        size: usize,
        packed: Option<&String>,
    ) -> Result<Vec<u8>, FormatError> {
        let count = accessor.count;
        self.source.within(&limits::CORNERS, count)?;
        let mut all = match (accessor.buffer_view, &accessor.sparse, packed) {
            (Some(view), ..) => self.packed(view, accessor.byte_offset, size, count)?,
            (None, Some(_), _) => vec![0; size * count],
            (None, None, Some(packed)) => {
                return Err(self
                    .bad("uncompressed buffers", format!("{}, which is not read", quoted_excerpt(packed))));
            }
            (None, None, None) => return Err(self.bad("uncompressed buffers", "an accessor without one")),
        };
        if let Some(sparse) = &accessor.sparse {
            let (indices, values) = (&sparse.indices, &sparse.values);
            let wide = self.component(indices.component_type)?.size();
            let replaced = sparse.count.min(count);
            let places = self.packed(indices.buffer_view, indices.byte_offset, wide, replaced)?;
            let values = self.packed(values.buffer_view, values.byte_offset, size, replaced)?;
            for (place, value) in places.chunks_exact(wide).map(unsigned).zip(values.chunks_exact(size)) {
                let Some(element) = all.get_mut(place.saturating_mul(size)..).and_then(|e| e.get_mut(..size))
                else {
                    return Err(self.bad(&format!("a sparse index below {count}"), place.to_string()));
                };
                element.copy_from_slice(value);
            }
        }
        Ok(all)
    }

    /// The bytes of `count` elements of a view, all of them known to lie in the buffer.
    fn packed(
        &mut self,
        view: usize,
        offset: usize,
        size: usize,
        count: usize,
    ) -> Result<Vec<u8>, FormatError> {
        if count == 0 {
            return Ok(Vec::new());
        }
        let document = self.document;
        let Some(view) = document.buffer_views.get(view) else {
            let expected = format!("a buffer view below {}", document.buffer_views.len());
            return Err(self.bad(&expected, view.to_string()));
        };
        let stride = view.byte_stride.unwrap_or(size).max(size);
        let buffer = self.buffer(view.buffer)?;
        let end = view.byte_offset.checked_add(view.byte_length);
        let bytes = end.and_then(|end| buffer.get(view.byte_offset..end)).and_then(|v| v.get(offset..));
        let needed = (count - 1).checked_mul(stride).and_then(|n| n.checked_add(size));
        match (bytes, needed) {
            (Some(bytes), Some(needed)) if needed <= bytes.len() => {
                Ok((0..count).flat_map(|i| &bytes[i * stride..i * stride + size]).copied().collect())
            }
            _ => {
                let packed = view.extensions.keys().find(|name| name.ends_with(PACKED));
                let found = match packed.filter(|_| buffer.is_empty()) {
                    Some(packed) => format!("{}, which is not read", quoted_excerpt(packed)),
                    None => format!("{} bytes", buffer.len()),
                };
                Err(self.bad(&format!("a buffer that holds {count} elements"), found))
            }
        }
    }

    /// The bytes of a buffer, fetched when they are first needed.
    fn buffer(&mut self, index: usize) -> Result<&[u8], FormatError> {
        if !self.buffers.contains_key(&index) {
            let Some(buffer) = self.document.buffers.get(index) else {
                let expected = format!("a buffer below {}", self.document.buffers.len());
                return Err(self.bad(&expected, index.to_string()));
            };
            let bytes = match &buffer.uri {
                Some(uri) => self.fetch(uri)?.into(),
                None if index == 0 => Cow::Borrowed(self.inside.unwrap_or_default()),
                None => Cow::Borrowed(&[][..]),
            };
            self.fetched += bytes.len();
            self.source.within(&limits::FILE, self.fetched)?;
            self.buffers.insert(index, bytes);
        }
        Ok(self.buffers.get(&index).map_or(&[], |b| b))
    }

    fn fetch(&self, uri: &str) -> Result<Vec<u8>, FormatError> {
        /// Some writers leave the signs at the end out.
        const BASE64: GeneralPurpose = GeneralPurpose::new(
            &STANDARD,
            GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
        );
        if let Some(data) = uri.strip_prefix("data:") {
            let (_, data) = data.split_once(";base64,").unwrap_or(("", ""));
            return BASE64.decode(data).map_err(|error| self.bad("a buffer in base64", error.to_string()));
        }
        include::fetch(self.source, &unescaped(uri))
            .ok_or_else(|| self.bad("a buffer in the file's own folder", quoted_excerpt(uri)))?
    }
}

/// Type of a stored number.
#[derive(Debug, Clone, Copy)]
pub(super) enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    /// By the number that the format has for it.
    pub(super) fn from_code(code: u64) -> Option<Component> {
        Some(match code {
            5120 => Component::I8,
            5121 => Component::U8,
            5122 => Component::I16,
            5123 => Component::U16,
            5125 => Component::U32,
            5126 => Component::F32,
            _ => return None,
        })
    }

    pub(super) fn size(self) -> usize {
        match self {
            Component::I8 | Component::U8 => 1,
            Component::I16 | Component::U16 => 2,
            Component::U32 | Component::F32 => 4,
        }
    }

    /// A coordinate; quantised ones (KHR_mesh_quantization) are whole numbers, or, normalised, parts of the
    /// largest.
    pub(super) fn float(self, normalised: bool, bytes: &[u8]) -> f64 {
        let at = |i: usize| bytes.get(i).copied().unwrap_or_default();
        let (value, most) = match self {
            Component::F32 => return f32::from_le_bytes([0, 1, 2, 3].map(at)).into(),
            Component::I8 => (i8::from_le_bytes([at(0)]).into(), f64::from(i8::MAX)),
            Component::U8 => (at(0).into(), f64::from(u8::MAX)),
            Component::I16 => (i16::from_le_bytes([0, 1].map(at)).into(), f64::from(i16::MAX)),
            Component::U16 => (u16::from_le_bytes([0, 1].map(at)).into(), f64::from(u16::MAX)),
            Component::U32 => (u32::from_le_bytes([0, 1, 2, 3].map(at)).into(), f64::from(u32::MAX)),
        };
        if normalised { f64::max(value / most, -1.0) } else { value }
    }
}

/// The URI with `%20` and its like as the bytes they stand for.
fn unescaped(uri: &str) -> String {
    let mut parts = uri.split('%');
    let mut bytes = parts.next().unwrap_or_default().as_bytes().to_vec();
    for part in parts {
        match part.get(..2).and_then(|hex| u8::from_str_radix(hex, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                bytes.extend(&part.as_bytes()[2..]);
            }
            None => {
                bytes.push(b'%');
                bytes.extend(part.as_bytes());
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}
