//! ZIP (APPNOTE 6.3.10) as far as 3MF needs it: stored and deflated files, with ZIP64, found through the central
//! directory. A third of the size of the `zip` crate's reader, which matters for a download.
use super::checksum::Checksum;
use flate2::bufread::DeflateDecoder;
use std::io::{self, Read};

pub(super) const END: &[u8] = b"PK\x05\x06";
const END_LENGTH: usize = 22;
const END_64: &[u8] = b"PK\x06\x06";
const END_64_LOCATOR: &[u8] = b"PK\x06\x07";
const END_64_LOCATOR_LENGTH: usize = 20;
pub(super) const ENTRY: &[u8] = b"PK\x01\x02";
const ENTRY_LENGTH: usize = 46;
pub(super) const FILE: &[u8] = b"PK\x03\x04";
const FILE_LENGTH: usize = 30;
/// Header of the extra field that holds the 64-bit values of an entry.
pub(super) const EXTRA_64: u16 = 1;
/// Stands in a 32-bit field for a value in the ZIP64 one.
pub(super) const ELSEWHERE: u64 = 0xffff_ffff;

const STORED: u16 = 0;
pub(super) const DEFLATED: u16 = 8;

/// A file in the archive.
struct Entry {
    name: String,
    is_encrypted: bool,
    method: u16,
    checksum: u32,
    packed_length: u64,
    /// Of the file's own header, from the start of the archive.
    offset: u64,
}

pub(super) struct Archive<'a> {
    bytes: &'a [u8],
    entries: Vec<Entry>,
}

impl<'a> Archive<'a> {
    /// # Errors
    /// If and only if the archive ends without a directory, or the directory is cut; says what is missing.
    pub fn open(bytes: &'a [u8]) -> Result<Archive<'a>, &'static str> {
        let end = find_end(bytes).ok_or("one without an end of its directory")?;
        let start = directory_start(bytes, end).ok_or("one without the start of its directory")?;
        let mut rest = usize::try_from(start).ok().and_then(|start| bytes.get(start..end));
        let mut entries = Vec::new();
        while let Some(record) = rest.filter(|rest| rest.starts_with(ENTRY)) {
            let (entry, length) = read_entry(record).ok_or("one whose directory is cut")?;
            entries.push(entry);
            rest = record.get(length..);
        }
        if rest.is_none() {
            return Err("one whose directory lies outside of it");
        }
        Ok(Archive { bytes, entries })
    }

    /// Names of the files, in the order of their places.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().map(|entry| entry.name.as_str())
    }

    /// The content of the file at `place`; reading it fails at its end if its checksum is wrong.
    ///
    /// # Errors
    /// If and only if the file is encrypted, lies outside of the archive, or is packed in another way than stored or
    /// deflated; says which.
    pub fn unpack(&self, place: usize) -> Result<Box<dyn Read + 'a>, String> {
        let entry = &self.entries[place];
        if entry.is_encrypted {
            return Err("an encrypted one".to_owned());
        }
        let packed = self.packed(entry).ok_or("one that lies outside of the archive")?;
        let content: Box<dyn Read> = match entry.method {
            STORED => Box::new(packed),
            DEFLATED => Box::new(DeflateDecoder::new(packed)),
            other => return Err(format!("one packed by method {other}")),
        };
        Ok(Box::new(Checked { content, expected: entry.checksum, found: Checksum::EMPTY }))
    }

    fn packed(&self, entry: &Entry) -> Option<&'a [u8]> {
        let header = self.bytes.get(usize::try_from(entry.offset).ok()?..)?;
        let start = FILE_LENGTH + u16_at(header, 26)? as usize + u16_at(header, 28)? as usize;
        let end = start.checked_add(usize::try_from(entry.packed_length).ok()?)?;
        header.starts_with(FILE).then(|| header.get(start..end)).flatten()
    }
}

fn u16_at(bytes: &[u8], at: usize) -> Option<u16> {
    Some(u16::from_le_bytes(*bytes.get(at..)?.first_chunk()?))
}

fn u32_at(bytes: &[u8], at: usize) -> Option<u64> {
    Some(u64::from(u32::from_le_bytes(*bytes.get(at..)?.first_chunk()?)))
}

fn u64_at(bytes: &[u8], at: usize) -> Option<u64> {
    Some(u64::from_le_bytes(*bytes.get(at..)?.first_chunk()?))
}

/// Where the end record begins: the last one whose comment fits what follows.
fn find_end(bytes: &[u8]) -> Option<usize> {
    let last = bytes.len().checked_sub(END_LENGTH)?;
    let first = last.saturating_sub(usize::from(u16::MAX));
    (first..=last).rev().find(|&at| {
        bytes[at..].starts_with(END)
            && u16_at(bytes, at + 20).is_some_and(|comment| at + END_LENGTH + comment as usize <= bytes.len())
    })
}

fn directory_start(bytes: &[u8], end: usize) -> Option<u64> {
    let start = u32_at(bytes, end + 16)?;
    if start != ELSEWHERE {
        return Some(start);
    }
    let locator = &bytes[end.checked_sub(END_64_LOCATOR_LENGTH)?..];
    let end_64 = bytes.get(usize::try_from(u64_at(locator, 8)?).ok()?..)?;
    (locator.starts_with(END_64_LOCATOR) && end_64.starts_with(END_64)).then(|| u64_at(end_64, 48)).flatten()
}

/// The entry that `record` begins with, and the length of its record.
fn read_entry(record: &[u8]) -> Option<(Entry, usize)> {
    let [name, extra, comment] = [28, 30, 32].map(|at| u16_at(record, at).map(usize::from));
    let extra_start = ENTRY_LENGTH + name?;
    let comment_start = extra_start + extra?;
    let [mut unpacked_length, mut packed_length, mut offset] =
        [u32_at(record, 24)?, u32_at(record, 20)?, u32_at(record, 42)?];
    let mut wide = extra_64(record.get(extra_start..comment_start)?);
    // The 64-bit field holds only those that do not fit, in this order.
    for value in [&mut unpacked_length, &mut packed_length, &mut offset] {
        if *value == ELSEWHERE {
            *value = u64_at(wide, 0)?;
            wide = &wide[8..];
        }
    }
    let entry = Entry {
        name: String::from_utf8_lossy(record.get(ENTRY_LENGTH..extra_start)?).into_owned(),
        is_encrypted: u16_at(record, 8)? & 1 == 1,
        method: u16_at(record, 10)?,
        checksum: u32_at(record, 16)? as u32,
        packed_length,
        offset,
    };
    Some((entry, comment_start + comment?))
}

/// The ZIP64 values among the extra fields of an entry; empty if there are none.
fn extra_64(mut fields: &[u8]) -> &[u8] {
    while let (Some(kind), Some(length)) = (u16_at(fields, 0), u16_at(fields, 2)) {
        let Some(value) = fields.get(4..4 + length as usize) else { break };
        if kind == EXTRA_64 {
            return value;
        }
        fields = &fields[4 + length as usize..];
    }
    &[]
}

/// A file that fails at its end if its CRC-32 is not as expected.
struct Checked<R> {
    content: R,
    expected: u32,
    found: Checksum,
}

impl<R: Read> Read for Checked<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = self.content.read(buffer)?;
        self.found.update(&buffer[..length]);
        if length == 0 && !buffer.is_empty() && self.found.value() != self.expected {
            return Err(io::Error::other("a file whose checksum is right"));
        }
        Ok(length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Cursor, Write};
    use zip::{CompressionMethod, ZipWriter, write::SimpleFileOptions};

    const TEXT: &[u8] = b"some text, some text, some text";

    fn archive(options: SimpleFileOptions) -> Vec<u8> {
        let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
        writer.set_comment("PK\x05\x06 is no end here").unwrap();
        for name in ["a.txt", "folder/b.txt"] {
            writer.start_file(name, options).unwrap();
            writer.write_all(TEXT).unwrap();
        }
        writer.finish().unwrap().into_inner()
    }

    fn content(archive: &[u8], place: usize) -> io::Result<Vec<u8>> {
        let mut content = Vec::new();
        Archive::open(archive).unwrap().unpack(place).map_err(io::Error::other)?.read_to_end(&mut content)?;
        Ok(content)
    }

    #[test]
    fn stored_deflated_and_large_files_are_unpacked() {
        let stored = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
        for options in [stored, SimpleFileOptions::default(), stored.large_file(true)] {
            let bytes = archive(options);
            let names: Vec<String> = Archive::open(&bytes).unwrap().names().map(str::to_owned).collect();
            assert_eq!(names, ["a.txt", "folder/b.txt"]);
            assert_eq!(content(&bytes, 1).unwrap(), TEXT);
        }
    }

    #[test]
    fn values_that_do_not_fit_stand_in_the_wide_field() {
        let mut record = ENTRY.to_vec();
        record.resize(ENTRY_LENGTH, 0);
        record[20..28].fill(0xff);
        record[30..32].copy_from_slice(&24_u16.to_le_bytes());
        record[42..46].copy_from_slice(&7_u32.to_le_bytes());
        record.extend([9, 9, 0, 0, 1, 0, 16, 0]);
        record.extend((1_u64 << 33).to_le_bytes());
        record.extend((1_u64 << 32).to_le_bytes());
        let (entry, length) = read_entry(&record).unwrap();
        assert_eq!((entry.packed_length, entry.offset, length), (1 << 32, 7, record.len()));
    }

    #[test]
    fn a_changed_byte_breaks_the_checksum() {
        let mut bytes = archive(SimpleFileOptions::default().compression_method(CompressionMethod::Stored));
        let at = bytes.windows(TEXT.len()).position(|window| window == TEXT).unwrap();
        bytes[at] ^= 1;
        assert_eq!(content(&bytes, 0).unwrap_err().to_string(), "a file whose checksum is right");
        assert_eq!(content(&bytes, 1).unwrap(), TEXT);
    }
}
