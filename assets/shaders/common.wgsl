// What all passes of the picture share: the numbers of a frame, the way between the world and the window, colour.
//
// AIR, GLOW, RICH and MORE are defined where the picture has that (src/game/render/features.rs).
//
// Colours come as sRGB and are turned to linear light at the very end of each pass.

struct World {
    // World to clip space: scale, offset.
    to_clip: vec4<f32>,
    // Size of the box in d, size of the window in pixels.
    size: vec4<f32>,
    // What the maps of depth and of the air cover, d.
    extent: vec4<f32>,
    // What the maps of bodies and of light cover, d.
    fine_extent: vec4<f32>,
    // Pixels of one d; opacity of the matter; 1 if it is shaded by depth and light, else 0; most that depth darkens.
    look: vec4<f32>,
    // Radius of a particle's soft disc, d; half-width of a streak, pixels; unused; scale of lines.
    pen: vec4<f32>,
    // Radius of a lump of gas, d; edge of a tile, d; unused; time that moves what drifts by itself, s.
    parts: vec4<f32>,
    // Of the ring of a lens: its middle and radius, pixels; unused.
    lens: vec4<f32>,
    surroundings: vec4<f32>,
    box_top: vec4<f32>,
    box_bottom: vec4<f32>,
    frame: vec4<f32>,
    abyss: vec4<f32>,
    // Colours of the liquids in their channels, and 1 of those that glow.
    liquids: array<vec4<f32>, 6>,
}

@group(0) @binding(0) var<uniform> world: World;
@group(0) @binding(1) var instances: texture_2d<u32>;
@group(1) @binding(0) var linear_sampler: sampler;
@group(1) @binding(1) var air_texture: texture_2d<f32>;
@group(1) @binding(2) var depth_texture: texture_2d<f32>;
@group(1) @binding(3) var rock_texture: texture_2d<f32>;
@group(1) @binding(4) var body_texture: texture_2d<f32>;
@group(1) @binding(5) var glow_texture: texture_2d<f32>;
@group(1) @binding(6) var light_texture: texture_2d<f32>;
@group(1) @binding(7) var field_texture: texture_2d<f32>;
@group(1) @binding(8) var more_texture: texture_2d<f32>;
@group(1) @binding(9) var gas_texture: texture_2d<f32>;
@group(1) @binding(10) var repeating_sampler: sampler;
@group(1) @binding(11) var noise_texture: texture_2d<f32>;
@group(2) @binding(0) var sheet_texture: texture_2d<f32>;

// Alpha of the field at the surface of a body.
const SURFACE: f32 = 0.5;

// Three vertices are a disc: where they are around it, if its radius is 1.
fn around(vertex: u32) -> vec2<f32> {
    let k = vertex % 3u;
    return vec2<f32>(1.7320508 * (f32(k) - 1.0), select(-1.0, 2.0, k == 1u));
}

// Six vertices are a quad: two triangles, of the corners 0, 1, 2 and 2, 1, 3.
fn corner(vertex: u32) -> vec2<f32> {
    let k = (0xda4u >> (2u * (vertex % 6u))) & 3u;
    return vec2<f32>(f32(k & 1u), f32(k >> 1u));
}

// A texel of what is known of the instances.
fn texel_of(k: u32) -> vec4<u32> {
    return textureLoad(instances, vec2<u32>(k % #{ROW}u, k / #{ROW}u), 0);
}

fn bytes_of(packed: u32) -> vec4<f32> {
    return vec4<f32>((vec4<u32>(packed) >> vec4<u32>(0u, 8u, 16u, 24u)) & vec4<u32>(255u)) / 255.0;
}

fn clip_of(point: vec2<f32>) -> vec4<f32> {
    return vec4<f32>(point * world.to_clip.xy + world.to_clip.zw, 0.0, 1.0);
}

fn point_at(uv: vec2<f32>) -> vec2<f32> {
    let clip = vec2<f32>(uv.x * 2.0 - 1.0, 1.0 - uv.y * 2.0);
    return (clip - world.to_clip.zw) / world.to_clip.xy;
}

fn uv_of(point: vec2<f32>) -> vec2<f32> {
    let clip = point * world.to_clip.xy + world.to_clip.zw;
    return vec2<f32>(clip.x * 0.5 + 0.5, 0.5 - clip.y * 0.5);
}

// The curve of sRGB as a polynomial, right to half a step of eight bits where it matters; a power would cost three times as much.
fn to_linear(srgb: vec3<f32>) -> vec3<f32> {
    let x = max(srgb, vec3<f32>(0.0));
    return x * (x * (x * 0.305306011 + 0.682171111) + 0.012522878);
}

// Brightness beyond white loses its colour little by little, as on film, and is not cut off.
fn exposed_to(rgb: vec3<f32>) -> vec3<f32> {
    let peak = max(max(rgb.r, rgb.g), rgb.b);
    let over = max(peak - 1.0, 0.0);
    return clamp(mix(rgb / max(peak, 1.0), vec3<f32>(1.0), over / (over + 1.6)), vec3<f32>(0.0), vec3<f32>(1.0));
}

// Distance to the box in pixels: negative inside.
fn outside_box(point: vec2<f32>) -> f32 {
    let half_size = world.size.xy * 0.5;
    let d = abs(point - half_size) - half_size;
    return max(d.x, d.y) * world.look.x;
}

// Light that hot things throw on a point.
fn light_at(point: vec2<f32>) -> vec3<f32> {
#ifdef GLOW
    return textureSampleLevel(light_texture, linear_sampler, point / world.fine_extent.zw, 0.0).rgb;
#else
    return vec3<f32>(0.0);
#endif
}

// Light that the matter at a point gives off itself.
fn glow_at(point: vec2<f32>) -> vec3<f32> {
#ifdef GLOW
    return textureSampleLevel(glow_texture, linear_sampler, point / world.fine_extent.xy, 0.0).rgb;
#else
    return vec3<f32>(0.0);
#endif
}

// Noise at a point, `scale` d to a period: two smooth channels, a grainy one, one of cells.
fn noise_at(point: vec2<f32>, scale: f32) -> vec4<f32> {
    return textureSampleLevel(noise_texture, repeating_sampler, point / scale, 0.0);
}

// Breaks up the bands that a dark gradient has in eight bits.
fn dither(pixel: vec2<f32>) -> f32 {
    return (fract(52.9829189 * fract(dot(pixel, vec2<f32>(0.06711056, 0.00583715)))) - 0.5) / 255.0;
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

// ---- tiles of the box that have something to be drawn

struct Tile {
    @builtin(position) position: vec4<f32>,
    @location(0) point: vec2<f32>,
}

@vertex
fn tile_vertex(@builtin(vertex_index) vertex: u32) -> Tile {
    let packed = texel_of(vertex / 6u).x;
    let tile = vec2<f32>(vec2<u32>(packed & 0xffffu, packed >> 16u));
    let point = min((tile + corner(vertex)) * world.parts.y, world.size.xy);
    var out: Tile;
    out.position = clip_of(point);
    out.point = point;
    return out;
}
