#version 330 core
#extension GL_ARB_gpu_shader5 : require
in vec3 a_Position;
in vec3 a_Velocity;
in int a_Bounces;

precise out vec3 out_Position;
precise out vec3 out_Velocity;
flat out int out_Bounces;
#ifdef LOCKSTEP_TRACE
precise out vec3 trace_acceleration;
precise out vec3 trace_falling;
precise out vec3 trace_moved;
precise out float trace_distance;
flat out int trace_inside;
precise out vec3 trace_normal;
precise out float trace_into;
#define TRACE(name, value) trace_##name = value
#else
#define TRACE(name, value)
#endif

uniform float u_Tick, u_Drag, u_Elasticity, u_Radius;
uniform vec3 u_Gravity, u_Centre;

void main() {
    precise vec3 acceleration = u_Gravity - a_Velocity * u_Drag;
    precise vec3 velocity = a_Velocity + acceleration * u_Tick;
    precise vec3 position = a_Position + velocity * u_Tick;
    TRACE(acceleration, acceleration);
    TRACE(falling, velocity);
    TRACE(moved, position);
    int bounces = a_Bounces;
    precise vec3 away = position - u_Centre;
    precise float distance = length(away);
    TRACE(distance, distance);
    TRACE(inside, distance < u_Radius ? 1 : 0);
    if (distance < u_Radius) {
        precise vec3 normal = normalize(away);
        precise float into = dot(velocity, normal);
        TRACE(normal, normal);
        TRACE(into, into);
        velocity = velocity - normal * (into * (1.0 + u_Elasticity));
        position = u_Centre + normal * u_Radius;
        bounces = bounces + 1;
    }
    if (position.y < 0.0) {
        position.y = 0.0;
        velocity = vec3(0.0);
    }
    out_Position = position;
    out_Velocity = velocity;
    out_Bounces = bounces;
}
