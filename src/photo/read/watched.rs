//! Bytes that tell how far a decoder has come, and end when the work is to stop.

use std::cell::Cell;
use std::ops::ControlFlow;

use zune_core::bytestream::{ZByteIoError, ZByteReaderTrait, ZSeekFrom};

use super::Progress;

/// Reports about this often over a whole file.
const REPORTS: usize = 100;

/// A cursor over bytes for a decoder that offers no progress of its own.
pub(super) struct Watched<'a> {
    bytes: &'a [u8],
    position: usize,
    next_report: usize,
    length: usize,
    progress: Progress<'a>,
    is_cancelled: &'a Cell<bool>,
}

impl<'a> Watched<'a> {
    /// Watches `bytes`; `is_cancelled` becomes true when `progress` asks to stop.
    pub fn new(bytes: &'a [u8], progress: Progress<'a>, is_cancelled: &'a Cell<bool>) -> Self {
        Self { bytes, position: 0, next_report: 0, length: bytes.len(), progress, is_cancelled }
    }

    fn rest(&self) -> &'a [u8] {
        &self.bytes[self.position.min(self.bytes.len())..]
    }

    fn advance(&mut self, count: usize) {
        self.position += count;
        if self.position >= self.next_report {
            self.report();
        }
    }

    #[cold]
    fn report(&mut self) {
        self.next_report = self.position + self.length / REPORTS + 1;
        let fraction = self.position.min(self.length) as f32 / self.length.max(1) as f32;
        if (self.progress)(fraction) == ControlFlow::Break(()) {
            self.is_cancelled.set(true);
            self.bytes = &[];
            self.next_report = usize::MAX;
        }
    }
}

impl ZByteReaderTrait for Watched<'_> {
    #[inline]
    fn read_byte_no_error(&mut self) -> u8 {
        let byte = self.bytes.get(self.position).copied().unwrap_or(0);
        self.advance(1);
        byte
    }

    #[inline]
    fn read_exact_bytes(&mut self, buf: &mut [u8]) -> Result<(), ZByteIoError> {
        self.peek_exact_bytes(buf)?;
        self.advance(buf.len());
        Ok(())
    }

    fn read_bytes(&mut self, buf: &mut [u8]) -> Result<usize, ZByteIoError> {
        let count = self.peek_bytes(buf)?;
        self.advance(count);
        Ok(count)
    }

    fn peek_bytes(&mut self, buf: &mut [u8]) -> Result<usize, ZByteIoError> {
        let rest = self.rest();
        let count = buf.len().min(rest.len());
        buf[..count].copy_from_slice(&rest[..count]);
        Ok(count)
    }

    #[inline]
    fn peek_exact_bytes(&mut self, buf: &mut [u8]) -> Result<(), ZByteIoError> {
        let rest = self.rest();
        let wanted = rest.get(..buf.len()).ok_or(ZByteIoError::NotEnoughBytes(rest.len(), buf.len()))?;
        buf.copy_from_slice(wanted);
        Ok(())
    }

    fn z_seek(&mut self, from: ZSeekFrom) -> Result<u64, ZByteIoError> {
        let (base, offset) = match from {
            ZSeekFrom::Start(position) => (0, i64::try_from(position).unwrap_or(i64::MAX)),
            ZSeekFrom::End(offset) => (self.bytes.len(), offset),
            ZSeekFrom::Current(offset) => (self.position, offset),
        };
        let position = base.checked_add_signed(offset as isize).ok_or(ZByteIoError::SeekError("before the start"))?;
        self.position = position;
        Ok(position as u64)
    }

    #[inline]
    fn is_eof(&mut self) -> Result<bool, ZByteIoError> {
        Ok(self.position >= self.bytes.len())
    }

    fn z_position(&mut self) -> Result<u64, ZByteIoError> {
        Ok(self.position as u64)
    }

    fn read_remaining(&mut self, sink: &mut Vec<u8>) -> Result<usize, ZByteIoError> {
        let rest = self.rest();
        sink.extend_from_slice(rest);
        self.advance(rest.len());
        Ok(rest.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_seeks_and_ends_like_a_cursor() {
        let cancelled = Cell::new(false);
        let mut go_on = |_| ControlFlow::Continue(());
        let mut watched = Watched::new(b"abcdef", &mut go_on, &cancelled);
        let mut pair = [0; 2];
        watched.read_exact_bytes(&mut pair).unwrap();
        assert_eq!((&pair, watched.read_byte_no_error()), (b"ab", b'c'));
        watched.z_seek(ZSeekFrom::Current(-2)).unwrap();
        assert_eq!(watched.read_byte_no_error(), b'b');
        watched.z_seek(ZSeekFrom::End(-1)).unwrap();
        assert!(watched.read_exact_bytes(&mut pair).is_err());
        assert_eq!((watched.read_byte_no_error(), watched.is_eof().unwrap()), (b'f', true));
        assert!(watched.z_seek(ZSeekFrom::Current(-9)).is_err());
    }

    #[test]
    fn ends_when_the_work_is_to_stop() {
        let cancelled = Cell::new(false);
        let mut stop = |fraction| if fraction > 0.5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        let bytes = vec![7; 1000];
        let mut watched = Watched::new(&bytes, &mut stop, &cancelled);
        let read = std::iter::from_fn(|| (!watched.is_eof().unwrap()).then(|| watched.read_byte_no_error())).count();
        assert!(cancelled.get() && (500..520).contains(&read), "{read}");
    }
}
