//! ZIP (APPNOTE 6.3.10) as far as writing 3MF needs it: deflated files one after the other. Each is packed in memory before it is
//! written, so that its lengths stand before it and `out` need not be gone back in.
use super::archive::{DEFLATED, ELSEWHERE, END, ENTRY, EXTRA_64, FILE};
use super::checksum::Checksum;
use flate2::Compression;
use flate2::write::DeflateEncoder;
use std::io::{self, Write};

/// 1980-01-01, the first day that ZIP knows: the same content gives the same bytes.
const NO_DATE: u16 = 0x21;
const PLAIN_VERSION: u16 = 20;
const WIDE_VERSION: u16 = 45;

/// An archive that is being written.
pub(in crate::io) struct Packer<W> {
    out: W,
    /// Bytes written so far.
    length: u64,
    /// The records of the files, which the archive ends with.
    directory: Vec<u8>,
    files: u16,
}

impl<W: Write> Packer<W> {
    pub fn new(out: W) -> Packer<W> {
        Packer { out, length: 0, directory: Vec::new(), files: 0 }
    }

    /// Adds a file whose content `write` writes.
    ///
    /// # Errors
    /// If and only if `write` fails, `out` refuses to be written to, or the archive would be larger than 4 GiB.
    pub fn file(
        &mut self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut content = Packing::default();
        write(&mut content)?;
        let (checksum, unpacked_length) = (content.checksum.value(), content.unpacked_length);
        let packed = content.packed.finish()?;
        self.add(name, checksum, unpacked_length, &packed)
    }

    fn add(&mut self, name: &str, checksum: u32, unpacked_length: u64, packed: &[u8]) -> io::Result<()> {
        let packed_length = packed.len() as u64;
        let offset = narrow(self.length)?;
        let is_wide = unpacked_length.max(packed_length) >= ELSEWHERE;
        let shown = [packed_length, unpacked_length].map(|n| if is_wide { !0 } else { n as u32 });
        let mut extra = Vec::new();
        if is_wide {
            extra.extend([EXTRA_64, 16].map(u16::to_le_bytes).as_flattened());
            extra.extend([unpacked_length, packed_length].map(u64::to_le_bytes).as_flattened());
        }
        let version = if is_wide { WIDE_VERSION } else { PLAIN_VERSION };
        // What the file's own header and its record in the directory have in common.
        let mut common = [version, 0, DEFLATED, 0, NO_DATE].map(u16::to_le_bytes).as_flattened().to_vec();
        common.extend([checksum, shown[0], shown[1]].map(u32::to_le_bytes).as_flattened());
        common.extend([name.len() as u16, extra.len() as u16].map(u16::to_le_bytes).as_flattened());
        let header = [FILE, &common, name.as_bytes(), &extra].concat();
        self.write(&header)?;
        self.write(packed)?;
        self.directory.extend([ENTRY, &version.to_le_bytes(), &common].concat());
        // No comment, the first disk, and no attributes, which take four bytes more.
        self.directory.extend([0; 10]);
        self.directory.extend(offset.to_le_bytes());
        self.directory.extend([name.as_bytes(), &extra].concat());
        self.files += 1;
        Ok(())
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.length += bytes.len() as u64;
        self.out.write_all(bytes)
    }

    /// Ends the archive.
    ///
    /// # Errors
    /// As [`Packer::file`].
    pub fn finish(mut self) -> io::Result<()> {
        let (start, length) = (narrow(self.length)?, narrow(self.directory.len() as u64)?);
        let directory = std::mem::take(&mut self.directory);
        self.write(&directory)?;
        let mut end = [0, 0, self.files, self.files].map(u16::to_le_bytes).as_flattened().to_vec();
        end.extend([length, start].map(u32::to_le_bytes).as_flattened());
        self.write(&[END, &end, &[0; 2]].concat())?;
        self.out.flush()
    }
}

fn narrow(length: u64) -> io::Result<u32> {
    let refused = |_| io::Error::new(io::ErrorKind::FileTooLarge, "the archive would be larger than 4 GiB");
    u32::try_from(length).map_err(refused)
}

/// A file as it is packed.
struct Packing {
    packed: DeflateEncoder<Vec<u8>>,
    checksum: Checksum,
    unpacked_length: u64,
}

impl Default for Packing {
    fn default() -> Packing {
        let packed = DeflateEncoder::new(Vec::new(), Compression::default());
        Packing { packed, checksum: Checksum::EMPTY, unpacked_length: 0 }
    }
}

impl Write for Packing {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let length = self.packed.write(bytes)?;
        self.checksum.update(&bytes[..length]);
        self.unpacked_length += length as u64;
        Ok(length)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.packed.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::threemf::archive::Archive;
    use std::io::{Cursor, Read};

    const TEXT: &[u8] = b"some text, some text, some text";

    #[test]
    fn files_are_read_back_by_us_and_by_others() {
        let mut bytes = Vec::new();
        let mut packer = Packer::new(&mut bytes);
        packer.file("a.txt", |out| out.write_all(TEXT)).unwrap();
        packer.file("folder/none.txt", |_| Ok(())).unwrap();
        packer.finish().unwrap();
        let ours = Archive::open(&bytes).unwrap();
        let mut theirs = zip::ZipArchive::new(Cursor::new(&bytes)).unwrap();
        assert_eq!((ours.names().count(), theirs.len()), (2, 2));
        for (place, (name, content)) in [("a.txt", TEXT), ("folder/none.txt", b"")].into_iter().enumerate() {
            let (mut by_us, mut by_them) = (Vec::new(), Vec::new());
            ours.unpack(place).unwrap().read_to_end(&mut by_us).unwrap();
            let mut file = theirs.by_index(place).unwrap();
            file.read_to_end(&mut by_them).unwrap();
            assert_eq!((ours.names().nth(place), file.name()), (Some(name), name));
            assert_eq!((by_us.as_slice(), by_them.as_slice()), (content, content));
        }
    }

    #[test]
    fn lengths_beyond_4_gib_stand_in_the_wide_field() {
        let mut bytes = Vec::new();
        let mut packer = Packer::new(&mut bytes);
        packer.add("long", 7, 5 << 32, b"packed").unwrap();
        packer.finish().unwrap();
        assert_eq!(Archive::open(&bytes).unwrap().names().collect::<Vec<_>>(), ["long"]);
        let mut theirs = zip::ZipArchive::new(Cursor::new(&bytes)).unwrap();
        let file = theirs.by_index_raw(0).unwrap();
        assert_eq!((file.size(), file.compressed_size(), file.crc32()), (5 << 32, 6, 7));
    }
}
