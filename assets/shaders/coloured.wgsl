// ---- matter coloured particle by particle, in the views that show a number
//
// `coloured` adds soft discs into a field, blended "over", so that its alpha 1 - Π(1 - w) never saturates early and its
// colour is a weighted mean; `shape` cuts the field where alpha passes a threshold: single particles become drops, many become
// one body.

struct Coloured {
    @builtin(position) position: vec4<f32>,
    @location(0) at: vec2<f32>,
    @location(1) colour: vec3<f32>,
}

@vertex
fn coloured_vertex(@builtin(vertex_index) vertex: u32) -> Coloured {
    let packed = texel_of(vertex / 3u);
    let position = bitcast<vec2<f32>>(packed.xy);
    let colour = bytes_of(packed.z);
    let at = around(vertex);
    var out: Coloured;
    out.position = clip_of(position + at * world.pen.x);
    out.at = at;
    out.colour = colour.rgb;
    return out;
}

// Weight of a soft disc at a place in it, -1 … 1.
fn disc(at: vec2<f32>) -> f32 {
    let fall = max(1.0 - dot(at, at), 0.0);
    return 0.8 * fall * fall;
}

@fragment
fn coloured_fragment(in: Coloured) -> @location(0) vec4<f32> {
    let weight = disc(in.at);
    return vec4<f32>(in.colour * weight, weight);
}

@fragment
fn shape_fragment(in: Tile) -> @location(0) vec4<f32> {
    let field = textureSampleLevel(field_texture, linear_sampler, uv_of(in.point), 0.0);
    let soft = clamp(fwidth(field.a) * 0.8, 0.02, 0.3);
    if field.a < SURFACE - soft {
        discard;
    }
    let cover = smoothstep(SURFACE - soft, SURFACE + soft, field.a);
    return vec4<f32>(to_linear(field.rgb / max(field.a, 0.001)), cover * world.look.y);
}
