#include <array>
#include <cmath>

#include "gpu/check.hpp"
#include "gpu/object.hpp"
#include "gpu/probe/inputs.hpp"
#include "gpu/probe/rows.hpp"
#include "gpu/program.hpp"

namespace lockstep::probing {
namespace {

constexpr std::size_t inputs = 1024;
constexpr std::size_t group_size = 64; // local_size_x of the shader

/// x * operand, or where `adds` x + operand.
Floats computed(const Program& program, const Floats& x, float operand, bool adds) {
    const GlBuffer values;
    const auto bytes = static_cast<GLsizeiptr>(x.size() * sizeof(float));
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, values.id());
    gl::BufferData(GL_SHADER_STORAGE_BUFFER, bytes, x.data(), GL_STREAM_READ);
    program.set("u_Operand", operand);
    program.set("u_Adds", adds ? 1 : 0);
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
    return judge(name, computed(program, x, factor, false),
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
    return judge(name, computed(program, x, addend, true),
                 {{"flushed", if_flushed}, {"flushed to +0", if_unsigned}, {"kept", kept}});
}

} // namespace

void measure_compute_arithmetic(Rows& rows) {
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
}

} // namespace lockstep::probing
