// ---- the box with its air, and what lies around it

@fragment
fn backdrop_fragment(in: Screen) -> @location(0) vec4<f32> {
    let point = point_at(in.uv);
    let out_pixels = outside_box(point) / world.pen.w;
    let height = clamp(point.y / world.size.y, 0.0, 1.0);
    var inside = mix(world.box_bottom.rgb, world.box_top.rgb, height * height * (3.0 - 2.0 * height));
    // Darker towards the frame.
    let deep = 1.0 + max(-out_pixels, 0.0) / 18.0;
    inside *= 1.0 - 0.22 / (deep * deep);
#ifdef GLOW
    // What glows lights the haze around it.
    let haze = light_at(point);
    inside += haze * (0.16 + 0.5 * inside);
#endif
#ifdef AIR
    let air = textureSampleLevel(air_texture, linear_sampler, point / world.extent.zw, 0.0);
    inside = inside * (1.0 - air.a) + air.rgb;
#endif
#ifdef GLOW
    inside = exposed_to(inside);
#endif
    let far = 1.0 + max(out_pixels - 2.0, 0.0) / 7.0;
    let around = world.surroundings.rgb * (1.0 - 0.45 / (far * far));
    let border = smoothstep(-0.5, 0.5, out_pixels);
    let beyond = smoothstep(1.5, 2.5, out_pixels);
    let rgb = mix(mix(inside, world.frame.rgb, border), around, beyond);
    return vec4<f32>(to_linear(rgb + dither(in.position.xy)), 1.0);
}

// ---- a picture of fewer pixels than the window, over all of it

@fragment
fn enlarged_fragment(in: Screen) -> @location(0) vec4<f32> {
    return textureSampleLevel(sheet_texture, linear_sampler, in.uv, 0.0);
}

// ---- a picture on its sheet, inside a ring

@fragment
fn lens_fragment(in: Screen) -> @location(0) vec4<f32> {
    let beyond = distance(in.uv * world.size.zw, world.lens.xy) - world.lens.z;
    return vec4<f32>(textureSampleLevel(sheet_texture, linear_sampler, in.uv, 0.0).rgb, clamp(0.5 - beyond, 0.0, 1.0));
}
