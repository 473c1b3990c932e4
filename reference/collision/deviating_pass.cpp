#include "reference/collision/deviating_pass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_mistakes.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/collision_twin.hpp"
#include "reference/collision/step_stage.hpp"
#include "reference/readings/mistaken.hpp"
#include "reference/readings/mistaken_arithmetic.hpp"
#include "reference/window.hpp"

namespace lockstep {
namespace {

FrameParams stored_as(FrameParams params, CdtFormat format) {
    params.switches.cdt_format = format;
    return params;
}

/// The camera that places the points.
FrameParams seen_by(const FrameInputs& inputs, const Deviations& deviations) {
    FrameParams params = *inputs.params;
    if (deviations.has(Deviation::matrix_of_earlier_frame) && inputs.earlier_params != nullptr)
        params.collision_proj_view = inputs.earlier_params->collision_proj_view;
    return params;
}

struct PointShift {
    Deviation deviation;
    glm::vec2 half_pixels;
};
constexpr std::array point_shifts{PointShift{Deviation::point_half_pixel_up, {1.0F, 1.0F}},
                                  PointShift{Deviation::point_half_pixel_down, {-1.0F, -1.0F}},
                                  PointShift{Deviation::point_half_pixel_right, {1.0F, 0.0F}},
                                  PointShift{Deviation::point_half_pixel_left, {-1.0F, 0.0F}},
                                  PointShift{Deviation::point_half_pixel_higher, {0.0F, 1.0F}},
                                  PointShift{Deviation::point_half_pixel_lower, {0.0F, -1.0F}},
                                  PointShift{Deviation::point_pixel_right, {2.0F, 0.0F}},
                                  PointShift{Deviation::point_pixel_left, {-2.0F, 0.0F}},
                                  PointShift{Deviation::point_pixel_up, {0.0F, 2.0F}},
                                  PointShift{Deviation::point_pixel_down, {0.0F, -2.0F}},
                                  PointShift{Deviation::point_shift_without_w, {1.0F, 1.0F}}};

/// The point drawn for `position`.
template <class A> class DeviatingPoint {
  public:
    DeviatingPoint(A fp, const FrameParams& params, std::span<const Mistake> made, const Deviations& deviations,
                   const RasterRules& rules)
        : fp_(fp), params_(params), deviations_(deviations), rules_(rules), reading_(fp, made),
          image_(reading_, params) {
        if (has(Deviation::point_viewport_swapped))
            std::swap(viewport_width_, viewport_height_);
        if (has(Deviation::point_on_upper_pixel))
            rules_.point_edge_to_lower = !rules_.point_edge_to_lower;
        for (const PointShift& shift : point_shifts)
            if (has(shift.deviation))
                shift_ = shift.half_pixels;
    }

    [[nodiscard]] PointFragment operator()(glm::vec3 position) {
        const auto projected = image_.clip({position.x, position.y, position.z});
        glm::vec4 clip(as_float(projected.x), as_float(projected.y), as_float(projected.z), as_float(projected.w));
        if (has(Deviation::near_half_discarded) && clip.z < 0.0F)
            return {};
        if (has(Deviation::only_upper_right_drawn) && (clip.x < 0.0F || clip.y < 0.0F))
            return {};
        if (has(Deviation::point_without_divide))
            clip.w = 1.0F;
        if (has(Deviation::point_y_flipped))
            clip.y = -clip.y;
        if (has(Deviation::point_depth_constant))
            clip.z = 0.0F;
        if (has(Deviation::point_depth_reversed))
            clip.z = params_.clip_depth.from_zero() ? clip.w - clip.z : -clip.z;
        if (has(Deviation::point_depth_zero_to_one))
            clip.z = (clip.z + clip.w) * 0.5F;
        if (has(Deviation::point_depth_doubled))
            clip.z = clip.z * 2.0F - clip.w;
        if (has(Deviation::point_depth_clamped) && clip.w > 0.0F)
            clip.z = std::clamp(clip.z, -clip.w, clip.w);
        if (has(Deviation::point_x_flipped))
            clip.x = -clip.x;
        if (has(Deviation::point_x_and_y_swapped))
            std::swap(clip.x, clip.y);
        if (has(Deviation::point_flat))
            clip = {fp_.divide(clip.x, clip.w), fp_.divide(clip.y, clip.w), 0.0F, 1.0F};
        const float by = has(Deviation::point_shift_without_w) ? 1.0F : clip.w;
        if (shift_.x != 0.0F)
            clip.x += by * (shift_.x / static_cast<float>(params_.width));
        if (shift_.y != 0.0F)
            clip.y += by * (shift_.y / static_cast<float>(params_.height));
        return places_points(params_.switches) || std::is_base_of_v<Portable, A> ? placed(clip) : rasterised(clip);
    }

  private:
    using Reading = Mistaken<A>;
    static float as_float(const typename Reading::Real& x) { return static_cast<float>(x); }
    [[nodiscard]] bool has(Deviation deviation) const { return deviations_.has(deviation); }

    [[nodiscard]] PointFragment placed(glm::vec4 clip) const {
        const auto texel = image_.base_texel(image_.image_position({clip.x, clip.y, clip.z, clip.w}));
        const float ndc = fp_.divide(clip.z, clip.w);
        const float depth = params_.clip_depth.from_zero() ? ndc : (ndc + 1.0F) * 0.5F;
        if (!texel || !(clip.w > 0.0F) || !(depth >= 0.0F) || !(depth <= 1.0F))
            return {};
        const float kept = std::is_base_of_v<Portable, A> ? std::floor(depth * 0x1p24F) * 0x1p-24F : depth;
        return {texel->x, texel->y, params_.clip_depth.sign() * kept};
    }

    [[nodiscard]] PointFragment rasterised(glm::vec4 clip) const {
        if (!in_clip_volume(clip, params_.clip_depth))
            return {};
        const WindowPosition window =
            window_position(clip, viewport_width_, viewport_height_, rules_, params_.clip_depth);
        const int x = point_pixel(snap_point(window.x, rules_), rules_);
        const int y = point_pixel(snap_point(window.y, rules_), rules_);
        if (x < 0 || y < 0 || x >= params_.width || y >= params_.height)
            return {};
        const auto by_reciprocal = [&] {
            return clip.z * fp_.reciprocal(clip.w) * params_.clip_depth.scale() + params_.clip_depth.offset();
        };
        return {x, y, rules_.depth_by_driver_reciprocal ? by_reciprocal() : window.z};
    }

    A fp_;
    const FrameParams& params_;
    const Deviations& deviations_;
    RasterRules rules_;
    Reading reading_;
    BaseTexelTwin<Reading> image_;
    int viewport_width_ = params_.width;
    int viewport_height_ = params_.height;
    glm::vec2 shift_{0.0F}; ///< half pixels
};

/// Whether something else than the position is stored.
bool spoils_stored(Deviation deviation) {
    using enum Deviation;
    return (deviation >= stores_half_floats && deviation <= stores_x_and_z_swapped) ||
           deviation == position_interpolated || (deviation >= stores_negated && deviation <= stores_remapped) ||
           (deviation >= stores_window_coordinates && deviation <= stores_size);
}

/// What a wrong fragment stage stores for a position.
glm::vec3 stored_wrongly(glm::vec3 position, const PointFragment& point, const glm::mat4& proj_view,
                         const Deviations& deviations, const CollisionCode& halves) {
    if (deviations.has(Deviation::stores_window_coordinates))
        position = {static_cast<float>(point.x) + 0.5F, static_cast<float>(point.y) + 0.5F, point.depth};
    if (deviations.has(Deviation::stores_clip_space) || deviations.has(Deviation::stores_ndc)) {
        const glm::vec4 clip = proj_view * glm::vec4(position, 1.0F);
        position = glm::vec3(clip) / (deviations.has(Deviation::stores_ndc) ? clip.w : 1.0F);
    }
    if (deviations.has(Deviation::stores_in_steps))
        position = glm::round(position * 256.0F) / 256.0F;
    if (deviations.has(Deviation::stores_size))
        position = glm::abs(position);
    if (deviations.has(Deviation::stores_half_floats))
        position = halves.decode(halves.encode(position));
    if (deviations.has(Deviation::stores_srgb))
        position = glm::sign(position) * glm::pow(glm::abs(position), glm::vec3(1.0F / 2.2F));
    if (deviations.has(Deviation::stores_clamped))
        position = glm::clamp(position, 0.0F, 1.0F);
    if (deviations.has(Deviation::stores_x_and_y_swapped))
        std::swap(position.x, position.y);
    if (deviations.has(Deviation::stores_y_and_z_swapped))
        std::swap(position.y, position.z);
    if (deviations.has(Deviation::stores_x_and_z_swapped))
        std::swap(position.x, position.z);
    if (deviations.has(Deviation::position_interpolated))
        position = position / 3.0F * 3.0F; // as a mean of equal corners may round
    if (deviations.has(Deviation::stores_negated))
        position = -position;
    if (deviations.has(Deviation::stores_x_negated))
        position.x = -position.x;
    if (deviations.has(Deviation::stores_y_negated))
        position.y = -position.y;
    if (deviations.has(Deviation::stores_z_negated))
        position.z = -position.z;
    if (deviations.has(Deviation::stores_remapped))
        position = position * 0.5F + 0.5F;
    return position;
}

bool discards(glm::vec3 position, float collide_time, const Deviations& deviations) {
    return (deviations.has(Deviation::waiting_discarded) && collide_time > 0.0F) ||
           (deviations.has(Deviation::negative_x_discarded) && position.x < 0.0F) ||
           (deviations.has(Deviation::negative_y_discarded) && position.y < 0.0F) ||
           (deviations.has(Deviation::negative_z_discarded) && position.z < 0.0F);
}

class DeviatingDepthTest {
  public:
    explicit DeviatingDepthTest(const Deviations& deviations)
        : greater_(deviations.has(Deviation::depth_greater)), always_(deviations.has(Deviation::depth_not_tested)),
          equal_(deviations.has(Deviation::depth_equal_passes)) {}
    [[nodiscard]] bool passes(float depth, float stored) const {
        if (always_)
            return true;
        if (greater_)
            return depth > stored;
        return equal_ ? depth <= stored : depth < stored;
    }

  private:
    bool greater_, always_, equal_;
};

const std::vector<glm::vec3>& drawn_positions(const FrameInputs& inputs, const Particles& after,
                                              const Deviations& deviations) {
    const bool updated = inputs.params->switches.raster_position == RasterPosition::updated
                             ? !deviations.has(Deviation::point_of_position_before)
                             : deviations.has(Deviation::point_of_position_after);
    return updated ? after.position : inputs.before->position;
}

/// What the frame before left in the depth buffer.
void draw_earlier_depth(const FrameInputs& inputs, const Profile& profile, const DepthImage& obstacles_depth,
                        DepthImage& depth) {
    depth = obstacles_depth;
    for (const glm::vec3 position : inputs.before->position) {
        const PointFragment point = point_fragment(position, *inputs.earlier_params, profile);
        if (point.x >= 0)
            depth.at(point.x, point.y) = std::min(depth.at(point.x, point.y), point.depth);
    }
}

/// What the particles are drawn onto.
void prepare(const FrameInputs& inputs, const Profile& profile, const Deviations& deviations,
             const CollisionImage& obstacles_cdt, const DepthImage& obstacles_depth, CollisionImage& cdt,
             DepthImage& depth) {
    cdt = obstacles_cdt; // into the memory that it has
    if (deviations.has(Deviation::obstacles_not_drawn))
        std::fill(cdt.texels.begin(), cdt.texels.end(), glm::vec4(0.0F));
    depth = deviations.has(Deviation::obstacles_not_drawn) || deviations.has(Deviation::obstacles_never_hide)
                ? DepthImage(obstacles_depth.width, obstacles_depth.height, inputs.params->clip_depth.cleared())
                : obstacles_depth;
    if (deviations.has(Deviation::cdt_not_cleared) && inputs.earlier_cdt != nullptr)
        for (std::size_t i = 0; i < cdt.texels.size(); ++i)
            if (cdt.texels[i].a == 0.0F)
                cdt.texels[i] = inputs.earlier_cdt->texels[i];
    if (deviations.has(Deviation::depth_not_cleared) && inputs.earlier_params != nullptr) {
        draw_earlier_depth(inputs, profile, obstacles_depth, depth);
        for (std::size_t i = 0; i < cdt.texels.size(); ++i)
            if (!(obstacles_depth.texels[i] < depth.texels[i]))
                cdt.texels[i] = glm::vec4(0.0F);
    }
}

} // namespace

void deviating_draw(const FrameInputs& inputs, const Particles& after, const Profile& profile,
                    const Deviations& deviations, const CollisionImage& obstacles_cdt,
                    const DepthImage& obstacles_depth, CollisionImage& cdt) {
    const FlushSubnormals guard = flush_in_step(inputs.params->switches, profile);
    DepthImage depth;
    prepare(inputs, profile, deviations, obstacles_cdt, obstacles_depth, cdt, depth);
    const CollisionCode code(*inputs.params);
    const bool is_coarse = deviations.has(Deviation::half_cdt) || deviations.has(Deviation::unorm8_cdt);
    const CollisionCode coarse(
        stored_as(*inputs.params, deviations.has(Deviation::half_cdt) ? CdtFormat::rgba16f : CdtFormat::rgba8));
    const CollisionCode halves(stored_as(*inputs.params, CdtFormat::rgba16f));
    const auto stored_code = [&](glm::vec3 position) {
        return code.encode(is_coarse ? coarse.decode(coarse.encode(position)) : position);
    };
    if (is_coarse)
        for (glm::vec4& texel : cdt.texels)
            if (texel.a != 0.0F)
                texel = stored_code(code.decode(texel));
    if (deviations.has(Deviation::cdt_not_drawn))
        return;
    const std::vector<glm::vec3>& positions = drawn_positions(inputs, after, deviations);
    const std::vector<glm::vec3>& stored = deviations.has(Deviation::stores_direction)         ? after.direction
                                           : deviations.has(Deviation::stores_position_before) ? inputs.before->position
                                                                                               : after.position;
    const bool stores_position = std::none_of(deviations.begin(), deviations.end(), spoils_stored);
    const DeviatingDepthTest test(deviations);
    const std::vector<Mistake> made = mistakes_of(deviations, inputs.params->switches);
    const FrameParams params = seen_by(inputs, deviations);
    with_mistaken_arithmetic<true>(profile, params.switches.arithmetic, made, [&](auto fp) {
        DeviatingPoint fragment(fp, params, made, deviations, profile.raster);
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const bool was = deviations.has(Deviation::point_of_position_before_at_hit) &&
                             after.collide_time[i] > inputs.before->collide_time[i];
            PointFragment point = fragment(was ? inputs.before->position[i] : positions[i]);
            if (deviations.has(Deviation::fragment_depth_reversed))
                point.depth = params.clip_depth.sign() - point.depth;
            if (deviations.has(Deviation::fragment_depth_zero))
                point.depth = 0.0F;
            if (discards(after.position[i], after.collide_time[i], deviations))
                continue;
            if (deviations.has(Deviation::checkerboard_discarded) && (point.x + point.y) % 2 != 0)
                continue;
            if (!cdt.contains(point.x, point.y) || !test.passes(point.depth, depth.at(point.x, point.y)))
                continue;
            depth.at(point.x, point.y) = point.depth;
            glm::vec4& texel = cdt.at(point.x, point.y);
            texel = stored_code(stores_position
                                    ? stored[i]
                                    : stored_wrongly(stored[i], point, params.collision_proj_view, deviations, halves));
            if (deviations.has(Deviation::alpha_missing))
                texel.a = 0.0F;
            if (deviations.has(Deviation::alpha_is_depth))
                texel.a = point.depth;
            if (deviations.has(Deviation::alpha_is_speed))
                texel.a = after.speed[i];
            if (deviations.has(Deviation::alpha_is_collide_time))
                texel.a = after.collide_time[i];
        }
    });
}

} // namespace lockstep
