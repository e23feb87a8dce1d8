//! What a plan costs. The bar: 1,000 materials on a facing-ratio pass of 4 megapixels within 2 s on two cores, reading
//! included; `a_thousand_materials` is that, `a_thousand_different_metals` the same where nothing can be fitted once for
//! many.

use std::io::Cursor;
use std::ops::ControlFlow;
use std::sync::Arc;

use divan::Bencher;
use edgewise::metal::{Metal, NkTable, preferred_metals};
use edgewise::photo::{Plane, PlaneKind};
use edgewise::preset::built_in_presets;
use edgewise::scene::{
    Angles, FacingPass, Masks, PlanOptions, SceneCurves, SceneMaterial, Source, Tolerance, plan_scene, plan_with_curves,
};
use edgewise::study::no_progress;
use exr::prelude::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage as _};

fn main() {
    divan::main();
}

const SIDE: usize = 2048;
const BALLS: usize = 32;
const MATERIALS: usize = 1000;

/// Balls in rows, each of its own material; what is left of the last row is nobody's.
fn ratio_and_id(pixel: usize) -> (f32, f32) {
    let tile = SIDE / BALLS;
    let (column, row) = (pixel % SIDE, pixel / SIDE);
    let on_ball = |place: usize| ((place % tile) as f32 + 0.5) * 2.0 / tile as f32 - 1.0;
    let (x, y) = (on_ball(column), on_ball(row));
    ((1.0 - x * x - y * y).max(0.0).sqrt(), (row / tile * BALLS + column / tile) as f32)
}

fn exr_of(channel: &str, values: Vec<f32>) -> Vec<u8> {
    let channels = AnyChannels::sort([AnyChannel::new(channel, FlatSamples::F32(values))].into_iter().collect());
    let layer = Layer::new((SIDE, SIDE), LayerAttributes::default(), Encoding::FAST_LOSSLESS, channels);
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut bytes).expect("written to memory");
    bytes.into_inner()
}

/// The bytes of the pass and of its ids.
fn files() -> [Vec<u8>; 2] {
    let (ratios, ids) = (0..SIDE * SIDE).map(ratio_and_id).unzip();
    [exr_of("facing_ratio", ratios), exr_of("MaterialID", ids)]
}

fn read(bytes: &[u8], kind: PlaneKind) -> Plane {
    let mut go = |_| ControlFlow::Continue(());
    Plane::from_bytes("made.exr", bytes, kind, None, &mut go).expect("a file of this bench")
}

fn angles_of([pass, ids]: &[Vec<u8>; 2]) -> Vec<Angles> {
    let pass = FacingPass { ratio: read(pass, PlaneKind::Facing) };
    let masks = Masks::Ids(read(ids, PlaneKind::Id));
    let wanted: Vec<u32> = (0..MATERIALS as u32).collect();
    pass.angles(&masks, &wanted).expect("pictures of one size").angles
}

/// Metals of the library and edited presets in turn, as a large scene has them.
fn usual(index: usize) -> Source {
    let metals: Vec<&Metal> = preferred_metals().collect();
    if index.is_multiple_of(2) {
        return Source::Metal(Arc::new(metals[index / 2 % metals.len()].clone()));
    }
    let mut preset = built_in_presets()[index / 2 % built_in_presets().len()].clone();
    preset.r = preset.r * (0.5 + 0.5 * index as f64 / MATERIALS as f64);
    Source::Preset(Box::new(preset))
}

/// A metal between two of the library, another for each index.
fn different(index: usize) -> Source {
    let metals: Vec<&Metal> = preferred_metals().collect();
    let (a, b) = (metals[index % metals.len()], metals[(index / metals.len() + 1 + index) % metals.len()]);
    let share = (index as f64 + 0.5) / MATERIALS as f64;
    let between = |nm: f64| {
        let (a, b) = (a.table().at(nm), b.table().at(nm));
        (nm, a.n + (b.n - a.n) * share, a.k + (b.k - a.k) * share)
    };
    let table = NkTable::new((38..=78).map(|tens| between(10.0 * f64::from(tens)))).expect("values of two metals");
    Source::Metal(Arc::new(Metal::from_table(format!("between-{index}"), format!("Alloy {index}"), table)))
}

fn materials(angles: Vec<Angles>, source: fn(usize) -> Source) -> Vec<SceneMaterial> {
    let material = |(index, angles)| SceneMaterial { source: source(index), angles };
    angles.into_iter().enumerate().map(material).collect()
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn a_thousand_materials(bencher: Bencher) {
    let files = files();
    bencher.bench(|| {
        let materials = materials(angles_of(&files), usual);
        plan_scene(&materials, "made", &PlanOptions::default(), &no_progress)
    });
}

#[divan::bench(sample_count = 3, sample_size = 1)]
fn a_thousand_different_metals(bencher: Bencher) {
    let files = files();
    bencher.bench(|| {
        let materials = materials(angles_of(&files), different);
        plan_scene(&materials, "made", &PlanOptions::default(), &no_progress)
    });
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn reading_the_pass_and_its_ids(bencher: Bencher) {
    let files = files();
    bencher.bench(|| (read(&files[0], PlaneKind::Facing), read(&files[1], PlaneKind::Id)));
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn angles_of_a_thousand_ids(bencher: Bencher) {
    let [pass, ids] = files();
    let (pass, masks) = (FacingPass { ratio: read(&pass, PlaneKind::Facing) }, Masks::Ids(read(&ids, PlaneKind::Id)));
    let wanted: Vec<u32> = (0..MATERIALS as u32).collect();
    bencher.bench(|| pass.angles(&masks, &wanted));
}

/// What the window does when a tolerance is moved: nothing is fitted anew.
#[divan::bench(sample_count = 5, sample_size = 1)]
fn another_tolerance(bencher: Bencher) {
    let materials = materials(angles_of(&files()), usual);
    let sources: Vec<&Source> = materials.iter().map(|material| &material.source).collect();
    let mut options = PlanOptions::default();
    let curves = SceneCurves::of(&sources, options.space, None, &no_progress).expect("materials of the library");
    options.tolerance = Tolerance { delta_e: 0.5, ..options.tolerance };
    bencher.bench(|| plan_with_curves(&materials, &curves, "made", &options));
}

/// Every variant of one metal, fitted and measured at every angle.
#[divan::bench(sample_count = 20)]
fn curves_of_one_metal(bencher: Bencher) {
    let source = different(7);
    bencher.bench(|| SceneCurves::of(&[&source], PlanOptions::default().space, None, &no_progress));
}
