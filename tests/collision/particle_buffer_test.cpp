#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "gpu/check.hpp"
#include "gpu/collision/particle_buffer.hpp"
#include "reference/model/state_hash.hpp"
#include "tests/gpu/any_context.hpp"
#include "tests/gpu/one_texel_target.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::particle_buffer_test {

using test::open_context;
using test::TemporaryFolder;

namespace {

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

/// Every float has a pattern of its own; among them NaNs with payload, infinities, subnormals and -0.
Particles varied(std::size_t count) {
    std::uint32_t state = 1;
    const auto next = [&] {
        state = state * 1664525U + 1013904223U;
        return std::bit_cast<float>(state);
    };
    Particles p;
    p.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        p.position[i] = {next(), next(), next()};
        p.direction[i] = {next(), next(), next()};
        p.speed[i] = next();
        p.collide_time[i] = next();
    }
    p.speed[0] = std::bit_cast<float>(0x7f812345U);
    p.speed[1] = -std::numeric_limits<float>::infinity();
    p.position[0].x = std::numeric_limits<float>::denorm_min();
    p.direction[0].z = -0.0F;
    return p;
}

bool same_bits(const Particles& a, const Particles& b) {
    const auto same = [](const auto& x, const auto& y) {
        return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
    };
    return same(a.position, b.position) && same(a.direction, b.direction) && same(a.speed, b.speed) &&
           same(a.collide_time, b.collide_time);
}

} // namespace

TEST_CASE("particle buffer: upload and read-back keep every bit") {
    for (const char* name : {"osmesa", "egl"}) {
        const auto context = open_context(name);
        if (!context)
            continue;
        const Particles original = varied(10007);
        ParticleBuffer buffer(original.size());
        buffer.upload(original);
        Particles read;
        buffer.read(read);
        CHECK(same_bits(original, read));
        check_gl("particle buffer");
    }
}

TEST_CASE("particle buffer: it holds the particles that have its very bits") {
    const auto context = open_context();
    if (!context)
        return;
    const Particles original = varied(3);
    ParticleBuffer buffer(3);
    buffer.upload(original);
    CHECK(buffer.holds(original));
    Particles other = original;
    other.collide_time[2] = std::nextafter(other.collide_time[2], 1e9F);
    CHECK_FALSE(buffer.holds(other));
    other = original;
    other.position[0].x = -other.position[0].x;
    CHECK_FALSE(buffer.holds(other));
}

TEST_CASE("particle buffer: a record lies as transform feedback writes it") {
    const auto context = open_context();
    if (!context)
        return;
    const Particles original = varied(3);
    ParticleBuffer buffer(3);
    buffer.upload(original);
    float words[24];
    gl::BindBuffer(GL_COPY_READ_BUFFER, buffer.id());
    gl::GetBufferSubData(GL_COPY_READ_BUFFER, 0, sizeof words, words);
    CHECK(bits(words[8]) == bits(original.position[1].x));
    CHECK(bits(words[11]) == bits(original.speed[1]));
    CHECK(bits(words[14]) == bits(original.direction[1].z));
    CHECK(bits(words[15]) == bits(original.collide_time[1]));
}

TEST_CASE("particle buffer: fill shows what was not written") {
    const auto context = open_context();
    if (!context)
        return;
    ParticleBuffer buffer(5);
    buffer.fill(0xdeadbeefU);
    Particles read;
    buffer.read(read);
    REQUIRE(read.size() == 5);
    CHECK(bits(read.position[4].z) == 0xdeadbeefU);
    CHECK(bits(read.collide_time[0]) == 0xdeadbeefU);
}

TEST_CASE("particle buffer: none is fine, too many are told") {
    const auto context = open_context();
    if (!context)
        return;
    ParticleBuffer none(0);
    Particles read = varied(2);
    none.fill(1);
    none.read(read);
    CHECK(read.size() == 0);
    CHECK_THROWS_WITH(ParticleBuffer(std::size_t{1} << 56U), "buffer of 72057594037927936 particles: GL_OUT_OF_MEMORY");
}

TEST_CASE("particle buffer: a copying shader captures what the attributes feed") {
    const auto context = open_context();
    if (!context)
        return;
    const TemporaryFolder folder;
    folder.write("copy.vert", R"(#version 330 core
in vec3 a_Position;
in vec3 a_Dir;
in float a_Speed;
in float a_CollideTime;
out vec3 out_Position;
out vec3 out_Dir;
out float out_Speed;
out float out_CollideTime;
void main() {
    out_Position = a_Position;
    out_Dir = a_Dir;
    out_Speed = a_Speed;
    out_CollideTime = a_CollideTime;
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
)");
    const Program program("copy", {{load_stage({folder.path()}, "copy", Stage::vertex)}},
                          particle_records().captures());
    Particles original = varied(1000);
    for (std::size_t i = 0; i < original.size(); ++i) {
        const auto f = static_cast<float>(i);
        original.position[i] = {f, f + 0.25F, -f};
        original.direction[i] = {0.5F, f * 2.0F, f * 3.0F};
        original.speed[i] = f * 0.1F;
        original.collide_time[i] = -f * 0.1F;
    }
    ParticleBuffer from(original.size());
    ParticleBuffer to(original.size());
    from.upload(original);
    to.fill(0);
    const GlVertexArray attributes = vertex_array(from, program);
    program.use();
    gl::BindVertexArray(attributes.id());
    to.bind_capture();
    const GlQuery written;
    const test::OneTexelTarget target;
    gl::Enable(GL_RASTERIZER_DISCARD);
    gl::BeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, written.id());
    gl::BeginTransformFeedback(GL_POINTS);
    gl::DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(original.size()));
    gl::EndTransformFeedback();
    gl::EndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    gl::Disable(GL_RASTERIZER_DISCARD);
    GLuint count = 0;
    gl::GetQueryObjectuiv(written.id(), GL_QUERY_RESULT, &count);
    CHECK(count == original.size());
    Particles read;
    to.read(read);
    CHECK(same_bits(original, read));
    check_gl("copy");
}

} // namespace lockstep::test::particle_buffer_test
