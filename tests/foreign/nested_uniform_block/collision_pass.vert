#version 420 core
// One block with a structure in it, an instance name, and the fragment stage of its own.
struct Motion { vec3 acceleration; float step; };
struct Limits { int window; float reach; float pause; float loss; };
layout(std140) uniform Globals {
    mat4 view_projection;
    Motion motion;
    Limits contact;
    ivec2 size;
} g;
layout(binding = 3) uniform sampler2D stored_positions;

layout(location = 4) in vec3 at;
layout(location = 5) in vec3 to;
layout(location = 6) in float by;
layout(location = 7) in float since;

layout(location = 0) flat out vec3 at_next;
layout(location = 1) out vec3 to_next;
layout(location = 2) out float by_next;
layout(location = 3) out float since_next;

struct Contact { bool found; vec3 away; float distance; };

Contact nearest(vec3 own, ivec2 base) {
    Contact best = Contact(false, vec3(0.0), 100000.0);
    int side = 2 * g.contact.window + 1;
    for (int k = 0; k < side * side; ++k) {
        ivec2 texel = base - g.contact.window + ivec2(k % side, k / side);
        if (texel == base || any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, g.size)))
            continue;
        vec4 other = texelFetch(stored_positions, texel, 0);
        precise vec3 apart = own - other.xyz;
        precise float len = length(apart);
        if (other.w != 0.0 && len != 0.0 && g.contact.reach > len && best.distance > len)
            best = Contact(true, apart, len);
    }
    return best;
}

void main() {
    precise vec4 clip = g.view_projection * vec4(at, 1.0);
    precise vec2 image = (clip.xy / clip.w + vec2(1.0)) * 0.5 * vec2(g.size);
    Contact contact = Contact(false, vec3(0.0), 0.0);
    if (since < 0.0 && image.x >= 0.0 && image.y >= 0.0 && image.x < float(g.size.x) && image.y < float(g.size.y))
        contact = nearest(at, ivec2(image));
    precise vec3 direction, position;
    precise float speed, time;
    if (contact.found) {
        direction = normalize(contact.away);
        speed = by * g.contact.loss;
        time = g.contact.pause;
    } else {
        precise vec3 velocity = to * by + g.motion.acceleration * g.motion.step;
        direction = normalize(velocity);
        speed = length(velocity);
        time = since - g.motion.step;
    }
    position = at + direction * speed * g.motion.step;
    precise vec4 where = g.view_projection * vec4(position, 1.0);
    at_next = position;
    to_next = direction;
    by_next = speed;
    since_next = time;
    gl_Position = where;
}
