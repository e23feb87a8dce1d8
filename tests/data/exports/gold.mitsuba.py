# Gold, written by Edgewise
# lin_rec709: r = 1.0 0.782 0.344 facing, h = 0.986 0.882 0.63 at 81.8°
# For Mitsuba 3, RGB variants: import this file after mi.set_variant, then use the plugin by its name.

import drjit as dr
import mitsuba as mi

PLUGIN = "edgewise_gold"
R = [1.0, 0.782, 0.344]
H = [0.986, 0.882, 0.63]
ALPHA = 0.0  # the square of roughness


def fresnel(r, h, cos_theta):
    """Hoffman 2023: r facing the surface, h at cosine 1/7, white at grazing."""
    c = dr.clip(cos_theta, 0.0, 1.0)
    x = 1.0 - c
    x2 = x * x
    white = 1.0 - r
    a = (823543.0 / 46656.0) * (r - h) + (49.0 / 6.0) * white
    return r + (x2 * x2 * x) * (white - (c * x) * a)


class EdgewiseConductor(mi.BSDF):
    """A conductor of r and h; both, and alpha, can be given in the scene."""

    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        if not mi.is_rgb:
            raise RuntimeError(f"{PLUGIN} holds RGB values; use an RGB variant of Mitsuba")
        self.r = mi.Color3f(props.get("r", mi.ScalarColor3f(R)))
        self.h = mi.Color3f(props.get("h", mi.ScalarColor3f(H)))
        self.alpha = float(props.get("alpha", ALPHA))
        self.is_smooth = self.alpha < 1e-4
        kind = mi.BSDFFlags.DeltaReflection if self.is_smooth else mi.BSDFFlags.GlossyReflection
        self.m_components = [kind | mi.BSDFFlags.FrontSide]
        self.m_flags = self.m_components[0]

    def _distribution(self):
        return mi.MicrofacetDistribution(mi.MicrofacetType.GGX, self.alpha, True)

    def _component(self):
        return mi.BSDFFlags.DeltaReflection if self.is_smooth else mi.BSDFFlags.GlossyReflection

    def sample(self, ctx, si, sample1, sample2, active=True):
        cos_i = mi.Frame3f.cos_theta(si.wi)
        active = active & (cos_i > 0.0) & ctx.is_enabled(self._component(), 0)
        bs = dr.zeros(mi.BSDFSample3f)
        bs.eta = 1.0
        bs.sampled_component = 0
        bs.sampled_type = int(self._component())
        if self.is_smooth:
            bs.wo = mi.reflect(si.wi)
            bs.pdf = 1.0
            return bs, dr.select(active, fresnel(self.r, self.h, cos_i), 0.0)
        distribution = self._distribution()
        normal, pdf = distribution.sample(si.wi, sample2)
        cos_m = dr.dot(si.wi, normal)
        bs.wo = mi.reflect(si.wi, normal)
        bs.pdf = pdf / (4.0 * dr.dot(bs.wo, normal))
        active = active & (pdf > 0.0) & (mi.Frame3f.cos_theta(bs.wo) > 0.0)
        weight = distribution.smith_g1(bs.wo, normal)
        return bs, dr.select(active, fresnel(self.r, self.h, cos_m) * weight, 0.0)

    def eval(self, ctx, si, wo, active=True):
        if self.is_smooth:
            return mi.Color3f(0.0)
        cos_i, cos_o = mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)
        active = active & (cos_i > 0.0) & (cos_o > 0.0) & ctx.is_enabled(self._component(), 0)
        half = dr.normalize(wo + si.wi)
        distribution = self._distribution()
        value = distribution.eval(half) * distribution.G(si.wi, wo, half) / (4.0 * cos_i)
        return dr.select(active, fresnel(self.r, self.h, dr.dot(si.wi, half)) * value, 0.0)

    def pdf(self, ctx, si, wo, active=True):
        if self.is_smooth:
            return mi.Float(0.0)
        cos_i, cos_o = mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)
        half = dr.normalize(wo + si.wi)
        active = active & (cos_i > 0.0) & (cos_o > 0.0) & (dr.dot(si.wi, half) > 0.0)
        distribution = self._distribution()
        pdf = distribution.eval(half) * distribution.smith_g1(si.wi, half) / (4.0 * cos_i)
        return dr.select(active, pdf, 0.0)

    def eval_pdf(self, ctx, si, wo, active=True):
        return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

    def traverse(self, callback):
        callback.put("r", self.r, mi.ParamFlags.Differentiable)
        callback.put("h", self.h, mi.ParamFlags.Differentiable)

    def to_string(self):
        return f"EdgewiseConductor[r={self.r}, h={self.h}, alpha={self.alpha}]"


mi.register_bsdf(PLUGIN, EdgewiseConductor)
