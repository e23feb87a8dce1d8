//! One of several processes that share a job.

use std::str::FromStr;

/// `--shard i/n`: the i-th of n processes, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    index: usize,
    count: usize,
}

impl Default for Shard {
    /// One process does everything.
    fn default() -> Self {
        Self { index: 1, count: 1 }
    }
}

impl Shard {
    /// Whether the piece of work at a position of the whole is this process's.
    ///
    /// Neighbours go to different processes, so that a folder of slow ones is shared too.
    pub fn takes(self, position: usize) -> bool {
        position % self.count == self.index - 1
    }

    /// True where there is only one process.
    pub fn is_whole(self) -> bool {
        self.count == 1
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(index, count)| Some((index.parse().ok()?, count.parse().ok()?)));
        match parts {
            Some((index, count)) if (1..=count).contains(&index) => Ok(Self { index, count }),
            _ => Err(format!("“{text}” is no shard; write i/n, from 1/n to n/n")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_piece_is_taken_once() {
        let shards: Vec<Shard> = (1..=7).map(|index| format!("{index}/7").parse().unwrap()).collect();
        for position in 0..100 {
            assert_eq!(shards.iter().filter(|shard| shard.takes(position)).count(), 1);
        }
        assert!((0..100).all(|position| Shard::default().takes(position)));
    }

    #[test]
    fn a_shard_that_is_none_is_refused() {
        for text in ["", "1", "0/3", "4/3", "1/0", "-1/2", "1/2/3", "a/b", "1.5/2"] {
            assert!(text.parse::<Shard>().unwrap_err().contains("no shard"), "{text}");
        }
    }
}
