//! Measured n and k over wavelength.

use thiserror::Error;

use crate::fresnel::Nk;
use crate::spectrum::{FIRST_NM, LAST_NM, SAMPLES, wavelengths_nm};

/// Rows of (wavelength, n, k) with strictly growing wavelengths.
#[derive(Clone, Debug, PartialEq)]
pub struct NkTable {
    wavelength_nm: Vec<f64>,
    nk: Vec<Nk>,
}

/// Why rows are not a table of n and k.
#[derive(Clone, Debug, Error, PartialEq)]
#[expect(missing_docs, reason = "each variant is said in its message")]
pub enum NkTableError {
    #[error("it has no rows")]
    Empty,
    #[error("row {row}: the wavelength {wavelength_nm} nm does not follow {previous_nm} nm; wavelengths must grow")]
    NotGrowing { row: usize, previous_nm: f64, wavelength_nm: f64 },
    #[error("row {row}: {name} is {value}; it must be a finite number of at least 0")]
    OutOfRange { row: usize, name: &'static str, value: f64 },
    #[error("row {row}: n and k are both 0, which no material has")]
    NoIndex { row: usize },
    #[error(
        "it covers {first_nm}–{last_nm} nm, which leaves out the middle of the visible (450–650 nm); \
             are the wavelengths in the unit the header names?"
    )]
    MissesVisible { first_nm: f64, last_nm: f64 },
    #[error("there is no row between {from_nm} and {to_nm} nm; a gap in the visible may span 100 nm at most")]
    Gap { from_nm: f64, to_nm: f64 },
}

/// Where the data end inside the visible and the last value was held.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HeldEnds {
    /// First wavelength with data, if it is above 380 nm.
    pub below_nm: Option<f64>,
    /// Last wavelength with data, if it is below 780 nm.
    pub above_nm: Option<f64>,
}

impl HeldEnds {
    /// True when the data cover 380–780 nm.
    pub fn is_none(self) -> bool {
        self == Self::default()
    }

    /// What was held, as a sentence; empty when nothing was.
    pub fn sentence(self) -> String {
        match (self.below_nm, self.above_nm) {
            (None, None) => String::new(),
            (Some(low), None) => format!("The data begin at {low} nm; n and k are held below."),
            (None, Some(high)) => format!("The data end at {high} nm; n and k are held above."),
            (Some(low), Some(high)) => format!("The data cover {low}–{high} nm; n and k are held outside."),
        }
    }
}

/// Data must reach into the middle of the visible from both sides.
const MUST_COVER_NM: (f64, f64) = (450.0, 650.0);
const LARGEST_GAP_NM: f64 = 100.0;

impl NkTable {
    /// Checks rows of (wavelength in nm, n, k).
    pub fn new(rows: impl IntoIterator<Item = (f64, f64, f64)>) -> Result<Self, NkTableError> {
        let mut table = Self { wavelength_nm: Vec::new(), nk: Vec::new() };
        for (index, (wavelength_nm, n, k)) in rows.into_iter().enumerate() {
            table.push(index + 1, wavelength_nm, Nk { n, k })?;
        }
        table.check_coverage()?;
        Ok(table)
    }

    fn push(&mut self, row: usize, wavelength_nm: f64, nk: Nk) -> Result<(), NkTableError> {
        Self::check_row(row, self.wavelength_nm.last().copied(), wavelength_nm, &[("n", nk.n), ("k", nk.k)])?;
        if nk.n == 0.0 && nk.k == 0.0 {
            return Err(NkTableError::NoIndex { row });
        }
        self.wavelength_nm.push(wavelength_nm);
        self.nk.push(nk);
        Ok(())
    }

    /// A row has finite values of at least 0 and a wavelength above the previous one's.
    pub(super) fn check_row(
        row: usize,
        previous_nm: Option<f64>,
        wavelength_nm: f64,
        values: &[(&'static str, f64)],
    ) -> Result<(), NkTableError> {
        for &(name, value) in [("the wavelength", wavelength_nm)].iter().chain(values) {
            if !(value.is_finite() && value >= 0.0) {
                return Err(NkTableError::OutOfRange { row, name, value });
            }
        }
        match previous_nm {
            Some(previous_nm) if wavelength_nm <= previous_nm => {
                Err(NkTableError::NotGrowing { row, previous_nm, wavelength_nm })
            }
            _ => Ok(()),
        }
    }

    fn check_coverage(&self) -> Result<(), NkTableError> {
        let (first_nm, last_nm) = self.range_nm().ok_or(NkTableError::Empty)?;
        if first_nm > MUST_COVER_NM.0 || last_nm < MUST_COVER_NM.1 {
            return Err(NkTableError::MissesVisible { first_nm, last_nm });
        }
        let visible_part = |pair: &[f64]| pair[1].min(LAST_NM as f64) - pair[0].max(FIRST_NM as f64);
        match self.wavelength_nm.windows(2).find(|pair| visible_part(pair) > LARGEST_GAP_NM) {
            Some(pair) => Err(NkTableError::Gap { from_nm: pair[0], to_nm: pair[1] }),
            None => Ok(()),
        }
    }

    /// The measured rows: wavelength in nm, n and k.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = (f64, Nk)> + '_ {
        self.wavelength_nm.iter().copied().zip(self.nk.iter().copied())
    }

    /// First and last wavelength in nm.
    fn range_nm(&self) -> Option<(f64, f64)> {
        Some((*self.wavelength_nm.first()?, *self.wavelength_nm.last()?))
    }

    /// Where the ends are held inside the visible.
    pub fn held_ends(&self) -> HeldEnds {
        let (first, last) = self.range_nm().unwrap_or((FIRST_NM as f64, LAST_NM as f64));
        HeldEnds {
            below_nm: (first > FIRST_NM as f64).then_some(first),
            above_nm: (last < LAST_NM as f64).then_some(last),
        }
    }

    /// n and k at a wavelength: linear in wavelength between rows, held beyond the ends.
    pub fn at(&self, wavelength_nm: f64) -> Nk {
        let above = self.wavelength_nm.partition_point(|&w| w <= wavelength_nm);
        match above {
            0 => self.nk[0],
            i if i == self.nk.len() => self.nk[i - 1],
            i => {
                let (w0, w1) = (self.wavelength_nm[i - 1], self.wavelength_nm[i]);
                let weight = (wavelength_nm - w0) / (w1 - w0);
                let mix = |a: f64, b: f64| a + (b - a) * weight;
                Nk { n: mix(self.nk[i - 1].n, self.nk[i].n), k: mix(self.nk[i - 1].k, self.nk[i].k) }
            }
        }
    }

    /// n and k at each wavelength of the grid.
    pub fn on_grid(&self) -> Box<[Nk; SAMPLES]> {
        let mut wavelengths = wavelengths_nm();
        Box::new(std::array::from_fn(|_| self.at(wavelengths.next().unwrap_or(LAST_NM as f64))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(first: f64, last: f64, step: f64) -> Result<NkTable, NkTableError> {
        let rows = (0..).map(|i| first + f64::from(i) * step).take_while(|w| *w <= last);
        NkTable::new(rows.map(|w| (w, w / 1000.0, 3.0)))
    }

    #[test]
    fn interpolates_and_holds() {
        let table = flat(400.0, 700.0, 50.0).unwrap();
        assert!((table.at(425.0).n - 0.425).abs() < 1e-15);
        assert_eq!((table.at(380.0).n, table.at(780.0).n), (0.4, 0.7));
        assert_eq!(table.held_ends(), HeldEnds { below_nm: Some(400.0), above_nm: Some(700.0) });
        assert!(flat(350.0, 800.0, 50.0).unwrap().held_ends().is_none());
    }

    #[test]
    fn refuses_what_is_no_table() {
        use NkTableError as E;
        assert_eq!(NkTable::new([]), Err(E::Empty));
        assert!(matches!(NkTable::new([(500.0, 1.0, 1.0), (500.0, 1.0, 1.0)]), Err(E::NotGrowing { row: 2, .. })));
        assert!(matches!(NkTable::new([(500.0, -1.0, 1.0)]), Err(E::OutOfRange { row: 1, name: "n", .. })));
        assert!(matches!(NkTable::new([(500.0, 1.0, f64::NAN)]), Err(E::OutOfRange { name: "k", .. })));
        assert_eq!(NkTable::new([(500.0, 0.0, 1.0), (600.0, 0.0, 0.0)]), Err(E::NoIndex { row: 2 }));
        assert!(matches!(flat(0.4, 0.7, 0.05), Err(E::MissesVisible { .. })));
        assert!(matches!(flat(400.0, 700.0, 150.0), Err(E::Gap { .. })));
    }
}
