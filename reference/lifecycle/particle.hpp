#pragma once
#include <array>
#include <bit>
#include <cstdint>

#include "reference/lifecycle/packing.hpp"
#include "reference/model/lifecycle/host.hpp"
#include "reference/model/lifecycle/layout.hpp"
#include "reference/model/lifecycle/schema.hpp"
#include "reference/readings/constant_divisor.hpp"
#include "reference/system/item_pass.hpp"
#include "reference/system/item_words.hpp"
#include "reference/system/pcg3d.hpp"

namespace lockstep::lifecycle {

/// The words of an item of a buffer as they stand.
using RawWords = std::array<std::uint32_t, 28>;

inline RawWords raw_words(const SystemView& state, std::uint8_t resource, std::size_t item) {
    static_cast<void>(state.value({resource, 0}, item)); // that it is there, and that it was read
    const View& view = state[resource];
    RawWords raw{};
    std::size_t w = 0;
    for (std::size_t f = 0; f < view.columns.size(); ++f) {
        const auto n = static_cast<std::size_t>(view.fields()[f].components);
        std::memcpy(raw.data() + w, view.columns[f] + item * n * sizeof(std::uint32_t), n * sizeof(std::uint32_t));
        w += n;
    }
    return raw;
}

/// A particle in one of the layouts, read and written field by field. Twin of shaders/lifecycle/layout.glsl.
template <class R> class Particle {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;

  public:
    /// One of zeros.
    Particle(R& reading, const Host& host) : Particle(reading, host, RawWords{}) {}
    Particle(R& reading, const Host& host, const RawWords& raw)
        : r(reading), host_(host), plan_(plan_of(host.switches().layout)), raw_(raw) {}

    /// What dithering is keyed by.
    void at(std::size_t slot, int frame) {
        slot_ = static_cast<std::uint32_t>(slot);
        frame_ = static_cast<std::uint32_t>(frame);
    }

    [[nodiscard]] Vec3 position() const {
        if (plan_.floats)
            return words(site::position_before, plan_.position);
        if (!boxed())
            return r.note(site::position_before, Vec3{half(high(0)), half(low(0)), half(high(1))});
        const Vec3 low_corner = r.uniform(site::box_low, host_.settings().box_low);
        const Vec3 step = r.uniform(site::box_step, host_.box_step());
        return r.note(site::position_before,
                      Vec3{low_corner.x + R::real(high(0)) * step.x, low_corner.y + R::real(low(0)) * step.y,
                           low_corner.z + R::real(high(1)) * step.z});
    }
    void set_position(const Vec3& p) {
        if (plan_.floats)
            return set_words(plan_.position, p);
        if (!boxed()) {
            set_word_of(0, half_of(p.x, 0, site::position_code), half_of(p.y, 1, site::position_code));
            return set_high(1, half_of(p.z, 2, site::position_code));
        }
        const Vec3 low_corner = r.uniform(site::box_low, host_.settings().box_low);
        const Vec3 scale = r.uniform(site::box_scale, host_.box_scale());
        const auto code = [&](const Real& x, const Real& from, const Real& by) {
            return ticks_of(r, site::in_box, (x - from) * by, &clamped_);
        };
        const std::uint32_t x = code(p.x, low_corner.x, scale.x), y = code(p.y, low_corner.y, scale.y);
        set_word_of(0, x, y);
        set_high(1, code(p.z, low_corner.z, scale.z));
    }

    [[nodiscard]] Vec3 velocity() const {
        if (plan_.floats)
            return words(site::velocity_before, plan_.velocity);
        return r.note(site::velocity_before, Vec3{half(low(1)), half(high(2)), half(low(2))});
    }
    void set_velocity(const Vec3& v) {
        if (plan_.floats)
            return set_words(plan_.velocity, v);
        set_low(1, half_of(v.x, 3, site::velocity_code));
        const std::uint32_t y = half_of(v.y, 4, site::velocity_code);
        set_word_of(2, y, half_of(v.z, 5, site::velocity_code));
    }

    [[nodiscard]] Vec3 acceleration() const {
        if (plan_.floats)
            return words(site::acceleration_before, plan_.acceleration);
        return r.note(site::acceleration_before, Vec3{half(high(4)), half(low(4)), half(high(5))});
    }
    void set_acceleration(const Vec3& a) {
        if (plan_.floats)
            return set_words(plan_.acceleration, a);
        const std::uint32_t x = half_of(a.x, 6, site::acceleration_code);
        set_word_of(4, x, half_of(a.y, 7, site::acceleration_code));
        set_high(5, half_of(a.z, 8, site::acceleration_code));
    }

    [[nodiscard]] bool counts_ticks() const { return !plan_.floats && host_.switches().time_code == TimeCode::ticks16; }
    /// Seconds, or ticks as they are counted.
    [[nodiscard]] Real remaining() const {
        if (plan_.floats)
            return word(site::remaining_before, plan_.remaining);
        return r.note(site::remaining_before, counts_ticks() ? R::real(low(3)) : half(low(3)));
    }
    [[nodiscard]] Real lifetime() const {
        if (plan_.floats)
            return word(site::lifetime, plan_.lifetime);
        return r.note(site::lifetime, counts_ticks() ? R::real(high(3)) : half(high(3)));
    }
    /// Seconds, or the low 16 bits of the frame.
    [[nodiscard]] Real spawn_time() const {
        if (plan_.floats)
            return word(site::spawn_time, plan_.spawn_time);
        return r.note(site::spawn_time, counts_ticks() ? R::real(low(5)) : half(low(5)));
    }
    void set_remaining(const Real& x) {
        if (plan_.floats)
            set(plan_.remaining, x);
        else if (counts_ticks())
            set_low(3, static_cast<std::uint32_t>(static_cast<int>(r.to_int(site::remaining_code, x))));
        else
            set_low(3, half_of(x, 10, site::remaining_code));
    }

    /// Both lifetimes, SpawnTime and, where the layout has it, the order.
    void set_birth(const Real& life, const Real& time, std::uint32_t order) {
        if (plan_.floats) {
            set(plan_.lifetime, r.note(site::lifetime, life));
            set(plan_.remaining, r.note(site::remaining, life));
            set(plan_.spawn_time, r.note(site::spawn_time, time));
            if (plan_.order >= 0)
                raw_[static_cast<std::size_t>(plan_.order)] = static_cast<std::uint32_t>(
                    static_cast<int>(r.note(site::spawn_order, typename R::Int(static_cast<int>(order)))));
        } else if (counts_ticks()) {
            const auto share = r.note(
                site::ticks_of_life, r.divide(site::ticks_of_life, life, r.uniform(site::tick, host_.settings().tick)));
            const std::uint32_t ticks = ticks_of(r, site::lifetime_code, share);
            set_word_of(3, ticks, ticks);
            set_low(5, static_cast<std::uint32_t>(static_cast<int>(
                           r.note(site::spawn_code, typename R::Int(static_cast<int>(frame_ & 0xffffU))))));
        } else {
            const std::uint32_t initial = half_of(life, 9, site::lifetime_code);
            set_word_of(3, initial, half_of(life, 10, site::remaining_code));
            set_low(5, half_of(time, 11, site::spawn_code));
        }
    }

    void set_sizes(const Real& initial, const Real& last) {
        const auto [first, end] = r.note(site::sizes, typename R::Vec2{initial, last});
        if (plan_.half_sizes) {
            const std::uint32_t code = half_of(first, 12, site::size_code);
            return set_word_of(static_cast<std::size_t>(plan_.size), code, half_of(end, 13, site::size_code));
        }
        set(plan_.size, r.note(site::initial_size, first));
        set(plan_.end_size, r.note(site::end_size, end));
    }
    [[nodiscard]] std::array<Real, 2> sizes() const {
        if (plan_.half_sizes)
            return {half(high(static_cast<std::size_t>(plan_.size))), half(low(static_cast<std::size_t>(plan_.size)))};
        return {word(site::initial_size, plan_.size), word(site::end_size, plan_.end_size)};
    }

    [[nodiscard]] Real from_previous() const {
        return plan_.half_lengths ? half(high(static_cast<std::size_t>(plan_.previous)))
                                  : word(site::previous_code, plan_.previous);
    }
    [[nodiscard]] Real from_start() const {
        return plan_.half_lengths ? half(low(static_cast<std::size_t>(plan_.start)))
                                  : word(site::start_code, plan_.start);
    }
    void set_from_previous(const Real& x) {
        if (plan_.half_lengths)
            set_high(static_cast<std::size_t>(plan_.previous), half_of(x, 14, site::previous_code));
        else
            set(plan_.previous, x);
    }
    void set_from_start(const Real& x) {
        if (plan_.half_lengths)
            set_low(static_cast<std::size_t>(plan_.start), half_of(x, 15, site::start_code));
        else
            set(plan_.start, x);
    }

    /// Red, green, blue; opacity.
    void set_color(bool end, const Vec3& rgb, const Real& opacity) {
        const auto word = static_cast<std::size_t>(end ? plan_.end_color : plan_.color);
        if (!plan_.float_colors) {
            raw_[word] = code_of(rgb, opacity);
            return;
        }
        set_words(static_cast<int>(word), rgb);
        set(end ? plan_.end_opacity : plan_.opacity, opacity);
    }
    [[nodiscard]] std::array<Real, 4> color(bool end) const {
        const auto at_word = static_cast<std::size_t>(end ? plan_.end_color : plan_.color);
        if (plan_.float_colors) {
            const Vec3 rgb = words(end ? site::end_color : site::initial_color, static_cast<int>(at_word));
            return {rgb.x, rgb.y, rgb.z,
                    word(end ? site::end_opacity : site::initial_opacity, end ? plan_.end_opacity : plan_.opacity)};
        }
        const bool rgba8 = host_.switches().color_code == ColorCode::rgba8;
        std::array<Real, 4> found;
        for (std::size_t c = 0; c < 4; ++c) {
            const std::uint32_t bits = rgba8 ? 8 : c == 3 ? 2 : 10, most = (1U << bits) - 1U;
            const std::uint32_t shift =
                rgba8 ? 8U * static_cast<std::uint32_t>(c) : 10U * static_cast<std::uint32_t>(c);
            found[c] =
                divided_by(r, site::color_code, R::real((raw_[at_word] >> shift) & most), static_cast<float>(most));
        }
        return found;
    }

    /// Whether a place was outside of the box of box16.
    [[nodiscard]] bool was_clamped() const { return clamped_; }

    [[nodiscard]] ItemWords<R> record() const {
        ItemWords<R> all;
        for (std::size_t w = 0; w < plan_.words; ++w)
            if (!plan_.is_float(w))
                all.add(raw_[w]);
            else if ((made_ & (1U << w)) != 0)
                all.add(numbers_[w]);
            else
                all.add(Real(std::bit_cast<float>(raw_[w])));
        return all;
    }

  private:
    [[nodiscard]] bool boxed() const { return host_.switches().position_code == PositionCode::box16; }

    [[nodiscard]] Real word(At place, int w) const {
        return r.read(place, std::bit_cast<float>(raw_[static_cast<std::size_t>(w)]));
    }
    [[nodiscard]] Vec3 words(At place, int w) const {
        const auto at_word = static_cast<std::size_t>(w);
        return r.read(place, glm::vec3(std::bit_cast<float>(raw_[at_word]), std::bit_cast<float>(raw_[at_word + 1]),
                                       std::bit_cast<float>(raw_[at_word + 2])));
    }
    void set(int w, const Real& x) {
        numbers_[static_cast<std::size_t>(w)] = x;
        made_ |= 1U << static_cast<std::uint32_t>(w);
    }
    void set_words(int w, const Vec3& v) {
        set(w, v.x);
        set(w + 1, v.y);
        set(w + 2, v.z);
    }
    [[nodiscard]] std::uint32_t code_of(const Vec3& rgb, const Real& opacity) {
        const bool rgba8 = host_.switches().color_code == ColorCode::rgba8;
        const float steps = rgba8 ? 255.0F : 1023.0F;
        const std::uint32_t red = unorm_of(r, site::color_code, rgb.x, steps);
        const std::uint32_t green = unorm_of(r, site::color_code, rgb.y, steps);
        const std::uint32_t blue = unorm_of(r, site::color_code, rgb.z, steps);
        const std::uint32_t alpha = unorm_of(r, site::color_code, opacity, rgba8 ? 255.0F : 3.0F);
        return rgba8 ? red | green << 8U | blue << 16U | alpha << 24U : red | green << 10U | blue << 20U | alpha << 30U;
    }

    [[nodiscard]] std::uint32_t high(std::size_t w) const { return raw_[w] >> 16U; }
    [[nodiscard]] std::uint32_t low(std::size_t w) const { return raw_[w] & 0xffffU; }
    [[nodiscard]] Real half(std::uint32_t code) const { return r.read(site::half_read, half_value(code)); }
    [[nodiscard]] std::uint32_t half_of(const Real& x, std::uint32_t field, At place) const {
        const HalfRounding rounding = host_.switches().half_rounding;
        const std::uint32_t dither = rounding == HalfRounding::dithered ? pcg3d({slot_, frame_, field})[0] : 0U;
        return lifecycle::half_of(r, place, x, rounding, dither,
                                  host_.settings().arithmetic == ArithmeticSwitch::exact);
    }
    void set_word_of(std::size_t w, std::uint32_t upper, std::uint32_t lower) { raw_[w] = upper << 16U | lower; }
    void set_high(std::size_t w, std::uint32_t code) { raw_[w] = code << 16U | (raw_[w] & 0xffffU); }
    void set_low(std::size_t w, std::uint32_t code) { raw_[w] = (raw_[w] & 0xffff0000U) | code; }

    R& r;
    const Host& host_;
    const LayoutPlan& plan_;
    RawWords raw_;
    std::array<Real, 28> numbers_{};
    std::uint32_t made_ = 0; ///< the words that numbers_ has
    std::uint32_t slot_ = 0, frame_ = 0;
    bool clamped_ = false;
};

/// The particle as it is, word by word.
template <class R> ItemWords<R> kept(R& r, const Host& host, const PassInput& in, std::size_t item) {
    return Particle<R>(r, host, raw_words(in.before, particle_buffer, item)).record();
}

} // namespace lockstep::lifecycle
