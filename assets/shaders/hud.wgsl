// The HUD, in the layout of bevy_egui's own shader, which it stands in for. Colours are multiplied as sRGB, "because that's the only
// way to get text to look right" (egui), and the target wants light: that is two turns of the curve a pixel. By powers they took a
// tenth of a page's frame where graphics are software; roots do, to a tenth of a step of eight bits.

struct Transform {
    scale: vec2<f32>,
    translation: vec2<f32>,
}

struct Corner {
    @builtin(position) position: vec4<f32>,
    @location(0) colour: vec4<f32>,
    @location(1) uv: vec2<f32>,
}

@group(0) @binding(0) var<uniform> transform: Transform;
@group(1) @binding(0) var image: texture_2d<f32>;
@group(1) @binding(1) var image_sampler: sampler;

// x^2.4 as x² x^0.4, and that in powers of the root of x: within 3.2e-4 of itself.
fn light_of(srgb: vec3<f32>) -> vec3<f32> {
    let x = (srgb + 0.055) / 1.055;
    let r = sqrt(x);
    let high = x * x * (0.05378402 + r * (1.18660702 + r * (-0.34081046 + r * 0.10041942)));
    return select(high, srgb / 12.92, srgb < vec3<f32>(0.04045));
}

// x^(1/2.4) from x^(1/2), x^(3/8) and x^(1/4): within 2.1e-4.
fn srgb_of(light: vec3<f32>) -> vec3<f32> {
    let a = sqrt(light);
    let b = sqrt(a);
    let high = 1.055 * (0.26362285 * a + b * (0.81208884 * sqrt(b) - 0.07571169)) - 0.055;
    return select(high, light * 12.92, light < vec3<f32>(0.0031308));
}

@vertex
fn vs_main(
    @location(0) position: vec2<f32>,
    @location(1) uv: vec2<f32>,
    @location(2) colour: vec4<f32>,
) -> Corner {
    return Corner(vec4<f32>(position * transform.scale + transform.translation, 0.0, 1.0), colour, uv);
}

@fragment
fn fs_main(in: Corner) -> @location(0) vec4<f32> {
    let texel = textureSample(image, image_sampler, in.uv);
    let colour = vec4<f32>(srgb_of(texel.rgb), texel.a) * in.colour;
    return vec4<f32>(light_of(colour.rgb), colour.a);
}
