// Where a ray meets a proxy: the normal over its cosine with the ray, then the distance along the ray. Nearness is 1 over a
// plane's distance from the place, which counts on both sides of the plane; its product with the ray is 1 over the distance
// along it. `bend` says how smooth edges are. The tiny numbers keep divisors from 0 and change no other value.

fn parallax_meet_box_smooth(place: vec3f, ray: vec3f, bend: f32, low: vec3f, high: vec3f) -> vec4f {
    let near_x = 1.0 / max(abs(select(low.x, high.x, ray.x > 0.0) - place.x), NEAREST);
    let near_y = 1.0 / max(abs(select(low.y, high.y, ray.y > 0.0) - place.y), NEAREST);
    let near_z = 1.0 / max(abs(select(low.z, high.z, ray.z > 0.0) - place.z), NEAREST);
    let along_x = abs(ray.x) * near_x;
    let along_y = abs(ray.y) * near_y;
    let along_z = abs(ray.z) * near_z;
    let top = max(along_x, along_y);
    let base = top - min(bend * max(near_x, near_y), top);
    let over_x = max(along_x - base, 0.0);
    let over_y = max(along_y - base, 0.0);
    let square = max(over_x * over_x + over_y * over_y, 1e-30);
    let unit = inverseSqrt(square);
    let both = base + square * unit;
    let wall_x = over_x * unit * near_x;
    let wall_y = over_y * unit * near_y;
    let steep = unit * (over_x * along_x + over_y * along_y);
    let top_z = max(both, along_z);
    let base_z = top_z - min(bend * max(max(wall_x, wall_y), near_z), top_z);
    let over = max(both - base_z, 0.0);
    let over_z = max(along_z - base_z, 0.0);
    let square_z = over * over + over_z * over_z;
    let scale = 1.0 / (over * steep + over_z * along_z);
    let part = over * scale;
    return vec4f(
        part * select(-wall_x, wall_x, ray.x > 0.0),
        part * select(-wall_y, wall_y, ray.y > 0.0),
        over_z * scale * select(-near_z, near_z, ray.z > 0.0),
        1.0 / (base_z + sqrt(square_z))
    );
}

fn parallax_meet_box_sharp(place: vec3f, ray: vec3f, low: vec3f, high: vec3f) -> vec4f {
    let over_x = 1.0 / (ray.x + 1e-20);
    let over_y = 1.0 / (ray.y + 1e-20);
    let over_z = 1.0 / (ray.z + 1e-20);
    let until_x = max(abs(select(low.x, high.x, ray.x > 0.0) - place.x), NEAREST) * abs(over_x);
    let until_y = max(abs(select(low.y, high.y, ray.y > 0.0) - place.y), NEAREST) * abs(over_y);
    let until_z = max(abs(select(low.z, high.z, ray.z > 0.0) - place.z), NEAREST) * abs(over_z);
    let other = min(until_y, until_z);
    let other_y = select(0.0, over_y, until_y <= until_z);
    let other_z = select(over_z, 0.0, until_y <= until_z);
    return vec4f(
        select(0.0, over_x, until_x <= other),
        select(other_y, 0.0, until_x <= other),
        select(other_z, 0.0, until_x <= other),
        min(until_x, other)
    );
}

fn parallax_meet_planes_COUNT_smooth(
    place: vec3f, ray: vec3f, bend: f32, planes: array<vec4f, COUNT>, probe: vec3f
) -> vec4f {
    let offset = place - probe;
    var both = 0.0;
    var steep = 0.0;
    var close = 0.0;
    var wall_x = 0.0;
    var wall_y = 0.0;
    var wall_z = 0.0;
    for (var i = 0; i < COUNT; i++) {
        let plane = planes[i];
        let nearness = 1.0 / max(abs(plane.w - dot(plane.xyz, offset)), NEAREST);
        let along = max(dot(plane.xyz, ray), 0.0) * nearness;
        let top = max(both, along);
        let base = top - min(bend * max(close, nearness), top);
        let over = max(both - base, 0.0);
        let ahead = max(along - base, 0.0);
        let square = max(over * over + ahead * ahead, 1e-30);
        let unit = inverseSqrt(square);
        both = base + square * unit;
        steep = unit * (over * steep + ahead * along);
        close = unit * max(over * close, ahead * nearness);
        wall_x = unit * (over * wall_x + ahead * nearness * plane.x);
        wall_y = unit * (over * wall_y + ahead * nearness * plane.y);
        wall_z = unit * (over * wall_z + ahead * nearness * plane.z);
    }
    let scale = 1.0 / steep;
    return vec4f(wall_x * scale, wall_y * scale, wall_z * scale, 1.0 / both);
}

fn parallax_meet_planes_COUNT_sharp(
    place: vec3f, ray: vec3f, planes: array<vec4f, COUNT>, probe: vec3f
) -> vec4f {
    let offset = place - probe;
    var steepest = 0.0;
    var cosine = 1.0;
    var normal_x = 0.0;
    var normal_y = 0.0;
    var normal_z = 0.0;
    for (var i = 0; i < COUNT; i++) {
        let plane = planes[i];
        let approach = dot(plane.xyz, ray);
        let along = approach / max(abs(plane.w - dot(plane.xyz, offset)), NEAREST);
        cosine = select(cosine, approach, along > steepest);
        normal_x = select(normal_x, plane.x, along > steepest);
        normal_y = select(normal_y, plane.y, along > steepest);
        normal_z = select(normal_z, plane.z, along > steepest);
        steepest = max(steepest, along);
    }
    let scale = 1.0 / cosine;
    return vec4f(normal_x * scale, normal_y * scale, normal_z * scale, 1.0 / steepest);
}
