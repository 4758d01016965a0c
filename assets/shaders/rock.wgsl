// ---- rock
//
// A map has a texel a cell: its colour, and what it is made of. `stone` bakes it as the window shows it: all of it when the camera moved,
// else the tiles whose rock changed, over what was there. `rock` lays that over the world, with the light of the frame.

// How the surfaces of fixed matter are made: the alpha of a texel is 1 less this many steps of eight bits.
const FIBRES: u32 = 1u;
const POLISHED: u32 = 2u;

@fragment
fn stone_fragment(in: Tile) -> @location(0) vec4<f32> {
    let size = vec2<f32>(textureDimensions(rock_texture));
    let texel = 1.0 / size;
    let uv = in.point * texel;
    let here = textureSampleLevel(rock_texture, linear_sampler, uv, 0.0);
    if here.a < 0.05 {
        return vec4<f32>(0.0);
    }
    let reach = 1.1 * texel;
    let left = textureSampleLevel(rock_texture, linear_sampler, uv - vec2<f32>(reach.x, 0.0), 0.0).a;
    let right = textureSampleLevel(rock_texture, linear_sampler, uv + vec2<f32>(reach.x, 0.0), 0.0).a;
    let above = textureSampleLevel(rock_texture, linear_sampler, uv + vec2<f32>(0.0, reach.y), 0.0).a;
    let below = textureSampleLevel(rock_texture, linear_sampler, uv - vec2<f32>(0.0, reach.y), 0.0).a;
    // The contour goes through the faces of the cells, rounds their corners and smooths their stairs.
    let alpha = 0.5 * here.a + (2.0 * here.a + left + right + above + below) / 12.0;
    let soft = clamp(0.6 / world.look.x, 0.03, 0.4);
    let cover = smoothstep(0.5 - soft, 0.5 + soft, alpha);
    let slope = vec2<f32>(left - right, below - above);
    let facing = dot(slope, vec2<f32>(-0.30, 0.95));

    let cell = clamp(vec2<i32>(in.point), vec2<i32>(0), vec2<i32>(size) - 1);
    let made = u32(round((1.0 - textureLoad(rock_texture, cell, 0).a) * 255.0));
    var rgb = here.rgb / max(here.a, 0.004);
    // Cracks and grain stand out on what is dark.
    let strong = max(1.65 - 1.75 * dot(rgb, vec3<f32>(0.3, 0.6, 0.1)), 0.08);
    let noise = noise_at(in.point, 40.0);
    let grain = noise_at(in.point + vec2<f32>(7.3, 1.9), 11.0);
    var relief = 0.22 * (noise.r - 0.5) + 0.30 * (grain.b - 0.5)
        - 0.16 * smoothstep(0.55, 0.15, abs(noise.g - 0.5) * 8.0);
    if made == FIBRES {
        let along = noise_at(in.point * vec2<f32>(0.22, 1.5), 17.0);
        relief = 0.42 * (along.r - 0.5) + 0.20 * (grain.b - 0.5);
    }
    var light = 0.34;
    if made == POLISHED {
        let along = noise_at(in.point * vec2<f32>(0.10, 2.2), 23.0);
        relief = 0.16 * (along.b - 0.5) + 0.10 * (noise.r - 0.5);
        light = 0.55;
    }
    rgb *= 1.0 + strong * relief + light * max(facing, 0.0) - 0.34 * max(-facing, 0.0);
    return vec4<f32>(clamp(rgb, vec3<f32>(0.0), vec3<f32>(1.0)), cover);
}

@fragment
fn rock_fragment(in: Tile) -> @location(0) vec4<f32> {
    let stone = textureLoad(sheet_texture, vec2<i32>(in.position.xy), 0);
    if stone.a == 0.0 {
        discard;
    }
    var rgb = stone.rgb;
#ifdef GLOW
    let glow = glow_at(in.point);
    let own = max(glow.r, max(glow.g, glow.b));
    rgb = exposed_to(rgb * (1.0 + 1.8 * light_at(in.point)) * (1.0 - own) + glow * (0.6 + rgb.g));
#endif
    return vec4<f32>(to_linear(rgb), stone.a);
}
