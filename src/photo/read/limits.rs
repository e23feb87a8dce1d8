//! What a file may ask for, checked on headers before anything is allocated.

use crate::photo::PhotoErrorKind;

/// Largest file, 2 GiB.
pub(super) const FILE_BYTES: u64 = 1 << 31;
/// Most pixels, 16384 × 16384.
const PIXELS: u64 = 1 << 28;
/// Largest decoded picture, 2 GiB.
const DECODED_BYTES: u64 = 1 << 31;

/// Refuses a file beyond the limit, and an empty one.
pub(super) fn check_file(bytes: u64) -> Result<(), PhotoErrorKind> {
    match bytes {
        0 => Err(PhotoErrorKind::Empty),
        bytes if bytes > FILE_BYTES => Err(too_large(format!("a file of {} MiB", bytes >> 20), "2048 MiB")),
        _ => Ok(()),
    }
}

/// The size of a picture, if it is within the limits, given the bytes of a decoded pixel.
pub(super) fn check_size(width: u64, height: u64, bytes_per_pixel: u64) -> Result<[u32; 2], PhotoErrorKind> {
    if width == 0 || height == 0 {
        return Err(PhotoErrorKind::NoPixels { width, height });
    }
    let size = || format!("a picture of {width} × {height} pixels");
    let pixels = width.checked_mul(height).filter(|pixels| *pixels <= PIXELS);
    let pixels = pixels.ok_or_else(|| too_large(size(), "268 megapixels"))?;
    if pixels * bytes_per_pixel > DECODED_BYTES {
        let what = format!("{} at {bytes_per_pixel} bytes each", size());
        return Err(too_large(what, "2048 MiB in memory"));
    }
    let within = "PIXELS is within 32 bits";
    Ok([u32::try_from(width).expect(within), u32::try_from(height).expect(within)])
}

/// Room for the samples of a picture, or one sentence instead of an abort.
pub(super) fn reserve<T>(samples: usize) -> Result<Vec<T>, PhotoErrorKind> {
    let mut room = Vec::new();
    let bytes = samples.saturating_mul(size_of::<T>()) as u64;
    room.try_reserve_exact(samples).map_err(|_| out_of_memory(bytes))?;
    Ok(room)
}

/// Zeros for the samples of a picture. Room is asked for first, since the second time nobody could be told that there is
/// none; the system then hands out pages that are zero already, each when it is first touched.
pub(super) fn zeros<T: Clone + Default>(samples: usize) -> Result<Vec<T>, PhotoErrorKind> {
    drop(reserve::<T>(samples)?);
    Ok(vec![T::default(); samples])
}

/// The error of an allocation that the system refused.
pub(super) fn out_of_memory(bytes: u64) -> PhotoErrorKind {
    too_large(format!("a picture of {} MiB", bytes.div_ceil(1 << 20)), "this computer's free memory")
}

fn too_large(what: String, limit: &str) -> PhotoErrorKind {
    PhotoErrorKind::TooLarge { what, limit: limit.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_at_and_beyond_the_limits() {
        assert_eq!(check_size(16_384, 16_384, 3).unwrap(), [16_384, 16_384]);
        assert!(matches!(check_size(16_385, 16_384, 3), Err(PhotoErrorKind::TooLarge { .. })));
        assert!(matches!(check_size(16_384, 16_384, 12), Err(PhotoErrorKind::TooLarge { .. })));
        assert!(matches!(check_size(u64::MAX, 3, 1), Err(PhotoErrorKind::TooLarge { .. })));
        assert!(matches!(check_size(0, 3, 1), Err(PhotoErrorKind::NoPixels { .. })));
        assert!(matches!(check_file(0), Err(PhotoErrorKind::Empty)));
        assert!(check_file(FILE_BYTES + 1).is_err());
    }
}
