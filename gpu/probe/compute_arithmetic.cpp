#include <array>
#include <cmath>

#include "gpu/check.hpp"
#include "gpu/object.hpp"
#include "gpu/probe/driver_arithmetic.hpp"
#include "gpu/probe/inputs.hpp"
#include "gpu/probe/rows.hpp"
#include "gpu/program.hpp"

namespace lockstep::probing {
namespace {

constexpr std::size_t inputs = 1024;
constexpr std::size_t group_size = 64; // local_size_x of the shader

/// What the shader makes of x and the operand: u_What.
enum class Made { product, sum, below };

Floats computed(const Program& program, const Floats& x, float operand, Made what) {
    const GlBuffer values;
    const auto bytes = static_cast<GLsizeiptr>(x.size() * sizeof(float));
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, values.id());
    gl::BufferData(GL_SHADER_STORAGE_BUFFER, bytes, x.data(), GL_STREAM_READ);
    program.set("u_Operand", operand);
    program.set("u_What", static_cast<int>(what));
    gl::DispatchCompute(static_cast<GLuint>(x.size() / group_size), 1, 1);
    gl::MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    Floats result(x.size());
    gl::GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, bytes, result.data());
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, 0);
    check_gl(program.name());
    return result;
}

ProbeRow measure_product(const Program& program, const char* name, int exponent, float factor) {
    const Floats x = random_floats(inputs, 35, {exponent, exponent + 1, true});
    Floats kept, flushed, if_unsigned;
    for (const float value : x) {
        kept.push_back(value * factor);
        flushed.push_back(std::copysign(0.0F, value));
        if_unsigned.push_back(0.0F);
    }
    return judge(name, computed(program, x, factor, Made::product),
                 {{"flushed", flushed}, {"flushed to +0", if_unsigned}, {"kept", kept}});
}

/// Where an operand or the sum is subnormal; `flushed`: what it is then.
template <class Flushed>
ProbeRow measure_sum(const Program& program, const char* name, const Floats& x, float addend, Flushed flushed) {
    Floats kept, if_flushed, if_unsigned;
    for (const float value : x) {
        kept.push_back(value + addend);
        if_flushed.push_back(flushed(value));
        if_unsigned.push_back(if_flushed.back() + 0.0F);
    }
    return judge(name, computed(program, x, addend, Made::sum),
                 {{"flushed", if_flushed}, {"flushed to +0", if_unsigned}, {"kept", kept}});
}

ProbeRow measure_comparison(const Program& program, const char* name) {
    const Floats x = random_floats(inputs, 40, {-135, -130, true});
    Floats kept;
    for (const float value : x)
        kept.push_back(value < 0.0F ? 1.0F : 0.0F);
    return judge(name, computed(program, x, 0.0F, Made::below), {{"flushed", Floats(inputs, 0.0F)}, {"kept", kept}});
}

constexpr std::size_t results_each = 11;

/// What shaders/probe/arithmetic.comp makes of each pair, `results_each` floats.
Floats operations_of(const Vectors& a, const Vectors& b) {
    const std::array stages{Stage::compute};
    const Program program("probe/arithmetic", load_stages(shader_folders(), "probe/arithmetic", stages));
    Floats pairs;
    for (std::size_t i = 0; i < a.size(); ++i)
        pairs.insert(pairs.end(), {a[i].x, a[i].y, a[i].z, b[i].x, b[i].y, b[i].z});
    Floats results(results_each * a.size());
    const GlBuffer from, to;
    const auto bytes = [](const Floats& floats) { return static_cast<GLsizeiptr>(floats.size() * sizeof(float)); };
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, from.id());
    gl::BufferData(GL_SHADER_STORAGE_BUFFER, bytes(pairs), pairs.data(), GL_STREAM_READ);
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, to.id());
    gl::BufferData(GL_SHADER_STORAGE_BUFFER, bytes(results), results.data(), GL_STREAM_READ);
    program.use();
    gl::DispatchCompute(static_cast<GLuint>(a.size() / group_size), 1, 1);
    gl::MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    gl::GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, bytes(results), results.data());
    for (const GLuint binding : {0U, 1U})
        gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, 0);
    check_gl(program.name());
    return results;
}

template <class Read> Floats each_of(const Vectors& vectors, Read read) {
    Floats values;
    for (const glm::vec3& v : vectors)
        values.push_back(read(v));
    return values;
}

/// The operations that GLSL leaves open, held against the vertex stage's, whose sequences other rows have.
void measure_operations(const DriverArithmetic& vertex, Rows& rows) {
    const Vectors a = random_vectors(inputs, 38, {}), b = random_vectors(inputs, 39, {});
    const Floats made = operations_of(a, b);
    const auto row = [&](const char* name, std::size_t first, std::size_t count, const Floats& of_vertex) {
        Floats values;
        for (std::size_t i = 0; i < a.size(); ++i)
            for (std::size_t k = first; k < first + count; ++k)
                values.push_back(made[results_each * i + k]);
        rows.push_back(judge(name, values, {{"as in the vertex stage", of_vertex}}));
    };
    const auto x = [](glm::vec3 v) { return v.x; };
    row("compute: a/b", 0, 1, vertex.divide(each_of(a, x), each_of(b, x)));
    row("compute: 1/b", 1, 1, vertex.reciprocal(each_of(b, [](glm::vec3 v) { return v.y; })));
    row("compute: sqrt", 2, 1, vertex.sqrt(each_of(a, [](glm::vec3 v) { return std::abs(v.y); })));
    row("compute: inversesqrt", 3, 1, vertex.inverse_sqrt(each_of(a, [](glm::vec3 v) { return std::abs(v.z); })));
    row("compute: dot(vec3)", 4, 1, vertex.dot(a, b));
    row("compute: length", 5, 1, vertex.length(b));
    row("compute: normalize", 6, 3, vertex.normalize(a));
    const auto fused = [&](const char* name, std::size_t place, const Floats& rounded, const Floats& once) {
        Floats values;
        for (std::size_t i = 0; i < a.size(); ++i)
            values.push_back(made[results_each * i + place]);
        rows.push_back(judge(name, values, {{"each rounded", rounded}, {"fused", once}}));
    };
    fused("compute: a*b+c, in functions", 9, each_of(a, [](glm::vec3 v) { return v.x * v.y + v.z; }),
          each_of(a, [](glm::vec3 v) { return std::fma(v.x, v.y, v.z); }));
    fused("compute: c-a*b, in functions", 10, each_of(b, [](glm::vec3 v) { return v.z - v.x * v.y; }),
          each_of(b, [](glm::vec3 v) { return std::fma(-v.x, v.y, v.z); }));
}

} // namespace

void measure_compute_arithmetic(Rows& rows) {
    const DriverArithmetic vertex(true);
    measure_operations(vertex, rows);
    const std::array stages{Stage::compute};
    const Program program("probe/product", load_stages(shader_folders(), "probe/product", stages));
    rows.push_back(measure_product(program, "compute: subnormal operand of *", -130, 0x1p60F));
    rows.push_back(measure_product(program, "compute: subnormal result of *", -100, 0x1p-32F));
    rows.push_back(measure_sum(program, "compute: subnormal operand of +",
                               random_floats(inputs, 36, {-128, -127, true}), 0x1p-125F,
                               [](float) { return 0x1p-125F; }));
    rows.push_back(measure_sum(program, "compute: subnormal result of +",
                               random_floats(inputs, 37, {-125, -124, false}), -0x1.8p-125F,
                               [](float x) { return std::copysign(0.0F, x - 0x1.8p-125F); }));
    rows.push_back(measure_comparison(program, "compute: subnormal < 0"));
}

} // namespace lockstep::probing
