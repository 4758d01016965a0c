// ---- streaks of wind

struct Streak {
    @builtin(position) position: vec4<f32>,
    // Along the streak from its tail (0) to its head (1); across it, −1 … 1.
    @location(0) at: vec2<f32>,
    @location(1) colour: vec4<f32>,
    // Pixels that it is outside the box.
    @location(2) beyond: f32,
}

@vertex
fn streak_vertex(@builtin(vertex_index) vertex: u32) -> Streak {
    let k = 2u * (vertex / 6u);
    let ends = bitcast<vec4<f32>>(texel_of(k));
    let colour = bytes_of(texel_of(k + 1u).x);
    let c = corner(vertex);
    let along = (ends.zw - ends.xy) * world.look.x;
    let length_pixels = max(length(along), 0.001);
    let way = along / length_pixels;
    let across = vec2<f32>(-way.y, way.x) * (c.y * 2.0 - 1.0) * world.pen.y;
    // A head as round as the streak is wide.
    let base = mix(ends.xy, ends.zw + way * world.pen.y / world.look.x, c.x);
    var out: Streak;
    out.position = clip_of(base + across / world.look.x);
    out.beyond = outside_box(base + across / world.look.x);
    out.at = vec2<f32>(c.x, c.y * 2.0 - 1.0);
    out.colour = colour;
    return out;
}

@fragment
fn streak_fragment(in: Streak) -> @location(0) vec4<f32> {
    let width = 0.25 + 0.75 * in.at.x;
    let edge = 1.0 - smoothstep(0.55, 1.0, abs(in.at.y) / width);
    let inside = clamp(0.5 - in.beyond, 0.0, 1.0);
    let alpha = inside * in.colour.a * in.at.x * in.at.x * edge;
    return vec4<f32>(to_linear(in.colour.rgb), alpha);
}
