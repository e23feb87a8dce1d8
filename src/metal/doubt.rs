//! What is odd about measured n and k: taken as it is, but said.

use std::fmt;

use super::NkTable;
use crate::spectrum::{FIRST_NM, LAST_NM};

/// Something that measured n and k of a metal hardly ever show. Displays as one sentence.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "each variant is said in its sentence")]
pub enum Doubt {
    /// Larger than in any other metal of the library.
    Large { name: &'static str, value: f64, wavelength_nm: f64 },
    /// One row far beyond both of its neighbours.
    Spike { name: &'static str, value: f64, beside: [f64; 2], wavelength_nm: f64 },
    /// So little absorption that light goes through.
    Transparent { largest_k: f64 },
}

/// Of the library's metals only zinc has an n or k above 8.5 in the visible.
const LARGEST_USUAL: f64 = 9.0;

/// How far a row may pass both neighbours, as a share of their mean: three times what the noisiest built-in set does.
const LARGEST_STEP_ASIDE: f64 = 0.33;

/// Below this n or k, the last digit of a published table is a large share of it.
const NOISE: f64 = 0.05;

/// k of a metal is larger than this somewhere in the visible; the least metallic of the library, rubidium, reaches 1.3.
const LEAST_K: f64 = 0.1;

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Large { name, value, wavelength_nm } => write!(
                f,
                "{name} reaches {value} at {wavelength_nm} nm, more than {LARGEST_USUAL}: few metals have that in the visible."
            ),
            Self::Spike { name, value, beside: [before, after], wavelength_nm } => write!(
                f,
                "{name} is {value} at {wavelength_nm} nm between {before} and {after}: it may be a slip in the table."
            ),
            Self::Transparent { largest_k } => {
                write!(f, "k is at most {largest_k} in the visible: this is no metal, light passes through it.")
            }
        }
    }
}

impl NkTable {
    /// What is odd about the rows in the visible, at most one of each kind for n and for k.
    pub fn doubts(&self) -> Vec<Doubt> {
        let (n, k): (Vec<_>, Vec<_>) = self.visible().map(|(nm, nk)| ((nm, nk.n), (nm, nk.k))).unzip();
        let mut doubts = Vec::new();
        for (name, rows) in [("n", &n), ("k", &k)] {
            doubts.extend(large(name, rows));
            doubts.extend(spike(name, rows));
        }
        let largest_k = k.iter().map(|(_, k)| *k).fold(0.0, f64::max);
        doubts.extend((largest_k < LEAST_K).then_some(Doubt::Transparent { largest_k }));
        doubts
    }

    fn visible(&self) -> impl Iterator<Item = (f64, crate::fresnel::Nk)> + '_ {
        self.rows().filter(|(nm, _)| (FIRST_NM as f64..=LAST_NM as f64).contains(nm))
    }
}

/// The largest value, if it is larger than usual. Rows are (wavelength in nm, value).
fn large(name: &'static str, rows: &[(f64, f64)]) -> Option<Doubt> {
    let &(wavelength_nm, value) = rows.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    (value > LARGEST_USUAL).then_some(Doubt::Large { name, value, wavelength_nm })
}

/// The row that steps farthest aside of both neighbours, if that is too far.
fn spike(name: &'static str, rows: &[(f64, f64)]) -> Option<Doubt> {
    let worst = rows.windows(3).max_by(|a, b| step_aside(a).total_cmp(&step_aside(b)))?;
    let (wavelength_nm, value) = worst[1];
    let doubt = Doubt::Spike { name, value, beside: [worst[0].1, worst[2].1], wavelength_nm };
    (step_aside(worst) > LARGEST_STEP_ASIDE).then_some(doubt)
}

/// How far the middle of three rows passes both others, as a share of their mean.
fn step_aside(three: &[(f64, f64)]) -> f64 {
    let [before, value, after] = [three[0].1, three[1].1, three[2].1];
    let beyond = (value - before.max(after)).max(before.min(after) - value);
    beyond / (NOISE + 0.5 * (before + after))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::metals;

    fn table(n: impl Fn(usize) -> f64, k: impl Fn(usize) -> f64) -> NkTable {
        NkTable::new((0..9).map(|i| (380.0 + 50.0 * i as f64, n(i), k(i)))).unwrap()
    }

    /// Zinc's n reaches 13.9, which is told; no published set of the library looks like a slip of the pen.
    #[test]
    fn of_the_library_only_zinc_is_odd() {
        let odd: Vec<&str> =
            metals().iter().filter(|m| !m.table().doubts().is_empty()).map(|m| m.id.as_str()).collect();
        assert_eq!(odd, ["Zn_Querry"]);
    }

    #[test]
    fn slips_in_a_table_are_told() {
        let ten_times = table(|_| 0.2, |i| if i == 4 { 35.0 } else { 3.5 });
        let said: Vec<String> = ten_times.doubts().iter().map(ToString::to_string).collect();
        assert_eq!(said.len(), 2, "{said:?}");
        assert!(said[0].starts_with("k reaches 35 at 580 nm"), "{said:?}");
        assert!(said[1].starts_with("k is 35 at 580 nm between 3.5 and 3.5"), "{said:?}");
        let missing_digit = table(|i| if i == 2 { 0.12 } else { 1.2 }, |_| 3.0);
        assert!(matches!(missing_digit.doubts()[..], [Doubt::Spike { name: "n", .. }]));
        assert!(table(|i| 0.2 + 0.3 * i as f64, |i| 2.0 + 0.5 * i as f64).doubts().is_empty());
    }

    #[test]
    fn glass_is_no_metal() {
        let doubts = table(|_| 1.5, |_| 1e-7).doubts();
        assert!(doubts[0].to_string().contains("no metal"), "{doubts:?}");
    }
}
