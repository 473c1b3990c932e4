#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "reference/model/srgb_table.hpp"
#include "reference/readings/site.hpp"
#include "reference/system/item_twin.hpp"
#include "reference/system/item_words.hpp"

namespace lockstep {

/// The places of the twin.
namespace encode_site {
inline constexpr Site radiance_in{"lit value"}, threshold{"threshold"}, at_least{"at least the threshold"},
    code_value{"code before rounding"}, code{"code"};
} // namespace encode_site

/// sRGB's curve (IEC 61966-2-1) of 0..1.
inline double srgb_curve(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055; }

/// An image of numbers, r g b a, to one of codes of 8 bits. Twin of shaders/encode_pass.comp and encode_by_gl_pass.*.
struct EncodeTwin {
    Encoding encoding;
    FieldId numbers;
    bool nearest_code = false; ///< GL's sRGB store is known to give the code nearest to the curve

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        using Real = typename R::Real;
        ItemWords<R> words;
        const auto v = r.read(encode_site::radiance_in, glm::vec3(in.before.vec4(numbers, item)));
        for (const Real& x : {v.x, v.y, v.z}) {
            const Real clamped = r.min(Real(1.0F), r.max(Real(0.0F), x));
            const typename R::Int k = r.note(encode_site::code, code_of(r, clamped));
            words.add(static_cast<std::uint32_t>(static_cast<int>(k)));
        }
        words.add(std::uint32_t{255});
        return words;
    }

    /// Whether the curve's thresholds decide the codes.
    [[nodiscard]] bool has_table() const {
        return encoding == Encoding::srgb_table || (encoding == Encoding::srgb_hw && nearest_code);
    }
    /// Those of items first to last, the last excluded, by a table of where to begin.
    void by_table(const PassInput& in, std::size_t first, std::size_t last, const WritableView& after) const {
        const View& from = in.before[numbers.resource];
        for (std::size_t item = first; item < last; ++item) {
            std::array<float, 3> v{};
            std::memcpy(v.data(), from.columns[numbers.field] + item * 4 * sizeof(float), sizeof v);
            const std::array<std::uint32_t, 4> codes{nearest_code_of(v[0]), nearest_code_of(v[1]),
                                                     nearest_code_of(v[2]), 255};
            std::memcpy(after.columns[0] + item * sizeof codes, codes.data(), sizeof codes);
        }
    }

    /// The same of linear8. Numbers that an arithmetic flushes have code 0 as they stand.
    void by_rounding(const PassInput& in, std::size_t first, std::size_t last, const WritableView& after) const {
        const View& from = in.before[numbers.resource];
        for (std::size_t item = first; item < last; ++item) {
            std::array<float, 3> v{};
            std::memcpy(v.data(), from.columns[numbers.field] + item * 4 * sizeof(float), sizeof v);
            std::array<std::uint32_t, 4> codes{0, 0, 0, 255};
            for (std::size_t c = 0; c < v.size(); ++c) {
                const float above = v[c] > 0.0F ? v[c] : 0.0F, clamped = above < 1.0F ? above : 1.0F;
                codes[c] = static_cast<std::uint32_t>(static_cast<std::int32_t>(255.0F * clamped + 0.5F));
            }
            std::memcpy(after.columns[0] + item * sizeof codes, codes.data(), sizeof codes);
        }
    }

  private:
    /// The number of thresholds at or below.
    static std::uint32_t nearest_code_of(float x) {
        constexpr int cells = 4096;
        static const std::array<std::uint8_t, cells + 1> begins = [] {
            std::array<std::uint8_t, cells + 1> all{};
            std::size_t code = 0;
            for (int cell = 0; cell <= cells; ++cell) {
                while (code < 255 && srgb_threshold(code) <= static_cast<float>(cell) / cells)
                    ++code;
                all[static_cast<std::size_t>(cell)] = static_cast<std::uint8_t>(code);
            }
            return all;
        }();
        if (!(x > 0.0F))
            return 0;
        const float clamped = x < 1.0F ? x : 1.0F;
        std::size_t code = begins[static_cast<std::size_t>(clamped * static_cast<float>(cells))];
        while (code < 255 && srgb_threshold(code) <= clamped)
            ++code;
        return static_cast<std::uint32_t>(code);
    }

    template <class R> typename R::Int code_of(R& r, const typename R::Real& x) const {
        using Real = typename R::Real;
        if (encoding == Encoding::linear8)
            return r.to_int(encode_site::code_value,
                            r.floor(r.note(encode_site::code_value, Real(255.0F) * x + Real(0.5F))));
        if (encoding == Encoding::srgb_hw)
            return r.to_int(encode_site::code_value, encoded_by_gl(r, x));
        return code_by_table(r, x);
    }
    /// The number of thresholds at or below.
    template <class R> typename R::Int code_by_table(R& r, const typename R::Real& x) const {
        int code = 0;
        for (int step = 128; step > 0; step /= 2)
            if (r.decide(encode_site::at_least,
                         r.uniform(encode_site::threshold, srgb_threshold(static_cast<std::size_t>(code + step - 1))) <=
                             x))
                code += step;
        return code;
    }
    /// The nearest code where that is known; else the curve right to 1 part in 10^5 (GL 4.5, 2.3.4.1), and either of
    /// the two codes next to it (2.3.5.2).
    template <class R> typename R::Real encoded_by_gl(R& r, const typename R::Real& x) const {
        using Real = typename R::Real;
        if (nearest_code)
            return r.real(code_by_table(r, x));
        const Interval set = item_twin::set_of(x);
        const double value = 255.0 * srgb_curve(double{set.as_float()});
        const double low = 255.0 * srgb_curve(set.low) * (1.0 - 1e-5),
                     high = 255.0 * srgb_curve(set.high) * (1.0 + 1e-5);
        return r.unspecified(encode_site::code_value, Real(static_cast<float>(std::floor(value + 0.5))),
                             static_cast<float>(std::floor(low)),
                             static_cast<float>(std::fmin(std::ceil(high), 255.0)));
    }
};

inline std::unique_ptr<ItemPass> encode_pass(ItemPassOptions options, const EncodeTwin& twin) {
    if (twin.has_table())
        options.fast = [twin](const PassInput& in, const Profile&, std::size_t first, std::size_t last,
                              const WritableView& after,
                              std::vector<std::size_t>&) { twin.by_table(in, first, last, after); };
    else if (twin.encoding == Encoding::linear8)
        options.fast = [twin](const PassInput& in, const Profile&, std::size_t first, std::size_t last,
                              const WritableView& after,
                              std::vector<std::size_t>&) { twin.by_rounding(in, first, last, after); };
    return item_pass(std::move(options), twin);
}

} // namespace lockstep
