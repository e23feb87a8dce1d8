//! The scene of a plan as JSON.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use thiserror::Error;

use super::{Angles, NODES, Place, Plan, SavedMaterial, SavedPass, SavedScene, Source};
use crate::metal::{Metal, NkTable, Provenance, metals};
use crate::preset::{FormatError, Preset, read_strict_json};

/// Why a plan of a file cannot be planned again.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum NotPlannable {
    /// It is of a version that kept only what came out.
    #[error(
        "the plan was saved before plans kept where their materials are seen: it can be looked at and exported, but not \
         changed"
    )]
    Nothing,
    /// A metal of the library is not in this one.
    #[error("the library has no metal “{0}”, so that the plan can be looked at and exported, but not changed")]
    Metal(String),
}

#[derive(Serialize, Deserialize)]
struct SceneFields {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pass: Option<SavedPass>,
    materials: Vec<MaterialFields>,
}

#[derive(Serialize, Deserialize)]
struct MaterialFields {
    source: SourceFields,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    place: Place,
    /// Of each node from grazing to facing; missing where they are those of the shape.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    weights: Option<Vec<f64>>,
    /// With the weights: the smallest and the largest that was seen; missing where nothing was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    cosines: Option<[f64; 2]>,
}

#[derive(Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
enum SourceFields {
    /// A metal of the library.
    Metal {
        id: String,
    },
    /// A person's own.
    NK(Box<NkFields>),
    Preset {
        preset: Value,
    },
}

#[derive(Serialize, Deserialize)]
struct NkFields {
    id: String,
    name: String,
    symbol: String,
    category: String,
    dataset: String,
    not_measured: String,
    provenance: Provenance,
    /// Wavelength in nm, n and k.
    rows: Vec<(f64, f64, f64)>,
}

/// The scene as JSON; an error where a preset would not read back as it is.
pub(super) fn scene_json(scene: &SavedScene) -> Result<Value, FormatError> {
    let materials: Result<Vec<MaterialFields>, FormatError> = scene.materials.iter().map(MaterialFields::of).collect();
    Ok(serde_json::to_value(SceneFields { pass: scene.pass.clone(), materials: materials? })?)
}

/// A scene and what it cannot be planned again for; a sentence where it is no scene of the plan.
pub(super) fn read_scene(value: Value, plan: &Plan) -> Result<Result<SavedScene, NotPlannable>, String> {
    let fields: SceneFields = serde_json::from_value(value).map_err(|error| error.to_string())?;
    if fields.materials.len() != plan.materials.len() {
        return Err(format!("{} materials are kept of {}", fields.materials.len(), plan.materials.len()));
    }
    let mut materials = Vec::with_capacity(fields.materials.len());
    for (kept, planned) in fields.materials.into_iter().zip(&plan.materials) {
        match kept.material().map_err(|reason| format!("“{}”: {reason}", planned.name))? {
            Ok(material) => materials.push(material),
            Err(missing) => return Ok(Err(missing)),
        }
    }
    Ok(Ok(SavedScene { materials, pass: fields.pass }))
}

impl MaterialFields {
    fn of(material: &SavedMaterial) -> Result<Self, FormatError> {
        let SavedMaterial { source, file, place, angles } = material;
        let is_the_shapes = matches!(place, Place::Shape(shape) if shape.angles() == *angles);
        Ok(Self {
            source: SourceFields::of(source)?,
            file: file.clone(),
            place: place.clone(),
            weights: (!is_the_shapes).then(|| angles.weights().to_vec()),
            cosines: angles.cosines().filter(|_| !is_the_shapes),
        })
    }

    fn material(self) -> Result<Result<SavedMaterial, NotPlannable>, String> {
        let Self { source, file, place, weights, cosines } = self;
        if let Place::Shape(shape) = place {
            shape.checked().map_err(|error| error.to_string())?;
        }
        let angles = match (weights, &place) {
            (Some(weights), _) => Angles::from_weights(&weights, cosines)?,
            (None, Place::Shape(shape)) => shape.angles(),
            (None, _) => return Err(format!("what a pass shows has {NODES} weights, and none is there")),
        };
        Ok(source.source()?.map(|source| SavedMaterial { source, file, place, angles }))
    }
}

impl SourceFields {
    fn of(source: &Source) -> Result<Self, FormatError> {
        Ok(match source {
            Source::Metal(metal) => match of_library(&metal.id) {
                Some(own) if own.table() == metal.table() => Self::Metal { id: metal.id.clone() },
                _ => Self::NK(NkFields::of(metal).into()),
            },
            Source::Preset(preset) => Self::Preset { preset: read_strict_json(&preset.to_json()?)? },
        })
    }

    fn source(self) -> Result<Result<Source, NotPlannable>, String> {
        Ok(match self {
            Self::Metal { id } => match of_library(&id) {
                Some(metal) => Ok(Source::Metal(metal.clone().into())),
                None => Err(NotPlannable::Metal(id)),
            },
            Self::NK(fields) => Ok(Source::Metal(fields.metal()?.into())),
            Self::Preset { preset } => {
                let loaded = Preset::from_json(&preset.to_string()).map_err(|error| error.to_string())?;
                Ok(Source::Preset(loaded.preset.into()))
            }
        })
    }
}

fn of_library(id: &str) -> Option<&'static Metal> {
    metals().iter().find(|metal| metal.id == id)
}

impl NkFields {
    fn of(metal: &Metal) -> Self {
        let Metal { id, name, symbol, category, dataset, not_measured, provenance, .. } = metal.clone();
        let rows = metal.table().rows().map(|(wavelength_nm, nk)| (wavelength_nm, nk.n, nk.k)).collect();
        Self { id, name, symbol, category, dataset, not_measured, provenance, rows }
    }

    fn metal(self) -> Result<Metal, String> {
        let Self { id, name, symbol, category, dataset, not_measured, provenance, rows } = self;
        let mut metal = Metal::from_table(id, name, NkTable::new(rows).map_err(|error| error.to_string())?);
        (metal.symbol, metal.category, metal.dataset) = (symbol, category, dataset);
        (metal.not_measured, metal.provenance) = (not_measured, provenance);
        Ok(metal)
    }
}
