//! L*a*b* over slices, for tables of colour differences; see [`crate::color::Lab`].

use fearless_simd::{Level, dispatch};

use super::Real;
use super::form::each_chunk;
use super::operations::{Counted, Operations};
use crate::color::{Rgb, RgbSpace};

/// From linear RGB of one space to L*a*b* relative to its white.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LabConversion {
    /// Rows of X, Y and Z over the white's.
    rows: [[f64; 3]; 3],
}

impl LabConversion {
    /// For linear colours of a space.
    pub fn new(space: RgbSpace) -> Self {
        let white = space.white().xyz();
        let unit = |channel: usize| Rgb(std::array::from_fn(|i| f64::from(u8::from(i == channel))));
        let columns = [0, 1, 2].map(|channel| space.xyz(unit(channel)));
        Self { rows: std::array::from_fn(|row| columns.map(|column| column.0[row] / white.0[row])) }
    }

    /// L*, a* and b* of one colour.
    #[inline(always)]
    pub fn lab<T: Real>(&self, [red, green, blue]: [T; 3]) -> [T; 3] {
        let mut roots = [red; 3];
        for (root, [x, y, z]) in roots.iter_mut().zip(self.rows) {
            *root = cube_root_with_toe(red.mul_add(red.of(x), green.mul_add(red.of(y), blue * red.of(z))));
        }
        let [fx, fy, fz] = roots;
        [fy.mul_add(fy.of(116.0), fy.of(-16.0)), fx.of(500.0) * (fx - fy), fx.of(200.0) * (fy - fz)]
    }

    /// Operations for one colour.
    pub fn operations(&self) -> Operations {
        Operations::while_running(|| {
            self.lab([Counted; 3]);
        })
    }

    /// At every colour; the shortest slice ends it.
    pub fn over(&self, level: Level, rgb: [&[f32]; 3], lab: [&mut [f32]; 3]) {
        let conversion = *self;
        dispatch!(level, simd => each_chunk(simd, 1, (rgb[0], [rgb]), [lab],
            #[inline(always)] |_, [[red], [green], [blue]]| [conversion.lab([red, green, blue])]));
    }
}

/// CIE 15:2018, eqs. 8.6 and 8.7; the toe continues below zero.
#[inline(always)]
fn cube_root_with_toe<T: Real>(ratio: T) -> T {
    const DELTA: f64 = 6.0 / 29.0;
    let toe = ratio.mul_add(ratio.of(1.0 / (3.0 * DELTA * DELTA)), ratio.of(4.0 / 29.0));
    ratio.of(DELTA * DELTA * DELTA).if_below(ratio, ratio.cube_root(), toe)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::color::Lab;
    use crate::kernel::levels;

    proptest! {
        #[test]
        fn is_the_core(rgb in prop::array::uniform3(-0.1..1.5_f32)) {
            for space in RgbSpace::ALL {
                let exact = Lab::from_rgb(Rgb(rgb.map(f64::from)), space);
                let conversion = LabConversion::new(space);
                let mut out = [[0.0_f32; 1]; 3];
                for level in levels() {
                    let planes = rgb.each_ref().map(std::slice::from_ref);
                    conversion.over(level, planes, out.each_mut().map(|plane| &mut plane[..]));
                    for got in [out.map(|[x]| x), conversion.lab(rgb)] {
                        let [l, a, b] = got.map(f64::from);
                        let off = Rgb([l, a, b]).max_abs_difference(Rgb([exact.lightness, exact.a, exact.b]));
                        prop_assert!(off < 4e-4, "{space} {level:?}: {off}");
                    }
                }
            }
        }
    }
}
