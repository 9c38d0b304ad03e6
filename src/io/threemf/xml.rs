use quick_xml::Reader;
use quick_xml::events::Event;
use std::io::BufRead;

/// How deep elements may nest: 3MF and its extensions need about ten. Each that is open takes memory.
const DEEPEST: usize = 256;

/// The events of an XML file, with a bound on how deep elements nest.
pub(super) struct Events<R> {
    reader: Reader<R>,
    depth: usize,
}

impl<R: BufRead> Events<R> {
    pub fn new(content: R) -> Events<R> {
        Events { reader: Reader::from_reader(content), depth: 0 }
    }

    /// Bytes of the file that have been read.
    pub fn position(&self) -> usize {
        self.reader.buffer_position() as usize
    }

    /// The next event, or what was expected instead of what the file has.
    pub fn next<'b>(&mut self, buffer: &'b mut Vec<u8>) -> Result<Event<'b>, String> {
        buffer.clear();
        let event = self.reader.read_event_into(buffer);
        let event = event.map_err(|cause| format!("well-formed XML, found: {cause}"))?;
        match &event {
            Event::Start(_) if self.depth == DEEPEST => {
                return Err(format!("elements nested at most {DEEPEST} deep, found more"));
            }
            Event::Start(_) => self.depth += 1,
            // The reader refuses ends that nothing began.
            Event::End(_) => self.depth -= 1,
            _ => {}
        }
        Ok(event)
    }
}
