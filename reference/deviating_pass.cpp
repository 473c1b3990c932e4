#include "reference/deviating_pass.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

#include "reference/collision_code.hpp"
#include "reference/subnormals.hpp"
#include "reference/window.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

using enum Deviation;

int clamp_to(int x, int size) { return std::clamp(x, 0, size - 1); }
int wrap(int x, int size) { return ((x % size) + size) % size; }

FrameParams stored_as(FrameParams params, CdtFormat format) {
    params.switches.cdt_format = format;
    return params;
}

/// The exact preset's arithmetic with sums the other way.
struct PortableRightToLeft : Portable {
    static float dot(glm::vec3 a, glm::vec3 b) {
        return add(multiply(a.x, b.x), add(multiply(a.y, b.y), multiply(a.z, b.z)));
    }
    static float length(glm::vec3 v) { return sqrt(dot(v, v)); }
    static glm::vec3 normalize(glm::vec3 v) { return scale(v, inverse_sqrt(dot(v, v))); }
};

/// The arithmetic a step is made with: the profile's, or a deviating one.
template <class Pass> decltype(auto) with_deviating_arithmetic(const Profile& profile, Switches switches,
                                                               const Deviations& deviations, Pass&& pass) {
    Profile deviating;
    const bool other_order =
        deviations.has(sums_left_to_right) || deviations.has(sums_right_to_left) || deviations.has(sums_fused);
    deviating.dot = profile.dot;
    // The driver's tables come with its own order of sums.
    if (!other_order) {
        deviating.length_dot = profile.length_dot;
        deviating.normalize_dot = profile.normalize_dot;
        deviating.roots = profile.roots;
    }
    if (deviations.has(sums_left_to_right))
        deviating.dot = DotOrder::left_to_right;
    if (deviations.has(sums_right_to_left))
        deviating.dot = DotOrder::right_to_left;
    if (deviations.has(sums_fused))
        deviating.dot = DotOrder::fused_chain;
    if (deviations.has(portable_arithmetic))
        switches.arithmetic = ArithmeticSwitch::exact;
    if (switches.arithmetic == ArithmeticSwitch::exact && deviations.has(sums_right_to_left))
        return pass(PortableRightToLeft{});
    return with_arithmetic(deviating, switches, pass);
}

const CollisionImage& read_cdt(const FrameInputs& inputs, const Deviations& deviations) {
    if (deviations.has(stale_cdt) && inputs.earlier_cdt != nullptr)
        return *inputs.earlier_cdt;
    if (deviations.has(current_frame_cdt) && inputs.drawn_cdt != nullptr)
        return *inputs.drawn_cdt;
    return *inputs.cdt;
}

template <class A> class DeviatingStep {
  public:
    DeviatingStep(A fp, const FrameInputs& inputs, const Deviations& deviations, StepTrace* trace)
        : fp_(fp), inputs_(inputs), params_(*inputs.params), constants_(params_.constants), switches_(params_.switches),
          deviations_(deviations), trace_(trace), code_(params_), cdt_(read_cdt(inputs, deviations)),
          tick_(constants_.tick) {
        if (has(half_cdt))
            coarse_code_.emplace(stored_as(params_, CdtFormat::rgba16f));
        if (has(unorm8_cdt))
            coarse_code_.emplace(stored_as(params_, CdtFormat::rgba8));
        if (has(tick_doubled))
            tick_ *= 2.0F;
        if (has(tick_halved))
            tick_ *= 0.5F;
    }

    ParticleState operator()(const ParticleState& before) {
        const ParticleState a{fp_.flush(before.position), fp_.flush(before.direction), fp_.flush(before.speed),
                              fp_.flush(before.collide_time)};
        const glm::vec4 clip = transform(a.position);
        const BaseTexelIndex base = base_texel(clip);
        const bool searches = may_search(a.collide_time) && base.x >= 0;
        if (trace_ != nullptr) {
            trace_->before = before;
            trace_->clip = clip;
            trace_->base = base;
            trace_->searches = searches;
        }
        std::optional<glm::vec3> away;
        if (searches)
            away = nearest_collision(a.position, base);
        const ParticleState after = away ? collide(a, *away) : integrate(a);
        if (has(state_passed_through))
            return before;
        return after;
    }

    [[nodiscard]] glm::vec4 transform(glm::vec3 v) const {
        glm::mat4 m = params_.collision_proj_view;
        if (has(matrix_of_earlier_frame) && inputs_.earlier_params != nullptr)
            m = inputs_.earlier_params->collision_proj_view;
        if (has(transposed_matrix))
            m = glm::transpose(m);
        if (!has(products_fused))
            return fp_.transform(m, v);
        const auto row = [&](int r) { return std::fma(m[2][r], v.z, std::fma(m[1][r], v.y, m[0][r] * v.x)) + m[3][r]; };
        return {row(0), row(1), row(2), row(3)};
    }

    [[nodiscard]] BaseTexelIndex base_texel(glm::vec4 clip) const {
        glm::vec2 p{clip.x, clip.y};
        if (switches_.perspective_divide == PerspectiveDivide::on && !has(no_perspective_divide))
            p = {fp_.divide(clip.x, clip.w), fp_.divide(clip.y, clip.w)};
        if (trace_ != nullptr)
            trace_->ndc = p;
        const float half = has(divide_by_half) ? 2.0F : has(not_halved) ? 1.0F : 0.5F;
        p = {(p.x + 1.0F) * half, (p.y + 1.0F) * half};
        if (has(x_flipped))
            p.x = 1.0F - p.x;
        if (has(y_flipped))
            p.y = 1.0F - p.y;
        if (trace_ != nullptr)
            trace_->texture_coordinate = p;
        const auto [width, height] = client_size();
        const float less = has(size_minus_one) ? 1.0F : 0.0F;
        p = {p.x * (static_cast<float>(width) - less), p.y * (static_cast<float>(height) - less)};
        if (has(half_texel_up))
            p += 0.5F;
        if (has(half_texel_down))
            p -= 0.5F;
        if (has(x_and_y_swapped))
            std::swap(p.x, p.y);
        if (trace_ != nullptr)
            trace_->image_position = p;
        const bool floors =
            switches_.base_texel == BaseTexel::floor ? !has(truncate_instead_of_floor) : has(floor_instead_of_truncate);
        const bool right = p.x < static_cast<float>(width) && p.y < static_cast<float>(height);
        const bool left = floors ? p.x >= 0.0F && p.y >= 0.0F : p.x > -1.0F && p.y > -1.0F;
        if (!left || !right)
            return {};
        return {static_cast<int>(p.x), static_cast<int>(p.y)};
    }

  private:
    [[nodiscard]] bool has(Deviation deviation) const { return deviations_.has(deviation); }

    [[nodiscard]] std::pair<int, int> client_size() const {
        return has(width_and_height_swapped) ? std::pair(params_.height, params_.width)
                                             : std::pair(params_.width, params_.height);
    }

    /// As the shader asks it, by its uniforms.
    [[nodiscard]] bool on_image(BaseTexelIndex texel) const {
        const auto [width, height] = client_size();
        return texel.x >= 0 && texel.y >= 0 && texel.x < width && texel.y < height;
    }

    /// Outside, where only a wrong size leads, drivers answer 0.
    [[nodiscard]] glm::vec4 fetch(BaseTexelIndex texel) const {
        return cdt_.contains(texel.x, texel.y) ? cdt_.at(texel.x, texel.y) : glm::vec4(0.0F);
    }

    [[nodiscard]] bool may_search(float collide_time) const {
        if (has(never_collides))
            return false;
        if (has(collide_time_not_tested))
            return true;
        if (has(collide_time_test_reversed))
            return collide_time > 0.0F;
        return has(collide_time_zero_searches) ? collide_time <= 0.0F : collide_time < 0.0F;
    }

    [[nodiscard]] bool holds_particle(glm::vec4 stored) const {
        const bool phantom =
            switches_.empty_texel == EmptyTexel::phantom ? !has(empty_texels_skipped) : has(phantom_origin);
        return phantom || stored.a != 0.0F;
    }

    [[nodiscard]] glm::vec3 decode(glm::vec4 stored) const {
        const glm::vec3 position = code_.decode(stored);
        return fp_.flush(coarse_code_ ? coarse_code_->decode(coarse_code_->encode(position)) : position);
    }

    [[nodiscard]] float distance(glm::vec3 apart) const {
        if (has(distance_without_z))
            apart.z = 0.0F;
        if (has(manhattan_distance))
            return (std::abs(apart.x) + std::abs(apart.y)) + std::abs(apart.z);
        return has(squared_distance) ? fp_.dot(apart, apart) : fp_.length(apart);
    }

    [[nodiscard]] bool in_range(float distance) const {
        if (has(range_not_tested))
            return true;
        return has(range_included) ? constants_.collision_range >= distance : constants_.collision_range > distance;
    }

    [[nodiscard]] bool nearer(float distance, float best, bool found) const {
        if (has(last_found_instead_of_nearest))
            return true;
        if (has(first_found_instead_of_nearest))
            return !found;
        if (has(farthest_instead_of_nearest))
            return !found || distance > best;
        return has(less_or_equal_for_less) ? distance <= best : distance < best;
    }

    /// The texel that is fetched for one outside the image; false: none.
    bool bring_inside(BaseTexelIndex& texel) const {
        if (has(outside_fetched_as_edge))
            texel = {clamp_to(texel.x, params_.width), clamp_to(texel.y, params_.height)};
        else if (has(outside_fetched_as_opposite_side))
            texel = {wrap(texel.x, params_.width), wrap(texel.y, params_.height)};
        else
            return false;
        return true;
    }

    [[nodiscard]] bool is_skipped(int tx, int ty) const {
        if (has(own_row_and_column_skipped))
            return tx == 0 || ty == 0;
        if ((has(own_row_skipped) && ty == 0) || (has(own_column_skipped) && tx == 0))
            return true;
        return tx == 0 && ty == 0 && !has(own_texel_not_skipped);
    }

    std::optional<glm::vec3> nearest_collision(glm::vec3 position, BaseTexelIndex base) {
        if (!on_image(base))
            return {};
        glm::vec3 own = position;
        const bool from_texel = switches_.self_position == SelfPosition::texel ? !has(own_position_from_vertex)
                                                                               : has(own_position_from_texel);
        if (from_texel) {
            const glm::vec4 self = fetch(base);
            if (!holds_particle(self))
                return {};
            own = decode(self);
        }
        if (trace_ != nullptr)
            trace_->own_position = own;
        float best = 100000.0F;
        std::optional<glm::vec3> away;
        const int range =
            constants_.texel_collide_range + (has(radius_one_more) ? 1 : 0) - (has(radius_one_less) ? 1 : 0);
        const int first_y = -range + (has(first_row_skipped) ? 1 : 0);
        const int first_x = -range + (has(first_column_skipped) ? 1 : 0);
        const int last_y = range - (has(last_row_skipped) ? 1 : 0);
        const int last_x = range - (has(last_column_skipped) ? 1 : 0);
        const bool zero_is_hit =
            switches_.zero_distance == ZeroDistance::hit ? !has(zero_distance_skipped) : has(zero_distance_hits);
        for (int ty = first_y; ty <= last_y; ++ty) {
            for (int tx = first_x; tx <= last_x; ++tx) {
                if (is_skipped(tx, ty))
                    continue;
                BaseTexelIndex texel{base.x + tx, base.y + ty};
                NeighbourTrace seen;
                seen.texel = texel;
                seen.on_image = on_image(texel);
                glm::vec4 stored(0.0F);
                bool fetched = seen.on_image || bring_inside(texel);
                if (fetched)
                    stored = fetch(texel);
                bool holds = fetched && holds_particle(stored);
                if (!fetched && has(outside_fetched_as_origin))
                    fetched = holds = true;
                if (fetched && holds) {
                    const glm::vec3 apart = fp_.flush(own - decode(stored));
                    const float len = distance(apart);
                    seen.holds_particle = true;
                    seen.compared = len != 0.0F || zero_is_hit;
                    if (seen.compared && in_range(len) && nearer(len, best, away.has_value())) {
                        best = len;
                        away = apart;
                        seen.became_nearest = true;
                    }
                    seen.position = decode(stored);
                    seen.apart = apart;
                    seen.distance = len;
                }
                if (trace_ != nullptr) {
                    seen.stored = stored;
                    if (seen.became_nearest)
                        trace_->nearest = trace_->neighbours.size();
                    trace_->neighbours.push_back(seen);
                }
            }
        }
        return away;
    }

    [[nodiscard]] ParticleState collide(const ParticleState& a, glm::vec3 away) const {
        if (has(direction_towards_neighbour))
            away = -away;
        ParticleState v;
        float factor = switches_.speed_factor;
        if (has(speed_reduced_by_instead_of_to))
            factor = 1.0F - factor;
        if (has(speed_factor_doubled))
            factor *= 2.0F;
        v.speed = has(speed_kept_at_hit) ? a.speed : fp_.flush(a.speed * factor);
        if (has(speed_factor_squared))
            v.speed = fp_.flush(v.speed * factor);
        v.direction = has(direction_kept_at_hit)             ? a.direction
                      : has(direction_not_normalised_at_hit) ? away
                                                             : fp_.normalize(away);
        v.collide_time = has(collide_time_not_set)          ? a.collide_time
                         : has(collide_time_counted_at_hit) ? fp_.flush(constants_.collision_time - tick_)
                                                            : constants_.collision_time;
        const bool by_tick = switches_.collision_step == CollisionStep::tick ? !has(tick_missing_in_collision_step)
                                                                             : has(tick_added_to_collision_step);
        const glm::vec3 direction = has(old_direction_moves_at_hit) ? a.direction : v.direction;
        const float speed = has(old_speed_moves_at_hit) ? a.speed : v.speed;
        if (has(position_kept_at_hit))
            v.position = a.position;
        else if (by_tick)
            v.position = multiply_add(fp_.scale(direction, speed), tick_, a.position);
        else
            v.position = multiply_add(direction, speed, a.position);
        return v;
    }

    [[nodiscard]] ParticleState integrate(const ParticleState& a) const {
        glm::vec3 gravity = fp_.scale(constants_.gravity, has(gravity_without_tick) ? 1.0F : tick_);
        if (has(gravity_missing))
            gravity = glm::vec3(0.0F);
        if (has(gravity_doubled))
            gravity = gravity * 2.0F;
        if (has(gravity_reversed))
            gravity = -gravity;
        const glm::vec3 temp = multiply_add(a.direction, a.speed, gravity);
        if (trace_ != nullptr)
            trace_->velocity = temp;
        ParticleState v;
        v.direction = has(direction_not_updated)      ? a.direction
                      : has(direction_not_normalised) ? temp
                                                      : fp_.normalize(temp);
        v.speed = has(speed_not_updated) ? a.speed : has(squared_speed) ? fp_.dot(temp, temp) : fp_.length(temp);
        const float ticks = has(collide_time_counted_twice) ? tick_ * 2.0F
                            : has(collide_time_counted_up)  ? -tick_
                                                            : tick_;
        v.collide_time = has(collide_time_not_counted) ? a.collide_time : fp_.flush(a.collide_time - ticks);
        glm::vec3 step = has(moves_before_gravity) ? fp_.scale(a.direction, a.speed) : fp_.scale(v.direction, v.speed);
        if (has(move_reversed))
            step = -step;
        v.position = has(position_not_updated)
                         ? a.position
                         : multiply_add(step, has(tick_missing_in_move) ? 1.0F : tick_, a.position);
        return v;
    }

    /// v * s + offset
    [[nodiscard]] glm::vec3 multiply_add(glm::vec3 v, float s, glm::vec3 offset) const {
        if (has(products_fused))
            return {std::fma(v.x, s, offset.x), std::fma(v.y, s, offset.y), std::fma(v.z, s, offset.z)};
        return fp_.flush(offset + fp_.scale(v, s));
    }

    A fp_;
    const FrameInputs& inputs_;
    const FrameParams& params_;
    const Constants& constants_;
    const Switches& switches_;
    const Deviations& deviations_;
    StepTrace* trace_;
    CollisionCode code_;
    std::optional<CollisionCode> coarse_code_;
    const CollisionImage& cdt_;
    float tick_;
};

/// The point drawn for `position`.
template <class A> class DeviatingPoint {
  public:
    DeviatingPoint(A fp, const FrameInputs& inputs, const Deviations& deviations, const RasterRules& rules)
        : fp_(fp), params_(*inputs.params), deviations_(deviations), rules_(rules),
          step_(fp, inputs, deviations, nullptr) {
        if (has(point_viewport_swapped))
            std::swap(viewport_width_, viewport_height_);
        if (has(point_on_upper_pixel))
            rules_.point_edge_to_lower = !rules_.point_edge_to_lower;
        if (has(point_half_pixel_up))
            shift_ = 1.0F;
        if (has(point_half_pixel_down))
            shift_ = -1.0F;
    }

    [[nodiscard]] PointFragment operator()(glm::vec3 position) const {
        glm::vec4 clip = step_.transform(position);
        if (has(point_without_divide))
            clip.w = 1.0F;
        if (has(point_y_flipped))
            clip.y = -clip.y;
        if (shift_ != 0.0F) {
            clip.x += clip.w * (shift_ / static_cast<float>(params_.width));
            clip.y += clip.w * (shift_ / static_cast<float>(params_.height));
        }
        return std::is_base_of_v<Portable, A> ? placed(clip) : rasterised(clip);
    }

  private:
    [[nodiscard]] bool has(Deviation deviation) const { return deviations_.has(deviation); }

    [[nodiscard]] PointFragment placed(glm::vec4 clip) const {
        const BaseTexelIndex texel = step_.base_texel(clip);
        const float depth = (fp_.divide(clip.z, clip.w) + 1.0F) * 0.5F;
        if (texel.x < 0 || !(clip.w > 0.0F) || !(depth >= 0.0F) || !(depth <= 1.0F))
            return {};
        return {texel.x, texel.y, std::floor(depth * 0x1p24F) * 0x1p-24F};
    }

    [[nodiscard]] PointFragment rasterised(glm::vec4 clip) const {
        if (!in_clip_volume(clip))
            return {};
        const WindowPosition window = window_position(clip, viewport_width_, viewport_height_, rules_);
        const int x = point_pixel(snap_point(window.x, rules_), rules_);
        const int y = point_pixel(snap_point(window.y, rules_), rules_);
        if (x < 0 || y < 0 || x >= params_.width || y >= params_.height)
            return {};
        return {x, y, rules_.depth_by_driver_reciprocal ? clip.z * fp_.reciprocal(clip.w) * 0.5F + 0.5F : window.z};
    }

    A fp_;
    const FrameParams& params_;
    const Deviations& deviations_;
    RasterRules rules_;
    DeviatingStep<A> step_;
    int viewport_width_ = params_.width;
    int viewport_height_ = params_.height;
    float shift_ = 0.0F; ///< half pixels
};

class DepthTest {
  public:
    explicit DepthTest(const Deviations& deviations)
        : greater_(deviations.has(depth_greater)), always_(deviations.has(depth_not_tested)),
          equal_(deviations.has(depth_equal_passes)) {}
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
                             ? !deviations.has(point_of_position_before)
                             : deviations.has(point_of_position_after);
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
    cdt =
        deviations.has(obstacles_not_drawn) ? CollisionImage(obstacles_cdt.width, obstacles_cdt.height) : obstacles_cdt;
    depth = deviations.has(obstacles_not_drawn) || deviations.has(obstacles_never_hide)
                ? DepthImage(obstacles_depth.width, obstacles_depth.height, 1.0F)
                : obstacles_depth;
    if (deviations.has(cdt_not_cleared) && inputs.earlier_cdt != nullptr)
        for (std::size_t i = 0; i < cdt.texels.size(); ++i)
            if (cdt.texels[i].a == 0.0F)
                cdt.texels[i] = inputs.earlier_cdt->texels[i];
    if (deviations.has(depth_not_cleared) && inputs.earlier_params != nullptr) {
        draw_earlier_depth(inputs, profile, obstacles_depth, depth);
        for (std::size_t i = 0; i < cdt.texels.size(); ++i)
            if (!(obstacles_depth.texels[i] < depth.texels[i]))
                cdt.texels[i] = glm::vec4(0.0F);
    }
}

} // namespace

ParticleState deviating_step(const FrameInputs& inputs, std::size_t i, const Profile& profile,
                             const Deviations& deviations, StepTrace* trace) {
    const FlushSubnormals guard(profile.flush_subnormals && !deviations.has(subnormals_kept));
    const bool earlier = deviations.has(buffers_not_swapped) && inputs.earlier != nullptr;
    const ParticleState before = (earlier ? *inputs.earlier : *inputs.before)[i];
    return with_deviating_arithmetic(profile, inputs.params->switches, deviations,
                                     [&](auto fp) { return DeviatingStep(fp, inputs, deviations, trace)(before); });
}

void deviating_draw(const FrameInputs& inputs, const Particles& after, const Profile& profile,
                    const Deviations& deviations, const CollisionImage& obstacles_cdt,
                    const DepthImage& obstacles_depth, CollisionImage& cdt) {
    const FlushSubnormals guard(profile.flush_subnormals);
    DepthImage depth;
    prepare(inputs, profile, deviations, obstacles_cdt, obstacles_depth, cdt, depth);
    const CollisionCode code(*inputs.params);
    const bool is_coarse = deviations.has(half_cdt) || deviations.has(unorm8_cdt);
    const CollisionCode coarse(
        stored_as(*inputs.params, deviations.has(half_cdt) ? CdtFormat::rgba16f : CdtFormat::rgba8));
    const auto stored_code = [&](glm::vec3 position) {
        return code.encode(is_coarse ? coarse.decode(coarse.encode(position)) : position);
    };
    if (is_coarse)
        for (glm::vec4& texel : cdt.texels)
            if (texel.a != 0.0F)
                texel = stored_code(code.decode(texel));
    if (deviations.has(cdt_not_drawn))
        return;
    const std::vector<glm::vec3>& positions = drawn_positions(inputs, after, deviations);
    const std::vector<glm::vec3>& stored = deviations.has(stores_direction)         ? after.direction
                                           : deviations.has(stores_position_before) ? inputs.before->position
                                                                                    : after.position;
    const DepthTest test(deviations);
    with_deviating_arithmetic(profile, inputs.params->switches, deviations, [&](auto fp) {
        const DeviatingPoint fragment(fp, inputs, deviations, profile.raster);
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const PointFragment point = fragment(positions[i]);
            if (!cdt.contains(point.x, point.y) || !test.passes(point.depth, depth.at(point.x, point.y)))
                continue;
            depth.at(point.x, point.y) = point.depth;
            glm::vec4& texel = cdt.at(point.x, point.y);
            texel = stored_code(stored[i]);
            if (deviations.has(alpha_missing))
                texel.a = 0.0F;
        }
    });
}

} // namespace lockstep
