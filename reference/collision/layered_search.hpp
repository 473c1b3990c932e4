#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/collision/collision_code.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// The world to clip space of a collision camera, 0 or 1.
inline const glm::mat4& collision_proj_view(const FrameParams& params, int camera) {
    return camera == 0 ? params.collision_proj_view : params.second_proj_view;
}

/// Where a clip-space position lies on the image, in texels (listing, lines 2 to 4). `A`: the arithmetic
/// (arithmetic.hpp).
template <class A> struct ImagePosition {
    float x, y;
    bool inside;

    ImagePosition(A fp, glm::vec4 clip, const FrameParams& params) {
        const auto width = static_cast<float>(params.width);
        const auto height = static_cast<float>(params.height);
        x = (fp.divide(clip.x, clip.w) + 1.0F) * 0.5F * width;
        y = (fp.divide(clip.y, clip.w) + 1.0F) * 0.5F * height;
        inside = x >= 0.0F && y >= 0.0F && x < width && y < height;
    }
};

/// From low to high, both included; none where low > high.
struct Span {
    int low = 0;
    int high = -1;

    [[nodiscard]] bool contains(int i) const { return low <= i && i <= high; }
};

/// The texels a particle looks at, seen from one camera.
struct Window {
    Span columns, rows;
};

/// Where something is stored. Layer -1: an obstacle.
struct StoredAt {
    int camera, layer, x, y;
};

/// The search through the planes of a CDT (layered_collision_pass.hpp).
template <class A> class LayeredSearch {
  public:
    LayeredSearch(A fp, const CollisionImage& cdt, const FrameParams& params)
        : fp_(fp), cdt_(cdt), params_(params), planes_(cdt_planes(params.switches)), code_(params) {
        for (int camera = 0; camera < planes_.cameras; ++camera)
            reach_[static_cast<std::size_t>(camera)] = projected_reach(collision_proj_view(params, camera), params);
    }

    [[nodiscard]] Window window(glm::vec3 position, int camera) const {
        const glm::vec4 clip = fp_.transform(collision_proj_view(params_, camera), position);
        const ImagePosition at(fp_, clip, params_);
        if (!at.inside)
            return {};
        const glm::vec3 reach = reach_[static_cast<std::size_t>(camera)];
        const float before = fp_.flush(clip.w - fp_.flush(reach.z));
        return {span(at.x, fp_.divide(reach.x, before), params_.width),
                span(at.y, fp_.divide(reach.y, before), params_.height)};
    }

    /// Calls look(StoredAt, stored position) for everything in the windows of a particle, in the pass's order. A
    /// texel's layers are looked at from the front, up to one that lies farther behind than the range reaches.
    template <class Look> void for_each_stored(glm::vec3 position, const Look& look) const {
        for (int camera = 0; camera < planes_.cameras; ++camera) {
            const auto [columns, rows] = window(position, camera);
            const float behind =
                fp_.flush(depth(position, camera) + fp_.flush(reach_[static_cast<std::size_t>(camera)].z));
            for (int y = rows.low; y <= rows.high; ++y)
                for (int x = columns.low; x <= columns.high; ++x)
                    for (int layer = -1; layer < planes_.layers; ++layer) {
                        const glm::vec4 code = texel(planes_.position(camera, layer), x, y);
                        const glm::vec3 stored = fp_.flush(code_.decode(code));
                        if (code.a != 0.0F && !(depth(stored, camera) > behind))
                            look(StoredAt{camera, layer, x, y}, stored);
                        else if (layer >= 0)
                            break; // the layers behind are empty, or out of reach too
                    }
        }
    }

    struct Nearest {
        StoredAt at;
        glm::vec3 away; ///< own position minus the stored one
    };
    [[nodiscard]] std::optional<Nearest> nearest(glm::vec3 position) const {
        const glm::vec3 self = as_stored(position);
        float least = 100000.0F;
        std::optional<Nearest> found;
        for_each_stored(position, [&](StoredAt at, glm::vec3 stored) {
            const glm::vec3 apart = fp_.flush(position - stored);
            const float length = fp_.length(apart);
            if (stored == self || length == 0.0F || !(params_.constants.collision_range > length) || !(length < least))
                return;
            least = length;
            found = Nearest{at, apart};
        });
        return found;
    }

    /// What comes back of a position or a velocity that has been stored.
    [[nodiscard]] glm::vec3 as_stored(glm::vec3 v) const { return fp_.flush(code_.decode(code_.encode(v))); }

    [[nodiscard]] glm::vec4 velocity(StoredAt at) const {
        return texel(planes_.velocity(at.camera, at.layer), at.x, at.y);
    }

    [[nodiscard]] std::size_t index(StoredAt at) const {
        return cdt_.index(at.x, planes_.position(at.camera, at.layer) * params_.height + at.y);
    }

  private:
    /// Clip w.
    [[nodiscard]] float depth(glm::vec3 position, int camera) const {
        return fp_.transform(collision_proj_view(params_, camera), position).w;
    }

    [[nodiscard]] Span span(float at, float reach, int size) const {
        const int base = static_cast<int>(at);
        const int range = params_.constants.texel_collide_range;
        Span s{base - range, base + range};
        const float r = reach + window_margin;
        if (params_.switches.search_window == SearchWindow::projected && reach >= 0.0F &&
            r < static_cast<float>(range)) {
            s.low = std::max(s.low, static_cast<int>(std::floor(fp_.flush(at - r))));
            s.high = std::min(s.high, static_cast<int>(std::floor(at + r)));
        }
        return {std::max(s.low, 0), std::min(s.high, size - 1)};
    }

    [[nodiscard]] glm::vec4 texel(int plane, int x, int y) const { return cdt_.at(x, plane * params_.height + y); }

    A fp_;
    const CollisionImage& cdt_;
    const FrameParams& params_;
    CdtPlanes planes_;
    CollisionCode code_;
    std::array<glm::vec3, 2> reach_;
};

} // namespace lockstep
