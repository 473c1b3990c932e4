#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "reference/arithmetic.hpp"
#include "reference/model/arithmetic_switch.hpp"
#include "reference/packed_roots.hpp"
#include "reference/portable.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep {

/// What a profile's arithmetic (arithmetic.hpp) does to a block of particles: its bits, any NaN counting as any other,
/// in loops that run on vectors. `Sums`: how the squares inside length and normalize are summed.

/// length and normalize sum alike.
template <DotOrder order> struct OneOrder {
    static constexpr bool one = true;
    static float length_square(glm::vec3 v) { return dot_in(order, v, v); }
    static float normalize_square(glm::vec3 v) { return dot_in(order, v, v); }
};

/// Each in an order of its own, which is asked for each time: slower.
struct OwnSums {
    static constexpr bool one = false;
    DotOrder length, normalize;
    [[nodiscard]] float length_square(glm::vec3 v) const { return dot_in(length, v, v); }
    [[nodiscard]] float normalize_square(glm::vec3 v) const { return dot_in(normalize, v, v); }
};

using Floats = std::array<float, block_size>;

/// Division and roots are rounded.
template <class Sums> struct RoundedBlocks : Strict {
    Sums sums;

    explicit RoundedBlocks(Sums sums_) : sums(sums_) {}

    /// What a numerator is divided by later, for quotient().
    static void divisors(const Floats& w, std::size_t count, Floats& divisor) {
        LOCKSTEP_VECTOR_LOOP
        for (std::size_t i = 0; i < count; ++i)
            divisor[i] = w[i];
    }
    static float quotient(float a, float divisor) { return a / divisor; }
    static float reciprocal_of(float divisor) { return 1.0F / divisor; }

    /// Of vectors of which these are the squares: the length, and what normalize multiplies them by.
    static void roots(const Floats& length_square, const Floats& normalize_square, std::size_t count, Floats& length,
                      Floats& inverse) {
        LOCKSTEP_VECTOR_LOOP
        for (std::size_t i = 0; i < count; ++i)
            length[i] = std::sqrt(length_square[i]);
        LOCKSTEP_VECTOR_LOOP
        for (std::size_t i = 0; i < count; ++i)
            inverse[i] = 1.0F / (Sums::one ? length[i] : std::sqrt(normalize_square[i]));
    }
    static void inverse_roots(const Floats& square, std::size_t count, Floats& inverse) {
        LOCKSTEP_VECTOR_LOOP
        for (std::size_t i = 0; i < count; ++i)
            inverse[i] = 1.0F / std::sqrt(square[i]);
    }
};

/// They are made of the driver's own tables.
template <class Sums> struct TableBlocks : Strict {
    Sums sums;
    const PackedRoots* tables;

    TableBlocks(Sums sums_, const PackedRoots& tables_) : sums(sums_), tables(&tables_) {}

    void divisors(const Floats& w, std::size_t count, Floats& divisor) const {
        tables->reciprocals(w.data(), count, divisor.data());
    }
    static float quotient(float a, float divisor) { return a * divisor; }
    static float reciprocal_of(float divisor) { return divisor; }

    void roots(const Floats& length_square, const Floats& normalize_square, std::size_t count, Floats& length,
               Floats& inverse) const {
        tables->sqrts(length_square.data(), count, length.data(), inverse.data());
        if constexpr (!Sums::one)
            tables->inverse_sqrts(normalize_square.data(), count, inverse.data());
    }
    void inverse_roots(const Floats& square, std::size_t count, Floats& inverse) const {
        tables->inverse_sqrts(square.data(), count, inverse.data());
    }
};

/// Portable. Operands have been through flush(); what cannot be tiny is not flushed again.
struct PortableBlocks : Portable {
    struct Squares {
        static constexpr bool one = true;
        static float length_square(glm::vec3 v) { return normalize_square(v); }
        static float normalize_square(glm::vec3 v) {
            const auto square = [](float x) {
                const float xx = x * x;
                return xx <= std::numeric_limits<float>::min() ? 0.0F : xx;
            };
            return (square(v.x) + square(v.y)) + square(v.z);
        }
    };
    static constexpr Squares sums{};

    static glm::vec3 scale(glm::vec3 v, float s) { return flush(v * s); }
    static glm::vec4 transform(const glm::mat4& m, glm::vec3 v) {
        const auto row = [&](int r) {
            const float xy = flush(flush(m[0][r] * v.x) + flush(m[1][r] * v.y));
            return flush(flush(xy + flush(m[2][r] * v.z)) + m[3][r]);
        };
        return {row(0), row(1), row(2), row(3)};
    }

    static void divisors(const Floats& w, std::size_t count, Floats& divisor) {
        RoundedBlocks<Squares>::divisors(w, count, divisor);
    }
    static float quotient(float a, float divisor) { return flush(a / divisor); }
    static float reciprocal_of(float divisor) { return flush(1.0F / divisor); }

    static void roots(const Floats& length_square, const Floats& normalize_square, std::size_t count, Floats& length,
                      Floats& inverse) {
        LOCKSTEP_VECTOR_LOOP
        for (std::size_t i = 0; i < count; ++i)
            length[i] = std::sqrt(length_square[i]);
        inverse_roots(normalize_square, count, inverse);
    }
    /// NaN where a vector has no direction.
    static void inverse_roots(const Floats& square, std::size_t count, Floats& inverse) {
        LOCKSTEP_VECTOR_LOOP
        for (std::size_t i = 0; i < count; ++i) {
            const bool has_direction = (square[i] > 0.0F) & (square[i] <= std::numeric_limits<float>::max());
            inverse[i] = has_direction ? 1.0F / std::sqrt(square[i]) : std::numeric_limits<float>::quiet_NaN();
        }
    }
};

/// A matrix's elements as transform() takes them.
template <class B> glm::mat4 flushed(const glm::mat4& matrix) {
    glm::mat4 m = matrix;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            m[column][row] = B::flush(m[column][row]);
    return m;
}

/// Null where roots are not made of tables.
template <class B> const PackedRoots* tables_of(const B& fp) {
    if constexpr (requires { fp.tables; })
        return fp.tables;
    else
        return nullptr;
}

/// Calls `pass` with the block arithmetic that a profile and the switch name. False where there is none, and it was not
/// called: the driver's tables have what cannot be packed, or normalize divides.
template <class Pass> bool with_block_arithmetic(const Profile& profile, ArithmeticSwitch arithmetic, Pass&& pass) {
    const auto with_sums = [&](auto sums) {
        if (profile.roots == nullptr) {
            pass(RoundedBlocks(sums));
            return true;
        }
        const auto tables = packed_roots(profile.roots);
        if (tables != nullptr)
            pass(TableBlocks(sums, *tables));
        return tables != nullptr;
    };
    if (arithmetic == ArithmeticSwitch::exact) {
        pass(PortableBlocks());
        return true;
    }
    if (profile.normalize_divides)
        return false;
    if (profile.length_order() == profile.normalize_order())
        switch (profile.length_order()) {
        case DotOrder::left_to_right:
            return with_sums(OneOrder<DotOrder::left_to_right>());
        case DotOrder::right_to_left:
            return with_sums(OneOrder<DotOrder::right_to_left>());
        case DotOrder::fused_chain:
            return with_sums(OneOrder<DotOrder::fused_chain>());
        default:
            break;
        }
    return with_sums(OwnSums{profile.length_order(), profile.normalize_order()});
}

} // namespace lockstep
