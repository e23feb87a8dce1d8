//! What was read of the regions, gone over again and again: a fit is a pass over memory.

use rayon::prelude::*;

use super::cells::{Cell, Counts, Outliers};
use super::light::Light;
use super::radial::{self, Radial};
use super::region::{RINGS, Region};
use super::regions::Regions;
use super::shape::MetalCurve;
use super::spots::{Piece, Spot, read};
use super::sums::{Plus, Scatters, Sum};
use super::view::View;
use crate::fresnel::Weights;
use crate::number::median;

/// What was read of both regions.
#[derive(Debug)]
pub(super) struct Readings {
    /// Facing and grazing.
    strata: [Option<Stratum>; 2],
}

#[derive(Debug)]
struct Stratum {
    region: Region,
    pieces: Vec<Piece>,
    /// What a pixel weighs r, h and white by at [`radial::cosines`].
    all_weights: Vec<Weights>,
    /// Of these, the weights of r and h.
    weights: Radial<2>,
}

/// The sums of every cell of both regions.
pub(super) struct Sums([Vec<Sum>; 2]);

impl Readings {
    /// Reads both regions under a light.
    pub fn of(view: &View, regions: &Regions, light: &Light) -> Self {
        let read = |region: &Region| Stratum::of(*region, read(view, region, light));
        Self { strata: [&regions.inner, &regions.outer].map(|region| region.as_ref().map(read)) }
    }

    /// What both hold.
    pub fn counts(&self) -> [Counts; 2] {
        self.strata.each_ref().map(|stratum| {
            let pieces = stratum.iter().flat_map(|stratum| &stratum.pieces);
            pieces.fold(Counts::default(), |all, piece| all.plus(&piece.counts))
        })
    }

    /// The sums over all pixels that can be used.
    pub fn sums(&self) -> Sums {
        Sums(self.of_strata(|stratum, _| stratum.sums()))
    }

    /// The same without outliers.
    pub fn sums_without(&self, outliers: &Outliers, all: &Sums) -> Sums {
        Sums(self.of_strata(|stratum, index| stratum.sums_without(outliers, &all.0[index])))
    }

    /// The standard deviation of a pixel around a curve: the median over cells of what is left within each.
    pub fn noise(&self, curve: &MetalCurve) -> [f64; 3] {
        let scatters = self.of_strata(|stratum, _| stratum.scatters(curve));
        [0, 1, 2].map(|channel| {
            let variances = scatters.iter().flatten().filter_map(|scatters| scatters.variance(channel));
            median(&mut variances.collect::<Vec<_>>()).sqrt()
        })
    }

    fn of_strata<T>(&self, of: impl Fn(&Stratum, usize) -> Vec<T>) -> [Vec<T>; 2] {
        [0, 1].map(|index| self.strata[index].as_ref().map_or_else(Vec::new, |stratum| of(stratum, index)))
    }
}

impl Sums {
    /// The cells of each channel.
    pub fn cells(&self) -> [Vec<Cell>; 3] {
        let of_stratum = |stratum: usize, channel: usize| {
            let cell = move |(index, sum): (usize, &Sum)| {
                let (block, ring) = (index / RINGS, index % RINGS);
                sum.mean(channel).map(|mean| Cell { stratum, block, ring, ..mean })
            };
            self.0[stratum].iter().enumerate().filter_map(cell)
        };
        [0, 1, 2].map(|channel| of_stratum(0, channel).chain(of_stratum(1, channel)).collect())
    }
}

impl Stratum {
    fn of(region: Region, pieces: Vec<Piece>) -> Self {
        let all_weights: Vec<Weights> = radial::cosines().map(|cosine| region.weights(cosine)).collect();
        let weights = Radial::of(all_weights.iter().map(|weights| [weights.of_r, weights.of_h]));
        Self { region, pieces, all_weights, weights }
    }

    /// The curve where a pixel shows a cosine; 0 in place of a fourth channel.
    fn expected(&self, curve: &MetalCurve) -> Radial<4> {
        Radial::of(radial::cosines().zip(&self.all_weights).map(|(cosine, weights)| {
            let [red, green, blue] = curve.at(*weights, cosine);
            [red, green, blue, 0.0]
        }))
    }

    fn sums(&self) -> Vec<Sum> {
        self.added(|piece, sums: &mut [Sum]| {
            for (cell, spots) in piece.runs() {
                sums[cell].add_run(1.0, spots, &self.weights);
            }
            for odd in &piece.odd {
                sums[odd.cell].add_odd(odd, &self.weights);
            }
        })
    }

    /// Takes the runs that hold outliers off the sums of all runs, and puts back what is left of them. Odd spots are
    /// added anew.
    fn sums_without(&self, outliers: &Outliers, all: &[Sum]) -> Vec<Sum> {
        let expected = self.expected(outliers.curve);
        let limits = Limits::of(outliers.limits);
        let mut sums = self.added(|piece, changes: &mut [Sum]| {
            let mut kept = Vec::new();
            for (cell, spots) in piece.runs() {
                if spots.iter().any(|spot| limits.are_exceeded(*spot, &expected)) {
                    kept.clear();
                    kept.extend(spots.iter().filter(|spot| !limits.are_exceeded(**spot, &expected)).copied());
                    changes[cell].add_run(-1.0, spots, &self.weights);
                    changes[cell].add_run(1.0, &kept, &self.weights);
                }
            }
            for odd in piece.odd.iter().filter(|odd| !limits.are_exceeded(odd.spot, &expected)) {
                changes[odd.cell].add_odd(odd, &self.weights);
            }
        });
        sums.iter_mut().zip(all).for_each(|(sum, all)| sum.plus(&all.of_runs()));
        sums
    }

    fn scatters(&self, curve: &MetalCurve) -> Vec<Scatters> {
        let expected = self.expected(curve);
        self.added(|piece, scatters: &mut [Scatters]| {
            for (cell, spots) in piece.runs() {
                scatters[cell].add_run(spots, &expected);
            }
            for odd in &piece.odd {
                scatters[odd.cell].add_odd(odd, &expected);
            }
        })
    }

    /// One `T` for each cell, added up over the pieces in their order, whatever the number of threads.
    fn added<T: Plus + Default + Clone + Send>(&self, add: impl Fn(&Piece, &mut [T]) + Sync) -> Vec<T> {
        /// Fewer would cost more to begin and to add up than to go over.
        const PIECES: usize = 8;
        let none = || vec![T::default(); self.region.blocks() * RINGS];
        let of_pieces = |pieces: &[Piece]| {
            let mut of_cells = none();
            pieces.iter().for_each(|piece| add(piece, &mut of_cells));
            of_cells
        };
        let parts: Vec<Vec<T>> = self.pieces.par_chunks(PIECES).map(of_pieces).collect();
        let plus = |mut all: Vec<T>, part: Vec<T>| {
            all.iter_mut().zip(&part).for_each(|(all, part)| all.plus(part));
            all
        };
        parts.into_iter().reduce(plus).unwrap_or_else(none)
    }
}

/// How far a pixel may lie from a curve, as it is compared: without bound in place of a fourth channel.
struct Limits([f32; 4]);

impl Limits {
    fn of([red, green, blue]: [f64; 3]) -> Self {
        Self([red as f32, green as f32, blue as f32, f32::INFINITY])
    }

    /// True where a channel is beyond its limit; no number is beyond none.
    #[inline]
    fn are_exceeded(&self, spot: Spot, expected: &Radial<4>) -> bool {
        let expected = expected.at(spot.place());
        // Every channel is compared, so that one comparison of whole registers serves.
        (0..4).fold(false, |beyond, i| beyond | ((spot.0[i] - expected[i]).abs() > self.0[i]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::CosTheta;
    use crate::number::largest;
    use crate::photo::solve::measured::fit_metal;
    use crate::photo::statistics::usable_channels;
    use crate::photo::{Circle, LightMode, MatchRequest, Photo};

    const BALL: Circle = Circle::new(70.3, 68.9, 64.2);

    /// A ball of two colours with noise, some lamps, one of them beyond all bounds, a dark spot, clipped floats and
    /// values that are no numbers.
    fn photo() -> Photo {
        let pixel = |i: u32| {
            let (column, row) = (i % 140, i / 140);
            let rho = BALL.rho(f64::from(column) + 0.5, f64::from(row) + 0.5);
            let weights = Weights::at(CosTheta::new((1.0 - rho * rho).max(0.0).sqrt()));
            let noise = 0.01 * (f64::from((i.wrapping_mul(2_654_435_761)) >> 20) / 4096.0 - 0.5);
            let metal = [0.6, 0.5, 0.4].map(|r| (weights.apply(r, r + 0.15) + noise) as f32);
            match i % 211 {
                _ if [column, row] == [90, 80] => [1e20, metal[1], metal[2]],
                0 => [f32::MAX, metal[1], metal[2]],
                1 => [f32::NAN, metal[1], metal[2]],
                2 => [3e7, metal[1], metal[2]],
                3 => [0.0; 3],
                _ if column > 60 && column < 70 && row > 40 && row < 50 => [5.0; 3],
                _ => metal,
            }
        };
        Photo::from_linear("ball", 140, 140, (0..140 * 140).map(pixel).collect())
    }

    fn request() -> MatchRequest {
        let light = Some(crate::color::Rgb([0.9, 1.0, 1.1]));
        MatchRequest { mode: LightMode::ByEye, circle: Some(BALL), light, ..MatchRequest::default() }
    }

    /// The cells of a channel by a plain loop over single pixels, of those that are kept.
    fn plain_cells(
        photo: &Photo,
        region: &Region,
        channel: usize,
        keep: impl Fn([f64; 3], f64) -> bool,
    ) -> Vec<Sums64> {
        let light = [0.9, 1.0, 1.1];
        let mut cells = vec![Sums64::default(); region.blocks() * RINGS];
        for row in region.rows([photo.width, photo.height]) {
            let facings = region.facings(row);
            for stretch in region.stretches(row, photo.width) {
                for column in stretch.columns {
                    let (pixel, cosine) = (photo.pixel(column, row).unwrap(), facings.at(column).cosine);
                    let reflectance = std::array::from_fn(|i| pixel.rgb[i] / light[i]);
                    if usable_channels(&pixel)[channel] && keep(reflectance, cosine) {
                        let Weights { of_r, of_h, .. } = region.weights(cosine);
                        let terms = [1.0, reflectance[channel], of_r, of_h, cosine];
                        cells[stretch.cell].0.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
                    }
                }
            }
        }
        cells
    }

    #[derive(Clone, Copy, Default)]
    struct Sums64([f64; 5]);

    /// Counts and means of every cell are those of a plain loop, with all pixels and without outliers.
    #[test]
    fn cells_are_those_of_a_plain_loop() {
        let (photo, request) = (photo(), request());
        let view = View::of(&photo, &request).unwrap();
        let light = Light::of(&view, &request).unwrap();
        let regions = Regions::of(&view, &request).unwrap();
        let readings = Readings::of(&view, &regions, &light);
        let all = readings.sums();
        let (curve, _) = fit_metal(&all.cells(), &regions);
        let outliers = Outliers { curve: &curve, limits: [0.02, 0.03, 0.04] };
        let kept = readings.sums_without(&outliers, &all);
        for (stratum, region) in [&regions.inner, &regions.outer].into_iter().enumerate() {
            let region = region.as_ref().unwrap();
            let keep = |reflectance: [f64; 3], cosine: f64| {
                let expected = curve.at(region.weights(cosine), cosine);
                (0..3).all(|i| (reflectance[i] - expected[i]).abs() <= outliers.limits[i])
            };
            for channel in 0..3 {
                assert_same(&all, stratum, channel, &plain_cells(&photo, region, channel, |_, _| true));
                assert_same(&kept, stratum, channel, &plain_cells(&photo, region, channel, keep));
            }
        }
    }

    fn assert_same(sums: &Sums, stratum: usize, channel: usize, plain: &[Sums64]) {
        let cells = sums.cells();
        let mut found = cells[channel].iter().filter(|cell| cell.stratum == stratum);
        for (index, Sums64([count, reflectance, of_r, of_h, cosine])) in plain.iter().enumerate() {
            if *count == 0.0 {
                continue;
            }
            let cell = found.next().unwrap();
            assert_eq!((cell.block * RINGS + cell.ring, cell.count as f64), (index, *count));
            let pairs = [
                (cell.reflectance, *reflectance),
                (cell.weights.of_r, *of_r),
                (cell.weights.of_h, *of_h),
                (cell.cosine, *cosine),
            ];
            let off = largest(pairs.map(|(mean, sum)| (mean - sum / count).abs() / (sum / count).abs().max(1.0)));
            assert!(off < 2e-5, "stratum {stratum}, channel {channel}, cell {index}: {cell:?} {pairs:?}");
        }
        assert!(found.next().is_none());
    }

    /// What one thread adds up and what three do is the same to the last bit.
    #[test]
    fn threads_change_nothing() {
        let (photo, request) = (photo(), request());
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| crate::photo::solve(&photo, &request, crate::color::RgbSpace::AcesCg).unwrap())
        };
        assert_eq!(format!("{:?}", with(1)), format!("{:?}", with(3)));
    }
}
