// Draws the world: the box and its air, rock, streaks of wind and the liquid's surface.
//
// The liquid takes two passes. `particle` adds soft discs into a field texture, blended "over", so that its alpha
// 1 - Π(1 - w) never saturates early and its colour is a weighted mean; `liquid` cuts the field where alpha passes a
// threshold: single particles become drops, many become one body with a smooth surface.
//
// Colours come as sRGB and are turned to linear light at the very end.

struct World {
    // World to clip space: scale, offset.
    to_clip: vec4<f32>,
    // Size of the box in d, size of the window in pixels.
    size: vec4<f32>,
    // What the depth map and the air texture cover, d.
    extent: vec4<f32>,
    // Pixels of one d; opacity of the liquid; 1 if it is shaded by depth and light, else 0; most that depth darkens.
    look: vec4<f32>,
    // Radius of a particle's disc, d; half-width of a streak, pixels; 1 if the air is shown; scale of lines.
    pen: vec4<f32>,
    surroundings: vec4<f32>,
    box_top: vec4<f32>,
    box_bottom: vec4<f32>,
    frame: vec4<f32>,
    abyss: vec4<f32>,
}

@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var linear_sampler: sampler;
@group(1) @binding(1) var air_texture: texture_2d<f32>;
@group(1) @binding(2) var depth_texture: texture_2d<f32>;
@group(1) @binding(3) var field_texture: texture_2d<f32>;

// Alpha of the field at the liquid's surface.
const SURFACE: f32 = 0.5;

fn corner(vertex: u32) -> vec2<f32> {
    return vec2<f32>(f32(vertex & 1u), f32(vertex >> 1u));
}

fn clip_of(point: vec2<f32>) -> vec4<f32> {
    return vec4<f32>(point * world.to_clip.xy + world.to_clip.zw, 0.0, 1.0);
}

fn point_at(uv: vec2<f32>) -> vec2<f32> {
    let clip = vec2<f32>(uv.x * 2.0 - 1.0, 1.0 - uv.y * 2.0);
    return (clip - world.to_clip.zw) / world.to_clip.xy;
}

fn to_linear(srgb: vec3<f32>) -> vec3<f32> {
    let low = srgb / 12.92;
    let high = pow((max(srgb, vec3<f32>(0.0)) + 0.055) / 1.055, vec3<f32>(2.4));
    return select(high, low, srgb <= vec3<f32>(0.04045));
}

// Distance to the box in pixels: negative inside.
fn outside_box(point: vec2<f32>) -> f32 {
    let half_size = world.size.xy * 0.5;
    let d = abs(point - half_size) - half_size;
    return max(d.x, d.y) * world.look.x;
}

// ---- whole screen

struct Screen {
    @builtin(position) position: vec4<f32>,
    @location(0) uv: vec2<f32>,
}

@vertex
fn screen_vertex(@builtin(vertex_index) vertex: u32) -> Screen {
    let uv = vec2<f32>(f32(vertex >> 1u), f32(vertex & 1u)) * 2.0;
    var out: Screen;
    out.position = vec4<f32>(uv * vec2<f32>(2.0, -2.0) + vec2<f32>(-1.0, 1.0), 0.0, 1.0);
    out.uv = uv;
    return out;
}

// Breaks up the bands that a dark gradient has in eight bits.
fn dither(pixel: vec2<f32>) -> f32 {
    return (fract(52.9829189 * fract(dot(pixel, vec2<f32>(0.06711056, 0.00583715)))) - 0.5) / 255.0;
}

@fragment
fn backdrop_fragment(in: Screen) -> @location(0) vec4<f32> {
    let point = point_at(in.uv);
    let out_pixels = outside_box(point) / world.pen.w;
    let height = clamp(point.y / world.size.y, 0.0, 1.0);
    var inside = mix(world.box_bottom.rgb, world.box_top.rgb, height);
    inside *= 1.0 - 0.35 * exp2(min(out_pixels, 0.0) / 14.0);
    let air = textureSampleLevel(air_texture, linear_sampler, point / world.extent.zw, 0.0) * world.pen.z;
    inside = inside * (1.0 - air.a) + air.rgb;
    let around = world.surroundings.rgb * (1.0 - 0.45 * exp2(-max(out_pixels - 2.0, 0.0) / 10.0));
    let border = smoothstep(-0.5, 0.5, out_pixels);
    let beyond = smoothstep(1.5, 2.5, out_pixels);
    let rgb = mix(mix(inside, world.frame.rgb, border), around, beyond);
    return vec4<f32>(to_linear(rgb + dither(in.position.xy)), 1.0);
}

// ---- particles into the field

struct ParticleOut {
    @builtin(position) position: vec4<f32>,
    @location(0) at: vec2<f32>,
    @location(1) colour: vec3<f32>,
}

@vertex
fn particle_vertex(
    @builtin(vertex_index) vertex: u32,
    @location(0) position: vec2<f32>,
    @location(1) colour: vec4<f32>,
) -> ParticleOut {
    let at = corner(vertex) * 2.0 - 1.0;
    var out: ParticleOut;
    out.position = clip_of(position + at * world.pen.x);
    out.at = at;
    out.colour = colour.rgb;
    return out;
}

@fragment
fn particle_fragment(in: ParticleOut) -> @location(0) vec4<f32> {
    let fall = max(1.0 - dot(in.at, in.at), 0.0);
    let weight = 0.8 * fall * fall;
    return vec4<f32>(in.colour * weight, weight);
}

// ---- the liquid's surface out of the field

fn field_at(point: vec2<f32>) -> f32 {
    let clip = point * world.to_clip.xy + world.to_clip.zw;
    let uv = vec2<f32>(clip.x * 0.5 + 0.5, 0.5 - clip.y * 0.5);
    return textureSampleLevel(field_texture, linear_sampler, uv, 0.0).a;
}

// What the walls reflect: a liquid that touches a wall ends there, not in drops before it.
fn reflected(point: vec2<f32>) -> f32 {
    let mirror = select(-point, 2.0 * world.size.xy - point, point > world.size.xy * 0.5);
    let near = abs(mirror - point) < vec2<f32>(2.0 * world.pen.x);
    let x = select(0.0, field_at(vec2<f32>(mirror.x, point.y)), near.x);
    let y = select(0.0, field_at(vec2<f32>(point.x, mirror.y)), near.y);
    return 1.0 - (1.0 - x) * (1.0 - y);
}

@fragment
fn liquid_fragment(in: Screen) -> @location(0) vec4<f32> {
    let point = point_at(in.uv);
    let field = textureSampleLevel(field_texture, linear_sampler, in.uv, 0.0);
    let alpha = 1.0 - (1.0 - field.a) * (1.0 - reflected(point));
    let soft = clamp(fwidth(alpha) * 0.8, 0.02, 0.3);
    if alpha < SURFACE - soft {
        discard;
    }
    let step = 1.25 / vec2<f32>(textureDimensions(field_texture));
    let left = textureSampleLevel(field_texture, linear_sampler, in.uv - vec2<f32>(step.x, 0.0), 0.0).a;
    let right = textureSampleLevel(field_texture, linear_sampler, in.uv + vec2<f32>(step.x, 0.0), 0.0).a;
    let above = textureSampleLevel(field_texture, linear_sampler, in.uv - vec2<f32>(0.0, step.y), 0.0).a;
    let below = textureSampleLevel(field_texture, linear_sampler, in.uv + vec2<f32>(0.0, step.y), 0.0).a;
    let cover = smoothstep(SURFACE - soft, SURFACE + soft, alpha) * smoothstep(0.5, -0.5, outside_box(point));
    var rgb = field.rgb / max(field.a, 0.001);

    let shading = world.look.z;
    let depth = textureSampleLevel(depth_texture, linear_sampler, point / world.extent.xy, 0.0).r;
    rgb = mix(rgb, world.abyss.rgb, world.look.w * depth * shading);
    // The surface catches light from above and a little from the left.
    let slope = vec2<f32>(left - right, below - above);
    let facing = dot(slope, vec2<f32>(-0.35, 0.94)) / max(length(slope), 0.05);
    let rim = 1.0 - smoothstep(SURFACE, 0.84, alpha);
    rgb += shading * rim * (0.05 + 0.26 * max(facing, 0.0) - 0.08 * max(-facing, 0.0));

    return vec4<f32>(to_linear(clamp(rgb, vec3<f32>(0.0), vec3<f32>(1.0))), cover * world.look.y);
}

// ---- rock

struct Rock {
    @builtin(position) position: vec4<f32>,
    @location(0) at: vec2<f32>,
    @location(1) colour: vec3<f32>,
    @location(2) @interpolate(flat) solid: u32,
}

@vertex
fn rock_vertex(
    @builtin(vertex_index) vertex: u32,
    @location(0) cell: vec2<u32>,
    @location(1) colour: vec4<u32>,
) -> Rock {
    let at = corner(vertex);
    var out: Rock;
    out.position = clip_of(vec2<f32>(cell) + at);
    out.at = at;
    out.colour = vec3<f32>(colour.rgb) / 255.0;
    out.solid = colour.a;
    return out;
}

// 1 at an open side, falling to 0 within `reach`.
fn exposed(bit: u32, solid: u32, distance: f32, reach: f32) -> f32 {
    return select(0.0, 1.0 - smoothstep(0.0, reach, distance), (solid & bit) == 0u);
}

// How much of the pixel a rounded open corner keeps.
fn corner_cut(sides: u32, solid: u32, from_corner: vec2<f32>) -> f32 {
    let radius = 0.46;
    let inside = max(vec2<f32>(radius) - from_corner, vec2<f32>(0.0));
    let cut = clamp((radius - length(inside)) * world.look.x + 0.5, 0.0, 1.0);
    return select(1.0, cut, (solid & sides) == 0u);
}

@fragment
fn rock_fragment(in: Rock) -> @location(0) vec4<f32> {
    let at = in.at;
    let solid = in.solid;
    let top = exposed(1u, solid, 1.0 - at.y, 0.75);
    let right = exposed(2u, solid, 1.0 - at.x, 0.6);
    let bottom = exposed(4u, solid, at.y, 0.75);
    let left = exposed(8u, solid, at.x, 0.6);
    let light = 1.0 + 0.34 * top + 0.12 * left - 0.16 * right - 0.3 * bottom;
    let cover = corner_cut(3u, solid, vec2<f32>(1.0 - at.x, 1.0 - at.y))
        * corner_cut(6u, solid, vec2<f32>(1.0 - at.x, at.y))
        * corner_cut(12u, solid, vec2<f32>(at.x, at.y))
        * corner_cut(9u, solid, vec2<f32>(at.x, 1.0 - at.y));
    return vec4<f32>(to_linear(clamp(in.colour * light, vec3<f32>(0.0), vec3<f32>(1.0))), cover);
}

// ---- streaks of wind

struct Streak {
    @builtin(position) position: vec4<f32>,
    // Along the streak from its tail (0) to its head (1); across it, −1 … 1.
    @location(0) at: vec2<f32>,
    @location(1) colour: vec4<f32>,
}

@vertex
fn streak_vertex(
    @builtin(vertex_index) vertex: u32,
    @location(0) ends: vec4<f32>,
    @location(1) colour: vec4<f32>,
) -> Streak {
    let c = corner(vertex);
    let along = (ends.zw - ends.xy) * world.look.x;
    let length_pixels = max(length(along), 0.001);
    let way = along / length_pixels;
    let across = vec2<f32>(-way.y, way.x) * (c.y * 2.0 - 1.0) * world.pen.y;
    // A head as round as the streak is wide.
    let base = mix(ends.xy, ends.zw + way * world.pen.y / world.look.x, c.x);
    var out: Streak;
    out.position = clip_of(base + across / world.look.x);
    out.at = vec2<f32>(c.x, c.y * 2.0 - 1.0);
    out.colour = colour;
    return out;
}

@fragment
fn streak_fragment(in: Streak) -> @location(0) vec4<f32> {
    let width = 0.25 + 0.75 * in.at.x;
    let edge = 1.0 - smoothstep(0.55, 1.0, abs(in.at.y) / width);
    let alpha = in.colour.a * in.at.x * in.at.x * edge;
    return vec4<f32>(to_linear(in.colour.rgb), alpha);
}
