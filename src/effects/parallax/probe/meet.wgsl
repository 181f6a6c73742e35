// Where a ray meets a proxy: unit normal, then the distance along the ray. `bend` says how smooth edges are.
// Nearness is 1 over a plane's distance from the place, with the normal's sign; its product with the ray is 1 over the
// distance along it. LEAST is the least share of the nearest plane's inverse distance that counts: pow(0, p) is undefined in
// some languages, and a smaller share is that of a ray along the plane.

fn parallax_meet_box_smooth(place: vec3f, ray: vec3f, bend: f32, low: vec3f, high: vec3f, probe: vec3f) -> vec4f {
    let ahead_x = select(low.x - place.x, high.x - place.x, ray.x > 0.0);
    let least_x = select(low.x - probe.x, high.x - probe.x, ray.x > 0.0);
    let side_x = select(-1.0, 1.0, ray.x > 0.0);
    let nearness_x = side_x / max(side_x * ahead_x, NEAREST * side_x * least_x);
    let along_x = nearness_x * ray.x;
    let ahead_y = select(low.y - place.y, high.y - place.y, ray.y > 0.0);
    let least_y = select(low.y - probe.y, high.y - probe.y, ray.y > 0.0);
    let side_y = select(-1.0, 1.0, ray.y > 0.0);
    let nearness_y = side_y / max(side_y * ahead_y, NEAREST * side_y * least_y);
    let along_y = nearness_y * ray.y;
    let ahead_z = select(low.z - place.z, high.z - place.z, ray.z > 0.0);
    let least_z = select(low.z - probe.z, high.z - probe.z, ray.z > 0.0);
    let side_z = select(-1.0, 1.0, ray.z > 0.0);
    let nearness_z = side_z / max(side_z * ahead_z, NEAREST * side_z * least_z);
    let along_z = nearness_z * ray.z;
    let steepest = max(max(along_x, along_y), along_z);
    let scale = 1.0 / steepest;
    let square_x = along_x * scale * along_x * scale;
    let square_y = along_y * scale * along_y * scale;
    let square_z = along_z * scale * along_z * scale;
    let steep_x = square_x * square_x / max(side_x * ray.x, GRAZING);
    let steep_y = square_y * square_y / max(side_y * ray.y, GRAZING);
    let steep_z = square_z * square_z / max(side_z * ray.z, GRAZING);
    let whole = square_x * square_x + square_y * square_y + square_z * square_z;
    let first = vec3f(steep_x, steep_y, steep_z);
    let second = steep_x / max(side_x * ray.x, GRAZING) + steep_y / max(side_y * ray.y, GRAZING) + steep_z / max(side_z * ray.z, GRAZING);
    let variance = second / whole - dot(first, first) / (whole * whole);
    let power = 1.0 / min(max(2.0 * bend * sqrt(max(variance, 0.0)), LEAST_BEND), MOST_BEND);
    let weight_x = select(0.0, pow(max(along_x * scale, LEAST), power - 1.0), along_x * scale > LEAST);
    let weight_y = select(0.0, pow(max(along_y * scale, LEAST), power - 1.0), along_y * scale > LEAST);
    let weight_z = select(0.0, pow(max(along_z * scale, LEAST), power - 1.0), along_z * scale > LEAST);
    let sum = (weight_x * along_x + weight_y * along_y + weight_z * along_z) * scale;
    let normal = vec3f(weight_x * nearness_x * scale, weight_y * nearness_y * scale, weight_z * nearness_z * scale);
    let scaled = 1.0 / sqrt(dot(normal, normal));
    let unit = normal * scaled;
    return vec4f(unit, scale / pow(sum, 1.0 / power));
}

fn parallax_meet_box_sharp(place: vec3f, ray: vec3f, low: vec3f, high: vec3f, probe: vec3f) -> vec4f {
    let ahead_x = select(low.x - place.x, high.x - place.x, ray.x > 0.0);
    let least_x = select(low.x - probe.x, high.x - probe.x, ray.x > 0.0);
    let side_x = select(-1.0, 1.0, ray.x > 0.0);
    let nearness_x = side_x / max(side_x * ahead_x, NEAREST * side_x * least_x);
    let along_x = nearness_x * ray.x;
    let ahead_y = select(low.y - place.y, high.y - place.y, ray.y > 0.0);
    let least_y = select(low.y - probe.y, high.y - probe.y, ray.y > 0.0);
    let side_y = select(-1.0, 1.0, ray.y > 0.0);
    let nearness_y = side_y / max(side_y * ahead_y, NEAREST * side_y * least_y);
    let along_y = nearness_y * ray.y;
    let ahead_z = select(low.z - place.z, high.z - place.z, ray.z > 0.0);
    let least_z = select(low.z - probe.z, high.z - probe.z, ray.z > 0.0);
    let side_z = select(-1.0, 1.0, ray.z > 0.0);
    let nearness_z = side_z / max(side_z * ahead_z, NEAREST * side_z * least_z);
    let along_z = nearness_z * ray.z;
    let steepest = max(max(along_x, along_y), along_z);
    let is_x = select(0.0, 1.0, along_x >= max(along_y, along_z));
    let is_y = select(0.0, 1.0 - is_x, along_y >= along_z);
    return vec4f(side_x * is_x, side_y * is_y, side_z * (1.0 - is_x - is_y), 1.0 / steepest);
}

fn parallax_meet_planes_COUNT_smooth(
    place: vec3f, ray: vec3f, bend: f32, planes: array<vec4f, COUNT>, probe: vec3f
) -> vec4f {
    let offset = place - probe;
    var steepest = 0.0;
    for (var i = 0; i < COUNT; i++) {
        let plane = planes[i];
        let depth = max(plane.w - dot(plane.xyz, offset), NEAREST * plane.w);
        steepest = max(steepest, dot(plane.xyz, ray) / depth);
    }
    let scale = 1.0 / steepest;
    var whole = 0.0;
    var second = 0.0;
    var first_x = 0.0;
    var first_y = 0.0;
    var first_z = 0.0;
    for (var i = 0; i < COUNT; i++) {
        let plane = planes[i];
        let approach = dot(plane.xyz, ray);
        let portion = max(approach, 0.0) * scale / max(plane.w - dot(plane.xyz, offset), NEAREST * plane.w);
        let square = portion * portion;
        let over = 1.0 / max(approach, GRAZING);
        whole = whole + square * square;
        second = second + square * square * over * over;
        first_x = first_x + square * square * over * plane.x;
        first_y = first_y + square * square * over * plane.y;
        first_z = first_z + square * square * over * plane.z;
    }
    let first = vec3f(first_x, first_y, first_z);
    let variance = second / whole - dot(first, first) / (whole * whole);
    let power = 1.0 / min(max(2.0 * bend * sqrt(max(variance, 0.0)), LEAST_BEND), MOST_BEND);
    var sum = 0.0;
    var normal_x = 0.0;
    var normal_y = 0.0;
    var normal_z = 0.0;
    for (var i = 0; i < COUNT; i++) {
        let plane = planes[i];
        let nearness = scale / max(plane.w - dot(plane.xyz, offset), NEAREST * plane.w);
        let share = dot(plane.xyz, ray) * nearness;
        let weight = select(0.0, pow(max(share, LEAST), power - 1.0), share > LEAST);
        sum = sum + weight * share;
        normal_x = normal_x + weight * nearness * plane.x;
        normal_y = normal_y + weight * nearness * plane.y;
        normal_z = normal_z + weight * nearness * plane.z;
    }
    let unit = 1.0 / sqrt(normal_x * normal_x + normal_y * normal_y + normal_z * normal_z);
    return vec4f(normal_x * unit, normal_y * unit, normal_z * unit, scale / pow(sum, 1.0 / power));
}

fn parallax_meet_planes_COUNT_sharp(
    place: vec3f, ray: vec3f, planes: array<vec4f, COUNT>, probe: vec3f
) -> vec4f {
    let offset = place - probe;
    var steepest = 0.0;
    var normal_x = 0.0;
    var normal_y = 0.0;
    var normal_z = 0.0;
    for (var i = 0; i < COUNT; i++) {
        let plane = planes[i];
        let depth = max(plane.w - dot(plane.xyz, offset), NEAREST * plane.w);
        let along = dot(plane.xyz, ray) / depth;
        normal_x = select(normal_x, plane.x, along > steepest);
        normal_y = select(normal_y, plane.y, along > steepest);
        normal_z = select(normal_z, plane.z, along > steepest);
        steepest = max(steepest, along);
    }
    return vec4f(normal_x, normal_y, normal_z, 1.0 / steepest);
}
