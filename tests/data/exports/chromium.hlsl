// Chromium, written by Edgewise
// lin_rec709: r = 0.635 0.662 0.705 facing, h = 0.576 0.612 0.697 at 81.8 degrees
#ifndef EDGEWISE_FRESNEL
#define EDGEWISE_FRESNEL
// Hoffman 2023: r facing the surface, h at 81.8 degrees (cosine 1/7), white at grazing.
float3 edgewise_fresnel(float3 r, float3 h, float cosTheta) {
    float c = saturate(cosTheta);
    float x = 1.0 - c;
    float x2 = x * x;
    float3 w = float3(1.0, 1.0, 1.0) - r;
    float3 a = 17.6513846 * (r - h) + 8.16666667 * w;
    return r + (x2 * x2 * x) * (w - (c * x) * a);
}
#endif

float3 fresnel_chromium(float cosTheta) {
    return edgewise_fresnel(float3(0.635, 0.662, 0.705), float3(0.576, 0.612, 0.697), cosTheta);
}
