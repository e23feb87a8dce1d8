// Gold, written by Edgewise
// lin_rec709: r = 1.0 0.782 0.344 facing, h = 0.986 0.882 0.63 at 81.8 degrees
#ifdef GL_ES
precision highp float;
#endif

#ifndef EDGEWISE_FRESNEL
#define EDGEWISE_FRESNEL
// Hoffman 2023: r facing the surface, h at 81.8 degrees (cosine 1/7), white at grazing.
vec3 edgewise_fresnel(vec3 r, vec3 h, float cosTheta) {
    float c = clamp(cosTheta, 0.0, 1.0);
    float x = 1.0 - c;
    float x2 = x * x;
    vec3 w = vec3(1.0) - r;
    vec3 a = 17.6513846 * (r - h) + 8.16666667 * w;
    return r + (x2 * x2 * x) * (w - (c * x) * a);
}
#endif

vec3 fresnel_gold(float cosTheta) {
    return edgewise_fresnel(vec3(1.0, 0.782, 0.344), vec3(0.986, 0.882, 0.63), cosTheta);
}
