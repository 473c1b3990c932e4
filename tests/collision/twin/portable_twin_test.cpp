#include "reference/portable.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/object.hpp"
#include "gpu/program.hpp"
#include "tests/gpu/any_context.hpp"

namespace lockstep::test::portable_twin_test {

namespace {

constexpr std::size_t chunk_size = std::size_t{1} << 20U;
constexpr std::size_t chunks = 16;

float from_bits(std::uint32_t x) { return std::bit_cast<float>(x); }

/// A scrambled counter (the finaliser of MurmurHash3): independent inputs without state.
std::uint32_t scrambled(std::uint32_t x) {
    x = (x ^ (x >> 16U)) * 0x85ebca6bU;
    x = (x ^ (x >> 13U)) * 0xc2b2ae35U;
    return x ^ (x >> 16U);
}

/// Zeros, subnormals, the edges of the tiny and of the infinite, NaN, and significands of all zeros and all ones.
constexpr std::array<std::uint32_t, 24> special{0x00000000, 0x00000001, 0x007fffff, 0x00800000, 0x00800001, 0x00800002,
                                                0x00ffffff, 0x01000000, 0x1fffffff, 0x20000000, 0x20000001, 0x3effffff,
                                                0x3f7fffff, 0x3f800000, 0x3f800001, 0x40490fdb, 0x5f000000, 0x5f7fffff,
                                                0x5f800000, 0x7e800000, 0x7f7fffff, 0x7f800000, 0x7f800001, 0x7fc00000};
constexpr std::size_t signed_specials = 2 * special.size();

float special_value(std::size_t i) {
    return from_bits(special[i / 2 % special.size()] | static_cast<std::uint32_t>(i % 2) << 31U);
}

/// Any bits, near 1, results at the edge of the tiny, squares at the edge of the tiny, special values.
float sample(std::uint32_t counter) {
    const std::uint32_t any = scrambled(counter);
    const std::uint32_t exponent = scrambled(counter ^ 0x9e3779b9U);
    const auto with_exponent = [&](std::uint32_t e) { return from_bits((any & 0x807fffffU) | e << 23U); };
    switch (exponent >> 24U & 7U) {
    case 0:
        return with_exponent(exponent % 6U);
    case 1:
        return with_exponent(60U + exponent % 8U);
    case 2:
        return special_value(exponent);
    case 3:
        return from_bits(any);
    default:
        return with_exponent(120U + exponent % 16U);
    }
}

struct Input {
    glm::vec3 a, b;
};

/// 2^24 inputs in chunks; the first ones are every triple of special values, so every pair too.
Input input(std::size_t chunk, std::size_t i) {
    if (chunk == 0 && i < signed_specials * signed_specials * signed_specials) {
        const std::size_t j = i / signed_specials;
        const std::size_t k = j / signed_specials;
        return {{special_value(i), special_value(j), special_value(k)},
                {special_value(j), special_value(k), special_value(i)}};
    }
    const auto counter = static_cast<std::uint32_t>((chunk * chunk_size + i) * 6);
    return {{sample(counter), sample(counter + 1), sample(counter + 2)},
            {sample(counter + 3), sample(counter + 4), sample(counter + 5)}};
}

glm::mat4 matrix(std::size_t chunk) {
    glm::mat4 m;
    for (int i = 0; i < 16; ++i)
        m[i / 4][i % 4] = sample(scrambled(static_cast<std::uint32_t>(chunk * 16) + static_cast<std::uint32_t>(i)));
    return m;
}

enum class Function { quotients, roots, significands, vectors, transform };
constexpr std::array<const char*, 5> function_names{"QUOTIENTS", "ROOTS", "SIGNIFICANDS", "VECTORS", "TRANSFORM"};

/// Twin of portable_functions.vert.
glm::vec4 expected(Function function, const Input& in, const glm::mat4& m, std::size_t index) {
    const auto& [a, b] = in;
    switch (function) {
    case Function::quotients:
        return {Portable::divide(a.x, b.x), Portable::divide(a.y, b.y), Portable::multiply(a.z, b.z),
                Portable::add(Portable::flush(a.x), Portable::flush(b.x))};
    case Function::roots:
        return {Portable::sqrt(a.x), Portable::reciprocal(a.x), Portable::inverse_sqrt(a.x), Portable::flush(a.y)};
    case Function::significands: {
        const float x = from_bits(0x3f800000U + static_cast<std::uint32_t>(index));
        return {Portable::sqrt(x), Portable::reciprocal(x), Portable::inverse_sqrt(x), 0.0F};
    }
    case Function::vectors: {
        const glm::vec3 n = Portable::normalize(a);
        return {n.x, n.y, n.z, Portable::length(a)};
    }
    case Function::transform:
        break;
    }
    return Portable::transform(m, a);
}

bool same(float x, float y) {
    return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y) || (std::isnan(x) && std::isnan(y));
}

Program function_program(Function function, const char* preset_name = "exact") {
    ShaderDefines defines = switch_defines(preset(preset_name));
    for (std::size_t i = 0; i < function_names.size(); ++i)
        defines.emplace_back(fmt::format("FUNCTION_{}", function_names[i]), std::to_string(i));
    defines.emplace_back("FUNCTION", fmt::format("FUNCTION_{}", function_names[static_cast<std::size_t>(function)]));
    const Stage vertex = Stage::vertex;
    const std::vector<Capture> captured{{"out_Result", GL_FLOAT_VEC4}};
    return {"portable functions",
            load_stages(shader_folders("tests/collision/twin"), "portable_functions", {&vertex, 1}, defines), captured};
}

/// Runs a program on one chunk of inputs after another.
class Runner {
  public:
    explicit Runner(const Program& program) : program_(program), results_(chunk_size, glm::vec4(-1.25F)) {
        draw_nowhere();
        gl::BindVertexArray(array_.id());
        gl::BindBuffer(GL_ARRAY_BUFFER, inputs_.id());
        gl::BufferData(GL_ARRAY_BUFFER, chunk_size * sizeof(Input), nullptr, GL_STREAM_DRAW);
        attribute("a_A", offsetof(Input, a));
        attribute("a_B", offsetof(Input, b));
        gl::BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, outputs_.id());
        gl::BufferData(GL_TRANSFORM_FEEDBACK_BUFFER, chunk_size * sizeof(glm::vec4), results_.data(), GL_STREAM_READ);
    }

    const std::vector<glm::vec4>& operator()(const std::vector<Input>& inputs, std::size_t first, const glm::mat4& m) {
        gl::BufferSubData(GL_ARRAY_BUFFER, 0, chunk_size * sizeof(Input), inputs.data());
        program_.set("u_Matrix", m);
        program_.set("u_First", static_cast<int>(first));
        gl::BeginTransformFeedback(GL_POINTS);
        gl::DrawArrays(GL_POINTS, 0, chunk_size);
        gl::EndTransformFeedback();
        gl::GetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, chunk_size * sizeof(glm::vec4), results_.data());
        check_gl("portable functions");
        return results_;
    }

  private:
    /// A context without a surface draws only into a complete framebuffer, even when nothing reaches it.
    void draw_nowhere() {
        gl::BindTexture(GL_TEXTURE_2D, texel_.id());
        gl::TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
        gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texel_.id(), 0);
        gl::Enable(GL_RASTERIZER_DISCARD);
    }

    void attribute(const char* name, std::size_t offset) {
        const GLint location = program_.attribute(name, GL_FLOAT_VEC3);
        if (location < 0)
            return;
        gl::EnableVertexAttribArray(static_cast<GLuint>(location));
        gl::VertexAttribPointer(static_cast<GLuint>(location), 3, GL_FLOAT, GL_FALSE, sizeof(Input),
                                reinterpret_cast<const void*>(offset));
    }

    const Program& program_;
    GlVertexArray array_;
    GlBuffer inputs_, outputs_;
    GlTexture texel_;
    GlFramebuffer framebuffer_;
    std::vector<glm::vec4> results_;
};

std::string text(const glm::vec4& v) { return fmt::format("({:a} {:a} {:a} {:a})", v.x, v.y, v.z, v.w); }
std::string text(const glm::vec3& v) { return fmt::format("({:a} {:a} {:a})", v.x, v.y, v.z); }

/// Runs 2^24 inputs; says where a bit of the four results differs, and nothing if none does.
std::string difference(Function function) {
    const Program program = function_program(function);
    Runner run(program);
    std::vector<Input> inputs(chunk_size);
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        const auto n = static_cast<std::ptrdiff_t>(chunk_size);
#pragma omp parallel for schedule(static)
        for (std::ptrdiff_t i = 0; i < n; ++i)
            inputs[i] = input(chunk, static_cast<std::size_t>(i));
        const glm::mat4 m = matrix(chunk);
        const std::size_t first = chunk * chunk_size;
        const std::vector<glm::vec4>& results = run(inputs, first, m);
        const auto differs = [&](std::ptrdiff_t i) {
            const glm::vec4 e = expected(function, inputs[i], m, first + static_cast<std::size_t>(i));
            const glm::vec4 r = results[i];
            return !(same(e.x, r.x) && same(e.y, r.y) && same(e.z, r.z) && same(e.w, r.w));
        };
        std::ptrdiff_t count = 0;
        std::ptrdiff_t least = n;
#pragma omp parallel for schedule(static) reduction(+ : count) reduction(min : least)
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            if (differs(i)) {
                ++count;
                least = std::min(least, i);
            }
        }
        if (count > 0)
            return fmt::format("{} of 2^20 in chunk {}; input {}: a {} b {}: reference {}, GL {}", count, chunk, least,
                               text(inputs[least].a), text(inputs[least].b),
                               text(expected(function, inputs[least], m, first + static_cast<std::size_t>(least))),
                               text(results[least]));
    }
    return {};
}

void check_twins(const char* backend) {
    const auto context = test::open_context(backend);
    if (!context)
        return;
    INFO(context->describe().renderer);
    CHECK(difference(Function::quotients) == "");
    CHECK(difference(Function::roots) == "");
    CHECK(difference(Function::significands) == "");
    CHECK(difference(Function::vectors) == "");
    CHECK(difference(Function::transform) == "");
}

} // namespace

TEST_CASE("portable twin: every function has the reference's bits on 2^24 inputs, on OSMesa") { check_twins("osmesa"); }

TEST_CASE("portable twin: every function has the reference's bits on 2^24 inputs, on EGL") { check_twins("egl"); }

TEST_CASE("portable twin: every function has the reference's bits on 2^24 inputs, on EGL device 0", "[.device]") {
    check_twins("egl-device:0");
}

TEST_CASE("portable twin: the plain arithmetic has the same functions") {
    const auto context = test::open_context();
    if (!context)
        return;
    for (const Function function : {Function::quotients, Function::roots, Function::vectors, Function::transform})
        CHECK_NOTHROW(function_program(function, "corrected"));
}

} // namespace lockstep::test::portable_twin_test
