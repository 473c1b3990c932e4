#pragma once
#include <span>

#include <glm/vec4.hpp>

#include "gpu/probe/images.hpp"
#include "gpu/program.hpp"

namespace lockstep::probing {

/// An image of one float, the number of the primitive drawn there last, and a depth buffer (DEPTH_COMPONENT32F).
class IdImage {
  public:
    IdImage(int width, int height);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// No primitive (-1) anywhere, depth 1; binds it for drawing, the whole image as viewport.
    void clear() const;

    [[nodiscard]] Floats ids() const;    ///< row by row from the lowest
    [[nodiscard]] Floats depths() const; ///< likewise

  private:
    int width_;
    int height_;
    GlTexture color_;
    GlTexture depth_;
    GlFramebuffer framebuffer_;
};

/// A vertex as it leaves the vertex stage. Numbers are exact up to 2^24.
struct RasterVertex {
    glm::vec4 clip;
    float id;
};

enum class Primitive { points, triangles };

/// Fixed-function rasterisation behind a vertex stage that computes nothing.
class RasterStage {
  public:
    /// `geometry`: with a geometry stage that passes primitives on, as the passes have one. `point_coord`: fragments
    /// put out gl_PointCoord, the number and 1 instead of the number alone.
    RasterStage(Primitive primitive, bool geometry, bool point_coord = false);

    /// gl_PointSize, where point_coord was asked for.
    void set_point_size(float size) const { program_.set("u_PointSize", size); }

    /// Draws without clearing; depth test as it is set.
    void draw(std::span<const RasterVertex> vertices) const;

  private:
    Primitive primitive_;
    Program program_;
};

} // namespace lockstep::probing
