//! Is every file of a plan, as its reader reads it, as near to the truth as the plan allows, or does a loss say how far?
//!
//! Files are read back from their bytes. Functions in shading languages are executed in `tests/shaders.rs`.

use std::ops::ControlFlow;
use std::sync::{Arc, LazyLock};

use edgewise::color::{Rgb, RgbSpace, delta_e_rgb};
use edgewise::export::{Options, Target};
use edgewise::fresnel::{CosTheta, FresnelModel, f82_tint, generalized_schlick};
use edgewise::metal::{Metal, metal_by_name};
use edgewise::preset::Preset;
use edgewise::scene::{
    NODES, Plan, PlanOptions, PlannedFile, SceneMaterial, SeenError, Shape, Source, Verdict, node_cosines, plan_scene,
};
use edgewise::study::{Form, Measure, Subject, Variant, forms, no_progress};

/// What a file's reader shows, and in which space.
type Shown = (RgbSpace, Box<dyn Fn(CosTheta) -> Rgb>);

fn text(file: &PlannedFile) -> &str {
    std::str::from_utf8(&file.bytes).unwrap()
}

fn rgb(text: &str) -> Rgb {
    let values: Vec<f64> = text.split(',').map(|v| v.trim().parse().unwrap()).collect();
    Rgb(values.try_into().unwrap())
}

/// The numbers of a line after `key`, if there is one.
fn numbers_after(text: &str, key: &str) -> Option<Vec<f64>> {
    let line = text[text.find(key)? + key.len()..].lines().next()?;
    Some(line.split(|c: char| !(c.is_ascii_digit() || "+-.".contains(c))).filter_map(|v| v.parse().ok()).collect())
}

fn tinted(r: Rgb, t: Rgb) -> Box<dyn Fn(CosTheta) -> Rgb> {
    Box::new(move |c| r.zip(t, |r, t| f82_tint(r, t, c)))
}

fn model(model: FresnelModel) -> Box<dyn Fn(CosTheta) -> Rgb> {
    Box::new(move |c| model.reflectance(c))
}

/// The inputs of a node in a MaterialX document, in its space.
fn materialx(file: &PlannedFile) -> Shown {
    let document = roxmltree::Document::parse(text(file)).unwrap();
    let space = document.root_element().attribute("colorspace").unwrap().parse().unwrap();
    let input = |name: &str| {
        let is = |node: &roxmltree::Node| node.has_tag_name("input") && node.attribute("name") == Some(name);
        document.descendants().find(is).map(|node| node.attribute("value").unwrap().to_owned())
    };
    let color = |name| input(name).map(|value| rgb(&value));
    let shown: Box<dyn Fn(CosTheta) -> Rgb> = match file.target {
        Target::OpenPbr => tinted(color("base_color").unwrap(), color("specular_color").unwrap_or(Rgb::WHITE)),
        Target::GeneralizedSchlick => {
            let (r0, t) = (color("color0").unwrap(), color("color82").unwrap_or(Rgb::WHITE));
            let (r90, p) = (color("color90").unwrap(), input("exponent").unwrap().parse().unwrap());
            let each = move |c, i: usize| generalized_schlick(r0[i], t[i], r90[i], p, c);
            Box::new(move |c| Rgb(std::array::from_fn(|i| each(c, i))))
        }
        _ => artistic(color("base_color").unwrap(), color("specular_color").unwrap()),
    };
    (space, shown)
}

/// MaterialX's artistic_ior, then the exact conductor.
fn artistic(r: Rgb, g: Rgb) -> Box<dyn Fn(CosTheta) -> Rgb> {
    let r = r.map(|r| r.clamp(0.0, 0.99));
    let n = r.zip(g, |r, g| g * (1.0 - r) / (1.0 + r) + (1.0 - g) * (1.0 + r.sqrt()) / (1.0 - r.sqrt()));
    let k = r.zip(n, |r, n| (((n + 1.0).powi(2) * r - (n - 1.0).powi(2)) / (1.0 - r)).max(0.0).sqrt());
    model(FresnelModel::Conductor { n, k })
}

/// Linear between samples.
fn between(rows: Vec<Rgb>, place: impl Fn(CosTheta) -> f64 + 'static) -> Box<dyn Fn(CosTheta) -> Rgb> {
    Box::new(move |c| {
        let place = place(c).clamp(0.0, (rows.len() - 1) as f64);
        let below = (place as usize).min(rows.len() - 2);
        rows[below].lerp(rows[below + 1], place - below as f64)
    })
}

fn ramp(file: &PlannedFile) -> Vec<Rgb> {
    use exr::prelude::*;
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgba_channels(
            |size, _| vec![Rgb::BLACK; size.area()],
            |row: &mut Vec<Rgb>, at, (r, g, b, _): (f32, f32, f32, f32)| row[at.x()] = Rgb([r, g, b].map(f64::from)),
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(std::io::Cursor::new(&file.bytes))
        .unwrap();
    image.layer_data.channel_data.pixels
}

fn gltf(file: &PlannedFile) -> Box<dyn Fn(CosTheta) -> Rgb> {
    let gltf = gltf::Gltf::from_slice(&file.bytes).unwrap();
    let material = gltf.materials().next().unwrap();
    let [red, green, blue, _] = material.pbr_metallic_roughness().base_color_factor().map(f64::from);
    let specular = material.extension_value("KHR_materials_specular");
    let t = specular.map_or(Rgb::WHITE, |of| Rgb(serde_json::from_value(of["specularColorFactor"].clone()).unwrap()));
    tinted(Rgb([red, green, blue]), t)
}

/// One curve for each space that the file speaks for.
fn read(file: &PlannedFile, space: RgbSpace) -> Vec<Shown> {
    let triple = |key: &str| numbers_after(text(file), key).map(|v| Rgb([v[0], v[1], v[2]]));
    let one = |shown| vec![(space, shown)];
    match file.target {
        Target::Json => one(model(Preset::from_json(text(file)).unwrap().preset.model())),
        Target::Csv => {
            let rows = text(file).lines().skip(1).map(|line| rgb(line.split_once(',').unwrap().1)).collect();
            one(between(rows, |c| c.deg()))
        }
        Target::Cube => {
            let is_row = |line: &&str| line.starts_with(|c: char| c.is_ascii_digit() || c == '-');
            let rows: Vec<Rgb> = text(file).lines().filter(is_row).map(|line| rgb(&line.replace(' ', ","))).collect();
            let last = (rows.len() - 1) as f64;
            one(between(rows, move |c| c.get() * last))
        }
        Target::Exr => {
            let row = ramp(file);
            let width = row.len() as f64;
            one(between(row, move |c| c.get() * width - 0.5))
        }
        Target::OpenPbr | Target::GeneralizedSchlick | Target::StandardSurface => vec![materialx(file)],
        Target::Blender => {
            let values = text(file).split("VALUES = ").nth(1).unwrap();
            let spaces = [
                ("\"lin_rec709_scene\"", RgbSpace::LinRec709),
                ("\"lin_rec2020_scene\"", RgbSpace::LinRec2020),
                ("\"lin_ap1_scene\"", RgbSpace::AcesCg),
            ];
            let shown = |(id, space)| {
                let v = numbers_after(values, id).unwrap();
                let t = if v.len() > 3 { Rgb([v[3], v[4], v[5]]) } else { Rgb::WHITE };
                (space, tinted(Rgb([v[0], v[1], v[2]]), t))
            };
            spaces.map(shown).into()
        }
        Target::Gltf => one(gltf(file)),
        Target::Usd => {
            let t = triple("color3f inputs:specular_color =").unwrap_or(Rgb::WHITE);
            one(tinted(triple("color3f inputs:base_color =").unwrap(), t))
        }
        Target::Mitsuba => {
            let document = roxmltree::Document::parse(text(file)).unwrap();
            let value = |name| {
                let node = document.descendants().find(|node| node.attribute("name") == Some(name)).unwrap();
                rgb(node.attribute("value").unwrap())
            };
            one(model(FresnelModel::Conductor { n: value("eta"), k: value("k") }))
        }
        Target::MitsubaPlugin => {
            one(model(FresnelModel::Hoffman { r: triple("\nR = ").unwrap(), h: triple("\nH = ").unwrap() }))
        }
        other => panic!("{other} is not read here"),
    }
}

fn targets() -> impl Iterator<Item = Target> {
    Target::ALL.into_iter().filter(|target| !target.is_palette() && !target.is_shader())
}

/// A plan for one metal that wants a variant and allows just its error.
fn wanting(plan: &Plan, variant: Variant, form: &Form) -> Plan {
    let mut plan = plan.clone();
    let material = &mut plan.materials[0];
    material.chosen = variant;
    material.parameters = (variant != Variant::Exact).then(|| form.clone());
    for judgement in &mut material.judgements {
        judgement.verdict = if judgement.variant == variant { Verdict::Chosen } else { Verdict::Dearer };
    }
    plan.tolerance.delta_e = material.choice().error.of(plan.tolerance.on);
    plan
}

/// The number that the plan bounds, of what a file's reader shows; of several spaces the largest.
fn seen_error(shown: &[Shown], scene: &SceneMaterial, on: Measure) -> f64 {
    let Source::Metal(metal) = &scene.source else { panic!("a metal") };
    let error = |(space, shown): &Shown| {
        let mut delta_e = [0.0; NODES];
        for (node, _) in scene.angles.seen() {
            let c = node_cosines()[node];
            delta_e[node] = delta_e_rgb(shown(c), metal.reflectance(c, *space), *space);
        }
        SeenError::over(&delta_e, &scene.angles).of(on)
    };
    shown.iter().map(error).fold(0.0, f64::max)
}

/// The number of a loss like “the largest ΔE is 1.300, above 1”.
fn told(losses: &[String], target: Target) -> Option<f64> {
    let beyond = losses.iter().find(|loss| loss.starts_with(&format!("{target}: ")) && loss.contains(", above "))?;
    beyond.split(", above ").next()?.rsplit(' ').next()?.parse().ok()
}

/// Below this no plan tells a difference, and files and their readers do not have the digits.
const DIGITS: f64 = 2e-3;

fn check_every_target(plan: &Plan, scene: &SceneMaterial, space: RgbSpace) {
    let on = plan.tolerance.on;
    let chosen = plan.materials[0].chosen;
    // Samples are those of the truth, whatever was chosen.
    let is_sampled = matches!(chosen, Variant::HOFFMAN | Variant::Exact);
    let targets = targets().filter(|target| target.spaces().contains(&space));
    for target in targets.filter(|target| is_sampled || !target.is_sampled()) {
        let options = Options { space: Some(space) };
        let made = plan.export(Some(std::slice::from_ref(scene)), &[target], &options, |_| true).unwrap();
        let [file] = &made.files[..] else { panic!("one file") };
        let error = seen_error(&read(file, space), scene, on);
        let about = format!("{} {chosen} {target} {space}: {error}, {:?}", plan.materials[0].name, made.losses);
        match told(&made.losses, target) {
            Some(told) => {
                assert!((error - told).abs() < DIGITS && told > plan.tolerance.delta_e, "{about}");
                let has_words = !matches!(target, Target::Csv);
                let bytes = String::from_utf8_lossy(&file.bytes);
                assert_eq!(bytes.contains(", above "), has_words, "{about}");
            }
            None => assert!(error <= plan.tolerance.delta_e + DIGITS, "{about}"),
        }
    }
}

fn zinc_and_gold() -> &'static [&'static Metal; 2] {
    static METALS: LazyLock<[&Metal; 2]> = LazyLock::new(|| ["zinc", "gold"].map(|name| metal_by_name(name).unwrap()));
    &METALS
}

fn scene(metal: &Metal, shape: Shape) -> SceneMaterial {
    SceneMaterial { source: Source::Metal(Arc::new(metal.clone())), angles: shape.angles() }
}

fn check_every_variant(metal: &Metal, shape: Shape, on: Measure, space: RgbSpace) {
    let scene = scene(metal, shape);
    let mut options = PlanOptions::default();
    options.tolerance.on = on;
    let plan = plan_scene(std::slice::from_ref(&scene), "", &options, &no_progress).unwrap();
    let subject = Subject::Metal(metal);
    let all = forms(&subject, &Variant::ALL, plan.space, &mut || ControlFlow::Continue(())).unwrap();
    for of in &all {
        check_every_target(&wanting(&plan, of.variant, &of.form), &scene, space);
    }
}

#[test]
fn files_for_a_sphere_are_within_the_plan_or_say_how_far() {
    for metal in zinc_and_gold() {
        check_every_variant(metal, Shape::Sphere, Measure::Max, RgbSpace::LinRec709);
    }
}

#[test]
fn files_for_a_card_are_within_the_mean_of_a_plan_or_say_how_far() {
    let card = Shape::Card { from_deg: 0.0, to_deg: 60.0 };
    check_every_variant(zinc_and_gold()[1], card, Measure::Mean, RgbSpace::LinRec709);
}

/// n, k and g are no colours: they are found again in the space of the file.
#[test]
fn files_of_another_space_are_within_the_plan_or_say_how_far() {
    check_every_variant(zinc_and_gold()[0], Shape::Sphere, Measure::P95, RgbSpace::AcesCg);
}

/// What a target takes comes as the plan has it.
#[test]
fn parameters_that_a_target_takes_are_the_plans() {
    let metal = zinc_and_gold()[0];
    let scene = scene(metal, Shape::Sphere);
    let plan = plan_scene(std::slice::from_ref(&scene), "", &PlanOptions::default(), &no_progress).unwrap();
    let subject = Subject::Metal(metal);
    let all = forms(&subject, &Variant::ALL, plan.space, &mut || ControlFlow::Continue(())).unwrap();
    for of in &all {
        let plan = wanting(&plan, of.variant, &of.form);
        let Variant::Model(kind, _) = of.variant else { continue };
        let Form::Model { model } = of.form else { panic!("a model") };
        for target in targets().filter(|target| target.takes(Some(kind)) && !target.is_sampled()) {
            let made = plan.export(None, &[target], &Options::default(), |_| true).unwrap();
            let fits = matches!(target, Target::StandardSurface | Target::Mitsuba)
                && !matches!(model, FresnelModel::Conductor { .. } | FresnelModel::Gulbrandsen { .. });
            if fits || !made.losses.is_empty() {
                continue;
            }
            assert_eq!(made.files[0].variant, of.variant, "{target}");
            for (space, shown) in read(&made.files[0], plan.space).iter().filter(|(space, _)| *space == plan.space) {
                let off = |c: CosTheta| shown(c).max_abs_difference(model.reflectance(c));
                let off = node_cosines().iter().map(|c| off(*c)).fold(0.0, f64::max);
                assert!(off < 1e-5, "{target} {} {space}: {off}", of.variant);
            }
        }
    }
}
