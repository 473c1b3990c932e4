#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "reference/collision/render/sites.hpp"
#include "reference/collision/render/sprite.hpp"
#include "reference/collision/render_pass.hpp"
#include "reference/collision/shading.hpp"
#include "reference/draw_in_bands.hpp"
#include "reference/draw_triangles.hpp"
#include "reference/pixel_box.hpp"

namespace lockstep {

template <class A> glm::vec3 to_render_view(A fp, glm::vec3 position, const FrameParams& params) {
    return fp.transform(params.render_view, position);
}

/// The square of a particle, in clip space.
template <class A, class Sites>
Billboard particle_square(A fp, const Sites& sites, glm::vec3 view_centre, const FrameParams& params) {
    const float radius = sites.corner_radius(params.constants.billboard_radius);
    const glm::mat4& projection = params.render_projection;
    return sites.square(
        expand_billboard(fp, sites.square_centre(view_centre, radius), radius, projection),
        [&] { return fp.transform(projection, view_centre); }, radius);
}

/// The render pass's drawing. `A`: the arithmetic (arithmetic.hpp); `Sites`: RightSites, or what a mistake makes of it.
template <class A, class Sites> class RenderDrawing {
  public:
    RenderDrawing(A fp, Sites sites, const FrameParams& params, const Profile& profile)
        : fp_(fp), sites_(sites), shading_(fp, sites), params_(params), profile_(profile), width_(params.render_width),
          height_(params.render_height), color_(width_, height_), owner_(width_, height_),
          depth_(width_, height_, sites.depth_test() == DepthTest::greater ? 0.0F : 1.0F) {}

    void draw_background() {
        for (int y = 0; y < height_; ++y) {
            const Rgba8 color = shading_.quantise(shading_.background(y, sites_.size(width_, height_, false).y));
            std::fill_n(&color_.at(0, y), width_, sites_.stored(color, false));
        }
    }

    void draw_obstacles(const Mesh& obstacles) {
        std::vector<glm::vec3> view(obstacles.positions.size());
        std::vector<glm::vec4> clip(obstacles.positions.size());
        for (std::size_t i = 0; i < view.size(); ++i) {
            view[i] = to_render_view(fp_, obstacles.positions[i], params_);
            clip[i] = fp_.transform(params_.render_projection, view[i]);
        }
        const auto shaded = [&](std::uint32_t i) { return sites_.shaded_corner(view[i], obstacles.positions[i]); };
        const auto shader = [&](std::size_t triangle) {
            const std::uint32_t* index = &obstacles.indices[triangle * 3];
            const Rgba8 color =
                shading_.quantise(shading_.obstacle({shaded(index[0]), shaded(index[1]), shaded(index[2])}));
            const PixelOwner owner{PixelOwner::Kind::obstacle, static_cast<std::uint32_t>(triangle)};
            return [this, color, owner](int x, int y, const auto&, float depth) {
                if (passes(depth, depth_.at(x, y)))
                    keep(x, y, depth, color, owner);
            };
        };
        draw_triangles(fp_, clip, obstacles.indices, width_, height_, profile_, shader);
    }

    /// One slice after the other, so that the sprites of a few alone are held.
    void draw_particles(const Particles& particles) {
        constexpr std::size_t slice = std::size_t{1} << 18U;
        std::vector<Sprite> sprites;
        for (std::size_t first = 0; first < particles.size(); first += slice) {
            sprites.resize(std::min(slice, particles.size() - first));
            for (std::size_t i = 0; i < sprites.size(); ++i)
                sprites[i] = sprite(to_render_view(fp_, particles.position[first + i], params_));
            const auto rows = [&](std::size_t i) { return std::pair{sprites[i].pixels.y0, sprites[i].pixels.y1 - 1}; };
            const auto draw = [&](std::size_t i, const PixelRect& area) {
                const PixelRect& pixels = sprites[i].pixels;
                for (int y = std::max(pixels.y0, area.y0); y < std::min(pixels.y1, area.y1); ++y)
                    for (int x = pixels.x0; x < pixels.x1; ++x)
                        draw_sphere_pixel(sprites[i], x, y, particles, first + i);
            };
            draw_in_bands(sprites.size(), width_, height_, profile_, rows, draw);
        }
    }

    RenderedFrame take() { return {std::move(color_), std::move(owner_)}; }

  private:
    struct Sprite {
        glm::vec3 centre{0.0F}; ///< view space
        BillboardWindow window;
        PixelRect pixels;
    };

    [[nodiscard]] Sprite sprite(glm::vec3 view_centre) const {
        const Billboard square = particle_square(fp_, sites_, view_centre, params_);
        if (!is_visible(square))
            return {};
        const glm::ivec2 size = sites_.size(width_, height_, true);
        const BillboardWindow window = sites_.sphere_window(billboard_window(fp_, square, size.x, size.y));
        const Billboard quad = sites_.quad(square);
        if constexpr (std::is_same_v<A, Portable>) {
            const BillboardWindow drawn = billboard_window(fp_, quad, width_, height_);
            return {view_centre, window, pixel_box(drawn.low, drawn.high, width_, height_)};
        } else {
            return {view_centre, window, covered_pixels(quad, width_, height_, profile_.raster)};
        }
    }

    void draw_sphere_pixel(const Sprite& sprite, int x, int y, const Particles& particles, std::size_t i) {
        const SphereFragment<A> fragment = sphere_fragment(fp_, sites_, sprite.centre, sprite.window, x, y, params_);
        if (!fragment.inside || !passes(fragment.depth, depth_.at(x, y)))
            return;
        const glm::vec3 color = shading_.particle(fragment.normal, particles.speed[i], particles.collide_time[i],
                                                  params_.constants.collision_time);
        keep(x, y, fragment.depth, shading_.quantise(color),
             {PixelOwner::Kind::particle, static_cast<std::uint32_t>(i)});
    }

    [[nodiscard]] bool passes(float depth, float there) const {
        switch (sites_.depth_test()) {
        case DepthTest::less:
            return depth < there;
        case DepthTest::less_or_equal:
            return depth <= there;
        case DepthTest::greater:
            return depth > there;
        case DepthTest::always:
            return true;
        }
        return false;
    }

    void keep(int x, int y, float depth, Rgba8 color, PixelOwner owner) {
        depth_.at(x, y) = depth;
        color_.at(x, y) = sites_.stored(color, owner.kind == PixelOwner::Kind::particle);
        owner_.at(x, y) = owner;
    }

    A fp_;
    Sites sites_;
    Shading<A, Sites> shading_;
    const FrameParams& params_;
    const Profile& profile_;
    int width_, height_;
    ColorImage color_;
    Image<PixelOwner> owner_;
    DepthImage depth_;
};

} // namespace lockstep
