#version 450

layout(binding = 0, std140) uniform Frame
{
    layout(row_major) mat4 viewProjection;
    vec3 gravity;
    float dt;
    ivec2 extent;
    int reach;
    float radius;
    float rest;
    float damping;
} _32;

uniform sampler2D SPIRV_Cross_CombinedpositionsSPIRV_Cross_DummySampler;

layout(location = 0) in vec3 p_position;
layout(location = 1) in vec3 p_direction;
layout(location = 2) in float p_speed;
layout(location = 3) in float p_timer;
layout(location = 0) flat out vec3 _entryPointOutput_position;
layout(location = 1) out vec3 _entryPointOutput_direction;
layout(location = 2) out float _entryPointOutput_speed;
layout(location = 3) out float _entryPointOutput_timer;

mat4 spvWorkaroundRowMajor(mat4 wrap) { return wrap; }

void main()
{
    precise vec4 _338 = vec4(p_position, 1.0) * spvWorkaroundRowMajor(_32.viewProjection);
    precise vec2 _344 = _338.xy / vec2(_338.w);
    precise vec2 _346 = _344 + vec2(1.0);
    precise vec2 _347 = _346 * 0.5;
    precise vec2 _351 = _347 * vec2(_32.extent);
    bool _581;
    vec3 _583;
    if ((p_timer < 0.0) && (all(greaterThanEqual(_351, vec2(0.0))) && all(lessThan(_351, vec2(_32.extent)))))
    {
        ivec2 _369 = ivec2(_351);
        int _372 = -_32.reach;
        bool _582;
        vec3 _584;
        _584 = vec3(0.0);
        _582 = false;
        float _590;
        bool _594;
        vec3 _597;
        int _580 = _372;
        float _591 = 100000.0;
        for (; _580 <= _32.reach; _584 = _597, _582 = _594, _580++, _591 = _590)
        {
            int _382 = -_32.reach;
            _590 = _591;
            _597 = _584;
            _594 = _582;
            bool _595;
            vec3 _598;
            float _602;
            for (int _588 = _382; _588 <= _32.reach; _590 = _602, _588++, _597 = _598, _594 = _595)
            {
                ivec2 _394 = _369 + ivec2(_588, _580);
                if ((((_588 == 0) && (_580 == 0)) || any(lessThan(_394, ivec2(0)))) || any(greaterThanEqual(_394, _32.extent)))
                {
                    _602 = _590;
                    _598 = _597;
                    _595 = _594;
                    continue;
                }
                vec4 _423 = texelFetch(SPIRV_Cross_CombinedpositionsSPIRV_Cross_DummySampler, ivec3(_394, 0).xy, 0);
                if (_423.w == 0.0)
                {
                    _602 = _590;
                    _598 = _597;
                    _595 = _594;
                    continue;
                }
                precise vec3 _433 = p_position - _423.xyz;
                float _435 = length(_433);
                bool _446 = ((_435 != 0.0) && (_435 < _32.radius)) && (_435 < _590);
                _602 = _446 ? _435 : _590;
                _598 = mix(_597, _433, bvec3(_446));
                _595 = _446 ? true : _594;
            }
        }
        _583 = _584;
        _581 = _582;
    }
    else
    {
        _583 = vec3(0.0);
        _581 = false;
    }
    vec3 _585;
    float _586;
    float _587;
    if (_581)
    {
        precise float _466 = p_speed * _32.damping;
        _587 = _32.rest;
        _586 = _466;
        _585 = normalize(_583);
    }
    else
    {
        precise vec3 _479 = p_direction * p_speed;
        precise vec3 _484 = _32.gravity * _32.dt;
        precise vec3 _485 = _479 + _484;
        precise float _496 = p_timer - _32.dt;
        _587 = _496;
        _586 = length(_485);
        _585 = normalize(_485);
    }
    precise vec3 _503 = _585 * _586;
    precise vec3 _509 = _503 * _32.dt;
    precise vec3 _510 = p_position + _509;
    precise vec4 _520 = vec4(_510, 1.0) * spvWorkaroundRowMajor(_32.viewProjection);
    _entryPointOutput_position = _510;
    _entryPointOutput_direction = _585;
    _entryPointOutput_speed = _586;
    _entryPointOutput_timer = _587;
    gl_Position = _520;
}

