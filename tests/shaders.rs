//! Do the exported shader functions compile, and do they return the curve?
//!
//! naga compiles them; its intermediate form is then executed here, in single precision, on the processor: there is
//! no other path, and none is skipped where a machine has no graphics. HLSL and OSL have no front end in naga: they
//! differ from GLSL in the names of types and of one function, which are replaced.

use std::collections::HashMap;

use edgewise::color::Rgb;
use edgewise::export::{Options, Target, export, export_baked, export_form};
use edgewise::fit::{BAKED_COEFFICIENTS, bake};
use edgewise::fresnel::{CosTheta, FresnelModel, SchlickSeries, whole_degrees};
use edgewise::kernel::{Exported, Operations, Polynomial, SchlickOfPixels};
use edgewise::metal::metal_by_name;
use edgewise::preset::Preset;
use edgewise::study::{Form, Subject, Variant, forms};
use naga::valid::{Capabilities, FunctionInfo, ModuleInfo, ValidationFlags, Validator};
use naga::{
    BinaryOperator, Block, Expression, Function, Handle, Literal, LocalVariable, MathFunction, Module, ScalarKind,
    ShaderStage, Statement, TypeInner, UnaryOperator,
};

/// A scalar or a vector of three.
#[derive(Clone, Copy, Debug)]
enum Value {
    Scalar(f32),
    Vector([f32; 3]),
}

impl Value {
    fn vector(self) -> [f32; 3] {
        match self {
            Self::Scalar(v) => [v; 3],
            Self::Vector(v) => v,
        }
    }

    fn scalar(self) -> f32 {
        match self {
            Self::Scalar(v) => v,
            Self::Vector(v) => panic!("{v:?} is no scalar"),
        }
    }

    fn zip(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        match (self, other) {
            (Self::Scalar(a), Self::Scalar(b)) => Self::Scalar(f(a, b)),
            (a, b) => {
                let (a, b) = (a.vector(), b.vector());
                Self::Vector(std::array::from_fn(|i| f(a[i], b[i])))
            }
        }
    }
}

/// One call of a function: what its expressions and variables hold.
struct Call<'a> {
    module: &'a Module,
    function: &'a Function,
    arguments: &'a [Value],
    values: HashMap<Handle<Expression>, Value>,
    locals: HashMap<Handle<LocalVariable>, Value>,
    /// The rows of variables that are arrays.
    tables: HashMap<Handle<LocalVariable>, Handle<Expression>>,
}

fn call(module: &Module, function: &Function, arguments: &[Value]) -> Value {
    let (values, locals, tables) = (HashMap::new(), HashMap::new(), HashMap::new());
    let mut call = Call { module, function, arguments, values, locals, tables };
    for (handle, local) in function.local_variables.iter() {
        match local.init {
            Some(init) if call.is_table(handle) => _ = call.tables.insert(handle, init),
            Some(init) => {
                let value = call.value(init);
                call.locals.insert(handle, value);
            }
            None => {}
        }
    }
    call.run(&function.body).expect("the function returns")
}

impl Call<'_> {
    fn run(&mut self, block: &Block) -> Option<Value> {
        for statement in block {
            match statement {
                Statement::Emit(range) => {
                    for handle in range.clone() {
                        let value = self.evaluate(&self.function.expressions[handle]);
                        self.values.insert(handle, value);
                    }
                }
                Statement::Block(block) => {
                    if let Some(value) = self.run(block) {
                        return Some(value);
                    }
                }
                Statement::Store { pointer, value } => {
                    let Expression::LocalVariable(local) = self.function.expressions[*pointer] else {
                        panic!("a store to something else than a variable");
                    };
                    if self.is_table(local) {
                        self.tables.insert(local, *value);
                        continue;
                    }
                    let value = self.value(*value);
                    self.locals.insert(local, value);
                }
                Statement::Call { function, arguments, result } => {
                    let arguments: Vec<Value> = arguments.iter().map(|&handle| self.argument(handle)).collect();
                    let value = call(self.module, &self.module.functions[*function], &arguments);
                    self.values.insert(result.expect("it returns a value"), value);
                }
                Statement::Return { value } => return value.map(|handle| self.value(handle)),
                other => panic!("not expected in straight-line code: {other:?}"),
            }
        }
        None
    }

    /// GLSL passes a variable where it reads one.
    fn argument(&self, handle: Handle<Expression>) -> Value {
        match self.function.expressions[handle] {
            Expression::LocalVariable(local) => self.locals[&local],
            _ => self.value(handle),
        }
    }

    fn value(&self, handle: Handle<Expression>) -> Value {
        self.values.get(&handle).copied().unwrap_or_else(|| self.evaluate(&self.function.expressions[handle]))
    }

    fn evaluate(&self, expression: &Expression) -> Value {
        match *expression {
            Expression::Literal(literal) => Value::Scalar(number(literal)),
            Expression::Constant(constant) => self.constant(self.module.constants[constant].init),
            Expression::FunctionArgument(index) => self.arguments[index as usize],
            Expression::Splat { value, .. } => Value::Vector(self.value(value).vector()),
            // Only its rows are ever asked for.
            Expression::Compose { ty, .. } if matches!(self.module.types[ty].inner, TypeInner::Array { .. }) => {
                Value::Scalar(f32::NAN)
            }
            Expression::Compose { ref components, .. } => compose(components, |handle| self.value(handle)),
            Expression::Load { pointer } => match self.function.expressions[pointer] {
                Expression::Access { base, index } => self.element(base, self.value(index).scalar() as usize),
                Expression::AccessIndex { base, index } => self.element(base, index as usize),
                _ => self.argument(pointer),
            },
            Expression::Access { base, index } => self.element(base, self.value(index).scalar() as usize),
            Expression::AccessIndex { base, index } => self.element(base, index as usize),
            Expression::As { expr, kind: ScalarKind::Sint | ScalarKind::Uint, .. } => {
                self.value(expr).zip(Value::Scalar(0.0), |a, _| a.trunc())
            }
            Expression::As { expr, kind: ScalarKind::Float, .. } => self.value(expr),
            Expression::Unary { op: UnaryOperator::Negate, expr } => {
                self.value(expr).zip(Value::Scalar(0.0), |a, _| -a)
            }
            Expression::Binary { op, left, right } => binary(op, self.value(left), self.value(right)),
            Expression::Math { fun: MathFunction::Clamp, arg, arg1: Some(low), arg2: Some(high), .. } => {
                let above = self.value(arg).zip(self.value(low), f32::max);
                above.zip(self.value(high), f32::min)
            }
            Expression::Math { fun: MathFunction::Min, arg, arg1: Some(other), .. } => {
                self.value(arg).zip(self.value(other), f32::min)
            }
            Expression::Math { fun: MathFunction::Pow, arg, arg1: Some(power), .. } => {
                self.value(arg).zip(self.value(power), f32::powf)
            }
            Expression::Math { fun, arg, .. } => {
                let of_one: fn(f32) -> f32 = match fun {
                    MathFunction::Sqrt => f32::sqrt,
                    MathFunction::Abs => f32::abs,
                    MathFunction::Sign => |a| if a == 0.0 { 0.0 } else { a.signum() },
                    other => panic!("not expected in these functions: {other:?}"),
                };
                self.value(arg).zip(Value::Scalar(0.0), |a, _| of_one(a))
            }
            ref other => panic!("not expected in these functions: {other:?}"),
        }
    }

    fn is_table(&self, local: Handle<LocalVariable>) -> bool {
        matches!(self.module.types[self.function.local_variables[local].ty].inner, TypeInner::Array { .. })
    }

    /// A component of a vector, or a row of a table.
    fn element(&self, base: Handle<Expression>, index: usize) -> Value {
        match self.function.expressions[base] {
            Expression::GlobalVariable(table) => {
                self.row(self.module.global_variables[table].init.expect("a table has rows"), index)
            }
            Expression::Constant(table) => self.row(self.module.constants[table].init, index),
            Expression::LocalVariable(local) if self.is_table(local) => self.element(self.tables[&local], index),
            Expression::Compose { ref components, .. } => self.value(components[index]),
            _ => Value::Scalar(self.argument(base).vector()[index]),
        }
    }

    fn row(&self, table: Handle<Expression>, index: usize) -> Value {
        match self.module.global_expressions[table] {
            Expression::Compose { ref components, .. } => self.constant(components[index]),
            ref other => panic!("no table: {other:?}"),
        }
    }

    fn constant(&self, handle: Handle<Expression>) -> Value {
        match self.module.global_expressions[handle] {
            Expression::Literal(literal) => Value::Scalar(number(literal)),
            Expression::Compose { ref components, .. } => compose(components, |handle| self.constant(handle)),
            Expression::Splat { value, .. } => Value::Vector(self.constant(value).vector()),
            ref other => panic!("not expected in a constant: {other:?}"),
        }
    }
}

fn number(literal: Literal) -> f32 {
    match literal {
        Literal::F32(v) => v,
        Literal::F64(v) | Literal::AbstractFloat(v) => v as f32,
        Literal::I32(v) => v as f32,
        Literal::U32(v) => v as f32,
        other => panic!("no float: {other:?}"),
    }
}

fn compose(components: &[Handle<Expression>], value: impl Fn(Handle<Expression>) -> Value) -> Value {
    let components: Vec<f32> = components.iter().map(|&handle| value(handle).scalar()).collect();
    Value::Vector(components.try_into().expect("three components"))
}

fn binary(op: BinaryOperator, left: Value, right: Value) -> Value {
    left.zip(
        right,
        match op {
            BinaryOperator::Add => |a, b| a + b,
            BinaryOperator::Subtract => |a, b| a - b,
            BinaryOperator::Multiply => |a, b| a * b,
            BinaryOperator::Divide => |a, b| a / b,
            other => panic!("not expected in these functions: {other:?}"),
        },
    )
}

fn validated(module: Module) -> Module {
    information(&module);
    module
}

fn information(module: &Module) -> ModuleInfo {
    Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(module).expect("a valid module")
}

fn module_from_glsl(source: &str) -> Module {
    let source = format!("#version 450\n{source}\nvoid main() {{}}\n");
    let options = naga::front::glsl::Options::from(ShaderStage::Fragment);
    let parsed = naga::front::glsl::Frontend::default().parse(&options, &source);
    validated(parsed.unwrap_or_else(|errors| panic!("{errors:?}\n{source}")))
}

fn module(target: Target, source: &str) -> Module {
    match target {
        Target::Glsl => module_from_glsl(source),
        Target::Wgsl => validated(naga::front::wgsl::parse_str(source).unwrap_or_else(|e| panic!("{e}\n{source}"))),
        Target::Hlsl => module_from_glsl(&with_constructed_tables(
            &source
                .replace("float3", "vec3")
                .replace("saturate(cosTheta)", "clamp(cosTheta, 0.0, 1.0)")
                .replace("static const", "const"),
        )),
        Target::Osl => {
            let functions = source.split("\nshader ").next().unwrap();
            module_from_glsl(&with_constructed_tables(&functions.replace("color ", "vec3 ").replace("color(", "vec3(")))
        }
        other => panic!("{other} is no shading language"),
    }
}

/// HLSL and OSL write the rows of a table in braces.
fn with_constructed_tables(source: &str) -> String {
    let line = |line: &str| match line.strip_suffix("] = {").and_then(|head| Some((head, head.rsplit_once('[')?.1))) {
        Some((head, count)) => format!("{head}] = vec3[{count}](\n"),
        None if line == "};" => ");\n".to_owned(),
        None => format!("{line}\n"),
    };
    source.lines().map(line).collect()
}

const LANGUAGES: [Target; 4] = [Target::Glsl, Target::Hlsl, Target::Wgsl, Target::Osl];

fn preset(name: &str, r: [f64; 3], h: [f64; 3]) -> Preset {
    Preset { name: name.to_owned(), r: Rgb(r), h: Rgb(h), ..Preset::new_authored() }
}

fn source(preset: &Preset, target: Target) -> String {
    let exported = export(preset, target, &Options::default()).unwrap();
    String::from_utf8(exported.files[0].bytes.clone()).unwrap()
}

fn source_of_form(preset: &Preset, target: Target, form: &Form) -> String {
    let exported = export_form("name", preset, target, &Options::default(), form, &[]).unwrap();
    String::from_utf8(exported.files[0].bytes.clone()).unwrap()
}

fn function<'a>(module: &'a Module, name: &str) -> &'a Function {
    let named = |(_, function): &(_, &Function)| function.name.as_deref() == Some(name);
    module.functions.iter().find(named).unwrap_or_else(|| panic!("no function {name}")).1
}

/// The rounding of a dozen operations on numbers up to 10 in single precision stays below 1e-6.
#[test]
fn functions_return_the_curve_where_naga_s_form_is_executed() {
    for preset in [
        preset("Gold", [1.0, 0.782, 0.344], [0.986, 0.882, 0.630]),
        preset("Chromium", [0.635, 0.662, 0.705], [0.576, 0.612, 0.697]),
        preset("Out of range", [1.04, -0.02, 0.5], [1.01, 0.1, -0.1]),
    ] {
        for target in LANGUAGES {
            let module = module(target, &source(&preset, target));
            let function = function(&module, &format!("fresnel_{}", edgewise::export::identifier(&preset.name)));
            for c in whole_degrees() {
                let shown = call(&module, function, &[Value::Scalar(c.get() as f32)]).vector();
                let off = preset.model().reflectance(c).max_abs_difference(Rgb(shown.map(f64::from)));
                assert!(off < 1e-6, "{target} {} {}°: {off}", preset.name, c.deg());
            }
        }
    }
}

/// A dot product of unit vectors can leave [0, 1] by rounding; the ends are held.
#[test]
fn cosines_out_of_range_hold_the_ends() {
    let gold = preset("Gold", [1.0, 0.782, 0.344], [0.986, 0.882, 0.630]);
    for target in LANGUAGES {
        let module = module(target, &source(&gold, target));
        for (cosine, end) in [(1.0 + f32::EPSILON, CosTheta::FACING), (-1e-3, CosTheta::GRAZING)] {
            let shown = call(&module, function(&module, "fresnel_gold"), &[Value::Scalar(cosine)]).vector();
            assert!(gold.model().reflectance(end).max_abs_difference(Rgb(shown.map(f64::from))) < 1e-6, "{target}");
        }
    }
}

/// Two exports in one source file: the guard keeps one copy of what they share.
#[test]
fn two_metals_share_the_general_function() {
    let sources =
        [preset("Tin", [0.7; 3], [0.8; 3]), preset("Lead", [0.6; 3], [0.7; 3])].map(|p| source(&p, Target::Glsl));
    let module = module_from_glsl(&sources.concat());
    assert_eq!(module.functions.iter().filter(|(_, f)| f.name.as_deref() == Some("edgewise_fresnel")).count(), 1);
    function(&module, "fresnel_tin");
    function(&module, "fresnel_lead");
}

#[test]
fn sources_are_ascii_and_free_of_pow_and_whole_literals() {
    for target in LANGUAGES {
        let source = source(&preset("Weiß – \\", [1.0, 0.0, 0.5], [1.0, 0.0, 0.5]), target);
        assert!(source.is_ascii() && !source.contains("pow") && !source.contains('\\'), "{source}");
        let code: String = source.lines().filter(|line| !line.starts_with("//")).collect();
        let arguments = code.rsplit("edgewise_fresnel(").next().unwrap();
        assert!(arguments.contains("(1.0, 0.0, 0.5)"), "{arguments}");
    }
}

/// What the functions of a shader are made of in naga's form, a vector being three numbers.
struct Counting<'a> {
    module: &'a Module,
    function: &'a Function,
    types: &'a FunctionInfo,
    counts: Operations,
}

impl Counting<'_> {
    fn block(&mut self, block: &Block) {
        for statement in block {
            match statement {
                Statement::Emit(range) => range.clone().for_each(|handle| self.expression(handle)),
                Statement::Block(block) => self.block(block),
                Statement::Store { .. } | Statement::Return { .. } => {}
                other => panic!("not expected in one function of straight-line code: {other:?}"),
            }
        }
    }

    fn expression(&mut self, handle: Handle<Expression>) {
        let numbers = match self.types[handle].ty.inner_with(&self.module.types) {
            TypeInner::Vector { size, .. } => *size as u32,
            _ => 1,
        };
        let counts = &mut self.counts;
        match &self.function.expressions[handle] {
            Expression::Binary { op: BinaryOperator::Add | BinaryOperator::Subtract, .. } => counts.sums += numbers,
            Expression::Binary { op: BinaryOperator::Multiply, .. } => counts.products += numbers,
            Expression::Binary { op: BinaryOperator::Divide, .. } => counts.quotients += numbers,
            Expression::Unary { op: UnaryOperator::Negate, .. } => counts.choices += numbers,
            // Not below and not above.
            Expression::Math { fun: MathFunction::Clamp, .. } => counts.choices += 2 * numbers,
            Expression::Splat { .. } | Expression::Compose { .. } | Expression::Load { .. } => {}
            other => panic!("not expected in these functions: {other:?}"),
        }
    }
}

fn counted(module: &Module, name: &str) -> Operations {
    let information = information(module);
    let named = |(_, function): &(_, &Function)| function.name.as_deref() == Some(name);
    let (handle, function) = module.functions.iter().find(named).unwrap_or_else(|| panic!("no function {name}"));
    let mut counting = Counting { module, function, types: &information[handle], counts: Operations::default() };
    counting.block(&function.body);
    counting.counts
}

/// As a shader's source has them: a product and its sum are two.
fn apart(operations: Operations) -> Operations {
    Operations { fused: 0, ..operations }
}

/// What the program says a shader costs is what the exported function is made of.
#[test]
fn exported_functions_have_the_operations_that_are_counted() {
    let gold = preset("Gold", [1.0, 0.782, 0.344], [0.986, 0.882, 0.630]);
    for target in LANGUAGES {
        let whole = module(target, &source(&gold, target));
        assert_eq!(counted(&whole, "edgewise_fresnel"), apart(Operations::of(Exported)), "{target}");
        // Of constants naga computes what it can; where it cannot, they are as variables.
        let only_r = Form::Model { model: FresnelModel::Schlick { r: gold.r } };
        let only_r = module(target, &source_of_form(&gold, target, &only_r));
        let (found, all) = (counted(&only_r, "fresnel_gold"), apart(Operations::of(SchlickOfPixels)));
        assert!(found == all || found == Operations { sums: all.sums - 3, ..all }, "{target}: {found:?} {all:?}");
        let baked = export_baked("gold", metal_by_name("gold").unwrap(), target, &Options::default()).unwrap();
        let baked = module(target, std::str::from_utf8(&baked.files[0].bytes).unwrap());
        let polynomial = apart(Polynomial::operations_of(1, SchlickSeries::BEND_OF_METALS, BAKED_COEFFICIENTS));
        assert_eq!(counted(&baked, "fresnel_gold"), polynomial, "{target}");
    }
}

#[test]
fn baked_functions_return_their_curve() {
    for name in ["gold", "osmium", "zinc", "caesium"] {
        let metal = metal_by_name(name).unwrap();
        let curve = bake(metal, edgewise::color::RgbSpace::LinRec709);
        for target in LANGUAGES {
            let baked = export_baked(name, metal, target, &Options::default()).unwrap();
            let module = module(target, std::str::from_utf8(&baked.files[0].bytes).unwrap());
            let function = function(&module, &format!("fresnel_{name}"));
            for c in whole_degrees() {
                let shown = call(&module, function, &[Value::Scalar(c.get() as f32)]).vector();
                let off = curve.reflectance(c).max_abs_difference(Rgb(shown.map(f64::from)));
                assert!(off < 1e-6, "{target} {name} {}°: {off}", c.deg());
            }
        }
    }
}

/// Every parameter that a plan can choose, as a function of its own. Single precision in a sum of 401 wavelengths, or of
/// an index whose k is in the thousands, keeps five digits.
#[test]
fn functions_of_every_variant_return_their_curve() {
    let space = edgewise::color::RgbSpace::LinRec709;
    for name in ["gold", "zinc"] {
        let subject = Subject::Metal(metal_by_name(name).unwrap());
        let preset = preset(name, [0.5; 3], [0.5; 3]);
        for of in forms(&subject, &Variant::ALL, space, &mut || std::ops::ControlFlow::Continue(())).unwrap() {
            for target in LANGUAGES {
                let module = module(target, &source_of_form(&preset, target, &of.form));
                let function = function(&module, &format!("fresnel_{name}"));
                for c in whole_degrees() {
                    let shown = call(&module, function, &[Value::Scalar(c.get() as f32)]).vector();
                    let off = of.form.reflectance(c).max_abs_difference(Rgb(shown.map(f64::from)));
                    assert!(off < 1e-5, "{target} {name} {} {}°: {off}", of.variant, c.deg());
                }
            }
        }
    }
}
