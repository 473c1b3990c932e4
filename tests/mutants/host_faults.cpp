#include "tests/mutants/host_faults.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "gpu/gl.hpp"

namespace lockstep::test {
namespace {

/// gl.hpp's table as a value.
struct Functions {
#define LOCKSTEP_GL_MEMBER(name, ...) decltype(gl::name) name = gl::name;
    LOCKSTEP_GL_CORE(LOCKSTEP_GL_MEMBER)
    LOCKSTEP_GL_OPTIONAL(LOCKSTEP_GL_MEMBER)
#undef LOCKSTEP_GL_MEMBER

    void restore() const {
#define LOCKSTEP_GL_RESTORE(name, ...) gl::name = name;
        LOCKSTEP_GL_CORE(LOCKSTEP_GL_RESTORE)
        LOCKSTEP_GL_OPTIONAL(LOCKSTEP_GL_RESTORE)
#undef LOCKSTEP_GL_RESTORE
    }
};

using Matrix = std::array<GLfloat, 16>;

/// The driver's own functions, and what a fault remembers; GL functions take no context of ours.
struct State {
    Functions real;
    int color_clears = 0;
    Matrix matrix{}, earlier_matrix{}; ///< u_ProjView of this frame and of the one before
    bool any_matrix = false;
    std::vector<GLuint> particle_buffers;
    std::vector<GLuint> color_textures; ///< in the order in which they were read
    bool to_be_read = false;            ///< the next texture bound is what the collision pass reads
    GLuint copy = 0;                    ///< a texture of our own
    std::vector<GLfloat> cdt, earlier_cdt;
    GLint held_program = 0; ///< the step whose groups wait
    GLuint held_groups = 0;
};
State state;

bool is_uniform(GLint location, const char* name) {
    GLint program = 0;
    state.real.GetIntegerv(GL_CURRENT_PROGRAM, &program);
    return location >= 0 && state.real.GetUniformLocation(static_cast<GLuint>(program), name) == location;
}

/// Whether the collision pass's program is in use: the only one that reads the CDT.
bool in_collision_pass() {
    GLint program = 0;
    state.real.GetIntegerv(GL_CURRENT_PROGRAM, &program);
    return program != 0 && state.real.GetUniformLocation(static_cast<GLuint>(program), "u_CDTexture") >= 0;
}

/// Whether the program in use makes one invocation a particle.
bool counts_particles() {
    GLint program = 0;
    state.real.GetIntegerv(GL_CURRENT_PROGRAM, &program);
    return program != 0 && state.real.GetUniformLocation(static_cast<GLuint>(program), "u_ParticleCount") >= 0;
}

/// Whether the program of a pass that steps particles is in use, whichever search it makes.
bool in_step() {
    GLint program = 0;
    state.real.GetIntegerv(GL_CURRENT_PROGRAM, &program);
    return program != 0 && state.real.GetUniformLocation(static_cast<GLuint>(program), "u_SpeedFactor") >= 0;
}

bool in_obstacle_pass() { return !in_collision_pass(); }

/// The images are cleared when they are made, and once a frame; the first two frames run twice.
bool after_repeated_frames() { return state.color_clears > 6; }

float one_ulp_up(float x) { return std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) + 1U); }

// What follows takes a GL function's place.

template <GLenum Function> void depth_func(GLenum function) {
    state.real.DepthFunc(in_collision_pass() ? Function : function);
}

/// `Before` and `After` round the collision pass's draw.
template <auto Before, auto After> void draw_points(GLenum mode, GLint first, GLsizei count) {
    const bool faulty = in_collision_pass();
    if (faulty)
        Before();
    state.real.DrawArrays(mode, first, count);
    if (faulty)
        After();
}

/// Value `Change`d for uniform `Name` of the pass that steps the particles.
template <const char* Name, auto Change> void uniform_float(GLint location, GLsizei count, const GLfloat* value) {
    const bool faulty = in_step() && is_uniform(location, Name);
    const GLfloat changed = Change(*value);
    state.real.Uniform1fv(location, count, faulty ? &changed : value);
}
template <const char* Name, auto Change> void uniform_int(GLint location, GLsizei count, const GLint* value) {
    const bool faulty = in_step() && is_uniform(location, Name);
    const GLint changed = Change(*value);
    state.real.Uniform1iv(location, count, faulty ? &changed : value);
}
/// In whatever pass.
template <const char* Name, auto Change> void every_uniform_int(GLint location, GLsizei count, const GLint* value) {
    const GLint changed = Change(*value);
    state.real.Uniform1iv(location, count, is_uniform(location, Name) ? &changed : value);
}
/// A sampler's texture unit.
template <const char* Name, GLint Unit> void uniform_unit(GLint location, GLint value) {
    state.real.Uniform1i(location, in_step() && is_uniform(location, Name) ? Unit : value);
}
template <const char* Name, auto Change> void uniform_vector(GLint location, GLsizei count, const GLfloat* value) {
    std::array<GLfloat, 3> vector{value[0], value[1], value[2]};
    if (in_step() && is_uniform(location, Name))
        Change(vector.data());
    state.real.Uniform3fv(location, count, vector.data());
}
template <auto Change> void uniform_matrix(GLint location, GLsizei count, GLboolean transpose, const GLfloat* value) {
    Matrix matrix;
    std::copy_n(value, matrix.size(), matrix.begin());
    if (in_collision_pass() && is_uniform(location, "u_ProjView"))
        Change(matrix);
    state.real.UniformMatrix4fv(location, count, transpose, matrix.data());
}

constexpr char tick[] = "u_Tick";
constexpr char gravity[] = "u_Gravity";
constexpr char speed_factor[] = "u_SpeedFactor";
constexpr char collision_range[] = "u_CollisionRange";
constexpr char collision_time[] = "u_CollisionTime";
constexpr char radius[] = "u_TexelCollideRange";
constexpr char client_width[] = "u_ClientWidth";
constexpr char cd_texture[] = "u_CDTexture";
constexpr char layer_number[] = "u_Layer";
constexpr char reach[] = "u_Reach";
constexpr char second_reach[] = "u_SecondReach";
constexpr char window_margin[] = "u_WindowMargin";
constexpr char obstacles[] = "u_Obstacles";
constexpr char box_min[] = "u_CdtBoxMin";
constexpr char box_scale[] = "u_CdtBoxScale";

void transpose(Matrix& m) {
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t column = 0; column < row; ++column)
            std::swap(m[4 * row + column], m[4 * column + row]);
}

/// The matrix that was last set to something else.
void use_earlier_matrix(Matrix& m) {
    if (!state.any_matrix)
        state.matrix = state.earlier_matrix = m;
    state.any_matrix = true;
    if (m != state.matrix)
        state.earlier_matrix = std::exchange(state.matrix, m);
    m = state.earlier_matrix;
}

/// The matrix of the call before: a uniform that is set after the draw.
void use_last_matrix(Matrix& m) {
    if (!state.any_matrix)
        state.matrix = m;
    state.any_matrix = true;
    m = std::exchange(state.matrix, m);
}

void use_first_matrix(Matrix& m) {
    if (!state.any_matrix)
        state.matrix = m;
    state.any_matrix = true;
    m = state.matrix;
}

void swap_image_size(GLint location, GLsizei count, const GLint* value) {
    GLint program = 0;
    state.real.GetIntegerv(GL_CURRENT_PROGRAM, &program);
    for (const auto& [name, other] :
         {std::pair{"u_ClientWidth", "u_ClientHeight"}, {"u_ClientHeight", "u_ClientWidth"}})
        if (in_collision_pass() && is_uniform(location, name)) {
            state.real.Uniform1iv(state.real.GetUniformLocation(static_cast<GLuint>(program), other), count, value);
            return;
        }
    state.real.Uniform1iv(location, count, value);
}

template <int X, int Width, int Height> void viewport(GLint x, GLint y, GLsizei width, GLsizei height) {
    const bool faulty = in_collision_pass();
    state.real.Viewport(x + (faulty ? X : 0), y, width + (faulty ? Width : 0), height + (faulty ? Height : 0));
}

void note_color_clear(GLenum buffer, GLint drawbuffer, const GLfloat* value) {
    if (buffer == GL_COLOR)
        ++state.color_clears;
    state.real.ClearBufferfv(buffer, drawbuffer, value);
}

template <GLenum Buffer, bool Always> void no_clear(GLenum buffer, GLint drawbuffer, const GLfloat* value) {
    if (buffer == GL_COLOR)
        ++state.color_clears;
    const bool at_creation = state.color_clears <= 2;
    if (buffer == Buffer && (Always ? !at_creation : after_repeated_frames()))
        return;
    state.real.ClearBufferfv(buffer, drawbuffer, value);
}

template <GLenum Buffer, int Percent, int AlphaPercent>
void clear_to(GLenum buffer, GLint drawbuffer, const GLfloat* value) {
    constexpr float other = Percent / 100.0F;
    const std::array<GLfloat, 4> values{other, other, other, AlphaPercent / 100.0F};
    state.real.ClearBufferfv(buffer, drawbuffer, buffer == Buffer ? values.data() : value);
}

template <GLenum From, GLenum To> void store_as(GLenum target, GLint level, GLint internal, GLsizei width,
                                                GLsizei height, GLint border, GLenum format, GLenum type,
                                                const void* data) {
    state.real.TexImage2D(target, level, internal == static_cast<GLint>(From) ? static_cast<GLint>(To) : internal,
                          width, height, border, format, type, data);
}

template <GLenum Name, GLint Value> void texture_parameter(GLenum target, GLenum name, GLint value) {
    state.real.TexParameteri(target, name, name == Name ? Value : value);
}

void note_active_texture(GLenum unit) {
    state.to_be_read = true;
    state.real.ActiveTexture(unit);
}

/// Always the same texture.
void bind_first_texture(GLenum target, GLuint texture) {
    if (std::exchange(state.to_be_read, false)) {
        if (state.color_textures.empty())
            state.color_textures.push_back(texture);
        texture = state.color_textures.front();
    }
    state.real.BindTexture(target, texture);
}

/// A copy of what the frame before read.
void bind_stale_texture(GLenum target, GLuint texture) {
    state.real.BindTexture(target, texture);
    if (!std::exchange(state.to_be_read, false))
        return;
    GLint width = 0;
    GLint height = 0;
    GLint internal = 0;
    state.real.GetTexLevelParameteriv(target, 0, GL_TEXTURE_WIDTH, &width);
    state.real.GetTexLevelParameteriv(target, 0, GL_TEXTURE_HEIGHT, &height);
    state.real.GetTexLevelParameteriv(target, 0, GL_TEXTURE_INTERNAL_FORMAT, &internal);
    std::vector<GLfloat> now(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
    state.real.GetTexImage(target, 0, GL_RGBA, GL_FLOAT, now.data());
    if (state.cdt.empty())
        state.earlier_cdt = state.cdt = now;
    if (now != state.cdt)
        state.earlier_cdt = std::exchange(state.cdt, now);
    if (state.copy == 0)
        state.real.GenTextures(1, &state.copy);
    state.real.BindTexture(target, state.copy);
    state.real.TexImage2D(target, 0, internal, width, height, 0, GL_RGBA, GL_FLOAT, state.earlier_cdt.data());
    state.real.TexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
    state.real.TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    state.real.TexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

/// The other particle buffer than the one to be read, from frame 2 on.
void read_other_buffer(GLenum target, GLuint buffer) {
    auto& known = state.particle_buffers;
    if (target == GL_ARRAY_BUFFER && in_collision_pass()) {
        if (std::find(known.begin(), known.end(), buffer) == known.end())
            known.push_back(buffer);
        if (known.size() == 2 && after_repeated_frames())
            buffer = known[buffer == known[0] ? 1 : 0];
    }
    state.real.BindBuffer(target, buffer);
}

GLint buffer_size(GLenum target) {
    GLint bytes = 0;
    state.real.GetBufferParameteriv(target, GL_BUFFER_SIZE, &bytes);
    return bytes;
}

template <bool Shifted> void capture_in_part(GLenum target, GLuint index, GLuint buffer) {
    state.real.BindBufferBase(target, index, buffer);
    const GLint bytes = buffer_size(target);
    state.real.BindBufferRange(target, index, buffer, Shifted ? 32 : 0, Shifted ? bytes - 32 : bytes / 2 / 32 * 32);
}

void capture_speed_and_time_swapped(GLuint program, GLsizei count, const GLchar* const* names, GLenum mode) {
    std::vector<const GLchar*> swapped(names, names + count);
    if (count == 4)
        std::swap(swapped[1], swapped[3]);
    state.real.TransformFeedbackVaryings(program, count, swapped.data(), mode);
}

template <int SpeedOffset, int Stride, bool Normalised>
void attribute(GLuint index, GLint components, GLenum type, GLboolean normalised, GLsizei stride, const void* offset) {
    const auto bytes = reinterpret_cast<std::uintptr_t>(offset);
    const bool speed = in_collision_pass() && components == 1 && bytes == 12;
    state.real.VertexAttribPointer(index, components, type, Normalised ? GL_TRUE : normalised,
                                   in_collision_pass() ? stride + Stride : stride,
                                   reinterpret_cast<const void*>(speed ? bytes + SpeedOffset : bytes));
}

GLint components_of_last_attribute = 0;

void note_components(GLuint index, GLint components, GLenum type, GLboolean normalised, GLsizei stride,
                     const void* offset) {
    components_of_last_attribute = components;
    state.real.VertexAttribPointer(index, components, type, normalised, stride, offset);
}

void attribute_per_instance(GLuint index, GLuint divisor) {
    state.real.VertexAttribDivisor(index, in_collision_pass() && components_of_last_attribute == 1 ? 1 : divisor);
}

template <auto Before, auto After> void draw_triangles(GLenum mode, GLsizei count, GLenum type, const void* indices) {
    Before();
    state.real.DrawElements(mode, count, type, indices);
    After();
}

/// The step's groups run once what comes after it has run: what a barrier left out lets a driver do.
void hold_step_back(GLuint x, GLuint y, GLuint z) {
    if (in_collision_pass()) {
        state.real.GetIntegerv(GL_CURRENT_PROGRAM, &state.held_program);
        state.held_groups = x;
        return;
    }
    state.real.DispatchCompute(x, y, z);
}

void run_step_held_back() {
    if (state.held_groups == 0)
        return;
    GLint current = 0;
    state.real.GetIntegerv(GL_CURRENT_PROGRAM, &current);
    state.real.UseProgram(static_cast<GLuint>(state.held_program));
    state.real.DispatchCompute(std::exchange(state.held_groups, 0), 1, 1);
    state.real.MemoryBarrier(GL_ALL_BARRIER_BITS);
    state.real.UseProgram(static_cast<GLuint>(current));
}

struct Fault {
    std::string_view name;
    void (*make)();
};

// In the order of a frame.
const Fault faults[] = {
    {"cdt_never_cleared", [] { gl::ClearBufferfv = no_clear<GL_COLOR, true>; }},
    {"cdt_cleared_twice_only", [] { gl::ClearBufferfv = no_clear<GL_COLOR, false>; }},
    {"cdt_cleared_to_one", [] { gl::ClearBufferfv = clear_to<GL_COLOR, 100, 100>; }},
    {"cdt_cleared_to_origin", [] { gl::ClearBufferfv = clear_to<GL_COLOR, 0, 100>; }},
    {"depth_never_cleared", [] { gl::ClearBufferfv = no_clear<GL_DEPTH, true>; }},
    {"depth_cleared_twice_only", [] { gl::ClearBufferfv = no_clear<GL_DEPTH, false>; }},
    {"depth_cleared_to_half", [] { gl::ClearBufferfv = clear_to<GL_DEPTH, 50, 50>; }},
    {"depth_cleared_to_zero", [] { gl::ClearBufferfv = clear_to<GL_DEPTH, 0, 0>; }},
    {"cdt_in_halves", [] { gl::TexImage2D = store_as<GL_RGBA32F, GL_RGBA16F>; }},
    {"cdt_in_bytes", [] { gl::TexImage2D = store_as<GL_RGBA32F, GL_RGBA8>; }},
    {"depth_of_16_bits", [] { gl::TexImage2D = store_as<GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT16>; }},
    {"depth_of_24_bits", [] { gl::TexImage2D = store_as<GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT24>; }},
    {"no_depth_attached",
     [] {
         gl::FramebufferTexture2D = [](GLenum target, GLenum attachment, GLenum kind, GLuint texture, GLint level) {
             if (attachment != GL_DEPTH_ATTACHMENT)
                 state.real.FramebufferTexture2D(target, attachment, kind, texture, level);
         };
     }},
    {"texture_filtered", [] { gl::TexParameteri = texture_parameter<GL_TEXTURE_MAG_FILTER, GL_LINEAR>; }},
    {"texture_repeated", [] { gl::TexParameteri = texture_parameter<GL_TEXTURE_WRAP_S, GL_REPEAT>; }},
    {"texture_unit_wrong", [] { gl::Uniform1i = uniform_unit<cd_texture, 1>; }},
    {"texture_not_swapped",
     [] {
         gl::ActiveTexture = note_active_texture;
         gl::BindTexture = bind_first_texture;
     }},
    {"texture_stale",
     [] {
         gl::ActiveTexture = note_active_texture;
         gl::BindTexture = bind_stale_texture;
     }},
    {"buffers_not_swapped",
     [] {
         gl::ClearBufferfv = note_color_clear;
         gl::BindBuffer = read_other_buffer;
     }},
    {"attribute_offset_wrong", [] { gl::VertexAttribPointer = attribute<16, 0, false>; }},
    {"attribute_stride_wrong", [] { gl::VertexAttribPointer = attribute<0, -4, false>; }},
    {"attribute_normalised", [] { gl::VertexAttribPointer = attribute<0, 0, true>; }},
    {"attribute_per_instance",
     [] {
         gl::VertexAttribPointer = note_components;
         gl::VertexAttribDivisor = attribute_per_instance;
     }},
    {"matrix_transposed", [] { gl::UniformMatrix4fv = uniform_matrix<transpose>; }},
    {"matrix_of_earlier_frame", [] { gl::UniformMatrix4fv = uniform_matrix<use_earlier_matrix>; }},
    {"matrix_set_after_draw", [] { gl::UniformMatrix4fv = uniform_matrix<use_last_matrix>; }},
    {"matrix_set_once", [] { gl::UniformMatrix4fv = uniform_matrix<use_first_matrix>; }},
    {"matrix_one_ulp", [] { gl::UniformMatrix4fv = uniform_matrix<[](Matrix& m) { m[5] = one_ulp_up(m[5]); }>; }},
    {"matrix_y_flipped",
     [] {
         gl::UniformMatrix4fv = uniform_matrix<[](Matrix& m) {
             for (std::size_t i = 1; i < m.size(); i += 4)
                 m[i] = -m[i];
         }>;
     }},
    {"obstacle_matrix_one_ulp",
     [] {
         gl::UniformMatrix4fv = [](GLint location, GLsizei count, GLboolean transposed, const GLfloat* value) {
             Matrix matrix;
             std::copy_n(value, matrix.size(), matrix.begin());
             if (in_obstacle_pass())
                 matrix[0] = one_ulp_up(matrix[0]);
             state.real.UniformMatrix4fv(location, count, transposed, matrix.data());
         };
     }},
    {"image_size_swapped", [] { gl::Uniform1iv = swap_image_size; }},
    {"image_width_one_less", [] { gl::Uniform1iv = uniform_int<client_width, [](int w) { return w - 1; }>; }},
    {"radius_one_more", [] { gl::Uniform1iv = uniform_int<radius, [](int r) { return r + 1; }>; }},
    {"radius_one_less", [] { gl::Uniform1iv = uniform_int<radius, [](int r) { return r - 1; }>; }},
    {"radius_not_set", [] { gl::Uniform1iv = uniform_int<radius, [](int) { return 0; }>; }},
    {"range_not_set", [] { gl::Uniform1fv = uniform_float<collision_range, [](float) { return 0.0F; }>; }},
    {"range_doubled", [] { gl::Uniform1fv = uniform_float<collision_range, [](float x) { return 2.0F * x; }>; }},
    {"time_not_set", [] { gl::Uniform1fv = uniform_float<collision_time, [](float) { return 0.0F; }>; }},
    {"time_one_ulp", [] { gl::Uniform1fv = uniform_float<collision_time, one_ulp_up>; }},
    {"speed_factor_one", [] { gl::Uniform1fv = uniform_float<speed_factor, [](float) { return 1.0F; }>; }},
    {"speed_factor_one_ulp", [] { gl::Uniform1fv = uniform_float<speed_factor, one_ulp_up>; }},
    {"speed_factor_complement", [] { gl::Uniform1fv = uniform_float<speed_factor, [](float x) { return 1.0F - x; }>; }},
    {"tick_doubled", [] { gl::Uniform1fv = uniform_float<tick, [](float x) { return 2.0F * x; }>; }},
    {"tick_halved", [] { gl::Uniform1fv = uniform_float<tick, [](float x) { return 0.5F * x; }>; }},
    {"tick_one_ulp", [] { gl::Uniform1fv = uniform_float<tick, one_ulp_up>; }},
    {"tick_not_set", [] { gl::Uniform1fv = uniform_float<tick, [](float) { return 0.0F; }>; }},
    {"tick_of_60_hertz", [] { gl::Uniform1fv = uniform_float<tick, [](float) { return 1.0F / 60.0F; }>; }},
    {"gravity_not_set", [] { gl::Uniform3fv = uniform_vector<gravity, [](GLfloat* g) { std::fill_n(g, 3, 0.0F); }>; }},
    {"gravity_doubled",
     [] {
         gl::Uniform3fv =
             uniform_vector<gravity, [](GLfloat* g) { std::transform(g, g + 3, g, [](float x) { return 2.0F * x; }); }>;
     }},
    {"gravity_in_y_only", [] { gl::Uniform3fv = uniform_vector<gravity, [](GLfloat* g) { g[0] = g[2] = 0.0F; }>; }},
    {"box_corner_not_set",
     [] { gl::Uniform3fv = uniform_vector<box_min, [](GLfloat* v) { std::fill_n(v, 3, 0.0F); }>; }},
    {"box_scale_one_ulp",
     [] { gl::Uniform3fv = uniform_vector<box_scale, [](GLfloat* v) { v[0] = one_ulp_up(v[0]); }>; }},
    {"viewport_one_narrower", [] { gl::Viewport = viewport<0, -1, 0>; }},
    {"viewport_one_right", [] { gl::Viewport = viewport<1, 0, 0>; }},
    {"viewport_swapped",
     [] {
         gl::Viewport = [](GLint x, GLint y, GLsizei width, GLsizei height) {
             const bool faulty = in_collision_pass();
             state.real.Viewport(x, y, faulty ? height : width, faulty ? width : height);
         };
     }},
    {"viewport_not_set",
     [] {
         state.real.Viewport(0, 0, 32, 32);
         gl::Viewport = [](GLint, GLint, GLsizei, GLsizei) {};
     }},
    {"depth_func_greater", [] { gl::DepthFunc = depth_func<GL_GREATER>; }},
    {"depth_func_lequal", [] { gl::DepthFunc = depth_func<GL_LEQUAL>; }},
    {"depth_func_always", [] { gl::DepthFunc = depth_func<GL_ALWAYS>; }},
    {"depth_func_never", [] { gl::DepthFunc = depth_func<GL_NEVER>; }},
    {"depth_func_gequal", [] { gl::DepthFunc = depth_func<GL_GEQUAL>; }},
    {"depth_test_off",
     [] {
         gl::DrawArrays =
             draw_points<[] { state.real.Disable(GL_DEPTH_TEST); }, [] { state.real.Enable(GL_DEPTH_TEST); }>;
     }},
    {"depth_not_written",
     [] {
         gl::DrawArrays = draw_points<[] { state.real.DepthMask(GL_FALSE); }, [] { state.real.DepthMask(GL_TRUE); }>;
     }},
    {"depth_range_reversed",
     [] {
         gl::DrawArrays = draw_points<[] { state.real.DepthRange(1.0, 0.0); }, [] { state.real.DepthRange(0.0, 1.0); }>;
     }},
    {"depth_range_halved",
     [] {
         gl::DrawArrays = draw_points<[] { state.real.DepthRange(0.0, 0.5); }, [] { state.real.DepthRange(0.0, 1.0); }>;
     }},
    {"alpha_not_written",
     [] {
         gl::DrawArrays = draw_points<[] { state.real.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE); },
                                      [] { state.real.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE); }>;
     }},
    {"blue_not_written",
     [] {
         gl::DrawArrays = draw_points<[] { state.real.ColorMask(GL_TRUE, GL_TRUE, GL_FALSE, GL_TRUE); },
                                      [] { state.real.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE); }>;
     }},
    {"blended",
     [] {
         gl::DrawArrays = draw_points<[] {
             state.real.Enable(GL_BLEND);
             state.real.BlendFunc(GL_ONE, GL_ONE);
         },
                                      [] { state.real.Disable(GL_BLEND); }>;
     }},
    {"scissored",
     [] {
         gl::DrawArrays = draw_points<[] {
             state.real.Enable(GL_SCISSOR_TEST);
             state.real.Scissor(0, 0, 40, 40);
         },
                                      [] { state.real.Disable(GL_SCISSOR_TEST); }>;
     }},
    {"points_of_two_pixels",
     [] { gl::DrawArrays = draw_points<[] { state.real.PointSize(2.0F); }, [] { state.real.PointSize(1.0F); }>; }},
    {"origin_upper_left",
     [] {
         gl::DrawArrays = draw_points<[] { state.real.ClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE); },
                                      [] { state.real.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE); }>;
     }},
    {"depth_zero_to_one",
     [] {
         gl::DrawArrays = draw_points<[] { state.real.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE); },
                                      [] { state.real.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE); }>;
     }},
    {"draws_one_too_few",
     [] {
         gl::DrawArrays = [](GLenum mode, GLint first, GLsizei count) {
             state.real.DrawArrays(mode, first, in_collision_pass() ? count - 1 : count);
         };
     }},
    {"draws_from_second",
     [] {
         gl::DrawArrays = [](GLenum mode, GLint first, GLsizei count) {
             state.real.DrawArrays(mode, in_collision_pass() ? first + 1 : first, count);
         };
     }},
    {"draws_twice",
     [] {
         gl::DrawArrays = [](GLenum mode, GLint first, GLsizei count) {
             state.real.DrawArrays(mode, first, count);
             if (in_collision_pass())
                 state.real.DrawArrays(mode, first, count);
         };
     }},
    {"draws_backwards_in_halves",
     [] {
         gl::DrawArrays = [](GLenum mode, GLint first, GLsizei count) {
             if (in_collision_pass()) {
                 state.real.DrawArrays(mode, first + count / 2, count - count / 2);
                 state.real.DrawArrays(mode, first, count / 2);
             } else {
                 state.real.DrawArrays(mode, first, count);
             }
         };
     }},
    {"captures_half", [] { gl::BindBufferBase = capture_in_part<false>; }},
    {"captures_shifted", [] { gl::BindBufferBase = capture_in_part<true>; }},
    {"captures_speed_and_time_swapped", [] { gl::TransformFeedbackVaryings = capture_speed_and_time_swapped; }},
    {"feedback_not_begun", [] { gl::BeginTransformFeedback = [](GLenum) {}; }},
    {"obstacles_not_drawn",
     [] {
         gl::DrawElements = [](GLenum, GLsizei, GLenum, const void*) {};
         gl::DrawArrays = [](GLenum mode, GLint first, GLsizei count) {
             if (in_collision_pass())
                 state.real.DrawArrays(mode, first, count);
         };
     }},
    {"obstacles_last_triangle_missing",
     [] {
         gl::DrawElements = [](GLenum mode, GLsizei count, GLenum type, const void* indices) {
             state.real.DrawElements(mode, count - 3, type, indices);
         };
     }},
    {"obstacles_culled",
     [] {
         gl::DrawElements =
             draw_triangles<[] { state.real.Enable(GL_CULL_FACE); }, [] { state.real.Disable(GL_CULL_FACE); }>;
     }},
    {"obstacles_wound_clockwise",
     [] {
         gl::DrawElements = draw_triangles<[] { state.real.FrontFace(GL_CW); }, [] { state.real.FrontFace(GL_CCW); }>;
     }},
    {"obstacles_offset",
     [] {
         gl::DrawElements = draw_triangles<[] {
             state.real.Enable(GL_POLYGON_OFFSET_FILL);
             state.real.PolygonOffset(10.0F, 10.0F);
         },
                                           [] { state.real.Disable(GL_POLYGON_OFFSET_FILL); }>;
     }},
    {"buffers_hinted_static",
     [] {
         gl::BufferData = [](GLenum target, GLsizeiptr bytes, const void* data, GLenum) {
             state.real.BufferData(target, bytes, data, GL_STATIC_DRAW);
         };
     }},
    {"one_group_missing",
     [] { gl::DispatchCompute = [](GLuint x, GLuint y, GLuint z) { state.real.DispatchCompute(x - 1, y, z); }; }},
    {"one_group_more",
     [] { gl::DispatchCompute = [](GLuint x, GLuint y, GLuint z) { state.real.DispatchCompute(x + 1, y, z); }; }},
    {"nearest_not_cleared",
     [] {
         gl::DispatchCompute = [](GLuint x, GLuint y, GLuint z) {
             if (counts_particles())
                 state.real.DispatchCompute(x, y, z);
         };
     }},
    {"nearest_before_step",
     [] {
         gl::DispatchCompute = hold_step_back;
         gl::DrawArrays = [](GLenum mode, GLint first, GLsizei count) {
             state.real.DrawArrays(mode, first, count);
             run_step_held_back();
         };
     }},
    {"storage_exchanged",
     [] {
         gl::BindBufferBase = [](GLenum target, GLuint index, GLuint buffer) {
             const bool faulty = target == GL_SHADER_STORAGE_BUFFER && index < 2;
             state.real.BindBufferBase(target, faulty ? 1 - index : index, buffer);
         };
     }},
    {"texel_depth_func_lequal", [] { gl::DepthFunc = [](GLenum) { state.real.DepthFunc(GL_LEQUAL); }; }},
    {"texel_depth_test_off",
     [] {
         gl::DrawArrays = [](GLenum mode, GLint first, GLsizei count) {
             state.real.Disable(GL_DEPTH_TEST);
             state.real.DrawArrays(mode, first, count);
             state.real.Enable(GL_DEPTH_TEST);
         };
     }},
    {"octree_obstacles_not_uploaded",
     [] {
         gl::BindBufferBase = [](GLenum target, GLuint index, GLuint buffer) {
             state.real.BindBufferBase(target, index, target == GL_SHADER_STORAGE_BUFFER && index == 4 ? 0 : buffer);
         };
     }},
    {"layer_always_first", [] { gl::Uniform1iv = every_uniform_int<layer_number, [](int) { return 0; }>; }},
    {"layer_one_more", [] { gl::Uniform1iv = every_uniform_int<layer_number, [](int l) { return l + 1; }>; }},
    {"keys_never_cleared", [] { gl::ClearBufferiv = [](GLenum, GLint, const GLint*) {}; }},
    {"reach_not_set", [] { gl::Uniform3fv = uniform_vector<reach, [](GLfloat* v) { std::fill_n(v, 3, 0.0F); }>; }},
    {"second_reach_not_set",
     [] { gl::Uniform3fv = uniform_vector<second_reach, [](GLfloat* v) { std::fill_n(v, 3, 0.0F); }>; }},
    {"margin_not_set", [] { gl::Uniform1fv = uniform_float<window_margin, [](float) { return 0.0F; }>; }},
    {"obstacles_not_told", [] { gl::Uniform1iv = uniform_int<obstacles, [](int) { return 0; }>; }},
    {"second_matrix_not_set",
     [] {
         gl::UniformMatrix4fv = [](GLint location, GLsizei count, GLboolean transposed, const GLfloat* value) {
             const Matrix none{};
             const bool faulty = is_uniform(location, "u_SecondProjView");
             state.real.UniformMatrix4fv(location, count, transposed, faulty ? none.data() : value);
         };
     }},
    {"flushed_not_finished", [] { gl::Finish = [] { state.real.Flush(); }; }},
};

const Fault* find(std::string_view name) {
    const auto* found =
        std::find_if(std::begin(faults), std::end(faults), [&](const Fault& f) { return f.name == name; });
    return found == std::end(faults) ? nullptr : found;
}

} // namespace

HostFault::HostFault(std::string_view name) {
    state = State{};
    if (const Fault* fault = find(name))
        fault->make();
}

HostFault::~HostFault() {
    state.real.restore();
    if (state.copy != 0)
        gl::DeleteTextures(1, &state.copy);
}

bool is_host_fault(std::string_view name) { return find(name) != nullptr; }

} // namespace lockstep::test
