#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "reference/interval.hpp"
#include "reference/plain_arithmetic.hpp"
#include "reference/readings/values.hpp"
#include "reference/text/invocation.hpp"

namespace lockstep::text {

/// The reading of bits, with the words that a text has and twins have not.
class TextValues : public Values<PlainArithmetic> {
  public:
    explicit TextValues(const Profile& profile)
        : Values<PlainArithmetic>(PlainArithmetic(profile)), length_(profile.length_order()),
          normalize_(profile.normalize_order()) {}

    [[nodiscard]] Real inverse_sqrt(At, Real a) const { return fp_.inverse_sqrt(a); }
    // The orders of sums of other than three products, which a text alone has.
    [[nodiscard]] DotOrder dot_order() const { return fp_.dot_order(); }
    [[nodiscard]] DotOrder length_order() const { return length_; }
    [[nodiscard]] DotOrder normalize_order() const { return normalize_; }
    /// A component of normalize, of a vector whose dot product with itself is known.
    [[nodiscard]] Real part_of_unit(At, Real component, Real squared) const {
        return fp_.direction_of({component, 0.0F, 0.0F}, squared).x;
    }
    static Real fma(At, Real a, Real b, Real c) { return std::fma(a, b, c); }
    /// Not an unsigned conversion of negative numbers, which GLSL leaves undefined (GLSL 4.60, 5.4.1).
    static std::uint32_t to_int(At, Real x) { return static_cast<std::uint32_t>(truncated(x)); }
    static std::uint32_t to_uint(At, Real x) { return static_cast<std::uint32_t>(truncated(x)); }

  private:
    static std::int64_t truncated(float x) {
        constexpr float most = 0x1p62F;
        return x > -most && x < most ? static_cast<std::int64_t>(x) : 0;
    }
    DotOrder length_, normalize_;
};

/// The reading of bits of an invocation whose every operation is noted (machine_trace.hpp).
class TracedValues : public TextValues {
  public:
    using TextValues::TextValues;
};

class TextWorlds;
/// A reading whose numbers are sets.
template <class R> inline constexpr bool has_sets = false;
template <> inline constexpr bool has_sets<TextWorlds> = true;
template <class R> inline constexpr bool is_traced = false;
template <> inline constexpr bool is_traced<TracedValues> = true;
/// Whether it runs one invocation again and again, and keeps what this writes beside memory, which stays as it is.
template <class R> inline constexpr bool runs_apart = has_sets<R> || is_traced<R>;

/// One scalar of one invocation. Of bits alone a word is enough; sets have a number of theirs beside it.
template <class R> struct Cell {
    std::uint32_t w = 0;

    [[nodiscard]] float real() const { return std::bit_cast<float>(w); }
    [[nodiscard]] std::uint32_t word() const { return w; }
    void set(float number) { w = std::bit_cast<std::uint32_t>(number); }
    void set(std::uint32_t word) { w = word; }
};
template <class R>
requires has_sets<R>
struct Cell<R> {
    using Terms = std::vector<Interval>;
    typename R::Real x{};
    mutable std::uint32_t w = 0;
    mutable R* bits_of_x = nullptr;     ///< the reading: the word is that of x, a set until the word is asked for
    bool is_real = false;               ///< of what was written: which of the two it is
    std::shared_ptr<const Terms> terms; ///< of a sum without `precise`, whose order is open; null: it is none

    [[nodiscard]] const typename R::Real& real() const { return x; }
    /// Of a number's bits, those of one float of its set, each in a run of its own.
    [[nodiscard]] std::uint32_t word() const {
        if (bits_of_x != nullptr)
            w = std::bit_cast<std::uint32_t>(std::exchange(bits_of_x, nullptr)->one_of(x));
        return w;
    }
    void set(const typename R::Real& number) {
        x = number;
        bits_of_x = nullptr;
        terms.reset();
    }
    void set(std::uint32_t word) {
        w = word;
        bits_of_x = nullptr;
        terms.reset();
    }
    void set_bits_of(const typename R::Real& number, R& reading) {
        set(number);
        bits_of_x = &reading;
        if (const Interval all = number.set(); all.any || all.is_point())
            static_cast<void>(word());
    }
};

template <class R> using WrittenWords = std::map<WrittenPlace, Cell<R>>;

} // namespace lockstep::text
