// ---- gases: soft clouds, and flames that give light
//
// `gas` sums wide soft discs up in a field of few texels: what comes of it is the same in whatever order, as each is rounded by
// itself. `cloud` takes the sum as an optical depth and lays it over the world.

struct Gas {
    @builtin(position) position: vec4<f32>,
    @location(0) at: vec2<f32>,
    // Its colour, and how much it hides of what is behind it.
    @location(1) @interpolate(flat) colour: vec4<f32>,
}

@vertex
fn gas_vertex(@builtin(vertex_index) vertex: u32) -> Gas {
    let packed = texel_of(vertex / 3u);
    let position = bitcast<vec2<f32>>(packed.xy);
    let colour = bytes_of(packed.z);
    let at = around(vertex);
    var out: Gas;
    out.position = clip_of(position + at * world.parts.x);
    out.at = at;
    out.colour = colour;
    return out;
}

@fragment
fn gas_fragment(in: Gas) -> @location(0) vec4<f32> {
    let fall = max(1.0 - dot(in.at, in.at), 0.0);
    let weight = 0.05 * fall * fall;
    return vec4<f32>(in.colour.rgb, in.colour.a) * weight;
}

@fragment
fn cloud_fragment(in: Tile) -> @location(0) vec4<f32> {
    // Swirls: the field is looked up a little off, by noise that rises.
    let rise = vec2<f32>(0.0, world.parts.w * 9.0);
    var point = in.point;
    let wisps = noise_at(in.point - 0.7 * rise, 31.0);
#ifdef RICH
    let swirl = noise_at(in.point - rise, 24.0);
    point += (swirl.rg - 0.5) * 3.4;
#endif
    let field = textureSampleLevel(gas_texture, linear_sampler, uv_of(point), 0.0);
    let sum = max(max(field.r, max(field.g, field.b)), field.a);
    let peak = 1.0 - exp2(-6.0 * sum);
    // It thins out inside rock, which it is before of by no more than its softness.
    let texel = 1.0 / vec2<f32>(textureDimensions(rock_texture));
    let rock = textureSampleLevel(rock_texture, linear_sampler, in.point * texel, 0.0).a;
    let thick = peak * (0.55 + 0.9 * wisps.r) * (1.0 - 0.85 * rock);
    if thick < 0.01 {
        discard;
    }
    // What hides is lit from outside, what doesn't gives light, and has an edge: it is a flame.
    let own = 1.0 - field.a / max(sum, 0.001);
    let flame = smoothstep(0.06, 0.30, thick) * min(1.6 * thick + 0.35, 1.0);
    let shown = mix(thick, flame, smoothstep(0.15, 0.6, own));
    let lit = light_at(in.point);
    let rgb = field.rgb / max(sum, 0.001) * (1.0 + 0.9 * lit * (1.0 - own)) * (1.0 + 0.9 * own * thick);
    return vec4<f32>(to_linear(exposed_to(rgb)) * shown, min(shown * (1.0 - own), 1.0));
}
