#include "reference/render_pass.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "reference/draw_in_bands.hpp"
#include "reference/draw_triangles.hpp"
#include "reference/pixel_box.hpp"
#include "reference/shading.hpp"
#include "reference/subnormals.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

/// `A`: the arithmetic (arithmetic.hpp).
template <class A> class RenderPass {
  public:
    RenderPass(A fp, const FrameParams& params, const Profile& profile)
        : fp_(fp), shading_(fp), params_(params), profile_(profile), width_(params.render_width),
          height_(params.render_height), color_(width_, height_), depth_(width_, height_, 1.0F) {}

    void draw_background() {
        for (int y = 0; y < height_; ++y) {
            const Rgba8 color = Shading<A>::quantise(shading_.background(y, height_));
            std::fill_n(&color_.at(0, y), width_, color);
        }
    }

    void draw_obstacles(const Mesh& obstacles) {
        std::vector<glm::vec3> view(obstacles.positions.size());
        std::vector<glm::vec4> clip(obstacles.positions.size());
        for (std::size_t i = 0; i < view.size(); ++i) {
            view[i] = to_view(obstacles.positions[i]);
            clip[i] = fp_.transform(params_.render_projection, view[i]);
        }
        const auto shader = [&](std::size_t triangle) {
            const std::uint32_t* index = &obstacles.indices[triangle * 3];
            const Rgba8 color =
                Shading<A>::quantise(shading_.obstacle({view[index[0]], view[index[1]], view[index[2]]}));
            return [this, color](int x, int y, const auto&, float depth) { keep_nearer(x, y, depth, color); };
        };
        draw_triangles(fp_, clip, obstacles.indices, width_, height_, profile_, shader);
    }

    void draw_particles(const Particles& particles) {
        std::vector<Sprite> sprites(particles.size());
        for (std::size_t i = 0; i < sprites.size(); ++i)
            sprites[i] = sprite(to_view(particles.position[i]));
        const auto rows = [&](std::size_t i) { return std::pair{sprites[i].pixels.y0, sprites[i].pixels.y1 - 1}; };
        const auto draw = [&](std::size_t i, const PixelRect& area) {
            const PixelRect& pixels = sprites[i].pixels;
            for (int y = std::max(pixels.y0, area.y0); y < std::min(pixels.y1, area.y1); ++y)
                for (int x = pixels.x0; x < pixels.x1; ++x)
                    draw_sphere_pixel(sprites[i], x, y, particles.speed[i], particles.collide_time[i]);
        };
        draw_in_bands(sprites.size(), width_, height_, profile_, rows, draw);
    }

    ColorImage take_image() { return std::move(color_); }

    [[nodiscard]] glm::vec3 to_view(glm::vec3 position) const { return fp_.transform(params_.render_view, position); }

    [[nodiscard]] Billboard billboard(glm::vec3 view_centre) const {
        return expand_billboard(fp_, view_centre, params_.constants.billboard_radius, params_.render_projection);
    }

  private:
    struct Sprite {
        glm::vec3 centre{0.0F}; ///< view space
        BillboardWindow window;
        PixelRect pixels;
    };

    [[nodiscard]] Sprite sprite(glm::vec3 view_centre) const {
        const Billboard square = billboard(view_centre);
        if (!is_visible(square))
            return {};
        const BillboardWindow window = billboard_window(fp_, square, width_, height_);
        if constexpr (std::is_same_v<A, Portable>)
            return {view_centre, window, pixel_box(window.low, window.high, width_, height_)};
        else
            return {view_centre, window, covered_pixels(square, width_, height_, profile_.raster)};
    }

    /// The sphere of the billboard's radius where the square's pixel looks at it, seen without perspective.
    void draw_sphere_pixel(const Sprite& sprite, int x, int y, float speed, float collide_time) {
        const float dx = fp_.divide((static_cast<float>(x) + 0.5F) - sprite.window.centre.x, sprite.window.half.x);
        const float dy = fp_.divide((static_cast<float>(y) + 0.5F) - sprite.window.centre.y, sprite.window.half.y);
        const float squared = dx * dx + dy * dy;
        if (!(squared <= 1.0F))
            return;
        const glm::vec3 normal(dx, dy, fp_.sqrt(1.0F - squared));
        const float z = sprite.centre.z + normal.z * params_.constants.billboard_radius;
        const glm::vec4 clip = fp_.transform(params_.render_projection, {sprite.centre.x, sprite.centre.y, z});
        const float depth = clamp_to(fp_.divide(clip.z, clip.w) * 0.5F + 0.5F, 1.0F);
        if (depth < depth_.at(x, y))
            keep_nearer(
                x, y, depth,
                Shading<A>::quantise(shading_.particle(normal, speed, collide_time, params_.constants.collision_time)));
    }

    void keep_nearer(int x, int y, float depth, Rgba8 color) {
        if (!(depth < depth_.at(x, y)))
            return;
        depth_.at(x, y) = depth;
        color_.at(x, y) = color;
    }

    A fp_;
    Shading<A> shading_;
    const FrameParams& params_;
    const Profile& profile_;
    int width_, height_;
    ColorImage color_;
    DepthImage depth_;
};

} // namespace

ColorImage render_pass(const Particles& particles, const Mesh& obstacles, const FrameParams& params,
                       const Profile& profile) {
    const FlushSubnormals guard(profile.flush_subnormals);
    return with_arithmetic(profile, params.switches, [&](auto fp) {
        RenderPass pass(fp, params, profile);
        pass.draw_background();
        pass.draw_obstacles(obstacles);
        pass.draw_particles(particles);
        return pass.take_image();
    });
}

Billboard particle_billboard(glm::vec3 position, const FrameParams& params, const Profile& profile) {
    const FlushSubnormals guard(profile.flush_subnormals);
    return with_arithmetic(profile, params.switches, [&](auto fp) {
        const RenderPass pass(fp, params, profile);
        return pass.billboard(pass.to_view(position));
    });
}

} // namespace lockstep
