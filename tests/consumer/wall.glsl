uniform float u_Kept;

// What a wall with this normal leaves of a velocity.
vec3 bounce(vec3 velocity, vec3 normal) {
    precise float into = velocity.x * normal.x + (velocity.y * normal.y + velocity.z * normal.z);
    precise vec3 left = velocity - normal * (into * (1.0 + u_Kept));
    return left;
}
