#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>

#include "reference/model/error.hpp"
#include "tests/text/text_kernel.hpp"

namespace lockstep::test::kernels_test {

namespace {

std::string refusal(const std::string& text) {
    try {
        TextKernel kernel(text);
        kernel.blocks["Out"].resize(16);
        kernel.run();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

const std::string head = "layout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer Out { float x[]; };\n";

} // namespace

TEST_CASE("text: loops, branches, switches and calls take the path that their conditions say") {
    const std::vector<float> x = computed(R"(
        int sum = 0;
        for (int i = 0; i < 10; ++i) {
            if (i == 3) continue;
            if (i == 8) break;
            sum += i;
        }
        x[0] = float(sum);
        int n = 27, steps = 0;
        while (n != 1) { n = n % 2 == 0 ? n / 2 : 3 * n + 1; steps++; }
        x[1] = float(steps);
        do { x[2] += 1.0; } while (x[2] < 5.0);
        for (int k = 0; k < 5; ++k)
            switch (k) {
            case 1: x[3] += 1.0;
            case 2: x[3] += 10.0; break;
            case 4: x[3] += 100.0; break;
            default: x[3] += 1000.0;
            }
        x[4] = factorial_like(5);
        float a = 1.0, b = 2.0;
        swap(a, b);
        x[5] = a * 10.0 + b;
        bool both = a > b && b > 0.0 || a < 0.0;
        x[6] = both ? 1.0 : 0.0;
        x[7] = early(3.0) + early(-3.0);)",
                                          R"(
        float factorial_like(int n) { float p = 1.0; for (int i = 2; i <= n; ++i) p *= float(i); return p; }
        void swap(inout float u, inout float v) { float t = u; u = v; v = t; }
        float early(float v) { if (v < 0.0) return -1.0; return v; })");
    CHECK(x[0] == 25.0F);
    CHECK(x[1] == 111.0F);
    CHECK(x[2] == 5.0F);
    CHECK(x[3] == 1.0F + 20.0F + 100.0F + 2000.0F);
    CHECK(x[4] == 120.0F);
    CHECK(x[5] == 21.0F);
    CHECK(x[6] == 1.0F);
    CHECK(x[7] == 2.0F);
}

TEST_CASE("text: invocations that branches part meet again with their own values") {
    TextKernel kernel(R"(layout(local_size_x = 32) in;
        layout(std430, binding = 0) buffer Out { float x[]; };
        float root(float v) { float y = v; for (int i = 0; i < int(gl_LocalInvocationID.x % 7u); ++i) y = y * 0.5 + 1.0; return y; }
        void main() {
            uint i = gl_GlobalInvocationID.x;
            float v = float(i), kept = v * 3.0;
            for (uint k = 0u; k < i; ++k) {
                if (k % 3u == 0u) continue;
                if (k > 20u) break;
                v += root(float(k));
            }
            if (i % 2u == 0u) { x[i] = v + kept; return; }
            x[i] = (i % 5u == 0u ? root(v) : v) - kept;
        })");
    kernel.blocks["Out"].resize(96);
    kernel.run({3, 1, 1});
    const std::vector<float> x = floats_of(kernel.blocks["Out"]);
    for (std::uint32_t i = 0; i < 96; ++i) {
        const auto root = [&](float y) {
            for (std::uint32_t k = 0; k < i % 32 % 7; ++k)
                y = y * 0.5F + 1.0F;
            return y;
        };
        float v = static_cast<float>(i), kept = v * 3.0F;
        for (std::uint32_t k = 0; k < i; ++k) {
            if (k % 3 == 0)
                continue;
            if (k > 20)
                break;
            v += root(static_cast<float>(k));
        }
        INFO("invocation " << i);
        CHECK(x[i] == (i % 2 == 0 ? v + kept : (i % 5 == 0 ? root(v) : v) - kept));
    }
}

TEST_CASE("text: vectors, matrices, arrays and structures keep their parts apart") {
    const std::vector<float> x = computed(R"(
        vec4 v = vec4(1.0, 2.0, 3.0, 4.0);
        v.xy = v.yx;
        v.zw *= 2.0;
        x[0] = v.x * 1000.0 + v.y * 100.0 + v.z * 10.0 + v.w;
        mat3 m = mat3(1, 2, 3, 4, 5, 6, 7, 8, 10);
        vec3 product = m * vec3(1.0, 0.0, 2.0), other = vec3(1.0, 0.0, 2.0) * m;
        x[1] = product.x + product.y * 100.0;
        x[2] = other.x + other.y * 100.0;
        x[3] = (m * transpose(m))[1][2];
        float a[5];
        for (int i = 0; i < 5; ++i) a[i] = float(i * i);
        int at = 3;
        a[at] += a[at - 1];
        x[4] = a[3] + a[4];
        Thing things[2];
        things[0] = Thing(vec2(1.0, 2.0), 7);
        things[1] = things[0];
        things[1].place.y = 5.0;
        things[at - 3].count += 1;
        x[5] = things[1].place.y + things[0].place.y * 10.0 + float(things[0].count) * 100.0;
        vec3 w = vec3(1.0);
        w[at - 2] = 9.0;
        x[6] = w.y + w[at - 1];
        x[7] = determinant(m);
        x[8] = (inverse(mat2(2, 0, 0, 4)))[1][1];
        m[at - 2].z = 50.0;
        x[9] = m[1].z;
        v = v.wzyx + v;
        x[10] = v.x;
        mat2x3 wide = outerProduct(w + vec3(0, 0, 2), vec2(x[9], 5));
        x[11] = wide[1].z;)",
                                          "struct Thing { vec2 place; int count; };");
    CHECK(x[0] == 2000.0F + 100.0F + 60.0F + 8.0F);
    CHECK(x[1] == 15.0F + 1800.0F);
    CHECK(x[2] == 7.0F + 1600.0F);
    CHECK(x[3] == 6.0F + 30.0F + 80.0F);
    CHECK(x[4] == 9.0F + 4.0F + 16.0F);
    CHECK(x[5] == 5.0F + 20.0F + 800.0F);
    CHECK(x[6] == 10.0F);
    CHECK(x[7] == -3.0F);
    CHECK(x[8] == 0.25F);
    CHECK(x[9] == 50.0F);
    CHECK(x[10] == 10.0F);
    CHECK(x[11] == 15.0F);
}

TEST_CASE("text: blocks of every layout are read and written where GLSL puts their members") {
    TextKernel kernel(R"(layout(local_size_x = 1) in;
        struct Inner { vec3 a; float b; };
        layout(std140, binding = 0) uniform Params { float p; vec3 q; float r[2]; layout(row_major) mat2 m; Inner inner; } params;
        layout(std430, binding = 1) buffer Data { uint count; vec3 v; mat2x3 m; Inner items[]; };
        void main() {
            v = params.q + params.p;
            m[1] = vec3(params.r[1], params.m[0][1], params.m[1][0]);
            count = uint(items.length());
            for (int i = 0; i < items.length(); ++i) items[i].b = params.inner.b + float(i);
            m[0] = items[1].a;
        })");
    // std140: p at word 0, q at 4, r at 8 and 12, m's rows at 16 and 20, inner at 24.
    std::vector<float> params(28);
    params[0] = 0.5F, params[4] = 1.0F, params[5] = 2.0F, params[6] = 3.0F, params[12] = 7.0F;
    params[16] = 11.0F, params[17] = 12.0F, params[20] = 21.0F, params[21] = 22.0F, params[27] = 100.0F;
    kernel.blocks["Params"] = words_of(params);
    // std430: count at word 0, v at 4, m's columns at 8 and 12, items from 16, of 4 words each.
    std::vector<float> data(16 + 3 * 4);
    data[20] = 31.0F, data[21] = 32.0F, data[22] = 33.0F;
    kernel.blocks["Data"] = words_of(data);
    kernel.run();
    const std::vector<float> after = floats_of(kernel.blocks["Data"]);
    CHECK(kernel.blocks["Data"][0] == 3);
    CHECK(std::vector(after.begin() + 4, after.begin() + 7) == std::vector{1.5F, 2.5F, 3.5F});
    CHECK(std::vector(after.begin() + 12, after.begin() + 15) == std::vector{7.0F, 21.0F, 12.0F});
    CHECK(std::vector(after.begin() + 8, after.begin() + 11) == std::vector{31.0F, 32.0F, 33.0F});
    CHECK((after[19] == 100.0F && after[23] == 101.0F && after[27] == 102.0F));
    CHECK(kernel.findings.all().empty());
}

TEST_CASE("text: plain uniforms go by GL's names, members and elements included") {
    TextKernel kernel(R"(layout(local_size_x = 1) in;
        layout(std430, binding = 0) buffer Out { float x[]; };
        struct Light { vec3 colour; float power[2]; };
        uniform Light lights[2];
        uniform mat2 turn;
        uniform bool on;
        uniform uint many = 5u;
        void main() {
            x[0] = lights[1].colour.y + lights[0].power[1];
            x[1] = (turn * vec2(1.0, 2.0)).x;
            x[2] = on ? float(many) : -1.0;
        })");
    kernel.blocks["Out"].resize(3);
    kernel.uniforms["lights[1].colour"] = words_of({1.0F, 2.0F, 3.0F});
    kernel.uniforms["lights[0].power"] = words_of({10.0F, 20.0F});
    kernel.uniforms["turn"] = words_of({1.0F, 2.0F, 3.0F, 4.0F});
    kernel.uniforms["on"] = {7};
    kernel.run();
    CHECK(floats_of(kernel.blocks["Out"]) == std::vector{22.0F, 7.0F, 5.0F});
}

TEST_CASE("text: integers wrap, shift and divide as GLSL says") {
    const std::vector<float> x = computed(R"(
        uint big = 0xffffffffu;
        x[0] = float(big + 2u);
        int negative = -7;
        x[1] = float(negative / 2) * 100.0 + float(negative >> 1);
        x[2] = float(bitfieldExtract(0xf0u, 4, 4)) + float(bitfieldExtract(-1, 0, 3));
        x[3] = float(bitfieldInsert(0u, 5u, 2, 3)) + float(bitCount(255)) * 100.0;
        x[4] = float(findMSB(1000)) + float(findLSB(8)) * 100.0 + float(findMSB(-1)) * 10000.0;
        uint high, low;
        umulExtended(big, big, high, low);
        x[5] = float(high == 0xfffffffeu && low == 1u);
        x[6] = float(uint(3000000000.0) == 3000000000u);
        x[7] = intBitsToFloat(floatBitsToInt(1.5) + 1);
        x[8] = unpackHalf2x16(packHalf2x16(vec2(0.333, -2.0))).x;
        x[9] = float(packUnorm4x8(vec4(1.0, 0.0, 0.5, 0.0)));
        x[10] = float(clamp(5, -2, 3)) + float(min(2u, 7u)) * 10.0;)");
    CHECK(x[0] == 1.0F);
    CHECK(x[1] == -304.0F);
    CHECK(x[2] == 14.0F);
    CHECK(x[3] == 820.0F);
    CHECK(x[4] == 9.0F + 300.0F - 10000.0F);
    CHECK(x[5] == 1.0F);
    CHECK(x[6] == 1.0F);
    CHECK(x[7] == std::nextafter(1.5F, 2.0F));
    CHECK(x[8] == 0.333007812F);
    CHECK(x[9] == static_cast<float>(255U + (128U << 16U)));
    CHECK(x[10] == 23.0F);
}

TEST_CASE("text: built-in functions of floats are GLSL's, dot and its like in the profile's order") {
    const std::string text = R"(
        vec3 v = vec3(x[0], x[1], x[2]);
        x[0] = dot(v, v);
        x[1] = length(v);
        x[2] = normalize(v).y;
        x[3] = mix(1.0, 3.0, 0.25) + step(0.5, 0.4) + smoothstep(0.0, 2.0, 1.0);
        x[4] = mod(-1.5, 1.0) + fract(2.25) + floor(-0.5) + ceil(0.5) + sign(-3.0) + trunc(-1.7);
        x[5] = reflect(vec2(1.0, -1.0), vec2(0.0, 1.0)).y + distance(vec2(0.0, 3.0), vec2(4.0, 0.0));
        x[6] = sin(1.0);
        x[7] = pow(2.0, 0.5);
        x[8] = atan(1.0, -1.0);
        x[9] = inversesqrt(4.0) + sqrt(9.0) + exp2(3.0) + log2(8.0);
        x[10] = cross(vec3(1, 0, 0), vec3(0, 1, 0)).z + faceforward(vec2(1.0), vec2(1.0), vec2(1.0)).x;
        x[11] = fma(x[11], x[12], x[13]);
        x[12] = refract(vec2(0.0, -1.0), vec2(0.0, 1.0), 0.5).y;
        x[13] = min(1.0, 2.0) + max(vec2(1.0), vec2(3.0)).y + clamp(5.0, 0.0, 1.0) + abs(-1.0);)";
    std::vector<float> given(16);
    given[0] = 0.1F, given[1] = 0.7F, given[2] = 0.3F;
    given[11] = 1.0F + 0x1p-23F, given[12] = 1.0F - 0x1p-23F, given[13] = -1.0F;
    const std::vector<float> x = computed(text, "", given);
    CHECK(x[0] == 0.1F * 0.1F + (0.7F * 0.7F + 0.3F * 0.3F)); // llvmpipe sums from the right
    CHECK(x[1] == std::sqrt(x[0]));
    CHECK(x[2] == 0.7F * (1.0F / std::sqrt(x[0])));
    CHECK(x[3] == 1.5F + 0.0F + 0.5F);
    CHECK(x[4] == 0.5F + 0.25F - 1.0F + 1.0F - 1.0F - 1.0F);
    CHECK(x[5] == 6.0F);
    CHECK(x[6] == std::sin(1.0F));
    CHECK(x[7] == static_cast<float>(std::sqrt(2.0)));
    CHECK(x[8] == static_cast<float>(std::atan2(1.0, -1.0)));
    CHECK(x[9] == 0.5F + 3.0F + 8.0F + 3.0F);
    CHECK(x[10] == 0.0F);
    CHECK(x[11] == -0x1p-46F);
    CHECK(x[12] == -1.0F);
    CHECK(x[13] == 6.0F);
}

TEST_CASE("text: a group goes from barrier to barrier, whatever its size, and its shared memory is its own") {
    TextKernel kernel(R"(layout(local_size_x = 48) in;
        layout(std430, binding = 0) buffer Out { uint x[]; };
        shared uint sums[48];
        shared uint most;
        void main() {
            uint i = gl_LocalInvocationID.x;
            if (i == 0u) most = 0u;
            sums[i] = x[gl_GlobalInvocationID.x];
            for (uint far = 1u; far < 48u; far *= 2u) {
                barrier();
                uint added = i >= far ? sums[i - far] : 0u;
                barrier();
                sums[i] += added;
            }
            atomicMax(most, sums[i]);
            barrier();
            x[gl_GlobalInvocationID.x] = sums[i] + (gl_WorkGroupID.x << 16) + (most << 24);
        })");
    std::vector<std::uint32_t>& x = kernel.blocks["Out"];
    x.assign(96, 1);
    kernel.run({2, 1, 1});
    for (std::uint32_t i = 0; i < 96; ++i)
        CHECK(x[i] == i % 48 + 1 + (i / 48 << 16U) + (48U << 24U));
}

TEST_CASE("text: atomic operations return what was there, and leave what they say") {
    TextKernel kernel(R"(layout(local_size_x = 1) in;
        layout(std430, binding = 0) buffer Out { uint x[8]; int y[4]; };
        layout(r32ui, binding = 0) uniform uimage2D image;
        void main() {
            x[1] = atomicAdd(x[0], 5u);
            x[3] = atomicCompSwap(x[2], 9u, 4u) + atomicExchange(x[2], 7u);
            x[5] = atomicXor(x[4], 6u) + atomicAnd(x[4], 3u) + atomicOr(x[4], 8u);
            y[1] = atomicMin(y[0], -3) + atomicMax(y[0], 2);
            x[6] = imageAtomicAdd(image, ivec2(1, 0), 3u) + imageLoad(image, ivec2(1, 0)).x;
        })");
    kernel.blocks["Out"] = {10, 0, 9, 0, 5, 0, 0, 0, 1, 0, 0, 0};
    kernel.images["image"] = {{.size = {2, 1, 1}, .components = 1}, {0, 40}};
    kernel.run();
    CHECK(kernel.blocks["Out"] ==
          std::vector<std::uint32_t>{15, 10, 7, 13, 11, 5 + 3 + 3, 83, 0, 2, static_cast<std::uint32_t>(1 - 3), 0, 0});
    CHECK(kernel.images["image"].words[1] == 43);
}

TEST_CASE("text: images are fetched and stored as their format has them; beyond them they are 0") {
    TextKernel kernel(R"(layout(local_size_x = 1) in;
        layout(std430, binding = 0) buffer Out { float x[]; };
        uniform sampler2D source;
        layout(rgba8) uniform image2D codes;
        layout(r32f) uniform image3D volume;
        void main() {
            x[0] = texelFetch(source, ivec2(1, 1), 0).y;
            x[1] = texelFetch(source, ivec2(1, 1), 0).w;
            x[2] = float(textureSize(source, 0).x * 10 + imageSize(volume).z);
            imageStore(codes, ivec2(0), vec4(0.5, 2.0, -1.0, 1.0));
            x[3] = imageLoad(codes, ivec2(0)).x;
            imageStore(volume, ivec3(1, 0, 1), vec4(3.0));
            imageStore(volume, ivec3(2, 0, 1), vec4(4.0));
            x[4] = imageLoad(volume, ivec3(-1, 0, 0)).x;
        })");
    kernel.blocks["Out"].resize(5);
    kernel.images["source"] = {{.size = {2, 2, 1}, .components = 2}, words_of({0, 0, 0, 0, 0, 0, 7.0F, 8.0F})};
    kernel.images["codes"] = {{.size = {1, 1, 1}, .components = 4, .code = text::TexelMemory::Code::unorm8},
                              std::vector<std::uint32_t>(4)};
    kernel.images["volume"] = {{.size = {2, 1, 2}, .components = 1}, std::vector<std::uint32_t>(4)};
    kernel.run();
    CHECK(floats_of(kernel.blocks["Out"]) == std::vector{8.0F, 1.0F, 22.0F, 128.0F / 255.0F, 0.0F});
    CHECK(kernel.images["codes"].words == std::vector<std::uint32_t>{128, 255, 0, 255});
    CHECK(floats_of(kernel.images["volume"].words) == std::vector{0.0F, 0.0F, 0.0F, 3.0F});
}

TEST_CASE("text: texture() mixes the texels around a place, clamped at the edges or black beyond them") {
    TextKernel kernel(R"(layout(local_size_x = 1) in;
        layout(std430, binding = 0) buffer Out { float x[]; };
        uniform sampler2D clamped, black, nearest;
        void main() {
            x[0] = texture(clamped, vec2(0.5, 0.5)).x;
            x[1] = texture(clamped, vec2(0.0, 0.0)).x;
            x[2] = texture(black, vec2(0.0, 0.25)).x;
            x[3] = textureLod(nearest, vec2(0.6, 0.2), 0.0).x;
        })");
    kernel.blocks["Out"].resize(4);
    const std::vector<std::uint32_t> texels = words_of({4.0F, 8.0F, 12.0F, 24.0F});
    using Filter = text::TexelMemory::Filter;
    kernel.images["clamped"] = {{.size = {2, 2, 1}, .components = 1, .filter = Filter::linear}, texels};
    kernel.images["black"] = {{.size = {2, 2, 1}, .components = 1, .filter = Filter::linear_in_black}, texels};
    kernel.images["nearest"] = {{.size = {2, 2, 1}, .components = 1}, texels};
    kernel.run();
    CHECK(floats_of(kernel.blocks["Out"]) == std::vector{12.0F, 4.0F, 2.0F, 8.0F});
}

TEST_CASE("text: modf, frexp and expressions of specialisation constants") {
    const std::vector<float> x = computed(R"(
        float whole;
        vec2 wholes;
        int power;
        ivec2 powers;
        x[0] = modf(x[8], whole);
        x[1] = whole;
        vec2 rest = modf(vec2(x[9], 2.0), wholes);
        x[2] = rest.x + 10.0 * wholes.x + 100.0 * wholes.y;
        x[3] = frexp(x[8], power) * 100.0 + float(power);
        vec2 parts = frexp(vec2(x[10], 0.0), powers);
        x[4] = parts.x + parts.y + float(powers.x) * 10.0 + float(powers.y);
        x[5] = float(list.length()) + float(rounded.y) + (is_large ? 1000.0 : 0.0);)",
                                          R"(
        layout(constant_id = 1) const int count = 4;
        const int more = count * 3 - 5;
        const ivec2 rounded = ivec2(count, count) / 3 + 100;
        const bool is_large = !(count == 5);
        float list[more];)",
                                          {0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, -3.75F, 5.5F, 0.375F});
    CHECK(x[0] == -0.75F);
    CHECK(x[1] == -3.0F);
    CHECK(x[2] == 0.5F + 50.0F + 200.0F);
    CHECK(x[3] == -93.75F + 2.0F);
    CHECK(x[4] == 0.75F - 10.0F);
    CHECK(x[5] == 7.0F + 101.0F + 1000.0F);
}

TEST_CASE("text: arrays of blocks and of images, layers, and offsets of texels") {
    TextKernel kernel(R"(layout(local_size_x = 4) in;
        layout(std430, binding = 0) buffer Out { float x[]; };
        layout(std430, binding = 1) buffer Part { int length; float part[]; } parts[2];
        layout(binding = 0) uniform sampler2D u_Pair[2];
        layout(binding = 2) uniform sampler2DArray u_Layers;
        layout(binding = 0, r32ui) uniform uimage2D u_Owners;
        layout(binding = 1, r32f) uniform writeonly image2D u_Made[2];
        void main() {
            uint i = gl_LocalInvocationID.x;
            x[i] = texelFetch(u_Pair[i % 2u], ivec2(i / 2u, 1), 0).x;
            x[4u + i] = texelFetchOffset(u_Pair[1], ivec2(0, 0), 0, ivec2(1, 1)).x +
                        textureGrad(u_Pair[0], vec2(0.75, 0.25), vec2(0.0), vec2(0.0)).x;
            x[8u + i] = texelFetch(u_Layers, ivec3(1, 0, int(i)), 0).x + texture(u_Layers, vec3(0.25, 0.25, float(i) - 0.7)).x;
            parts[1].part[i] = parts[0].part[3u - i] + float(parts[0].part.length()) + float(textureSize(u_Layers, 0).z);
            imageStore(u_Made[i % 2u], ivec2(i / 2u, 0), vec4(float(i)));
            x[12u + i] = float(imageAtomicCompSwap(u_Owners, ivec2(1, 1), i, i + 1u));
        })");
    const auto image = [&](const std::string& name, std::array<std::uint32_t, 3> size, std::vector<float> floats) {
        kernel.images[name] = {{.size = size, .components = 1}, words_of(floats)};
    };
    image("u_Pair[0]", {2, 2, 1}, {1.0F, 2.0F, 3.0F, 4.0F});
    image("u_Pair[1]", {2, 2, 1}, {10.0F, 20.0F, 30.0F, 40.0F});
    image("u_Layers", {2, 1, 4}, {1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F, 7.0F, 8.0F});
    image("u_Made[0]", {2, 1, 1}, {9.0F, 9.0F});
    image("u_Made[1]", {2, 1, 1}, {9.0F, 9.0F});
    kernel.images["u_Owners"] = {{.size = {2, 2, 1}, .components = 1}, std::vector<std::uint32_t>(4)};
    kernel.blocks["Out"].resize(16);
    kernel.blocks["Part[0]"] = words_of({0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F});
    kernel.blocks["Part[1]"].resize(5);
    kernel.run();
    CHECK(floats_of(kernel.blocks["Out"]) == std::vector<float>{3.0F, 30.0F, 4.0F, 40.0F, 42.0F, 42.0F, 42.0F, 42.0F,
                                                                3.0F, 5.0F, 9.0F, 13.0F, 0.0F, 1.0F, 2.0F, 3.0F});
    CHECK(floats_of(kernel.blocks["Part[1]"]) == std::vector<float>{0.0F, 13.0F, 12.0F, 11.0F, 10.0F});
    CHECK(floats_of(kernel.images["u_Made[0]"].words) == std::vector<float>{0.0F, 2.0F});
    CHECK(floats_of(kernel.images["u_Made[1]"].words) == std::vector<float>{1.0F, 3.0F});
    CHECK(kernel.images["u_Owners"].words == std::vector<std::uint32_t>{0, 0, 0, 4});
}

TEST_CASE("text: cubes, samples, shadows, offsets and projections") {
    TextKernel kernel(R"(layout(local_size_x = 1) in;
        layout(std430, binding = 0) buffer Out { float x[]; };
        uniform samplerCube u_Sky;
        layout(r32f) uniform imageCube u_Faces;
        uniform sampler2DMS u_Samples;
        layout(r32f) uniform image2DMS u_Painted;
        uniform sampler2DShadow u_Shadow;
        uniform sampler2D u_Plain;
        void main() {
            vec3 to[6] = vec3[](vec3(2, 1, 1), vec3(-2, 1, 1), vec3(1, 2, 1), vec3(1, -2, 1), vec3(1, 1, 2), vec3(1, 1, -2));
            for (int face = 0; face < 6; ++face)
                x[face] = texture(u_Sky, to[face]).x;
            x[6] = imageLoad(u_Faces, ivec3(1, 0, 5)).x + float(imageSize(u_Faces).x) + float(textureSize(u_Sky, 0).y);
            x[7] = texelFetch(u_Samples, ivec2(1, 0), 1).x + 10.0 * float(textureSamples(u_Samples));
            imageStore(u_Painted, ivec2(0, 0), 1, vec4(8.0));
            x[8] = imageLoad(u_Painted, ivec2(0, 0), 1).x;
            x[9] = texture(u_Shadow, vec3(0.75, 0.5, 2.0)) + 10.0 * texture(u_Shadow, vec3(0.25, 0.5, 2.0));
            x[10] = textureProj(u_Shadow, vec4(1.5, 1.0, 4.0, 2.0));
            x[11] = textureProj(u_Plain, vec3(0.5, 1.0, 2.0)).x;
            x[12] = textureOffset(u_Plain, vec2(0.25, 0.5), ivec2(1, 0)).x + textureLodOffset(u_Plain, vec2(0.25, 0.5), 0.0, ivec2(-3, 2)).x;
        })");
    const auto image = [&](const std::string& name, std::array<std::uint32_t, 3> size, std::vector<float> floats) {
        kernel.images[name] = {{.size = size, .components = 1}, words_of(floats)};
    };
    std::vector<float> sky(24);
    std::iota(sky.begin(), sky.end(), 0.0F);
    image("u_Sky", {2, 2, 6}, sky);
    image("u_Faces", {2, 2, 6}, sky);
    image("u_Samples", {2, 1, 2}, {1.0F, 2.0F, 3.0F, 4.0F});
    image("u_Painted", {1, 1, 2}, {0.0F, 0.0F});
    image("u_Shadow", {2, 1, 1}, {1.0F, 2.0F});
    image("u_Plain", {2, 1, 1}, {5.0F, 7.0F});
    kernel.blocks["Out"].resize(13);
    kernel.run();
    // Each face's texel by GL 4.6, table 8.19: s and t of (2, 1, 1) on +x are -1/2, and so on.
    CHECK(floats_of(kernel.blocks["Out"]) == std::vector<float>{0.0F, 5.0F, 11.0F, 13.0F, 17.0F, 20.0F, 21.0F + 4.0F,
                                                                24.0F, 8.0F, 1.0F, 1.0F, 5.0F, 12.0F});
}

TEST_CASE("text: what is not interpreted is refused by name and line") {
    using Catch::Contains;
    CHECK_THAT(refusal(head + "void main() {\n    double d = double(x[0]);\n    x[0] = float(d);\n}\n"),
               Contains("floats of 64 bits are not interpreted; expected 32"));
    CHECK_THAT(refusal("#extension GL_KHR_shader_subgroup_arithmetic : require\n" + head +
                       "void main() {\n    x[0] = subgroupAdd(x[0]);\n}\n"),
               Contains("kernel.comp:5: the size of subgroups is the driver's"));
    CHECK_THAT(refusal(head + "void main() {\n    while (x[0] == 0.0)\n        x[1] += 1.0;\n}\n"),
               Contains("does not end: no end within"));
    CHECK_THAT(refusal(head + "void main() {\n    x[0] = undeclared;\n}\n"), Contains("kernel.comp:4: "));
}

} // namespace lockstep::test::kernels_test
