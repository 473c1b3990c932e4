// The collision pass as a vertex shader in HLSL, with names of its own: row vectors, mul(v, M), or with -DCOLUMNS column
// vectors, mul(M, v), as ../hlsl_columns has it.
#ifdef COLUMNS
#define project(position) mul(viewProjection, float4(position, 1.0))
#else
#define project(position) mul(float4(position, 1.0), viewProjection)
#endif
cbuffer Frame : register(b0) {
    float4x4 viewProjection;
    float3 gravity;
    float dt;
    int2 extent;
    int reach;
    float radius;
    float rest;
    float damping;
};
Texture2D<float4> positions : register(t1);

struct Input {
    [[vk::location(0)]] float3 position : POSITION;
    [[vk::location(1)]] float3 direction : NORMAL;
    [[vk::location(2)]] float speed : TEXCOORD0;
    [[vk::location(3)]] float timer : TEXCOORD1;
};
struct Output {
    [[vk::location(0)]] nointerpolation float3 position : POSITION0;
    [[vk::location(1)]] float3 direction : NORMAL0;
    [[vk::location(2)]] float speed : TEXCOORD2;
    [[vk::location(3)]] float timer : TEXCOORD3;
    float4 clip : SV_Position;
};

Output main(Input p) {
    precise float4 clip = project(p.position);
    precise float2 place = (clip.xy / clip.w + 1.0) * 0.5 * float2(extent);
    bool inside = all(place >= 0.0) && all(place < float2(extent));
    bool hit = false;
    precise float3 away = 0.0;
    if (p.timer < 0.0 && inside) {
        int2 base = int2(place);
        float best = 100000.0;
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x) {
                int2 texel = base + int2(x, y);
                if ((x == 0 && y == 0) || any(texel < 0) || any(texel >= extent))
                    continue;
                float4 other = positions.Load(int3(texel, 0));
                if (other.w == 0.0)
                    continue;
                precise float3 apart = p.position - other.xyz;
                precise float far = length(apart);
                if (far != 0.0 && far < radius && far < best) {
                    best = far;
                    away = apart;
                    hit = true;
                }
            }
    }
    precise Output o;
    if (hit) {
        o.speed = p.speed * damping;
        o.direction = normalize(away);
        o.timer = rest;
    } else {
        precise float3 velocity = p.direction * p.speed + gravity * dt;
        o.speed = length(velocity);
        o.direction = normalize(velocity);
        o.timer = p.timer - dt;
    }
    precise float3 path = o.direction * o.speed;
    o.position = p.position + path * dt;
    o.clip = project(o.position);
    return o;
}
