#include "gpu/particle_buffer.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// Calls `work` with the buffer's memory. A driver may lose a mapped buffer's contents (GL_FALSE at unmapping); there
/// is no telling what it holds then, hence the Error.
template <class Element, class Work> void with_mapped(GLuint buffer, std::size_t bytes, GLbitfield access, Work work) {
    gl::BindBuffer(GL_COPY_READ_BUFFER, buffer);
    void* memory = gl::MapBufferRange(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(bytes), access);
    if (memory == nullptr) {
        check_gl("particle buffer");
        throw Error("particle buffer: GL cannot map it");
    }
    work(std::span(static_cast<Element*>(memory), bytes / sizeof(Element)));
    if (gl::UnmapBuffer(GL_COPY_READ_BUFFER) == GL_FALSE)
        throw Error("particle buffer: its contents were lost while mapped");
}

constexpr GLbitfield overwrite = GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT;

} // namespace

const std::array<Capture, 4>& particle_captures() {
    static const std::array<Capture, 4> captures{{{"out_Position", GL_FLOAT_VEC3},
                                                  {"out_Speed", GL_FLOAT},
                                                  {"out_Dir", GL_FLOAT_VEC3},
                                                  {"out_CollideTime", GL_FLOAT}}};
    return captures;
}

ParticleBuffer::ParticleBuffer(std::size_t count) : count_(count) {
    gl::BindBuffer(GL_COPY_READ_BUFFER, buffer_.id());
    gl::BufferData(GL_COPY_READ_BUFFER, static_cast<GLsizeiptr>(count * sizeof(ParticleRecord)), nullptr,
                   GL_DYNAMIC_COPY);
    check_gl(fmt::format("buffer of {} particles", count));
}

void ParticleBuffer::upload(const Particles& particles) {
    assert(particles.size() == count_);
    if (count_ == 0)
        return;
    with_mapped<
        ParticleRecord>(id(), count_ * sizeof(ParticleRecord), overwrite, [&](std::span<ParticleRecord> records) {
        const auto n = static_cast<std::ptrdiff_t>(records.size());
#pragma omp parallel for schedule(static)
        for (std::ptrdiff_t i = 0; i < n; ++i)
            records[i] = {particles.position[i], particles.speed[i], particles.direction[i], particles.collide_time[i]};
    });
}

void ParticleBuffer::read(Particles& particles) const {
    particles.resize(count_);
    if (count_ == 0)
        return;
    with_mapped<const ParticleRecord>(id(), count_ * sizeof(ParticleRecord), GL_MAP_READ_BIT,
                                      [&](std::span<const ParticleRecord> records) {
                                          const auto n = static_cast<std::ptrdiff_t>(records.size());
#pragma omp parallel for schedule(static)
                                          for (std::ptrdiff_t i = 0; i < n; ++i) {
                                              const ParticleRecord& record = records[i];
                                              particles.position[i] = record.position;
                                              particles.direction[i] = record.direction;
                                              particles.speed[i] = record.speed;
                                              particles.collide_time[i] = record.collide_time;
                                          }
                                      });
}

bool ParticleBuffer::holds(const Particles& particles) const {
    assert(particles.size() == count_);
    if (count_ == 0)
        return true;
    bool same = true;
    with_mapped<const ParticleRecord>(
        id(), count_ * sizeof(ParticleRecord), GL_MAP_READ_BIT, [&](std::span<const ParticleRecord> records) {
            for (std::size_t i = 0; i < records.size() && same; ++i) {
                const ParticleRecord record{particles.position[i], particles.speed[i], particles.direction[i],
                                            particles.collide_time[i]};
                same = std::memcmp(&record, &records[i], sizeof record) == 0;
            }
        });
    return same;
}

void ParticleBuffer::fill(std::uint32_t word) {
    if (count_ == 0)
        return;
    with_mapped<std::uint32_t>(id(), count_ * sizeof(ParticleRecord), overwrite,
                               [&](std::span<std::uint32_t> words) { std::fill(words.begin(), words.end(), word); });
}

void ParticleBuffer::bind_capture() const { gl::BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, id()); }

GlVertexArray particle_vertex_array(const ParticleBuffer& buffer, const Program& program) {
    GlVertexArray array;
    gl::BindVertexArray(array.id());
    gl::BindBuffer(GL_ARRAY_BUFFER, buffer.id());
    const auto attribute = [&](const char* name, GLint components, GLenum type, std::size_t offset) {
        const GLint location = program.attribute(name, type);
        if (location < 0)
            return;
        gl::EnableVertexAttribArray(static_cast<GLuint>(location));
        gl::VertexAttribPointer(static_cast<GLuint>(location), components, GL_FLOAT, GL_FALSE, sizeof(ParticleRecord),
                                reinterpret_cast<const void*>(offset));
    };
    attribute("a_Position", 3, GL_FLOAT_VEC3, offsetof(ParticleRecord, position));
    attribute("a_Speed", 1, GL_FLOAT, offsetof(ParticleRecord, speed));
    attribute("a_Dir", 3, GL_FLOAT_VEC3, offsetof(ParticleRecord, direction));
    attribute("a_CollideTime", 1, GL_FLOAT, offsetof(ParticleRecord, collide_time));
    gl::BindVertexArray(0);
    return array;
}

} // namespace lockstep
