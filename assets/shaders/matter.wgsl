// ---- bodies of liquids and powders
//
// `body` adds soft discs into two fields, each kind of matter into a channel of its own: a channel becomes 1 - Π(1 - w),
// whatever the order of the particles. `surface` cuts their union where it passes a threshold, and each point belongs to the
// strongest channel, so that two liquids have a clean line between them.

struct Body {
    @builtin(position) position: vec4<f32>,
    @location(0) at: vec2<f32>,
    @location(1) @interpolate(flat) channel: vec4<f32>,
    @location(2) @interpolate(flat) foam: f32,
}

// `traits`: channel, foam, how far the disc is drawn out, and the angle along which, as a share of a half turn.
@vertex
fn body_vertex(@builtin(vertex_index) vertex: u32) -> Body {
    let packed = texel_of(vertex / 3u);
    let position = bitcast<vec2<f32>>(packed.xy);
    let traits = bytes_of(packed.z);
    let at = around(vertex);
    let long = 1.0 + 2.0 * traits.z;
    let angle = traits.w * 3.14159265;
    let along = vec2<f32>(cos(angle), sin(angle));
    // As large as it was: what it is longer it is slimmer.
    let slim = at * vec2<f32>(long, inverseSqrt(long)) * world.pen.x;
    var out: Body;
    out.position = clip_of(position + along * slim.x + vec2<f32>(-along.y, along.x) * slim.y);
    out.at = at;
    let channel = u32(traits.x * 255.0 + 0.5);
    out.channel = vec4<f32>(f32(channel == 0u), f32(channel == 1u), f32(channel == 2u), f32(channel == 3u));
    out.foam = traits.y;
    return out;
}

// The first field: powders, two liquids, foam.
@fragment
fn body_fragment(in: Body) -> @location(0) vec4<f32> {
    let weight = disc(in.at);
    return vec4<f32>(in.channel.rgb, in.foam) * weight;
}

// The second field: four more liquids.
@fragment
fn more_fragment(in: Body) -> @location(0) vec4<f32> {
    return in.channel * disc(in.at);
}

// What there is of matter at a point: in all, and of the strongest.
struct Mix {
    all: f32,
    first: f32,
    second: f32,
    // The strongest and the next, as numbers: -1 is powder, else a liquid.
    owner: i32,
    next: i32,
}

fn stronger(found: Mix, number: i32, value: f32) -> Mix {
    var out = found;
    out.all = 1.0 - (1.0 - found.all) * (1.0 - value);
    if value > found.first {
        out.second = found.first;
        out.next = found.owner;
        out.first = value;
        out.owner = number;
    } else if value > found.second {
        out.second = value;
        out.next = number;
    }
    return out;
}

fn union_at(uv: vec2<f32>) -> f32 {
    let field = textureSampleLevel(field_texture, linear_sampler, uv, 0.0).rgb;
    var clear = (1.0 - field.r) * (1.0 - field.g) * (1.0 - field.b);
#ifdef MORE
    let more = vec4<f32>(1.0) - textureSampleLevel(more_texture, linear_sampler, uv, 0.0);
    clear *= more.r * more.g * more.b * more.a;
#endif
    return 1.0 - clear;
}

// Colour of a kind at a point, before light, and whether it can glow.
fn kind_colour(number: i32, powder: vec3<f32>) -> vec4<f32> {
    return select(world.liquids[max(number, 0)], vec4<f32>(powder, 1.0), number < 0);
}

@fragment
fn surface_fragment(in: Tile) -> @location(0) vec4<f32> {
    let uv = uv_of(in.point);
    let field = textureSampleLevel(field_texture, linear_sampler, uv, 0.0);
    var found = Mix(0.0, 0.0, 0.0, -1, -1);
    found = stronger(found, -1, field.r);
    found = stronger(found, 0, field.g);
    found = stronger(found, 1, field.b);
#ifdef MORE
    let more = textureSampleLevel(more_texture, linear_sampler, uv, 0.0);
    found = stronger(found, 2, more.r);
    found = stronger(found, 3, more.g);
    found = stronger(found, 4, more.b);
    found = stronger(found, 5, more.a);
#endif
    let body = textureSampleLevel(body_texture, linear_sampler, in.point / world.fine_extent.xy, 0.0);
    // Gaps of less than a particle in the middle of matter are no holes.
    let bulk = smoothstep(0.80, 0.95, body.a);
    let alpha = max(found.all, bulk * smoothstep(0.10, 0.30, found.all));
    // How much stronger it is a pixel to the left, and a pixel below.
    let steep = vec2<f32>(-dpdx(found.all), dpdy(found.all)) * world.look.x * 0.84;
    let soft = clamp(fwidth(found.all) * 0.8, 0.04, 0.3);
    // The line between two kinds is as sharp as a pixel.
    let lead = found.first - found.second;
    let border = 0.5 + 0.5 * clamp(lead / clamp(fwidth(lead), 0.06, 0.4), 0.0, 1.0);
    if alpha < SURFACE - soft {
        discard;
    }
    let cover = smoothstep(SURFACE - soft, SURFACE + soft, alpha);
    let kind = mix(kind_colour(found.next, body.rgb), kind_colour(found.owner, body.rgb), border);
    var rgb = kind.rgb;
    let liquid = mix(f32(found.next >= 0), f32(found.owner >= 0), border);

    // Water takes red first, all take something: deep liquid is darker and more of its own colour.
    let depth = textureSampleLevel(depth_texture, linear_sampler, in.point / world.extent.xy, 0.0).r;
    let deep = rgb * mix(vec3<f32>(0.30), rgb, vec3<f32>(0.45)) + world.abyss.rgb * 0.35;
    let shade = min(world.look.w * depth * 1.25, 0.92);
    rgb = mix(rgb * (1.0 - 0.26 * (1.0 - liquid)), mix(deep, rgb * 0.55, 1.0 - liquid), shade);

    // The surface catches light from above and a little from the left; what is inside does not.
    var slope = steep;
#ifdef RICH
    if bulk < 0.99 {
        let step = 0.42 / world.size.zw * max(world.look.x, 1.0);
        let left = union_at(uv - vec2<f32>(step.x, 0.0));
        let right = union_at(uv + vec2<f32>(step.x, 0.0));
        let above = union_at(uv - vec2<f32>(0.0, step.y));
        let below = union_at(uv + vec2<f32>(0.0, step.y));
        slope = vec2<f32>(left - right, below - above);
    }
#endif
    let facing = dot(slope, vec2<f32>(-0.30, 0.95)) / max(length(slope), 0.12);
    let rim = (1.0 - smoothstep(SURFACE, 0.93, alpha)) * (1.0 - bulk) * liquid;
    let edge = 1.0 - smoothstep(SURFACE, 0.72, alpha);
    rgb += rim * (0.10 + 0.20 * max(facing, 0.0) - 0.10 * max(-facing, 0.0));
    rgb += edge * (1.0 - bulk) * liquid * 0.30 * max(facing, 0.0);

    // Foam is white at the surface; deeper it is bubbles that only make the liquid paler.
    let white = smoothstep(0.05, 0.75, field.a) * f32(found.owner >= 0) * (0.86 - 0.55 * bulk * min(2.0 * shade, 1.0));
    rgb = mix(rgb, vec3<f32>(0.88, 0.94, 0.98) * (1.0 - 0.3 * shade), white);
#ifdef GLOW
    let lit = light_at(in.point);
    // The map of glow is coarse: what is cold beside what glows stays as it is.
    let glow = glow_at(in.point) * kind.a;
    let own = max(glow.r, max(glow.g, glow.b));
    // Crust drifts on what glows.
    let drift = noise_at(in.point + vec2<f32>(0.0, world.parts.w * 0.4), 34.0).g;
    let crust = 1.0 - 0.45 * own * smoothstep(0.45, 0.75, drift);
    rgb = (rgb * (1.0 + 1.1 * lit) + 0.10 * lit) * (1.0 - own) + glow * crust;
#endif
    return vec4<f32>(to_linear(exposed_to(rgb)), cover * world.look.y);
}
