// Gold, written by Edgewise
// lin_rec709: r = 1.0 0.782 0.344 facing, h = 0.986 0.882 0.63 at 81.8 degrees
// Hoffman 2023: r facing the surface, h at 81.8 degrees (cosine 1/7), white at grazing.
// WGSL cannot guard against a second copy: keep one of this function in a module.
fn edgewise_fresnel(r: vec3<f32>, h: vec3<f32>, cos_theta: f32) -> vec3<f32> {
    let c = clamp(cos_theta, 0.0, 1.0);
    let x = 1.0 - c;
    let x2 = x * x;
    let w = vec3<f32>(1.0) - r;
    let a = 17.6513846 * (r - h) + 8.16666667 * w;
    return r + (x2 * x2 * x) * (w - (c * x) * a);
}

fn fresnel_gold(cos_theta: f32) -> vec3<f32> {
    return edgewise_fresnel(vec3<f32>(1.0, 0.782, 0.344), vec3<f32>(0.986, 0.882, 0.63), cos_theta);
}
