//! The instruction sets that kernels are compiled for.

pub use fearless_simd::Level;

/// Every instruction set of this machine that kernels are compiled for, the best first.
pub fn levels() -> Vec<Level> {
    let best = Level::new();
    let mut levels = vec![best];
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        let lower = [best.as_avx2().map(Level::Avx2), best.as_sse4_2().map(Level::Sse4_2)];
        let lower = lower.into_iter().chain([best.as_sse2().map(Level::Sse2)]).flatten();
        levels.extend(lower.filter(|level| level_id(*level) != level_id(best)));
    }
    levels
}

/// The stable name of an instruction set.
pub const fn level_id(level: Level) -> &'static str {
    match level {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Level::Avx512(_) => "avx512",
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Level::Avx2(_) => "avx2",
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Level::Sse4_2(_) => "sse4.2",
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Level::Sse2(_) => "sse2",
        #[cfg(target_arch = "aarch64")]
        Level::Neon(_) => "neon",
        _ => "other",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_comes_first_and_each_once() {
        let ids: Vec<&str> = levels().into_iter().map(level_id).collect();
        assert_eq!(ids[0], level_id(Level::new()));
        let mut once = ids.clone();
        once.dedup();
        assert_eq!(ids, once);
    }
}
