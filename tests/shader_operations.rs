//! Are the operations that are counted for the exported shader those of its intermediate form?

use edgewise::color::Rgb;
use edgewise::export::{Options, Target, export};
use edgewise::kernel::{Exported, Operations};
use edgewise::preset::Preset;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{BinaryOperator, Expression, MathFunction, TypeInner};

/// Operations on single numbers in the function `edgewise_fresnel` of the exported WGSL.
fn counted_by_naga() -> Operations {
    let gold = Preset {
        name: "Gold".to_owned(),
        r: Rgb([1.0, 0.78, 0.34]),
        h: Rgb([0.99, 0.88, 0.63]),
        ..Preset::new_authored()
    };
    let exported = export(&gold, Target::Wgsl, &Options::default()).expect("it is valid");
    let source = String::from_utf8(exported.files[0].bytes.clone()).expect("it is valid");
    let module = naga::front::wgsl::parse_str(&source).expect("it is valid");
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&module).expect("it is valid");
    let named = |(_, function): &(_, &naga::Function)| function.name.as_deref() == Some("edgewise_fresnel");
    let (handle, function) = module.functions.iter().find(named).expect("it is exported");
    let mut counts = Operations::default();
    for (expression, value) in function.expressions.iter() {
        let width = match info[handle][expression].ty.inner_with(&module.types) {
            TypeInner::Vector { size, .. } => *size as u32,
            _ => 1,
        };
        match value {
            Expression::Binary { op: BinaryOperator::Add | BinaryOperator::Subtract, .. } => counts.sums += width,
            Expression::Binary { op: BinaryOperator::Multiply, .. } => counts.products += width,
            Expression::Binary { op: BinaryOperator::Divide, .. } => counts.quotients += width,
            // A limit below and one above.
            Expression::Math { fun: MathFunction::Clamp, .. } => counts.choices += 2 * width,
            Expression::Binary { .. } | Expression::Math { .. } | Expression::Unary { .. } => {
                panic!("not expected in this function: {value:?}")
            }
            _ => {}
        }
    }
    counts
}

#[test]
fn the_exported_shader_has_as_many_as_its_formula() {
    assert_eq!(counted_by_naga(), Operations::of(Exported));
}
