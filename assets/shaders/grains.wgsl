// ---- grains: each with a shade of its own
//
// They lie on the bodies of their powders, which are darker: where two overlap the lighter is seen, whichever is drawn first.

struct Grain {
    @builtin(position) position: vec4<f32>,
    @location(0) at: vec2<f32>,
    // Its colour, and the share of it that is light of its own.
    @location(1) @interpolate(flat) colour: vec4<f32>,
    @location(2) @interpolate(flat) light: vec3<f32>,
}

// Radius of a grain's disc, d.
const GRAIN: f32 = 0.56;

@vertex
fn grain_vertex(@builtin(vertex_index) vertex: u32) -> Grain {
    let packed = texel_of(vertex / 3u);
    let position = bitcast<vec2<f32>>(packed.xy);
    let colour = bytes_of(packed.z);
    let at = around(vertex);
    var out: Grain;
    // A pixel of room for the soft edge.
    let radius = GRAIN + 0.7 / world.look.x;
    out.position = clip_of(position + at * radius);
    out.at = at * radius;
    out.colour = colour;
    // Under deep matter it is as dark as that.
    let depth = textureSampleLevel(depth_texture, linear_sampler, position / world.extent.xy, 0.0).r;
    let shade = 1.0 - 0.52 * min(world.look.w * depth * 1.25, 0.92);
    out.light = shade + 1.2 * light_at(position);
    return out;
}

@fragment
fn grain_fragment(in: Grain) -> @location(0) vec4<f32> {
    let radius = length(in.at);
    let cover = clamp((GRAIN - radius) * world.look.x + 0.5, 0.0, 1.0);
    // A ball, lit from above and a little from the left.
    let round = 1.0 + 0.22 * dot(in.at, vec2<f32>(-0.35, 0.94)) / GRAIN - 0.14 * radius * radius / (GRAIN * GRAIN);
    let rgb = in.colour.rgb * mix(in.light * round, vec3<f32>(1.0), in.colour.a);
    return vec4<f32>(to_linear(exposed_to(rgb)) * cover, cover);
}
