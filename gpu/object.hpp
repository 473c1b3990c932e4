#pragma once
#include <utility>

#include "gpu/gl.hpp"

namespace lockstep {

/// Owns one GL object; made in the current context, which has to outlive it. Move-only.
template <auto& Generate, auto& Delete> class GlObject {
  public:
    GlObject() { Generate(1, &id_); }
    GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~GlObject() {
        if (id_ != 0 && Delete != nullptr)
            Delete(1, &id_);
    }
    [[nodiscard]] GLuint id() const { return id_; }

  private:
    GLuint id_ = 0;
};

using GlBuffer = GlObject<gl::GenBuffers, gl::DeleteBuffers>;
using GlTexture = GlObject<gl::GenTextures, gl::DeleteTextures>;
using GlFramebuffer = GlObject<gl::GenFramebuffers, gl::DeleteFramebuffers>;
using GlSampler = GlObject<gl::GenSamplers, gl::DeleteSamplers>;
using GlVertexArray = GlObject<gl::GenVertexArrays, gl::DeleteVertexArrays>;
using GlQuery = GlObject<gl::GenQueries, gl::DeleteQueries>;

/// A query that runs while this lives, and ends with it also where an error leaves the scope.
class RunningQuery {
  public:
    RunningQuery(GLenum target, const GlQuery& query) : target_(target) { gl::BeginQuery(target, query.id()); }
    ~RunningQuery() { gl::EndQuery(target_); }
    RunningQuery(const RunningQuery&) = delete;
    RunningQuery& operator=(const RunningQuery&) = delete;

  private:
    GLenum target_;
};

} // namespace lockstep
