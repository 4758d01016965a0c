// ---- rock: a texel a cell, baked when it changes

@fragment
fn rock_fragment(in: Tile) -> @location(0) vec4<f32> {
    let texel = 1.0 / vec2<f32>(textureDimensions(rock_texture));
    let uv = in.point * texel;
    let here = textureSampleLevel(rock_texture, linear_sampler, uv, 0.0);
    if here.a < 0.05 {
        discard;
    }
    let reach = 1.1 * texel;
    let left = textureSampleLevel(rock_texture, linear_sampler, uv - vec2<f32>(reach.x, 0.0), 0.0).a;
    let right = textureSampleLevel(rock_texture, linear_sampler, uv + vec2<f32>(reach.x, 0.0), 0.0).a;
    let above = textureSampleLevel(rock_texture, linear_sampler, uv + vec2<f32>(0.0, reach.y), 0.0).a;
    let below = textureSampleLevel(rock_texture, linear_sampler, uv - vec2<f32>(0.0, reach.y), 0.0).a;
    // The contour goes through the faces of the cells, rounds their corners and smooths their stairs.
    let smooth_a = (2.0 * here.a + left + right + above + below) / 6.0;
    let alpha = 0.5 * (here.a + smooth_a);
    let soft = clamp(0.6 / world.look.x, 0.03, 0.4);
    let cover = smoothstep(0.5 - soft, 0.5 + soft, alpha);
    var rgb = here.rgb / max(here.a, 0.004);
    let noise = noise_at(in.point, 40.0);
    let grain = noise_at(in.point + vec2<f32>(7.3, 1.9), 11.0);
    rgb *= 1.0 + 0.22 * (noise.r - 0.5) + 0.30 * (grain.b - 0.5) - 0.16 * smoothstep(0.55, 0.15, abs(noise.g - 0.5) * 8.0);
    let slope = vec2<f32>(left - right, below - above);
    let facing = dot(slope, vec2<f32>(-0.30, 0.95));
    rgb *= 1.0 + 0.34 * max(facing, 0.0) - 0.34 * max(-facing, 0.0);
    let glow = glow_at(in.point);
    let own = max(glow.r, max(glow.g, glow.b));
    rgb = rgb * (1.0 + 1.2 * light_at(in.point)) * (1.0 - own) + glow * (0.75 + 0.5 * noise.r);
    return vec4<f32>(to_linear(exposed_to(rgb)), cover);
}
