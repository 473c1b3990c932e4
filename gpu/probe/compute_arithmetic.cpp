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

Floats products(const Program& program, const Floats& x, float factor) {
    const GlBuffer values;
    const auto bytes = static_cast<GLsizeiptr>(x.size() * sizeof(float));
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, values.id());
    gl::BufferData(GL_SHADER_STORAGE_BUFFER, bytes, x.data(), GL_STREAM_READ);
    program.set("u_Factor", factor);
    gl::DispatchCompute(static_cast<GLuint>(x.size() / group_size), 1, 1);
    gl::MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    Floats result(x.size());
    gl::GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, bytes, result.data());
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, 0);
    check_gl(program.name());
    return result;
}

ProbeRow measure(const Program& program, const char* name, int exponent, float factor) {
    const Floats x = random_floats(inputs, 35, {exponent, exponent + 1, true});
    Floats kept, flushed, if_unsigned;
    for (const float value : x) {
        kept.push_back(value * factor);
        flushed.push_back(std::copysign(0.0F, value));
        if_unsigned.push_back(0.0F);
    }
    return judge(name, products(program, x, factor),
                 {{"flushed", flushed}, {"flushed to +0", if_unsigned}, {"kept", kept}});
}

} // namespace

void measure_compute_arithmetic(Rows& rows) {
    const std::array stages{Stage::compute};
    const Program program("probe/product", load_stages(shader_folders(), "probe/product", stages));
    rows.push_back(measure(program, "compute: subnormal operand of *", -130, 0x1p60F));
    rows.push_back(measure(program, "compute: subnormal result of *", -100, 0x1p-32F));
}

} // namespace lockstep::probing
