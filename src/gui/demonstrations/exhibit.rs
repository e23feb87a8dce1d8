//! What a demonstration shows, so that it can be computed again: for the screen, and for a file.

use std::path::Path;

use super::Demonstration;
use super::material::{Described, Material};
use crate::color::RgbSpace;
use crate::figure::{
    BlendFigure, ConversionFigure, DecouplingFigure, Figure, FigureFormat, FigureTheme, QuantisationFigure,
    UniformityFigure, blend_matrix_of_two, conversion_distribution, feasible_figure,
};
use crate::fit::Method;
use crate::metal::{Metal, preferred_metals};
use crate::preset::{Preset, file_stem};
use crate::render::{SaveError, write_atomically};
use crate::study::{
    BlendPair, ColourConversion, ConversionOptions, ConversionSummary, Decoupling, DecouplingOptions, MetalPoint,
    Parameters, Quantisation, Reach, Slider, SliderSweep, StudyError, blend_matrix, blending, conversion_of,
    conversions, decoupling, feasibility_boundary, metal_points, no_progress, preset_points, quantisation, rows_to_csv,
};

/// One material, converted between two spaces.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OfConversion {
    /// The material.
    pub material: Material,
    /// From where to where.
    pub options: ConversionOptions,
}

/// Two materials in one space.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OfPair {
    /// The first material.
    pub a: Described,
    /// The second, in the same space.
    pub b: Described,
}

/// Every pair of metals, in two descriptions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OfMatrix {
    /// The space in which everything is blended.
    pub space: RgbSpace,
    /// How n, k and g are derived.
    pub method: Method,
    /// The description below the diagonal.
    pub below: Parameters,
    /// The description above it.
    pub above: Parameters,
}

/// One material, of which parameters are moved.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OfDecoupling {
    /// The material.
    pub described: Described,
    /// How far.
    pub amount: f64,
}

/// What is on show.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Exhibit {
    /// One material, converted.
    Conversion(OfConversion),
    /// All metals, converted.
    Conversions(ConversionOptions),
    /// Two materials, blended.
    Blending(OfPair),
    /// All pairs of metals, blended.
    Blends(OfMatrix),
    /// One material's parameters, stored; the gradient leads to the other.
    Quantisation(OfPair),
    /// One material's parameters, moved.
    Decoupling(OfDecoupling),
    /// Sliders at this r.
    Uniformity(f64),
    /// The square of r and h, with a preset in it.
    Feasibility(Box<Preset>),
}

/// A file that a demonstration can be exported to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Piece {
    /// The figure.
    Figure(FigureFormat),
    /// The numbers in it.
    Data,
    /// What one table has no room for: the grey edges of decoupling, the boundaries of feasibility.
    MoreData,
}

impl Piece {
    /// The ending of the file's name.
    pub(crate) const fn extension(self) -> &'static str {
        match self {
            Self::Figure(format) => format.extension(),
            Self::Data | Self::MoreData => "csv",
        }
    }
}

impl OfConversion {
    pub(crate) fn study(&self) -> Result<ColourConversion, StudyError> {
        let ConversionOptions { from: space, method, .. } = self.options;
        let contestants = Described { material: self.material.clone(), space, method }.contestants()?;
        Ok(conversion_of(&contestants, &self.options))
    }
}

impl OfPair {
    pub(crate) fn quantisation(&self) -> Result<Quantisation, StudyError> {
        Ok(quantisation(&*self.a.contestants()?, &*self.b.contestants()?))
    }
}

impl OfDecoupling {
    pub(crate) fn study(&self) -> Result<Decoupling, StudyError> {
        Ok(decoupling(&*self.described.contestants()?, &DecouplingOptions { amount: self.amount }))
    }
}

/// The sweeps that are shown at an r: over what g can reach, and over the whole slider.
pub(crate) fn sweeps_at(r: f64) -> Vec<SliderSweep> {
    const STEPS: usize = 20;
    let of_reach = |reach| Slider::ALL.map(|slider| SliderSweep::new(r, slider, reach, STEPS));
    [Reach::Reachable, Reach::Full].into_iter().flat_map(of_reach).flatten().collect()
}

/// One point for each channel of each preferred metal.
pub(crate) fn points_in(space: RgbSpace) -> Vec<MetalPoint> {
    let metals: Vec<&Metal> = preferred_metals().collect();
    metal_points(&metals, space)
}

/// Every preferred metal, converted.
fn all_conversions(options: &ConversionOptions) -> Result<Vec<ConversionSummary>, StudyError> {
    let metals: Vec<&Metal> = preferred_metals().collect();
    conversions(&metals, options, &no_progress)
}

fn all_pairs(of: &OfMatrix) -> Result<Vec<BlendPair>, StudyError> {
    let metals: Vec<&Metal> = preferred_metals().collect();
    blend_matrix(&metals, of.space, of.method, &no_progress)
}

impl Exhibit {
    /// Which demonstration it belongs to.
    pub(crate) const fn demonstration(&self) -> Demonstration {
        match self {
            Self::Conversion(_) | Self::Conversions(_) => Demonstration::Conversion,
            Self::Blending(_) | Self::Blends(_) => Demonstration::Blending,
            Self::Quantisation(_) => Demonstration::Quantisation,
            Self::Decoupling(_) => Demonstration::Decoupling,
            Self::Uniformity(_) => Demonstration::Uniformity,
            Self::Feasibility(_) => Demonstration::Feasibility,
        }
    }

    /// The tables it has, and what they are called on buttons.
    pub(crate) const fn tables(&self) -> &'static [(Piece, &'static str)] {
        match self {
            Self::Decoupling(_) => &[(Piece::Data, "CSV, sweeps…"), (Piece::MoreData, "CSV, grey edges…")],
            Self::Feasibility(_) => &[(Piece::Data, "CSV, metals…"), (Piece::MoreData, "CSV, boundaries…")],
            _ => &[(Piece::Data, "CSV…")],
        }
    }

    /// A file name: `gold-conversion.svg`.
    pub(crate) fn file_name(&self, piece: Piece) -> String {
        let of = match self {
            Self::Conversion(of) => of.material.name(),
            Self::Blending(of) | Self::Quantisation(of) => {
                format!("{} {}", of.a.material.name(), of.b.material.name())
            }
            Self::Decoupling(of) => of.described.material.name(),
            Self::Conversions(_) | Self::Blends(_) => "all metals".to_owned(),
            Self::Uniformity(r) => format!("r {r:.2}"),
            Self::Feasibility(preset) => preset.name.clone(),
        };
        let more = match (self, piece) {
            (Self::Decoupling(_), Piece::MoreData) => " grey edges",
            (Self::Feasibility(_), Piece::MoreData) => " boundaries",
            _ => "",
        };
        let name = format!("{of} {}{more}", self.demonstration().label());
        format!("{}.{}", file_stem(&name), piece.extension())
    }

    /// Computes it and writes a file, whole or not at all.
    pub(crate) fn write(&self, piece: Piece, path: &Path) -> Result<(), String> {
        let said = |error: StudyError| format!("{}: {error}", path.display());
        match piece {
            Piece::Figure(_) => {
                let figure = self.figure().map_err(said)?;
                figure.save(path, FigureTheme::Light).map_err(|error| error.to_string())
            }
            Piece::Data | Piece::MoreData => {
                if !path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv")) {
                    return Err(SaveError::UnknownFormat { path: path.to_owned(), known: ".csv" }.to_string());
                }
                let csv = self.csv(piece).map_err(said)?;
                write_atomically(path, csv.as_bytes()).map_err(|error| error.to_string())
            }
        }
    }

    /// The figure that the command line draws of the same.
    pub(crate) fn figure(&self) -> Result<Box<dyn Figure>, StudyError> {
        Ok(match self {
            Self::Conversion(of) => Box::new(ConversionFigure { study: of.study()? }),
            Self::Conversions(options) => Box::new(conversion_distribution(&all_conversions(options)?)),
            Self::Blending(of) => Box::new(BlendFigure::new(&*of.a.contestants()?, &*of.b.contestants()?)),
            Self::Blends(of) => Box::new(blend_matrix_of_two(&all_pairs(of)?, of.below, of.above)),
            Self::Quantisation(of) => Box::new(QuantisationFigure { study: of.quantisation()? }),
            Self::Decoupling(of) => Box::new(DecouplingFigure { study: of.study()? }),
            Self::Uniformity(r) => Box::new(UniformityFigure { sweeps: sweeps_at(*r), r: *r }),
            Self::Feasibility(preset) => Box::new(feasible_figure(&points_in(preset.space), Some(preset.as_ref()))),
        })
    }

    /// The numbers in it.
    pub(crate) fn csv(&self, piece: Piece) -> Result<String, StudyError> {
        Ok(match self {
            Self::Conversion(of) => rows_to_csv(&of.study()?.rows()),
            Self::Conversions(options) => rows_to_csv(&all_conversions(options)?),
            Self::Blending(of) => rows_to_csv(&blending(&*of.a.contestants()?, &*of.b.contestants()?).rows()),
            Self::Blends(of) => rows_to_csv(&all_pairs(of)?),
            Self::Quantisation(of) => rows_to_csv(&of.quantisation()?.rows()),
            Self::Decoupling(of) if piece == Piece::MoreData => rows_to_csv(&of.study()?.cross_talk),
            Self::Decoupling(of) => rows_to_csv(&of.study()?.rows()),
            Self::Uniformity(r) => {
                rows_to_csv(&sweeps_at(*r).iter().flat_map(SliderSweep::step_rows).collect::<Vec<_>>())
            }
            Self::Feasibility(_) if piece == Piece::MoreData => rows_to_csv(&feasibility_boundary(BOUNDARY_STEPS)),
            Self::Feasibility(preset) => {
                let points = points_in(preset.space).into_iter().chain(preset_points(preset));
                rows_to_csv(&points.collect::<Vec<_>>())
            }
        })
    }
}

/// Steps of r along the boundaries.
pub(crate) const BOUNDARY_STEPS: usize = 200;
